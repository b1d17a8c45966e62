//! Physical quantity of the values of a table, and their unit.
//!
//! Lights counted in photons, or given per frequency, wave number or electronvolt: converted to energy per nanometer.
//!
//! A photon of wavelength λ carries the energy h c/λ; a density over another variable changes by the derivative of that
//! variable with respect to λ (CIE S 017, "spectral concentration").
//!
//! ```text
//! E_λ = N_λ · h c / λ                          N_λ in photons
//! E_λ = n_λ · N_A h c / λ                      n_λ in moles of photons (1 µmol = 1 µE)
//! E_λ = E_ν · |dν/dλ| = E_ν · c / λ²           per frequency ν = c/λ
//! E_λ = E_σ · |dσ/dλ| = E_σ · 10⁷ nm cm⁻¹/λ²   per wave number σ = 10⁷ nm cm⁻¹/λ
//! E_λ = E_eV · |dE/dλ| = E_eV · h c/(e λ²)    per energy of a photon E = h c/(e λ)
//! E_λ = E_µm / 1000,  E_λ = 10 E_Å             per another length
//! ```
//!
//! h = 6.626 070 15e-34 J s, c = 299 792 458 m/s and `N_A` = 6.022 140 76e23 /mol are exact (SI 2019). Wavelengths are taken as those
//! in vacuum; of those in air the photons' energies are 0.03 % too high. Where nothing but "photons" is said, the scale is
//! relative, and values are kept at 550 nm.

use crate::decision::{Certainty, Decided, Decision, Effect, Quantity, Role, Values, WavelengthUnit};
use crate::grid::{Grid, RawCurve};
use crate::options::ReadOptions;
use crate::text::{excerpt, has_part, is_one};
use crate::unit_text::{is_per_energy, is_per_photon, is_photons, names_photons, says_per_photon};
use crate::units::{self, Amount, PLANCK_LIGHT_EV_NM, PLANCK_LIGHT_J_NM, Per, SPEED_OF_LIGHT_NM_THZ};
use crate::warning::Warning;
use crate::watch::Log;
use crate::{decimal, header_terms};

/// The wavelength in nanometers where relative photons and relative energies have the same value.
const SAME_AT_NM: f64 = 550.0;

#[derive(Debug, Clone)]
struct Conversion {
    /// Photons for each unit of the values; infinite for a relative scale of photons; none for energies.
    photons: Option<f64>,
    per: Per,
    ten: f64,
    /// The size of the energy in the unit of the result, as of an erg in joules.
    size: f64,
    unit: Option<String>,
    why: String,
}

impl Conversion {
    fn of_unit(text: &str, why: String) -> Option<Self> {
        let unit = units::parse(text)?;
        let photons = match unit.amount {
            Amount::Photons(count) => Some(count),
            Amount::Energy(_) => None,
        };
        let per = unit.per;
        let needed = photons.is_some() || unit.size != 1.0 || !matches!(per, Per::None | Per::Nanometer);
        needed.then(|| Self { photons, per, ten: unit.ten, size: unit.size, unit: Some(unit.in_energy_per_nm()), why })
    }

    fn relative(why: String) -> Self {
        Self { photons: Some(f64::INFINITY), per: Per::None, ten: 1.0, size: 1.0, unit: None, why }
    }

    /// A value at a wavelength in nanometers as energy per nanometer. Powers of ten keep its digits.
    fn apply(&self, value: f64, nm: f64) -> f64 {
        match (self.photons, self.per) {
            (None, Per::Length(length_nm)) if self.ten == 1.0 && self.size == 1.0 => decimal::divided(value, length_nm),
            _ => value * self.factor(nm),
        }
    }

    fn factor(&self, nm: f64) -> f64 {
        let energy = match self.photons {
            Some(count) if count.is_finite() => count * PLANCK_LIGHT_J_NM / nm,
            Some(_) => SAME_AT_NM / nm,
            None => 1.0,
        };
        let density = match self.per {
            Per::None | Per::Nanometer => 1.0,
            Per::Length(length_nm) => 1.0 / length_nm,
            Per::Frequency(thz) => SPEED_OF_LIGHT_NM_THZ / thz / (nm * nm),
            Per::Wavenumber => 1e7 / (nm * nm),
            Per::Electronvolt => PLANCK_LIGHT_EV_NM / (nm * nm),
        };
        energy * density * self.ten * self.size
    }

