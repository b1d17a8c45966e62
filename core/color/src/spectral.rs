//! Spectra: samples over wavelength, the integration grid, and the assumptions of the resampling.
//!
//! A [`SpectralDistribution`] is what was measured. A [`GridSpectrum`] is the same on the standard grid (380–780 nm at
//! 1 nm), with the ranges where nothing was measured. A [`Sensor`] is three sensitivities ready to integrate.

pub mod dataset;
pub mod distribution;
pub mod grid;
pub mod sensor;
pub mod stated_uncertainty;

pub use dataset::{Dataset, DatasetError, Header};
pub use distribution::{DistributionError, SpectralDistribution};
pub use grid::{Assumed, GridSpectrum, Interpolation, Quantity};
pub use sensor::{Evidence, Primaries, Response, Sensor, SensorError};
pub use stated_uncertainty::{Correlation, StatedUncertainty, StatedUncertaintyError};
