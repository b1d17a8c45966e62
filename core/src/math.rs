//! Numerical tools with no knowledge of color: interpolation, Chebyshev polynomials, Gauss rules, least squares, dot products.

pub mod chebyshev;
pub mod dot;
pub mod exp;
pub mod gauss;
pub mod interpolation;
pub mod least_squares;
