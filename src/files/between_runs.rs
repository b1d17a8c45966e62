//! Document and layout saved between runs, documents saved by other windows, and the messages about them, which are shown
//! below the conditions while they hold or until the user dismisses them.

use std::collections::{BTreeMap, HashSet};
use std::path::{Path, PathBuf};
use std::time::SystemTime;

use super::Files;
use super::event::{FileEvent, Note};
use crate::atomic::write_atomically;
use crate::document::Document;
use crate::document::start::Start;
use crate::format::io_failure;

/// The file of the window's place and layout, which eframe reads.
const LAYOUT: &str = "app.ron";

#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PersistentMessage {
    pub kind: PersistentMessageKind,
    pub words: String,
    pub file: Option<PathBuf>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum PersistentMessageKind {
    OtherWindow,
    NotSaved,
    SetAside,
    Moved,
    Copies,
}

impl PersistentMessageKind {
    pub const fn is_dismissible(self) -> bool {
        matches!(self, Self::SetAside | Self::Moved | Self::Copies)
    }
}

#[derive(Debug, Default)]
pub(super) struct Notices {
    /// A document that could not be read: a message, and its file.
    pub(super) complaint: Option<(String, PathBuf)>,
    /// Number of documents that other windows had saved at the start.
    pub(super) copies: usize,
    dismissed: HashSet<PersistentMessageKind>,
}

impl Files {
    /// The persistent messages, the most severe first.
    pub fn standing(&self) -> Vec<PersistentMessage> {
        let Notices { complaint, copies, dismissed } = &self.standing;
        let message = |kind, words, file| PersistentMessage { kind, words, file };
        let failure = self.autosave.failure().map(|why| {
            let words = if self.autosave.is_saved() {
                format!("Saving is not possible: {why}. Changes will be lost when the window closes.")
            } else {
                format!("Changes are not saved: {why}. Retrying.")
            };
            message(PersistentMessageKind::NotSaved, words, None)
        });
        let other = self.copy().map(|(words, file)| message(PersistentMessageKind::OtherWindow, words, Some(file)));
        let aside = complaint.clone();
        let aside = aside.map(|(words, file)| message(PersistentMessageKind::SetAside, words, Some(file)));
        let moved = self.autosave.moved().map(|file| {
            let words = "Another program wrote to the document: changes here are saved in a copy.".to_owned();
            message(PersistentMessageKind::Moved, words, Some(file))
        });
        let copies = (*copies > 0).then(|| {
            let words = match copies {
                1 => "A document of another window was recovered: File, Recovered documents.".to_owned(),
                many => format!("{many} documents of other windows were recovered: File, Recovered documents."),
            };
            message(PersistentMessageKind::Copies, words, None)
        });
        let all = [failure, aside, moved, other, copies].into_iter().flatten();
        all.filter(|standing| !dismissed.contains(&standing.kind)).collect()
    }

    pub fn dismiss(&mut self, kind: PersistentMessageKind) {
        self.standing.dismissed.insert(kind);
    }

    pub fn saved_document(&mut self) -> Document {
        if self.autosave.is_first_run() {
            let words =
                format!("Start: {}. The other start is in the Inspector and under Edit.", Start::default().label());
            self.note(Note::Event(FileEvent::Said(words)));
        }
        let (document, complaint) = self.autosave.load();
        self.standing.complaint = complaint;
        // Only the first window lists the copies.
        self.standing.copies = if self.autosave.other().is_none() { self.autosave.copies().len() } else { 0 };
        document
    }

    /// File of this window's document while another window has the folder, with a sentence that stays on screen.
    pub fn copy(&self) -> Option<(String, PathBuf)> {
        let (other, file) = self.autosave.other()?;
        let process = other.process.map_or_else(String::new, |process| format!(" (process {process})"));
        let words = format!(
            "Another Chromascope window{process} is open: changes here are saved in a copy, not in its document."
        );
        Some((words, file.to_owned()))
    }

    pub fn other_documents(&self) -> Vec<(PathBuf, String)> {
        let now = SystemTime::now();
        let age = |modified: Option<SystemTime>| now.duration_since(modified?).ok().map(|age| age.as_secs() / 60);
        let words = |modified| match age(modified) {
            None => "at an unknown time".to_owned(),
            Some(0) => "just now".to_owned(),
            Some(minutes @ 1..60) => format!("{minutes} min ago"),
            Some(minutes @ 60..2880) => format!("{} h ago", minutes / 60),
            Some(minutes) => format!("{} days ago", minutes / 1440),
        };
        self.autosave.copies().into_iter().map(|copy| (copy.path, words(copy.modified))).collect()
    }

    pub fn remove_document(&self, path: &Path) {
        let event = if self.autosave.is_in_use(path) {
            FileEvent::Failed(format!("{} is open in another window and was not deleted.", path.display()))
        } else {
            match std::fs::remove_file(path) {
                Ok(()) => FileEvent::Said(format!("{} was deleted.", path.display())),
                Err(error) => FileEvent::Failed(format!("{}.", io_failure(path, &error))),
            }
        };
        self.note(Note::Event(event));
    }

    pub fn autosave(&mut self, document: &Document, ctx: &egui::Context) {
        self.autosave.watch(document, ctx);
    }

    pub fn save_document(&mut self, document: &Document) -> Result<(), String> {
        self.autosave.save(document)
    }

    pub fn is_saved(&self) -> bool {
        self.autosave.is_saved()
    }

    /// Saves the window's position and layout if they changed; `now` waits until it is done. They belong to the first
    /// window.
    pub fn save_layout(&mut self, layout: &BTreeMap<String, String>, now: bool) {
        let Some(folder) = self.autosave.folder().filter(|_| self.autosave.other().is_none()) else { return };
        let text = match ron::ser::to_string_pretty(layout, ron::ser::PrettyConfig::default()) {
            Ok(text) => text,
            Err(error) => return log::warn!("the layout could not be saved: {error}"),
        };
        // What is being written in the background may not be done before the program is.
        if self.layout.as_ref() == Some(&text) && !now {
            return;
        }
        self.layout = Some(text.clone());
        let path = folder.join(LAYOUT);
        let write = move || -> [Note; 0] {
            if let Err(error) = write_atomically(&path, text.as_bytes()) {
                log::warn!("{}: {error}", path.display());
            }
            []
        };
        if now {
            write();
        } else {
            self.in_background(write);
        }
    }
}
