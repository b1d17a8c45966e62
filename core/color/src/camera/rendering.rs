//! From one sensor's signals to XYZ, chromaticity and colors on a screen.

use super::white_balance::WhiteBalanceTarget;
use crate::accuracy::Unmet;
use crate::colorimetry::adaptation::bradford;
use crate::colorimetry::rgb::{XYZ_FROM_SRGB, srgb_from_xyz, srgb_white};
use crate::colorimetry::{Lab, Xyz, lab::lab_from_xyz};
use crate::correction::minimize::Refit;
use crate::correction::root_polynomial::RootPolynomial;
use crate::correction::{Correction, CorrectionMethod, RgbTransform, Training};
use crate::math::dot::{dot, dot_each};
use crate::math::least_squares::FitError;
use crate::patch_set::PatchSet;
use crate::spectral::grid::COUNT;
use crate::spectral::{GridSpectrum, Primaries, Sensor};
use glam::{DMat3, DVec3};
use std::sync::Arc;

/// Color transform from sensor signals to XYZ.
#[derive(Clone, Copy, Debug)]
pub enum ColorTransform<'a> {
    /// Eq 13 for cameras and RGB observers alike; CIE observers directly.
    Paper,
    /// CIE observers directly; all else by a transform fitted to a reference observer over training reflectances.
    Observer {
        /// The XYZ observer that is fitted to.
        reference: &'a Sensor,
        /// The reflectances that are fitted over; never the displayed ones.
        training: &'a PatchSet,
        /// The color correction.
        correction: Correction,
    },
}

