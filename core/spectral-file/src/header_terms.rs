//! Units, quantities and roles in the words of a header.

mod axis;

pub(super) use axis::*;

use crate::role::{Quantity, Role, Values};
use crate::text::{begins, lower, spaced, words};
use crate::unit_text::percent_sign;

/// Quantity of curves that state none, in the heads of the program's own tables.
pub(super) const UNSPECIFIED: &str = "unspecified quantity";

/// Returns whether a column's header names a scale of the spectrum, which is no curve: wavelengths, wave numbers, energies of photons.
pub(super) fn names_axis(text: &str) -> bool {
    let energies = x_unit(text) == Some(XUnit::Other);
    // A unit of values may hold one of wavelengths, such as `W/(cm-1)`.
    let of_values = quantity(text).is_some() || role(text).is_some() || crate::unit_text::unit(text).is_some();
    (names_wavelengths(text) || energies) && !of_values
}

/// Returns whether a header says percent.
pub(super) fn says_percent(text: &str) -> bool {
    let text = lower(text);
    percent_sign(&text).is_some()
        || upper_end(&text) == Some(100)
        || words(&text).any(|word| matches!(word, "percent" | "pct" | "percentage"))
}

/// Returns whether a header says that values are fractions of one.
pub(super) fn says_fraction(text: &str) -> bool {
    let text = lower(text);
    upper_end(&text) == Some(1) || words(&text).any(|word| matches!(word, "fraction" | "0-1" | "1"))
}

/// The upper end of the range of values that a header gives from 0: `(0-100)`, `[0, 1]`, `(range 0 to 100)`. Only what stands in
/// brackets is one: `soil 0-100 cm` is a name.
fn upper_end(lower: &str) -> Option<u32> {
    lower.match_indices(['(', '[']).find_map(|(at, _)| {
        let inner = &lower[at + 1..];
        let inner = inner[..inner.find([')', ']'])?].trim().trim_start_matches(|c: char| c.is_alphabetic() || c == ' ');
        let inner = inner.trim_end_matches(['%', ' ']);
        let (from, to) =
            ["to", "..", "…", "–", "—", "−", "-", ",", ";"].iter().find_map(|sign| inner.split_once(sign))?;
        let number = |text: &str| text.trim().parse::<f64>().ok();
        match (number(from)?, number(to)?) {
            (0.0, 1.0) => Some(1),
            (0.0, 100.0) => Some(100),
            _ => None,
        }
    })
}

/// Letter of the quantity whose inverse a decadic logarithm in a header takes: `log(1/R)`, `-log10 T`.
fn inverse_log(lower: &str) -> Option<char> {
    const STARTS: [&str; 10] =
        ["log(1/", "log10(1/", "log1/", "log101/", "lg(1/", "lg1/", "-log(", "-log10(", "-log10", "-log"];
    if !lower.contains("log") && !lower.contains("lg") {
        return None;
    }
    let bare: String = lower.chars().filter(|c| !c.is_whitespace() && !matches!(c, '_' | '₁' | '₀')).collect();
    STARTS.iter().find_map(|start| {
        let rest = &bare[bare.find(start)? + start.len()..];
        let mut letters = rest.chars();
        let letter = letters.next().filter(|c| matches!(c, 'r' | 't'))?;
        let alone = !letters.next().is_some_and(char::is_alphabetic);
        let spelled = ["refl", "trans"].iter().any(|word| rest.starts_with(word));
        (alone || spelled).then_some(letter)
    })
}

/// The letter that a sign of percent goes with: `%R`, `%T leaf`, `R (%)`.
fn percent_letter(lower: &str) -> Option<char> {
    let bare: String = lower.chars().filter(|c| !matches!(c, ' ' | '(' | ')' | '[' | ']')).collect();
    match &*bare {
        "r%" => return Some('r'),
        "t%" => return Some('t'),
        _ => {}
    }
    lower.match_indices('%').find_map(|(at, _)| {
        let mut after = lower[at + 1..].chars();
        let letter = after.next().filter(|c| matches!(c, 'r' | 't'))?;
        (!after.next().is_some_and(char::is_alphanumeric)).then_some(letter)
    })
}

/// Returns whether a header says decadic absorbance. `Abs. irradiance` is absolute.
fn says_absorbance(lower: &str) -> bool {
    const OTHERS: [&str; 7] = ["radian", "power", "flux", "energ", "reflect", "transmi", "sensiti"];
    let short = || {
        let name = crate::unit_text::without_unit(lower);
        matches!(name, "abs" | "abs." | "od" | "o.d." | "a.u. (abs)")
            || lower.ends_with("(od)")
            || lower.ends_with("[od]")
    };
    let abs = || words(lower).any(|word| word == "abs") && !OTHERS.iter().any(|other| lower.contains(other));
    let culture = |word: &str| {
        word.strip_prefix("od").is_some_and(|nm| nm.len() == 3 && nm.bytes().all(|digit| digit.is_ascii_digit()))
    };
    begins(lower, "absorban|optical density")
        || lower.trim() == "extinktion"
        || matches!(lower.trim(), "a (au)" | "a [au]" | "a(au)")
        || words(lower).any(culture)
        || inverse_log(lower).is_some()
        || ((short() || abs()) && !says_percent(lower))
}

