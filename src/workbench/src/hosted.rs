//! Commands inside another program: files by value, and what would go to standard output and standard error.

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Mutex, PoisonError};

/// Beginning of the paths of files in memory.
const MEMORY: &str = "memory:";

type Files = BTreeMap<PathBuf, Arc<[u8]>>;

static FILES: Mutex<Files> = Mutex::new(Files::new());

fn with_files<T>(work: impl FnOnce(&mut Files) -> T) -> T {
    work(&mut FILES.lock().unwrap_or_else(PoisonError::into_inner))
}

/// Folder of files in memory, which are gone with it. Commands read and write them by their paths, from any thread.
#[derive(Debug)]
pub struct MemoryFolder(PathBuf);

impl MemoryFolder {
    #[allow(clippy::new_without_default, reason = "each folder is another one")]
    pub fn new() -> Self {
        static COUNT: AtomicU64 = AtomicU64::new(1);
        Self(format!("{MEMORY}{}", COUNT.fetch_add(1, Ordering::Relaxed)).into())
    }

    pub fn path(&self) -> &Path {
        &self.0
    }

    /// Adds a file and returns its path.
    pub fn add(&self, name: &str, bytes: Vec<u8>) -> PathBuf {
        let path = self.0.join(name);
        with_files(|files| files.insert(path.clone(), bytes.into()));
        path
    }

    /// All files by name.
    pub fn files(&self) -> Vec<(String, Arc<[u8]>)> {
        let name = |path: &Path| path.strip_prefix(&self.0).ok().map(|name| name.to_string_lossy().into_owned());
        with_files(|files| files.iter().filter_map(|(path, bytes)| Some((name(path)?, bytes.clone()))).collect())
    }

    /// A sentence without the folder before the names of its files.
    pub fn told(&self, sentence: &str) -> String {
        sentence.replace(&format!("{}/", self.0.display()), "").replace(&*self.0.to_string_lossy(), "")
    }
}

impl Drop for MemoryFolder {
    fn drop(&mut self) {
        with_files(|files| files.retain(|path, _| !path.starts_with(&self.0)));
    }
}

/// True for a path of a file or folder in memory.
pub fn is_in_memory(path: &Path) -> bool {
    path.to_str().is_some_and(|path| path.starts_with(MEMORY))
}

/// Contents of a file in memory.
pub fn bytes(path: &Path) -> Option<Arc<[u8]>> {
    if is_in_memory(path) { with_files(|files| files.get(path).cloned()) } else { None }
}

pub(crate) fn put(path: &Path, bytes: Vec<u8>) {
    with_files(|files| files.insert(path.to_owned(), bytes.into()));
}

/// Output and messages of a command.
#[derive(Debug, Default)]
pub struct Streams {
    /// Bytes for standard output.
    pub output: Vec<u8>,
    /// Messages for standard error, in order.
    pub remarks: Vec<String>,
}

thread_local! {
    static STREAMS: RefCell<Option<Streams>> = const { RefCell::new(None) };
}

/// Runs work of this thread with its streams held. After a panic they are those of the process again.
pub fn with_streams<T>(work: impl FnOnce() -> T) -> (T, Streams) {
    struct Ended;
    impl Drop for Ended {
        fn drop(&mut self) {
            STREAMS.take();
        }
    }
    STREAMS.set(Some(Streams::default()));
    let ended = Ended;
    let answer = work();
    let streams = STREAMS.take().unwrap_or_default();
    drop(ended);
    (answer, streams)
}

/// True while this thread's streams are held.
pub fn holds_streams() -> bool {
    STREAMS.with_borrow(Option::is_some)
}

/// Adds to the streams that are held; false where none are.
pub(crate) fn hold(add: impl FnOnce(&mut Streams)) -> bool {
    STREAMS.with_borrow_mut(|streams| streams.as_mut().map(add).is_some())
}
