//! Everything that can be done from a menu, a key or a button, in one list.

use chromascope_measure::Workload;
use egui::{Key, KeyboardShortcut, Modifiers};

use crate::action::Action;
use crate::document::SetKind;
use crate::document::imported::{Fingerprint, ImportOverrides};
use crate::export::FigureForm;
use crate::export::profile::CorrectionForm;
use crate::export::spectra::Form;
use crate::plot_item::{PlotItem, SensorId};
use crate::view::ReportOn;
use crate::view::import::ImportItem;
use crate::view::tour::Tour;
use crate::workspaces::{PaneKind, Side, Workspace};

/// Something to do at the start of the next frame.
#[derive(Clone, Debug, PartialEq)]
pub enum Command {
    Do(Action),
    Undo,
    Redo,
    Session(SessionCommand),
    Open,
    OpenRecorded,
    OpenFolder,
    Report(ReportOn),
    StopReport,
    /// Open a session or document in place of this one, which is saved first.
    OpenDocument(std::path::PathBuf),
    RemoveDocument(std::path::PathBuf),
    OpenPath(std::path::PathBuf),
    ShowImport(ImportItem, Option<usize>),
    SetOverrides(ImportItem, Box<ImportOverrides>),
    DiscardOverrides,
    /// Leave all to the content again, for a file and those like it.
    ForgetChoices(ImportItem),
    /// Make a set of a file that is none yet.
    UseFile(Fingerprint, Box<ImportOverrides>),
    /// Make a set of each of these parts of a file, from 1.
    UseParts(Fingerprint, Vec<usize>, Box<ImportOverrides>),
    /// Read all files of this one's kind as this one.
    UseForAlike(ImportItem),
    ForgetFile(Fingerprint),
    ReadAgain(String),
    StopReading,
    MeasureScene,
    MeasureWorkload(Workload),
    StopMeasuring,
    Paste(String),
    /// Show a pane as the printed page, or go back.
    FigurePage(PaneKind),
    Export(PaneKind, FigureForm),
    ExportExr(SensorId),
    CopySet(SetKind, String),
    SaveSet(SetKind, String, Form),
    SaveCorrection(CorrectionForm),
    /// Save a profile of the camera of a name, as made.
    SaveProfile(String, CorrectionForm, std::sync::Arc<[u8]>),
    CopyPicture(PaneKind),
    /// Put a pane's figure, the swatches and the conditions on the clipboard as one picture.
    CopyCard(PaneKind),
    SaveCard(PaneKind),
    CopyNumbers(PaneKind),
    Show(Workspace),
    Maximize(PaneKind),
    /// Show or hide what is at a side of Compare; a column that has no place in a narrow window lies over the center.
    Toggle(Side),
    /// Let plots show their own ranges.
    ResetView,
    ResetLayout,
    SetTheme(egui::ThemePreference),
    /// Take an alternative of a setting of the layout, by its place.
    Look(&'static str, usize),
    Select(PlotItem),
    Help(&'static str, usize),
    Tour(TourMove),
    ToggleAbout,
    FocusSearch,
    FindAnything,
    FocusTemperature,
    /// Show or hide the source of this place in the list, from 0.
    ToggleSource(usize),
    /// Keep the selection, or let it go.
    Pin,
    ToggleDifference,
    Escape,
    NextPane,
    GoTo(PaneKind),
    Seek(PaneKind, &'static str),
    Quit,
}

#[derive(Clone, Debug, PartialEq)]
pub enum SessionCommand {
    /// Begin a new session, from the template of a name or the default start.
    New(Option<&'static str>),
    NewFrom(std::path::PathBuf),
    Save,
    SaveAs,
    SaveTemplate,
    RemoveTemplate(std::path::PathBuf),
}

impl From<SessionCommand> for Command {
    fn from(command: SessionCommand) -> Self {
        Self::Session(command)
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TourMove {
    Begin(Tour),
    Back,
    /// To the next step; from the last one, to the end.
    Next,
    /// To the end: the user's own document comes back.
    End,
}

impl Command {
    /// True if it shows other panes, so that the Figure page closes.
    pub fn shows_panes(&self) -> bool {
        match self {
            Self::Toggle(side) => *side != Side::Left,
            Self::Show(_)
            | Self::Maximize(_)
            | Self::ResetLayout
            | Self::GoTo(_)
            | Self::Seek(..)
            | Self::ShowImport(..)
            | Self::MeasureScene
            | Self::Tour(_) => true,
            _ => false,
        }
    }
}

impl From<Action> for Command {
    fn from(action: Action) -> Self {
        Self::Do(action)
    }
}

/// A key and its command. One table serves the keys, the menus' hints and the help page.
pub struct KeyBinding {
    pub shortcut: KeyboardShortcut,
    pub command: Command,
    pub words: &'static str,
    pub rests_while_typing: bool,
}

const CTRL_SHIFT: Modifiers = Modifiers { shift: true, ..Modifiers::COMMAND };

/// All keys. `focused` is the pane that exports and maximizing mean.
pub fn key_bindings(focused: PaneKind) -> Vec<KeyBinding> {
    let binding = |modifiers, rests_while_typing| {
        move |key, command: Command, words: &'static str| {
            let shortcut = KeyboardShortcut::new(modifiers, key);
            KeyBinding { shortcut, command, words, rests_while_typing }
        }
    };
    // On a Mac, Command stands for Ctrl.
    let (with_ctrl, shifted) = (binding(Modifiers::COMMAND, false), binding(CTRL_SHIFT, false));
    let (letter, always) = (binding(Modifiers::NONE, true), binding(Modifiers::NONE, false));
    let mut keys = vec![
        // The longer combination first: egui's Ctrl+Z would also take Ctrl+Shift+Z.
        shifted(Key::Z, Command::Redo, "Redo"),
        shifted(Key::C, Command::CopyPicture(focused), "Copy the pane's picture"),
        shifted(Key::S, Command::Session(SessionCommand::SaveAs), "Save the session under a name"),
        with_ctrl(Key::S, Command::Session(SessionCommand::Save), "Save the session"),
        with_ctrl(Key::N, Command::Session(SessionCommand::New(None)), "New session"),
        with_ctrl(Key::O, Command::Open, "Open files"),
        with_ctrl(Key::E, Command::FigurePage(focused), "The pane as the printed page: size, style, PDF"),
        with_ctrl(Key::Z, Command::Undo, "Undo"),
        with_ctrl(Key::Y, Command::Redo, "Redo"),
        with_ctrl(Key::F, Command::FocusSearch, "Add a camera; in Data, search all sets"),
        with_ctrl(Key::K, Command::FindAnything, "Find anything"),
    ];
    let numbers = [Key::Num1, Key::Num2, Key::Num3, Key::Num4, Key::Num5, Key::Num6, Key::Num7, Key::Num8, Key::Num9];
    for (workspace, key) in Workspace::ALL.into_iter().zip(numbers) {
        keys.push(with_ctrl(key, Command::Show(workspace), "Workspace"));
    }
    keys.extend([
        letter(Key::F, Command::Maximize(focused), "Maximize the pane"),
        letter(Key::L, Command::Toggle(Side::Left), "Compared sensors"),
        letter(Key::I, Command::Toggle(Side::Right), "Right column"),
        letter(Key::T, Command::FocusTemperature, "Type a temperature"),
        letter(Key::P, Command::Pin, "Pin the selection"),
        letter(Key::D, Command::ToggleDifference, "Difference bars"),
        letter(Key::Home, Command::ResetView, "Reset the view"),
    ]);
    for (index, key) in numbers.into_iter().enumerate() {
        keys.push(letter(key, Command::ToggleSource(index), "Show or hide a compared sensor"));
    }
    keys.extend([
        always(Key::F1, Command::Help(crate::help::FIRST, 0), "Help"),
        always(Key::F6, Command::NextPane, "Next pane"),
        always(Key::Escape, Command::Escape, "One step back"),
    ]);
    keys
}

pub const THEMES: [(egui::ThemePreference, &str); 3] = [
    (egui::ThemePreference::System, "System"),
    (egui::ThemePreference::Dark, "Dark"),
    (egui::ThemePreference::Light, "Light"),
];

pub const REPORTS: [(ReportOn, &str); 4] = [
    (ReportOn::Comparison, "This comparison…"),
    (ReportOn::Paper, "The paper, with its cameras and patches…"),
    (ReportOn::Document, "The paper, with these cameras and patches…"),
    (ReportOn::Library, "The library as files to cite (data package)…"),
];

pub fn key_name(shortcut: KeyboardShortcut) -> String {
    shortcut.format(&egui::ModifierNames::NAMES, cfg!(target_os = "macos"))
}

pub fn shortcut_of(command: &Command, focused: PaneKind) -> Option<KeyboardShortcut> {
    key_bindings(focused).into_iter().find(|binding| binding.command == *command).map(|binding| binding.shortcut)
}
