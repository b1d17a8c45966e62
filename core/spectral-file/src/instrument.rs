//! Program that wrote a table, and its own words about the values.

use crate::clues::{self, Program, THORLABS};
use crate::decision::{Decided, Decision, Quantity, Role, Values};
use crate::grid::Grid;
use crate::text::Lines;

const LOOK: usize = 60;

/// Names the program that wrote a table, and takes over what only its own words say.
pub(super) fn recognize(text: &str, grid: &mut Grid) -> Option<Decision> {
    let lines = || Lines::new(text).take(LOOK).filter(|(_, line)| line.len() <= clues::LONGEST);
    if let Some((line, mode)) = lines().take(4).find_map(|(line, text)| Some((line, stellarnet_mode(text)?))) {
        take_mode(line, mode, grid);
        return Some(decision("StellarNet SpectraWiz", line));
    }
    let (line, Program { name: program, .. }) =
        lines().find_map(|(number, line)| Some((number, clues::program(line)?)))?;
    if *program == THORLABS {
        grid.role
            .get_or_insert_with(|| Decided::guess(Role::Illuminant, format!("Line {line} is of an analyzer of light")));
    }
    if let Some((at, name)) = lines().find_map(|(at, line)| Some((at, library_name(line)?))) {
        grid.header.note(at, "title", name);
        if let [only] = grid.curves.as_mut_slice()
            && !only.named
        {
            name.clone_into(&mut only.name);
            only.named = true;
        }
    }
    Some(decision(program, line))
}

fn decision(program: &str, line: usize) -> Decision {
    Decision::certain("Program", format!("a file of {program}"), format!("Line {line} shows it"))
}

fn library_name(line: &str) -> Option<&str> {
    line.strip_prefix("Name:").map(str::trim).filter(|name| !name.is_empty())
}

/// The word before an arrow in a line that begins with a quote that is never closed.
fn stellarnet_mode(line: &str) -> Option<&str> {
    let (mode, rest) = line.strip_prefix('"')?.split_once("->")?;
    rest.contains("Wave:").then_some(mode.trim())
}

fn take_mode(line: usize, mode: &str, grid: &mut Grid) {
    let why = format!("Line {line} says {mode}");
    let (quantity, values) = match mode.to_ascii_uppercase().as_str() {
        "TRANS" | "TRM" => (Quantity::Transmittance, Some(Values::Percent)),
        "REFL" | "REFLECT" => (Quantity::Reflectance, Some(Values::Percent)),
        "ABSORB" | "ABS" => {
            grid.role = Some(Decided::guess(Role::Transmittance, &*why));
            grid.header.values = Some((line, Values::Absorbance));
            return;
        }
        "SCOPE" => (Quantity::Counts, None),
        "IRRAD" | "IRR" => (Quantity::Irradiance, None),
        "RAD" | "RADIANCE" => (Quantity::Radiance, None),
        "WATTS" => (Quantity::RadiantFlux, None),
        "LUMENS" => (Quantity::SpectralPower, None),
        _ => return,
    };
    grid.role = quantity.role().map(|role| Decided::certain(role, &*why));
    grid.header.values = values.map(|values| (line, values)).or(grid.header.values);
    // Irradiances are written so, too.
    let decide = if mode.eq_ignore_ascii_case("RAD") { Decided::guess } else { Decided::certain };
    grid.quantity = Some(decide(quantity, why));
}
