//! From the bytes of a user's file to a set of their own, with what was decided on the way.

use std::path::Path;

use chromascope_core::table::{self, Certainty, ReadError, ReadOptions, Role, Table, Warning, WavelengthUnit};

use crate::document::own::{OwnCurve, OwnRole, OwnSet, OwnUnit, ReadAs};

/// A set as it was read.
#[derive(Clone, Debug, PartialEq)]
pub struct Imported {
    /// The set.
    pub set: OwnSet,
    /// What was read, in one sentence, with what a person should know first.
    pub message: String,
    /// Whether something that changes numbers was guessed.
    pub guessed: bool,
}

/// Reads a file's bytes; `file` names it. A role that is given is not guessed.
pub fn import(file: &str, bytes: &[u8], role: Option<OwnRole>) -> Result<Imported, ReadError> {
    Ok(import_warned(file, bytes, role)?.0)
}

/// The same, with what should be looked at before the curves are trusted; the message tells the first of it.
pub fn import_warned(file: &str, bytes: &[u8], role: Option<OwnRole>) -> Result<(Imported, Vec<Warning>), ReadError> {
    let options = ReadOptions { role: role.map(core_role), ..ReadOptions::default() };
    let table = table::read(bytes, &options)?;
    let weighty = |what: &str| matches!(what, "Role" | "Wavelengths" | "Values");
    let guesses: Vec<_> = table
        .decisions()
        .into_iter()
        .filter(|decision| decision.certainty == Certainty::Guess && weighty(decision.what))
        .collect();
    let mut message = format!("{file}: {}", summary(&table));
    if let Some(guess) = guesses.iter().find(|guess| guess.what == "Values").or_else(|| guesses.first()) {
        message = format!("{message} {guess}");
    }
    if let Some(warning) = table.warnings.first() {
        message = format!("{message} {warning}");
    }
    let warnings = table.warnings.clone();
    Ok((Imported { message, guessed: !guesses.is_empty(), set: own_set(file, table) }, warnings))
}

/// How many curves of what, over which range.
fn summary(table: &Table) -> String {
    let [first, last] = table.reading.range_nm;
    let count = table.curves.len();
    let curves = if count == 1 { "1 curve".to_owned() } else { format!("{count} curves") };
    format!("{curves}, {}, {first}–{last} nm.", table.role.value)
}

fn own_set(file: &str, table: Table) -> OwnSet {
    let name = table.reading.comment("title").map(str::trim).filter(|title| !title.is_empty()).map(str::to_owned);
    let stem =
        || Path::new(file).file_stem().map_or_else(|| file.to_owned(), |stem| stem.to_string_lossy().into_owned());
    let unit = match table.reading.wavelength_unit.value {
        WavelengthUnit::Nanometer => OwnUnit::Nanometers,
        WavelengthUnit::Micrometer => OwnUnit::Micrometers,
        WavelengthUnit::Angstrom => OwnUnit::Angstroms,
    };
    let percent = table.reading.percent.value;
    let mut decisions: Vec<String> =
        table.decisions().iter().map(|decision| format!("{} ({})", decision, decision.certainty)).collect();
    decisions.extend(table.warnings.iter().map(ToString::to_string));
    let name = name.unwrap_or_else(stem);
    let mut curves: Vec<OwnCurve> = Vec::with_capacity(table.curves.len());
    let alone = table.curves.len() == 1;
    for curve in table.curves {
        // The file's name says more about its only curve than "Column 2" does.
        let called = if alone && !curve.named { name.clone() } else { curve.name };
        curves.push(OwnCurve { name: called, wavelengths: curve.wavelengths_nm, values: curve.values });
    }
    OwnSet {
        name,
        file: file.to_owned(),
        role: own_role(table.role.value),
        read_as: ReadAs { unit, percent },
        unit,
        percent,
        per_photon: table.reading.comment("response").is_some_and(|response| response.trim() == "per photon"),
        channels: table.reading.camera_columns.unwrap_or([0, 1, 2]),
        curves,
        decisions,
    }
}

const fn own_role(role: Role) -> OwnRole {
    match role {
        Role::Camera => OwnRole::Camera,
        Role::Reflectance => OwnRole::Reflectance,
        Role::Illuminant => OwnRole::Illuminant,
    }
}

const fn core_role(role: OwnRole) -> Role {
    match role {
        OwnRole::Camera => Role::Camera,
        OwnRole::Reflectance => Role::Reflectance,
        OwnRole::Illuminant => Role::Illuminant,
    }
}
