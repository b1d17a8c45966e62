//! Reason that a file could not be read.

use crate::binary::BinaryKind;
use crate::decision::{Family, Reader};

pub(super) const MAX_PARTS: usize = 1000;

/// The most bytes a file may have: 64 MiB. Spectra of a whole session of measurements are far below.
pub const MAX_BYTES: usize = 64 << 20;

/// The most curves one table may hold.
pub const MAX_CURVES: usize = 100_000;

pub(super) const MAX_DROPPED: usize = 1000;

/// The most samples (curves times wavelengths) one table may hold.
pub const MAX_SAMPLES: usize = 20_000_000;

/// Refuses more curves than a table may hold.
pub(super) fn check_curves(count: usize, line: usize) -> Result<(), ReadError> {
    if count > MAX_CURVES { Err(ReadError::TooManyCurves(line)) } else { Ok(()) }
}

/// Refuses more samples than a table may hold.
pub(super) fn check_samples(count: usize, line: usize) -> Result<(), ReadError> {
    if count > MAX_SAMPLES { Err(ReadError::TooManySamples(line)) } else { Ok(()) }
}

/// Reason that a file could not be read: where, what, and what helps. Lines and columns count from 1; a
/// number alone is a line.
///
/// The application adds the name of the file.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
#[allow(missing_docs, reason = "each variant says in its message what is wrong")]
pub enum ReadError {
    #[error("the file has {megabytes} MB, the limit is {limit} MB: split it into smaller files")]
    TooLarge { megabytes: usize, limit: usize },
    #[error("this is {}, not text: {}", .0, .0.remedy())]
    Binary(BinaryKind),
    #[error("line 1: this is {0}, but of no layout that holds spectra: export the measurement as text or CSV")]
    Unsupported(Family),
    #[error("line {line}: from column {column} on this breaks the rules of {family}: is the file cut short or edited?")]
    Malformed { family: Family, line: usize, column: usize },
    #[error("line {line}: {text} is no number of JSON: write null for a missing value")]
    NoJsonNumber { line: usize, text: &'static str },
    #[error("line {0}: the file does not say at which wavelengths these values are: export them with wavelengths")]
    NoWavelengths(usize),
    #[error(
        "line {line}: begins at {found}, but the header and the lines before put it at {expected}: correct the line or the \
         header, or export the measurement again"
    )]
    Misplaced { line: usize, found: f64, expected: f64 },
    #[error(
        "line {line}: begins with {found}, but line {before} ends with {expected}, and both are the same value: \
         a digit is wrong in one of them; export the measurement again"
    )]
    CheckFails { line: usize, found: f64, before: usize, expected: f64 },
    #[error(
        "lines {other} and {line}: different values at {at}: correct the abscissas at the heads of the lines, or export \
         the measurement again"
    )]
    TwoValues { line: usize, other: usize, at: f64 },
    #[error("line {line}: DELTAX is {announced}, but FIRSTX, LASTX and NPOINTS give {found}: correct the wrong one")]
    StepContradicts { line: usize, announced: f64, found: f64 },
    #[error("line {line}: {label} announces {announced}, but the data give {found}: correct YFACTOR, or the line")]
    ScaleContradicts { line: usize, label: &'static str, announced: f64, found: f64 },
    #[error("line {line}: “{name}” has {found} values where {expected} are expected: is the file cut short?")]
    WrongCount {
        /// The line, where known, else 1.
        line: usize,
        name: String,
        found: usize,
        expected: usize,
    },
    #[error("reading was stopped")]
    Stopped,
    #[error("the file is empty: expected a wavelength and at least one value in each line")]
    Empty,
    #[error("no rows of numbers were found: expected a wavelength and at least one value in each line")]
    NoNumbers,
    #[error("line {line}: no rows of numbers: \"{text}\" {why}")]
    NearlyRow { line: usize, text: String, why: NearMiss },
    #[error("{error} (as chosen: {switch})")]
    AsChosen { switch: String, error: Box<ReadError> },
    #[error("this is {what}, which this program was built without: compile it with the feature {feature}")]
    NotBuilt { what: &'static str, feature: &'static str },
    #[error(
        "line {0}: only one number in each line: expected a wavelength and at least one value; where a file of its own holds the \
         wavelengths, as in the USGS spectral library, put them beside the values"
    )]
    OneColumn(usize),
    #[error("line {line}: no number in column {column} (\"{text}\"): correct it, or leave it empty if it is missing")]
    NotANumber { line: usize, column: usize, text: String },
    #[error("line {line}: {found} columns where {expected} are expected: write NaN for a missing value")]
    UnevenRow { line: usize, found: usize, expected: usize },
    #[error("line {0}: a second table begins here: put each table into a file of its own")]
    SecondTable(usize),
    #[error("the file has no part {part}: it has {parts}")]
    NoSuchPart { part: usize, parts: usize },
    #[error("this is no file of the chosen layout ({0}): choose another, or let the content decide")]
    OtherLayout(Reader),
    #[error("column {column} holds no wavelengths: the table has {columns} columns")]
    NotWavelengthColumn { column: usize, columns: usize },
    #[error(
        "line {line}: numbers from {min} to {max} may be ångströms, wave numbers (1/cm) or infrared nanometers: choose the wavelength unit"
    )]
    AmbiguousUnit { line: usize, min: f64, max: f64 },
    #[error(
        "line {line}: numbers from {max} down to {min} may be energies of photons (eV) or micrometers: choose the one that \
         they are"
    )]
    AmbiguousEnergies { line: usize, min: f64, max: f64 },
    #[error("line {0}: commas separate numbers and seem to mark fractions: choose decimal commas, or points if not")]
    AmbiguousCommas(usize),
    #[error(
        "line {0}: the header gives neither wavelengths nor wave numbers nor THz nor eV: convert to wavelengths in nm, or choose the unit"
    )]
    NotWavelengths(usize),
    #[error("line {line}: “{kind}” is no spectrum of light over wavelengths, wave numbers or frequencies")]
    NotLight { line: usize, kind: String },
    #[error("line {0}: a value times the factor of the file is beyond the largest number, 1.8e308: correct the factor")]
    TooGreat(usize),
    #[error("line {0}: a curve needs values at two wavelengths or more: check the columns")]
    TooFewSamples(usize),
    #[error("line {line}: wavelength {wavelength_nm} nm is outside 100 to 25000 nm: check the unit and the column")]
    WavelengthOutOfRange { line: usize, wavelength_nm: f64 },
    #[error(
        "line {line}: wavelength {wavelength_nm} nm is outside 100 to 25000 nm, but the numbers of column {column} are in order within: \
         choose it as that of the wavelengths (--wavelength-column {column})"
    )]
    OtherWavelengthColumn { line: usize, wavelength_nm: f64, column: usize },
    #[error("line {line}: {count} of {rows} rows are at {nm} nm, as in no spectrum: choose the column of wavelengths")]
    OneWavelength { line: usize, nm: f64, count: usize, rows: usize },
    #[error("{what}: correct it, leave it empty if it is missing, or choose plain numbers to use it as it is")]
    ImpossibleValues {
        /// The line of the first, where known.
        line: Option<usize>,
        what: String,
    },
    #[error("line {0}: more than {MAX_CURVES} curves: split the file")]
    TooManyCurves(usize),
    #[error("line {0}: more than {MAX_SAMPLES} samples: split the file")]
    TooManySamples(usize),
}

