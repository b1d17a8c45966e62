//! Inputs of the metrics, as separate queries, so that each is computed once whatever else changes.

use super::differences::{DifferenceConditions, PatchDifferences, Statistic};
use super::table::CameraMetric;
use super::value::{CameraMetricsQuery, IndexConditions, WhyNot};
use crate::ask::{Ask, Query, Shared};
use crate::compare::DifferenceError;
use crate::loci::LocusRulesQuery;
use crate::patches::{PatchColorsQuery, RenderingQuery};
use chromascope_color::camera::channel_ratio::has_equal_maxima;
use chromascope_color::camera::quality::{
    Electrons, IndexSamples, MetamerismIndex, NoiseAmplification, SpaceQuality, gray_snr_db,
};
use chromascope_color::camera::{LocusDeviation, LocusEvaluator, ReferenceLocus, Rendering, RenderingError};
use chromascope_color::light::RadiationConstants;
use chromascope_color::spectral::{Primaries, Sensor};
use chromascope_color::units::Kelvin;

/// Colors of the patches for the observer of the index.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub(super) struct IndexSamplesQuery(pub(super) IndexConditions);

impl Query for IndexSamplesQuery {
    type Answer = Result<IndexSamples, RenderingError>;
    const NAME: &'static str = "metamerism index samples";

    fn answer(&self, _: &impl Ask) -> Self::Answer {
        IndexSamples::new(&self.0.observer, &self.0.light, &self.0.patches)
    }
}

/// Sensitivity metamerism index of a sensor.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct MetamerismIndexQuery {
    /// The sensor.
    pub sensor: Shared<Sensor>,
    /// Observer, light and patches.
    pub conditions: IndexConditions,
}

impl Query for MetamerismIndexQuery {
    type Answer = Result<MetamerismIndex, RenderingError>;
    const NAME: &'static str = "metamerism index";

    fn answer(&self, ask: &impl Ask) -> Self::Answer {
        let samples = ask.ask(&IndexSamplesQuery(self.conditions.clone()));
        let samples = (*samples).as_ref().map_err(|&e| e)?;
        samples.index(&self.sensor, &self.conditions.light, &self.conditions.patches)
    }
}

/// Agreement of a sensor's space with an observer's; none for linearly dependent curves.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct SpaceQualityQuery {
    /// The sensor.
    pub sensor: Shared<Sensor>,
    /// The observer.
    pub observer: Shared<Sensor>,
}

impl Query for SpaceQualityQuery {
    type Answer = Option<SpaceQuality>;
    const NAME: &'static str = "space quality";

    fn answer(&self, _: &impl Ask) -> Self::Answer {
        SpaceQuality::new(&self.sensor, &self.observer)
    }
}

/// The reference's own Planckian locus.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct ReferenceLocusQuery(pub RenderingQuery);

impl Query for ReferenceLocusQuery {
    type Answer = Result<ReferenceLocus<Shared<Sensor>>, RenderingError>;
    const NAME: &'static str = "reference locus";

    fn answer(&self, ask: &impl Ask) -> Self::Answer {
        let rendering = ask.ask(&self.0);
        let rendering = (*rendering).as_ref().map_err(|&e| e)?;
        let rules = LocusRulesQuery { sensor: self.0.sensor.clone(), constants: RadiationConstants::Paper };
        Ok(ReferenceLocus::new((*ask.ask(&rules)).clone(), rendering.clone()))
    }
}

/// Error of a sensor's Planckian locus at a temperature, relative to the reference's own.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct LocusDeviationQuery {
    /// The sensor and its color transform.
    pub rendering: RenderingQuery,
    /// The reference under the same conditions.
    pub reference: RenderingQuery,
    /// The temperature.
    pub temperature: Kelvin,
}

impl Query for LocusDeviationQuery {
    type Answer = Result<LocusDeviation, WhyNot>;
    const NAME: &'static str = "locus deviation";

    fn answer(&self, ask: &impl Ask) -> Self::Answer {
        DifferenceConditions::new(&self.rendering, &self.reference).comparable?;
        let locus = ask.ask(&ReferenceLocusQuery(self.reference.clone()));
        let locus = (*locus).as_ref().map_err(|&e| e)?;
        let rendering = ask.ask(&self.rendering);
        let rendering = (*rendering).as_ref().map_err(|&e| e)?;
        // One temperature is cheaper by the sum than by rules made for it.
        let raw = LocusEvaluator::by_sum(&*self.rendering.sensor, RadiationConstants::Paper).raw(self.temperature);
        let color = rendering.blackbody(raw).uv_prime().ok_or(WhyNot::NoLocus)?;
        locus.deviation(self.temperature, color).ok_or(WhyNot::NoLocus)
    }
}

/// All that metrics of one sensor are computed from.
pub(super) struct Evidence {
    pub(super) patches: Result<Vec<PatchDifferences>, WhyNot>,
    pub(super) locus: Result<LocusDeviation, WhyNot>,
    pub(super) space: Result<SpaceQuality, WhyNot>,
    pub(super) index: Result<MetamerismIndex, WhyNot>,
    pub(super) noise: Result<NoiseAmplification, WhyNot>,
    /// Reason for no gains of raw channels.
    pub(super) scale: Result<(), WhyNot>,
    pub(super) snr_db: Result<f64, WhyNot>,
}

