//! One way to split lines into cells, tried on the beginning of a file, and the layout that follows: separators, decimal mark,
//! orientation, and the line where the numbers begin.

use crate::bands::{self, Group};
use crate::decision::{Decided, DecimalMark, Delimiter, Orientation};
use crate::dialect::{Cell, Dialect, may_be_thousands};
use crate::error::MAX_CURVES;
use crate::units::{RANGE_NM, plausible};
use crate::warning::Warning;

/// Lines that may not fit below such a header before it is rejected: the reader then reports their errors.
const MISSES: usize = 3;

#[derive(Debug, Clone, Default)]
pub(super) struct Shape {
    /// All cells, and all but empty ones at the end.
    pub(super) cells: usize,
    pub(super) filled: usize,
    pub(super) numbers: usize,
    pub(super) first: Option<f64>,
    /// True if that is the first cell.
    pub(super) leads: bool,
    /// True if any cell is text (a wavelength with its unit in the first cell is a number).
    pub(super) text: bool,
    /// Bit mask of the first columns that are text; all bits are set if a later one is.
    pub(super) texts: u128,
    gaps: u128,
    /// Texts that are a number with a unit.
    united: u128,
    /// Cells with this dialect's decimal mark, and those that may be thousands, such as `4.800`.
    marks: usize,
    grouped: usize,
    /// Those with a mark that can only stand before a fraction, `0.390`.
    fractions: usize,
    /// True if a cell after the first is written like `05`, as only digits after a decimal mark are.
    padded: bool,
}

impl Shape {
    pub(super) fn of(dialect: Dialect, line: &str) -> Self {
        let mut shape = Self::default();
        for (index, cell) in dialect.cells(line).take(MAX_CURVES + 2).enumerate() {
            shape.cells += 1;
            if !cell.is_empty() {
                shape.filled = index + 1;
            }
            match dialect.parse(cell) {
                Cell::Number(value) => shape.number(index, value, dialect.has_mark(cell), cell),
                Cell::Gap => shape.gaps |= bit(index).unwrap_or(0),
                Cell::Text => shape.label_or_text(index, dialect, cell),
            }
        }
        shape
    }

    fn label_or_text(&mut self, index: usize, dialect: Dialect, cell: &str) {
        self.text |= index > 0;
        // What a wrong separator leaves of numbers has no unit.
        let united = cell.bytes().any(|b| b.is_ascii_alphabetic() || b == b'%' || !b.is_ascii());
        if let Some((value, _)) = united.then(|| dialect.parse_label(cell)).flatten() {
            self.number(index, value, dialect.has_mark(cell), "");
            return;
        }
        self.text = true;
        self.texts |= bit(index).unwrap_or(u128::MAX);
        self.united |= bit(index).filter(|_| united && dialect.parse_united(cell).is_some()).unwrap_or(0);
    }

    fn number(&mut self, index: usize, value: f64, marked: bool, cell: &str) {
        self.numbers += 1;
        self.first = self.first.or(Some(value));
        self.leads |= index == 0;
        self.marks += usize::from(marked);
        self.grouped += usize::from(marked && index > 0 && may_be_thousands(cell));
        self.fractions += usize::from(marked && !may_be_thousands(cell));
        let bytes = cell.as_bytes();
        self.padded |= index > 0 && bytes.len() > 1 && bytes[0] == b'0' && bytes.iter().all(u8::is_ascii_digit);
    }

    /// Returns whether the line is a row of numbers, or of numbers with columns of text among them.
    pub(super) fn is_row(&self, mixed: bool) -> bool {
        let enough = if mixed {
            self.numbers > 0 && self.numbers + self.united.count_ones() as usize > 1
        } else {
            self.numbers > 0
        };
        (mixed || !self.text) && self.texts != u128::MAX && enough && self.cells > 1
    }
}

fn bit(column: usize) -> Option<u128> {
    u32::try_from(column).ok().and_then(|column| 1_u128.checked_shl(column))
}

#[derive(Debug, Clone, Default)]
pub(super) struct Run {
    pub(super) line: usize,
    pub(super) rows: usize,
    pub(super) cells: usize,
    pub(super) filled: usize,
    /// Bit masks of the columns that are text, and of those that are empty in all rows.
    pub(super) texts: u128,
    pub(super) gaps: u128,
    united: u128,
    /// Rows that start again with the first wavelength.
    restarts: usize,
    /// The first numbers of the first and the last row.
    pub(super) first: f64,
    pub(super) last: f64,
    rises: usize,
    falls: usize,
    /// The largest step by which they fall.
    back: f64,
    min: f64,
    max: f64,
    fractions: bool,
}

