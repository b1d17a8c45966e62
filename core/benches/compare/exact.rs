//! The same quantities with compensated sums: what the errors are measured against.

use crate::library::CONSTANTS;
use chromascope_core::camera::{ColorTransform, Rendering};
use chromascope_core::colorimetry::rgb::XYZ_FROM_SRGB;
use chromascope_core::colorimetry::{Xy, Xyz};
use chromascope_core::light::planckian::relative_exitance;
use chromascope_core::patch_set::PatchSet;
use chromascope_core::spectral::grid::COUNT;
use chromascope_core::spectral::{GridSpectrum, Primaries, Sensor};
use chromascope_core::units::Kelvin;
use chromascope_math::least_squares::matrix_keeping;
use glam::{DMat3, DVec3};

/// `Σ terms` with the rounding of every addition kept and added at the end (Neumaier 1974).
fn compensated(terms: impl Iterator<Item = f64>) -> f64 {
    let (mut sum, mut lost) = (0.0_f64, 0.0);
    for term in terms {
        let next = sum + term;
        lost += if sum.abs() >= term.abs() { (sum - next) + term } else { (term - next) + sum };
        sum = next;
    }
    sum + lost
}

/// `∫ C_c S L dλ`.
pub(crate) fn integrals(sensor: &Sensor, light: &[f64; COUNT], reflectance: &[f64; COUNT]) -> DVec3 {
    DVec3::from_array(
        [0, 1, 2].map(|c| compensated((0..COUNT).map(|i| sensor.weighted(c)[i] * light[i] * reflectance[i]))),
    )
}

/// The same, one addition after the other: the baseline.
pub(crate) fn plain(sensor: &Sensor, light: &[f64; COUNT], reflectance: &[f64; COUNT]) -> DVec3 {
    DVec3::from_array([0, 1, 2].map(|c| (0..COUNT).map(|i| sensor.weighted(c)[i] * light[i] * reflectance[i]).sum()))
}

/// Signals to XYZ, made of compensated sums.
pub(crate) struct Exact {
    white: DVec3,
    locus: DVec3,
    matrix: DMat3,
}

impl Exact {
    pub(crate) fn new(sensor: &Sensor, light: &GridSpectrum, transform: ColorTransform<'_>) -> Self {
        let ones = [1.0; COUNT];
        let white = integrals(sensor, light.values(), &ones);
        let flat = integrals(sensor, &ones, &ones);
        match (sensor.primaries(), transform) {
            (Primaries::Xyz, _) => Self { white: DVec3::splat(white.y), locus: DVec3::ONE, matrix: DMat3::IDENTITY },
            (_, ColorTransform::Paper) => Self { white, locus: flat, matrix: XYZ_FROM_SRGB },
            (_, ColorTransform::Observer { reference, training }) => {
                let matrix = fit(sensor, light, white, reference, training);
                Self { white, locus: white, matrix }
            }
        }
    }

    pub(crate) fn patch(&self, sensor: &Sensor, light: &GridSpectrum, reflectance: &[f64; COUNT]) -> Xy {
        chromaticity(self.matrix * (integrals(sensor, light.values(), reflectance) / self.white))
    }

    pub(crate) fn radiator(&self, sensor: &Sensor, temperature: Kelvin) -> Xy {
        let mut spectrum = [0.0; COUNT];
        for (index, value) in spectrum.iter_mut().enumerate() {
            *value = relative_exitance(380.0 + index as f64, 780.0, temperature, CONSTANTS);
        }
        chromaticity(self.matrix * (integrals(sensor, &spectrum, &[1.0; COUNT]) / self.locus))
    }
}

fn fit(sensor: &Sensor, light: &GridSpectrum, white: DVec3, reference: &Sensor, training: &PatchSet) -> DMat3 {
    let seen = integrals(reference, light.values(), &[1.0; COUNT]);
    let all = training.patches().iter().map(|patch| patch.grid.values());
    let (samples, targets): (Vec<_>, Vec<_>) = all
        .map(|s| (integrals(sensor, light.values(), s) / white, integrals(reference, light.values(), s) / seen.y))
        .unzip();
    matrix_keeping(&samples, &targets, DVec3::ONE, seen / seen.y).unwrap()
}

fn chromaticity(xyz: DVec3) -> Xy {
    Xyz::from_vector(xyz).chromaticity().unwrap()
}

/// Where a rendering puts raw integrals of a black body.
pub(crate) fn locus_point(rendering: &Rendering, raw: [f64; 3]) -> Xy {
    rendering.xyz(DVec3::from_array(raw) * rendering.locus_gain).chromaticity().unwrap()
}

/// The largest distance of corresponding points.
pub(crate) fn apart(found: &[Xy], exact: &[Xy]) -> f64 {
    assert_eq!(found.len(), exact.len());
    found.iter().zip(exact).map(|(a, b)| a.distance(*b)).fold(0.0, f64::max)
}
