//! The user's own sets, by value: figures as read, with the decisions that can be flipped.

use std::hash::{Hash, Hasher};

use chromascope_core::query::Shared;
use chromascope_core::spectral::{DistributionError, Response, SpectralDistribution};
use serde::{Deserialize, Serialize};

/// What a set is used as.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum OwnRole {
    /// Three sensitivities.
    Camera,
    /// Reflectances: a chart.
    Reflectance,
    /// A light.
    Illuminant,
}

/// In what wavelengths are counted.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum OwnUnit {
    /// Nanometers.
    Nanometers,
    /// Micrometers.
    Micrometers,
    /// Ångströms.
    Angstroms,
}

impl OwnUnit {
    /// How many nanometers one is.
    pub const fn nanometers(self) -> f64 {
        match self {
            Self::Nanometers => 1.0,
            Self::Micrometers => 1000.0,
            Self::Angstroms => 0.1,
        }
    }
}

/// One curve, as it was read: in the units that [`OwnSet::read_as`] says.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct OwnCurve {
    /// Its column's name.
    pub name: String,
    /// Wavelengths, ascending, in nanometers if the unit was decided right.
    pub wavelengths: Vec<f64>,
    /// Values; percent already divided if that was decided.
    pub values: Vec<f64>,
}

/// What the reader took a file's units to be, and converted from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub struct ReadAs {
    /// The unit of the wavelengths.
    pub unit: OwnUnit,
    /// Whether values were percent.
    pub percent: bool,
}

/// One of the user's sets.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct OwnSet {
    /// Its name, unique among sets of its kind.
    pub name: String,
    /// The file it came from, or `clipboard`.
    pub file: String,
    /// What it is used as.
    pub role: OwnRole,
    /// The units that the curves were converted from on reading.
    pub read_as: ReadAs,
    /// The unit of the wavelengths in the file, as the user has it.
    pub unit: OwnUnit,
    /// Whether the file's values are percent, as the user has it.
    pub percent: bool,
    /// For a camera: whether it counts photons, not energy.
    #[serde(default)]
    pub per_photon: bool,
    /// For a camera: which curves are red, green and blue.
    #[serde(default = "first_three")]
    pub channels: [usize; 3],
    /// The curves, as read.
    pub curves: Vec<OwnCurve>,
    /// What was decided on reading, one line each, for people.
    #[serde(default)]
    pub decisions: Vec<String>,
}

fn first_three() -> [usize; 3] {
    [0, 1, 2]
}

impl Eq for OwnSet {}

impl Hash for OwnSet {
    fn hash<H: Hasher>(&self, state: &mut H) {
        (&self.name, &self.file, self.role, self.read_as, self.unit, self.percent, self.per_photon, self.channels)
            .hash(state);
        for curve in &self.curves {
            curve.name.hash(state);
            curve.wavelengths.iter().chain(&curve.values).for_each(|v| v.to_bits().hash(state));
        }
    }
}

impl OwnSet {
    /// The curves that its role uses, in nanometers and, for reflectances, as fractions.
    pub fn curves_in_nm(&self) -> Result<Vec<(String, SpectralDistribution)>, DistributionError> {
        let used: Vec<&OwnCurve> = match self.role {
            OwnRole::Camera => self.channels.iter().filter_map(|&index| self.curves.get(index)).collect(),
            OwnRole::Reflectance | OwnRole::Illuminant => self.curves.iter().collect(),
        };
        used.into_iter().map(|curve| Ok((curve.name.clone(), self.spectrum(curve)?))).collect()
    }

    /// What its sensitivities are a response to.
    pub fn response(&self) -> Response {
        if self.per_photon { Response::PerPhoton } else { Response::PerEnergy }
    }

    /// A curve with the units that the user has it in. Unchanged units change no bit.
    fn spectrum(&self, curve: &OwnCurve) -> Result<SpectralDistribution, DistributionError> {
        let stretch = self.unit.nanometers() / self.read_as.unit.nanometers();
        let wavelengths = if self.unit == self.read_as.unit {
            curve.wavelengths.clone()
        } else {
            // Rounded to a picometer: 0.38 µm is 380 nm, not 380.00000000000006.
            curve.wavelengths.iter().map(|w| (w * stretch * 1e3).round() / 1e3).collect()
        };
        let is_percent = self.percent && self.role == OwnRole::Reflectance;
        let values = match (is_percent, self.read_as.percent) {
            (true, false) => curve.values.iter().map(|v| v / 100.0).collect(),
            (false, true) => curve.values.iter().map(|v| v * 100.0).collect(),
            _ => curve.values.clone(),
        };
        SpectralDistribution::new(wavelengths, values)
    }
}

/// Saves shared sets as plain values.
pub(super) mod list {
    use super::{OwnSet, Shared};
    use serde::{Deserialize, Deserializer, Serializer};

    pub(in super::super) fn serialize<S: Serializer>(
        sets: &[Shared<OwnSet>],
        serializer: S,
    ) -> Result<S::Ok, S::Error> {
        serializer.collect_seq(sets.iter().map(|set| &**set))
    }

    pub(in super::super) fn deserialize<'de, D: Deserializer<'de>>(from: D) -> Result<Vec<Shared<OwnSet>>, D::Error> {
        Ok(Vec::<OwnSet>::deserialize(from)?.into_iter().map(Shared::new).collect())
    }
}
