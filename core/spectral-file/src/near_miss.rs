//! Lines that are nearly rows of numbers, and why they are none.

use crate::dialect::{Cell, Dialect};
use crate::error::{NearMiss, ReadError};
use crate::options::ReadOptions;
use crate::separators::{DecimalMark, Delimiter};
use crate::text::{Lines, Section, comment, excerpt};

/// Bytes of a text that are searched.
const LOOK: usize = 1 << 18;

/// A line of more bytes is not looked at as a whole.
const LONGEST: usize = 4000;

/// Ways in which a line may split.
const SPLITS: [(Delimiter, DecimalMark); 7] = [
    (Delimiter::Semicolon, DecimalMark::Point),
    (Delimiter::Tab, DecimalMark::Point),
    (Delimiter::Semicolon, DecimalMark::Comma),
    (Delimiter::Tab, DecimalMark::Comma),
    (Delimiter::Comma, DecimalMark::Point),
    (Delimiter::Spaces, DecimalMark::Point),
    (Delimiter::Spaces, DecimalMark::Comma),
];

/// The error for a text without rows: about the first line that nearly is one.
pub(super) fn error(section: Section<'_>, options: &ReadOptions) -> ReadError {
    let mut read = 0;
    for (line, text) in Lines::of(section) {
        read += text.len() + 1;
        if read > LOOK {
            break;
        }
        if comment(text).is_some() {
            continue;
        }
        let start = &text[..text.floor_char_boundary(LONGEST)];
        if let Some(why) = nearly(start.trim(), options) {
            return ReadError::NearlyRow { line, text: excerpt(text.trim()), why };
        }
    }
    ReadError::NoNumbers
}

/// Prose that begins with a number has more words behind it than a row has texts.
const MOST_CELLS: usize = 3;

fn nearly(line: &str, options: &ReadOptions) -> Option<NearMiss> {
    let chosen = options.delimiter.is_some() || options.decimal_mark.is_some();
    let shapes = SPLITS.map(|(delimiter, mark)| {
        let dialect = Dialect::new(delimiter, mark);
        let cells = dialect.cells(line).filter(|cell| !cell.is_empty());
        let is_number = |cell: &str| matches!(dialect.parse(cell), Cell::Number(_));
        let (mut count, mut numbers, mut leads) = (0, 0, false);
        for cell in cells {
            leads |= count == 0 && (is_number(cell) || dialect.parse_label(cell).is_some());
            numbers += usize::from(is_number(cell));
            count += 1;
        }
        (count, numbers, leads)
    });
    if shapes.iter().any(|(count, numbers, _)| *count > 1 && count == numbers) {
        return chosen.then_some(NearMiss::Separators);
    }
    if let Some(between) = between(line) {
        return Some(NearMiss::Between(between));
    }
    if shapes.iter().any(|(count, numbers, leads)| *leads && *numbers <= 1 && (2..=MOST_CELLS).contains(count)) {
        return Some(NearMiss::TextAfter);
    }
    shapes.iter().any(|(count, numbers, _)| *numbers >= 2 && *count > *numbers).then_some(NearMiss::Order)
}

/// The sign between two numbers that fill a line.
fn between(line: &str) -> Option<char> {
    let in_number = |c: char| c.is_ascii_digit() || matches!(c, '.' | ',' | '-' | '+');
    let end = line.find(|c: char| !in_number(c))?;
    let rest = line[end..].trim_start();
    let sign = rest.chars().next().filter(|c| !c.is_alphanumeric() && !matches!(c, ';' | '"' | '\''))?;
    let second = rest[sign.len_utf8()..].trim();
    let second = second.split(sign).next()?.trim();
    let plain = |text: &str| text.replace(',', ".").parse::<f64>().is_ok_and(f64::is_finite);
    (plain(&line[..end]) && plain(second)).then_some(sign)
}
