//! Uncertainty of metrics from the spread of independent tables of one camera model, and ranks that respect it.

use super::conditions::{CameraMetricsQuery, Replicates};
use super::evidence::Evidence;
use super::table::{Better, CameraMetric};
use super::value::{MetricValue, WhyNot};
use crate::query::ask::{Ask, Query};
use crate::query::patches::RenderingQuery;
use crate::query::shared::Shared;
use crate::spectral::{Primaries, Sensor};

/// Values of all metrics of one table, without uncertainties: shared by all cameras whose uncertainty depends on it.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
struct TableMetricsQuery(CameraMetricsQuery);

impl Query for TableMetricsQuery {
    type Answer = Vec<Result<f64, WhyNot>>;
    const NAME: &'static str = "metrics of a table";

    fn answer(&self, ask: &impl Ask) -> Self::Answer {
        let evidence = Evidence::new(&self.0, ask);
        CameraMetric::ALL.iter().map(|metric| metric.evaluate(&evidence)).collect()
    }
}

/// Standard uncertainty of each metric; none without two independent tables of any model.
///
/// ```text
/// u² = Σ_k (m_k − m̄)² / (n − 1)                    for a model with n ≥ 2 independent tables
/// u² = Σ_j Σ_k (m_jk − m̄_j)² / Σ_j (n_j − 1)       for all others: pooled over those models, a prior
/// ```
/// m are the metric's values of the tables under the conditions of the query.
pub(super) fn standard_uncertainties(of: &CameraMetricsQuery, ask: &impl Ask) -> Vec<Option<f64>> {
    let nothing = || vec![None; CameraMetric::ALL.len()];
    if of.rendering.sensor.primaries() != Primaries::Camera {
        return nothing();
    }
    let values = |tables: &Vec<Shared<Sensor>>| -> Vec<Vec<Result<f64, WhyNot>>> {
        tables.iter().map(|sensor| (*ask.ask(&table_query(of, sensor))).clone()).collect()
    };
    let own = of.model.and_then(|model| of.replicates.models().get(model)).filter(|tables| tables.len() > 1);
    let models: Vec<_> = match own {
        Some(tables) => vec![values(tables)],
        None => of.replicates.models().iter().filter(|tables| tables.len() > 1).map(values).collect(),
    };
    (0..CameraMetric::ALL.len()).map(|metric| pooled(&models, metric)).collect()
}

/// Query for another table of the model; irrelevant fields are reset, so that equal queries compare equal.
fn table_query(of: &CameraMetricsQuery, sensor: &Shared<Sensor>) -> TableMetricsQuery {
    let rendering = RenderingQuery { sensor: sensor.clone(), ..of.rendering.clone() };
    let replicates = Shared::new(Replicates::default());
    TableMetricsQuery(CameraMetricsQuery { rendering, replicates, model: None, ..of.clone() })
}

/// Pooled standard deviation of one metric within models.
fn pooled(models: &[Vec<Vec<Result<f64, WhyNot>>>], metric: usize) -> Option<f64> {
    let (mut squares, mut freedom) = (0.0, 0);
    for tables in models {
        let values: Vec<f64> = tables.iter().filter_map(|values| values[metric].ok()).collect();
        let mean = values.iter().sum::<f64>() / values.len().max(1) as f64;
        squares += values.iter().map(|value| (value - mean).powi(2)).sum::<f64>();
        freedom += values.len().saturating_sub(1);
    }
    (freedom > 0).then(|| (squares / freedom as f64).sqrt())
}

/// True if two values differ by more than the standard uncertainty of their difference, `√(u₁² + u₂²)`; unknown uncertainties count as
/// zero.
pub fn distinguishable(a: (f64, Option<f64>), b: (f64, Option<f64>)) -> bool {
    (a.0 - b.0).abs() > a.1.unwrap_or(0.0).hypot(b.1.unwrap_or(0.0))
}

/// Rank of each value as a range from 1, best first: as many as are distinguishably better stand before it, and as many as are
/// distinguishably worse after it. None for missing values and for metrics that rank nothing.
///
/// ```text
/// [1 + #better, n − #worse],   n values
/// ```
pub fn rank_ranges(better: Better, values: &[MetricValue]) -> Vec<Option<[usize; 2]>> {
    let merit = |value: &MetricValue| Some((better.merit(value.value.ok()?)?, value.uncertainty));
    let merits: Vec<Option<(f64, Option<f64>)>> = values.iter().map(merit).collect();
    let others = || merits.iter().flatten().copied();
    let count = others().count();
    let range = |own: (f64, Option<f64>)| {
        let apart = || others().filter(move |&other| distinguishable(own, other));
        [1 + apart().filter(|other| other.0 < own.0).count(), count - apart().filter(|other| other.0 > own.0).count()]
    };
    merits.iter().map(|own| own.map(range)).collect()
}
