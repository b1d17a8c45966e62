//! `compare`: cameras ranked by figures of merit, as an aligned table, as CSV and as JSON.

use std::fmt::Write as _;
use std::sync::Arc;

use chromascope_core::colorimetry::Metric;
use chromascope_core::query::metrics::{Better, rank_ranges};
use chromascope_core::query::{Ask as _, CameraMetric, MetricUncertainty, MetricValue, Shared, WhyNot};
use chromascope_core::spectral::Correlation;
use chromascope_figure::number::significant;
use chromascope_figure::{Cell, Column, Field, Table};
use clap::builder::PossibleValuesParser;
use clap::{ArgMatches, Args};
use serde_json::{Map, Value, json};

use super::arguments::{ChartArguments, CommonArguments, Form, LOCUS_K, PixelArguments, form};
use super::error::{Result, refused};
use super::request::Request;
use crate::catalog::load::LoadError;
use crate::document::{SensorId, SetKind};
use crate::figures::metrics::USUAL;
use crate::format::cut_in_middle;
use crate::results::Results;
use crate::scene::metrics::CameraFigures;
use crate::scene::tables::{self, ModelTable};
use crate::scene::uncertainty::{self, cell, in_words, rank_cell, with_nature};
use crate::scene::{Scene, SceneError};
use crate::terminal::shown_json;

/// Cameras ranked by figures of merit, with uncertainties: a table, CSV or JSON
#[derive(Debug, Args)]
#[command(after_help = examples())]
pub(super) struct CompareArguments {
    #[command(flatten)]
    common: CommonArguments,
    #[command(flatten)]
    chart: ChartArguments,
    /// Metrics in the order of the columns, or `all` [default: the usual eight]
    #[arg(long, value_name = "a,b,c", value_delimiter = ',', value_parser = metric_names([ALL]), hide_possible_values = true)]
    metrics: Vec<String>,
    /// Metric that orders the rows, best first, or `name` [default: the first of --metrics]
    #[arg(long, value_name = "METRIC", value_parser = metric_names([NAME]), hide_possible_values = true)]
    sort: Option<String>,
    /// Form of the output
    #[arg(long, value_parser = form(FORMS), default_value = "table")]
    format: Form,
    /// Temperature in kelvins of the blackbody whose place on the locus is compared [default: that of a blackbody or daylight as the
    /// illuminant, otherwise 2856]
    #[arg(long, value_name = "K")]
    temperature: Option<f64>,
    /// All built-in cameras beside those of --camera
    #[arg(long)]
    library: bool,
    /// All tables of a camera's model, and those of --camera, with what they differ by from the first: in curves, in ΔE*00 of the
    /// patches, and where a table ends above 5 % of its peak
    #[arg(long, value_name = "NAME", conflicts_with_all = ["library", "observer"])]
    tables_of: Option<String>,
    #[command(flatten)]
    pixel: PixelArguments,
}

const FORMS: [&str; 3] = [
    "Aligned columns for reading",
    "One row for each sensor, with 15 significant digits",
    "One object with conditions, metrics and values",
];

/// All metrics, in the place of their names.
const ALL: &str = "all";
/// The order of names, in the place of a metric.
const NAME: &str = "name";

