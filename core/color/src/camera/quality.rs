//! Figures of merit of a sensor's curves: how near they come to an observer's, and what correcting them costs in noise.
//!
//! They rank cameras differently, because each weighs something else: the Vora value the directions of the two spaces, the Luther
//! residual power at each wavelength, the metamerism index the colors of surfaces.

use crate::camera::rendering::{Rendering, RenderingError, raw, under_light, white_divisors};
use crate::colorimetry::lab::{lab_from_each, lab_from_xyz};
use crate::colorimetry::{Lab, Xyz, delta_e_1976};
use crate::correction::minimize::{Objective, Refit};
use crate::correction::{Correction, CorrectionMethod, RgbTransform, Training};
use crate::math::dot::{dot, dot_inline};
use crate::math::least_squares::FitError;
use crate::math::normal::take_out;
use crate::patch_set::PatchSet;
use crate::spectral::{GridSpectrum, Sensor};
use crate::units::{bits, hash_by};
use glam::{DMat3, DVec3};
use multiversion::multiversion;

/// Rounds of reweighting of fits near one of minimum ΔE*ab.
const REFIT_ROUNDS: usize = 4;

/// Observer's colors of the patches: the part of a sensitivity metamerism index that all sensors share.
///
/// ```text
/// SMI = 100 − 5.5 mean ΔE*ab
/// ```
/// over the patches after a 3×3 fitted over the same patches, white not kept (ISO 17321-1:2012, annex: D55, the 18 chromatic patches of
/// the `ColorChecker`). The standard leaves the fit open, so both usual ones stand here. 100 for a sensor that is a linear combination
/// of the observer's curves; negative for a sensor worse than a mean ΔE*ab of 18.
#[derive(Clone, Debug, PartialEq)]
pub struct IndexSamples {
    white: Xyz,
    targets: Vec<DVec3>,
    /// L\*a\*b\* of the targets.
    wanted: Option<Vec<Lab>>,
}

impl IndexSamples {
    /// Prepares the patches as an XYZ observer sees them under the light.
    ///
    /// # Errors
    /// [`RenderingError`] where the observer does not respond to the light.
    pub fn new(observer: &Sensor, light: &GridSpectrum, patches: &PatchSet) -> Result<Self, RenderingError> {
        let divisors = white_divisors(observer, light)?;
        let product = under_light(observer, light);
        let white = DVec3::from_array(observer.integrate(light.values())) / divisors;
        let targets = patches.patches().iter().map(|patch| raw(&product, patch.grid.values()) / divisors);
        let (white, targets) = (Xyz::from_vector(white), targets.collect::<Vec<_>>());
        let wanted = targets.iter().map(|target| lab_from_xyz(Xyz::from_vector(*target), white)).collect();
        Ok(Self { white, targets, wanted })
    }

    /// The index of a sensor under the same light and patches, with the transform of the fit.
    ///
    /// # Errors
    /// [`RenderingError`] where a channel does not respond to the light or the patches do not determine a matrix.
    pub fn index(
        &self,
        sensor: &Sensor,
        light: &GridSpectrum,
        patches: &PatchSet,
        method: CorrectionMethod,
    ) -> Result<(f64, RgbTransform), RenderingError> {
        let product = under_light(sensor, light);
        let divisors = DVec3::from_array(sensor.integrate(light.values()));
        if !divisors.is_finite() || divisors.abs().min_element() == 0.0 {
            return Err(white_divisors(sensor, light).err().unwrap_or(RenderingError::NoWhite));
        }
        let samples: Vec<DVec3> =
            patches.patches().iter().map(|patch| raw(&product, patch.grid.values()) / divisors).collect();
        let transform = self.fit(&samples, method)?;
        Ok((self.of(&samples, &transform).ok_or(RenderingError::NoWhite)?, transform))
    }

