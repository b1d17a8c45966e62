//! The same answers without a window: `locus`, `patches`, `render`, `inspect`, `bench`, `list`.
//!
//! Arguments become a [`Document`](crate::document::Document) and are answered through [`Scene`](crate::scene::Scene), as in the
//! window, so that the two cannot disagree. Nothing here needs a display or a graphics library.

mod arguments;
mod bench;
mod checks;
mod inspect;
mod outputs;
mod radiance;
mod render;
mod request;
mod tables;

use std::ffi::OsString;
use std::io;
use std::path::{Path, PathBuf};

use clap::{CommandFactory as _, FromArgMatches as _};

use arguments::{Arguments, Subcommand};
use chromascope_core::camera::RenderingError;
use outputs::{put, show};

use crate::scene::SceneError;
pub use crate::terminal::say;

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
    /// Cone fundamentals with the paper's matrix.
    #[error("{0}: Eq 13 takes RGB, not cone signals; add --transform fitted")]
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
    /// An output that is an input.
    #[error("{}: not overwritten because this command reads it; name another file", .0.display())]
    Input(PathBuf),
    /// An output that exists.
    #[error("{}: the file exists; name another, or add --force to replace it", .0.display())]
    Exists(PathBuf),
    /// One file for two outputs.
    #[error("{}: two outputs cannot go to one file; name another", .0.display())]
    Twice(PathBuf),
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
            SceneError::Rendering { name, error: RenderingError::ConesNeedObserver } => Self::Cones(name),
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
        if let Some(word) = parsed.files.iter().find(|file| is_mistyped_command(file)) {
            say(&format!("chromascope: {}: no such command or file; see chromascope --help\n", word.display()));
            return Outcome::Done(2);
        }
        return Outcome::Window(parsed.files);
    };
    let result = match subcommand {
        Subcommand::Locus(arguments) => tables::locus(&arguments, matches),
        Subcommand::Patches(arguments) => {
            tables::patches(&arguments, matches).and_then(|text| put(&text, arguments.common.out.as_deref()))
        }
        Subcommand::Render(arguments) => render::run(&arguments, matches),
        Subcommand::Inspect(arguments) => inspect::run(&arguments),
        Subcommand::Bench(arguments) => bench::run(&arguments),
        Subcommand::List { kind } => show(&tables::list(kind)),
    };
    Outcome::Done(match result {
        Ok(()) => 0,
        Err(error) => {
            say(&format!("chromascope: {error}\n"));
            error.code()
        }
    })
}

/// Whether what stands for a file is a bare word that no file has: a command that was mistyped.
fn is_mistyped_command(file: &Path) -> bool {
    file.components().count() == 1 && file.extension().is_none() && !file.exists()
}

/// Prints help, the version or a complaint about the arguments where it belongs.
fn explain(error: &clap::Error) -> u8 {
    let text = error.render().to_string();
    if error.use_stderr() {
        say(&text);
    } else {
        // Nothing can be said when the terminal is gone.
        let _gone = show(&text);
    }
    u8::try_from(error.exit_code()).unwrap_or(2)
}
