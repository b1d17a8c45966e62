//! Response basis of sensitivities in camera files: energy or photons.

use clap::ValueEnum;

/// Response basis of sensitivities.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum Per {
    /// Equal energy at each wavelength
    Energy,
    /// Equal numbers of photons at each wavelength
    Photon,
}
