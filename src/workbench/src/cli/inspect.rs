//! `inspect`: contents of spectral files, their interpretation, and their curves as plain tables.

mod output;
pub(super) mod written;

use std::collections::HashSet;
use std::fs;
use std::io::{self, IsTerminal as _, Read as _};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread;
use std::time::Duration;

use chromascope_measure::harness::now;
use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use clap::{ArgMatches, Args};
use serde::Deserialize as _;
use serde::de::IntoDeserializer as _;
use serde::de::value::{Error, StrDeserializer};
use spectral_file::write::{Format, Grid, Prepared, Trace, write};
use spectral_file::{
    Certainty, Decided, DecimalMark, Delimiter, Orientation, ReadError, ReadOptions, Reader, Role, SpectralFile,
    Values, WavelengthUnit,
};

use super::arguments::{named, values};
use super::error::{CliError, Result, refused};
use super::outputs::{self, is_standard_output, put, show, stream};
use super::reading::read;
use crate::atomic::{fitting, paths_beside};
use crate::catalog::folders::{FolderFiles, NO_SPECTRA, leave_companions_out};
use crate::catalog::import::Origin;
use crate::format::{Tally, display_path, file_name, io_failure, io_reason};
use crate::hosted;
use crate::terminal::{Remarks, say, shown_json};

const EXAMPLES: &str = "Examples:
  chromascope inspect leaf.txt
  chromascope inspect leaf.txt --values percent --csv leaf.csv
  chromascope inspect measured/ --step 5 --csv tables
  chromascope inspect lamp.txt --step 5 --average --csv -
  chromascope inspect lamp.spdx --csv - | head
  chromascope inspect camera.txt --format rawtoaces --out camera.json
  chromascope inspect charts/ --format sp --out argyll
  chromascope inspect *.sp --json | jq '.[].kind'

Reports the decisions made for each file, one line each: value, confidence (certain, a guess, chosen) and reason. An option of the
same name overrides a decision. A folder stands for the files in it at any depth, `-` for standard input; named pipes are not supported.

--csv writes `wavelength_nm,<curve> [<quantity> in <unit>],...`: nanometers, reflectances and transmittances as fractions, a cell left blank where a
curve has no sample. Behind a curve whose file states its uncertainty stands `<curve> [expanded uncertainty (k=2) in <unit>]`; the
covariance of a file goes into NAME.cov.csv beside. Other formats have no place for either. With `--csv -` the table goes to standard output and the report to standard error. OUT is a
folder where several files or a folder are named.

--out writes a file in a --format, all of which the window has too: csv, which has the same table and, in a file beside it whose name goes on
with `-metadata.json` (W3C, CSV on the Web), title, source, license and other notes, which are read back; rawtoaces and dcamprof JSON;
sp and cmf of Argyll; cgats. What is not in it as it was read is said on standard error.

--json prints an object for a file, an array for several: file, kind (camera, reflectance, transmittance, illuminant, unknown),
curves [{name, unit, quantity, wavelengths_nm, values, standard_uncertainty, coverage_factor, missing}], channels [red, green, blue] as places in curves from 0,
decisions [{what, value, certainty, why}], warnings [{line, text}], reading {...}, notes on resampling; or file and error
{line, column, text}. Lines and columns count from 1.

A file that cannot be read is reported on standard error; the others are still read, and the exit code is 1. Of several files, those
that hold no spectra, hidden ones, and metadata and covariance beside a table are skipped and counted in one line.";

