//! What can be done with a data set: its use, its source, its reading, its removal, and the forms in which it can be saved.

use egui::Ui;

use crate::action::{Action, CompareAction, ImportedAction, SceneAction};
use crate::catalog::Entry;
use crate::command::Command;
use crate::document::{Light, SetKind};
use crate::export::spectra::{Form, fits};
use crate::format::sentence;
use crate::panes::context::PaneContext;
use crate::panes::widgets::pick_list::{self, Line};
use crate::plot_item::PlotItem;
use crate::view::import::ImportItem;
use crate::workspaces::PaneKind;

/// Puts a set to use, or removes it from the comparison.
pub fn choose(entry: &Entry, on: bool, context: &mut PaneContext<'_>) {
    let name = entry.name.clone();
    if entry.kind == SetKind::Unsorted {
        // Its kind must be chosen first.
        context.push(Command::ShowImport(ImportItem::Set(name), None));
        return;
    }
    context.push(match entry.kind {
        SetKind::Camera | SetKind::Observer if on => Action::Compare(CompareAction::Add(entry.kind, name)),
        SetKind::Camera | SetKind::Observer => Action::Compare(CompareAction::Remove(entry.kind, name)),
        SetKind::Chart | SetKind::Material => Action::Scene(SceneAction::SetChart(name)),
        SetKind::Filter => Action::Scene(SceneAction::SetFilter(name, on)),
        SetKind::Illuminant | SetKind::Unsorted => Action::Scene(SceneAction::SetLight(Light::Set(name))),
    });
}

pub fn menu(ui: &mut Ui, entry: &Entry, context: &mut PaneContext<'_>) {
    if ui.button("Source").on_hover_text("Source, terms and curve in the Inspector").clicked() {
        context.view.selected = Some(PlotItem::of_set(entry.kind, &entry.name));
        show_inspector(context);
        ui.close();
    }
    if entry.is_own() {
        context.item(ui, "Reading…", "", Command::ShowImport(ImportItem::Set(entry.name.clone()), None));
    }
    let hint = "Tab-separated text, for a spreadsheet or for Paste data";
    context.item(ui, "Copy curves", hint, Command::CopySet(entry.kind, entry.name.clone()));
    save_as(ui, entry.kind, &entry.name, context);
    if entry.is_own() {
        context.item(ui, "Remove", "", Action::Imported(ImportedAction::Remove(entry.name.clone())));
    }
}

/// The camera of Rank's page, of the whole library; the one chosen is selected.
pub fn camera(ui: &mut Ui, width: f32, context: &mut PaneContext<'_>) {
    let now = context.view.camera(&context.scene).map(|id| id.name);
    let is_compared = |entry: &Entry| context.scene.document.compared(SetKind::Camera, &entry.name).is_some();
    let mut entries = Vec::new();
    let hint = "The camera of the page, of the whole library: the one selected";
    let shown = now.as_deref().unwrap_or("Choose a camera");
    let chosen = pick_list::drop_down(ui, ("Camera", hint), shown, width, &context.theme, || {
        entries.extend(context.scene.entries(SetKind::Camera));
        entries.sort_by_key(|entry| !is_compared(entry));
        let line = |Entry { name, short, also, .. }: &Entry| {
            let also = format!("{short} {}", also.as_deref().unwrap_or_default());
            Line { also, ..Line::new(name, now.as_ref() == Some(name)) }
        };
        entries.iter().map(line).collect()
    });
    if let Some(index) = chosen {
        context.view.selected = Some(PlotItem::of_set(SetKind::Camera, &entries[index].name));
    }
}

/// Brings the inspector on, if it is hidden.
pub fn show_inspector(context: &mut PaneContext<'_>) {
    context.view.show(PaneKind::INSPECTOR);
    // Only a narrow window looks at this.
    context.view.column_over = true;
}

/// The forms a set can be saved in; those that are not for such a set say why.
pub fn save_as(ui: &mut Ui, kind: SetKind, name: &str, context: &mut PaneContext<'_>) {
    ui.menu_button("Save as", |ui| {
        let Ok(entry) = context.scene.entry(kind, name) else { return };
        for form in Form::all() {
            let fitting = fits(&entry, form);
            let button = ui.add_enabled(fitting.is_ok(), egui::Button::new(form.name()));
            if button.clicked() {
                context.push(Command::SaveSet(kind, name.to_owned(), form));
                ui.close();
            }
            if let Err(error) = fitting {
                button.on_disabled_hover_text(sentence(&error.to_string()));
            }
        }
    });
}
