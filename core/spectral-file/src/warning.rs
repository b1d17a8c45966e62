//! Warnings: doubts to check before the curves of a file are trusted.

use std::fmt;

use crate::decision::{DecimalMark, Quantity, Role};
use crate::error::ReadError;

/// Line numbers, of which the first few are stored.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct LineList {
    first: Vec<usize>,
    count: usize,
}

impl LineList {
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

impl FromIterator<usize> for LineList {
    fn from_iter<I: IntoIterator<Item = usize>>(lines: I) -> Self {
        let mut list = Self::default();
        lines.into_iter().for_each(|line| list.add(line));
        list
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
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
#[allow(missing_docs, reason = "each variant says in its message what is in doubt")]
pub enum Warning {
    #[error("{}", gaps(*.cells, .lines, .sentinel.as_ref()))]
    Gaps {
        cells: usize,
        /// Lines; empty where the rows of the file are curves, or unknown.
        lines: LineList,
        /// A number that was taken for a missing value.
        sentinel: Option<Sentinel>,
    },
    #[error("{names} names stand above {columns} columns: {}", if .names > .columns { "they are not used" } else { "they may belong to others than they stand above" })]
    NamesDiffer { names: usize, columns: usize },
    #[error("{}", empty_curves(*.count, .first))]
    EmptyCurves { count: usize, first: String },
    /// Columns before the wavelengths, such as a pixel number: omitted. Holds the column of the wavelengths, from 1.
    #[error("Wavelengths stand in column {0}: the columns before it are left out")]
    SkippedColumns(usize),
    #[error("{}", text_columns(*.count, *.column, .name))]
    TextColumns { count: usize, column: usize, name: String },
    #[error("line {0}: wavelengths out of order: sorted")]
    Sorted(usize),
    #[error("{0}: the same as an earlier row: counted once")]
    RepeatedRows(LineList),
    #[error("{0}: several rows with different values at one wavelength: their mean is taken")]
    AveragedRows(LineList),
    #[error("{0}: rows that begin with # in the table: left out as comments")]
    CommentedRows(LineList),
    #[error("{0}: the names of the columns again: left out")]
    RepeatedHeader(LineList),
    #[error("Every fraction has three digits: if the marks group thousands, the values are wrong")]
    MaybeThousands,
    /// Marks before three digits were taken to group thousands, because whole numbers stand next to them.
    /// Holds the mark to choose if they have fractions.
    #[error("Numbers such as {} are read as thousands: if they have fractions, choose {}", grouped(*.0), .0)]
    GroupedThousands(DecimalMark),
    #[error("There is nothing between 380 and 780 nm, the light that is seen")]
    Invisible,
    /// Neighboring wavelengths far further apart than the others: more than 20 nm and ten times the median step. Of several, the
    /// widest.
    #[error("{}nothing between {from_nm} and {to_nm} nm, far more than the other steps{}", of(*.lines, |[a, b]| format!("lines {a} and {b}: ")), narrower(*.count))]
    Hole {
        /// Number of such steps.
        count: usize,
        from_nm: f64,
        to_nm: f64,
        /// The lines of both, where each wavelength has its own.
        lines: Option<[usize; 2]>,
    },
    #[error("{0}: no wavelength: left out")]
    NoWavelength(LineList),
    #[error("{count} sample{} at {from_nm} to {to_nm} nm, beyond the wavelengths that are read (100 nm to 25 µm){}: left out", if *.count == 1 { "" } else { "s" }, if .lines.is_empty() { String::new() } else { format!(", {lines}") })]
    OutOfRange {
        count: usize,
        from_nm: f64,
        to_nm: f64,
        /// Lines; empty where all wavelengths stand in one.
        lines: LineList,
    },
    #[error("line {0}: numbers above the table: left out")]
    NumbersAbove(usize),
    #[error("line {0}: text after the table: left out")]
    TextBelow(usize),
    #[error("No number has a decimal point: if the commas mark fractions, choose decimal commas")]
    CommasOnly,
    #[error("{lines}: “{name}” has several values at one wavelength: their mean is taken")]
    Averaged { name: String, lines: LineList },
    #[error("line {0}: another table with spectra: left out")]
    MoreTables(usize),
    #[error("“{second}”{}: left out", other_groups(*.count))]
    MoreGroups { count: usize, second: String },
    #[error("Nothing names the unit of wave numbers: if they are wavelengths, choose nanometers")]
    MaybeWavelengths,
    #[error("Nothing names the unit of the wavelengths, taken as ångströms: if they are nanometers, choose these")]
    MaybeNanometers,
    #[error("{}{}", of(*.line, |line| format!("line {line}: ")), below_zero(*.count, .first, *.min))]
    BelowZero {
        count: usize,
        first: String,
        min: f64,
        /// The line of that value, where each has its own.
        line: Option<usize>,
    },
    #[error("The numbers look like {quantity}, not like {role}")]
    OtherQuantity { quantity: Quantity, role: Role },
    #[error("line {line}: another table that cannot be read: left out ({error})")]
    BrokenTable { line: usize, error: Box<ReadError> },
    #[error("{0}: not where the line before ends: placed by the wavelength at the head of the line")]
    PlacedByAbscissa(LineList),
    #[error("{0}: up to one step off the wavelength at the head of the line: placed by FIRSTX, LASTX and NPOINTS")]
    PlacedByEnds(LineList),
    #[error("{0}: fewer values than places before the next line: left out. Which is missing is not known")]
    ShortLines(LineList),
    #[error("line {line}: {label} announces {announced}, but the data give {found}")]
    HeaderDiffers { line: usize, label: &'static str, announced: f64, found: f64 },
    #[error("{named}: another scale than the wavelengths{}, no spectrum: left out", of(*.wavelength_column, |column| format!(" in column {column}")))]
    OtherAxes {
        named: String,
        /// The column of the wavelengths, from 1, where they run down one.
        wavelength_column: Option<usize>,
    },
    /// The columns of the upper and of the lower ends, from 1.
    #[error("Column {} holds the upper ends of intervals that begin at the wavelengths, in column {}: left out, so that each value stands at the lower end", .0[0], .0[1])]
    UpperEnds([usize; 2]),
    #[error("line {0}: other wavelengths than those above: rows that belong to them stand at wrong ones")]
    OtherHeader(usize),
    #[error("Rows of other quantities than “{taken}”: left out ({others}): choose the part to read them")]
    MoreQuantities { taken: String, others: String },
    #[error("line {line}: {named}: no wavelength there, so the column is left out")]
    BadWavelengths {
        line: usize,
        /// The columns, from 1, and what stands there, the first few.
        named: String,
    },
    #[error("line {line} announces {expected} values, but there are {found}")]
    CountDiffers { line: usize, expected: usize, found: usize },
    #[error("{}", not_reflectances(*.count, .first, *.max))]
    NotReflectances { count: usize, first: String, max: f64 },
    #[error("{}", not_spectra(*.count, .first))]
    NotSpectra { count: usize, first: String },
    /// Columns of which nothing says that they are of another quantity than the rest.
    #[error("The values of {first}{} are over 100 times larger or smaller than those of {other}: leave out what is another quantity", and_more(*.count))]
    OtherSize { count: usize, first: String, other: String },
    #[error("{first}{} only rises, from nothing to its end: leave it out if it is an integral", and_more(*.count))]
    Integral { count: usize, first: String },
    /// Columns of whole numbers, or of few or nearly equal ones, beside others.
    #[error("{first}{}: only whole, few different or nearly equal numbers, unlike the others: leave out what is no spectrum", and_more(*.count))]
    Stepped { count: usize, first: String },
    /// Columns of quantities that hold only zeros.
    #[error("{first}{}: only zeros, as programs write for what they did not compute: left out", and_more(*.count))]
    Uncomputed { count: usize, first: String },
    #[error("By their values {first}{} are read as percent, others such as {other} as written", and_more(*.percent))]
    ScalesDiffer { percent: usize, first: String, other: String },
    /// Curves that look like fractions beside others in percent.
    #[error("{first}{} may be fractions, but are read as percent as the others are", and_more(*.count))]
    SmallAmongPercent { count: usize, first: String },
    /// The file states percent, but its values would be fractions. Holds the largest value as written, in words.
    #[error("The file says percent, but no value exceeds {0}: if they are fractions, choose plain numbers")]
    SmallPercent(String),
    /// A column of one number, which may mark rows.
    #[error("{first} is {value} at all wavelengths{}", if *.count > 1 { format!("; constant too: {} more", .count - 1) } else { String::new() })]
    Constant { count: usize, first: String, value: f64 },
    /// Numbers that may only count the rows were taken for wavelengths. Holds their column and that of others in order, from 1.
    #[error("Column {} goes up by ones, and column {} is in order too: choose that if it holds the wavelengths", .0[0], .0[1])]
    MayCount([usize; 2]),
    /// Nothing names the column of the wavelengths. Holds it, from 1.
    #[error("The numbers of column {0} are in order, as wavelengths are: taken for these")]
    UnnamedWavelengths(usize),
    #[error("{named} is an uncertainty by its name, but {why}: left out. To read it as a curve, include raw columns")]
    NotUncertainty { named: String, why: &'static str },
    #[error("{first}{} may be an uncertainty by its name, but is read as a curve: nothing says of which it would be", and_more(*.count))]
    MaybeUncertainty { count: usize, first: String },
    #[error(
        "{named} is read as an uncertainty{how}, which nothing says: if it is not, write “relative” and “%”, or neither, into its name"
    )]
    UncertaintyScale { named: String, how: &'static str },
    #[error("{named} has no uncertainty for {}: the larger of the neighbors' is taken", if *.count == 1 { "one value".to_owned() } else { format!("{count} values") })]
    UncertaintyGaps { named: String, count: usize },
    /// Holds the reason why the covariance beside a file is not taken.
    #[error("The covariance beside the file is left out: {0}")]
    NoCovariance(String),
    /// Warnings of kinds that are listed often enough: only counted. Stands last.
    #[error("{} more warning{} like these", .0, if *.0 == 1 { "" } else { "s" })]
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
            | Self::OutOfRange { lines, .. }
            | Self::CommentedRows(lines)
            | Self::RepeatedHeader(lines)
            | Self::PlacedByAbscissa(lines)
            | Self::PlacedByEnds(lines)
            | Self::ShortLines(lines)
            | Self::Averaged { lines, .. } => lines.first().first().copied(),
            Self::Sorted(line)
            | Self::NumbersAbove(line)
            | Self::TextBelow(line)
            | Self::OtherHeader(line)
            | Self::MoreTables(line)
            | Self::BrokenTable { line, .. }
            | Self::HeaderDiffers { line, .. }
            | Self::BadWavelengths { line, .. }
            | Self::CountDiffers { line, .. } => Some(*line),
            Self::BelowZero { line, .. } => *line,
            Self::Hole { lines, .. } => lines.map(|[line, _]| line),
            _ => None,
        }
    }
}

fn gaps(cells: usize, lines: &LineList, sentinel: Option<&Sentinel>) -> String {
    let plural = if cells == 1 { "" } else { "s" };
    let lines = if lines.is_empty() { String::new() } else { format!(", {lines}") };
    let number = sentinel.map_or_else(String::new, |Sentinel { number, curve }| {
        let number = if number.abs() >= 1e9 { format!("{number:e}") } else { number.to_string() };
        format!(" ({number} in {curve} stands for no value)")
    });
    format!("{cells} missing value{plural}{lines}: left out{number}")
}

fn empty_curves(count: usize, first: &str) -> String {
    match count {
        1 => format!("{first} has fewer than two values: left out"),
        _ => format!("{count} curves with fewer than two values, the first {first}: left out"),
    }
}

fn text_columns(count: usize, column: usize, name: &str) -> String {
    let name = if name.is_empty() { String::new() } else { format!(" (“{name}”)") };
    match count {
        1 => format!("Column {column}{name} holds text: left out"),
        2 => format!("Column {column}{name} and another hold text: left out"),
        _ => format!("Column {column}{name} and {} others hold text: left out", count - 1),
    }
}

fn grouped(fractions: DecimalMark) -> &'static str {
    if fractions == DecimalMark::Comma { "1,000" } else { "1.000" }
}

fn of<T>(number: Option<T>, words: impl FnOnce(T) -> String) -> String {
    number.map_or_else(String::new, words)
}

fn and_more(count: usize) -> String {
    if count == 1 { String::new() } else { format!(" and {} more", count - 1) }
}

fn narrower(count: usize) -> String {
    match count {
        1 => String::new(),
        2 => ", as in another place".to_owned(),
        _ => format!(", as in {} other places", count - 1),
    }
}

fn other_groups(count: usize) -> String {
    match count {
        2 => ", another group of spectra".to_owned(),
        _ => format!(" and {} more groups of spectra", count - 2),
    }
}

fn below_zero(count: usize, first: &str, min: f64) -> String {
    match count {
        1 => format!("{first} falls to {min}, further below zero than noise"),
        _ => format!("{count} curves fall further below zero than noise, the first {first} to {min}"),
    }
}

fn not_reflectances(count: usize, first: &str, max: f64) -> String {
    match count {
        _ if max > 1e30 => format!("{first} reaches {max:e}, more than any quantity of light can"),
        1 => format!("{first} reaches {max}, more than a fraction of light can"),
        _ => format!("{count} curves reach more than a fraction of light can, the first {first} {max}"),
    }
}

fn not_spectra(count: usize, first: &str) -> String {
    match count {
        1 => format!("{first} is no spectrum: left out"),
        _ => format!("{count} columns are no spectra, the first {first}: left out"),
    }
}