/// Contents of files of spectra and the decisions made when reading them; curves as CSV or JSON
#[allow(clippy::struct_excessive_bools, reason = "each is a flag of the command line")]
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(super) struct InspectArguments {
    /// Files with spectra, or folders of them
    #[arg(value_name = "FILE", required = true)]
    files: Vec<PathBuf>,
    /// Prints all that was read as JSON, curves included
    #[arg(long)]
    json: bool,
    /// Writes the curves as CSV: a file, a folder for several files, or `-` for standard output
    #[arg(long, value_name = "OUT")]
    csv: Option<PathBuf>,
    /// Writes the curves in a format, with what is known about them: a file, a folder for several files, or `-` for standard output
    #[arg(long, value_name = "OUT", conflicts_with = "csv")]
    out: Option<PathBuf>,
    /// Format of the file that --out names
    #[arg(long, value_name = "FORMAT", requires = "out", value_parser = written::format(), default_value = "csv")]
    format: Format,
    /// Writes title, source, license and other notes of a CSV table above it, as comments
    #[arg(long)]
    notes: bool,
    /// Overwrites existing files named by --csv or --out, but never an input file
    #[arg(long)]
    force: bool,
    /// Resamples the curves to whole multiples of a step in nanometers
    #[arg(long, value_name = "NM", value_parser = step)]
    step: Option<f64>,
    /// With --step, averages the curves over bands of that width around each wavelength, which preserves the energy of
    /// narrow lines, instead of sampling them
    #[arg(long, requires = "step")]
    average: bool,
    /// Role of the curves
    #[arg(long, value_name = "ROLE", value_parser = named::<Role>(ROLES), help_heading = READING)]
    role: Option<Role>,
    /// Scale of the values as written
    #[arg(long, value_name = "VALUES", value_parser = values(), help_heading = READING)]
    values: Option<Values>,
    /// Unit of the wavelengths as written
    #[arg(long, value_name = "UNIT", value_parser = unit(), help_heading = READING)]
    unit: Option<WavelengthUnit>,
    /// Delimiter between cells
    #[arg(long, value_name = "DELIMITER", value_parser = named::<Delimiter>(DELIMITERS), help_heading = READING)]
    delimiter: Option<Delimiter>,
    /// Decimal mark
    #[arg(long, value_name = "MARK", value_parser = named::<DecimalMark>(MARKS), help_heading = READING)]
    decimal_mark: Option<DecimalMark>,
    /// Orientation of the wavelengths: down a column or across a row
    #[arg(long, value_name = "ORIENTATION", value_parser = named::<Orientation>(ORIENTATIONS), help_heading = READING)]
    orientation: Option<Orientation>,
    /// Column of the wavelengths, from 1
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..), help_heading = READING)]
    wavelength_column: Option<u32>,
    /// Number of the table, block or group in the file, from 1
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..), help_heading = READING)]
    part: Option<u32>,
    /// Unit of a camera's sensitivities: response per energy or per photon
    #[arg(long, value_name = "UNIT", value_parser = PossibleValuesParser::new(["energy", "photon"]), help_heading = READING)]
    per: Option<String>,
    /// Format of the file, overriding detection
    #[arg(long, value_name = "READER", value_parser = named::<Reader>(Reader::ALL.map(|reader| reader.key)), help_heading = READING)]
    reader: Option<Reader>,
    /// Imports raw counts and other quantities recorded with the spectra; with --wavelength-column, every other column
    #[arg(long, value_name = "BOOL", num_args = 0..=1, require_equals = true, default_missing_value = "true",
          help_heading = READING)]
    raw: Option<bool>,
}

const READING: &str = "Overrides";

const ROLES: [&str; 5] = ["camera", "reflectance", "transmittance", "illuminant", "unknown"];
const UNITS: [(&str, &[&str]); 7] = [
    ("nanometer", &["nm"]),
    ("micrometer", &["um", "µm"]),
    ("angstrom", &[]),
    ("wavenumber", &[]),
    ("terahertz", &["thz"]),
    ("hertz", &["hz"]),
    ("electronvolt", &["ev"]),
];
const DELIMITERS: [&str; 6] = ["comma", "comma-space", "semicolon", "tab", "spaces", "elements"];
const MARKS: [&str; 2] = ["point", "comma"];
const ORIENTATIONS: [&str; 2] = ["down", "across"];

/// Parser of units, which have symbols besides names.
fn unit() -> impl TypedValueParser<Value = WavelengthUnit> {
    let names = UNITS.map(|(name, symbols)| PossibleValue::new(name).aliases(symbols));
    PossibleValuesParser::new(names).try_map(|typed| {
        let known = UNITS.iter().find(|(_, symbols)| symbols.contains(&typed.as_str()));
        let name: StrDeserializer<'_, Error> = known.map_or(typed.as_str(), |(name, _)| name).into_deserializer();
        WavelengthUnit::deserialize(name)
    })
}

