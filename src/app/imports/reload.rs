//! Sets that are read again: because their files changed on disk, or as others of their kind.

use std::path::PathBuf;

use chromascope_core::query::Shared;

use super::ChromascopeApp;
use crate::action::{Action, ImportedAction};
use crate::catalog::import::Imported;
use crate::catalog::opened::{Request, Why};
use crate::document::imported::ImportedSet;
use crate::view::import::ImportItem;
use crate::view::{Offer, Weight};

/// What came of reading sets again.
#[derive(Default)]
struct Reread {
    /// Sets to replace, by the names they had.
    with: Vec<(String, ImportedSet)>,
    /// Readings in another role, which are offered.
    beside: Vec<ImportedSet>,
    /// Sets whose settings changed meanwhile.
    again: Vec<ImportedSet>,
    /// Reasons why others stay as they were.
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
        if fresh.wishes != set.wishes {
            return self.again.push(set.clone());
        }
        if fresh.role != set.role {
            let part = fresh.wishes.options.part;
            let is_it = |known: &ImportedSet| {
                known.path == fresh.path && known.role == fresh.role && known.wishes.options.part == part
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
    /// Puts sets that were read again in their places, as one step.
    pub(super) fn put_in_place(&mut self, sets: Vec<(String, Result<Imported, String>)>, why: Why, ticket: u64) {
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
    pub(in crate::app) fn read_changed(&mut self, paths: &[PathBuf]) {
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

    /// Reloads a set's file at the user's request.
    pub(in crate::app) fn read_again(&mut self, name: &str) {
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
