//! The palette that finds anything: commands, settings, numbers, data sets, patches, panes and help.

mod settings;

use egui::{Align2, Id, Ui, Vec2};

use crate::action::history::History;
use crate::action::{Action, CompareAction, RenderAction, SceneAction};
use crate::catalog::Entry;
use crate::catalog::names::{NO_PHONES, is_for_phone, ranked};
use crate::command::{Command, REPORTS, TourMove, key_bindings, key_name};
use crate::document::start::Start;
use crate::document::{LOCUS_RANGE_K, Light, SetKind, WhiteBalanceChoice};
use crate::export::FigureForm;
use crate::export::profile::CorrectionForm;
use crate::figures::swatches;
use crate::help;
use crate::panes::PaneContext;
use crate::panes::widgets;
use crate::panes::widgets::pick_list::{Line, PickList};
use crate::plot_item::{PlotItem, SensorId};
use crate::view::import::ImportItem;
use crate::view::tour::Tour;
use crate::workspaces::{PaneKind, Side, Workspace};

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
    let shown = window.fixed_size(size).show(ui.ctx(), |ui| {
        let list = PickList {
            id: Id::unique("palette search"),
            name: "Find anything",
            hint: "A setting, a camera, a light, a patch, a temperature…",
            height: HEIGHT.min(screen.height() - 180.0),
            from_set: false,
            is_short: false,
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
    let is_left = shown.is_some_and(|shown| widgets::alone(ui.ctx(), &shown.response));
    match chosen {
        Some(command) => context.push(command),
        None => context.view.palette = Some(state).filter(|_| !is_left),
    }
}

/// Everything that matches, by group, each below its heading; places in the help come last.
fn find(text: &str, history: &History, context: &PaneContext<'_>) -> Vec<Found> {
    let mut all = numbers(text, context);
    all.extend(commands(history, context));
    all.extend(panes(context));
    all.extend(phones(text));
    all.extend(sets(context));
    all.extend(settings::scene(context));
    all.extend(settings::view(context));
    all.extend(settings::render(context));
    all.extend(saves(context));
    all.extend(patches(context));
    all.extend(pages());
    let mut found = matching(all, text);
    let hits = help_text(text);
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

/// Largest number of patches and of places in the help that are listed.
const MOST_PATCHES: usize = 1000;
const MOST_HITS: usize = 8;

/// What a number stands for: a temperature in kelvins.
fn numbers(text: &str, context: &PaneContext<'_>) -> Vec<Found> {
    let text = text.trim().trim_end_matches(['k', 'K']).trim_end();
    let Some(kelvin) = text.parse::<f64>().ok().filter(|k| (LOCUS_RANGE_K[0]..=LOCUS_RANGE_K[1]).contains(k)) else {
        return Vec::new();
    };
    let note = match context.scene.document.light {
        Light::Set(_) => "marks the loci",
        Light::BlackBody => "of the light",
        Light::Daylight => "of daylight, from 4000 K",
    };
    let set = |words: String, action: SceneAction| Found::new("Temperature", words, Action::Scene(action));
    let white = |words: &str, white| set(format!("White balance: {words} {kelvin} K"), SceneAction::SetWhite(white));
    let mut found = vec![set(format!("Temperature {kelvin} K"), SceneAction::SetTemperature(kelvin)).note(note)];
    found.push(white("blackbody", WhiteBalanceChoice::BlackBody(kelvin)));
    if kelvin >= 4000.0 {
        found.push(white("daylight", WhiteBalanceChoice::Daylight(kelvin)));
    }
    found
}

/// Commands with a key, and the starts.
fn commands(history: &History, context: &PaneContext<'_>) -> Vec<Found> {
    let focused = context.view.focused.unwrap_or(PaneKind::CHROMATICITY);
    let mut found: Vec<Found> = Vec::new();
    for binding in key_bindings(focused) {
        let name = |word: &str, step: Option<&str>| step.map(|step| format!("{word} ({step})"));
        let words = match binding.command {
            Command::ToggleSource(_) | Command::FindAnything | Command::Escape | Command::Show(_) => None,
            Command::Undo => name("Undo", history.undo_name()),
            Command::Redo => name("Redo", history.redo_name()),
            _ => Some(binding.words.to_owned()),
        };
        if let Some(words) =
            words.filter(|_| !found.iter().any(|known| known.command.as_ref() == Some(&binding.command)))
        {
            found.push(Found::new("Commands", words, binding.command).note(key_name(binding.shortcut)));
        }
    }
    let others = [
        ("Open a folder", Command::OpenFolder),
        ("Reset layout", Command::ResetLayout),
        ("Fold the lower view away, or show it", Command::Toggle(Side::Lower)),
        (Tour::Program.label(), Command::Tour(TourMove::Begin(Tour::Program))),
        (Tour::Paper.label(), Command::Tour(TourMove::Begin(Tour::Paper))),
        ("About Chromascope", Command::ToggleAbout),
        ("Copy Chromaticity as card", Command::CopyCard(PaneKind::CHROMATICITY)),
    ];
    for (words, command) in others {
        found.push(Found::new("Commands", words, command));
    }
    if let Some((words, item)) = swatches::worst(&context.scene) {
        found
            .push(Found::new("Commands", words, Command::Select(item)).note("select").also("patch largest difference"));
    }
    for start in Start::ALL {
        found.push(Found::new("Commands", format!("Start: {}", start.label()), Action::Start(start)));
    }
    found.push(Found::new("Commands", "Reset to the first screen", Action::Reset));
    for (action, words) in [
        (RenderAction::Figure8, "Figure 8: a head under direct sunlight"),
        (RenderAction::Figure9, "Figure 9: a fern under direct sunlight"),
        (RenderAction::PaperFigure8, "Figure 8, as in the paper: point light, Eq 12 as printed"),
        (RenderAction::PaperFigure9, "Figure 9, as in the paper: point light, Eq 12 as printed"),
    ] {
        found.push(Found::new("Render", words, Action::Render(action)));
    }
    found
}

fn panes(context: &PaneContext<'_>) -> Vec<Found> {
    let now = context.view.saved.workspace;
    let keys = key_bindings(PaneKind::CHROMATICITY);
    let mut found: Vec<Found> = Vec::new();
    for workspace in Workspace::ALL {
        let command = Command::Show(workspace);
        let key = keys.iter().find(|binding| binding.command == command);
        let key = key.map_or_else(String::new, |binding| key_name(binding.shortcut));
        let words = format!("Workspace {}", workspace.label());
        found.push(Found::new("Workspaces and panes", words, command).note(key).on(workspace == now));
    }
    for pane in context.panes {
        let on = context.view.is_shown(pane.kind);
        let words =
            if pane.tab == pane.title { pane.title.to_owned() } else { format!("{}: {}", pane.tab, pane.title) };
        let also = match pane.kind {
            PaneKind::LIGHT => "judge this light rendering index",
            PaneKind::METHODS => "numerics bench",
            PaneKind::MEASURE => "photograph photo picture raw DNG chart profile DCP sensitivities",
            _ => "",
        };
        found.push(Found::new("Workspaces and panes", words, Command::GoTo(pane.kind)).on(on).also(also));
    }
    found
}

fn saves(context: &PaneContext<'_>) -> Vec<Found> {
    let mut found = Vec::new();
    for pane in context.panes.iter().filter(|pane| pane.figure.is_some()) {
        let page = Found::new("Save", format!("Figure page of {}", pane.title), Command::FigurePage(pane.kind));
        found.push(page.also("print paper export PDF journal"));
        for form in FigureForm::ALL {
            let numbers = if form.is_numbers() { "numbers " } else { "" };
            let words = format!("Save {} {numbers}as {}…", pane.title, form.label());
            found.push(Found::new("Save", words, Command::Export(pane.kind, form)).also("export figure picture file"));
        }
    }
    for (on, words) in REPORTS {
        let words = format!("Report: {}{}", words[..1].to_lowercase(), &words[1..]);
        found.push(
            Found::new("Save", words, Command::Report(on))
                .also("figures claims ranking export pdf html page csv json license"),
        );
    }
    for form in context.view.camera(&context.scene).map_or(&[][..], |_| &CorrectionForm::ALL) {
        let (words, hint) = form.words();
        let words = format!("Save the color correction as {words}");
        let also = format!("{hint} export matrix camera profile DCP ICC CLF");
        found.push(Found::new("Save", words, Command::SaveCorrection(*form)).also(also));
    }
    found
}

fn patches(context: &PaneContext<'_>) -> Vec<Found> {
    let patches = context.scene.patches();
    let names = patches.iter().flat_map(|set| set.patches()).take(MOST_PATCHES).map(|patch| patch.name.clone());
    let found = names.map(|patch| {
        let item = PlotItem::Patch { source: None, patch: patch.clone() };
        let on = context.view.selected.as_ref() == Some(&item);
        Found::new("Patches shown", patch, Command::Select(item)).note("select").on(on)
    });
    found.collect()
}

/// Data sets, with what choosing one does.
fn sets(context: &PaneContext<'_>) -> Vec<Found> {
    SetKind::ALL
        .into_iter()
        .flat_map(|kind| context.scene.entries(kind).map(move |entry| set(kind, entry, context)))
        .collect()
}

fn set(kind: SetKind, entry: Entry, context: &PaneContext<'_>) -> Found {
    let document = context.scene.document;
    let line = Line::of_set(&entry, false);
    let name = entry.name;
    let (group, command, note, on) = match kind {
        SetKind::Camera | SetKind::Observer => {
            let group = if kind == SetKind::Camera { "Cameras" } else { "Observers" };
            let id = SensorId { kind, name: name.clone() };
            if kind == SetKind::Observer && name == document.reference {
                (group, Command::Select(PlotItem::Sensor(id)), "the reference: select", true)
            } else if document.compared(kind, &name).is_some() {
                (group, Command::Select(PlotItem::Sensor(id)), "compared: select", true)
            } else {
                (group, Action::Compare(CompareAction::Add(kind, name.clone())).into(), "compare", false)
            }
        }
        SetKind::Chart | SetKind::Material => {
            let group = if kind == SetKind::Chart { "Charts" } else { "Materials" };
            (group, Action::Scene(SceneAction::SetChart(name.clone())).into(), "as patches", document.chart == name)
        }
        SetKind::Illuminant => {
            let light = Light::Set(name.clone());
            let on = document.light == light;
            ("Illuminants", Action::Scene(SceneAction::SetLight(light)).into(), "as light", on)
        }
        SetKind::Filter => {
            let on = document.filters.contains(&name);
            let note = if on { "remove from the light" } else { "add to the light" };
            ("Filters", Action::Scene(SceneAction::SetFilter(name.clone(), !on)).into(), note, on)
        }
        SetKind::Unsorted => {
            let command = Command::ShowImport(ImportItem::Set(name.clone()), None);
            ("Unsorted spectra", command, "choose what it is", false)
        }
    };
    Found { line, ..Found::new(group, "", command) }.note(note).on(on)
}

/// To a search for a phone: that there is none, and how one is brought in.
fn phones(text: &str) -> Option<Found> {
    let help = Command::Help("own-spectra", 0);
    is_for_phone(text).then(|| Found::new("Cameras", NO_PHONES, help).note("how to add one").also(text))
}

fn pages() -> Vec<Found> {
    let pages = help::pages().iter();
    pages.map(|page| Found::new("Help", &page.title, Command::Help(page.name, 0)).note("page")).collect()
}

fn help_text(text: &str) -> Vec<Found> {
    let hits = help::search(help::pages(), text).into_iter().take(MOST_HITS);
    hits.map(|hit| Found::new("", hit.excerpt, Command::Help(hit.page, hit.block)).note(hit.heading)).collect()
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
