//! The Figure page: a pane as it is printed, beside the settings of its paper.

mod settings;
mod sheet;

use std::sync::Arc;

use chromascope_figure::Figure;
use egui::{Rect, RichText, Ui, UiBuilder, Vec2};

use super::context::PaneContext;
use super::{by_kind, show as show_pane};
use crate::export::page::PageFacts;
use crate::theme::UNIT;
use crate::workspaces::PaneKind;

/// Width of the settings in points.
const SETTINGS: f32 = 300.0;
/// Panes whose figures follow from the document alone. The others ask for work in the background while they are shown.
const OF_DOCUMENT: [PaneKind; 3] = [PaneKind::CHROMATICITY, PaneKind::SWATCHES, PaneKind::SPECTRA];

/// Shows the page of a pane in its rectangle.
pub fn show(ui: &mut Ui, rect: Rect, kind: PaneKind, context: &mut PaneContext<'_>) {
    let pressed = |input: &egui::InputState| {
        input.pointer.any_pressed() && input.pointer.interact_pos().is_some_and(|at| rect.contains(at))
    };
    if ui.input(pressed) {
        context.view.focused = Some(kind);
    }
    keep_working(ui, rect, kind, context);
    ui.painter().rect_filled(rect, 0.0, context.theme.panel);
    let figure = made(ui, kind, context);
    let facts = figure.as_deref().map(|figure| PageFacts::of(figure, &context.view.saved.page.paper));
    let cut = rect.right() - SETTINGS.min(0.5 * rect.width());
    sheet::show(ui, rect.with_max_x(cut), (kind, figure), context);
    ui.painter().vline(cut + 0.5, rect.y_range(), egui::Stroke::new(1.0, context.theme.line));
    settings::show(ui, rect.with_min_x(cut + 1.0), (kind, facts), context);
    // Esc leaves a field before it leaves the page.
    if context.view.palette.is_none() && context.view.help.page.is_none() {
        context.view.keeps_escape = ui.ctx().text_edit_focused();
    }
}

/// Lets a pane that is not seen go on asking for what its figure needs.
fn keep_working(ui: &mut Ui, rect: Rect, kind: PaneKind, context: &mut PaneContext<'_>) {
    if OF_DOCUMENT.contains(&kind) {
        return;
    }
    // No key is meant for it.
    let (focused, enters) = (context.view.focused.take(), std::mem::take(&mut context.view.tab_enters));
    let mut unseen = ui.new_child(UiBuilder::new().id_salt("unseen pane").max_rect(rect).invisible());
    unseen.set_clip_rect(Rect::NOTHING);
    show_pane(&mut unseen, kind, rect, context);
    (context.view.focused, context.view.tab_enters) = (focused, enters);
}

/// The figure, made anew ten times a second at most while neither pane nor paper change.
fn made(ui: &Ui, kind: PaneKind, context: &mut PaneContext<'_>) -> Option<Arc<Figure>> {
    let (of, now) = ((kind, context.view.saved.page.paper), ui.input(|input| input.time));
    if let Some((figure, rest)) = context.view.page.fresh(of, now) {
        ui.ctx().request_repaint_after(rest);
        return figure;
    }
    let shown = by_kind(kind).and_then(|pane| pane.figure);
    let figure = shown.and_then(|shown| shown.on_paper(&of.1, &context.scene, &context.look(kind)));
    context.view.page.keep(of, now, figure)
}

/// A child of a rectangle with some space along its sides.
fn inside(ui: &mut Ui, salt: &'static str, rect: Rect) -> Ui {
    let inner = rect.shrink2(Vec2::new(2.0 * UNIT, 0.0));
    let mut child = ui.new_child(UiBuilder::new().id_salt(salt).max_rect(inner));
    child.set_clip_rect(rect.intersect(ui.clip_rect()));
    child
}

/// Small, weak text.
fn small(words: impl Into<String>, context: &PaneContext<'_>) -> RichText {
    RichText::new(words).small().color(context.theme.weak)
}
