//! Outcomes of dialogs, reads and writes.

use std::path::PathBuf;

use super::dialogs::Answer;
use super::prompt::{Completed, PathPrompt};
use super::save::SaveRequest;
use crate::document::Document;

/// Outcome of a dialog, a read or a write.
#[derive(Debug)]
pub enum FileEvent {
    /// Files or folders are to be opened.
    Open(Vec<PathBuf>),
    /// Files changed on disk.
    Changed(Vec<PathBuf>),
    /// Something to know.
    Said(String),
    /// A file was written: a message, and the description of its contents.
    Saved(String, String),
    /// A document was read, and the one before it saved.
    Document(Box<OpenedDocument>),
    /// Something failed; nothing was changed.
    Failed(String),
}

pub(super) enum Note {
    Event(FileEvent),
    Answered(u64, Answer, Option<SaveRequest>),
    ToSave(SaveRequest),
    NotMade(String),
    NotSaved(PathPrompt),
    Completed(Completed),
}

/// A document that was opened in place of another one.
#[derive(Debug)]
pub struct OpenedDocument {
    /// Its file.
    pub path: PathBuf,
    /// The document.
    pub document: Document,
    /// Sets of it that could not be read, in words; may be empty.
    pub lost: Vec<String>,
    /// The document being replaced, which is saved in a file of its own if it was changed.
    pub before: Document,
}
