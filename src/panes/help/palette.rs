//! The palette that finds anything: commands, settings, numbers, data sets, patches, panes and help.

mod settings;
mod things;

use egui::{Align2, Id, Ui, Vec2, Window};

use crate::action::history::History;
use crate::catalog::names::folded;
use crate::command::Command;
use crate::panes::PaneContext;
use crate::panes::widgets::pick_list::{Line, PickList, typed_words};

/// Group of places in the help, which stands last.
const IN_HELP: &str = "In the help";

/// Height of the lines.
const HEIGHT: f32 = 380.0;

/// Something that can be found, and what choosing it does.
struct Found {
    group: &'static str,
    line: Line,
    command: Command,
}

impl Found {
    fn new(group: &'static str, words: impl Into<String>, command: impl Into<Command>) -> Self {
        Self { group, line: Line::new(words, false), command: command.into() }
    }

    /// Further words that find it.
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
    let window = Window::new("Find anything")
        .id(Id::unique("palette"))
        .collapsible(false)
        .resizable(false)
        .anchor(Align2::CENTER_TOP, Vec2::new(0.0, 84.0))
        .fixed_size(Vec2::new(520.0_f32.min(screen.width() - 40.0), HEIGHT + 40.0));
    window.show(ui.ctx(), |ui| {
        let list = PickList {
            id: Id::unique("palette search"),
            name: "Find anything",
            hint: "A setting, a camera, a light, a patch, a temperature…",
            height: HEIGHT.min(screen.height() - 180.0),
            from_set: false,
        };
        let mut commands = Vec::new();
        let lines = |text: &str| {
            let mut lines = Vec::new();
            for (line, command) in grouped(find(text, history, context), text) {
                lines.push(line);
                commands.push(command);
            }
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

/// Everything that matches.
fn find(text: &str, history: &History, context: &PaneContext<'_>) -> Vec<Found> {
    let typed = typed_words(text);
    let mut found = things::numbers(text, context);
    let mut all = things::commands(history, context);
    all.extend(things::panes(context));
    all.extend(settings::scene(context));
    all.extend(settings::view(context));
    all.extend(settings::render(context));
    all.extend(things::saves(context));
    all.extend(things::patches(context));
    all.extend(things::sets(context));
    all.extend(things::pages());
    found.extend(all.into_iter().filter(|found| found.line.matches(&typed)));
    found.extend(things::help_text(text));
    found
}

/// What was found, by group, each below its heading; a heading has no command. The group with the best match is first.
fn grouped(found: Vec<Found>, text: &str) -> Vec<(Line, Option<Command>)> {
    let typed = typed_words(text);
    let mut groups: Vec<(&'static str, Vec<(usize, Found)>)> = Vec::new();
    for found in found {
        let rank = rank(&found.line, &typed);
        match groups.iter_mut().find(|(name, _)| *name == found.group) {
            Some((_, group)) => group.push((rank, found)),
            None => groups.push((found.group, vec![(rank, found)])),
        }
    }
    for (_, group) in &mut groups {
        group.sort_by_key(|(rank, _)| *rank);
    }
    groups.sort_by_key(|(name, group)| (*name == IN_HELP, group[0].0));
    let lines = groups.into_iter().flat_map(|(name, group)| {
        let heading = std::iter::once((Line::heading(name), None));
        heading.chain(group.into_iter().map(|(_, found)| (found.line, Some(found.command))))
    });
    lines.collect()
}

/// How well a line matches: begins with whole words, begins with, has words that begin with, contains, has other words for it. What
/// stands behind a colon counts as a beginning.
fn rank(line: &Line, typed: &[String]) -> usize {
    let text = typed.concat();
    let known = typed_words(&line.words);
    let parts = [folded(&line.words), line.words.split_once(':').map_or_else(String::new, |(_, value)| folded(value))];
    let begins = !text.is_empty() && parts.iter().any(|part| part.starts_with(&text));
    let has_whole = typed.iter().all(|word| known.contains(word));
    let has_beginnings = typed.iter().all(|word| known.iter().any(|known| known.starts_with(word.as_str())));
    match () {
        () if begins && has_whole => 0,
        () if begins => 1,
        () if has_beginnings => 2,
        () if typed.iter().all(|word| parts[0].contains(word.as_str())) => 3,
        () => 4,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn settings_come_before_what_only_contains_the_words() {
        let found = |group, words: &str| Found::new(group, words, Command::Undo);
        let all = vec![
            found(IN_HELP, "Fitted. A color correction matrix"),
            found("Patches shown", "outfit"),
            found("Settings", "Color transform: fitted to CIE 1931"),
            found("Settings", "Diagram: fit to data"),
        ];
        let lines: Vec<String> = grouped(all, "fit").into_iter().map(|(line, _)| line.words).collect();
        assert_eq!(
            lines,
            [
                "Settings",
                "Diagram: fit to data",
                "Color transform: fitted to CIE 1931",
                "Patches shown",
                "outfit",
                IN_HELP,
                "Fitted. A color correction matrix"
            ]
        );
    }
}
