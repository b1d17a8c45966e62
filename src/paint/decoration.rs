//! Surroundings of the marks: ground, grid, frame, tick labels, notes.

use chromascope_figure::{Anchor, Annotation, Ink, InkRole, Panel, Rect as Area, TextSize, Tick, annotations};
use egui::{Painter, Pos2, Rect, Stroke, StrokeKind};

use super::{EmphasisOf, View, marks};
use crate::theme::Theme;

/// Draws a panel whose plot is `view` and whose outer box is `rect`.
pub(super) fn panel(
    painter: &Painter,
    panel: &Panel,
    view: &View,
    rect: Rect,
    theme: &Theme,
    emphasis: EmphasisOf<'_>,
) {
    let inside = painter.with_clip_rect(view.rect.intersect(painter.clip_rect()));
    inside.rect_filled(view.rect, 0.0, theme.ink(panel.background));
    let x_ticks = panel.x.ticks_over(view.x, f64::from(view.rect.width()));
    let y_ticks = panel.y.vertical_ticks_over(view.y, f64::from(view.rect.height()));
    let thin = Stroke::new(crate::theme::LINE_GRID as f32, theme.grid);
    if panel.x.grid {
        for tick in &x_ticks {
            let x = painter.round_to_pixel_center(view.at([tick.value, view.y[0]]).x);
            inside.vline(x, view.rect.y_range(), thin);
        }
    }
    if panel.y.grid {
        for tick in &y_ticks {
            let y = painter.round_to_pixel_center(view.at([view.x[0], tick.value]).y);
            inside.hline(view.rect.x_range(), y, thin);
        }
    }
    for mark in &panel.marks {
        marks::mark(&inside, mark, view, theme, emphasis(mark.tag));
    }
    if panel.framed {
        let stroke = Stroke::new(1.0, theme.line);
        painter.rect_stroke(view.rect, 0.0, stroke, StrokeKind::Outside);
    }
    tick_labels(painter, view, rect, theme, &x_ticks, &y_ticks);
    let plot = Area {
        min: [f64::from(view.rect.left()), f64::from(view.rect.top())],
        max: [f64::from(view.rect.right()), f64::from(view.rect.bottom())],
    };
    for Annotation { at, text, anchor } in annotations(panel, plot, 1.0) {
        let at = Pos2::new(at[0] as f32, at[1] as f32);
        let style =
            marks::TextStyle { anchor, size: TextSize::Small, ink: InkRole::Weak.into(), halo: Some(panel.background) };
        marks::text(painter, at, &text, style, theme);
    }
}

fn tick_labels(painter: &Painter, view: &View, rect: Rect, theme: &Theme, x_ticks: &[Tick], y_ticks: &[Tick]) {
    let style =
        |anchor: Anchor| marks::TextStyle { anchor, size: TextSize::Body, ink: Ink::new(InkRole::Weak), halo: None };
    for tick in x_ticks.iter().filter(|tick| !tick.label.is_empty()) {
        let at = Pos2::new(view.at([tick.value, view.y[0]]).x, view.rect.bottom() + 4.0);
        marks::text_inside(painter, at, &tick.label, style(Anchor::TOP), theme, rect);
    }
    for tick in y_ticks.iter().filter(|tick| !tick.label.is_empty()) {
        let at = Pos2::new(view.rect.left() - 6.0, view.at([view.x[0], tick.value]).y);
        marks::text_inside(painter, at, &tick.label, style(Anchor::RIGHT), theme, rect);
    }
}
