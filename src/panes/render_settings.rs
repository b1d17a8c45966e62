//! Settings of the render: mesh, material, surface, light, view; and the pixel that is read.

mod image;
mod material;
mod pixel;
mod scene;
mod surface;
mod view;

use egui::{CollapsingHeader, Rect, ScrollArea, Ui, UiBuilder, Vec2};

use super::context::{Pane, PaneContext};
use crate::action::{Action, RenderAction};
use crate::document::render::RenderSettings;
use crate::panes::widgets;
use crate::theme::UNIT;
use crate::workspaces::PaneKind;

/// Height of the pixel's numbers at the foot of the pane, in addition to a line for each of some sensors.
const PIXEL: f32 = 128.0;
const PIXEL_LINE: f32 = 17.0;
const PIXEL_LINES: usize = 6;
/// Height while no pixel is pinned: the status bar reads the one under the pointer.
const NO_PIXEL: f32 = 44.0;
/// In a lower pane they are a group among the others.
const WITH_PIXEL: f32 = 480.0;

/// The pane.
pub const PANE: Pane = Pane {
    kind: PaneKind::RENDER_SETTINGS,
    title: "Render settings",
    show,
    figure: None,
    under_conditions: false,
    table: false,
};

/// Shows the pane in its rectangle.
fn show(ui: &mut Ui, rect: Rect, context: &mut PaneContext<'_>) {
    let body = widgets::pane(ui, &PANE, rect, context, |_, _| {});
    let sources = context.render_service.frame().map_or(0, |shot| shot.sources.len());
    let kept = context.view.render.pinned.is_some();
    let spectrum =
        if context.scene.document.render.mesh.is_image() { widgets::pixel_spectrum::HEIGHT + UNIT } else { 0.0 };
    let foot = if kept { PIXEL + PIXEL_LINE * sources.min(PIXEL_LINES) as f32 + spectrum } else { NO_PIXEL };
    let below = if body.height() > WITH_PIXEL { foot } else { 0.0 };
    let groups = Rect::from_min_max(body.min, egui::pos2(body.right(), body.bottom() - below));
    let inner = groups.shrink2(Vec2::new(2.0 * UNIT, 0.0));
    let mut child = ui.new_child(UiBuilder::new().id_salt("render setup").max_rect(inner));
    child.set_clip_rect(groups.intersect(ui.clip_rect()));
    ScrollArea::vertical().id_salt("render setup").auto_shrink(false).show(&mut child, |ui| {
        ui.set_max_width(inner.width() - 2.0 * UNIT);
        ui.spacing_mut().slider_width = 88.0;
        ui.spacing_mut().item_spacing.y = 0.5 * UNIT;
        group(ui, "Mesh and light", true, context, scene::show);
        let no_surface = "A spectral image has no surface.";
        group(ui, "Surface", true, context, |ui, context| unless_image(ui, no_surface, context, surface::show));
        group(ui, "View", true, context, view::show);
        if below == 0.0 {
            group(ui, "Pixel", true, context, pixel::show);
        }
        ui.add_space(2.0 * UNIT);
    });
    if below > 0.0 {
        let rect = Rect::from_min_max(groups.left_bottom(), body.max);
        ui.painter().hline(inner.x_range(), rect.top(), egui::Stroke::new(1.0, context.theme.line));
        let room = rect.shrink2(Vec2::new(2.0 * UNIT, UNIT));
        let mut child = ui.new_child(UiBuilder::new().id_salt("pixel").max_rect(room));
        child.set_clip_rect(rect.intersect(ui.clip_rect()));
        ScrollArea::vertical().id_salt("pixel").auto_shrink(false).show(&mut child, |ui| pixel::show(ui, context));
    }
}

/// A group that folds.
fn group(
    ui: &mut Ui,
    words: &str,
    open: bool,
    context: &mut PaneContext<'_>,
    content: impl FnOnce(&mut Ui, &mut PaneContext<'_>),
) {
    CollapsingHeader::new(words).id_salt(words).default_open(open).show(ui, |ui| content(ui, context));
}

/// Controls that do nothing for a spectral image: dim then, below the reason.
fn unless_image(
    ui: &mut Ui,
    reason: &str,
    context: &mut PaneContext<'_>,
    content: impl FnOnce(&mut Ui, &mut PaneContext<'_>),
) {
    let is_image = context.scene.document.render.mesh.is_image();
    if is_image {
        caption(ui, reason, context);
    }
    ui.add_enabled_ui(!is_image, |ui| content(ui, context));
}

/// Changes the settings; changes of the same name during one drag are one step.
fn set(context: &mut PaneContext<'_>, what: &'static str, change: impl FnOnce(&mut RenderSettings)) {
    let mut to = context.scene.document.render.clone();
    change(&mut to);
    context.push(Action::Render(RenderAction::Set { what, to: Box::new(to) }));
}

/// A small caption above a control.
fn caption(ui: &mut Ui, words: &str, context: &PaneContext<'_>) {
    ui.label(egui::RichText::new(words).small().color(context.theme.weak));
}

/// A slider of the settings: a value with its name. Returns the new value.
struct Dial<'a> {
    name: &'static str,
    range: std::ops::RangeInclusive<f64>,
    /// For ranges over powers of ten: the least value above zero.
    logarithmic: Option<f64>,
    unit: &'a str,
    hint: &'a str,
    /// Values beyond the slider may be typed.
    beyond: bool,
}

impl Dial<'_> {
    fn show(&self, ui: &mut Ui, now: f64) -> Option<f64> {
        let mut value = now;
        let unit = self.unit.to_owned();
        let clamping = if self.beyond { egui::SliderClamping::Never } else { egui::SliderClamping::Edits };
        let mut slider = egui::Slider::new(&mut value, self.range.clone())
            .clamping(clamping)
            // Typing is one step when it is done, not one for each key.
            .update_while_editing(false)
            .text(self.name)
            .step_by(0.0)
            .custom_formatter(move |value, _| format!("{}{unit}", short(value)))
            .custom_parser(parsed);
        if let Some(least) = self.logarithmic {
            slider = slider.logarithmic(true).smallest_positive(least);
        }
        let response = ui.add(slider).on_hover_text(self.hint);
        widgets::take_sought(&response, self.name);
        (response.changed() && value.is_finite() && value != now).then(|| short_value(value))
    }
}

/// A value as it is shown: three digits.
fn short(value: f64) -> String {
    crate::format::number(short_value(value))
}

/// Three digits: the precision of a drag and of reading.
fn short_value(value: f64) -> f64 {
    if value == 0.0 || !value.is_finite() {
        return 0.0;
    }
    let scale = 10_f64.powi(2 - value.abs().log10().floor() as i32);
    (value * scale).round() / scale
}

/// A number before its unit, with either minus sign.
fn parsed(text: &str) -> Option<f64> {
    let number: String =
        text.replace('−', "-").chars().take_while(|c| c.is_ascii_digit() || "+-.eE".contains(*c)).collect();
    number.trim().parse().ok()
}
