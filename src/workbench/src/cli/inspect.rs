//! `inspect`: contents of spectral files, their interpretation, and their curves as plain tables.

pub(super) mod arguments;
mod json;
mod out;
mod report;
mod samples;

use std::io::{self, IsTerminal as _, Read as _};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread;
use std::time::Duration;

use spectral_file::write::{Prepared, Sheet, Trace};
use spectral_file::{Certainty, Decided, ReadError, Role, SpectralFile};

use self::arguments::InspectArguments;
use self::out::Out;
use super::error::CliError;
use super::outputs::{Stop, put, show, stream};
use super::request::read;
use crate::catalog::import::Origin;
use crate::catalog::opened::files_of;
use crate::format::{io_failure, io_reason};
use crate::terminal::{say, shown_json};

/// Reason that a file could not be read or written.
#[derive(Clone)]
enum Failure {
    /// The system says no.
    Disk(String),
    /// The content is not recognized.
    Read(ReadError),
    /// Only sensitivities are responses to something.
    NoCamera(Role),
    /// The curves cannot be written as asked.
    Write(spectral_file::write::WriteError),
}

impl Failure {
    /// Reason without the file's name.
    fn reason(&self) -> String {
        match self {
            Self::Disk(reason) => reason.clone(),
            Self::Read(error) => error.to_string(),
            Self::NoCamera(role) => format!(
                "read as {role}, but --per applies to camera sensitivities; add --role \
                                             camera"
            ),
            Self::Write(error) => error.to_string(),
        }
    }

    /// One sentence: where, what, and what helps.
    fn sentence(&self, name: &str) -> String {
        match self {
            Self::Disk(_) | Self::Write(_) | Self::NoCamera(_) => format!("{name}: {}", self.reason()),
            Self::Read(error) => {
                let text = error.to_string();
                let line = error.line().map(|line| format!("line {line}"));
                let rest = line.as_ref().and_then(|line| Some((line, text.strip_prefix(line.as_str())?)));
                match rest {
                    Some((line, rest)) => format!("{name}, {line}{rest}"),
                    None => format!("{name}: {text}"),
                }
            }
        }
    }
}

/// Reads the files one by one and writes the requested output of each. A failed file does not stop the others.
pub(super) fn run(arguments: &InspectArguments) -> Result<(), CliError> {
    let (files, several) = files(&arguments.files)?;
    let out = Out::new(arguments, &files, several)?;
    let mut failures = Vec::new();
    if arguments.json && several {
        put("[\n", None)?;
    }
    for (index, file) in files.iter().enumerate() {
        let end = if several && index + 1 < files.len() { ",\n" } else { "\n" };
        if let Err(error) = answer(file, (index, end), &out, arguments)? {
            failures.push(error);
            if files.len() > 1
                && let Some(error) = failures.last()
            {
                say(&format!("chromascope: {error}\n"));
            }
        }
    }
    if arguments.json && several {
        put("]\n", None)?;
    }
    match failures.pop() {
        None => Ok(()),
        Some(only) if files.len() == 1 => Err(only),
        Some(_) => Err(CliError::Failed { failed: failures.len() + 1, count: files.len() }),
    }
}

/// Writes the requested output of a file. The outer error ends the whole run.
fn answer(
    file: &Path,
    (index, end): (usize, &str),
    out: &Out,
    arguments: &InspectArguments,
) -> Result<Result<(), CliError>, CliError> {
    let name = if is_standard_input(file) { "standard input".to_owned() } else { file.display().to_string() };
    let told = spectral_file::on_one_line(&name);
    let table = inspect(file, &name, arguments);
    let curves: Vec<Trace<'_>> = table.iter().flat_map(|table| &table.curves).map(Trace::from).collect();
    let wanted = arguments.csv.is_some() || arguments.step.is_some();
    let prepared = table.as_ref().map_err(Clone::clone).and_then(|table| {
        let sheet = Sheet { content: samples::content(table), curves: &curves, ..Sheet::default() };
        let prepared = wanted.then(|| Prepared::new(&sheet, arguments.grid())).transpose().map_err(Failure::Write)?;
        Ok((table, prepared))
    });
    let (table, mut prepared) = match prepared {
        Ok(prepared) => prepared,
        Err(failure) => {
            if arguments.json {
                put(&shown_json(&format!("{}{end}", json::failure(&name, &failure))), None)?;
            }
            return Ok(Err(CliError::File(failure.sentence(&told))));
        }
    };
    if arguments.json {
        stream(None, |out| {
            json::write(out, &name, table, prepared.as_mut())?;
            Ok(out.write_all(end.as_bytes())?)
        })?;
    } else {
        let notes = prepared.as_mut().map_or_else(Vec::new, samples::notes);
        let gap = if index > 0 { "\n" } else { "" };
        let text = format!("{gap}{}", report::of(&told, table, &notes));
        if out.is_standard_output() { say(&text) } else { show(&text)? }
    }
    if let Some(question) = question(table) {
        say(&format!("chromascope: {told}: {question}\n"));
    }
    Ok(match (&mut prepared, out.place(index)) {
        (Some(prepared), Some(place)) => stream(Some(place), |out| samples::write(prepared, out)),
        _ => Ok(()),
    })
}

