//! From what is written to plain numbers.

use crate::grid::{Grid, RawCurve};
use crate::report::Certainty;
use crate::role::{Role, Values};
use crate::scale::decision::Scale;
use crate::{decimal, header_terms, unit_text};

/// Makes plain numbers of what is written.
pub(crate) fn convert(grid: &mut Grid, scale: &Scale) {
    let plain_by_choice = scale.values.certainty == Certainty::Chosen && scale.values.value == Values::Plain;
    for (curve, &values) in grid.curves.iter_mut().zip(&scale.columns) {
        if values == Values::Plain {
            let denied = |unit: &String| header_terms::values(unit).is_some_and(|said| said != Values::Plain);
            curve.unit = curve.unit.take().filter(|unit| !(plain_by_choice && denied(unit)));
            continue;
        }
        relabel(curve, values, scale.role.value);
        let plain = |value: f64| match values {
            Values::Plain => value,
            Values::Percent => decimal::shifted(value, -2),
            Values::Absorbance => 10_f64.powf(-value),
            Values::Decibels => 10_f64.powf(value / 10.0),
        };
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
            let name =
                replaced(&curve.name, |word| (word == "abs" || word.starts_with("absorban")).then_some(fraction));
            name.trim_end_matches('.').to_owned()
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
