//! What sensitivities in camera files are a response to.

use clap::ValueEnum;

/// What sensitivities are a response to.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum Per {
    /// Equal energy at each wavelength
    Energy,
    /// Equal numbers of photons at each wavelength
    Photon,
}
