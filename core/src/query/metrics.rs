//! Figures of merit of a camera under conditions: the table of metrics, and the query for all of them together.
//!
//! A metric is one entry of [`CameraMetric::ALL`]. Documents, the command line, tables and the window list whatever stands there.

mod conditions;
mod differences;
mod evidence;
mod table;
mod uncertainty;
mod value;

use super::ask::{Ask, Query};

pub use conditions::{CameraMetricsQuery, IndexConditions, Replicates};
pub use differences::{PatchDifferences, Statistic, WORST};
pub use evidence::{LocusDeviationQuery, MetamerismIndexQuery, ReferenceLocusQuery, SpaceQualityQuery};
pub use table::{Better, CameraMetric, MetricGroup};
pub use uncertainty::{distinguishable, rank_ranges};
pub use value::{MetricValue, WhyNot};

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
        self.values.get(metric.place).copied()
    }
}

impl Query for CameraMetricsQuery {
    type Answer = CameraMetrics;
    const NAME: &'static str = "camera metrics";

    fn answer(&self, ask: &impl Ask) -> CameraMetrics {
        let own = evidence::Evidence::new(self, ask);
        let uncertainties = uncertainty::standard_uncertainties(self, ask);
        let values = CameraMetric::ALL.iter().zip(uncertainties).map(|(metric, uncertainty)| {
            let value = metric.evaluate(&own);
            MetricValue { value, uncertainty: uncertainty.filter(|_| value.is_ok()) }
        });
        let values = values.collect();
        let patches = own.patches.unwrap_or_default();
        CameraMetrics { values, worst: differences::worst(&patches), patches }
    }
}
