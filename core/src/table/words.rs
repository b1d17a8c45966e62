//! What the words of a header say about units and quantities.

use super::scale::Role;
use super::wavelengths::WavelengthUnit;

/// Longer header lines are prose, or hostile.
const LONGEST: usize = 2000;

/// What stands on the x axis, as a header may name it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum XUnit {
    Wavelength(WavelengthUnit),
    /// Wave numbers or frequencies.
    Other,
}

/// Lower case, without what no header needs; empty if the text is too long to be a header.
fn lower(text: &str) -> String {
    if text.len() > LONGEST { String::new() } else { text.to_lowercase() }
}

fn words(lower: &str) -> impl Iterator<Item = &str> {
    lower.split(|c: char| !c.is_alphanumeric() && c != '-' && c != '^' && c != '/').filter(|word| !word.is_empty())
}

/// The first unit of length (or of wave number) in a piece of text.
pub(super) fn x_unit(text: &str) -> Option<XUnit> {
    let text = lower(text);
    if text.contains("wavenumber") || text.contains("wave number") {
        return Some(XUnit::Other);
    }
    words(&text).find_map(|word| match word {
        "cm-1" | "cm^-1" | "1/cm" | "thz" => Some(XUnit::Other),
        _ => WavelengthUnit::from_symbol(word).map(XUnit::Wavelength),
    })
}

/// The unit that a line of free text gives for wavelengths: the first unit after the word.
pub(super) fn x_unit_in_prose(text: &str) -> Option<XUnit> {
    let text = lower(text);
    let start = ["wavelength", "x unit", "xunit", "x axis", "xaxis"].iter().find_map(|word| text.find(word))?;
    x_unit(&text[start..])
}

/// Whether a column's header names wavelengths.
pub(super) fn names_wavelengths(text: &str) -> bool {
    let text = lower(text);
    text.contains("wavelength")
        || text.contains("lambda")
        || text.contains('λ')
        || words(&text).next().is_some_and(|word| matches!(word, "wave" | "wl" | "nm" | "um" | "µm" | "μm"))
}

/// Whether a header says percent.
pub(super) fn says_percent(text: &str) -> bool {
    let text = lower(text);
    text.contains('%') || words(&text).any(|word| matches!(word, "percent" | "pct" | "percentage"))
}

/// Whether a header says that values are fractions of one.
pub(super) fn says_fraction(text: &str) -> bool {
    let text = lower(text);
    words(&text).any(|word| matches!(word, "fraction" | "0-1" | "1"))
}

/// What a header says the values are.
pub(super) fn role(text: &str) -> Option<Role> {
    let text = lower(text);
    let any = |parts: &[&str]| parts.iter().any(|part| text.contains(part));
    if any(&["sensitiv", "responsiv", "quantum eff", "color match", "colour match", "color-match", "cone fund"]) {
        Some(Role::Camera)
    } else if any(&["reflect", "transmit", "transmiss", "r-factor"]) {
        Some(Role::Reflectance)
    } else if any(&["radian", "illuminan", "spectral power", "emission", "light source"])
        || words(&text).any(|word| matches!(word, "lux" | "cct" | "spd"))
    {
        Some(Role::Illuminant)
    } else {
        None
    }
}

/// How a name points to a channel of a camera.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Channel {
    /// By a letter, `R`.
    Letter(usize),
    /// By a word, `red`, which can also be the color of a thing.
    Word(usize),
}

/// The channel (0, 1, 2) that a name stands for.
pub(super) fn channel(name: &str) -> Option<Channel> {
    let name = lower(name);
    let position = |word: &str, list: &[&str]| list.iter().position(|entry| *entry == word);
    let parts = || name.split(|c: char| !c.is_alphanumeric()).filter(|part| !part.is_empty());
    parts().find_map(|part| {
        let letters = ["r", "g", "b", "x", "y", "z", "l", "m", "s", "xbar", "ybar", "zbar", "rbar", "gbar", "bbar"];
        let letter = position(part, &letters).map(|i| Channel::Letter(i % 3));
        letter.or_else(|| position(part, &["red", "green", "blue"]).map(Channel::Word))
    })
}
