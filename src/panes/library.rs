//! What is compared, the only legend; and all data sets, under one search.

use egui::{
    Align, Button, Checkbox, Key, Layout, Rect, Response, RichText, ScrollArea, Sense, TextEdit, Ui, UiBuilder, Vec2,
};

use super::PaneContext;
use crate::action::{Action, CompareAction, OwnAction, SceneAction};
use crate::catalog::{Entry, Kind, names};
use crate::command::Command;
use crate::document::Light;
use crate::scene::Source;
use crate::theme::{ROW, UNIT};
use crate::thing::{SourceId, Thing};
use crate::widgets;
use crate::workspaces::PaneKind;

/// A line of the list of data sets.
enum Line {
    Group(Kind, usize, bool),
    Set(Box<Entry>),
}

/// Shows the pane in its rectangle.
pub fn show(ui: &mut Ui, rect: Rect, context: &mut PaneContext<'_>) {
    ui.painter().rect_filled(rect, 0.0, context.theme.panel);
    if ui.input(|input| input.pointer.any_pressed() && input.pointer.interact_pos().is_some_and(|at| rect.contains(at)))
    {
        context.view.focused = Some(PaneKind::Library);
    }
    let inner = rect.shrink2(Vec2::new(2.0 * UNIT, UNIT));
    let mut child = ui.new_child(UiBuilder::new().id_salt("library").max_rect(inner));
    child.set_clip_rect(rect.intersect(ui.clip_rect()));
    let ui = &mut child;
    ui.add_space(UNIT);
    ui.label("Compared");
    let sources = context.scene.sources();
    let most = (inner.height() * 0.45).max(4.0 * (ROW + UNIT));
    ScrollArea::vertical().id_salt("compared").max_height(most).auto_shrink([false, true]).show(ui, |ui| {
        for source in &sources {
            source_row(ui, source, context);
        }
    });
    ui.separator();
    ui.label("Library");
    search(ui, context);
    sets(ui, context);
}

/// One compared source: key, name, tag, menu.
fn source_row(ui: &mut Ui, source: &Source, context: &mut PaneContext<'_>) {
    let (rect, _) = ui.allocate_exact_size(Vec2::new(ui.available_width(), ROW), Sense::hover());
    let thing = Thing::Source(SourceId { kind: source.kind, name: source.name.clone() });
    let theme = context.theme;
    let layout = Layout::left_to_right(Align::Center);
    let mut row = ui.new_child(UiBuilder::new().id_salt(("compared", &source.name)).max_rect(rect).layout(layout));
    row.set_clip_rect(rect.expand(1.0).intersect(ui.clip_rect()));
    let key = key_button(&mut row, source, context);
    let tag = match (source.is_truth, source.is_own) {
        (true, _) => "truth",
        (_, true) => "yours",
        _ => "",
    };
    let room = (rect.right() - row.cursor().left() - if tag.is_empty() { 4.0 } else { 44.0 }).max(20.0);
    let color = if source.visible { theme.text } else { theme.weak };
    let name = Button::selectable(false, (RichText::new(&source.label).color(color), egui::Atom::grow()))
        .truncate()
        .min_size(Vec2::new(room, ROW));
    let name = row.allocate_ui(Vec2::new(room, ROW), |ui| ui.add(name)).inner;
    if !tag.is_empty() {
        row.label(RichText::new(tag).small().color(theme.weak));
    }
    let selected = context.view.selected.as_ref() == Some(&thing);
    if selected || name.has_focus() {
        let stroke = egui::Stroke::new(1.0, theme.text);
        ui.painter().rect_stroke(rect, 3.0, stroke, egui::StrokeKind::Inside);
    }
    if name.hovered() || key.hovered() {
        context.view.hover(Some(&thing));
    }
    if name.clicked() {
        context.view.click(Some(&thing));
    }
    let failure = context.scene.rendering_of(source.kind, &source.name).err().map(|error| error.to_string());
    if let Some(failure) = &failure {
        ui.painter().text(
            rect.right_center(),
            egui::Align2::RIGHT_CENTER,
            "!",
            egui::FontId::proportional(16.0),
            theme.warning,
        );
        name.clone().on_hover_text(failure);
    } else {
        name.clone().on_hover_text(format!("{}. Click to keep it, right click for more.", source.name));
    }
    name.context_menu(|ui| source_menu(ui, source, context));
}

