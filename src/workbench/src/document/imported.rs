//! The user's own sets, by value: figures as read, with the decisions that can be flipped.

use std::hash::{Hash, Hasher};
use std::path::PathBuf;

use chromascope_core::query::Shared;
use chromascope_core::spectral::{DistributionError, Response, SpectralDistribution};
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value};
pub use spectral_file::{Covariance, ReadOptions, Role, Uncertainty, WavelengthUnit};

/// One curve, as it was read: in the units that [`ImportedSet::read_as`] says.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ImportedCurve {
    pub name: String,
    /// Wavelengths, ascending, in nanometers if the unit was decided right.
    #[serde(deserialize_with = "numbers")]
    pub wavelengths: Vec<f64>,
    /// Values; percent already divided if that was decided.
    #[serde(deserialize_with = "numbers")]
    pub values: Vec<f64>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub unit: Option<String>,
    /// Uncertainty of the values, where the file states it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub uncertainty: Option<Uncertainty>,
    /// Fields that this version does not know, kept as they are.
    #[serde(flatten)]
    pub unknown: Map<String, Value>,
}

/// Numbers as JSON has them, where NaN and infinities are written as null: one of them must not cost the document.
fn numbers<'de, D: serde::Deserializer<'de>>(from: D) -> Result<Vec<f64>, D::Error> {
    let numbers = Vec::<Option<f64>>::deserialize(from)?;
    Ok(numbers.into_iter().map(|number| number.unwrap_or(f64::NAN)).collect())
}

/// The user's overrides for reading a file. What is open is decided by its content.
#[derive(Clone, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(default)]
pub struct ImportOverrides {
    pub options: ReadOptions,
    /// Indices of the file's curves to import, from 0.
    pub taken: Option<Vec<usize>>,
    /// For a camera: which of the file's curves are red, green and blue.
    pub channels: Option<[usize; 3]>,
    /// For a camera: whether it counts photons, not energy.
    pub per_photon: Option<bool>,
}

impl ImportOverrides {
    /// Leaves all but the role to the content.
    pub fn for_role(role: Option<Role>) -> Self {
        Self { options: ReadOptions { role, ..ReadOptions::default() }, ..Self::default() }
    }
}

/// Units of the file as interpreted, before conversion.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub struct ReadAs {
    pub unit: WavelengthUnit,
    pub percent: bool,
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ImportedSet {
    /// Its name, unique among sets of its kind.
    pub name: String,
    /// The file it came from, or `clipboard`.
    pub file: String,
    #[serde(default, skip_serializing_if = "Option::is_none", with = "super::paths::option")]
    pub path: Option<PathBuf>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub fingerprint: Option<Fingerprint>,
    /// [`Measurement::origin`](super::measurement::Measurement::origin) of a camera that was recovered from pictures here.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub measured: Option<Fingerprint>,
    /// Model of the camera as raw files state it, where that is known.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub model: Option<String>,
    #[serde(default, rename = "wishes")]
    pub overrides: ImportOverrides,
    pub role: Role,
    /// The units that the curves were converted from on reading.
    pub read_as: ReadAs,
    /// The unit of the wavelengths in the file, as the user has it.
    pub unit: WavelengthUnit,
    /// True if the file's values are percent, as the user has it.
    pub percent: bool,
    #[serde(default)]
    pub per_photon: bool,
    /// For a camera: which curves are red, green and blue.
    #[serde(default = "first_three")]
    pub channels: [usize; 3],
    pub curves: Vec<ImportedCurve>,
    /// Covariance of their samples, curve after curve, where a file beside states it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub covariance: Option<Covariance>,
    /// Decisions made on reading, one line each, for display.
    #[serde(default)]
    pub decisions: Vec<String>,
}

fn first_three() -> [usize; 3] {
    [0, 1, 2]
}

/// A number that two contents of a file share only by a chance of 1 in 10^19; the same on every machine.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(transparent)]
pub struct Fingerprint(u64);

impl Fingerprint {
    pub fn of(bytes: &[u8]) -> Self {
        const OFFSET: u64 = 0xCBF2_9CE4_8422_2325;
        const PRIME: u64 = 0x0100_0000_01B3;
        Self(bytes.iter().fold(OFFSET, |hash, &byte| (hash ^ u64::from(byte)).wrapping_mul(PRIME)))
    }
}

/// True if two lists of sets differ at most in the folders of their files.
pub(super) fn same_but_folders(a: &[Shared<ImportedSet>], b: &[Shared<ImportedSet>]) -> bool {
    a.len() == b.len() && a.iter().zip(b).all(|(a, b)| a == b || a.is_same_but_folder(b))
}

/// A session's file as it was last read or written by this window.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct SessionFile {
    #[serde(with = "super::paths")]
    pub path: PathBuf,
    /// Fingerprint of its contents; other contents were written by another program.
    pub fingerprint: Fingerprint,
}

impl Eq for ImportedSet {}

impl Hash for ImportedSet {
    fn hash<H: Hasher>(&self, state: &mut H) {
        (&self.name, &self.file, self.role, self.read_as, self.unit, self.percent, self.per_photon, self.channels)
            .hash(state);
        self.overrides.hash(state);
        for curve in &self.curves {
            curve.name.hash(state);
            curve.wavelengths.iter().chain(&curve.values).for_each(|v| v.to_bits().hash(state));
            curve.uncertainty.iter().flat_map(|of| &of.standard).for_each(|v| v.to_bits().hash(state));
        }
        self.covariance.iter().flat_map(|of| &of.values).for_each(|v| v.to_bits().hash(state));
    }
}

