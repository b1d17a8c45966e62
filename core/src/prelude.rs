//! The names that most programs need.
//!
//! ```
//! use chromascope_core::prelude::*;
//! ```

pub use crate::camera::{ColorTransform, LocusEvaluator, Rendering, RenderingError, WhiteBalanceTarget};
pub use crate::colorimetry::{Lab, UvPrime, Xy, Xyz, delta_e_1976, delta_e_2000};
pub use crate::correction::{Correction, CorrectionMethod};
#[cfg(feature = "data")]
pub use crate::data;
pub use crate::light::{Cct, DaylightBasis, PlanckianLocus, RadiationConstants};
pub use crate::patch_set::{Patch, PatchSet};
pub use crate::query::{Ask, Direct, Query, Shared};
pub use crate::spectral::{Dataset, GridSpectrum, Primaries, Quantity, Response, Sensor, SpectralDistribution};
pub use crate::units::Kelvin;
