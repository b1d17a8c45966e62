//! Arguments of `inspect`.

use std::path::PathBuf;

use clap::Args;
use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use serde::Deserialize as _;
use serde::de::DeserializeOwned;
use serde::de::IntoDeserializer as _;
use serde::de::value::{Error, StrDeserializer};
use spectral_file::write::Grid;
use spectral_file::{DecimalMark, Delimiter, Orientation, ReadOptions, Reader, Role, Values, WavelengthUnit};

pub(in crate::cli) const EXAMPLES: &str = "Examples:
  chromascope inspect leaf.txt
  chromascope inspect leaf.txt --values percent --csv leaf.csv
  chromascope inspect measured/ --step 5 --csv tables
  chromascope inspect lamp.txt --step 5 --average --csv -
  chromascope inspect lamp.spdx --csv - | head
  chromascope inspect *.sp --json | jq '.[].kind'

Reports the decisions made for each file, one line each: value, confidence (certain, a guess, chosen) and reason. An option of the
same name overrides a decision. A folder stands for the files in it, `-` for standard input; named pipes are not supported.

--csv writes `wavelength_nm,<curve> [<quantity> in <unit>],...`: nanometers, reflectances and transmittances as fractions, a cell left blank where a
curve has no sample. With `--csv -` the table goes to standard output and the report to standard error. OUT is a
folder where several files or a folder are named.

--json prints an object for a file, an array for several: file, kind (camera, reflectance, transmittance, illuminant, unknown),
curves [{name, unit, quantity, wavelengths_nm, values, missing}], channels [red, green, blue] as places in curves from 0,
decisions [{what, value, certainty, why}], warnings [{line, text}], reading {...}, notes on resampling; or file and error
{line, column, text}. Lines and columns count from 1.

A file that cannot be read is reported on standard error; the others are still read, and the exit code is 1.";

/// Arguments of `inspect`.
#[derive(Debug, Args)]
pub(in crate::cli) struct InspectArguments {
    /// Files with spectra, or folders of them
    #[arg(value_name = "FILE", required = true)]
    pub(super) files: Vec<PathBuf>,
    /// Prints all that was read as JSON, curves included
    #[arg(long)]
    pub(super) json: bool,
    /// Writes the curves as CSV: a file, a folder for several files, or `-` for standard output
    #[arg(long, value_name = "OUT")]
    pub(super) csv: Option<PathBuf>,
    /// Overwrites existing files named by --csv, but never an input file
    #[arg(long)]
    pub(super) force: bool,
    /// Resamples the curves, in CSV and JSON, to whole multiples of a step in nanometers
    #[arg(long, value_name = "NM", value_parser = step)]
    pub(super) step: Option<f64>,
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
    #[arg(long, value_name = "READER", value_parser = named::<Reader>(Reader::ALL.map(Reader::key)), help_heading = READING)]
    reader: Option<Reader>,
    /// Imports raw counts and other quantities recorded with the spectra; with --wavelength-column, every other column
    #[arg(long, value_name = "BOOL", num_args = 0..=1, require_equals = true, default_missing_value = "true",
          help_heading = READING)]
    raw: Option<bool>,
}

const READING: &str = "Overrides";

const ROLES: [&str; 5] = ["camera", "reflectance", "transmittance", "illuminant", "unknown"];
const VALUES: [&str; 4] = ["plain", "percent", "absorbance", "decibels"];
const UNITS: [(&str, &[&str]); 5] = [
    ("nanometer", &["nm"]),
    ("micrometer", &["um", "µm"]),
    ("angstrom", &[]),
    ("wavenumber", &[]),
    ("terahertz", &["thz"]),
];
const DELIMITERS: [&str; 6] = ["comma", "comma-space", "semicolon", "tab", "spaces", "elements"];
const MARKS: [&str; 2] = ["point", "comma"];
const ORIENTATIONS: [&str; 2] = ["down", "across"];

/// Takes what values stand for as written.
pub(in crate::cli) fn values() -> impl TypedValueParser<Value = Values> {
    named::<Values>(VALUES)
}

/// Takes the names that sessions use too.
fn named<T: DeserializeOwned + Clone + Send + Sync + 'static>(
    names: impl IntoIterator<Item = &'static str>,
) -> impl TypedValueParser<Value = T> {
    PossibleValuesParser::new(names).try_map(|name| {
        let name: StrDeserializer<'_, Error> = name.as_str().into_deserializer();
        T::deserialize(name)
    })
}

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
    /// The switches of the reader.
    pub(super) fn options(&self) -> ReadOptions {
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

    /// True if sensitivities are to be taken as responses per photon.
    pub(super) fn per_photon(&self) -> Option<bool> {
        self.per.as_ref().map(|per| per == "photon")
    }

    /// The wavelengths of what is written.
    pub(super) fn grid(&self) -> Grid {
        self.step.map_or(Grid::Native, if self.average { Grid::Average } else { Grid::Step })
    }
}
