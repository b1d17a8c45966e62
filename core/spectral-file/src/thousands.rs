//! Detection of marks that group thousands: `1,000` beside `980`.

use crate::decision::{DecimalMark, Delimiter, Orientation};
use crate::dialect::{Dialect, may_be_thousands};
use crate::error::MAX_CURVES;
use crate::text::{Lines, Section, comment};

/// Returns whether a mark groups thousands in the rows from a line on: each number that has it could be a whole one, and the
/// whole numbers of three digits next to them are nearer to that than to a fraction.
///
/// ```text
/// Σ |ln(p/f)| − |ln(p/1000 f)| > 0    over neighbors, a whole number p and one that would be the fraction f
/// ```
pub(super) fn groups(
    section: Section<'_>,
    (delimiter, mark): (Delimiter, char),
    from: usize,
    orientation: Orientation,
) -> bool {
    let dialect = Dialect::new(delimiter, DecimalMark::Point);
    // Commas that separate stand in every line; one within a cell is quoted.
    let sign = if delimiter == Delimiter::Comma && mark == ',' { '"' } else { mark };
    let mut score = 0.0;
    let mut before = (false, "");
    for (number, line) in Lines::of(section) {
        if number < from || line.trim_ascii().is_empty() || comment(line).is_some() {
            continue;
        }
        let marked = line.contains(sign);
        if marked {
            for (index, cell) in dialect.cells(line).take(MAX_CURVES + 1).enumerate() {
                let Some(cell) = Written::of(cell, mark) else { continue };
                let too_large = matches!(cell, Written::Whole(value) if index > 0 && value >= 1000.0);
                if too_large || matches!(cell, Written::Fraction) {
                    return false;
                }
            }
        }
        if orientation == Orientation::Across && marked {
            let cells = || dialect.cells(line).take(MAX_CURVES + 1);
            score += cells().zip(cells().skip(1)).map(|(a, b)| votes(a, b, mark)).sum::<f64>();
        } else if orientation == Orientation::Down && (marked || before.0) {
            score += dialect.cells(before.1).zip(dialect.cells(line)).map(|(a, b)| votes(a, b, mark)).sum::<f64>();
        }
        before = (marked, line);
    }
    score > 0.0
}

/// Returns whether a mark that stands before no fraction groups thousands in the rows from a line on, `1,000` beside `0.390`: where
/// fractions are seen to stand after the other mark, it can mean nothing else.
pub(super) fn beside_fractions(
    section: Section<'_>,
    delimiter: Delimiter,
    fractions: DecimalMark,
    from: usize,
) -> bool {
    let other = if fractions == DecimalMark::Point { ',' } else { '.' };
    let dialect = Dialect::new(delimiter, fractions);
    let content = Lines::of(section).skip_while(|(number, _)| *number < from);
    // Commas that separate stand in every line; one within a cell is quoted.
    let sign = if delimiter == Delimiter::Comma && other == ',' { '"' } else { other };
    if !section.text.contains(sign) {
        return false;
    }
    let mut marked = content.filter(|(_, line)| line.contains(sign) && comment(line).is_none());
    let grouped = |cell: &str| cell.contains(other) && may_be_thousands(cell);
    marked.any(|(_, line)| dialect.cells(line).take(MAX_CURVES + 1).any(grouped))
}

/// Returns whether a text has a number such as `1,000` or `1.000` in it that no comma of a list makes.
pub(super) fn has_grouped(text: &str) -> bool {
    let bytes = text.as_bytes();
    let digit = |at: usize| bytes.get(at).is_some_and(u8::is_ascii_digit);
    let mut signs = bytes.iter().enumerate().filter(|(_, byte)| matches!(byte, b',' | b'.'));
    let commas_and_points = bytes.contains(&b',') && bytes.contains(&b'.');
    commas_and_points
        && signs
            .any(|(at, _)| at > 0 && digit(at - 1) && digit(at + 1) && digit(at + 2) && digit(at + 3) && !digit(at + 4))
}

/// Form of a written number.
enum Written {
    /// Digits alone.
    Whole(f64),
    /// With a mark that may group thousands; the number that it is with a fraction.
    Either(f64),
    /// With a mark that can only stand before a fraction.
    Fraction,
}

impl Written {
    fn of(cell: &str, mark: char) -> Option<Self> {
        const LONGEST: usize = 24;
        let other = |c: char| !(c.is_ascii_digit() || c == mark || c == '-');
        if cell.is_empty() || cell.len() > LONGEST || cell.contains(other) {
            return None;
        }
        match cell.matches(mark).count() {
            0 => cell.parse().ok().map(Self::Whole),
            1 if may_be_thousands(cell) => cell.replace(mark, ".").parse().ok().map(Self::Either),
            1 => Some(Self::Fraction),
            _ => None,
        }
    }
}

/// Natural logarithm of how much nearer two neighbors are with thousands than with fractions.
fn votes(a: &str, b: &str, mark: char) -> f64 {
    let both = (Written::of(a, mark), Written::of(b, mark));
    let ((Some(Written::Whole(plain)), Some(Written::Either(fraction)))
    | (Some(Written::Either(fraction)), Some(Written::Whole(plain)))) = both
    else {
        return 0.0;
    };
    if !(100.0..1000.0).contains(&plain) || fraction <= 0.0 {
        return 0.0;
    }
    (plain / fraction).ln().abs() - (plain / (1000.0 * fraction)).ln().abs()
}
