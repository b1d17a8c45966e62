//! Names and units of wavelengths in the words of a header.

use crate::report::Medium;
use crate::text::{lower, slashed, words};
use crate::wavelength_unit::WavelengthUnit;

/// Quantity on the x axis, as a header may name it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum XUnit {
    Wavelength(WavelengthUnit),
    /// Something that is not converted, such as photon energies.
    Other,
}

/// The first unit of length, of wave number or of frequency in a piece of text.
pub(crate) fn x_unit(text: &str) -> Option<XUnit> {
    let text = bracketed(lower(text)).replace('⁻', "-").replace('¹', "1");
    if let Some(unit) = bracketed_letter(&text) {
        return Some(unit);
    }
    let energies = text.contains("energ") || words(&text).count() == 1;
    let unit = words(&text).find_map(|word| match word {
        "ev" | "kev" | "mev" if energies => Some(XUnit::Other),
        "hz" | "ghz" | "phz" | "1/nm" | "1/m" | "m-1" => Some(XUnit::Other),
        _ => WavelengthUnit::from_symbol(word).map(XUnit::Wavelength),
    });
    let wave_numbers = text.contains("wavenumber") || text.contains("wave number");
    unit.or_else(|| wave_numbers.then_some(XUnit::Wavelength(WavelengthUnit::Wavenumber)))
}

/// Words for wavelengths and what stands for them.
const NAMES: [&str; 11] =
    ["wavelength", "wavelengths", "wave", "wl", "lambda", "λ", "wavenumber", "wave number", "frequency", "freq", "ν"];

/// As other languages call them.
const CALLED: [&str; 7] =
    ["wellenl", "longueur d", "longitud de onda", "lunghezza d", "comprimento de onda", "波長", "波长"];

/// A header in lower case with its unit in brackets, if it stands behind a slash: `frequency (thz)` of `frequency/thz`.
fn bracketed(lower: String) -> String {
    match slashed(&lower) {
        Some((name, unit)) if NAMES.contains(&name) || CALLED.iter().any(|start| name.starts_with(start)) => {
            format!("{name} ({})", unit.trim_matches(['(', ')']))
        }
        _ => lower,
    }
}

/// A unit of one letter, or a multiple of one, in brackets right after the word for wavelengths: `Wavelength (A)`, `wave(m)`,
/// `Wavenumber (10^3 cm-1)`.
fn bracketed_letter(lower: &str) -> Option<XUnit> {
    let (name, rest) = lower.split_once(['(', '['])?;
    let unit = rest[..rest.find([')', ']'])?].trim();
    let name = name.trim_matches(|c: char| !c.is_alphanumeric());
    if !NAMES.contains(&name) && !CALLED.iter().any(|start| name.starts_with(start)) {
        return None;
    }
    let multiple = ["10^3", "10^4", "10³", "1000", "k"].iter().any(|start| unit.starts_with(start));
    match unit {
        "a" => Some(XUnit::Wavelength(WavelengthUnit::Angstrom)),
        "m" | "meter" | "meters" | "metre" | "metres" => Some(XUnit::Other),
        _ if multiple && unit.contains("cm") => Some(XUnit::Other),
        _ => None,
    }
}

/// Medium of the wavelengths that a text names: air or vacuum.
pub(crate) fn medium(text: &str) -> Option<Medium> {
    let text = lower(text);
    if text.contains("nm_air") || text.contains("nm (air)") {
        Some(Medium::Air)
    } else if text.contains("nm_vac") || text.contains("nm (vac") {
        Some(Medium::Vacuum)
    } else {
        None
    }
}

/// The unit that a line of free text gives for wavelengths: the first unit after the word.
pub(crate) fn x_unit_in_prose(text: &str) -> Option<XUnit> {
    let text = lower(text);
    let start = ["wavelength", "wavenumber", "wave number", "x unit", "xunit", "x axis", "xaxis"]
        .iter()
        .find_map(|word| text.find(word))?;
    x_unit(&text[start..])
}

/// A name in lower case without the argument of a function of wavelength: `S(λ)` and `V(lambda)` are values.
fn without_argument(lower: &str) -> String {
    const ARGUMENTS: [&str; 3] = ["(λ)", "(lambda)", "(wavelength)"];
    let mut text = lower.to_owned();
    for argument in ARGUMENTS {
        if let Some(at) = text.find(argument)
            && !text[..at].trim().is_empty()
        {
            text = text.replace(argument, "");
        }
    }
    text
}

/// Returns whether a column's header is about wavelengths before all: it begins or ends with their name, units aside.
pub(crate) fn begins_with_wavelengths(text: &str) -> bool {
    const NAMES: [&str; 6] = ["wavelength", "wavelengths", "wl", "λ", "lambda", "wavenumber"];
    let text = without_argument(&lower(text));
    let mut words = words(&text).filter(|word| WavelengthUnit::from_symbol(word).is_none());
    let first = words.next();
    let last = words.last().or(first);
    first.is_some_and(|word| NAMES.contains(&word)) || last.is_some_and(|word| NAMES.contains(&word))
}

/// Returns whether a column's header names wavelengths, wave numbers or frequencies of light.
pub(crate) fn names_wavelengths(text: &str) -> bool {
    // As their unit alone does.
    const UNITS: [&str; 10] = ["[nm]", "(nm)", "[µm]", "(µm)", "[μm]", "(μm)", "[um]", "(um)", "[cm-1]", "(cm-1)"];
    let text = without_argument(&bracketed(lower(text)));
    if CALLED.iter().chain(&UNITS).any(|part| text.contains(part)) {
        return true;
    }
    // As an index, such as in `E_λ`, it names no wavelengths.
    let symbol = |symbol| {
        text.match_indices(symbol).any(|(at, _)| !text[..at].ends_with(|c: char| c.is_alphanumeric() || c == '_'))
    };
    text.contains("wavelength")
        || text.contains("wavenumber")
        || text.contains("wave number")
        || (text.contains("frequency") && words(&text).any(|word| word == "thz"))
        || symbol("lambda")
        || symbol("λ")
        || words(&text)
            .next()
            .is_some_and(|word| matches!(word, "wave" | "wl" | "nm" | "um" | "µm" | "μm" | "cm-1" | "1/cm" | "thz"))
}

/// Returns whether a column's header names times and nothing else, such as `Time (s)` or `Integration time [ms]`.
pub(crate) fn names_time(text: &str) -> bool {
    const TIMES: [&str; 6] = ["time", "timestamp", "date", "datetime", "date/time", "zeit"];
    const BESIDE: [&str; 17] = [
        "s",
        "sec",
        "seconds",
        "ms",
        "us",
        "µs",
        "min",
        "h",
        "hours",
        "utc",
        "local",
        "stamp",
        "integration",
        "exposure",
        "acquisition",
        "elapsed",
        "measurement",
    ];
    let text = lower(text);
    words(&text).any(|word| TIMES.contains(&word))
        && words(&text).all(|word| TIMES.contains(&word) || BESIDE.contains(&word))
}

/// Index of the column header that names the wavelengths: those in nanometers before those in other units.
pub(crate) fn axis(names: &[String]) -> Option<usize> {
    let rank = |name: &str| match x_unit(name) {
        Some(XUnit::Wavelength(WavelengthUnit::Nanometer)) => 0,
        Some(XUnit::Wavelength(WavelengthUnit::Micrometer | WavelengthUnit::Angstrom)) => 1,
        None => 2,
        Some(_) => 3,
    };
    let named = names.iter().enumerate().filter(|(_, name)| names_wavelengths(name));
    named.min_by_key(|(_, name)| rank(name)).map(|(column, _)| column)
}
