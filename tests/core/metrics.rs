//! Figures of merit against published and independently computed values, and their properties.

use chromascope_core::camera::WhiteBalanceTarget;
use chromascope_core::colorimetry::Metric;
use chromascope_core::patch_set::PatchSet;
use chromascope_core::query::metrics::{Better, Statistic};
use chromascope_core::query::{
    Ask, CameraMetric, CameraMetrics, CameraMetricsQuery, ColorTransformSpec, DifferenceError, Direct, RenderingQuery,
    Shared, WhyNot,
};
use chromascope_core::spectral::Sensor;

use crate::support::{CANON_10D, CIE_1931, REFERENCE, assert_near, chart, light, sensor, training};

fn query(sensor: Sensor, transform: &ColorTransformSpec, reference: Sensor) -> CameraMetricsQuery {
    let light = Shared::new(light("illuminants/d65.csv"));
    let rendering = |sensor: Sensor| RenderingQuery {
        sensor: Shared::new(sensor),
        light: light.clone(),
        white: WhiteBalanceTarget::UNITY,
        transform: transform.clone(),
    };
    CameraMetricsQuery { rendering: rendering(sensor), reference: rendering(reference), patches: Shared::new(chart()) }
}

fn fitted() -> ColorTransformSpec {
    ColorTransformSpec::Observer { reference: Shared::new(sensor(CIE_1931)), training: Shared::new(training()) }
}

fn value(metrics: &CameraMetrics, id: &str) -> Result<f64, WhyNot> {
    metrics.of(CameraMetric::by_id(id).unwrap()).unwrap().value
}

#[test]
fn statistics_are_those_of_numpy() {
    // numpy 2: np.mean, np.median, np.percentile(…, 95), np.max.
    let values = [3.0, 1.5, 0.25, 9.0, 4.0, 2.0];
    let expected = [3.291_666_666_666_667, 2.5, 7.75, 9.0];
    let all = [Statistic::Mean, Statistic::Median, Statistic::Percentile95, Statistic::Maximum];
    for (statistic, expected) in all.into_iter().zip(expected) {
        assert_near("statistic", statistic.over(values.to_vec()).unwrap(), expected, 1e-14);
        assert_eq!(statistic.over(Vec::new()), None);
        assert_eq!(statistic.over(vec![7.0]), Some(7.0));
    }
}

#[test]
fn each_difference_metric_has_its_statistics() {
    for (metric, entries) in Metric::ALL.iter().zip(CameraMetric::ALL.chunks(4)) {
        for (entry, end) in entries.iter().zip(["mean", "median", "p95", "max"]) {
            assert_eq!(entry.id, format!("{}-{end}", metric.id));
            assert_eq!(entry.column, format!("{}_{end}", metric.column));
            assert!(entry.symbol.starts_with(metric.symbol));
            assert_eq!((entry.decimals, entry.better), (metric.decimals, Better::Lower));
        }
    }
    for (index, metric) in CameraMetric::ALL.iter().enumerate() {
        assert_eq!(CameraMetric::by_id(metric.id), Some(*metric));
        let unique = |other: &CameraMetric| other.id != metric.id && other.column != metric.column;
        assert!(CameraMetric::ALL[..index].iter().all(unique), "{}", metric.id);
    }
}

#[test]
fn differences_add_up_and_the_worst_are_the_largest() {
    let metrics = Direct.ask(&query(sensor(CANON_10D), &fitted(), sensor(CIE_1931)));
    assert_eq!(metrics.patches.len(), 24);
    for patch in &metrics.patches {
        let [l, c, h] = patch.lch.unwrap();
        assert_near("ΔE*ab", l.hypot(c).hypot(h), patch.by_metric[1].unwrap(), 1e-12);
        assert!(patch.angle_deg.unwrap() > 0.0);
    }
    for (at, worst) in metrics.worst.iter().enumerate() {
        let values: Vec<f64> = metrics.patches.iter().map(|patch| patch.by_metric[at].unwrap()).collect();
        let found: Vec<f64> = worst.iter().map(|&patch| values[patch]).collect();
        let mut sorted = values;
        sorted.sort_by(|a, b| b.total_cmp(a));
        assert_eq!(found, sorted[..5]);
    }
}

#[test]
fn the_reference_differs_from_itself_by_nothing() {
    let metrics = Direct.ask(&query(sensor(CIE_1931), &fitted(), sensor(CIE_1931)));
    for metric in &CameraMetric::ALL[..20] {
        assert_eq!(value(&metrics, metric.id), Ok(0.0), "{}", metric.id);
    }
}

#[test]
fn undefined_differences_say_why() {
    let by_paper = |reference| Direct.ask(&query(sensor(CANON_10D), &ColorTransformSpec::Paper, sensor(reference)));
    let metrics = by_paper(REFERENCE);
    assert_eq!(value(&metrics, "delta-e2000-mean"), Err(WhyNot::Eq13));
    assert!(value(&metrics, "xy-mean").unwrap() > 0.0);
    let metrics = by_paper(CIE_1931);
    assert_eq!(value(&metrics, "xy-mean"), Err(DifferenceError::Ways.into()));
    let nothing = Shared::new(PatchSet::new([]));
    let empty = CameraMetricsQuery { patches: nothing, ..query(sensor(CANON_10D), &fitted(), sensor(CIE_1931)) };
    assert_eq!(value(&Direct.ask(&empty), "xy-max"), Err(WhyNot::NoPatches));
}