impl ImportedSet {
    /// The curves that its role uses, in nanometers and, for reflectances, as fractions.
    pub fn curves_in_nm(&self) -> Result<Vec<(String, SpectralDistribution)>, DistributionError> {
        self.used()
            .into_iter()
            .map(|index| &self.curves[index])
            .map(|curve| Ok((curve.name.clone(), self.spectrum(curve)?)))
            .collect()
    }

    /// Standard uncertainties of the values of [`Self::curves_in_nm`], in their units; `None` for a curve whose file states none.
    pub fn uncertainties_in_nm(&self) -> Vec<Option<Vec<f64>>> {
        let of = |index: usize| {
            let curve = &self.curves[index];
            let stated = curve.uncertainty.as_ref().filter(|of| of.standard.len() == curve.values.len())?;
            let mut standard = self.scaled(&stated.standard);
            if self.is_reversed(curve) {
                standard.reverse();
            }
            Some(standard)
        };
        self.used().into_iter().map(of).collect()
    }

    /// Covariance of the samples of [`Self::curves_in_nm`], curve after curve, in products of their units.
    pub fn covariance_in_nm(&self) -> Option<Covariance> {
        let covariance = self.covariance.as_ref()?;
        let mut samples = Vec::with_capacity(covariance.size);
        for index in self.used() {
            let from = self.curves[..index].iter().map(|curve| curve.values.len()).sum::<usize>();
            let own = from..from + self.curves[index].values.len();
            if self.is_reversed(&self.curves[index]) { samples.extend(own.rev()) } else { samples.extend(own) }
        }
        let among = covariance.among(&samples)?;
        Some(Covariance { values: self.scaled(&self.scaled(&among.values)), ..among })
    }

    /// Indices of the curves that its role uses.
    fn used(&self) -> Vec<usize> {
        let all = 0..self.curves.len();
        match self.role {
            Role::Camera => self.channels.into_iter().filter(|index| all.contains(index)).collect(),
            _ => all.collect(),
        }
    }

    /// All but the curves, which may be millions of numbers.
    #[must_use]
    pub fn without_curves(&self) -> Self {
        Self {
            name: self.name.clone(),
            file: self.file.clone(),
            path: self.path.clone(),
            fingerprint: self.fingerprint,
            measured: self.measured,
            model: self.model.clone(),
            overrides: self.overrides.clone(),
            role: self.role,
            read_as: self.read_as,
            unit: self.unit,
            percent: self.percent,
            per_photon: self.per_photon,
            channels: self.channels,
            curves: Vec::new(),
            covariance: None,
            decisions: self.decisions.clone(),
        }
    }

    /// True if another set differs at most in the folder of its file.
    fn is_same_but_folder(&self, other: &Self) -> bool {
        let head = |set: &Self| Self { path: None, ..set.without_curves() };
        head(self) == head(other) && self.curves == other.curves && self.covariance == other.covariance
    }

    pub fn response(&self) -> Response {
        if self.per_photon { Response::PerPhoton } else { Response::PerEnergy }
    }

    /// A curve with the units that the user has it in. Unchanged units change no bit.
    fn spectrum(&self, curve: &ImportedCurve) -> Result<SpectralDistribution, DistributionError> {
        let mut values = self.scaled(&curve.values);
        let mut wavelengths: Vec<f64> = curve.wavelengths.iter().map(|nm| self.nanometers(*nm)).collect();
        if self.is_reversed(curve) {
            wavelengths.reverse();
            values.reverse();
        }
        SpectralDistribution::new(wavelengths, values)
    }

    /// Numbers of the curves, on the scale that the user has them on.
    fn scaled(&self, numbers: &[f64]) -> Vec<f64> {
        match (self.percent, self.read_as.percent) {
            (true, false) => numbers.iter().map(|v| v / 100.0).collect(),
            (false, true) => numbers.iter().map(|v| v * 100.0).collect(),
            _ => numbers.to_vec(),
        }
    }

    fn nanometers(&self, nm: f64) -> f64 {
        if self.unit == self.read_as.unit { nm } else { self.unit.nanometers(self.read_as.unit.from_nanometers(nm)) }
    }

    /// True if the wavelengths of a curve come in the opposite order in the user's unit: wave numbers and frequencies.
    fn is_reversed(&self, curve: &ImportedCurve) -> bool {
        let end = |nm: Option<&f64>| nm.map(|nm| self.nanometers(*nm));
        self.unit != self.read_as.unit && end(curve.wavelengths.first()) > end(curve.wavelengths.last())
    }
}

pub(super) mod list {
    use super::{ImportedSet, Shared};
    use serde::{Deserialize, Deserializer, Serializer};

    pub(in super::super) fn serialize<S: Serializer>(
        sets: &[Shared<ImportedSet>],
        serializer: S,
    ) -> Result<S::Ok, S::Error> {
        serializer.collect_seq(sets.iter().map(|set| &**set))
    }

    pub(in super::super) fn deserialize<'de, D: Deserializer<'de>>(
        from: D,
    ) -> Result<Vec<Shared<ImportedSet>>, D::Error> {
        Ok(Vec::<ImportedSet>::deserialize(from)?.into_iter().map(Shared::new).collect())
    }
}
