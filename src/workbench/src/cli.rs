//! Command-line interface: a command is a file here and an entry of `commands`.
//!
//! Arguments become a [`Document`](crate::document::Document), which is evaluated through [`Scene`](crate::scene::Scene), as in
//! the window, so that the two cannot disagree. Nothing here needs a display or a graphics library.

mod arguments;
mod bench;
mod compare;
mod error;
mod figure;
mod identify;
mod inspect;
mod light;
mod list;
mod locus;
mod matrix;
mod outputs;
mod patches;
mod reading;
mod recover;
mod render;
mod report;
mod request;
mod settings;

use std::ffi::OsString;
use std::path::{Path, PathBuf};

use clap::{ArgMatches, CommandFactory as _, FromArgMatches as _, Parser};

use error::Result;
use outputs::show;

pub use self::list::list;
pub use self::request::by_formula;
pub use crate::terminal::say;

/// Commands: each with its arguments, whose doc comment is its line in the help, and the function that runs it.
macro_rules! commands {
    ($($name:ident($arguments:path) => $run:path,)*) => {
        #[derive(Debug, clap::Subcommand)]
        enum Command {
            $($name(Box<$arguments>),)*
        }

        impl Command {
            fn run(&self, matches: &ArgMatches) -> Result<()> {
                match self {
                    $(Self::$name(arguments) => $run(arguments, matches),)*
                }
            }
        }
    };
}

commands! {
    Locus(locus::LocusArguments) => locus::run,
    Patches(patches::PatchesArguments) => patches::run,
    Compare(compare::CompareArguments) => compare::run,
    Light(light::LightArguments) => light::run,
    Matrix(matrix::MatrixArguments) => matrix::run,
    Figure(figure::arguments::FigureArguments) => figure::run,
    Report(report::ReportArguments) => report::run,
    Render(render::arguments::RenderArguments) => render::run,
    Identify(identify::IdentifyArguments) => identify::run,
    Recover(recover::RecoverArguments) => recover::run,
    Inspect(inspect::InspectArguments) => inspect::run,
    Bench(bench::BenchArguments) => bench::run,
    List(list::ListArguments) => list::run,
}

/// See, measure and explain how digital cameras render color, from spectra.
///
/// Without a command, opens the window with the given files.
#[derive(Debug, Parser)]
#[command(name = "chromascope", version, args_conflicts_with_subcommands = true, after_help = EXAMPLES)]
struct Arguments {
    /// A session (.chromascope), spectra or camera sensitivities to open in the window
    #[arg(value_name = "FILE")]
    files: Vec<PathBuf>,
    /// A session to open in the window
    #[arg(long, value_name = "FILE")]
    session: Option<PathBuf>,
    /// A computation without a window
    #[command(subcommand)]
    command: Option<Command>,
}

const EXAMPLES: &str = "Examples:
  chromascope leaf.csv
  chromascope locus --camera \"Nikon D70\" --observer \"CIE 1931 2°\" --temperatures 2856,5500,6504
  chromascope patches --camera \"Canon EOS 10D\" --illuminant D55 --out patches.csv
  chromascope compare --illuminant A --sort metamerism-index
  chromascope matrix \"Nikon D850\" --illuminant A --second-illuminant D65 --format dcp --out d850.dcp
  chromascope render --mesh head --camera \"Nikon D70\" --out pictures
  chromascope inspect measured.txt --csv measured.csv
  chromascope report --out report
  chromascope list cameras

Names are those of `chromascope list`. Case, punctuation and words such as CIE, illuminant, standard and observer are ignored; whole
words, or any unambiguous part of one, match. A match that is not exact is reported on standard error.
No command overwrites a file that it reads, or any other file without --force.";

pub enum Outcome {
    Window(Vec<PathBuf>),
    /// It is done; end with this code.
    Done(u8),
}

pub fn run(arguments: impl IntoIterator<Item = OsString>) -> Outcome {
    let arguments: Vec<OsString> = arguments.into_iter().collect();
    let matches = match command().try_get_matches_from(&arguments) {
        Ok(matches) => matches,
        Err(error) => {
            // Help was asked of a command that does not exist.
            let word = arguments.get(1).filter(|_| error.kind() == clap::error::ErrorKind::DisplayHelp);
            let is_command = |word: &OsString| command().find_subcommand(word).is_some();
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
    let (Some(command), Some((_, matches))) = (parsed.command, matches.subcommand()) else {
        if let Some(word) = parsed.files.iter().find(|file| is_mistyped_command(file)) {
            return Outcome::Done(unknown_command(word));
        }
        return Outcome::Window(parsed.session.into_iter().chain(parsed.files).collect());
    };
    Outcome::Done(match command.run(matches) {
        Ok(()) => 0,
        Err(error) => {
            say(&format!("chromascope: {error}\n"));
            error.code()
        }
    })
}

/// The command line. One `--camera` takes several values, as shells make them of `*.csv`, where no other file can follow.
pub fn command() -> clap::Command {
    let is_camera = |argument: &clap::Arg| argument.get_id() == "camera" && argument.get_long().is_some();
    Arguments::command().mut_subcommands(|command| {
        let takes_several = command.get_positionals().next().is_none() && command.get_arguments().any(is_camera);
        if takes_several { command.mut_arg("camera", |camera| camera.num_args(1..)) } else { command }
    })
}

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
