//! Differences between what two sensors see.

use super::loci::LocusPoint;
use super::patches::PatchColor;
use chromascope_color::colorimetry::{Coordinates, Lab, Metric, UvPrime, Xy};
use chromascope_color::spectral::Primaries;

/// Reason for no difference between two colors.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, thiserror::Error)]
#[allow(missing_docs, reason = "each variant says in its message what is wrong")]
pub enum DifferenceError {
    #[error(
        "a CIE observer is drawn directly while cameras and RGB observers go through Eq 13, so the two differ by construction; \
         choose a fitted color transform to compare them"
    )]
    Ways,
    #[error("chromaticity undefined (X + Y + Z = 0)")]
    NoChromaticity,
    #[error("the adopted white has a component that is not positive, so L*a*b* is undefined")]
    NoLab,
}

/// Checks that two sensors' colors may be compared under Eq 13.
///
/// # Errors
/// [`DifferenceError`] where one sensor counts in RGB and the other in XYZ.
pub fn comparable_by_paper(a: Primaries, b: Primaries) -> Result<(), DifferenceError> {
    let direct = |p: Primaries| p == Primaries::Xyz;
    if direct(a) == direct(b) { Ok(()) } else { Err(DifferenceError::Ways) }
}

/// Difference of a color from the reference's: of one patch, or of one temperature on two loci.
///
/// # Errors
/// [`DifferenceError`] where a color has no chromaticity, or no L\*a\*b\* where the metric needs it.
pub fn difference(
    metric: Metric,
    reference: &impl Coordinates,
    sample: &impl Coordinates,
) -> Result<f64, DifferenceError> {
    let undefined = if metric.needs_adopted_white() { DifferenceError::NoLab } else { DifferenceError::NoChromaticity };
    metric.between(reference, sample).ok_or(undefined)
}

impl Coordinates for PatchColor {
    fn xy(&self) -> Option<Xy> {
        self.xy
    }

    fn uv_prime(&self) -> Option<UvPrime> {
        self.uv
    }

    fn lab(&self) -> Option<Lab> {
        self.lab
    }
}

impl Coordinates for LocusPoint {
    fn xy(&self) -> Option<Xy> {
        self.xy
    }

    fn uv_prime(&self) -> Option<UvPrime> {
        self.uv
    }

    fn lab(&self) -> Option<Lab> {
        None
    }
}
