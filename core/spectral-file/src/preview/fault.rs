//! Place in a line at which reading failed.

use std::ops::Range;

use crate::dialect::Dialect;
use crate::error::ReadError;
use crate::preview::cells;
use crate::separators::{DecimalMark, Delimiter};
use crate::text::excerpt;

/// The bytes of a line that an error is about; the whole line where nothing closer is known.
pub(super) fn range(line: &str, error: &ReadError) -> Range<usize> {
    let found = match error {
        ReadError::AsChosen { error, .. } => return range(line, error),
        ReadError::NotANumber { column, text, .. } => cell(line, *column, text),
        ReadError::Malformed { column, .. } => Some(word(line, *column)),
        _ => None,
    };
    found.filter(|range| !range.is_empty()).unwrap_or_else(|| cells::trimmed(line))
}

/// The cell of a column that begins with what the error quotes, or the first place where that stands.
fn cell(line: &str, column: usize, quoted: &str) -> Option<Range<usize>> {
    const ALL: [Delimiter; 5] =
        [Delimiter::Semicolon, Delimiter::Tab, Delimiter::CommaSpace, Delimiter::Comma, Delimiter::Spaces];
    let cells = ALL.iter().filter_map(|&delimiter| {
        let dialect = Dialect::new(delimiter, DecimalMark::Point);
        dialect.cells(line).nth(column.checked_sub(1)?)
    });
    let exact = cells.into_iter().find(|cell| excerpt(cell) == quoted);
    let start = quoted.trim_end_matches('\u{2026}');
    exact.map(|cell| cells::range(line, cell)).or_else(|| {
        let at = line.find(start).filter(|_| !start.is_empty())?;
        Some(at..at + start.len())
    })
}

/// The word that begins at a character, counted from 1, or the last character of a shorter line.
fn word(line: &str, column: usize) -> Range<usize> {
    let last = line.char_indices().next_back().map_or(0, |(at, _)| at);
    let start = line.char_indices().nth(column.saturating_sub(1)).map_or(last, |(at, _)| at);
    let first = line[start..].chars().next().map_or(0, char::len_utf8);
    let rest = &line[start + first..];
    start..start + first + rest.find(|c: char| !c.is_alphanumeric()).unwrap_or(rest.len())
}
