//! Marks of tables whose wavelengths run across a header row.

use std::collections::BTreeSet;
use std::ops::Range;

use crate::decision::WavelengthUnit;
use crate::dialect::{Cell, Dialect};
use crate::layout::Layout;
use crate::preview::cells;
use crate::preview::down::{line_mark, value};
use crate::preview::mark::{LeftOut, Mark, What};
use crate::report::SpectralFile;
use crate::{dialect_trial, header_terms, wide};

/// The columns and rows of a table that became curves.
#[derive(Debug, Clone)]
pub(super) struct Across {
    dialect: Dialect,
    line: usize,
    /// The column of the first wavelength, from 0.
    start: usize,
    /// The wavelengths in the order of the columns; `None` where none can be read, or again.
    wavelengths: Vec<Option<f64>>,
    names: usize,
    /// The line of each curve, in ascending order, and the curve.
    pub(super) rows: Vec<(usize, usize)>,
}

impl Across {
    pub(super) fn new(layout: &Layout, across: &dialect_trial::Across, header: &str, unit: WavelengthUnit) -> Self {
        let (group, dialect) = (across.group(), layout.dialect());
        let heads: Vec<&str> = dialect.cells(header).take(group.start).collect();
        let mut seen = BTreeSet::new();
        let written = group.wavelengths.iter().map(|wavelength| unit.nanometers(*wavelength));
        Self {
            dialect,
            line: across.line,
            start: group.start,
            wavelengths: written.map(|nm| Some(nm).filter(|nm| !nm.is_nan() && seen.insert(nm.to_bits()))).collect(),
            names: wide::name_column(&heads),
            rows: Vec::new(),
        }
    }

    pub(super) fn marks(&self, number: usize, line: &str, window: &Range<usize>, file: &SpectralFile) -> Vec<Mark> {
        if number == self.line {
            return self.header(line, window);
        }
        match self.rows.binary_search_by_key(&number, |(line, _)| *line) {
            Ok(at) => self.row(line, self.rows[at].1, window, file),
            Err(_) if number > self.line && cells::is_content(line) => line_mark(line, window, LeftOut::Line),
            Err(_) => Vec::new(),
        }
    }

    fn header(&self, line: &str, window: &Range<usize>) -> Vec<Mark> {
        let marks = cells::within(self.dialect, line, window).filter_map(|(column, range, cell)| {
            let what = match column.checked_sub(self.start) {
                None => What::Unit(header_terms::x_unit(cell).map(|_| None)?),
                Some(index) => match self.wavelengths.get(index)? {
                    Some(nm) => What::Wavelength(*nm),
                    None => What::LeftOut(LeftOut::Column),
                },
            };
            Some(Mark::new(range, what))
        });
        marks.collect()
    }

    fn row(&self, line: &str, curve: usize, window: &Range<usize>, file: &SpectralFile) -> Vec<Mark> {
        let mut leading = self.dialect.cells(line).take(self.start);
        let named = leading.clone().nth(self.names).is_some_and(|cell| !cell.is_empty());
        let name = if named { Some(self.names) } else { leading.position(|cell| !cell.is_empty()) };
        let marks = cells::within(self.dialect, line, window).filter_map(|(column, range, cell)| {
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
            Some(Mark::new(range, what))
        });
        marks.collect()
    }
}
