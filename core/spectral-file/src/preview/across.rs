//! Marks of tables whose wavelengths run across a header row.

use std::collections::BTreeSet;
use std::ops::Range;

use super::super::bands;
use super::super::dialect::{Cell, Dialect};
use super::super::{Curve, Table, words};
use super::Preview;
use super::cells::{self, Conversion};
use super::mark::{LeftOut, Mark, What};

/// Values that must be those of a curve before a row is taken for it.
const ENOUGH: usize = 16;

/// How the rows of a table became curves.
#[derive(Debug, Clone)]
pub(super) struct Across {
    dialect: Dialect,
    conversion: Conversion,
    /// The line of the wavelengths.
    line: usize,
    /// The column of the first wavelength, from 0.
    start: usize,
    /// The wavelengths in the order of the columns; `None` where none can be read.
    wavelengths: Vec<Option<f64>>,
    /// The line of each curve.
    rows: Vec<usize>,
}

impl Across {
    pub(super) fn new(preview: &Preview, table: &Table) -> Self {
        let reading = &table.reading;
        let mut across = Self {
            dialect: cells::dialect(reading),
            conversion: Conversion::of(table),
            line: reading.header_line.unwrap_or(1),
            start: 0,
            wavelengths: Vec::new(),
            rows: Vec::with_capacity(table.curves.len()),
        };
        across.find_wavelengths(preview.line(across.line).unwrap_or(""), table);
        let mut curves = table.curves.iter();
        let mut next = curves.next();
        for (number, line) in
            preview.lines_from(across.line.saturating_add(1)).filter(|(_, line)| !line.trim_ascii().is_empty())
        {
            let Some(curve) = next else { break };
            if across.fits(line, curve) {
                across.rows.push(number);
                next = curves.next();
            }
        }
        across
    }

    /// The wavelengths of the group that was taken.
    fn find_wavelengths(&mut self, header: &str, table: &Table) {
        let groups = bands::groups(self.dialect, header);
        let part = groups.len().min(table.reading.part.value.max(1)).saturating_sub(1);
        let Some(group) = groups.get(part) else { return };
        self.start = group.start;
        let mut seen = BTreeSet::new();
        let unit = table.reading.wavelength_unit.value;
        let written = group.wavelengths.iter().map(|wavelength| unit.nanometers(*wavelength));
        self.wavelengths = written.map(|nm| Some(nm).filter(|nm| !nm.is_nan() && seen.insert(nm.to_bits()))).collect();
    }

    /// Whether a row begins with the values of a curve.
    fn fits(&self, line: &str, curve: &Curve) -> bool {
        let mut same = 0;
        let mut columns = self.wavelengths.iter();
        for cell in self.dialect.cells(line).skip(self.start) {
            let Some(column) = columns.next() else { break };
            let Some(nm) = column else { continue };
            match (self.dialect.parse(cell), cells::at(curve, *nm)) {
                (Cell::Number(written), Some(value)) if self.conversion.gives(written, value) => same += 1,
                (Cell::Gap | Cell::Number(_), None) => {}
                _ => return false,
            }
            if same == ENOUGH {
                return true;
            }
        }
        same > 1
    }

    pub(super) fn marks(&self, number: usize, line: &str, window: &Range<usize>, table: &Table) -> Vec<Mark> {
        if number == self.line {
            return self.header(line, window);
        }
        let found = self.rows.binary_search(&number).ok();
        if number < self.line || (found.is_none() && !cells::is_content(line)) {
            return Vec::new();
        }
        let marks = found.and_then(|curve| self.row(line, curve, window, table));
        marks.unwrap_or_else(|| {
            let mark = Mark::new(cells::trimmed(line), What::LeftOut { why: LeftOut::Line });
            Some(mark).filter(|mark| cells::touches(&mark.range, window)).into_iter().collect()
        })
    }

    fn header(&self, line: &str, window: &Range<usize>) -> Vec<Mark> {
        self.pieces(line, window, |column, cell| match column.checked_sub(self.start) {
            None => words::x_unit(cell).map(|_| What::Unit { curve: None }),
            Some(index) => self.wavelengths.get(index).map(|nm| match nm {
                Some(nm) => What::Wavelength { nm: *nm },
                None => What::LeftOut { why: LeftOut::Column },
            }),
        })
    }

    fn row(&self, line: &str, index: usize, window: &Range<usize>, table: &Table) -> Option<Vec<Mark>> {
        let curve = table.curves.get(index)?;
        let mut named = false;
        let mut wrong = false;
        let marks = self.pieces(line, window, |column, cell| {
            let Some(at) = column.checked_sub(self.start) else {
                let is_name = curve.named && !named && cell.replace("\"\"", "\"") == curve.name;
                named |= is_name;
                let other = (!cell.is_empty()).then_some(What::LeftOut { why: LeftOut::Column });
                return if is_name { Some(What::Name { curve: index }) } else { other };
            };
            let Some(nm) = self.wavelengths.get(at)? else { return Some(What::LeftOut { why: LeftOut::Column }) };
            match (self.dialect.parse(cell), cells::at(curve, *nm)) {
                (Cell::Number(written), Some(value)) if self.conversion.gives(written, value) => {
                    Some(What::Value { curve: index, nm: *nm, value, written })
                }
                (Cell::Gap | Cell::Number(_), None) => Some(What::Gap { curve: index }),
                _ => {
                    wrong = true;
                    None
                }
            }
        });
        (!wrong).then_some(marks)
    }

    /// The cells of a line in a window that are something.
    fn pieces(
        &self,
        line: &str,
        window: &Range<usize>,
        mut what: impl FnMut(usize, &str) -> Option<What>,
    ) -> Vec<Mark> {
        let cells = self.dialect.cells(line).map(|cell| (cells::range(line, cell), cell)).enumerate();
        let seen = cells.take_while(|(_, (range, _))| range.start < window.end);
        let inside = seen.filter(|(_, (range, _))| cells::touches(range, window));
        inside.filter_map(|(column, (range, cell))| what(column, cell).map(|what| Mark::new(range, what))).collect()
    }
}
