//! Opening the user's spectra: read first, then put to use; and reading them otherwise, or again.

mod reload;
mod words;

use std::collections::BTreeSet;
use std::path::PathBuf;

use chromascope_core::query::Shared;

use super::ChromascopeApp;
use crate::action::history::History;
use crate::action::{Action, ImportedAction};
use crate::catalog::import::{Imported, imported};
use crate::catalog::likeness::Likeness;
use crate::catalog::opened::{CLIPBOARD, OpenFile, OpenedEvent, Request, Why};
use crate::command::Command;
use crate::document::SetKind;
use crate::document::imported::{Fingerprint, ImportOverrides, ImportedSet};
use crate::panes::import;
use crate::view::import::{ImportItem, of_a_kind};
use crate::view::{Offer, Status, Weight};
use crate::workspaces::{PaneKind, Workspace};
use words::{opened_again, put_to_use, renamed};

impl ChromascopeApp {
    /// Begins to read. The document stays as it is until that is done.
    pub(super) fn open(&mut self, requests: Vec<Request>) {
        self.end_tour();
        let memory = self.view.saved.import.clone();
        self.opened.open(requests, move |bytes| {
            if memory.remembered.is_empty() { ImportOverrides::default() } else { memory.wishes(&Likeness::of(bytes)) }
        });
    }

    /// Opens files named at the start, which are the user's word: a single one is put to use.
    pub fn open_at_start(&mut self, paths: Vec<PathBuf>) {
        self.at_start = paths.iter().filter_map(|path| std::path::absolute(path).ok()).collect();
        self.open(paths.into_iter().map(Request::Path).collect());
    }

    /// Files dropped on the window in one gesture.
    pub(super) fn take_dropped(&mut self, ctx: &egui::Context) {
        let dropped = ctx.input(|input| input.raw.dropped_files.clone());
        if dropped.is_empty() {
            return;
        }
        let mut requests = Vec::new();
        for file in dropped {
            let path = file.path().to_path_buf();
            if path.exists() {
                requests.push(Request::Path(path));
                continue;
            }
            let name = path.file_name().map_or_else(|| "dropped file".to_owned(), |n| n.to_string_lossy().into_owned());
            match file.bytes() {
                Ok(bytes) => requests.push(Request::Bytes { name, bytes: bytes.into() }),
                Err(error) => self.view.fail(format!("{name}: {error}. Nothing was changed.")),
            }
        }
        self.open(requests);
    }

    pub(super) fn take_opened(&mut self) {
        for event in self.opened.poll() {
            match event {
                OpenedEvent::Read { sets, message, failure, paths, failed } => {
                    self.bring_in(sets, [message, failure], paths);
                    self.view.import.unseen.extend(failed.into_iter().map(ImportItem::File));
                }
                OpenedEvent::Reread { sets, why, ticket } => self.put_in_place(sets, why, ticket),
                OpenedEvent::Replaced { old, new, path } => {
                    let own = &self.history.document().own;
                    let set = own.iter().find(|set| set.path.as_ref() == Some(&path));
                    let now = set.map_or(ImportItem::File(new), |set| ImportItem::Set(set.name.clone()));
                    self.view.import.follow(&ImportItem::File(old), &now);
                }
                OpenedEvent::Mesh(path) => self.open_mesh(&path),
                OpenedEvent::Image(path) => self.open_image(&path),
                OpenedEvent::Document(path) => self.push(Command::OpenDocument(path)),
                OpenedEvent::Failed(message, files) => {
                    let first = files.first().map(|file| ImportItem::File(*file));
                    if let Some(first) = first.clone().filter(|_| !self.is_trying()) {
                        self.view.import.select(first);
                    }
                    let is_pasted =
                        |file: &Fingerprint| self.opened.file(*file).is_some_and(|file| file.origin.name == CLIPBOARD);
                    if let Some(pasted) = files.iter().copied().find(is_pasted) {
                        self.view.import.select(ImportItem::File(pasted));
                        self.show_workspace(Workspace::Import);
                    }
                    // An earlier success must not stand beside it.
                    self.view.status = Status::default();
                    self.view.import.unseen.extend(files.iter().copied().map(ImportItem::File));
                    // Where the list of files is in sight, it says which failed and why.
                    let mut panes = self.arrangement.panes.iter();
                    let in_list = panes.any(|(pane, rect)| *pane == PaneKind::IMPORT && import::lists_files(*rect));
                    if first.is_none() || !in_list {
                        self.view.fail(message);
                        self.view.status.change = first.map(|first| (first, None));
                    }
                }
            }
        }
        self.settle_wishes();
        self.follow_files();
    }

