//! Where the tables go.

use std::collections::HashSet;
use std::fs;
use std::path::{Path, PathBuf};

use super::arguments::InspectArguments;
use crate::cli::{CliError, put};

/// Where the tables of files go.
pub(super) struct Out {
    place: Place,
    /// What is being read, which no table may replace.
    sources: Vec<PathBuf>,
}

enum Place {
    Nowhere,
    StandardOutput,
    File(PathBuf),
    Folder { path: PathBuf, taken: HashSet<String> },
}

impl Out {
    /// As asked for; a folder is made if there is none.
    pub(super) fn new(arguments: &InspectArguments, files: &[String], several: bool) -> Result<Self, CliError> {
        let wrong = |reason: &str| Err(CliError::Argument { argument: "--csv", reason: reason.to_owned() });
        let place = match arguments.csv.as_deref() {
            None => Place::Nowhere,
            Some(path) if path == Path::new("-") && arguments.json => {
                return wrong("JSON goes to standard output already; name a file");
            }
            Some(path) if path == Path::new("-") && several => {
                return wrong("several tables make no table; name a folder");
            }
            Some(path) if path == Path::new("-") => Place::StandardOutput,
            Some(path) if path.is_dir() => Place::Folder { path: path.to_owned(), taken: HashSet::new() },
            Some(path) if several => {
                if path.exists() {
                    return wrong(&format!("{} is a file; several files need a folder", path.display()));
                }
                fs::create_dir_all(path).map_err(|error| CliError::Output { path: path.to_owned(), error })?;
                Place::Folder { path: path.to_owned(), taken: HashSet::new() }
            }
            Some(path) => Place::File(path.to_owned()),
        };
        let sources = files.iter().filter_map(|file| fs::canonicalize(file).ok()).collect();
        Ok(Self { place, sources })
    }

    /// Whether tables go where reports go else.
    pub(super) fn is_standard_output(&self) -> bool {
        matches!(self.place, Place::StandardOutput)
    }

    /// Writes a file's table.
    pub(super) fn take(&mut self, source: &str, text: &str) -> Result<(), CliError> {
        let path = match &mut self.place {
            Place::Nowhere => return Ok(()),
            Place::StandardOutput => return put(text, None),
            Place::File(path) => path.clone(),
            Place::Folder { path, taken } => path.join(free_name(source, taken)),
        };
        // A shell's `*` and a folder that is its own OUT would else put tables in the place of measurements.
        if fs::canonicalize(&path).is_ok_and(|path| self.sources.contains(&path)) {
            let path = path.display();
            return Err(CliError::File(format!("{path}: a file that is read is not written over; name another OUT")));
        }
        put(text, Some(&path))
    }
}

/// The file's name with another ending, and a number where another file has that name already.
fn free_name(source: &str, taken: &mut HashSet<String>) -> String {
    let stem = Path::new(source).file_stem().map_or_else(String::new, |stem| stem.to_string_lossy().into_owned());
    let stem = if stem.is_empty() || stem == "-" { "table".to_owned() } else { stem };
    let mut name = format!("{stem}.csv");
    let mut number = 2;
    // Some systems do not tell `A.csv` from `a.csv`.
    while !taken.insert(name.to_lowercase()) {
        name = format!("{stem}-{number}.csv");
        number += 1;
    }
    name
}
