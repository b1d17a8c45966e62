//! Cells with their places, and what all numbers of a table have in common.

use std::ops::Range;

use super::super::decimal;
use super::super::dialect::{Cell, Dialect};
use super::super::text;
use super::super::{Curve, Reading, Table, Values, WavelengthUnit};

/// Where a piece of a text begins in it.
pub(super) fn offset(text: &str, piece: &str) -> usize {
    piece.as_ptr().addr().saturating_sub(text.as_ptr().addr()).min(text.len())
}

/// The bytes that a piece of a line takes.
pub(super) fn range(line: &str, piece: &str) -> Range<usize> {
    let start = offset(line, piece);
    start..start + piece.len()
}

/// The bytes of a line without the white space around it.
pub(super) fn trimmed(line: &str) -> Range<usize> {
    range(line, line.trim())
}

/// Whether a line can be a row: neither blank nor a comment.
pub(super) fn is_content(line: &str) -> bool {
    !line.trim_ascii().is_empty() && text::comment(line).is_none()
}

/// Whether a range touches a window. An empty one does where it stands.
pub(super) fn touches(range: &Range<usize>, window: &Range<usize>) -> bool {
    range.start < window.end && range.end >= window.start
}

/// The dialect of a reading.
pub(super) fn dialect(reading: &Reading) -> Dialect {
    Dialect { delimiter: reading.delimiter.value, mark: reading.decimal_mark.value, thousands: reading.thousands }
}

/// The wavelength that a cell holds, in nanometers.
pub(super) fn wavelength(dialect: Dialect, unit: WavelengthUnit, cell: &str) -> Option<f64> {
    let written = match dialect.parse(cell) {
        Cell::Number(value) => value,
        Cell::Gap => return None,
        Cell::Text => dialect.parse_label(cell)?.0,
    };
    Some(unit.nanometers(written)).filter(|nm| nm.is_finite())
}

/// What a cell holds, with its unit or without.
pub(super) fn parse(dialect: Dialect, cell: &str) -> Cell {
    match dialect.parse(cell) {
        Cell::Text => dialect.parse_united(cell).map_or(Cell::Text, |(value, _)| Cell::Number(value)),
        other => other,
    }
}

/// The value of a curve at one of its wavelengths.
pub(super) fn at(curve: &Curve, nm: f64) -> Option<f64> {
    let index = curve.wavelengths_nm.binary_search_by(|probe| probe.total_cmp(&nm)).ok()?;
    curve.values.get(index).copied()
}

/// What is done to the numbers of a file before they are values.
#[derive(Debug, Clone, Copy)]
pub(super) struct Conversion {
    values: Values,
    /// What the file itself multiplies and divides by.
    pub(super) factor: f64,
    divisor: f64,
}

impl Conversion {
    pub(super) fn of(table: &Table) -> Self {
        let scale = table.reading.notes.iter().find(|note| note.what == "Scale");
        let divisor = scale.and_then(|note| note.value.strip_prefix("divided by ")?.parse().ok());
        let divisor = divisor.filter(|divisor: &f64| *divisor > 0.0).unwrap_or(1.0);
        Self { values: table.reading.values.value, factor: 1.0, divisor }
    }

    /// Whether a number as written is a value of the table. Not all curves of a table need be converted.
    pub(super) fn gives(self, written: f64, value: f64) -> bool {
        let scaled = decimal::divided(written * self.factor, self.divisor);
        let converted = match self.values {
            Values::Plain => scaled,
            Values::Percent => decimal::shifted(scaled, -2),
            Values::Absorbance => 10_f64.powf(-scaled),
            Values::Decibels => 10_f64.powf(scaled / 10.0),
        };
        scaled == value || converted == value
    }
}
