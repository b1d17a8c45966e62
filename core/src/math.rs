//! Numerical tools with no knowledge of color: interpolation, Gauss rules, least squares, dot products.

pub mod dot;
pub mod exp;
pub mod gauss;
pub mod interpolation;
pub mod least_squares;
