//! Units, and mentions of photons, in the words of a header.

use crate::text::{has_part, is_one, lower, slashed, spaced};
use crate::{header_terms, units};

/// The unit in a piece of a header, if it holds one: in brackets, or alone.
pub(super) fn unit(text: &str) -> Option<String> {
    const LONGEST: usize = 200;
    let text = text.trim();
    if text.is_empty() || text.len() > LONGEST {
        return None;
    }
    let pairs = [('[', ']'), ('(', ')')];
    let bracketed =
        pairs.iter().find_map(|&(open, close)| last_bracket(text, open, close).filter(|inner| is_unit(inner)));
    // `R%` is a name with its sign.
    let signed = || Some("%").filter(|_| percent_sign(text).is_some_and(|at| at > 0));
    let behind_slash = || slashed(text).map(|(_, unit)| unit).filter(|unit| is_quotient(unit));
    let behind_name = || named_unit(text).map(|(_, unit)| unit.split(" (").next().unwrap_or(unit));
    let found = bracketed.or_else(signed).or_else(behind_slash).or_else(behind_name);
    found.or_else(|| Some(text).filter(|text| is_unit(text))).map(repaired)
}

/// A name, and the unit of light that follows it without brackets: `Global tilt  W*m-2*nm-1`.
fn named_unit(text: &str) -> Option<(&str, &str)> {
    let (name, unit) = text.trim().split_at_checked(units::parse(text.trim())?.start)?;
    let bare = name.trim_end_matches(|c: char| c.is_whitespace() || c == ',');
    let counted = lower(unit).starts_with(['p', 'q']);
    (bare.len() < name.len() && bare.ends_with(char::is_alphanumeric) && !counted && is_quotient(unit))
        .then_some((bare, unit))
}

/// The first sign of percent that is a unit: none in a figure such as `50%`, `50 %` or `50_%`, but that of `T8 %`.
pub(super) fn percent_sign(text: &str) -> Option<usize> {
    text.match_indices('%').map(|(at, _)| at).find(|&at| {
        let before = text[..at].trim_end_matches([' ', '_']);
        let word = before.rsplit([' ', '\t', '_', '(', '[', '"']).next().unwrap_or_default();
        let number = word.bytes().all(|b| b.is_ascii_digit() || matches!(b, b'.' | b',' | b'-' | b'+'));
        !(before.ends_with(|c: char| c.is_ascii_digit()) && (number || before.len() == at))
    })
}

/// The name before a sign of percent that ends it, unless a figure stands there: `R%`, `leaf %`, `T8 %`.
pub(super) fn percent_name(text: &str) -> Option<&str> {
    let name = text.trim().strip_suffix('%')?;
    let signed = percent_sign(text.trim()) == Some(name.len());
    Some(name.trim_end_matches([' ', '/', '_'])).filter(|name| signed && name.ends_with(char::is_alphanumeric))
}

/// Returns whether a text is a whole unit of light, such as `W m-2 nm-1`, and no part of one, such as `m2/nm`.
pub(super) fn is_quotient(text: &str) -> bool {
    const SIGNS: &str = "/.·*×^()[]-−–⁻+?\u{FFFD}";
    let written = |c: char| c.is_alphanumeric() || c.is_whitespace() || SIGNS.contains(c);
    text.chars().all(written) && units::parse(text).is_some_and(|unit| unit.start == 0)
}

/// A column's name without the unit in brackets at its end.
pub(super) fn without_unit(name: &str) -> &str {
    let name = name.trim();
    let ends = [('[', ']'), ('(', ')')].into_iter().find_map(|(open, close)| {
        let inner = name.ends_with(close).then(|| last_bracket(name, open, close))?.filter(|inner| is_unit(inner))?;
        let bare = name[..inner.as_ptr() as usize - name.as_ptr() as usize].trim_end().strip_suffix(open)?.trim_end();
        Some(bare).filter(|bare| !bare.is_empty())
    });
    let behind_slash = || slashed(name).filter(|(_, unit)| is_quotient(unit)).map(|(bare, _)| bare);
    ends.map(|bare| bare.trim_end_matches(['/', ',', ' ']))
        .or_else(|| percent_name(name))
        .or_else(behind_slash)
        .or_else(|| named_unit(name).filter(|(_, unit)| !unit.contains(" (")).map(|(bare, _)| bare))
        .filter(|bare| !bare.is_empty())
        .unwrap_or(name)
}

/// A text up to its first bracket.
pub(super) fn bare(text: &str) -> &str {
    text.split(['(', '[']).next().unwrap_or_default().trim()
}

fn last_bracket(text: &str, open: char, close: char) -> Option<&str> {
    let end = text.rfind(close)?;
    let mut depth = 1;
    let start = text[..end].char_indices().rev().find(|(_, c)| {
        depth += i32::from(*c == close) - i32::from(*c == open);
        depth == 0
    });
    start.map(|(at, _)| text[at + 1..end].trim())
}

/// The unit in a cell of a row of units, whatever it is.
pub(super) fn unit_cell(cell: &str) -> Option<String> {
    let cell = cell.trim();
    let inner = |[open, close]: [char; 2]| {
        let inner = cell.strip_prefix(open)?.strip_suffix(close)?.trim();
        Some(inner).filter(|inner| last_bracket(cell, open, close) == Some(*inner))
    };
    let bare = inner(['[', ']']).or_else(|| inner(['(', ')'])).unwrap_or(cell).trim();
    let usable = !bare.is_empty() && bare.chars().count() <= LONGEST_UNIT;
    usable.then(|| repaired(bare))
}

const LONGEST_UNIT: usize = 40;

