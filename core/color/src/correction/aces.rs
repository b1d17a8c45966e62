//! ACES input device transforms (IDT) as rawtoaces defines them.

use super::minimize::{Objective, minimize};
use super::neutral::Neutral;
use super::{RgbTransform, Training};
use crate::colorimetry::adaptation::cat02;
use crate::colorimetry::{Lab, Xyz, delta_e_2000, lab::lab_from_xyz};
use crate::math::least_squares::FitError;
use crate::patch_set::PatchSet;
use crate::spectral::grid::COUNT;
use crate::spectral::{GridSpectrum, Primaries, Sensor};
use glam::{DMat3, DVec3};

/// XYZ from ACES2065-1 RGB (SMPTE ST 2065-1:2012): primaries AP0, white x = 0.32168, y = 0.33767.
pub const XYZ_FROM_ACES: DMat3 = DMat3::from_cols(
    DVec3::new(0.952_552_395_9, 0.343_966_449_8, 0.0),
    DVec3::new(0.0, 0.728_166_096_6, 0.0),
    DVec3::new(0.000_093_678_6, -0.072_132_546_4, 1.008_825_184_4),
);

/// Samples between those of rawtoaces' tables: 380–780 nm at 5 nm.
const STEP: usize = 5;

/// Brightness of the training samples before the fit.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum IdtExposure {
    /// As rawtoaces: the light is scaled so that the channel with the highest peak gives 1 for a perfect diffuser, then the least
    /// balance multiplier is 1. Where these are two channels, camera RGB of that diffuser is not 1 and the fit starts too bright.
    #[default]
    Rawtoaces,
    /// Camera RGB of a perfect diffuser is 1, 1, 1.
    WhiteAtOne,
}