    /// Transform of samples, balanced to unity, to the observer's colors.
    ///
    /// # Errors
    /// [`FitError`] where the samples do not determine one.
    pub fn fit(&self, samples: &[DVec3], method: CorrectionMethod) -> Result<RgbTransform, FitError> {
        let correction = Correction { method, keeps_white: false, ..Correction::default() };
        self.training(samples, &vec![1.0; samples.len()]).fit(&correction, self.white)
    }

    /// Fits near that of minimum ΔE*ab of these samples.
    pub fn refit(&self, samples: &[DVec3], fitted: &RgbTransform) -> Option<Refit> {
        let (RgbTransform::Matrix(matrix), weights) = (fitted, vec![1.0; samples.len()]) else { return None };
        let by = (Objective::DeltaE1976, REFIT_ROUNDS);
        Refit::new(self.training(samples, &weights), self.white, false, by, *matrix)
    }

    fn training<'a>(&'a self, samples: &'a [DVec3], weights: &'a [f64]) -> Training<'a> {
        Training { samples, targets: &self.targets, weights }
    }

    /// The index of samples through a transform.
    pub fn of(&self, samples: &[DVec3], transform: &RgbTransform) -> Option<f64> {
        let colors: Vec<Xyz> = samples.iter().map(|sample| Xyz::from_vector(transform.xyz(*sample))).collect();
        let found = lab_from_each(&colors, self.white)?;
        let sum: f64 =
            found.iter().zip(self.wanted.as_ref()?).map(|(found, wanted)| delta_e_1976(*found, *wanted)).sum();
        Some(100.0 - 5.5 * sum / samples.len() as f64)
    }
}

/// Reflectance of the gray whose noise is reported.
const GRAY: f64 = 0.18;

/// Noise gains from raw RGB to linear sRGB.
///
/// ```text
/// N = M G,   M = linear sRGB from balanced RGB,   G = diag(g),   g_c ∝ s_c / ∫ C_c L dλ with g_green = 1
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NoiseAmplification {
    /// Noise of linear red, green and blue for unit independent noise of the raw channels: the lengths of the rows of N.
    pub rows: [f64; 3],
    /// Noise-gain factor Ψ of US patent 5609978 (1997): sum of the lengths of the rows of M, the matrix from balanced exposures to those
    /// of the primaries of BT.709. 3 for a camera that needs no matrix; the patent requires at most 6.5.
    pub psi: f64,
    /// N.
    matrix: DMat3,
}

#[cfg(feature = "fits")]
impl NoiseAmplification {
    /// Noise gains of a rendering; none where a gain is zero or not finite.
    pub fn new(rendering: &Rendering) -> Option<Self> {
        let matrix = srgb_from_balanced(rendering);
        let gains = rendering.white / rendering.white_integrals;
        let all = matrix * DMat3::from_diagonal(gains / gains.y);
        if gains.abs().min_element() == 0.0 || !all.is_finite() {
            return None;
        }
        Some(Self { rows: row_lengths(all), psi: row_lengths(matrix).iter().sum(), matrix: all })
    }

    /// Condition number of N: ratio of its largest to its smallest singular value; none for a singular matrix. Found when it is asked
    /// for, because it takes longer than all else here.
    pub fn condition(&self) -> Option<f64> {
        let values = nalgebra::Matrix3::from_column_slice(&self.matrix.to_cols_array()).singular_values();
        Some(values.max() / values.min()).filter(|ratio| ratio.is_finite())
    }
}

/// Linear sRGB from RGB balanced to unity: a perfect diffuser at (1, 1, 1).
fn srgb_from_balanced(rendering: &Rendering) -> DMat3 {
    rendering.srgb_from_xyz * rendering.xyz_from_signals * DMat3::from_diagonal(rendering.white)
}

#[cfg(feature = "fits")]
fn row_lengths(matrix: DMat3) -> [f64; 3] {
    [0, 1, 2].map(|row| matrix.row(row).length())
}

/// Electrons that a pixel holds, and its read noise.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Electrons {
    full_well: f64,
    read_noise: f64,
}