/// Scale in a header that is not converted, with its remedy.
pub(super) fn not_converted(text: &str) -> Option<&'static str> {
    let text = lower(text);
    let word = |wanted: &[&str]| words(&text).any(|word| wanted.contains(&word));
    if word(&["mau", "mabs", "milliabsorbance"]) || text.contains("(mod)") || text.contains("[mod]") {
        Some("mAU, thousandths of absorbances, are not converted: divide them by 1000 first")
    } else if word(&["db"]) && ["attenuation", "loss", "dämpfung"].iter().any(|part| text.contains(part)) {
        Some("losses in dB are not converted: negate them first")
    } else {
        None
    }
}

/// Returns whether a line of prose says that values are absorbances, and names no other quantity.
pub(super) fn mentions_absorbance(text: &str) -> bool {
    const MOST_WORDS: usize = 15;
    let short = lower(text);
    begins(&short, "absorban|extinktion|optical density")
        && words(&short).count() <= MOST_WORDS
        && quantity(text).is_none()
        && !says_percent(text)
        && not_converted(text).is_none()
}

/// Returns whether a header names light on a scale of its own: `Relative power`, `Intensity (a.u.)`, `mW`.
pub(super) fn names_light_scale(text: &str) -> bool {
    const WORDS: [&str; 10] = ["power", "intensity", "emission", "energy", "luminance", "mw", "µw", "uw", "nw", "w"];
    let text = lower(text);
    text.trim() == "a.u." || words(&text).any(|word| WORDS.contains(&word) || word.starts_with("erg/"))
}

/// Returns whether a header ends in the word for power: `Relative power`.
pub(super) fn is_power(text: &str) -> bool {
    words(&lower(crate::unit_text::without_unit(text))).last() == Some("power")
}

/// Returns whether a header names a response, which is neither a light nor a fraction of one.
pub(super) fn names_response(text: &str) -> bool {
    words(&lower(text)).any(|word| matches!(word, "response" | "responses" | "quantum"))
}

/// Returns whether the unit of a header is AU, which is of absorbance or arbitrary.
pub(super) fn says_au(text: &str) -> bool {
    let text = lower(text);
    text.ends_with("(au)") || text.ends_with("[au]")
}

