//! Wavelengths across a header: `400`, `400nm`, or in the names of columns: `SCI 360nm`, `SPEC_380`, `R380`, `380 nm [%]`.

use crate::decimal::extent;
use crate::decision::WavelengthUnit;
use crate::dialect::{Cell, Dialect};
use crate::error::MAX_CURVES;
use crate::header_terms::{self, XUnit};
use crate::text::is_one;
use crate::units::{RANGE_NM, plausible};

/// The fewest bands that are taken for a spectrum.
pub(super) const FEWEST: usize = 5;

/// The fewest that are wavelengths although a word behind them says nothing of it, or a few are out of range: fewer may count samples
/// or their settings.
const FEWEST_UNSAID: usize = 30;

#[derive(Debug, Clone, Copy, PartialEq)]
struct Band<'a> {
    /// Text before the wavelength, and text behind it and its unit.
    prefix: &'a str,
    suffix: &'a str,
    wavelength: f64,
    unit: Option<WavelengthUnit>,
}

impl Band<'_> {
    /// Returns whether its name says that the number is a wavelength.
    fn is_known(&self) -> bool {
        self.unit.is_some() || is_band_prefix(self.prefix)
    }

    /// Returns whether the name begins with the number, and a word is set apart from it: `400.386_SP1`.
    fn is_apart(&self) -> bool {
        let word = self.suffix.strip_prefix('_').filter(|_| self.prefix.is_empty());
        word.is_some_and(|word| word.starts_with(char::is_alphabetic))
    }

    fn goes_with(&self, other: &Self) -> bool {
        (self.prefix, self.suffix, self.unit) == (other.prefix, other.suffix, other.unit)
    }
}

/// Bands side by side whose names differ in nothing but the wavelength.
#[derive(Debug, Clone, Default)]
pub(super) struct Group {
    /// The first column, from 0.
    pub(super) start: usize,
    /// The wavelength of each column; NaN where none can be read.
    pub(super) wavelengths: Vec<f64>,
    pub(super) unit: Option<WavelengthUnit>,
    pub(super) prefix: String,
    pub(super) suffix: String,
    /// True if the names say that their numbers are wavelengths, and not only the numbers.
    pub(super) known: bool,
}

impl Group {
    pub(super) fn end(&self) -> usize {
        self.start + self.wavelengths.len()
    }

    /// Returns whether a line is a header of other wavelengths: as long as no row of values is that rises or falls all the way.
    pub(super) fn is_like(&self, dialect: Dialect, line: &str) -> bool {
        let mut last = None;
        let mut count = 0;
        // Counts that rise with the time of exposure run elsewhere.
        let near = |nm: f64, own: Option<&f64>| own.is_some_and(|own| nm < 2.0 * own && *own < 2.0 * nm);
        for cell in dialect.cells(line).skip(self.start) {
            match dialect.parse(cell) {
                Cell::Number(nm) if count == 0 && !near(nm, self.wavelengths.first()) => return false,
                Cell::Number(nm) if RANGE_NM.contains(&nm) && last.is_none_or(|last| nm > last) => last = Some(nm),
                Cell::Gap if count > 0 => break,
                _ => return false,
            }
            count += 1;
        }
        count > FEWEST_UNSAID && last.is_some_and(|nm| near(nm, self.wavelengths.last()))
    }

    pub(super) fn count(&self) -> usize {
        self.wavelengths.iter().filter(|wavelength| !wavelength.is_nan()).count()
    }
}

