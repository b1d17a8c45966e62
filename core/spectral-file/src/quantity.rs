//! What physical quantity the values of a table are, and in which unit.

use std::fmt;

use serde::{Deserialize, Serialize};

use super::grid::Grid;
use super::text::excerpt;
use super::watch::Log;
use super::words;
use super::{Certainty, Decided, Role, Warning, photons};

/// The physical quantity of values.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
#[non_exhaustive]
pub enum Quantity {
    /// Reflectance, or a reflectance factor.
    Reflectance,
    /// Transmittance.
    Transmittance,
    /// Absorptance: the fraction that is neither reflected nor transmitted. (Absorbances are read as transmittances.)
    Absorptance,
    /// Response to energy or to photons, usually relative.
    Sensitivity,
    /// Electrons for each photon.
    QuantumEfficiency,
    /// Power on an area, `W/m²/nm`.
    Irradiance,
    /// Power from an area into a solid angle, `W/sr/m²/nm`.
    Radiance,
    /// Power, `W/nm`.
    RadiantFlux,
    /// Power into a solid angle, `W/sr/nm`.
    RadiantIntensity,
    /// Spectral power of a light, without a word on its geometry.
    SpectralPower,
    /// What a detector counted: its own sensitivity is still in it.
    Counts,
    /// A relative scale, without a word on what is compared.
    Relative,
    /// Nothing says what it is.
    Unknown,
}

impl Quantity {
    /// What curves of this quantity are, if they are only one thing.
    pub fn role(self) -> Option<Role> {
        match self {
            Self::Reflectance => Some(Role::Reflectance),
            Self::Transmittance => Some(Role::Transmittance),
            Self::Sensitivity | Self::QuantumEfficiency => Some(Role::Camera),
            Self::Irradiance | Self::Radiance | Self::RadiantFlux | Self::RadiantIntensity | Self::SpectralPower => {
                Some(Role::Illuminant)
            }
            // Neither a light nor a fraction of one that a picture needs.
            Self::Absorptance | Self::Counts => Some(Role::Unknown),
            Self::Relative | Self::Unknown => None,
        }
    }
}

impl fmt::Display for Quantity {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Reflectance => "reflectance",
            Self::Transmittance => "transmittance",
            Self::Absorptance => "absorptance",
            Self::Sensitivity => "spectral sensitivity",
            Self::QuantumEfficiency => "quantum efficiency",
            Self::Irradiance => "irradiance",
            Self::Radiance => "radiance",
            Self::RadiantFlux => "radiant flux",
            Self::RadiantIntensity => "radiant intensity",
            Self::SpectralPower => "spectral power",
            Self::Counts => "counts of a detector",
            Self::Relative => "a relative scale",
            Self::Unknown => "a quantity that the file does not name",
        })
    }
}

/// The quantity of a grid whose role is decided. A role that was chosen has its own, whatever the file says.
pub(super) fn decide(grid: &Grid, role: &Decided<Role>, log: &mut Log<'_>) -> Decided<Quantity> {
    let said = said(grid, role);
    let other = |quantity: Quantity| quantity.role().is_some_and(|other| other != role.value);
    let chosen = role.certainty == Certainty::Chosen && role.value != Role::Unknown;
    match said {
        Some(said) if !(chosen && other(said.value)) => return said,
        Some(said) => log.push(Warning::OtherQuantity { quantity: said.value, role: role.value }),
        None => {}
    }
    let quantity = match role.value {
        Role::Camera => Quantity::Sensitivity,
        Role::Reflectance => Quantity::Reflectance,
        Role::Transmittance => Quantity::Transmittance,
        Role::Illuminant => Quantity::SpectralPower,
        Role::Unknown => Quantity::Unknown,
    };
    Decided { value: quantity, certainty: role.certainty, why: format!("The curves are {}", role.value) }
}

/// The quantity that the file names.
fn said(grid: &Grid, role: &Decided<Role>) -> Option<Decided<Quantity>> {
    if let Some(quantity) = &grid.quantity {
        return Some(quantity.clone());
    }
    // A relative scale of sensitivities is one of sensitivities.
    let fits = |quantity: Quantity| quantity != Quantity::Relative || !matches!(role.value, Role::Camera);
    let labeled = grid.curves.iter().find_map(|curve| Some((words::quantity(&curve.label)?, &curve.label)));
    if let Some((quantity, label)) = labeled.filter(|(quantity, _)| fits(*quantity)) {
        return Some(Decided::certain(quantity, format!("A column is headed “{}”", excerpt(label))));
    }
    if let Some((line, quantity)) = grid.header.quantity.filter(|(_, quantity)| fits(*quantity)) {
        return Some(Decided::certain(quantity, format!("Line {line} says so")));
    }
    let unit = grid.curves.iter().find_map(|curve| curve.unit.as_deref());
    let (unit, quantity) = unit.and_then(|unit| Some((unit, of_unit(unit).filter(|unit| fits(*unit))?)))?;
    Some(Decided::certain(quantity, format!("The unit is {unit}")))
}