/// The key, which hides the source and shows it again.
fn key_button(ui: &mut Ui, source: &Source, context: &mut PaneContext<'_>) -> Response {
    let (rect, response) = ui.allocate_exact_size(Vec2::new(26.0, ROW), Sense::click());
    let words = if source.visible { "Hide" } else { "Show" };
    response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Button, true, format!("{words} {}", source.label)));
    let theme = context.theme;
    if source.visible {
        crate::paint::key(ui.painter(), rect, &widgets::legend_entry(source), &theme);
    } else {
        ui.painter().circle_stroke(rect.center(), 4.0, egui::Stroke::new(1.2, theme.weak));
    }
    if response.has_focus() {
        ui.painter().rect_stroke(rect, 3.0, widgets::focus_rim(&response, &theme), egui::StrokeKind::Inside);
    }
    if response.clicked() {
        let action = CompareAction::SetVisible(source.kind, source.name.clone(), !source.visible);
        context.push(Action::Compare(action));
    }
    response.on_hover_text(format!("{words} {}", source.label))
}

fn source_menu(ui: &mut Ui, source: &Source, context: &mut PaneContext<'_>) {
    let mut act = |ui: &mut Ui, enabled: bool, words: &str, action: CompareAction| {
        if ui.add_enabled(enabled, Button::new(words)).clicked() {
            context.commands.push(Action::Compare(action).into());
            ui.close();
        }
    };
    let (kind, name) = (source.kind, source.name.clone());
    if kind == Kind::Observer {
        act(ui, !source.is_truth, "Make it the truth", CompareAction::SetTruth(name.clone()));
    }
    let words = if source.visible { "Hide" } else { "Show" };
    act(ui, true, words, CompareAction::SetVisible(kind, name.clone(), !source.visible));
    act(ui, !source.is_truth, "Take off the list", CompareAction::Remove(kind, name.clone()));
    ui.separator();
    ui.label("Name on screen");
    let id = ui.scope_id().with("rename");
    let mut text = ui.data(|data| data.get_temp::<String>(id)).unwrap_or_else(|| source.label.clone());
    let field = ui.add(TextEdit::singleline(&mut text).desired_width(160.0));
    field.widget_info(|| egui::WidgetInfo::labeled(egui::Role::TextInput, true, "Name on screen"));
    if field.lost_focus() && ui.input(|input| input.key_pressed(Key::Enter)) {
        context.push(Action::Compare(CompareAction::Rename(kind, name, text)));
        ui.data_mut(|data| data.remove::<String>(id));
        ui.close();
    } else {
        ui.data_mut(|data| data.insert_temp(id, text));
    }
}

/// The search field. Enter puts the first match to use.
fn search(ui: &mut Ui, context: &mut PaneContext<'_>) {
    let count = Kind::ALL.map(|kind| context.scene.entries(kind).count()).iter().sum::<usize>();
    let hint = format!("Search {count} sets, Ctrl+F");
    let field = TextEdit::singleline(&mut context.view.search).hint_text(hint).desired_width(f32::INFINITY);
    let field = ui.add(field.min_size(Vec2::new(0.0, ROW)));
    field.widget_info(|| egui::WidgetInfo::labeled(egui::Role::TextInput, true, "Search the library"));
    if std::mem::take(&mut context.view.focus_search) {
        field.request_focus();
    }
    if field.lost_focus() && ui.input(|input| input.key_pressed(Key::Enter)) {
        let first = lines(context).into_iter().find_map(|line| match line {
            Line::Set(entry) => Some(entry),
            Line::Group(..) => None,
        });
        if let Some(entry) = first.filter(|_| !context.view.search.is_empty()) {
            use_set(&entry, context);
        }
        field.request_focus();
    }
    if field.has_focus() && ui.input(|input| input.key_pressed(Key::Escape)) {
        context.view.search.clear();
    }
}

/// The sets in their groups, those that match while something is searched.
fn lines(context: &PaneContext<'_>) -> Vec<Line> {
    let search = context.view.search.trim();
    let mut lines = Vec::new();
    for kind in Kind::ALL {
        let entries: Vec<Entry> =
            context.scene.entries(kind).filter(|entry| names::matches_search(entry, search)).collect();
        if entries.is_empty() && !search.is_empty() {
            continue;
        }
        let open = !search.is_empty() || !context.view.saved.folded.contains(kind.plural());
        lines.push(Line::Group(kind, entries.len(), open));
        if open {
            lines.extend(entries.into_iter().map(|entry| Line::Set(Box::new(entry))));
        }
    }
    lines
}

fn sets(ui: &mut Ui, context: &mut PaneContext<'_>) {
    let lines = lines(context);
    if lines.is_empty() {
        ui.horizontal(|ui| {
            ui.label("No match.");
            if ui.button("Clear search").clicked() {
                context.view.search.clear();
            }
        });
        return;
    }
    ScrollArea::vertical().id_salt("sets").auto_shrink(false).show_rows(ui, ROW, lines.len(), |ui, rows| {
        for line in &lines[rows] {
            match line {
                Line::Group(kind, count, open) => group(ui, *kind, *count, *open, context),
                Line::Set(entry) => set_row(ui, entry, context),
            }
        }
    });
}

