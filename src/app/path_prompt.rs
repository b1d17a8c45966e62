//! A path to type, where the system has no file dialog.

use egui::{Align2, Key, RichText, TextEdit, Ui, Vec2, Window};

use crate::files::Files;
use crate::theme::Theme;

/// Shows the question, if one is open.
pub(super) fn show(ui: &Ui, theme: &Theme, files: &mut Files) {
    let Some(prompt) = files.prompt_mut() else { return };
    let saving = prompt.save.is_some();
    let title = prompt.save.as_ref().map_or_else(|| "Open".to_owned(), |request| format!("Save {}", request.what));
    let (mut done, mut open) = (false, true);
    Window::new(title)
        .id(egui::Id::unique("path prompt"))
        .open(&mut open)
        .collapsible(false)
        .resizable(false)
        .anchor(Align2::CENTER_TOP, Vec2::new(0.0, 96.0))
        .show(ui.ctx(), |ui| {
            ui.label(if saving {
                "No file dialog here. Type a path."
            } else {
                "No file dialog here. Type a path, or drop the file."
            });
            ui.horizontal(|ui| {
                let field = ui.add(TextEdit::singleline(&mut prompt.text).desired_width(360.0));
                field.widget_info(|| egui::WidgetInfo::labeled(egui::Role::TextInput, true, "Path"));
                // Before the focus is taken back: then it would not have been lost.
                let entered = field.lost_focus() && ui.input(|input| input.key_pressed(Key::Enter));
                if std::mem::take(&mut prompt.focus) || ui.memory(|memory| memory.focused().is_none()) {
                    field.request_focus();
                }
                done = ui.button(if saving { "Save" } else { "Open" }).clicked() || entered;
            });
            if let Some(failure) = &prompt.failure {
                ui.label(RichText::new(failure).color(theme.error));
            }
            if prompt.replaces.as_deref() == Some(std::path::Path::new(prompt.text.trim())) {
                ui.label("That file exists. Save again to replace it, or type another name.");
            }
            ui.small("For dialogs install a desktop portal or the package zenity.");
        });
    // Esc is the program's: it closes what is in front.
    if !open {
        *files.prompt_mut() = None;
    } else if done {
        files.take_prompt();
    }
}
