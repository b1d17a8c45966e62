//! Units of wavelengths and the range in which wavelengths are plausible.

use serde::{Deserialize, Serialize};
use std::fmt;

use crate::decimal;
use crate::decimal::clean;

/// The unit in which wavelengths are written.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum WavelengthUnit {
    /// nm.
    #[serde(alias = "nanometers")]
    Nanometer,
    /// µm: 1000 nm.
    #[serde(alias = "micrometers")]
    Micrometer,
    /// Å: 0.1 nm.
    #[serde(alias = "angstroms")]
    Angstrom,
    /// Wave numbers σ in 1/cm, taken as the vacuum wavelength 10⁷ nm/σ.
    Wavenumber,
    /// Frequencies ν in THz, taken as the vacuum wavelength c/ν with c = 299 792.458 nm THz.
    Terahertz,
}

impl fmt::Display for WavelengthUnit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Nanometer => "nanometers",
            Self::Micrometer => "micrometers",
            Self::Angstrom => "ångströms",
            Self::Wavenumber => "wave numbers in 1/cm",
            Self::Terahertz => "frequencies in terahertz",
        })
    }
}

impl WavelengthUnit {
    /// The unit of a symbol or name, such as `nm`, `um`, `µm` or `Micrometers`.
    pub(super) fn from_symbol(symbol: &str) -> Option<Self> {
        // Every unit has a letter: numbers cut in pieces by a wrong separator have none.
        if symbol.len() > 16 || !symbol.contains(char::is_alphabetic) {
            return None;
        }
        let lower = symbol.to_lowercase();
        match lower.as_str() {
            "nm" | "nanometer" | "nanometers" | "nanometre" | "nanometres" => Some(Self::Nanometer),
            // U+00B5 and U+03BC, and the former misread as Windows-1252.
            "um" | "µm" | "μm" | "âµm" | "micron" | "microns" | "micro" | "micrometer" | "micrometers"
            | "micrometre" | "micrometres" => Some(Self::Micrometer),
            "cm-1" | "cm^-1" | "1/cm" | "cm⁻¹" | "wavenumbers" => Some(Self::Wavenumber),
            "thz" | "terahertz" => Some(Self::Terahertz),
            "å" | "ångström" | "ångströms" | "angstrom" | "angstroms" => Some(Self::Angstrom),
            _ => None,
        }
    }

    /// The wavelength in nanometers that a number in this unit means, to 1e-9 nm.
    pub fn nanometers(self, value: f64) -> f64 {
        match self {
            Self::Nanometer => value,
            Self::Micrometer => clean(decimal::shifted(value, 3)),
            Self::Angstrom => clean(decimal::shifted(value, -1)),
            Self::Wavenumber => clean(1e7 / value),
            Self::Terahertz => clean(SPEED_OF_LIGHT_NM_THZ / value),
        }
    }

    /// The number in this unit that means a wavelength in nanometers, to 1e-9 of the unit: what
    /// [`nanometers`](Self::nanometers) was given.
    pub fn from_nanometers(self, nm: f64) -> f64 {
        match self {
            Self::Nanometer => nm,
            Self::Micrometer => decimal::shifted(nm, -3),
            Self::Angstrom => decimal::shifted(nm, 1),
            Self::Wavenumber => clean(1e7 / nm),
            Self::Terahertz => clean(SPEED_OF_LIGHT_NM_THZ / nm),
        }
    }
}

/// The speed of light in vacuum in nm THz, exact.
pub(super) const SPEED_OF_LIGHT_NM_THZ: f64 = 299_792.458;

/// Accepted wavelengths in nanometers: beyond what any instrument for light measures.
pub(super) const RANGE_NM: std::ops::RangeInclusive<f64> = 100.0..=25_000.0;

/// Returns whether numbers can be wavelengths at all: in range as nanometers, or as micrometers with fractions.
pub(super) fn plausible(min: f64, max: f64, fractions: bool) -> bool {
    (RANGE_NM.contains(&min) && RANGE_NM.contains(&max)) || (fractions && min >= 0.2 && max <= 20.0)
}
