//! Figures of merit of cameras: tables, ranks, the differences of two cameras, and cameras in order of one metric.

use chromascope_core::query::metrics::{Better, Difference, rank_ranges};
use chromascope_core::query::{CameraMetric, MetricUncertainty, MetricValue, WhyNot};
use chromascope_figure::{
    Anchor, Cell, Figure, FigureRoom, Ink, InkRole, Mark, Note, Panel, Rect, Shape, Table, Tag, TextSize, text_width,
};

use super::chromaticity::conditions;
use super::kind::FigureKind;
use super::look::{FigureLook, Sorting};
use crate::scene::Scene;
use crate::scene::metrics::{CameraFigures, Ranked};
use crate::scene::uncertainty::{self, cell, number, uncertainty, unit, with_nature};

/// Id of the table of cameras in what is saved between runs.
pub const TABLE: &str = "Metrics";
/// Metric that cameras are sorted by at first.
pub const FIRST: &str = "delta-e2000-mean";
/// The metric where the first has no meaning.
pub const FIRST_EQ_13: &str = "xy-mean";

/// The metric that rows are sorted by: the column's, or the first one that has a meaning under the color transform.
pub fn sorted_by(scene: &Scene<'_>, sorting: Option<&Sorting>) -> Option<CameraMetric> {
    let named = |name: &str| CameraMetric::ALL.iter().copied().find(|metric| metric.symbol == name);
    sorting.map_or_else(|| first(scene), |sorting| named(&sorting.column))
}

/// The metric that cameras are sorted by until another is chosen.
pub fn first(scene: &Scene<'_>) -> Option<CameraMetric> {
    CameraMetric::by_id(if scene.document.transform.is_eq_13() { FIRST_EQ_13 } else { FIRST })
}

pub fn value(ranked: &Ranked, camera: usize, metric: CameraMetric) -> Option<MetricValue> {
    figures(ranked, camera)?.of(metric)
}

pub fn figures(ranked: &Ranked, camera: usize) -> Option<&CameraFigures> {
    ranked.metrics.get(camera)?.as_ref()?.as_ref().ok()
}

/// True if two values differ at 95 %; none where a value is missing.
pub fn differ(a: MetricValue, b: MetricValue) -> Option<bool> {
    Difference::new(a, b).map(Difference::is_significant)
}

/// True if the first of two values is better; none where the metric ranks nothing or a value is missing.
pub fn is_better(metric: CameraMetric, a: MetricValue, b: MetricValue) -> Option<bool> {
    let (x, y) = (a.value.ok()?, b.value.ok()?);
    match metric.better {
        Better::Lower => Some(x.abs() < y.abs()),
        Better::Higher => Some(x > y),
        Better::Neither => None,
    }
}

/// Ranks of cameras as ranges from 1: no rank is claimed among values that do not differ, nor before uncertainties are known.
pub fn ranks(ranked: &Ranked, metric: CameraMetric) -> Vec<Option<[usize; 2]>> {
    let all = 0..ranked.cameras.len();
    if all.clone().filter_map(|camera| figures(ranked, camera)).any(|figures| figures.uncertainties.is_none()) {
        return all.map(|_| None).collect();
    }
    let missing = MetricValue { value: Err(WhyNot::NoPatches), uncertainty: None };
    let values = (0..ranked.cameras.len()).map(|camera| value(ranked, camera, metric).unwrap_or(missing));
    rank_ranges(metric.better, &values.collect::<Vec<_>>())
}

/// All figures of merit of all cameras, each with its uncertainty or the reason that there is none.
pub fn table(ranked: &Ranked) -> Table {
    let names = ranked.cameras.iter().map(|camera| camera.id.name.as_str());
    uncertainty::table(("camera", names), CameraMetric::ALL, |camera, metric| {
        let failed = || ranked.metrics[camera].as_ref().and_then(|made| made.as_ref().err());
        match value(ranked, camera, metric) {
            Some(value) => cell(value),
            None => failed().map_or(Cell::Empty, |why| Cell::Missing(why.clone())),
        }
    })
}