/// Examples and what the numbers mean, with every metric.
fn examples() -> String {
    let statistics = Metric::ALL.len() * 4;
    let line = |(id, label): (&str, &str)| format!("\n  {id:22} {label}");
    let named = |metric: &CameraMetric| line((metric.id, metric.label));
    let list = CameraMetric::ALL[statistics..].iter().map(named).collect::<Vec<_>>().concat();
    let differences = Metric::ALL.iter().map(|metric| line((metric.id, metric.label))).collect::<Vec<_>>().concat();
    format!(
        "Examples:
  chromascope compare
  chromascope compare --camera \"Nikon D70 (A.M.P.A.S.)\" --camera mine.csv --illuminant A --metrics all
  chromascope compare --camera mine.csv --library
  chromascope compare --tables-of \"Nikon D70\" --camera measured.csv
  chromascope compare --sort metamerism-index --metrics metamerism-index,metamerism-index-min,vora,luther
  chromascope compare --correction min-delta-e --chart leaves.csv --format csv --out ranking.csv

Without --camera and --observer: all built-in cameras. Metrics of the chart's patches, each followed by -mean, -median, -p95 or -max:
{differences}

Other metrics:
{list}

The number after ± is the standard uncertainty that errors of the sensitivities cause: those that the camera's file states, otherwise
the spread between laboratories, propagated through the camera's own curves; with those that the files of light and chart state. A rank is a range where values do not differ at 95 %. A value that is undefined is –, with the reason
below.

CSV: sensor, rank_first, rank_last (by the metric of --sort); for each metric its column and the same with _uncertainty; worst_patch and its difference; origin of the
uncertainty, coverage factor, degrees of freedom, extrapolated; then the conditions. JSON: format, version, conditions, metrics,
cameras with value, uncertainty, its budget and rank of each metric or the reason for none, worst_patches, those of the largest
\u{394}E*00, and worst, the patch that differs most by the preset's metric."
    )
}

