//! Keeping the document between runs: each change is on disk within a second, whatever ends the program, be it a panic, a
//! signal, or the end of the display.

use std::io;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError, TryLockError, Weak};
use std::thread;
use std::time::{Duration, Instant, SystemTime};

use super::document_file::{DocumentFile, Unread, Unwritten};
use super::folder::{self, Copy, Folder, OtherWindow};
use crate::document::Document;
use crate::jobs::{Clock, Executor};

/// Minimum interval between writes; the first change is written immediately.
const PAUSE: Duration = Duration::from_millis(150);
/// Interval after which a failed write is retried.
const RETRY: Duration = Duration::from_secs(2);
/// Maximum time to wait for a disk at exit.
const WAIT: Duration = Duration::from_secs(3);

static LAST: Mutex<Weak<Shared>> = Mutex::new(Weak::new());

pub(super) struct Autosave {
    folder: Folder,
    shared: Arc<Shared>,
    executor: Executor,
}

/// The document as it is and as it is on disk, shared by the window and the thread that writes.
struct Shared {
    state: Mutex<State>,
    /// Held while something is written.
    file: Mutex<DocumentFile>,
    /// Notified when nothing is pending any more.
    closing: Condvar,
    clock: Clock,
    is_driven: bool,
    /// True if there is a file to save the document in.
    keeps: bool,
}

#[derive(Default)]
struct State {
    newest: Option<Arc<Document>>,
    /// The document as it is on disk; the same one where there is nothing to write.
    saved: Option<Arc<Document>>,
    /// True while a thread writes, or waits to write again.
    running: bool,
    closed: bool,
    ended: Option<Duration>,
    failure: Option<String>,
    /// The file that the document was moved to, because another program wrote to the one before.
    moved: Option<PathBuf>,
    wake: Option<egui::Context>,
}

impl Autosave {
    pub(super) fn new(executor: &Executor, folder: Option<PathBuf>) -> Self {
        let folder = Folder::claim(folder);
        let shared = Arc::new(Shared {
            state: Mutex::new(State { failure: folder.closed.clone(), ..State::default() }),
            file: Mutex::new(DocumentFile::new(folder.file.clone().unwrap_or_default())),
            closing: Condvar::new(),
            clock: executor.clock(),
            is_driven: executor.is_driven(),
            keeps: folder.file.is_some(),
        });
        *LAST.lock().unwrap_or_else(PoisonError::into_inner) = Arc::downgrade(&shared);
        Self { folder, shared, executor: executor.clone() }
    }

    /// The window that has the folder, where it is not this one, and the file of this one's copy.
    pub(super) fn other(&self) -> Option<(OtherWindow, &Path)> {
        self.folder.other.zip(self.folder.file.as_deref())
    }

    /// True if a window saves its document in a file: this one or another.
    pub(super) fn is_in_use(&self, path: &Path) -> bool {
        self.moved().as_deref() == Some(path) || self.folder.is_in_use(path)
    }

    pub(super) fn copies(&self) -> Vec<Copy> {
        self.folder.copies(self.moved().as_deref())
    }

    /// True if no document was saved before, by this window or another.
    pub(super) fn is_first_run(&self) -> bool {
        self.folder.first.as_ref().is_some_and(|file| std::fs::symlink_metadata(file).is_err())
    }

    /// The saved document, or the default one; a message if it could not be read, and the file that now holds it.
    pub(super) fn load(&mut self) -> (Document, Option<(String, PathBuf)>) {
        let Some(first) = self.folder.first.clone() else { return Default::default() };
        let mut file = self.shared.file();
        // An earlier version of the program does not write over it.
        let read = file.read(&first).and_then(|kept| match kept.newer {
            Some(why) => Err(Unread::Because(format!("{why} Update to open it"))),
            None => Ok(kept),
        });
        let is_by_value = file.by_value;
        drop(file);
        let is_others = self.folder.other.is_some();
        let (document, complaint) = match read {
            Ok(kept) => {
                let lost = match kept.lost.as_slice() {
                    [] => None,
                    [one] => Some(one.clone()),
                    many => Some(format!("{} sets, the first {}", many.len(), many[0])),
                };
                let what = "An imported set could not be read; the document that names it";
                let lost = lost.filter(|_| !is_others);
                (kept.document, lost.map(|lost| self.set_aside(&first, what, &lost, true)))
            }
            Err(Unread::Missing) => Default::default(),
            // Files of other windows are left to them.
            Err(Unread::Because(why)) if is_others => {
                let words =
                    format!("The other window's document could not be read ({why}); starting with a new document.");
                (Document::default(), Some((words, first)))
            }
            Err(Unread::Because(why)) => {
                let what = "The last document could not be read and";
                (Document::default(), Some(self.set_aside(&first, what, &why, false)))
            }
        };
        // Before anything is written that may refer to the removed files.
        self.folder.tidy(SystemTime::now());
        // The document opened before the first frame counts as a change.
        let newest = Arc::new(document.clone());
        let mut state = self.shared.lock();
        state.newest = Some(Arc::clone(&newest));
        // A large document of an earlier version is taken apart now, so that the first change need not wait for that.
        state.saved = (!is_by_value).then_some(newest);
        (document, complaint)
    }

