//! The curves of a table on the way out.

use chromascope_core::table::write::{Content, Grid, Note, Sheet, Trace, WriteError, canonical_csv};
use chromascope_core::table::{Role, Table};

/// A table of curves as text.
pub(super) struct Tabulated {
    /// The canonical CSV.
    pub(super) text: String,
    /// What is not as it was read.
    pub(super) notes: Vec<Note>,
}

/// Writes the curves of a table.
pub(super) fn tabulate(table: &Table, grid: Grid) -> Result<Tabulated, WriteError> {
    let curves: Vec<Trace<'_>> = table.curves.iter().map(Trace::from).collect();
    let sheet = Sheet { content: content(table), curves: &curves, ..Sheet::default() };
    let written = canonical_csv(&sheet, grid)?;
    Ok(Tabulated { text: written.text, notes: written.notes })
}

fn content(table: &Table) -> Content<'_> {
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

impl Tabulated {
    /// Wavelengths and values of each of so many curves, as written.
    pub(super) fn curves(&self, count: usize) -> Vec<(Vec<f64>, Vec<f64>)> {
        let mut curves = vec![(Vec::new(), Vec::new()); count];
        for line in self.text.lines().skip(1) {
            let mut cells = line.split(',').map(|cell| cell.parse::<f64>().ok());
            let Some(wavelength) = cells.next().flatten() else { continue };
            for (curve, cell) in curves.iter_mut().zip(cells) {
                if let Some(value) = cell {
                    curve.0.push(wavelength);
                    curve.1.push(value);
                }
            }
        }
        curves
    }
}
