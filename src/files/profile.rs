//! The profile folder belongs to one window at a time: the first one holds a lock, another one keeps a copy.

use std::fs::{self, File, OpenOptions, TryLockError};
use std::io::Write as _;
use std::path::{Path, PathBuf};

/// The file that the first window's document is kept in.
const DOCUMENT: &str = "document.json";
/// The file that the first window holds locked, with the number of its process. The system releases the lock of a process that
/// ended, however it ended.
const LOCK: &str = "window.lock";

/// A window's part of the profile folder.
#[derive(Debug, Default)]
pub(super) struct Profile {
    /// The file that this window's document is kept in.
    pub(super) file: Option<PathBuf>,
    /// The file of the first window's document; for the first window, its own.
    pub(super) first: Option<PathBuf>,
    /// The window that has the profile, where it is not this one.
    pub(super) other: Option<OtherWindow>,
    /// Held as long as the window is open.
    _lock: Option<File>,
}

/// Another window of the program on the same profile.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct OtherWindow {
    /// Its process, if it could be read.
    pub(super) process: Option<u32>,
}

impl Profile {
    /// Takes the profile, or finds out who has it.
    pub(super) fn claim(folder: Option<PathBuf>) -> Self {
        let Some(folder) = folder else { return Self::default() };
        let first = Some(folder.join(DOCUMENT));
        match lock(&folder) {
            Ok(lock) => Self { file: first.clone(), first, other: None, _lock: Some(lock) },
            Err(TryLockError::WouldBlock) => {
                let process = fs::read_to_string(folder.join(LOCK)).ok().and_then(|text| text.trim().parse().ok());
                Self { file: Some(free_name(&folder)), first, other: Some(OtherWindow { process }), _lock: None }
            }
            // Some network folders have no locks: better one document for all than none.
            Err(TryLockError::Error(error)) => {
                log::warn!("{} cannot be locked: {error}", folder.display());
                Self { file: first.clone(), first, other: None, _lock: None }
            }
        }
    }

    /// Copies of the document that other windows kept.
    pub(super) fn copies(&self) -> Vec<PathBuf> {
        let Some(first) = self.first.as_ref().filter(|_| self.other.is_none()) else { return Vec::new() };
        let files = first.parent().and_then(|folder| fs::read_dir(folder).ok()).into_iter().flatten().flatten();
        let mut copies: Vec<PathBuf> = files.map(|file| file.path()).filter(|path| is_copy(path)).collect();
        copies.sort();
        copies
    }
}

fn lock(folder: &Path) -> Result<File, TryLockError> {
    fs::create_dir_all(folder).map_err(TryLockError::Error)?;
    let mut options = OpenOptions::new();
    let mut file = options
        .read(true)
        .write(true)
        .create(true)
        .truncate(false)
        .open(folder.join(LOCK))
        .map_err(TryLockError::Error)?;
    file.try_lock()?;
    let written = file.set_len(0).and_then(|()| write!(file, "{}", std::process::id()));
    if let Err(error) = written {
        log::warn!("the lock of {} does not name this process: {error}", folder.display());
    }
    Ok(file)
}

/// A name for a copy that no window has, nor had.
fn free_name(folder: &Path) -> PathBuf {
    use std::sync::atomic::{AtomicU32, Ordering};
    static COUNT: AtomicU32 = AtomicU32::new(1);
    loop {
        let number = COUNT.fetch_add(1, Ordering::Relaxed);
        let more = if number == 1 { String::new() } else { format!("-{number}") };
        let path = folder.join(format!("document-{}{more}.json", std::process::id()));
        if !path.exists() {
            return path;
        }
    }
}

fn is_copy(path: &Path) -> bool {
    let name = path.file_name().and_then(|name| name.to_str()).unwrap_or_default();
    let inner = name.strip_prefix("document-").and_then(|rest| rest.strip_suffix(".json"));
    inner.is_some_and(|inner| inner.starts_with(|c: char| c.is_ascii_digit()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_lock_of_a_window_that_ended_is_taken_over() {
        let folder = tempfile::tempdir().expect("a folder");
        let claim = || Profile::claim(Some(folder.path().to_owned()));
        // What a process left that was killed: a file, but no lock.
        fs::write(folder.path().join(LOCK), "4711").expect("written");
        let first = claim();
        assert_eq!(first.other, None);
        assert_eq!(fs::read_to_string(folder.path().join(LOCK)).ok(), Some(std::process::id().to_string()));
        let second = claim();
        assert_eq!(second.other, Some(OtherWindow { process: Some(std::process::id()) }));
        let third = claim();
        assert!(third.file != second.file && second.file != first.file);
        drop(first);
        assert_eq!(claim().other, None);
    }
}
