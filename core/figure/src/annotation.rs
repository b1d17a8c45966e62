//! Small texts in a plot's corners and below it.

use super::mark::{Anchor, TextSize};
use super::panel::Panel;
use super::projection::Projection;
use super::rect::Rect;
use super::text::{text_width, wrapped};

/// Height of a line of a note, in points.
const LINE: f64 = 15.0;

/// A small text of a plot: an axis' label, a panel's note.
#[derive(Debug, Clone, PartialEq)]
pub struct Annotation {
    /// Its place in points.
    pub at: [f64; 2],
    /// The text.
    pub text: String,
    /// Anchor: the point of the text that lies at the position.
    pub anchor: Anchor,
}

/// Labels of the axes (y upper left; x below the tick labels, symbols lower right) and the note (upper right) of a panel
/// whose plot covers the given rectangle, a long one in several lines, for [`TextSize::Small`] drawn `text_scale` times as large as on screen. None covers another.
pub fn annotations(panel: &Panel, plot: Rect, text_scale: f64) -> Vec<Annotation> {
    let pad = 5.0 * text_scale;
    let width = |text: &str| text_scale * text_width(text, TextSize::Small);
    let beside = width(&panel.y.label) + width(&panel.note) + 4.0 * pad <= plot.width();
    let below = if beside || panel.y.label.is_empty() { 0.0 } else { 16.0 * text_scale };
    let left = plot.min[0] + pad;
    let right = plot.max[0] - pad;
    let top = plot.min[1] + pad;
    let x = if panel.x.has_title_line() {
        let bottom = plot.max[1] + (Projection::BOTTOM - 2.0) * text_scale;
        ([0.5 * (plot.min[0] + plot.max[0]), bottom], &panel.x.label, Anchor::TOP)
    } else {
        ([right, plot.max[1] - pad], &panel.x.label, Anchor::RIGHT_BOTTOM)
    };
    [([left, top], &panel.y.label, Anchor::LEFT_TOP), ([right, top + below], &panel.note, Anchor::RIGHT_TOP), x]
        .into_iter()
        .flat_map(|([x, y], text, anchor)| {
            let lines = wrapped(text, TextSize::Small, (plot.width() - 2.0 * pad) / text_scale);
            let first = if anchor.1 < 0.5 { 0.0 } else { 1.0 - lines.len() as f64 };
            let line =
                move |(i, text)| Annotation { at: [x, y + LINE * text_scale * (first + i as f64)], text, anchor };
            lines.into_iter().enumerate().map(line)
        })
        .collect()
}