fn step(text: &str) -> Result<f64, String> {
    const SMALLEST_NM: f64 = 0.001;
    let step = text.parse::<f64>().ok().filter(|step| step.is_finite() && *step >= SMALLEST_NM);
    step.ok_or_else(|| "not a number of at least 0.001; write 5 for 5 nm".to_owned())
}

impl InspectArguments {
    fn options(&self) -> ReadOptions {
        ReadOptions {
            delimiter: self.delimiter,
            decimal_mark: self.decimal_mark,
            orientation: self.orientation,
            wavelength_unit: self.unit,
            wavelength_column: self.wavelength_column.map(|column| column as usize),
            values: self.values,
            part: self.part.map(|part| part as usize),
            role: self.role,
            reader: self.reader,
            raw: self.raw,
        }
    }

    fn per_photon(&self) -> Option<bool> {
        self.per.as_ref().map(|per| per == "photon")
    }

    /// Format of what is written, if anything is.
    fn format(&self) -> Option<Format> {
        let format = if self.notes { Format::CommentedCsv } else { self.format };
        (self.csv.is_some() || self.out.is_some()).then_some(format)
    }

    fn grid(&self) -> Grid {
        self.step.map_or(Grid::Native, if self.average { Grid::Average } else { Grid::Step })
    }
}

#[derive(Clone)]
enum Failure {
    Read(ReadError),
    Other(String),
}

impl Failure {
    /// Reason without the file's name.
    fn reason(&self) -> String {
        match self {
            Self::Read(error) => error.to_string(),
            Self::Other(reason) => reason.clone(),
        }
    }

    fn refusal(&self, name: &str) -> CliError {
        match self {
            Self::Read(error) => CliError::unread(self.sentence(name), error),
            Self::Other(_) => CliError::File(self.sentence(name)),
        }
    }

    /// One sentence: where, what, and what helps.
    fn sentence(&self, name: &str) -> String {
        let text = self.reason();
        let line = match self {
            Self::Read(error) => error.line().map(|line| format!("line {line}")),
            Self::Other(_) => None,
        };
        match line.filter(|line| text.starts_with(line)) {
            Some(_) => format!("{name}, {text}"),
            None => format!("{name}: {text}"),
        }
    }
}

/// Reads the files one by one and writes the requested output of each. A failed file does not stop the others.
pub(super) fn run(arguments: &InspectArguments, _: &ArgMatches) -> Result<()> {
    let (files, mut skipped) = files(&arguments.files)?;
    let several = arguments.files.len() > 1 || arguments.files[0].is_dir();
    let out = Out::new(arguments, &files, several)?;
    let (mut read, mut failures, mut remarks) = (0, Vec::new(), Remarks::default());
    if arguments.json && several {
        put("[\n", None)?;
    }
    for (index, file) in files.iter().enumerate() {
        let end = if several && index + 1 < files.len() { ",\n" } else { "\n" };
        match answer(file, (index, end), &out, arguments, &mut remarks)? {
            Ok(()) => read += 1,
            // Of several files, the text beside them is no failure.
            Err(CliError::NoSpectra(_)) if several => skipped.add(NO_SPECTRA, display_path(file)),
            Err(error) => {
                if files.len() > 1 {
                    say(&format!("chromascope: {error}\n"));
                }
                failures.push(error);
            }
        }
    }
    if arguments.json && several {
        put("]\n", None)?;
    }
    let failed = failures.len();
    if several && failed + read == 0 {
        return Err(CliError::NoSpectra(format!("no spectra were found; skipped: {skipped}")));
    }
    if !skipped.is_empty() {
        say(&format!("chromascope: skipped: {skipped}\n"));
    }
    match failures.pop() {
        None => Ok(()),
        Some(only) if files.len() == 1 => Err(only),
        Some(_) => Err(CliError::Failed { failed, count: failed + read }),
    }
}

