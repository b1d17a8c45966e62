//! Provenance: what was decided on reading a file, how sure it is, and why.

use serde::{Deserialize, Serialize};
use std::fmt;

use crate::decimal::clean;
pub use crate::decision::{Certainty, Decided, Decision, Effect};
use crate::role::{Quantity, Role, Values};
use crate::separators::{DecimalMark, Delimiter};
use crate::wavelength_unit::WavelengthUnit;

/// The encoding of the bytes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Encoding {
    /// UTF-8, of which ASCII is a part.
    Utf8,
    /// UTF-16, low byte first.
    Utf16Le,
    /// UTF-16, high byte first.
    Utf16Be,
    /// Windows-1252, which holds Latin-1: taken for all that is none of the others.
    Windows1252,
    /// Shift-JIS, as Windows writes it.
    ShiftJis,
}

impl fmt::Display for Encoding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Utf8 => "UTF-8",
            Self::Utf16Le => "UTF-16 LE",
            Self::Utf16Be => "UTF-16 BE",
            Self::Windows1252 => "Windows-1252",
            Self::ShiftJis => "Shift-JIS",
        })
    }
}

/// Direction of the wavelengths: down a column or across a row.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Orientation {
    /// Down a column; every other column is a curve.
    Down,
    /// Across a header row; every row is a curve.
    Across,
}

impl fmt::Display for Orientation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Down => "wavelengths down a column",
            Self::Across => "wavelengths across a row",
        })
    }
}

/// Reader of a file format.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
#[non_exhaustive]
pub enum Reader {
    /// The general reader of numbers in rows and columns.
    Table,
    /// CGATS and its relatives, as Argyll and X-Rite write them.
    Cgats,
    /// JCAMP-DX.
    Jcamp,
    /// XML of IES TM-27 (`.spdx`).
    Tm27,
    /// XML of `CxF3`.
    Cxf,
    /// JSON of rawtoaces.
    Rawtoaces,
    /// JSON of dcamprof, with or without comments.
    Dcamprof,
    /// JSON of Wasatch ENLIGHTEN.
    Enlighten,
    /// One sample a line, its wavelength at the end of a label, as Sekonic meters write.
    Labels,
    /// Wavelengths and values on alternate lines, as Macam writes.
    Alternate,
    /// Cameras by name, each with three lines of 33 values.
    Camspec,
}

impl Reader {
    /// All readers.
    pub const ALL: [Self; 11] = [
        Self::Table,
        Self::Cgats,
        Self::Jcamp,
        Self::Tm27,
        Self::Cxf,
        Self::Rawtoaces,
        Self::Dcamprof,
        Self::Enlighten,
        Self::Labels,
        Self::Alternate,
        Self::Camspec,
    ];
}

impl fmt::Display for Reader {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Table => "table of numbers",
            Self::Cgats => "CGATS",
            Self::Jcamp => "JCAMP-DX",
            Self::Tm27 => "IES TM-27",
            Self::Cxf => "CxF",
            Self::Rawtoaces => "rawtoaces JSON",
            Self::Dcamprof => "dcamprof JSON",
            Self::Enlighten => "Wasatch ENLIGHTEN JSON",
            Self::Labels => "one labeled sample a line",
            Self::Camspec => "database of cameras, untested on a real file",
            Self::Alternate => "wavelengths and values on alternate lines",
        })
    }
}

/// In what the wavelengths of a file are measured. They are taken as they are: the difference is 0.03 %.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Medium {
    /// Air.
    Air,
    /// Vacuum.
    Vacuum,
}

impl fmt::Display for Medium {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Air => "wavelengths in air, taken as they are",
            Self::Vacuum => "wavelengths in vacuum, taken as they are",
        })
    }
}

/// One of several tables, blocks or groups in a file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Part {
    /// The line where its numbers begin, from 1.
    pub line: usize,
    /// Its name in the file, or an empty text.
    pub name: String,
    /// Curves in it.
    pub curves: usize,
    /// Rows of numbers in it (samples, where wavelengths run down).
    pub rows: usize,
}

/// Reason that a row is in no curve.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Dropped {
    /// It has values but no wavelength.
    NoWavelength,
    /// It repeats an earlier row exactly.
    Repeated,
    /// Another row has other values at its wavelength: their mean was taken.
    Averaged,
}

impl fmt::Display for Dropped {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::NoWavelength => "no wavelength",
            Self::Repeated => "the same as an earlier row",
            Self::Averaged => "merged with rows of the same wavelength, of which the mean was taken",
        })
    }
}

/// A row that is in no curve.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct DroppedRow {
    /// Its line, from 1.
    pub line: usize,
    /// Reason.
    pub why: Dropped,
}

/// The distances between neighboring wavelengths, in nanometers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Steps {
    /// The smallest.
    pub min: f64,
    /// The median.
    pub median: f64,
    /// The largest.
    pub max: f64,
}

impl Steps {
    /// The steps of ascending wavelengths, of which there are at least two.
    pub(super) fn of(wavelengths_nm: &[f64]) -> Self {
        let mut steps: Vec<f64> = wavelengths_nm.windows(2).map(|pair| clean(pair[1] - pair[0])).collect();
        steps.sort_unstable_by(f64::total_cmp);
        let at = |i: usize| steps.get(i).copied().unwrap_or(0.0);
        Self { min: at(0), median: at(steps.len() / 2), max: at(steps.len().saturating_sub(1)) }
    }
}

