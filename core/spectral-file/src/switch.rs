//! Which chosen setting an error is due to.

use std::fmt;

use super::watch::Watch;
use super::{
    DecimalMark, Delimiter, Orientation, ReadError, ReadOptions, Reader, Role, Values, WavelengthUnit, read_once,
};

/// A setting that was chosen, not left to the content.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Switch {
    /// What stands between cells.
    Delimiter(Delimiter),
    /// What stands before fractions.
    DecimalMark(DecimalMark),
    /// Where the wavelengths stand.
    Orientation(Orientation),
    /// Their unit.
    WavelengthUnit(WavelengthUnit),
    /// Their column, from 1.
    WavelengthColumn(usize),
    /// What the values stand for.
    Values(Values),
    /// The part of the file, from 1.
    Part(usize),
    /// What the curves are.
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

/// Files up to this size are read again to find what an error is due to.
const LONGEST: usize = 1 << 20;

/// The error, with the chosen setting without which there would be none, if there is one.
pub(super) fn blame(bytes: &[u8], options: &ReadOptions, error: ReadError, watch: Watch<'_>) -> ReadError {
    let own = matches!(
        error,
        ReadError::Stopped
            | ReadError::TooLarge { .. }
            | ReadError::Binary { .. }
            | ReadError::Empty
            | ReadError::NoSuchPart { .. }
            | ReadError::OtherLayout { .. }
            | ReadError::NotWavelengthColumn { .. }
    );
    if own || bytes.len() > LONGEST {
        return error;
    }
    for (switch, without) in switches(options) {
        match read_once(bytes, &without, watch) {
            Ok(_) => return ReadError::AsChosen { switch, error: Box::new(error) },
            Err(ReadError::Stopped) => return ReadError::Stopped,
            Err(_) => {}
        }
    }
    error
}

/// What was chosen, each with the options without it.
fn switches(options: &ReadOptions) -> Vec<(Switch, ReadOptions)> {
    let all = options;
    let without = |change: fn(&mut ReadOptions)| {
        let mut less = all.clone();
        change(&mut less);
        less
    };
    let found = [
        all.delimiter.map(|chosen| (Switch::Delimiter(chosen), without(|less| less.delimiter = None))),
        all.decimal_mark.map(|chosen| (Switch::DecimalMark(chosen), without(|less| less.decimal_mark = None))),
        all.orientation.map(|chosen| (Switch::Orientation(chosen), without(|less| less.orientation = None))),
        all.wavelength_unit.map(|chosen| (Switch::WavelengthUnit(chosen), without(|less| less.wavelength_unit = None))),
        all.wavelength_column
            .map(|chosen| (Switch::WavelengthColumn(chosen), without(|less| less.wavelength_column = None))),
        all.values.map(|chosen| (Switch::Values(chosen), without(|less| less.values = None))),
        all.part.map(|chosen| (Switch::Part(chosen), without(|less| less.part = None))),
        all.role.map(|chosen| (Switch::Role(chosen), without(|less| less.role = None))),
        all.reader.map(|chosen| (Switch::Reader(chosen), without(|less| less.reader = None))),
    ];
    found.into_iter().flatten().collect()
}
