//! Sensitivity metamerism index, as ISO 17321-1 defines it from the residual of a color correction.

use crate::camera::rendering::{RenderingError, raw, under_light, white_divisors};
use crate::colorimetry::lab::lab_from_xyz;
use crate::colorimetry::{Xyz, delta_e_1976};
use crate::correction::minimize::{Objective, Refit};
use crate::correction::{Correction, CorrectionMethod, RgbTransform, Training};
use crate::math::least_squares::FitError;
use crate::patch_set::PatchSet;
use crate::spectral::{GridSpectrum, Sensor};
use glam::DVec3;

/// Sensitivity metamerism index of a sensor.
///
/// ```text
/// SMI = 100 − 5.5 mean ΔE*ab
/// ```
/// over the patches after a 3×3 fitted over the same patches, white not kept (ISO 17321-1:2012, annex: D55, the 18 chromatic patches of
/// the `ColorChecker`). The standard leaves the fit open, so both usual ones stand here. 100 for a sensor that is a linear combination
/// of the observer's curves; negative for a sensor worse than a mean ΔE*ab of 18.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MetamerismIndex {
    /// By the matrix of least squares in XYZ.
    pub least_squares: f64,
    /// By the matrix of least mean ΔE*ab.
    pub min_delta_e: f64,
}

/// Rounds of reweighting of fits near one of minimum ΔE*ab.
const REFIT_ROUNDS: usize = 4;

/// Observer's colors of the patches: the part of an index that all sensors share.
#[derive(Clone, Debug, PartialEq)]
pub struct IndexSamples {
    white: Xyz,
    targets: Vec<DVec3>,
}

impl IndexSamples {
    /// Prepares the patches as an XYZ observer sees them under the light.
    ///
    /// # Errors
    ///
    /// [`RenderingError`] where the observer does not respond to the light.
    pub fn new(observer: &Sensor, light: &GridSpectrum, patches: &PatchSet) -> Result<Self, RenderingError> {
        let divisors = white_divisors(observer, light)?;
        let product = under_light(observer, light);
        let white = DVec3::from_array(observer.integrate(light.values())) / divisors;
        let targets = patches.patches().iter().map(|patch| raw(&product, patch.grid.values()) / divisors);
        Ok(Self { white: Xyz::from_vector(white), targets: targets.collect() })
    }

    /// The index of a sensor under the same light and patches.
    ///
    /// # Errors
    ///
    /// [`RenderingError`] where a channel does not respond to the light or the patches do not determine a matrix.
    pub fn index(
        &self,
        sensor: &Sensor,
        light: &GridSpectrum,
        patches: &PatchSet,
    ) -> Result<MetamerismIndex, RenderingError> {
        let product = under_light(sensor, light);
        let divisors = DVec3::from_array(sensor.integrate(light.values()));
        if !divisors.is_finite() || divisors.abs().min_element() == 0.0 {
            return Err(white_divisors(sensor, light).err().unwrap_or(RenderingError::NoWhite));
        }
        let samples: Vec<DVec3> =
            patches.patches().iter().map(|patch| raw(&product, patch.grid.values()) / divisors).collect();
        let by = |method| self.of(&samples, &self.fit(&samples, method)?).ok_or(RenderingError::NoWhite);
        Ok(MetamerismIndex {
            least_squares: by(CorrectionMethod::LeastSquares)?,
            min_delta_e: by(CorrectionMethod::Minimize(Objective::DeltaE1976))?,
        })
    }

    /// Transform of samples, balanced to unity, to the observer's colors.
    ///
    /// # Errors
    ///
    /// [`FitError`] where the samples do not determine one.
    pub(crate) fn fit(&self, samples: &[DVec3], method: CorrectionMethod) -> Result<RgbTransform, FitError> {
        let correction = Correction { method, keeps_white: false, ..Correction::default() };
        self.training(samples, &vec![1.0; samples.len()]).fit(&correction, self.white)
    }

    /// Fits near that of minimum ΔE*ab of these samples; none where there is no such fit.
    pub(crate) fn refit(&self, samples: &[DVec3]) -> Option<Refit> {
        let objective = Objective::DeltaE1976;
        let RgbTransform::Matrix(matrix) = self.fit(samples, CorrectionMethod::Minimize(objective)).ok()? else {
            return None;
        };
        Refit::new(
            self.training(samples, &vec![1.0; samples.len()]),
            self.white,
            false,
            (objective, REFIT_ROUNDS),
            matrix,
        )
    }

    fn training<'a>(&'a self, samples: &'a [DVec3], weights: &'a [f64]) -> Training<'a> {
        Training { samples, targets: &self.targets, weights }
    }

    /// The index of samples through a transform.
    pub(crate) fn of(&self, samples: &[DVec3], transform: &RgbTransform) -> Option<f64> {
        let lab = |xyz: DVec3| lab_from_xyz(Xyz::from_vector(xyz), self.white);
        let differences = samples.iter().zip(&self.targets).map(|(sample, target)| {
            let (found, wanted) = (lab(transform.xyz(*sample))?, lab(*target)?);
            Some(delta_e_1976(found, wanted))
        });
        let sum: f64 = differences.sum::<Option<f64>>()?;
        Some(100.0 - 5.5 * sum / samples.len() as f64)
    }
}
