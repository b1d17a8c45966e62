//! Notation of a line of numbers: what separates cells, what marks fractions, what stands for a gap.

use crate::decision::{DecimalMark, Delimiter, WavelengthUnit};
use crate::unit_text;

#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Cell {
    Number(f64),
    Gap,
    Text,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Dialect {
    pub(super) delimiter: Delimiter,
    pub(super) mark: DecimalMark,
    /// True if the other mark groups thousands even where it stands once and without a fraction, `1,000`.
    pub(super) thousands: bool,
}

impl Default for Dialect {
    fn default() -> Self {
        Self::new(Delimiter::Comma, DecimalMark::Point)
    }
}

/// Returns whether a number with one mark may be a whole one with a mark between its thousands: `4.800`, `1,000`.
pub(super) fn may_be_thousands(cell: &str) -> bool {
    let Some((whole, fraction)) = cell.trim_start_matches('-').split_once(['.', ',']) else { return false };
    let digits = |text: &str| text.bytes().all(|b| b.is_ascii_digit());
    (1..=3).contains(&whole.len())
        && !whole.starts_with('0')
        && fraction.len() == 3
        && digits(whole)
        && digits(fraction)
}

const NOT_MEASURED: f64 = -9999.0;

const GAPS: [&str; 15] =
    ["sat", ".", "na", "n/a", "n.a.", "null", "none", "nan", "-", "*", "#n/a", "#div/0!", "#value!", "#num!", "#ref!"];

impl Dialect {
    pub(super) fn new(delimiter: Delimiter, mark: DecimalMark) -> Self {
        Self { delimiter, mark, thousands: false }
    }