/// Uncertainties of cameras in all metrics, where they are known.
pub fn uncertainties(
    ranked: &Ranked,
    cameras: impl IntoIterator<Item = usize>,
) -> impl Iterator<Item = MetricUncertainty> {
    let all = cameras.into_iter().filter_map(|camera| figures(ranked, camera)?.uncertainties.as_ref());
    all.flat_map(|all| all.iter().copied().flatten())
}

/// Columns of the difference of two cameras, and of their values.
pub const DIFFERENCE: usize = 1;
pub const VALUES: [usize; 2] = [3, 4];

/// Two cameras head to head: each metric with the difference, the camera better by more than the uncertainty, and both values;
/// gray where the difference is within its uncertainty.
pub fn head_to_head(ranked: &Ranked, cameras: [usize; 2]) -> Table {
    let mut table = Table::new(["metric", "A − B", "better", "A", "B"]);
    for column in &mut table.columns {
        column.decimals = Some(0);
    }
    BETTER_HINT.clone_into(&mut table.columns[2].hint);
    for metric in CameraMetric::ALL {
        let values = cameras.map(|camera| value(ranked, camera, *metric));
        let pair = values[0].zip(values[1]);
        let better = pair.and_then(|(a, b)| is_better(*metric, a, b));
        let differ = pair.and_then(|(a, b)| differ(a, b));
        let words = match (better, differ, pair) {
            (None, ..) => "",
            (_, Some(false), _) => "neither",
            (Some(true), ..) => "A",
            (Some(false), _, Some((a, b))) if a.value.ok() == b.value.ok() => "neither",
            (Some(false), ..) => "B",
        };
        let hint = format!("{}. Enter or a double click sorts Metrics by it.", metric.label);
        let exact = |note: &mut Note| note.decimals = Some(metric.decimals);
        let gray = |note: &mut Note| note.is_gray = differ == Some(false);
        let [a, b] = values.map(|value| value.map_or(Cell::Empty, cell).with(exact));
        let difference = pair.and_then(|(a, b)| difference(a, b)).map_or(Cell::Empty, cell);
        table.push([
            Cell::from(format!("{} {}", metric.symbol, unit(metric)).trim_end()).with(|note| note.hint = hint),
            difference.with(exact).with(gray),
            Cell::from(words).with(gray),
            a,
            b,
        ]);
    }
    table
}

const BETTER_HINT: &str = "The better camera at 95 %: where the difference exceeds k times its standard uncertainty; neither where it does not.";

/// Difference of two values with its uncertainty, whose parts are not told apart; extrapolated where either is.
pub fn difference(a: MetricValue, b: MetricValue) -> Option<MetricValue> {
    let difference = Difference::new(a, b)?;
    let of_either = a.uncertainty.or(b.uncertainty).zip(difference.standard);
    let is_extrapolated = [a, b].iter().any(|value| value.uncertainty.is_some_and(|by| by.is_extrapolated));
    let coverage = difference.coverage;
    let uncertainty = of_either.map(|(one, standard)| MetricUncertainty { standard, coverage, is_extrapolated, ..one });
    Some(MetricValue { value: Ok(difference.value), uncertainty })
}

const WIDTH: f64 = 640.0;
const ROW: f64 = 16.0;

pub static KIND: FigureKind =
    FigureKind::new("metrics", "Cameras ranked by their first figure of merit", figure).of_metrics();

