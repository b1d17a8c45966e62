//! The palette that finds anything: commands, scenes, help pages and data sets.

use egui::{Align2, Key, ScrollArea, TextEdit, Ui, Vec2, Window};

use crate::action::history::History;
use crate::action::{Action, CompareAction, RenderAction, SceneAction};
use crate::catalog::{Entry, names};
use crate::command::{Command, key_bindings};
use crate::document::Light;
use crate::document::SetKind;
use crate::help;
use crate::panes::PaneContext;
use crate::theme::ROW;
use crate::view::import::ImportItem;
use crate::workspaces::{PaneKind, Workspace};

struct Found {
    words: String,
    note: String,
    command: Command,
}

/// Shows the search field and its results while the palette is open. Enter runs the first.
pub(super) fn show(ui: &Ui, history: &History, context: &mut PaneContext<'_>) {
    let Some(mut typed) = context.view.palette.take() else { return };
    let mut chosen = None;
    let screen = ui.ctx().content_rect();
    let window = Window::new("Find anything")
        .id(egui::Id::unique("palette"))
        .collapsible(false)
        .resizable(false)
        .anchor(Align2::CENTER_TOP, Vec2::new(0.0, 84.0))
        .fixed_size(Vec2::new(520.0_f32.min(screen.width() - 40.0), 360.0));
    window.show(ui.ctx(), |ui| {
        let hint = "A command, a camera, a light, a chart…";
        let field = TextEdit::singleline(&mut typed).hint_text(hint).desired_width(f32::INFINITY);
        let field = ui.add(field);
        field.widget_info(|| egui::WidgetInfo::labeled(egui::Role::TextInput, true, "Find anything"));
        if !field.has_focus() && !field.lost_focus() && ui.memory(|memory| memory.focused().is_none()) {
            field.request_focus();
        }
        let found = find(&typed, history, context);
        if field.lost_focus() && ui.input(|input| input.key_pressed(Key::Enter)) {
            chosen = found.first().map(|found| found.command.clone());
        }
        if found.is_empty() {
            ui.label("No match.");
        }
        ScrollArea::vertical().auto_shrink([false, true]).show_rows(ui, ROW, found.len(), |ui, rows| {
            for found in &found[rows] {
                let button = egui::Button::new(&found.words).shortcut_text(&found.note).frame_when_inactive(false);
                if ui.add_sized([ui.available_width(), ROW], button).clicked() {
                    chosen = Some(found.command.clone());
                }
            }
        });
    });
    match chosen {
        Some(command) => context.push(command),
        None => context.view.palette = Some(typed),
    }
}

fn find(typed: &str, history: &History, context: &PaneContext<'_>) -> Vec<Found> {
    let wanted: Vec<String> = typed.split_whitespace().map(names::folded).collect();
    let matches = |words: &str| {
        let words = names::folded(words);
        wanted.iter().all(|word| words.contains(word))
    };
    let focused = context.view.focused.unwrap_or(PaneKind::CHROMATICITY);
    let mut found: Vec<Found> = key_bindings(focused)
        .into_iter()
        .filter(|binding| {
            !matches!(binding.command, Command::ToggleSource(_) | Command::FindAnything | Command::Escape)
        })
        .filter(|binding| binding.command != Command::Undo || history.undo_name().is_some())
        .map(|binding| Found {
            words: match binding.command {
                Command::Show(workspace) => format!("Workspace {}", Workspace::title(workspace)),
                _ => binding.words.to_owned(),
            },
            note: key_name(binding.shortcut),
            command: binding.command,
        })
        .filter(|found| matches(&found.words))
        .collect();
    for (action, words) in [
        (RenderAction::Figure8, "Figure 8: a head under direct sunlight"),
        (RenderAction::Figure9, "Figure 9: a fern under direct sunlight"),
        (RenderAction::PaperFigure8, "Figure 8, as in the paper: point light, Eq 12 as printed"),
        (RenderAction::PaperFigure9, "Figure 9, as in the paper: point light, Eq 12 as printed"),
    ] {
        if matches(words) {
            let command = Command::Do(Action::Render(action));
            found.push(Found { words: words.to_owned(), note: "render".to_owned(), command });
        }
    }
    for page in help::pages().iter().filter(|page| matches(&page.title)) {
        found.push(Found { words: page.title.clone(), note: "help".to_owned(), command: Command::Help(page.name) });
    }
    for kind in SetKind::ALL {
        let entries = context.scene.entries(kind).filter(|entry| names::matches_search(entry, typed));
        found.extend(entries.map(|entry| entry_found(kind, &entry)));
    }
    found
}

fn key_name(shortcut: egui::KeyboardShortcut) -> String {
    shortcut.format(&egui::ModifierNames::NAMES, cfg!(target_os = "macos"))
}

/// Result for a data set, with what choosing it does.
fn entry_found(kind: SetKind, entry: &Entry) -> Found {
    let name = entry.name.clone();
    let action = match kind {
        SetKind::Camera | SetKind::Observer => Action::Compare(CompareAction::Add(kind, name)),
        SetKind::Chart | SetKind::Material => Action::Scene(SceneAction::SetChart(name)),
        SetKind::Illuminant => Action::Scene(SceneAction::SetLight(Light::Set(name))),
        SetKind::Filter => Action::Scene(SceneAction::SetFilter(name, true)),
        SetKind::Unsorted => {
            let command = Command::ShowImport(ImportItem::Set(name), None);
            return Found { words: entry.name.clone(), note: "unsorted: choose what it is".to_owned(), command };
        }
    };
    let verb = match kind {
        SetKind::Camera | SetKind::Observer => "compare",
        SetKind::Chart | SetKind::Material => "as patches",
        SetKind::Filter => "add to the light",
        SetKind::Illuminant | SetKind::Unsorted => "as light",
    };
    Found { words: entry.name.clone(), note: format!("{}, {verb}", kind.singular()), command: Command::Do(action) }
}
