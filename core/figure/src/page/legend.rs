//! The legend: inside the first plot, beside the figure, or below it.

use super::{Brush, Label};
use crate::figure::Figure;
use crate::ink::{Ink, InkRole};
use crate::mark::{Anchor, Stroke, TextSize};
use crate::panel::{LegendEntry, LegendPlace, Panel};
use crate::projection::Projection;
use crate::rect::Rect;
use crate::text::text_width;

const ROW: f64 = 20.0;
const KEY: f64 = 28.0;
const PAD: f64 = 8.0;
/// Distance from the figure.
const GAP: f64 = 12.0;

/// Width of the widest entry.
fn widest(entries: &[LegendEntry]) -> f64 {
    let widest = entries.iter().map(|entry| text_width(&entry.name, TextSize::Body)).fold(0.0, f64::max);
    3.0 * PAD + KEY + widest
}

/// Size of a legend in a number of columns.
fn size(entries: &[LegendEntry], columns: usize) -> [f64; 2] {
    let rows = entries.len().div_ceil(columns);
    [widest(entries) * columns as f64, ROW * rows as f64 + PAD]
}

/// Columns of a legend below a figure: as many as fit, in rows as full as possible.
fn columns_below(figure: &Figure, width: f64) -> usize {
    let most = ((width / widest(&figure.legend)).floor() as usize).clamp(1, figure.legend.len().max(1));
    let rows = figure.legend.len().div_ceil(most).max(1);
    figure.legend.len().div_ceil(rows).max(1)
}

/// The rectangle of a legend that stands outside of a figure of the given size.
pub(super) fn outside(figure: &Figure, [width, height]: [f64; 2]) -> Option<Rect> {
    match figure.legend_place {
        _ if figure.legend.is_empty() => None,
        LegendPlace::Outside => Some(Rect::from_min_size([width + GAP, 0.0], size(&figure.legend, 1))),
        LegendPlace::Below => {
            let size = size(&figure.legend, columns_below(figure, width));
            Some(Rect::from_min_size([0.0, height + 0.5 * GAP], size))
        }
        _ => None,
    }
}

/// Draws the legend in its rectangle outside, or inside the first panel.
pub(super) fn draw(
    brush: &mut Brush<'_>,
    figure: &Figure,
    outside: Option<Rect>,
    first: Option<(&Panel, &Projection)>,
) {
    let area = outside.unwrap_or_else(|| inside(figure, first));
    if outside.is_none() {
        let ground = Ink { role: InkRole::Plot, alpha: 0.9 };
        brush.rect(area, Some(Stroke::solid(InkRole::Line, 1.0)), Some(ground));
    }
    let pitch = widest(&figure.legend);
    let columns = ((area.width() / pitch).round() as usize).max(1);
    for (i, entry) in figure.legend.iter().enumerate() {
        let x = area.min[0] + (i % columns) as f64 * pitch + PAD;
        let y = area.min[1] + 0.5 * PAD + ROW * ((i / columns) as f64 + 0.5);
        key(brush, entry, [x, y]);
        let at = [x + KEY + PAD, y];
        brush.text(&Label::new(at, &entry.name, Anchor::LEFT, TextSize::Body, InkRole::Text.into()));
    }
}

fn inside(figure: &Figure, first: Option<(&Panel, &Projection)>) -> Rect {
    let size = size(&figure.legend, 1);
    let whole = Rect::from_min_size([0.0, 0.0], figure.size);
    let plot = first.map_or(whole, |(_, projection)| projection.plot);
    let note = if first.is_some_and(|(panel, _)| !panel.note.is_empty()) { 18.0 } else { 0.0 };
    let (left, right) = (plot.min[0] + PAD, plot.max[0] - PAD - size[0]);
    let (top, bottom) = (plot.min[1] + PAD, plot.max[1] - PAD - size[1]);
    // The corners hold the labels of the axes and the note.
    let min = match figure.legend_place {
        LegendPlace::UpperLeft => [left, top + 16.0],
        LegendPlace::LowerRight => [right, bottom - 16.0],
        LegendPlace::LowerLeft => [left, bottom],
        _ => [right, top + note],
    };
    Rect::from_min_size(min, size)
}

fn key(brush: &mut Brush<'_>, entry: &LegendEntry, left: [f64; 2]) {
    if let Some(stroke) = entry.stroke {
        brush.path(&[left, [left[0] + KEY, left[1]]], false, Some(stroke), None);
    }
    if let Some(marker) = entry.marker {
        let ink = entry.stroke.map(|stroke| stroke.ink).or(entry.fill);
        let rim = ink.map(|ink| Stroke::solid(ink, 2.0));
        let inside = if marker.has_inside() { entry.fill.or(Some(InkRole::Plot.into())) } else { None };
        let ground = Some(Ink::new(InkRole::Plot));
        brush.marker([left[0] + 0.5 * KEY, left[1]], (marker, 5.0), rim, inside, ground);
    }
}
