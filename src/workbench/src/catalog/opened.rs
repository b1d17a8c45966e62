//! Spectral files opened in this run: read in the background, with their bytes cached so that the settings can be changed.
//!
//! Nothing here changes a document. The results of opening are returned by [`Opened::poll`]. A file stays listed whether it
//! could be read or not, so that the user can see its text and its interpretation ([`Opened::look`]), change a setting, and see
//! the effect.

mod look;
mod reading;

pub use look::{FilePreview, FilePreviewQuery, OpenFile};
pub use reading::Request;

use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use serde::{Deserialize, Serialize};

use super::import::Imported;
use crate::document::imported::{Fingerprint, ImportOverrides, ImportedSet};
use crate::document::measurement::MeasuredPass;
use crate::format::file_name;
use crate::jobs::{self, Background, Executor};

/// Maximum total bytes of files without a set; beyond it the oldest are dropped.
const REMEMBERED_BYTES: usize = 256_000_000;

/// Earlier contents of a changed file that are kept, for undo.
const READINGS: usize = 3;

/// Name of what is pasted, in place of a file's.
pub const CLIPBOARD: &str = "clipboard";

/// A file on disk that could not be read, as it is remembered between runs.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Failing {
    #[serde(with = "crate::document::paths")]
    pub path: PathBuf,
    pub fingerprint: Fingerprint,
    /// Reason, as a message that names the file.
    pub why: String,
}

#[derive(Debug)]
pub enum OpenedEvent {
    /// Files were read: a message that sums up contents and decisions in one sentence; the number of further files that could not be
    /// read, with the reason for the first (may be empty); the files on disk; and the further ones whose text can be shown.
    Read { sets: Vec<Imported>, message: String, failure: String, paths: Vec<PathBuf>, failed: Vec<Fingerprint> },
    /// Sets were read again for a reason: by the names they had, each as it is now, or why it stays as it was. A later reading has a
    /// larger ticket.
    Reread { sets: Vec<(String, Result<Imported, String>)>, why: Why, ticket: u64 },
    /// New contents of a file that could not be read before.
    Replaced { old: Fingerprint, new: Fingerprint, path: PathBuf },
    /// A mesh is to be opened, which is not read yet.
    Mesh(PathBuf),
    /// A spectral image is to be opened, which is not read yet.
    Image(PathBuf),
    /// Passes over narrow bands, from which a camera is measured.
    Bands(Vec<MeasuredPass>),
    /// A document of this program is to be opened, which is not read yet.
    Document(PathBuf),
    /// No file could be read, and nothing was changed. Contains the files whose text can be shown.
    Failed(String, Vec<Fingerprint>),
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Why {
    /// Its file changed on disk.
    Changed,
    /// It is to be read as another of its kind.
    Alike,
}

#[derive(Clone, Debug, Default, PartialEq)]
pub struct Progress {
    pub name: String,
    /// Fraction done, 0 to 1.
    pub share: f32,
    /// Number of the file, from 1, and the count of files.
    pub file: [usize; 2],
    pub time: Duration,
}

pub struct Opened {
    monitor: Arc<Monitor>,
    look: Background<FilePreviewQuery>,
    executor: Executor,
}

/// State shared by the window and the reading threads.
type Monitor = jobs::Monitor<State>;

#[derive(Default)]
struct State {
    files: Vec<OpenFile>,
    events: Vec<OpenedEvent>,
    running: Vec<Arc<Job>>,
    tickets: u64,
    /// Files that were looked for on disk and are not there as they were.
    lost: Vec<Fingerprint>,
}

struct Job {
    /// Its time is known when it is asked for.
    progress: Mutex<Progress>,
    stop: AtomicBool,
    begun: Duration,
}

impl Opened {
    /// Creates an empty store. `wake` is called when something was read, from the thread that read it.
    pub fn on(executor: &Executor, wake: impl Fn() + Send + Sync + 'static) -> Self {
        let wake: Arc<dyn Fn() + Send + Sync> = Arc::new(wake);
        let theirs = Arc::clone(&wake);
        let look = Background::on(executor, move || theirs());
        let monitor = Monitor::new(executor, State::default(), move || wake());
        Self { monitor: Arc::new(monitor), look, executor: executor.clone() }
    }

