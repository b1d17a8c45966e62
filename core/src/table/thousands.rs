//! Whether marks group thousands, `1,000` beside `980`, or stand before fractions.

use super::dialect::{DecimalMark, Delimiter, Dialect, may_be_thousands};
use super::text::{Lines, Section, comment};
use super::{MAX_CURVES, Orientation};

/// Whether a mark groups thousands in the rows from a line on: each number that has it could be a whole one, and the
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

/// How a number is written.
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

/// How much nearer two neighbors are with thousands than with fractions, in powers of e.
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
