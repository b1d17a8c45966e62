//! Data and small conversions that several tests share.

use std::fs;
use std::path::PathBuf;

use chromascope_core::camera::WhiteBalanceTarget;
use chromascope_core::colorimetry::Xy;
use chromascope_core::patch_set::PatchSet;
use chromascope_core::query::{ColorTransformSpec, RenderingQuery, Shared};
use chromascope_core::spectral::{Dataset, GridSpectrum, Quantity, Sensor};
use chromascope_core::units::Kelvin;
use proptest::prelude::ProptestConfig;

/// The five sources of the first screen.
pub(crate) const REFERENCE: &str = "observers/stiles_burch_1955_2deg.csv";
pub(crate) const CIE_1931: &str = "observers/cie_1931_2deg.csv";
pub(crate) const CANON_10D: &str = "cameras/canon_eos_10d_2007_figure.csv";
pub(crate) const NIKON_D70: &str = "cameras/nikon_d70_2007_figure.csv";
pub(crate) const DCS200: &str = "cameras/kodak_dcs200.csv";

/// Random cases, without files of failed ones beside the sources.
pub(crate) fn cases(count: u32) -> ProptestConfig {
    ProptestConfig { cases: count, failure_persistence: None, ..ProptestConfig::default() }
}

fn root(folder: &str) -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("..").join(folder)
}

pub(crate) fn dataset(path: &str) -> Dataset {
    let text = fs::read_to_string(root("assets").join(path)).unwrap();
    Dataset::read(&text).unwrap_or_else(|e| panic!("{path}: {e}"))
}

pub(crate) fn sensor(path: &str) -> Sensor {
    Sensor::from_dataset(&dataset(path)).unwrap()
}

pub(crate) fn patches(path: &str) -> PatchSet {
    PatchSet::from_dataset(&dataset(path))
}

/// The paper's default chart.
pub(crate) fn chart() -> PatchSet {
    patches("charts/colorchecker_24_ohta_1997.csv")
}

pub(crate) fn training() -> PatchSet {
    patches("charts/training_reflectances_190.csv")
}

/// The first curve of a data set as a light.
pub(crate) fn light(path: &str) -> GridSpectrum {
    GridSpectrum::resample(&dataset(path).curves[0], Quantity::Light)
}

pub(crate) fn kelvin(value: f64) -> Kelvin {
    Kelvin::new(value).unwrap()
}

/// Every sensor of a folder, by path, in the order of their names.
pub(crate) fn sensors(folder: &str) -> Vec<(String, Sensor)> {
    let mut names: Vec<String> = fs::read_dir(root("assets").join(folder))
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .filter(|name| name.strip_suffix(".csv").is_some())
        .collect();
    names.sort();
    names.into_iter().map(|name| format!("{folder}/{name}")).map(|path| (path.clone(), sensor(&path))).collect()
}

/// The rows of a reference table, without its comments and column heads.
pub(crate) fn reference(name: &str) -> Vec<Vec<String>> {
    let text = fs::read_to_string(root("tests/core/reference").join(name)).unwrap();
    let rows = text.lines().filter(|line| !line.starts_with('#')).skip(1);
    rows.map(|line| line.split(',').map(str::to_owned).collect()).collect()
}

/// The rows of a reference table that holds nothing but numbers.
pub(crate) fn reference_numbers(name: &str) -> Vec<Vec<f64>> {
    reference(name).iter().map(|row| row.iter().map(|field| field.parse().unwrap()).collect()).collect()
}

/// A sensor under equal energy, unity balance, by Eq 13.
pub(crate) fn by_paper(sensor: &Shared<Sensor>) -> RenderingQuery {
    RenderingQuery {
        sensor: sensor.clone(),
        light: Shared::new(light("illuminants/e.csv")),
        white: WhiteBalanceTarget::UNITY,
        transform: ColorTransformSpec::Paper,
    }
}

#[track_caller]
pub(crate) fn assert_near(what: &str, value: f64, expected: f64, tolerance: f64) {
    assert!((value - expected).abs() <= tolerance, "{what}: {value} is not within {tolerance} of {expected}");
}

#[track_caller]
pub(crate) fn assert_xy(what: &str, value: Xy, expected: [f64; 2], tolerance: f64) {
    assert_near(&format!("{what} x"), value.x, expected[0], tolerance);
    assert_near(&format!("{what} y"), value.y, expected[1], tolerance);
}

/// A grid spectrum as if it had been measured at 1 nm.
pub(crate) fn measured(
    spectrum: &chromascope_core::spectral::GridSpectrum,
) -> chromascope_core::spectral::SpectralDistribution {
    let nm = (0..spectrum.values().len()).map(chromascope_core::spectral::grid::wavelength_nm).collect();
    chromascope_core::spectral::SpectralDistribution::new(nm, spectrum.values().to_vec()).unwrap()
}
