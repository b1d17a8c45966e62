//! Layout of a text: separators, decimal mark, orientation, and the line where the numbers begin.

use crate::decision::{Decided, DecimalMark, Delimiter, Orientation};
use crate::dialect::Dialect;
use crate::dialect_trial::Across;
use crate::warning::Warning;

#[derive(Debug)]
pub(super) struct Layout {
    pub(super) delimiter: Decided<Delimiter>,
    pub(super) decimal_mark: Decided<DecimalMark>,
    /// True if the other mark groups thousands even where it stands once.
    pub(super) thousands: bool,
    pub(super) orientation: Decided<Orientation>,
    pub(super) first_line: usize,
    /// Bit mask of the columns that are text.
    pub(super) texts: u128,
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
    /// The layout of a family that leaves nothing to decide.
    pub(super) fn fixed(
        (delimiter, mark): (Delimiter, DecimalMark),
        orientation: Orientation,
        first_line: usize,
        why: &str,
    ) -> Self {
        Self {
            delimiter: Decided::certain(delimiter, why),
            decimal_mark: Decided::certain(mark, why),
            thousands: false,
            orientation: Decided::certain(orientation, why),
            first_line,
            texts: 0,
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

    /// The line before which comments and names stand.
    pub(super) fn header_end(&self) -> usize {
        self.across.as_ref().map_or(self.first_line, |across| across.line)
    }
}
