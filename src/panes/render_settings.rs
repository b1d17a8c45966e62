//! Settings of the render: mesh, material, surface, light, view; and the pixel that is read.

mod image;
mod material;
mod pixel;
mod scene;
mod surface;
mod view;

use egui::{CollapsingHeader, Rect, ScrollArea, Ui, UiBuilder, Vec2};

use super::context::{Pane, PaneContext, set_render as set};
use crate::panes::widgets::{
    self,
    pick_list::{self, Line},
};
use crate::theme::UNIT;
use crate::workspaces::PaneKind;

/// Height of the numbers of a pixel, at the foot of the pane, beside a line for each of some sensors. They lie over the foot of the
/// groups, which stay where they are.
const PIXEL: f32 = 128.0;
const PIXEL_LINE: f32 = 17.0;
const PIXEL_LINES: usize = 6;
/// Height while no pixel is pinned: the status bar reads the one under the pointer.
const NO_PIXEL: f32 = 44.0;
/// Width of a value beside its slider, and of the gap between.
const VALUE: f32 = 76.0;
/// Height of a line of small text, and of a slider.
const LINE: f32 = 15.0;
const SLIDER: f32 = 24.0;
/// In a lower pane they are a group among the others.
const WITH_PIXEL: f32 = 480.0;

pub const PANE: Pane = Pane {
    kind: PaneKind::RENDER_SETTINGS,
    title: "Render settings",
    show,
    figure: None,
    under_conditions: false,
    table: false,
};

fn show(ui: &mut Ui, rect: Rect, context: &mut PaneContext<'_>) {
    let body = widgets::pane(ui, &PANE, rect, context, |_, _| {});
    let sources = context.scene.rendered_sources().len();
    let kept = context.view.render.pinned.is_some();
    let spectrum =
        if context.scene.document.render.mesh.is_image() { widgets::pixel_spectrum::HEIGHT + UNIT } else { 0.0 };
    let foot = if kept { PIXEL + PIXEL_LINE * sources.min(PIXEL_LINES) as f32 + spectrum } else { NO_PIXEL };
    let below = if body.height() > WITH_PIXEL { foot } else { 0.0 };
    let groups = Rect::from_min_max(body.min, egui::pos2(body.right(), body.bottom() - below));
    widgets::scroll::show(ui, (PANE.kind, "render setup"), groups, context, |ui, context| {
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
        ui.painter().hline(
            groups.shrink2(Vec2::new(2.0 * UNIT, 0.0)).x_range(),
            rect.top(),
            egui::Stroke::new(1.0, context.theme.line),
        );
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

/// A small caption above a control.
fn caption(ui: &mut Ui, words: &str, context: &PaneContext<'_>) {
    line(ui, words, words, context.theme.weak);
}

/// One line of small text that keeps its height whatever it says; what is cut, and what it means, is told on hover.
fn line(ui: &mut Ui, words: &str, meaning: &str, color: egui::Color32) {
    let (rect, response) = ui.allocate_exact_size(Vec2::new(ui.available_width(), LINE), egui::Sense::hover());
    if words.is_empty() {
        return;
    }
    let cut = widgets::lines::elided(ui, rect, words, egui::TextStyle::Small, color);
    response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Label, true, words));
    if cut || meaning != words {
        response.on_hover_text(meaning);
    }
}

/// A slider of the settings: its name above, then the slider over the width of the pane and the value. Says what it was moved to.
struct Dial<'a> {
    name: &'static str,
    range: std::ops::RangeInclusive<f64>,
    /// For ranges over powers of ten: the least value above zero.
    logarithmic: Option<f64>,
    unit: &'a str,
    hint: &'a str,
    /// Values beyond the slider may be typed.
    beyond: bool,
    /// False where it has no effect now; it keeps its place.
    enabled: bool,
}

impl Dial<'_> {
    fn show(&self, ui: &mut Ui, now: f64, context: &PaneContext<'_>) -> Option<f64> {
        let mut value = now;
        caption(ui, self.name, context);
        let (rect, _) = ui.allocate_exact_size(Vec2::new(ui.available_width(), SLIDER), egui::Sense::hover());
        let mut child = ui.new_child(UiBuilder::new().id_salt(self.name).max_rect(rect));
        if !self.enabled {
            child.disable();
        }
        let (left, right) = rect.split_left_right_at_x(rect.right() - VALUE);
        let changed = self.slider(&mut child, left.with_max_x(left.right() - 2.0 * UNIT), &mut value)
            | self.field(&mut child, right, &mut value);
        (changed && value.is_finite() && value != now).then(|| short_value(value))
    }

    fn slider(&self, ui: &mut Ui, rect: Rect, value: &mut f64) -> bool {
        ui.spacing_mut().slider_width = rect.width();
        let clamping = if self.beyond { egui::SliderClamping::Never } else { egui::SliderClamping::Edits };
        let mut slider = egui::Slider::new(value, self.range.clone()).clamping(clamping).show_value(false).step_by(0.0);
        if let Some(least) = self.logarithmic {
            slider = slider.logarithmic(true).smallest_positive(least);
        }
        let response = ui.put(rect, slider).on_hover_text(self.hint);
        widgets::take_sought(&response, self.name);
        response.widget_info(|| egui::WidgetInfo::slider(true, *value, self.name));
        response.changed()
    }

    fn field(&self, ui: &mut Ui, rect: Rect, value: &mut f64) -> bool {
        let unit = self.unit.to_owned();
        let mut field = egui::DragValue::new(value)
            // Typing is one step when it is done, not one for each key.
            .update_while_editing(false)
            .speed(0.0)
            .custom_formatter(move |value, _| format!("{}{unit}", short(value)))
            .custom_parser(parsed);
        if !self.beyond {
            field = field.range(self.range.clone());
        }
        let response = ui.put(rect, field).on_hover_text(self.hint);
        response.changed()
    }
}

/// A list of the settings, its name above it, over the width of the pane. Returns the line that was chosen.
fn list(
    ui: &mut Ui,
    name: &'static str,
    [shown, hint]: [&str; 2],
    context: &PaneContext<'_>,
    lines: impl FnOnce() -> Vec<Line>,
) -> Option<usize> {
    caption(ui, name, context);
    let width = ui.available_width();
    pick_list::drop_down(ui, (name, hint), shown, width, &context.theme, lines)
}

/// A list of choices that are told apart by their labels. Returns the one that was chosen.
fn choices<T: Copy + PartialEq>(
    ui: &mut Ui,
    (name, hint): (&'static str, &str),
    (all, now): (&[T], T),
    words: impl Fn(T) -> [&'static str; 2],
    context: &PaneContext<'_>,
) -> Option<T> {
    let line = |&choice: &T| {
        let [label, facts] = words(choice);
        Line { facts: facts.to_owned(), ..Line::new(label, choice == now) }
    };
    let chosen = list(ui, name, [words(now)[0], hint], context, || all.iter().map(line).collect());
    chosen.map(|index| all[index])
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