    /// Reads files, folders or bytes; `remembered` returns the user's settings for files like one with the given text.
    pub fn open(&self, requests: Vec<Request>, remembered: impl Fn(&[u8]) -> ImportOverrides + Send + 'static) {
        self.begin(move |monitor, job| {
            let events = reading::open(requests, &remembered, monitor, job);
            monitor.lock().events.extend(events);
        });
    }

    /// Reads the files of sets again: those known here from memory if `why` allows, else from disk.
    pub fn reread(&self, sets: Vec<ImportedSet>, why: Why) {
        let ticket = {
            let mut state = self.monitor.lock();
            state.tickets += 1;
            state.tickets
        };
        self.begin(move |monitor, job| {
            let sets: Vec<_> = sets.iter().filter_map(|set| reading::reread(set, why, monitor, job)).collect();
            if !sets.is_empty() {
                monitor.lock().events.push(OpenedEvent::Reread { sets, why, ticket });
            }
        });
    }

    /// Reloads the contents that a set was made of, if its file is unchanged. Requested once.
    pub fn fetch(&self, set: &ImportedSet) {
        let (Some(path), Some(fingerprint)) = (set.path.clone(), set.fingerprint) else { return };
        let mut state = self.monitor.lock();
        if state.lost.contains(&fingerprint) || state.file(fingerprint).is_some() {
            return;
        }
        // The search counts as failed until the file is found, so that it is done once.
        state.lost.push(fingerprint);
        drop(state);
        self.begin(move |monitor, job| reading::fetch(&path, fingerprint, monitor, job));
    }

    /// Reads files that failed in an earlier run, so that their text can be shown again. They are only listed; missing files
    /// are dropped.
    pub fn recall(&self, failing: Vec<Failing>) {
        if !failing.is_empty() {
            self.begin(move |monitor, job| reading::recall(failing, monitor, job));
        }
    }

    pub fn failing(&self) -> Vec<Failing> {
        let state = self.monitor.lock();
        let failing = state.files.iter().filter_map(|file| {
            let (path, why) = (file.origin.path.clone()?, file.failure.clone()?);
            Some(Failing { path, fingerprint: file.origin.fingerprint, why })
        });
        failing.collect()
    }

    /// Outcomes of reading since the last call.
    pub fn poll(&self) -> Vec<OpenedEvent> {
        std::mem::take(&mut self.monitor.lock().events)
    }

    /// The reading that has gone on for longest.
    pub fn progress(&self) -> Option<Progress> {
        let state = self.monitor.lock();
        let job = state.running.first()?;
        Some(Progress { time: self.monitor.clock().since(job.begun), ..job.progress().clone() })
    }

    /// Stops whatever is being read. Returns the name of a file that was.
    pub fn stop(&self) -> Option<String> {
        let progress = self.progress()?;
        for job in &self.monitor.lock().running {
            job.stop.store(true, Ordering::Relaxed);
        }
        Some(progress.name)
    }

    /// The files known, in the order in which they were opened.
    pub fn files(&self) -> Vec<OpenFile> {
        self.monitor.lock().files.clone()
    }

    pub fn file(&self, fingerprint: Fingerprint) -> Option<OpenFile> {
        self.monitor.lock().file(fingerprint).cloned()
    }

    pub fn forget(&self, fingerprint: Fingerprint) {
        self.monitor.lock().files.retain(|file| file.origin.fingerprint != fingerprint);
    }

