//! Cells of a line with their places, and the place at which reading failed.

use std::ops::Range;

use crate::decision::{DecimalMark, Delimiter, WavelengthUnit};
use crate::dialect::{Cell, Dialect};
use crate::error::ReadError;
use crate::report::Curve;
use crate::text::{self, excerpt};

pub(super) fn offset(text: &str, piece: &str) -> usize {
    piece.as_ptr().addr().saturating_sub(text.as_ptr().addr()).min(text.len())
}

pub(super) fn range(line: &str, piece: &str) -> Range<usize> {
    let start = offset(line, piece);
    start..start + piece.len()
}

/// The bytes of a line without the white space around it.
pub(super) fn trimmed(line: &str) -> Range<usize> {
    range(line, line.trim())
}

/// True for a line that can be a row: neither blank nor a comment.
pub(super) fn is_content(line: &str) -> bool {
    !line.trim_ascii().is_empty() && text::comment(line).is_none()
}

/// True for a range that touches a window; an empty range touches where it stands.
pub(super) fn touches(range: &Range<usize>, window: &Range<usize>) -> bool {
    range.start < window.end && range.end >= window.start
}

pub(super) fn within<'a>(
    dialect: Dialect,
    line: &'a str,
    window: &Range<usize>,
) -> impl Iterator<Item = (usize, Range<usize>, &'a str)> {
    let cells = dialect.cells(line).enumerate().map(move |(column, cell)| (column, range(line, cell), cell));
    cells.take_while(|(_, range, _)| range.start < window.end).filter(|(_, range, _)| range.end >= window.start)
}

pub(super) fn wavelength(dialect: Dialect, unit: WavelengthUnit, cell: &str) -> Option<f64> {
    let written = match dialect.parse(cell) {
        Cell::Number(value) => value,
        Cell::Gap => return None,
        Cell::Text => dialect.parse_label(cell)?.0,
    };
    Some(unit.nanometers(written)).filter(|nm| nm.is_finite())
}

/// The content of a cell, a unit beside its number aside.
pub(super) fn parse(dialect: Dialect, cell: &str) -> Cell {
    match dialect.parse(cell) {
        Cell::Text => dialect.parse_united(cell).map_or(Cell::Text, |(value, _)| Cell::Number(value)),
        other => other,
    }
}

/// A number as written, with either decimal mark.
pub(super) fn number(text: &str) -> Option<f64> {
    Dialect::of_number(text).value(text).filter(|value| !value.is_nan())
}

/// The wavelength and the value of the sample nearest to a wavelength, if it is at that wavelength but for rounding.
pub(super) fn sample(curve: &Curve, nm: f64) -> Option<(f64, f64)> {
    const ROUNDING_NM: f64 = 1e-6;
    let at = curve.wavelengths_nm.partition_point(|wavelength| *wavelength < nm - ROUNDING_NM);
    let found = curve.wavelengths_nm.get(at).filter(|found| (**found - nm).abs() <= ROUNDING_NM)?;
    Some((*found, *curve.values.get(at)?))
}

/// The bytes of a line that an error is about; the whole line where nothing closer is known.
pub(super) fn of_error(line: &str, error: &ReadError) -> Range<usize> {
    let found = match error {
        ReadError::AsChosen { error, .. } => return of_error(line, error),
        ReadError::NotANumber { column, text, .. } => cell(line, *column, text),
        ReadError::Malformed { column, .. } => Some(word(line, *column)),
        _ => None,
    };
    found.filter(|range| !range.is_empty()).unwrap_or_else(|| trimmed(line))
}

/// The cell of a column that begins with what the error quotes, or the first place where that stands.
fn cell(line: &str, column: usize, quoted: &str) -> Option<Range<usize>> {
    const ALL: [Delimiter; 5] =
        [Delimiter::Semicolon, Delimiter::Tab, Delimiter::CommaSpace, Delimiter::Comma, Delimiter::Spaces];
    let cells = ALL.iter().filter_map(|&delimiter| {
        let dialect = Dialect::new(delimiter, DecimalMark::Point);
        dialect.cells(line).nth(column.checked_sub(1)?)
    });
    let exact = cells.into_iter().find(|cell| excerpt(cell) == quoted);
    let start = quoted.trim_end_matches('\u{2026}');
    exact.map(|cell| range(line, cell)).or_else(|| {
        let at = line.find(start).filter(|_| !start.is_empty())?;
        Some(at..at + start.len())
    })
}

/// The word that begins at a character, counted from 1, or the last character of a shorter line.
fn word(line: &str, column: usize) -> Range<usize> {
    let last = line.char_indices().next_back().map_or(0, |(at, _)| at);
    let start = line.char_indices().nth(column.saturating_sub(1)).map_or(last, |(at, _)| at);
    let first = line[start..].chars().next().map_or(0, char::len_utf8);
    let rest = &line[start + first..];
    start..start + first + rest.find(|c: char| !c.is_alphanumeric()).unwrap_or(rest.len())
}
