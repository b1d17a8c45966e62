//! Units, quantities and roles in the words of a header.

use crate::decision::{Medium, Quantity, Role, Values, WavelengthUnit};
use crate::text::{begins, has_part, has_word, is_one, lower, slashed, spaced, words};
use crate::unit_text::percent_sign;
use crate::units;

/// Quantity of curves that state none, in the heads of the program's own tables.
pub(super) const UNSPECIFIED: &str = "unspecified quantity";

/// Returns whether a column's header names a scale of the spectrum, which is no curve: wavelengths, wave numbers, energies of photons.
pub(super) fn names_axis(text: &str) -> bool {
    let energies = x_unit(text) == Some(XUnit::Other);
    // A unit of values may hold one of wavelengths, such as `W/(cm-1)`.
    let of_values = || quantity(text).is_some() || role(text).is_some() || crate::unit_text::unit(text).is_some();
    (names_wavelengths(text) || energies) && (!of_values() || ends_with_wavelengths(text))
}

/// Returns whether text is a sign of YAML or a rule, and no name.
pub(super) fn is_sign(text: &str) -> bool {
    text.bytes().all(|byte| b"|>-_=:".contains(&byte))
}

/// Returns whether a name is only `x`, or `x1`, `x_2`.
pub(super) fn is_x(name: &str) -> bool {
    let rest = name.strip_prefix(['x', 'X']);
    rest.is_some_and(|rest| rest.trim_start_matches('_').bytes().all(|byte| byte.is_ascii_digit()))
}

/// Returns whether a name is that of wavelengths with one word before it at most, units aside: those at which light is emitted.
pub(super) fn ends_with_wavelengths(text: &str) -> bool {
    let lower = lower(text);
    let named: Vec<&str> = words(&lower).filter(|word| WavelengthUnit::from_symbol(word).is_none()).collect();
    named.len() < 3 && named.last().is_some_and(|word| is_one(word, "wavelength|wavelengths|wavenumber"))
}

pub(super) fn says_percent(text: &str) -> bool {
    let text = lower(text);
    percent_sign(&text).is_some() || upper_end(&text) == Some(100) || has_word(&text, "percent|pct|percentage")
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
    const OTHERS: &str = "radian|power|flux|energ|reflect|transmi|sensiti";
    let short = || {
        let name = crate::unit_text::without_unit(lower);
        is_one(name, "abs|abs.|od|o.d.|a.u. (abs)") || lower.ends_with("(od)") || lower.ends_with("[od]")
    };
    let abs = || has_word(lower, "abs") && !has_part(lower, OTHERS) && !begins(lower, "length|depth|coef");
    let culture = |word: &str| {
        word.strip_prefix("od").is_some_and(|nm| nm.len() == 3 && nm.bytes().all(|digit| digit.is_ascii_digit()))
    };
    begins(lower, "absorban|optical density")
        || is_one(lower.trim(), "extinktion|a (au)|a [au]|a(au)")
        || words(lower).any(culture)
        || inverse_log(lower).is_some()
        || ((short() || abs()) && !says_percent(lower))
}

/// Returns whether a name is that of the logarithm of a quantity or of a channel, and of no absorbance.
fn names_logarithm(lower: &str) -> bool {
    const OF: &str =
        "sensitiv|respons|irradian|radian|power|intensity|flux|reflec|transmi|emission|(r)|(g)|(b)|(l)|(m)|(s)";
    begins(lower, "log |log10|log(|lg(|log-") && has_part(lower, OF) && !says_absorbance(lower)
}

