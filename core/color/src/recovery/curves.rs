//! Recovered curves with their covariance.

use crate::math::dense::Matrix;
use crate::spectral::{Primaries, Response, Sensor, SensorError, SpectralDistribution};

/// Three curves at the same wavelengths with the covariance of all samples, red first.
#[derive(Clone, Debug, PartialEq)]
pub struct RecoveredCurves {
    /// Wavelengths in nanometers.
    pub wavelengths_nm: Vec<f64>,
    /// Red, green and blue per unit energy, the largest value 1.
    pub values: [Vec<f64>; 3],
    /// Covariance of all samples, curve after curve, by rows. The scale of each channel is held.
    pub covariance: Matrix,
    /// Share of each sample that is from the data, 0 to 1: one less the ratio of posterior to prior variance.
    pub data_share: [Vec<f64>; 3],
}

impl RecoveredCurves {
    /// Curves of a scaled channel each, brought to a largest value of 1.
    pub(super) fn new(
        nm: &[f64],
        curves: &[Vec<f64>; 3],
        covariance: &[f64],
        scales: [f64; 3],
        share: [Vec<f64>; 3],
    ) -> Self {
        let peak = curves.iter().zip(scales).flat_map(|(curve, by)| curve.iter().map(move |v| v * by));
        let peak = peak.fold(f64::MIN_POSITIVE, f64::max);
        let by = scales.map(|scale| scale / peak);
        let (count, size) = (nm.len(), 3 * nm.len());
        let scaled = |(at, value): (usize, &f64)| value * by[at / size / count] * by[at % size / count];
        Self {
            wavelengths_nm: nm.to_vec(),
            values: [0, 1, 2].map(|c: usize| curves[c].iter().map(|v| v * by[c]).collect()),
            covariance: covariance.iter().enumerate().map(scaled).collect(),
            data_share: share,
        }
    }

    /// Standard uncertainty of each sample.
    pub fn standard(&self) -> [Vec<f64>; 3] {
        let (count, size) = (self.wavelengths_nm.len(), 3 * self.wavelengths_nm.len());
        let of = |c: usize| (0..count).map(|i| self.covariance[(c * count + i) * (size + 1)].max(0.0).sqrt()).collect();
        [0, 1, 2].map(of)
    }

    /// The curves as a camera.
    ///
    /// # Errors
    /// [`SensorError`] where a channel is blind.
    pub fn sensor(&self) -> Result<Sensor, SensorError> {
        let curve = |values: &Vec<f64>| SpectralDistribution::new(self.wavelengths_nm.clone(), values.clone());
        let [r, g, b] = self.values.each_ref().map(curve);
        Sensor::new(Primaries::Camera, [r?, g?, b?], Response::PerEnergy)
    }
}
