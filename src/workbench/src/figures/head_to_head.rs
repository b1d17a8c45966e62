//! Two cameras side by side as a figure: each metric with both values and their difference.

use chromascope_core::query::CameraMetric;
use chromascope_figure::{
    Anchor, Cell, Figure, FigureRoom, Ink, InkRole, Mark, Panel, Rect, Shape, Table, Tag, TextSize, text_width,
};

use super::chromaticity::conditions;
use super::kind::FigureKind;
use super::look::FigureLook;
use super::metrics::{DIFFERENCE, VALUES, head_to_head, uncertainties, value};
use crate::document::SetKind;
use crate::plot_item::{PlotItem, SensorId};
use crate::scene::Scene;
use crate::scene::metrics::Ranked;
use crate::scene::uncertainty::with_nature;

/// Width of a saved figure in points, and height of a row.
const WIDTH: f64 = 640.0;
const ROW: f64 = 18.0;
/// Columns of the figure, and the air behind each.
const COLUMNS: usize = 5;
const GAP: f64 = 14.0;

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
    FigureKind::new("head-to-head", "All figures of merit of two cameras", figure).of_metrics();

fn figure(scene: &Scene<'_>, look: &FigureLook, room: FigureRoom) -> Option<Figure> {
    let ranked = scene.ranked(look.cameras);
    let [Some(a), Some(b)] = pair(&ranked, scene, look) else { return None };
    let table = head_to_head(&ranked, [a, b]);
    let rows = rows(&table);
    let width_of = |words: &str| text_width(words, TextSize::Small);
    let widest = |column: usize| rows.iter().map(|row| width_of(&row[column])).fold(30.0, f64::max) + GAP;
    let least: f64 = 12.0 + (0..COLUMNS).map(widest).sum::<f64>();
    let width = room.width.unwrap_or(WIDTH).max(least);
    let [name_a, name_b] = [a, b].map(|camera| ranked.cameras[camera].id.name.as_str());
    let mut figure = Figure::new(format!("{name_a} and {name_b}"), [width, ROW * (rows.len() as f64 + 3.0)]);
    let mut panel = Panel::board("Head to head", Rect::from_min_size([0.0, 0.0], figure.size), Ink::new(InkRole::Plot));
    // Left ends of the columns, with the spare room before the numbers.
    let spare = (width - least) / (COLUMNS - 1) as f64;
    let mut left = 6.0;
    let lefts: Vec<f64> = (0..COLUMNS)
        .map(|column| {
            let at = left + if column > 0 { spare } else { 0.0 };
            left = at + widest(column);
            at
        })
        .collect();
    let mut line = 0.5;
    let text = |words: &str, at, size| Mark::text(words, at, Anchor::LEFT, size, InkRole::Text);
    for (letter, name) in [("A", name_a), ("B", name_b)] {
        panel.marks.push(text(&format!("{letter}: {name}"), [6.0, ROW * line], TextSize::Body));
        line += 1.0;
    }
    let heads = ["", "A", "B", "A − B", "better"];
    for (head, x) in heads.into_iter().zip(&lefts).skip(1) {
        panel.marks.push(text(head, [*x, ROW * line], TextSize::Small));
    }
    let rule = Shape::Segments { segments: vec![[[0.0, ROW * (line + 0.5)], [width, ROW * (line + 0.5)]]] };
    panel.marks.push(Mark::new(Tag::default(), "rule", rule).with_stroke(InkRole::Line, 1.0));
    for row in rows {
        line += 1.0;
        for (words, x) in row.iter().zip(&lefts) {
            panel.marks.push(text(words, [*x, ROW * line], TextSize::Small));
        }
    }
    figure.panels.push(panel);
    let known: Vec<_> = uncertainties(&ranked, [a, b]).collect();
    figure.caption = format!(
        "A: {name_a}. B: {name_b}. Better: at 95 %, where the difference exceeds k u of the difference. {} {}",
        scene.metrics_words_with(known),
        conditions(scene)
    );
    figure.table =
        numbers(&ranked, [a, b], table).with_constants(scene.metrics_constants(scene.document.temperature_k));
    Some(figure)
}

/// Rows of the figure in words: metric, A, B, their difference and the better one; metrics without a difference are omitted.
fn rows(table: &Table) -> Vec<[String; COLUMNS]> {
    let rows = (0..table.rows.len()).filter(|&row| table.cell(row, DIFFERENCE).number().is_some());
    rows.map(|row| [0, VALUES[0], VALUES[1], DIFFERENCE, 2].map(|column| table.cell(row, column).in_words())).collect()
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