impl Evidence {
    pub(super) fn new(of: &CameraMetricsQuery, ask: &impl Ask) -> Self {
        let CameraMetricsQuery { rendering, reference, .. } = of.clone();
        let sensor = rendering.sensor.clone();
        let scale = channel_scale(&sensor);
        let (noise, snr_db) = noise(of, scale, ask);
        let locus = LocusDeviationQuery { rendering, reference, temperature: of.temperature };
        let space = SpaceQualityQuery { sensor: sensor.clone(), observer: of.reference.sensor.clone() };
        let index = MetamerismIndexQuery { sensor, conditions: of.index.clone() };
        Self {
            patches: patch_differences(of, ask),
            locus: *ask.ask(&locus),
            space: ask.ask(&space).ok_or(WhyNot::Dependent),
            index: (*ask.ask(&index)).map_err(WhyNot::from),
            noise,
            scale,
            snr_db,
        }
    }

    /// All metrics, in the order of [`CameraMetric::ALL`].
    pub(super) fn values(&self) -> Vec<Result<f64, WhyNot>> {
        CameraMetric::ALL.iter().map(|metric| metric.evaluate(self)).collect()
    }

    /// Statistic of the differences by the metric at this place of `Metric::ALL`.
    pub(super) fn statistic(&self, metric: usize, of: Statistic) -> Result<f64, WhyNot> {
        let patches = self.patches.as_ref().map_err(|&e| e)?;
        let values = patches.iter().map(|patch| patch.by_metric.get(metric).copied().unwrap_or(Err(WhyNot::NoPatches)));
        of.over(values.collect::<Result<_, _>>()?).ok_or(WhyNot::NoPatches)
    }

    pub(super) fn rms(&self, of: impl Fn(&PatchDifferences) -> Option<f64>) -> Result<f64, WhyNot> {
        self.mean(|patch| of(patch).map(|value| value * value)).map(f64::sqrt)
    }

    pub(super) fn mean(&self, of: impl Fn(&PatchDifferences) -> Option<f64>) -> Result<f64, WhyNot> {
        let patches = self.patches.as_ref().map_err(|&e| e)?;
        let value = |patch: &PatchDifferences| {
            // A component is missing for the reason that differences are.
            let reason = patch.by_metric.iter().find_map(|value| value.err());
            of(patch).ok_or(reason.unwrap_or(WhyNot::Difference(DifferenceError::NoChromaticity)))
        };
        let values = patches.iter().map(value).collect::<Result<Vec<f64>, _>>()?;
        Statistic::Mean.over(values).ok_or(WhyNot::NoPatches)
    }

    /// Noise gain of one row of matrix ∘ balance.
    pub(super) fn noise_row(&self, row: usize) -> Result<f64, WhyNot> {
        self.scale?;
        Ok(self.noise?.rows[row])
    }
}

fn patch_differences(of: &CameraMetricsQuery, ask: &impl Ask) -> Result<Vec<PatchDifferences>, WhyNot> {
    let colors = |rendering: &RenderingQuery| {
        let (rendering, patches) = (rendering.clone(), of.patches.clone());
        ask.ask(&PatchColorsQuery { rendering, patches })
    };
    let (reference, sample) = (colors(&of.reference), colors(&of.rendering));
    let reference = (*reference).as_ref().map_err(|&e| e)?;
    let sample = (*sample).as_ref().map_err(|&e| e)?;
    let way = DifferenceConditions::new(&of.rendering, &of.reference);
    Ok(reference.iter().zip(sample).map(|(reference, sample)| way.differences(reference, sample)).collect())
}

/// Checks that the sensor is a camera whose table does not scale each channel on its own.
pub(super) fn channel_scale(sensor: &Sensor) -> Result<(), WhyNot> {
    match sensor.primaries() {
        Primaries::Camera if has_equal_maxima(sensor) => Err(WhyNot::ChannelScale),
        Primaries::Camera => Ok(()),
        _ => Err(WhyNot::NoChannels),
    }
}

fn noise(of: &CameraMetricsQuery, scale: Result<(), WhyNot>, ask: &impl Ask) -> Noise {
    let rendering = ask.ask(&of.rendering);
    match (&*rendering, scale) {
        (_, Err(WhyNot::NoChannels)) => (Err(WhyNot::NoChannels), Err(WhyNot::NoChannels)),
        (Err(error), _) => (Err((*error).into()), Err((*error).into())),
        (Ok(rendering), _) => noise_of(rendering, of.electrons, scale),
    }
}

/// Noise gains, and the signal-to-noise ratio of a gray in decibels.
type Noise = (Result<NoiseAmplification, WhyNot>, Result<f64, WhyNot>);

pub(super) fn noise_of(rendering: &Rendering, electrons: Option<Electrons>, scale: Result<(), WhyNot>) -> Noise {
    let gains = NoiseAmplification::new(rendering).ok_or(WhyNot::Rendering(RenderingError::NoWhite));
    let snr = match electrons {
        _ if scale.is_err() => scale.map(|()| 0.0),
        None => Err(WhyNot::NoElectrons),
        Some(electrons) => gray_snr_db(rendering, electrons).ok_or(WhyNot::Rendering(RenderingError::NoWhite)),
    };
    (gains, snr)
}