/// Names of all metrics and one more word.
fn metric_names(more: [&'static str; 1]) -> PossibleValuesParser {
    PossibleValuesParser::new(CameraMetric::ALL.iter().map(|metric| metric.id).chain(more))
}

struct Comparison {
    metrics: Vec<CameraMetric>,
    /// The metric that orders the rows; none for the order of names.
    sorted_by: Option<CameraMetric>,
    rows: Vec<Row>,
    /// Of each row with --tables-of, and the name of the table that they are compared with.
    tables: Option<(String, Vec<ModelTable>)>,
    patches: Vec<String>,
    /// Metric by which a patch is the worst.
    difference: Metric,
    /// Conditions by their heads, the temperature among them.
    conditions: Vec<(Column, String)>,
    /// Sentences on uncertainties that files state and that are not used.
    refused: Vec<String>,
}

struct Row {
    kind: SetKind,
    name: String,
    all: CameraFigures,
    /// Values of the comparison's metrics, in their order.
    values: Vec<MetricValue>,
    /// Rank by the metric that orders the rows.
    rank: Option<[usize; 2]>,
}

pub(super) fn run(arguments: &CompareArguments, matches: &ArgMatches) -> Result<()> {
    let mut request = Request::new(&arguments.common, matches)?;
    arguments.chart.set(&mut request)?;
    request.document.pixel = arguments.pixel.pixel()?;
    let results = Results::default();
    let scene = Scene { document: &request.document, catalog: &request.catalog, results: &results };
    let alone = arguments.common.sources.names_no_sensor();
    if alone || arguments.library || arguments.tables_of.is_some() {
        let own = if alone { Vec::new() } else { std::mem::take(&mut request.sources) };
        let others = match &arguments.tables_of {
            Some(name) => match scene.tables_of(name) {
                tables if tables.is_empty() => scene.tables_of(&scene.entry(SetKind::Camera, name)?.name),
                tables => tables,
            },
            None => request.catalog.of_kind(SetKind::Camera).map(|entry| entry.name.clone()).collect(),
        };
        let others = others.into_iter().map(|name| (SetKind::Camera, name)).collect();
        // Tables are compared with the model's first.
        let [first, then] = if arguments.tables_of.is_some() { [others, own] } else { [own, others] };
        request.sources = first;
        let then: Vec<_> = then.into_iter().filter(|source| !request.sources.contains(source)).collect();
        request.sources.extend(then);
    }
    if let Some(wrong) = arguments.temperature.filter(|kelvin| !(1.0..=1e15).contains(kelvin)) {
        return refused("--temperature", format!("{wrong} is not a temperature; use kelvins from 1 to 1e15"));
    }
    arguments.common.out.check(&request)?;
    let comparison = compared(&scene, &request, arguments)?;
    let text = match arguments.format {
        Form::Table => text(&comparison),
        Form::Csv => csv(&comparison),
        Form::Json => shown_json(&json(&comparison)).into_owned(),
    };
    request.say_caution(&scene)?;
    arguments.common.out.put(&text)
}

fn compared(scene: &Scene<'_>, request: &Request, arguments: &CompareArguments) -> Result<Comparison> {
    let named = |id: &str| CameraMetric::by_id(id);
    let metrics: Vec<CameraMetric> = match arguments.metrics.as_slice() {
        [] => USUAL.split(' ').filter_map(named).collect(),
        ids if ids.iter().any(|id| id == ALL) => CameraMetric::ALL.to_vec(),
        ids => ids.iter().filter_map(|id| named(id)).collect(),
    };
    let sorted_by = match arguments.sort.as_deref() {
        Some(NAME) => None,
        Some(id) => named(id),
        None => metrics.first().copied(),
    };
    let temperature = arguments.temperature.or(scene.document.radiator_k()).unwrap_or(LOCUS_K);
    let wanted = metrics.iter().copied().chain(sorted_by).collect();
    let conditions = Shared::new(scene.metrics_conditions(temperature, wanted)?);
    let query = |(kind, name): &(SetKind, String)| {
        let sensor = SensorId { kind: *kind, name: name.clone() };
        Ok(scene.figures_query(&sensor, conditions.clone())?.with_uncertainties())
    };
    let queries: Vec<_> = request.sources.iter().map(query).collect::<Result<_, SceneError>>()?;
    let found = |((kind, name), all): (&(SetKind, String), Arc<_>)| match &*all {
        Ok(all) => Ok((*kind, name.clone(), CameraFigures::clone(all))),
        Err(error) => Err(SceneError::Load { name: name.clone(), error: LoadError::clone(error) }),
    };
    let found: Vec<_> =
        request.sources.iter().zip(scene.results.ask_all(&queries)).map(found).collect::<Result<_, SceneError>>()?;
    let mut conditions = scene.conditions();
    conditions.extend(scene.metrics_constants(temperature));
    let patches = scene.patches()?.patches().iter().map(|patch| patch.name.clone()).collect();
    let cameras = request.sources.iter().filter(|(kind, _)| *kind == SetKind::Camera);
    let refused = scene.refused_uncertainties(cameras.map(|(_, name)| name.as_str()));
    let rows = rows(&found, &metrics, sorted_by);
    let tables = arguments.tables_of.as_ref().map(|_| -> Result<(String, Vec<ModelTable>), SceneError> {
        let names: Vec<String> = request.sources.iter().map(|(_, name)| name.clone()).collect();
        let made = scene.results.ask(&scene.model_tables(&names)?);
        let made = made.as_ref().as_ref().map_err(SceneError::clone)?;
        let of = |row: &Row| names.iter().position(|name| *name == row.name).map(|at| made[at].clone());
        Ok((names[0].clone(), rows.iter().filter_map(of).collect()))
    });
    Ok(Comparison {
        rows,
        tables: tables.transpose()?,
        metrics,
        sorted_by,
        patches,
        difference: scene.document.difference,
        conditions,
        refused,
    })
}

fn rows(
    found: &[(SetKind, String, CameraFigures)],
    metrics: &[CameraMetric],
    sorted_by: Option<CameraMetric>,
) -> Vec<Row> {
    let missing = MetricValue { value: Err(WhyNot::NoPatches), uncertainty: None };
    let values = |metric: CameraMetric| -> Vec<MetricValue> {
        found.iter().map(|(_, _, all)| all.of(metric).unwrap_or(missing)).collect()
    };
    let columns: Vec<_> = metrics.iter().map(|metric| values(*metric)).collect();
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
            rank: sorting_ranks.as_ref().and_then(|ranks| ranks[at]),
        }
    };
    order.into_iter().map(row).collect()
}