/// Reason that there is no IDT.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, thiserror::Error)]
#[allow(missing_docs, reason = "each variant says in its message what is wrong")]
pub enum IdtError {
    #[error("an ACES IDT takes the RGB of a camera; choose a camera")]
    NotCamera,
    #[error("the observer of an ACES IDT must be an XYZ observer")]
    Reference,
    #[error("channel {} does not respond to this light; choose another light", channel + 1)]
    BlindToLight {
        /// The channel, 0 to 2.
        channel: usize,
    },
    #[error("the light's white cannot be adapted to the ACES white; choose another light")]
    NoWhite,
    #[error(transparent)]
    Fit(#[from] FitError),
}

/// ACES input device transform.
#[derive(Clone, Debug, PartialEq)]
pub struct Idt {
    /// White-balance multipliers of camera RGB, the least 1.
    pub balance: [f64; 3],
    /// ACES2065-1 RGB from balanced camera RGB; each row sums to 1.
    pub matrix: DMat3,
    /// Balanced camera RGB that the fit took for a perfect diffuser; 1 where rawtoaces' two scalings agree.
    pub white_signal: f64,
    /// CIEDE2000 of each training reflectance with a perfect diffuser at 1, under the ACES white.
    pub errors: Vec<f64>,
}

impl Idt {
    /// IDT of a matrix from balanced RGB to XYZ under a light, `XYZ_FROM_ACES⁻¹ · CAT02 · M`, with the camera RGB of a perfect diffuser and
    /// the errors of the fit.
    ///
    /// # Errors
    /// [`IdtError::NoWhite`] where the white cannot be adapted.
    pub fn from_matrix(matrix: DMat3, raw_white: DVec3, white: Xyz, errors: Vec<f64>) -> Result<Self, IdtError> {
        let adaptation = cat02(white, Xyz::from_vector(XYZ_FROM_ACES * DVec3::ONE)).ok_or(IdtError::NoWhite)?;
        let balance = (raw_white.max_element() / raw_white).to_array();
        Ok(Self { balance, matrix: XYZ_FROM_ACES.inverse() * adaptation * matrix, white_signal: 1.0, errors })
    }
}

/// Fits the IDT of a camera for a light.
///
/// ```text
/// min Σ |Lab(CAT02 · XYZ) − Lab(M · B · b ∘ rgb)|²,   each row of B sums to 1: 6 parameters
/// ```
/// A `neutral` replaces the table's own ratio between the channels: balance and brightness are then those of camera RGB that is the
/// neutral for a perfect diffuser. Sums at 380–780 nm every 5 nm over the training reflectances; XYZ adapted from the light's white to that of ACES by CAT02;
/// L\*a\*b\* relative to the ACES white; M is [`XYZ_FROM_ACES`] (rawtoaces 1.0, AMPAS). Outside a camera's table its sensitivity is 0.
///
/// # Errors
/// [`IdtError`] where the sensor is no camera, does not see the light, or the samples determine no matrix.
pub fn input_device_transform(
    camera: &Sensor,
    light: &GridSpectrum,
    observer: &Sensor,
    training: &PatchSet,
    exposure: IdtExposure,
    neutral: Option<Neutral>,
) -> Result<Idt, IdtError> {
    if camera.primaries() != Primaries::Camera {
        return Err(IdtError::NotCamera);
    }
    if observer.primaries() != Primaries::Xyz {
        return Err(IdtError::Reference);
    }
    let places = || (0..COUNT).step_by(STEP);
    let sum = |sensor: &Sensor, reflectance: &dyn Fn(usize) -> f64| -> DVec3 {
        places().map(|i| DVec3::from_array(sensor.at_index(i)) * light.values()[i] * reflectance(i)).sum()
    };
    let white_sums = sum(camera, &|_| 1.0);
    if let Some(channel) = (0..3).find(|&c| !white_sums[c].is_normal() || white_sums[c] < 0.0) {
        return Err(IdtError::BlindToLight { channel });
    }
    let peaks: DVec3 = places().fold(DVec3::ZERO, |peak, i| peak.max(DVec3::from_array(camera.at_index(i))));
    let raw_white = neutral.map_or(white_sums, Neutral::to_vector);
    let peaks = peaks * (raw_white / white_sums);
    // The first of equal peaks: a table whose channels are each scaled to 1 counts as red.
    let highest = (0..3).rev().max_by(|&a, &b| peaks[a].total_cmp(&peaks[b])).unwrap_or(0);
    let white_signal = match exposure {
        IdtExposure::Rawtoaces => raw_white.max_element() / raw_white[highest],
        IdtExposure::WhiteAtOne => 1.0,
    };
    let xyz_white = sum(observer, &|_| 1.0);
    let aces_white = Xyz::from_vector(XYZ_FROM_ACES * DVec3::ONE);
    let adapted = (xyz_white.y > 0.0).then(|| Xyz::from_vector(xyz_white / xyz_white.y));
    let adaptation = adapted.and_then(|white| cat02(white, aces_white)).ok_or(IdtError::NoWhite)?;
    let of = |sensor: &Sensor, white: DVec3| -> Vec<DVec3> {
        let sums = training.patches().iter().map(|patch| sum(sensor, &|i| patch.grid.values()[i]));
        sums.map(|sums| sums / white).collect()
    };
    let balanced = of(camera, white_sums);
    let samples: Vec<DVec3> = balanced.iter().map(|rgb| *rgb * white_signal).collect();
    let targets: Vec<DVec3> = of(observer, DVec3::splat(xyz_white.y)).into_iter().map(|xyz| adaptation * xyz).collect();
    let weights = vec![1.0; samples.len()];
    let training = Training { samples: &samples, targets: &targets, weights: &weights };
    let xyz_from_rgb = minimize(training, aces_white, true, Objective::LabSquares)?;
    let balance = raw_white.max_element() / raw_white;
    let errors = errors(&RgbTransform::Matrix(xyz_from_rgb), &balanced, &targets, aces_white);
    Ok(Idt { balance: balance.to_array(), matrix: XYZ_FROM_ACES.inverse() * xyz_from_rgb, white_signal, errors })
}

/// CIEDE2000 of samples through a transform from their targets, under a white.
fn errors(transform: &RgbTransform, samples: &[DVec3], targets: &[DVec3], white: Xyz) -> Vec<f64> {
    let lab = |xyz: DVec3| -> Option<Lab> { lab_from_xyz(Xyz::from_vector(xyz), white) };
    let pairs = samples.iter().zip(targets);
    pairs.filter_map(|(rgb, target)| Some(delta_e_2000(lab(*target)?, lab(transform.xyz(*rgb))?))).collect()
}
