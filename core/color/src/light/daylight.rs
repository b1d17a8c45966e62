//! CIE daylight of any correlated color temperature.

use crate::colorimetry::Xy;
use crate::spectral::{Dataset, SpectralDistribution};
use crate::units::Kelvin;

/// Reason that there is no daylight of a temperature.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[allow(missing_docs, reason = "each variant says in its message what is wrong")]
pub enum DaylightError {
    /// The CIE formula holds from 4000 to 25000 K.
    #[error("CIE daylight is defined from 4000 to 25000 K, not at {0}")]
    Temperature(Kelvin),
    #[error("the daylight basis needs the three curves S0, S1 and S2")]
    Basis,
}

/// The mean and the first two characteristic vectors of measured daylight (CIE 15).
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct DaylightBasis {
    curves: [SpectralDistribution; 3],
}

impl DaylightBasis {
    /// Takes the data set with the columns S0, S1 and S2.
    ///
    /// # Errors
    /// [`DaylightError`] unless the data set holds the three functions S0, S1 and S2.
    pub fn new(dataset: &Dataset) -> Result<Self, DaylightError> {
        let curves: [SpectralDistribution; 3] = dataset.curves.clone().try_into().map_err(|_| DaylightError::Basis)?;
        Ok(Self { curves })
    }

    /// The relative spectral power of daylight (CIE 15:2004, 3.1).
    ///
    /// # Errors
    /// [`DaylightError`] outside 4000 K to 25 000 K.
    ///
    /// ```text
    /// S(λ) = S₀(λ) + M₁ S₁(λ) + M₂ S₂(λ)
    /// M₁ = (−1.3515 − 1.7703 x + 5.9114 y) / (0.0241 + 0.2562 x − 0.7341 y)
    /// M₂ = ( 0.0300 − 31.4424 x + 30.0717 y) / (0.0241 + 0.2562 x − 0.7341 y)
    /// ```
    /// M₁ and M₂ are not rounded to three decimals as they were for the tables of D50, D55, D65 and D75; and those tables
    /// belong to temperatures 1.4388/1.4380 higher than their names (D55: 5503 K). 1 at 560 nm is 100.
    pub fn light(&self, temperature: Kelvin) -> Result<SpectralDistribution, DaylightError> {
        self.sum(temperature, |m| m)
    }

    /// [`Self::light`] with M₁ and M₂ rounded to three decimals, as in the tables of the CIE and in references of rendition indices.
    ///
    /// # Errors
    /// As [`Self::light`].
    pub fn rounded(&self, temperature: Kelvin) -> Result<SpectralDistribution, DaylightError> {
        self.sum(temperature, |m| (m * 1e3).round() / 1e3)
    }

    fn sum(&self, temperature: Kelvin, finish: fn(f64) -> f64) -> Result<SpectralDistribution, DaylightError> {
        let Xy { x, y } = chromaticity(temperature)?;
        let divisor = 0.0241 + 0.2562 * x - 0.7341 * y;
        let m1 = finish((-1.3515 - 1.7703 * x + 5.9114 * y) / divisor);
        let m2 = finish((0.0300 - 31.4424 * x + 30.0717 * y) / divisor);
        let [s0, s1, s2] = &self.curves;
        let values = (s0.values().iter().zip(s1.values()).zip(s2.values())).map(|((a, b), c)| a + m1 * b + m2 * c);
        SpectralDistribution::new(s0.wavelengths_nm().to_vec(), values.collect()).map_err(|_| DaylightError::Basis)
    }
}

/// The chromaticity of daylight of a correlated color temperature (CIE 15:2004, 3.1), from 4000 to 25000 K.
///
/// # Errors
/// [`DaylightError`] outside 4000 K to 25 000 K.
///
/// ```text
/// x = −4.6070e9/T³ + 2.9678e6/T² + 0.09911e3/T + 0.244063    4000 K ≤ T ≤ 7000 K
/// x = −2.0064e9/T³ + 1.9018e6/T² + 0.24748e3/T + 0.237040    7000 K < T ≤ 25000 K
/// y = −3.000 x² + 2.870 x − 0.275
/// ```
pub fn chromaticity(temperature: Kelvin) -> Result<Xy, DaylightError> {
    let t = temperature.get();
    if !(4000.0..=25000.0).contains(&t) {
        return Err(DaylightError::Temperature(temperature));
    }
    let [a, b, c, d] = if t <= 7000.0 {
        [-4.6070e9, 2.9678e6, 0.09911e3, 0.244_063]
    } else {
        [-2.0064e9, 1.9018e6, 0.24748e3, 0.237_040]
    };
    let r = 1.0 / t;
    let x = ((a * r + b) * r + c) * r + d;
    Ok(Xy { x, y: (-3.0 * x + 2.870) * x - 0.275 })
}
