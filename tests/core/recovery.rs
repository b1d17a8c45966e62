//! Sensitivities from charts and from narrow bands: every table of the library as if it were unknown, and independent second methods.

mod chart;
mod narrow_band;
mod profile;
mod support;
mod tables;
