//! The user's meshes, spectral images and recorded values: read in the background, remembered by path, reloaded when they changed.
//!
//! A document holds only the path of a file. [`FileStore::get`] is called for pictures: it starts reading on the first call and
//! never waits. [`FileStore::open`] is called when the user opens a file: the file is read before anything changes, and the
//! result is returned by [`FileStore::poll`]; opening another file meanwhile cancels the first.

use std::collections::HashMap;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::SystemTime;
use std::{fs, io};

use crate::format::{file_name, io_reason};
use crate::jobs::{Executor, Monitor};

/// Maximum bytes of unused files that stay cached, so that undo need not read them again.
const REMEMBERED_BYTES: usize = 256_000_000;

#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Stamp {
    modified: Option<SystemTime>,
    bytes: u64,
}

impl Stamp {
    pub fn of(file: &fs::Metadata) -> Self {
        Self { modified: file.modified().ok(), bytes: file.len() }
    }

    pub fn bytes(self) -> u64 {
        self.bytes
    }
}

pub trait FromFile: Sized + Send + Sync + 'static {
    type Failure: std::fmt::Display + Send + From<Unread>;
    /// State of a file by which it is known to have changed.
    type Version: Copy + Send + 'static;
    const THREAD: &'static str;

    /// Reads a file unless it is still in this state. `stop` is polled.
    fn read_unless(
        path: &Path,
        unless: Option<Self::Version>,
        stop: &dyn Fn() -> bool,
    ) -> Result<Option<(Self, Self::Version)>, Self::Failure>;

    fn bytes(&self) -> usize;

    fn summary(&self) -> &str;

    /// Message for the user who opened the file.
    fn on_opening(failure: &Self::Failure) -> String {
        failure.to_string()
    }

    /// Message for a picture that needs the file.
    fn picture_message(failure: &Self::Failure) -> String {
        failure.to_string()
    }
}

/// For files whose failures are no more than their words.
impl From<Unread> for String {
    fn from(why: Unread) -> Self {
        why.to_string()
    }
}

/// Reason that a file was not read to its end, whatever it holds.
#[derive(Debug, thiserror::Error)]
pub enum Unread {
    #[error("{file}: {}", io_reason(.error))]
    Io { file: String, error: io::Error },
    #[error("{0} could not be read because of an error in this program; please report it with the file")]
    Broken(String),
    #[error("Reading {0} stopped")]
    Stopped(String),
}

#[derive(Debug)]
pub enum FileState<T> {
    Loading,
    Ready(Arc<T>),
    /// It gives no content: why, and what to do.
    Failed(String),
}

#[derive(Debug)]
pub struct Opened<T> {
    pub path: PathBuf,
    pub result: Result<Arc<T>, String>,
}

pub struct FileStore<T: FromFile> {
    monitor: Arc<Monitor<State<T>>>,
    executor: Executor,
}

struct State<T: FromFile> {
    known: HashMap<PathBuf, Known<T>>,
    opening: Option<PathBuf>,
    opened: Vec<Opened<T>>,
    clock: u64,
}

/// One file. With nothing in it, nothing was tried yet.
struct Known<T: FromFile> {
    content: Option<(Arc<T>, T::Version)>,
    failure: Option<String>,
    /// Tells the thread that reads it to stop.
    reading: Option<Arc<AtomicBool>>,
    asked: u64,
}

impl<T: FromFile> Known<T> {
    fn stop(&mut self) {
        if let Some(stop) = self.reading.take() {
            stop.store(true, Ordering::Relaxed);
        }
    }
}

impl<T: FromFile> FileStore<T> {
    /// Creates an empty store. `wake` is called when something was read, from the thread that read it.
    pub fn on(executor: &Executor, wake: impl Fn() + Send + Sync + 'static) -> Self {
        let state = State { known: HashMap::new(), opening: None, opened: Vec::new(), clock: 0 };
        Self { monitor: Arc::new(Monitor::new(executor, state, wake)), executor: executor.clone() }
    }

    /// State of a file. The first call starts reading; its content stays visible while it is reloaded.
    pub fn get(&self, path: &Path) -> FileState<T> {
        let mut state = self.monitor.lock();
        state.clock += 1;
        let now = state.clock;
        let known = state.known_at(path);
        known.asked = now;
        if let Some((content, _)) = &known.content {
            return FileState::Ready(Arc::clone(content));
        }
        if known.reading.is_none() {
            if let Some(failure) = &known.failure {
                return FileState::Failed(failure.clone());
            }
            self.begin(&mut state, path, None);
        }
        FileState::Loading
    }

    /// Opens a file for the user; [`FileStore::poll`] returns the result. Cancels an earlier open request.
    pub fn open(&self, path: &Path) {
        let mut state = self.monitor.lock();
        state.give_up_opening();
        state.opening = Some(path.to_owned());
        let known = state.known_at(path);
        let unless = known.content.as_ref().map(|(_, version)| *version);
        if known.reading.is_none() {
            self.begin(&mut state, path, unless);
        }
    }