/// Decisions made while reading a file, from its bytes to its units.
#[derive(Debug, Clone, PartialEq)]
pub struct ReadReport {
    /// Reader that read the file.
    pub reader: Decided<Reader>,
    /// The encoding of the bytes.
    pub encoding: Encoding,
    /// Separator of cells.
    pub delimiter: Decided<Delimiter>,
    /// Decimal mark.
    pub decimal_mark: Decided<DecimalMark>,
    /// True if the other mark, where it stands before three digits, was taken to group thousands.
    pub thousands: bool,
    /// Direction of the wavelengths: down a column or across a row.
    pub orientation: Decided<Orientation>,
    /// The unit of the wavelengths as written.
    pub wavelength_unit: Decided<WavelengthUnit>,
    /// The column of the wavelengths, from 1, where they run down one.
    pub wavelength_column: Option<usize>,
    /// Scale of the values, or of those of the columns that the header marks.
    pub values: Decided<Values>,
    /// Role of the curves by their file and what stands beside it, whatever was chosen.
    pub content_role: Decided<Role>,
    /// The physical quantity of the values.
    pub quantity: Decided<Quantity>,
    /// For camera sensitivities, whether they are responses per photon and not per energy.
    pub per_photon: Option<Decided<bool>>,
    /// The tables, blocks or groups of the file that have spectra, in its order; the first thousand. At least one.
    pub parts: Vec<Part>,
    /// Number of the part that was read, from 1; 0 if all were, side by side.
    pub part: Decided<usize>,
    /// Decisions that only some families of files need, such as which block was taken.
    pub notes: Vec<Decision>,
    /// The comments above the table, `# key: value`, in order; the first thousand.
    pub header: Vec<(String, String)>,
    /// The line with the names of the columns.
    pub header_line: Option<usize>,
    /// The line where the numbers begin.
    pub first_data_line: usize,
    /// Rows of numbers, those dropped among them.
    pub rows: usize,
    /// Rows that are in no curve; the first thousand.
    pub dropped_rows: Vec<DroppedRow>,
    /// True if the wavelengths came in descending order.
    pub descending: bool,
    /// The first and the last wavelength, in nanometers.
    pub range_nm: [f64; 2],
    /// The distances between wavelengths.
    pub step_nm: Steps,
    /// For camera sensitivities, which curves are red, green and blue.
    pub camera_columns: Option<[usize; 3]>,
}

impl ReadReport {
    /// Every decision, in the order in which they were made.
    pub fn decisions(&self) -> Vec<Decision> {
        let mut all = Vec::new();
        if self.reader.value != Reader::Table || self.reader.certainty == Certainty::Chosen {
            all.push(Decision::new("Layout", &self.reader));
        }
        // The form of JCAMP-DX, among the notes, stands for both: its data are no columns.
        let columns = self.reader.value != Reader::Jcamp;
        all.push(Decision::new("Encoding", &self.decided_encoding()));
        all.extend(columns.then(|| Decision::new("Separator", &self.delimiter).affecting(Effect::Data)));
        all.push(Decision::new("Decimal mark", &self.decimal_mark));
        all.extend(columns.then(|| Decision::new("Orientation", &self.orientation)));
        all.extend([
            Decision::new("Wavelengths", &self.wavelength_unit).affecting(Effect::Data),
            Decision::new("Values", &self.values).affecting(Effect::Scale),
            Decision::new("Quantity", &self.quantity),
        ]);
        if let Some(per_photon) = &self.per_photon {
            let what = if per_photon.value { "responses per photon" } else { "responses per energy" };
            all.push(Decision::new("Response", &per_photon.described(what)));
        }
        if self.parts.len() > 1 {
            all.push(Decision::new("Part", &self.part.described(&self.part_description())).affecting(Effect::Data));
        }
        all.extend(self.notes.iter().cloned());
        all
    }

    /// The value of a comment, such as `title`, whatever the case of its key.
    pub fn comment(&self, key: &str) -> Option<&str> {
        self.header.iter().find(|(name, _)| name.eq_ignore_ascii_case(key)).map(|(_, value)| value.as_str())
    }

    fn part_description(&self) -> String {
        let count = self.parts.len();
        match self.part.value.checked_sub(1).map(|index| (index, self.parts.get(index))) {
            None => format!("curves side by side, not one of the {count} parts alone"),
            Some((index, part)) => {
                format!("part {} of {count}, from line {}", index + 1, part.map_or(1, |part| part.line))
            }
        }
    }

    fn decided_encoding(&self) -> Decided<Encoding> {
        let certain = |why: &str| Decided::certain(self.encoding, why);
        match self.encoding {
            Encoding::Utf8 => certain("The bytes are valid UTF-8"),
            Encoding::Utf16Le | Encoding::Utf16Be => certain("A byte order mark, or zeros in every other byte, say so"),
            Encoding::Windows1252 => certain("The bytes are not UTF-8"),
            Encoding::ShiftJis => Decided::guess(self.encoding, "The bytes are not UTF-8, but sound Japanese"),
        }
    }
}
