//! Marks of tables whose wavelengths run down a column.

use std::ops::Range;

use super::super::dialect::{Cell, Dialect};
use super::super::{Dropped, Table, WavelengthUnit, header, quantity, text, words};
use super::Preview;
use super::cells::{self, Conversion};
use super::mark::{LeftOut, Mark, What};

/// Rows that are compared to find which column is which curve.
const SAMPLE_ROWS: usize = 48;

/// Lines of so many bytes are looked at as a whole.
const SHORT: usize = 1 << 15;

/// The most cells that are compared for it.
const SAMPLE_CELLS: usize = 1 << 20;

/// The most rows that a reading lists as dropped; of more, the rest must be found.
const LISTED: usize = 1000;

/// How the columns of a table became curves.
#[derive(Debug, Clone)]
pub(super) struct Down {
    dialect: Dialect,
    unit: WavelengthUnit,
    conversion: Conversion,
    /// The column of the wavelengths, from 0.
    wavelength: usize,
    /// The curve of each column.
    curves: Vec<Option<usize>>,
    /// Columns of the table that the line of names leaves out at its beginning.
    shift: usize,
    /// Rows in no curve, by line.
    dropped: Vec<(usize, LeftOut)>,
}

/// A row that is looked at to find the columns.
struct Row {
    nm: f64,
    cells: Vec<Cell>,
}

impl Down {
    pub(super) fn new(preview: &Preview, table: &Table) -> Self {
        let reading = &table.reading;
        let mut down = Self {
            dialect: cells::dialect(reading),
            unit: reading.wavelength_unit.value,
            conversion: Conversion::of(table),
            wavelength: reading.wavelength_column.map_or(0, |column| column.saturating_sub(1)),
            curves: Vec::new(),
            shift: 0,
            dropped: dropped(table),
        };
        if reading.dropped_rows.len() >= LISTED {
            down.find_repeats(preview, reading.first_data_line);
        }
        let rows = down.sample(preview, table);
        let names =
            reading.header_line.and_then(|line| preview.line(line)).map_or_else(Vec::new, |line| down.names(line));
        let width = rows.iter().map(|row| row.cells.len()).max().unwrap_or(0);
        down.shift = usize::from(names.len() + 1 == width && !names.iter().any(|name| words::names_wavelengths(name)));
        down.curves = down.columns(&rows, &names, width, table);
        down
    }

    fn names(&self, line: &str) -> Vec<String> {
        header::split(self.dialect, text::comment(line).unwrap_or(line))
    }

    /// Some rows from all over the table.
    fn sample(&self, preview: &Preview, table: &Table) -> Vec<Row> {
        let first = table.reading.first_data_line.max(1);
        let lines = (preview.line_count() + 1).saturating_sub(first);
        let mut left = SAMPLE_CELLS;
        let mut rows = Vec::new();
        let mut next = first;
        for index in 0..SAMPLE_ROWS {
            let number = first.saturating_add(index * lines / SAMPLE_ROWS).max(next);
            next = number.saturating_add(1);
            let row = preview.line(number).filter(|line| cells::is_content(line)).and_then(|line| self.row(line));
            if let Some(row) = row.filter(|row| self.is_of(row, table)) {
                left = left.saturating_sub(row.cells.len());
                rows.push(row);
            }
            if left == 0 {
                break;
            }
        }
        rows
    }

    fn row(&self, line: &str) -> Option<Row> {
        let mut nm = None;
        let mut row = Vec::new();
        let mut filled = 0;
        for (index, cell) in self.dialect.cells(line).enumerate() {
            filled = if cell.is_empty() { filled } else { index + 1 };
            if index == self.wavelength {
                nm = cells::wavelength(self.dialect, self.unit, cell);
                row.push(Cell::Gap);
                continue;
            }
            // Columns of text are none of the curves.
            row.push(match cells::parse(self.dialect, cell) {
                Cell::Text => Cell::Gap,
                other => other,
            });
        }
        row.truncate(filled);
        Some(Row { nm: nm?, cells: row })
    }

