//! Noise that white balance and color matrix amplify.

use crate::camera::rendering::Rendering;
use crate::units::{bits, hash_by};
use glam::{DMat3, DVec3};

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
    /// Condition number of N: ratio of its largest to its smallest singular value.
    pub condition: f64,
}

impl NoiseAmplification {
    /// Noise gains of a rendering; none where a gain is zero or not finite.
    pub fn new(rendering: &Rendering) -> Option<Self> {
        let matrix = srgb_from_balanced(rendering);
        let gains = rendering.white / rendering.white_integrals;
        let all = matrix * DMat3::from_diagonal(gains / gains.y);
        if gains.abs().min_element() == 0.0 || !all.is_finite() {
            return None;
        }
        let found = Self { rows: row_lengths(all), psi: row_lengths(matrix).iter().sum(), condition: condition(all) };
        found.condition.is_finite().then_some(found)
    }
}

/// Linear sRGB from RGB balanced to unity: a perfect diffuser at (1, 1, 1).
fn srgb_from_balanced(rendering: &Rendering) -> DMat3 {
    rendering.srgb_from_xyz * rendering.xyz_from_signals * DMat3::from_diagonal(rendering.white)
}

fn row_lengths(matrix: DMat3) -> [f64; 3] {
    [0, 1, 2].map(|row| matrix.row(row).length())
}

/// Ratio of the largest to the smallest singular value of a finite matrix; not finite for a singular one.
fn condition(matrix: DMat3) -> f64 {
    let values = nalgebra::Matrix3::from_column_slice(&matrix.to_cols_array()).singular_values();
    values.max() / values.min()
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
pub enum ElectronsError {
    /// The full well is not a positive number.
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
    ///
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
