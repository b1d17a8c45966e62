//! Color correction: transforms from camera RGB to XYZ, fitted over training reflectances.
//!
//! Samples are camera RGB balanced to unity (1, 1, 1 for a perfect diffuser), targets the tristimulus values that the reference
//! observer sees under the same light, with Y = 1 for that diffuser.

pub mod aces;
pub mod classes;
pub mod dng;
pub mod minimize;
pub mod neutral;
pub mod root_polynomial;

use crate::colorimetry::Xyz;
use crate::colorimetry::adaptation::bradford;
use crate::colorimetry::rgb::{XYZ_FROM_SRGB, srgb_white};
use crate::math::least_squares::{FitError, linear_fit, matrix_keeping};
use classes::ClassWeights;
use glam::{DMat3, DVec3};
use minimize::{Objective, minimize, minimize_near};
use rayon::prelude::*;
use root_polynomial::{Degree, RootPolynomial};
use std::borrow::Cow;
use std::sync::Arc;

/// Method by which a color transform is found.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum CorrectionMethod {
    /// No correction: balanced RGB taken as linear sRGB, its white adapted to the scene's (Bradford). What a camera shows before any.
    None,
    /// 3×3 by least squares in XYZ.
    #[default]
    LeastSquares,
    /// 3×3 that minimizes an objective of L\*a\*b\*.
    Minimize(Objective),
    /// Root polynomial by least squares in XYZ.
    RootPolynomial(Degree),
}

impl CorrectionMethod {
    /// All methods, in the order they are listed.
    pub const ALL: [Self; 8] = [
        Self::None,
        Self::LeastSquares,
        Self::Minimize(Objective::LabSquares),
        Self::Minimize(Objective::DeltaE1976),
        Self::Minimize(Objective::DeltaE2000),
        Self::RootPolynomial(Degree::Two),
        Self::RootPolynomial(Degree::Three),
        Self::RootPolynomial(Degree::Four),
    ];

    /// Name in documents and on the command line.
    pub const fn id(self) -> &'static str {
        self.words().0
    }

    /// Name in words.
    pub const fn label(self) -> &'static str {
        self.words().1
    }

    const fn words(self) -> (&'static str, &'static str) {
        match self {
            Self::None => ("none", "None (RGB as sRGB)"),
            Self::LeastSquares => ("matrix", "Matrix by least squares in XYZ"),
            Self::Minimize(Objective::LabSquares) => ("lab-least-squares", "Matrix by least squares in L*a*b*"),
            Self::Minimize(Objective::DeltaE1976) => ("min-delta-e-ab", "Matrix by minimum mean ΔE*ab"),
            Self::Minimize(Objective::DeltaE2000) => ("min-delta-e", "Matrix by minimum mean ΔE*00"),
            Self::RootPolynomial(Degree::Two) => ("root-polynomial", "Root polynomial, degree 2"),
            Self::RootPolynomial(Degree::Three) => ("root-polynomial-3", "Root polynomial, degree 3"),
            Self::RootPolynomial(Degree::Four) => ("root-polynomial-4", "Root polynomial, degree 4"),
        }
    }

    /// The method of this id.
    pub fn by_id(id: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|method| method.id() == id)
    }
}

/// Color correction: its method and conditions.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Correction {
    /// Method.
    pub method: CorrectionMethod,
    /// True if a perfect diffuser keeps its color exactly.
    pub keeps_white: bool,
    /// Weights of classes of reflectances.
    pub weights: ClassWeights,
}

impl Default for Correction {
    fn default() -> Self {
        Self { method: CorrectionMethod::LeastSquares, keeps_white: true, weights: ClassWeights::default() }
    }
}

/// Transform from balanced camera RGB to XYZ.
#[derive(Clone, Debug, PartialEq)]
pub enum RgbTransform {
    /// 3×3.
    Matrix(DMat3),
    /// Root polynomial.
    RootPolynomial(Arc<RootPolynomial>),
}

impl RgbTransform {
    /// XYZ of balanced RGB.
    pub fn xyz(&self, rgb: DVec3) -> DVec3 {
        match self {
            Self::Matrix(matrix) => *matrix * rgb,
            Self::RootPolynomial(polynomial) => polynomial.xyz(rgb),
        }
    }
}

/// Training samples: balanced RGB, the XYZ they are to give, and weights that are not negative.
#[derive(Clone, Copy, Debug)]
pub struct Training<'a> {
    /// RGB balanced to unity.
    pub samples: &'a [DVec3],
    /// XYZ of the reference.
    pub targets: &'a [DVec3],
    /// Weight of each sample in the sum that is minimized.
    pub weights: &'a [f64],
}