/// Reason that a sensor cannot be rendered under a light.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, thiserror::Error)]
#[allow(missing_docs, reason = "each variant says in its message what is wrong")]
pub enum RenderingError {
    #[error("channel {} does not respond to this light, so white cannot be balanced; choose another light", channel + 1)]
    BlindToLight {
        /// The channel, 0 to 2.
        channel: usize,
    },
    #[error("Eq 13 takes RGB, not cone signals; choose a fitted color transform")]
    ConesNeedObserver,
    #[error("the observer that a color transform is fitted to must be an XYZ observer")]
    Reference,
    #[error("channel {} responds too weakly for the chosen white; choose another white or larger sensitivities", channel + 1)]
    GainOverflow {
        /// The channel, 0 to 2.
        channel: usize,
    },
    #[error("the chosen white leaves a channel at zero; choose another white")]
    NoWhite,
    #[error("the paper's matrix (Eq 13) is not fitted; choose a fitted color transform")]
    NotFitted,
    #[error("this correction is no invertible 3×3 matrix; choose a matrix")]
    NoMatrix,
    #[error(
        "a root polynomial needs signals that are never negative, but {} has negative lobes; choose a matrix",
        if *is_rgb { "the observer" } else { "the sensor" }
    )]
    NegativeLobes {
        /// True for an observer's matching functions.
        is_rgb: bool,
    },
    #[error(transparent)]
    Fit(#[from] FitError),
    #[error(transparent)]
    Accuracy(#[from] Unmet),
}

/// Rounds of reweighting of fits near one that minimizes a mean difference over training reflectances.
const REFIT_ROUNDS: usize = 24;

/// Below this share of the unsigned integral a balance is refused: it would be made of cancellation.
const BLIND: f64 = 1e-6;

/// Conversion from a sensor's raw integrals to chromaticities, for a fixed light, white balance and color transform.
#[derive(Clone, Debug, PartialEq)]
pub struct Rendering {
    /// Signals of a perfect diffuser: Eq 11's s.
    pub white: DVec3,
    /// Divisors of `∫ C_c S L dλ`: `∫ C_c L dλ` (Eq 16), for tristimulus values that of Y. Divided, not multiplied with
    /// the reciprocal, so that a perfect white takes `white` exactly.
    pub white_integrals: DVec3,
    /// Factors that turn `∫ C_c E dλ` of a glowing body into signals (Eq 15), the same along a locus.
    pub locus_gain: DVec3,
    /// XYZ from signals; with a root polynomial, its derivative at white.
    pub xyz_from_signals: DMat3,
    /// Root polynomial from signals balanced to unity, if that is the color transform.
    pub root_polynomial: Option<Arc<RootPolynomial>>,
    /// Linear sRGB from XYZ, for swatches.
    pub srgb_from_xyz: DMat3,
    /// CIE's adopted white of L*a*b*: the tristimulus values of a perfect diffuser.
    pub lab_white: Xyz,
    /// True if the signals are RGB (cameras, RGB observers), false if tristimulus values.
    pub is_rgb: bool,
    /// The smallest share that is left of a white integral after cancellation; below 0.01 the balance is fragile.
    pub conditioning: f64,
    /// Raw integrals of the training reflectances that the color transform was fitted over, if it was.
    pub training: Option<Arc<[DVec3]>>,
}

impl Rendering {
    /// Prepares a sensor for a light, a white balance and a color transform.
    ///
    /// # Errors
    /// [`RenderingError`] where white cannot be balanced or the transform does not apply to the sensor.
    pub fn new(
        sensor: &Sensor,
        light: &GridSpectrum,
        white: WhiteBalanceTarget,
        transform: ColorTransform<'_>,
    ) -> Result<Self, RenderingError> {
        match (transform, sensor.primaries()) {
            (_, Primaries::Xyz) => direct(sensor, light),
            (ColorTransform::Paper, Primaries::Cones) => Err(RenderingError::ConesNeedObserver),
            (ColorTransform::Paper, Primaries::Camera | Primaries::Rgb) => paper(sensor, light, white),
            (ColorTransform::Observer { reference, training, correction }, _) => {
                let targets = FitTargets::new(reference, light, training);
                fitted(sensor, light, white, training, targets.as_ref().map_err(|&e| e), &correction)
            }
        }
    }

    /// [`Rendering::new`] with a transform fitted to an observer, given the part that other sensors share.
    ///
    /// # Errors
    /// [`RenderingError`] where white cannot be balanced or the fit has no answer.
    pub fn by_targets(
        sensor: &Sensor,
        light: &GridSpectrum,
        white: WhiteBalanceTarget,
        training: &PatchSet,
        targets: Result<&FitTargets, RenderingError>,
        correction: &Correction,
    ) -> Result<Self, RenderingError> {
        match sensor.primaries() {
            Primaries::Xyz => direct(sensor, light),
            Primaries::Camera | Primaries::Rgb | Primaries::Cones => {
                fitted(sensor, light, white, training, targets, correction)
            }
        }
    }

    /// Signals of a reflectance from its raw integrals `∫ C_c S L dλ`.
    pub fn patch_signals(&self, raw: [f64; 3]) -> DVec3 {
        self.white * (DVec3::from_array(raw) / self.white_integrals)
    }

    /// Rendering by Eq 13 of a sensor with these integrals `∫ C_c L dλ` and `∫ C_c dλ`.
    ///
    /// # Errors
    /// [`RenderingError::GainOverflow`].
    pub fn by_paper(white: DVec3, integrals: DVec3, flat: DVec3, conditioning: f64) -> Result<Self, RenderingError> {
        Ok(Self {
            white,
            white_integrals: integrals,
            locus_gain: gain(white, flat)?,
            xyz_from_signals: XYZ_FROM_SRGB,
            root_polynomial: None,
            srgb_from_xyz: srgb_from_xyz(),
            // A perfect diffuser takes `white`, so that is the adopted white. Another one would let a wrong target shrink every
            // difference.
            lab_white: Xyz::from_vector(XYZ_FROM_SRGB * white),
            is_rgb: true,
            conditioning,
            training: None,
        })
    }

    /// Rendering of a sensor with these integrals `∫ C_c L dλ` through a transform that is fitted.
    ///
    /// # Errors
    /// [`RenderingError::NoWhite`] and [`RenderingError::GainOverflow`].
    pub fn by_fit(
        targets: &FitTargets,
        transform: RgbTransform,
        white: DVec3,
        integrals: DVec3,
        (conditioning, is_rgb): (f64, bool),
    ) -> Result<Self, RenderingError> {
        if !white.recip().is_finite() {
            return Err(RenderingError::NoWhite);
        }
        let (unity, root_polynomial) = match transform {
            RgbTransform::Matrix(matrix) => (matrix, None),
            RgbTransform::RootPolynomial(polynomial) => (polynomial.at_white(), Some(polynomial)),
        };
        let FitTargets { reference, .. } = targets;
        Ok(Self {
            white,
            white_integrals: integrals,
            locus_gain: gain(white, integrals)?,
            xyz_from_signals: unity * DMat3::from_diagonal(white.recip()),
            root_polynomial,
            srgb_from_xyz: reference.srgb_from_xyz,
            lab_white: reference.lab_white,
            is_rgb,
            conditioning,
            training: None,
        })
    }

    /// Rendering under equal energy with unity white balance by Eq 13: the conditions of the paper's first two experiments.
    ///
    /// # Errors
    /// As [`Rendering::new`].
    pub fn under_equal_energy(sensor: &Sensor) -> Result<Self, RenderingError> {
        Self::new(sensor, &GridSpectrum::constant(1.0), WhiteBalanceTarget::UNITY, ColorTransform::Paper)
    }

    /// XYZ of a blackbody, up to a positive factor, from its raw integrals `∫ C_c E dλ` (Eq 15).
    pub fn blackbody(&self, raw: [f64; 3]) -> Xyz {
        self.xyz(DVec3::from_array(raw) * self.locus_gain)
    }

    /// XYZ of signals; Y = 1 for a perfect white.
    pub fn xyz(&self, signals: DVec3) -> Xyz {
        Xyz::from_vector(match &self.root_polynomial {
            Some(polynomial) => polynomial.xyz(signals / self.white),
            None => self.xyz_from_signals * signals,
        })
    }

    /// Linear sRGB of XYZ; may be outside 0 to 1.
    pub fn linear_srgb(&self, xyz: Xyz) -> [f64; 3] {
        (self.srgb_from_xyz * xyz.to_vector()).to_array()
    }

    /// L*a*b* of XYZ.
    pub fn lab(&self, xyz: Xyz) -> Option<Lab> {
        lab_from_xyz(xyz, self.lab_white)
    }
}

/// `∫ C_c L dλ` of one channel, checked against blindness, with the share left of the unsigned integral.
fn white_integral(sensor: &Sensor, light: &GridSpectrum, channel: usize) -> Result<(f64, f64), RenderingError> {
    let weighted = sensor.weighted(channel);
    let integral = dot(weighted, light.values());
    let unsigned: f64 = weighted.iter().zip(light.values()).map(|(c, l)| (c * l).abs()).sum();
    // Written so that an unsigned integral of zero is refused too.
    let share = (integral / unsigned).abs();
    if share >= BLIND && unsigned.is_normal() {
        Ok((integral, share))
    } else {
        Err(RenderingError::BlindToLight { channel })
    }
}

/// White integrals of the three channels, with the smallest share left after cancellation.
fn white_integrals(sensor: &Sensor, light: &GridSpectrum) -> Result<(DVec3, f64), RenderingError> {
    let (r, of_r) = white_integral(sensor, light, 0)?;
    let (g, of_g) = white_integral(sensor, light, 1)?;
    let (b, of_b) = white_integral(sensor, light, 2)?;
    Ok((DVec3::new(r, g, b), of_r.min(of_g).min(of_b)))
}

/// Divisors of `∫ C_c S L dλ`: `∫ C_c L dλ` of each channel (Eq 16), for tristimulus values that of Y.
///
/// # Errors
/// [`RenderingError::BlindToLight`] where a channel does not respond to the light.
pub fn white_divisors(sensor: &Sensor, light: &GridSpectrum) -> Result<DVec3, RenderingError> {
    if sensor.primaries() == Primaries::Xyz {
        white_integral(sensor, light, 1).map(|(y, _)| DVec3::splat(y))
    } else {
        white_integrals(sensor, light).map(|(integrals, _)| integrals)
    }
}

/// Factors from raw integrals to signals.
fn gain(white: DVec3, integrals: DVec3) -> Result<DVec3, RenderingError> {
    let gain = white / integrals;
    match (0..3).find(|&channel| !gain[channel].is_finite()) {
        Some(channel) => Err(RenderingError::GainOverflow { channel }),
        None => Ok(gain),
    }
}

/// A CIE observer: tristimulus values with Y = 1 for a perfect white under the light.
fn direct(sensor: &Sensor, light: &GridSpectrum) -> Result<Rendering, RenderingError> {
    // Only Y divides: light that the other two do not see, such as deep red, is no reason to refuse.
    let (y, conditioning) = white_integral(sensor, light, 1)?;
    let integrals = DVec3::from_array(sensor.integrate(light.values()));
    let divisor = DVec3::splat(y);
    let white = Xyz::from_vector(integrals / divisor);
    // Beside the other two there is no Y.
    if !white.to_vector().is_finite() {
        return Err(RenderingError::BlindToLight { channel: 1 });
    }
    Ok(Rendering {
        white: DVec3::ONE,
        white_integrals: divisor,
        locus_gain: gain(DVec3::ONE, divisor)?,
        xyz_from_signals: DMat3::IDENTITY,
        root_polynomial: None,
        srgb_from_xyz: screen_from(white),
        lab_white: white,
        is_rgb: false,
        conditioning,
        training: None,
    })
}

/// Eq 15, 16 and 13: loci balanced to equal energy, patches to the light, both through M.
fn paper(
    sensor: &Sensor,
    light: &GridSpectrum,
    WhiteBalanceTarget(white): WhiteBalanceTarget,
) -> Result<Rendering, RenderingError> {
    let (integrals, conditioning) = white_integrals(sensor, light)?;
    let equal_energy = GridSpectrum::constant(1.0);
    let (flat, _) = white_integrals(sensor, &equal_energy)?;
    Rendering::by_paper(DVec3::from_array(white), integrals, flat, conditioning)
}

/// XYZ of the training reflectances through a reference observer: the part of a fit that all sensors share.
#[derive(Clone, Debug, PartialEq)]
pub struct FitTargets {
    reference: Rendering,
    targets: Vec<DVec3>,
}

impl FitTargets {
    /// Prepares the targets; the reference must count in XYZ and see the light.
    ///
    /// # Errors
    /// [`RenderingError`] unless the reference is an XYZ observer that responds to the light.
    pub fn new(reference: &Sensor, light: &GridSpectrum, training: &PatchSet) -> Result<Self, RenderingError> {
        if reference.primaries() != Primaries::Xyz {
            return Err(RenderingError::Reference);
        }
        let rendering = direct(reference, light)?;
        let product = under_light(reference, light);
        let targets =
            training.patches().iter().map(|patch| raw(&product, patch.grid.values()) / rendering.white_integrals);
        Ok(Self { targets: targets.collect(), reference: rendering })
    }

    /// Other targets under the same conditions.
    #[must_use]
    pub fn with(&self, targets: Vec<DVec3>) -> Self {
        Self { targets, reference: self.reference.clone() }
    }

    /// XYZ of each training reflectance.
    pub fn targets(&self) -> &[DVec3] {
        &self.targets
    }

    /// Transform of balanced samples to the targets.
    ///
    /// # Errors
    /// [`FitError`] where the samples do not determine it.
    pub fn fit(&self, samples: &[DVec3], correction: &Correction) -> Result<RgbTransform, FitError> {
        let weights = correction.weights.for_targets(&self.targets, self.reference.lab_white);
        let training = Training { samples, targets: &self.targets, weights: &weights };
        training.fit(correction, self.reference.lab_white)
    }

    /// Fits near one of these samples; none for a method that does not search, whose fits are cheap anyway.
    pub fn refit(&self, samples: &[DVec3], correction: &Correction, fitted: &RgbTransform) -> Option<Refit> {
        let (CorrectionMethod::Minimize(objective), RgbTransform::Matrix(matrix)) = (correction.method, fitted) else {
            return None;
        };
        let weights = correction.weights.for_targets(&self.targets, self.reference.lab_white);
        let training = Training { samples, targets: &self.targets, weights: &weights };
        Refit::new(training, self.reference.lab_white, correction.keeps_white, (objective, REFIT_ROUNDS), *matrix)
    }
}

/// Raw integrals of training reflectances, with their divisors, those of a perfect diffuser, and their conditioning.
fn training_integrals(
    sensor: &Sensor,
    light: &GridSpectrum,
    training: &PatchSet,
) -> Result<(Arc<[DVec3]>, DVec3, f64), RenderingError> {
    let (integrals, conditioning) = white_integrals(sensor, light)?;
    let product = under_light(sensor, light);
    let all = training.patches().iter().map(|patch| raw(&product, patch.grid.values()));
    Ok((all.collect(), integrals, conditioning))
}

/// Raw integrals over those of a perfect diffuser.
pub fn balanced(raw: &[DVec3], white_integrals: DVec3) -> Vec<DVec3> {
    raw.iter().map(|raw| *raw / white_integrals).collect()
}

/// Samples that a color correction of a sensor is fitted over.
#[derive(Clone, Debug, PartialEq)]
pub struct FitSamples {
    /// RGB balanced to unity, of each training reflectance.
    pub samples: Vec<DVec3>,
    /// XYZ of each, to the reference observer.
    pub targets: Vec<DVec3>,
    /// Adopted white: XYZ of a perfect diffuser.
    pub white: Xyz,
    /// Linear sRGB from XYZ, for swatches.
    pub srgb_from_xyz: DMat3,
    /// Divisors of the raw integrals: signals of a perfect diffuser before balance.
    pub white_integrals: DVec3,
}

impl FitSamples {
    /// Samples of a sensor under a light.
    ///
    /// # Errors
    /// [`RenderingError`] where white cannot be balanced, or the targets have an error.
    pub fn new(
        sensor: &Sensor,
        light: &GridSpectrum,
        training: &PatchSet,
        targets: Result<&FitTargets, RenderingError>,
    ) -> Result<Self, RenderingError> {
        let (raw, white_integrals, _) = training_integrals(sensor, light, training)?;
        let samples = balanced(&raw, white_integrals);
        let FitTargets { reference, targets } = targets?;
        let (white, srgb_from_xyz) = (reference.lab_white, reference.srgb_from_xyz);
        Ok(Self { samples, targets: targets.clone(), white, srgb_from_xyz, white_integrals })
    }
}

/// A sensor through the transform that best predicts the reference observer over the training reflectances, by default a 3×3 that
/// keeps white.
///
/// The transform belongs to the balanced signals, so the white chosen for the balance moves RGB but not XYZ.
fn fitted(
    sensor: &Sensor,
    light: &GridSpectrum,
    WhiteBalanceTarget(white): WhiteBalanceTarget,
    training: &PatchSet,
    targets: Result<&FitTargets, RenderingError>,
    correction: &Correction,
) -> Result<Rendering, RenderingError> {
    // The sensor first: a light that neither sees is the sensor's own trouble.
    let (raw, integrals, conditioning) = training_integrals(sensor, light, training)?;
    let targets = targets?;
    check_lobes(sensor, correction.method)?;
    let transform = targets.fit(&balanced(&raw, integrals), correction)?;
    let is_rgb = matches!(sensor.primaries(), Primaries::Camera | Primaries::Rgb);
    let fitted = Rendering::by_fit(targets, transform, DVec3::from_array(white), integrals, (conditioning, is_rgb))?;
    Ok(Rendering { training: Some(raw), ..fitted })
}

/// Refuses roots for a sensor with a sensitivity below zero.
///
/// # Errors
/// [`RenderingError::NegativeLobes`].
pub fn check_lobes(sensor: &Sensor, method: CorrectionMethod) -> Result<(), RenderingError> {
    let negative = || (0..3).any(|channel| sensor.weighted(channel).iter().any(|&c| c < 0.0));
    if matches!(method, CorrectionMethod::RootPolynomial(_)) && negative() {
        return Err(RenderingError::NegativeLobes { is_rgb: sensor.primaries() == Primaries::Rgb });
    }
    Ok(())
}

/// Linear sRGB from XYZ under a scene white: Bradford to D65, then the inverse of M.
fn screen_from(white: Xyz) -> DMat3 {
    // A white that cannot be adapted (a saturated light with a negative response) is shown unadapted.
    let adapted = bradford(white, srgb_white()).unwrap_or(DMat3::IDENTITY);
    srgb_from_xyz() * adapted
}

/// A sensor's three weighted curves times a light, on the grid: the vectors that every patch is multiplied with.
pub fn under_light(sensor: &Sensor, light: &GridSpectrum) -> [Box<[f64; COUNT]>; 3] {
    [0, 1, 2].map(|channel| {
        let mut product = Box::new(*sensor.weighted(channel));
        product.iter_mut().zip(light.values()).for_each(|(c, l)| *c *= l);
        product
    })
}

/// `∫ C_c S L dλ` for each channel, from the products of [`under_light`].
pub fn raw(under_light: &[Box<[f64; COUNT]>; 3], reflectance: &[f64; COUNT]) -> DVec3 {
    let [r, g, b] = under_light;
    DVec3::from_array(dot_each([r, g, b], reflectance))
}
