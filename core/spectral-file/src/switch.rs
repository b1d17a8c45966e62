//! Chosen setting that causes an error.

use std::fmt;

use crate::report::{Orientation, Reader};
use crate::role::{Role, Values};
use crate::separators::{DecimalMark, Delimiter};
use crate::wavelength_unit::WavelengthUnit;

/// A setting that was chosen, not left to the content.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Switch {
    /// Separator of cells.
    Delimiter(Delimiter),
    /// Decimal mark.
    DecimalMark(DecimalMark),
    /// Direction of the wavelengths: down a column or across a row.
    Orientation(Orientation),
    /// Their unit.
    WavelengthUnit(WavelengthUnit),
    /// Their column, from 1.
    WavelengthColumn(usize),
    /// Scale of the values.
    Values(Values),
    /// The part of the file, from 1.
    Part(usize),
    /// Role of the curves.
    Role(Role),
    /// The reader.
    Reader(Reader),
}

impl fmt::Display for Switch {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Delimiter(delimiter) => delimiter.fmt(f),
            Self::DecimalMark(mark) => mark.fmt(f),
            Self::Orientation(orientation) => orientation.fmt(f),
            Self::WavelengthUnit(unit) => unit.fmt(f),
            Self::WavelengthColumn(column) => write!(f, "wavelengths in column {column}"),
            Self::Values(values) => write!(f, "values are {values}"),
            Self::Part(part) => write!(f, "part {part}"),
            Self::Role(role) => role.fmt(f),
            Self::Reader(reader) => write!(f, "read as {reader}"),
        }
    }
}
