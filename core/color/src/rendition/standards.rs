//! Data of the standards, and sums over their own wavelengths.

use crate::colorimetry::Xyz;
use crate::light::{CctError, DaylightBasis, DaylightError, LocusError};
use crate::math::interpolation::{Sprague, linear};
use crate::patch_set::PatchSet;
use crate::spectral::{Primaries, Sensor, SpectralDistribution};

/// Reason that a light has no index.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[allow(missing_docs, reason = "each variant says in its message what is wrong")]
pub enum RenditionError {
    #[error("the light has no power between {first_nm} and {last_nm} nm")]
    NoPower {
        /// First wavelength of the range in nanometers.
        first_nm: u16,
        /// Last wavelength of the range in nanometers.
        last_nm: u16,
    },
    #[error(
        "four fifths of the luminance lie within 20 nm of {nm} nm, and CIE 13.3 excludes lamps that are mainly monochromatic"
    )]
    Monochromatic {
        /// Peak of the band in nanometers.
        nm: u16,
    },
    #[error("no reference illuminant: {0}")]
    Temperature(#[from] CctError),
    #[error("no reference illuminant: {0}")]
    Daylight(#[from] DaylightError),
    #[error("the observer of the index must be an XYZ observer: {0}")]
    Observer(#[from] LocusError),
    #[error("{found} test samples, but the index is defined for {expected}")]
    Samples { found: usize, expected: usize },
    #[error("test sample {sample} has no color coordinates under this light")]
    Undefined {
        /// The sample, from 1.
        sample: usize,
    },
    #[error("no test sample falls into hue bin {bin} under the reference illuminant")]
    EmptyBin {
        /// The bin, from 1.
        bin: usize,
    },
}

/// Observers, samples and basis that the indices are defined with.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Standards {
    /// CIE 1931 2° observer.
    pub cie_1931: Sensor,
    /// CIE 1964 10° observer.
    pub cie_1964: Sensor,
    /// Daylight by temperature.
    pub daylight: DaylightBasis,
    /// Test color samples 1 to 14 of CIE 13.3.
    pub test_colors: PatchSet,
    /// Color evaluation samples 1 to 99 of CIE 224 and TM-30.
    pub evaluation_colors: PatchSet,
}

/// Wavelengths in nanometers from `first` to `last`, both included.
pub(super) fn wavelengths(first: u16, last: u16, step: u16) -> Vec<f64> {
    (first..=last).step_by(step.into()).map(f64::from).collect()
}

/// A table at other wavelengths, linearly; zero beyond it.
pub(super) fn within(spectrum: &SpectralDistribution, nm: &[f64]) -> Vec<f64> {
    let [first, last] = spectrum.range_nm();
    let inside = |x: f64| (first..=last).contains(&x);
    nm.iter().map(|&x| if inside(x) { linear(spectrum.wavelengths_nm(), spectrum.values(), x) } else { 0.0 }).collect()
}

/// A table at other wavelengths, linearly; its end values beyond it.
pub(super) fn held(spectrum: &SpectralDistribution, nm: &[f64]) -> Vec<f64> {
    nm.iter().map(|&x| linear(spectrum.wavelengths_nm(), spectrum.values(), x)).collect()
}

/// A table at other wavelengths, by Sprague's interpolation where its steps are even and 5 nm or more; its end values beyond it.
pub(super) fn smooth(spectrum: &SpectralDistribution, nm: &[f64]) -> Vec<f64> {
    let step = spectrum.uniform_step_nm().filter(|step| *step >= 5.0);
    let sprague = step.and_then(|step| Sprague::new(spectrum.range_nm()[0], step, spectrum.values()));
    let at = |x: f64| match &sprague {
        Some(sprague) => sprague.at(x),
        None => linear(spectrum.wavelengths_nm(), spectrum.values(), x),
    };
    nm.iter().map(|&x| at(x)).collect()
}

/// Matching functions at some wavelengths, summed without end weights, as the standards have it.
#[derive(Clone, Debug)]
pub(super) struct Sums {
    pub(super) nm: Vec<f64>,
    bars: [Vec<f64>; 3],
}

impl Sums {
    pub(super) fn new(observer: &Sensor, nm: Vec<f64>) -> Result<Self, RenditionError> {
        if observer.primaries() != Primaries::Xyz {
            return Err(LocusError::NotXyz.into());
        }
        let bars = observer.curves().each_ref().map(|curve| within(curve, &nm));
        Ok(Self { nm, bars })
    }

    /// `Σ x̄ S`, `Σ ȳ S`, `Σ z̄ S`.
    pub(super) fn xyz(&self, spectrum: &[f64]) -> Xyz {
        let sum = |bar: &Vec<f64>| bar.iter().zip(spectrum).map(|(a, b)| a * b).sum();
        let [x, y, z] = self.bars.each_ref().map(sum);
        Xyz { x, y, z }
    }

    /// `ȳ S` at each wavelength.
    pub(super) fn luminance(&self, spectrum: &[f64]) -> Vec<f64> {
        self.bars[1].iter().zip(spectrum).map(|(bar, value)| bar * value).collect()
    }

    /// A spectrum scaled to Y = 1, with its tristimulus values.
    pub(super) fn unit(&self, spectrum: &[f64]) -> Result<(Vec<f64>, Xyz), RenditionError> {
        let peak = spectrum.iter().fold(0.0_f64, |peak, v| peak.max(v.abs()));
        let relative: Vec<f64> = spectrum.iter().map(|v| v / peak).collect();
        let seen = self.xyz(&relative);
        // Below this share Y is what is left of cancellation, or the light is all but invisible.
        let visible = seen.y > 1e-9 && seen.to_vector().is_finite();
        if !visible {
            return Err(self.no_power());
        }
        let unit: Vec<f64> = relative.iter().map(|v| v / seen.y).collect();
        Ok((unit, Xyz::new(seen.x / seen.y, 1.0, seen.z / seen.y)))
    }

    fn no_power(&self) -> RenditionError {
        let end = |nm: Option<&f64>| nm.map_or(0, |nm| nm.round() as u16);
        RenditionError::NoPower { first_nm: end(self.nm.first()), last_nm: end(self.nm.last()) }
    }
}
