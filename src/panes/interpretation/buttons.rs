//! Actions on the file as a whole.

use egui::Ui;

use crate::action::{Action, ImportedAction};
use crate::command::Command;
use crate::document::imported::ImportOverrides;
use crate::figures::curves::ImportSelection;
use crate::panes::context::PaneContext;
use crate::theme::{ROW, UNIT};
use crate::view::import::ImportItem;

/// Below this width the three buttons of a set take one more row.
const SET: f32 = 290.0;
/// Below these widths the four buttons of a file that is no set take one and two more.
const FILE: [f32; 2] = [380.0, 270.0];

pub(super) fn height(shown: &ImportSelection, width: f32) -> f32 {
    let more = match shown.item {
        ImportItem::Set(_) => usize::from(width < SET),
        ImportItem::File(_) => FILE.into_iter().filter(|least| width < *least).count(),
    };
    let rows = 2 + usize::from(on_disk(shown)) + more;
    rows as f32 * (ROW + UNIT) + 2.0 * UNIT
}

/// True if there is a file to look after.
fn on_disk(shown: &ImportSelection) -> bool {
    match (&shown.set, &shown.file) {
        (Some(set), _) => set.path.is_some(),
        (None, file) => file.as_ref().is_some_and(|file| file.origin.path.is_some()),
    }
}

pub(super) fn show(ui: &mut Ui, shown: &ImportSelection, context: &mut PaneContext<'_>) {
    ui.spacing_mut().item_spacing.x = UNIT;
    ui.horizontal_wrapped(|ui| match &shown.item {
        ImportItem::File(fingerprint) => {
            let reads = shown.is_fresh() && shown.table().is_some();
            let none = shown.taken().is_empty();
            let button = ui.add_enabled(reads && !none, egui::Button::new("Use"));
            let hint = "Import it and use it; can be undone";
            let why = if reads { "No curve is selected" } else { "Not readable with these settings" };
            if button.on_hover_text(hint).on_disabled_hover_text(why).clicked() {
                context.push(Command::UseFile(*fingerprint, Box::new(shown.overrides.clone())));
            }
            alike(ui, shown, context);
            if let Some(path) = shown.file.as_ref().and_then(|file| file.origin.path.clone())
                && ui.button("Reload").on_hover_text("Reload the file from disk").clicked()
            {
                context.push(Command::OpenPath(path));
            }
            if ui.button("Do not import").on_hover_text("Remove from the list").clicked() {
                context.push(Command::ForgetFile(*fingerprint));
                context.view.import.selected = None;
            }
        }
        ImportItem::Set(name) => {
            if shown.file.is_some() {
                alike(ui, shown, context);
            }
            if on_disk(shown) && ui.button("Reload").on_hover_text("Reload the file from disk").clicked() {
                context.push(Command::ReadAgain(name.clone()));
            }
            context.button(
                ui,
                "Remove",
                "Remove the data set; can be undone",
                Action::Imported(ImportedAction::Remove(name.clone())),
            );
        }
    });
    ui.horizontal(|ui| {
        let chosen = shown.overrides != ImportOverrides::default();
        let hint = "Decide by content again, for this file and others like it; can be undone";
        let button = ui.add_enabled(chosen, egui::Button::new("Forget choices")).on_hover_text(hint);
        if button.on_disabled_hover_text("Nothing was chosen for it").clicked() {
            context.push(Command::ForgetChoices(shown.item.clone()));
        }
    });
    if on_disk(shown) {
        ui.checkbox(&mut context.view.saved.import.watch, "Reload when the file changes").on_hover_text(
            "Files are reloaded when they change on disk, including files that failed to load; can be \
                            undone",
        );
    }
}

fn alike(ui: &mut Ui, shown: &ImportSelection, context: &mut PaneContext<'_>) {
    let hint = "Use these settings for all open files of this kind, and for files like it from now on";
    let reads = shown.is_fresh() && shown.table().is_some();
    if ui.add_enabled(reads, egui::Button::new("Use for all like it")).on_hover_text(hint).clicked() {
        context.push(Command::UseForAlike(shown.item.clone()));
    }
}