/// Reason why what a header names is read as none of the roles, with its remedy.
pub(super) fn not_converted(text: &str) -> Option<&'static str> {
    let text = lower(text).replace('_', " ");
    let has = |part: &str| has_part(&text, part);
    let word = |words: &str| has_word(&text, words);
    match () {
        () if word("mau|mabs|milliabsorbance") || has("(mod)|[mod]") => {
            Some("mAU, thousandths of absorbances, are not converted: divide them by 1000 first")
        }
        () if word("db") && has("attenuation|loss|dämpfung") => {
            Some("losses in dB are not converted: negate them first")
        }
        () if has("internal transm|transmittance internal|reintransm|transmittance interne") => Some(
            "Internal transmittances lack the reflections at the surfaces: multiply them by the factor of these first",
        ),
        () if has("diffraction|grating") && has("efficienc") => {
            Some("The efficiency of a grating is that of no camera: it is one factor of an instrument")
        }
        // With a value behind it, it is a setting.
        () if has("correction curve") && !text.contains([':', '=', '\t']) => {
            Some("A correction is a factor of an instrument's values, and none of the spectra read here")
        }
        () if begins(&text, "emissivit|thermal emission") => {
            Some("An emissivity is neither a reflectance nor a transmittance")
        }
        () if word("fwhm|bandwidths") && has("wavelength") && !text.contains([',', ';', '\t']) => {
            Some("The widths of bands are no spectrum")
        }
        () if names_logarithm(&text) => Some("Logarithms are not converted: raise ten to their power first"),
        () => None,
    }
}

/// Returns whether words name a property of a material that is none of the quantities read.
pub(super) fn names_material(text: &str) -> bool {
    has_part(&lower(text), "absorption|scatter|refractive|extinction|attenuation")
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
    const WORDS: &str = "power|intensity|intensities|emission|energy|luminance";
    const UNITS: &str = "mw|µw|uw|nw|w";
    let text = lower(text).replace(" / ", "/");
    // `G_W_1` is a name.
    let unit = text.trim_end_matches([')', ']']).rsplit(['(', '[', ',']).next().unwrap_or_default();
    text.trim() == "a.u."
        || has_word(&text, WORDS)
        || is_one(unit.trim(), UNITS)
        || words(&text).any(|word| word.starts_with("erg/"))
}

pub(super) fn is_power(text: &str) -> bool {
    words(&lower(crate::unit_text::without_unit(text))).last() == Some("power")
}

/// Returns whether a header names a response, which is neither a light nor a fraction of one.
pub(super) fn names_response(text: &str) -> bool {
    has_word(&lower(text).replace('_', " "), "response|responses|quantum|rsr")
}

/// Returns whether the unit of a header is AU, which is of absorbance or arbitrary.
pub(super) fn says_au(text: &str) -> bool {
    let text = lower(text);
    text.ends_with("(au)") || text.ends_with("[au]")
}

pub(super) fn values(text: &str) -> Option<Values> {
    let short = lower(text);
    if not_converted(text).is_some() {
        None
    } else if says_absorbance(&short) {
        Some(Values::Absorbance)
    } else if has_word(&short, "dbm|db") {
        Some(Values::Decibels)
    } else if says_percent(text) {
        Some(Values::Percent)
    } else if upper_end(&short) == Some(1) || has_word(&short, "fraction|0-1|1") {
        Some(Values::Plain)
    } else {
        None
    }
}

pub(super) fn says_counts(text: &str) -> bool {
    has_word(&lower(text), COUNTS)
}

const COUNTS: &str = "count|counts|adc|dn";

/// Quantities by the beginnings of their names, in English, German, French, Spanish, Italian, Portuguese, Japanese and Chinese, and
/// by whole words. The first that is named counts.
const QUANTITIES: [(Quantity, &str, &str); 14] = [
    (Quantity::Unknown, "chromaticity coord", ""),
    (Quantity::QuantumEfficiency, "quantum eff", "qe|eqe|iqe"),
    (
        Quantity::Sensitivity,
        "sensitivit|photosensitiv|responsiv|color match|colour match|color-match|colour-match|cone fund|empfindlichkeit|\
         sensibilit|sensibilid|感度|luminous efficien|tristimulus val|action spectr|x bar|y bar|z bar|xbar|ybar|zbar",
        "",
    ),
    (Quantity::Absorptance, "absorptan", ""),
    // A natural logarithm, which is not converted.
    (Quantity::Unknown, "ln(1/|ln 1/|-ln(", ""),
    (
        Quantity::Reflectance,
        "reflect|reflekt|reflexi|refletâ|réflect|réflexi|riflett|rifless|remission|odbici|odrazivost|\
         отражени|r-factor|反射率|反射比|반사율",
        "rfr|rpc|rfl|reflec",
    ),
    (
        Quantity::Transmittance,
        "transmit|transmiss|trasmitt|trasmiss|propustnost|пропускани|t-factor|透過率|透过率|透射|투과율",
        "tfr|tpc",
    ),
    (
        Quantity::Irradiance,
        "irradian|irr. (|irradiân|irraggiam|exitance|bestrahlungsst|éclairement énerg|放射照度",
        "irrad",
    ),
    (Quantity::Radiance, "radianc|rad. (|radianz|radiânc|strahldichte|luminance énerg|放射輝度", ""),
    (Quantity::RadiantIntensity, "radiant intensity", ""),
    (Quantity::RadiantFlux, "radiant flux|spectral flux", ""),
    (Quantity::SpectralPower, "spectral power|spectral distribution", "spd|emission|emissions"),
    (Quantity::Counts, "", COUNTS),
    (Quantity::Relative, "", "relative"),
];

