//! Three sensitivities, ready to integrate: an observer's or a camera's.

use super::dataset::Dataset;
use super::distribution::{DistributionError, SpectralDistribution};
use super::grid::{COUNT, FIRST_NM, GridSpectrum, LAST_NM, Quantity, wavelength_nm};
use crate::math::dot::dot_each;
use crate::units::hash_by;

/// In what the three channels are counted.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Primaries {
    /// A camera's own red, green and blue.
    Camera,
    /// An observer's matching amounts of three real lights, with negative lobes.
    Rgb,
    /// CIE tristimulus values.
    Xyz,
    /// Responses of the long-, medium- and short-wave cones.
    Cones,
}

impl Primaries {
    /// Quantity by which the curves are brought onto the grid.
    pub fn quantity(self) -> Quantity {
        match self {
            Self::Camera => Quantity::CameraSensitivity,
            Self::Rgb | Self::Xyz | Self::Cones => Quantity::MatchingFunction,
        }
    }

    /// Primaries that the column heads of a data file name: `x_bar`, `r_bar` or `l_bar` first for an observer's; a camera's otherwise.
    pub fn from_columns(columns: &[String]) -> Self {
        match columns.first().map(String::as_str) {
            Some("x_bar") => Self::Xyz,
            Some("r_bar") => Self::Rgb,
            Some("l_bar") => Self::Cones,
            _ => Self::Camera,
        }
    }

    /// The names of the three channels.
    pub fn channels(self) -> [&'static str; 3] {
        match self {
            Self::Camera => ["red", "green", "blue"],
            Self::Rgb => ["r\u{304}", "g\u{304}", "b\u{304}"],
            Self::Xyz => ["x\u{304}", "y\u{304}", "z\u{304}"],
            Self::Cones => ["l\u{304}", "m\u{304}", "s\u{304}"],
        }
    }
}

/// Stimulus that sensitivities are a response to. Computation is per energy: `C_energy ∝ λ C_photon`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Response {
    /// Response to equal power at each wavelength.
    PerEnergy,
    /// Response to equal numbers of photons at each wavelength.
    PerPhoton,
    /// The source does not say; taken per energy, and shown as an assumption.
    Unknown,
}

/// Evidence for what a table's sensitivities are a response to.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Evidence {
    /// Stated by the source, or implied by the quantity's definition.
    Stated,
    /// Concluded from how the source or its programs use the table.
    Inferred,
    /// Neither; computed as per energy.
    Unknown,
}

/// Wavelength in nanometers that a table has to reach for loci below [`TAIL_BELOW_K`].
pub const TAIL_NM: f64 = 720.0;

/// Temperature in kelvins below which a table that ends before [`TAIL_NM`] leaves too much of a blackbody's signals unmeasured.
///
/// Cutting the measured Nikon D70 (A.M.P.A.S.) at 700 nm moves its locus (Eq 13) by 0.021 in xy at 1000 K, two thirds of its
/// distance to Stiles & Burch 1955, by 0.005 at 1500 K and by less than 0.001 from 2500 K on.
pub const TAIL_BELOW_K: f64 = 2500.0;

/// Reason that three curves make no sensor.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[allow(missing_docs, reason = "each variant says in its message what is wrong")]
pub enum SensorError {
    #[error("channel {} has no sensitivity between 380 and 780 nm", channel + 1)]
    Blind {
        /// The channel, 0 to 2.
        channel: usize,
    },
    #[error("{found} curves, but a camera needs three: red, green and blue")]
    NotThree { found: usize },
    #[error(transparent)]
    Curve(#[from] DistributionError),
}

/// Three sensitivities per unit energy on the grid, with the trapezoid's weights already in them.
///
/// Channels are integrated over their own support within 380–780 nm, with half weights at its ends: where a table ends, the
/// sensitivity is unknown and counts as zero, it does not fall linearly.
#[derive(Clone, Debug, PartialEq)]
pub struct Sensor {
    primaries: Primaries,
    response: Response,
    curves: [SpectralDistribution; 3],
    weighted: [Box<[f64; COUNT]>; 3],
    integrals: [f64; 3],
}

hash_by!(Sensor, |of| (of.primaries, &of.curves));

impl Sensor {
    /// Takes the three curves as measured, in the order of [`Primaries::channels`].
    ///
    /// # Errors
    /// [`SensorError`] where a channel has no sensitivity on the grid.
    pub fn new(
        primaries: Primaries,
        curves: [SpectralDistribution; 3],
        response: Response,
    ) -> Result<Self, SensorError> {
        let curves = if response == Response::PerPhoton {
            let [a, b, c] = &curves;
            // The scale is free; 550 nm keeps numbers near those of the table.
            [a.map(per_energy)?, b.map(per_energy)?, c.map(per_energy)?]
        } else {
            curves
        };
        let weighted = [0, 1, 2].map(|c| weighted_on_grid(&curves[c], primaries.quantity()));
        let integrals = [0, 1, 2].map(|c: usize| weighted[c].iter().sum());
        match weighted.iter().position(|curve| curve.iter().all(|v| *v == 0.0)) {
            Some(channel) => Err(SensorError::Blind { channel }),
            None => Ok(Self { primaries, response, curves, weighted, integrals }),
        }
    }

