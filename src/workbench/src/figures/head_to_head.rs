//! Two cameras against each other as a figure: the difference of each metric about 0; its numbers hold both values.

use chromascope_core::query::CameraMetric;
use chromascope_figure::{Cell, Figure, FigureRoom, InkRole, Marker, Table};

use super::chromaticity::conditions;
use super::kind::FigureKind;
use super::look::FigureLook;
use super::metrics::{DIFFERENCE, VALUES, differ, difference, head_to_head, is_better, uncertainties, value};
use super::whiskers::{self, Row};
use crate::document::SetKind;
use crate::plot_item::{PlotItem, SensorId};
use crate::scene::Scene;
use crate::scene::metrics::Ranked;
use crate::scene::uncertainty::with_nature;

/// Width of a saved figure in points.
const WIDTH: f64 = 560.0;

/// The two cameras, as indices in the ranking: chosen, else the selected one and the first compared one.
pub fn pair(ranked: &Ranked, scene: &Scene<'_>, look: &FigureLook) -> [Option<usize>; 2] {
    let place = |id: &SensorId| ranked.cameras.iter().position(|camera| camera.id == *id);
    let [a, b] = look.pair.each_ref().map(|id| id.as_ref().and_then(place));
    let selected = look.selected.as_ref().and_then(PlotItem::source).and_then(place);
    let compared: Vec<usize> = scene
        .document
        .compared
        .iter()
        .filter(|c| c.kind == SetKind::Camera)
        .filter_map(|c| place(&SensorId { kind: c.kind, name: c.name.clone() }))
        .collect();
    let candidates = || compared.iter().copied().chain(0..ranked.cameras.len());
    let a = a.or(selected.filter(|selected| Some(*selected) != b)).or_else(|| candidates().find(|c| Some(*c) != b));
    let b = b.or_else(|| candidates().find(|c| Some(*c) != a));
    [a, b]
}

pub static KIND: FigureKind =
    FigureKind::new("head-to-head", "Differences of two cameras in all figures of merit", figure)
        .of_metrics()
        .of_cameras(2);

fn figure(scene: &Scene<'_>, look: &FigureLook, room: FigureRoom) -> Option<Figure> {
    let ranked = scene.ranked(look.cameras);
    let [Some(a), Some(b)] = pair(&ranked, scene, look) else { return None };
    let [name_a, name_b] = [a, b].map(|camera| ranked.cameras[camera].id.name.as_str());
    let rows: Vec<Row> = CameraMetric::ALL.iter().filter_map(|metric| row(&ranked, [a, b], *metric)).collect();
    let mut figure = Figure::new(format!("{name_a} and {name_b}"), [0.0; 2]);
    let width = room.width.unwrap_or(WIDTH);
    figure.panels = whiskers::panels(&rows, "A − B, % of the larger", width, true).into();
    figure.size = figure.panels[0].area.max;
    let known: Vec<_> = uncertainties(&ranked, [a, b]).collect();
    let [mark_a, mark_b] =
        [a, b].map(|at| if uncertainties(&ranked, [at]).any(|by| by.is_extrapolated) { "†" } else { "" });
    figure.caption = format!(
        "A: {name_a}{mark_a}. B: {name_b}{mark_b}. Differences A − B in percent of the larger value, with whiskers to \
         95 %; filled and lettered where they exceed them: A or B is better, or they only differ (≠). {} {}",
        scene.metrics_words_with(CameraMetric::ALL, known),
        conditions(scene)
    );
    figure.table = numbers(&ranked, [a, b], head_to_head(&ranked, [a, b]))
        .with_constants(scene.metrics_constants(scene.document.temperature_k));
    Some(figure)
}

/// Difference of a metric by the larger of its values; none where it is undefined.
fn row(ranked: &Ranked, cameras: [usize; 2], metric: CameraMetric) -> Option<Row> {
    let [a, b] = cameras.map(|camera| value(ranked, camera, metric));
    let (a, b) = a.zip(b)?;
    let larger = a.value.ok()?.abs().max(b.value.ok()?.abs()).max(f64::MIN_POSITIVE);
    let difference = difference(a, b)?;
    let reach = difference.uncertainty.map_or(0.0, |by| by.coverage * by.standard);
    let is_significant = differ(a, b) == Some(true);
    let better = if is_significant { is_better(metric, a, b).map_or("≠", |a| if a { "A" } else { "B" }) } else { "" };
    Some(Row {
        name: metric.symbol.to_owned(),
        behind: better.to_owned(),
        ink: InkRole::Text.into(),
        marker: Marker::Circle,
        is_filled: is_significant,
        value: Some([difference.value.ok()?, reach].map(|value| 100.0 * value / larger)),
    })
}

fn numbers(ranked: &Ranked, cameras: [usize; 2], mut table: Table) -> Table {
    for column in [DIFFERENCE, VALUES[0], VALUES[1]] {
        let head = format!("{} uncertainty", table.columns[column].name);
        let cells: Vec<Cell> = table.rows.iter().map(|row| row[column].note().uncertainty.into()).collect();
        table.insert(table.columns.len(), head, cells);
    }
    with_nature(table, |row| {
        let values = cameras.map(|camera| value(ranked, camera, CameraMetric::ALL[row]));
        values.into_iter().flatten().filter_map(|value| value.uncertainty)
    })
}
