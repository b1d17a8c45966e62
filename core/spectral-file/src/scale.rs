//! Role of the curves and scale of their values.
//!
//! `role` decides the role of the curves: as stated in the file, else as suggested by its settings, else by the numbers. `values`
//! decides for each curve the meaning of its numbers, by the header, else by its own numbers. [`convert`] makes plain numbers of
//! them, and [`warn`] warns of invalid ones. If nothing decides between scales that differ by a factor, the decision is
//! [`Certainty::Open`] and the numbers stay as written.

mod role;
mod values;

pub(super) use role::camera_columns;

use std::f64::consts::LN_10;

use crate::decision::{Certainty, Decided, Role, Values};
use crate::grid::{Grid, RawCurve};
use crate::options::ReadOptions;
use crate::scale::values::VISIBLE_NM;
use crate::warning::Warning;
use crate::watch::Log;
use crate::{decimal, header_terms, unit_text};

/// Decides what the curves are and what the values of each stand for.
pub(super) fn decide(grid: &Grid, options: &ReadOptions, log: &mut Log<'_>) -> Scale {
    let evidence = values::Evidence::of(grid);
    let said = role::said(grid, options.values.filter(|_| options.role.is_none()));
    let from_file = said.is_some();
    let content = said.unwrap_or_else(|| role::suggested(grid, &evidence));
    let logarithms = || role::of_logarithms(grid).filter(|_| content.value != Role::Unknown);
    let content = logarithms().unwrap_or(content);
    let role = Decided::or_chosen(options.role, || content.clone());
    let (values, columns) = values::decide(grid, options, &role, from_file, &evidence, log);
    Scale { role, content, values, columns }
}

/// Coefficients of absorption are called absorbances, too, but no instrument measures such large ones: their heads say nothing.
pub(super) fn doubt_absorbances(grid: &mut Grid) {
    const MOST: f64 = 100.0;
    for curve in &mut grid.curves {
        let is_large = || curve.values.iter().any(|value| *value > MOST);
        if header_terms::values(&curve.label) == Some(Values::Absorbance) && is_large() {
            curve.label.clear();
        }
    }
}

#[derive(Debug)]
pub(super) struct Scale {
    pub(super) role: Decided<Role>,
    /// The role by content and surroundings, where another was chosen.
    pub(super) content: Decided<Role>,
    pub(super) values: Decided<Values>,
    /// Those of each curve.
    pub(super) columns: Vec<Values>,
}

impl Scale {
    /// Returns whether values above a thousand are out of question: percent, and fractions of light.
    pub(super) fn denies_thousands(&self) -> bool {
        let sure = |certainty| matches!(certainty, Certainty::Certain | Certainty::Chosen);
        (self.values.value == Values::Percent && sure(self.values.certainty))
            || (self.role.value.is_fraction() && sure(self.role.certainty))
    }
}

pub(super) fn convert(grid: &mut Grid, scale: &Scale) {
    // A title is the name of a sample, whatever it says.
    let title = grid.header.comment("title").map(str::to_owned);
    let plain_by_choice = scale.values.certainty == Certainty::Chosen && scale.values.value == Values::Plain;
    for (curve, &values) in grid.curves.iter_mut().zip(&scale.columns) {
        if values == Values::Plain {
            let denied = |unit: &String| header_terms::values(unit).is_some_and(|said| said != Values::Plain);
            curve.unit = curve.unit.take().filter(|unit| !(plain_by_choice && denied(unit)));
            continue;
        }
        let name = Some(&curve.name).filter(|name| curve.label.is_empty() && title.as_ref() == Some(*name)).cloned();
        relabel(curve, values, scale.role.value);
        curve.name = name.unwrap_or_else(|| std::mem::take(&mut curve.name));
        let plain = |value: f64| match values {
            Values::Plain => value,
            Values::Percent => decimal::shifted(value, -2),
            Values::Absorbance => 10_f64.powf(-value),
            Values::Decibels => 10_f64.powf(value / 10.0),
        };
        curve.convert_differences(|difference, value, _| match values {
            Values::Plain => difference,
            Values::Percent => decimal::shifted(difference, -2),
            Values::Absorbance => -difference * LN_10 * plain(value),
            Values::Decibels => difference * LN_10 / 10.0 * plain(value),
        });
        // A value outside the range of doubles is a gap.
        let finite = |value: f64| if value.is_finite() { value } else { f64::NAN };
        curve.values.iter_mut().for_each(|value| *value = finite(plain(*value)));
    }
}