impl Run {
    pub(super) fn steady(&self) -> usize {
        self.rises.max(self.falls)
    }

    pub(super) fn looks_like_wavelengths(&self) -> bool {
        self.rows >= 3 && self.steady() + 1 == self.rows && self.is_plausible()
    }

    /// Also true for several spectra below one another that each begin with the same wavelength.
    pub(super) fn looks_like_passes(&self) -> bool {
        let (rows, back) = (self.rows, self.rises.min(self.falls));
        self.looks_like_wavelengths()
            || (back > 0 && back == self.restarts && self.steady() + back + 1 == rows && rows > 3 * back)
                && self.is_plausible()
    }

    /// True for points read off a plot, which repeat some wavelengths and go back a little.
    pub(super) fn looks_read_off(&self) -> bool {
        const MOST_EQUAL: usize = 10;
        const MOST_BACK: f64 = 50.0;
        self.rows > 2 * MOST_EQUAL
            && MOST_EQUAL * (self.rows - 1 - self.steady()) < self.rows
            && self.rises > self.falls
            && MOST_BACK * self.back < self.max - self.min
            && self.is_plausible()
    }

    fn is_plausible(&self) -> bool {
        plausible(self.min, self.max, self.fractions)
    }

    /// Returns whether a row can stand in the table: one with as many cells, and text in the same columns or nothing. Of numbers
    /// with units, some may have none.
    pub(super) fn takes(&self, shape: &Shape) -> bool {
        let other = self.texts & !(shape.texts | shape.gaps) | shape.texts & !(self.texts | self.gaps);
        let united = self.united | shape.united;
        (shape.cells == self.cells || shape.filled == self.filled) && other & !united == 0
    }

    fn push(&mut self, line: usize, shape: &Shape) {
        let value = shape.first.unwrap_or(self.last);
        if self.rows == 0 {
            let gaps = u128::MAX;
            *self = Self { line, first: value, last: value, min: value, max: value, gaps, ..Self::default() };
        } else if value == self.first {
            self.restarts += 1;
        }
        self.rises += usize::from(value > self.last);
        self.falls += usize::from(value < self.last);
        self.back = self.back.max(self.last - value);
        self.min = self.min.min(value);
        self.max = self.max.max(value);
        self.fractions |= value.fract() != 0.0;
        self.rows += 1;
        self.last = value;
        self.cells = shape.cells;
        self.texts |= shape.texts;
        self.gaps &= shape.gaps;
        self.united |= shape.united;
        self.filled = self.filled.max(shape.filled);
    }
}

/// A header of wavelengths across a line, and the rows that fit below it.
#[derive(Debug, Clone, Default)]
pub(super) struct Across {
    pub(super) line: usize,
    pub(super) first_row: usize,
    pub(super) rows: usize,
    misses: usize,
    pub(super) cells: usize,
    /// Empty cells that the header begins with.
    blank: usize,
    /// Its groups of wavelengths, at least one.
    pub(super) groups: Vec<Group>,
    /// The part that is read, from 0: one of several groups, else of the quantities of the rows.
    pub(super) part: usize,
    /// Columns by which rows stand further right than their heads: 1 if their names have no head, as R writes them, -1 if the head
    /// begins with an empty cell too many.
    pub(super) shift: isize,
}

impl Across {
    /// Moves the wavelengths to the columns in which rows have their values.
    pub(super) fn shifted(mut self, shift: isize) -> Self {
        self.groups.iter_mut().for_each(|group| group.start = group.start.saturating_add_signed(shift));
        Self { cells: self.cells.saturating_add_signed(shift), shift, ..self }
    }

