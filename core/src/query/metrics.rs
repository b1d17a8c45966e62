//! Figures of merit of a camera under conditions: the table of metrics, and the question for all of them at once.
//!
//! A metric is one entry of [`CameraMetric::ALL`]. Documents, the command line, tables and the window list whatever stands there.

mod differences;
mod table;

use super::ask::{Ask, Query};
use super::compare::DifferenceError;
use super::patches::{PatchColorsQuery, RenderingQuery};
use super::shared::Shared;
use crate::camera::RenderingError;
use crate::patch_set::PatchSet;

pub use differences::{PatchDifferences, Statistic, WORST};
pub use table::{Better, CameraMetric, MetricGroup};

/// Reason for no value of a metric.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum WhyNot {
    /// The sensor or the reference cannot be shown under these conditions.
    #[error(transparent)]
    Rendering(#[from] RenderingError),
    /// The sensor cannot be compared with the reference.
    #[error(transparent)]
    Difference(#[from] DifferenceError),
    /// Eq 13 takes any RGB as sRGB: a formula of L*a*b* gives a number there, but no CIE color difference.
    #[error("Eq 13 takes RGB as sRGB, so ΔE* is undefined; choose a fitted color transform")]
    Eq13,
    /// A statistic of nothing.
    #[error("the chart has no patches")]
    NoPatches,
}

/// Figures of merit of one camera under one set of conditions.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct CameraMetricsQuery {
    /// The camera and its color transform.
    pub rendering: RenderingQuery,
    /// The reference observer under the same conditions.
    pub reference: RenderingQuery,
    /// The patches that differences are taken over.
    pub patches: Shared<PatchSet>,
}

/// Value of a metric with its uncertainty.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MetricValue {
    /// The value in the metric's unit, or the reason for none.
    pub value: Result<f64, WhyNot>,
    /// Standard uncertainty that the sensitivities' own uncertainty causes, in the metric's unit; none where it is unknown.
    pub uncertainty: Option<f64>,
}

/// All figures of merit of one camera.
#[derive(Clone, Debug, PartialEq)]
pub struct CameraMetrics {
    /// Values in the order of [`CameraMetric::ALL`].
    pub values: Vec<MetricValue>,
    /// Differences of each patch from the reference, in the order of the chart; empty where the camera cannot be shown.
    pub patches: Vec<PatchDifferences>,
    /// For each metric of `Metric::ALL` the patches with the largest differences, largest first, at most [`WORST`].
    pub worst: Vec<Vec<usize>>,
}

impl CameraMetrics {
    /// Value of a metric.
    pub fn of(&self, metric: CameraMetric) -> Option<MetricValue> {
        let at = CameraMetric::ALL.iter().position(|entry| *entry == metric)?;
        self.values.get(at).copied()
    }
}

impl Query for CameraMetricsQuery {
    type Answer = CameraMetrics;
    const NAME: &'static str = "camera metrics";

    fn answer(&self, ask: &impl Ask) -> CameraMetrics {
        let patches = self.patch_differences(ask);
        let evidence = Evidence { patches: patches.as_ref().map(Vec::as_slice).map_err(|&e| e) };
        let value = |metric: &CameraMetric| MetricValue { value: metric.evaluate(&evidence), uncertainty: None };
        let values = CameraMetric::ALL.iter().map(value).collect();
        let patches = patches.unwrap_or_default();
        CameraMetrics { values, worst: differences::worst(&patches), patches }
    }
}

impl CameraMetricsQuery {
    /// Differences of each patch from the reference.
    fn patch_differences(&self, ask: &impl Ask) -> Result<Vec<PatchDifferences>, WhyNot> {
        let colors = |rendering: &RenderingQuery| {
            let (rendering, patches) = (rendering.clone(), self.patches.clone());
            ask.ask(&PatchColorsQuery { rendering, patches })
        };
        let (reference, sample) = (colors(&self.reference), colors(&self.rendering));
        let reference = (*reference).as_ref().map_err(|&e| e)?;
        let sample = (*sample).as_ref().map_err(|&e| e)?;
        let way = differences::Way::new(&self.rendering, &self.reference);
        Ok(reference.iter().zip(sample).map(|(reference, sample)| way.differences(reference, sample)).collect())
    }
}

/// All that metrics are computed from.
#[derive(Clone, Copy, Debug)]
struct Evidence<'a> {
    /// Differences of each patch.
    patches: Result<&'a [PatchDifferences], WhyNot>,
}