fn is_unit(text: &str) -> bool {
    const WHOLE: &str = "a.u.|au|a. u.|arb. units|arb.u.|relative|rel.|fraction|dbm|db|dn|dl";
    // Behind a sign of equality stands another that it is equal to.
    if text.is_empty() || text.starts_with('=') || text.chars().count() > LONGEST_UNIT {
        return false;
    }
    let lower = text.to_lowercase();
    // `10%` is a figure, `%` a unit.
    (text.contains('%') && header_terms::says_percent(text))
        || is_light_unit(text)
        || is_one(&lower, WHOLE)
        || header_terms::says_counts(&lower)
        || (header_terms::says_percent(&lower) && !lower.contains(['(', '[']))
        || has_part(&lower, "w/|watt|w m|w·|w.m|mol/|mol m|photons/|j/|/nm")
}

/// Returns whether a text can be the unit beside a single value: also one of power, which no header needs a list for.
pub(super) fn is_value_unit(text: &str) -> bool {
    const BASES: &str = "w|watt|watts|j|a|v|lm|lx|lux|cd|mol|count|cts";
    // What a wrong separator leaves of numbers is no unit.
    if text.bytes().all(|b| b.is_ascii() && !b.is_ascii_alphabetic() && b != b'%') {
        return false;
    }
    let lower = text.to_lowercase();
    let base = lower.split(['/', '·', '*', '.', ' ', '^']).next().unwrap_or_default();
    let bare = base.strip_prefix(['m', 'µ', 'μ', 'u', 'n', 'p', 'k']).unwrap_or(base);
    is_unit(text) || (text.chars().count() <= LONGEST_UNIT && (is_one(base, BASES) || is_one(bare, BASES)))
}

/// A unit whose µ and ² were lost or doubled on the way through encodings, with them restored.
fn repaired(unit: &str) -> String {
    let lost = |c: char| matches!(c, '?' | '\u{FFFD}');
    let mut text = unit.replace("Â", "");
    if let Some(rest) = text.strip_prefix(lost).filter(|rest| rest.starts_with(['W', 'w', 'J', 'm'])) {
        text = format!("µ{rest}");
    }
    for area in ["cm", "m"] {
        if let Some(at) = text.find(&format!("/{area}")).map(|at| at + 1 + area.len())
            && let Some(rest) = text[at..].strip_prefix(lost)
        {
            text = format!("{}²{rest}", &text[..at]);
        }
    }
    text
}

/// A name without the signs that are units, not part of a figure such as `50 %`.
pub(super) fn without_percent_signs(name: &str) -> String {
    let mut figure = false;
    let kept = name.chars().filter(|c| {
        let keep = *c != '%' || figure;
        figure = c.is_ascii_digit() || (figure && c.is_whitespace());
        keep
    });
    tidy(&kept.collect::<String>())
}

/// A text without what blanks and brackets the removal of words leaves.
pub(super) fn tidy(text: &str) -> String {
    let text = text.replace("()", "").replace("[]", "");
    text.split_whitespace().collect::<Vec<_>>().join(" ").trim_end_matches([',', ':', ';']).to_owned()
}

pub(super) fn is_light_unit(text: &str) -> bool {
    units::parse(text).is_some() || is_per_photon(text) || is_per_energy(text) || is_photons(text)
}

/// Returns whether a unit is one of a response to power or energy.
pub(super) fn is_per_energy(unit: &str) -> bool {
    is_one(&lower(unit).replace(' ', ""), "a/w|ma/w|v/w|mv/w|1/w|1/j")
}

pub(super) fn is_photons(text: &str) -> bool {
    is_one(lower(text).trim(), "photon|photons|quanta|qntm")
}

pub(super) fn is_per_photon(unit: &str) -> bool {
    let lower = lower(unit).replace(" per ", "/").replace(' ', "");
    ["/photon", "/photons", "/quantum", "photon-1", "photon^-1", "photon⁻¹"].iter().any(|end| lower.ends_with(end))
}

/// Quantities of photons.
const PHOTON_PHRASES: &str = "photon flux|photon irradian|photon radian|photon exitan|photon fluence|photon intensity|\
    quantum flux|quantum irradian|(qntm)|s.q.irrad";

/// Returns whether a text names a quantity of photons, and not only a lamp.
pub(super) fn names_photons(text: &str) -> bool {
    if header_terms::says_counts(text) {
        return false;
    }
    let lower = spaced(text).replace('_', " ");
    let word = |word: &str| is_one(word, "ppfd|pfd|spfd|photons|quanta|qntm");
    has_part(&lower, PHOTON_PHRASES)
        || lower.split(|c: char| !c.is_alphanumeric()).any(word) && !lower.contains("/photon")
}

/// Returns whether a line of free text states that all values are photons: LI-COR's `(QNTM)`, or a sentence on all
/// values, or a title that is one of their quantities.
pub(super) fn said_in_prose(line: &str) -> bool {
    let lower = lower(line);
    let values = has_part(&lower, "values are in |values in |units are ");
    let photons = has_part(&lower, "photons per |moles of photons|mol of photons");
    // A figure is that of a sum: `Photon flux 400-700 nm: 12.3`.
    let title = !lower.contains([':', '=', ',', ';', '\t']) && !lower.contains(|c: char| c.is_ascii_digit());
    line.contains("(QNTM)")
        || (values && photons || title && has_part(&lower, PHOTON_PHRASES)) && !header_terms::says_counts(&lower)
}

/// Returns whether a title or a line of free text states that sensitivities are quantum efficiencies or responses per
/// photon.
pub(super) fn says_per_photon(text: &str) -> bool {
    let lower = lower(text);
    let qe = lower.split(|c: char| !c.is_alphanumeric()).any(|word| is_one(word, "qe|eqe|iqe"));
    (qe || has_part(&lower, "quantum eff|quantal|per photon|/photon|per quantum")) && !lower.contains("energ")
}