    /// The cells of a line, trimmed and without the quotes around them.
    pub(super) fn cells(self, line: &str) -> Cells<'_> {
        let rest = if self.delimiter == Delimiter::Spaces { line.trim_ascii() } else { line };
        let spaces_only = self.delimiter == Delimiter::Spaces && rest.is_empty();
        let joined =
            if (self.delimiter, self.mark) == (Delimiter::Comma, DecimalMark::Comma) { joined(rest) } else { 0 };
        Cells { rest: (!spaces_only).then_some(rest), delimiter: self.delimiter, quotes: true, joined, at: 0 }
    }

    /// Returns whether each quote that opens a cell of a line is closed where a cell ends.
    pub(super) fn closes_quotes(self, line: &str) -> bool {
        let mut cells = self.cells(line);
        while cells.next().is_some() {}
        cells.quotes
    }

    pub(super) fn of_number(text: &str) -> Self {
        Self::new(Delimiter::Spaces, if text.contains(',') { DecimalMark::Comma } else { DecimalMark::Point })
    }

    /// A number, or NaN for a gap.
    pub(super) fn value(self, cell: &str) -> Option<f64> {
        match self.parse(cell) {
            Cell::Number(value) => Some(value),
            Cell::Gap => Some(f64::NAN),
            Cell::Text => None,
        }
    }

    #[inline]
    pub(super) fn parse(self, cell: &str) -> Cell {
        match self.number(cell) {
            Some(NOT_MEASURED) => Cell::Gap,
            Some(value) if value.is_finite() => Cell::Number(value),
            Some(_) if cell.bytes().any(|b| b.is_ascii_digit()) => Cell::Text, // 1e999 is a mistake, not a gap
            Some(_) => Cell::Gap,
            None => self.parse_rare(cell),
        }
    }

    #[inline]
    fn number(self, cell: &str) -> Option<f64> {
        let mark = match self.mark {
            DecimalMark::Point => b'.',
            DecimalMark::Comma => b',',
        };
        parse_plain(cell.as_bytes(), mark).or_else(|| match self.mark {
            DecimalMark::Point => cell.parse().ok(),
            DecimalMark::Comma => parse_decimal_comma(cell),
        })
    }

    #[cold]
    fn parse_rare(self, cell: &str) -> Cell {
        let cell = cell.trim();
        if is_gap(cell) {
            return Cell::Gap;
        }
        if let Some(value) = self.grouped(cell).or_else(|| self.fortran(cell)) {
            return Cell::Number(value);
        }
        // The typographic minus, as word processors write it.
        match cell.strip_prefix('\u{2212}').and_then(|rest| self.number(rest)) {
            Some(value) if value.is_finite() && value.is_sign_positive() => Cell::Number(-value),
            _ => Cell::Text,
        }
    }

    /// A number in double precision as Fortran writes it: `1.5D-01`.
    fn fortran(self, cell: &str) -> Option<f64> {
        const LONGEST: usize = 32;
        let (mantissa, exponent) = cell.split_once(['D', 'd']).filter(|_| cell.len() <= LONGEST)?;
        let digits = exponent.strip_prefix(['+', '-'])?;
        let plain = mantissa.contains('.') && (2..=3).contains(&digits.len());
        let number = || self.number(&format!("{mantissa}E{exponent}")).filter(|number| number.is_finite());
        if plain && digits.bytes().all(|b| b.is_ascii_digit()) { number() } else { None }
    }

    /// A number with thousands set apart, where that cannot mean anything else: `1.234,5`, `1,234.5`, `1 234,5`.
    fn grouped(self, cell: &str) -> Option<f64> {
        const LONGEST: usize = 32;
        let (mark, other) = if self.mark == DecimalMark::Point { ('.', ',') } else { (',', '.') };
        if cell.len() > LONGEST || !cell.ends_with(|c: char| c.is_ascii_digit()) {
            return None;
        }
        let (sign, digits) = cell.strip_prefix('-').map_or((1.0, cell), |rest| (-1.0, rest));
        let (whole, fraction) = digits.split_once(mark).unwrap_or((digits, ""));
        let spaced =
            matches!(self.delimiter, Delimiter::Semicolon | Delimiter::Tab | Delimiter::Bar | Delimiter::Comma);
        let separates =
            |c: char| c == other || (spaced && matches!(c, ' ' | '\u{a0}' | '\u{202f}' | '\'' | '\u{2019}'));
        let separator = whole.chars().find(|&c| separates(c))?;
        let mut groups = whole.split(separator);
        let digits = |text: &str| text.bytes().all(|b| b.is_ascii_digit());
        let first = groups.next().filter(|first| (1..=3).contains(&first.len()) && digits(first))?;
        let mut text = first.to_owned();
        let mut count = 0;
        for group in groups {
            if group.len() != 3 || !digits(group) {
                return None;
            }
            text.push_str(group);
            count += 1;
        }
        // `1.234` alone may be a fraction.
        let told = self.thousands && !first.starts_with('0');
        if !digits(fraction) || (separator == other && count < 2 && fraction.is_empty() && !told) {
            return None;
        }
        format!("{text}.{fraction}0").parse().ok().map(|value: f64| sign * value)
    }

    /// A wavelength that carries its unit, such as `380nm` or `380 [nm]`.
    pub(super) fn parse_label(self, cell: &str) -> Option<(f64, WavelengthUnit)> {
        let split = cell.find(|c: char| !(c.is_ascii_digit() || matches!(c, '.' | ',')))?;
        let (number, unit) = cell.split_at(split);
        let unit = unit.trim().trim_start_matches(['[', '(']).trim_end_matches([']', ')']);
        let value = self.number(number).filter(|value| value.is_finite())?;
        Some((value, WavelengthUnit::from_symbol(unit)?))
    }

    /// A value that carries its unit, such as `4.0%` or `12 mW`.
    pub(super) fn parse_united(self, cell: &str) -> Option<(f64, &str)> {
        const LONGEST: usize = 64;
        if cell.len() > LONGEST || !cell.starts_with(|c: char| c.is_ascii_digit() || matches!(c, '-' | '+' | '.')) {
            return None;
        }
        let in_number = |c: char| c.is_ascii_digit() || matches!(c, '.' | ',' | '-' | '+' | 'e' | 'E');
        let (number, unit) = cell.split_at(cell.find(|c: char| !in_number(c))?);
        let value = self.number(number).filter(|value| value.is_finite())?;
        // `10% gray` is a name.
        let sole = |unit: &str| !unit.starts_with('%') || unit == "%";
        Some((value, unit.trim())).filter(|(_, unit)| unit_text::is_value_unit(unit) && sole(unit))
    }

    pub(super) fn has_mark(self, cell: &str) -> bool {
        cell.contains(match self.mark {
            DecimalMark::Point => '.',
            DecimalMark::Comma => ',',
        })
    }
}

/// Numbers as most are, digits with at most one mark among them, several times faster than the general way. Exact: a
/// whole number below 2^53 divided by a power of ten below 10^22 is rounded once (W. D. Clinger 1990).
fn parse_plain(cell: &[u8], mark: u8) -> Option<f64> {
    const POWERS: [f64; 16] = [1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15];
    let (negative, digits) = match cell {
        [b'-', rest @ ..] => (true, rest),
        rest => (false, rest),
    };
    // One mark and at most 15 digits, so that the whole number stays below 2^53.
    if digits.len() > POWERS.len() || !digits.last()?.is_ascii_digit() {
        return None;
    }
    let (mut whole, mut fraction) = (0_u64, None);
    for (index, &byte) in digits.iter().enumerate() {
        if byte.is_ascii_digit() {
            whole = whole * 10 + u64::from(byte - b'0');
        } else if byte == mark && fraction.is_none() {
            fraction = Some(digits.len() - 1 - index);
        } else {
            return None;
        }
    }
    if fraction.is_none() && digits.len() == POWERS.len() {
        return None;
    }
    let value = whole as f64 / POWERS[fraction.unwrap_or(0)];
    Some(if negative { -value } else { value })
}

fn parse_decimal_comma(cell: &str) -> Option<f64> {
    const LONGEST: usize = 64;
    let bytes = cell.as_bytes();
    // `380,` is a number and a separator, not a number with an empty fraction.
    if bytes.len() > LONGEST || bytes.last() == Some(&b',') || bytes.contains(&b'.') {
        return None;
    }
    cell.replace(',', ".").parse().ok()
}

