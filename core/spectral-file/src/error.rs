//! Reason that a file could not be read.

use std::fmt;

use crate::binary::BinaryKind;
use crate::decision::{Family, Reader};
use crate::options::Switch;

pub(super) const MAX_PARTS: usize = 1000;

/// The most bytes a file may have: 64 MiB. Spectra of a whole session of measurements are far below.
pub const MAX_BYTES: usize = 64 << 20;

/// The most curves one table may hold.
pub const MAX_CURVES: usize = 100_000;

pub(super) const MAX_DROPPED: usize = 1000;

/// The most samples (curves times wavelengths) one table may hold.
pub const MAX_SAMPLES: usize = 20_000_000;

/// Reason that a file could not be read: where, what, and what helps. Lines and columns count from 1; a
/// number alone is a line.
///
/// The application adds the name of the file.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ReadError {
    /// The file is over [`MAX_BYTES`](crate::MAX_BYTES).
    #[error("the file has {megabytes} MB, the limit is {limit} MB: split it into smaller files")]
    TooLarge {
        /// Size of the file, rounded up.
        megabytes: usize,
        /// The limit.
        limit: usize,
    },
    /// The file is binary.
    #[error("this is {}, not text: {}", .0, .0.remedy())]
    Binary(BinaryKind),
    /// The file is of a known family, but of a layout that no reader takes.
    #[error("line 1: this is {0}, but of no layout that holds spectra: export the measurement as text or CSV")]
    Unsupported(Family),
    /// The file breaks the rules of its family.
    #[error("line {line}: from column {column} on this breaks the rules of {family}: is the file cut short or edited?")]
    Malformed {
        /// Its meaning.
        family: Family,
        /// The line.
        line: usize,
        /// The column.
        column: usize,
    },
    /// Values whose wavelengths are given nowhere.
    #[error("line {0}: the file does not say at which wavelengths these values are: export them with wavelengths")]
    NoWavelengths(usize),
    /// A line of values begins at another abscissa than its place in the file and the header say.
    #[error(
        "line {line}: begins at {found}, but the header and the lines before put it at {expected}: correct the line or the \
         header, or export the measurement again"
    )]
    Misplaced {
        /// The line.
        line: usize,
        /// The abscissa at its head.
        found: f64,
        /// The abscissa that it should have.
        expected: f64,
    },
    /// A line does not repeat the last value of the line before it, as lines of differences do.
    #[error(
        "line {line}: begins with {found}, but line {before} ends with {expected}, and both are the same value: \
         a digit is wrong in one of them; export the measurement again"
    )]
    CheckFails {
        /// The line.
        line: usize,
        /// Its first value.
        found: f64,
        /// The line before it.
        before: usize,
        /// The last value of that.
        expected: f64,
    },
    /// Two lines give different values at one abscissa.
    #[error(
        "lines {other} and {line}: different values at {at}: correct the abscissas at the heads of the lines, or export \
         the measurement again"
    )]
    TwoValues {
        /// The later line.
        line: usize,
        /// The earlier line.
        other: usize,
        /// The abscissa, in the unit of the file.
        at: f64,
    },
    /// DELTAX is another step than FIRSTX, LASTX and NPOINTS give, and the lines do not decide which is right.
    #[error("line {line}: DELTAX is {announced}, but FIRSTX, LASTX and NPOINTS give {found}: correct the wrong one")]
    StepContradicts {
        /// The line of DELTAX.
        line: usize,
        /// As announced.
        announced: f64,
        /// As the others give it.
        found: f64,
    },
    /// A value that is announced is a power of ten times that in the data.
    #[error("line {line}: {label} announces {announced}, but the data give {found}: correct YFACTOR, or the line")]
    ScaleContradicts {
        /// The line that announces it.
        line: usize,
        /// The label.
        label: &'static str,
        /// As announced.
        announced: f64,
        /// As found, the factor applied.
        found: f64,
    },
    /// A list of values is longer or shorter than what it belongs to.
    #[error("line {line}: “{name}” has {found} values where {expected} are expected: is the file cut short?")]
    WrongCount {
        /// The line, where known, else 1.
        line: usize,
        /// The list.
        name: String,
        /// Values in it.
        found: usize,
        /// Values it should have.
        expected: usize,
    },
    /// The caller wanted no more.
    #[error("reading was stopped")]
    Stopped,
    /// Nothing but white space.
    #[error("the file is empty: expected a wavelength and at least one value in each line")]
    Empty,
    /// No line holds two numbers, or the chosen separators fit no line.
    #[error("no rows of numbers were found: expected a wavelength and at least one value in each line")]
    NoNumbers,
    /// No line is a row of numbers, but one nearly is.
    #[error("line {line}: no rows of numbers: \"{text}\" {why}")]
    NearlyRow {
        /// The first such line.
        line: usize,
        /// The line, shortened.
        text: String,
        /// Reason that it is none.
        why: NearMiss,
    },
    /// An error that was none before a setting was chosen.
    #[error("{error} (as chosen: {switch})")]
    AsChosen {
        /// The chosen setting.
        switch: Switch,
        /// The error that it led to.
        error: Box<ReadError>,
    },
    /// The crate was compiled without the feature that reads such files.
    #[error("this is {what}, which this program was built without: compile it with the feature {feature}")]
    NotBuilt {
        /// The format or encoding.
        what: &'static str,
        /// The feature of the crate.
        feature: &'static str,
    },
    /// Every line holds one number only.
    #[error("line {0}: only one number in each line: expected a wavelength and at least one value")]
    OneColumn(usize),
    /// Text where a number must be.
    #[error("line {line}: no number in column {column} (\"{text}\"): correct it, or leave it empty if it is missing")]
    NotANumber {
        /// The line.
        line: usize,
        /// The column.
        column: usize,
        /// The text there, shortened.
        text: String,
    },
    /// A row has another number of columns than the rows before it.
    #[error("line {line}: {found} columns where {expected} are expected: write NaN for a missing value")]
    UnevenRow {
        /// The line.
        line: usize,
        /// Columns in this line.
        found: usize,
        /// Columns in the rest.
        expected: usize,
    },
    /// Rows of a table that each name their wavelengths have other ones than the first.
    #[error("line {0}: a second table begins here: put each table into a file of its own")]
    SecondTable(usize),
    /// The file has fewer tables, blocks or groups than the caller chose from.
    #[error("the file has no part {part}: it has {parts}")]
    NoSuchPart {
        /// The part that was chosen, from 1.
        part: usize,
        /// Number found.
        parts: usize,
    },
    /// The file is not of the family that the chosen reader is for.
    #[error("this is no file of the chosen layout ({0}): choose another, or let the content decide")]
    OtherLayout(Reader),
    /// The column that was chosen for the wavelengths holds no numbers, or is not there.
    #[error("column {column} holds no wavelengths: the table has {columns} columns")]
    NotWavelengthColumn {
        /// The column, from 1.
        column: usize,
        /// Number found.
        columns: usize,
    },
    /// Numbers that may be wavelengths in ångströms as well as wave numbers.
    #[error(
        "line {line}: numbers from {min} to {max} may be ångströms or wave numbers (1/cm): choose the wavelength unit"
    )]
    AmbiguousUnit {
        /// The line where they begin.
        line: usize,
        /// The smallest.
        min: f64,
        /// The largest.
        max: f64,
    },
    /// Commas separate the cells and mark the fractions.
    #[error("line {0}: commas separate numbers and seem to mark fractions: choose decimal commas, or points if not")]
    AmbiguousCommas(usize),
    /// The header gives photon energies, or another scale that is not converted.
    #[error("line {0}: the header gives neither wavelengths nor wave numbers nor THz: convert to wavelengths in nm")]
    NotWavelengths(usize),
    /// A value that is beyond the largest number once it is multiplied by the factor of the file.
    #[error("line {0}: a value times the factor of the file is beyond the largest number, 1.8e308: correct the factor")]
    TooGreat(usize),
    /// Only one sample, or no curve with two.
    #[error("line {0}: a curve needs values at two wavelengths or more: check the columns")]
    TooFewSamples(usize),
    /// A wavelength that no instrument for light measures.
    #[error("line {line}: wavelength {wavelength_nm} nm is outside 100 to 25000 nm: check the unit and the column")]
    WavelengthOutOfRange {
        /// The line.
        line: usize,
        /// The wavelength in the unit decided on.
        wavelength_nm: f64,
    },
    /// Values that no quantity of their role has.
    #[error("{what}: correct it, leave it empty if it is missing, or choose plain numbers to use it as it is")]
    ImpossibleValues {
        /// The line of the first, where known.
        line: Option<usize>,
        /// The first, with its line.
        what: String,
    },
    /// More than [`MAX_CURVES`] curves.
    #[error("line {0}: more than {MAX_CURVES} curves: split the file")]
    TooManyCurves(usize),
    /// More than [`MAX_SAMPLES`] samples.
    #[error("line {0}: more than {MAX_SAMPLES} samples: split the file")]
    TooManySamples(usize),
}

