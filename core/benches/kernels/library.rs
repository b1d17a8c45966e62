//! The program's own data, as texts and as what they hold.

use chromascope_core::light::RadiationConstants;
use chromascope_core::patch_set::PatchSet;
use chromascope_core::spectral::{Dataset, GridSpectrum, Primaries, Sensor};
use std::fs;
use std::path::PathBuf;

pub(crate) const CONSTANTS: RadiationConstants = RadiationConstants::Paper;

pub(crate) const CHART: &str = "charts/colorchecker_24_ohta_1997.csv";

pub(crate) fn text(path: &str) -> String {
    fs::read_to_string(PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../assets").join(path)).unwrap()
}

pub(crate) fn sensor(text: &str) -> Sensor {
    let data = Dataset::read(text).unwrap();
    let primaries = match data.header.columns[0].as_str() {
        "r_bar" => Primaries::Rgb,
        "x_bar" => Primaries::Xyz,
        "l_bar" => Primaries::Cones,
        _ => Primaries::Camera,
    };
    let response = data.header.response();
    Sensor::new(primaries, data.curves.try_into().unwrap(), response).unwrap()
}

pub(crate) fn patches(path: &str) -> PatchSet {
    PatchSet::from_dataset(&Dataset::read(&text(path)).unwrap())
}

pub(crate) fn equal_energy() -> GridSpectrum {
    GridSpectrum::constant(1.0)
}
