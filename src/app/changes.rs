//! Changes of the document: each one of the window passes here, forwards, back or to another document. What is selected follows
//! to its new names.

use chromascope_core::query::Shared;

use super::ChromascopeApp;
use crate::action::Action;
use crate::action::history::History;
use crate::document::imported::ImportedSet;
use crate::view::Status;
use crate::view::import::ImportItem;

impl ChromascopeApp {
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
}
