//! Cost of the methods in nanoseconds on one core: a model, so that the choice is the same on every machine.
//!
//! Measured on an AVX2 Xeon; ratios hold better than times.

use super::method::IntegrationMethod;
use crate::reflectance::Precision;

/// One S(g, b) among many.
pub(super) const fn sum_ns(precision: Precision) -> f64 {
    match precision {
        Precision::Coarse => 35.0,
        Precision::Fine => 50.0,
        Precision::Full => 65.0,
    }
}

/// Factor by which one sample alone takes longer.
const ALONE: f64 = 1.5;

/// One of the paper's three cases of g.
const REGIMES_NS: f64 = 30.0;

/// A place of a table from another.
pub(super) const PLACE_NS: f64 = 100.0;

/// Number of cells, half a megabyte, up to which a table is read from near caches, and the cost of each doubling
/// beyond.
const NEAR_CELLS: f64 = 16_384.0;
const FAR_NS: f64 = 4.0;

/// All wavelengths of the grid.
const EVERY: f64 = 401.0;

/// One sample.
pub(super) fn of_sample(method: &IntegrationMethod) -> f64 {
    match *method {
        IntegrationMethod::Nothing => 0.0,
        IntegrationMethod::Moments { orders, .. } => 3.0 + orders as f64,
        IntegrationMethod::Table { degree, kappas, betas, .. } => {
            let far = ((kappas * betas) as f64 / NEAR_CELLS).log2().max(0.0);
            24.0 + 0.9 * ((degree + 1) * (degree + 1)) as f64 + FAR_NS * far
        }
        IntegrationMethod::Shared { nodes, precision } => nodes as f64 * sum_ns(precision),
        IntegrationMethod::Own { nodes, precision } => ALONE * nodes as f64 * sum_ns(precision),
        IntegrationMethod::Every { precision } => EVERY * sum_ns(precision),
        IntegrationMethod::Regimes => EVERY * REGIMES_NS,
    }
}
