//! Columns of text in a table: omitted, unless each cell is a number with the same unit.

use crate::dialect::{Cell, Dialect};
use crate::grid::RawCurve;

/// The columns of text of a table.
#[derive(Debug)]
pub(super) struct Texts {
    mask: u128,
    columns: Vec<Text>,
}

#[derive(Debug)]
struct Text {
    column: usize,
    /// The unit of all cells until now.
    unit: Option<String>,
    /// True if a cell was not a number with that unit.
    other: bool,
}

impl Texts {
    /// Columns by their bits.
    pub(super) fn new(mask: u128) -> Self {
        let columns = (0..128).filter(|column| mask >> column & 1 == 1);
        Self { mask, columns: columns.map(|column| Text { column, unit: None, other: false }).collect() }
    }

    /// Returns whether a column holds text, or numbers with units.
    #[inline]
    pub(super) fn contains(&self, column: usize) -> bool {
        column < 128 && self.mask >> column & 1 == 1
    }

    /// Processes a cell of such a column: its number, or NaN.
    pub(super) fn take(&mut self, column: usize, dialect: Dialect, cell: &str) -> f64 {
        let Some(text) = self.columns.iter_mut().find(|text| text.column == column) else { return f64::NAN };
        if dialect.parse(cell) == Cell::Gap {
            return f64::NAN;
        }
        let Some((value, unit)) = dialect.parse_united(cell).filter(|_| !text.other) else {
            text.other = true;
            return f64::NAN;
        };
        text.other = text.unit.get_or_insert_with(|| unit.to_owned()) != unit;
        value
    }

    /// The unit of a column whose cells are numbers with one unit.
    fn unit(&self, column: usize) -> Option<&str> {
        let text = self.columns.iter().find(|text| text.column == column && !text.other)?;
        text.unit.as_deref()
    }

    /// A curve with the unit that stands beside each of its values, where the header names none.
    pub(super) fn united(&self, mut curve: RawCurve, column: usize) -> RawCurve {
        if let Some(unit) = self.unit(column).filter(|_| curve.unit.is_none()) {
            let before = if curve.label.is_empty() { "" } else { " " };
            curve.label = format!("{}{before}{unit}", curve.label);
            curve.unit = Some(unit.to_owned());
        }
        curve
    }

    /// The omitted columns.
    pub(super) fn left_out(&self) -> impl Iterator<Item = usize> {
        self.columns.iter().filter(|text| text.other || text.unit.is_none()).map(|text| text.column)
    }
}
