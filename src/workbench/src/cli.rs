//! Command-line interface: `locus`, `patches`, `compare`, `matrix`, `light`, `figure`, `report`, `render`, `identify`, `inspect`, `bench`, `list`.
//!
//! Arguments become a [`Document`](crate::document::Document), which is evaluated through [`Scene`](crate::scene::Scene), as in
//! the window, so that the two cannot disagree. Nothing here needs a display or a graphics library.

mod arguments;
mod bench;
mod checks;
mod compare;
mod error;
mod figure;
mod fit;
mod identify;
mod inspect;
mod light;
mod matrix;
mod outputs;
mod per;
mod pixel;
mod radiance;
mod render;
mod report;
mod request;
mod settings;
mod sources;
mod tables;

use std::ffi::OsString;
use std::path::{Path, PathBuf};

use clap::{CommandFactory as _, FromArgMatches as _};

use arguments::{Arguments, Subcommand};
use outputs::{put, show};

pub use self::tables::list;
use crate::catalog::Catalog;
pub use crate::terminal::say;

/// Action requested by the command line.
pub enum Outcome {
    /// A window with these files.
    Window(Vec<PathBuf>),
    /// It is done; end with this code.
    Done(u8),
}

/// Reads the arguments; runs a command if they name one.
pub fn run(arguments: impl IntoIterator<Item = OsString>) -> Outcome {
    let arguments: Vec<OsString> = arguments.into_iter().collect();
    let matches = match Arguments::command().try_get_matches_from(&arguments) {
        Ok(matches) => matches,
        Err(error) => {
            // Help was asked of a command that does not exist.
            let word = arguments.get(1).filter(|_| error.kind() == clap::error::ErrorKind::DisplayHelp);
            let is_command = |word: &OsString| Arguments::command().find_subcommand(word).is_some();
            let word =
                word.filter(|word| !word.to_string_lossy().starts_with('-') && *word != "help" && !is_command(word));
            return Outcome::Done(match word.filter(|word| is_mistyped_command(Path::new(word))) {
                Some(word) => unknown_command(Path::new(word)),
                None => explain(&error),
            });
        }
    };
    let parsed = match Arguments::from_arg_matches(&matches) {
        Ok(parsed) => parsed,
        Err(error) => return Outcome::Done(explain(&error)),
    };
    let (Some(subcommand), Some((_, matches))) = (parsed.subcommand, matches.subcommand()) else {
        if let Some(word) = parsed.files.iter().find(|file| is_mistyped_command(file)) {
            return Outcome::Done(unknown_command(word));
        }
        return Outcome::Window(parsed.session.into_iter().chain(parsed.files).collect());
    };
    let result = match subcommand {
        Subcommand::Locus(arguments) => tables::locus(&arguments, matches),
        Subcommand::Patches(arguments) => {
            tables::patches(&arguments, matches).and_then(|text| put(&text, arguments.common.out.as_deref()))
        }
        Subcommand::Compare(arguments) => compare::run(&arguments, matches),
        Subcommand::Matrix(arguments) => matrix::run(&arguments),
        Subcommand::Render(arguments) => render::run(&arguments, matches),
        Subcommand::Figure(arguments) => figure::run(&arguments, matches),
        Subcommand::Report(arguments) => report::run(&arguments),
        Subcommand::Light(arguments) => light::run(&arguments, matches),
        Subcommand::Identify(arguments) => identify::run(&arguments),
        Subcommand::Inspect(arguments) => inspect::run(&arguments),
        Subcommand::Bench(arguments) => bench::run(&arguments),
        Subcommand::List { kind } => show(&list(&Catalog::built_in(), kind)),
    };
    Outcome::Done(match result {
        Ok(()) => 0,
        Err(error) => {
            say(&format!("chromascope: {error}\n"));
            error.code()
        }
    })
}

/// Refuses a word that is no command.
fn unknown_command(word: &Path) -> u8 {
    say(&format!("chromascope: {}: no such command or file; see chromascope --help\n", word.display()));
    2
}

/// True if an argument in the place of a file is a bare word and no such file exists: a mistyped command.
fn is_mistyped_command(file: &Path) -> bool {
    file.components().count() == 1 && file.extension().is_none() && !file.exists()
}

/// Prints help, the version or a complaint about the arguments where it belongs.
fn explain(error: &clap::Error) -> u8 {
    let text = error.render().to_string();
    if error.use_stderr() {
        say(&text);
    } else {
        // No message can be written once the terminal is closed.
        let _gone = show(&text);
    }
    u8::try_from(error.exit_code()).unwrap_or(2)
}
