//! Roles, scales and quantities that curves can have.

use serde::{Deserialize, Serialize};
use std::fmt;

/// The physical quantity of values.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
#[non_exhaustive]
pub enum Quantity {
    /// Reflectance, or a reflectance factor.
    Reflectance,
    /// Transmittance.
    Transmittance,
    /// Absorptance: the fraction that is neither reflected nor transmitted. (Absorbances are read as transmittances.)
    Absorptance,
    /// Response to energy or to photons, usually relative.
    Sensitivity,
    /// Electrons for each photon.
    QuantumEfficiency,
    /// Power on an area, `W/m²/nm`.
    Irradiance,
    /// Power from an area into a solid angle, `W/sr/m²/nm`.
    Radiance,
    /// Power, `W/nm`.
    RadiantFlux,
    /// Power into a solid angle, `W/sr/nm`.
    RadiantIntensity,
    /// Spectral power of a light, without a word on its geometry.
    SpectralPower,
    /// Counts of a detector: its own sensitivity is still in it.
    Counts,
    /// A relative scale, without a word on what is compared.
    Relative,
    /// Not stated.
    Unknown,
}

impl Quantity {
    /// Role of curves of this quantity, if they have only one.
    pub fn role(self) -> Option<Role> {
        match self {
            Self::Reflectance => Some(Role::Reflectance),
            Self::Transmittance => Some(Role::Transmittance),
            Self::Sensitivity | Self::QuantumEfficiency => Some(Role::Camera),
            Self::Irradiance | Self::Radiance | Self::RadiantFlux | Self::RadiantIntensity | Self::SpectralPower => {
                Some(Role::Illuminant)
            }
            // Neither a light nor a fraction of one that a picture needs.
            Self::Absorptance | Self::Counts => Some(Role::Unknown),
            Self::Relative | Self::Unknown => None,
        }
    }
}

impl fmt::Display for Quantity {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Reflectance => "reflectance",
            Self::Transmittance => "transmittance",
            Self::Absorptance => "absorptance",
            Self::Sensitivity => "spectral sensitivity",
            Self::QuantumEfficiency => "quantum efficiency",
            Self::Irradiance => "irradiance",
            Self::Radiance => "radiance",
            Self::RadiantFlux => "radiant flux",
            Self::RadiantIntensity => "radiant intensity",
            Self::SpectralPower => "spectral power",
            Self::Counts => "counts of a detector",
            Self::Relative => "a relative scale",
            Self::Unknown => "a quantity that the file does not name",
        })
    }
}

/// Role of the curves of a file.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Role {
    /// Sensitivities of a camera, or color matching functions.
    Camera,
    /// Reflectances: fractions of one.
    Reflectance,
    /// Transmittances of filters: fractions of one.
    Transmittance,
    /// Spectral power of lights, in any unit.
    Illuminant,
    /// Neither stated nor suggested by their values.
    Unknown,
}

impl Role {
    /// Returns whether the curves are fractions of the light that falls on something.
    pub fn is_fraction(self) -> bool {
        matches!(self, Self::Reflectance | Self::Transmittance)
    }
}

impl fmt::Display for Role {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Camera => "camera sensitivities",
            Self::Reflectance => "reflectances",
            Self::Transmittance => "transmittances",
            Self::Illuminant => "illuminants",
            Self::Unknown => "spectra of an unknown kind",
        })
    }
}

/// Scale of the values as written, which decides their conversion.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Values {
    /// Taken as they are: fractions of one where the curves are reflectances or transmittances.
    Plain,
    /// Percent: divided by 100.
    Percent,
    /// Decadic absorbances A: taken as the fraction 10^−A.
    Absorbance,
    /// Decibels L of power: taken as the power 10^(L/10).
    Decibels,
}

impl fmt::Display for Values {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Plain => "plain numbers, not percent",
            Self::Percent => "percent",
            Self::Absorbance => "absorbances, of which fractions are made",
            Self::Decibels => "decibels, of which powers are made",
        })
    }
}
