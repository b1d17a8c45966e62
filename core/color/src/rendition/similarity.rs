//! Spectral similarity index of SMPTE ST 2122.

use super::reference;
use super::standards::{RenditionError, Standards, wavelengths, within};
use crate::spectral::SpectralDistribution;
use crate::units::Kelvin;

/// Number of bands, 10 nm wide, from 375 to 675 nm.
const BANDS: usize = 30;

/// Spectral similarity index of a light to a reference light, unrounded; published values are rounded to whole numbers.
///
/// ```text
/// SSI = 100 − 32 √Σ (w ∗ g)²,   g = (t − r) / (r + 1/30),   w = (0.22, 0.56, 0.22)
/// ```
/// t and r are the shares of the light and of the reference in 30 bands of 10 nm from 375 to 675 nm; the bands at both ends count less.
/// 100 for proportional spectra; below 0 for lights of a few lines. Not symmetric.
///
/// Source: SMPTE ST 2122:2020; Academy of Motion Picture Arts and Sciences, *Academy Spectral Similarity Index (SSI): Overview*, 2020.
///
/// # Errors
/// [`RenditionError::NoPower`] where one of the two has no power in the range.
pub fn spectral_similarity(
    light: &SpectralDistribution,
    reference: &SpectralDistribution,
) -> Result<f64, RenditionError> {
    let (light, reference) = (shares(light)?, shares(reference)?);
    let mut weighted = [0.0; BANDS + 2];
    for (index, (t, r)) in light.iter().zip(&reference).enumerate() {
        weighted[index + 1] = weight(index) * (t - r) / (r + 1.0 / 30.0);
    }
    let smooth = |three: &[f64]| 0.22 * three[0] + 0.56 * three[1] + 0.22 * three[2];
    let sum: f64 = weighted.windows(3).map(|three| smooth(three).powi(2)).sum();
    let index = 100.0 - 32.0 * sum.sqrt();
    if index.is_finite() { Ok(index) } else { Err(NO_POWER) }
}

/// Light that a light of a temperature is compared with: a blackbody below 4000 K, CIE daylight from there on.
///
/// # Errors
/// [`RenditionError::Daylight`] above 25 000 K.
pub fn similarity_reference(
    temperature: Kelvin,
    standards: &Standards,
) -> Result<SpectralDistribution, RenditionError> {
    let nm = wavelengths(375, 675, 1);
    let values = if temperature.get() < 4000.0 {
        reference::blackbody(temperature, &nm)
    } else {
        reference::daylight(&standards.daylight, temperature, &nm)?
    };
    SpectralDistribution::new(nm, values).map_err(|_| NO_POWER)
}

const NO_POWER: RenditionError = RenditionError::NoPower { first_nm: 375, last_nm: 675 };

fn weight(band: usize) -> f64 {
    const FIRST: [f64; 5] = [12.0, 22.0, 32.0, 40.0, 44.0];
    match band {
        0..5 => FIRST[band] / 45.0,
        28 => 11.0 / 15.0,
        29 => 3.0 / 15.0,
        _ => 1.0,
    }
}

/// Shares of the bands, by the trapezoid over each at 1 nm.
fn shares(light: &SpectralDistribution) -> Result<[f64; BANDS], RenditionError> {
    let values = within(light, &wavelengths(375, 675, 1));
    let peak = values.iter().fold(0.0_f64, |peak, v| peak.max(v.abs()));
    let band = |index: usize| {
        let band = &values[10 * index..=10 * index + 10];
        (band.iter().sum::<f64>() - f64::midpoint(band[0], band[10])) / peak
    };
    let powers: [f64; BANDS] = std::array::from_fn(band);
    let sum: f64 = powers.iter().sum();
    if sum > 1e-9 && sum.is_finite() { Ok(powers.map(|power| power / sum)) } else { Err(NO_POWER) }
}
