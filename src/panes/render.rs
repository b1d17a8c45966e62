//! A mesh through each camera, side by side, from one orbit.

mod draw;
mod request;
mod settings;

use std::time::Duration;

use draw::PictureLayout;
use egui::{Align2, EventFilter, FontId, Key, Modifiers, PointerButton, Rect, Response, Sense, Ui};

use super::context::{Pane, PaneContext};
use crate::action::{Action, RenderAction};
use crate::document::render::SUN;
use crate::figures;
use crate::panes::widgets;
use crate::plot_item::PlotItem;
use crate::render_service::REST_AFTER;
use crate::scene::orbit::Orbit;
use crate::theme::{HEADING, UNIT};
use crate::view::{PixelPlace, RenderMode};
use crate::workspaces::PaneKind;

pub const PANE: Pane = Pane::new(PaneKind::RENDER, "Render", show)
    .figure(&figures::render::KIND)
    .under_conditions()
    .table()
    .tab("Pictures")
    .settings(settings::show);

#[derive(Default)]
struct RenderPane {
    /// Time of egui in seconds since which the pictures are of something else than what is chosen.
    old_since: Option<f64>,
}

fn show(ui: &mut Ui, rect: Rect, context: &mut PaneContext<'_>) {
    let body = widgets::body(ui, &PANE, rect, context, switches);
    context.view.render.hovered = None;
    if context.view.reset_plots {
        context.view.saved.render.orbit = None;
    }
    let sources = context.scene.rendered_sources();
    let layout = PictureLayout::new(&sources, body, ui.ctx().pixels_per_point(), context);
    let asked = request::ask(ui, &layout, context);
    let busy = context.render_service.busy();
    if widgets::figure_numbers(ui, &PANE, body, context) {
        widgets::busy_line(ui, body, busy, context.theme.on_surround);
        return;
    }
    let painter = ui.painter().with_clip_rect(body.intersect(ui.clip_rect()));
    painter.rect_filled(body, 0.0, context.theme.surround);
    let id = ui.scope_id().with("render orbit");
    let response = ui.interact(body, id, Sense::click_and_drag());
    widgets::labeled(&response, egui::Role::Canvas, "Rendered pictures");
    if !context.scene.document.render.mesh.is_image() {
        by_pointer(ui, &response, context);
        by_keys(ui, &response, context);
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
    widgets::busy_line(ui, body, busy, context.theme.on_surround);
    if response.has_focus() {
        let stroke = egui::Stroke::new(1.0, context.theme.on_surround);
        ui.painter().rect_stroke(body, 0.0, stroke, egui::StrokeKind::Inside);
    }
}

/// Dims pictures of something else than what is chosen, and says what is being rendered, unless the new ones come at once.
fn mark_old(ui: &Ui, painter: &egui::Painter, response: &egui::Response, context: &mut PaneContext<'_>) {
    let now = ui.input(|input| input.time);
    let old_since = &mut context.states.of::<RenderPane>().old_since;
    if context.view.render.cancelled || !context.render_service.is_of_another() {
        *old_since = None;
        return;
    }
    let left = *old_since.get_or_insert(now) + REST_AFTER - now;
    if left > 0.0 {
        ui.ctx().request_repaint_after(Duration::from_secs_f64(left));
        return;
    }
    let light = if context.scene.is_sunlit() { SUN.to_owned() } else { context.scene.light_name() };
    let words = format!("Rendering {}, {light}…", context.scene.document.render.mesh.name());
    painter.rect_filled(response.rect, 0.0, context.theme.surround.gamma_multiply(0.6));
    say(painter, response.rect, &words, context);
    widgets::labeled(response, egui::Role::Canvas, &words);
}

fn say(painter: &egui::Painter, body: Rect, words: &str, context: &PaneContext<'_>) {
    let galley = painter.layout(
        words.to_owned(),
        FontId::proportional(HEADING),
        context.theme.on_surround,
        (body.width() - 40.0).max(80.0),
    );
    let at = Align2::CENTER_CENTER.align_size_within_rect(galley.size(), body).min;
    painter.galley(at, galley, context.theme.on_surround);
}

/// Shows values of the pixel under the pointer; a click pins it, a double click shows its sensor alone or all again.
fn point_at(ui: &Ui, response: &egui::Response, layout: &PictureLayout, context: &mut PaneContext<'_>) {
    let Some(pointer) = response.hover_pos() else { return };
    let Some((cell, at)) = layout.place_at(pointer) else { return };
    let Some(source) = layout.sources.get(cell).map(figures::chromaticity::id) else { return };
    let place = PixelPlace { at, source: source.clone() };
    if response.double_clicked() {
        let look = &mut context.view.saved.render;
        look.mode = if look.mode == RenderMode::Grid { RenderMode::One } else { RenderMode::Grid };
        context.view.render.chosen = Some(source);
        context.view.render.pinned = None;
        ui.ctx().request_repaint();
        return;
    }
    let shot = context.render_service.frame().cloned();
    let patch = shot.as_deref().and_then(|shot| figures::render::patch_at(&context.scene, shot, &place));
    let item = match patch {
        Some(patch) => PlotItem::Patch { source: Some(source), patch },
        None => PlotItem::Sensor(source),
    };
    if response.clicked() {
        if item.patch().is_some() {
            context.view.click(Some(&item));
        }
        context.view.render.pinned = Some(place.clone());
        ui.ctx().request_repaint();
    }
    if !response.dragged() {
        context.view.point = shot.and_then(|shot| figures::render::pixel_line(&context.scene, &shot, &place));
        context.view.hover(Some(&item));
        context.view.render.hovered = Some(place);
    }
}

fn switches(ui: &mut Ui, context: &mut PaneContext<'_>) {
    widgets::switch(ui, &mut context.view.saved.render.mode);
    ui.add_space(UNIT);
    let figures = [
        (RenderAction::Figure8, "Figure 8", "The paper's head"),
        (RenderAction::Figure9, "Figure 9", "The paper's fern"),
    ];
    // All of them have room in a narrow pane.
    ui.spacing_mut().button_padding.x = 0.5 * UNIT;
    ui.spacing_mut().item_spacing.x = 0.75 * UNIT;
    for (action, words, mesh) in figures {
        let hint = format!(
            "{mesh} in parallel sunlight without sky, balanced to D55, with the reflectance model chosen under Surface \
             (initially radiometric). Also sets light and white balance; the compared sensors stay."
        );
        if ui.button(words).on_hover_text(hint).clicked() {
            set_up(action, context);
        }
    }
    let menu = ui.menu_button("⋯", |ui| {
        for action in [RenderAction::PaperFigure8, RenderAction::PaperFigure9] {
            let words = Action::Render(action.clone()).name();
            let hint = "The paper's setup: a point light, and Eq 12 with P as printed: no Fresnel factor, A = XY. \
                        The paper does not give σ and τ; they are this program's.";
            if ui.button(words).on_hover_text(hint).clicked() {
                set_up(action, context);
                ui.close();
            }
        }
    });
    widgets::labeled(&menu.response, egui::Role::Button, "Figures as in the paper");
    menu.response.on_hover_text("Figures 8 and 9 as in the paper: point light, the paper's normalization");
}

fn set_up(action: RenderAction, context: &mut PaneContext<'_>) {
    context.view.saved.render.orbit = None;
    context.push(Action::Render(action));
}

const DRAG: f64 = 0.4;
const STEP: f64 = 5.0;
const NEARER: f64 = 0.9;

/// Drag turns, wheel and pinch approach.
fn by_pointer(ui: &Ui, response: &Response, context: &mut PaneContext<'_>) {
    if response.clicked() || response.drag_started() {
        // Keys act on this pane now, not on an earlier text field; letters are free unless a control has the focus.
        ui.memory_mut(|memory| {
            if let Some(other) = memory.focused() {
                memory.surrender_focus(other);
            }
        });
    }
    if response.dragged_by(PointerButton::Primary) {
        let moved = response.drag_delta();
        if moved != egui::Vec2::ZERO {
            change(ui, context, |orbit| orbit.turned(-DRAG * f64::from(moved.x), DRAG * f64::from(moved.y)));
        }
    }
    if response.contains_pointer() {
        let (scroll, zoom) = ui.input(|input| (input.smooth_scroll_delta().y, input.zoom_delta()));
        if scroll != 0.0 || zoom != 1.0 {
            let factor = (-0.003 * f64::from(scroll)).exp() / f64::from(zoom.max(0.01));
            change(ui, context, |orbit| orbit.at_distance(factor));
        }
    }
}

/// Arrows turn, + and − approach, while the pictures have the keyboard, or nothing else has.
fn by_keys(ui: &Ui, response: &Response, context: &mut PaneContext<'_>) {
    if response.has_focus() {
        let arrows = EventFilter { horizontal_arrows: true, vertical_arrows: true, ..EventFilter::default() };
        ui.memory_mut(|memory| memory.set_focus_lock_filter(response.id, arrows));
    }
    let idle = context.view.focused == Some(PaneKind::RENDER) && ui.memory(|memory| memory.focused().is_none());
    if !response.has_focus() && !idle {
        return;
    }
    let (x, y, nearer) = ui.input_mut(|input| {
        if !input.modifiers.is_none() && !input.modifiers.shift_only() {
            return (0.0, 0.0, 0.0);
        }
        let mut presses = |key: Key| input.count_and_consume_key(Modifiers::NONE, key) as f64;
        (
            presses(Key::ArrowRight) - presses(Key::ArrowLeft),
            presses(Key::ArrowUp) - presses(Key::ArrowDown),
            presses(Key::Plus) + presses(Key::Equals) - presses(Key::Minus),
        )
    });
    if x != 0.0 || y != 0.0 {
        change(ui, context, |orbit| orbit.turned(STEP * x, STEP * y));
    }
    if nearer != 0.0 {
        change(ui, context, |orbit| orbit.at_distance(NEARER.powf(nearer)));
    }
}

fn change(ui: &Ui, context: &mut PaneContext<'_>, to: impl FnOnce(Orbit) -> Orbit) {
    let now = context.view.saved.render.orbit.unwrap_or_else(|| Orbit::of(&context.scene.document.render));
    context.view.saved.render.orbit = Some(to(now));
    ui.ctx().request_repaint();
}