const VERSION: u32 = 1;
const LONGEST_NAME: usize = 40;

/// A row for each sensor; a name is cut in its middle to a number of characters.
fn table(comparison: &Comparison, longest: usize) -> Table {
    let rows = &comparison.rows;
    let names = rows.iter().map(|row| cut_in_middle(&row.name, |name| name.chars().count() <= longest).into_owned());
    let mut table = uncertainty::table(("sensor", names), &comparison.metrics, |row, metric| {
        rows[row].all.of(metric).map_or(Cell::Empty, cell)
    });
    let (at, metrics) = (table.columns.len(), rows.iter().map(|row| Some(&*row.all.metrics)));
    uncertainty::insert_worst(&mut table, at, (comparison.difference, &comparison.patches), metrics);
    if let Some((_, tables)) = &comparison.tables {
        tables::insert(&mut table, tables);
    }
    table
}

/// Aligned columns: rank, sensor, values with uncertainties; then the conditions and the reasons for missing values.
fn text(comparison: &Comparison) -> String {
    let mut table = table(comparison, LONGEST_NAME);
    table.insert(0, "rank", comparison.rows.iter().map(|row| rank_cell(row.rank)));
    table.to_text() + &notes(comparison)
}

/// Conditions, the meaning of rank and ±, and why values are missing.
fn notes(comparison: &Comparison) -> String {
    let mut text = "\n".to_owned();
    for (column, value) in &comparison.conditions {
        let unit = if column.unit == "K" { " in kelvins" } else { "" };
        let _ = writeln!(text, "{}{unit}: {value}", column.name.replace('_', " "));
    }
    if let Some(metric) = comparison.sorted_by {
        let _ =
            writeln!(text, "Rank by {}; a range where values do not differ at 95 % (k √(u₁² + u₂²)).", metric.symbol);
    }
    if let Some((first, _)) = &comparison.tables {
        let _ = writeln!(text, "First: {first}. {}", tables::COLUMNS);
    }
    let all: Vec<MetricUncertainty> = comparison.rows.iter().flat_map(uncertainties).collect();
    text.extend(Some(in_words(all)).filter(|words| !words.is_empty()).map(|words| words + "\n"));
    text.extend(comparison.refused.iter().map(|sentence| format!("{sentence}\n")));
    let mut reasons: Vec<(String, Vec<&str>)> = Vec::new();
    for row in &comparison.rows {
        for (metric, value) in comparison.metrics.iter().zip(&row.values) {
            let Err(why) = value.value else { continue };
            let reason = format!("{}: {why}", metric.symbol);
            match reasons.iter_mut().find(|(known, _)| *known == reason) {
                Some((_, names)) => names.push(&row.name),
                None => reasons.push((reason, vec![&row.name])),
            }
        }
    }
    for (reason, names) in reasons {
        let who = if names.len() == comparison.rows.len() { "all".to_owned() } else { names.join(", ") };
        let _ = writeln!(text, "– {reason} ({who})");
    }
    text
}

fn uncertainties(row: &Row) -> impl Iterator<Item = MetricUncertainty> + Clone {
    row.values.iter().filter_map(|value| value.uncertainty)
}

fn csv(comparison: &Comparison) -> String {
    let rows = &comparison.rows;
    let mut table = table(comparison, usize::MAX);
    for (end, key) in ["rank_first", "rank_last"].into_iter().enumerate() {
        let ends = rows.iter().map(|row| row.rank.map_or(Cell::Empty, |rank| rank[end].to_string().into()));
        table.insert(1 + end, key, ends);
    }
    with_nature(table, |row| uncertainties(&rows[row])).with_constants(comparison.conditions.clone()).csv(significant)
}