    /// Sensor of a data file: primaries from its column heads, response from its header.
    ///
    /// # Errors
    /// [`SensorError::NotThree`] unless the file has three curves; otherwise as [`Sensor::new`].
    pub fn from_dataset(dataset: &Dataset) -> Result<Self, SensorError> {
        let curves = <[SpectralDistribution; 3]>::try_from(dataset.curves.clone());
        let curves = curves.map_err(|curves| SensorError::NotThree { found: curves.len() })?;
        Self::new(Primaries::from_columns(&dataset.header.columns), curves, dataset.header.response())
    }

    /// In what the channels are counted.
    pub fn primaries(&self) -> Primaries {
        self.primaries
    }

    /// Response that the source's figures were given for.
    pub fn response(&self) -> Response {
        self.response
    }

    /// The three curves per energy, at their own wavelengths.
    pub fn curves(&self) -> &[SpectralDistribution; 3] {
        &self.curves
    }

    /// `C_c(λ)` times the quadrature weight, on the grid: sums of products with it are integrals in nanometers.
    pub fn weighted(&self, channel: usize) -> &[f64; COUNT] {
        &self.weighted[channel]
    }

    /// `∫ C_c dλ` for each channel, in nanometers.
    pub fn integrals(&self) -> [f64; 3] {
        self.integrals
    }

    /// `∫ C_c f dλ` for each channel, with f on the grid.
    pub fn integrate(&self, spectrum: &[f64; COUNT]) -> [f64; 3] {
        let [a, b, c] = &self.weighted;
        dot_each([a, b, c], spectrum)
    }

    /// `C_c(λ)` at a grid sample, without quadrature weight at the ends of the support.
    pub fn at_index(&self, index: usize) -> [f64; 3] {
        [0, 1, 2].map(|c: usize| self.weighted[c][index] / weight(support(&self.curves[c]), index))
    }

    /// The same of one channel at all grid samples.
    pub fn on_grid(&self, channel: usize) -> Vec<f64> {
        let support = support(&self.curves[channel]);
        let weighted = self.weighted[channel].iter().enumerate();
        weighted.map(|(index, value)| value / weight(support, index)).collect()
    }

    /// Temperature in kelvins below which blackbodies through this sensor are extrapolated: their signals depend on a red tail that
    /// the table does not hold. None for a table that reaches [`TAIL_NM`].
    pub fn extrapolated_below_k(&self) -> Option<f64> {
        (self.support_nm()[1] < TAIL_NM).then_some(TAIL_BELOW_K)
    }

    /// The wavelengths in nanometers that all three channels were measured over, within the grid.
    pub fn support_nm(&self) -> [f64; 2] {
        let ranges = [0, 1, 2].map(|c: usize| support(&self.curves[c]));
        [ranges.iter().map(|r| r[0]).fold(FIRST_NM, f64::max), ranges.iter().map(|r| r[1]).fold(LAST_NM, f64::min)]
    }
}

/// From a response per photon to one per energy.
pub(super) fn per_energy(wavelength_nm: f64, value: f64) -> f64 {
    value * wavelength_nm / 550.0
}

/// The grid wavelengths that a curve covers: its first and last.
fn support(curve: &SpectralDistribution) -> [f64; 2] {
    let [first, last] = curve.range_nm();
    [first.max(FIRST_NM).ceil(), last.min(LAST_NM).floor()]
}

/// A curve on the grid times the trapezoid's weights over its support.
fn weighted_on_grid(curve: &SpectralDistribution, quantity: Quantity) -> Box<[f64; COUNT]> {
    let support = support(curve);
    let mut values = Box::new(*GridSpectrum::resample(curve, quantity).values());
    values.iter_mut().enumerate().for_each(|(index, value)| *value *= weight(support, index));
    values
}

/// The trapezoid's weight of a grid sample.
fn weight([first, last]: [f64; 2], index: usize) -> f64 {
    let x = wavelength_nm(index);
    if first < last && (x == first || x == last) { 0.5 } else { 1.0 }
}