impl ReadError {
    /// The line the error is about, from 1; `None` where it concerns the whole file.
    pub fn line(&self) -> Option<usize> {
        match *self {
            Self::TooLarge { .. }
            | Self::Binary(..)
            | Self::Empty
            | Self::NotBuilt { .. }
            | Self::Stopped
            | Self::NoNumbers
            | Self::NoSuchPart { .. }
            | Self::OtherLayout(..)
            | Self::NotWavelengthColumn { .. } => None,
            Self::Unsupported(..) => Some(1),
            Self::AsChosen { ref error, .. } => error.line(),
            Self::ImpossibleValues { line, .. } => line,
            Self::OneColumn(line)
            | Self::NearlyRow { line, .. }
            | Self::Malformed { line, .. }
            | Self::WrongCount { line, .. }
            | Self::NoWavelengths(line)
            | Self::Misplaced { line, .. }
            | Self::CheckFails { line, .. }
            | Self::TwoValues { line, .. }
            | Self::StepContradicts { line, .. }
            | Self::ScaleContradicts { line, .. }
            | Self::NotANumber { line, .. }
            | Self::UnevenRow { line, .. }
            | Self::SecondTable(line)
            | Self::AmbiguousCommas(line)
            | Self::AmbiguousUnit { line, .. }
            | Self::NotWavelengths(line)
            | Self::TooGreat(line)
            | Self::TooFewSamples(line)
            | Self::WavelengthOutOfRange { line, .. }
            | Self::TooManyCurves(line)
            | Self::TooManySamples(line) => Some(line),
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
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum NearMiss {
    /// The character between the numbers separates no columns.
    Between(char),
    /// It would be a row with other separators than were chosen.
    Separators,
    /// A number is followed by text only.
    TextAfter,
    /// Texts and numbers, of which the first are no wavelengths in order.
    Order,
}

impl fmt::Display for NearMiss {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Between(c) => {
                write!(f, "has “{c}” between its numbers: separate them by commas, semicolons, tabs or spaces")
            }
            Self::Separators => f.write_str("does not split as chosen: choose other separators"),
            Self::TextAfter => {
                f.write_str("has text where a value is expected: write a number there, or leave it empty")
            }
            Self::Order => f.write_str(
                "has text beside numbers that are no wavelengths in order: choose the column of wavelengths",
            ),
        }
    }
}
