//! A pixel's full-well capacity and read noise: with them a camera's signal-to-noise ratio has a value.

use chromascope_core::camera::quality::{Electrons, ElectronsError};
use serde::{Deserialize, Serialize};

/// A pixel of the cameras that are compared.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub struct Pixel {
    /// Full-well capacity in electrons.
    pub full_well: f64,
    /// Read noise in electrons (RMS).
    #[serde(default)]
    pub read_noise: f64,
}

impl Pixel {
    /// Largest full-well capacity in electrons.
    pub const LARGEST: f64 = 1e9;

    /// The pixel as the core takes it.
    pub fn electrons(self) -> Result<Electrons, ElectronsError> {
        Electrons::new(self.full_well, self.read_noise)
    }

    /// Both numbers in words.
    pub fn describe(self) -> String {
        format!("full well {} electrons, read noise {} electrons", self.full_well, self.read_noise)
    }
}
