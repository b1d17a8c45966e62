//! Ownership of the program's folder: the first window holds a lock, another one saves a copy under a lock of its own. The
//! system releases the locks of a process when it ends.

use std::fs::{self, File, OpenOptions, TryLockError};
use std::io::{self, Write as _};
use std::path::{Path, PathBuf};
use std::time::{Duration, SystemTime};

use crate::atomic::{TEMPORARY, is_older, sweep};
use crate::format::io_failure;

/// The file in which the first window's document is saved.
const DOCUMENT: &str = "document.json";
/// The file that the first window holds locked, with the number of its process.
const LOCK: &str = "window.lock";
/// Time for which a curve file that no document names is retained, in case a document was moved out of the folder.
const UNNAMED: Duration = Duration::from_hours(30 * 24);
/// The folder of the curves of imported sets, which all documents of the folder share.
pub(super) const CURVES: &str = "curves";

/// A window's part of the program's folder.
#[derive(Debug, Default)]
pub(super) struct Folder {
    /// The file in which this window's document is saved.
    pub(super) file: Option<PathBuf>,
    /// The file of the first window's document; for the first window, its own.
    pub(super) first: Option<PathBuf>,
    /// The window that has the folder, where it is not this one.
    pub(super) other: Option<OtherWindow>,
    /// The reason why nothing can be written, as found at the start.
    pub(super) closed: Option<String>,
    lock: Option<Lock>,
}

/// A file that is locked, until this is dropped.
#[derive(Debug)]
pub(super) struct Lock {
    /// Missing where the file could not be locked.
    _file: Option<File>,
    /// The file of a copy's lock, which goes with the window.
    gone: Option<PathBuf>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct OtherWindow {
    pub(super) process: Option<u32>,
}

/// A document in the folder that is not this window's.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Copy {
    pub(super) path: PathBuf,
    pub(super) modified: Option<SystemTime>,
}

impl Folder {
    /// Locks the folder, or determines its owner.
    pub(super) fn claim(folder: Option<PathBuf>) -> Self {
        let Some(folder) = folder else { return Self::default() };
        let first = Some(folder.join(DOCUMENT));
        let of_first = Self { file: first.clone(), first: first.clone(), ..Self::default() };
        if let Err(error) = writable(&folder) {
            return Self { closed: Some(io_failure(&folder, &error)), ..of_first };
        }
        match lock(&folder.join(LOCK)) {
            Ok(file) => {
                sweep(&folder);
                sweep(&folder.join(CURVES));
                Self { lock: Some(Lock { _file: Some(file), gone: None }), ..of_first }
            }
            Err(TryLockError::WouldBlock) => {
                let process = fs::read_to_string(folder.join(LOCK)).ok().and_then(|text| text.trim().parse().ok());
                let copy = free_copy(&folder);
                let lock = Some(Lock::of_copy(&copy));
                Self { file: Some(copy), first, other: Some(OtherWindow { process }), closed: None, lock }
            }
            // Some network folders have no locks: better one document for all than none.
            Err(TryLockError::Error(error)) => {
                log::warn!("{} cannot be locked: {error}", folder.display());
                of_first
            }
        }
    }

    /// Saves this window's document in a copy from now on, because the first window's file must not be changed.
    pub(super) fn leave_document(&mut self) {
        if let Some(folder) = self.first.as_ref().and_then(|first| first.parent()).map(Path::to_owned) {
            self.file = Some(free_copy(&folder));
        }
    }

    /// Documents saved by other windows that are closed, the newest first, except the one that this window uses.
    pub(super) fn copies(&self, moved: Option<&Path>) -> Vec<Copy> {
        let Some(folder) = self.first.as_ref().and_then(|first| first.parent()) else { return Vec::new() };
        let is_free = |path: &PathBuf| is_copy(path) && moved != Some(path) && !self.is_in_use(path);
        let mut copies: Vec<Copy> = entries(folder)
            .filter(is_free)
            .map(|path| {
                let modified = fs::metadata(&path).and_then(|facts| facts.modified()).ok();
                Copy { path, modified }
            })
            .collect();
        copies.sort_by(|a, b| (b.modified, &a.path).cmp(&(a.modified, &b.path)));
        copies
    }

    /// Owner of a document: this window, the first one, or another that holds its lock.
    pub(super) fn is_in_use(&self, path: &Path) -> bool {
        [&self.file, &self.first].into_iter().flatten().any(|own| own == path) || is_held(path)
    }

    /// Removes locks that ended windows left, and old files of curves that no document of the folder names. Only the first
    /// window does, and only while it is alone.
    pub(super) fn tidy(&self, now: SystemTime) {
        let (Some(folder), None, Some(_)) = (self.first.as_ref().and_then(|f| f.parent()), self.other, &self.lock)
        else {
            return;
        };
        for path in entries(folder).filter(|path| path.extension().is_some_and(|ending| ending == "lock")) {
            let is_own = self.file.as_ref().is_some_and(|file| file.with_extension("lock") == path);
            if is_own || path.file_name().is_some_and(|name| name == LOCK) {
                continue;
            }
            if is_held(&path) {
                return;
            }
            let _gone = fs::remove_file(&path);
        }
        let Some(texts) = texts_of_documents(folder) else { return };
        for path in entries(&folder.join(CURVES)) {
            let is_named = || texts.iter().any(|text| text.contains(name_of(&path)));
            if is_older(&path, UNNAMED, now) && !is_named() {
                let _gone = fs::remove_file(&path);
            }
        }
    }
}

