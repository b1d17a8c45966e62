//! The compared sensors: the only legend.

use egui::{Id, Key, Rect, Sense, TextEdit, TextStyle, Ui, Vec2};

use crate::action::{Action, CompareAction};
use crate::command::Command;
use crate::document::SetKind;
use crate::format::fixed;
use crate::panes::context::PaneContext;
use crate::panes::widgets::{self, focus_rim, lines, sets};
use crate::plot_item::PlotItem;
use crate::scene::ComparedSensor;
use crate::theme::{FADED, ROW, UNIT};
use crate::view::import::ImportItem;

#[derive(Clone, Default)]
struct Renaming {
    kind: Option<SetKind>,
    name: String,
    text: String,
}

fn renaming_id() -> Id {
    Id::unique("renamed sensor")
}

fn id(source: &ComparedSensor) -> Id {
    Id::unique(("compared", source.kind, &source.name))
}

pub(super) fn focus(ui: &Ui, source: &ComparedSensor) {
    ui.memory_mut(|memory| memory.request_focus(id(source).with("label")));
}

pub(super) fn row(ui: &mut Ui, source: &ComparedSensor, context: &mut PaneContext<'_>) {
    let (rect, _) = ui.allocate_exact_size(Vec2::new(ui.available_width(), ROW), Sense::hover());
    let id = id(source);
    key(ui, Rect::from_min_size(rect.min, Vec2::new(lines::KEY + UNIT, ROW)), id, source, context);
    let dots = rect.with_min_x(rect.right() - lines::DOTS);
    let mut words = Rect::from_x_y_ranges(rect.left() + lines::KEY + 2.0 * UNIT..=dots.left() - UNIT, rect.y_range());
    let renaming: Renaming = ui.data(|data| data.get_temp(renaming_id())).unwrap_or_default();
    if renaming.kind == Some(source.kind) && renaming.name == source.name {
        rename_field(ui, words, id, renaming, context);
    } else {
        words.max.x -= mean(ui, words, source, context).unwrap_or_else(|| tag(ui, words, source, context));
        if let Some(error) = trouble(source, context) {
            words.max.x -= 18.0;
            let mark = Rect::from_center_size(egui::pos2(words.right() + 9.0, rect.center().y), Vec2::splat(16.0));
            lines::warning_mark(ui.painter(), mark.center(), context.theme.warning);
            let response =
                widgets::named(ui, mark, id.with("trouble"), egui::Role::Image, &format!("Warning: {error}"));
            response.on_hover_text(error);
        }
        let frame = Rect::from_min_max(rect.min - Vec2::new(UNIT, 0.0), egui::pos2(dots.left() - 2.0, rect.bottom()));
        label(ui, words, frame, id, source, context);
    }
    let menu_button = lines::dots(ui, dots, id.with("dots"), &format!("Menu of {}", source.label));
    egui::Popup::menu(&menu_button).show(|ui| menu(ui, source, context));
}

fn key(ui: &Ui, rect: Rect, id: Id, source: &ComparedSensor, context: &mut PaneContext<'_>) {
    let response = ui.interact(rect, id.with("key"), Sense::click());
    let verb = if source.visible { "Hide" } else { "Show" };
    let name = format!("{verb} {}", source.label);
    widgets::labeled(&response, egui::Role::Button, &name);
    if response.hovered() || response.has_focus() {
        let rim = focus_rim(&response, &context.theme);
        ui.painter().rect(rect, 3.0, context.theme.control, rim, egui::StrokeKind::Inside);
        context.view.hover(Some(&thing(source)));
    }
    let place = Rect::from_center_size(rect.center(), Vec2::new(lines::KEY, ROW));
    lines::key(ui.painter(), place, source, &context.theme);
    if response.on_hover_text(name).clicked() {
        toggle(source, context);
    }
}

fn toggle(source: &ComparedSensor, context: &mut PaneContext<'_>) {
    let action = CompareAction::SetVisible(source.kind, source.name.clone(), !source.visible);
    context.push(Action::Compare(action));
}

fn thing(source: &ComparedSensor) -> PlotItem {
    PlotItem::of_set(source.kind, &source.name)
}

/// Mean difference from the reference over the patches, at the end of the row. Returns the width that it takes.
fn mean(ui: &Ui, rect: Rect, source: &ComparedSensor, context: &PaneContext<'_>) -> Option<f32> {
    let differences = context.scene.differences(source.kind, &source.name).ok().filter(|_| !source.is_reference)?;
    let known: Vec<f64> = differences.iter().filter_map(|difference| difference.ok()).collect();
    let mean = known.iter().sum::<f64>() / known.len() as f64;
    let words = fixed(mean, context.scene.document.difference.decimals);
    let drawn =
        mean.is_finite().then(|| lines::right_aligned(ui, rect, &words, TextStyle::Monospace, context.theme.text));
    drawn.map(|width| width + UNIT)
}

