//! The menu of a set: its source, its reading, its removal, and the forms in which it can be saved.

use egui::{Key, Modifiers, Popup, Rect, Response, Sense, Ui};

use crate::action::{Action, ImportedAction};
use crate::catalog::Entry;
use crate::command::Command;
use crate::document::SetKind;
use crate::export::spectra::{Form, fits};
use crate::format::sentence;
use crate::panes::context::PaneContext;
use crate::panes::widgets::lines;
use crate::plot_item::PlotItem;
use crate::view::import::ImportItem;
use crate::workspaces::PaneKind;

/// The dots at the end of a row and their menu, which a right click on the row and the menu key open, too. The row of a
/// built-in set shows its dots while it is hovered or focused. Returns whether they are visible.
pub(super) fn menu_of(ui: &Ui, rect: Rect, row: &Response, entry: &Entry, context: &mut PaneContext<'_>) -> bool {
    let id = row.id.with("dots");
    let whose = if entry.is_own() { "Menu of your" } else { "Menu in the library of" };
    let name = format!("{whose} {}", entry.name);
    let popup = Popup::default_response_id(row).with("menu");
    let shown = entry.is_own()
        || row.contains_pointer()
        || row.has_focus()
        || ui.memory(|memory| memory.has_focus(id))
        || Popup::is_id_open(ui.ctx(), popup)
        || ui.rect_contains_pointer(rect);
    let button = if shown {
        lines::dots(ui, rect, id, &name)
    } else {
        // Invisible, but accessible to keyboards and screen readers.
        let button = ui.interact(rect, id, Sense::click());
        button.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Button, true, &name));
        button
    };
    let focused = row.has_focus() || button.has_focus();
    let key = focused
        && ui.input_mut(|i| i.consume_key(Modifiers::NONE, Key::Menu) || i.consume_key(Modifiers::SHIFT, Key::F10));
    let toggled = button.clicked() || key;
    Popup::menu(&button)
        .id(popup)
        .open_memory(toggled.then_some(egui::SetOpenCommand::Toggle))
        .show(|ui| menu(ui, entry, context));
    row.context_menu(|ui| menu(ui, entry, context));
    shown
}

fn menu(ui: &mut Ui, entry: &Entry, context: &mut PaneContext<'_>) {
    if ui.button("Source").on_hover_text("Source, terms and curve in the Inspector").clicked() {
        context.view.selected = Some(PlotItem::of_set(entry.kind, &entry.name));
        show_inspector(context);
        ui.close();
    }
    if entry.is_own() && ui.button("Reading…").clicked() {
        context.push(Command::ShowImport(ImportItem::Set(entry.name.clone()), None));
        ui.close();
    }
    context.item(
        ui,
        "Copy curves",
        "Tab-separated text, for a spreadsheet or for Paste data",
        Command::CopySet(entry.kind, entry.name.clone()),
    );
    save_as(ui, entry.kind, &entry.name, context);
    if entry.is_own() && ui.button("Remove").clicked() {
        context.push(Action::Imported(ImportedAction::Remove(entry.name.clone())));
        ui.close();
    }
}

/// Brings the inspector on, if the workspace does not show it.
pub(super) fn show_inspector(context: &mut PaneContext<'_>) {
    let saved = &context.view.saved;
    if !saved.layout.shows(saved.workspace, PaneKind::INSPECTOR) {
        context.view.saved.layout.toggle(context.view.saved.workspace, PaneKind::INSPECTOR);
    }
    // Only a narrow window looks at this.
    context.view.inspector_over = true;
}

/// The forms a set can be saved in; those that are not for such a set say why.
pub(super) fn save_as(ui: &mut Ui, kind: SetKind, name: &str, context: &mut PaneContext<'_>) {
    ui.menu_button("Save as", |ui| {
        let Ok(entry) = context.scene.entry(kind, name) else { return };
        for form in Form::ALL {
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