/// Whether sensitivities are responses per photon. Quantum efficiencies are, by their definition.
pub(super) fn per_photon(grid: &Grid, role: Role, quantity: &Decided<Quantity>) -> Option<Decided<bool>> {
    if role != Role::Camera {
        return None;
    }
    let said = grid.header.comment("response").map(|response| response.trim().to_lowercase());
    match said.as_deref() {
        Some("per photon" | "per photon (stated)") => {
            return Some(Decided::certain(true, "The comment “response” says so"));
        }
        Some("per energy" | "per energy (stated)") => {
            return Some(Decided::certain(false, "The comment “response” says so"));
        }
        Some("per photon (inferred)") => return Some(Decided::guess(true, "The comment “response” says: inferred")),
        Some("per energy (inferred)") => return Some(Decided::guess(false, "The comment “response” says: inferred")),
        _ => {}
    }
    if let Some(said) = photons::response(grid) {
        return Some(said);
    }
    Some(if quantity.value == Quantity::QuantumEfficiency {
        Decided::certain(true, "Quantum efficiencies are counted per photon")
    } else {
        Decided::guess(false, "Nothing says that they are per photon")
    })
}

/// The quantity that a unit belongs to.
pub(super) fn of_unit(unit: &str) -> Option<Quantity> {
    const LONGEST: usize = 40;
    if unit.len() > LONGEST {
        return None;
    }
    if let Some(quantity) = photons::quantity(unit) {
        return Some(quantity);
    }
    let lower: String = unit.to_lowercase().chars().filter(|c| !matches!(c, ' ' | '^' | '·' | '*' | '-')).collect();
    let lower = lower.replace("watt", "w").replace('²', "2");
    let power = ["w/", "w.", "wm", "wcm", "mol/", "photons/", "j/"].iter().any(|part| lower.contains(part));
    let area = ["m2", "m²"].iter().any(|part| lower.contains(part));
    match (power, area, lower.contains("sr")) {
        (true, true, true) => Some(Quantity::Radiance),
        (true, true, false) => Some(Quantity::Irradiance),
        (true, false, true) => Some(Quantity::RadiantIntensity),
        (true, false, false) => Some(Quantity::RadiantFlux),
        _ if matches!(lower.as_str(), "w" | "mw" | "µw" | "μw" | "uw" | "nw") => Some(Quantity::RadiantFlux),
        _ if words::says_counts(&lower) => Some(Quantity::Counts),
        _ if lower == "relative" || lower == "rel." => Some(Quantity::Relative),
        _ => None,
    }
}

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
    let signed = || Some("%").filter(|_| text.contains('%') && percent_name(text).is_some());
    bracketed.or_else(signed).or_else(|| Some(text).filter(|text| is_unit(text))).map(repaired)
}

/// The name before a sign of percent that ends it, unless a figure stands there: `R%`, `leaf %`.
pub(super) fn percent_name(text: &str) -> Option<&str> {
    let name = text.trim().strip_suffix('%')?.trim_end();
    name.ends_with(char::is_alphabetic).then_some(name)
}

/// A column's name without the unit in brackets at its end.
pub(super) fn without_unit(name: &str) -> &str {
    let name = name.trim();
    let ends = [('[', ']'), ('(', ')')].into_iter().find_map(|(open, close)| {
        let inner = name.ends_with(close).then(|| last_bracket(name, open, close))?.filter(|inner| is_unit(inner))?;
        let bare = name[..inner.as_ptr() as usize - name.as_ptr() as usize].trim_end().strip_suffix(open)?.trim_end();
        Some(bare).filter(|bare| !bare.is_empty())
    });
    ends.or_else(|| percent_name(name)).unwrap_or(name)
}

/// What stands in the last pair of brackets, which may hold others.
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
    let bare = cell.trim().trim_start_matches(['[', '(']).trim_end_matches([']', ')']).trim();
    let usable = !bare.is_empty() && bare.chars().count() <= LONGEST_UNIT;
    usable.then(|| repaired(bare))
}

/// Longer texts are no units.
const LONGEST_UNIT: usize = 40;

fn is_unit(text: &str) -> bool {
    if text.is_empty() || text.chars().count() > LONGEST_UNIT {
        return false;
    }
    let lower = text.to_lowercase();
    let whole =
        ["a.u.", "au", "a. u.", "arb. units", "arb.u.", "relative", "rel.", "fraction", "dbm", "db", "dn", "dl"];
    // `10%` is a figure, `%` a unit.
    (text.contains('%') && words::says_percent(text))
        || photons::is_unit(text)
        || whole.contains(&lower.as_str())
        || words::says_counts(&lower)
        || (words::says_percent(&lower) && !lower.contains(['(', '[']))
        || ["w/", "watt", "w m", "w·", "w.m", "mol/", "mol m", "photons/", "j/", "/nm"]
            .iter()
            .any(|part| lower.contains(part))
}

/// Whether a text can be the unit beside a single value: also one of power, which no header needs a list for.
pub(super) fn is_value_unit(text: &str) -> bool {
    const BASES: [&str; 13] = ["w", "watt", "watts", "j", "a", "v", "lm", "lx", "lux", "cd", "mol", "count", "cts"];
    let lower = text.to_lowercase();
    let base = lower.split(['/', '·', '*', '.', ' ', '^']).next().unwrap_or_default();
    let bare = base.strip_prefix(['m', 'µ', 'μ', 'u', 'n', 'p', 'k']).unwrap_or(base);
    is_unit(text) || (text.chars().count() <= LONGEST_UNIT && (BASES.contains(&base) || BASES.contains(&bare)))
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
