//! The legend: inside the largest plot, beside the figure, or below it.

use super::{Brush, TextLine};
use crate::ink::{Ink, InkRole};
use crate::labels::Labels;
use crate::mark::{Anchor, Stroke, TextSize};
use crate::panel::{Figure, LegendEntry, LegendPlace, Panel};
use crate::projection::Projection;
use crate::rect::Rect;
use crate::text::{text_width, wrapped};

const ROW: f64 = 20.0;
const KEY: f64 = 28.0;
const PAD: f64 = 8.0;
const MOST_COLUMNS: usize = 6;
const LEAST: f64 = 60.0;
const GAP: f64 = 12.0;

/// Height of a further line of a long name.
const LINE: f64 = 15.0;
/// Size of the names.
const SIZE: TextSize = TextSize::Small;

/// Columns of a legend.
#[derive(Clone, PartialEq, Debug)]
struct Columns {
    widths: Vec<f64>,
    names: Vec<Vec<String>>,
}

impl Columns {
    /// So many columns, filled row by row; a name wider than there is room for one column stands in lines.
    fn new(entries: &[LegendEntry], count: usize, room: f64) -> Self {
        let mut widths = vec![0.0_f64; count.max(1)];
        // After the last column none is needed.
        let most = (room - PAD - KEY + 0.5).max(LEAST);
        let names: Vec<Vec<String>> = entries.iter().map(|entry| wrapped(&entry.name, SIZE, most)).collect();
        for (i, lines) in names.iter().enumerate() {
            let widest = lines.iter().map(|line| text_width(line, SIZE)).fold(0.0, f64::max);
            let width = &mut widths[i % count.max(1)];
            *width = width.max(2.0 * PAD + KEY + widest);
        }
        Self { widths, names }
    }

    /// The fewest rows that fit below a figure.
    fn below(entries: &[LegendEntry], width: f64) -> Self {
        let most = entries.len().clamp(1, MOST_COLUMNS);
        let mut fitting = (1..=most).rev().map(|count| Self::new(entries, count, width));
        let fewest = fitting.find(|columns| columns.width() <= width + PAD + 0.5);
        let rows = fewest.map_or(entries.len(), |columns| columns.rows(entries)).max(1);
        // In rows as full as possible.
        Self::new(entries, entries.len().div_ceil(rows), width)
    }

    /// One column in a plot.
    fn inside(entries: &[LegendEntry], width: f64) -> Self {
        Self::new(entries, 1, 0.7 * width)
    }

    fn rows(&self, entries: &[LegendEntry]) -> usize {
        entries.len().div_ceil(self.widths.len())
    }

    fn width(&self) -> f64 {
        self.widths.iter().sum()
    }

    fn size(&self) -> [f64; 2] {
        [self.width() + PAD, self.heights().sum::<f64>() + PAD]
    }

    fn heights(&self) -> impl Iterator<Item = f64> {
        let lines = self.names.chunks(self.widths.len()).map(|row| row.iter().map(Vec::len).max().unwrap_or(1));
        lines.map(|lines| ROW + LINE * (lines.max(1) - 1) as f64)
    }
}

/// The rectangle of a legend that stands outside of a figure of the given size.
pub(super) fn outside(figure: &Figure, place: LegendPlace, [width, height]: [f64; 2]) -> Option<Rect> {
    match place {
        _ if figure.legend.is_empty() => None,
        LegendPlace::Outside => {
            let size = Columns::new(&figure.legend, 1, f64::INFINITY).size();
            Some(Rect::from_min_size([width + GAP, 0.0], size))
        }
        LegendPlace::Below => {
            let columns = Columns::below(&figure.legend, width);
            // Keys begin where the figure does, and the last column needs no room after it.
            let size = [(columns.width() - PAD).min(width.max(columns.widths[0])), columns.size()[1]];
            Some(Rect::from_min_size([0.0, height + 0.5 * GAP], size))
        }
        _ => None,
    }
}

/// Draws the legend in its rectangle outside, or inside the largest panel.
pub(super) fn draw(
    brush: &mut Brush<'_>,
    figure: &Figure,
    (place, outside): (LegendPlace, Option<Rect>),
    panels: &[(&Panel, &Projection)],
) {
    let area = outside.unwrap_or_else(|| inside(figure, place, panels));
    if outside.is_none() {
        let ground = Ink { role: InkRole::Plot, alpha: 0.9 };
        brush.rect(area, Some(Stroke::solid(InkRole::Line, 1.0)), Some(ground));
    }
    let (columns, inset) = match place {
        LegendPlace::Below => (Columns::below(&figure.legend, area.width()), 0.0),
        LegendPlace::Outside => (Columns::new(&figure.legend, 1, f64::INFINITY), PAD),
        _ => (Columns::inside(&figure.legend, figure.size[0]), PAD),
    };
    for (i, entry) in figure.legend.iter().enumerate() {
        let column = i % columns.widths.len();
        let x = area.min[0] + inset + columns.widths[..column].iter().sum::<f64>();
        let above: f64 = columns.heights().take(i / columns.widths.len()).sum();
        let y = area.min[1] + 0.5 * PAD + above + 0.5 * ROW;
        key(brush, entry, [x, y]);
        for (row, line) in columns.names[i].iter().enumerate() {
            let at = [x + KEY + PAD, y + LINE * row as f64];
            brush.text(&TextLine::new(at, line, Anchor::LEFT, SIZE, InkRole::Text.into()));
        }
    }
}

/// Place of the legend: [`LegendPlace::Inside`] is the corner where it covers nothing, else it stands below.
pub(super) fn place(figure: &Figure) -> LegendPlace {
    if figure.legend_place != LegendPlace::Inside {
        return figure.legend_place;
    }
    let projections: Vec<Projection> = figure.panels.iter().map(|panel| Projection::new(panel, 1.0)).collect();
    let panels: Vec<_> = figure.panels.iter().zip(&projections).collect();
    let Some((panel, _)) = largest(&panels) else { return LegendPlace::Below };
    let labels = Labels::new(panel);
    [LegendPlace::UpperRight, LegendPlace::UpperLeft, LegendPlace::LowerRight, LegendPlace::LowerLeft]
        .into_iter()
        .find(|place| labels.is_free(&inside(figure, *place, &panels), 0.0))
        .unwrap_or(LegendPlace::Below)
}

fn largest<'a>(panels: &[(&'a Panel, &'a Projection)]) -> Option<(&'a Panel, &'a Projection)> {
    let area = |plot: Rect| plot.width() * plot.height();
    panels.iter().copied().max_by(|a, b| area(a.1.plot).total_cmp(&area(b.1.plot)))
}

/// The rectangle of a legend in a corner of the largest panel.
fn inside(figure: &Figure, place: LegendPlace, panels: &[(&Panel, &Projection)]) -> Rect {
    let size = Columns::inside(&figure.legend, figure.size[0]).size();
    let largest = largest(panels);
    let plot = largest.map_or(Rect::from_min_size([0.0, 0.0], figure.size), |(_, projection)| projection.plot);
    let note = if largest.is_some_and(|(panel, _)| !panel.note.is_empty()) { 18.0 } else { 0.0 };
    let (left, right) = (plot.min[0] + PAD, plot.max[0] - PAD - size[0]);
    let (top, bottom) = (plot.min[1] + PAD, plot.max[1] - PAD - size[1]);
    // The corners hold the labels of the axes and the note.
    let min = match place {
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
