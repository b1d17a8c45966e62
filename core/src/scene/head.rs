//! A human head from parameters.