fn band(dialect: Dialect, name: &str) -> Option<Band<'_>> {
    const LONGEST: usize = 64;
    let digit = |c: char| c.is_ascii_digit();
    if name.len() > LONGEST || !name.contains(digit) {
        return None;
    }
    let mut found: Option<Band<'_>> = counted(name);
    let mut from = if found.is_some() { name.len() } else { 0 };
    while let Some(start) = name[from..].find(digit).map(|at| from + at) {
        let in_number = |c: char| c.is_ascii_digit() || matches!(c, '.' | ',');
        let end = name[start..].find(|c| !in_number(c)).map_or(name.len(), |at| start + at);
        let end = start + name[start..end].trim_end_matches(['.', ',']).len();
        let end = end + exponent(&name[end..]);
        from = end;
        let Cell::Number(wavelength) = dialect.parse(&name[start..end]) else { continue };
        let (unit, suffix) = unit(&name[end..]);
        let (prefix, suffix) = unbracketed(name[..start].trim(), suffix);
        let bare = prefix.trim_end_matches(['_', '.', ' ', '-']).to_ascii_lowercase();
        let numbers = || is_one(&bare, "wn|wavenumber").then_some(WavelengthUnit::Wavenumber);
        let before = bare.ends_with("nm").then_some(WavelengthUnit::Nanometer).or_else(numbers);
        let one = Band { prefix, suffix, wavelength, unit: unit.or(before) };
        // A number with a unit, or before `_SP1`, else the last.
        if found.is_none_or(|found| found.unit.is_none() && !found.is_apart()) {
            found = Some(one);
        }
    }
    // Other words, but no numbers cut in pieces.
    let word = |band: &Band<'_>| band.prefix.starts_with(char::is_alphabetic) && !band.prefix.contains(digit);
    // `400_refl`
    let measured = |band: &Band<'_>| band.prefix.is_empty() && header_terms::role_of_bands(band.suffix).is_some();
    found.filter(|band| band.is_known() || band.suffix.is_empty() && word(band) || measured(band) || band.is_apart())
}

/// A band that `SCiO` numbers from its first wavelength, in nanometers: `spectrum_3 + 740`.
fn counted(name: &str) -> Option<Band<'_>> {
    let (index, first) = name.strip_prefix("spectrum_")?.split_once(" + ")?;
    let wavelength = f64::from(index.parse::<u16>().ok()?) + f64::from(first.parse::<u16>().ok()?);
    Some(Band { prefix: "spectrum", suffix: "", wavelength, unit: Some(WavelengthUnit::Nanometer) })
}

/// Length of the exponent that a text begins with, such as `e+03`.
fn exponent(text: &str) -> usize {
    let digits = text.strip_prefix(['e', 'E']).and_then(|rest| rest.strip_prefix(['+', '-'])).unwrap_or_default();
    let count = digits.bytes().take_while(u8::is_ascii_digit).count();
    if count > 0 { count + 2 } else { 0 }
}

/// Without the brackets around a wavelength: `Rrs(412)`, `R[400 nm]`.
fn unbracketed<'a>(prefix: &'a str, suffix: &'a str) -> (&'a str, &'a str) {
    let Some(bare) = prefix.strip_suffix(['(', '[']).filter(|bare| !bare.is_empty()) else { return (prefix, suffix) };
    let rest = suffix.strip_prefix([')', ']']);
    rest.or(suffix.is_empty().then_some("")).map_or((prefix, suffix), |rest| (bare.trim_end(), rest.trim_start()))
}

fn unit(text: &str) -> (Option<WavelengthUnit>, &str) {
    let rest = text.trim_start().trim_start_matches(['[', '(', '_']).trim_start();
    let end = rest.find(|c: char| !(c.is_alphabetic() || c == '/' || c == '-' || c == '1')).unwrap_or(rest.len());
    match WavelengthUnit::from_symbol(&rest[..end]) {
        Some(unit) => (Some(unit), rest[end..].trim_start_matches([']', ')']).trim()),
        None => (None, text.trim()),
    }
}

/// Returns whether a text before a number without unit makes it a wavelength, and no name of a sample.
fn is_band_prefix(prefix: &str) -> bool {
    const WHOLE: &str = "r|t|s|x|w|a|b|l|wl|wv|wvl|wave|band|spc|refl|ref|trans|sci|sce|lambda|λ|%r";
    let lower = prefix.to_lowercase();
    let bare = lower.trim_end_matches(|c: char| !c.is_alphanumeric());
    is_one(bare, WHOLE) || bare.contains("spec") || bare.contains("wavelength") || bare.contains("reflectance")
}

