//! A spectrum as it was measured.

use crate::units::{bits, hash_by};

/// Reason that samples do not make a spectrum.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[allow(missing_docs, reason = "each variant says in its message what is wrong")]
pub enum DistributionError {
    #[error("a spectrum needs at least one sample")]
    Empty,
    #[error("{wavelengths} wavelengths but {values} values")]
    Lengths { wavelengths: usize, values: usize },
    #[error("sample {index}: wavelength {wavelength} nm is not a positive number above the one before it")]
    Order {
        /// The offending sample, from zero.
        index: usize,
        /// Its wavelength in nanometers.
        wavelength: f64,
    },
    #[error("sample {index}: the value {value} cannot be computed with (limit 1e100)")]
    Value {
        /// The offending sample, from zero.
        index: usize,
        value: f64,
    },
}

/// Samples of a quantity over wavelength: strictly ascending wavelengths in nanometers, finite values.
///
/// ```
/// use chromascope_core::spectral::SpectralDistribution;
/// let s = SpectralDistribution::new(vec![400.0, 500.0], vec![0.2, 0.4])?;
/// assert_eq!(s.range_nm(), [400.0, 500.0]);
/// # Ok::<(), chromascope_core::spectral::DistributionError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct SpectralDistribution {
    wavelengths: Vec<f64>,
    values: Vec<f64>,
}

hash_by!(SpectralDistribution, |of| of.wavelengths.iter().chain(&of.values).map(|&v| bits(v)).collect::<Vec<_>>());

impl SpectralDistribution {
    /// Takes wavelengths in nanometers and values, one for each.
    ///
    /// # Errors
    /// [`DistributionError`] unless there are as many values as wavelengths, at least two, finite and ascending.
    pub fn new(wavelengths: Vec<f64>, values: Vec<f64>) -> Result<Self, DistributionError> {
        if wavelengths.is_empty() {
            return Err(DistributionError::Empty);
        }
        if wavelengths.len() != values.len() {
            return Err(DistributionError::Lengths { wavelengths: wavelengths.len(), values: values.len() });
        }
        let mut before = 0.0;
        for (index, &wavelength) in wavelengths.iter().enumerate() {
            if !(wavelength.is_finite() && wavelength > before) {
                return Err(DistributionError::Order { index, wavelength });
            }
            before = wavelength;
        }
        // The bound keeps every product of three spectra, and sums of them, inside a double's range.
        if let Some((index, &value)) = values.iter().enumerate().find(|(_, v)| !(v.is_finite() && v.abs() <= 1e100)) {
            return Err(DistributionError::Value { index, value });
        }
        // Negative zero equals zero but hashes otherwise.
        let values = values.into_iter().map(|v| v + 0.0).collect();
        Ok(Self { wavelengths, values })
    }

    /// The wavelengths in nanometers, strictly ascending.
    pub fn wavelengths_nm(&self) -> &[f64] {
        &self.wavelengths
    }

    /// The values, one for each wavelength.
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// The first and the last wavelength in nanometers.
    pub fn range_nm(&self) -> [f64; 2] {
        [self.wavelengths[0], self.wavelengths[self.wavelengths.len() - 1]]
    }

    /// The spacing in nanometers if it is the same throughout (to 1e-6 of it), else none.
    pub fn uniform_step_nm(&self) -> Option<f64> {
        let [first, last] = self.range_nm();
        let step = (last - first) / (self.wavelengths.len().checked_sub(1).filter(|&n| n > 0)? as f64);
        let even = self.wavelengths.windows(2).all(|w| (w[1] - w[0] - step).abs() <= 1e-6 * step);
        even.then_some(step)
    }

    /// Spectrum with every value mapped by `f(wavelength, value)`, refused where the result is no spectrum.
    ///
    /// # Errors
    /// [`DistributionError`] where a result is not finite.
    pub fn map(&self, f: impl Fn(f64, f64) -> f64) -> Result<Self, DistributionError> {
        let values = self.wavelengths.iter().zip(&self.values).map(|(&w, &v)| f(w, v)).collect();
        Self::new(self.wavelengths.clone(), values)
    }
}
