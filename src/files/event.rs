//! Outcomes of dialogs, reads and writes.

use std::path::PathBuf;
use std::sync::Arc;

use super::dialogs::Answer;
use super::request::{Completed, PathPrompt, SaveRequest};
use crate::document::{Document, SessionFile};
use crate::format::file_name;

#[derive(Debug)]
pub enum FileEvent {
    Open(Vec<PathBuf>),
    Changed(Vec<PathBuf>),
    Said(String),
    Saved(SavedFile),
    /// A session was written to its file, with this document.
    SessionSaved(SessionFile, Arc<Document>),
    /// A session was not written to its file, because another program wrote to that.
    SessionChanged(PathBuf),
    SessionFailed(String),
    /// The session that the program began with, as it is in its file.
    SessionKnown(SessionFile, Arc<Document>),
    /// A document was read, and the one before it saved.
    Document(Box<OpenedDocument>),
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

#[derive(Debug)]
pub struct SavedFile {
    pub message: String,
    pub what: String,
    pub file: SessionFile,
}

/// Source of a document that takes the place of another one.
#[derive(Clone, Debug, PartialEq)]
pub enum DocumentSource {
    /// A file, which is a session if its name ends so.
    File(PathBuf),
    /// A template of the user's: its file stays as it is.
    Template(PathBuf),
    New(&'static str, Box<Document>),
}

impl DocumentSource {
    pub fn name(&self) -> String {
        match self {
            Self::File(path) => file_name(path),
            Self::Template(path) => path.file_stem().unwrap_or_default().to_string_lossy().into_owned(),
            Self::New(name, _) => (*name).to_owned(),
        }
    }
}

#[derive(Debug)]
pub struct OpenedDocument {
    pub source: DocumentSource,
    pub document: Document,
    /// Parts of a document of a newer version that are not understood, in a sentence.
    pub newer: Option<String>,
    /// True if the document being replaced was saved in a file of its own.
    pub aside: bool,
    /// Sets of it that could not be read, in words; may be empty.
    pub lost: Vec<String>,
    /// Files on this computer whose contents are not those that its sets of these names were made of.
    pub other: Vec<PathBuf>,
    pub before: Document,
}
