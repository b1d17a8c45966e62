//! Inputs of the metrics, as separate queries, so that each is computed once whatever else changes.

use super::differences::{DifferenceConditions, PatchDifferences, Seen, Statistic};
use super::table::CameraMetric;
use super::value::{CameraMetricsQuery, IndexConditions, MetricSet, WhyNot};
use crate::ask::{Ask, Query, Shared};
use crate::compare::DifferenceError;
use crate::loci::LocusRulesQuery;
use crate::patches::{PatchColor, PatchColorsQuery, RenderingQuery};
use chromascope_color::camera::channel_ratio::has_equal_maxima;
use chromascope_color::camera::quality::{
    Electrons, IndexSamples, NoiseAmplification, ObserverSpace, SpaceQuality, curves, gray_snr_db,
};
use chromascope_color::camera::{LocusDeviation, LocusEvaluator, ReferenceLocus, Rendering, RenderingError};
use chromascope_color::colorimetry::Metric;
use chromascope_color::correction::minimize::Objective;
use chromascope_color::correction::{CorrectionMethod, RgbTransform};
use chromascope_color::light::RadiationConstants;
use chromascope_color::spectral::{Primaries, Sensor};
use chromascope_color::units::Kelvin;
use std::cell::{LazyCell, OnceCell};
use std::sync::Arc;

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

/// Sensitivity metamerism index of a sensor, with the transform of its fit.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct MetamerismIndexQuery {
    /// The sensor.
    pub sensor: Shared<Sensor>,
    /// Observer, light and patches.
    pub conditions: IndexConditions,
    /// Fit.
    pub method: CorrectionMethod,
}

/// Fits of the two metamerism indices.
pub(super) const INDEX_METHODS: [CorrectionMethod; 2] =
    [CorrectionMethod::LeastSquares, CorrectionMethod::Minimize(Objective::DeltaE1976)];

impl Query for MetamerismIndexQuery {
    type Answer = Result<(f64, RgbTransform), RenderingError>;
    const NAME: &'static str = "metamerism index";

    fn answer(&self, ask: &impl Ask) -> Self::Answer {
        let samples = ask.ask(&IndexSamplesQuery(self.conditions.clone()));
        let samples = (*samples).as_ref().map_err(|&e| e)?;
        samples.index(&self.sensor, &self.conditions.light, &self.conditions.patches, self.method)
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
        ObserverSpace::new(&self.observer)?.quality(&curves(&self.sensor))
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

/// A part of what metrics are computed from, made when the first metric asks for it.
pub(super) type Part<'a, T> = LazyCell<Result<T, WhyNot>, Box<dyn FnOnce() -> Result<T, WhyNot> + 'a>>;

pub(super) fn part<'a, T>(make: impl FnOnce() -> Result<T, WhyNot> + 'a) -> Part<'a, T> {
    LazyCell::new(Box::new(make))
}

/// Colors of patches.
type Colors = Result<Vec<PatchColor>, RenderingError>;

/// All that metrics of one sensor are computed from.
pub(super) struct Evidence<'a> {
    pub(super) way: DifferenceConditions,
    pub(super) reference: Arc<Colors>,
    /// Differences by each of `Metric::ALL`.
    pub(super) by_metric: [OnceCell<Result<Vec<f64>, WhyNot>>; Metric::ALL.len()],
    pub(super) colors: Part<'a, Vec<Seen>>,
    pub(super) locus: Part<'a, LocusDeviation>,
    pub(super) space: Part<'a, SpaceQuality>,
    /// By [`INDEX_METHODS`].
    pub(super) index: [Part<'a, f64>; 2],
    pub(super) noise: Part<'a, NoiseAmplification>,
    /// Reason for no gains of raw channels.
    pub(super) scale: Result<(), WhyNot>,
    pub(super) snr_db: Part<'a, f64>,
}

impl<'a> Evidence<'a> {
    /// Evidence whose parts are missing.
    pub(super) fn none(way: DifferenceConditions, reference: Arc<Colors>, scale: Result<(), WhyNot>) -> Self {
        const NONE: Result<f64, WhyNot> = Err(WhyNot::NoPatches);
        Self {
            way,
            reference,
            by_metric: Default::default(),
            colors: part(|| Err(WhyNot::NoPatches)),
            locus: part(|| Err(WhyNot::NoPatches)),
            space: part(|| Err(WhyNot::NoPatches)),
            index: [part(|| NONE), part(|| NONE)],
            noise: part(|| Err(WhyNot::NoPatches)),
            scale,
            snr_db: part(|| NONE),
        }
    }

