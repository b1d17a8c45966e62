//! Persistent messages, shown below the conditions while they hold or until the user dismisses them.

use std::collections::HashSet;
use std::path::PathBuf;

use super::Files;

/// A persistent message.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PersistentMessage {
    /// Its subject.
    pub kind: PersistentMessageKind,
    /// The message.
    pub words: String,
    /// The file it is about.
    pub file: Option<PathBuf>,
}

/// The subject of a persistent message.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum PersistentMessageKind {
    /// Another window has the profile.
    OtherWindow,
    /// The document is not saved.
    NotSaved,
    /// The document of the last session could not be read.
    SetAside,
    /// Another program wrote to the document's file.
    Moved,
    /// Other windows saved documents.
    Copies,
}

impl PersistentMessageKind {
    /// True if the user can dismiss it.
    pub const fn is_dismissible(self) -> bool {
        matches!(self, Self::SetAside | Self::Moved | Self::Copies)
    }
}

/// Facts that the messages are made from.
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
        let failure = self.keeper.failure().map(|why| {
            let words = if self.keeper.is_saved() {
                format!("Saving is not possible: {why}. Changes will be lost when the window closes.")
            } else {
                format!("Changes are not saved: {why}. Retrying.")
            };
            PersistentMessage { kind: PersistentMessageKind::NotSaved, words, file: None }
        });
        let other = self.copy().map(|(words, file)| PersistentMessage {
            kind: PersistentMessageKind::OtherWindow,
            words,
            file: Some(file),
        });
        let aside = complaint.clone().map(|(words, file)| PersistentMessage {
            kind: PersistentMessageKind::SetAside,
            words,
            file: Some(file),
        });
        let moved = self.keeper.moved().map(|file| {
            let words = "Another program wrote to the document: changes here are saved in a copy.".to_owned();
            PersistentMessage { kind: PersistentMessageKind::Moved, words, file: Some(file) }
        });
        let copies = (*copies > 0).then(|| {
            let words = match copies {
                1 => "A document of another window was recovered: File, Recovered documents.".to_owned(),
                many => format!("{many} documents of other windows were recovered: File, Recovered documents."),
            };
            PersistentMessage { kind: PersistentMessageKind::Copies, words, file: None }
        });
        let all = [failure, aside, moved, other, copies].into_iter().flatten();
        all.filter(|standing| !dismissed.contains(&standing.kind)).collect()
    }

    /// Removes a message.
    pub fn dismiss(&mut self, kind: PersistentMessageKind) {
        self.standing.dismissed.insert(kind);
    }
}
