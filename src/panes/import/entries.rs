//! The list of files: the document's own sets, then opened files that no set is made of.

use std::path::PathBuf;

use chromascope_figure::{Cell, Table};

use crate::catalog::opened::OpenFile;
use crate::document::imported::{ImportedSet, Role};
use crate::panes::context::PaneContext;
use crate::view::import::ImportItem;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum State {
    /// Read without a doubt.
    Certain,
    /// Read with a guess that the user has seen.
    Seen,
    /// Read with a guess that the user has not reviewed.
    Unseen,
    /// Read as written: the role has to be chosen.
    Open,
    /// Not used, though it could be read.
    Unused,
    Failed,
}

impl State {
    pub(super) const ALL: [Self; 6] = [Self::Certain, Self::Seen, Self::Unseen, Self::Open, Self::Unused, Self::Failed];

    /// Description for tooltips and screen readers.
    pub(super) const fn words(self) -> &'static str {
        match self {
            Self::Certain => "read",
            Self::Seen => "read, with guesses",
            Self::Unseen => "read, with guesses that nobody has looked at",
            Self::Open => "not decided: choose what it is",
            Self::Unused => "not used",
            Self::Failed => "not read",
        }
    }
}

pub(super) struct Entry {
    pub(super) item: ImportItem,
    pub(super) name: String,
    pub(super) state: State,
    /// Contents, or the reason why it was not read.
    pub(super) note: String,
    pub(super) path: Option<PathBuf>,
    pub(super) at_hand: bool,
}

pub(super) fn all(context: &PaneContext<'_>) -> Vec<Entry> {
    let files = context.opened.files();
    let own = &context.scene.document.own;
    let sets = own.iter().map(|set| of_set(set, &files, context));
    // The contents that a file had before a change are retained for undo; in the list it is the same file.
    let is_of = |set: &ImportedSet, file: &OpenFile| {
        set.fingerprint == Some(file.origin.fingerprint)
            || (file.failure.is_none() && set.path.is_some() && set.path == file.origin.path)
    };
    let unused = files.iter().filter(|file| !own.iter().any(|set| is_of(set, file)));
    sets.chain(unused.map(of_file)).collect()
}

fn of_set(set: &ImportedSet, files: &[OpenFile], context: &PaneContext<'_>) -> Entry {
    let item = ImportItem::Set(set.name.clone());
    // A decision is a sentence that ends with its confidence; the role's comes first.
    let open = |decision: &String| decision.ends_with("(open)");
    let guessed = |decision: &String| decision.ends_with("(a guess)") || open(decision);
    let state = match (set.decisions.iter().any(guessed), context.view.import.unseen.contains(&item)) {
        _ if set.decisions.iter().any(open) => State::Open,
        (_, true) => State::Unseen,
        (true, false) => State::Seen,
        (false, false) => State::Certain,
    };
    let curves = if set.curves.len() == 1 { "1 curve".to_owned() } else { format!("{} curves", set.curves.len()) };
    let doubt = if set.decisions.first().is_some_and(guessed) { "?" } else { "" };
    let role = role(set.role, set.curves.len() == 1);
    let at_hand = files.iter().any(|file| Some(file.origin.fingerprint) == set.fingerprint);
    let note = format!("{curves}, {role}{doubt}");
    Entry { name: set.name.clone(), state, note, path: set.path.clone(), at_hand, item }
}

const fn role(role: Role, one: bool) -> &'static str {
    match (role, one) {
        (Role::Camera, _) => "a camera",
        (Role::Reflectance, true) => "reflectance",
        (Role::Reflectance, false) => "reflectances",
        (Role::Transmittance, true) => "transmittance",
        (Role::Transmittance, false) => "transmittances",
        (Role::Illuminant, true) => "a light",
        (Role::Illuminant, false) => "lights",
        (Role::Unknown, _) => "of unknown kind",
    }
}

fn of_file(file: &OpenFile) -> Entry {
    let name = file.origin.name.clone();
    let (state, note) = match &file.failure {
        Some(failure) => (State::Failed, reason(failure, &name).to_owned()),
        None => (State::Unused, "not used".to_owned()),
    };
    let item = ImportItem::File(file.origin.fingerprint);
    Entry { item, name, state, note, path: file.origin.path.clone(), at_hand: true }
}

fn reason<'a>(failure: &'a str, name: &str) -> &'a str {
    failure.strip_prefix(name).map_or(failure, |rest| rest.trim_start_matches([',', ':', ' ']))
}

pub(super) fn table(entries: &[Entry]) -> Table {
    let mut table = Table::new(["file", "state", "holds", "path"].map(str::to_owned));
    for entry in entries {
        let path = entry.path.as_ref().map_or(Cell::Empty, |path| Cell::Text(path.display().to_string()));
        let words = [entry.name.clone(), entry.state.words().to_owned(), entry.note.clone()].map(Cell::Text);
        table.push(words.into_iter().chain([path]).collect::<Vec<_>>());
    }
    table
}
