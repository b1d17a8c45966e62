//! The table of metrics.

use super::differences::{Statistic, statistic};
use super::{Evidence, WhyNot};
use crate::colorimetry::Metric;
use std::hash::{Hash, Hasher};

/// Part of the table that a metric belongs to.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum MetricGroup {
    /// Differences of the chart's patches from the reference.
    Differences,
}

impl MetricGroup {
    /// Name in words.
    pub const fn label(self) -> &'static str {
        match self {
            Self::Differences => "Differences of patches",
        }
    }
}

/// Direction in which a metric's values improve.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Better {
    /// Smaller magnitudes are better.
    Lower,
    /// Larger values are better.
    Higher,
    /// A property, no figure of merit: not ranked.
    Neither,
}

/// A figure of merit of a camera under conditions.
#[derive(Clone, Copy, Debug)]
pub struct CameraMetric {
    /// Name in documents and on the command line.
    pub id: &'static str,
    /// Head of its column in tables.
    pub column: &'static str,
    /// Name in words.
    pub label: &'static str,
    /// Symbol.
    pub symbol: &'static str,
    /// Unit; `1` for ratios and indices.
    pub unit: &'static str,
    /// Part of the table.
    pub group: MetricGroup,
    /// Meaningful decimals.
    pub decimals: usize,
    /// Direction in which values improve.
    pub better: Better,
    evaluate: fn(&Evidence<'_>) -> Result<f64, WhyNot>,
}

impl PartialEq for CameraMetric {
    fn eq(&self, other: &Self) -> bool {
        self.id == other.id
    }
}

impl Eq for CameraMetric {}

impl Hash for CameraMetric {
    fn hash<H: Hasher>(&self, state: &mut H) {
        self.id.hash(state);
    }
}

/// The four statistics of one difference metric over the chart's patches.
macro_rules! statistics {
    ($at:literal, $id:literal, $column:literal, $symbol:literal, $decimals:literal) => {
        [
            statistics!(@ $at, Statistic::Mean, $id, "mean", "mean", $column, $symbol, $decimals),
            statistics!(@ $at, Statistic::Median, $id, "median", "median", $column, $symbol, $decimals),
            statistics!(@ $at, Statistic::Percentile95, $id, "p95", "95 %", $column, $symbol, $decimals),
            statistics!(@ $at, Statistic::Maximum, $id, "max", "max", $column, $symbol, $decimals),
        ]
    };
    (@ $at:literal, $of:expr, $id:literal, $suffix:literal, $word:literal, $column:literal, $symbol:literal, $decimals:literal) => {
        CameraMetric {
            id: concat!($id, "-", $suffix),
            column: concat!($column, "_", $suffix),
            label: concat!($symbol, " of the patches, ", $word),
            symbol: concat!($symbol, " ", $word),
            unit: "1",
            group: MetricGroup::Differences,
            decimals: $decimals,
            better: Better::Lower,
            evaluate: |evidence| statistic(evidence.patches?, $at, $of),
        }
    };
}

const DELTA_E_2000: [CameraMetric; 4] = statistics!(0, "delta-e2000", "delta_e_2000", "ΔE*00", 2);
const DELTA_E_1976: [CameraMetric; 4] = statistics!(1, "delta-e1976", "delta_e_1976", "ΔE*ab", 2);
const DELTA_E_1994: [CameraMetric; 4] = statistics!(2, "delta-e1994", "delta_e_1994", "ΔE*94", 2);
const UV_PRIME: [CameraMetric; 4] = statistics!(3, "uv-prime", "delta_uv_prime", "Δu′v′", 4);
const XY: [CameraMetric; 4] = statistics!(4, "xy", "delta_xy", "Δxy", 4);

const DIFFERENCES: [[CameraMetric; 4]; 5] = [DELTA_E_2000, DELTA_E_1976, DELTA_E_1994, UV_PRIME, XY];
// A metric that is added to the table of differences has its statistics here.
const _: () = assert!(DIFFERENCES.len() == Metric::ALL.len());

impl CameraMetric {
    /// All metrics, in the order they are listed.
    pub const ALL: &[Self] = DIFFERENCES.as_flattened();

    /// The metric of this id.
    pub fn by_id(id: &str) -> Option<Self> {
        Self::ALL.iter().copied().find(|metric| metric.id == id)
    }

    /// The value, or the reason for none.
    pub(super) fn evaluate(self, evidence: &Evidence<'_>) -> Result<f64, WhyNot> {
        (self.evaluate)(evidence)
    }
}