    fn description(&self) -> String {
        let amount = match self.photons {
            Some(count) if !count.is_finite() => Some(("photons on a relative scale", "550 nm/λ".to_owned())),
            Some(count) if count > 1e6 => Some(("moles of photons", "N_A h c/λ".to_owned())),
            Some(_) => Some(("photons", "h c/λ".to_owned())),
            None if self.size > 1e-10 && self.size != 1.0 => Some(("ergs", "10⁻⁷ J".to_owned())),
            None if self.size != 1.0 => Some(("janskys", format!("{:e} W/m²/Hz", self.size))),
            None => None,
        };
        let density = match self.per {
            Per::None | Per::Nanometer => None,
            Per::Length(length_nm) => Some(("per another length", format!("1/{length_nm}"))),
            Per::Frequency(_) => Some(("per frequency", "c/λ²".to_owned())),
            Per::Wavenumber => Some(("per wave number", "10⁷/λ²".to_owned())),
            Per::Electronvolt => Some(("per electronvolt", "h c/(e λ²)".to_owned())),
        };
        let (what, by): (Vec<&str>, Vec<String>) = [amount, density].into_iter().flatten().unzip();
        format!("{}, converted to energy per nanometer by {}", what.join(" "), by.join(" and "))
    }
}

/// The quantity of a light that is measured on an area, into a solid angle, or neither.
fn of_light(area: bool, steradian: bool) -> Quantity {
    match (area, steradian) {
        (true, true) => Quantity::Radiance,
        (true, false) => Quantity::Irradiance,
        (false, true) => Quantity::RadiantIntensity,
        (false, false) => Quantity::RadiantFlux,
    }
}

/// Decision on responses per photon or per energy, as far as the file states it.
fn response(grid: &Grid) -> Option<Decided<bool>> {
    let of_curve = |curve: &RawCurve| {
        let unit = curve.unit.as_deref().unwrap_or_default();
        let by_unit = || format!("The unit is {unit}");
        if is_per_photon(unit) || is_photons(unit) {
            Some((true, by_unit()))
        } else if says_per_photon(&curve.label) {
            Some((true, format!("A column is headed “{}”", excerpt(&curve.label))))
        } else {
            is_per_energy(unit).then(|| (false, by_unit()))
        }
    };
    if let Some((photon, why)) = grid.curves.iter().find_map(of_curve) {
        let all = grid.curves.iter().all(|curve| of_curve(curve).is_some_and(|(other, _)| other == photon));
        return Some(if all { Decided::certain(photon, why) } else { Decided::guess(photon, why) });
    }
    let line = grid.header.per_photon.or(grid.header.photons)?;
    Some(Decided::certain(true, format!("Line {line} says so")))
}

/// Conversion of a curve, by its own header or by a line about all.
fn of_curve(grid: &Grid, curve: &RawCurve) -> Option<Conversion> {
    if let Some(unit) = curve.unit.as_deref().filter(|unit| units::parse(unit).is_some()) {
        return Conversion::of_unit(unit, format!("The unit is {unit}"));
    }
    let headed = || format!("A column is headed “{}”", excerpt(&curve.label));
    if units::parse(&curve.label).is_some() {
        return Conversion::of_unit(&curve.label, headed());
    }
    if curve.label.to_lowercase().contains("s.q.irrad") {
        return Conversion::of_unit("mol/m²/s/nm", headed());
    }
    if names_photons(&curve.label) {
        return Some(Conversion::relative(headed()));
    }
    if let Some(unit) = curve.unit.as_deref().filter(|unit| is_photons(unit)) {
        return Some(Conversion::relative(format!("The unit is {unit}")));
    }
    let line = grid.header.photons.filter(|_| curve.unit.is_none())?;
    Some(Conversion::relative(format!("Line {line} says photons")))
}

/// Converts curves of photons as lights, if no other role is known.
pub(super) fn suggest_role(grid: &mut Grid) {
    if grid.role.is_some() || grid.header.role.is_some() {
        return;
    }
    let found = grid.curves.iter().find_map(|curve| of_curve(grid, curve).map(|found| (found, curve)));
    if let Some((found, curve)) = found.filter(|(found, _)| found.photons.is_some()) {
        let named = names_photons(&curve.label) && header_terms::role(&curve.label).is_none();
        grid.role = Some(if named {
            Decided::certain(Role::Illuminant, found.why)
        } else {
            Decided::guess(Role::Illuminant, found.why)
        });
    }
}