/// Scale of the values that a header gives.
pub(super) fn values(text: &str) -> Option<Values> {
    let short = lower(text);
    if not_converted(text).is_some() {
        None
    } else if says_absorbance(&short) {
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

/// Returns whether a header says that values are what a detector counted.
pub(super) fn says_counts(text: &str) -> bool {
    words(&lower(text)).any(|word| matches!(word, "count" | "counts" | "adc" | "dn"))
}

/// How names of quantities begin, in English, German, French, Spanish, Italian, Portuguese, Japanese and Chinese.
const SENSITIVITIES: &str = "sensitivit|photosensitiv|responsiv|color match|colour match|color-match|colour-match|cone fund|\
    empfindlichkeit|sensibilit|sensibilid|感度|luminous efficien|tristimulus val|action spectr";
const REFLECTANCES: &str =
    "reflect|reflekt|reflexi|refletâ|réflect|réflexi|riflett|rifless|remission|r-factor|反射率|反射比";
const TRANSMITTANCES: &str = "transmit|transmiss|trasmitt|trasmiss|t-factor|透過率|透射";
const IRRADIANCES: &str = "irradian|irradiân|irraggiam|exitance|bestrahlungsst|éclairement énerg|放射照度";
const RADIANCES: &str = "radianc|radianz|radiânc|strahldichte|luminance énerg|放射輝度";

/// The physical quantity that a header names, in whole words.
pub(super) fn quantity(text: &str) -> Option<Quantity> {
    let text = spaced(text);
    let any = |parts: &str| begins(&text, parts);
    let word = |wanted: &[&str]| words(&text).any(|word| wanted.contains(&word));
    // Light that something reflects or transmits is light.
    let passed = any("reflected|transmitted") && any("radian|irradian|spectral flux|power");
    let letter = percent_letter(&text).or_else(|| inverse_log(&text));
    let found = if text.trim() == UNSPECIFIED || any("chromaticity coord") {
        Quantity::Unknown
    } else if any("quantum eff") || word(&["qe"]) {
        Quantity::QuantumEfficiency
    } else if any(SENSITIVITIES) {
        Quantity::Sensitivity
    } else if any("absorptan") {
        Quantity::Absorptance
    } else if any("ln(1/|ln 1/|-ln(") {
        // A natural logarithm, which is not converted.
        Quantity::Unknown
    } else if !passed && (any(REFLECTANCES) || word(&["rfr", "rpc", "rfl"]) || letter == Some('r')) {
        Quantity::Reflectance
    } else if !passed && (any(TRANSMITTANCES) || word(&["tfr", "tpc"]) || letter == Some('t')) {
        Quantity::Transmittance
    } else if any(IRRADIANCES) || word(&["irrad"]) {
        Quantity::Irradiance
    } else if any(RADIANCES) {
        Quantity::Radiance
    } else if any("radiant intensity") {
        Quantity::RadiantIntensity
    } else if any("radiant flux|spectral flux") {
        Quantity::RadiantFlux
    } else if any("spectral power|spectral distribution") || word(&["spd", "emission", "emissions"]) {
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

/// Role that a header gives to the values.
pub(super) fn role(text: &str) -> Option<Role> {
    let light = || {
        let text = lower(text);
        let word = || words(&text).any(|word| matches!(word, "lux" | "cct"));
        begins(&text, "radianc|radiant flux|radiant power|radiant energ|irradian|illuminan|light source") || word()
    };
    match quantity(text) {
        Some(Quantity::Counts | Quantity::Relative) | None => light().then_some(Role::Illuminant),
        Some(Quantity::Unknown) => Some(Role::Unknown),
        Some(quantity) => quantity.role(),
    }
}

/// Role that a line of prose gives to the values. `Illuminant: D65` is a condition of colors, as `Observer: 2°` is.
pub(super) fn role_in_prose(text: &str) -> Option<Role> {
    let key = text.split([':', ',', ';', '=', '\t']).next().unwrap_or_default();
    let condition = key.len() < text.len() && matches!(lower(key.trim()).as_str(), "illuminant" | "illuminants");
    // A luminance is measured of lights.
    let light = key.len() < text.len() && lower(key.trim()) == "luminance";
    if light { Some(Role::Illuminant) } else { role(text).filter(|_| !condition) }
}

/// Returns whether a name is that of a standard illuminant: `D65`, `FL2`, `Illuminant A`. `A`, `E` and `F2` alone are fields of charts too.
pub(super) fn names_illuminant(name: &str) -> bool {
    let name = lower(name);
    let mut told = false;
    let mut rest = words(&name).filter(|word| {
        let about =
            matches!(*word, "cie" | "iso" | "standard" | "std" | "illuminant" | "ill" | "illum" | "light" | "series");
        told |= about;
        !about
    });
    let (Some(first), None) = (rest.next(), rest.next()) else { return false };
    let number = |text: &str, most: u32| text.parse::<u32>().is_ok_and(|number| (1..=most).contains(&number));
    matches!(first, "d50" | "d55" | "d60" | "d65" | "d75" | "d93" | "id50" | "id65" | "iso7589")
        || first.strip_prefix("fl").is_some_and(|rest| number(rest, 12))
        || ["led-b", "led-rgb", "led-v"]
            .iter()
            .any(|start| first.strip_prefix(start).is_some_and(|rest| number(rest, 5)))
        || (told
            && (matches!(first, "a" | "b" | "c" | "e") || first.strip_prefix('f').is_some_and(|rest| number(rest, 12))))
}

/// Kind of a light in a name; only good for a guess.
pub(super) fn names_lamp(name: &str) -> bool {
    const LAMPS: [&str; 12] = [
        "lamp",
        "lamps",
        "led",
        "leds",
        "halogen",
        "xenon",
        "daylight",
        "sunlight",
        "skylight",
        "tungsten",
        "lightbulb",
        "luminaire",
    ];
    words(&lower(name)).any(|word| LAMPS.contains(&word))
}

/// Role of bands named by a letter: `R400`, `T_380`.
pub(super) fn role_of_bands(prefix: &str) -> Option<Role> {
    let prefix = lower(prefix);
    match prefix.trim_matches(|c: char| !c.is_alphanumeric()) {
        "r" | "refl" | "rfl" => Some(Role::Reflectance),
        "t" | "trans" => Some(Role::Transmittance),
        _ => role(&prefix),
    }
}

/// Returns whether a text is the word for what is measured and nothing else.
pub(super) fn is_quantity(text: &str) -> bool {
    let word = !text.trim().contains(|c: char| !c.is_alphabetic());
    word && (quantity(text).is_some() || matches!(lower(text).as_str(), "value" | "values" | "intensity" | "signal"))
}

/// Returns whether a column's header names what only counts its rows.
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

/// Returns whether a column's header names what tells rows apart and nothing else: samples, channels, scans, flags.
pub(super) fn is_label(name: &str) -> bool {
    const LABELS: [&str; 13] = [
        "sample_id",
        "sample id",
        "sampleid",
        "id",
        "flag",
        "quality",
        "channel",
        "scan",
        "band",
        "n",
        "no",
        "no.",
        "#",
    ];
    LABELS.contains(&lower(name).trim())
}

/// Returns whether the name of bands says how specular reflection was treated: included (SCI) or excluded (SCE).
pub(super) fn says_specular(text: &str) -> bool {
    words(&lower(text)).any(|word| matches!(word, "sci" | "sce" | "spin" | "spex"))
}

/// Channel of a camera, by the form of its name.
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
        let colors = ["red", "green", "blue", "rot", "grün", "blau", "rouge", "vert", "bleu"];
        letter.or_else(|| position(part, &colors).map(|i| Channel::Word(i % 3)))
    })
}
