//! Words and numbers of a text, with their line and column, without a copy of the text.

use super::report::MeshReadError;

pub(super) const FARTHEST: f64 = 1e15;

/// A place in a text, which moves on word by word within a line and from line to line.
///
/// Lines end with LF, CRLF or CR. A backslash before the line's end continues it.
pub(super) struct Cursor<'a> {
    bytes: &'a [u8],
    at: usize,
    line: usize,
    line_start: usize,
    first_line: usize,
}

/// A word and the place where it begins.
#[derive(Clone, Copy)]
pub(super) struct Word<'a> {
    /// The word's bytes; never empty.
    pub(super) text: &'a [u8],
    pub(super) line: usize,
    /// The byte in the line, from 1.
    pub(super) column: usize,
}

impl<'a> Cursor<'a> {
    pub(super) fn new(bytes: &'a [u8]) -> Self {
        Self { bytes, at: 0, line: 1, line_start: 0, first_line: 1 }
    }

    /// The line on which the present statement begins.
    pub(super) fn first_line(&self) -> usize {
        self.first_line
    }

    pub(super) fn is_done(&self) -> bool {
        self.at >= self.bytes.len()
    }

    /// The next word of the statement, or none at its end or before a comment.
    #[inline]
    pub(super) fn word(&mut self) -> Option<Word<'a>> {
        self.skip_blanks();
        let start = self.at;
        let rest = &self.bytes[start..];
        if matches!(rest.first(), None | Some(b'\n' | b'\r' | b'#')) {
            return None;
        }
        let mut length = 0;
        while length < rest.len() && rest[length] > b' ' {
            if rest[length] == b'\\' && line_end(&rest[length + 1..]) > 0 {
                break;
            }
            length += 1;
        }
        self.at += length;
        Some(Word { text: &rest[..length], line: self.line, column: start - self.line_start + 1 })
    }

    /// The rest of the line without blanks around it: a name, which may hold blanks.
    pub(super) fn rest(&mut self) -> &'a [u8] {
        self.skip_blanks();
        let rest = &self.bytes[self.at..];
        let length = rest.iter().position(|b| matches!(b, b'\n' | b'\r')).unwrap_or(rest.len());
        self.at += length;
        rest[..length].trim_ascii()
    }

    #[inline]
    pub(super) fn next_line(&mut self) {
        self.skip_blanks();
        let comment = self.bytes.get(self.at) == Some(&b'#');
        while self.at < self.bytes.len() {
            let byte = self.bytes[self.at];
            if byte == b'\n' || byte == b'\r' {
                self.end_line();
                break;
            }
            self.at += 1;
            // Paths in comments may end with a backslash, which continues nothing.
            if byte == b'\\' && !comment && line_end(&self.bytes[self.at..]) > 0 {
                self.end_line();
            }
        }
        self.first_line = self.line;
    }

    /// The next word as a number, or none at the statement's end.
    #[inline]
    pub(super) fn number(&mut self) -> Result<Option<f64>, MeshReadError> {
        self.word().map(|word| parse_number(&word)).transpose()
    }

    /// The three coordinates of a vertex or normal.
    #[inline]
    pub(super) fn three(&mut self) -> Result<[f64; 3], MeshReadError> {
        let mut xyz = [0.0; 3];
        for (found, value) in xyz.iter_mut().enumerate() {
            *value = self.number()?.ok_or(MeshReadError::TooFewNumbers { line: self.first_line, found })?;
        }
        Ok(xyz)
    }

    pub(super) fn left(&self) -> &'a [u8] {
        &self.bytes[self.at..]
    }

    /// Advances to the next statement that is not empty.
    pub(super) fn skip_empty_lines(&mut self) {
        self.skip_blanks();
        while matches!(self.bytes.get(self.at), Some(b'\n' | b'\r' | b'#')) {
            self.next_line();
            self.skip_blanks();
        }
    }

    #[inline]
    fn skip_blanks(&mut self) {
        while let Some(&byte) = self.bytes.get(self.at) {
            if byte == b'\\' && line_end(&self.bytes[self.at + 1..]) > 0 {
                self.at += 1;
                self.end_line();
            } else if byte > b' ' || byte == b'\n' || byte == b'\r' {
                break;
            } else {
                self.at += 1;
            }
        }
    }

    fn end_line(&mut self) {
        self.at += line_end(&self.bytes[self.at..]);
        self.line += 1;
        self.line_start = self.at;
    }
}

/// The length of the line's end that these bytes begin with; zero where there is none.
fn line_end(bytes: &[u8]) -> usize {
    match bytes {
        [b'\r', b'\n', ..] => 2,
        [b'\r' | b'\n', ..] => 1,
        _ => 0,
    }
}

/// A word as a number; NaN and infinities are numbers here.
#[inline]
pub(super) fn parse_number(word: &Word<'_>) -> Result<f64, MeshReadError> {
    short_number(word.text)
        .or_else(|| std::str::from_utf8(word.text).ok().and_then(|text| text.parse().ok()))
        .ok_or(MeshReadError::Number { line: word.line, column: word.column })
}

/// A number of at most 18 digits with a small exponent, to the nearest double; none for all else.
///
/// A whole number below 2^53 and a power of ten up to 22 are exact doubles, so that one division or multiplication rounds
/// once (Clinger 1990). Nearly all coordinates are of this kind, at a fifth of the time of the general method.
#[inline]
fn short_number(text: &[u8]) -> Option<f64> {
    const TENS: [f64; 23] = [
        1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19,
        1e20, 1e21, 1e22,
    ];
    let (negative, text) = match text {
        [b'-', rest @ ..] => (true, rest),
        [b'+', rest @ ..] => (false, rest),
        _ => (false, text),
    };
    let (mut mantissa, mut digits, mut decimals, mut point, mut end) = (0_u64, 0, 0_i32, false, text.len());
    for (i, &byte) in text.iter().enumerate() {
        match byte {
            b'0'..=b'9' => {
                mantissa = mantissa * 10 + u64::from(byte - b'0');
                digits += 1;
                decimals += i32::from(point);
                if digits > 18 {
                    return None;
                }
            }
            b'.' if !point => point = true,
            b'e' | b'E' => {
                end = i;
                break;
            }
            _ => return None,
        }
    }
    let exponent = if end == text.len() { 0 } else { short_integer(&text[end + 1..])? };
    let power = exponent - decimals;
    let ten = *TENS.get(power.unsigned_abs() as usize)?;
    if digits == 0 || mantissa >= 1 << 53 {
        return None;
    }
    let value = if power < 0 { mantissa as f64 / ten } else { mantissa as f64 * ten };
    Some(if negative { -value } else { value })
}

/// A whole number of at most four digits.
fn short_integer(text: &[u8]) -> Option<i32> {
    let (sign, digits) = match text {
        [b'-', rest @ ..] => (-1, rest),
        [b'+', rest @ ..] => (1, rest),
        _ => (1, text),
    };
    if digits.is_empty() || digits.len() > 4 || !digits.iter().all(u8::is_ascii_digit) {
        return None;
    }
    Some(sign * digits.iter().fold(0, |n, d| n * 10 + i32::from(d - b'0')))
}
