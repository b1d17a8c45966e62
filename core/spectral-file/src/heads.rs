//! Heads of the columns in the program's own tables, such as `leaf [reflectance factor in 1]` and, behind it, `leaf [expanded uncertainty
//! (k=2) in 1]`, so that a table says what it holds without a line above it.

use crate::decision::{Quantity, Role, Values};
use crate::header::Header;
use crate::header_terms::UNSPECIFIED;

const QUANTITIES: [(&str, Quantity); 13] = [
    ("relative spectral sensitivity", Quantity::Sensitivity),
    ("spectral sensitivity", Quantity::Sensitivity),
    ("color matching functions", Quantity::Sensitivity),
    ("reflectance factor", Quantity::Reflectance),
    ("transmittance", Quantity::Transmittance),
    ("relative spectral power", Quantity::SpectralPower),
    ("spectral power", Quantity::SpectralPower),
    ("spectral irradiance", Quantity::Irradiance),
    ("spectral radiance", Quantity::Radiance),
    ("spectral flux", Quantity::RadiantFlux),
    ("radiant intensity", Quantity::RadiantIntensity),
    ("counts", Quantity::Counts),
    (UNSPECIFIED, Quantity::Unknown),
];

pub(super) fn quantity_of_light(quantity: Quantity) -> &'static str {
    let mut named = QUANTITIES.iter().filter(|(_, known)| *known == quantity && quantity != Quantity::SpectralPower);
    named.next().map_or("spectral power", |(name, _)| name)
}

pub(super) fn of_curve(quantity: &str, per_photon: Option<bool>, unit: Option<&str>) -> String {
    head(quantity, per_photon.map_or("", |photon| if photon { " per photon" } else { " per energy" }), unit)
}

pub(super) fn of_uncertainty(coverage: f64, unit: Option<&str>) -> String {
    let kind = if coverage == 1.0 { "standard" } else { "expanded" };
    head(kind, &format!("{UNCERTAINTY}{coverage})"), unit)
}

const UNCERTAINTY: &str = " uncertainty (k=";

fn head(what: &str, how: &str, unit: Option<&str>) -> String {
    format!(" [{what}{how}{}]", unit.map_or(String::new(), |unit| format!(" in {unit}")))
}

/// The coverage factor in the head of uncertainties.
fn coverage(said: &str) -> Option<f64> {
    let k = said.strip_suffix(')')?.rsplit_once(UNCERTAINTY)?.1.parse().ok();
    k.filter(|k: &f64| k.is_finite() && *k > 0.0)
}

fn split(tail: &str) -> (&str, Option<&str>) {
    tail.split_once(" in ").map_or((tail, None), |(said, unit)| (said, Some(unit)))
}

/// Takes quantity, scale, unit and response from names that all end alike in such a bracket, but for those of uncertainties behind
/// their curves, and leaves the names.
pub(super) fn take(header: &mut Header) {
    let names = header.names.get(1..).unwrap_or_default();
    let heads = names.iter().map(|name| name.strip_suffix(']')?.rsplit_once(" ["));
    let (Some(line), Some(heads)) = (header.line, heads.collect::<Option<Vec<_>>>()) else { return };
    let Some(&(_, tail)) = heads.first() else { return };
    let (said, unit) = split(tail);
    let factor = |&(_, other): &(&str, &str)| {
        Some(split(other)).filter(|(_, own)| *own == unit).and_then(|(said, _)| coverage(said))
    };
    let own: Vec<Option<f64>> = heads.iter().map(factor).collect();
    let is_known = |at: usize| match own[at] {
        None => heads[at].1 == tail,
        Some(_) => at > 0 && own[at - 1].is_none() && heads[at - 1].0 == heads[at].0,
    };
    let mut responses = ["per photon", "per energy"].into_iter();
    let response = responses.find_map(|response| Some((said.strip_suffix(response)?.trim_end(), response)));
    let name = response.map_or(said, |(name, _)| name);
    let Some((_, quantity)) = QUANTITIES.iter().find(|(known, _)| *known == name) else { return };
    let role = quantity.role().unwrap_or(Role::Unknown);
    // Without a unit nothing says that fractions are no percent: such a bracket is another program's.
    if role.is_fraction() && unit.is_none() || !(0..own.len()).all(is_known) {
        return;
    }
    let bare: Vec<String> = heads.iter().map(|(bare, _)| (*bare).to_owned()).collect();
    let (unit, response) = (unit.map(str::to_owned), response.map(|(_, response)| response));
    if let Some(response) = response.filter(|_| header.comment("response").is_none()) {
        header.note(line, "response", response);
    }
    header.values = unit.as_ref().filter(|unit| *unit == "1").map(|_| (line, Values::Plain)).or(header.values);
    (header.role, header.quantity) = (Some((line, role)), Some((line, *quantity)));
    header.unit = unit.filter(|unit| unit != "1").or(header.unit.take());
    header.names.truncate(1);
    header.names.extend(bare);
    header.own = own;
}
