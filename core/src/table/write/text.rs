//! Numbers and names as text.

use std::borrow::Cow;
use std::fmt::{Arguments, Write};

/// Appends what a format string makes.
pub(super) fn push(out: &mut String, arguments: Arguments<'_>) {
    out.write_fmt(arguments).expect("a text takes whatever is written to it");
}

/// Appends the shortest decimal that reads back as the same double: `0.055`, `400`, `1e-7`, `1.5e300`.
pub(super) fn push_number(out: &mut String, value: f64) {
    const PLAIN: std::ops::Range<f64> = 1e-5..1e16;
    let plain = value == 0.0 || PLAIN.contains(&value.abs());
    if plain { push(out, format_args!("{value}")) } else { push(out, format_args!("{value:e}")) }
}

/// The same with a point in it: readers of CGATS take whole numbers for integers.
pub(super) fn push_real(out: &mut String, value: f64) {
    let start = out.len();
    push_number(out, value);
    if !out[start..].contains('.') {
        let end = out[start..].find('e').map_or(out.len(), |at| start + at);
        out.insert_str(end, ".0");
    }
}

/// A text without line breaks and other control characters, and without blanks around it.
pub(super) fn one_line(text: &str) -> Cow<'_, str> {
    let text = text.trim();
    let breaks = |c: char| c.is_control() || matches!(c, '\u{2028}' | '\u{2029}');
    if text.contains(breaks) {
        let spaced: String = text.chars().map(|c| if breaks(c) { ' ' } else { c }).collect();
        return Cow::Owned(spaced.trim().to_owned());
    }
    Cow::Borrowed(text)
}

/// The name of a curve: on one line, and not blank.
pub(super) fn name(text: &str, index: usize) -> Cow<'_, str> {
    let name = one_line(text);
    if name.is_empty() { Cow::Owned(format!("Curve {}", index + 1)) } else { name }
}

/// Appends a text between quotation marks, those inside doubled, as CSV and CGATS have it.
pub(super) fn push_quoted(out: &mut String, text: &str) {
    out.push('"');
    for part in text.split_inclusive('"') {
        out.push_str(part);
        if part.ends_with('"') {
            out.push('"');
        }
    }
    out.push('"');
}
