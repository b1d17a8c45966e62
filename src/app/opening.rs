//! Opening the user's spectra, meshes and spectral images: read first, then put to use; and reading spectra otherwise, or again
//! because their files changed on disk.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use chromascope_core::query::Shared;

use super::ChromascopeApp;
use crate::action::{Action, ImportedAction, RenderAction};
use crate::catalog::import::{Imported, imported};
use crate::catalog::likeness::Likeness;
use crate::catalog::opened::{CLIPBOARD, OpenFile, OpenedEvent, Request, Why};
use crate::command::Command;
use crate::document::imported::{Fingerprint, ImportOverrides, ImportedSet, Role};
use crate::document::render::MeshChoice;
use crate::document::{Document, SetKind};
use crate::format::file_name;
use crate::panes::import;
use crate::view::import::{ImportItem, of_a_kind};
use crate::view::{Offer, Status, Weight};
use crate::workspaces::{PaneKind, Workspace};

/// What came of reading sets again.
#[derive(Default)]
struct Reread {
    with: Vec<(String, ImportedSet)>,
    /// Readings in another role, which are offered.
    beside: Vec<ImportedSet>,
    /// Sets whose settings changed meanwhile.
    again: Vec<ImportedSet>,
    failures: Vec<String>,
    /// Sentences about the readings in another role.
    told: Vec<String>,
}

impl Reread {
    /// Sorts a new reading of a set. What is in use is not replaced by something else, nor by what cannot be.
    fn take(&mut self, set: &ImportedSet, fresh: ImportedSet, why: Why, own: &[Shared<ImportedSet>]) {
        if why == Why::Alike {
            return self.with.push((set.name.clone(), ImportedSet { name: set.name.clone(), ..fresh }));
        }
        if fresh.overrides != set.overrides {
            return self.again.push(set.clone());
        }
        if fresh.role != set.role {
            let part = fresh.overrides.options.part;
            let is_it = |known: &ImportedSet| {
                known.path == fresh.path && known.role == fresh.role && known.overrides.options.part == part
            };
            // Where the file was in this role before, that set is read again itself.
            if !own.iter().any(|known| is_it(known)) && !self.beside.iter().any(is_it) {
                self.told.push(format!("{} now holds {}; {} is unchanged.", set.file, fresh.role, set.name));
                self.beside.push(fresh);
            }
            return;
        }
        self.with.push((set.name.clone(), ImportedSet { name: set.name.clone(), ..fresh }));
    }
}

impl ChromascopeApp {
    pub(super) fn open(&mut self, mut requests: Vec<Request>) {
        self.end_tour();
        self.take_pictures(&mut requests);
        if requests.is_empty() {
            return;
        }
        let memory = self.view.saved.import.clone();
        self.opened.open(requests, move |bytes| {
            if memory.remembered.is_empty() {
                ImportOverrides::default()
            } else {
                memory.overrides(&Likeness::of(bytes))
            }
        });
    }