fn group(ui: &mut Ui, kind: Kind, count: usize, open: bool, context: &mut PaneContext<'_>) {
    let name = kind.plural();
    let mut title = name.to_owned();
    title[..1].make_ascii_uppercase();
    let words = format!("{} {title}  {count}", if open { "▼" } else { "▶" });
    let button = Button::new(words).frame(false).min_size(Vec2::new(ui.available_width(), ROW));
    let response = ui.add(button);
    if response.clicked() && !context.view.saved.folded.remove(name) {
        context.view.saved.folded.insert(name.to_owned());
    }
}

/// One data set: ticked, or chosen.
fn set_row(ui: &mut Ui, entry: &Entry, context: &mut PaneContext<'_>) {
    let layout = Layout::left_to_right(Align::Center);
    let size = Vec2::new(ui.available_width(), ROW);
    let in_use = is_in_use(entry, context);
    let response = ui.allocate_ui_with_layout(size, layout, |ui| {
        ui.set_min_size(size);
        ui.add_space(3.0 * UNIT);
        ui.style_mut().wrap_mode = Some(egui::TextWrapMode::Truncate);
        let mut words = RichText::new(&entry.name);
        if entry.is_own() {
            words = words.strong();
        }
        match entry.kind {
            Kind::Camera | Kind::Observer => {
                let mut on = in_use;
                let is_truth = entry.kind == Kind::Observer && entry.name == context.scene.document.truth;
                ui.add_enabled(!is_truth, Checkbox::new(&mut on, words))
            }
            _ => ui.radio(in_use, words),
        }
    });
    let response = response.inner;
    if response.clicked() {
        use_set(entry, context);
    }
    if response.hovered() && matches!(entry.kind, Kind::Camera | Kind::Observer) {
        let thing = Thing::Source(SourceId { kind: entry.kind, name: entry.name.clone() });
        context.view.hover(Some(&thing));
    }
    let response =
        response.on_hover_ui(|ui| about(ui, entry)).on_disabled_hover_text("The truth stays; choose another first.");
    if entry.is_own() {
        response.context_menu(|ui| {
            if ui.button("How it was read…").clicked() {
                context.view.reading = Some(entry.name.clone());
                show_inspector(context);
                ui.close();
            }
            if ui.button("Remove").clicked() {
                context.push(Action::Own(OwnAction::Remove(entry.name.clone())));
                ui.close();
            }
        });
    }
}

/// Makes sure that the inspector can be seen.
fn show_inspector(context: &mut PaneContext<'_>) {
    let workspace = context.view.saved.workspace;
    if !context.view.saved.layout.shows(workspace, PaneKind::Inspector) {
        context.push(Command::TogglePane(PaneKind::Inspector));
    }
}

fn is_in_use(entry: &Entry, context: &PaneContext<'_>) -> bool {
    let document = context.scene.document;
    match entry.kind {
        Kind::Camera | Kind::Observer => document.compared(entry.kind, &entry.name).is_some(),
        Kind::Chart | Kind::Material => document.chart == entry.name,
        Kind::Illuminant => document.light == Light::Set(entry.name.clone()),
    }
}

/// Ticks or unticks a source; chooses a chart, a material or a light.
fn use_set(entry: &Entry, context: &mut PaneContext<'_>) {
    let name = entry.name.clone();
    let action = match entry.kind {
        Kind::Camera | Kind::Observer if is_in_use(entry, context) => {
            Action::Compare(CompareAction::Remove(entry.kind, name))
        }
        Kind::Camera | Kind::Observer => Action::Compare(CompareAction::Add(entry.kind, name)),
        Kind::Chart | Kind::Material => Action::Scene(SceneAction::SetChart(name)),
        Kind::Illuminant => Action::Scene(SceneAction::SetLight(Light::Set(name))),
    };
    context.push(action);
}

/// What is known of a set: gloss, quantity, source, terms, notes.
fn about(ui: &mut Ui, entry: &Entry) {
    ui.strong(&entry.name);
    if let Some(also) = &entry.also {
        ui.label(also);
    }
    if let Some(header) = &entry.header {
        let response = header.response.as_ref().map_or_else(String::new, |response| format!(", {response}"));
        ui.label(format!("{}, unit {}{response}", header.quantity, header.unit));
        ui.small(format!("Source: {}", header.source));
        ui.small(format!("Terms: {}", header.license));
        for note in &header.notes {
            ui.small(note);
        }
    }
    if let crate::catalog::Place::Own(set) = &entry.place {
        ui.small(format!("File: {}", set.file));
        for decision in &set.decisions {
            ui.small(decision);
        }
    }
}
