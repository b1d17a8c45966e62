//! Numbers and names as text.

use std::borrow::Cow;
use std::fmt::{Arguments, Write};

use crate::role::Values;
use crate::write::sheet::Content;
use crate::{header_terms, photons, unit_text};

pub(super) use chromascope_text::on_one_line as one_line;

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

/// A number with a point in it: readers of CGATS take whole numbers for integers.
pub(super) fn push_real(out: &mut String, value: f64) {
    let start = out.len();
    push_number(out, value);
    if !out[start..].contains('.') {
        let end = out[start..].find('e').map_or(out.len(), |at| start + at);
        out.insert_str(end, ".0");
    }
}

/// The name of a curve: on one line, not blank, and not one that a reader takes for a unit which the values are not in.
pub(super) fn name<'a>(text: &'a str, index: usize, content: Content<'_>) -> Cow<'a, str> {
    let mut name = one_line(text);
    if misleads(&name, content) {
        name = Cow::Owned(unit_text::without_percent_signs(&name));
    }
    let bad = name.is_empty() || heads_wavelengths(&name) || misleads(&name, content);
    if bad { Cow::Owned(format!("Curve {}", index + 1)) } else { name }
}

/// Returns whether a reader would convert the values under such a name. What responds to light is never scaled down from percent.
fn misleads(name: &str, content: Content<'_>) -> bool {
    match header_terms::values(name) {
        // Energies are not photons or powers per frequency.
        _ if matches!(content, Content::Illuminant | Content::Other) && photons::converts(name) => true,
        None | Some(Values::Plain) => false,
        Some(Values::Decibels) => true,
        Some(Values::Percent | Values::Absorbance) => !matches!(content, Content::Camera { .. } | Content::Observer),
    }
}

/// Returns whether a reader would take a column of such a name for one of wavelengths.
fn heads_wavelengths(name: &str) -> bool {
    const LONGEST_UNIT: usize = 4;
    header_terms::names_wavelengths(name) || (name.len() <= LONGEST_UNIT && header_terms::x_unit(name).is_some())
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