    /// Opens files named at the start, which are the user's word: a single one is put to use.
    pub fn open_at_start(&mut self, paths: Vec<PathBuf>) {
        self.at_start = paths.iter().filter_map(|path| std::path::absolute(path).ok()).collect();
        self.open(paths.into_iter().map(Request::Path).collect());
    }

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
                OpenedEvent::Bands(passes) => self.measure_from_bands(passes),
                OpenedEvent::Mesh(path) => self.open_mesh(&path),
                OpenedEvent::Image(path) => {
                    self.meshes.cancel();
                    self.images.open(&path);
                    self.view.say(format!("Reading {}…", file_name(&path)));
                }
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
                        self.show_workspace(Workspace::Data);
                        self.view.show(PaneKind::IMPORT);
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
        self.settle_overrides();
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
            if self.view.import.pending(item).is_some_and(|overrides| *overrides == set.overrides) {
                self.view.import.tried.remove(item);
            }
            self.view.import.unseen.remove(item);
        }
        let doubtful: Vec<ImportItem> =
            items.iter().zip(guessed).filter(|(_, guessed)| *guessed).map(|(item, _)| item.clone()).collect();
        if let Some(first) = doubtful.first().or(items.first())
            && !trying
        {
            if self.view.saved.workspace == Workspace::Data {
                self.view.select_file(first.clone(), &self.history.document().own);
            } else {
                self.view.import.select(first.clone());
            }
        }
        self.view.status.change = doubtful.first().map(|first| (first.clone(), None));
        self.view.import.unseen.extend(doubtful);
        // What was pasted has no name yet: it is looked at first.
        let pasted = brought.iter().position(|set| set.file == CLIPBOARD);
        if let Some(item) = pasted.and_then(|index| items.get(index)) {
            self.view.select_file(item.clone(), &self.history.document().own);
            self.show_workspace(Workspace::Data);
            self.view.show(PaneKind::IMPORT);
        }
    }

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
    fn settle_overrides(&mut self) {
        let Some(ImportItem::Set(name)) = self.view.import.selected.clone() else { return };
        let item = ImportItem::Set(name.clone());
        let Some(overrides) = self.view.import.pending(&item).cloned() else { return };
        let Some(set) = self.history.document().own.iter().find(|set| set.name == name).cloned() else { return };
        let Some(file) = set.fingerprint.and_then(|fingerprint| self.opened.file(fingerprint)) else { return };
        let Some(look) = self.opened.look(&file, &overrides.options).filter(|look| look.options == overrides.options)
        else {
            return;
        };
        let Ok(table) = &look.table else { return };
        let fresh = imported(&file.origin, table, &overrides).set;
        if fresh.curves.is_empty() {
            return;
        }
        let with = ImportedSet { name: name.clone(), file: set.file.clone(), path: set.path.clone(), ..fresh };
        self.view.import.tried.remove(&item);
        self.view.saved.import.remember(Likeness::of(&file.bytes), &overrides);
        let (built_in, role) = (self.catalog.names().clone(), with.role);
        let place = self.history.document().own.iter().position(|set| set.name == name);
        self.change(&Action::Imported(ImportedAction::Replace { name, with: Box::new(with), built_in }));
        self.history.end_gesture();
        let now: Vec<_> = place.and_then(|place| self.history.document().own.get(place)).cloned().into_iter().collect();
        let offers = if role == set.role { Vec::new() } else { self.offers(&now) };
        if !offers.is_empty() {
            self.view.say(format!("{}: {role}, in Data.", now[0].name));
            self.view.offer(offers, false);
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

    pub(super) fn show_import(&mut self, item: ImportItem, line: Option<usize>) {
        // What the message was about is on show from now on.
        if self.view.status.change.as_ref().is_some_and(|(led, _)| *led == item) {
            self.view.status = Status::default();
        }
        self.view.select_file(item, &self.history.document().own);
        self.view.import.line = line;
        self.show_workspace(Workspace::Data);
        self.view.show(PaneKind::INTERPRETATION);
    }

    /// Makes a set of each of these parts of a file; a choice of curves belongs to another part and is not applied.
    pub(super) fn use_parts(&mut self, file: Fingerprint, parts: &[usize], overrides: &ImportOverrides) {
        let overrides = |part: usize| {
            let mut overrides = ImportOverrides { taken: None, channels: None, ..overrides.clone() };
            overrides.options.part = Some(part);
            overrides
        };
        self.open(parts.iter().map(|part| Request::Known(file, Box::new(overrides(*part)))).collect());
    }

    /// Reads every file of an item's kind as it is read, those that failed among them, and remembers.
    pub(super) fn use_for_alike(&mut self, item: &ImportItem) {
        let Some((file, overrides)) = self.file_and_overrides(item) else { return };
        let likeness = Likeness::of(&file.bytes);
        let overrides = of_a_kind(&overrides);
        self.view.saved.import.remember(likeness.clone(), &overrides);
        let alike = |file: &OpenFile| Likeness::of(&file.bytes).is_like(&likeness);
        let own = &self.history.document().own;
        let mut sets = Vec::new();
        for set in own {
            let known = set.fingerprint.and_then(|fingerprint| self.opened.file(fingerprint));
            let is_item = *item == ImportItem::Set(set.name.clone());
            if !is_item && known.is_some_and(|file| alike(&file)) && of_a_kind(&set.overrides) != overrides {
                let overrides = ImportOverrides { taken: set.overrides.taken.clone(), ..overrides.clone() };
                sets.push(ImportedSet { overrides, ..(**set).clone() });
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
            .map(|file| Request::Known(file.origin.fingerprint, Box::new(overrides.clone())))
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
        if let Some((file, _)) = self.file_and_overrides(item) {
            self.view.saved.import.forget(&Likeness::of(&file.bytes));
        }
        self.view.import.tried.remove(item);
        let own = &self.history.document().own;
        let read =
            |name: &String| own.iter().any(|set| set.name == *name && set.overrides != ImportOverrides::default());
        if matches!(item, ImportItem::Set(name) if read(name)) {
            self.view.import.tried.insert(item.clone(), ImportOverrides::default());
        }
    }

    fn file_and_overrides(&self, item: &ImportItem) -> Option<(OpenFile, ImportOverrides)> {
        let pending = self.view.import.pending(item).cloned();
        match item {
            ImportItem::File(fingerprint) => Some((self.opened.file(*fingerprint)?, pending.unwrap_or_default())),
            ImportItem::Set(name) => {
                let set = self.history.document().own.iter().find(|set| set.name == *name)?;
                Some((self.opened.file(set.fingerprint?)?, pending.unwrap_or_else(|| set.overrides.clone())))
            }
        }
    }

    pub(super) fn stop_reading(&mut self) -> bool {
        let Some(name) = self.opened.stop() else { return false };
        self.view.say(format!("Reading {name} stopped. Nothing was changed."));
        true
    }

    /// Puts sets that were read again in their places, as one step.
    fn put_in_place(&mut self, sets: Vec<(String, Result<Imported, String>)>, why: Why, ticket: u64) {
        self.end_tour();
        let mut reread = Reread::default();
        for (name, result) in sets {
            let own = &self.history.document().own;
            // Items that were renamed, removed or reloaded meanwhile are no longer concerned.
            let Some(set) = own.iter().find(|set| set.name == name) else { continue };
            if self.last_read.get(&name).is_some_and(|last| *last > ticket) {
                continue;
            }
            self.last_read.insert(name.clone(), ticket);
            let failed = reread.failures.len();
            match result {
                Ok(imported) => reread.take(set, imported.set, why, own),
                Err(sentence) => reread.failures.push(sentence),
            }
            if reread.failures.len() > failed {
                self.view.import.unseen.insert(ImportItem::Set(name));
            }
        }
        let Reread { with, beside, again, failures, told } = reread;
        if !again.is_empty() {
            self.opened.reread(again, why);
        }
        let names: Vec<String> = with.iter().map(|(name, _)| name.clone()).collect();
        let which = match names.as_slice() {
            [] => String::new(),
            [one] => one.clone(),
            many => format!("{} sets", many.len()),
        };
        if !with.is_empty() || !beside.is_empty() {
            let from = beside.first().map_or(which.as_str(), |set| &set.file);
            let what = match why {
                Why::Changed => format!("Reload {}", if which.is_empty() { from } else { &which }),
                Why::Alike => format!("Read {which} with the same settings"),
            };
            log::info!("read again {}", names.join(", "));
            let built_in = self.catalog.names().clone();
            let beside = beside.clone();
            let action = Action::Imported(ImportedAction::ReplaceAll { what, with, beside, built_in });
            self.step(|history| if why == Why::Changed { history.reload(&action) } else { history.apply(&action) });
            self.history.end_gesture();
        }
        let done = match why {
            _ if which.is_empty() => String::new(),
            Why::Changed => format!("{which} changed on disk and was reloaded. Ctrl+Z undoes this."),
            Why::Alike => format!("{which}: read with the same settings. Ctrl+Z undoes this."),
        };
        let told = told.join(" ");
        let words = format!("{told} {done}").trim().to_owned();
        if !failures.is_empty() {
            let failures = failures.join(".  ");
            self.view.fail(format!("{failures}. The earlier data are unchanged. {words}").trim_end().to_owned());
        } else if !words.is_empty() {
            self.view.say(words);
        }
        let document = self.history.document();
        let added: Vec<_> =
            beside.iter().filter_map(|set| document.own.get(document.same_set(set)?)).cloned().collect();
        let offers: Vec<Offer> = self.offers(&added);
        if !offers.is_empty() {
            // The user may be at something else: nothing takes the keyboard.
            self.view.offer(offers, false);
            self.view.status.weight = self.view.status.weight.max(Weight::Warning);
        }
    }

    /// Reads the sets of files that changed on disk again, and files that could not be read.
    pub(super) fn read_changed(&mut self, paths: &[PathBuf]) {
        let own = &self.history.document().own;
        let changed = own.iter().filter(|set| set.path.as_ref().is_some_and(|path| paths.contains(path)));
        let sets: Vec<ImportedSet> = changed.map(|set| (**set).clone()).collect();
        let is_set = |path: &PathBuf| own.iter().any(|set| set.path.as_ref() == Some(path));
        let failing = self.opened.failing().into_iter().map(|failing| failing.path);
        let failing: Vec<Request> =
            failing.filter(|path| paths.contains(path) && !is_set(path)).map(Request::Path).collect();
        if !sets.is_empty() {
            self.opened.reread(sets, Why::Changed);
        }
        if !failing.is_empty() {
            self.open(failing);
        }
    }

    pub(super) fn read_again(&mut self, name: &str) {
        let Some(set) = self.history.document().own.iter().find(|set| set.name == name) else { return };
        match &set.path {
            Some(path) => {
                let path = path.clone();
                self.view.say(format!("{} is unchanged.", set.file));
                self.read_changed(&[path]);
            }
            None => self.view.fail(format!("{} did not come from a file on disk.", set.file)),
        }
    }
}

/// Names the sets that were renamed because another set already had the name in their files.
fn renamed(new: &[(&ImportedSet, &Shared<ImportedSet>)]) -> String {
    let mut renamed = new.iter().filter(|(wanted, set)| wanted.name != set.name);
    let Some((first, set)) = renamed.next() else { return String::new() };
    let more = match renamed.count() {
        0 => String::new(),
        count => format!(" ({count} others renamed)"),
    };
    format!("A data set named {} already exists; imported as {}{more}.", first.name, set.name)
}

/// Names the files, of `count`, whose sets were already there.
fn opened_again(again: &[(&ImportedSet, &Shared<ImportedSet>)], count: usize) -> String {
    match again {
        [] => String::new(),
        [(_, set)] if count == 1 => format!("This data set is already open as {}.", set.name),
        [(wanted, set)] => format!("{} is already open as {}.", wanted.file, set.name),
        many => format!("{} of them were already open.", many.len()),
    }
}

/// What becomes of sets that were opened: cameras are compared, all others wait in the library.
fn put_to_use(before: &Document, after: &Document, brought: &[Shared<ImportedSet>]) -> String {
    if let [one] = brought {
        let waits = SetKind::of_own(one).used_as().is_some() && !after.uses(SetKind::of_own(one), &one.name);
        return if waits { "In Data; the conditions are unchanged.".to_owned() } else { String::new() };
    }
    let cameras = brought.iter().filter(|set| set.role == Role::Camera).count();
    let shown = after.compared.len() - before.compared.len();
    let shown = match (shown, cameras) {
        (_, 0) => "None is a camera".to_owned(),
        (shown, cameras) if shown == cameras => format!("{shown} added to the comparison"),
        (shown, cameras) => format!("{shown} of {cameras} cameras added to the comparison"),
    };
    format!("{shown}; illuminant and patches are unchanged. Choose others in Data.")
}

impl ChromascopeApp {
    /// Shows meshes and images that were read, and stops reads that are no longer needed.
    pub(super) fn take_scenes(&mut self) {
        let meshes = self.meshes.poll().into_iter().map(|opened| {
            let message = opened.result.map(|mesh| mesh.message.clone());
            (RenderAction::Open(opened.path.clone()), opened.path, message)
        });
        let images = self.images.poll().into_iter().map(|opened| {
            let message = opened.result.map(|image| image.message());
            (RenderAction::OpenImage(opened.path.clone()), opened.path, message)
        });
        for (action, path, message) in meshes.chain(images).collect::<Vec<_>>() {
            match message {
                Ok(message) => {
                    self.view.remember_file(path);
                    self.history.apply(&Action::Render(action));
                    self.history.end_gesture();
                    self.view.show(PaneKind::RENDER);
                    self.view.maximized = None;
                    self.view.say(message);
                }
                Err(sentence) => self.view.fail(sentence),
            }
        }
        let (mesh, image) = match &self.history.document().render.mesh {
            MeshChoice::File(path) => (Some(path.as_path()), None),
            MeshChoice::Image(path) => (None, Some(path.as_path())),
            _ => (None, None),
        };
        self.meshes.keep(mesh);
        self.images.keep(image);
    }

    pub(super) fn open_mesh(&mut self, path: &Path) {
        let before = self.meshes.opening().filter(|before| before != path);
        self.images.cancel();
        self.meshes.open(path);
        let given_up =
            before.map(|before| format!(" {} was canceled: one mesh is shown at a time.", file_name(&before)));
        self.view.say(format!("Reading {}… Esc stops.{}", file_name(path), given_up.unwrap_or_default()));
    }

    pub(super) fn stop_opening(&mut self) -> bool {
        let Some(path) = self.meshes.cancel().or_else(|| self.images.cancel()) else { return false };
        self.view.say(format!("Reading {} stopped. Nothing was changed.", file_name(&path)));
        true
    }
}
