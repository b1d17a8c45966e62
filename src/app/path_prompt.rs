//! A path to type, where the system has no file dialog.

use egui::{Align2, Key, Modifiers, RichText, ScrollArea, TextEdit, Ui, Vec2};

use crate::files::{Files, PathPrompt};
use crate::panes::widgets::{self, mark};
use crate::theme::{ROW, Theme};

const WIDTH: f32 = 420.0;
const ROWS: f32 = 5.0;

#[derive(Clone, Copy, PartialEq, Eq)]
enum Step {
    Take,
    Complete,
}

pub(super) fn show(ui: &Ui, theme: &Theme, files: &mut Files) {
    let Some(prompt) = files.prompt_mut() else { return };
    let title = prompt.save.as_ref().map_or_else(|| "Open".to_owned(), |request| format!("Save {}", request.what));
    let (mut step, mut open) = (None, true);
    let shown = widgets::window(title, "path prompt", (Align2::CENTER_TOP, Vec2::new(0.0, 96.0)))
        .open(&mut open)
        .show(ui.ctx(), |ui| step = content(ui, theme, prompt));
    // A path is not lost by a press beside it.
    let _beside = shown.map(|shown| widgets::alone(ui.ctx(), &shown.response));
    // Esc is handled by the program: it closes the front overlay.
    match step {
        _ if !open => *files.prompt_mut() = None,
        Some(Step::Take) => files.take_prompt(),
        Some(Step::Complete) => files.complete_prompt(),
        None => {}
    }
}

fn content(ui: &mut Ui, theme: &Theme, prompt: &mut PathPrompt) -> Option<Step> {
    ui.label(match (prompt.no_dialog, prompt.save.is_some()) {
        (true, true) => "No file dialog here. Type a path.",
        (true, false) => "No file dialog here. Type a path, or drop the file.",
        (false, _) => "Type another path.",
    });
    let step = ui.horizontal(|ui| field(ui, prompt)).inner;
    if let Some(failure) = &prompt.failure {
        ui.set_max_width(WIDTH + 80.0);
        ui.label(RichText::new(failure).color(theme.error));
    }
    if let Some(path) = &prompt.replaces {
        let name = path.file_name().map_or_else(String::new, |name| format!(": {}", name.to_string_lossy()));
        ui.label(format!("That file exists{name}. Save again to replace it, or type another name."));
    }
    candidates(ui, prompt);
    let endings = prompt.save.as_ref().map_or_else(String::new, |request| format!("Saves as {}. ", request.endings()));
    ui.small(format!("{endings}Tab completes the path; ~ is your home folder."));
    if prompt.no_dialog {
        ui.small("For file dialogs, install a desktop portal or the package zenity.");
    }
    step
}

fn field(ui: &mut Ui, prompt: &mut PathPrompt) -> Option<Step> {
    let id = ui.scope_id().with("path");
    // Tab stays here instead of going to the next control.
    let edit = TextEdit::singleline(&mut prompt.text).id(id).desired_width(WIDTH).lock_focus(true);
    let field = ui.add(edit);
    widgets::labeled(&field, egui::Role::TextInput, "Path");
    if field.changed() {
        prompt.typed();
    }
    // Before the focus is taken back: then it would not have been lost.
    let entered = field.lost_focus() && ui.input(|input| input.key_pressed(Key::Enter));
    let tab = field.has_focus() && ui.input_mut(|input| input.consume_key(Modifiers::NONE, Key::Tab));
    let wanted = std::mem::take(&mut prompt.focus);
    if wanted || ui.memory(|memory| memory.focused().is_none()) {
        field.request_focus();
    }
    if std::mem::take(&mut prompt.to_end) || wanted {
        let end = prompt.text.chars().count();
        mark(ui, id, end..end);
    }
    let clicked = ui.button(if prompt.save.is_some() { "Save" } else { "Open" }).clicked();
    match (clicked || entered, tab) {
        (true, _) => Some(Step::Take),
        (false, true) => Some(Step::Complete),
        (false, false) => None,
    }
}

/// The names that the path could go on with; a click takes one.
fn candidates(ui: &mut Ui, prompt: &mut PathPrompt) {
    if prompt.candidates.is_empty() {
        return;
    }
    let mut chosen = None;
    let area = ScrollArea::vertical().id_salt("completions").max_height(ROWS * ROW).auto_shrink([false, true]);
    area.show_rows(ui, ROW, prompt.candidates.len(), |ui, range| {
        for name in &prompt.candidates[range] {
            if ui.selectable_label(false, name).clicked() {
                chosen = Some(name.clone());
            }
        }
    });
    if let Some(name) = chosen {
        let folder = prompt.text.rfind(std::path::is_separator).map_or(0, |at| at + 1);
        prompt.text.truncate(folder);
        prompt.text.push_str(&name);
        prompt.typed();
        prompt.focus = true;
    }
}