/// Gives a curve the unit that its converted values have, and a name that does not say what they were.
fn relabel(curve: &mut RawCurve, values: Values, role: Role) {
    let fraction = if role == Role::Reflectance { "Reflectance" } else { "Transmittance" };
    let renamed = match values {
        // Percent are so common that written files omit the conversion, but the user sees it.
        Values::Plain | Values::Percent => return,
        Values::Absorbance => {
            curve.unit = Some("1".to_owned());
            let by = |word: &str| (word == "abs" || word.starts_with("absorban")).then_some(fraction);
            // `bxw2Absorbance` is two words.
            let (before, word) = curve.name.split_at(curve.name.find("Absorban").unwrap_or(0));
            let blank = if before.ends_with(char::is_alphanumeric) { " " } else { "" };
            replaced(&format!("{before}{blank}{word}"), by).trim_end_matches('.').to_owned()
        }
        Values::Decibels => {
            // Decibels are powers above a milliwatt, or ratios.
            let word = |ratio| {
                move |word: &str| match word {
                    "dbm" => Some("mW"),
                    "db" => Some(ratio),
                    _ => None,
                }
            };
            let milliwatts = || curve.label.to_lowercase().contains("dbm").then_some("dBm");
            curve.unit = curve.unit.as_deref().or_else(milliwatts).map(|unit| replaced(unit, word("1")));
            replaced(&curve.name, word(""))
        }
    };
    let misleads = renamed.is_empty() || header_terms::values(&renamed).is_some_and(|said| said != Values::Plain);
    let whole = if role.is_fraction() { fraction } else { "Power" };
    curve.name = if misleads { whole.to_owned() } else { renamed };
}

/// A text with some of its words, given in lower case, replaced, and without what blanks and brackets that leaves.
fn replaced<'a>(text: &str, by: impl Fn(&str) -> Option<&'a str>) -> String {
    let mut out = String::with_capacity(text.len());
    for piece in text.split_inclusive(|c: char| !c.is_alphanumeric()) {
        let word = piece.trim_end_matches(|c: char| !c.is_alphanumeric());
        out.push_str(by(&word.to_lowercase()).unwrap_or(word));
        out.push_str(&piece[word.len()..]);
    }
    unit_text::tidy(&out)
}

/// Warns of reflectances that cannot be, and of values further below zero than noise, also of lights.
pub(super) fn warn(scale: &Scale, grid: &Grid, log: &mut Log<'_>) {
    const LARGEST_FRACTION: f64 = 2.0;
    // Photons on a square meter in a second and a nanometer stay below 1e22.
    const LARGEST: f64 = 1e30;
    const NOISE: f64 = 0.05;
    let role = scale.role.value;
    let light = role == Role::Illuminant;
    // Of an unknown kind, what has no value above zero: logarithms.
    let unknown = role == Role::Unknown;
    // Outside, instruments are noisy.
    let all = unknown || !light && !grid.wavelengths.iter().any(|w| VISIBLE_NM.contains(w));
    let (mut bright, mut below) = (0, 0);
    let (mut first_bright, mut first_below) = (None, None);
    for curve in &grid.curves {
        let mut lowest = (f64::INFINITY, 0);
        let mut max = f64::NEG_INFINITY;
        for (at, (w, &value)) in grid.wavelengths.iter().zip(&curve.values).enumerate() {
            if (all || VISIBLE_NM.contains(w)) && !value.is_nan() {
                max = max.max(value);
                lowest = if value < lowest.0 { (value, at) } else { lowest };
            }
        }
        if (role.is_fraction() && max > LARGEST_FRACTION && !all) || max > LARGEST {
            bright += 1;
            first_bright.get_or_insert((curve, max));
        }
        if lowest.0 < -NOISE * max.max(0.0) && lowest.0 < 0.0 && (!unknown || max <= 0.0 && lowest.0 < -1.0) {
            below += 1;
            first_below.get_or_insert((curve, lowest));
        }
    }
    if let Some((curve, max)) = first_bright {
        log.push(Warning::NotReflectances { count: bright, first: curve.description(), max });
    }
    if let Some((curve, (min, at))) = first_below {
        let line = (grid.lines.len() == grid.wavelengths.len()).then(|| grid.line(at));
        log.push(Warning::BelowZero { count: below, first: curve.description(), min, line });
    }
}
