//! Cells of a line with their places.

use std::ops::Range;

use crate::dialect::{Cell, Dialect};
use crate::file::Curve;
use crate::separators::{DecimalMark, Delimiter};
use crate::text;
use crate::wavelength_unit::WavelengthUnit;

/// Offset of a piece of a text in it.
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

/// True for a line that can be a row: neither blank nor a comment.
pub(super) fn is_content(line: &str) -> bool {
    !line.trim_ascii().is_empty() && text::comment(line).is_none()
}

/// True for a range that touches a window; an empty range touches where it stands.
pub(super) fn touches(range: &Range<usize>, window: &Range<usize>) -> bool {
    range.start < window.end && range.end >= window.start
}

/// The cells of a line that touch a window, with their columns.
pub(super) fn within<'a>(
    dialect: Dialect,
    line: &'a str,
    window: &Range<usize>,
) -> impl Iterator<Item = (usize, Range<usize>, &'a str)> {
    let cells = dialect.cells(line).enumerate().map(move |(column, cell)| (column, range(line, cell), cell));
    cells.take_while(|(_, range, _)| range.start < window.end).filter(|(_, range, _)| range.end >= window.start)
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

/// The content of a cell, a unit beside its number aside.
pub(super) fn parse(dialect: Dialect, cell: &str) -> Cell {
    match dialect.parse(cell) {
        Cell::Text => dialect.parse_united(cell).map_or(Cell::Text, |(value, _)| Cell::Number(value)),
        other => other,
    }
}

/// A number as written, with either decimal mark.
pub(super) fn number(text: &str) -> Option<f64> {
    let mark = if text.contains(',') { DecimalMark::Comma } else { DecimalMark::Point };
    match Dialect::new(Delimiter::Spaces, mark).parse(text) {
        Cell::Number(value) => Some(value),
        Cell::Gap | Cell::Text => None,
    }
}

/// The wavelength and the value of the sample nearest to a wavelength, if it is at that wavelength but for rounding.
pub(super) fn sample(curve: &Curve, nm: f64) -> Option<(f64, f64)> {
    const ROUNDING_NM: f64 = 1e-6;
    let at = curve.wavelengths_nm.partition_point(|wavelength| *wavelength < nm - ROUNDING_NM);
    let found = curve.wavelengths_nm.get(at).filter(|found| (**found - nm).abs() <= ROUNDING_NM)?;
    Some((*found, *curve.values.get(at)?))
}