impl ReadError {
    /// The line the error is about, from 1; `None` where it concerns the whole file.
    pub fn line(&self) -> Option<usize> {
        match *self {
            Self::Unsupported(..) => Some(1),
            Self::AsChosen { ref error, .. } => error.line(),
            Self::ImpossibleValues { line, .. } => line,
            Self::OneColumn(line)
            | Self::NearlyRow { line, .. }
            | Self::Malformed { line, .. }
            | Self::NoJsonNumber { line, .. }
            | Self::WrongCount { line, .. }
            | Self::NoWavelengths(line)
            | Self::Misplaced { line, .. }
            | Self::CheckFails { line, .. }
            | Self::TwoValues { line, .. }
            | Self::StepContradicts { line, .. }
            | Self::ScaleContradicts { line, .. }
            | Self::NotANumber { line, .. }
            | Self::UnevenRow { line, .. }
            | Self::NotLight { line, .. }
            | Self::SecondTable(line)
            | Self::AmbiguousCommas(line)
            | Self::AmbiguousUnit { line, .. }
            | Self::NotWavelengths(line)
            | Self::TooGreat(line)
            | Self::TooFewSamples(line)
            | Self::WavelengthOutOfRange { line, .. }
            | Self::OneWavelength { line, .. }
            | Self::OtherWavelengthColumn { line, .. }
            | Self::TooManyCurves(line)
            | Self::TooManySamples(line) => Some(line),
            _ => None,
        }
    }

    /// Returns whether the file is of another kind than spectra, such as a text, a picture or a program, and not a table that
    /// is broken or that another program has to export.
    pub fn is_of_no_spectra(&self) -> bool {
        match self {
            Self::Binary(kind) => kind.is_of_no_spectra(),
            Self::Unsupported(_) | Self::Empty | Self::NoNumbers | Self::NearlyRow { .. } => true,
            _ => false,
        }
    }

    /// The column the error is about, from 1, where known.
    pub fn column(&self) -> Option<usize> {
        match *self {
            Self::AsChosen { ref error, .. } => error.column(),
            Self::NotANumber { column, .. }
            | Self::Malformed { column, .. }
            | Self::NotWavelengthColumn { column, .. } => Some(column),
            _ => None,
        }
    }
}

/// Reason that a line with numbers is no row of them.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, thiserror::Error)]
#[allow(missing_docs, reason = "each variant says in its message what is wrong")]
pub enum NearMiss {
    #[error("has “{0}” between its numbers: separate them by commas, semicolons, tabs or spaces")]
    Between(char),
    #[error("does not split as chosen: choose other separators")]
    Separators,
    #[error("has text where a value is expected: write a number there, or leave it empty")]
    TextAfter,
    #[error("has text beside numbers that are no wavelengths in order: choose the column of wavelengths")]
    Order,
}