    /// Drops the oldest contents of files that change again and again, and the oldest files without a set, beyond the memory limit.
    pub fn keep(&self, wanted: &[Fingerprint]) {
        let mut state = self.monitor.lock();
        let mut later: HashMap<&Path, usize> = HashMap::new();
        let mut old = Vec::new();
        for file in state.files.iter().rev() {
            let fingerprint = file.origin.fingerprint;
            let Some(path) = file.origin.path.as_deref().filter(|_| !wanted.contains(&fingerprint)) else { continue };
            let count = later.entry(path).or_default();
            *count += 1;
            old.extend((*count > READINGS).then_some(fingerprint));
        }
        if !old.is_empty() {
            state.files.retain(|file| !old.contains(&file.origin.fingerprint));
        }
        let size = |state: &State| state.files.iter().map(|file| file.bytes.len()).sum::<usize>();
        while size(&state) > REMEMBERED_BYTES {
            let spare = |file: &OpenFile| !wanted.contains(&file.origin.fingerprint);
            let Some(oldest) = state.files.iter().position(spare) else { return };
            state.files.remove(oldest);
        }
    }

    /// Preview of a file read with these options; the last preview while it is being read.
    pub fn look(&self, file: &OpenFile, options: &spectral_file::ReadOptions) -> Option<Arc<FilePreview>> {
        self.look.ask(vec![FilePreviewQuery::new(file, options)]);
        self.preview().filter(|preview| preview.fingerprint == file.origin.fingerprint)
    }

    /// Latest preview that [`look`](Self::look) produced, of any file.
    pub fn preview(&self) -> Option<Arc<FilePreview>> {
        self.look.shown().map(|shown| shown.answer)
    }

    pub fn looking(&self) -> Option<Duration> {
        self.look.busy()
    }

    /// Stops the preview, which is not visible.
    pub fn rest(&self) {
        self.look.rest();
    }

    /// Waits until everything that was requested is read. For tests.
    pub fn wait(&self) {
        self.monitor.settle(&self.executor, |state| state.running.is_empty());
        self.look.wait();
    }

    fn begin(&self, work: impl FnOnce(&Monitor, &Job) + Send + 'static) {
        let progress = Mutex::new(Progress { file: [1, 1], ..Progress::default() });
        let job = Arc::new(Job { progress, stop: AtomicBool::new(false), begun: self.monitor.clock().now() });
        self.monitor.lock().running.push(Arc::clone(&job));
        let monitor = Arc::clone(&self.monitor);
        let theirs = Arc::clone(&job);
        let run = move || {
            work(&monitor, &theirs);
            monitor.lock().running.retain(|running| !Arc::ptr_eq(running, &theirs));
            monitor.tell();
        };
        if let Err(error) = self.executor.spawn("files", run) {
            let mut state = self.monitor.lock();
            state.running.retain(|running| !Arc::ptr_eq(running, &job));
            state.events.push(OpenedEvent::Failed(format!("no thread for reading: {error}"), Vec::new()));
        }
    }
}

impl Drop for Opened {
    fn drop(&mut self) {
        self.monitor.lock().running.iter().for_each(|job| job.stop.store(true, Ordering::Relaxed));
    }
}

impl State {
    /// Takes a file in, in place of one with the same contents, and of what could not be read at the same place.
    fn know(&mut self, file: OpenFile) {
        let Self { files, events, .. } = self;
        let new = file.origin.fingerprint;
        if let Some(path) = &file.origin.path {
            files.retain(|known| {
                let old = known.origin.fingerprint;
                let gone = known.failure.is_some() && known.origin.path.as_ref() == Some(path) && old != new;
                if gone {
                    events.push(OpenedEvent::Replaced { old, new, path: path.clone() });
                }
                !gone
            });
        }
        self.lost.retain(|lost| *lost != new);
        match self.files.iter_mut().find(|known| known.origin.fingerprint == new) {
            Some(known) => *known = file,
            None => self.files.push(file),
        }
    }

    fn file(&self, fingerprint: Fingerprint) -> Option<&OpenFile> {
        self.files.iter().find(|file| file.origin.fingerprint == fingerprint)
    }
}

impl Job {
    /// Records the progress: file number `file` of `count`.
    fn at(&self, path: &Path, file: usize, count: usize) {
        *self.progress() = Progress { name: file_name(path), file: [file, count], ..Progress::default() };
    }

    fn progress(&self) -> MutexGuard<'_, Progress> {
        self.progress.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Records the share of the file read; returns whether to continue.
    fn go_on(&self, share: f32) -> bool {
        self.progress().share = share;
        !self.stop.load(Ordering::Relaxed)
    }
}
