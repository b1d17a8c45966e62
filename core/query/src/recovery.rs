//! Sensitivities from charts as a query: everything that is shown of a camera that was measured so.

use super::ask::{Ask, Query, Shared};
use chromascope_color::correction::root_polynomial::Degree;
use chromascope_color::correction::{Correction, CorrectionMethod};
use chromascope_color::light::DaylightBasis;
use chromascope_color::patch_set::PatchSet;
use chromascope_color::recovery::{ChartRecovery, Library, RecoveryError, Shot, ShotProfile, left_out};
use chromascope_color::spectral::{GridSpectrum, Quantity, Sensor};
use chromascope_color::units::Kelvin;
use rayon::prelude::*;
use std::sync::Arc;

/// Standard deviation of daylight's reciprocal temperature about the best of steps of 20, in mireds.
const MIREDS: f64 = 15.0;
/// Reciprocal temperatures of daylight, in mireds, with room for its derivative.
const DAYLIGHTS: [f64; 2] = [44.0, 246.0];

/// Shot of a chart with its light.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct ChartShot {
    /// The recorded patches.
    pub shot: Shared<Shot>,
    /// True for daylight of unknown temperature: the shot's own light is then a stand-in.
    pub is_daylight: bool,
    /// Name of the light: shots under one light make one profile.
    pub light: String,
    /// Name of the chart.
    pub chart: String,
    /// Name of the picture, for reasons of refusal.
    pub picture: String,
}

/// Sensitivities from shots of a chart, with all that is known of them.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct ChartRecoveryQuery {
    /// Tables of the prior.
    pub library: Shared<Library>,
    /// Shots of one camera.
    pub shots: Vec<ChartShot>,
    /// Basis of daylight, for shots under daylight of unknown temperature.
    pub daylight: Shared<DaylightBasis>,
    /// Lights that a shot may have been taken under instead, by name: it is refused where one is far more probable.
    pub other_lights: Vec<(String, Shared<GridSpectrum>)>,
    /// Charts whose patches may have been recorded instead, by name.
    pub other_charts: Vec<(String, Shared<PatchSet>)>,
    /// CIE 1931 2°, to which profiles are fitted.
    pub observer: Shared<Sensor>,
}

/// Answer of [`ChartRecoveryQuery`].
#[derive(Clone, Debug, PartialEq)]
pub struct ChartMeasurement {
    /// Curves with bands and shares of data, residuals by patch, brightness, glare, unlikeness.
    pub recovery: ChartRecovery,
    /// The shots under the light that was found.
    pub shots: Vec<Shot>,
    /// Names of the charts of the shots, each once.
    pub charts: Vec<String>,
    /// Chart that is far more probable than the one that was named.
    pub better_chart: Option<String>,
    /// Daylight's temperature with its standard deviation in kelvins, where it was unknown.
    pub daylight: Option<[f64; 2]>,
    /// Tables by their distance from the curves, nearest first, relative to the curves' root mean square.
    pub nearest: Vec<(String, f64)>,
    /// ΔE\*00 by patch of the first shot, between recorded values and those of the curves recovered without it.
    pub left_out: Vec<(String, Option<f64>)>,
    /// Color corrections under each light, by its name, in the order of the shots: 3×3 by least squares, then a root polynomial.
    pub profiles: Vec<(String, ShotProfile)>,
}

impl ChartRecoveryQuery {
    /// Corrections of [`ChartMeasurement::profiles`]; the first goes into files.
    pub fn corrections() -> [Correction; 2] {
        let of = |method| Correction { method, ..Correction::default() };
        [CorrectionMethod::LeastSquares, CorrectionMethod::RootPolynomial(Degree::Two)].map(of)
    }

    /// The shots with daylight of a reciprocal temperature where that is unknown.
    fn at(&self, mired: f64) -> Vec<Shot> {
        let daylight = |mired: f64| {
            let light = Kelvin::from_mired(mired).ok().and_then(|kelvin| self.daylight.light(kelvin).ok());
            light.map(|light| GridSpectrum::resample(&light, Quantity::Light))
        };
        let [light, low, high] = [mired, mired - 2.0, mired + 2.0].map(daylight);
        let drift = low.zip(high).map(|(low, high)| {
            let mut pairs = low.values().iter().zip(high.values());
            GridSpectrum::from_fn(|_| pairs.next().map_or(0.0, |(low, high)| MIREDS / 4.0 * (high / low).ln()))
        });
        let shot = |given: &ChartShot| match (&light, &drift) {
            (Some(light), Some(drift)) if given.is_daylight => {
                Shot { drifts: vec![drift.clone()], ..given.shot.under(light) }
            }
            _ => (*given.shot).clone(),
        };
        self.shots.iter().map(shot).collect()
    }

