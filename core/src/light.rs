//! Lights: black bodies and daylight by formula; measured ones are plain spectra.

pub mod daylight;
pub mod locus_table;
pub mod planckian;
pub mod temperature;

pub use daylight::{DaylightBasis, DaylightError};
pub use locus_table::{LocusTable, NotInTable};
pub use planckian::RadiationConstants;
pub use temperature::{Cct, NoCct, NoLocus, PlanckianLocus};
