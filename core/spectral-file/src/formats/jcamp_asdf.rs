//! Ordinates as JCAMP-DX squeezes them: letters that carry a digit and a sign, differences, repetitions.

use crate::decimal::last_digit;

#[derive(Debug, PartialEq)]
pub(super) struct Ordinates {
    /// The abscissa at its head, and the unit of its last digit.
    pub(super) head: (f64, f64),
    /// The values of the line, with one that only repeats the last of the line before.
    pub(super) values: Vec<f64>,
    /// True if the last value was written as a difference: the next line then begins by repeating it.
    pub(super) ends_in_difference: bool,
}

#[derive(Debug, Clone, Copy, PartialEq)]
enum Kind {
    /// The abscissa or a value, with an ordinary sign or none, or the sign in its first letter.
    Value,
    /// The difference from the value before.
    Difference,
    /// Number of repetitions of the entry before.
    Repeat,
}

/// The most values of a line, far above any line of a sound file: a few letters can request billions.
const MOST_VALUES: usize = 100_000;

/// Decodes a line; `None` for a blank one. The error is the text that is not a number.
pub(super) fn decode(line: &str) -> Result<Option<Ordinates>, &str> {
    let mut entries = entries(line)?.into_iter();
    let abscissa = match entries.next() {
        None => return Ok(None),
        Some((Kind::Value, number)) if !number.is_nan() => number,
        Some(_) => return Err(line.trim()),
    };
    let mut values: Vec<f64> = Vec::new();
    let mut before: Option<(Kind, f64)> = None;
    for (kind, number) in entries {
        match (kind, before, values.last()) {
            (Kind::Value, ..) => values.push(number),
            (Kind::Difference, _, Some(last)) => values.push(last + number),
            (Kind::Repeat, Some((entry, step)), Some(&last)) => {
                let mut value = last;
                // The entry itself is the first of the repetitions.
                if number > MOST_VALUES as f64 || values.len() > MOST_VALUES {
                    return Err(line.trim());
                }
                for _ in 1..number.max(1.0) as usize {
                    value += if entry == Kind::Difference { step } else { 0.0 };
                    values.push(value);
                }
                continue;
            }
            _ => return Err(line.trim()),
        }
        before = Some((kind, number));
    }
    let ends_in_difference = before.is_some_and(|(kind, _)| kind == Kind::Difference);
    let start = line.trim_start_matches(separates);
    let body = start.char_indices().nth(1).map_or("", |(at, _)| &start[at..]);
    let digits = &start[..start.len() - body.len() + end(body)];
    // A first letter is a digit and no exponent.
    let plain = digits.trim_start_matches(|c: char| c.is_ascii_alphabetic());
    Ok(Some(Ordinates { head: (abscissa, last_digit(plain)), values, ends_in_difference }))
}

/// The entries of a line. Plain numbers may have exponents, which squeezed ones never have.
fn entries(line: &str) -> Result<Vec<(Kind, f64)>, &str> {
    let mut found = Vec::new();
    let mut rest = line.trim_start_matches(separates);
    while let Some(first) = rest.chars().next() {
        let (kind, lead) = lead(first).ok_or(rest)?;
        let body = &rest[first.len_utf8()..];
        let end = end(body);
        let number = match (first, &body[..end]) {
            ('?', "") => f64::NAN,
            (_, digits) => number(lead, digits).ok_or(rest)?,
        };
        found.push((kind, number));
        if found.len() > MOST_VALUES {
            return Err(line.trim());
        }
        rest = body[end..].trim_start_matches(separates);
    }
    Ok(found)
}

fn separates(c: char) -> bool {
    c.is_whitespace() || c == ','
}

/// End of the digits after the first character.
fn end(body: &str) -> usize {
    let bytes = body.as_bytes();
    let mut at = 0;
    while at < bytes.len() {
        let exponent = matches!(bytes[at], b'E' | b'e')
            && matches!(bytes.get(at + 1), Some(b'+' | b'-'))
            && bytes.get(at + 2).is_some_and(u8::is_ascii_digit);
        match bytes[at] {
            b'0'..=b'9' | b'.' => at += 1,
            _ if exponent => at += 3,
            _ => break,
        }
    }
    at
}

/// The number that a first character and the digits after it stand for.
fn number(lead: (bool, Option<u8>), digits: &str) -> Option<f64> {
    // On the stack: a file holds millions of entries, of a few letters each.
    const LONGEST: usize = 48;
    let mut buffer = [0; LONGEST];
    let mut length = 0;
    let (negative, first) = lead;
    for byte in negative.then_some(b'-').into_iter().chain(first).chain(digits.bytes()) {
        *buffer.get_mut(length)? = byte;
        length += 1;
    }
    std::str::from_utf8(&buffer[..length]).ok()?.parse().ok().filter(|number: &f64| number.is_finite())
}

/// Meaning of the first character of an entry: its kind, its sign and its first digit.
fn lead(first: char) -> Option<(Kind, (bool, Option<u8>))> {
    let digit = |from: u8| Some((first as u8).wrapping_sub(from) + b'1');
    Some(match first {
        '0'..='9' | '.' => (Kind::Value, (false, Some(first as u8))),
        '-' => (Kind::Value, (true, None)),
        '+' | '?' => (Kind::Value, (false, None)),
        '@' => (Kind::Value, (false, Some(b'0'))),
        'A'..='I' => (Kind::Value, (false, digit(b'A'))),
        'a'..='i' => (Kind::Value, (true, digit(b'a'))),
        '%' => (Kind::Difference, (false, Some(b'0'))),
        'J'..='R' => (Kind::Difference, (false, digit(b'J'))),
        'j'..='r' => (Kind::Difference, (true, digit(b'j'))),
        'S'..='Z' => (Kind::Repeat, (false, digit(b'S'))),
        's' => (Kind::Repeat, (false, Some(b'9'))),
        _ => return None,
    })
}