fn budget(of: MetricUncertainty) -> Value {
    json!({
        "source": of.source.word(),
        "correlation": of.source.correlation().map(Correlation::word),
        "coverage_factor_95": of.coverage,
        // JSON has no infinity: null.
        "degrees_of_freedom": of.freedom,
        "extrapolated": of.is_extrapolated,
        "curves": of.contributions.curves,
        "response": of.contributions.response,
        "channel_ratio": of.contributions.channel_ratio,
        "light": of.contributions.light,
        "patches": of.contributions.patches,
        "bias": of.bias,
    })
}

fn json(comparison: &Comparison) -> String {
    let metric = |metric: &CameraMetric| {
        json!({
            "id": metric.id, "label": metric.label, "symbol": metric.symbol, "unit": metric.unit,
            "better": match metric.better {
                Better::Lower => "lower",
                Better::Higher => "higher",
                Better::Neither => "neither",
            },
        })
    };
    let table = |at: usize| {
        let of = comparison.tables.as_ref().and_then(|(_, tables)| tables.get(at))?;
        let key = |field: &Field<ModelTable>| field.key.trim_start_matches("from_first_").to_owned();
        let numbers = tables::FIELDS.iter().map(|field| (key(field), json!((field.cell)(of).number())));
        let mut told: Map<String, Value> = numbers.collect();
        let end =
            |(c, nm, share): &(usize, f64, f64)| json!({ "channel": c, "wavelength_nm": nm, "share_of_peak": share });
        told.insert(tables::ENDS.to_owned(), of.ends.iter().map(end).collect());
        Some(Value::Object(told))
    };
    let ranks = |(place, metric): (usize, &CameraMetric)| {
        rank_ranges(metric.better, &comparison.rows.iter().map(|row| row.values[place]).collect::<Vec<_>>())
    };
    let ranks: Vec<_> = comparison.metrics.iter().enumerate().map(ranks).collect();
    let camera = |(at, row): (usize, &Row)| {
        let values = comparison.metrics.iter().zip(&row.values).zip(&ranks).map(|((metric, value), ranks)| {
            let rank = ranks[at];
            let told = match value.value {
                Ok(number) => {
                    let standard = value.uncertainty.map(|u| u.standard);
                    json!({ "value": number, "uncertainty": standard, "budget": value.uncertainty.map(budget), "rank": rank })
                }
                Err(why) => json!({ "reason": why.to_string() }),
            };
            (metric.id.to_owned(), told)
        });
        let worst: Vec<&String> =
            row.all.metrics.worst.iter().take(1).flatten().filter_map(|&patch| comparison.patches.get(patch)).collect();
        let place = Metric::ALL.iter().position(|metric| *metric == comparison.difference).unwrap_or(0);
        let largest = row.all.metrics.worst.get(place).and_then(|worst| worst.first()).map(|&patch| {
            let difference = row.all.metrics.patches[patch].by_metric[place].ok();
            json!({ "patch": comparison.patches.get(patch), "metric": comparison.difference.id, "difference": difference })
        });
        let mut told = json!({
            "name": row.name,
            "kind": row.kind.label(),
            "values": values.collect::<Map<String, Value>>(),
            "worst_patches": worst,
            "worst": largest,
        });
        if let Some(table) = table(at) {
            told["from_first"] = table;
        }
        told
    };
    let conditions = comparison.conditions.iter().map(|(column, value)| (column.key.clone(), json!(value)));
    let all = json!({
        "format": "chromascope-comparison",
        "version": VERSION,
        "conditions": conditions.collect::<Map<String, Value>>(),
        "sorted_by": comparison.sorted_by.map(|metric| metric.id),
        "metrics": comparison.metrics.iter().map(metric).collect::<Vec<_>>(),
        "cameras": comparison.rows.iter().enumerate().map(camera).collect::<Vec<_>>(),
    });
    format!("{all:#}\n")
}