    /// Handles a saved document that cannot be read: it is not overwritten, but moved or copied aside; if that fails, this
    /// window saves its document in another file.
    fn set_aside(&mut self, file: &Path, what: &str, why: &str, copy: bool) -> (String, PathBuf) {
        let aside = folder::free_aside(file.parent().unwrap_or(Path::new(".")));
        let result = if copy {
            std::fs::read(file).and_then(|bytes| crate::atomic::write_atomically(&aside, &bytes))
        } else {
            std::fs::rename(file, &aside)
        };
        match result {
            Ok(()) => (format!("{what} is now {} ({why}).", aside.display()), aside),
            Err(error) => {
                self.folder.leave_document();
                let own = self.folder.file.clone().unwrap_or_default();
                self.shared.file().move_to(own.clone());
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
            if self.folder.closed.is_none() {
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
            drop(self.shared.stop(format!("no thread for writing: {error}")));
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

    pub(super) fn failure(&self) -> Option<String> {
        self.shared.lock().failure.clone()
    }

    pub(super) fn is_saved(&self) -> bool {
        self.shared.lock().is_clean()
    }

    pub(super) fn moved(&self) -> Option<PathBuf> {
        self.shared.lock().moved.clone()
    }

    pub(super) fn folder(&self) -> Option<&Path> {
        self.folder.first.as_ref()?.parent()
    }
}

impl Drop for Autosave {
    fn drop(&mut self) {
        self.shared.lock().closed = true;
        self.shared.closing.notify_all();
        // A window that went without closing, because its display did.
        self.shared.save_last();
    }
}

impl State {
    fn is_clean(&self) -> bool {
        match (&self.newest, &self.saved) {
            (Some(newest), Some(saved)) => Arc::ptr_eq(newest, saved),
            (newest, _) => newest.is_none(),
        }
    }

    /// Takes a document in. One that is as it is on disk needs no writing.
    fn see(&mut self, document: &Document) {
        let is = |known: &Option<Arc<Document>>| known.as_deref() == Some(document);
        if is(&self.newest) {
            return;
        }
        // What kills are judged by (`.ci/kills`).
        log::debug!("changed: {} K", document.temperature_k);
        self.newest =
            Some(if is(&self.saved) { self.saved.clone() } else { None }.unwrap_or_else(|| Arc::new(document.clone())));
    }

    fn pause(&self) -> Duration {
        if self.failure.is_some() { RETRY } else { PAUSE }
    }

    fn written(&mut self, document: Arc<Document>, result: Result<(), Unwritten>, file: &DocumentFile, now: Duration) {
        self.ended = Some(now);
        let before = self.failure.take();
        // After a move to another file, nothing counts as saved there yet.
        if self.moved != file.moved {
            self.saved = None;
            self.moved.clone_from(&file.moved);
        }
        match result {
            Ok(()) => self.saved = Some(document),
            Err(Unwritten { why, is_rest_written }) => {
                // The file then holds neither this document nor the one before.
                self.saved = self.saved.take().filter(|_| !is_rest_written);
                self.failure = Some(why);
            }
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

impl Shared {
    /// A panic elsewhere leaves no partial state: it is only read and replaced under the lock.
    fn lock(&self) -> MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn file(&self) -> MutexGuard<'_, DocumentFile> {
        self.file.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Records that no thread writes any more, for a reason.
    fn stop(&self, why: String) -> MutexGuard<'_, State> {
        let mut state = self.lock();
        (state.running, state.ended, state.failure) = (false, Some(self.clock.now()), Some(why));
        state
    }

    /// Writes the newest state, and later ones, until there is nothing new for a while.
    fn work(&self) {
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

    fn write_newest(&self) {
        let mut file = self.file();
        let newest = {
            let state = self.lock();
            if state.is_clean() {
                return;
            }
            state.newest.clone()
        };
        if let Some(document) = newest {
            let result = file.write(&document);
            self.lock().written(document, result, &file, self.clock.now());
        }
    }

    /// Writes the newest state at exit. Never waits for long: the thread that holds a lock may be the one that panicked.
    /// Returns the file, if everything is in it.
    fn save_last(&self) -> Option<PathBuf> {
        if !self.keeps {
            return None;
        }
        let mut file = within_moments(&self.file)?;
        let newest = {
            let state = within_moments(&self.state)?;
            if state.is_clean() { None } else { state.newest.clone() }
        };
        let mut is_saved = true;
        if let Some(document) = newest {
            let result = file.write(&document);
            is_saved = result.as_ref().err().is_none_or(|unwritten| unwritten.is_rest_written);
            within_moments(&self.state)?.written(document, result, &file, self.clock.now());
        }
        is_saved.then(|| file.path.clone())
    }
}

/// Reports a writer thread that ended by a panic, so that another one is started.
struct Breakdown<'a>(&'a Shared);

impl Drop for Breakdown<'_> {
    fn drop(&mut self) {
        if thread::panicking()
            && let Some(ctx) = &self.0.stop("the program was interrupted while writing".to_owned()).wake
        {
            ctx.request_repaint();
        }
    }
}

/// Locks what another thread may hold for good.
fn within_moments<T>(mutex: &Mutex<T>) -> Option<MutexGuard<'_, T>> {
    let start = Instant::now();
    loop {
        match mutex.try_lock() {
            Ok(guard) => return Some(guard),
            Err(TryLockError::Poisoned(poisoned)) => return Some(poisoned.into_inner()),
            Err(TryLockError::WouldBlock) if start.elapsed() > WAIT => return None,
            Err(TryLockError::WouldBlock) => thread::sleep(Duration::from_millis(1)),
        }
    }
}

/// Saves the last document seen, for a program that is about to end. Returns its file, if it is saved.
fn save_last() -> Option<PathBuf> {
    within_moments(&LAST)?.upgrade()?.save_last()
}

/// Before a panic is reported, the document is saved.
pub fn install_panic_hook() {
    let report = std::panic::take_hook();
    std::panic::set_hook(Box::new(move |info| {
        // What writes cannot save from within.
        if thread::current().name() != Some("keep")
            && let Some(file) = save_last()
        {
            log::error!("the document was saved to {}", file.display());
        }
        report(info);
    }));
}

/// Saves the document when the main thread ends, for instance because the display is gone: Xlib then ends the process from
/// within. To be called on the main thread.
pub fn save_on_exit() {
    struct Last;
    impl Drop for Last {
        fn drop(&mut self) {
            // On a separate thread: its thread-local values may already be destroyed on this one.
            let saving = thread::Builder::new().name("last".to_owned()).spawn(save_last);
            let _ended = saving.map(thread::JoinHandle::join);
        }
    }
    thread_local!(static LAST: Last = const { Last });
    LAST.with(|_| ());
}

#[cfg(unix)]
pub fn save_on_signals() -> io::Result<()> {
    use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM};
    use signal_hook::low_level::emulate_default_handler;
    let taken = [SIGTERM, SIGINT, SIGHUP].into_iter().filter(|signal| !is_ignored(*signal));
    let mut signals = signal_hook::iterator::Signals::new(taken)?;
    let work = move || {
        for signal in signals.forever() {
            // Whatever the disk does, the program ends.
            save_last();
            let _ended = emulate_default_handler(signal);
        }
    };
    thread::Builder::new().name("signals".to_owned()).spawn(work).map(drop)
}

/// Elsewhere the system closes the window, or ends the process without a word.
#[cfg(not(unix))]
pub fn save_on_signals() -> io::Result<()> {
    Ok(())
}

/// True if the parent process had the program ignore a signal, as `nohup` does.
#[cfg(unix)]
fn is_ignored(signal: i32) -> bool {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    let mask = mask.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok()).unwrap_or(0);
    mask >> (signal - 1) & 1 == 1
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_panic_while_writing_is_told_and_writing_goes_on() {
        let folder = tempfile::tempdir().expect("a folder");
        let executor = Executor::driven();
        let mut autosave = Autosave::new(&executor, Some(folder.path().to_owned()));
        let (document, _) = autosave.load();
        autosave.shared.lock().running = true;
        let broken = std::panic::catch_unwind(std::panic::AssertUnwindSafe(|| {
            let _told = Breakdown(&autosave.shared);
            panic!("as an error in writing");
        }));
        assert!(broken.is_err() && autosave.failure().is_some());
        let changed = Document { temperature_k: 4321.0, ..document };
        executor.advance(RETRY);
        autosave.watch(&changed, &egui::Context::default());
        executor.run_all();
        assert!(autosave.is_saved() && autosave.failure().is_none());
    }
}
