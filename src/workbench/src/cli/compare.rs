//! Cameras ranked by figures of merit.

pub(super) mod arguments;
mod output;

use chromascope_core::query::metrics::rank_ranges;
use chromascope_core::query::{Ask as _, CameraMetric, CameraMetricsQuery, MetricValue};
use clap::ArgMatches;

use self::arguments::{ALL, CompareArguments, Format, NAME, USUAL};
use super::error::CliError;
use super::outputs;
use super::pixel::LOCUS_K;
use super::request::Request;
use super::tables;
use crate::document::SetKind;
use crate::results::Results;
use crate::scene::conditions::CONDITIONS;
use crate::scene::metrics::CameraFigures;
use crate::scene::{Scene, SceneError};
use crate::terminal::shown_json;

/// A ranking: sensors in order, with their values.
struct Comparison {
    metrics: Vec<CameraMetric>,
    /// The metric that orders the rows; none for the order of names.
    sorted_by: Option<CameraMetric>,
    rows: Vec<Row>,
    /// Names of the patches.
    patches: Vec<String>,
    /// Conditions by their heads, the temperature among them.
    conditions: Vec<(&'static str, String)>,
}

/// One sensor.
struct Row {
    kind: SetKind,
    name: String,
    all: CameraFigures,
    /// Values of the comparison's metrics, in their order.
    values: Vec<MetricValue>,
    /// Their ranks from 1, as ranges.
    ranks: Vec<Option<[usize; 2]>>,
    /// Rank by the metric that orders the rows.
    rank: Option<[usize; 2]>,
}

/// Ranks the cameras and writes them.
pub(super) fn run(arguments: &CompareArguments, matches: &ArgMatches) -> Result<(), CliError> {
    let mut request = Request::new(&arguments.common, matches)?;
    request.values = arguments.values;
    request.set_chart(arguments.chart.as_deref())?;
    if arguments.common.sources.names_no_sensor() {
        let cameras = request.catalog.of_kind(SetKind::Camera);
        request.sources = cameras.map(|entry| (SetKind::Camera, entry.name.clone())).collect();
    }
    request.document.pixel = arguments.pixel.pixel()?;
    if let Some(wrong) = arguments.temperature.filter(|kelvin| !(1.0..=1e15).contains(kelvin)) {
        let reason = format!("{wrong} is not a temperature; use kelvins from 1 to 1e15");
        return Err(CliError::Argument { argument: "--temperature", reason });
    }
    tables::check_out(&arguments.common, &request)?;
    let results = Results::default();
    let scene = Scene { document: &request.document, catalog: &request.catalog, results: &results };
    let comparison = compared(&scene, &request, arguments)?;
    let text = match arguments.format {
        Format::Table => output::table(&comparison),
        Format::Csv => output::csv(&comparison),
        Format::Json => shown_json(&output::json(&comparison)).into_owned(),
    };
    tables::say_caution(&scene, &request)?;
    outputs::put(&text, arguments.common.out.as_deref())
}

fn compared(scene: &Scene<'_>, request: &Request, arguments: &CompareArguments) -> Result<Comparison, CliError> {
    let named = |id: &str| CameraMetric::by_id(id);
    let metrics: Vec<CameraMetric> = match arguments.metrics.as_slice() {
        [] => USUAL.iter().filter_map(|id| named(id)).collect(),
        ids if ids.iter().any(|id| id == ALL) => CameraMetric::ALL.to_vec(),
        ids => ids.iter().filter_map(|id| named(id)).collect(),
    };
    let sorted_by = match arguments.sort.as_deref() {
        Some(NAME) => None,
        Some(id) => named(id),
        None => metrics.first().copied(),
    };
    let temperature = arguments.temperature.or(scene.document.radiator_k()).unwrap_or(LOCUS_K);
    let query = |(kind, name): &(SetKind, String)| scene.camera_metrics_query_at(*kind, name, temperature);
    let queries: Vec<_> = request.sources.iter().map(query).collect::<Result<_, SceneError>>()?;
    let uncertainty = |((kind, name), query): (&(SetKind, String), &CameraMetricsQuery)| {
        scene.metric_uncertainties_query(*kind, name, query.clone())
    };
    let uncertainties: Vec<_> =
        request.sources.iter().zip(&queries).map(uncertainty).collect::<Result<_, SceneError>>()?;
    let figures = scene.results.ask_all(&queries).into_iter().zip(scene.results.ask_all(&uncertainties));
    let figures = figures.map(|(metrics, all)| CameraFigures { metrics, uncertainties: Some(all) });
    let found: Vec<_> =
        request.sources.iter().cloned().zip(figures).map(|((kind, name), all)| (kind, name, all)).collect();
    let mut conditions: Vec<_> = CONDITIONS.into_iter().zip(scene.conditions()).collect();
    conditions.extend(scene.metrics_constants(temperature));
    let patches = scene.patches()?.patches().iter().map(|patch| patch.name.clone()).collect();
    Ok(Comparison { rows: rows(&found, &metrics, sorted_by), metrics, sorted_by, patches, conditions })
}

/// The rows in order, with ranks.
fn rows(
    found: &[(SetKind, String, CameraFigures)],
    metrics: &[CameraMetric],
    sorted_by: Option<CameraMetric>,
) -> Vec<Row> {
    let missing = MetricValue { value: Err(chromascope_core::query::WhyNot::NoPatches), uncertainty: None };
    let values = |metric: CameraMetric| -> Vec<MetricValue> {
        found.iter().map(|(_, _, all)| all.of(metric).unwrap_or(missing)).collect()
    };
    let columns: Vec<_> = metrics.iter().map(|metric| values(*metric)).collect();
    let ranks: Vec<_> =
        metrics.iter().zip(&columns).map(|(metric, values)| rank_ranges(metric.better, values)).collect();
    let sorting = sorted_by.map(|metric| (metric, values(metric)));
    let sorting_ranks = sorting.as_ref().map(|(metric, values)| rank_ranges(metric.better, values));
    let merit = |at: usize| {
        let (metric, values) = sorting.as_ref()?;
        let value = values[at].value.ok()?;
        // What ranks nothing is ordered by its value.
        Some(metric.better.merit(value).unwrap_or(value))
    };
    let mut order: Vec<(usize, Option<f64>)> = (0..found.len()).map(|at| (at, merit(at))).collect();
    order.sort_by(|a, b| match (a.1, b.1) {
        (Some(a), Some(b)) => a.total_cmp(&b),
        (a, b) => a.is_none().cmp(&b.is_none()),
    });
    let row = |(at, _): (usize, Option<f64>)| {
        let (kind, name, all) = &found[at];
        Row {
            kind: *kind,
            name: name.clone(),
            all: all.clone(),
            values: columns.iter().map(|values| values[at]).collect(),
            ranks: ranks.iter().map(|ranks| ranks[at]).collect(),
            rank: sorting_ranks.as_ref().and_then(|ranks| ranks[at]),
        }
    };
    order.into_iter().map(row).collect()
}
