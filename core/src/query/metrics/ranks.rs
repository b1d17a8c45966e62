//! Differences and ranks of metrics that respect the uncertainty.

use super::table::Better;
use super::value::{MetricUncertainty, MetricValue};

/// Difference of two values of one metric under the same conditions, with its uncertainty.
///
/// ```text
/// u = √(u₁² + u₂²),   significant where |x₁ − x₂| > k u
/// ```
/// Errors of the two cameras are taken as independent, which is conservative for tables of one laboratory: they share some. k is the larger
/// of the two coverage factors; an uncertainty that is not known counts as zero.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Difference {
    /// First less second.
    pub value: f64,
    /// Standard uncertainty, if either has one.
    pub standard: Option<f64>,
    /// Coverage factor for 95 %.
    pub coverage: f64,
}

impl Difference {
    /// Difference of two values; none where one is missing.
    pub fn new(a: MetricValue, b: MetricValue) -> Option<Self> {
        Some(Self::of((a.value.ok()?, a.uncertainty), (b.value.ok()?, b.uncertainty)))
    }

    fn of(a: (f64, Option<MetricUncertainty>), b: (f64, Option<MetricUncertainty>)) -> Self {
        let known = || [a.1, b.1].into_iter().flatten();
        let standard = known().map(|u| u.standard).reduce(f64::hypot);
        Self { value: a.0 - b.0, standard, coverage: known().map(|u| u.coverage).fold(0.0, f64::max) }
    }

    /// True if the difference exceeds its expanded uncertainty: a claim at 95 %.
    pub fn is_significant(self) -> bool {
        self.value.abs() > self.coverage * self.standard.unwrap_or(0.0)
    }
}

/// Rank of each value as a range from 1, best first: as many as are significantly better stand before it, and as many as are significantly
/// worse after it. None for missing values and for metrics that rank nothing.
///
/// ```text
/// [1 + #better, n − #worse],   n values
/// ```
pub fn rank_ranges(better: Better, values: &[MetricValue]) -> Vec<Option<[usize; 2]>> {
    let merit = |value: &MetricValue| Some((better.merit(value.value.ok()?)?, value.uncertainty));
    let merits: Vec<Option<(f64, Option<MetricUncertainty>)>> = values.iter().map(merit).collect();
    let others = || merits.iter().flatten().copied();
    let count = others().count();
    let range = |own: (f64, Option<MetricUncertainty>)| {
        let apart = || others().filter(move |&other| Difference::of(own, other).is_significant());
        [1 + apart().filter(|other| other.0 < own.0).count(), count - apart().filter(|other| other.0 > own.0).count()]
    };
    merits.iter().map(|own| own.map(range)).collect()
}