/// Writes the requested output of a file. The outer error ends the whole run.
fn answer(
    file: &Path,
    (index, end): (usize, &str),
    out: &Out,
    arguments: &InspectArguments,
    remarks: &mut Remarks,
) -> Result<Result<()>> {
    let name = if is_standard_input(file) { "standard input".to_owned() } else { file.display().to_string() };
    let told = spectral_file::on_one_line(&name);
    let table = inspect(file, &name, arguments);
    let curves: Vec<Trace<'_>> = table.iter().flat_map(|table| &table.curves).map(Trace::from).collect();
    let (format, now) = (arguments.format(), now());
    let known = table.as_ref().map_or_else(|_| Vec::new(), |table| written::known(table, file));
    let prepared = table.as_ref().map_err(Clone::clone).and_then(|table| {
        let sheet = written::sheet(table, &curves, &known, &now);
        let text = format.filter(|format| !format.is_csv()).map(|format| write(&sheet, format, arguments.grid()));
        let text = text.transpose().map_err(|error| Failure::Other(error.to_string()))?;
        let wanted = format.is_some_and(Format::is_csv) || arguments.step.is_some() && text.is_none();
        let prepared = wanted.then(|| Prepared::new(&sheet, arguments.grid())).transpose();
        let prepared = prepared.map_err(|error| Failure::Other(error.to_string()))?;
        Ok((table, prepared, text))
    });
    let (table, mut prepared, text) = match prepared {
        Ok(prepared) => prepared,
        Err(failure) => {
            if arguments.json {
                put(&shown_json(&format!("{}{end}", output::failure(&name, &failure))), None)?;
            }
            return Ok(Err(failure.refusal(&told)));
        }
    };
    if arguments.json {
        stream(None, |out| {
            output::json(out, &name, table, prepared.as_mut())?;
            Ok(out.write_all(end.as_bytes())?)
        })?;
    } else {
        let notes = prepared.as_mut().filter(|_| arguments.out.is_none()).map_or_else(Vec::new, output::notes);
        let gap = if index > 0 { "\n" } else { "" };
        let text = format!("{gap}{}", output::report(&told, table, &notes));
        if out.is_standard_output() { say(&text) } else { show(&text)? }
    }
    if let Some(question) = question(table) {
        remarks.0.add(&question, told.to_string());
    }
    let Some((format, place)) = format.zip(out.place(index)) else { return Ok(Ok(())) };
    Ok(written::put(&told, place, (format, arguments.out.is_some()), prepared.as_mut(), text.as_ref()))
}

fn inspect(file: &Path, name: &str, arguments: &InspectArguments) -> Result<SpectralFile, Failure> {
    let bytes = contents(file).map_err(|error| Failure::Other(io_reason(&error)))?;
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
            "add --role reflectance --values percent, --role transmittance --values percent, --role illuminant, --role camera \
             or --role unknown"
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
        let role = table.role.value;
        let reason = format!("read as {role}, but --per applies to camera sensitivities; add --role camera");
        return Err(Failure::Other(reason));
    }
    let why = "Set by --per".to_owned();
    table.reading.per_photon = Some(Decided { value: per_photon, certainty: Certainty::Chosen, why });
    Ok(())
}

const STANDARD_INPUT: &str = "-";

fn contents(file: &Path) -> io::Result<Vec<u8>> {
    if !is_standard_input(file) {
        return read(file);
    }
    let done = Arc::new(AtomicBool::new(false));
    if io::stdin().is_terminal() {
        say("Type or paste the data; Ctrl+D ends the input.\n");
    } else {
        let done = Arc::clone(&done);
        // Without a thread it waits without a word.
        let _silent = thread::Builder::new().name("patience".to_owned()).spawn(move || {
            thread::sleep(PATIENCE);
            if !done.load(Ordering::Relaxed) {
                say("chromascope: waiting for standard input to end; Ctrl+C stops.\n");
            }
        });
    }
    let mut bytes = Vec::new();
    let read = io::stdin().lock().take(spectral_file::MAX_BYTES as u64 + 1).read_to_end(&mut bytes);
    done.store(true, Ordering::Relaxed);
    read?;
    Ok(bytes)
}

fn is_standard_input(file: &Path) -> bool {
    let names = [STANDARD_INPUT, "/dev/stdin", "/dev/fd/0", "/proc/self/fd/0"];
    // Another program's standard input is its own.
    !hosted::holds_streams() && names.iter().any(|name| file == Path::new(name))
}

