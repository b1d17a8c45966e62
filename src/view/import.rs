//! What is looked at in Import.

use std::collections::BTreeSet;
use std::sync::Arc;

use serde::{Deserialize, Serialize};

use crate::catalog::likeness::Likeness;
use crate::catalog::opened::Look;
use crate::document::own::{Fingerprint, Wishes};
use crate::figures::curves::Kept;

/// So many kinds of files are remembered.
const REMEMBERED: usize = 100;

/// Something in the list of files.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum ImportItem {
    /// A set of the document, by name.
    Set(String),
    /// A file that no set is made of.
    File(Fingerprint),
}

/// What is looked at in Import.
#[derive(Debug, Default)]
pub struct ImportView {
    /// The file on show.
    pub selected: Option<ImportItem>,
    /// How it is to be read, while that is not yet so in the document.
    pub pending: Option<(ImportItem, Wishes)>,
    /// Files with something guessed or broken that nobody has looked at.
    pub unseen: BTreeSet<ImportItem>,
    /// The line of the text to bring into sight in this frame.
    pub line: Option<usize>,
    /// What is typed into the search of curves.
    pub search: String,
    /// Curves under the pointer, by place in the file.
    pub hovered_curve: Option<usize>,
    /// What the file on show was last understood as.
    pub look: Option<Arc<Look>>,
    /// Its curves, kept from frame to frame.
    pub kept: Option<Kept>,
}

impl ImportView {
    /// Shows an item. What was tried on another is given up.
    pub fn select(&mut self, item: ImportItem) {
        if self.selected.as_ref() != Some(&item) {
            self.pending = None;
            self.line = None;
            self.search.clear();
            self.selected = Some(item);
        }
    }

    /// What is tried on an item.
    pub fn pending(&self, item: &ImportItem) -> Option<&Wishes> {
        self.pending.as_ref().filter(|(of, _)| of == item).map(|(_, wishes)| wishes)
    }

    /// Follows a set to its new name.
    pub fn rename(&mut self, old: &str, new: &str) {
        let old = ImportItem::Set(old.to_owned());
        let new = ImportItem::Set(new.to_owned());
        if self.selected.as_ref() == Some(&old) {
            self.selected = Some(new.clone());
        }
        if let Some((item, _)) = self.pending.as_mut().filter(|(item, _)| *item == old) {
            *item = new.clone();
        }
        if self.unseen.remove(&old) {
            self.unseen.insert(new);
        }
    }
}

/// What a person wished for a kind of file.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Remembered {
    /// The kind.
    pub likeness: Likeness,
    /// The wishes.
    pub wishes: Wishes,
}

/// What is kept of Import between runs.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct ImportMemory {
    /// What was wished for which kinds of files, the latest last.
    pub remembered: Vec<Remembered>,
    /// Whether files are read again when they change on disk.
    pub watch: bool,
}

impl Default for ImportMemory {
    fn default() -> Self {
        Self { remembered: Vec::new(), watch: true }
    }
}

impl ImportMemory {
    /// Remembers what was wished for a file, for others like it; no wishes forget.
    pub fn remember(&mut self, likeness: Likeness, wishes: &Wishes) {
        if !likeness.is_telling() {
            return;
        }
        self.remembered.retain(|known| !known.likeness.is_like(&likeness));
        let wishes = of_a_kind(wishes);
        if wishes != Wishes::default() {
            self.remembered.push(Remembered { likeness, wishes });
        }
        let spare = self.remembered.len().saturating_sub(REMEMBERED);
        self.remembered.drain(..spare);
    }

    /// What is wished for a file.
    pub fn wishes(&self, likeness: &Likeness) -> Wishes {
        let known = self.remembered.iter().rev().find(|known| known.likeness.is_like(likeness));
        known.map(|known| known.wishes.clone()).unwrap_or_default()
    }
}

/// The wishes that hold for other files of a kind too: which curves are taken, and which part and column, do not.
pub fn of_a_kind(wishes: &Wishes) -> Wishes {
    let mut kind = Wishes { taken: None, ..wishes.clone() };
    (kind.options.part, kind.options.wavelength_column) = (None, None);
    kind
}
