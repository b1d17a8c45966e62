//! Settings of the render: mesh, material, surface, light, view.

mod scene;

use chromascope_text::{Look, Number, Pick, Setting, Settings as _, Value};
use egui::{CollapsingHeader, DragValue, Rect, Ui, UiBuilder, Vec2};

use crate::document::render::RenderSettings;
use crate::document::render::settings::{LIGHT, SURFACE, VIEW};
use crate::format::number;
use crate::panes::context::PaneContext;
use crate::panes::context::set_render as set;
use crate::panes::widgets;
use crate::panes::widgets::pick_list::{self, Line};
use crate::scene::orbit::Orbit;
use crate::theme::UNIT;
use crate::workspaces::PaneKind;

/// Width of a value beside its slider, and of the gap between.
const VALUE: f32 = 76.0;
/// Height of a line of small text, and of a slider.
const LINE: f32 = 15.0;
const SLIDER: f32 = 24.0;

/// Shows the settings in a rectangle of the right column.
pub(super) fn show(ui: &mut Ui, body: Rect, context: &mut PaneContext<'_>) {
    widgets::scroll(ui, (PaneKind::SETTINGS, "render setup"), body, context, |ui, context| {
        ui.spacing_mut().item_spacing.y = 0.5 * UNIT;
        group(ui, LIGHT, context, |ui, context| controls(ui, LIGHT, context));
        group(ui, SURFACE, context, scene::surface);
        group(ui, VIEW, context, show_view);
        ui.add_space(2.0 * UNIT);
    });
}

fn group(ui: &mut Ui, words: &str, context: &mut PaneContext<'_>, content: impl FnOnce(&mut Ui, &mut PaneContext<'_>)) {
    CollapsingHeader::new(words).id_salt(words).default_open(true).show(ui, |ui| content(ui, context));
}

/// Controls of a group's settings. Those without effect now are dim, below the reason.
fn controls(ui: &mut Ui, group: &str, context: &mut PaneContext<'_>) {
    let settings = context.scene.document.render.clone();
    let all: Vec<_> = RenderSettings::ALL.iter().filter(|setting| setting.group == group).collect();
    let mut told = "";
    for line in all.chunk_by(|_, next| next.beside) {
        let idle = (line[0].idle)(&settings).unwrap_or_default();
        if told != idle && !idle.is_empty() {
            caption(ui, idle, context);
            told = idle;
        }
        ui.add_enabled_ui(idle.is_empty(), |ui| match line {
            [one] => control(ui, one, &settings, context),
            several => {
                ui.horizontal(|ui| several.iter().for_each(|one| control(ui, one, &settings, context)));
            }
        });
    }
}

fn control(ui: &mut Ui, setting: &Setting<RenderSettings>, settings: &RenderSettings, context: &mut PaneContext<'_>) {
    let (name, hint) = (setting.name, setting.help);
    let is_enabled = (setting.idle)(settings).is_none();
    let mut to = settings.clone();
    match &setting.value {
        _ if setting.key == "tolerance" => tolerance(ui, is_enabled, settings, context),
        Value::Number(number) if number.field => {
            caption(ui, name, context);
            field(ui, [name, hint], number, &mut to);
        }
        Value::Number(number) => {
            let least = (number.floor)(settings);
            let dial = Dial { name, hint, number, is_enabled };
            if let Some(value) = dial.show(ui, (number.get)(settings).max(least), context).filter(|_| is_enabled) {
                (number.set)(&mut to, number.rounded(value).max(least));
            }
        }
        Value::Pair(pair) => {
            caption(ui, name, context);
            ui.horizontal(|ui| {
                for (name, hint, number) in *pair {
                    field(ui, [name, hint], number, &mut to);
                    ui.label(name.rsplit(' ').next().unwrap_or(name)).on_hover_text(*hint);
                }
            });
        }
        Value::Switch(get, set) => {
            let mut on = get(settings);
            let response = ui.checkbox(&mut on, name).on_hover_text(hint);
            widgets::take_sought(&response, name);
            if response.changed() {
                set(&mut to, on);
            }
        }
        Value::Choice(pick) => {
            let chosen = ui.add_enabled_ui(is_enabled, |ui| choice(ui, name, pick, settings, context)).inner;
            if let Some(index) = chosen {
                (pick.set)(&mut to, index);
            }
        }
        Value::Own => scene::own(ui, setting.key, is_enabled, context),
    }
    if to != *settings {
        set(context, name, |settings| *settings = to);
    }
    if setting.key == "reading" {
        let words = settings.normalization.words();
        line(ui, words.brief(), words.why, context.theme.weak);
    }
    if setting.key == "exposure_ev" {
        lens(ui, settings, context);
    }
}

