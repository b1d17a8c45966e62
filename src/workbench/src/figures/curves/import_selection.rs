//! The file or set that Import shows, with all that is known about it now.

use std::sync::Arc;

use chromascope_core::query::Shared;
use serde::{Deserialize, Serialize};
use spectral_file::{ReadError, SpectralFile};

use crate::catalog::import::taken;
use crate::catalog::opened::{FilePreview, OpenFile, Opened};
use crate::document::imported::{Fingerprint, ImportOverrides, ImportedSet};
use crate::scene::Scene;

/// Something in the list of files.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub enum ImportItem {
    /// A set of the document, by name.
    Set(String),
    /// A file that no set is made of.
    File(Fingerprint),
}

/// Contents of the Import pane.
#[derive(Clone, Debug)]
pub struct ImportSelection {
    pub item: ImportItem,
    pub set: Option<Shared<ImportedSet>>,
    /// Overrides with which it is, or is to be, read.
    pub overrides: ImportOverrides,
    /// True if the document does not contain this yet.
    pub pending: bool,
    /// The file's contents, if they are available.
    pub file: Option<OpenFile>,
    /// Preview of the contents, present or last.
    pub look: Option<Arc<FilePreview>>,
}

impl ImportSelection {
    /// With the file's contents; requests their preview if that is not available yet.
    #[must_use]
    pub fn refreshed(mut self, opened: &Opened) -> Option<Self> {
        let fingerprint = match &self.item {
            ImportItem::File(fingerprint) => Some(*fingerprint),
            ImportItem::Set(_) => self.set.as_ref().and_then(|set| set.fingerprint),
        };
        self.file = fingerprint.and_then(|fingerprint| opened.file(fingerprint));
        match (&self.file, &self.set) {
            (Some(file), _) => {
                if let Some(look) = opened.look(file, &self.overrides.options) {
                    self.look = Some(look);
                }
            }
            (None, Some(set)) => {
                self.look = None;
                opened.fetch(set);
            }
            (None, None) => return None,
        }
        Some(self)
    }

    /// An item with the settings tried on it, as far as it is known; `last` is the last preview of a file.
    pub fn of(
        scene: &Scene<'_>,
        item: ImportItem,
        tried: Option<ImportOverrides>,
        last: Option<Arc<FilePreview>>,
    ) -> Option<Self> {
        let (set, fingerprint) = match &item {
            ImportItem::Set(name) => {
                let set = scene.document.own.iter().find(|set| set.name == *name)?;
                (Some(set.clone()), set.fingerprint)
            }
            ImportItem::File(fingerprint) => (None, Some(*fingerprint)),
        };
        let pending = tried.is_some();
        let overrides = tried.or_else(|| set.as_ref().map(|set| set.overrides.clone())).unwrap_or_default();
        let look = last.filter(|look| Some(look.fingerprint) == fingerprint);
        Some(Self { item, set, overrides, pending, file: None, look })
    }

    /// True if the curves of another are the same: nothing that they depend on differs.
    pub fn is_same(&self, other: &Self) -> bool {
        let look = match (&self.look, &other.look) {
            (Some(look), Some(other)) => Arc::ptr_eq(look, other),
            (None, None) => true,
            _ => false,
        };
        look && self.item == other.item
            && self.pending == other.pending
            && self.overrides == other.overrides
            && self.set == other.set
    }

    /// True if the preview is of the current settings, not of earlier ones.
    pub fn is_fresh(&self) -> bool {
        self.look.as_ref().is_some_and(|look| look.options == self.overrides.options)
    }

    pub fn table(&self) -> Option<&SpectralFile> {
        self.look.as_ref()?.table.as_deref().ok()
    }

    /// Reason that the contents cannot be read with the settings.
    pub fn error(&self) -> Option<&ReadError> {
        self.look.as_ref().filter(|_| self.is_fresh())?.table.as_ref().err()
    }

    /// The curves taken, by place in the file.
    pub fn taken(&self) -> Vec<usize> {
        match (self.table(), &self.set) {
            (Some(table), _) => taken(table, &self.overrides),
            (None, Some(set)) => places(set),
            (None, None) => Vec::new(),
        }
    }

    /// True for each curve of the file that is taken.
    pub fn are_taken(&self) -> Vec<bool> {
        let mut are = vec![false; self.table().map_or(0, |table| table.curves.len())];
        for place in self.taken() {
            if let Some(taken) = are.get_mut(place) {
                *taken = true;
            }
        }
        are
    }
}

/// The places in its file of a set's curves.
pub fn places(set: &ImportedSet) -> Vec<usize> {
    let chosen = set.overrides.taken.clone().filter(|taken| taken.len() == set.curves.len());
    chosen.unwrap_or_else(|| (0..set.curves.len()).collect())
}
