//! Figures of merit of cameras: tables, ranks, the differences of two cameras, and cameras in order of one metric.

use chromascope_core::query::metrics::{Better, Difference, rank_ranges};
use chromascope_core::query::{CameraMetric, MetricUncertainty, MetricValue, WhyNot};
use chromascope_figure::{Cell, Figure, FigureRoom, InkRole, Marker, Note, Table};

use super::chromaticity::conditions;
use super::kind::FigureKind;
use super::look::{FigureLook, Sorting};
use super::whiskers::{self, Row};
use crate::format::rank_in_words;
use crate::names::shortest;
use crate::scene::Scene;
use crate::scene::metrics::{CameraFigures, Ranked};
use crate::scene::uncertainty::{self, cell, number, uncertainty, unit, with_nature};

/// Id of the table of cameras in what is saved between runs.
pub const TABLE: &str = "Metrics";
/// Metric that cameras are sorted by at first.
pub const FIRST: &str = "delta-e2000-mean";
/// The metric where the first has no meaning.
pub const FIRST_EQ_13: &str = "xy-mean";

/// Metrics by their ids that are shown where none are chosen.
pub const USUAL: &str =
    "delta-e2000-mean delta-e2000-p95 delta-e2000-max metamerism-index vora luther cct-error noise-gain";

/// The metric that rows are sorted by: the column's, or the first one that has a meaning under the color transform.
pub fn sorted_by(scene: &Scene<'_>, sorting: Option<&Sorting>) -> Option<CameraMetric> {
    let named = |name: &str| CameraMetric::ALL.iter().copied().find(|metric| metric.symbol == name);
    sorting.map_or_else(|| first(scene), |sorting| named(&sorting.column))
}

/// The metric that cameras are sorted by until another is chosen.
pub fn first(scene: &Scene<'_>) -> Option<CameraMetric> {
    CameraMetric::by_id(if scene.document.transform.is_eq_13() { FIRST_EQ_13 } else { FIRST })
}

