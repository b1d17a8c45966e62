//! Cells of a line with their places, the place at which reading failed, and marks of tables: wavelengths run down a column, or
//! across a header row.

use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;

use crate::decision::{DecimalMark, Delimiter, Dropped, WavelengthUnit};
use crate::dialect::{Cell, Dialect};
use crate::dialect_trial::Layout;
use crate::error::ReadError;
use crate::grid::Grid;
use crate::preview::mark::{LeftOut, Mark, What};
use crate::report::{Curve, SpectralFile};
use crate::text::{self, excerpt};
use crate::{dialect_trial, header_terms, wide};

/// The columns and rows of a table that became curves.
#[derive(Debug, Clone)]
pub(super) struct Down {
    dialect: Dialect,
    axes: Vec<(usize, WavelengthUnit)>,
    pub(super) curves: Vec<Option<usize>>,
    /// The columns of uncertainties, with the index of their curve.
    pub(super) uncertain: BTreeMap<usize, usize>,
    /// The line of names, and how many columns it omits at its beginning.
    names: Option<usize>,
    shift: usize,
    units: Option<usize>,
    first_line: usize,
    /// The wavelength of each line of values, by line; NaN where curves have wavelengths of their own.
    rows: Vec<(u32, f64)>,
    dropped: Vec<(u32, LeftOut)>,
}

impl Down {
    pub(super) fn new(grid: &Grid, layout: &Layout, unit: WavelengthUnit) -> Self {
        let first = (grid.wavelength_column.unwrap_or(1).saturating_sub(1), None);
        let axes = [first].into_iter().chain(grid.axes.iter().copied());
        let own = grid.row_lines.iter().map(|line| (*line as u32, f64::NAN));
        let shared = grid.lines.iter().zip(&grid.wavelengths).map(|(line, nm)| (*line as u32, *nm));
        let mut rows: Vec<(u32, f64)> = if own.len() > 0 { own.collect() } else { shared.collect() };
        rows.sort_unstable_by_key(|(line, _)| *line);
        let mut dropped: Vec<(u32, LeftOut)> =
            grid.dropped.iter().map(|row| (row.line as u32, left_out(row.why))).collect();
        dropped.sort_unstable_by_key(|(line, _)| *line);
        let header = &grid.header;
        Self {
            dialect: layout.dialect(),
            axes: axes.map(|(column, own)| (column, own.unwrap_or(unit))).collect(),
            curves: Vec::new(),
            uncertain: BTreeMap::new(),
            names: header.line.filter(|_| !header.names.is_empty()),
            shift: usize::from(header.shifted),
            units: header.units_line,
            first_line: layout.first_line,
            rows,
            dropped,
        }
    }

    fn no_curve(&self, column: usize) -> What {
        self.uncertain.get(&column).map_or(What::LeftOut(LeftOut::Column), |curve| What::Uncertainty(*curve))
    }

    fn axis(&self, column: usize) -> Option<WavelengthUnit> {
        self.axes.iter().find(|(axis, _)| *axis == column).map(|(_, unit)| *unit)
    }

    pub(super) fn marks(&self, number: usize, line: &str, window: &Range<usize>, file: &SpectralFile) -> Vec<Mark> {
        let names = self.names == Some(number);
        if names || self.units == Some(number) {
            return self.above(line, names, window);
        }
        if number < self.first_line || !is_content(line) {
            return Vec::new();
        }
        let find = |rows: &[(u32, LeftOut)]| rows.binary_search_by_key(&number, |(line, _)| *line as usize).ok();
        if let Some(at) = find(&self.dropped) {
            return line_mark(line, window, What::LeftOut(self.dropped[at].1));
        }
        match self.rows.binary_search_by_key(&number, |(line, _)| *line as usize) {
            Ok(at) => self.values(line, self.rows[at].1, window, file),
            Err(_) if self.dialect.cells(line).all(|cell| self.dialect.parse(cell) == Cell::Gap) => Vec::new(),
            Err(_) => line_mark(line, window, What::LeftOut(LeftOut::Line)),
        }
    }

    fn values(&self, line: &str, shared: f64, window: &Range<usize>, file: &SpectralFile) -> Vec<Mark> {
        let mut nm = shared;
        let mut marks = Vec::new();
        for (column, cell) in self.dialect.cells(line).enumerate() {
            let range = range(line, cell);
            if range.start >= window.end {
                break;
            }
            let axis = self.axis(column);
            if let Some(unit) = axis.filter(|_| shared.is_nan()) {
                nm = wavelength(self.dialect, unit, cell).unwrap_or(f64::NAN);
            }
            if !touches(&range, window) {
                continue;
            }
            let what = match (self.curves.get(column).copied().flatten(), parse(self.dialect, cell)) {
                _ if axis.is_some() && nm.is_nan() => continue,
                _ if axis.is_some() => What::Wavelength(nm),
                (None, Cell::Gap) if cell.is_empty() => continue,
                (None, _) => self.no_curve(column),
                (Some(curve), Cell::Number(written)) => value(written, curve, nm, file),
                (Some(curve), Cell::Gap | Cell::Text) => What::Gap(curve),
            };
            marks.push(Mark { range, what });
        }
        marks
    }