    /// The cells of the header, each above its column.
    pub(super) fn heads<'h>(&self, heads: impl Iterator<Item = &'h str>) -> Vec<&'h str> {
        let (missing, extra) = (self.shift.max(0), (-self.shift).max(0));
        std::iter::repeat_n("", missing.unsigned_abs()).chain(heads.skip(extra.unsigned_abs())).collect()
    }

    /// Returns whether more numbers than rows stand behind an empty cell and the head of another column, as behind an index and a class:
    /// the numbers that rows begin with are no wavelengths then.
    pub(super) fn is_indexed(&self) -> bool {
        self.blank > 0 && self.group().start > self.blank && self.group().count() > self.rows && self.rows > 0
    }

    pub(super) fn group(&self) -> &Group {
        self.groups.get(self.part).unwrap_or(&self.groups[0])
    }

    fn is_row(&self, dialect: Dialect, shape: &Shape, line: &str) -> bool {
        let Group { start, wavelengths, .. } = self.group();
        let mut numbers = 0;
        let numeric = dialect.cells(line).skip(*start).zip(wavelengths).all(|(cell, wavelength)| {
            let cell = dialect.parse(cell);
            numbers += usize::from(matches!(cell, Cell::Number(_)));
            cell != Cell::Text || wavelength.is_nan()
        });
        numeric && numbers > 0 && shape.filled <= self.cells
    }

    fn push(&mut self, line: usize) {
        self.first_row = if self.rows == 0 { line } else { self.first_row };
        self.rows += 1;
    }
}

#[derive(Debug, Clone, Default)]
pub(super) struct Trial {
    pub(super) dialect: Dialect,
    /// True if rows may have columns of text.
    pub(super) mixed: bool,
    run: Run,
    pub(super) best: Run,
    pub(super) across: Option<Across>,
    across_tested: bool,
    /// Cells of the last line of names.
    heads: usize,
    /// Cells with the decimal mark, in rows of numbers.
    pub(super) marks: usize,
    /// Those between quotes, which cannot separate.
    pub(super) quoted: usize,
    /// Those of them that may be thousands.
    grouped: usize,
    /// Those that can only stand before a fraction.
    pub(super) fractions: usize,
    pub(super) padded_line: Option<usize>,
    /// Lines of a single number: how many, and the first.
    pub(super) single: usize,
    pub(super) single_line: usize,
}

impl Trial {
    pub(super) fn new(dialect: Dialect, mixed: bool) -> Self {
        Self { dialect, mixed, ..Self::default() }
    }

    /// Counts the marks of a row; `quoted` tells whether they stand between quotes.
    fn count(&mut self, shape: &Shape, quoted: bool) {
        self.marks += shape.marks;
        self.quoted += if quoted { shape.marks } else { 0 };
        self.grouped += shape.grouped;
        self.fractions += shape.fractions;
    }

    pub(super) fn take(&mut self, number: usize, line: &str) {
        let shape = Shape::of(self.dialect, line);
        self.take_across(number, &shape, line);
        if shape.is_row(self.mixed) {
            if self.run.rows > 0 && !self.run.takes(&shape) {
                self.run = Run::default();
            }
            self.run.push(number, &shape);
            self.count(&shape, line.contains('"'));
            if shape.padded {
                self.padded_line = self.padded_line.or(Some(number));
            }
            if (self.run.rows, self.run.steady()) > (self.best.rows, self.best.steady()) {
                self.best = self.run.clone();
            }
            return;
        }
        self.run = Run::default();
        if shape.numbers == 1 && shape.filled == 1 {
            self.single += 1;
            self.single_line = if self.single == 1 { number } else { self.single_line };
        }
    }

    /// Processes a line that begins with `#`: below a header of wavelengths that can be the name of a sample.
    pub(super) fn take_marked(&mut self, number: usize, line: &str) {
        let Some(across) = self.across.as_mut().filter(|across| across.misses <= MISSES) else { return };
        let shape = Shape::of(self.dialect, line);
        if across.is_row(self.dialect, &shape, line) {
            across.push(number);
            self.count(&shape, false);
        }
    }