    fn bring_in(&mut self, sets: Vec<Imported>, [message, failure]: [String; 2], paths: Vec<PathBuf>) {
        self.end_tour();
        for path in paths {
            self.view.remember_file(path);
        }
        let before = self.history.document().clone();
        let guessed: Vec<bool> = sets.iter().map(|imported| imported.guessed).collect();
        let wanted: Vec<ImportedSet> = sets.into_iter().map(|imported| imported.set).collect();
        self.history.apply(&Action::Imported(ImportedAction::Import {
            sets: wanted.clone(),
            built_in: self.catalog.names().clone(),
        }));
        self.history.end_gesture();
        let after = self.history.document();
        let brought: Vec<Shared<ImportedSet>> =
            wanted.iter().filter_map(|set| after.own.get(after.same_set(set)?)).cloned().collect();
        let mut there: BTreeSet<&str> = before.own.iter().map(|set| set.name.as_str()).collect();
        let (new, again): (Vec<_>, Vec<_>) =
            wanted.iter().zip(&brought).partition(|(_, set)| there.insert(set.name.as_str()));
        let failed = !failure.is_empty();
        let mut offers = self.offers(&brought);
        // A file named at the start is the user's word already.
        let named =
            brought.iter().filter(|set| set.path.as_ref().is_some_and(|path| self.at_start.remove(path))).count();
        if let ([Offer::Use(kind, name)], 1) = (offers.as_slice(), named) {
            self.change(&Action::Imported(ImportedAction::Use(*kind, name.clone())));
            self.history.end_gesture();
            offers.clear();
        }
        let used = put_to_use(&before, self.history.document(), &brought);
        let told = [failure, message, used, renamed(&new), opened_again(&again, wanted.len())];
        self.view.say(told.into_iter().filter(|words| !words.is_empty()).collect::<Vec<_>>().join(" "));
        self.view.offer(offers, true);
        if failed {
            self.view.status.weight = Weight::Warning;
        }
        let items: Vec<ImportItem> = brought.iter().map(|set| ImportItem::Set(set.name.clone())).collect();
        let trying = self.is_trying();
        for (set, item) in brought.iter().zip(&items) {
            self.view.import.tried.remove(item);
            if let Some(fingerprint) = set.fingerprint {
                self.view.import.follow(&ImportItem::File(fingerprint), item);
            }
            if self.view.import.pending(item).is_some_and(|wishes| *wishes == set.wishes) {
                self.view.import.tried.remove(item);
            }
            self.view.import.unseen.remove(item);
        }
        let doubtful: Vec<ImportItem> =
            items.iter().zip(guessed).filter(|(_, guessed)| *guessed).map(|(item, _)| item.clone()).collect();
        if let Some(first) = doubtful.first().or(items.first())
            && !trying
        {
            self.view.import.select(first.clone());
        }
        self.view.status.change = doubtful.first().map(|first| (first.clone(), None));
        self.view.import.unseen.extend(doubtful);
        // What was pasted has no name yet: it is looked at first.
        let pasted = brought.iter().position(|set| set.file == CLIPBOARD);
        if let Some(item) = pasted.and_then(|index| items.get(index)) {
            self.view.import.select(item.clone());
            self.show_workspace(Workspace::Import);
        }
    }

    /// True while settings are tried on the selected file, which then stays selected.
    fn is_trying(&self) -> bool {
        self.view.import.selected.as_ref().is_some_and(|item| self.view.import.pending(item).is_some())
    }

    /// What can be done with sets that are not in use.
    fn offers(&self, sets: &[Shared<ImportedSet>]) -> Vec<Offer> {
        let document = self.history.document();
        let kinds = sets.iter().map(|set| (SetKind::of_own(set), set.name.clone()));
        let unused = kinds.filter(|(kind, name)| *kind != SetKind::Unsorted && !document.uses(*kind, name));
        let mut offers: Vec<Offer> = unused.map(|(kind, name)| Offer::Use(kind, name)).collect();
        offers.dedup();
        offers
    }