/// Cameras in order of the metric by which the table is sorted, with uncertainties, and the table of all numbers.
fn figure(scene: &Scene<'_>, look: &FigureLook, room: FigureRoom) -> Option<Figure> {
    let ranked = scene.ranked(look.cameras);
    let metric = sorted_by(scene, look.sorting.as_ref()).or_else(|| first(scene))?;
    let mut rows: Vec<(usize, MetricValue, f64)> = (0..ranked.cameras.len())
        .filter_map(|camera| value(&ranked, camera, metric).and_then(|v| Some((camera, v, v.value.ok()?))))
        .collect();
    let largest_first = metric.better == Better::Higher;
    rows.sort_by(|a, b| if largest_first { b.2.total_cmp(&a.2) } else { a.2.abs().total_cmp(&b.2.abs()) });
    let unit = if unit(&metric).is_empty() { String::new() } else { format!(" in {}", unit(&metric)) };
    let name = |camera: usize| ranked.cameras[camera].id.name.as_str();
    let names = rows.iter().map(|row| text_width(name(row.0), TextSize::Small)).fold(40.0, f64::max) + 20.0;
    let width = room.width.unwrap_or(WIDTH).max(names + 180.0);
    let mut figure = Figure::new(format!("{}{unit}", metric.label), [width, 24.0 + ROW * rows.len() as f64]);
    let mut panel = Panel::board("Metrics", Rect::from_min_size([0.0; 2], figure.size), Ink::new(InkRole::Plot));
    let text =
        |words: &str, at: [f64; 2], anchor: Anchor, size: TextSize| Mark::text(words, at, anchor, size, InkRole::Text);
    panel.marks.push(text(&figure.title, [8.0, 12.0], Anchor::LEFT, TextSize::Body));
    let largest = rows
        .iter()
        .map(|row| row.2.abs() + row.1.uncertainty.map_or(0.0, |by| by.standard))
        .fold(f64::MIN_POSITIVE, f64::max);
    let written = |value: MetricValue| {
        [number(metric, value), uncertainty(value).unwrap_or_default()].map(|words| {
            let width = text_width(&words, TextSize::Small);
            (words, width)
        })
    };
    let [numbers_width, behind_width] =
        rows.iter().map(|row| written(row.1)).fold([0.0_f64; 2], |[a, b], [x, y]| [a.max(x.1), b.max(y.1)]);
    let margin = 72.0_f64.max(numbers_width + behind_width + 24.0);
    let x = |value: f64| names + (width - names - margin) * (value.abs() / largest).clamp(0.0, 1.0);
    for (index, (camera, value, merit)) in rows.iter().enumerate() {
        let y = 24.0 + ROW * index as f64 + ROW / 2.0;
        let name = name(*camera);
        panel.marks.push(text(name, [names - 8.0, y], Anchor::RIGHT, TextSize::Small));
        let bar = Shape::Rect { min: [names, y - 5.0], max: [x(*merit), y + 5.0] };
        panel.marks.push(Mark::new(Tag::default(), name, bar).with_fill(InkRole::Line));
        if let Some(by) = value.uncertainty.map(|by| by.standard) {
            let segments = vec![[[x((merit.abs() - by).max(0.0)), y], [x(merit.abs() + by), y]]];
            panel.marks.push(
                Mark::new(Tag::default(), "uncertainty", Shape::Segments { segments }).with_stroke(InkRole::Text, 1.2),
            );
        }
        let [(number, _), (behind, _)] = written(*value);
        let end = width - 12.0 - behind_width;
        panel.marks.push(text(&number, [end, y], Anchor::RIGHT, TextSize::Small));
        panel.marks.push(Mark::text(behind, [end + 4.0, y], Anchor::LEFT, TextSize::Small, InkRole::Weak));
    }
    figure.panels.push(panel);
    figure.caption = format!(
        "Lines: ± u. {} {}",
        scene.metrics_words_with(rows.iter().filter_map(|row| row.1.uncertainty).collect::<Vec<_>>()),
        conditions(scene)
    );
    let numbers = with_nature(table(&ranked), |camera| uncertainties(&ranked, [camera]));
    figure.table = numbers.with_constants(scene.metrics_constants(scene.document.temperature_k));
    Some(figure)
}
