//! Code shared by the fuzz targets: invariants of every table, choices made from bytes, valid seed files.

pub mod files;
pub mod options;

use spectral_file::SpectralFile;

/// Checks the invariants of every table that was read.
pub fn check(table: &SpectralFile) {
    assert!(!table.curves.is_empty());
    for curve in &table.curves {
        assert!(curve.wavelengths_nm.len() >= 2 && curve.wavelengths_nm.len() == curve.values.len());
        assert!(curve.wavelengths_nm.windows(2).all(|pair| pair[0] < pair[1]));
        assert!(curve.wavelengths_nm.iter().all(|w| (100.0..=25_000.0).contains(w)));
        assert!(curve.values.iter().all(|value| value.is_finite()));
    }
    let reading = &table.reading;
    assert!(reading.first_data_line > 0 && reading.rows > 0);
    assert!(reading.step_nm.min > 0.0 && reading.step_nm.max >= reading.step_nm.median);
    assert!(reading.camera_columns.is_none_or(|columns| columns.iter().all(|&i| i < table.curves.len())));
    assert!(table.decisions().iter().all(|decision| !decision.to_string().is_empty()));
    assert!(table.warnings.iter().all(|warning| !warning.to_string().is_empty()));
}