fn field<D>(ui: &mut Ui, [name, hint]: [&str; 2], number: &Number<D>, settings: &mut D) {
    let now = (number.get)(settings);
    let mut value = now;
    let [low, high] = number.slider;
    let field = DragValue::new(&mut value).range(low..=high).speed(0.01 * now).suffix(number.unit);
    let field = if number.unit.is_empty() { field } else { field.max_decimals(3) };
    let response = ui.add_sized([VALUE + 2.0 * UNIT, SLIDER], field);
    response.widget_info(|| egui::WidgetInfo::slider(true, value, name));
    widgets::take_sought(&response, name);
    if response.on_hover_text(hint).changed() {
        (number.set)(settings, value);
    }
}

/// The alternatives of a choice. Returns the one that was chosen.
fn choice<D>(
    ui: &mut Ui,
    name: &'static str,
    pick: &Pick<D>,
    settings: &D,
    context: &PaneContext<'_>,
) -> Option<usize> {
    let (all, now) = ((pick.all)(), (pick.get)(settings));
    match pick.look {
        Look::List => list(ui, name, [all[now].label, all[now].why], context, || {
            let line = |(index, words): (usize, &&chromascope_text::Words)| Line {
                facts: words.why.to_owned(),
                ..Line::new(words.label, index == now)
            };
            all.iter().enumerate().map(line).collect()
        }),
        Look::Row => {
            caption(ui, name, context);
            let lines: Vec<_> = all.iter().enumerate().map(|(index, words)| (index, words.label, words.why)).collect();
            ui.horizontal(|ui| widgets::segmented(ui, &lines, now)).inner
        }
        Look::Radio => {
            let radio = |ui: &mut Ui, index: usize| {
                ui.radio(index == now, all[index].label).on_hover_text(all[index].why).clicked()
            };
            ui.horizontal(|ui| (0..all.len()).filter(|&index| radio(ui, index)).last()).inner
        }
    }
}

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
    widgets::labeled(&response, egui::Role::Label, words);
    if cut || meaning != words {
        response.on_hover_text(meaning);
    }
}

/// A slider over the width of the pane, its name above and its value beside it. Says what it was moved to.
struct Dial<'a, D: 'static> {
    name: &'static str,
    hint: &'a str,
    number: &'a Number<D>,
    /// False where it has no effect now; it keeps its place.
    is_enabled: bool,
}