pub(super) fn quantity(text: &str) -> Option<Quantity> {
    let text = spaced(text);
    if text.trim() == UNSPECIFIED {
        return Some(Quantity::Unknown);
    }
    if names_logarithm(&text.replace('_', " ")) {
        return None;
    }
    // Light that something reflects or transmits is light.
    let passed = begins(&text, "reflected|transmitted") && begins(&text, "radian|irradian|spectral flux|power");
    // What stands in brackets was measured: before it, `100%T` may be a sample's name.
    let measured = text.trim_end().strip_suffix(')').and_then(|text| percent_letter(text.rsplit_once('(')?.1));
    let letter = measured.or_else(|| percent_letter(&text)).or_else(|| inverse_log(&text));
    let is_named = |(quantity, beginnings, whole): &&(Quantity, &str, &str)| {
        let named = begins(&text, beginnings) || has_word(&text, whole);
        match quantity {
            Quantity::Reflectance => !passed && (named || letter == Some('r')),
            Quantity::Transmittance => !passed && (named || letter == Some('t')),
            _ => named,
        }
    };
    let mut named = QUANTITIES.iter().filter(is_named).map(|(quantity, ..)| *quantity);
    let first = named.next();
    // Either of two, as in `EQE (or reflectance)`.
    let is_response = |of: Quantity| matches!(of, Quantity::QuantumEfficiency | Quantity::Absorptance);
    let is_of_surface = |of: Quantity| matches!(of, Quantity::Reflectance | Quantity::Transmittance);
    let is_either = first.is_some_and(is_response) && has_word(&text, "or") && named.any(is_of_surface);
    first.filter(|_| !is_either)
}

