//! Warnings: doubts to check before the curves of a file are trusted.

mod words;

use std::fmt;

use crate::error::ReadError;
use crate::role::{Quantity, Role};
use crate::separators::DecimalMark;

/// Line numbers, of which the first few are stored.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct LineList {
    first: Vec<usize>,
    count: usize,
}

impl LineList {
    /// Maximum number of stored line numbers.
    const MAX_LISTED: usize = 6;

    /// Adds a line; a line added twice in a row counts once.
    pub(super) fn add(&mut self, line: usize) {
        if self.first.last() == Some(&line) {
            return;
        }
        self.count += 1;
        if self.first.len() < Self::MAX_LISTED {
            self.first.push(line);
        }
    }

    /// The first lines, ascending.
    pub fn first(&self) -> &[usize] {
        &self.first
    }

    /// Number of lines in all.
    pub fn count(&self) -> usize {
        self.count
    }

    /// Returns whether there is no line.
    pub fn is_empty(&self) -> bool {
        self.count == 0
    }
}

impl fmt::Display for LineList {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(if self.count == 1 { "line " } else { "lines " })?;
        for (i, line) in self.first.iter().enumerate() {
            write!(f, "{}{line}", if i == 0 { "" } else { ", " })?;
        }
        match self.count - self.first.len() {
            0 => Ok(()),
            more => write!(f, " and {more} more"),
        }
    }
}

/// A number that stands for a missing value, such as −999.
#[derive(Debug, Clone, PartialEq)]
pub struct Sentinel {
    /// The number.
    pub number: f64,
    /// The first curve in which it stands: its name in quotes, and its column if it has one.
    pub curve: String,
}

/// Warning about a file that was read. Plain numbers are lines, unless noted.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum Warning {
    /// Cells without a value: omitted from their curves.
    Gaps {
        /// Number of cells.
        cells: usize,
        /// Lines; empty where the rows of the file are curves, or unknown.
        lines: LineList,
        /// A number that was taken for a missing value.
        sentinel: Option<Sentinel>,
    },
    /// Curves with fewer than two values: omitted.
    EmptyCurves {
        /// Number.
        count: usize,
        /// The first: its name in quotes, and its column if it has one.
        first: String,
    },
    /// Columns before the wavelengths, such as a pixel number: omitted. Holds the column of the wavelengths, from 1.
    SkippedColumns(usize),
    /// Columns that hold text: omitted.
    TextColumns {
        /// Number.
        count: usize,
        /// The first, from 1.
        column: usize,
        /// Its name, or an empty text.
        name: String,
    },
    /// Rows were neither ascending nor descending: sorted. Holds the first line out of order.
    Sorted(usize),
    /// Rows that repeat an earlier row exactly: counted once.
    RepeatedRows(LineList),
    /// Rows with different values at one wavelength: their mean was taken.
    AveragedRows(LineList),
    /// Comments inside the table that look like rows: omitted.
    CommentedRows(LineList),
    /// The line of names again, inside the table: omitted.
    RepeatedHeader(LineList),
    /// All fractions have three digits, so that their marks may group thousands.
    MaybeThousands,
    /// Marks before three digits were taken to group thousands, because whole numbers stand next to them.
    /// Holds the mark to choose if they have fractions.
    GroupedThousands(DecimalMark),
    /// All wavelengths are outside 380 to 780 nm.
    Invisible,
    /// Neighboring wavelengths far further apart than the others: more than 20 nm and ten times the median step.
    Hole {
        /// The wavelength before it, in nanometers.
        from_nm: f64,
        /// The wavelength after it, in nanometers.
        to_nm: f64,
        /// The lines of both, where each wavelength has its own.
        lines: Option<[usize; 2]>,
    },
    /// Rows without a wavelength: omitted.
    NoWavelength(LineList),
    /// Numbers above the table that belong to no row.
    NumbersAbove(usize),
    /// Text after the table: omitted. Holds its first line.
    TextBelow(usize),
    /// No number has a decimal point, so the separating commas might be decimal marks.
    CommasOnly,
    /// Several values at one wavelength of a curve: their mean was taken.
    Averaged {
        /// The curve.
        name: String,
        /// Lines of the repeated values.
        lines: LineList,
    },
    /// Another table with spectra follows the one that was read. Holds its line.
    MoreTables(usize),
    /// Other spectra of the same samples stand beside those that were read.
    MoreGroups {
        /// Number of groups of columns.
        count: usize,
        /// Name of the second.
        second: String,
    },
    /// Numbers without a unit were read as wave numbers.
    MaybeWavelengths,
    /// A reflectance or a sensitivity is far below zero.
    BelowZero {
        /// Number of such curves.
        count: usize,
        /// The first of them: its name in quotes, and its column if it has one.
        first: String,
        /// Its smallest value.
        min: f64,
        /// The line of that value, where each has its own.
        line: Option<usize>,
    },
    /// The curves were declared to have another role than the file states.
    OtherQuantity {
        /// Quantity that the file gives.
        quantity: Quantity,
        /// Chosen role.
        role: Role,
    },
    /// Rows of numbers below the table make no table that can be read.
    BrokenTable {
        /// Line where they begin.
        line: usize,
        /// Reason.
        error: Box<ReadError>,
    },
    /// Lines out of place: their values are at the abscissas at their heads.
    PlacedByAbscissa(LineList),
    /// Lines with fewer values than there are places before the next line: omitted.
    ShortLines(LineList),
    /// A header announces another value than the data hold.
    HeaderDiffers {
        /// Line of the announcement.
        line: usize,
        /// The label.
        label: &'static str,
        /// As announced.
        announced: f64,
        /// As found.
        found: f64,
    },
    /// Columns or rows that hold wavelengths again, another scale of them, or only count or time the others: omitted.
    OtherAxes {
        /// Their names in quotes and their columns or lines, the first few.
        named: String,
        /// The column of the wavelengths, from 1, where they run down one.
        wavelength_column: Option<usize>,
    },
    /// Rows of other quantities than those that were read.
    MoreQuantities {
        /// Value that was read.
        taken: String,
        /// The others, the first few.
        others: String,
    },
    /// Columns with values whose names should be wavelengths and are none: omitted.
    BadWavelengths {
        /// The line of the wavelengths.
        line: usize,
        /// The columns, from 1, and what stands there, the first few.
        named: String,
    },
    /// The file announces another number of values than it holds.
    CountDiffers {
        /// Line of the announcement.
        line: usize,
        /// As announced.
        expected: usize,
        /// As found.
        found: usize,
    },
    /// Curves that reach values no quantity of their role has.
    NotReflectances {
        /// Number.
        count: usize,
        /// The first: its name in quotes, and its column if it has one.
        first: String,
        /// Its largest value.
        max: f64,
    },
    /// Columns of quantities other than spectra, such as temperatures: omitted.
    NotSpectra {
        /// Number.
        count: usize,
        /// The first: its name in quotes, and its column if it has one.
        first: String,
    },
    /// Some curves were read as percent, others as written, each by its own numbers.
    ScalesDiffer {
        /// Number in percent.
        percent: usize,
        /// The first of them: its name in quotes, and its column if it has one.
        first: String,
        /// The first of the others.
        other: String,
    },
    /// The file states percent, but its values would be fractions. Holds the largest value as written, in words.
    SmallPercent(String),
    /// Warnings of kinds that are listed often enough: only counted. Stands last.
    More(usize),
}

