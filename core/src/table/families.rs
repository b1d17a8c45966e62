//! Who takes a text: a reader of its family, or the general reader of numbers in columns.

mod alternate;
mod asdf;
mod camspec;
mod cgats;
mod cxf;
mod jcamp;
mod json;
mod labels;
mod spectra;
mod tm27;
mod xml;

use super::family::{self, Family};
use super::grid::Grid;
use super::sniff::{self, Layout};
use super::{Decided, Decision, Orientation, ReadError, ReadOptions, Reader, Warning, columns, instrument, raw, wide};

/// What a reader makes of a text, before units, order and scale are settled.
pub(super) struct Found {
    pub(super) grid: Grid,
    pub(super) layout: Layout,
    pub(super) reader: Decided<Reader>,
    /// Decisions that only this family asks for.
    pub(super) notes: Vec<Decision>,
}

/// Reads a text with the reader that was chosen, or with the one its content asks for.
pub(super) fn read(text: &str, options: &ReadOptions, warnings: &mut Vec<Warning>) -> Result<Found, ReadError> {
    let reader = match options.reader {
        Some(reader) => reader,
        None => recognize(text)?,
    };
    let mut found = match reader {
        Reader::Table => table(text, options, warnings),
        Reader::Cgats => cgats::read(text, warnings),
        Reader::Jcamp => jcamp::read(text, options, warnings),
        Reader::Tm27 => tm27::read(text, warnings),
        Reader::Cxf => cxf::read(text, warnings),
        Reader::Rawtoaces | Reader::Dcamprof => json::read(text, warnings),
        Reader::Labels => labels::read(text, warnings),
        Reader::Alternate => alternate::read(text, warnings),
        Reader::Camspec => camspec::read(text),
    }?;
    if options.reader == Some(found.reader.value) {
        found.reader = Decided::chosen(found.reader.value);
    }
    Ok(found)
}

/// The reader that the content asks for.
fn recognize(text: &str) -> Result<Reader, ReadError> {
    match family::recognize(text) {
        Some(Family::Cgats) => Ok(Reader::Cgats),
        Some(Family::Jcamp) => Ok(Reader::Jcamp),
        Some(Family::Json) => Ok(Reader::Rawtoaces),
        Some(Family::Xml) => xml::recognize(text).ok_or(ReadError::Unsupported { family: Family::Xml }),
        None if alternate::recognize(text) => Ok(Reader::Alternate),
        None if camspec::recognize(text) => Ok(Reader::Camspec),
        None if labels::recognize(text) => Ok(Reader::Labels),
        None => Ok(Reader::Table),
    }
}

/// Numbers in columns.
fn table(text: &str, options: &ReadOptions, warnings: &mut Vec<Warning>) -> Result<Found, ReadError> {
    let layout = sniff::sniff(text, options)?;
    warnings.extend(layout.warnings.iter().cloned());
    let mut grid = match layout.orientation.value {
        Orientation::Down => columns::read(text, &layout, warnings)?,
        Orientation::Across => wide::read(text, &layout, warnings)?,
    };
    let reader = Decided::certain(Reader::Table, "Rows of numbers");
    let mut notes = Vec::new();
    if options.reader.is_none() {
        notes.extend(instrument::recognize(text, &mut grid, warnings));
    }
    notes.extend(raw::leave_out(&mut grid, options));
    Ok(Found { grid, layout, reader, notes })
}
