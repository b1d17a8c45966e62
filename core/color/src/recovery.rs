//! Sensitivities of a camera from what it recorded: of a chart, or of narrow bands.
//!
//! Curves are known at [`sites`](Library::wavelengths_nm) and between them as tables at even steps are (Sprague, CIE 167:2005). The
//! library's tables make a Gaussian prior of red, green and blue together; the posterior has the covariance of all samples.

pub mod chart;
mod check;
mod curves;
mod narrow_band;
mod prior;
mod profile;
mod tables;

pub use chart::{ChartRecovery, RecoveryError, Shot};
pub use check::left_out;
pub use curves::RecoveredCurves;
pub use narrow_band::{Band, Cell, NarrowBandError, NarrowBandRecovery, NarrowBands, Pass};
pub use prior::{Library, Prior};
pub use profile::{FitSource, PatchFit, ShotProfile};
pub use tables::{TableDifference, open_ends};
