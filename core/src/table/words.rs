//! What the words of a header say about units and quantities.

use super::quantity::Quantity;
use super::reading::Medium;
use super::scale::{Role, Values};
use super::wavelengths::WavelengthUnit;

/// Longer header lines are prose, or hostile.
const LONGEST: usize = 2000;

/// What stands on the x axis, as a header may name it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum XUnit {
    Wavelength(WavelengthUnit),
    /// Something that is not converted, such as photon energies.
    Other,
}

/// Lower case, without what no header needs; empty if the text is too long to be a header.
fn lower(text: &str) -> String {
    if text.len() > LONGEST { String::new() } else { text.to_lowercase() }
}

fn words(lower: &str) -> impl Iterator<Item = &str> {
    lower.split(|c: char| !c.is_alphanumeric() && c != '-' && c != '^' && c != '/').filter(|word| !word.is_empty())
}

/// The first unit of length, of wave number or of frequency in a piece of text.
pub(super) fn x_unit(text: &str) -> Option<XUnit> {
    let text = lower(text).replace('⁻', "-").replace('¹', "1");
    let energies = text.contains("energ") || words(&text).count() == 1;
    let unit = words(&text).find_map(|word| match word {
        "ev" | "kev" | "mev" if energies => Some(XUnit::Other),
        "hz" | "ghz" | "phz" | "1/nm" | "1/m" | "m-1" => Some(XUnit::Other),
        _ => WavelengthUnit::from_symbol(word).map(XUnit::Wavelength),
    });
    let wave_numbers = text.contains("wavenumber") || text.contains("wave number");
    unit.or_else(|| wave_numbers.then_some(XUnit::Wavelength(WavelengthUnit::Wavenumber)))
}

