//! Analysis of the light: temperature, rendition indices, and cameras under it and under its reference illuminant.

use std::sync::Arc;

use chromascope_core::colorimetry::Xyz;
use chromascope_core::light::{Cct, CctError, PlanckianLocus, RadiationConstants};
use chromascope_core::query::{
    Ask, CctQuery, Consistency, ConsistencyError, ConsistencyQuery, NearestBlackBodyQuery, Rendition, RenditionQuery,
    Shared,
};
use chromascope_core::rendition::{RenditionError, Standards};

use super::{Scene, SceneError};
use crate::catalog::load::StandardsQuery;
use crate::document::{FIT_TARGET, SetKind, TRAINING};

/// Reason that a camera has no consistency under the light.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum NoConsistency {
    /// The light has no reference illuminant.
    #[error(transparent)]
    Light(#[from] RenditionError),
    /// The camera cannot be corrected under it.
    #[error(transparent)]
    Camera(#[from] ConsistencyError),
    /// Something of the scene is missing.
    #[error(transparent)]
    Scene(#[from] SceneError),
}

impl Scene<'_> {
    /// Observers and samples of the indices.
    pub fn standards(&self) -> Result<Shared<Standards>, SceneError> {
        self.loaded(&StandardsQuery, "test samples")
    }

    /// Rendition indices of the light, filters included.
    pub fn rendition(&self) -> Result<Arc<Rendition>, SceneError> {
        let light = Shared::new(self.light()?.measured);
        Ok(self.results.ask(&RenditionQuery { light, standards: self.standards()? }))
    }

    /// Tristimulus values of the light for the CIE 1931 observer, in its own units.
    pub fn light_color(&self) -> Result<Xyz, SceneError> {
        let observer = self.sensor(SetKind::Observer, FIT_TARGET)?;
        let [x, y, z] = observer.integrate(self.light()?.grid.values());
        Ok(Xyz { x, y, z })
    }

    /// Query of the nearest blackbody for the CIE 1931 observer.
    pub fn nearest_blackbody_query(&self) -> Result<NearestBlackBodyQuery, SceneError> {
        let observer = self.sensor(SetKind::Observer, FIT_TARGET)?;
        Ok(NearestBlackBodyQuery { observer, constants: RadiationConstants::Paper })
    }

    /// Correlated color temperatures and Duv of many colors for the CIE 1931 observer. The locus is tabulated when first requested.
    pub fn temperatures_of(&self, colors: &[Option<Xyz>]) -> Result<Vec<Result<Cct, CctError>>, SceneError> {
        let locus = self.results.ask(&self.nearest_blackbody_query()?);
        let cct = |locus: &PlanckianLocus, color: &Option<Xyz>| {
            color.ok_or(CctError::NoChromaticity).and_then(|color| locus.cct_of_xyz(color))
        };
        Ok(match &*locus {
            Ok(locus) => colors.iter().map(|color| cct(locus, color)).collect(),
            Err(_) => vec![Err(CctError::NoChromaticity); colors.len()],
        })
    }

    /// Correlated color temperature and Duv of one color for the CIE 1931 observer, without tabulating the locus.
    pub fn temperature_of(&self, color: Option<Xyz>) -> Result<Result<Cct, CctError>, SceneError> {
        let observer = self.sensor(SetKind::Observer, FIT_TARGET)?;
        let Some(uv) = color.and_then(Xyz::uv_prime) else { return Ok(Err(CctError::NoChromaticity)) };
        Ok(*self.results.ask(&CctQuery::new(observer, uv.uv60())))
    }

    /// Correlated color temperature and Duv of the light, filters included.
    pub fn light_temperature(&self) -> Result<Result<Cct, CctError>, SceneError> {
        self.temperature_of(Some(self.light_color()?))
    }

    /// Color consistency of a camera: differences of the patches from those under the light's reference illuminant. The correction
    /// is fitted under the latter to the observer that the document fits to, or to CIE 1931.
    pub fn consistency(&self, camera: &str) -> Result<Consistency, NoConsistency> {
        let rendition = self.rendition()?;
        let (reference, _) = rendition.reference.as_ref().map_err(|&error| error)?;
        let query = ConsistencyQuery {
            sensor: self.sensor(SetKind::Camera, camera)?,
            light: self.light()?.grid,
            reference: reference.clone(),
            observer: self.sensor(SetKind::Observer, self.fit_target())?,
            training: self.patch_set(TRAINING, None)?,
            patches: self.patches()?,
        };
        Ok((*self.results.ask(&query)).clone()?)
    }
}
