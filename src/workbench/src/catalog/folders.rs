//! Files in folders of any depth.

use std::collections::HashSet;
use std::path::{Path, PathBuf};
use std::{fs, io};

use super::import::companions;
use crate::format::{Tally, display_path, file_name};

/// Said of texts, pictures and the like.
pub const NO_SPECTRA: &str = "without readable spectra";

/// Files of a folder and of all folders within, in order of path, and what was skipped.
#[derive(Debug, Default)]
pub struct FolderFiles {
    pub files: Vec<PathBuf>,
    pub skipped: Tally,
    /// Folders that were read, without links: a link back to one of them leads in a circle.
    read: HashSet<PathBuf>,
}

impl FolderFiles {
    /// Searches a folder, until `go_on` is false. Fails only if the folder itself cannot be read.
    pub fn new(folder: &Path, go_on: &dyn Fn() -> bool) -> io::Result<Self> {
        let mut found = Self::default();
        found.search(folder, folder, go_on)?;
        leave_companions_out(&mut found.files, |file| Some(file.clone()), &mut found.skipped);
        Ok(found)
    }

    fn search(&mut self, folder: &Path, root: &Path, go_on: &dyn Fn() -> bool) -> io::Result<()> {
        let name = |path: &Path| display_path(path.strip_prefix(root).unwrap_or(path));
        if !self.read.insert(fs::canonicalize(folder)?) {
            self.skipped.add("reached again by a link", name(folder));
            return Ok(());
        }
        let mut paths = fs::read_dir(folder)?.map(|entry| Ok(entry?.path())).collect::<io::Result<Vec<_>>>()?;
        paths.sort();
        for path in paths.into_iter().take_while(|_| go_on()) {
            if path.file_name().is_some_and(|name| name.to_string_lossy().starts_with('.')) {
                self.skipped.add("hidden", name(&path));
            } else if path.is_dir() {
                if self.search(&path, root, go_on).is_err() {
                    self.skipped.add("unreadable", name(&path));
                }
            } else if path.is_file() {
                self.files.push(path);
            } else {
                self.skipped.add("no files", name(&path));
            }
        }
        Ok(())
    }
}

/// Removes files that belong to another of them: its metadata or its covariance.
pub fn leave_companions_out<T>(files: &mut Vec<T>, path: impl Fn(&T) -> Option<PathBuf>, skipped: &mut Tally) {
    let named = files.iter().filter_map(&path).filter(|file| file.file_name().is_some());
    let companions: HashSet<PathBuf> = named.flat_map(|file| companions(&file)).collect();
    for file in files.extract_if(.., |file| path(file).is_some_and(|path| companions.contains(&path))) {
        skipped.add("beside their tables", path(&file).as_deref().map(file_name).unwrap_or_default());
    }
}
