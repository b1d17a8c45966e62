//! Choice of the reader for a text: one for its format family, or the general reader of numbers in columns.

mod camspec;
mod cgats;
#[cfg(feature = "xml")]
mod cxf;
pub(super) mod found;
mod jcamp;
mod jcamp_asdf;
#[cfg(feature = "json")]
mod json;
mod lamp_meter;
mod macam;
pub(super) mod spectra;
#[cfg(feature = "xml")]
mod tm27;
#[cfg(feature = "xml")]
mod xml;

use crate::error::ReadError;
use crate::formats::found::Found;
use crate::grid::Grid;
use crate::limits::MAX_PARTS;
use crate::markup::Family;
use crate::options::ReadOptions;
use crate::report::{Decided, Decision, Orientation, Part, Reader};
use crate::sniff::Layout;
use crate::text::{Lines, Section};
use crate::warning::Warning;
use crate::watch::Log;
use crate::{columns, instrument, markup, raw, sniff, wide};

/// Reads a text with the reader that was chosen, or with the one its content indicates.
pub(super) fn read(text: &str, options: &ReadOptions, log: &mut Log<'_>) -> Result<Found, ReadError> {
    let reader = match options.reader {
        Some(reader) if fits(reader, text) => reader,
        Some(reader) => return Err(ReadError::OtherLayout(reader)),
        None => recognize(text)?,
    };
    let mut found = match reader {
        Reader::Table => table(text, options, log),
        Reader::Cgats => cgats::read(text, options, log),
        Reader::Jcamp => jcamp::read(text, options, log),
        #[cfg(feature = "xml")]
        Reader::Tm27 => tm27::read(text, options, log),
        #[cfg(feature = "xml")]
        Reader::Cxf => cxf::read(text, log),
        #[cfg(not(feature = "xml"))]
        Reader::Tm27 | Reader::Cxf => Err(ReadError::NotBuilt { what: "XML", feature: "xml" }),
        #[cfg(feature = "json")]
        Reader::Rawtoaces | Reader::Dcamprof | Reader::Enlighten => json::read(text, options, log),
        #[cfg(not(feature = "json"))]
        Reader::Rawtoaces | Reader::Dcamprof | Reader::Enlighten => {
            Err(ReadError::NotBuilt { what: "JSON", feature: "json" })
        }
        Reader::Labels => lamp_meter::read(text, options, log),
        Reader::Alternate => macam::read(text, log),
        Reader::Camspec => camspec::read(text, log),
    }?;
    match options.reader {
        Some(chosen) if chosen == found.reader.value => found.reader = Decided::chosen(chosen),
        Some(reader) => return Err(ReadError::OtherLayout(reader)),
        None => {}
    }
    Ok(found)
}

/// Returns whether a text can be of the layout that a reader was chosen for.
fn fits(reader: Reader, text: &str) -> bool {
    let has_line = |start: &str| Lines::new(text).any(|(_, line)| line.trim_start().starts_with(start));
    match reader {
        Reader::Table => true,
        Reader::Cgats => has_line("BEGIN_DATA_FORMAT"),
        Reader::Jcamp => has_line("##"),
        Reader::Tm27 | Reader::Cxf => {
            markup::recognize(text) == Some(Family::Xml) && xml_reader(text).is_none_or(|found| found == reader)
        }
        Reader::Rawtoaces | Reader::Dcamprof | Reader::Enlighten => markup::recognize(text) == Some(Family::Json),
        Reader::Labels => lamp_meter::recognize(text),
        Reader::Alternate => macam::recognize(text),
        Reader::Camspec => camspec::recognize(text),
    }
}

/// The reader that the content indicates.
fn recognize(text: &str) -> Result<Reader, ReadError> {
    match markup::recognize(text) {
        Some(Family::Cgats) => Ok(Reader::Cgats),
        Some(Family::Jcamp) => Ok(Reader::Jcamp),
        Some(Family::Json) => Ok(Reader::Rawtoaces),
        Some(Family::Xml) => xml_reader(text).ok_or(ReadError::Unsupported(Family::Xml)),
        None if macam::recognize(text) => Ok(Reader::Alternate),
        None if camspec::recognize(text) => Ok(Reader::Camspec),
        None if lamp_meter::recognize(text) => Ok(Reader::Labels),
        None => Ok(Reader::Table),
    }
}

/// The reader for the root element of a text; any reader of XML where none is built, so that its error names the feature.
fn xml_reader(text: &str) -> Option<Reader> {
    #[cfg(feature = "xml")]
    return xml::recognize(text);
    #[cfg(not(feature = "xml"))]
    return Some(Reader::Tm27).filter(|_| !text.is_empty());
}

