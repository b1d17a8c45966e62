//! Colors as numbers: tristimulus values, chromaticities, Lab, differences, adaptation, RGB spaces, diagram curves.

pub mod adaptation;
pub mod ciecam02;
pub mod diagram;
pub mod difference;
pub mod lab;
pub mod rgb;
pub mod tristimulus;

pub use difference::{Coordinates, Metric, Stimulus, delta_e_1976, delta_e_2000, delta_e_2000_into};
pub use lab::Lab;
pub use tristimulus::{Uv60, UvPrime, Xy, Xyz};