    /// Applies the settings tried on the selected set once its file was read with them and yields a curve. Until then the
    /// document is unchanged.
    fn settle_wishes(&mut self) {
        let Some(ImportItem::Set(name)) = self.view.import.selected.clone() else { return };
        let item = ImportItem::Set(name.clone());
        let Some(wishes) = self.view.import.pending(&item).cloned() else { return };
        let Some(set) = self.history.document().own.iter().find(|set| set.name == name).cloned() else { return };
        let Some(file) = set.fingerprint.and_then(|fingerprint| self.opened.file(fingerprint)) else { return };
        let Some(look) = self.opened.look(&file, &wishes.options).filter(|look| look.options == wishes.options) else {
            return;
        };
        let Ok(table) = &look.table else { return };
        let fresh = imported(&file.origin, table, &wishes).set;
        if fresh.curves.is_empty() {
            return;
        }
        let with = ImportedSet { name: name.clone(), file: set.file.clone(), path: set.path.clone(), ..fresh };
        self.view.import.tried.remove(&item);
        self.view.saved.import.remember(Likeness::of(&file.bytes), &wishes);
        let (built_in, role) = (self.catalog.names().clone(), with.role);
        let place = self.history.document().own.iter().position(|set| set.name == name);
        self.change(&Action::Imported(ImportedAction::Replace { name, with: Box::new(with), built_in }));
        self.history.end_gesture();
        let now: Vec<_> = place.and_then(|place| self.history.document().own.get(place)).cloned().into_iter().collect();
        let offers = if role == set.role { Vec::new() } else { self.offers(&now) };
        if !offers.is_empty() {
            self.view.say(format!("{}: {role}, in the Library.", now[0].name));
            self.view.offer(offers, false);
        }
    }

    /// Changes the document; the selection in Import follows sets to their new names.
    pub(super) fn change(&mut self, action: &Action) {
        self.step(|history| history.apply(action));
    }

    /// Goes to another state of the document; the selection in Import follows sets to their new names, and sensors that are
    /// no longer compared are deselected.
    pub(super) fn step(&mut self, go: impl FnOnce(&mut History)) {
        let before = self.history.document();
        let (own, compared) = (before.own.clone(), before.compared.clone());
        go(&mut self.history);
        self.view.let_go_of_removed(&compared, &self.history.document().compared);
        self.view.import.follow_names(&own, &self.history.document().own);
        self.follow_selection(&own);
    }

    /// Keeps the same contents visible when a step turned the selected file into a set, or removed that set.
    fn follow_selection(&mut self, before: &[Shared<ImportedSet>]) {
        let own = &self.history.document().own;
        let now = match &self.view.import.selected {
            Some(ImportItem::Set(name)) if !own.iter().any(|set| set.name == *name) => {
                let gone = before.iter().find(|set| set.name == *name).and_then(|set| set.fingerprint);
                gone.filter(|file| self.opened.file(*file).is_some()).map(ImportItem::File)
            }
            Some(ImportItem::File(file)) => {
                let made = own.iter().find(|set| set.fingerprint == Some(*file));
                made.map(|set| ImportItem::Set(set.name.clone()))
            }
            _ => None,
        };
        if let Some(now) = now {
            self.view.import.select(now);
        }
    }

    /// Undoes or redoes a step. Messages about a step that was undone are cleared.
    pub(super) fn travel(&mut self, go: impl FnOnce(&mut History), words: Option<String>) {
        let before = self.history.document().clone();
        self.step(go);
        if before != *self.history.document() {
            // Earlier messages may refer to something that no longer exists.
            self.view.status = Status::default();
            self.view.say(words.unwrap_or_default());
        }
    }

    /// Watches the files of the sets and those that could not be read, and drops the oldest beyond the memory limit.
    fn follow_files(&mut self) {
        let document = self.history.document();
        let paths: BTreeSet<PathBuf> = if self.view.saved.import.watch {
            let failing = self.opened.failing().into_iter().map(|failing| failing.path);
            document.own.iter().filter_map(|set| set.path.clone()).chain(failing).collect()
        } else {
            BTreeSet::new()
        };
        self.files.watch(paths);
        let wanted: Vec<Fingerprint> = document.own.iter().filter_map(|set| set.fingerprint).collect();
        self.opened.keep(&wanted);
    }