/// Bytes that are read to list tables below the one that is taken. Where wavelengths just start again, only reading on shows
/// where, so that each table is read with all that follow.
const MOST_WORK: usize = 64 << 20;

/// Numbers in columns: the table that was chosen of several below one another, else the first.
fn table(text: &str, options: &ReadOptions, log: &mut Log<'_>) -> Result<Found, ReadError> {
    let wanted = options.part.unwrap_or(1);
    let mut section = Section::whole(text);
    let mut parts = Vec::new();
    let mut taken: Option<(Layout, columns::Read)> = None;
    let mut begun = None;
    let (mut budget, mut work) = (sniff::SAMPLE_BUDGET, 0);
    loop {
        log.look(section.byte)?;
        let warnings = log.warnings.len();
        let (layout, mut read) = match one(section, options, &mut budget, log) {
            Ok(read) => read,
            Err(ReadError::Stopped) => return Err(ReadError::Stopped),
            Err(error) if taken.is_some() => {
                log.warnings.truncate(warnings);
                if let Some(line) = begun {
                    log.push(Warning::BrokenTable { line, error: Box::new(error) });
                }
                break;
            }
            Err(ReadError::NoNumbers | ReadError::NearlyRow { .. } | ReadError::OneColumn(..)) if !parts.is_empty() => {
                break;
            }
            Err(error) => return Err(error),
        };
        let next = read.next.take();
        let bytes = read.bytes;
        if !read.grid.parts.is_empty() {
            side_by_side(&mut read.grid, options, log);
            taken = Some((layout, read));
            break;
        }
        parts.push(part(&layout, &read.grid));
        if parts.len() == wanted {
            taken = Some((layout, read));
        } else {
            log.warnings.truncate(warnings);
        }
        work += bytes;
        match next.filter(|_| parts.len() < MAX_PARTS && (taken.is_none() || work < MOST_WORK)) {
            Some(line) => {
                begun = Some(line);
                section = section.after(line);
            }
            None => break,
        }
    }
    let Some((layout, read)) = taken else {
        return Err(ReadError::NoSuchPart { part: wanted, parts: parts.len() });
    };
    let columns::Read { mut grid, note, .. } = read;
    let mut notes: Vec<Decision> = note.into_iter().collect();
    if let [_, second, ..] = parts.as_slice() {
        grid.part = Some(Decided::guess(wanted, format!("{} tables stand below one another", parts.len())));
        if options.part.is_none() {
            log.push(Warning::MoreTables(second.line));
        }
        grid.parts = parts;
    }
    let reader = Decided::certain(Reader::Table, "Rows of numbers");
    if options.reader.is_none() {
        notes.extend(instrument::recognize(text, &mut grid));
    }
    notes.extend(raw::leave_out(&mut grid, options));
    Ok(Found { grid, layout, reader, notes })
}

/// Groups of columns, or rows of several quantities, in one table, one of which was taken.
fn side_by_side(grid: &mut Grid, options: &ReadOptions, log: &mut Log<'_>) {
    if let Some(part) = &grid.part {
        let taken = part.value.checked_sub(1).filter(|at| *at < grid.parts.len()).unwrap_or(0);
        let others = wide::other_names(&grid.parts, taken);
        if options.part.is_none() {
            log.push(Warning::MoreQuantities { taken: grid.parts[taken].name.clone(), others });
        }
        return;
    }
    let names: Vec<&str> = grid.parts.iter().map(|part| part.name.as_str()).take(MOST_NAMED).collect();
    let why = format!("{} groups of spectra stand side by side, {}", grid.parts.len(), names.join(", "));
    grid.part = Some(Decided::guess(1, why));
    if options.part.is_none() {
        log.push(Warning::MoreGroups { count: grid.parts.len(), second: grid.parts[1].name.clone() });
    }
}

/// Groups that are named in a decision.
const MOST_NAMED: usize = 4;

/// The first table of a section.
fn one(
    section: Section<'_>,
    options: &ReadOptions,
    budget: &mut usize,
    log: &mut Log<'_>,
) -> Result<(Layout, columns::Read), ReadError> {
    let layout = sniff::sniff(section, options, budget, log)?;
    log.extend(layout.warnings.iter().cloned());
    let read = match layout.orientation.value {
        Orientation::Down => columns::read(section, &layout, log)?,
        Orientation::Across => {
            let grid = wide::read(section, &layout, log)?;
            columns::Read { grid, next: None, bytes: 0, note: None }
        }
    };
    Ok((layout, read))
}

fn part(layout: &Layout, grid: &Grid) -> Part {
    let name = grid.header.comment("title").unwrap_or_default().to_owned();
    Part { line: layout.first_line, name, curves: grid.curves.len(), rows: grid.rows }
}
