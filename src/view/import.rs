//! View state of the Import pane.

use std::collections::{BTreeMap, BTreeSet};

use chromascope_core::query::Shared;
use serde::{Deserialize, Serialize};

use crate::catalog::likeness::Likeness;
use crate::catalog::opened::Failing;
use crate::document::imported::{Fingerprint, ImportOverrides, ImportedSet};

/// Maximum number of remembered kinds of files.
const REMEMBERED: usize = 100;

/// Something in the list of files.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub enum ImportItem {
    Set(String),
    /// A file that no set is made of.
    File(Fingerprint),
}

#[derive(Debug, Default)]
pub struct ImportView {
    pub selected: Option<ImportItem>,
    /// Import settings tried for each item but not yet applied to the document.
    pub tried: BTreeMap<ImportItem, ImportOverrides>,
    /// Files with a guess or an error that the user has not reviewed.
    pub unseen: BTreeSet<ImportItem>,
    /// The parts of the selected file to import, each as a set of its own; from 1.
    pub parts: BTreeSet<usize>,
    /// Control at which the keyboard focus stopped between panes.
    pub stop: Option<Stop>,
    /// Control that takes the keyboard focus in this frame.
    pub focus: Option<Stop>,
    /// The line of the text to bring into view in this frame.
    pub line: Option<usize>,
    pub search: String,
    /// Curves under the pointer, by place in the file.
    pub hovered_curve: Option<usize>,
}

/// Control of Import that takes the keyboard focus between panes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stop {
    Files,
    Switches,
    Picker,
}

impl ImportView {
    /// Shows an item. Settings tried on another stay with that.
    pub fn select(&mut self, item: ImportItem) {
        if self.selected.as_ref() != Some(&item) {
            self.line = None;
            self.search.clear();
            self.parts.clear();
            self.selected = Some(item);
        }
    }

    /// True if the keyboard focus goes to a place in this frame; called by that place, once.
    pub fn takes_keyboard(&mut self, stop: Stop) -> bool {
        let takes = self.focus == Some(stop);
        if takes {
            self.focus = None;
        }
        takes
    }

    pub fn pending(&self, item: &ImportItem) -> Option<&ImportOverrides> {
        self.tried.get(item)
    }

    /// Whatever is known of an item holds for another from now on: a set has another name, a file other contents.
    pub fn follow(&mut self, old: &ImportItem, new: &ImportItem) {
        if old == new {
            return;
        }
        if self.selected.as_ref() == Some(old) {
            self.selected = Some(new.clone());
        }
        if let Some(wishes) = self.tried.remove(old) {
            self.tried.insert(new.clone(), wishes);
        }
        if self.unseen.remove(old) {
            self.unseen.insert(new.clone());
        }
    }

    /// Follows sets to the names they have after a step.
    pub fn follow_names(&mut self, before: &[Shared<ImportedSet>], after: &[Shared<ImportedSet>]) {
        if before.len() != after.len() {
            return;
        }
        let known = |sets: &[Shared<ImportedSet>], name: &str| sets.iter().any(|set| set.name == name);
        for (old, new) in before.iter().zip(after) {
            // A set that changes keeps its index; where both names persist, there is nothing to follow.
            if old.name != new.name && !known(after, &old.name) && !known(before, &new.name) {
                self.follow(&ImportItem::Set(old.name.clone()), &ImportItem::Set(new.name.clone()));
            }
        }
    }
}

/// Import settings that the user chose for a kind of file.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Remembered {
    pub likeness: Likeness,
    pub wishes: ImportOverrides,
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct ImportMemory {
    /// Settings by kind of file, the latest last.
    pub remembered: Vec<Remembered>,
    /// True if files are read again when they change on disk.
    pub watch: bool,
    /// Files on disk that could not be read.
    pub failing: Vec<Failing>,
    /// Files with a guess or an error that the user has not reviewed.
    pub unseen: BTreeSet<ImportItem>,
}

impl Default for ImportMemory {
    fn default() -> Self {
        Self { remembered: Vec::new(), watch: true, failing: Vec::new(), unseen: BTreeSet::new() }
    }
}

impl ImportMemory {
    /// Remembers the settings for a file, to be applied to others like it; default settings remove the entry.
    pub fn remember(&mut self, likeness: Likeness, wishes: &ImportOverrides) {
        if !likeness.is_telling() {
            return;
        }
        self.remembered.retain(|known| !known.likeness.is_like(&likeness));
        let wishes = of_a_kind(wishes);
        if wishes != ImportOverrides::default() {
            self.remembered.push(Remembered { likeness, wishes });
        }
        let spare = self.remembered.len().saturating_sub(REMEMBERED);
        self.remembered.drain(..spare);
    }

    /// Forgets the settings for files like one.
    pub fn forget(&mut self, likeness: &Likeness) {
        self.remembered.retain(|known| !known.likeness.is_like(likeness));
    }

    /// Returns the remembered settings for a file.
    pub fn wishes(&self, likeness: &Likeness) -> ImportOverrides {
        let known = self.remembered.iter().rev().find(|known| known.likeness.is_like(likeness));
        known.map(|known| known.wishes.clone()).unwrap_or_default()
    }
}

/// The settings that apply to other files of a kind, too: not the choice of curves, part and column.
pub fn of_a_kind(wishes: &ImportOverrides) -> ImportOverrides {
    let mut kind = ImportOverrides { taken: None, ..wishes.clone() };
    (kind.options.part, kind.options.wavelength_column) = (None, None);
    kind
}
