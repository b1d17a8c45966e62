//! Figures of merit of a camera under conditions: the table of metrics, and the query for all of them together.
//!
//! A metric is one entry of [`CameraMetric::ALL`]. Documents, the command line, tables and the window list whatever stands there.

mod differences;
mod evidence;
mod table;
mod uncertainty;

use super::ask::{Ask, Query};
use super::compare::DifferenceError;
use super::patches::RenderingQuery;
use super::shared::Shared;
use crate::camera::RenderingError;
use crate::camera::quality::Electrons;
use crate::patch_set::PatchSet;
use crate::units::Kelvin;

pub use differences::{PatchDifferences, Statistic, WORST};
pub use evidence::{IndexConditions, LocusDeviationQuery, MetamerismIndexQuery, SpaceQualityQuery};
pub use table::{Better, CameraMetric, MetricGroup};
pub use uncertainty::{Replicates, distinguishable, rank_ranges};

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
    /// A color or a locus that is not on the diagram.
    #[error("the blackbody has no chromaticity on one of the loci; choose another temperature")]
    NoLocus,
    /// A meaningless color temperature.
    #[error(
        "the color is farther than 0.05 in CIE 1960 u, v from the reference's locus, or beyond 500 K to 100 000 K there, \
         so it has no correlated color temperature"
    )]
    NoCct,
    /// Curves that span less than three dimensions.
    #[error("the three curves are linearly dependent")]
    Dependent,
    /// Tristimulus values have no noise of channels.
    #[error("noise is that of camera RGB; an observer has none")]
    NoChannels,
    /// The table does not hold the ratio between the channels.
    #[error("the table scales each channel to the same maximum, so the balance gains of the camera are unknown")]
    ChannelScale,
    /// Noise in electrons needs electrons.
    #[error("the full-well capacity is not given")]
    NoElectrons,
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
    /// Temperature of the blackbody whose place on the locus is compared.
    pub temperature: Kelvin,
    /// Light and patches of the metamerism index.
    pub index: IndexConditions,
    /// The camera's full-well capacity and read noise, if known.
    pub electrons: Option<Electrons>,
    /// Tables of the same models, whose spread is the uncertainty.
    pub replicates: Shared<Replicates>,
    /// The model among [`Self::replicates`] that the camera is, if it is one.
    pub model: Option<usize>,
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