impl Warning {
    /// The first line it is about, from 1; `None` where it concerns whole curves.
    pub fn line(&self) -> Option<usize> {
        match self {
            Self::Gaps { lines, .. }
            | Self::RepeatedRows(lines)
            | Self::AveragedRows(lines)
            | Self::NoWavelength(lines)
            | Self::CommentedRows(lines)
            | Self::RepeatedHeader(lines)
            | Self::PlacedByAbscissa(lines)
            | Self::ShortLines(lines)
            | Self::Averaged { lines, .. } => lines.first().first().copied(),
            Self::Sorted(line)
            | Self::NumbersAbove(line)
            | Self::TextBelow(line)
            | Self::MoreTables(line)
            | Self::BrokenTable { line, .. }
            | Self::HeaderDiffers { line, .. }
            | Self::BadWavelengths { line, .. }
            | Self::CountDiffers { line, .. } => Some(*line),
            Self::BelowZero { line, .. } => *line,
            Self::Hole { lines, .. } => lines.map(|[line, _]| line),
            Self::EmptyCurves { .. }
            | Self::MoreGroups { .. }
            | Self::MaybeWavelengths
            | Self::OtherQuantity { .. }
            | Self::SkippedColumns(..)
            | Self::OtherAxes { .. }
            | Self::MoreQuantities { .. }
            | Self::TextColumns { .. }
            | Self::CommasOnly
            | Self::MaybeThousands
            | Self::Invisible
            | Self::GroupedThousands(..)
            | Self::NotReflectances { .. }
            | Self::NotSpectra { .. }
            | Self::ScalesDiffer { .. }
            | Self::SmallPercent(..)
            | Self::More(..) => None,
        }
    }
}
