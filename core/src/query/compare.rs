//! Differences between what two sensors see.

use super::loci::LocusPoint;
use super::patches::PatchColor;
use crate::colorimetry::{UvPrime, Xy, delta_e_1976, delta_e_2000};
use crate::spectral::Primaries;

/// A measure of difference.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Metric {
    /// CIEDE2000.
    #[default]
    DeltaE2000,
    /// The straight distance in L*a*b*.
    DeltaE1976,
    /// The distance in the 1976 diagram.
    UvPrime,
    /// The distance in the 1931 diagram.
    Xy,
}

/// Why there is no difference between two colors.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, thiserror::Error)]
pub enum DifferenceError {
    /// One is drawn by Eq 13, the other directly.
    #[error(
        "a CIE observer is drawn directly while cameras and RGB observers go through Eq 13, so the two differ by construction; \
         choose a fitted color transform to compare them"
    )]
    Ways,
    /// One of them has no chromaticity.
    #[error("chromaticity undefined (X + Y + Z = 0)")]
    NoChromaticity,
    /// One of them has no L*a*b*.
    #[error("the adopted white has a component that is not positive, so L*a*b* is undefined")]
    NoLab,
}

/// Whether two sensors' colors may be compared on the way that takes Eq 13.
///
/// # Errors
///
/// [`DifferenceError`] where one sensor counts in RGB and the other in XYZ.
pub fn comparable_by_paper(a: Primaries, b: Primaries) -> Result<(), DifferenceError> {
    let direct = |p: Primaries| p == Primaries::Xyz;
    if direct(a) == direct(b) { Ok(()) } else { Err(DifferenceError::Ways) }
}

/// The difference of one patch through two sensors.
///
/// # Errors
///
/// [`DifferenceError`] where a color has no chromaticity or no L\*a\*b\*, or the difference is not finite.
pub fn patch_difference(metric: Metric, a: &PatchColor, b: &PatchColor) -> Result<f64, DifferenceError> {
    match metric {
        Metric::DeltaE2000 => lab_pair(a, b).map(|(a, b)| delta_e_2000(a, b)),
        Metric::DeltaE1976 => lab_pair(a, b).map(|(a, b)| delta_e_1976(a, b)),
        Metric::UvPrime => distance(a.uv, b.uv, UvPrime::distance),
        Metric::Xy => distance(a.xy, b.xy, Xy::distance),
    }
}

/// The distance of two loci at the same temperature, in the 1931 diagram.
///
/// # Errors
///
/// [`DifferenceError`] where a point has no chromaticity.
pub fn locus_distance_xy(a: &LocusPoint, b: &LocusPoint) -> Result<f64, DifferenceError> {
    distance(a.xy, b.xy, Xy::distance)
}

/// The distance of two loci at the same temperature, in the 1976 diagram.
///
/// # Errors
///
/// [`DifferenceError`] where a point has no chromaticity.
pub fn locus_distance_uv(a: &LocusPoint, b: &LocusPoint) -> Result<f64, DifferenceError> {
    distance(a.uv, b.uv, UvPrime::distance)
}

fn lab_pair(
    a: &PatchColor,
    b: &PatchColor,
) -> Result<(crate::colorimetry::Lab, crate::colorimetry::Lab), DifferenceError> {
    a.lab.zip(b.lab).ok_or(DifferenceError::NoLab)
}

fn distance<T: Copy>(a: Option<T>, b: Option<T>, measure: impl Fn(T, T) -> f64) -> Result<f64, DifferenceError> {
    a.zip(b).map(|(a, b)| measure(a, b)).ok_or(DifferenceError::NoChromaticity)
}
