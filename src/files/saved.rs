//! Document and layout saved between runs, and documents saved by other windows.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::time::SystemTime;

use super::Files;
use super::atomic::write_atomically;
use super::event::{FileEvent, Note};
use crate::document::Document;
use crate::document::start::Start;
use crate::format::io_failure;

/// The file of the window's place and layout, which eframe reads.
const LAYOUT: &str = "app.ron";

impl Files {
    /// The saved document, else the default one.
    pub fn saved_document(&mut self) -> Document {
        if self.keeper.is_first_run() {
            let words =
                format!("Start: {}. The other start is in the Inspector and under Edit.", Start::default().label());
            self.note(Note::Event(FileEvent::Said(words)));
        }
        let loaded = self.keeper.load();
        self.standing.complaint = loaded.complaint;
        // Only the first window lists the copies.
        self.standing.copies = if self.keeper.other().is_none() { self.keeper.copies().len() } else { 0 };
        loaded.document
    }

    /// File of this window's document while another window has the profile, with a sentence that stays on screen.
    pub fn copy(&self) -> Option<(String, PathBuf)> {
        let (other, file) = self.keeper.other()?;
        let process = other.process.map_or_else(String::new, |process| format!(" (process {process})"));
        let words = format!(
            "Another Chromascope window{process} is open: changes here are saved in a copy, not in its document."
        );
        Some((words, file.to_owned()))
    }

    /// Documents that other windows saved, with their ages.
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
        self.keeper.copies().into_iter().map(|copy| (copy.path, words(copy.modified))).collect()
    }

    /// Removes a document that another window saved.
    pub fn remove_document(&self, path: &Path) {
        let event = if self.keeper.is_in_use(path) {
            FileEvent::Failed(format!("{} is open in another window and was not deleted.", path.display()))
        } else {
            match std::fs::remove_file(path) {
                Ok(()) => FileEvent::Said(format!("{} was deleted.", path.display())),
                Err(error) => FileEvent::Failed(format!("{}.", io_failure(path, &error))),
            }
        };
        self.note(Note::Event(event));
    }

    /// Saves a changed document immediately, in the background.
    pub fn autosave(&mut self, document: &Document, ctx: &egui::Context) {
        self.keeper.watch(document, ctx);
    }

    /// Saves the document now. The error says why not all of it is saved.
    pub fn save_document(&mut self, document: &Document) -> Result<(), String> {
        self.keeper.save(document)
    }

    /// True if the document is on disk as last seen.
    pub fn is_saved(&self) -> bool {
        self.keeper.is_saved()
    }

    /// Saves the window's position and layout if they changed; `now` waits until it is done. They belong to the first
    /// window.
    pub fn save_layout(&mut self, layout: &BTreeMap<String, String>, now: bool) {
        let Some(folder) = self.keeper.folder().filter(|_| self.keeper.other().is_none()) else { return };
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
