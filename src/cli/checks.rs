//! Checks that a file contains the quantity that its option requires.

use spectral_file::{Certainty, ReadOptions, SpectralFile, Warning};

use super::error::CliError;
use crate::document::imported::{ImportedSet, Role};
use crate::terminal::say;

/// Rejects as reflectances data that the file declares as another quantity, and values of unknown scale.
pub(super) fn reflectances(path: &str, role: Role, table: &SpectralFile) -> Result<(), CliError> {
    if !role.is_fraction() {
        return Ok(());
    }
    let other = table.warnings.iter().find_map(|warning| match warning {
        Warning::OtherQuantity { quantity, .. } => {
            quantity.role().filter(|role| matches!(role, Role::Illuminant | Role::Camera)).map(|_| quantity)
        }
        _ => None,
    });
    if let Some(quantity) = other {
        let why = format!(
            "the file states {quantity}, which is not a reflectance; use patches --radiance for measured \
                     radiances"
        );
        return Err(CliError::File(format!("{path}: {why}")));
    }
    let values = &table.reading.values;
    if values.certainty == Certainty::Open {
        let remedy = if role == Role::Transmittance {
            "state it in the file, such as Transmittance (%)"
        } else {
            "add --values percent, or --values plain for fractions"
        };
        return Err(CliError::File(format!("{path}: {}; {remedy}", values.why)));
    }
    Ok(())
}

/// Reports the assumed quantity of a file that does not state it.
pub(super) fn say_role(path: &str, role: Role, table: &SpectralFile, bytes: &[u8]) {
    // Only a file that names no quantity can be open.
    let unnamed = table.reading.quantity.certainty == Certainty::Chosen;
    let open = || {
        spectral_file::read(bytes, &ReadOptions::default()).is_ok_and(|table| table.role.certainty == Certainty::Open)
    };
    if unnamed && open() {
        say(&format!(
            "chromascope: {path}: the file does not state its quantity; used as {role} because of the option\n"
        ));
    }
}

/// Refuses sensitivities of which nothing says which are red, green and blue.
pub(super) fn channels(path: &str, role: Role, table: &SpectralFile) -> Result<(), CliError> {
    let count = table.curves.len();
    if role != Role::Camera || count <= 3 || table.reading.camera_columns.is_some() {
        return Ok(());
    }
    let why = "red, green and blue are not identified; name the columns red, green and blue, or keep three";
    Err(CliError::File(format!("{path}: {count} curves; {why}")))
}

/// True if a file holds as many curves as its use takes.
pub(super) fn curves(set: &ImportedSet) -> Result<(), CliError> {
    let wanted = match set.role {
        Role::Camera if set.curves.len() < 3 => "expected three for a camera: red, green and blue",
        Role::Transmittance if set.curves.len() > 1 => "expected exactly one curve for a filter",
        Role::Illuminant if set.curves.len() > 1 => "expected exactly one curve for an illuminant",
        _ => return Ok(()),
    };
    let count = match set.curves.len() {
        1 => "1 curve".to_owned(),
        n => format!("{n} curves"),
    };
    Err(CliError::File(format!("{}: {count}; {wanted}", set.file)))
}