hash_by!(Electrons, |of| [of.full_well, of.read_noise].map(bits));

/// Reason that numbers describe no pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, thiserror::Error)]
#[allow(missing_docs, reason = "each variant says in its message what is wrong")]
pub enum ElectronsError {
    #[error("the full-well capacity must be a positive number of electrons, at most 1e9")]
    FullWell,
    /// The read noise is not a number from zero up.
    #[error("the read noise must be a number of electrons from 0 to the full-well capacity")]
    ReadNoise,
}

impl Electrons {
    /// Full-well capacity and RMS read noise in electrons.
    ///
    /// # Errors
    /// [`ElectronsError`] unless 0 < full well ≤ 1e9 and 0 ≤ read noise ≤ full well.
    pub fn new(full_well: f64, read_noise: f64) -> Result<Self, ElectronsError> {
        if !(f64::MIN_POSITIVE..=1e9).contains(&full_well) {
            return Err(ElectronsError::FullWell);
        }
        if !(0.0..=full_well).contains(&read_noise) {
            return Err(ElectronsError::ReadNoise);
        }
        Ok(Self { full_well, read_noise })
    }
}

/// Covariance of linear sRGB of a gray of some reflectance: shot and read noise of the raw channels through balance and matrix.
///
/// ```text
/// Σ′ = M Σ Mᵀ,   Σ = diag((n_c + r²) / w_c²),   n_c = ρ w_c
/// ```
/// `w_c` are the electrons of a perfect diffuser, exposed so that the most sensitive channel just fills its well; r is the read noise, ρ the
/// reflectance. Needs curves whose channels have one scale.
pub fn covariance(rendering: &Rendering, electrons: Electrons, reflectance: f64) -> DMat3 {
    let matrix = srgb_from_balanced(rendering);
    let integrals = rendering.white_integrals.abs();
    let white = integrals * (electrons.full_well / integrals.max_element());
    let variance = (white * reflectance + DVec3::splat(electrons.read_noise.powi(2))) / (white * white);
    matrix * DMat3::from_diagonal(variance) * matrix.transpose()
}

/// Signal-to-noise ratio of the luminance Y of an 18 % gray in decibels, `20 lg (Y / σ_Y)`, by [`covariance`]; none where it is not
/// finite.
pub fn gray_snr_db(rendering: &Rendering, electrons: Electrons) -> Option<f64> {
    let covariance = covariance(rendering, electrons, GRAY);
    // Luminance of linear sRGB under its own white.
    let weights = crate::colorimetry::rgb::XYZ_FROM_SRGB.row(1);
    let sigma = weights.dot(covariance * weights).sqrt();
    let snr = 20.0 * (GRAY * (weights.x + weights.y + weights.z) / sigma).log10();
    snr.is_finite().then_some(snr)
}

/// Share of a curve's length below which what is left of it beside the others is rounding.
const DEPENDENT: f64 = 1e-10;

/// Agreement of a sensor's space with an observer's, independent of light, balance and color transform.
///
/// Curves are taken at 380, 381, …, 780 nm without weights. `P_C` and `P_A` project onto the spaces of the sensor's curves C and the
/// observer's A.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpaceQuality {
    /// Vora value (Vora and Trussell 1993, J. Opt. Soc. Am. A 10, 1499): 1 where the spaces are the same, 0 where they are orthogonal.
    ///
    /// ```text
    /// ν = tr(P_A P_C) / 3
    /// ```
    pub vora: f64,
    /// Luther residual: relative RMS of the observer's curves that no linear combination of the sensor's reaches; 0 to 1.
    ///
    /// ```text
    /// min_M ‖A − C M‖ / ‖A‖ = ‖A − P_C A‖ / ‖A‖
    /// ```
    /// 0 where the Luther–Ives condition holds. Depends on which curves span the observer's space.
    pub luther: f64,
    /// Quality factor of each channel (Neugebauer 1956, J. Opt. Soc. Am. 46, 821): `|P_A c|² / |c|²`, 0 to 1.
    pub factors: [f64; 3],
}

