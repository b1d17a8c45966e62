//! Figures of merit of a camera under conditions: the table of metrics, and the query for all of them together.
//!
//! A metric is one entry of [`CameraMetric::ALL`]. Documents, the command line, tables and the window list whatever stands there.

mod differences;
mod evidence;
mod figures;
mod perturbed;
mod stimulus;
mod table;
mod uncertainty;
mod value;

pub use differences::{PatchDifferences, Statistic, WORST};
pub use evidence::{LocusDeviationQuery, MetamerismIndexQuery, ReferenceLocusQuery, SpaceQualityQuery};
pub use figures::CameraMetrics;
pub use stimulus::LightUncertainty;
pub use table::{Better, CameraMetric, Difference, MetricGroup, rank_ranges};
pub use uncertainty::{MetricUncertaintiesQuery, OwnUncertainties};
pub use value::{
    CameraMetricsQuery, Contributions, IndexConditions, MetricSet, MetricUncertainty, MetricValue, UncertaintySource,
    WhyNot,
};