fn tag(ui: &Ui, rect: Rect, source: &ComparedSensor, context: &PaneContext<'_>) -> f32 {
    let words = match (source.is_reference, source.is_own) {
        (true, _) => "reference",
        (_, true) => "yours",
        _ => return 0.0,
    };
    lines::right_aligned(ui, rect, words, TextStyle::Small, context.theme.weak) + UNIT
}

fn trouble(source: &ComparedSensor, context: &PaneContext<'_>) -> Option<String> {
    use chromascope_core::query::Ask;
    let scene = &context.scene;
    match scene.rendering_of(source.kind, &source.name) {
        Ok(query) if source.visible => {
            let answer = scene.results.ask(&query);
            (*answer).as_ref().err().map(|error| format!("{}: {error}", source.label))
        }
        Ok(_) => None,
        Err(error) => Some(error.to_string()),
    }
}

fn label(ui: &Ui, rect: Rect, row: Rect, id: Id, source: &ComparedSensor, context: &mut PaneContext<'_>) {
    let thing = thing(source);
    let selected = context.view.selected.as_ref().is_some_and(|chosen| chosen.source() == thing.source());
    let frame = rect.expand2(Vec2::new(UNIT, 0.0));
    let response = ui.interact(frame, id.with("label"), Sense::click());
    response.widget_info(|| egui::WidgetInfo::selected(egui::Role::Button, true, selected, &source.label));
    let hovered = response.hovered() || context.view.hovered.as_ref() == Some(&thing);
    if hovered {
        ui.painter().rect_filled(frame, 3.0, context.theme.control);
    }
    if response.hovered() {
        context.view.hover(Some(&thing));
    }
    if selected {
        let stroke = egui::Stroke::new(1.5, context.theme.text);
        ui.painter().rect_stroke(row, 3.0, stroke, egui::StrokeKind::Inside);
    }
    let color = context.theme.text.gamma_multiply(if source.visible { 1.0 } else { FADED + 0.25 });
    let shown = source.fitted(&context.scene.sources(), |form| lines::width(ui, form, TextStyle::Body) <= rect.width());
    lines::elided(ui, rect, &shown, TextStyle::Body, color);
    let cut = shown != source.label;
    if response.clicked() {
        context.view.click(Some(&thing));
    }
    response.context_menu(|ui| menu(ui, source, context));
    // All else stands in the inspector, where it covers nothing.
    if cut || source.label != source.name {
        let sides = [egui::RectAlign::RIGHT, egui::RectAlign::BOTTOM_START];
        widgets::read_beside(&response, row, sides, std::slice::from_ref(&source.name));
    }
}

fn menu(ui: &mut Ui, source: &ComparedSensor, context: &mut PaneContext<'_>) {
    ui.set_min_width(150.0);
    let name = source.name.clone();
    if source.kind == SetKind::Observer && offer(ui, "Make reference", !source.is_reference) {
        let counts_in_xyz = context.scene.entry(SetKind::Observer, &name).is_ok_and(|entry| entry.counts_in_xyz());
        context.push(Action::Compare(CompareAction::SetReference { name: name.clone(), counts_in_xyz }));
    }
    if offer(ui, "Rename…", true) {
        let renaming = Renaming { kind: Some(source.kind), name: name.clone(), text: source.label.clone() };
        ui.data_mut(|data| data.insert_temp(renaming_id(), renaming));
    }
    if offer(ui, if source.visible { "Hide" } else { "Show" }, true) {
        toggle(source, context);
    }
    if offer(ui, "Remove from comparison", !source.is_reference) {
        context.push(Action::Compare(CompareAction::Remove(source.kind, name)));
    }
    if offer(ui, "Source", true) {
        context.view.selected = Some(thing(source));
        sets::show_inspector(context);
    }
    sets::save_as(ui, source.kind, &source.name, context);
    if source.is_own && offer(ui, "Reading…", true) {
        context.push(Command::ShowImport(ImportItem::Set(source.name.clone()), None));
    }
}

fn offer(ui: &mut Ui, words: &str, enabled: bool) -> bool {
    let clicked = ui.add_enabled(enabled, egui::Button::new(words).frame_when_inactive(false)).clicked();
    if clicked {
        ui.close();
    }
    clicked
}

/// The label as a field. Enter and a click elsewhere keep it, Esc does not.
fn rename_field(ui: &mut Ui, rect: Rect, id: Id, mut renaming: Renaming, context: &mut PaneContext<'_>) {
    let field = TextEdit::singleline(&mut renaming.text).id(id.with("rename")).margin(egui::Margin::symmetric(4, 3));
    let response = ui.put(rect, field);
    widgets::labeled(&response, egui::Role::TextInput, "Label of the sensor");
    context.view.keeps_escape = true;
    if response.lost_focus() {
        let given_up = ui.input(|input| input.key_down(Key::Escape));
        if let Some(kind) = renaming.kind.filter(|_| !given_up) {
            context.push(Action::Compare(CompareAction::Rename(kind, renaming.name, renaming.text)));
        }
        ui.data_mut(|data| data.remove::<Renaming>(renaming_id()));
        return;
    }
    if !response.has_focus() {
        response.request_focus();
    }
    ui.data_mut(|data| data.insert_temp(renaming_id(), renaming));
}
