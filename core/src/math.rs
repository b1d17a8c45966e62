//! Numerical tools with no knowledge of color: interpolation, Chebyshev polynomials, Gauss rules, least squares, dot products,
//! exponentials and logarithms that vectorize.

pub mod chebyshev;
pub mod dot;
pub mod exp;
pub mod gauss;
pub mod interpolation;
pub mod least_squares;
pub mod ln;
