//! The document as it is and as it is on disk, shared by the window and the thread that writes.

use std::path::PathBuf;
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use super::last::within_moments;
use super::store::{Store, Written};
use crate::document::Document;
use crate::jobs::Clock;

/// Minimum interval between writes; the first change is written immediately.
const PAUSE: Duration = Duration::from_millis(150);
/// Interval after which a failed write is retried.
pub(super) const RETRY: Duration = Duration::from_secs(2);

/// State shared by the window and the thread that writes.
pub(super) struct SharedState {
    pub(super) state: Mutex<State>,
    /// Held while something is written.
    pub(super) store: Mutex<Store>,
    /// Notified when nothing is pending any more.
    pub(super) closing: Condvar,
    pub(super) clock: Clock,
    pub(super) is_driven: bool,
    /// True if there is a file to save the document in.
    pub(super) keeps: bool,
}

#[derive(Default)]
pub(super) struct State {
    /// The document as it is.
    pub(super) newest: Option<Arc<Document>>,
    /// The document as it is on disk; the same one where there is nothing to write.
    pub(super) saved: Option<Arc<Document>>,
    /// True while a thread writes, or waits to write again.
    pub(super) running: bool,
    pub(super) closed: bool,
    /// Time at which the last write ended.
    pub(super) ended: Option<Duration>,
    /// The reason why the last writing did not save all.
    pub(super) failure: Option<String>,
    /// The file that the document was moved to, because another program wrote to the one before.
    pub(super) moved: Option<PathBuf>,
    pub(super) wake: Option<egui::Context>,
}

impl State {
    pub(super) fn is_clean(&self) -> bool {
        match (&self.newest, &self.saved) {
            (Some(newest), Some(saved)) => Arc::ptr_eq(newest, saved),
            (newest, _) => newest.is_none(),
        }
    }

    /// Takes a document in. One that is as it is on disk needs no writing.
    pub(super) fn see(&mut self, document: &Document) {
        let is = |known: &Option<Arc<Document>>| known.as_deref() == Some(document);
        if is(&self.newest) {
            return;
        }
        // What kills are judged by (`.ci/kills`).
        log::debug!("changed: {} K", document.temperature_k);
        self.newest =
            Some(if is(&self.saved) { self.saved.clone() } else { None }.unwrap_or_else(|| Arc::new(document.clone())));
    }

    /// Time to rest after the last write.
    pub(super) fn pause(&self) -> Duration {
        if self.failure.is_some() { RETRY } else { PAUSE }
    }

    /// Handles the result of writing a document.
    fn written(&mut self, document: Arc<Document>, result: Result<Written, String>, store: &Store, now: Duration) {
        self.ended = Some(now);
        let before = self.failure.take();
        // After a move to another file, nothing counts as saved there yet.
        if self.moved.as_ref() != store.moved() {
            self.saved = None;
            self.moved = store.moved().cloned();
        }
        match result {
            Ok(Written { skipped_work }) if skipped_work.is_empty() => self.saved = Some(document),
            // The file holds neither this document nor the one before.
            Ok(Written { skipped_work }) => (self.saved, self.failure) = (None, Some(skipped_work)),
            Err(why) => self.failure = Some(why),
        }
        if before != self.failure {
            match &self.failure {
                Some(why) => log::warn!("the document is not saved: {why}"),
                None => log::info!("the document is saved again"),
            }
            if let Some(ctx) = &self.wake {
                ctx.request_repaint();
            }
        }
    }
}

impl SharedState {
    /// A panic elsewhere leaves no partial state: it is only read and replaced under the lock.
    pub(super) fn lock(&self) -> MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    pub(super) fn store(&self) -> MutexGuard<'_, Store> {
        self.store.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Writes the newest state, and later ones, until there is nothing new for a while.
    pub(super) fn work(&self) {
        let _told = Breakdown(self);
        loop {
            if !self.lock().closed {
                self.write_newest();
            }
            let mut state = self.lock();
            if self.is_driven || state.closed {
                state.running = false;
                return;
            }
            let pause = state.pause();
            let waited = self.closing.wait_timeout_while(state, pause, |state| !state.closed);
            state = waited.unwrap_or_else(PoisonError::into_inner).0;
            if state.is_clean() || state.closed {
                state.running = false;
                return;
            }
        }
    }

    pub(super) fn write_newest(&self) {
        let mut store = self.store();
        let newest = {
            let state = self.lock();
            if state.is_clean() {
                return;
            }
            state.newest.clone()
        };
        if let Some(document) = newest {
            let result = store.write(&document);
            self.lock().written(document, result, &store, self.clock.now());
        }
    }

    /// Writes the newest state at exit. Never waits for long: the thread that holds a lock may be the one that panicked.
    /// Returns the file, if everything is in it.
    pub(super) fn save_last(&self) -> Option<PathBuf> {
        if !self.keeps {
            return None;
        }
        let mut store = within_moments(&self.store)?;
        let newest = {
            let state = within_moments(&self.state)?;
            if state.is_clean() { None } else { state.newest.clone() }
        };
        if let Some(document) = newest {
            let result = store.write(&document);
            let file = result.is_ok().then(|| store.file().to_owned());
            within_moments(&self.state)?.written(document, result, &store, self.clock.now());
            return file;
        }
        Some(store.file().to_owned())
    }
}

/// Reports a writer thread that ended by a panic, so that another one is started.
pub(super) struct Breakdown<'a>(pub(super) &'a SharedState);

impl Drop for Breakdown<'_> {
    fn drop(&mut self) {
        if std::thread::panicking() {
            let mut state = self.0.lock();
            (state.running, state.ended) = (false, Some(self.0.clock.now()));
            state.failure = Some("the program was interrupted while writing".to_owned());
            if let Some(ctx) = &state.wake {
                ctx.request_repaint();
            }
        }
    }
}
