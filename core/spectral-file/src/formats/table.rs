//! Numbers in rows and columns: what every text is that no other format takes.

use crate::decision::{Decided, Decision, Orientation, Part, Reader};
use crate::dialect_trial::Layout;
use crate::error::{MAX_PARTS, ReadError};
use crate::formats::Format;
use crate::formats::spectra::Found;
use crate::grid::Grid;
use crate::options::ReadOptions;
use crate::text::{Section, comment};
use crate::warning::Warning;
use crate::watch::Log;
use crate::{columns, instrument, no_curve, sniff, wide};

impl Reader {
    /// The general reader of numbers in rows and columns.
    pub const TABLE: Self = Self::new("table", "table of numbers", "Table of numbers");
}

pub(super) const FORMAT: Format = Format { reader: Reader::TABLE, fits: |head| head.is_plain(), read };

/// Bytes that are read to list tables below the one that is taken. Where wavelengths just start again, only reading on shows
/// where, so that each table is read with all that follow.
const MOST_WORK: usize = 64 << 20;

/// Numbers in columns: the table that was chosen of several below one another, else the first.
fn read(text: &str, options: &ReadOptions, log: &mut Log<'_>) -> Result<Found, ReadError> {
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
        let head = || columns::table_head(section, &layout).and_then(comment);
        let name = read.grid.header.comment("title").or_else(head).unwrap_or_default().to_owned();
        let (curves, rows) = (read.grid.curves.len(), read.grid.rows);
        parts.push(Part { line: layout.first_line, name, curves, rows });
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
    let reader = Decided::certain(Reader::TABLE, "Rows of numbers");
    if options.reader.is_none() {
        notes.extend(instrument::recognize(text, &mut grid));
    }
    if options.raw != Some(true) {
        no_curve::leave_out_uncomputed(&mut grid, log);
    }
    notes.extend(no_curve::leave_out_raw(&mut grid, options));
    Ok(Found { grid, layout, reader, notes })
}

/// Groups of columns, or rows of several quantities, in one table, one of which was taken.
fn side_by_side(grid: &mut Grid, options: &ReadOptions, log: &mut Log<'_>) {
    const MOST_NAMED: usize = 4;
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
            let (grid, next) = wide::read(section, &layout, log)?;
            columns::Read { grid, next, bytes: section.text.len(), note: None }
        }
    };
    Ok((layout, read))
}
