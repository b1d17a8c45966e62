//! Two cameras side by side as a figure: each metric with both values and their difference.

use chromascope_figure::{Anchor, Cell, Figure, Ink, InkRole, Mark, Panel, Rect, Shape, Tag, TextSize};

use super::FigureInput;
use super::chromaticity::conditions;
use super::metrics::head_to_head;
use crate::document::SetKind;
use crate::format::fixed;
use crate::plot_item::{PlotItem, SensorId};
use crate::ranking::{Ranked, ranked};
use crate::scene::Scene;
use crate::view::View;

/// Width of a saved figure in points, and height of a row.
const WIDTH: f64 = 640.0;
const ROW: f64 = 18.0;

/// The two cameras, as indices in the ranking: chosen, else the selected one and the first compared one.
pub fn pair(ranked: &Ranked, scene: &Scene<'_>, view: &View) -> [Option<usize>; 2] {
    let place = |id: &SensorId| ranked.cameras.iter().position(|camera| camera.id == *id);
    let [a, b] = view.saved.metrics.pair.each_ref().map(|id| id.as_ref().and_then(place));
    let selected = view.selected.as_ref().and_then(PlotItem::source).and_then(place);
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

/// The table of two cameras; none where there are fewer than two.
pub fn figure(input: &FigureInput<'_>) -> Option<Figure> {
    let (scene, view) = (input.scene, input.view);
    let ranked = ranked(scene, view.saved.metrics.cameras);
    let [Some(a), Some(b)] = pair(&ranked, scene, view) else { return None };
    let table = head_to_head(&ranked, [a, b]);
    let rows: Vec<_> = table.rows.iter().filter(|row| matches!(row.get(1), Some(Cell::Number(_)))).collect();
    let width = view.room.width.unwrap_or(WIDTH).max(360.0);
    let [name_a, name_b] = [a, b].map(|camera| ranked.cameras[camera].id.name.as_str());
    let mut figure = Figure::new(format!("{name_a} and {name_b}"), [width, ROW * (rows.len() as f64 + 3.0)]);
    let mut panel = Panel::board("Head to head", Rect::from_min_size([0.0, 0.0], figure.size), Ink::new(InkRole::Plot));
    // Right ends of the columns of numbers.
    let ends = [0.46, 0.65, 0.84, 1.0].map(|share| share * width - 6.0);
    let mut line = 0.5;
    for (letter, name) in [("A", name_a), ("B", name_b)] {
        panel.marks.push(text(&format!("{letter}: {name}"), [6.0, ROW * line], Anchor::LEFT, TextSize::Body));
        line += 1.0;
    }
    let heads = [("A", ends[0]), ("B", ends[1]), ("A − B", ends[2]), ("better", ends[3])];
    panel.marks.extend(heads.map(|(head, x)| text(head, [x, ROW * line], Anchor::RIGHT, TextSize::Small)));
    let rule = Shape::Segments { segments: vec![[[0.0, ROW * (line + 0.5)], [width, ROW * (line + 0.5)]]] };
    panel.marks.push(Mark::new(Tag::default(), "rule", rule).with_stroke(InkRole::Line, 1.0));
    for row in rows {
        line += 1.0;
        let words = |column: usize| match row.get(column) {
            Some(Cell::Number(value)) => fixed(*value, 4),
            Some(Cell::Text(words)) => words.clone(),
            _ => String::new(),
        };
        panel.marks.push(text(&words(0), [6.0, ROW * line], Anchor::LEFT, TextSize::Small));
        for (column, x) in [3, 4, 1, 2].into_iter().zip(ends) {
            panel.marks.push(text(&words(column), [x, ROW * line], Anchor::RIGHT, TextSize::Small));
        }
    }
    figure.panels.push(panel);
    figure.caption = format!(
        "A: {name_a}. B: {name_b}. Better: the camera that is better by more than the standard uncertainty of the \
         difference. {} {}",
        scene.metrics_words(),
        conditions(scene)
    );
    figure.table = table.with_constants(&scene.metrics_constants(scene.document.temperature_k));
    Some(figure)
}

fn text(words: &str, at: [f64; 2], anchor: Anchor, size: TextSize) -> Mark {
    let (text, ink) = (words.to_owned(), Ink::new(InkRole::Text));
    Mark::new(Tag::default(), words, Shape::Text { at, text, anchor, offset: [0.0; 2], size, ink })
}
