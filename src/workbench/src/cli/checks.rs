//! Checks that a file contains the quantity that its option requires.

use spectral_file::{Certainty, SpectralFile, Warning};

use super::error::CliError;
use crate::document::imported::{ImportedSet, Role};
use crate::terminal::say;

/// Rejects a file that states another quantity than its option takes, values of unknown scale, and values that no such quantity has;
/// reports the use of a file that states none.
pub(super) fn quantity(path: &str, role: Role, table: &SpectralFile) -> Result<(), CliError> {
    let refuse = |why: String| Err(CliError::File(format!("{path}: {why}")));
    let content = &table.reading.content_role;
    let other = content.value != role && !(content.value.is_fraction() && role.is_fraction());
    if other && content.certainty == Certainty::Certain && content.value != Role::Unknown {
        let option = match content.value {
            Role::Camera => "--camera",
            Role::Reflectance => "--chart",
            Role::Transmittance => "--filter",
            Role::Illuminant | Role::Unknown => "--illuminant, or patches --radiance for measured radiances",
        };
        let quantity = table.warnings.iter().find_map(|warning| match warning {
            Warning::OtherQuantity { quantity, .. } => Some(quantity.to_string()),
            _ => None,
        });
        let stated = quantity.unwrap_or_else(|| content.value.to_string());
        let why = spectral_file::lowered(&content.why);
        return refuse(format!("the file states {stated}, not {role} ({why}); use {option}, or correct its header"));
    }
    let values = &table.reading.values;
    if role.is_fraction() && values.certainty == Certainty::Open {
        let remedy = if role == Role::Transmittance {
            "state it in the file, such as Transmittance (%)"
        } else {
            "add --values percent, or --values plain for fractions"
        };
        return refuse(format!("{}; {remedy}", values.why));
    }
    if other && content.certainty != Certainty::Certain {
        let why = match content.certainty {
            Certainty::Guess => format!("{}, which suggests {}", content.why, content.value),
            _ => "the file does not state its quantity".to_owned(),
        };
        say(&format!("chromascope: {path}: {why}; used as {role} because of the option\n"));
    }
    Ok(())
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