/// The groups of wavelengths in a header. A cell that is empty or out of order costs its column only.
pub(super) fn groups(dialect: Dialect, line: &str) -> Vec<Group> {
    const APART: f64 = 3.0;
    let (mut named, mut stated, mut of_all) = (false, None, None);
    let mut bands: Vec<(usize, Band<'_>)> = Vec::new();
    for (column, cell) in dialect.cells(line).take(MAX_CURVES + 2).enumerate() {
        let mut band = head(dialect, cell);
        let is_known = band.is_some_and(|band| band.is_known());
        // `lambda=400.5 404.8 …`: the name of the list stands before its first number.
        if let Some(first) = &mut band
            && first.prefix.ends_with('=')
            && is_band_prefix(first.prefix)
        {
            first.prefix = "";
        }
        if bands.is_empty() && has_letter(cell) && header_terms::names_wavelengths(cell) && !is_known {
            named = true;
            stated = header_terms::x_unit(cell)
                .and_then(|unit| if let XUnit::Wavelength(unit) = unit { Some(unit) } else { None });
        } else if let Some(band) = band {
            bands.push((column, band));
        }
    }
    // A number that is set apart, and so far from the next, is none of the wavelengths that follow.
    let is_far = |first: f64, second: f64| first > APART * second || second > APART * first;
    let mut all = Vec::new();
    let mut run: Vec<(usize, Band<'_>)> = Vec::new();
    let (mut wrong, mut overlaps) = (0, 0);
    for (index, &(column, band)) in bands.iter().enumerate() {
        let next = bands.get(index + 1).map(|(_, next)| next);
        of_all = of_all.or_else(|| unit_of_all(&mut run, &band));
        stated = stated.or(of_all);
        let (begun, beside) =
            (run.first().map(|(_, first)| first.wavelength), run.last().is_some_and(|(last, _)| last + 1 == column));
        match step(&run, &band, next) {
            Step::On => {
                if run.len() == 1 && !beside && begun.is_some_and(|first| is_far(first, band.wavelength)) {
                    run.clear();
                }
                run.push((column, band));
            }
            Step::Wrong | Step::Anew
                if beside && overlaps < MOST_OVERLAPS && begins_next_detector(&run, &band, next) =>
            {
                run.push((column, band));
                overlaps += 1;
            }
            Step::Wrong => wrong += 1,
            Step::Anew => {
                // Numbers that go up and down are values, unless a second spectrum begins where the first did, or one number
                // stands behind many.
                let plain = band.prefix.is_empty() && band.suffix.is_empty();
                let lone = index + 1 == bands.len() && run.len() > FEWEST_UNSAID;
                if plain && !lone && beside && begun != Some(band.wavelength) {
                    return Vec::new();
                }
                all.extend(group(&run, wrong, stated));
                (run, wrong) = (vec![(column, band)], 0);
            }
            Step::Other => {
                all.extend(group(&run, wrong, stated));
                (run, wrong) = (vec![(column, band)], 0);
            }
        }
    }
    all.extend(group(&run, wrong, stated));
    if let ([only], Some(unit)) = (&mut all[..], of_all) {
        only.unit = only.unit.or(Some(unit));
    }
    // A table that names the column of its wavelengths has them there.
    // R puts an X before numbers.
    let bare = |group: &Group| group.suffix.is_empty() && matches!(group.prefix.as_str(), "" | "X");
    if named && all.first().is_some_and(|group| !bare(group)) {
        return Vec::new();
    }
    all
}

/// Takes the unit that the first of several bands has for all: `380 [nm],385,390`.
fn unit_of_all(run: &mut [(usize, Band<'_>)], band: &Band<'_>) -> Option<WavelengthUnit> {
    let [(_, first)] = run else { return None };
    let alike = band.unit.is_none() && (first.prefix, first.suffix) == (band.prefix, band.suffix);
    if alike { first.unit.take() } else { None }
}

/// The most detectors of one instrument whose ranges overlap, but one.
const MOST_OVERLAPS: usize = 4;

/// Returns whether wavelengths go back a little and on, as where the ranges of two detectors overlap.
fn begins_next_detector(run: &[(usize, Band<'_>)], band: &Band<'_>, next: Option<&Band<'_>>) -> bool {
    const LEAST_TIMES: f64 = 10.0;
    const MOST_STEPS: f64 = 5.0;
    let ([(_, first), .., (_, last)], Some(next)) = (run, next) else { return false };
    let (so_far, back) = (last.wavelength - first.wavelength, last.wavelength - band.wavelength);
    // A number out of order among others that go on is none.
    let (step, typical) = (next.wavelength - band.wavelength, so_far / (run.len() - 1) as f64);
    let on = step > 0.0
        && step < MOST_STEPS * typical
        && next.wavelength - last.wavelength < typical
        && next.goes_with(band);
    run.len() >= FEWEST_UNSAID && back * LEAST_TIMES < so_far && back > 0.0 && on
}

enum Step {
    On,
    /// Out of order among those around it.
    Wrong,
    Anew,
    Other,
}

fn step(run: &[(usize, Band<'_>)], band: &Band<'_>, next: Option<&Band<'_>>) -> Step {
    let Some((_, last)) = run.last() else { return Step::On };
    if !last.goes_with(band) {
        return Step::Other;
    }
    let ([(_, first), (_, second), ..], at) = (run, band.wavelength) else {
        return if band.wavelength == last.wavelength { Step::Anew } else { Step::On };
    };
    let way = (second.wavelength - first.wavelength).signum();
    let after = |a: f64, b: f64| (b - a) * way > 0.0;
    if let Some(next) = next.filter(|next| next.goes_with(last) && after(last.wavelength, next.wavelength))
        && !(after(last.wavelength, at) && after(at, next.wavelength))
    {
        return Step::Wrong;
    }
    if after(last.wavelength, at) { Step::On } else { Step::Anew }
}

/// False for numbers cut in pieces by a wrong separator, of which there are many: names and units of wavelengths have letters.
fn has_letter(cell: &str) -> bool {
    cell.contains(char::is_alphabetic)
}

fn head(dialect: Dialect, cell: &str) -> Option<Band<'_>> {
    let plain = |wavelength, unit| Band { prefix: "", suffix: "", wavelength, unit };
    match dialect.parse(cell) {
        Cell::Number(wavelength) => Some(plain(wavelength, None)),
        Cell::Gap => None,
        Cell::Text if !has_letter(cell) => None,
        Cell::Text => {
            let label = dialect.parse_label(cell).map(|(wavelength, unit)| plain(wavelength, Some(unit)));
            label.or_else(|| band(dialect, cell))
        }
    }
}

fn group(run: &[(usize, Band<'_>)], wrong: usize, stated: Option<WavelengthUnit>) -> Option<Group> {
    /// Sound wavelengths for each that is out of order; more of those are values.
    const SOUND: usize = 5;
    const LEAST_RANGE: f64 = 150.0;
    const MOST_MICROMETERS: f64 = 25.0;
    let ((start, first), (end, _)) = (run.first().filter(|_| run.len() >= FEWEST)?, run.last()?);
    let values = || run.iter().map(|(_, band)| band.wavelength);
    let (min, max) = extent(values());
    // Fractions may be micrometers or values: without a word only those in order are the former, and that is a guess.
    let bare = first.prefix.is_empty() && first.unit.or(stated).is_none() && max <= MOST_MICROMETERS;
    if bare && wrong > 0 {
        return None;
    }
    // Some of those with a known unit may be out of range.
    let in_range = first.unit.or(stated).is_some_and(|unit| {
        let (a, b) = (unit.nanometers(min), unit.nanometers(max));
        a.max(b) > *RANGE_NM.start() && a.min(b) < *RANGE_NM.end()
    });
    let many = run.len() > FEWEST_UNSAID && first.prefix.is_empty() && first.suffix.is_empty();
    let mostly = || SOUND * values().filter(|nm| !RANGE_NM.contains(nm)).count() < run.len();
    let in_range = in_range || many && wrong == 0 && min > 0.0 && mostly();
    if !in_range && !plausible(min, max, values().any(|w| w.fract() != 0.0)) || run.len() < SOUND * wrong {
        return None;
    }
    let said = || first.unit.is_some() || header_terms::role_of_bands(first.suffix).is_some();
    if first.prefix.is_empty() && !first.suffix.is_empty() && run.len() < FEWEST_UNSAID && !said() {
        return None;
    }
    // What a letter may count as well, such as patches or bands, counts by ones.
    let counted = values().zip(values().skip(1)).all(|(a, b)| b - a == 1.0) && max - min < LEAST_RANGE;
    let letter = is_one(first.prefix.trim_end_matches(['_', '.', ' ']).to_lowercase().as_str(), "a|b|l|band");
    let known = first.is_known() || first.prefix.is_empty() && !bare;
    if counted && first.unit.is_none() && (letter || !known) {
        return None;
    }
    let years = counted && first.prefix.is_empty() && first.unit.or(stated).is_none() && min >= 1900.0 && max <= 2100.0;
    let frequencies = is_one(&first.prefix.to_lowercase(), "f|freq|oae") && first.unit.is_none();
    if years || frequencies {
        return None;
    }
    let from_start = first.wavelength <= 1.0 && values().zip(values().skip(1)).all(|(a, b)| b - a == 1.0);
    if from_start && first.unit.is_none() {
        return None;
    }
    let mut wavelengths = vec![f64::NAN; end + 1 - start];
    for (column, band) in run {
        wavelengths[column - start] = band.wavelength;
    }
    let (prefix, suffix) = (first.prefix.to_owned(), first.suffix.to_owned());
    Some(Group { start: *start, wavelengths, unit: first.unit, prefix, suffix, known })
}
