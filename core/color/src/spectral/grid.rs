//! The grid everything is integrated on, and how a measured spectrum gets there.
//!
//! Convention: 380–780 nm at 1 nm, trapezoid, in the range that the sensitivities cover. Uniform tables of smooth
//! quantities with steps of 5 nm or more by Sprague's interpolation (CIE 167:2005), all else and every light linearly
//! (which is the definition of the daylight illuminants). See `Quantity` for what holds beyond the data.

use crate::math::interpolation::{Sprague, linear};
use crate::spectral::distribution::SpectralDistribution;
use crate::units::{bits, hash_by};

/// The first wavelength of the grid, in nanometers.
pub const FIRST_NM: f64 = 380.0;
/// The last wavelength of the grid, in nanometers.
pub const LAST_NM: f64 = 780.0;
/// The spacing of the grid, in nanometers.
pub const STEP_NM: f64 = 1.0;
/// Number of wavelengths of the grid.
pub const COUNT: usize = 401;

/// The wavelength of grid sample `index`, in nanometers.
#[inline]
pub fn wavelength_nm(index: usize) -> f64 {
    FIRST_NM + index as f64 * STEP_NM
}

/// Quantity of a spectrum; it decides how the table is interpolated and what holds beyond it.
///
/// | quantity | steps ≥ 5 nm | negatives after interpolation | beyond the table |
/// |---|---|---|---|
/// | light | linear | kept as measured | end value held, marked |
/// | reflectance | Sprague | set to zero | end value held, marked |
/// | camera sensitivity | Sprague | set to zero | zero |
/// | color matching function | Sprague | kept | zero |
///
/// Matching functions keep their negative lobes: clamping them moves a Planckian locus by 0.008 in xy.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Quantity {
    /// Spectral power of a light, in any unit.
    Light,
    /// A reflectance factor or transmittance.
    Reflectance,
    /// A camera channel's sensitivity.
    CameraSensitivity,
    /// A color matching function or cone fundamental.
    MatchingFunction,
}

impl Quantity {
    fn clamps(self) -> bool {
        matches!(self, Self::Reflectance | Self::CameraSensitivity)
    }

    fn ends_in_zero(self) -> bool {
        matches!(self, Self::CameraSensitivity | Self::MatchingFunction)
    }
}

/// Interpolation that brings a table to the steps of the grid.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Interpolation {
    /// None: the table has a sample at each wavelength of the grid that it covers.
    None,
    /// Sprague's fifth-degree polynomial (CIE 167:2005).
    Sprague,
    /// Linear between neighboring samples.
    Linear,
}

impl Interpolation {
    /// The interpolation of a table by the convention of its quantity.
    pub fn of(spectrum: &SpectralDistribution, quantity: Quantity) -> Self {
        let first = spectrum.range_nm()[0];
        match spectrum.uniform_step_nm() {
            Some(step) if (step - STEP_NM).abs() < 1e-9 && first.fract() == 0.0 => Self::None,
            Some(_) if sprague(spectrum, quantity).is_some() => Self::Sprague,
            _ => Self::Linear,
        }
    }
}

/// Sprague's interpolation of a table that the convention gives it to.
fn sprague(spectrum: &SpectralDistribution, quantity: Quantity) -> Option<Sprague> {
    let step = spectrum.uniform_step_nm().filter(|&step| step >= 5.0 && quantity != Quantity::Light)?;
    Sprague::new(spectrum.range_nm()[0], step, spectrum.values())
}

/// Ranges of the grid that were not measured: end values hold there (sensitivities: zero).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Assumed {
    /// The first measured wavelength in nanometers, if the grid begins before it.
    pub below_nm: Option<f64>,
    /// The last measured wavelength in nanometers, if the grid goes on beyond it.
    pub above_nm: Option<f64>,
}

impl Assumed {
    /// True if the whole grid was measured.
    pub fn nothing(self) -> bool {
        self.below_nm.is_none() && self.above_nm.is_none()
    }
}

/// A spectrum on the standard grid.
#[derive(Clone, Debug, PartialEq)]
pub struct GridSpectrum {
    values: Box<[f64; COUNT]>,
    assumed: Assumed,
}

hash_by!(GridSpectrum, |of| of.values.map(bits));

impl GridSpectrum {
    /// Brings a measured spectrum onto the grid by the convention of its quantity.
    ///
    /// Error against a 1 nm table for smooth spectra: below 5e-7 of an integral at 5 nm, 2e-4 at 10 nm.
    pub fn resample(spectrum: &SpectralDistribution, quantity: Quantity) -> Self {
        let [first, last] = spectrum.range_nm();
        let smooth = sprague(spectrum, quantity);
        let (mut values, mut cell) = (Box::new([0.0; COUNT]), (usize::MAX, [0.0; 5]));
        for (index, value) in values.iter_mut().enumerate() {
            let x = wavelength_nm(index);
            if quantity.ends_in_zero() && !(first..=last).contains(&x) {
                continue;
            }
            let y = match &smooth {
                Some(sprague) => sprague.at_next(x, &mut cell),
                None => linear(spectrum.wavelengths_nm(), spectrum.values(), x),
            };
            *value = if quantity.clamps() { y.max(0.0) } else { y };
        }
        let assumed =
            Assumed { below_nm: (first > FIRST_NM).then_some(first), above_nm: (last < LAST_NM).then_some(last) };
        Self { values, assumed }
    }

    /// The spectrum that has this value everywhere: equal energy, or a perfect white.
    pub fn constant(value: f64) -> Self {
        Self::from_fn(|_| value)
    }

    /// A spectrum given by a formula of the wavelength in nanometers; values that are not finite become zero.
    pub fn from_fn(mut f: impl FnMut(f64) -> f64) -> Self {
        let mut values = Box::new([0.0; COUNT]);
        for (index, value) in values.iter_mut().enumerate() {
            let y = f(wavelength_nm(index));
            // Negative zero equals zero but hashes otherwise.
            *value = if y.is_finite() { y + 0.0 } else { 0.0 };
        }
        Self { values, assumed: Assumed::default() }
    }

    /// The product with another spectrum, such as a light behind a filter; values that overflow become zero. What was assumed of either
    /// stays assumed.
    #[must_use]
    pub fn times(&self, other: &Self) -> Self {
        let mut product = Self::from_fn(|_| 0.0);
        let factors = self.values.iter().zip(other.values.iter());
        for (value, (a, b)) in product.values.iter_mut().zip(factors) {
            let y = a * b;
            *value = if y.is_finite() { y + 0.0 } else { 0.0 };
        }
        let wider = |a: Option<f64>, b: Option<f64>, of: fn(f64, f64) -> f64| match (a, b) {
            (Some(a), Some(b)) => Some(of(a, b)),
            (a, b) => a.or(b),
        };
        product.assumed = Assumed {
            below_nm: wider(self.assumed.below_nm, other.assumed.below_nm, f64::max),
            above_nm: wider(self.assumed.above_nm, other.assumed.above_nm, f64::min),
        };
        product
    }

    /// The values at 380, 381, …, 780 nm.
    pub fn values(&self) -> &[f64; COUNT] {
        &self.values
    }

    /// Ranges in which values were assumed, not measured.
    pub fn assumed(&self) -> Assumed {
        self.assumed
    }
}