/// Whether a text says that wavelengths are those in air or in vacuum.
pub(super) fn medium(text: &str) -> Option<Medium> {
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
pub(super) fn x_unit_in_prose(text: &str) -> Option<XUnit> {
    let text = lower(text);
    let start = ["wavelength", "wavenumber", "wave number", "x unit", "xunit", "x axis", "xaxis"]
        .iter()
        .find_map(|word| text.find(word))?;
    x_unit(&text[start..])
}

/// Whether a column's header names wavelengths, wave numbers or frequencies of light.
pub(super) fn names_wavelengths(text: &str) -> bool {
    // As other languages call them, and as their unit alone does.
    const CALLED: [&str; 7] =
        ["wellenl", "longueur d", "longitud de onda", "lunghezza d", "comprimento de onda", "波長", "波长"];
    const UNITS: [&str; 10] = ["[nm]", "(nm)", "[µm]", "(µm)", "[μm]", "(μm)", "[um]", "(um)", "[cm-1]", "(cm-1)"];
    let text = lower(text);
    if CALLED.iter().chain(&UNITS).any(|part| text.contains(part)) {
        return true;
    }
    text.contains("wavelength")
        || text.contains("wavenumber")
        || text.contains("wave number")
        || (text.contains("frequency") && words(&text).any(|word| word == "thz"))
        || text.contains("lambda")
        || text.contains('λ')
        || words(&text)
            .next()
            .is_some_and(|word| matches!(word, "wave" | "wl" | "nm" | "um" | "µm" | "μm" | "cm-1" | "1/cm" | "thz"))
}

/// Whether a column's header names a scale of the spectrum, which is no curve: wavelengths, wave numbers, energies of photons.
pub(super) fn names_axis(text: &str) -> bool {
    let energies = x_unit(text) == Some(XUnit::Other);
    // A unit of values may hold one of wavelengths, such as `W/(cm-1)`.
    let of_values = quantity(text).is_some() || role(text).is_some() || super::quantity::unit(text).is_some();
    (names_wavelengths(text) || energies) && !of_values
}

/// Whether a column's header names times and nothing else, such as `Time (s)` or `Integration time [ms]`.
pub(super) fn names_time(text: &str) -> bool {
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

/// Which of several column headers names the wavelengths: those in nanometers before those in other units.
pub(super) fn axis(names: &[String]) -> Option<usize> {
    let rank = |name: &str| match x_unit(name) {
        Some(XUnit::Wavelength(WavelengthUnit::Nanometer)) => 0,
        Some(XUnit::Wavelength(WavelengthUnit::Micrometer | WavelengthUnit::Angstrom)) => 1,
        None => 2,
        Some(_) => 3,
    };
    let named = names.iter().enumerate().filter(|(_, name)| names_wavelengths(name));
    named.min_by_key(|(_, name)| rank(name)).map(|(column, _)| column)
}

/// Whether a header says percent.
pub(super) fn says_percent(text: &str) -> bool {
    let text = lower(text);
    // `50% gray` is a name: only a sign that follows no figure is a unit.
    let sign = text.match_indices('%').any(|(at, _)| !text[..at].trim_end().ends_with(|c: char| c.is_ascii_digit()));
    sign || words(&text).any(|word| matches!(word, "percent" | "pct" | "percentage"))
}

/// Whether a header says that values are fractions of one.
pub(super) fn says_fraction(text: &str) -> bool {
    let text = lower(text);
    words(&text).any(|word| matches!(word, "fraction" | "0-1" | "1"))
}

/// What a header says that the values stand for.
pub(super) fn values(text: &str) -> Option<Values> {
    let short = lower(text);
    if short.contains("absorban") || short.contains("optical density") {
        Some(Values::Absorbance)
    } else if words(&short).any(|word| matches!(word, "dbm" | "db")) {
        Some(Values::Decibels)
    } else if says_percent(text) {
        Some(Values::Percent)
    } else if says_fraction(text) {
        Some(Values::Plain)
    } else {
        None
    }
}

/// Whether a header says that values are what a detector counted.
pub(super) fn says_counts(text: &str) -> bool {
    words(&lower(text)).any(|word| matches!(word, "count" | "counts" | "adc" | "dn"))
}

/// The physical quantity that a header names.
pub(super) fn quantity(text: &str) -> Option<Quantity> {
    let text = lower(text);
    let any = |parts: &[&str]| parts.iter().any(|part| text.contains(part));
    let word = |wanted: &[&str]| words(&text).any(|word| wanted.contains(&word));
    let found = if any(&["quantum eff"]) || word(&["qe"]) {
        Quantity::QuantumEfficiency
    } else if any(&["sensitiv", "responsiv", "color match", "colour match", "color-match", "cone fund"]) {
        Quantity::Sensitivity
    } else if any(&["absorptan"]) {
        Quantity::Absorptance
    } else if any(&["reflect", "r-factor", "反射率"]) {
        Quantity::Reflectance
    } else if any(&["transmit", "transmiss", "t-factor", "透過率"]) {
        Quantity::Transmittance
    } else if any(&["irradian", "exitance"]) {
        Quantity::Irradiance
    } else if any(&["radiance"]) {
        Quantity::Radiance
    } else if any(&["radiant intensity"]) {
        Quantity::RadiantIntensity
    } else if any(&["radiant flux", "spectral flux"]) {
        Quantity::RadiantFlux
    } else if any(&["spectral power", "emission"]) || word(&["spd"]) {
        Quantity::SpectralPower
    } else if says_counts(&text) {
        Quantity::Counts
    } else if word(&["relative"]) {
        Quantity::Relative
    } else {
        return None;
    };
    Some(found)
}

/// What a header says the values are.
pub(super) fn role(text: &str) -> Option<Role> {
    let text = lower(text);
    let any = |parts: &[&str]| parts.iter().any(|part| text.contains(part));
    let word = |wanted: &str| words(&text).any(|word| word == wanted);
    if any(&["absorptan"]) {
        Some(Role::Unknown)
    } else if word("qe")
        || any(&["sensitiv", "responsiv", "quantum eff", "color match", "colour match", "color-match", "cone fund"])
    {
        Some(Role::Camera)
    } else if any(&["reflect", "r-factor", "反射率"]) {
        Some(Role::Reflectance)
    } else if any(&["transmit", "transmiss", "t-factor", "透過率"]) {
        Some(Role::Transmittance)
    } else if any(&["radian", "illuminan", "spectral power", "emission", "light source"])
        || words(&text).any(|word| matches!(word, "lux" | "cct" | "spd"))
    {
        Some(Role::Illuminant)
    } else {
        None
    }
}

/// Whether a text is the word for what is measured and nothing else.
pub(super) fn is_quantity(text: &str) -> bool {
    let word = !text.trim().contains(|c: char| !c.is_alphabetic());
    word && (quantity(text).is_some() || matches!(lower(text).as_str(), "value" | "values" | "intensity" | "signal"))
}

/// Whether a column's header names what only counts its rows.
pub(super) fn is_count(name: &str) -> bool {
    let name = lower(name);
    let mut words = words(&name);
    name == "#"
        || words.next().is_some_and(|word| {
            matches!(
                word,
                "pixel" | "pixels" | "px" | "index" | "no" | "nr" | "number" | "row" | "line" | "id" | "n" | "i"
            )
        })
}

/// Whether the name of bands says how specular reflection was treated: included (SCI) or excluded (SCE).
pub(super) fn says_specular(text: &str) -> bool {
    words(&lower(text)).any(|word| matches!(word, "sci" | "sce" | "spin" | "spex"))
}

/// How a name points to a channel of a camera.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Channel {
    /// By a letter alone, `R`.
    Letter(usize),
    /// By a word, `red`, which can also be the color of a thing, or by a part of the name.
    Word(usize),
}

/// The channel (0, 1, 2) that a name stands for.
pub(super) fn channel(name: &str) -> Option<Channel> {
    let name = lower(name);
    let position = |word: &str, list: &[&str]| list.iter().position(|entry| *entry == word);
    let parts = || name.split(|c: char| !c.is_alphanumeric()).filter(|part| !part.is_empty());
    let alone = parts().count() == 1;
    let kind = if alone { Channel::Letter } else { Channel::Word };
    parts().find_map(|part| {
        let letters = ["r", "g", "b", "x", "y", "z", "l", "m", "s", "xbar", "ybar", "zbar", "rbar", "gbar", "bbar"];
        let letter = position(part, &letters).map(|i| kind(i % 3));
        letter.or_else(|| position(part, &["red", "green", "blue"]).map(Channel::Word))
    })
}
