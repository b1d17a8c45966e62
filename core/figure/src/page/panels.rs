//! Panels: ground, grid, marks, tick labels, and the titles of the axes.

use super::{AxisTitles, Brush, TextLine, marks};
use crate::ink::{Ink, InkRole};
use crate::mark::{Anchor, Mark, Shape, Stroke, TextSize};
use crate::panel::{Panel, annotations};
use crate::projection::Projection;
use crate::rect::Rect;
use crate::text::text_width;

const TITLE: f64 = 18.0;

/// A panel at its place on the page, with the titles that stand outside of it.
pub(super) struct Titled {
    pub(super) panel: Panel,
    x: String,
    y: String,
}

/// True if the titles of y may stand along the axes: each is shorter than its plot is high.
fn titles_fit(panels: &[Panel]) -> bool {
    panels
        .iter()
        .all(|panel| text_width(&panel.y.label, TextSize::Small) <= panel.area.height() - Projection::bottom(&panel.x))
}

/// Left sides of panels with a title of y, lower sides of those with one of x, that stand outside in this layout. Titles of x with a
/// line of their own are outside already.
fn titled_sides(panels: &[Panel], titles: AxisTitles) -> [Vec<f64>; 2] {
    let sides = |side: &dyn Fn(&Panel) -> Option<f64>| {
        let mut sides: Vec<f64> = panels.iter().filter_map(side).collect();
        sides.sort_by(f64::total_cmp);
        sides.dedup_by(|a, b| (*a - *b).abs() < 0.5);
        sides
    };
    if titles != AxisTitles::Outside {
        return [Vec::new(), Vec::new()];
    }
    let fit = titles_fit(panels);
    let left = |panel: &Panel| (fit && !panel.y.label.is_empty()).then_some(panel.area.min[0]);
    let lower = |panel: &Panel| (!panel.x.label.is_empty() && !panel.x.has_title_line()).then_some(panel.area.max[1]);
    [sides(&left), sides(&lower)]
}

/// Width and height by which a figure grows for the titles of its axes.
pub(super) fn room_of_titles(panels: &[Panel], titles: AxisTitles) -> [f64; 2] {
    titled_sides(panels, titles).map(|sides| TITLE * sides.len() as f64)
}

/// The panels, moved apart by the titles of their axes.
pub(super) fn spread(panels: &[Panel], titles: AxisTitles) -> Vec<Titled> {
    let [left, lower] = titled_sides(panels, titles);
    // Sides at the same height have one title, below which the next panel stands.
    let before = |sides: &[f64], edge: f64| TITLE * sides.iter().filter(|side| **side <= edge + 0.5).count() as f64;
    let fit = titles_fit(panels);
    let place = |panel: &Panel| {
        let mut titled = Titled { panel: panel.clone(), x: String::new(), y: String::new() };
        let Panel { area, x, y, .. } = &mut titled.panel;
        match titles {
            AxisTitles::Inside => {}
            AxisTitles::None => {
                x.label.clear();
                y.label.clear();
            }
            AxisTitles::Outside => {
                if !x.has_title_line() {
                    titled.x = std::mem::take(&mut x.label);
                }
                if fit {
                    titled.y = std::mem::take(&mut y.label);
                }
                let size = [area.width(), area.height()];
                let moved = [area.min[0] + before(&left, area.min[0]), area.min[1] + before(&lower, area.min[1])];
                *area = Rect::from_min_size(moved, size);
            }
        }
        titled
    };
    panels.iter().map(place).collect()
}

pub(super) fn draw(brush: &mut Brush<'_>, titled: &Titled, projection: &Projection) {
    let (panel, plot) = (&titled.panel, projection.plot);
    brush.canvas.begin(&panel.name, Some(plot));
    brush.rect(plot, None, Some(panel.background));
    let is_ground = |mark: &&Mark| matches!(mark.shape, Shape::Image { .. });
    let grounds = panel.marks.iter().take_while(is_ground).count();
    for mark in &panel.marks[..grounds] {
        marks::draw_ground(brush, mark, projection, panel.background);
    }
    draw_grid(brush, panel, projection);
    for mark in &panel.marks[grounds..] {
        marks::draw(brush, mark, projection);
    }
    brush.canvas.end();
    if panel.framed {
        brush.rect(plot, Some(Stroke::solid(InkRole::Line, 1.0)), None);
    }
    draw_tick_labels(brush, panel, projection);
    draw_titles(brush, titled, projection);
    for note in annotations(panel, plot, 1.0) {
        let label = TextLine::new(note.at, &note.text, note.anchor, TextSize::Small, InkRole::Weak.into());
        brush.text(&TextLine { halo: Some(panel.background), ..label });
    }
}

fn draw_grid(brush: &mut Brush<'_>, panel: &Panel, projection: &Projection) {
    let (plot, stroke) = (projection.plot, Some(Stroke::solid(InkRole::Grid, 1.0)));
    for tick in projection.x_ticks.iter().filter(|_| panel.x.grid) {
        let x = projection.at([tick.value, projection.y[0]])[0];
        brush.path(&[[x, plot.min[1]], [x, plot.max[1]]], false, stroke, None);
    }
    for tick in projection.y_ticks.iter().filter(|_| panel.y.grid) {
        let y = projection.at([projection.x[0], tick.value])[1];
        brush.path(&[[plot.min[0], y], [plot.max[0], y]], false, stroke, None);
    }
}

fn draw_tick_labels(brush: &mut Brush<'_>, panel: &Panel, projection: &Projection) {
    let (plot, ink) = (projection.plot, Ink::new(InkRole::Weak));
    for tick in &projection.x_ticks {
        let half = 0.5 * text_width(&tick.label, TextSize::Small);
        let x = projection.at([tick.value, projection.y[0]])[0];
        let x = x.min(panel.area.max[0] - half).max(panel.area.min[0] + half);
        brush.text(&TextLine::new([x, plot.max[1] + 6.0], &tick.label, Anchor::TOP, TextSize::Small, ink));
    }
    for tick in &projection.y_ticks {
        let y = projection.at([projection.x[0], tick.value])[1];
        brush.text(&TextLine::new([plot.min[0] - 7.0, y], &tick.label, Anchor::RIGHT, TextSize::Small, ink));
    }
}

fn draw_titles(brush: &mut Brush<'_>, titled: &Titled, projection: &Projection) {
    let (plot, area, ink) = (projection.plot, titled.panel.area, Ink::new(InkRole::Weak));
    let middle = [0, 1].map(|axis| 0.5 * (plot.min[axis] + plot.max[axis]));
    let below = [middle[0], area.max[1] + 0.5 * TITLE];
    brush.text(&TextLine::new(below, &titled.x, Anchor::CENTER, TextSize::Small, ink));
    let beside = [area.min[0] - 0.5 * TITLE, middle[1]];
    let label = TextLine::new(beside, &titled.y, Anchor::CENTER, TextSize::Small, ink);
    brush.text(&TextLine { upward: true, ..label });
}
