//! Conversion of a table's curves for output.

use std::io::Write;

use spectral_file::write::{Content, Note, Prepared};
use spectral_file::{Role, SpectralFile};

use super::Stop;

/// The differences between curves that are written and those that were read, found by resampling all of them.
pub(super) fn notes(prepared: &mut Prepared<'_>) -> Vec<Note> {
    prepared.each(|_, _| true);
    prepared.notes()
}

/// Writes the table as it is made.
pub(super) fn write(prepared: &mut Prepared<'_>, out: &mut dyn Write) -> Result<(), Stop> {
    let mut done = Ok(());
    prepared.table(&mut |part| {
        done = out.write_all(part.as_bytes());
        done.is_ok()
    });
    Ok(done?)
}

/// Kind of the curves for those who write them.
pub(super) fn content(table: &SpectralFile) -> Content<'_> {
    match table.role.value {
        Role::Camera => table.reading.camera_columns.map_or(Content::Observer, |channels| Content::Camera {
            channels,
            per_photon: table.reading.per_photon.as_ref().map(|decided| decided.value),
            manufacturer: None,
            model: None,
        }),
        Role::Reflectance => Content::Reflectance,
        Role::Transmittance => Content::Transmittance,
        Role::Illuminant => Content::Illuminant,
        Role::Unknown => Content::Other,
    }
}
