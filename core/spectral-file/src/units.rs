//! Units of light in their parts: `µmol m⁻² s⁻¹ nm⁻¹`, `photons/(s cm2 nm)`, `W/m²/THz`, `mW/(m² sr cm⁻¹)`.
//!
//! The parts after the first are denominators, however they are written: nobody multiplies irradiance by square meters. Only
//! the size of an exponent counts, so that `W/m2/nm`, `W m-2 nm-1` and `W/m2 nm` are one unit, and a centimeter that is not
//! squared is always a wave number: `W/m²/cm-1`, `W m-2 (cm-1)-1`, `W m-2 cm`.

use crate::decimal::{self, clean};
use crate::decision::WavelengthUnit;

/// The Avogadro constant, exact (SI 2019).
const AVOGADRO: f64 = 6.022_140_76e23;

#[derive(Debug, Clone)]
pub(super) struct Unit {
    pub(super) amount: Amount,
    /// The area, such as `m²`.
    pub(super) area: Option<&'static str>,
    /// The solid angle, such as `sr`.
    pub(super) angle: Option<&'static str>,
    time: Option<&'static str>,
    pub(super) per: Per,
    pub(super) ten: f64,
    /// The size of its energy in units of the symbol, as of an erg in joules.
    pub(super) size: f64,
    /// The byte of the text where it begins.
    pub(super) start: usize,
}

#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Amount {
    Energy(&'static str),
    Photons(f64),
}

#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Per {
    None,
    Nanometer,
    /// A length in nanometers.
    Length(f64),
    /// A frequency in terahertz.
    Frequency(f64),
    Wavenumber,
    /// The energy of a photon in electronvolts.
    Electronvolt,
}

impl Unit {
    /// The symbol of the unit that values have as energies per nanometer.
    pub(super) fn in_energy_per_nm(&self) -> String {
        let (symbol, time) = match (self.amount, self.time) {
            (Amount::Photons(_), Some("s")) => ("W", None),
            (Amount::Photons(_), time) => ("J", time),
            (Amount::Energy("J"), Some("s")) if self.size != 1.0 => ("W", None),
            (Amount::Energy(symbol), time) => (symbol, time),
        };
        let spectral = (self.per != Per::None).then_some("nm");
        let parts = [time, self.area, self.angle, spectral].into_iter().flatten();
        parts.fold(symbol.to_owned(), |unit, part| unit + "/" + part)
    }
}

/// A word of a unit: letters and the size of an exponent.
struct Word<'a> {
    letters: &'a str,
    exponent: u32,
    start: usize,
}

/// The unit of light in a text, which may have words before it.
pub(super) fn parse(text: &str) -> Option<Unit> {
    const LONGEST: usize = 200;
    const MOST: usize = 24;
    // An amount of an amount is none of light.
    if text.len() > LONGEST || text.contains("mol/mol") {
        return None;
    }
    let words: Vec<Word<'_>> = words(text).take(MOST).collect();
    (0..words.len()).find_map(|at| {
        let unit = unit(text, &words[at..])?;
        let told = unit.area.is_some() || unit.angle.is_some() || unit.per != Per::None;
        let photons = matches!(unit.amount, Amount::Photons(_)) && unit.time.is_some();
        (told || photons).then_some(unit)
    })
}

fn words(text: &str) -> impl Iterator<Item = Word<'_>> {
    let mut at = 0;
    std::iter::from_fn(move || {
        let start = at + text[at..].find(char::is_alphabetic)?;
        let end = text[start..].find(|c: char| !c.is_alphabetic()).map_or(text.len(), |end| start + end);
        let (exponent, length) = exponent(&text[end..]);
        at = end + length;
        Some(Word { letters: &text[start..end], exponent, start })
    })
}

/// The size of the exponent that a text begins with (1 if there is none), and its length in bytes.
fn exponent(text: &str) -> (u32, usize) {
    let before = text.trim_start_matches(['^', '*', '(', '-', '\u{2212}', '\u{2013}', '⁻', '+']);
    let digit = |c: char| plain(c).to_digit(10);
    let digits: u32 = before.chars().map_while(digit).take(3).fold(0, |number, digit| number * 10 + digit);
    let length: usize = before.chars().take_while(|c| digit(*c).is_some()).take(3).map(char::len_utf8).sum();
    if length == 0 { (1, 0) } else { (digits, text.len() - before.len() + length) }
}

