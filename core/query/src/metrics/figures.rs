//! All figures of merit of a camera at once.

use super::differences::{self, PatchDifferences};
use super::evidence::Evidence;
use super::table::CameraMetric;
use super::value::{CameraMetricsQuery, MetricUncertainty, MetricValue, WhyNot};
use crate::ask::{Ask, Query};

/// All figures of merit of one camera, without their uncertainties, which take longer: see [`MetricUncertaintiesQuery`](super::MetricUncertaintiesQuery).
#[derive(Clone, Debug, PartialEq)]
pub struct CameraMetrics {
    /// Values in the order of [`CameraMetric::ALL`], or reasons for none.
    pub values: Vec<Result<f64, WhyNot>>,
    /// Differences of each patch from the reference, in the order of the chart; empty where the camera cannot be shown.
    pub patches: Vec<PatchDifferences>,
    /// For each metric of `Metric::ALL` the patches with the largest differences, largest first, at most [`WORST`](super::WORST).
    pub worst: Vec<Vec<usize>>,
}

impl CameraMetrics {
    /// Value of a metric.
    pub fn of(&self, metric: CameraMetric) -> Option<Result<f64, WhyNot>> {
        self.values.get(metric.place).copied()
    }

    /// Value of a metric with its uncertainty among those of all metrics, where they are known.
    pub fn with(
        &self,
        uncertainties: Option<&[Option<MetricUncertainty>]>,
        metric: CameraMetric,
    ) -> Option<MetricValue> {
        let value = self.of(metric)?;
        let uncertainty = uncertainties.and_then(|all| *all.get(metric.place)?).filter(|_| value.is_ok());
        Some(MetricValue { value, uncertainty })
    }
}

impl Query for CameraMetricsQuery {
    type Answer = CameraMetrics;
    const NAME: &'static str = "camera metrics";

    fn answer(&self, ask: &impl Ask) -> CameraMetrics {
        let own = Evidence::new(self, ask);
        let values = own.values(self.wanted);
        let patches = own.patches().unwrap_or_default();
        CameraMetrics { values, worst: differences::worst(&patches), patches }
    }
}
