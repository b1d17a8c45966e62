//! The same answers without a window: `locus`, `patches`, `render`, `inspect`, `bench`, `list`.
//!
//! Arguments become a [`Document`](crate::document::Document) and are answered through [`Scene`](crate::scene::Scene), as in the
//! window, so that the two cannot disagree. Nothing here needs a display or a graphics library.

mod arguments;
mod bench;
mod inspect;
mod render;
mod request;
mod tables;

use std::ffi::OsString;
use std::fs;
use std::io::{self, Write as _};
use std::path::{Path, PathBuf};

use clap::{CommandFactory as _, FromArgMatches as _};

use arguments::{Arguments, Subcommand};
use chromascope_core::camera::NoRendering;

use crate::scene::SceneError;

/// What the command line asks for.
pub enum Outcome {
    /// A window with these files.
    Window(Vec<PathBuf>),
    /// It is done; end with this code.
    Done(u8),
}

/// Why a command failed.
#[derive(Debug, thiserror::Error)]
pub enum CliError {
    /// A name means no set.
    #[error(transparent)]
    Name(#[from] crate::catalog::names::NameError),
    /// A file could not be read.
    #[error("{}", .0)]
    File(String),
    /// Some of several files failed; each was told of.
    #[error("{failed} of {count} files failed")]
    Failed {
        /// How many.
        failed: usize,
        /// Of how many.
        count: usize,
    },
    /// The scene cannot be computed.
    #[error(transparent)]
    Scene(SceneError),
    /// Cone fundamentals on the paper's way.
    #[error("{0}: Eq 13 takes RGB, not cone signals; add --transform observer")]
    Cones(String),
    /// An argument that means nothing.
    #[error("{argument}: {reason}")]
    Argument {
        /// Which.
        argument: &'static str,
        /// Why, with what would do.
        reason: String,
    },
    /// A picture could not be made into a file.
    #[error("{}: {error}", path.display())]
    Picture {
        /// Which.
        path: PathBuf,
        /// Why.
        error: crate::export::render::PictureError,
    },
    /// Nothing can be measured.
    #[error(transparent)]
    Bench(#[from] crate::bench::BenchError),
    /// What was measured cannot be written down.
    #[error(transparent)]
    Report(#[from] crate::bench::ReportError),
    /// A figure cannot be drawn.
    #[error(transparent)]
    Figure(#[from] crate::export::ExportError),
    /// The output could not be written.
    #[error("cannot write {}: {}", path.display(), crate::files::reason(error))]
    Output {
        /// Where.
        path: PathBuf,
        /// Why.
        error: io::Error,
    },
}

impl CliError {
    /// 2 where the arguments themselves are wrong, as for those that clap refuses; 1 where data, names or disk say no.
    fn code(&self) -> u8 {
        if matches!(self, Self::Argument { .. }) { 2 } else { 1 }
    }
}

impl From<SceneError> for CliError {
    /// The scene's remedies are the window's; the one that is called otherwise here is put in this one's words.
    fn from(error: SceneError) -> Self {
        match error {
            SceneError::Rendering { name, error: NoRendering::ConesNeedObserver } => Self::Cones(name),
            other => Self::Scene(other),
        }
    }
}

/// Reads the arguments; runs a command if they name one.
pub fn run(arguments: impl IntoIterator<Item = OsString>) -> Outcome {
    let matches = match Arguments::command().try_get_matches_from(arguments) {
        Ok(matches) => matches,
        Err(error) => return Outcome::Done(explain(&error)),
    };
    let parsed = match Arguments::from_arg_matches(&matches) {
        Ok(parsed) => parsed,
        Err(error) => return Outcome::Done(explain(&error)),
    };
    let (Some(subcommand), Some((_, matches))) = (parsed.subcommand, matches.subcommand()) else {
        return Outcome::Window(parsed.files);
    };
    let result = match subcommand {
        Subcommand::Locus(arguments) => {
            tables::locus(&arguments, matches).and_then(|text| put(&text, arguments.common.out.as_deref()))
        }
        Subcommand::Patches(arguments) => {
            tables::patches(&arguments, matches).and_then(|text| put(&text, arguments.common.out.as_deref()))
        }
        Subcommand::Render(arguments) => render::run(&arguments, matches),
        Subcommand::Inspect(arguments) => inspect::run(&arguments),
        Subcommand::Bench(arguments) => bench::run(&arguments),
        Subcommand::List { kind } => put(&tables::list(kind), None),
    };
    Outcome::Done(match result {
        Ok(()) => 0,
        Err(error) => {
            say(&format!("chromascope: {error}\n"));
            error.code()
        }
    })
}

/// Prints help, the version or a complaint about the arguments where it belongs.
fn explain(error: &clap::Error) -> u8 {
    // Nothing can be said when the terminal is gone.
    let _gone = error.print();
    u8::try_from(error.exit_code()).unwrap_or(2)
}

/// Says something on standard error.
pub fn say(text: &str) {
    let _gone = io::stderr().lock().write_all(text.as_bytes());
}

/// Writes a table to a file, whole or not at all, or to standard output.
fn put(text: &str, out: Option<&Path>) -> Result<(), CliError> {
    let path = out.filter(|path| *path != Path::new("-"));
    match path.map_or_else(|| print(text), |path| write_to(path, text.as_bytes())) {
        // Whoever read it has seen enough, as `head` does.
        Err(error) if error.kind() == io::ErrorKind::BrokenPipe => Ok(()),
        Err(error) => Err(CliError::Output { path: path.unwrap_or(Path::new("standard output")).to_owned(), error }),
        Ok(()) => Ok(()),
    }
}

fn print(text: &str) -> io::Result<()> {
    let mut stdout = io::stdout().lock();
    stdout.write_all(text.as_bytes())?;
    stdout.flush()
}

/// A file is replaced whole, behind a link if it is one; what is no file, such as a pipe or `/dev/null`, is written into.
fn write_to(path: &Path, bytes: &[u8]) -> io::Result<()> {
    match fs::metadata(path) {
        Ok(known) if known.is_file() => crate::files::write_atomically(&fs::canonicalize(path)?, bytes),
        Ok(known) if !known.is_dir() => fs::OpenOptions::new().write(true).open(path)?.write_all(bytes),
        _ => crate::files::write_atomically(path, bytes),
    }
}
