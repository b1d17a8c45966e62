//! Round trip through each write format: no panic, and a CSV returns every sample to the last bit.
#![no_main]

use spectral_file::write::{Content, Format, Grid, Sheet, Trace, write};
use spectral_file::{
    Curve,    DecimalMark, Delimiter, Orientation, ReadError, ReadOptions, Reader, Role, SpectralFile, Values, WavelengthUnit, read,
};
use chromascope_core_fuzz::check;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|input: &[u8]| {
    let Some((&step, bytes)) = input.split_first() else { return };
    let Ok(table) = read(bytes, &ReadOptions::default()) else { return };
    let traces: Vec<Trace<'_>> = table.curves.iter().map(Trace::from).collect();
    let title = table.reading.comment("title").unwrap_or_default();
    let comments = &table.reading.header;
    let covariance = table.covariance.as_ref();
    let sheet = Sheet { title, content: content(&table), curves: &traces, covariance, comments, ..Sheet::default() };
    let grid = if step == 0 { Grid::Native } else { Grid::Step(f64::from(step) / 2.0) };
    for format in Format::ALL {
        let Ok(written) = write(&sheet, format, grid) else { continue };
        if let Ok(again) = read(written.text.as_bytes(), &ReadOptions::default()) {
            check(&again);
        }
    }
    if let Ok(written) = write(&sheet, Format::Csv, Grid::Native) {
        same(&table, &read(written.text.as_bytes(), &as_written(table.role.value)), &written.text);
    }
});

fn content(table: &SpectralFile) -> Content<'_> {
    match (table.role.value, table.reading.camera_columns) {
        (Role::Camera, Some(channels)) => {
            Content::Camera { channels, per_photon: None, manufacturer: None, model: None }
        }
        (Role::Reflectance, _) => Content::Reflectance,
        (Role::Transmittance, _) => Content::Transmittance,
        (Role::Illuminant, _) => Content::Illuminant,
        _ => Content::Other,
    }
}

/// The choices under which a CSV is what it was written as.
fn as_written(role: Role) -> ReadOptions {
    ReadOptions {
        reader: Some(Reader::TABLE),
        delimiter: Some(Delimiter::Comma),
        decimal_mark: Some(DecimalMark::Point),
        orientation: Some(Orientation::Down),
        wavelength_unit: Some(WavelengthUnit::Nanometer),
        wavelength_column: Some(1),
        values: Some(Values::Plain),
        role: Some(role),
        ..ReadOptions::default()
    }
}

fn same(table: &SpectralFile, again: &Result<SpectralFile, ReadError>, text: &str) {
    let again = match again {
        Ok(again) => again,
        Err(error) => panic!("{error}\n{text}"),
    };
    assert_eq!(again.curves.len(), table.curves.len(), "{text}");
    for (a, b) in table.curves.iter().zip(&again.curves) {
        // What means "not measured" is omitted when it is read.
        if !a.values.contains(&-9999.0) {
            let of = |curve: &Curve| (curve.wavelengths_nm.clone(), curve.values.clone(), curve.uncertainty.clone().map(|of| of.standard));
            assert_eq!(of(a), of(b), "{text}");
        }
    }
}