fn is_gap(cell: &str) -> bool {
    const LONGEST: usize = 16;
    if cell.is_empty() || cell.bytes().all(|b| b == b'-') || cell.bytes().all(|b| b == b'*') {
        return true;
    }
    // Few cells get here in a sound file, but a hostile one is nothing else.
    if cell.len() > LONGEST || !cell.starts_with(['n', 'N', '#', '*', '1', '-', '+', '.', 's', 'S', '<', '>']) {
        return false;
    }
    // Beyond a limit of detection, as of `<0.01`.
    if let Some(limit) = cell.strip_prefix(['<', '>']) {
        return limit.trim().parse::<f64>().is_ok();
    }
    let lower = cell.to_ascii_lowercase();
    // What C runtimes on Windows print for not-a-number and infinity.
    GAPS.contains(&lower.as_str()) || lower.trim_start_matches(['-', '+']).starts_with("1.#")
}

/// Grouping of commas that both separate whole numbers and mark fractions, `400,0,060` or `400,5,0,060`: how the pieces belong
/// together, a bit for each comma that marks a fraction. Each value has a fraction then, or all but the first number.
fn joined(line: &str) -> u64 {
    const MOST: usize = 32;
    let digits = |piece: &str| {
        let bare = piece.trim().trim_start_matches('-');
        !bare.is_empty() && bare.bytes().all(|b| b.is_ascii_digit())
    };
    let count = line.bytes().filter(|byte| *byte == b',').take(MOST).count() + 1;
    if !(3..=MOST).contains(&count) || !line.split(',').all(digits) {
        return 0;
    }
    let first = count % 2;
    (first..count - 1).step_by(2).fold(0, |bits, comma| bits | 1 << comma)
}

#[derive(Debug, Clone)]
pub(super) struct Cells<'a> {
    rest: Option<&'a str>,
    delimiter: Delimiter,
    quotes: bool,
    /// Commas, by bits, that mark fractions; and how many have been passed.
    joined: u64,
    at: u32,
}

impl<'a> Iterator for Cells<'a> {
    type Item = &'a str;

    #[inline]
    fn next(&mut self) -> Option<&'a str> {
        let rest = self.rest?;
        if self.quotes
            && rest.trim_start_matches(' ').starts_with('"')
            && let Some(cell) = self.quoted(rest)
        {
            return Some(cell);
        }
        let mut found = self.delimiter.find(rest);
        if self.joined != 0 {
            if self.joined >> self.at & 1 == 1
                && let Some((end, width)) = found
            {
                self.at += 1;
                found = self.delimiter.find(&rest[end + width..]).map(|(at, width)| (end + 1 + at, width));
            }
            self.at += 1;
        }
        let Some((end, width)) = found else {
            self.rest = None;
            return Some(rest.trim_ascii());
        };
        let after = &rest[end + width..];
        self.rest = Some(if self.delimiter == Delimiter::Spaces { after.trim_ascii_start() } else { after });
        Some(rest[..end].trim_ascii())
    }
}

impl<'a> Cells<'a> {
    /// A cell in quotes, if the quotes are closed where a cell ends. Some instruments open quotes they never close:
    /// then the rest of the line is taken as it stands, which also keeps this linear.
    fn quoted(&mut self, rest: &'a str) -> Option<&'a str> {
        let inner = rest.trim_start_matches(' ').strip_prefix('"')?;
        let bytes = inner.as_bytes();
        let mut at = 0;
        while at < bytes.len() && (bytes[at] != b'"' || bytes.get(at + 1) == Some(&b'"')) {
            at += if bytes[at] == b'"' { 2 } else { 1 };
        }
        let after = inner.get(at + 1..).unwrap_or("");
        let tail =
            if self.delimiter == Delimiter::Tab { after.trim_start_matches(' ') } else { after.trim_ascii_start() };
        let closed = at < bytes.len()
            && (tail.is_empty()
                || self.delimiter.find(tail).is_some_and(|(end, _)| end == 0)
                || self.delimiter == Delimiter::Spaces && after.starts_with([' ', '\t']));
        if !closed {
            self.quotes = false;
            return None;
        }
        self.rest = match (self.delimiter, self.delimiter.find(tail)) {
            _ if tail.is_empty() => None,
            (Delimiter::Spaces, _) => Some(tail),
            (_, Some((_, width))) => Some(&tail[width..]),
            (_, None) => None,
        };
        Some(inner[..at].trim_ascii())
    }
}

impl Delimiter {
    #[inline]
    fn find(self, text: &str) -> Option<(usize, usize)> {
        let wanted = match self {
            Self::Comma => b',',
            Self::Semicolon => b';',
            Self::Tab => b'\t',
            Self::Bar => b'|',
            Self::CommaSpace => return text.find(", ").map(|at| (at, 2)),
            Self::Elements => return None,
            Self::Spaces => return text.bytes().position(|b| b.is_ascii_whitespace()).map(|at| (at, 1)),
        };
        text.bytes().position(|b| b == wanted).map(|at| (at, 1))
    }
}
