//! The user's mesh files: read in the background, remembered by path, reloaded when they changed.
//!
//! A document holds only the path of a mesh. [`MeshStore::get`] is called for pictures: it starts reading on the first call and
//! never waits. [`MeshStore::open`] is called when the user opens a file: the file is read before anything changes, and the
//! result is returned by [`MeshStore::poll`]; opening another file meanwhile cancels the first.

mod read;

pub use read::{ENDINGS, LoadedMesh, MAX_FILE_BYTES, MeshFailure, is_mesh, read};

use std::collections::HashMap;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use chromascope_core::query::Shared;
use chromascope_mesh::Mesh;

use crate::document::render::MeshChoice;
use crate::format::file_name;
use crate::jobs::{Desk, Executor};
use read::Stamp;

/// Maximum bytes of unused meshes that stay cached, so that undo need not read them again.
const REMEMBERED_BYTES: usize = 256_000_000;

/// State of a mesh file.
#[derive(Clone, Debug)]
pub enum MeshState {
    /// It is being read.
    Loading,
    /// It was read.
    Ready(Arc<LoadedMesh>),
    /// It gives no mesh: why, and what to do.
    Failed(String),
}

/// Outcome of opening a file.
#[derive(Clone, Debug)]
pub struct Opened {
    /// The file.
    pub path: PathBuf,
    /// The mesh, or the reason that there is none.
    pub result: Result<Arc<LoadedMesh>, String>,
}

/// The mesh files that were requested.
pub struct MeshStore {
    desk: Arc<Desk<State>>,
    executor: Executor,
}

#[derive(Default)]
struct State {
    known: HashMap<PathBuf, Known>,
    opening: Option<PathBuf>,
    opened: Vec<Opened>,
    clock: u64,
}

/// One file. With nothing in it, nothing was tried yet.
#[derive(Default)]
struct Known {
    mesh: Option<(Arc<LoadedMesh>, Stamp)>,
    failure: Option<String>,
    /// Tells the thread that reads it to stop.
    reading: Option<Arc<AtomicBool>>,
    asked: u64,
}

impl Known {
    fn stop(&mut self) {
        if let Some(stop) = self.reading.take() {
            stop.store(true, Ordering::Relaxed);
        }
    }
}

impl MeshStore {
    /// Creates an empty store. `wake` is called when a file was read, from the thread that read it.
    pub fn new(wake: impl Fn() + Send + Sync + 'static) -> Self {
        Self::on(&Executor::default(), wake)
    }

    /// Reads files on an executor.
    pub fn on(executor: &Executor, wake: impl Fn() + Send + Sync + 'static) -> Self {
        Self { desk: Arc::new(Desk::new(executor, State::default(), wake)), executor: executor.clone() }
    }

    /// State of a file. The first call starts reading; a mesh stays visible while its file is reloaded.
    pub fn get(&self, path: &Path) -> MeshState {
        let mut state = self.desk.lock();
        state.clock += 1;
        let now = state.clock;
        let known = state.known_at(path);
        known.asked = now;
        if let Some((mesh, _)) = &known.mesh {
            return MeshState::Ready(Arc::clone(mesh));
        }
        if known.reading.is_none() {
            if let Some(failure) = &known.failure {
                return MeshState::Failed(failure.clone());
            }
            self.begin(&mut state, path, None);
        }
        MeshState::Loading
    }

    /// The mesh that a document chose, if it is a file's and was read.
    pub fn chosen(&self, choice: &MeshChoice) -> Option<Shared<Mesh>> {
        let MeshChoice::File(path) = choice else { return None };
        match self.get(path) {
            MeshState::Ready(mesh) => Some(mesh.mesh.clone()),
            MeshState::Loading | MeshState::Failed(_) => None,
        }
    }

    /// Opens a file for the user; [`MeshStore::poll`] returns the result. Cancels an earlier open request.
    pub fn open(&self, path: &Path) {
        let mut state = self.desk.lock();
        state.give_up_opening();
        state.opening = Some(path.to_owned());
        let known = state.known_at(path);
        let unless = known.mesh.as_ref().map(|(_, stamp)| *stamp);
        if known.reading.is_none() {
            self.begin(&mut state, path, unless);
        }
    }

    /// Reads a file again, changed or not. Its mesh stays visible meanwhile, and afterwards if it can no longer be read.
    pub fn reload(&self, path: &Path) {
        let mut state = self.desk.lock();
        state.known_at(path).stop();
        self.begin(&mut state, path, None);
    }