impl Training<'_> {
    /// Fits a transform; `white` is the XYZ of a perfect diffuser.
    ///
    /// # Errors
    /// [`FitError`] where the samples do not determine it.
    pub fn fit(self, correction: &Correction, white: Xyz) -> Result<RgbTransform, FitError> {
        let image = white.to_vector();
        let fits = correction.method != CorrectionMethod::None && !self.samples.is_empty();
        if fits && self.weights.iter().all(|weight| *weight == 0.0) {
            return Err(FitError::NoWeight);
        }
        match correction.method {
            CorrectionMethod::None => uncorrected(white).map(RgbTransform::Matrix),
            CorrectionMethod::LeastSquares if correction.keeps_white => {
                let [samples, targets] = [self.samples, self.targets].map(|values| self.scaled(values));
                matrix_keeping(&samples, &targets, DVec3::ONE, image).map(RgbTransform::Matrix)
            }
            CorrectionMethod::LeastSquares => {
                let coefficients = self.linear(None, |rgb| rgb.to_array())?.coefficients;
                Ok(RgbTransform::Matrix(DMat3::from_cols(coefficients[0], coefficients[1], coefficients[2])))
            }
            CorrectionMethod::Minimize(objective) => {
                minimize(self, white, correction.keeps_white, objective).map(RgbTransform::Matrix)
            }
            CorrectionMethod::RootPolynomial(degree) => {
                let keep = correction.keeps_white.then_some(image);
                let fit = self.linear(keep, |rgb| degree.terms(rgb))?;
                Ok(RgbTransform::RootPolynomial(Arc::new(RootPolynomial::new(degree, fit.coefficients))))
            }
        }
    }

    /// XYZ of each sample by the fit to all others; none where the others do not determine one. `fitted` is the fit to all.
    /// Incomplete once `stop` says so.
    ///
    /// Linear fits by the residual over one minus the leverage (Allen's PRESS 1974), which equals refitting; others are refitted.
    ///
    /// # Errors
    /// [`FitError`] where all samples together do not determine a fit.
    pub fn leave_one_out(
        self,
        correction: &Correction,
        white: Xyz,
        fitted: &RgbTransform,
        stop: impl Fn() -> bool + Sync,
    ) -> Result<Vec<Option<DVec3>>, FitError> {
        let keep = correction.keeps_white.then_some(white.to_vector());
        let leverages = match correction.method {
            CorrectionMethod::None => vec![0.0; self.samples.len()],
            CorrectionMethod::LeastSquares => self.linear(keep, |rgb| rgb.to_array())?.leverages,
            CorrectionMethod::RootPolynomial(degree) => self.linear(keep, |rgb| degree.terms(rgb))?.leverages,
            CorrectionMethod::Minimize(_) => return Ok(self.refitted(correction, white, fitted, stop)),
        };
        let left_out = |((sample, target), leverage): ((&DVec3, &DVec3), f64)| {
            let error = (fitted.xyz(*sample) - *target) / (1.0 - leverage);
            (1.0 - leverage > 1e-9 && error.is_finite()).then(|| *target + error)
        };
        Ok(self.samples.iter().zip(self.targets).zip(leverages).map(left_out).collect())
    }

    /// XYZ of each sample by a new fit without it; `fitted` is the fit to all. Once `stop` says so, nothing is fitted any more.
    pub fn refitted(
        self,
        correction: &Correction,
        white: Xyz,
        fitted: &RgbTransform,
        stop: impl Fn() -> bool + Sync,
    ) -> Vec<Option<DVec3>> {
        // Fits that are searched for begin at that of all samples: it is near.
        let near = match (correction.method, fitted) {
            (CorrectionMethod::Minimize(objective), RgbTransform::Matrix(matrix)) => Some((objective, *matrix)),
            _ => None,
        };
        let without = |left: usize| {
            if stop() {
                return None;
            }
            let kept = |i: &usize| *i != left;
            let places: Vec<usize> = (0..self.samples.len()).filter(kept).collect();
            let samples: Vec<DVec3> = places.iter().map(|&i| self.samples[i]).collect();
            let targets: Vec<DVec3> = places.iter().map(|&i| self.targets[i]).collect();
            let weights: Vec<f64> = places.iter().map(|&i| self.weights[i]).collect();
            let rest = Training { samples: &samples, targets: &targets, weights: &weights };
            let fit = match near {
                Some((objective, matrix)) => {
                    let keeps_white = correction.keeps_white;
                    minimize_near(rest, white, keeps_white, objective, Some(matrix)).map(RgbTransform::Matrix)
                }
                None => rest.fit(correction, white),
            };
            fit.ok().map(|fit| fit.xyz(self.samples[left]))
        };
        (0..self.samples.len()).into_par_iter().map(without).collect()
    }

    /// Values times the roots of their weights; the values themselves, as mostly, where all weights are 1.
    fn scaled<'a>(&self, values: &'a [DVec3]) -> Cow<'a, [DVec3]> {
        if self.weights.iter().all(|weight| *weight == 1.0) {
            return Cow::Borrowed(values);
        }
        values.iter().zip(self.weights).map(|(value, weight)| *value * weight.sqrt()).collect()
    }

    fn linear<R: AsMut<[f64]> + AsRef<[f64]>>(
        self,
        keep: Option<DVec3>,
        terms: impl Fn(DVec3) -> R,
    ) -> Result<crate::math::least_squares::LinearFit, FitError> {
        let rows = self.samples.iter().zip(self.weights).map(|(rgb, weight)| {
            let mut row = terms(*rgb);
            row.as_mut().iter_mut().for_each(|v| *v *= weight.sqrt());
            row
        });
        let rows: Vec<R> = rows.collect();
        linear_fit(&rows, &self.scaled(self.targets), keep)
    }
}

/// XYZ from balanced RGB taken as linear sRGB, its white carried to the scene's.
fn uncorrected(white: Xyz) -> Result<DMat3, FitError> {
    let scene = bradford(srgb_white(), white).ok_or(FitError::NoWhite)?;
    Ok(scene * XYZ_FROM_SRGB)
}
