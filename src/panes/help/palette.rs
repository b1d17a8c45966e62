//! The palette that finds anything: commands, settings, numbers, data sets, patches, panes and help.

mod found;
mod settings;

use egui::{Align2, Id, Ui, Vec2};

use crate::action::history::History;
use crate::catalog::names::ranked;
use crate::command::Command;
use crate::panes::PaneContext;
use crate::panes::widgets::{
    self,
    pick_list::{Line, PickList},
};

/// Group of places in the help, which stands last.
const IN_HELP: &str = "In the help";

const HEIGHT: f32 = 380.0;

struct Found {
    group: &'static str,
    line: Line,
    /// None for the heading of a group.
    command: Option<Command>,
}

impl Found {
    fn new(group: &'static str, words: impl Into<String>, command: impl Into<Command>) -> Self {
        Self { group, line: Line::new(words, false), command: Some(command.into()) }
    }

    fn heading(group: &'static str) -> Self {
        Self { group, line: Line::heading(group), command: None }
    }

    fn also(mut self, words: impl Into<String>) -> Self {
        self.line.also = words.into();
        self
    }

    fn note(mut self, note: impl Into<String>) -> Self {
        self.line.note = note.into();
        self
    }

    fn on(mut self, on: bool) -> Self {
        self.line.on = on;
        self
    }
}

/// Shows the search field and what it finds while the palette is open. Arrow keys move, Enter chooses.
pub(super) fn show(ui: &Ui, history: &History, context: &mut PaneContext<'_>) {
    let Some(mut state) = context.view.palette.take() else { return };
    let mut chosen = None;
    let screen = ui.ctx().content_rect();
    let theme = context.theme;
    let window = widgets::window("Find anything", "palette", (Align2::CENTER_TOP, Vec2::new(0.0, 84.0)));
    let size = Vec2::new(520.0_f32.min(screen.width() - 40.0), HEIGHT + 40.0);
    window.fixed_size(size).show(ui.ctx(), |ui| {
        let list = PickList {
            id: Id::unique("palette search"),
            name: "Find anything",
            hint: "A setting, a camera, a light, a patch, a temperature…",
            height: HEIGHT.min(screen.height() - 180.0),
            from_set: false,
        };
        let mut commands = Vec::new();
        let lines = |text: &str| {
            let found = find(text, history, context);
            let (lines, made) = found.into_iter().map(|found| (found.line, found.command)).unzip();
            commands = made;
            lines
        };
        let index = list.show(ui, &mut state, lines, &theme);
        chosen = index.and_then(|index| commands.swap_remove(index));
    });
    match chosen {
        Some(command) => context.push(command),
        None => context.view.palette = Some(state),
    }
}

/// Everything that matches, by group, each below its heading; places in the help come last.
fn find(text: &str, history: &History, context: &PaneContext<'_>) -> Vec<Found> {
    let mut all = found::numbers(text, context);
    all.extend(found::commands(history, context));
    all.extend(found::panes(context));
    all.extend(found::phones(text));
    all.extend(found::sets(context));
    all.extend(settings::scene(context));
    all.extend(settings::view(context));
    all.extend(settings::render(context));
    all.extend(found::saves(context));
    all.extend(found::patches(context));
    all.extend(found::pages());
    let mut found = matching(all, text);
    let hits = found::help_text(text);
    if !hits.is_empty() {
        found.push(Found::heading(IN_HELP));
        found.extend(hits);
    }
    found
}

/// What matches, by group, each below its heading; the group with the best match is first.
fn matching(all: Vec<Found>, text: &str) -> Vec<Found> {
    let facts = |found: &Found| (found.group, found.line.words.clone(), found.line.also.clone());
    let groups = ranked(text, all.into_iter(), facts);
    groups.into_iter().flat_map(|(group, found)| std::iter::once(Found::heading(group)).chain(found)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn settings_come_before_what_only_contains_the_words() {
        let found = |group, words: &str| Found::new(group, words, Command::Undo);
        let all = vec![
            found("Patches shown", "outfit"),
            found("Settings", "Color transform: fitted to CIE 1931"),
            found("Settings", "Diagram: fit to data"),
        ];
        let lines: Vec<String> = matching(all, "fit").into_iter().map(|found| found.line.words).collect();
        assert_eq!(
            lines,
            ["Settings", "Color transform: fitted to CIE 1931", "Diagram: fit to data", "Patches shown", "outfit"]
        );
    }
}