/// The order of cameras until another is chosen: the best by that metric first.
pub fn usual(scene: &Scene<'_>) -> Option<Sorting> {
    let first = first(scene)?;
    Some(Sorting { column: first.symbol.to_owned(), descending: first.better == Better::Higher })
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

/// Inserts the patch of each camera that differs most, by the document's metric; without a place at the end.
pub fn insert_worst(table: &mut Table, ranked: &Ranked, scene: &Scene<'_>, at: Option<usize>) {
    let patches = scene.patches();
    let names: Vec<String> = patches.iter().flat_map(|set| set.patches()).map(|patch| patch.name.clone()).collect();
    let rows = (0..ranked.cameras.len()).map(|camera| figures(ranked, camera).map(|figures| &*figures.metrics));
    let at = at.unwrap_or(table.columns.len());
    uncertainty::insert_worst(table, at, (scene.document.difference, &names), rows);
}

/// Uncertainties of cameras in all metrics, where they are known.
pub fn uncertainties(
    ranked: &Ranked,
    cameras: impl IntoIterator<Item = usize>,
) -> impl Iterator<Item = MetricUncertainty> {
    let all = cameras.into_iter().filter_map(|camera| figures(ranked, camera)?.uncertainties.as_ref());
    all.flat_map(|all| all.iter().copied().flatten())
}

/// All figures of merit of all cameras with their uncertainties and conditions, as they are written to files.
pub fn numbers(scene: &Scene<'_>, ranked: &Ranked) -> Table {
    let mut numbers = table(ranked);
    insert_worst(&mut numbers, ranked, scene, None);
    let numbers = with_nature(numbers, |camera| uncertainties(ranked, [camera]));
    numbers.with_constants(scene.metrics_constants(scene.document.temperature_k))
}

/// Columns of the difference of two cameras, of the better one, and of their values.
pub const DIFFERENCE: usize = 1;
pub const BETTER: usize = 2;
pub const VALUES: [usize; 2] = [3, 4];

/// Two cameras head to head: each metric with the difference, the camera better by more than the uncertainty, and both values;
/// gray where the difference is within its uncertainty.
pub fn head_to_head(ranked: &Ranked, cameras: [usize; 2]) -> Table {
    let mut table = Table::new(["metric", "A − B", "better", "A", "B"]);
    for column in &mut table.columns {
        column.decimals = Some(0);
    }
    BETTER_HINT.clone_into(&mut table.columns[BETTER].hint);
    for column in VALUES {
        "Gray: the other camera is better at 95 %.".clone_into(&mut table.columns[column].hint);
    }
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
            a.with(|note| note.is_gray = words == "B"),
            b.with(|note| note.is_gray = words == "A"),
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
/// Width below which numbers are left out: there is the axis.
const NARROW: f64 = 450.0;
/// Largest number of cameras in a figure that has no height of its own.
const MOST: usize = 24;

pub static KIND: FigureKind =
    FigureKind::new("metrics", "Cameras ranked by their first figure of merit", figure).of_metrics().in_report();

/// Places that are shown: all of few, else those that must be, the last, and the first.
fn shown(count: usize, most: usize, must: impl Fn(usize) -> bool) -> Vec<usize> {
    let must = |place: &usize| count <= most || must(*place) || place + 1 == count;
    let mut free = most.saturating_sub((0..count).filter(must).count());
    let mut takes = |place: &usize| {
        let is_free = free > 0;
        let is_kept = must(place);
        free -= usize::from(is_free && !is_kept);
        is_kept || is_free
    };
    (0..count).filter(|place| takes(place)).collect()
}

/// Makers of cameras whose names are shortened, each with these, in a sentence.
fn makers<'a>(named: impl Iterator<Item = (&'a str, &'a str)>) -> String {
    let mut groups: Vec<(&str, String)> = Vec::new();
    for (full, short) in named.filter(|(full, short)| full != short) {
        let maker = full.split(' ').next().unwrap_or_default();
        match groups.iter_mut().find(|(of, _)| *of == maker) {
            Some((_, all)) => *all += &[", ", short].concat(),
            None => groups.push((maker, format!("{maker}: {short}"))),
        }
    }
    let groups: Vec<String> = groups.into_iter().map(|(_, words)| words).collect();
    if groups.is_empty() { String::new() } else { format!(" {}.", groups.join("; ")) }
}

/// Cameras in the order of the table with their values of the metric by which it is sorted, and the table of all numbers.
fn figure(scene: &Scene<'_>, look: &FigureLook, room: FigureRoom) -> Option<Figure> {
    let ranked = scene.ranked(look.cameras);
    let metric = sorted_by(scene, look.sorting.as_ref()).or_else(|| first(scene))?;
    let by = look.sorting.clone().or_else(|| usual(scene))?;
    let mut listed = table(&ranked);
    insert_worst(&mut listed, &ranked, scene, None);
    let mut rows: Vec<usize> = (0..ranked.cameras.len()).collect();
    by.sort(&listed, &mut rows);
    let valued = |camera: usize| value(&ranked, camera, metric).and_then(|v| Some((camera, v, v.value.ok()?)));
    let order: Vec<(usize, MetricValue, f64)> = rows.into_iter().filter_map(valued).collect();
    let (sources, ranks) = (scene.visible_sources(), ranks(&ranked, metric));
    let source = |camera: usize| {
        let id = &ranked.cameras[camera].id;
        sources.iter().find(|source| source.kind == id.kind && source.name == id.name)
    };
    let width = room.width.unwrap_or(WIDTH);
    let most = room.height.map_or(MOST, |height| (height / whiskers::ROW) as usize - 4);
    let places = shown(order.len(), most.max(2), |place| source(order[place].0).is_some());
    let full: Vec<&str> = places.iter().map(|place| ranked.cameras[order[*place].0].id.name.as_str()).collect();
    let names: Vec<String> = if width < NARROW {
        shortest(full.iter().copied())
    } else {
        full.iter().map(|name| (*name).to_owned()).collect()
    };
    let others = full.iter().zip(&names).zip(&places).filter(|(_, place)| source(order[**place].0).is_none());
    let makers = makers(others.map(|((full, short), _)| (*full, short.as_str())));
    let mut rows = Vec::new();
    let mut next = 0;
    for (&place, name) in places.iter().zip(names) {
        let words = |name: String| Row {
            name,
            behind: String::new(),
            ink: InkRole::Weak.into(),
            marker: Marker::Dot,
            is_filled: true,
            value: None,
        };
        if place > next {
            rows.push(words(format!("{} more", place - next)));
        }
        next = place + 1;
        let (camera, value, merit) = order[place];
        let rank = rank_in_words(ranks[camera]);
        let value_in_words = [number(metric, value), uncertainty(value).unwrap_or_default()].join(" ");
        let behind = format!("{}, {rank}", value_in_words.trim_end());
        let by = value.uncertainty.map_or(0.0, |by| by.standard);
        let dagger = if value.uncertainty.is_some_and(|by| by.is_extrapolated) { "†" } else { "" };
        let row = Row {
            behind: if width < NARROW { rank + dagger } else { behind },
            ink: InkRole::Text.into(),
            value: Some([merit, by]),
            ..words(name)
        };
        rows.push(match source(camera) {
            Some(source) => Row { ink: source.role.into(), marker: source.marker, ..row },
            None => row,
        });
    }
    let [in_unit, unit] = match unit(&metric) {
        "" => [String::new(), String::new()],
        unit => [format!(" in {unit}"), format!(" ({unit})")],
    };
    let mut figure = Figure::new(format!("{}{in_unit}", metric.label), [width, 0.0]);
    figure.panels = whiskers::panels(&rows, &format!("{}{unit}", metric.symbol), width, false).into();
    figure.size = figure.panels[0].area.max;
    let first = places.iter().enumerate().take_while(|(row, place)| row == *place).count();
    let among = if places.len() < order.len() {
        let direction = if by.descending { "descending" } else { "ascending" };
        let counts = format!("{} of {} cameras: the first {first}", places.len(), order.len());
        format!("{counts} by {}, {direction}, those compared and the last. ", by.column)
    } else {
        String::new()
    };
    let behind = if width < NARROW { "ranks" } else { "values and ranks" };
    figure.caption = format!(
        "{among}Whiskers: ± u. At the right: {behind}, a range where cameras do not differ at 95 %. {} {}{makers}",
        scene.metrics_words_with(
            &[metric],
            places.iter().filter_map(|place| order[*place].1.uncertainty).collect::<Vec<_>>()
        ),
        conditions(scene)
    );
    figure.table = numbers(scene, &ranked);
    Some(figure)
}
