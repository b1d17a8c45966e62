//! Correlated color temperatures, their range, and why there is none.

use crate::units::Kelvin;

/// The coldest blackbody that is looked for, in kelvins.
pub const COLDEST_K: f64 = 1000.0;
/// The hottest blackbody that is looked for, in kelvins.
pub const HOTTEST_K: f64 = 20_000.0;
/// The largest distance from the locus at which a color temperature means something (CIE 15:2004).
pub const MAX_DUV: f64 = 0.05;

pub(super) const HOTTEST_MIRED: f64 = 1e6 / HOTTEST_K;
pub(super) const COLDEST_MIRED: f64 = 1e6 / COLDEST_K;
/// Relative tolerance of the limits, so that rounding does not reject a value made from a limit itself; not clamped.
pub(super) const SLACK: f64 = 1e-11;

/// A color as the nearest blackbody and the distance from it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cct {
    /// The correlated color temperature.
    pub temperature: Kelvin,
    /// The distance from the Planckian locus in the 1960 diagram, positive above it.
    pub duv: f64,
}

/// Reason that a color has no correlated color temperature.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, thiserror::Error)]
#[allow(missing_docs, reason = "each variant says in its message what is wrong")]
pub enum CctError {
    #[error("the color has no chromaticity")]
    NoChromaticity,
    #[error("the color is further than 0.05 from the Planckian locus")]
    TooFar,
    #[error("the nearest black body is too hot")]
    TooHot,
    #[error("the nearest black body is too cold")]
    TooCold,
}

/// Reason that an observer gives no locus to compare with.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, thiserror::Error)]
#[allow(missing_docs, reason = "each variant says in its message what is wrong")]
pub enum LocusError {
    #[error("the observer does not count in XYZ")]
    NotXyz,
    #[error("black bodies have no chromaticity for this observer")]
    NoChromaticity,
    #[error("the observer's Planckian locus is too crooked")]
    Crooked,
}

/// True if a reciprocal temperature is one that is looked for.
#[inline(always)]
pub(super) fn is_in_range(mired: f64) -> bool {
    (HOTTEST_MIRED * (1.0 - SLACK)..=COLDEST_MIRED * (1.0 + SLACK)).contains(&mired)
}