fn inspect(file: &Path, name: &str, arguments: &InspectArguments) -> Result<SpectralFile, Failure> {
    let bytes = contents(file).map_err(|error| Failure::Disk(io_reason(&error)))?;
    let origin = Origin::on_disk(name, file, &bytes);
    let mut table = spectral_file::read(origin.source(&bytes), &arguments.options()).map_err(Failure::Read)?;
    name_the_only_curve(&mut table, name);
    if let Some(per_photon) = arguments.per_photon() {
        respond(&mut table, per_photon)?;
    }
    Ok(table)
}

/// Reflectances pass one by noise and fluorescence.
const LARGEST_FRACTION: f64 = 1.2;

/// Open question of a table, with the options that decide it.
fn question(table: &SpectralFile) -> Option<String> {
    let (role, values) = (&table.role, &table.reading.values);
    if role.certainty == Certainty::Open {
        let large = table.curves.iter().flat_map(|curve| &curve.values).any(|value| *value > LARGEST_FRACTION);
        let remedy = if large {
            "add --role reflectance --values percent, --role illuminant or --role unknown"
        } else {
            "add --role reflectance, --role transmittance, --role illuminant, --role camera or --role unknown"
        };
        return Some(format!("{}; {remedy}", role.why));
    }
    (values.certainty == Certainty::Open).then(|| format!("{}; add --values percent or --values plain", values.why))
}

/// Takes sensitivities as responses per photon or per energy, whatever the file says.
fn respond(table: &mut SpectralFile, per_photon: bool) -> Result<(), Failure> {
    if table.role.value != Role::Camera {
        return Err(Failure::NoCamera(table.role.value));
    }
    let why = "Set by --per".to_owned();
    table.reading.per_photon = Some(Decided { value: per_photon, certainty: Certainty::Chosen, why });
    Ok(())
}

/// The name that means no file.
const STANDARD_INPUT: &str = "-";

fn contents(file: &Path) -> io::Result<Vec<u8>> {
    if !is_standard_input(file) {
        return read(file);
    }
    let done = Arc::new(AtomicBool::new(false));
    if io::stdin().is_terminal() {
        say("Type or paste the data; Ctrl+D ends the input.\n");
    } else {
        let patience = || thread::sleep(PATIENCE);
        let done = Arc::clone(&done);
        // Without a thread it waits without a word.
        let _silent = thread::Builder::new()
            .name("patience".to_owned())
            .spawn(move || say_if_waiting(patience, || done.load(Ordering::Relaxed), say));
    }
    let mut bytes = Vec::new();
    let read = io::stdin().lock().take(spectral_file::MAX_BYTES as u64 + 1).read_to_end(&mut bytes);
    done.store(true, Ordering::Relaxed);
    read?;
    Ok(bytes)
}

fn is_standard_input(file: &Path) -> bool {
    [STANDARD_INPUT, "/dev/stdin", "/dev/fd/0", "/proc/self/fd/0"].iter().any(|name| file == Path::new(name))
}

/// Time without an end of standard input after which a notice says what is waited for.
const PATIENCE: Duration = Duration::from_secs(2);

/// Writes a notice if, once `patience` returns, standard input has not ended: it may have been left unredirected by mistake.
fn say_if_waiting(patience: impl FnOnce(), has_ended: impl FnOnce() -> bool, say: impl FnOnce(&str)) {
    patience();
    if !has_ended() {
        say("chromascope: waiting for standard input to end; Ctrl+C stops.\n");
    }
}

/// A title, or the file's name, says more about a curve than "Column 2" does.
fn name_the_only_curve(table: &mut SpectralFile, file: &str) {
    let title = table.reading.comment("title").map(str::trim).filter(|title| !title.is_empty()).map(str::to_owned);
    if let [curve] = table.curves.as_mut_slice()
        && !curve.named
    {
        let stem = || Path::new(file).file_stem().map_or_else(|| file.to_owned(), |s| s.to_string_lossy().into_owned());
        curve.name = spectral_file::on_one_line(&title.unwrap_or_else(stem)).into_owned();
    }
}

/// The files that are meant, and whether there may be several: folders become what is in them, in order of name.
fn files(named: &[PathBuf]) -> Result<(Vec<PathBuf>, bool), CliError> {
    let mut files = Vec::new();
    let mut several = named.len() > 1;
    for path in named {
        if !path.is_dir() {
            files.push(path.clone());
            continue;
        }
        several = true;
        let within = files_of(path).map_err(|error| CliError::File(io_failure(path, &error)))?;
        if within.is_empty() {
            return Err(CliError::File(format!("{}: no files in it", path.display())));
        }
        files.extend(within);
    }
    Ok((files, several))
}

#[cfg(test)]
mod tests {
    use std::cell::{Cell, RefCell};

    use super::*;

    /// The notice after waiting, if standard input ends while it is waited, or later.
    fn notice(ends_meanwhile: bool) -> String {
        let (ended, said) = (Cell::new(false), RefCell::new(String::new()));
        say_if_waiting(|| ended.set(ends_meanwhile), || ended.get(), |text| said.borrow_mut().push_str(text));
        said.into_inner()
    }

    #[test]
    fn a_notice_comes_only_while_standard_input_is_open() {
        assert_eq!(notice(false), "chromascope: waiting for standard input to end; Ctrl+C stops.\n");
        assert_eq!(notice(true), "");
    }
}
