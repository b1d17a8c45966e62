//! Keeping the document between runs: each change is on disk within a second, whatever ends the program.

use std::path::{Path, PathBuf};
use std::sync::{Arc, Condvar, Mutex};
use std::time::SystemTime;

use super::last;
use super::profile::{self, Copy, OtherWindow, Profile};
use super::shared_state::{SharedState, State};
use super::store::{Store, Unread};
use crate::document::Document;
use crate::jobs::Executor;

/// Writes the document to the program's folder.
pub(super) struct Keeper {
    profile: Profile,
    shared: Arc<SharedState>,
    executor: Executor,
}

/// Result of reading the saved document.
pub(super) struct Loaded {
    /// The document, or the first screen.
    pub(super) document: Document,
    /// A message if the document could not be read, and the file that now holds it.
    pub(super) complaint: Option<(String, PathBuf)>,
}

impl Keeper {
    pub(super) fn new(executor: &Executor, folder: Option<PathBuf>) -> Self {
        let profile = Profile::claim(folder);
        let failure = profile.closed.clone();
        let shared = Arc::new(SharedState {
            state: Mutex::new(State { failure, ..State::default() }),
            store: Mutex::new(Store::new(profile.file.clone().unwrap_or_default())),
            closing: Condvar::new(),
            clock: executor.clock(),
            is_driven: executor.is_driven(),
            keeps: profile.file.is_some(),
        });
        last::remember(&shared);
        Self { profile, shared, executor: executor.clone() }
    }

    /// The window that has the profile, where it is not this one, and the file of this one's copy.
    pub(super) fn other(&self) -> Option<(OtherWindow, &Path)> {
        self.profile.other.zip(self.profile.file.as_deref())
    }

    /// True if a window saves its document in a file: this one or another.
    pub(super) fn is_in_use(&self, path: &Path) -> bool {
        self.moved().as_deref() == Some(path) || self.profile.is_in_use(path)
    }

    /// Documents saved by other windows that are closed.
    pub(super) fn copies(&self) -> Vec<Copy> {
        self.profile.copies(self.moved().as_deref())
    }

    /// True if no document was saved before, by this window or another.
    pub(super) fn is_first_run(&self) -> bool {
        self.profile.first.as_ref().is_some_and(|file| std::fs::symlink_metadata(file).is_err())
    }

    /// The saved document, or the default one.
    pub(super) fn load(&mut self) -> Loaded {
        let Some(first) = self.profile.first.clone() else {
            return Loaded { document: Document::default(), complaint: None };
        };
        let mut store = self.shared.store();
        // An earlier version of the program does not write over it.
        let read = store.read(&first).and_then(|kept| match kept.newer {
            Some(why) => Err(Unread::Because(format!("{why} Update to open it"))),
            None => Ok(kept),
        });
        let is_by_value = store.is_by_value();
        drop(store);
        let is_others = self.profile.other.is_some();
        let loaded = match read {
            Ok(kept) if kept.lost.is_empty() => Loaded { document: kept.document, complaint: None },
            Ok(kept) => {
                let some = match kept.lost.as_slice() {
                    [one] => one.clone(),
                    many => format!("{} sets, the first {}", many.len(), many[0]),
                };
                let complaint = (!is_others).then(|| {
                    self.set_aside(&first, "An imported set could not be read; the document that names it", &some, true)
                });
                Loaded { document: kept.document, complaint }
            }
            Err(Unread::Missing) => Loaded { document: Document::default(), complaint: None },
            // Files of other windows are left to them.
            Err(Unread::Because(why)) if is_others => {
                let words =
                    format!("The other window's document could not be read ({why}); starting with a new document.");
                Loaded { document: Document::default(), complaint: Some((words, first)) }
            }
            Err(Unread::Because(why)) => {
                let complaint = self.set_aside(&first, "The last document could not be read and", &why, false);
                Loaded { document: Document::default(), complaint: Some(complaint) }
            }
        };
        // Before anything is written that may refer to the removed files.
        self.profile.tidy(SystemTime::now());
        // The document opened before the first frame counts as a change.
        let document = Arc::new(loaded.document.clone());
        let mut state = self.shared.lock();
        state.newest = Some(Arc::clone(&document));
        // A large document of an earlier version is taken apart now, so that the first change need not wait for that.
        state.saved = (!is_by_value).then_some(document);
        loaded
    }