    /// Whether some curve has a value where the row is.
    fn is_of(&self, row: &Row, table: &Table) -> bool {
        let (first, rest) = table.curves.split_first().map_or((None, &[][..]), |(first, rest)| (Some(first), rest));
        let numbers = row.cells.len() > self.wavelength;
        numbers && first.into_iter().chain(rest).any(|curve| cells::at(curve, row.nm).is_some())
    }

    /// The curve of each column: curves stand in the order of the columns, and some columns are none.
    fn columns(&self, rows: &[Row], names: &[String], width: usize, table: &Table) -> Vec<Option<usize>> {
        let mut curves = vec![None; width];
        let mut curve = 0;
        for (column, slot) in curves.iter_mut().enumerate().filter(|(column, _)| *column != self.wavelength) {
            let columns_left = width - column - usize::from(column < self.wavelength);
            let curves_left = table.curves.len() - curve;
            if curves_left == 0 {
                break;
            }
            let forced = columns_left <= curves_left;
            if forced || (self.is_named(names, column, curve, table) && self.fits(rows, column, curve, table)) {
                *slot = Some(curve);
                curve += 1;
            }
        }
        curves
    }

    fn is_named(&self, names: &[String], column: usize, curve: usize, table: &Table) -> bool {
        let name = column.checked_sub(self.shift).and_then(|column| names.get(column)).filter(|name| !name.is_empty());
        let curve = &table.curves[curve];
        name.is_none_or(|name| !curve.named || table.curves.len() == 1 || quantity::without_unit(name) == curve.name)
    }

    fn fits(&self, rows: &[Row], column: usize, curve: usize, table: &Table) -> bool {
        rows.iter().all(|row| {
            let value = cells::at(&table.curves[curve], row.nm);
            match (row.cells.get(column), value) {
                (Some(Cell::Number(written)), Some(value)) => self.conversion.gives(*written, value),
                (Some(Cell::Gap) | None, None) => true,
                _ => false,
            }
        })
    }

    /// Finds repeated rows beyond those that a reading lists.
    fn find_repeats(&mut self, preview: &Preview, first: usize) {
        let rows = preview.lines_from(first).filter(|(_, line)| cells::is_content(line));
        let mut all: Vec<(u64, usize)> = rows
            .filter_map(|(number, line)| {
                let cell = self.dialect.cells(line).nth(self.wavelength)?;
                Some((cells::wavelength(self.dialect, self.unit, cell)?.to_bits(), number))
            })
            .collect();
        all.sort_unstable();
        let repeats = all.windows(2).filter(|pair| pair[0].0 == pair[1].0).map(|pair| (pair[1].1, LeftOut::Repeated));
        self.dropped.extend(repeats);
        self.dropped.sort_unstable_by_key(|(line, _)| *line);
        self.dropped.dedup_by_key(|(line, _)| *line);
    }

    pub(super) fn marks(&self, number: usize, line: &str, window: &Range<usize>, table: &Table) -> Vec<Mark> {
        let reading = &table.reading;
        if reading.header_line == Some(number) {
            return self.header(line, window);
        }
        if number < reading.first_data_line {
            let below_names = reading.header_line.is_some_and(|names| names < number);
            return if below_names && cells::is_content(line) { self.units(line, window) } else { Vec::new() };
        }
        if !cells::is_content(line) {
            return Vec::new();
        }
        let whole = |why: LeftOut| {
            let mark = Mark::new(cells::trimmed(line), What::LeftOut { why });
            Some(mark).filter(|mark| cells::touches(&mark.range, window)).into_iter().collect()
        };
        if let Ok(index) = self.dropped.binary_search_by_key(&number, |(line, _)| *line) {
            return whole(self.dropped[index].1);
        }
        self.values(line, window, table).unwrap_or_else(|| whole(LeftOut::Line))
    }

