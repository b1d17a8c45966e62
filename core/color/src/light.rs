//! Lights: blackbodies and daylight by formula; measured ones are plain spectra.

pub mod daylight;
pub mod filter;
pub mod planckian;
pub mod temperature;

pub use daylight::{DaylightBasis, DaylightError};
pub use planckian::RadiationConstants;
pub use temperature::{Cct, CctError, LocusError, PlanckianLocus};
