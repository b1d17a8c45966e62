//! Result of reading: curves, and the report of what was decided on the way, how sure it is, and why.

use serde::{Deserialize, Serialize};

use crate::decimal::clean;
use crate::decision::{
    Certainty, Decided, DecimalMark, Decision, Delimiter, Dropped, Effect, Encoding, Orientation, Part, Quantity,
    Reader, Role, Values, WavelengthUnit,
};
use crate::error::ReadError;
use crate::warning::Warning;

/// One curve: values over wavelength, in the order of wavelength.
#[derive(Debug, Clone, PartialEq)]
pub struct Curve {
    /// The name from the header, the title of the file, or `Column 2` and `Row 1`.
    pub name: String,
    /// True if the name is from the file; where it is not, the name of the file may say more.
    pub named: bool,
    /// Wavelengths in nanometers: finite, strictly ascending, at least two.
    pub wavelengths_nm: Vec<f64>,
    /// Values, one for each wavelength: finite; percent are already divided by 100.
    pub values: Vec<f64>,
    /// Number of wavelengths of the table without a value in this curve. They are omitted, not filled.
    pub missing: usize,
    /// The unit of the values as the file names it, such as `W/m²/nm` or `counts`.
    pub unit: Option<String>,
    /// Uncertainty of the values, where the file states it.
    pub uncertainty: Option<Uncertainty>,
}

/// Uncertainty of a curve's values.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Uncertainty {
    /// Standard uncertainty u of each value, in the unit of the values: finite, not negative.
    pub standard: Vec<f64>,
    /// Coverage factor k of the numbers in the file, which are k u.
    pub coverage: f64,
}

/// Covariance of all samples of a file's curves, curve after curve in the order of the file.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Covariance {
    /// Number of samples.
    pub size: usize,
    /// Rows of the symmetric matrix, `size` × `size`, in products of the units of the values: finite.
    pub values: Vec<f64>,
}

impl Covariance {
    /// The covariance of some of the samples, in the order of their indices; `None` if one of them is not in it.
    pub fn among(&self, samples: &[usize]) -> Option<Self> {
        if self.values.len() != self.size * self.size || samples.iter().any(|&sample| sample >= self.size) {
            return None;
        }
        let rows = samples.iter().map(|row| &self.values[row * self.size..][..self.size]);
        let values = rows.flat_map(|row| samples.iter().map(|&column| row[column])).collect();
        Some(Self { size: samples.len(), values })
    }
}

/// Curves of a file, with the report of how it was read.
#[derive(Debug, Clone, PartialEq)]
pub struct SpectralFile {
    /// The curves, in the order of the file; at least one.
    pub curves: Vec<Curve>,
    /// Covariance of their samples, where a file beside states it.
    pub covariance: Option<Covariance>,
    /// Role of the curves.
    pub role: Decided<Role>,
    /// Decisions made while reading.
    pub reading: ReadReport,
    /// Doubts to check before the curves are trusted.
    pub warnings: Vec<Warning>,
}

impl SpectralFile {
    /// This file, unless it holds values that no quantity of its role has: fractions of light far from 0 to 1, and numbers beyond any
    /// unit. A scale that is open, or that was chosen to be as written, is not judged.
    ///
    /// # Errors
    /// [`ReadError::ImpossibleValues`], with the first of them.
    pub fn usable(self) -> Result<Self, ReadError> {
        const NOISE: f64 = 0.05;
        let values = &self.reading.values;
        let asked = values.certainty == Certainty::Open || self.role.certainty == Certainty::Open;
        if asked || (values.certainty, values.value) == (Certainty::Chosen, Values::Plain) {
            return Ok(self);
        }
        let impossible = self.warnings.iter().find(|warning| match warning {
            Warning::NotReflectances { .. } => true,
            Warning::BelowZero { min, .. } => self.role.value.is_fraction() && *min < -NOISE,
            _ => false,
        });
        match impossible {
            Some(warning) => Err(ReadError::ImpossibleValues { line: warning.line(), what: warning.to_string() }),
            None => Ok(self),
        }
    }

    /// Every decision made on reading, the role first, ready to be listed for the user.
    pub fn decisions(&self) -> Vec<Decision> {
        let mut all = vec![Decision::new("Role", &self.role)];
        all.extend(self.reading.decisions());
        all
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
        if self.reader.value != Reader::TABLE || self.reader.certainty == Certainty::Chosen {
            all.push(Decision::new("Layout", &self.reader));
        }
        // The form of JCAMP-DX, among the notes, stands for both: its data are no columns.
        let columns = self.reader.value != Reader::JCAMP;
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
            Encoding::Dos => {
                Decided::guess(self.encoding, "The bytes are not UTF-8, and m² or µW is written as in DOS")
            }
            Encoding::Unknown => Decided::guess(
                self.encoding,
                "The bytes are no text in a known encoding: save the file as UTF-8 for its names",
            ),
            Encoding::ShiftJis => Decided::guess(self.encoding, "The bytes are not UTF-8, but sound Japanese"),
            Encoding::Gbk => {
                Decided::guess(self.encoding, "The bytes are not UTF-8, but hold Chinese words of spectra")
            }
        }
    }
}
