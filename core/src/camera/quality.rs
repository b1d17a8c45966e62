//! Figures of merit of a sensor's curves: how near they come to an observer's, and what correcting them costs in noise.
//!
//! They rank cameras differently, because each weighs something else: the Vora value the directions of the two spaces, the Luther
//! residual power at each wavelength, the metamerism index the colors of surfaces.

mod index;
mod noise;
pub(crate) mod space;

pub use index::{IndexSamples, MetamerismIndex};
pub use noise::{Electrons, ElectronsError, NoiseAmplification, covariance, gray_snr_db};
pub use space::SpaceQuality;
