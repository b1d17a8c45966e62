//! A mesh through each camera, side by side, from one orbit.

mod cells;
mod difference;
mod draw;
mod orbit;
mod request;
mod switches;

use std::time::Duration;

use egui::{Align2, FontId, Rect, Sense, Ui, Vec2};

use super::context::{Pane, PaneContext};
use crate::document::render::SUN;
use crate::panes::widgets;
use crate::render_service::REST_AFTER;
use crate::theme::{HEADING, UNIT};
use crate::view::render::{PixelPlace, RenderMode};
use crate::workspaces::PaneKind;
use cells::PictureLayout;

pub const PANE: Pane = Pane {
    kind: PaneKind::RENDER,
    title: "Render",
    show,
    figure: Some(crate::figures::render::figure),
    under_conditions: true,
    table: true,
};

fn show(ui: &mut Ui, rect: Rect, context: &mut PaneContext<'_>) {
    let body = widgets::pane(ui, &PANE, rect, context, switches::show);
    let body = Rect::from_min_max(body.min + Vec2::new(2.0 * UNIT, 0.0), body.max - Vec2::new(2.0 * UNIT, UNIT));
    context.view.render.hovered = None;
    if context.view.reset_plots {
        context.view.saved.render.orbit = None;
    }
    let sources = context.scene.rendered_sources();
    let layout = PictureLayout::new(&sources, body, ui.ctx().pixels_per_point(), context);
    let asked = request::ask(ui, &layout, context);
    let busy = context.render_service.busy();
    context.view.render.busy = busy;
    if context.view.saved.tables.contains(&PaneKind::RENDER) {
        if let Some(figure) = crate::figures::render::figure(&context.figure_input()) {
            widgets::table::show_numbers(ui, body, PaneKind::RENDER, &figure.table, context);
        }
        widgets::busy_line(ui, body, busy, context.theme.surround.label());
        return;
    }
    let painter = ui.painter().with_clip_rect(body.intersect(ui.clip_rect()));
    painter.rect_filled(body, 0.0, context.theme.surround.color());
    let id = ui.scope_id().with("render orbit");
    let response = ui.interact(body, id, Sense::click_and_drag());
    response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Canvas, true, "Rendered pictures"));
    if !context.scene.document.render.mesh.is_image() {
        orbit::by_pointer(ui, &response, context);
        orbit::by_keys(ui, &response, context);
    }
    if let Err(words) = asked {
        context.render_service.hide();
        say(&painter, body, &words, context);
    } else {
        draw::pictures(ui, &painter, &layout, context);
        mark_old(ui, &painter, &response, context);
        point_at(ui, &response, &layout, context);
        draw::divider(ui, &layout, context);
        draw::choosers(ui, &layout, &sources, context);
    }
    widgets::busy_line(ui, body, busy, context.theme.surround.label());
    if response.has_focus() {
        let stroke = egui::Stroke::new(1.0, context.theme.surround.label());
        ui.painter().rect_stroke(body, 0.0, stroke, egui::StrokeKind::Inside);
    }
}

/// Dims pictures of something else than what is chosen, and says what is being rendered, unless the new ones come at once.
fn mark_old(ui: &Ui, painter: &egui::Painter, response: &egui::Response, context: &mut PaneContext<'_>) {
    let now = ui.input(|input| input.time);
    let view = &mut context.view.render;
    if view.cancelled || !context.render_service.is_of_another() {
        view.old_since = None;
        return;
    }
    let left = *view.old_since.get_or_insert(now) + REST_AFTER - now;
    if left > 0.0 {
        ui.ctx().request_repaint_after(Duration::from_secs_f64(left));
        return;
    }
    let light = if context.scene.is_sunlit() { SUN.to_owned() } else { context.scene.light_name() };
    let words = format!("Rendering {}, {light}…", context.scene.document.render.mesh.name());
    painter.rect_filled(response.rect, 0.0, context.theme.surround.color().gamma_multiply(0.6));
    say(painter, response.rect, &words, context);
    response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Canvas, true, &words));
}

/// Draws a message in place of pictures.
fn say(painter: &egui::Painter, body: Rect, words: &str, context: &PaneContext<'_>) {
    let galley = painter.layout(
        words.to_owned(),
        FontId::proportional(HEADING),
        context.theme.surround.label(),
        (body.width() - 40.0).max(80.0),
    );
    let at = Align2::CENTER_CENTER.align_size_within_rect(galley.size(), body).min;
    painter.galley(at, galley, context.theme.surround.label());
}

/// Shows values of the pixel under the pointer; a click pins it, a double click shows its sensor alone or all again.
fn point_at(ui: &Ui, response: &egui::Response, layout: &PictureLayout, context: &mut PaneContext<'_>) {
    let Some(pointer) = response.hover_pos() else { return };
    let Some((cell, at)) = layout.place_at(pointer) else { return };
    let Some(source) = layout.sources.get(cell).map(crate::figures::chromaticity::id) else { return };
    let place = PixelPlace { at, source: source.clone() };
    if response.double_clicked() {
        let look = &mut context.view.saved.render;
        look.mode = if look.mode == RenderMode::Grid { RenderMode::One } else { RenderMode::Grid };
        context.view.render.chosen = Some(source);
        context.view.render.pinned = None;
        ui.ctx().request_repaint();
        return;
    }
    if response.clicked() {
        context.view.render.pinned = Some(place.clone());
        ui.ctx().request_repaint();
    }
    if !response.dragged() {
        let pictures = context.render_service.frame();
        context.view.point = pictures.and_then(|shot| crate::figures::render::pixel_line(&context.scene, shot, &place));
        context.view.hover(Some(&crate::plot_item::PlotItem::Sensor(source)));
        context.view.render.hovered = Some(place);
    }
}