/// Time without an end of standard input, which may not be redirected by mistake, after which a notice says what is waited for.
const PATIENCE: Duration = Duration::from_secs(2);

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

/// The files that are meant: folders become what is in them, in order of path. And what was skipped.
fn files(named: &[PathBuf]) -> Result<(Vec<PathBuf>, Tally)> {
    let (mut files, mut skipped) = (Vec::new(), Tally::default());
    for path in named {
        if path.is_dir() {
            let found = FolderFiles::new(path, &|| true);
            let mut found = found.map_err(|error| CliError::File(io_failure(path, &error)))?;
            files.append(&mut found.files);
            skipped.0.append(&mut found.skipped.0);
        } else {
            files.push(path.clone());
        }
    }
    leave_companions_out(&mut files, |file| Some(file.clone()), &mut skipped);
    Ok((files, skipped))
}

enum Out {
    Nowhere,
    StandardOutput,
    /// A file for each file that is read, in the same order.
    Files(Vec<PathBuf>),
}

impl Out {
    /// Writes the tables as requested; a missing folder is created. Nothing is created or written if one of the tables
    /// may not be.
    fn new(arguments: &InspectArguments, files: &[PathBuf], several: bool) -> Result<Self> {
        let wrong = |reason: &str| refused(if arguments.csv.is_some() { "--csv" } else { "--out" }, reason);
        if arguments.notes && !arguments.format.is_csv() {
            return refused("--notes", "the format has notes of its own; --notes is for CSV");
        }
        let path = arguments.csv.as_deref().or(arguments.out.as_deref());
        let Some((path, format)) = path.zip(arguments.format()) else { return Ok(Self::Nowhere) };
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
            files.iter().map(|file| path.join(free_name(file, format.ending(), &mut taken))).collect()
        } else {
            vec![path.to_owned()]
        };
        let beside = tables.iter().filter(|table| format.is_csv() && !outputs::is_stream(table));
        let all: Vec<PathBuf> = beside.flat_map(|table| paths_beside(table)).chain(tables.iter().cloned()).collect();
        outputs::check(all.iter().map(PathBuf::as_path), &inputs(files), arguments.force)?;
        if folder {
            fs::create_dir_all(path).map_err(|error| CliError::Output { path: path.to_owned(), error })?;
        }
        Ok(Self::Files(tables))
    }

    /// True if tables go where reports go else.
    fn is_standard_output(&self) -> bool {
        matches!(self, Self::StandardOutput)
    }

    /// Destination of the table of the file with this index, if any; `-` for standard output.
    fn place(&self, index: usize) -> Option<&Path> {
        match self {
            Self::Nowhere => None,
            Self::StandardOutput => Some(Path::new("-")),
            Self::Files(paths) => paths.get(index).map(PathBuf::as_path),
        }
    }
}

/// Files that are read, with those beside them; standard input too, which may be redirected from a file.
fn inputs(files: &[PathBuf]) -> Vec<PathBuf> {
    let place = |file: &PathBuf| if is_standard_input(file) { PathBuf::from("/dev/stdin") } else { file.clone() };
    files.iter().map(place).flat_map(|file| paths_beside(&file).into_iter().chain([file])).collect()
}

/// The file's name with another ending, and a number where it or the file with its covariance has the name of another.
fn free_name(source: &Path, ending: &str, taken: &mut HashSet<String>) -> String {
    let stem = source.file_stem().map_or_else(String::new, |stem| stem.to_string_lossy().into_owned());
    let stem = if stem.is_empty() || stem == "-" { "table".to_owned() } else { stem };
    let named = |number: &str| fitting(&stem, &format!("{number}.{ending}"));
    // Some file systems do not distinguish `A.csv` from `a.csv`.
    let both =
        |name: &str| [Path::new(name), &paths_beside(Path::new(name))[1]].map(|path| file_name(path).to_lowercase());
    let (mut name, mut number) = (named(""), 2);
    while both(&name).iter().any(|name| taken.contains(name)) {
        name = named(&format!("-{number}"));
        number += 1;
    }
    taken.extend(both(&name));
    name
}