    /// Takes the results of finished open requests, one for each file that was not canceled.
    pub fn poll(&self) -> Vec<Opened> {
        std::mem::take(&mut self.desk.lock().opened)
    }

    /// The file that is being opened.
    pub fn opening(&self) -> Option<PathBuf> {
        self.desk.lock().opening.clone()
    }

    /// Cancels opening. Returns the file that was being opened.
    pub fn cancel(&self) -> Option<PathBuf> {
        self.desk.lock().give_up_opening()
    }

    /// Stops reads that are no longer needed, and drops unused meshes beyond the memory limit.
    pub fn keep(&self, wanted: Option<&Path>) {
        let mut state = self.desk.lock();
        let opening = state.opening.clone();
        let needed = |path: &Path| Some(path) == wanted || Some(path) == opening.as_deref();
        for (path, known) in &mut state.known {
            if !needed(path) {
                known.stop();
            }
        }
        state.known.retain(|path, known| needed(path) || known.mesh.is_some() || known.failure.is_some());
        let size = |known: &Known| known.mesh.as_ref().map_or(0, |(mesh, _)| mesh.bytes());
        loop {
            let spare = || state.known.iter().filter(|(path, _)| !needed(path));
            if spare().map(|(_, known)| size(known)).sum::<usize>() <= REMEMBERED_BYTES {
                return;
            }
            let oldest = spare().filter(|(_, known)| known.mesh.is_some()).min_by_key(|(_, known)| known.asked);
            let Some(oldest) = oldest.map(|(path, _)| path.clone()) else { return };
            state.known.remove(&oldest);
        }
    }

    /// Reads on a separate thread, so that an unreachable server blocks no other file.
    fn begin(&self, state: &mut State, path: &Path, unless: Option<Stamp>) {
        let stop: Arc<AtomicBool> = Arc::default();
        state.known_at(path).reading = Some(Arc::clone(&stop));
        let (desk, file) = (Arc::clone(&self.desk), path.to_owned());
        let work = move || {
            let result = read_once(&file, unless, &|| stop.load(Ordering::Relaxed));
            desk.lock().take(&file, &stop, result);
            desk.tell();
        };
        if let Err(error) = self.executor.spawn("meshes", work) {
            let failure = MeshFailure::Io { file: file_name(path), error };
            let stop = state.known_at(path).reading.clone().unwrap_or_default();
            state.take(path, &stop, Err(failure));
        }
    }
}

impl Drop for MeshStore {
    fn drop(&mut self) {
        self.desk.lock().known.values_mut().for_each(Known::stop);
    }
}

impl State {
    fn known_at(&mut self, path: &Path) -> &mut Known {
        self.known.entry(path.to_owned()).or_default()
    }

    /// Handles the result of a thread; `None` for an unchanged file.
    fn take(&mut self, path: &Path, stop: &Arc<AtomicBool>, result: Result<Option<(LoadedMesh, Stamp)>, MeshFailure>) {
        let Some(known) = self.known.get_mut(path) else { return };
        if known.reading.as_ref().is_none_or(|reading| !Arc::ptr_eq(reading, stop)) {
            return;
        }
        known.reading = None;
        let mut sentence = None;
        match result {
            Ok(Some((mesh, stamp))) => {
                log::info!("read {}", mesh.summary);
                known.mesh = Some((Arc::new(mesh), stamp));
                known.failure = None;
            }
            Ok(None) => {}
            Err(failure) => {
                log::warn!("{failure}");
                known.failure = Some(failure.on_show());
                sentence = Some(failure.on_opening());
            }
        }
        if self.opening.as_deref() != Some(path) {
            return;
        }
        self.opening = None;
        let result = match (sentence, &known.mesh) {
            (Some(sentence), _) => Err(sentence),
            (None, Some((mesh, _))) => Ok(Arc::clone(mesh)),
            (None, None) => return,
        };
        self.opened.push(Opened { path: path.to_owned(), result });
    }

    fn give_up_opening(&mut self) -> Option<PathBuf> {
        let path = self.opening.take()?;
        let known = self.known_at(&path);
        known.stop();
        known.failure = Some(MeshFailure::Stopped(file_name(&path)).on_show());
        Some(path)
    }
}

/// Reads, and has a panic come out as a failure of this file alone.
fn read_once(
    path: &Path,
    unless: Option<Stamp>,
    stop: &dyn Fn() -> bool,
) -> Result<Option<(LoadedMesh, Stamp)>, MeshFailure> {
    let read = catch_unwind(AssertUnwindSafe(|| read::read_unless(path, unless, stop)));
    read.unwrap_or_else(|_| Err(MeshFailure::Broken(file_name(path))))
}
