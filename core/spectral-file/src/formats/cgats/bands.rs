//! Spectral fields and their wavelengths.

use crate::decimal::clean;
use crate::decision::{Decided, Decision};

/// Bands that keywords declare, in nanometers.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Declared {
    pub(super) bands: Option<f64>,
    pub(super) start: Option<f64>,
    pub(super) end: Option<f64>,
}

#[derive(Debug)]
pub(super) struct Bands {
    pub(super) wavelengths: Vec<f64>,
    /// True if the name of the fields states percent.
    pub(super) percent: bool,
    kinds: Vec<Kind>,
    why: String,
    pub(super) in_rows: bool,
}

#[derive(Debug, Clone, Copy, PartialEq)]
enum Kind {
    Other,
    Wavelength,
    Value,
}

/// Prefixes of the wavelength in the name of a spectral field, in capitals.
const PREFIXES: [&str; 6] = ["SPECTRAL_NM", "SPECTRAL_", "SPEC_", "NM", "R_", "S_"];

impl Bands {
    /// The spectral fields among the fields of a table, if there are any.
    pub(super) fn of(fields: &[String], declared: Declared) -> Option<Self> {
        let named: Vec<Option<f64>> = fields.iter().map(|field| wavelength(field)).collect();
        let names: Vec<f64> = named.iter().flatten().copied().collect();
        if names.len() < 2 {
            return Self::pairs(fields);
        }
        let kinds = named.iter().map(|named| if named.is_some() { Kind::Value } else { Kind::Other }).collect();
        let (wavelengths, why) = match from_keywords(&names, declared) {
            Some(exact) => (exact, "Keywords give first, last and number of bands".to_owned()),
            None => (names, "The names of the fields give them".to_owned()),
        };
        Some(Self { wavelengths, percent: false, kinds, why, in_rows: false })
    }

    fn pairs(fields: &[String]) -> Option<Self> {
        let mut kinds = vec![Kind::Other; fields.len()];
        let mut percent = false;
        for at in 1..fields.len() {
            let value = fields[at].to_ascii_uppercase();
            if fields[at - 1].eq_ignore_ascii_case("SPECTRAL_NM")
                && matches!(value.as_str(), "SPECTRAL_PCT" | "SPECTRAL_DEC")
            {
                kinds[at - 1] = Kind::Wavelength;
                kinds[at] = Kind::Value;
                percent = value == "SPECTRAL_PCT";
            }
        }
        let why = "Each value has its wavelength beside it".to_owned();
        kinds.contains(&Kind::Value).then_some(Self { wavelengths: Vec::new(), percent, kinds, why, in_rows: true })
    }

    pub(super) fn count(&self) -> usize {
        self.kinds.iter().filter(|kind| **kind == Kind::Value).count()
    }

    pub(super) fn is_value(&self, field: usize) -> bool {
        self.kinds.get(field) == Some(&Kind::Value)
    }

    pub(super) fn is_wavelength(&self, field: usize) -> bool {
        self.kinds.get(field) == Some(&Kind::Wavelength)
    }

    /// Processes the wavelengths in a row; all rows must have the same.
    pub(super) fn agrees(&mut self, row: Vec<f64>) -> bool {
        if !self.in_rows {
            return true;
        }
        if self.wavelengths.is_empty() && row.iter().all(|wavelength| wavelength.is_finite()) {
            self.wavelengths = row;
            return true;
        }
        self.wavelengths == row
    }

    pub(super) fn decision(&self) -> Decision {
        let value = match (self.wavelengths.first(), self.wavelengths.last()) {
            (Some(first), Some(last)) => format!("{} from {first} to {last} nm", self.wavelengths.len()),
            _ => "none".to_owned(),
        };
        Decision::new("Bands", &Decided::certain(value, self.why.clone()))
    }
}

/// The digits that the name of a spectral field ends with.
pub(super) fn digits(field: &str) -> &str {
    let number = |c: char| c.is_ascii_digit() || c == '.';
    &field[field.len() - field.chars().rev().take_while(|c| number(*c)).count()..]
}

fn wavelength(field: &str) -> Option<f64> {
    const PLAUSIBLE: std::ops::RangeInclusive<f64> = 100.0..=20_000.0;
    if field.len() > 32 || !field.is_ascii() {
        return None;
    }
    let upper = field.to_ascii_uppercase();
    let number = PREFIXES.iter().find_map(|prefix| upper.strip_prefix(prefix))?.trim_start_matches('_');
    if !number.starts_with(|c: char| c.is_ascii_digit()) {
        return None;
    }
    number.parse().ok().filter(|number| PLAUSIBLE.contains(number))
}

/// The wavelengths that keywords give. The names of the fields are rounded where the step is no whole number, so they
/// only have to agree with them.
fn from_keywords(names: &[f64], declared: Declared) -> Option<Vec<f64>> {
    const ROUNDING: f64 = 1.0;
    let Declared { bands: Some(bands), start: Some(start), end: Some(end) } = declared else { return None };
    if bands != names.len() as f64 {
        return None;
    }
    let step = (end - start) / (bands - 1.0);
    let exact: Vec<f64> = (0..names.len()).map(|i| clean(start + step * i as f64)).collect();
    exact.iter().zip(names).all(|(exact, name)| (exact - name).abs() <= ROUNDING).then_some(exact)
}
