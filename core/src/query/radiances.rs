//! Queries about measured spectra of radiance, through a sensor.

use super::ask::{Ask, Query};
use super::patches;
use super::patches::{PatchColor, RenderingQuery};
use super::shared::Shared;
use crate::camera::RenderingError;
use crate::camera::rendering::{raw, under_light};
use crate::spectral::GridSpectrum;

/// Colors of radiances L through a sensor: `I_c = s_c ∫C_c L dλ / ∫C_c W dλ`.
///
/// W, the radiance of white, takes the place of the rendering's light: a radiance equal to W takes the white-balance target, and
/// Y = 1.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct RadianceColorsQuery {
    /// The sensor and its color transform, with W for its light.
    pub rendering: RenderingQuery,
    /// The radiances.
    pub radiances: Vec<Shared<GridSpectrum>>,
}

impl Query for RadianceColorsQuery {
    type Answer = Result<Vec<PatchColor>, RenderingError>;
    const NAME: &'static str = "radiance colors";

    fn answer(&self, ask: &impl Ask) -> Self::Answer {
        let rendering = ask.ask(&self.rendering);
        let rendering = (*rendering).as_ref().map_err(|&e| e)?;
        let product = under_light(&self.rendering.sensor, &GridSpectrum::constant(1.0));
        Ok(self.radiances.iter().map(|radiance| patches::color(rendering, raw(&product, radiance.values()))).collect())
    }
}
