//! What the workloads are made of: the program's own data, and numbers that follow from a seed.

use chromascope_core::light::RadiationConstants;
use chromascope_core::query::{Ask as _, Direct, Shared};
use chromascope_core::spectral::{GridSpectrum, Quantity, Sensor};

use crate::catalog::Place;
use crate::catalog::load::{FileQuery, LoadError, SensorQuery};

/// The constants everything is computed with.
pub(super) const CONSTANTS: RadiationConstants = RadiationConstants::Paper;
/// The observer of color temperatures.
pub(super) const OBSERVER: &str = "observers/cie_1931_2deg.csv";
/// The camera that stands for all.
pub(super) const CAMERA: &str = "cameras/nikon_d70_2007_figure.csv";
/// The light that stands for all.
pub(super) const LIGHT: &str = "illuminants/direct_sun_astm_g173.csv";
/// The reflectance that stands for all.
pub(super) const REFLECTANCE: &str = "materials/skin_vrhel.csv";

/// A built-in sensor.
pub(super) fn sensor(path: &'static str) -> Result<Shared<Sensor>, LoadError> {
    (*Direct.ask(&SensorQuery(Place::BuiltIn { path, column: None }))).clone()
}

/// The first curve of a built-in file.
pub(super) fn curve(path: &'static str, quantity: Quantity) -> Result<GridSpectrum, LoadError> {
    let file = Direct.ask(&FileQuery(path));
    let file = (*file).as_ref().map_err(Clone::clone)?;
    Ok(GridSpectrum::resample(file.curves.first().ok_or(LoadError::NoCurve)?, quantity))
}

/// Numbers that look like chance and are the same in every run (Steele, Lea and Flood 2014).
pub(super) struct Numbers(u64);

impl Numbers {
    pub(super) fn new(seed: u64) -> Self {
        Self(seed)
    }

    /// The next, evenly from `low` to `high`.
    pub(super) fn between(&mut self, low: f64, high: f64) -> f64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut mixed = self.0;
        mixed = (mixed ^ (mixed >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        let unit = (mixed ^ (mixed >> 31)) >> 11;
        low + (high - low) * (unit as f64 / (1_u64 << 53) as f64)
    }

    /// The next, its logarithm evenly.
    pub(super) fn log_between(&mut self, low: f64, high: f64) -> f64 {
        self.between(low.ln(), high.ln()).exp()
    }
}
