//! Color corrections fitted to a shot's recorded patches, beside those fitted to the recovered curves.

use glam::DVec3;

use super::chart::{ChartRecovery, RecoveryError, Shot};
use crate::colorimetry::{Metric, Stimulus, Xyz};
use crate::correction::{Correction, RgbTransform, Training};
use crate::math::least_squares::FitError;
use crate::spectral::Sensor;

/// Samples that a correction is fitted to.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum FitSource {
    /// Recorded values, each patch divided by its recovered brightness.
    Patches,
    /// Values of the recovered curves for the same patches.
    Curves,
}

/// Color correction with the ΔE\*00 of each patch.
#[derive(Clone, Debug, PartialEq)]
pub struct PatchFit {
    /// Samples.
    pub source: FitSource,
    /// Method and conditions.
    pub correction: Correction,
    /// From RGB balanced to unity to XYZ.
    pub transform: RgbTransform,
    /// ΔE\*00 of the curves' values.
    pub predicted: Vec<Option<f64>>,
    /// ΔE\*00 of the recorded values; none for a patch without all three.
    pub measured: Vec<Option<f64>>,
    /// ΔE\*00 of the recorded values through a fit to the patches of other names.
    pub left_out: Vec<Option<f64>>,
}

/// Color corrections under one light, by shots under it.
#[derive(Clone, Debug, PartialEq)]
pub struct ShotProfile {
    /// XYZ of a perfect diffuser under the light, Y = 1.
    pub white: Xyz,
    /// Raw RGB of that diffuser by the recovered curves, the largest 1.
    pub neutral: DVec3,
    /// Names of the patches, shot after shot.
    pub patches: Vec<String>,
    /// For each correction, the fit to the patches and the fit to the curves.
    pub fits: Vec<[PatchFit; 2]>,
}

/// Patch with its XYZ and balanced RGB.
pub(super) struct Sample<'a> {
    pub(super) name: &'a str,
    pub(super) target: DVec3,
    pub(super) predicted: DVec3,
    pub(super) recorded: Option<DVec3>,
}

/// XYZ of a perfect diffuser, Y = 1, and the samples of a shot of a recovery.
pub(super) fn samples<'a>(
    sensor: &Sensor,
    observer: &Sensor,
    shot: &'a Shot,
    brightness: &[f64],
) -> (DVec3, Vec<Sample<'a>>) {
    let white = DVec3::from(observer.integrate(shot.light.values()));
    let diffuser = DVec3::from(sensor.integrate(shot.light.values()));
    let sample = |(patch, bright): (&'a crate::camera::recorded::RecordedPatch, &f64)| {
        let [r, g, b] = patch.rgb.map(|signal| signal.value().ok());
        let recorded = r.zip(g).zip(b).map(|((r, g), b)| DVec3::new(r, g, b) / diffuser / *bright);
        let predicted = DVec3::from(sensor.integrate(patch.radiance.values())) / diffuser;
        let target = DVec3::from(observer.integrate(patch.radiance.values())) / white.y;
        Sample { name: &patch.name, target, predicted, recorded }
    };
    let mut all: Vec<Sample<'_>> = shot.patches.iter().zip(brightness).map(sample).collect();
    // The unit of the recorded values is that of the exposure.
    let logs = all.iter().filter_map(|s| Some((s.recorded? / s.predicted).to_array().map(f64::ln)));
    let logs: Vec<f64> = logs.flatten().filter(|log| log.is_finite()).collect();
    let scale = (-logs.iter().sum::<f64>() / logs.len().max(1) as f64).exp();
    for sample in &mut all {
        sample.recorded = sample.recorded.map(|rgb| rgb * scale);
    }
    (white / white.y, all)
}

/// CIEDE2000 under a white.
pub(super) fn difference(a: DVec3, b: DVec3, white: DVec3) -> Option<f64> {
    let stimulus = |xyz: DVec3| Stimulus::new(Xyz::from_vector(xyz), Xyz::from_vector(white));
    Metric::DELTA_E_2000.between(&stimulus(a), &stimulus(b))
}

/// Fit of a correction to pairs of balanced RGB and XYZ.
pub(super) fn fitted(
    pairs: impl Iterator<Item = (DVec3, DVec3)>,
    correction: &Correction,
    white: DVec3,
) -> Result<RgbTransform, FitError> {
    let (samples, targets): (Vec<DVec3>, Vec<DVec3>) = pairs.unzip();
    let weights = vec![1.0; samples.len()];
    Training { samples: &samples, targets: &targets, weights: &weights }.fit(correction, Xyz::from_vector(white))
}

impl ShotProfile {
    /// Fits corrections to those of the shots that were recorded under one light, `under`.
    ///
    /// # Errors
    /// [`RecoveryError`] where the patches do not determine a correction.
    pub fn new(
        recovery: &ChartRecovery,
        shots: &[Shot],
        under: &[usize],
        observer: &Sensor,
        corrections: &[Correction],
    ) -> Result<Self, RecoveryError> {
        let sensor = recovery.curves.sensor().map_err(|_| RecoveryError::Unsolved)?;
        let (mut white, mut neutral, mut all) = (DVec3::ONE, DVec3::ONE, Vec::new());
        for (shot, brightness) in under.iter().filter_map(|at| Some((shots.get(*at)?, recovery.brightness.get(*at)?))) {
            let (of_light, samples) = samples(&sensor, observer, shot, brightness);
            (white, neutral) = (of_light, DVec3::from(sensor.integrate(shot.light.values())));
            all.extend(samples);
        }
        let one = |correction: &Correction, source: FitSource| -> Result<PatchFit, FitError> {
            let sample = |s: &Sample<'_>| match source {
                FitSource::Patches => s.recorded,
                FitSource::Curves => Some(s.predicted),
            };
            let without = |name: Option<&str>| {
                let kept = all.iter().filter(|s| Some(s.name) != name);
                fitted(kept.filter_map(|s| Some((sample(s)?, s.target))), correction, white)
            };
            let transform = without(None)?;
            let error = |by: &RgbTransform, s: &Sample<'_>, rgb: DVec3| difference(s.target, by.xyz(rgb), white);
            Ok(PatchFit {
                source,
                correction: *correction,
                predicted: all.iter().map(|s| error(&transform, s, s.predicted)).collect(),
                measured: all.iter().map(|s| error(&transform, s, s.recorded?)).collect(),
                left_out: all.iter().map(|s| error(&without(Some(s.name)).ok()?, s, s.recorded?)).collect(),
                transform,
            })
        };
        let both = |correction| Ok([one(correction, FitSource::Patches)?, one(correction, FitSource::Curves)?]);
        let fits = corrections.iter().map(both).collect::<Result<_, FitError>>()?;
        let patches = all.iter().map(|s| s.name.to_owned()).collect();
        Ok(Self { white: Xyz::from_vector(white), neutral: neutral / neutral.max_element(), patches, fits })
    }
}