    pub(super) fn new(of: &'a CameraMetricsQuery, ask: &'a impl Ask) -> Self {
        let sensor = &of.rendering.sensor;
        let scale = channel_scale(sensor);
        let rendering = move || match scale {
            Err(WhyNot::NoChannels) => Err(WhyNot::NoChannels),
            _ => (*ask.ask(&of.rendering)).clone().map_err(WhyNot::from),
        };
        let colors = |rendering: &RenderingQuery| {
            let (rendering, patches) = (rendering.clone(), of.patches.clone());
            ask.ask(&PatchColorsQuery { rendering, patches })
        };
        let way = DifferenceConditions::new(&of.rendering, &of.reference);
        Self {
            colors: part(move || {
                Ok((*colors(&of.rendering)).as_ref().map_err(|&e| e)?.iter().map(Seen::from).collect())
            }),
            locus: part(|| {
                let (rendering, reference) = (of.rendering.clone(), of.reference.clone());
                *ask.ask(&LocusDeviationQuery { rendering, reference, temperature: of.temperature })
            }),
            space: part(|| {
                let observer = of.reference.sensor.clone();
                ask.ask(&SpaceQualityQuery { sensor: sensor.clone(), observer }).ok_or(WhyNot::Dependent)
            }),
            index: INDEX_METHODS.map(|method| {
                part(move || {
                    let query = MetamerismIndexQuery { sensor: sensor.clone(), conditions: of.index.clone(), method };
                    Ok((*ask.ask(&query)).as_ref().map_err(|&e| e)?.0)
                })
            }),
            noise: part(move || gains(&rendering()?)),
            snr_db: part(move || snr_db(&rendering()?, of.electrons, scale)),
            ..Self::none(way, colors(&of.reference), scale)
        }
    }

    /// The metrics that are asked for, in the order of [`CameraMetric::ALL`].
    pub(super) fn values(&self, wanted: MetricSet) -> Vec<Result<f64, WhyNot>> {
        let value = |&metric: &CameraMetric| {
            if wanted.contains(metric) { metric.evaluate(self) } else { Err(WhyNot::NotAsked) }
        };
        CameraMetric::ALL.iter().map(value).collect()
    }

    /// Differences of the patches.
    pub(super) fn patches(&self) -> Result<Vec<PatchDifferences>, WhyNot> {
        self.of_pairs(|reference, sample| Ok(self.way.differences(reference, sample)))
    }

    fn of_pairs<T>(&self, of: impl Fn(&PatchColor, &Seen) -> Result<T, WhyNot>) -> Result<Vec<T>, WhyNot> {
        let reference = (*self.reference).as_ref().map_err(|&e| e)?;
        let colors = self.colors.as_ref().map_err(|&e| e)?;
        reference.iter().zip(colors).map(|(reference, sample)| of(reference, sample)).collect()
    }

    /// Statistic of the differences by the metric at this place of `Metric::ALL`.
    pub(super) fn statistic(&self, metric: usize, of: Statistic) -> Result<f64, WhyNot> {
        let values = self.by_metric[metric].get_or_init(|| {
            let reference = (*self.reference).as_ref().map_err(|&e| e)?;
            let colors = self.colors.as_ref().map_err(|&e| e)?;
            self.way.each(Metric::ALL[metric], reference, colors)
        });
        of.over(values.as_ref().map_err(|&e| e)?).ok_or(WhyNot::NoPatches)
    }

    /// Root mean square of ΔL\*, ΔC\*ab or ΔH\*ab.
    pub(super) fn rms(&self, component: usize) -> Result<f64, WhyNot> {
        self.mean(|way, reference, sample| Some(way.lch(reference, sample)?[component].powi(2))).map(f64::sqrt)
    }

    pub(super) fn mean(
        &self,
        of: impl Fn(&DifferenceConditions, &PatchColor, &Seen) -> Option<f64>,
    ) -> Result<f64, WhyNot> {
        let values = self.of_pairs(|reference, sample| {
            // A component is missing for the reason that differences are.
            let reason = || self.way.differences(reference, sample).by_metric.iter().find_map(|value| value.err());
            let unknown = WhyNot::Difference(DifferenceError::NoChromaticity);
            of(&self.way, reference, sample).ok_or_else(|| reason().unwrap_or(unknown))
        });
        Statistic::Mean.over(&values?).ok_or(WhyNot::NoPatches)
    }

    /// Noise gain of one row of matrix ∘ balance.
    pub(super) fn noise_row(&self, row: usize) -> Result<f64, WhyNot> {
        self.scale?;
        Ok((*self.noise)?.rows[row])
    }
}

/// Checks that the sensor is a camera whose table does not scale each channel on its own.
pub(super) fn channel_scale(sensor: &Sensor) -> Result<(), WhyNot> {
    match sensor.primaries() {
        Primaries::Camera if has_equal_maxima(sensor) => Err(WhyNot::ChannelScale),
        Primaries::Camera => Ok(()),
        _ => Err(WhyNot::NoChannels),
    }
}

/// Noise gains.
pub(super) fn gains(rendering: &Rendering) -> Result<NoiseAmplification, WhyNot> {
    NoiseAmplification::new(rendering).ok_or(WhyNot::Rendering(RenderingError::NoWhite))
}

/// Signal-to-noise ratio of a gray in decibels.
pub(super) fn snr_db(
    rendering: &Rendering,
    electrons: Option<Electrons>,
    scale: Result<(), WhyNot>,
) -> Result<f64, WhyNot> {
    scale?;
    gray_snr_db(rendering, electrons.ok_or(WhyNot::NoElectrons)?).ok_or(WhyNot::Rendering(RenderingError::NoWhite))
}
