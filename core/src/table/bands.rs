//! Wavelengths in the names of columns: `SCI 360nm`, `SPEC_380`, `R380`, `nm400`, `380 nm [%]`.

use super::dialect::{Cell, Dialect};
use super::wavelengths::{WavelengthUnit, plausible};
use super::words;

/// The fewest bands that are taken for a spectrum.
const FEWEST: usize = 5;

/// What one name holds.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Band<'a> {
    /// What stands before the wavelength, and what stands behind it and its unit.
    prefix: &'a str,
    suffix: &'a str,
    pub(super) wavelength: f64,
    pub(super) unit: Option<WavelengthUnit>,
}

impl Band<'_> {
    fn goes_with(&self, other: &Self) -> bool {
        (self.prefix, self.suffix, self.unit) == (other.prefix, other.suffix, other.unit)
    }
}

/// Bands side by side whose names differ in nothing but the wavelength.
#[derive(Debug, Clone, Default)]
pub(super) struct Group {
    /// The first column, from 0, and how many there are.
    pub(super) start: usize,
    pub(super) count: usize,
    /// What stands before and behind the wavelengths.
    pub(super) prefix: String,
    pub(super) suffix: String,
}

/// The wavelength in the name of a column.
pub(super) fn band(dialect: Dialect, name: &str) -> Option<Band<'_>> {
    const LONGEST: usize = 64;
    let digit = |c: char| c.is_ascii_digit();
    if name.len() > LONGEST || !name.contains(digit) {
        return None;
    }
    let mut found: Option<Band<'_>> = None;
    let mut from = 0;
    while let Some(start) = name[from..].find(digit).map(|at| from + at) {
        let in_number = |c: char| c.is_ascii_digit() || matches!(c, '.' | ',');
        let end = name[start..].find(|c| !in_number(c)).map_or(name.len(), |at| start + at);
        let end = start + name[start..end].trim_end_matches(['.', ',']).len();
        from = end;
        let Cell::Number(wavelength) = dialect.parse(&name[start..end]) else { continue };
        let (unit, suffix) = unit(&name[end..]);
        let prefix = name[..start].trim();
        let before = prefix.to_ascii_lowercase().ends_with("nm").then_some(WavelengthUnit::Nanometer);
        let one = Band { prefix, suffix, wavelength, unit: unit.or(before) };
        // A number with a unit, else the last.
        if found.is_none_or(|found| found.unit.is_none()) {
            found = Some(one);
        }
    }
    found.filter(|band| band.unit.is_some() || is_band_prefix(band.prefix))
}

/// The unit that a text begins with, and what follows it.
fn unit(text: &str) -> (Option<WavelengthUnit>, &str) {
    let rest = text.trim_start().trim_start_matches(['[', '(', '_']).trim_start();
    let end = rest.find(|c: char| !(c.is_alphabetic() || c == '/' || c == '-' || c == '1')).unwrap_or(rest.len());
    match WavelengthUnit::from_symbol(&rest[..end]) {
        Some(unit) => (Some(unit), rest[end..].trim_start_matches([']', ')']).trim()),
        None => (None, text.trim()),
    }
}

/// Whether a text before a number without unit makes it a wavelength, and no name of a sample.
fn is_band_prefix(prefix: &str) -> bool {
    const WHOLE: [&str; 14] =
        ["r", "t", "s", "x", "w", "wl", "refl", "ref", "trans", "sci", "sce", "lambda", "λ", "%r"];
    let lower = prefix.to_lowercase();
    let bare = lower.trim_end_matches(|c: char| !c.is_alphanumeric());
    WHOLE.contains(&bare) || bare.contains("spec") || bare.contains("wavelength") || bare.contains("reflectance")
}

/// The groups of bands in a line of names.
pub(super) fn groups(dialect: Dialect, line: &str) -> Vec<Group> {
    let mut all = Vec::new();
    let mut run: Vec<Band<'_>> = Vec::new();
    for (column, cell) in dialect.cells(line).enumerate() {
        let band = band(dialect, cell);
        let goes_on = |band: &Band<'_>| {
            let Some(last) = run.last().filter(|last| last.goes_with(band)) else { return false };
            let rises = run.len() < 2 || run[1].wavelength > run[0].wavelength;
            band.wavelength != last.wavelength && (run.len() < 2 || (band.wavelength > last.wavelength) == rises)
        };
        if !band.as_ref().is_some_and(goes_on) {
            all.extend(group(&run, column));
            run.clear();
            // A table that names the column of its wavelengths has them there.
            if all.is_empty() && band.is_none() && words::names_wavelengths(cell) {
                return Vec::new();
            }
        }
        run.extend(band);
    }
    let columns = dialect.cells(line).count();
    all.extend(group(&run, columns));
    all
}

fn group(run: &[Band<'_>], end: usize) -> Option<Group> {
    let first = run.first().filter(|_| run.len() >= FEWEST)?;
    let wavelengths = || run.iter().map(|band| band.wavelength);
    let (min, max) = (wavelengths().fold(f64::INFINITY, f64::min), wavelengths().fold(f64::NEG_INFINITY, f64::max));
    plausible(min, max, wavelengths().any(|w| w.fract() != 0.0)).then(|| Group {
        start: end - run.len(),
        count: run.len(),
        prefix: first.prefix.to_owned(),
        suffix: first.suffix.to_owned(),
    })
}