/// Converts lights to energies per nanometer, and reports it. Values that the user declared plain are left as they are.
pub(super) fn to_energy(
    grid: &mut Grid,
    role: Role,
    axis: &Decided<WavelengthUnit>,
    options: &ReadOptions,
) -> Option<Decision> {
    if role != Role::Illuminant || options.values == Some(Values::Plain) {
        return None;
    }
    let found: Vec<Option<Conversion>> = grid.curves.iter().map(|curve| of_curve(grid, curve)).collect();
    let count = found.iter().flatten().count();
    let Some(first) = found.iter().flatten().next() else { return unsaid(grid, axis) };
    let some = if count < found.len() { format!(", in {count} of {} curves", found.len()) } else { String::new() };
    // A power of ten in a unit may be meant either way.
    let certainty = if first.ten == 1.0 { Certainty::Certain } else { Certainty::Guess };
    let decided = Decided { value: format!("{}{some}", first.description()), certainty, why: first.why.clone() };
    let decision = Decision::new(DECISION, &decided).affecting(Effect::Data);
    for (curve, conversion) in grid.curves.iter_mut().zip(&found) {
        let Some(conversion) = conversion else { continue };
        curve.convert_differences(|difference, _, index| conversion.apply(difference, grid.wavelengths[index]));
        for (value, nm) in curve.values.iter_mut().zip(&grid.wavelengths) {
            let converted = conversion.apply(*value, *nm);
            *value = if converted.is_finite() { converted } else { f64::NAN };
        }
        curve.unit.clone_from(&conversion.unit);
        curve.name = renamed(&curve.name);
    }
    Some(decision)
}

pub(super) const DECISION: &str = "Spectral unit";

/// The guess that lights over frequencies or wave numbers are per nanometer, if no unit states otherwise.
fn unsaid(grid: &Grid, axis: &Decided<WavelengthUnit>) -> Option<Decision> {
    let per_nm = |curve: &RawCurve| {
        let unit = curve.unit.as_deref().and_then(units::parse);
        unit.is_some_and(|unit| matches!(unit.per, Per::Nanometer))
    };
    if !axis.value.is_inverse() || grid.curves.iter().all(per_nm) {
        return None;
    }
    let why = format!("The axis is {}, but nothing says per what the power is", axis.value);
    Some(Decision::new(DECISION, &Decided::guess("power per nanometer, taken as it is", why)).affecting(Effect::Data))
}

/// A name that does not say photons, or a unit that the values have no longer.
fn renamed(name: &str) -> String {
    let start = units::parse(name).map_or(name.len(), |unit| unit.start);
    let bare = name[..start].trim_end_matches(['(', '[', ',', ' ', '/', '_']);
    if !names_photons(bare) && !bare.is_empty() {
        return bare.to_owned();
    }
    let kept = bare.split_whitespace().filter_map(|word| {
        let lower = word.trim_matches(|c: char| !c.is_alphanumeric()).to_lowercase();
        match lower.as_str() {
            "photon" | "photons" | "quantum" | "quanta" | "qntm" | "photosynthetic" => None,
            "ppfd" | "pfd" | "spfd" => Some("Irradiance"),
            "s.q.irrad" => Some("s.e.irrad"),
            _ => Some(word),
        }
    });
    let name = kept.collect::<Vec<_>>().join(" ");
    // `Red_PhotonFlux`
    let lower = name.to_ascii_lowercase();
    let joined = ["photonflux", "photon_flux"].iter().find_map(|words| Some((lower.find(words)?, words.len())));
    let name = match joined {
        Some((at, length)) => [&name[..at], &name[at + length..]].concat().trim_matches('_').to_owned(),
        None => name,
    };
    if name.is_empty() || names_photons(&name) {
        return "Spectral power".to_owned();
    }
    let mut letters = name.chars();
    match letters.next().filter(|_| bare.starts_with(char::is_uppercase)) {
        Some(first) => first.to_uppercase().chain(letters).collect(),
        None => name,
    }
}

/// Returns whether a column of such a name would be converted when it is read.
pub(super) fn converts(name: &str) -> bool {
    names_photons(name) || Conversion::of_unit(name, String::new()).is_some()
}

/// The quantity of a grid whose role is decided. A chosen role determines it, whatever the file states.
pub(super) fn decide(grid: &Grid, role: &Decided<Role>, log: &mut Log<'_>) -> Decided<Quantity> {
    let said = said(grid, role);
    let other = |quantity: Quantity| quantity.role().is_some_and(|other| other != role.value);
    let chosen = role.certainty == Certainty::Chosen && role.value != Role::Unknown;
    match said {
        Some(said) if !(chosen && other(said.value)) => return said,
        Some(said) => log.push(Warning::OtherQuantity { quantity: said.value, role: role.value }),
        None => {}
    }
    let quantity = match role.value {
        Role::Camera => Quantity::Sensitivity,
        Role::Reflectance => Quantity::Reflectance,
        Role::Transmittance => Quantity::Transmittance,
        Role::Illuminant => Quantity::SpectralPower,
        Role::Unknown => Quantity::Unknown,
    };
    Decided { value: quantity, certainty: role.certainty, why: format!("The curves are {}", role.value) }
}