    /// Handles a saved document that cannot be read: it is not overwritten, but moved or copied aside; if that fails, this
    /// window saves its document in another file.
    fn set_aside(&mut self, file: &Path, what: &str, why: &str, copy: bool) -> (String, PathBuf) {
        let aside = profile::free_aside(file.parent().unwrap_or(Path::new(".")));
        let result = if copy {
            std::fs::read(file).and_then(|bytes| crate::atomic::write_atomically(&aside, &bytes))
        } else {
            std::fs::rename(file, &aside)
        };
        match result {
            Ok(()) => (format!("{what} is now {} ({why}).", aside.display()), aside),
            Err(error) => {
                self.profile.leave_document();
                let own = self.profile.file.clone().unwrap_or_default();
                self.shared.store().move_to(own.clone());
                let words = format!(
                    "{what} stays {}; this window's is {} ({why}; it could not be moved: {}).",
                    file.display(),
                    own.display(),
                    crate::format::io_reason(&error)
                );
                (words, file.to_owned())
            }
        }
    }

    /// Records the current document and has it written in the background.
    pub(super) fn watch(&mut self, document: &Document, ctx: &egui::Context) {
        if !self.shared.keeps {
            return;
        }
        let mut state = self.shared.lock();
        state.see(document);
        if state.wake.is_none() {
            state.wake = Some(ctx.clone());
        }
        if state.is_clean() {
            // What could not be saved is undone.
            if self.profile.closed.is_none() {
                state.failure = None;
            }
            return;
        }
        if state.running {
            return;
        }
        let rested = state.ended.map(|ended| self.shared.clock.since(ended));
        if let Some(left) = rested.and_then(|rested| state.pause().checked_sub(rested)).filter(|left| !left.is_zero()) {
            ctx.request_repaint_after(left);
            return;
        }
        state.running = true;
        drop(state);
        let shared = Arc::clone(&self.shared);
        if let Err(error) = self.executor.spawn("keep", move || shared.work()) {
            let mut state = self.shared.lock();
            (state.running, state.ended) = (false, Some(self.shared.clock.now()));
            state.failure = Some(format!("no thread for writing: {error}"));
        }
    }

    /// Writes the document now, unless it is as it was written. The error says why not all of it is saved.
    pub(super) fn save(&mut self, document: &Document) -> Result<(), String> {
        if !self.shared.keeps {
            return Ok(());
        }
        self.shared.lock().see(document);
        self.shared.write_newest();
        let state = self.shared.lock();
        match &state.failure {
            Some(why) if !state.is_clean() => Err(why.clone()),
            _ => Ok(()),
        }
    }

    /// The reason why the document is not saved, while it is not.
    pub(super) fn failure(&self) -> Option<String> {
        self.shared.lock().failure.clone()
    }

    /// True if all is on disk.
    pub(super) fn is_saved(&self) -> bool {
        self.shared.lock().is_clean()
    }

    /// The file in which the document is saved because another program wrote to the one before.
    pub(super) fn moved(&self) -> Option<PathBuf> {
        self.shared.lock().moved.clone()
    }

    pub(super) fn folder(&self) -> Option<&Path> {
        self.profile.first.as_ref()?.parent()
    }

    /// Saves replaced documents, from any thread.
    pub(super) fn aside(&self) -> Aside {
        Aside(self.folder().map(Path::to_owned))
    }
}

/// Saves replaced documents.
pub(super) struct Aside(Option<PathBuf>);

impl Aside {
    /// Writes a document to a new file.
    pub(super) fn put_aside(&self, document: &Document) -> Result<(), String> {
        let Some(folder) = &self.0 else { return Ok(()) };
        Store::new(profile::free_copy(folder)).write(document).and_then(|written| match written.skipped_work {
            why if why.is_empty() => Ok(()),
            why => Err(why),
        })
    }
}

impl Drop for Keeper {
    fn drop(&mut self) {
        self.shared.lock().closed = true;
        self.shared.closing.notify_all();
        // A window that went without closing, because its display did.
        self.shared.save_last();
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::files::shared_state::{Breakdown, RETRY};

    #[test]
    fn a_panic_while_writing_is_told_and_writing_goes_on() {
        let folder = tempfile::tempdir().expect("a folder");
        let executor = Executor::driven();
        let mut keeper = Keeper::new(&executor, Some(folder.path().to_owned()));
        let document = keeper.load().document;
        keeper.shared.lock().running = true;
        let broken = std::panic::catch_unwind(std::panic::AssertUnwindSafe(|| {
            let _told = Breakdown(&keeper.shared);
            panic!("as an error in writing");
        }));
        assert!(broken.is_err() && keeper.failure().is_some());
        let changed = Document { temperature_k: 4321.0, ..document };
        executor.advance(RETRY);
        keeper.watch(&changed, &egui::Context::default());
        executor.run_all();
        assert!(keeper.is_saved() && keeper.failure().is_none());
    }
}
