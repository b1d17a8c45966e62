//! Patches as colors.

use chromascope_figure::Shape;
use egui::{Id, Rect, ScrollArea, Ui, Vec2};

use super::context::{Pane, PaneContext};
use crate::action::{Action, SceneAction};
use crate::figures::{chromaticity, swatches};
use crate::paint;
use crate::panes::widgets;
use crate::theme::UNIT;
use crate::view::SwatchLayout;
use crate::workspaces::PaneKind;

const FOOTER: f32 = 24.0;

pub const PANE: Pane =
    Pane::new(PaneKind::SWATCHES, "Swatches", show).figure(&swatches::KIND).under_conditions().table();

fn show(ui: &mut Ui, rect: Rect, context: &mut PaneContext<'_>) {
    let body = widgets::body(ui, &PANE, rect, context, switches);
    if widgets::figure_numbers(ui, &PANE, body, context) {
        return;
    }
    let body = widgets::lines::caution(ui, body, context);
    ui.painter().rect_filled(body, 0.0, context.theme.surround);
    let (body, slot) = footer(ui, body, context);
    let size = [f64::from(body.width()), f64::from(body.height())];
    let built = swatches::build(&context.scene, &context.view.look(PANE.kind), size);
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

/// The line below the swatches: a button that selects the worst patch, and the scale of the bars. Returns what is left above, and
/// the place of the hint at more rows.
fn footer(ui: &mut Ui, body: Rect, context: &mut PaneContext<'_>) -> (Rect, Rect) {
    let Some((words, thing)) = swatches::worst(&context.scene) else {
        return (body, body.with_min_y(body.bottom() - FOOTER));
    };
    let color = context.theme.on_surround;
    let font = egui::FontId::proportional(crate::theme::SMALL);
    let scale = context.view.saved.difference_bars.then(|| swatches::bar_scale(&context.scene));
    let scale = scale.map(|words| ui.painter().layout_no_wrap(words, font.clone(), color));
    let inner = body.width() - 4.0 * UNIT;
    let padding = ui.spacing().button_padding;
    let text = ui.painter().layout(words.clone(), font, color, inner - 2.0 * padding.x);
    let size = (text.size() + 2.0 * padding + Vec2::splat(1.0)).max(Vec2::new(0.0, FOOTER - 6.0));
    let beside = scale.as_ref().is_none_or(|scale| size.x + 4.0 * UNIT + scale.size().x <= inner);
    let height = size.y + 6.0 + if beside { 0.0 } else { 16.0 };
    let top = body.bottom() - height;
    let place = Rect::from_min_size(body.left_bottom() + Vec2::new(2.0 * UNIT, 2.0 - height), size);
    let response = ui.put(place, egui::Button::new(egui::RichText::new(words).small()).wrap());
    if response.on_hover_text("Largest difference: click to select it").clicked() {
        context.view.selected = Some(thing);
    }
    if let Some(scale) = scale {
        let middle = if beside { place.center().y } else { body.bottom() - 9.0 };
        let at = egui::Pos2::new(body.right() - 2.0 * UNIT - scale.size().x, middle - 0.5 * scale.size().y);
        ui.painter().galley(at, scale, color);
    }
    let rest = body.with_max_y(top);
    let beside_button = egui::Pos2::new(place.right() + 2.0 * UNIT, place.top());
    (rest, Rect::from_min_size(beside_button, Vec2::new(body.right() - beside_button.x, place.height())))
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
        let lines = chromaticity::brief(&context.scene, &thing);
        widgets::read_at_pointer(&shown.response, &lines);
    }
}

fn switches(ui: &mut Ui, context: &mut PaneContext<'_>) {
    let count = context.scene.patches().map_or(0, |set| set.patches().len());
    if context.scene.has_five() {
        if let Some(subset) = widgets::choice(ui, context.scene.document.subset) {
            context.push(Action::Scene(SceneAction::SetSubset(subset)));
        }
        ui.add_space(UNIT);
    }
    let rows = swatches::in_rows(context.view.saved.swatch_layout, count);
    let layout = if rows { SwatchLayout::Rows } else { SwatchLayout::Charts };
    if let Some(layout) = widgets::choice_of(ui, &[SwatchLayout::Rows, SwatchLayout::Charts], layout) {
        context.view.saved.swatch_layout = layout;
        ui.ctx().request_repaint();
    }
    ui.add_space(UNIT);
    widgets::switch(ui, &mut context.view.saved.swatch_style);
}