    /// The numbers of a row; `None` if it is no row of the table.
    fn values(&self, line: &str, window: &Range<usize>, table: &Table) -> Option<Vec<Mark>> {
        let cell = self.dialect.cells(line).nth(self.wavelength)?;
        let nm = match cells::wavelength(self.dialect, self.unit, cell) {
            Some(nm) => nm,
            None if self.dialect.cells(line).all(|cell| self.dialect.parse(cell) == Cell::Gap) => {
                return Some(Vec::new());
            }
            None => return None,
        };
        let mut marks = Vec::new();
        // One cell that is not of the table makes the line none of its rows; in a very long line only what is seen is looked at.
        let looked = if line.len() <= SHORT { 0..usize::MAX } else { window.clone() };
        for (column, cell) in self.dialect.cells(line).enumerate() {
            let range = cells::range(line, cell);
            if range.start >= looked.end {
                break;
            }
            if !cells::touches(&range, &looked) {
                continue;
            }
            if column == self.wavelength {
                marks.push(Mark::new(range, What::Wavelength { nm }));
                continue;
            }
            let what = match (cells::parse(self.dialect, cell), self.curves.get(column).copied().flatten()) {
                (Cell::Text, Some(_)) => return None,
                (Cell::Gap, None) if cell.is_empty() => continue,
                (_, None) => What::LeftOut { why: LeftOut::Column },
                (Cell::Gap, Some(curve)) => What::Gap { curve },
                (Cell::Number(written), Some(curve)) => self.value(written, curve, nm, table)?,
            };
            marks.push(Mark::new(range, what));
        }
        marks.retain(|mark| cells::touches(&mark.range, window));
        Some(marks)
    }

    fn value(&self, written: f64, curve: usize, nm: f64, table: &Table) -> Option<What> {
        match cells::at(table.curves.get(curve)?, nm) {
            Some(value) if self.conversion.gives(written, value) => Some(What::Value { curve, nm, value, written }),
            Some(_) => None,
            // What no number can hold after it is converted is a gap.
            None => Some(What::Gap { curve }),
        }
    }

    fn header(&self, line: &str, window: &Range<usize>) -> Vec<Mark> {
        let body = text::comment(line).unwrap_or(line);
        self.pieces(line, body, self.shift, window, |column, cell| match self.curves.get(column) {
            _ if column == self.wavelength => {
                let unit = words::x_unit(cell).is_some() || words::names_wavelengths(cell);
                unit.then_some(What::Unit { curve: None })
            }
            Some(Some(curve)) => Some(What::Name { curve: *curve }),
            _ => Some(What::LeftOut { why: LeftOut::Column }),
        })
    }

    fn units(&self, line: &str, window: &Range<usize>) -> Vec<Mark> {
        self.pieces(line, line, 0, window, |column, _| match self.curves.get(column) {
            _ if column == self.wavelength => Some(What::Unit { curve: None }),
            Some(Some(curve)) => Some(What::Unit { curve: Some(*curve) }),
            _ => Some(What::LeftOut { why: LeftOut::Column }),
        })
    }

    /// The cells of a line above the table that are something, if they stand over the columns.
    fn pieces(
        &self,
        line: &str,
        body: &str,
        shift: usize,
        window: &Range<usize>,
        what: impl Fn(usize, &str) -> Option<What>,
    ) -> Vec<Mark> {
        if self.dialect.cells(body).take(2).count() < 2 {
            return Vec::new();
        }
        let cells = self.dialect.cells(body).enumerate().filter(|(_, cell)| !cell.is_empty());
        let marks = cells.filter_map(|(index, cell)| {
            let range = cells::range(line, cell);
            let what = what(index + shift, cell).filter(|_| cells::touches(&range, window))?;
            Some(Mark::new(range, what))
        });
        marks.collect()
    }
}

/// The rows that a reading lists as dropped, by line.
fn dropped(table: &Table) -> Vec<(usize, LeftOut)> {
    let why = |why| match why {
        Dropped::NoWavelength => LeftOut::NoWavelength,
        Dropped::Repeated => LeftOut::Repeated,
        Dropped::Averaged => LeftOut::Averaged,
    };
    let mut all: Vec<(usize, LeftOut)> =
        table.reading.dropped_rows.iter().map(|row| (row.line, why(row.why))).collect();
    all.sort_unstable_by_key(|(line, _)| *line);
    all
}