    /// What else may have been recorded: the chart turned, or another light.
    fn others(&self, shots: &[Shot]) -> Vec<(String, Vec<Shot>)> {
        let turned = ("the chart turned by 180°".to_owned(), shots.iter().map(Shot::turned).collect());
        let others = match (shots, self.shots.as_slice()) {
            ([shot], [given]) => {
                let lights = self.other_lights.iter().filter(|(name, _)| *name != given.light);
                lights.map(|(name, light)| (format!("the light {name}"), vec![shot.under(light)])).collect()
            }
            _ => Vec::new(),
        };
        std::iter::once(turned).chain(others).collect()
    }

    /// Curves, the shots under their lights, and daylight's reciprocal temperature where it is unknown.
    fn recovered(&self) -> Result<(ChartRecovery, Vec<Shot>, Option<f64>), RecoveryError> {
        let mut mired = None;
        if self.shots.iter().any(|shot| shot.is_daylight) {
            let (found, near) = ChartRecovery::under_daylight(&self.library, |mired| self.at(mired))?;
            let by = found.light.first().map_or(0.0, |[t, _]| t * MIREDS);
            mired = Some((near + by).clamp(DAYLIGHTS[0], DAYLIGHTS[1]));
        }
        let shots = self.at(mired.unwrap_or_default());
        let others = self.others(&shots);
        let named = others.iter().map(|(what, shots)| (what.clone(), shots.as_slice()));
        Ok((ChartRecovery::against(&self.library, &shots, named)?, shots, mired))
    }

    /// Refuses what a shot contradicts by itself: several may hide it in curves that are unlike any camera's.
    fn each_alone(&self) -> Result<(), RecoveryError> {
        let alone = |shot: &ChartShot| match (Self { shots: vec![shot.clone()], ..self.clone() }).recovered() {
            Err(reason @ (RecoveryError::Fit { .. } | RecoveryError::Contradicted { .. })) => {
                Err(RecoveryError::Picture { picture: shot.picture.clone(), reason: Box::new(reason) })
            }
            _ => Ok(()),
        };
        let all: Vec<Result<(), RecoveryError>> = self.shots.par_iter().map(alone).collect();
        all.into_iter().collect()
    }

    /// Names that the shots have, each once.
    fn names(&self, of: impl Fn(&ChartShot) -> &String) -> Vec<String> {
        let mut names: Vec<String> = Vec::new();
        for name in self.shots.iter().map(of) {
            if !names.contains(name) {
                names.push(name.clone());
            }
        }
        names
    }

    fn profiles(&self, recovery: &ChartRecovery, shots: &[Shot]) -> Result<Vec<(String, ShotProfile)>, RecoveryError> {
        let profile = |name: String| {
            let under: Vec<usize> = (0..shots.len()).filter(|at| self.shots[*at].light == name).collect();
            let profile = ShotProfile::new(recovery, shots, &under, &self.observer, &Self::corrections())?;
            Ok((name, profile))
        };
        self.names(|shot| &shot.light).into_iter().map(profile).collect()
    }
}

impl Query for ChartRecoveryQuery {
    type Answer = Result<Arc<ChartMeasurement>, RecoveryError>;
    const NAME: &'static str = "sensitivities from a chart";
    const CAPACITY: usize = 8;

    fn answer(&self, _: &impl Ask) -> Self::Answer {
        if self.shots.len() > 1 {
            self.each_alone()?;
        }
        let (recovery, shots, mired) = self.recovered()?;
        // Modes are in the order of the shots; all stand for one temperature, each by its own shot.
        let daylight = mired.zip(recovery.light.first()).map(|(mired, [t, deviation])| {
            let kelvin = 1e6 / (mired + t * MIREDS);
            [kelvin, kelvin * kelvin * 1e-6 * deviation * MIREDS]
        });
        let others = self.other_charts.iter().filter_map(|(name, chart)| {
            let shots = shots.iter().map(|shot| shot.of_chart(chart)).collect::<Option<Vec<Shot>>>()?;
            Some((name.clone(), shots))
        });
        let others: Vec<(String, Vec<Shot>)> = others.collect();
        let others = others.iter().map(|(name, shots)| (name.clone(), shots.as_slice()));
        let better_chart = recovery.contradiction(&self.library, others).map(|(name, _)| name);
        let nearest = self.library.nearest(&recovery.curves.values);
        let nearest = nearest.into_iter().map(|(name, distance)| (name.to_owned(), distance)).collect();
        let left_out = left_out(&self.library, &shots, &self.observer)?;
        let profiles = self.profiles(&recovery, &shots)?;
        let charts = self.names(|shot| &shot.chart);
        Ok(Arc::new(ChartMeasurement { recovery, shots, charts, better_chart, daylight, nearest, left_out, profiles }))
    }
}
