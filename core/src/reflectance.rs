//! How a rough surface scatters light: the reflectance model (Eq 1–4) and its parts.