    /// Opens Import with a file selected.
    pub(super) fn show_import(&mut self, item: ImportItem, line: Option<usize>) {
        // What the message was about is on show from now on.
        self.view.status = std::mem::take(&mut self.view.status).without(&item);
        self.view.import.select(item);
        self.view.import.line = line;
        self.view.saved.workspace = Workspace::Import;
        self.view.maximized = None;
        self.view.inspector_over = false;
    }

    /// Makes a set of each of these parts of a file; a choice of curves belongs to another part and is not applied.
    pub(super) fn use_parts(&mut self, file: Fingerprint, parts: &[usize], wishes: &ImportOverrides) {
        let wishes = |part: usize| {
            let mut wishes = ImportOverrides { taken: None, channels: None, ..wishes.clone() };
            wishes.options.part = Some(part);
            wishes
        };
        self.open(parts.iter().map(|part| Request::Known(file, Box::new(wishes(*part)))).collect());
    }

    /// Reads every file of an item's kind as it is read, those that failed among them, and remembers.
    pub(super) fn use_for_alike(&mut self, item: &ImportItem) {
        let Some((file, wishes)) = self.file_and_wishes(item) else { return };
        let likeness = Likeness::of(&file.bytes);
        let wishes = of_a_kind(&wishes);
        self.view.saved.import.remember(likeness.clone(), &wishes);
        let alike = |file: &OpenFile| Likeness::of(&file.bytes).is_like(&likeness);
        let own = &self.history.document().own;
        let mut sets = Vec::new();
        for set in own {
            let known = set.fingerprint.and_then(|fingerprint| self.opened.file(fingerprint));
            let is_item = *item == ImportItem::Set(set.name.clone());
            if !is_item && known.is_some_and(|file| alike(&file)) && of_a_kind(&set.wishes) != wishes {
                let wishes = ImportOverrides { taken: set.wishes.taken.clone(), ..wishes.clone() };
                sets.push(ImportedSet { wishes, ..(**set).clone() });
            }
        }
        let unused: Vec<Request> = self
            .opened
            .files()
            .into_iter()
            .filter(|file| {
                let fingerprint = file.origin.fingerprint;
                !own.iter().any(|set| set.fingerprint == Some(fingerprint)) && alike(file)
            })
            .map(|file| Request::Known(file.origin.fingerprint, Box::new(wishes.clone())))
            .collect();
        if sets.is_empty() && unused.is_empty() {
            self.view.say("No other open file is of this kind; the next one will be read with these settings.");
            return;
        }
        if !sets.is_empty() {
            self.opened.reread(sets, Why::Alike);
        }
        if !unused.is_empty() {
            self.opened.open(unused, |_| ImportOverrides::default());
        }
    }

    /// Reads a file by its contents alone, and forgets the settings remembered for its kind.
    pub(super) fn forget_choices(&mut self, item: &ImportItem) {
        if let Some((file, _)) = self.file_and_wishes(item) {
            self.view.saved.import.forget(&Likeness::of(&file.bytes));
        }
        self.view.import.tried.remove(item);
        let own = &self.history.document().own;
        let read = |name: &String| own.iter().any(|set| set.name == *name && set.wishes != ImportOverrides::default());
        if matches!(item, ImportItem::Set(name) if read(name)) {
            self.view.import.tried.insert(item.clone(), ImportOverrides::default());
        }
    }

    /// An item's file and how it is to be read.
    fn file_and_wishes(&self, item: &ImportItem) -> Option<(OpenFile, ImportOverrides)> {
        let pending = self.view.import.pending(item).cloned();
        match item {
            ImportItem::File(fingerprint) => Some((self.opened.file(*fingerprint)?, pending.unwrap_or_default())),
            ImportItem::Set(name) => {
                let set = self.history.document().own.iter().find(|set| set.name == *name)?;
                Some((self.opened.file(set.fingerprint?)?, pending.unwrap_or_else(|| set.wishes.clone())))
            }
        }
    }

    /// Stops reading, if something is being read.
    pub(super) fn stop_reading(&mut self) -> bool {
        let Some(name) = self.opened.stop() else { return false };
        self.view.say(format!("Reading {name} stopped. Nothing was changed."));
        true
    }
}