    /// Forgets a file, which is read again when it is needed, and stops reading others.
    pub fn read_again(&self, path: &Path) {
        self.keep(None);
        self.monitor.lock().known.remove(path);
    }

    /// Takes the results of finished open requests, one for each file that was not canceled.
    pub fn poll(&self) -> Vec<Opened<T>> {
        std::mem::take(&mut self.monitor.lock().opened)
    }

    pub fn opening(&self) -> Option<PathBuf> {
        self.monitor.lock().opening.clone()
    }

    /// Cancels opening. Returns the file that was being opened.
    pub fn cancel(&self) -> Option<PathBuf> {
        self.monitor.lock().give_up_opening()
    }

    /// Stops reads that are no longer needed, and drops unused contents beyond the memory limit.
    pub fn keep(&self, wanted: Option<&Path>) {
        let mut state = self.monitor.lock();
        let opening = state.opening.clone();
        let needed = |path: &Path| Some(path) == wanted || Some(path) == opening.as_deref();
        for (path, known) in &mut state.known {
            if !needed(path) {
                known.stop();
            }
        }
        state.known.retain(|path, known| needed(path) || known.content.is_some() || known.failure.is_some());
        let size = |known: &Known<T>| known.content.as_ref().map_or(0, |(content, _)| content.bytes());
        loop {
            let spare = || state.known.iter().filter(|(path, _)| !needed(path));
            if spare().map(|(_, known)| size(known)).sum::<usize>() <= REMEMBERED_BYTES {
                return;
            }
            let oldest = spare().filter(|(_, known)| known.content.is_some()).min_by_key(|(_, known)| known.asked);
            let Some(oldest) = oldest.map(|(path, _)| path.clone()) else { return };
            state.known.remove(&oldest);
        }
    }

    /// Reads on a separate thread, so that an unreachable server blocks no other file.
    fn begin(&self, state: &mut State<T>, path: &Path, unless: Option<T::Version>) {
        let stop: Arc<AtomicBool> = Arc::default();
        state.known_at(path).reading = Some(Arc::clone(&stop));
        let (monitor, file) = (Arc::clone(&self.monitor), path.to_owned());
        let work = move || {
            let result = read_once::<T>(&file, unless, &|| stop.load(Ordering::Relaxed));
            monitor.lock().take(&file, &stop, result);
            monitor.tell();
        };
        if let Err(error) = self.executor.spawn(T::THREAD, work) {
            let failure = Unread::Io { file: file_name(path), error }.into();
            let stop = state.known_at(path).reading.clone().unwrap_or_default();
            state.take(path, &stop, Err(failure));
        }
    }
}

impl<T: FromFile> Drop for FileStore<T> {
    fn drop(&mut self) {
        self.monitor.lock().known.values_mut().for_each(Known::stop);
    }
}

impl<T: FromFile> State<T> {
    fn known_at(&mut self, path: &Path) -> &mut Known<T> {
        let unknown = Known { content: None, failure: None, reading: None, asked: 0 };
        self.known.entry(path.to_owned()).or_insert(unknown)
    }

    /// Handles the result of a thread; `None` for an unchanged file.
    fn take(&mut self, path: &Path, stop: &Arc<AtomicBool>, result: Result<Option<(T, T::Version)>, T::Failure>) {
        let Some(known) = self.known.get_mut(path) else { return };
        if known.reading.as_ref().is_none_or(|reading| !Arc::ptr_eq(reading, stop)) {
            return;
        }
        known.reading = None;
        let mut sentence = None;
        match result {
            Ok(Some((content, version))) => {
                log::info!("read {}", content.summary());
                known.content = Some((Arc::new(content), version));
                known.failure = None;
            }
            Ok(None) => {}
            Err(failure) => {
                log::warn!("{failure}");
                known.failure = Some(T::picture_message(&failure));
                sentence = Some(T::on_opening(&failure));
            }
        }
        if self.opening.as_deref() != Some(path) {
            return;
        }
        self.opening = None;
        let result = match (sentence, &known.content) {
            (Some(sentence), _) => Err(sentence),
            (None, Some((content, _))) => Ok(Arc::clone(content)),
            (None, None) => return,
        };
        self.opened.push(Opened { path: path.to_owned(), result });
    }

    fn give_up_opening(&mut self) -> Option<PathBuf> {
        let path = self.opening.take()?;
        let known = self.known_at(&path);
        known.stop();
        known.failure = Some(T::picture_message(&Unread::Stopped(file_name(&path)).into()));
        Some(path)
    }
}

/// Reads, and has a panic come out as a failure of this file alone.
fn read_once<T: FromFile>(
    path: &Path,
    unless: Option<T::Version>,
    stop: &dyn Fn() -> bool,
) -> Result<Option<(T, T::Version)>, T::Failure> {
    let read = catch_unwind(AssertUnwindSafe(|| T::read_unless(path, unless, stop)));
    read.unwrap_or_else(|_| Err(Unread::Broken(file_name(path)).into()))
}
