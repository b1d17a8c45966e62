//! Spectral images through cameras: each pixel's samples times one weight per band and channel.
//!
//! ```text
//! ∫ C_c S L dλ ≈ Σ_k w_ck s_k        w_ck = Σ_i C_c(λ_i) L(λ_i) B_k(λ_i) / ∫ C_c W dλ
//! ```
//! `s_k` = sample of band k, `B_k` = what the interpolation onto the grid makes of a 1 in band k and 0 elsewhere. Interpolation is
//! linear in the samples, so the weights are made once, and a pixel costs three products a band and camera.

use super::geometry::LitSamples;
use super::visibility::{MAX_SIDE, RasterSize};
use chromascope_color::camera::batch::Batch;
use chromascope_color::camera::rendering::under_light;
use chromascope_color::spectral::grid::{COUNT, wavelength_nm};
use chromascope_color::spectral::{DistributionError, GridSpectrum, Quantity, Sensor, SpectralDistribution};
use glam::DVec3;
use std::sync::Arc;

/// Quantity of the samples.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum SampleQuantity {
    /// Reflectance, lit by the light: interpolated as reflectances are, end values held.
    Reflectance,
    /// Radiance, integrated as it is: interpolated linearly, end values held.
    Radiance,
}

/// Reason that an image cannot be put through cameras.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[allow(missing_docs, reason = "each variant says in its message what is wrong")]
pub enum SpectralImageError {
    #[error(transparent)]
    Wavelengths(#[from] DistributionError),
    #[error("the bands cover {first} to {last} nm, none of 380 to 780 nm")]
    NotVisible { first: f64, last: f64 },
    #[error("the light or the sensitivities are too large for an image")]
    NotFinite,
    #[error("{width} x {height} pixels; at most {MAX_SIDE} a side")]
    Size { width: usize, height: usize },
}

/// A camera or observer: its sensitivities, and the divisors of its integrals ([`chromascope_color::camera::Rendering::white_integrals`]).
#[derive(Clone, Copy, Debug)]
pub struct ImageSensor<'a> {
    /// Sensitivities.
    pub sensor: &'a Sensor,
    /// Divisors of `∫ C_c S L dλ`.
    pub divisors: DVec3,
}

/// Weights of all bands for all sensors.
#[derive(Clone, Debug)]
pub struct BandWeights {
    batch: Batch<f32>,
    bands: usize,
}

