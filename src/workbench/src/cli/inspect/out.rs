//! Destinations of the tables.

use std::collections::HashSet;
use std::fs;
use std::path::{Path, PathBuf};

use super::arguments::InspectArguments;
use super::is_standard_input;
use crate::atomic::fitting;
use crate::cli::error::CliError;
use crate::cli::outputs::{self, is_standard_output};

/// Destination of the files' tables.
pub(super) enum Out {
    Nowhere,
    StandardOutput,
    /// A file for each file that is read, in the same order.
    Files(Vec<PathBuf>),
}

impl Out {
    /// Writes the tables as requested; a missing folder is created. Nothing is created or written if one of the tables
    /// may not be.
    pub(super) fn new(arguments: &InspectArguments, files: &[PathBuf], several: bool) -> Result<Self, CliError> {
        let wrong = |reason: &str| Err(CliError::Argument { argument: "--csv", reason: reason.to_owned() });
        let Some(path) = arguments.csv.as_deref() else { return Ok(Self::Nowhere) };
        if is_standard_output(path) {
            return match (arguments.json, several) {
                (true, _) => wrong("JSON goes to standard output already; name a file"),
                (_, true) => wrong("several tables cannot be written to one file; name a folder"),
                _ => Ok(Self::StandardOutput),
            };
        }
        let folder = several || path.is_dir();
        if folder && path.exists() && !path.is_dir() {
            return wrong(&format!("{} is a file; several files need a folder", path.display()));
        }
        let mut taken = HashSet::new();
        let tables: Vec<PathBuf> = if folder {
            files.iter().map(|file| path.join(free_name(file, &mut taken))).collect()
        } else {
            vec![path.to_owned()]
        };
        outputs::check(tables.iter().map(PathBuf::as_path), &inputs(files), arguments.force)?;
        if folder {
            fs::create_dir_all(path).map_err(|error| CliError::Output { path: path.to_owned(), error })?;
        }
        Ok(Self::Files(tables))
    }

    /// True if tables go where reports go else.
    pub(super) fn is_standard_output(&self) -> bool {
        matches!(self, Self::StandardOutput)
    }

    /// Destination of the table of the file with this index, if any; `-` for standard output.
    pub(super) fn place(&self, index: usize) -> Option<&Path> {
        match self {
            Self::Nowhere => None,
            Self::StandardOutput => Some(Path::new("-")),
            Self::Files(paths) => paths.get(index).map(PathBuf::as_path),
        }
    }
}

/// Files that are read; standard input too, which may be redirected from a file.
fn inputs(files: &[PathBuf]) -> Vec<PathBuf> {
    let place = |file: &PathBuf| if is_standard_input(file) { PathBuf::from("/dev/stdin") } else { file.clone() };
    files.iter().map(place).collect()
}

/// The file's name with another ending, and a number where another file has that name already.
fn free_name(source: &Path, taken: &mut HashSet<String>) -> String {
    let stem = source.file_stem().map_or_else(String::new, |stem| stem.to_string_lossy().into_owned());
    let stem = if stem.is_empty() || stem == "-" { "table".to_owned() } else { stem };
    let mut name = fitting(&stem, ".csv");
    let mut number = 2;
    // Some file systems do not distinguish `A.csv` from `a.csv`.
    while !taken.insert(name.to_lowercase()) {
        name = fitting(&stem, &format!("-{number}.csv"));
        number += 1;
    }
    name
}
