//! What the ways cost, in nanoseconds on one core: a model, so that the choice is the same on every machine.
//!
//! Measured on an AVX2 Xeon; ratios hold better than times.

use super::candidate::Method;
use crate::reflectance::Precision;

/// One S(g, b), between small and large arguments.
const fn sum_ns(precision: Precision) -> f64 {
    match precision {
        Precision::Coarse => 90.0,
        Precision::Fine => 120.0,
        Precision::Full => 150.0,
    }
}

/// All wavelengths of the grid.
const EVERY: f64 = 401.0;

/// One sample.
pub(super) fn of_sample(method: &Method) -> f64 {
    match *method {
        Method::Nothing => 0.0,
        Method::Moments { orders, .. } => 3.0 + orders as f64,
        Method::Table { degree, .. } => 15.0 + 0.5 * ((degree + 1) * (degree + 1)) as f64,
        Method::Shared { nodes, precision } | Method::Own { nodes, precision } => nodes as f64 * sum_ns(precision),
        Method::Every { precision } => EVERY * sum_ns(precision),
    }
}

/// What comes before the first sample.
pub(super) fn of_making(method: &Method) -> f64 {
    match *method {
        // A logarithm is taken where elsewhere a product is.
        Method::Table { kappas, betas, nodes, .. } => {
            let places = (kappas * betas) as f64 * nodes as f64;
            // Looking for its size costs half as much again.
            1.5 * places * (sum_ns(Precision::Full) + 20.0)
        }
        _ => 0.0,
    }
}