impl BandWeights {
    /// Weights for bands at ascending wavelengths in nanometers, under a light.
    ///
    /// Samples finer than the grid's 1 nm are not averaged: bands between its wavelengths count by interpolation.
    ///
    /// # Errors
    /// [`SpectralImageError`] where the bands are none, or lie outside the grid.
    pub fn new(
        wavelengths_nm: &[f64],
        quantity: SampleQuantity,
        light: &GridSpectrum,
        sensors: &[ImageSensor<'_>],
    ) -> Result<Self, SpectralImageError> {
        let bands = wavelengths_nm.len();
        let bases = bases(wavelengths_nm, quantity)?;
        let flat = GridSpectrum::constant(1.0);
        let light = if quantity == SampleQuantity::Reflectance { light } else { &flat };
        let mut curves = Vec::with_capacity(sensors.len() * 3 * bands);
        for sensor in sensors {
            let products = under_light(sensor.sensor, light);
            for (product, divisor) in products.iter().zip(sensor.divisors.to_array()) {
                let weight = |basis: &[f64; COUNT]| {
                    (product.iter().zip(basis.iter()).map(|(p, b)| p * b).sum::<f64>() / divisor) as f32
                };
                curves.extend(bases.iter().map(weight));
            }
        }
        let batch = Batch::new(&curves, bands).map_err(|_| SpectralImageError::NotFinite)?;
        Ok(Self { batch, bands })
    }

    /// Number of bands of a pixel.
    pub fn bands(&self) -> usize {
        self.bands
    }

    /// Number of sensors.
    pub fn sensors(&self) -> usize {
        self.batch.channels() / 3
    }
}

/// Interpolation onto the grid of a 1 in each band and 0 in the others.
fn bases(wavelengths_nm: &[f64], quantity: SampleQuantity) -> Result<Vec<[f64; COUNT]>, SpectralImageError> {
    let bands = wavelengths_nm.len();
    let unit = |band: usize| {
        let values = (0..bands).map(|k| f64::from(u8::from(k == band))).collect();
        SpectralDistribution::new(wavelengths_nm.to_vec(), values)
    };
    let [first, last] = unit(0)?.range_nm();
    if last < wavelength_nm(0) || first > wavelength_nm(COUNT - 1) {
        return Err(SpectralImageError::NotVisible { first, last });
    }
    // Matching functions are interpolated as reflectances are, but keep the negative lobes that a basis has; lights linearly.
    let how = match quantity {
        SampleQuantity::Reflectance => Quantity::MatchingFunction,
        SampleQuantity::Radiance => Quantity::Light,
    };
    let basis = |band: usize| {
        let mut values = *GridSpectrum::resample(&unit(band)?, how).values();
        for (index, value) in values.iter_mut().enumerate() {
            let nm = wavelength_nm(index);
            if nm < first || nm > last {
                let end = if nm < first { 0 } else { bands - 1 };
                *value = f64::from(u8::from(band == end));
            }
        }
        Ok(values)
    };
    (0..bands).map(basis).collect()
}

/// Signals of all sensors, filled row by row.
#[derive(Clone, Debug)]
pub struct SpectralImageSignals {
    size: RasterSize,
    weights: BandWeights,
    next: usize,
    samples: Vec<u32>,
    signals: Vec<Vec<[f32; 3]>>,
    responses: Vec<f32>,
}

impl SpectralImageSignals {
    /// Begins an image.
    ///
    /// # Errors
    /// [`SpectralImageError::Size`] for a side of 0 or more than [`MAX_SIDE`].
    pub fn new(weights: BandWeights, width: usize, height: usize) -> Result<Self, SpectralImageError> {
        let side = |pixels: usize| u32::try_from(pixels).ok().filter(|side| (1..=MAX_SIDE).contains(side));
        let (Some(across), Some(down)) = (side(width), side(height)) else {
            return Err(SpectralImageError::Size { width, height });
        };
        let signals = vec![Vec::new(); weights.sensors()];
        let size = RasterSize::new(across, down);
        Ok(Self { size, weights, next: 0, samples: Vec::new(), signals, responses: Vec::new() })
    }

    /// Takes the next rows' samples, pixel by pixel. A pixel with a sample that is not finite is omitted; samples beyond the last row
    /// are ignored.
    pub fn push(&mut self, samples: &[f32]) {
        let bands = self.weights.bands;
        let left = self.size.columns() * self.size.rows() - self.next;
        let pixels = (samples.len() / bands).min(left);
        let samples = &samples[..pixels * bands];
        self.responses.resize(pixels * self.weights.batch.channels(), 0.0);
        // The lengths fit by construction.
        if self.weights.batch.responses_into(samples, &mut self.responses).is_err() {
            return;
        }
        let per_pixel = self.responses.chunks_exact(self.weights.batch.channels().max(1));
        for (pixel, (samples, responses)) in samples.chunks_exact(bands).zip(per_pixel).enumerate() {
            if samples.iter().any(|sample| !sample.is_finite()) {
                continue;
            }
            self.samples.push((self.next + pixel) as u32);
            for (signals, response) in self.signals.iter_mut().zip(responses.as_chunks::<3>().0) {
                signals.push(*response);
            }
        }
        self.next += pixels;
    }

    /// Positions of the pixels with samples, and each sensor's signals there, for [`super::develop::develop_signals`].
    pub fn finish(self) -> (Arc<LitSamples>, Vec<Vec<[f32; 3]>>) {
        let seen = self.samples.clone();
        (Arc::new(LitSamples::new(self.size, self.samples, seen)), self.signals)
    }
}