impl Lock {
    /// Locks a copy for as long as its window is open. Without locks, the file's existence marks it.
    pub(super) fn of_copy(copy: &Path) -> Self {
        let own = copy.with_extension("lock");
        let file = lock(&own).inspect_err(|error| log::warn!("{} cannot be locked: {error}", own.display())).ok();
        Self { _file: file, gone: Some(own) }
    }
}

impl Drop for Lock {
    fn drop(&mut self) {
        if let Some(path) = &self.gone {
            let _gone = fs::remove_file(path);
        }
    }
}

/// Texts of all documents of a folder; none if one cannot be read, whose references are unknown.
pub(super) fn texts_of_documents(folder: &Path) -> Option<Vec<String>> {
    let documents = entries(folder).filter(|path| path.extension().is_some_and(|ending| ending == "json"));
    documents.map(|path| fs::read(path).ok().map(|bytes| String::from_utf8_lossy(&bytes).into_owned())).collect()
}

pub(super) fn free_aside(folder: &Path) -> PathBuf {
    free(folder, |number| format!("document-unreadable-{number}.json"))
}

/// A name for a copy that no window has, nor had.
pub(super) fn free_copy(folder: &Path) -> PathBuf {
    let process = std::process::id();
    free(folder, |number| match number {
        1 => format!("document-{process}.json"),
        _ => format!("document-{process}-{number}.json"),
    })
}

fn free(folder: &Path, name: impl Fn(u32) -> String) -> PathBuf {
    let is_free = |path: &PathBuf| fs::symlink_metadata(path).is_err() && !path.with_extension("lock").exists();
    let paths = (1..=u32::MAX).map(|number| folder.join(name(number)));
    paths.into_iter().find(is_free).unwrap_or_else(|| folder.join(name(0)))
}

/// True if files can be made in a folder, which is made if it does not exist.
fn writable(folder: &Path) -> io::Result<()> {
    fs::create_dir_all(folder)?;
    tempfile::Builder::new().prefix(TEMPORARY).tempfile_in(folder).map(drop)
}

fn lock(path: &Path) -> Result<File, TryLockError> {
    let mut options = OpenOptions::new();
    let mut file =
        options.read(true).write(true).create(true).truncate(false).open(path).map_err(TryLockError::Error)?;
    file.try_lock()?;
    let written = file.set_len(0).and_then(|()| write!(file, "{}", std::process::id()));
    if let Err(error) = written {
        log::warn!("{} does not name this process: {error}", path.display());
    }
    Ok(file)
}

/// True if a window holds the lock of a copy.
fn is_held(copy: &Path) -> bool {
    // Network folders lock only files opened for writing.
    match OpenOptions::new().read(true).write(true).open(copy.with_extension("lock")) {
        Ok(file) => file.try_lock().is_err(),
        Err(error) => error.kind() != io::ErrorKind::NotFound,
    }
}

fn is_copy(path: &Path) -> bool {
    let inner = name_of(path).strip_prefix("document-").and_then(|rest| rest.strip_suffix(".json"));
    inner.is_some_and(|inner| inner.starts_with(|c: char| c.is_ascii_digit()))
}

fn name_of(path: &Path) -> &str {
    path.file_name().and_then(|name| name.to_str()).unwrap_or_default()
}

fn entries(folder: &Path) -> impl Iterator<Item = PathBuf> {
    fs::read_dir(folder).into_iter().flatten().flatten().map(|entry| entry.path())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn curves_that_no_document_names_are_removed_once_no_other_window_is_open() {
        let folder = tempfile::tempdir().expect("a folder");
        let curves = folder.path().join(CURVES);
        fs::create_dir(&curves).expect("made");
        for name in ["a.json", "b.json", "c.json"] {
            fs::write(curves.join(name), "[]").expect("written");
        }
        for (document, names) in [("document.json", "a.json"), ("of-a-backup.json", "{ b.json")] {
            fs::write(folder.path().join(document), names).expect("written");
        }
        let left = || entries(&curves).map(|path| name_of(&path).to_owned()).collect::<std::collections::BTreeSet<_>>();
        let claim = || Folder::claim(Some(folder.path().to_owned()));
        let (first, second) = (claim(), claim());
        let written = SystemTime::UNIX_EPOCH + Duration::from_hours(1_000_000);
        for name in ["a.json", "b.json", "c.json"] {
            let file = OpenOptions::new().write(true).open(curves.join(name)).expect("opened");
            file.set_modified(written).expect("set");
        }
        let late = written + UNNAMED + Duration::from_secs(1);
        first.tidy(late);
        second.tidy(late);
        assert_eq!(left().len(), 3, "the second window may be about to name one");
        drop(second);
        first.tidy(written + UNNAMED);
        assert_eq!(left().len(), 3, "a document that is put back may name one");
        first.tidy(late);
        assert_eq!(left().into_iter().collect::<Vec<_>>(), ["a.json", "b.json"]);
    }
}