impl<D> Dial<'_, D> {
    fn show(&self, ui: &mut Ui, now: f64, context: &PaneContext<'_>) -> Option<f64> {
        let mut value = now;
        caption(ui, self.name, context);
        let (rect, _) = ui.allocate_exact_size(Vec2::new(ui.available_width(), SLIDER), egui::Sense::hover());
        let mut child = ui.new_child(UiBuilder::new().id_salt(self.name).max_rect(rect));
        if !self.is_enabled {
            child.disable();
        }
        let (left, right) = rect.split_left_right_at_x(rect.right() - VALUE);
        let changed = self.slider(&mut child, left.with_max_x(left.right() - 2.0 * UNIT), &mut value)
            | self.field(&mut child, right, &mut value);
        (changed && value.is_finite() && value != now).then(|| short_value(value))
    }

    fn range(&self) -> std::ops::RangeInclusive<f64> {
        self.number.slider[0]..=self.number.slider[1]
    }

    fn hint(&self) -> String {
        let typed = self.number.typed.map(|[_, high]| format!("; type up to {high}{}", self.number.unit));
        format!("{}{}.", self.hint, typed.unwrap_or_default())
    }

    fn slider(&self, ui: &mut Ui, rect: Rect, value: &mut f64) -> bool {
        ui.spacing_mut().slider_width = rect.width();
        let is_open = self.number.typed.is_some();
        let clamping = if is_open { egui::SliderClamping::Never } else { egui::SliderClamping::Edits };
        let mut slider = egui::Slider::new(value, self.range()).clamping(clamping).show_value(false).step_by(0.0);
        if let Some(least) = self.number.log_from {
            slider = slider.logarithmic(true).smallest_positive(least);
        }
        let response = ui.put(rect, slider).on_hover_text(self.hint());
        widgets::take_sought(&response, self.name);
        response.widget_info(|| egui::WidgetInfo::slider(true, *value, self.name));
        response.changed()
    }

    fn field(&self, ui: &mut Ui, rect: Rect, value: &mut f64) -> bool {
        let unit = self.number.unit;
        let mut field = DragValue::new(value)
            // Typing is one step when it is done, not one for each key.
            .update_while_editing(false)
            .speed(0.0)
            .custom_formatter(move |value, _| format!("{}{unit}", number(short_value(value))))
            .custom_parser(parsed);
        if self.number.typed.is_none() {
            field = field.range(self.range());
        }
        ui.put(rect, field).on_hover_text(self.hint()).changed()
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

const FIELD: Number<Orbit> = Number { unit: "°", slider: [2.0, 120.0], ..Number::DEFAULT };

fn show_view(ui: &mut Ui, context: &mut PaneContext<'_>) {
    controls(ui, VIEW, context);
    let is_image = context.scene.document.render.mesh.is_image();
    let reset = ui.add_enabled(!is_image, egui::Button::new("Reset view"));
    if reset.on_hover_text("Initial view of the mesh (Home)").clicked() {
        context.view.saved.render.orbit = None;
        ui.ctx().request_repaint();
    }
    without_picture(ui, context);
}

/// The field of view, which is no part of the document.
fn lens(ui: &mut Ui, settings: &RenderSettings, context: &mut PaneContext<'_>) {
    let orbit = context.view.saved.render.orbit.unwrap_or_else(|| Orbit::of(settings));
    let hint =
        "Of the lens; the viewpoint moves so that the mesh keeps its size. Wide lenses fall off with cos⁴ (Eq 12)";
    let is_enabled = !settings.mesh.is_image();
    let dial = Dial { name: "Field of view", hint, number: &FIELD, is_enabled };
    if let Some(to) = dial.show(ui, orbit.field_of_view_deg, context) {
        context.view.saved.render.orbit = Some(orbit.with_field_of_view(to));
        ui.ctx().request_repaint();
    }
}

fn tolerance(ui: &mut Ui, is_enabled: bool, settings: &RenderSettings, context: &mut PaneContext<'_>) {
    let hint = "Largest error of a picture, relative to its brightest sample, with the quality Within a tolerance. \
                Help > Numerics shows the method for each camera.";
    caption(ui, "Tolerance", context);
    let id = ui.make_persistent_id("tolerance field");
    let field = |ui: &mut Ui| widgets::tolerance::field(ui, id, settings.tolerance, "", hint, context);
    if let Some(to) = ui.add_enabled_ui(is_enabled, field).inner {
        set(context, "Tolerance", |settings| settings.tolerance = to);
    }
}

/// Lists the compared sensors that have no picture.
fn without_picture(ui: &mut Ui, context: &PaneContext<'_>) {
    let rendered = context.scene.rendered_sources();
    let skipped_work = context.scene.sources().into_iter().filter(|source| source.visible);
    let skipped_work =
        skipped_work.filter(|source| !rendered.iter().any(|r| (r.kind, &r.name) == (source.kind, &source.name)));
    let names: Vec<String> = skipped_work.map(|source| source.label).collect();
    let words = if names.is_empty() { String::new() } else { format!("No picture: {}", names.join(", ")) };
    let why =
        "Eq 13 takes the signals of cameras and of Stiles & Burch; with a fitted color transform all have pictures.";
    line(ui, &words, &format!("{words}. {why}"), context.theme.weak);
}