    fn take_across(&mut self, number: usize, shape: &Shape, line: &str) {
        if !self.across_tested && shape.cells >= bands::FEWEST {
            let mut groups = bands::groups(self.dialect, line);
            // Wavelengths with points may stand above values with commas.
            if groups.is_empty()
                && self.dialect.mark == DecimalMark::Comma
                && self.dialect.delimiter != Delimiter::Comma
            {
                groups = bands::groups(Dialect::new(self.dialect.delimiter, DecimalMark::Point), line);
            }
            // Small numbers below names are values.
            let small = |group: &Group| {
                group.unit.is_none()
                    && group.prefix.is_empty()
                    && group.wavelengths.iter().all(|nm| *nm < *RANGE_NM.start())
            };
            groups.retain(|group| self.heads != shape.cells || !small(group));
            self.heads = if shape.numbers == 0 { shape.filled } else { self.heads };
            self.across_tested = shape.numbers >= bands::FEWEST || !groups.is_empty();
            if !groups.is_empty() {
                // Eigenvector's word for a list of wavelengths, above a column of names.
                let axis = usize::from(line.trim_start().trim_start_matches('"').starts_with("Axisscale"));
                let blank = axis.max(shape.gaps.trailing_ones() as usize);
                self.across = Some(Across { line: number, cells: shape.cells, blank, groups, ..Across::default() });
            }
        } else if let Some(across) = self.across.as_mut().filter(|across| across.misses <= MISSES) {
            let first = across.rows == 0 && across.misses == 0 && shape.texts & !1 == 0;
            let named = shape.texts == 1 || line.trim_start().starts_with('"');
            if first && named && shape.filled == across.cells + 1 {
                *across = std::mem::take(across).shifted(1);
            } else if first
                && shape.texts == 1
                && across.blank > 1
                && across.group().start == across.blank
                && shape.cells + 1 == across.cells
            {
                *across = std::mem::take(across).shifted(-1);
            }
            if across.is_row(self.dialect, shape, line) {
                across.push(number);
                self.count(shape, line.contains('"'));
            } else {
                across.misses += 1;
            }
        }
    }

    /// Returns whether every mark may group thousands, three digits after it, one to three before, and there are so many of them.
    pub(super) fn may_be_thousands(&self, fewest: usize) -> bool {
        self.grouped >= fewest && self.grouped == self.marks
    }

    /// Rows that this dialect understands in an orientation, or in the better; a header of wavelengths counts as one.
    pub(super) fn rows(&self, orientation: Option<Orientation>) -> usize {
        match orientation {
            Some(Orientation::Down) => self.best.rows,
            Some(Orientation::Across) => self.across_rows(),
            None => self.best.rows.max(self.across_rows()),
        }
    }

    /// Rows below a header of wavelengths and the header itself, or none.
    pub(super) fn across_rows(&self) -> usize {
        self.across.as_ref().filter(|across| across.rows > 0).map_or(0, |across| across.rows + 1)
    }
}

#[derive(Debug)]
pub(super) struct Layout {
    pub(super) delimiter: Decided<Delimiter>,
    pub(super) decimal_mark: Decided<DecimalMark>,
    /// True if the other mark groups thousands even where it stands once.
    pub(super) thousands: bool,
    pub(super) orientation: Decided<Orientation>,
    pub(super) first_line: usize,
    pub(super) texts: u128,
    /// Bit mask of the first columns that are empty in all rows, but for notes.
    pub(super) gaps: u128,
    /// Columns, as far as seen.
    pub(super) width: usize,
    pub(super) across: Option<Across>,
    /// The column of the wavelengths, from 1, if the caller chose one.
    pub(super) wavelength_column: Option<usize>,
    /// True if all other columns are curves, whatever they look like.
    pub(super) every_column: bool,
    pub(super) warnings: Vec<Warning>,
}

impl Layout {
    pub(super) fn fixed(
        (delimiter, mark): (Delimiter, DecimalMark),
        orientation: Orientation,
        first_line: usize,
        why: &str,
    ) -> Self {
        let orientation = Decided::certain(orientation, why);
        Self::new(Decided::certain(delimiter, why), Decided::certain(mark, why), orientation, first_line)
    }

    pub(super) fn new(
        delimiter: Decided<Delimiter>,
        decimal_mark: Decided<DecimalMark>,
        orientation: Decided<Orientation>,
        first_line: usize,
    ) -> Self {
        Self {
            delimiter,
            decimal_mark,
            thousands: false,
            orientation,
            first_line,
            texts: 0,
            gaps: 0,
            width: 0,
            across: None,
            wavelength_column: None,
            every_column: false,
            warnings: Vec::new(),
        }
    }

    pub(super) fn dialect(&self) -> Dialect {
        Dialect { delimiter: self.delimiter.value, mark: self.decimal_mark.value, thousands: self.thousands }
    }

    pub(super) fn header_end(&self) -> usize {
        self.across.as_ref().map_or(self.first_line, |across| across.line)
    }
}