    /// Marks of the cells of a line above the table, one of names or of units.
    fn above(&self, line: &str, names: bool, window: &Range<usize>) -> Vec<Mark> {
        let is_unit = |cell: &str| header_terms::x_unit(cell).is_some() || header_terms::names_wavelengths(cell);
        let shift = if names { self.shift } else { 0 };
        let cells = self.dialect.cells(text::comment(line).unwrap_or(line)).enumerate();
        let marks = cells.filter(|(_, cell)| !cell.is_empty()).filter_map(|(index, cell)| {
            let what = match self.curves.get(index + shift) {
                _ if self.axis(index + shift).is_some() => {
                    Some(What::Unit(None)).filter(|_| !names || is_unit(cell))?
                }
                Some(Some(curve)) if names => What::Name(*curve),
                Some(Some(curve)) => What::Unit(Some(*curve)),
                _ => self.no_curve(index + shift),
            };
            Some(Mark { range: range(line, cell), what }).filter(|mark| touches(&mark.range, window))
        });
        marks.collect()
    }
}

pub(super) fn line_mark(line: &str, window: &Range<usize>, what: What) -> Vec<Mark> {
    let mark = Mark { range: trimmed(line), what };
    Some(mark).filter(|mark| touches(&mark.range, window)).into_iter().collect()
}

/// A number of a curve; a gap where the curve has no value, such as at a number that stands for a missing one.
pub(super) fn value(written: f64, curve: usize, nm: f64, file: &SpectralFile) -> What {
    match file.curves.get(curve).and_then(|curve| sample(curve, nm)) {
        Some((nm, value)) => What::Value { curve, nm, value, written },
        None => What::Gap(curve),
    }
}

fn left_out(why: Dropped) -> LeftOut {
    match why {
        Dropped::NoWavelength => LeftOut::NoWavelength,
        Dropped::OutOfRange => LeftOut::OutOfRange,
        Dropped::Repeated => LeftOut::Repeated,
        Dropped::Averaged => LeftOut::Averaged,
    }
}

#[derive(Debug, Clone)]
pub(super) struct Across {
    dialect: Dialect,
    line: usize,
    start: usize,
    /// Columns by which rows stand further right than their heads.
    shift: isize,
    /// The wavelengths in the order of the columns; `None` where none can be read, or again.
    wavelengths: Vec<Option<f64>>,
    names: usize,
    /// The line of each curve, in ascending order, and the curve.
    pub(super) rows: Vec<(usize, usize)>,
    /// The lines of uncertainties, with the index of their curve.
    pub(super) uncertain: Vec<(usize, usize)>,
}

impl Across {
    pub(super) fn new(layout: &Layout, across: &dialect_trial::Across, header: &str, unit: WavelengthUnit) -> Self {
        let (group, dialect) = (across.group(), layout.dialect());
        let heads = across.heads(dialect.cells(header));
        let mut seen = BTreeSet::new();
        let written = group.wavelengths.iter().map(|wavelength| unit.nanometers(*wavelength));
        Self {
            dialect,
            line: across.line,
            start: group.start,
            shift: across.shift,
            wavelengths: written.map(|nm| Some(nm).filter(|nm| !nm.is_nan() && seen.insert(nm.to_bits()))).collect(),
            names: wide::name_column(&heads[..group.start.min(heads.len())]),
            rows: Vec::new(),
            uncertain: Vec::new(),
        }
    }

    pub(super) fn marks(&self, number: usize, line: &str, window: &Range<usize>, file: &SpectralFile) -> Vec<Mark> {
        if let Some((_, curve)) = self.uncertain.iter().find(|(line, _)| *line == number) {
            return line_mark(line, window, What::Uncertainty(*curve));
        }
        if number == self.line {
            return self.header(line, window);
        }
        match self.rows.binary_search_by_key(&number, |(line, _)| *line) {
            Ok(at) => self.row(line, self.rows[at].1, window, file),
            Err(_) if number > self.line && is_content(line) => line_mark(line, window, What::LeftOut(LeftOut::Line)),
            Err(_) => Vec::new(),
        }
    }

    fn header(&self, line: &str, window: &Range<usize>) -> Vec<Mark> {
        let marks = within(self.dialect, line, window).filter_map(|(column, range, cell)| {
            let what = match column.checked_add_signed(self.shift).and_then(|column| column.checked_sub(self.start)) {
                None => What::Unit(header_terms::x_unit(cell).map(|_| None)?),
                Some(index) => match self.wavelengths.get(index)? {
                    Some(nm) => What::Wavelength(*nm),
                    None => What::LeftOut(LeftOut::Column),
                },
            };
            Some(Mark { range, what })
        });
        marks.collect()
    }

    fn row(&self, line: &str, curve: usize, window: &Range<usize>, file: &SpectralFile) -> Vec<Mark> {
        let mut leading = self.dialect.cells(line).take(self.start);
        let named = leading.clone().nth(self.names).is_some_and(|cell| !cell.is_empty());
        let name = if named { Some(self.names) } else { leading.position(|cell| !cell.is_empty()) };
        let marks = within(self.dialect, line, window).filter_map(|(column, range, cell)| {
            let what = match column.checked_sub(self.start) {
                None if name == Some(column) => What::Name(curve),
                None if cell.is_empty() => return None,
                None => What::LeftOut(LeftOut::Column),
                Some(at) => match (self.wavelengths.get(at)?, self.dialect.parse(cell)) {
                    (None, _) => What::LeftOut(LeftOut::Column),
                    (Some(nm), Cell::Number(written)) => value(written, curve, *nm, file),
                    (Some(_), Cell::Gap | Cell::Text) => What::Gap(curve),
                },
            };
            Some(Mark { range, what })
        });
        marks.collect()
    }
}

pub(super) fn offset(text: &str, piece: &str) -> usize {
    piece.as_ptr().addr().saturating_sub(text.as_ptr().addr()).min(text.len())
}

pub(super) fn range(line: &str, piece: &str) -> Range<usize> {
    let start = offset(line, piece);
    start..start + piece.len()
}

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