/// Space of an observer's curves: the part that all sensors share.
#[derive(Clone, Debug, PartialEq)]
pub struct ObserverSpace {
    /// Curves on the grid in one scale.
    pub curves: [Vec<f64>; 3],
    basis: Vec<Vec<f64>>,
    /// Sum of their squared lengths.
    power: f64,
}

impl ObserverSpace {
    /// Space of an observer; none where its curves are linearly dependent.
    pub fn new(observer: &Sensor) -> Option<Self> {
        Self::of(curves(observer))
    }

    /// Space of an observer's curves on the grid, or in coordinates of an orthonormal basis; none where they are linearly dependent.
    pub fn of(curves: [Vec<f64>; 3]) -> Option<Self> {
        Some(Self { basis: basis(&curves)?, power: curves.iter().map(|curve| dot(curve, curve)).sum(), curves })
    }

    /// Agreement of a sensor's curves, in one scale and the coordinates of the observer's; none where they are linearly dependent.
    pub fn quality(&self, channels: &[Vec<f64>; 3]) -> Option<SpaceQuality> {
        quality(self, channels)
    }
}

/// Compiled as a whole for several instruction sets: of curves in coordinates the products are short, but many.
#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl+avx512bw+avx512cd", "x86_64+avx2", "aarch64+neon"))]
fn quality(observer: &ObserverSpace, channels: &[Vec<f64>; 3]) -> Option<SpaceQuality> {
    let (own, seen) = (basis(channels)?, &observer.basis);
    let (mut vora, mut left, mut factors) = (0.0, 0.0, [0.0; 3]);
    for c in 0..3 {
        vora += inside(&own[c], seen);
        left += outside(&observer.curves[c], &own);
        factors[c] = inside(&channels[c], seen) / dot_inline(&channels[c], &channels[c]);
    }
    Some(SpaceQuality { vora: vora / 3.0, luther: (left / observer.power).sqrt(), factors })
}

/// The three curves on the grid, each scaled to its largest value: neither spaces nor ratios within a curve's set change where all
/// three have one scale, and squares neither overflow nor vanish.
pub fn curves(sensor: &Sensor) -> [Vec<f64>; 3] {
    let mut curves = [0, 1, 2].map(|channel| sensor.on_grid(channel));
    let largest = curves.iter().flatten().fold(0.0_f64, |m, v| m.max(v.abs()));
    curves.iter_mut().flatten().for_each(|v| *v /= largest);
    curves
}

/// Orthonormal basis of the space of three curves, by Gram and Schmidt's method done twice.
#[inline(always)]
fn basis(curves: &[Vec<f64>; 3]) -> Option<Vec<Vec<f64>>> {
    let mut found: Vec<Vec<f64>> = Vec::with_capacity(3);
    for curve in curves {
        let length = dot_inline(curve, curve).sqrt();
        let mut rest = curve.clone();
        take_out(&mut rest, &found);
        take_out(&mut rest, &found);
        let left = dot_inline(&rest, &rest).sqrt();
        if left.is_nan() || left <= DEPENDENT * length {
            return None;
        }
        for value in &mut rest {
            *value /= left;
        }
        found.push(rest);
    }
    Some(found)
}

/// Squared length of a curve's projection onto a space.
#[inline(always)]
fn inside(curve: &[f64], space: &[Vec<f64>]) -> f64 {
    space.iter().fold(0.0, |square, axis| square + dot_inline(curve, axis).powi(2))
}

/// Squared length of what a projection onto a space leaves of a curve; by subtraction, so that it is exact where little is left.
#[inline(always)]
fn outside(curve: &[f64], space: &[Vec<f64>]) -> f64 {
    let mut rest = curve.to_vec();
    take_out(&mut rest, space);
    dot_inline(&rest, &rest)
}
