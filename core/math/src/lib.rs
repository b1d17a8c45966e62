//! Numerical tools with no knowledge of color: interpolation, Chebyshev polynomials, Gauss rules, least squares, dot products,
//! correlated normal numbers, exponentials and logarithms that vectorize, and numbers of twice the digits to judge such things by.

#![allow(clippy::inline_always, reason = "each instruction set needs a copy of its own inside the caller")]

pub mod array;
pub mod cbrt;
pub mod chebyshev;
pub mod dense;
pub mod dot;
pub mod double;
pub mod exp;
pub mod gauss;
pub mod interpolation;
pub mod least_squares;
pub mod ln;
pub mod minimum;
pub mod normal;
pub mod quantile;
pub mod random;
