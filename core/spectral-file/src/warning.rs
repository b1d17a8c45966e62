//! Warnings: doubts to check before the curves of a file are trusted.

use std::fmt;

use crate::error::ReadError;
use crate::role::{Quantity, Role};
use crate::separators::DecimalMark;

/// Line numbers, of which the first few are kept.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct LineList {
    first: Vec<usize>,
    count: usize,
}

impl LineList {
    /// Most line numbers that are kept; nobody reads more.
    const KEPT: usize = 6;

    /// Adds a line; a line added twice in a row counts once.
    pub(super) fn add(&mut self, line: usize) {
        if self.first.last() == Some(&line) {
            return;
        }
        self.count += 1;
        if self.first.len() < Self::KEPT {
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

/// Something a person should know about a file that was read all the same. Numbers alone are lines, unless noted.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum Warning {
    /// Cells without a value: left out of their curves.
    Gaps {
        /// Number of cells.
        cells: usize,
        /// Lines; empty where the rows of the file are curves, or unknown.
        lines: LineList,
        /// A number that was taken for a missing value.
        sentinel: Option<Sentinel>,
    },
    /// Curves with fewer than two values: left out.
    EmptyCurves {
        /// Number.
        count: usize,
        /// The first: its name in quotes, and its column if it has one.
        first: String,
    },
    /// Columns before the wavelengths, such as a pixel number: left out. Holds the column of the wavelengths, from 1.
    SkippedColumns(usize),
    /// Columns that hold text: left out.
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
    /// Comments inside the table that look like rows: left out.
    CommentedRows(LineList),
    /// The line of names again, inside the table: left out.
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
    /// Rows without a wavelength: left out.
    NoWavelength(LineList),
    /// Numbers above the table that belong to no row.
    NumbersAbove(usize),
    /// Text after the table: left out. Holds its first line.
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
    /// The curves were chosen to be something that the file says they are not.
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
    /// Lines with fewer values than there are places before the next line: left out.
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
    /// Columns or rows that hold wavelengths again, another scale of them, or only count or time the others: left out.
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
    /// Columns with values whose names should be wavelengths and are none: left out.
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
    /// Curves read as fractions of light that reach values no such fraction has.
    NotReflectances {
        /// Number.
        count: usize,
        /// The first: its name in quotes, and its column if it has one.
        first: String,
        /// Its largest value.
        max: f64,
    },
    /// Columns of something else than spectra, such as temperatures: left out.
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
    /// The file says percent, but its values would be fractions. Holds the largest value as written, in words.
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

impl Warning {
    /// Words about columns and rows that hold something else; nothing for the others.
    fn of_layout(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::OtherAxes { named, wavelength_column: None } => {
                write!(f, "{named}: another scale than the wavelengths, no spectrum: left out")
            }
            Self::OtherAxes { named, wavelength_column: Some(column) } => {
                write!(f, "{named}: another scale than the wavelengths in column {column}, no spectrum: left out")
            }
            Self::MoreQuantities { taken, others } => {
                write!(f, "Rows of other quantities than “{taken}”: left out ({others}): choose the part to read them")
            }
            Self::BadWavelengths { line, named } => {
                write!(f, "line {line}: {named}: no wavelength there, so the column is left out")
            }
            _ => Ok(()),
        }
    }

    /// Part that concerns single curves, in words; empty for other warnings.
    fn of_curves(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::EmptyCurves { count: 1, first } => write!(f, "{first} has fewer than two values: left out"),
            Self::EmptyCurves { count, first } => {
                write!(f, "{count} curves with fewer than two values, the first {first}: left out")
            }
            Self::TextColumns { count, column, name } => {
                write!(f, "Column {column}")?;
                if !name.is_empty() {
                    write!(f, " (“{name}”)")?;
                }
                match count {
                    1 => f.write_str(" holds text: left out"),
                    2 => f.write_str(" and another hold text: left out"),
                    _ => write!(f, " and {} others hold text: left out", count - 1),
                }
            }
            Self::Averaged { name, lines } => {
                write!(f, "{lines}: “{name}” has several values at one wavelength: their mean is taken")
            }
            Self::BelowZero { count, first, min, line } => {
                if let Some(line) = line {
                    write!(f, "line {line}: ")?;
                }
                match count {
                    1 => write!(f, "{first} falls to {min}, further below zero than noise"),
                    _ => write!(f, "{count} curves fall further below zero than noise, the first {first} to {min}"),
                }
            }
            Self::NotReflectances { count: 1, first, max } => {
                write!(f, "{first} reaches {max}, more than a fraction of light can")
            }
            Self::NotReflectances { count, first, max } => {
                write!(f, "{count} curves reach more than a fraction of light can, the first {first} {max}")
            }
            Self::NotSpectra { count: 1, first } => write!(f, "{first} is no spectrum: left out"),
            Self::NotSpectra { count, first } => {
                write!(f, "{count} columns are no spectra, the first {first}: left out")
            }
            Self::ScalesDiffer { percent, first, other } => {
                let more = if *percent == 1 { String::new() } else { format!(" and {} more", percent - 1) };
                write!(f, "By their values {first}{more} are read as percent, others such as {other} as written")
            }
            _ => Ok(()),
        }
    }
}

fn gaps(f: &mut fmt::Formatter<'_>, cells: usize, lines: &LineList, sentinel: Option<&Sentinel>) -> fmt::Result {
    write!(f, "{cells} missing value{}", if cells == 1 { "" } else { "s" })?;
    if !lines.is_empty() {
        write!(f, ", {lines}")?;
    }
    f.write_str(": left out")?;
    match sentinel {
        Some(Sentinel { number, curve }) if number.abs() >= 1e9 => {
            write!(f, " ({number:e} in {curve} stands for no value)")
        }
        Some(Sentinel { number, curve }) => write!(f, " ({number} in {curve} stands for no value)"),
        None => Ok(()),
    }
}

impl fmt::Display for Warning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Gaps { cells, lines, sentinel } => gaps(f, *cells, lines, sentinel.as_ref()),
            Self::SkippedColumns(wavelength_column) => {
                write!(f, "Wavelengths stand in column {wavelength_column}: the columns before it are left out")
            }
            Self::Sorted(line) => write!(f, "line {line}: wavelengths out of order: sorted"),
            Self::RepeatedRows(lines) => write!(f, "{lines}: the same as an earlier row: counted once"),
            Self::AveragedRows(lines) => {
                write!(f, "{lines}: several rows with different values at one wavelength: their mean is taken")
            }
            Self::ShortLines(lines) => {
                write!(
                    f,
                    "{lines}: fewer values than places before the next line: left out. Which is missing is not known"
                )
            }
            Self::NoWavelength(lines) => write!(f, "{lines}: no wavelength: left out"),
            Self::NumbersAbove(line) => write!(f, "line {line}: numbers above the table: left out"),
            Self::TextBelow(line) => write!(f, "line {line}: text after the table: left out"),
            Self::CommentedRows(lines) => {
                write!(f, "{lines}: rows that begin with # in the table: left out as comments")
            }
            Self::RepeatedHeader(lines) => write!(f, "{lines}: the names of the columns again: left out"),
            Self::MaybeThousands => {
                f.write_str("Every fraction has three digits: if the marks group thousands, the values are wrong")
            }
            Self::Invisible => f.write_str("There is nothing between 380 and 780 nm, the light that is seen"),
            Self::Hole { from_nm, to_nm, lines } => {
                if let Some([a, b]) = lines {
                    write!(f, "lines {a} and {b}: ")?;
                }
                write!(f, "nothing between {from_nm} and {to_nm} nm, far more than the other steps")
            }
            Self::GroupedThousands(fractions) => {
                let mark = if *fractions == DecimalMark::Comma { "1,000" } else { "1.000" };
                write!(f, "Numbers such as {mark} are read as thousands: if they have fractions, choose {fractions}")
            }
            Self::CommasOnly => {
                f.write_str("No number has a decimal point: if the commas mark fractions, choose decimal commas")
            }
            Self::BrokenTable { line, error } => {
                write!(f, "line {line}: another table that cannot be read: left out ({error})")
            }
            Self::MoreGroups { count: 2, second } => write!(f, "“{second}”, another group of spectra: left out"),
            Self::MoreGroups { count, second } => {
                write!(f, "“{second}” and {} more groups of spectra: left out", count - 2)
            }
            Self::MaybeWavelengths => {
                f.write_str("Nothing names the unit of wave numbers: if they are wavelengths, choose nanometers")
            }
            Self::OtherQuantity { quantity, role } => write!(f, "The numbers look like {quantity}, not like {role}"),
            Self::MoreTables(line) => write!(f, "line {line}: another table with spectra: left out"),
            Self::PlacedByAbscissa(lines) => {
                write!(f, "{lines}: not where the line before ends: placed by the wavelength at the head of the line")
            }
            Self::HeaderDiffers { line, label, announced, found } => {
                write!(f, "line {line}: {label} announces {announced}, but the data give {found}")
            }
            Self::CountDiffers { line, expected, found } => {
                write!(f, "line {line} announces {expected} values, but there are {found}")
            }
            Self::More(1) => f.write_str("1 more warning like these"),
            Self::More(count) => write!(f, "{count} more warnings like these"),
            Self::SmallPercent(max) => {
                write!(
                    f,
                    "The file says percent, but no value exceeds {max}: if they are fractions, choose plain numbers"
                )
            }
            Self::OtherAxes { .. } | Self::MoreQuantities { .. } | Self::BadWavelengths { .. } => self.of_layout(f),
            Self::EmptyCurves { .. }
            | Self::NotSpectra { .. }
            | Self::ScalesDiffer { .. }
            | Self::TextColumns { .. }
            | Self::Averaged { .. }
            | Self::BelowZero { .. }
            | Self::NotReflectances { .. } => self.of_curves(f),
        }
    }
}
