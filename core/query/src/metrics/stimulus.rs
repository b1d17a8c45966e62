//! Metrics under other lights and of other charts, for the uncertainties that files of these state.

use super::value::CameraMetricsQuery;
use crate::ask::Shared;
use crate::patches::RenderingQuery;
use chromascope_color::patch_set::PatchSet;
use chromascope_color::spectral::grid::COUNT;
use chromascope_color::spectral::{GridSpectrum, Quantity, SpectralDistribution, StatedUncertainty};
use chromascope_color::units::hash_by;

/// Width of bands on the grid, in nanometers, that lights are drawn with their exact covariance in.
const BAND: usize = 10;

/// A light as measured, with the uncertainty that its file states.
#[derive(Clone, Debug, PartialEq)]
pub struct LightUncertainty {
    /// Light at the wavelengths of its file.
    pub measured: SpectralDistribution,
    /// Uncertainty of its one curve.
    pub stated: StatedUncertainty,
    /// Transmittance of the filters in front of it; none without.
    pub transmittance: Option<GridSpectrum>,
}

hash_by!(LightUncertainty, |of| (&of.measured, &of.stated, &of.transmittance));

/// Bands that a light's effect on metrics is all but determined by.
pub(super) fn bands() -> Vec<Vec<f64>> {
    let band = |band: usize| (0..COUNT).map(|at| f64::from(u8::from(at / BAND == band))).collect();
    (0..COUNT.div_ceil(BAND)).map(band).collect()
}

impl CameraMetricsQuery {
    /// The same with another light, which camera and reference see, behind the filters.
    pub(super) fn under(&self, measured: &SpectralDistribution, transmittance: Option<&GridSpectrum>) -> Self {
        let light = GridSpectrum::resample(measured, Quantity::Light);
        let light = Shared::new(transmittance.map_or_else(|| light.clone(), |filters| light.times(filters)));
        let under = |rendering: &RenderingQuery| RenderingQuery { light: light.clone(), ..rendering.clone() };
        Self { rendering: under(&self.rendering), reference: under(&self.reference), ..self.clone() }
    }

    /// The same with other reflectances of the patches.
    pub(super) fn of_patches(&self, measured: Vec<SpectralDistribution>) -> Self {
        let names = self.patches.patches().iter().map(|patch| patch.name.clone());
        Self { patches: Shared::new(PatchSet::new(names.zip(measured))), ..self.clone() }
    }
}