fn unit(text: &str, words: &[Word<'_>]) -> Option<Unit> {
    let (first, rest) = words.split_first()?;
    let lower = first.letters.to_lowercase();
    let ergs = ergs(first.letters);
    // Below another amount, `A/W` or `A W^-1`, or behind what no unit begins with, `milli-Jy`, it is none of light.
    let (before, after) = text.split_at(first.start);
    let after = after[first.letters.len()..].trim_start_matches(['^', '*', '(']);
    let inverse = after.strip_prefix(['-', '\u{2212}', '⁻']).is_some_and(|power| power.starts_with(['1', '¹']));
    if inverse || before.ends_with(['/', '-']) {
        return None;
    }
    let (amount, joined) = if let Some((symbol, _)) = ergs { (Amount::Energy(symbol), None) } else { amount(&lower)? };
    let (ten, start) = power_of_ten(text, first.start);
    let ten = ten * power_behind(text);
    let size = ergs.map_or(1.0, |(_, size)| size);
    let mut unit = Unit { amount, area: None, angle: None, time: None, per: Per::None, ten, size, start };
    let mut bare = unit.clone();
    if amount == Amount::Energy("W") && ergs.is_some() {
        (unit.area, unit.per) = (Some("m²"), Per::Frequency(1e-12));
    }
    if let Some(joined) = joined {
        unit.take(joined, first.exponent);
    }
    for word in rest {
        let lower = word.letters.to_lowercase();
        let known =
            matches!(lower.as_str(), "per" | "photon" | "photons" | "quanta") || unit.take(&lower, word.exponent);
        if !known {
            // What is divided by one kind of thing twice, such as `ergs/cm^s/s/nm`, is misspelt.
            let divided = text[..word.start].ends_with(['/', '.', '·', '*']);
            return (!(divided && bare.take(&lower, word.exponent))).then_some(unit);
        }
    }
    Some(unit)
}

/// The amount that a word stands for, and a length that is written right behind it, as in `Wm-2`.
fn amount(word: &str) -> Option<(Amount, Option<&'static str>)> {
    if let Some(amount) = plain_amount(word) {
        return Some((amount, None));
    }
    ["cm", "m"].into_iter().find_map(|length| {
        let short = word.strip_suffix(length).filter(|short| !short.is_empty() && !short.ends_with("photon"))?;
        Some((plain_amount(short)?, Some(length)))
    })
}

/// The symbol and the size of ergs, and of janskys (10⁻²⁶ W/m²/Hz). Of janskys, `m` and `M` are different.
fn ergs(letters: &str) -> Option<(&'static str, f64)> {
    Some(match letters {
        "erg" | "ergs" | "Erg" | "Ergs" => ("J", 1e-7),
        "Jy" => ("W", 1e-26),
        "mJy" => ("W", 1e-29),
        "µJy" | "μJy" | "uJy" => ("W", 1e-32),
        "kJy" => ("W", 1e-23),
        "MJy" => ("W", 1e-20),
        _ => return None,
    })
}

fn plain_amount(word: &str) -> Option<Amount> {
    const PREFIXES: [(&str, f64); 11] = [
        ("micro", 1e-6),
        ("milli", 1e-3),
        ("nano", 1e-9),
        ("", 1.0),
        ("m", 1e-3),
        ("µ", 1e-6),
        ("μ", 1e-6),
        ("u", 1e-6),
        ("n", 1e-9),
        ("p", 1e-12),
        ("k", 1e3),
    ];
    const ENERGIES: [(&str, [&str; 6]); 2] =
        [("w", ["W", "mW", "µW", "nW", "pW", "kW"]), ("j", ["J", "mJ", "µJ", "nJ", "pJ", "kJ"])];
    const SCALES: [f64; 6] = [1.0, 1e-3, 1e-6, 1e-9, 1e-12, 1e3];
    PREFIXES.iter().find_map(|(prefix, scale)| {
        let base = word.strip_prefix(prefix)?;
        let symbol = match base {
            "mol" | "mole" | "moles" | "einstein" | "einsteins" => return Some(Amount::Photons(scale * AVOGADRO)),
            // Microeinsteins; a lone E is a quantity.
            "e" if *scale == 1e-6 => return Some(Amount::Photons(scale * AVOGADRO)),
            "photon" | "photons" | "quanta" | "quantum" => return Some(Amount::Photons(*scale)),
            "ph" | "phot" if *scale == 1.0 => return Some(Amount::Photons(1.0)),
            "watt" | "watts" => "w",
            "joule" | "joules" => "j",
            other => other,
        };
        let (_, symbols) = ENERGIES.iter().find(|(base, _)| *base == symbol)?;
        let index = SCALES.iter().position(|known| known == scale)?;
        Some(Amount::Energy(symbols[index]))
    })
}

impl Unit {
    /// Parses a denominator; returns whether it is one.
    fn take(&mut self, word: &str, exponent: u32) -> bool {
        let known = match WavelengthUnit::from_symbol(word) {
            Some(WavelengthUnit::Nanometer) => Some(Per::Nanometer),
            Some(WavelengthUnit::Terahertz) => Some(Per::Frequency(1.0)),
            Some(WavelengthUnit::Wavenumber) => Some(Per::Wavenumber),
            unit => unit.map(|unit| Per::Length(unit.nanometers(1.0))),
        };
        if let Some(per) = known {
            return self.take_per(per);
        }
        let (symbol, length_nm, areas) = match word {
            "a" | "ang" => return self.take_per(Per::Length(0.1)),
            "ghz" => return self.take_per(Per::Frequency(1e-3)),
            "mhz" => return self.take_per(Per::Frequency(1e-6)),
            "hz" => return self.take_per(Per::Frequency(1e-12)),
            "ev" | "electronvolt" | "electronvolts" => return self.take_per(Per::Electronvolt),
            "sr" | "steradian" | "steradians" => return self.angle.replace("sr").is_none(),
            // As astronomers leave out its exponent, too.
            "arcsec" | "arcsecond" | "arcseconds" => return self.angle.replace("arcsec²").is_none(),
            "sqm" | "sm" => return self.area.replace("m²").is_none(),
            "s" | "sec" | "second" | "seconds" => return self.take_time("s"),
            "h" | "hr" | "hour" => return self.take_time("h"),
            "d" | "day" => return self.take_time("d"),
            "m" | "meter" | "metre" => ("m", 1e9, "m²"),
            "cm" => ("cm", 1e7, "cm²"),
            "mm" => ("mm", 1e6, "mm²"),
            _ => return false,
        };
        match exponent {
            2 => self.area.replace(areas).is_none(),
            3 => self.area.replace(areas).is_none() && self.take_per(Per::Length(length_nm)),
            1 if symbol == "cm" => self.take_per(Per::Wavenumber),
            1 => self.take_per(Per::Length(length_nm)),
            _ => false,
        }
    }

    fn take_per(&mut self, per: Per) -> bool {
        std::mem::replace(&mut self.per, per) == Per::None
    }

    fn take_time(&mut self, time: &'static str) -> bool {
        self.time.replace(time).is_none()
    }
}

/// The power of ten that stands right before a unit, and where it begins: `10^15 photons`, `1e13 photons`.
fn power_of_ten(text: &str, start: usize) -> (f64, usize) {
    let before = text[..start].trim_end_matches([' ', '*', '·', '×']);
    let number = |c: char| matches!(plain(c), '0'..='9' | 'e' | 'E' | '^' | '-' | '+');
    let at =
        before.rfind(|c: char| !number(c)).map_or(0, |at| at + before[at..].chars().next().map_or(1, char::len_utf8));
    let written: String = before[at..].chars().map(plain).collect();
    let power = written.strip_prefix("10").map(|rest| rest.trim_start_matches('^')).filter(|rest| !rest.is_empty());
    let power = power.or_else(|| written.strip_prefix("1e").or_else(|| written.strip_prefix("1E")));
    let power = power.and_then(|power| power.parse::<i32>().ok()).filter(|power| power.abs() <= 40);
    power.map_or((1.0, start), |power| (10_f64.powi(power), at))
}

/// The power of ten that a unit ends with: `erg/s/cm2/A*10**-16`, `W/m2 x 10^-3`.
fn power_behind(text: &str) -> f64 {
    let text = text.trim_end_matches([')', ']']);
    let power = |start: &str| {
        let (before, power) = text.rsplit_once(start)?;
        let times = before.trim_end().ends_with(['*', '·', '×', 'x']);
        power.trim_matches(['(', ')']).parse::<i32>().ok().filter(|power| times && power.abs() <= 40)
    };
    power("10**").or_else(|| power("10^")).map_or(1.0, |power| 10_f64.powi(power))
}

fn plain(c: char) -> char {
    match c {
        '⁻' => '-',
        '⁰' => '0',
        '¹' => '1',
        '²' => '2',
        '³' => '3',
        '⁴'..='⁹' => char::from_digit(u32::from(c) - u32::from('⁰'), 10).unwrap_or(c),
        other => other,
    }
}

impl WavelengthUnit {
    /// True for what is inverse to wavelengths: equal steps of it are none of these.
    pub(super) fn is_inverse(self) -> bool {
        matches!(self, Self::Wavenumber | Self::Terahertz | Self::Hertz | Self::Electronvolt)
    }

    /// The unit of a symbol or name, such as `nm`, `um`, `µm` or `Micrometers`.
    pub(super) fn from_symbol(symbol: &str) -> Option<Self> {
        // Every unit has a letter: numbers cut in pieces by a wrong separator have none.
        if symbol.len() > 16 || !symbol.contains(char::is_alphabetic) {
            return None;
        }
        let lower = symbol.to_lowercase();
        match lower.as_str() {
            "nm" | "nanometer" | "nanometers" | "nanometre" | "nanometres" => Some(Self::Nanometer),
            // U+00B5 and U+03BC, and the former misread as Windows-1252.
            "um" | "µm" | "μm" | "âµm" | "micron" | "microns" | "micro" | "micrometer" | "micrometers"
            | "micrometre" | "micrometres" => Some(Self::Micrometer),
            "cm-1" | "cm^-1" | "1/cm" | "cm⁻¹" | "wavenumbers" => Some(Self::Wavenumber),
            "thz" | "terahertz" => Some(Self::Terahertz),
            "å" | "aa" | "ångström" | "ångströms" | "angstrom" | "angstroms" => Some(Self::Angstrom),
            _ => None,
        }
    }

    /// The wavelength in nanometers that a number in this unit means, to 1e-9 nm.
    pub fn nanometers(self, value: f64) -> f64 {
        match self {
            Self::Nanometer => value,
            Self::Micrometer => clean(decimal::shifted(value, 3)),
            Self::Meter => clean(decimal::shifted(value, 9)),
            Self::Angstrom => clean(decimal::shifted(value, -1)),
            Self::Wavenumber => clean(1e7 / value),
            Self::Terahertz => clean(SPEED_OF_LIGHT_NM_THZ / value),
            Self::Hertz => clean(SPEED_OF_LIGHT_NM_THZ * 1e12 / value),
            Self::Electronvolt => clean(PLANCK_LIGHT_EV_NM / value),
        }
    }

    /// The number in this unit that means a wavelength in nanometers, to 1e-9 of the unit: what
    /// [`nanometers`](Self::nanometers) was given.
    pub fn from_nanometers(self, nm: f64) -> f64 {
        match self {
            Self::Nanometer => nm,
            Self::Micrometer => decimal::shifted(nm, -3),
            Self::Meter => decimal::shifted(nm, -9),
            Self::Angstrom => decimal::shifted(nm, 1),
            Self::Wavenumber => clean(1e7 / nm),
            Self::Terahertz => clean(SPEED_OF_LIGHT_NM_THZ / nm),
            Self::Hertz => clean(SPEED_OF_LIGHT_NM_THZ * 1e12 / nm),
            Self::Electronvolt => clean(PLANCK_LIGHT_EV_NM / nm),
        }
    }
}

/// The Planck constant times the speed of light, in J nm and in eV nm, exact (SI 2019).
pub(super) const PLANCK_LIGHT_J_NM: f64 = 6.626_070_15e-34 * 299_792_458e9;
pub(super) const PLANCK_LIGHT_EV_NM: f64 = PLANCK_LIGHT_J_NM / 1.602_176_634e-19;

/// The speed of light in vacuum in nm THz, exact.
pub(super) const SPEED_OF_LIGHT_NM_THZ: f64 = 299_792.458;

/// Accepted wavelengths in nanometers: beyond what any instrument for light measures.
pub(super) const RANGE_NM: std::ops::RangeInclusive<f64> = 100.0..=25_000.0;

/// Returns whether numbers can be wavelengths at all: in range as nanometers, or as micrometers with fractions.
pub(super) fn plausible(min: f64, max: f64, fractions: bool) -> bool {
    (RANGE_NM.contains(&min) && RANGE_NM.contains(&max)) || (fractions && min >= 0.1 && max <= 25.0)
}