fn said(grid: &Grid, role: &Decided<Role>) -> Option<Decided<Quantity>> {
    if let Some(quantity) = &grid.quantity {
        return Some(quantity.clone());
    }
    // A relative scale of sensitivities is one of sensitivities.
    let fits = |quantity: Quantity| quantity != Quantity::Relative || !matches!(role.value, Role::Camera);
    // A sample may be called `radiance paint`.
    let own = |quantity: &Quantity| {
        !role.value.is_fraction() || role.certainty == Certainty::Chosen || quantity.role() != Some(Role::Illuminant)
    };
    // ASD names columns by files, and these by what was meant to be measured.
    let is_file = |label: &str| label.contains(".asd");
    let meant = |quantity: &Quantity, label: &str| !is_file(label) || quantity.role() == Some(role.value);
    let of_label =
        |label: &str| header_terms::quantity(label).filter(|quantity| own(quantity) && meant(quantity, label));
    let labels = grid.curves.iter().map(|curve| &curve.label);
    let mut labeled = labels.filter_map(|label| Some((of_label(label)?, label)));
    let decide = |all: bool| if all { Decided::certain } else { Decided::guess };
    if let Some((quantity, label)) = labeled.next().filter(|(quantity, _)| fits(*quantity)) {
        let all = labeled.filter(|(other, _)| *other == quantity).count() + 1 == grid.curves.len() && !is_file(label);
        return Some(decide(all)(quantity, format!("A column is headed “{}”", excerpt(label))));
    }
    if let Some((line, quantity)) = grid.header.quantity.filter(|(_, quantity)| fits(*quantity)) {
        return Some(Decided::certain(quantity, format!("Line {line} says so")));
    }
    let unit = grid.curves.iter().find_map(|curve| curve.unit.as_deref());
    let (unit, quantity) = unit.and_then(|unit| Some((unit, of_unit(unit).filter(|unit| fits(*unit))?)))?;
    let all = grid.curves.iter().all(|curve| curve.unit.is_some());
    Some(decide(all)(quantity, format!("The unit is {unit}")))
}

/// Returns whether sensitivities are responses per photon. Quantum efficiencies are, by their definition.
pub(super) fn per_photon(grid: &Grid, role: Role, quantity: &Decided<Quantity>) -> Option<Decided<bool>> {
    if role != Role::Camera {
        return None;
    }
    let said = grid.header.comment("response").map(|response| response.trim().to_lowercase()).unwrap_or_default();
    for (words, per_photon) in [("per photon", true), ("per energy", false)] {
        match said.strip_prefix(words) {
            Some("" | " (stated)") => return Some(Decided::certain(per_photon, "The comment “response” says so")),
            Some(" (inferred)") => return Some(Decided::guess(per_photon, "The comment “response” says: inferred")),
            _ => {}
        }
    }
    if let Some(said) = response(grid) {
        return Some(said);
    }
    Some(if quantity.value == Quantity::QuantumEfficiency {
        Decided::certain(true, "Quantum efficiencies are counted per photon")
    } else if grid.header.clues.quantum {
        Decided::guess(true, "The file is named after a quantum efficiency")
    } else {
        Decided::guess(false, "Nothing says that they are per photon")
    })
}

pub(super) fn of_unit(unit: &str) -> Option<Quantity> {
    const LONGEST: usize = 40;
    if unit.len() > LONGEST {
        return None;
    }
    if is_per_photon(unit) {
        return Some(Quantity::QuantumEfficiency);
    }
    if let Some(unit) = units::parse(unit) {
        return Some(of_light(unit.area.is_some(), unit.angle.is_some()));
    }
    let lower: String = unit.to_lowercase().chars().filter(|c| !matches!(c, ' ' | '^' | '·' | '*' | '-')).collect();
    let lower = lower.replace("watt", "w").replace('²', "2");
    let power = has_part(&lower, "w/|w.|wm|wcm|mol/|photons/|j/") && !lower.contains("mol/mol");
    match () {
        () if power => Some(of_light(has_part(&lower, "m2|m²"), lower.contains("sr"))),
        () if is_one(&lower, "w|mw|µw|μw|uw|nw") => Some(Quantity::RadiantFlux),
        () if header_terms::says_counts(&lower) => Some(Quantity::Counts),
        () => is_one(&lower, "relative|rel.").then_some(Quantity::Relative),
    }
}
