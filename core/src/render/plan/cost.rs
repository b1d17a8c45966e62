//! What the ways cost, in nanoseconds on one core: a model, so that the choice is the same on every machine.
//!
//! Measured on an AVX2 Xeon; ratios hold better than times.

use super::candidate::Method;
use crate::reflectance::Precision;

/// One S(g, b), between small and large arguments.
pub(super) const fn sum_ns(precision: Precision) -> f64 {
    match precision {
        Precision::Coarse => 90.0,
        Precision::Fine => 120.0,
        Precision::Full => 150.0,
    }
}

/// A place of a table from another.
pub(super) const PLACE_NS: f64 = 100.0;

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