pub(super) fn role(text: &str) -> Option<Role> {
    let light = || {
        let text = spaced(text).replace('_', " ");
        begins(&text, "photon flux|radianc|radiant flux|radiant power|radiant energ|irradian|illuminan|light source")
            || has_word(&text, "lux|cct")
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
    let word = lower(key.trim());
    let condition = key.len() < text.len() && (word.starts_with("illuminant") || word.ends_with("_unit"));
    // A luminance is measured of lights.
    let light = key.len() < text.len() && word == "luminance";
    // Of a lock-in amplifier.
    let number = |rest: &str| rest.trim_start_matches([':', '=', ' ', '\t']).starts_with(|c: char| c.is_ascii_digit());
    let setting = word == "sensitivity" && number(&text[key.len()..]);
    // Power on an area, per wavelength.
    let power = || units::parse(text).is_some_and(|unit| unit.area.is_some() && unit.per != units::Per::None);
    if light {
        return Some(Role::Illuminant);
    }
    role(text).or_else(|| power().then_some(Role::Illuminant)).filter(|_| !(condition || setting))
}

/// Returns whether a line says that the numbers below are coefficients for the calibration of an instrument.
pub(super) fn says_calibration(text: &str) -> bool {
    const PHRASES: &str = "calibration file|calibration coef|characterization results|characterisation results";
    has_part(&lower(text), PHRASES)
}

/// Returns whether a name is that of a standard illuminant: `D65`, `FL2`, `Illuminant A`. `A`, `E` and `F2` alone are fields of charts too.
pub(super) fn names_illuminant(name: &str) -> bool {
    let name = lower(name);
    let mut told = false;
    let mut rest = words(&name).filter(|word| {
        let about = is_one(word, "cie|iso|standard|std|illuminant|ill|illum|light|series");
        told |= about;
        !about
    });
    let (Some(first), None) = (rest.next(), rest.next()) else { return false };
    let number = |text: &str, most: u32| text.parse::<u32>().is_ok_and(|number| (1..=most).contains(&number));
    is_one(first, "d50|d55|d60|d65|d75|d93|id50|id65|iso7589")
        || first.strip_prefix("fl").is_some_and(|rest| number(rest, 12))
        || ["led-b", "led-rgb", "led-v"]
            .iter()
            .any(|start| first.strip_prefix(start).is_some_and(|rest| number(rest, 5)))
        || (told
            && (matches!(first, "a" | "b" | "c" | "e") || first.strip_prefix('f').is_some_and(|rest| number(rest, 12))))
}

/// Kind of a light in a name; only good for a guess.
pub(super) fn names_lamp(name: &str) -> bool {
    const LAMPS: &str = "lamp|lamps|led|leds|halogen|xenon|daylight|sunlight|skylight|tungsten|lightbulb|luminaire";
    has_word(&lower(name), LAMPS)
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
    let word = !text.trim().trim_end_matches('.').contains(|c: char| !c.is_alphabetic());
    word && (quantity(text).is_some() || is_one(&lower(text), "value|values|intensity|signal"))
}

/// Returns whether a column's header names what only counts its rows.
pub(super) fn is_count(name: &str) -> bool {
    let name = lower(name);
    let first = words(&name).next();
    name == "#"
        || first.is_some_and(|word| {
            is_one(word, "pixel|pixels|px|index|idx|no|nr|nº|num|number|row|line|obs|id|n|i|番号|序号")
        })
}

/// Returns whether a column's header names what tells rows apart and nothing else: samples, channels, scans, flags.
pub(super) fn is_label(name: &str) -> bool {
    is_one(
        lower(name).trim(),
        "sample_id|sample id|sampleid|id|flag|quality|channel|scan|band|n|no|no.|#|row|column|run",
    )
}

/// Returns whether a column's header explains codes: `Source (0 = model, 1 = optical spectrum)`.
pub(super) fn lists_codes(name: &str) -> bool {
    let bare: String = name.chars().filter(|c| *c != ' ').collect();
    bare.contains("0=") && bare.contains("1=")
}

/// Returns whether the name of bands says how specular reflection was treated: included (SCI) or excluded (SCE).
pub(super) fn says_specular(text: &str) -> bool {
    has_word(&lower(text), "sci|sce|spin|spex|rsin|rsex")
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Channel {
    Letter(usize),
    /// By a word, `red`, which can also be the color of a thing, or by a part of the name.
    Word(usize),
}

pub(super) fn channel(name: &str) -> Option<Channel> {
    let name = lower(name);
    let position = |word: &str, list: &str| list.split('|').position(|entry| entry == word);
    let parts = || name.split(|c: char| !c.is_alphanumeric()).filter(|part| !part.is_empty());
    let kind = if parts().count() == 1 { Channel::Letter } else { Channel::Word };
    parts().find_map(|part| {
        let letter = position(part, "r|g|b|x|y|z|l|m|s|xbar|ybar|zbar|rbar|gbar|bbar").map(|i| kind(i % 3));
        let color = || position(part, "red|green|blue|rot|grün|blau|rouge|vert|bleu").map(|i| Channel::Word(i % 3));
        letter.or_else(color)
    })
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum XUnit {
    Wavelength(WavelengthUnit),
    /// Something that is not converted, such as photon energies.
    Other,
}

/// Words for lengths that are no wavelengths.
const SIZES: &str = "size|diameter|radius|thickness|distance";

/// The first unit of length, of wave number or of frequency in a piece of text.
pub(super) fn x_unit(text: &str) -> Option<XUnit> {
    const SHIFTS: &str = "raman shift|raman-shift|ramanshift|rel. 1/cm|rel. cm|relative wavenumber|relative wave number|shift (cm|\
        shift [cm|shift/cm";
    const ENERGIES: &str = "ev|freq|frequency|energy|energies|photon|e|h|hv|hν|hω|ħω|hbar|omega|ω|ν|wavelength|x";
    let text = bracketed(lower(text)).replace('⁻', "-").replace('¹', "1");
    if let Some(unit) = bracketed_letter(&text) {
        return Some(unit);
    }
    // Shifts are differences of wave numbers.
    if has_part(&text, "raman|cm|relative w") && has_part(&text, SHIFTS) {
        return Some(XUnit::Other);
    }
    let energies = has_part(&text, "energ|(ev)|[ev]") || words(&text).count() == 1;
    // Those of photons, and no band gaps, losses or binding energies.
    let photons = || words(&text.replace('_', " ")).all(|word| is_one(word, ENERGIES));
    let wave_numbers = has_part(&text, WAVE_NUMBERS) || text == "wn";
    let unit = words(&text).find_map(|word| match word {
        "ev" if energies && photons() => Some(XUnit::Wavelength(WavelengthUnit::Electronvolt)),
        "ev" | "kev" | "mev" if energies => Some(XUnit::Other),
        "hz" => Some(XUnit::Wavelength(WavelengthUnit::Hertz)),
        "ghz" | "phz" | "1/nm" => Some(XUnit::Other),
        // Coefficients of absorption have it too.
        "1/m" | "m-1" if wave_numbers => Some(XUnit::Other),
        _ => WavelengthUnit::from_symbol(word).map(XUnit::Wavelength),
    });
    // Of particles, and of layers.
    if unit.is_some() && words(&text).next().is_some_and(|word| is_one(word, SIZES)) {
        return Some(XUnit::Other);
    }
    // A wave number in nanometers contradicts itself.
    let own =
        wave_numbers && unit == Some(XUnit::Wavelength(WavelengthUnit::Nanometer)) && !text.contains("wavelength");
    unit.filter(|_| !own).or_else(|| (wave_numbers && !own).then_some(XUnit::Wavelength(WavelengthUnit::Wavenumber)))
}

/// Words for wavelengths and what stands for them.
const NAMES: &str = "wavelength|wavelengths|wave|wl|wvl|lambda|λ|wavenumber|wave number|frequency|freq|ν";

/// Wave numbers, in some languages.
const WAVE_NUMBERS: &str =
    "wavenumber|wave number|wellenzahl|golfgetal|nombre d'onde|número de onda|numero d'onda|波数";

/// As other languages call them.
const CALLED: &str = "wellenl|longueur d|longitud de onda|lunghezza d|comprimento de onda|golflengte|våglängd|bølgel|długość fal|\
    vlnová délka|длина волны|波長|波长|파장";

/// Returns whether a name is that of wavelengths and nothing else.
fn is_axis_name(name: &str) -> bool {
    is_one(name, NAMES) || CALLED.split('|').any(|start| name.starts_with(start))
}

/// A header in lower case with its unit in brackets, if it stands behind a slash: `frequency (thz)` of `frequency/thz`.
fn bracketed(lower: String) -> String {
    match slashed(&lower) {
        Some((name, unit)) if is_axis_name(name) => format!("{name} ({})", unit.trim_matches(['(', ')'])),
        _ => lower,
    }
}

/// A unit of one letter, or a multiple of one, in brackets right after the word for wavelengths: `Wavelength (A)`, `wave(m)`,
/// `Wavenumber (10^3 cm-1)`.
fn bracketed_letter(lower: &str) -> Option<XUnit> {
    let (name, rest) = lower.split_once(['(', '['])?;
    let unit = rest[..rest.find([')', ']'])?].trim();
    let name = name.trim_matches(|c: char| !c.is_alphanumeric());
    if !is_axis_name(name) {
        return None;
    }
    let multiple = ["10^3", "10^4", "10³", "1000", "k"].iter().any(|start| unit.starts_with(start));
    match unit {
        "a" => Some(XUnit::Wavelength(WavelengthUnit::Angstrom)),
        "m" | "meter" | "meters" | "metre" | "metres" => Some(XUnit::Wavelength(WavelengthUnit::Meter)),
        _ if multiple && unit.contains("cm") => Some(XUnit::Other),
        _ => None,
    }
}

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
    const WORDS: &str =
        "wavelength|lambda is in|lambda\" is in|lambda in|wavenumber|wave number|x unit|xunit|x axis|xaxis|axisunit[1]";
    let text = lower(text);
    let start = WORDS.split('|').find_map(|word| text.find(word))?;
    // In a line of names, wave numbers and shifts have columns of their own.
    let text = &text[start..];
    let is_name = |at: &usize| text[..*at].ends_with([',', ';', '\t']);
    let end = ["wavenumber", "raman shift"].iter().filter_map(|other| text.find(other).filter(is_name)).min();
    x_unit(&text[..end.unwrap_or(text.len())])
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
pub(super) fn begins_with_wavelengths(text: &str) -> bool {
    const NAMES: &str = "wavelength|wavelengths|wave|wl|wvl|λ|lambda|wavenumber";
    let text = without_argument(&lower(text));
    let mut words = words(&text).filter(|word| WavelengthUnit::from_symbol(word).is_none());
    let first = words.next();
    let last = words.last().or(first);
    first.is_some_and(|word| is_one(word, NAMES)) || last.is_some_and(|word| is_one(word, NAMES))
}

/// Returns whether a column's header names wavelengths, wave numbers or frequencies of light.
pub(super) fn names_wavelengths(text: &str) -> bool {
    // As their unit alone does.
    const UNITS: &str = "[nm]|(nm)|[µm]|(µm)|[μm]|(μm)|[um]|(um)|[cm-1]|(cm-1)";
    let text = without_argument(&bracketed(lower(text)));
    if words(&text).next().is_some_and(|word| is_one(word, SIZES)) {
        return false;
    }
    if has_part(&text, CALLED) || has_part(&text, UNITS) {
        return true;
    }
    // As an index, such as in `E_λ`, it names no wavelengths.
    let symbol = |symbol| {
        text.match_indices(symbol).any(|(at, _)| !text[..at].ends_with(|c: char| c.is_alphanumeric() || c == '_'))
    };
    has_part(&text, "wavelength|wavenumber|wave number")
        || (text.contains("freq") && has_word(&text, "thz|hz"))
        || symbol("lambda")
        || symbol("λ")
        || ["w.length", "w_length"].iter().any(|name| text.starts_with(name))
        || words(&text).next().is_some_and(|word| is_one(word, "wave|wl|wvl|nm|um|µm|μm|cm-1|1/cm|thz"))
}

/// Returns whether a column's header names times and nothing else, such as `Time (s)` or `Integration time [ms]`.
pub(super) fn names_time(text: &str) -> bool {
    const TIMES: &str = "time|timestamp|date|datetime|date/time|zeit";
    const BESIDE: &str =
        "s|sec|seconds|ms|us|µs|min|h|hours|utc|local|stamp|integration|exposure|acquisition|elapsed|measurement";
    let text = lower(text);
    has_word(&text, TIMES) && words(&text).all(|word| is_one(word, TIMES) || is_one(word, BESIDE))
}

/// Index of the column header that names the wavelengths: those in nanometers before those in other units. A first one without a
/// unit is that of the values next to it.
pub(super) fn axis(names: &[String]) -> Option<usize> {
    let rank = |name: &str| match x_unit(name) {
        Some(XUnit::Wavelength(WavelengthUnit::Nanometer)) => 0,
        Some(XUnit::Wavelength(WavelengthUnit::Micrometer | WavelengthUnit::Angstrom)) => 1,
        None => 2,
        Some(_) => 3,
    };
    let mut named = names.iter().enumerate().filter(|(_, name)| names_wavelengths(name)).peekable();
    let &(first, name) = named.peek()?;
    let has_values =
        |next: &String| !next.is_empty() && !names_wavelengths(next) && !is_count(next) && !names_time(next);
    if rank(name) == 2 && names.get(first + 1).is_some_and(has_values) {
        return Some(first);
    }
    named.min_by_key(|(_, name)| rank(name)).map(|(column, _)| column)
}
