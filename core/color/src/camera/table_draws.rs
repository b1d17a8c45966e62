//! Tables of a camera drawn from the uncertainty that their file states.

use super::curve_spread::{cubature, nearly_normal};
use super::quality::remove;
use crate::math::dot::dot;
use crate::math::random::SplitMix64;
use crate::spectral::grid::COUNT;
use crate::spectral::stated_uncertainty::Errors;
use crate::spectral::{GridSpectrum, Primaries, Quantity, Response, Sensor, SpectralDistribution, StatedUncertainty};

/// Spectra that responses are drawn with their exact covariance to, at most.
pub const MOST_SPECTRA: usize = 33;
/// Fewest points that an error of few dimensions is drawn at.
const FEWEST: usize = 31;
/// Part of a spectrum below which it lies in the space of others.
const DEPENDENT: f64 = 1e-6;

/// A camera and the uncertainty of its table, both per unit energy.
#[derive(Clone, Debug)]
pub struct TableDraws<'a> {
    sensor: &'a Sensor,
    stated: StatedUncertainty,
    /// Derivatives of the responses to some spectra by the samples, curve after curve.
    kernels: Vec<Vec<f64>>,
}

impl<'a> TableDraws<'a> {
    /// The uncertainty as the file of the camera states it, and spectra, of which the first [`MOST_SPECTRA`] count. None where the
    /// uncertainty is not one of the camera's three curves.
    pub fn new(sensor: &'a Sensor, stated: &StatedUncertainty, spectra: &[Vec<f64>]) -> Option<Self> {
        let curves = sensor.curves();
        let stated = stated.per_energy(sensor)?;
        let spectra = &spectra[..spectra.len().min(MOST_SPECTRA)];
        let lengths = curves.each_ref().map(|curve| curve.values().len());
        let mut kernels = Vec::new();
        for (c, curve) in curves.iter().enumerate() {
            let before = lengths[..c].iter().sum::<usize>();
            let first = kernels.len();
            kernels.extend(spectra.iter().map(|_| vec![0.0; lengths.iter().sum()]));
            for j in 0..lengths[c] {
                let Some(unit) = unit(curve, j) else { continue };
                for (kernel, spectrum) in kernels[first..].iter_mut().zip(spectra) {
                    kernel[before + j] = dot(&unit, spectrum);
                }
            }
        }
        Some(Self { sensor, stated, kernels })
    }

    /// Errors of the table under each correlation that is possible.
    pub fn errors(&self) -> impl Iterator<Item = Errors<'_>> {
        self.stated.errors()
    }

    /// Cameras whose tables have these errors, see [`shifts`]; none for a table that makes no sensor. What depends linearly on responses to
    /// the spectra has exactly its linearized uncertainty.
    pub fn cameras(&self, errors: Errors<'_>) -> impl Iterator<Item = Option<Sensor>> {
        shifts(errors, &self.kernels, 0).map(|shift| self.shifted(&shift))
    }

    fn shifted(&self, shift: &[f64]) -> Option<Sensor> {
        let mut shift = shift.iter();
        let mut curve = |of: &SpectralDistribution| {
            let values = of.values().iter().zip(&mut shift).map(|(value, by)| value + by).collect();
            SpectralDistribution::new(of.wavelengths_nm().to_vec(), values).ok()
        };
        let [red, green, blue] = self.sensor.curves();
        let curves = [curve(red)?, curve(green)?, curve(blue)?];
        Sensor::new(Primaries::Camera, curves, Response::PerEnergy).ok()
    }
}

/// Errors of samples in pairs of opposite sign, at least `pairs` of them where there are many independent ones, the same at each call.
///
/// ```text
/// A z,   z = ±(V q + w − V Vᵀ w),   V an orthonormal basis of Aᵀ kernels, q of exactly unit covariance, w random
/// ```
/// What depends linearly on the errors by the kernels thus has exactly its linearized uncertainty; of few errors all does.
pub fn shifts<'a>(errors: Errors<'a>, kernels: &[Vec<f64>], pairs: usize) -> impl Iterator<Item = Vec<f64>> + use<'a> {
    let dimensions = errors.dimensions();
    let basis = (dimensions > 3 * MOST_SPECTRA).then(|| basis(errors, kernels));
    let exact = basis.as_ref().map_or(dimensions.max(FEWEST), Vec::len);
    let count = if basis.is_some() { exact.max(pairs) } else { exact };
    let mut random = SplitMix64::new(1);
    cubature(exact).into_iter().chain(std::iter::repeat(Vec::new())).take(count).flat_map(move |point| {
        let numbers = basis.as_ref().map(|basis| {
            let free: Vec<f64> = (0..dimensions).map(|_| nearly_normal(&mut random)).collect();
            let mut numbers = remove(&free, basis);
            for (at, axis) in basis.iter().enumerate() {
                // Beyond the exact points errors are random in all directions.
                let along = point.get(at).copied().unwrap_or_else(|| dot(&free, axis));
                numbers.iter_mut().zip(axis).for_each(|(number, part)| *number += along * part);
            }
            numbers
        });
        let shift = errors.of(&numbers.unwrap_or(point));
        let opposite = shift.iter().map(|by| -by).collect();
        [shift, opposite]
    })
}

fn basis(errors: Errors<'_>, kernels: &[Vec<f64>]) -> Vec<Vec<f64>> {
    let mut found: Vec<Vec<f64>> = Vec::new();
    for kernel in kernels.iter().map(|kernel| errors.transposed(kernel)) {
        let rest = remove(&remove(&kernel, &found), &found);
        let [length, left] = [&kernel, &rest].map(|of| dot(of, of).sqrt());
        if left > DEPENDENT * length {
            found.push(rest.iter().map(|v| v / left).collect());
        }
    }
    found
}

/// Change of a curve on the grid by 1 at one sample; none beyond the grid.
fn unit(curve: &SpectralDistribution, sample: usize) -> Option<[f64; COUNT]> {
    let mut values = vec![0.0; curve.values().len()];
    values[sample] = 1.0;
    let unit = SpectralDistribution::new(curve.wavelengths_nm().to_vec(), values).ok()?;
    // Interpolated as a sensitivity is, but not clamped.
    let grid = *GridSpectrum::resample(&unit, Quantity::MatchingFunction).values();
    grid.iter().any(|v| *v != 0.0).then_some(grid)
}

/// Orthonormal spectra that some spectra are nearly combinations of, those that hold most first.
pub fn leading(spectra: &[[f64; COUNT]], most: usize) -> Vec<Vec<f64>> {
    let scaled = |spectrum: &[f64; COUNT]| {
        let length = dot(spectrum, spectrum).sqrt();
        (length > 0.0).then(|| spectrum.iter().map(|v| v / length).collect::<Vec<f64>>())
    };
    let mut rests: Vec<Vec<f64>> = spectra.iter().filter_map(scaled).collect();
    let mut found: Vec<Vec<f64>> = Vec::new();
    while found.len() < most {
        let lengths = rests.iter().map(|rest| dot(rest, rest).sqrt()).enumerate();
        let Some((at, length)) = lengths.max_by(|a, b| a.1.total_cmp(&b.1)).filter(|(_, l)| *l > DEPENDENT) else {
            break;
        };
        let axis: Vec<f64> = rests[at].iter().map(|v| v / length).collect();
        for rest in &mut rests {
            *rest = remove(rest, std::slice::from_ref(&axis));
        }
        found.push(axis);
    }
    found
}
