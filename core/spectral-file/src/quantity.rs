//! Physical quantity of the values of a table, and their unit.

use crate::grid::Grid;
use crate::report::{Certainty, Decided};
use crate::role::{Quantity, Role};
use crate::text::excerpt;
use crate::warning::Warning;
use crate::watch::Log;
use crate::{header_terms, photons};

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

/// The quantity that the file names.
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
    let labels = grid.curves.iter().map(|curve| &curve.label);
    let mut labeled = labels.filter_map(|label| Some((header_terms::quantity(label).filter(own)?, label)));
    let labeled = labeled.next();
    if let Some((quantity, label)) = labeled.filter(|(quantity, _)| fits(*quantity)) {
        return Some(Decided::certain(quantity, format!("A column is headed “{}”", excerpt(label))));
    }
    if let Some((line, quantity)) = grid.header.quantity.filter(|(_, quantity)| fits(*quantity)) {
        return Some(Decided::certain(quantity, format!("Line {line} says so")));
    }
    let unit = grid.curves.iter().find_map(|curve| curve.unit.as_deref());
    let (unit, quantity) = unit.and_then(|unit| Some((unit, of_unit(unit).filter(|unit| fits(*unit))?)))?;
    Some(Decided::certain(quantity, format!("The unit is {unit}")))
}

/// Returns whether sensitivities are responses per photon. Quantum efficiencies are, by their definition.
pub(super) fn per_photon(grid: &Grid, role: Role, quantity: &Decided<Quantity>) -> Option<Decided<bool>> {
    if role != Role::Camera {
        return None;
    }
    let said = grid.header.comment("response").map(|response| response.trim().to_lowercase());
    match said.as_deref() {
        Some("per photon" | "per photon (stated)") => {
            return Some(Decided::certain(true, "The comment “response” says so"));
        }
        Some("per energy" | "per energy (stated)") => {
            return Some(Decided::certain(false, "The comment “response” says so"));
        }
        Some("per photon (inferred)") => return Some(Decided::guess(true, "The comment “response” says: inferred")),
        Some("per energy (inferred)") => return Some(Decided::guess(false, "The comment “response” says: inferred")),
        _ => {}
    }
    if let Some(said) = photons::response(grid) {
        return Some(said);
    }
    Some(if quantity.value == Quantity::QuantumEfficiency {
        Decided::certain(true, "Quantum efficiencies are counted per photon")
    } else {
        Decided::guess(false, "Nothing says that they are per photon")
    })
}

/// The quantity that a unit belongs to.
pub(super) fn of_unit(unit: &str) -> Option<Quantity> {
    const LONGEST: usize = 40;
    if unit.len() > LONGEST {
        return None;
    }
    if let Some(quantity) = photons::quantity(unit) {
        return Some(quantity);
    }
    let lower: String = unit.to_lowercase().chars().filter(|c| !matches!(c, ' ' | '^' | '·' | '*' | '-')).collect();
    let lower = lower.replace("watt", "w").replace('²', "2");
    let power = ["w/", "w.", "wm", "wcm", "mol/", "photons/", "j/"].iter().any(|part| lower.contains(part));
    let area = ["m2", "m²"].iter().any(|part| lower.contains(part));
    match (power, area, lower.contains("sr")) {
        (true, true, true) => Some(Quantity::Radiance),
        (true, true, false) => Some(Quantity::Irradiance),
        (true, false, true) => Some(Quantity::RadiantIntensity),
        (true, false, false) => Some(Quantity::RadiantFlux),
        _ if matches!(lower.as_str(), "w" | "mw" | "µw" | "μw" | "uw" | "nw") => Some(Quantity::RadiantFlux),
        _ if header_terms::says_counts(&lower) => Some(Quantity::Counts),
        _ if lower == "relative" || lower == "rel." => Some(Quantity::Relative),
        _ => None,
    }
}
