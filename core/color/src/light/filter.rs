//! Filters in front of a light.

use crate::math::interpolation::linear;
use crate::spectral::grid::{STEP_NM, wavelength_nm};
use crate::spectral::{DistributionError, GridSpectrum, SpectralDistribution};

/// Widest step in nanometers at which a light's own table can carry a filter's edges.
const WIDEST: f64 = 5.0;

/// Transmittance of several filters one behind another, without reflections between them.
///
/// ```text
/// T(λ) = T₁(λ) T₂(λ) …
/// ```
/// Multiplied in an order that depends on the values alone, so that the order of the filters changes no bit.
pub fn transmittance<'a>(filters: impl IntoIterator<Item = &'a GridSpectrum>) -> GridSpectrum {
    let mut filters: Vec<&GridSpectrum> = filters.into_iter().collect();
    let compare = |a: &f64, b: &f64| a.total_cmp(b);
    filters.sort_by(|a, b| {
        let pairs = a.values().iter().zip(b.values());
        pairs.map(|(a, b)| compare(a, b)).find(|order| order.is_ne()).unwrap_or(std::cmp::Ordering::Equal)
    });
    filters.into_iter().fold(GridSpectrum::constant(1.0), |product, filter| product.times(filter))
}

/// A measured light behind filters: at its own wavelengths, or at 1 nm where those are more than 5 nm apart.
///
/// Beyond 380–780 nm the transmittance at the end holds. A transmittance of 1 throughout returns the light unchanged.
///
/// # Errors
/// [`DistributionError`] where a product is beyond the range of a spectrum.
pub fn filtered(
    light: &SpectralDistribution,
    transmittance: &GridSpectrum,
) -> Result<SpectralDistribution, DistributionError> {
    if transmittance.values().iter().all(|&t| t == 1.0) {
        return Ok(light.clone());
    }
    let grid: Vec<f64> = (0..transmittance.values().len()).map(wavelength_nm).collect();
    let at = |nm: f64| linear(&grid, transmittance.values(), nm);
    if light.wavelengths_nm().windows(2).all(|pair| pair[1] - pair[0] <= WIDEST) {
        return light.map(|nm, value| value * at(nm));
    }
    let [first, last] = light.range_nm();
    let steps = ((last - first) / STEP_NM).min(1e5) as usize;
    let mut nm: Vec<f64> = light.wavelengths_nm().to_vec();
    nm.extend((0..=steps).map(|i| first + i as f64 * STEP_NM).filter(|nm| *nm <= last));
    nm.sort_by(f64::total_cmp);
    nm.dedup();
    let values = nm.iter().map(|&x| linear(light.wavelengths_nm(), light.values(), x) * at(x)).collect();
    SpectralDistribution::new(nm, values)
}
