//! Patches as colors.

use chromascope_figure::Shape;
use egui::{Id, Rect, RectAlign, ScrollArea, Ui, Vec2};

use super::context::{Pane, PaneContext};
use crate::action::{Action, SceneAction};
use crate::figures::{chromaticity, swatches};
use crate::paint;
use crate::panes::widgets;
use crate::theme::UNIT;
use crate::view::SwatchLayout;
use crate::workspaces::PaneKind;

const FOOTER: f32 = 18.0;
/// Height of the pane from which on it has a line below.
const WITH_FOOTER: f32 = 230.0;

pub const PANE: Pane = Pane::new(PaneKind::SWATCHES, "Swatches", show)
    .settings(settings)
    .figure(&swatches::KIND)
    .under_conditions()
    .table();

fn show(ui: &mut Ui, rect: Rect, context: &mut PaneContext<'_>) {
    let body = widgets::body(ui, &PANE, rect, context, switches);
    if widgets::figure_numbers(ui, &PANE, body, context) {
        return;
    }
    let body = widgets::lines::caution(ui, body, context);
    ui.painter().rect_filled(body, 0.0, context.theme.surround);
    let (mut body, slot) = footer(ui, body, context);
    let size = [f64::from(body.width()), f64::from(body.height())];
    let built = swatches::build(&context.scene, &context.view.look(PANE.kind), size);
    if built.height as f32 > body.height() + 1.0 {
        // Room for the hint at more.
        body.max.y = body.max.y.min(slot.top());
    }
    let mut child = widgets::clipped(ui, "swatches", body);
    let height = (built.height as f32).max(body.height());
    let shown = ScrollArea::vertical().id_salt("swatches scroll").auto_shrink(false).show(&mut child, |ui| {
        let (area, _) = ui.allocate_exact_size(Vec2::new(body.width(), height), egui::Sense::hover());
        board(ui, area, &built, context);
    });
    if height - shown.state.clamped_offset().y > body.height() + 1.0 {
        widgets::more_below(ui, slot, context.theme.on_surround);
    }
}

fn settings(ui: &mut Ui, body: Rect, context: &mut PaneContext<'_>) {
    widgets::scroll(ui, (PaneKind::SETTINGS, "swatches"), body, context, |ui, context| {
        widgets::note(ui, "Within a swatch");
        ui.horizontal_wrapped(|ui| widgets::switch(ui, &mut context.view.saved.swatch_style));
        ui.checkbox(&mut context.view.saved.difference_bars, "Bars under swatches (D)");
        widgets::note(ui, "Surround");
        ui.horizontal_wrapped(|ui| widgets::switch(ui, &mut context.view.saved.surround));
    });
}

/// The scale of the bars below the swatches, where there is room for it or differences are not drawn as they are. Returns what is
/// left above, and the place of the hint at more rows.
fn footer(ui: &Ui, body: Rect, context: &PaneContext<'_>) -> (Rect, Rect) {
    let exaggerated = context.scene.document.exaggeration.note();
    let bars = context.view.saved.difference_bars;
    let line = body.with_min_y(body.bottom() - FOOTER);
    if exaggerated.is_none() && !(bars && body.height() > WITH_FOOTER) {
        return (body, line);
    }
    let words = exaggerated.filter(|_| !bars).unwrap_or_else(|| swatches::bar_scale(&context.scene));
    let at = line.right_center() - Vec2::new(2.0 * UNIT, 0.0);
    let font = egui::FontId::proportional(crate::theme::SMALL);
    let written = ui.painter().text(at, egui::Align2::RIGHT_CENTER, words, font, context.theme.on_surround);
    (body.with_max_y(line.top()), line.with_max_x(written.left() - UNIT))
}

fn board(ui: &mut Ui, area: Rect, built: &swatches::Built, context: &mut PaneContext<'_>) {
    let reference = context.scene.document.reference.clone();
    let shown = {
        let view = &*context.view;
        let emphasis = |tag| match view.emphasis_of(&built.things, tag, &reference) {
            // Colors are judged by eye: none is ever dimmed.
            paint::Emphasis::Faded => paint::Emphasis::Normal,
            emphasis => emphasis,
        };
        paint::board(ui, Id::unique("swatch board"), &built.panel, &context.theme, area, &emphasis)
    };
    let hit = shown.response.hover_pos().and_then(|at| paint::nearest(&built.panel, &shown.view, at, 6.0));
    let thing = hit.and_then(|hit| built.things.get(hit.tag)).cloned();
    context.view.hover(thing.as_ref());
    if shown.response.clicked() {
        context.view.click(thing.as_ref());
    }
    if widgets::walk::along(ui, PaneKind::SWATCHES, context, widgets::walk::patches_by_sensor) {
        let cursor = context.view.cursor.as_ref();
        let mark = built.panel.marks.iter().find(|mark| cursor.is_some() && built.things.get(mark.tag) == cursor);
        if let Some(Shape::Rect { min, max }) = mark.map(|mark| &mark.shape) {
            ui.scroll_to_rect(Rect::from_two_pos(shown.view.at(*min), shown.view.at(*max)), None);
        }
    }
    if let Some(thing) = thing {
        let mut lines = chromaticity::brief(&context.scene, &thing);
        if context.view.saved.difference_bars && lines.len() > 1 {
            lines.push(swatches::bar_scale(&context.scene));
        }
        let pane = area.intersect(ui.clip_rect());
        widgets::read_beside(&shown.response, pane, [RectAlign::LEFT, RectAlign::RIGHT], &lines);
    }
}

fn switches(ui: &mut Ui, context: &mut PaneContext<'_>) {
    let count = context.scene.patches().map_or(0, |set| set.patches().len());
    if context.scene.has_five() {
        if let Some(subset) = widgets::choice(ui, context.scene.document.subset) {
            context.push(Action::Scene(SceneAction::SetSubset(subset)));
        }
        ui.add_space(0.5 * UNIT);
    }
    let rows = swatches::in_rows(context.view.saved.swatch_layout, count);
    let layout = if rows { SwatchLayout::Rows } else { SwatchLayout::Charts };
    if let Some(layout) = widgets::choice_of(ui, &[SwatchLayout::Rows, SwatchLayout::Charts], layout) {
        context.view.saved.swatch_layout = layout;
        ui.ctx().request_repaint();
    }
    ui.add_space(0.5 * UNIT);
    if let Some((words, thing)) = swatches::worst(&context.scene)
        && ui.button("Worst").on_hover_text(format!("{words}: click to select it")).clicked()
    {
        context.view.selected = Some(thing);
    }
}
