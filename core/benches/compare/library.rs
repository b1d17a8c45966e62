//! The program's own data, as texts and as what they hold.

use chromascope_core::light::RadiationConstants;
use chromascope_core::patch_set::PatchSet;
use chromascope_core::query::{Shared, Temperatures};
use chromascope_core::spectral::{Dataset, GridSpectrum, Primaries, Sensor};
use chromascope_core::units::Kelvin;
use std::fs;
use std::path::PathBuf;

pub(crate) const CONSTANTS: RadiationConstants = RadiationConstants::Paper;

/// The sources of the first screen, the truth first.
pub(crate) const DEFAULT: [&str; 5] = [
    "observers/stiles_burch_1955_2deg.csv",
    "cameras/canon_eos_10d_2007_figure.csv",
    "cameras/nikon_d70_2007_figure.csv",
    "cameras/kodak_dcs200.csv",
    "observers/cie_1931_2deg.csv",
];

pub(crate) const CHART: &str = "charts/colorchecker_24_ohta_1997.csv";
pub(crate) const TRAINING: &str = "charts/training_reflectances_190.csv";

fn assets() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../assets")
}

pub(crate) fn text(path: &str) -> String {
    fs::read_to_string(assets().join(path)).unwrap()
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

pub(crate) fn shared(path: &str) -> Shared<Sensor> {
    Shared::new(sensor(&text(path)))
}

pub(crate) fn defaults() -> Vec<Shared<Sensor>> {
    DEFAULT.iter().map(|path| shared(path)).collect()
}

/// All cameras by name, then the two RGB observers: sixty sources that Eq 13 is applied to.
pub(crate) fn sixty() -> Vec<Shared<Sensor>> {
    let entries = fs::read_dir(assets().join("cameras")).unwrap();
    let mut names: Vec<String> =
        entries.map(|entry| format!("cameras/{}", entry.unwrap().file_name().to_string_lossy())).collect();
    names.sort();
    names.extend(["observers/stiles_burch_1955_2deg.csv", "observers/stiles_burch_1959_10deg.csv"].map(str::to_owned));
    names.iter().map(|path| shared(path)).collect()
}

pub(crate) fn patches(path: &str) -> PatchSet {
    PatchSet::from_dataset(&Dataset::read(&text(path)).unwrap())
}

pub(crate) fn equal_energy() -> GridSpectrum {
    GridSpectrum::constant(1.0)
}

/// 1000 to 20000 K, evenly in 1/T.
pub(crate) fn temperatures(count: usize) -> Temperatures {
    let [from, to] = [1000.0, 20_000.0].map(|t| Kelvin::new(t).unwrap());
    Temperatures::Range { from, to, count }
}

/// The processor's name, where the system says it.
pub(crate) fn processor() -> String {
    let facts = fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let name = facts.lines().find(|line| line.starts_with("model name"));
    name.and_then(|line| line.split_once(": ")).map_or("a processor".to_owned(), |(_, name)| name.to_owned())
}
