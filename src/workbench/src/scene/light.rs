//! Analysis of the light: temperature, rendition indices, and cameras under it and under its reference illuminant.

use std::sync::Arc;

use chromascope_core::colorimetry::Xyz;
use chromascope_core::light::{Cct, CctError, PlanckianLocus, RadiationConstants};
use chromascope_core::patch_set::PatchSet;
use chromascope_core::query::{
    Ask, CctQuery, Consistency, ConsistencyError, ConsistencyQuery, NearestBlackBodyQuery, Query, Rendition,
    RenditionQuery, Shared,
};
use chromascope_core::rendition::cri::{self, monochromatic_band};
use chromascope_core::rendition::{RenditionError, Standards, spectral_similarity};
use chromascope_core::spectral::grid::{GridSpectrum, wavelength_nm};
use chromascope_core::spectral::{Sensor, SpectralDistribution};

use super::{Result, Scene, SceneError};
use crate::catalog::load::StandardsQuery;
use crate::document::{FIT_TARGET, Light, SetKind, TRAINING};
use crate::format::fixed;

/// Reason that a camera has no consistency under the light.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum NoConsistency {
    #[error(transparent)]
    Light(#[from] RenditionError),
    #[error(transparent)]
    Camera(#[from] ConsistencyError),
    #[error(transparent)]
    Scene(#[from] SceneError),
}

/// Question for the indices of a light, and for the consistency of cameras under it.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct LightSheetQuery {
    measured: Shared<SpectralDistribution>,
    grid: Shared<GridSpectrum>,
    observer: Shared<Sensor>,
    training: Shared<PatchSet>,
    patches: Shared<PatchSet>,
    /// The cameras, by label.
    pub cameras: Vec<(String, Shared<Sensor>)>,
}

/// Indices of a light, and the consistency of cameras under it.
pub struct LightSheet {
    pub rendition: Result<Arc<Rendition>>,
    /// Consistency of each camera of the question.
    pub cameras: Vec<Result<Consistency, NoConsistency>>,
}

impl LightSheetQuery {
    fn rendition(&self, ask: &impl Ask) -> Result<Arc<Rendition>> {
        let standards = (*ask.ask(&StandardsQuery)).clone();
        let standards = standards.map_err(|error| SceneError::Load { name: "test samples".to_owned(), error })?;
        Ok(ask.ask(&RenditionQuery { light: self.measured.clone(), standards }))
    }

    fn consistency(&self, sensor: &Shared<Sensor>, ask: &impl Ask) -> Result<Consistency, NoConsistency> {
        let rendition = self.rendition(ask)?;
        let (reference, _) = rendition.reference.as_ref().map_err(|&error| error)?;
        let query = ConsistencyQuery {
            sensor: sensor.clone(),
            light: self.grid.clone(),
            reference: reference.clone(),
            observer: self.observer.clone(),
            training: self.training.clone(),
            patches: self.patches.clone(),
        };
        Ok((*ask.ask(&query)).clone()?)
    }
}

impl Query for LightSheetQuery {
    type Answer = LightSheet;
    const NAME: &'static str = "light and cameras under it";
    const CAPACITY: usize = 4;

    fn answer(&self, ask: &impl Ask) -> LightSheet {
        let cameras = self.cameras.iter().map(|(_, sensor)| self.consistency(sensor, ask)).collect();
        LightSheet { rendition: self.rendition(ask), cameras }
    }
}

impl Scene<'_> {
    /// Question for the light with the compared cameras.
    pub fn light_sheet_query(&self) -> Result<LightSheetQuery> {
        let sources = self.sources().into_iter().filter(|source| source.kind == SetKind::Camera);
        let cameras = sources.map(|source| Ok((source.label, self.sensor(source.kind, &source.name)?)));
        self.light_query_of(cameras.collect::<Result<_>>()?)
    }

    fn light_query_of(&self, cameras: Vec<(String, Shared<Sensor>)>) -> Result<LightSheetQuery> {
        let light = self.light()?;
        Ok(LightSheetQuery {
            measured: Shared::new(light.measured),
            grid: light.grid,
            observer: self.sensor(SetKind::Observer, self.fit_target())?,
            training: self.patch_set(TRAINING, None)?,
            patches: self.patches()?,
            cameras,
        })
    }

    pub fn standards(&self) -> Result<Shared<Standards>> {
        self.loaded(&StandardsQuery, "test samples")
    }

    pub fn rendition(&self) -> Result<Arc<Rendition>> {
        let light = Shared::new(self.light()?.measured);
        Ok(self.results.ask(&RenditionQuery { light, standards: self.standards()? }))
    }

    /// Conditions under which indices of the light mean less than they seem, in sentences.
    pub fn rendition_cautions(&self, rendition: &Rendition) -> Result<Vec<String>> {
        /// Temperatures that are one: the sums of the indices differ by 2 K.
        const SAME_K: f64 = 5.0;
        let (light, shown) = (self.light()?.measured, self.light_temperature()?.ok());
        let mut cautions = Vec::new();
        if rendition.rendering.as_ref().is_ok_and(|indices| indices.distance > cri::NEAR) {
            cautions.push(format!(
                "farther than {} from the reference illuminant in u, v: CIE 13.3 calls Ra and R1 to R14 less accurate there",
                cri::NEAR
            ));
        }
        if let Some(held) = &rendition.held {
            let [first, last] = light.range_nm();
            let effect = held.as_ref().map_or_else(ToString::to_string, |[rf, rg, ssi]| {
                format!("held, they would be Rf {}, Rg {}, SSI {}", fixed(*rf, 1), fixed(*rg, 1), fixed(*ssi, 0))
            });
            cautions.push(format!(
                "the table covers {first} to {last} nm: beyond, Ra takes its end values, but Rf, Rg and SSI zero; {effect}"
            ));
        }
        let of_reference = rendition.reference.as_ref().ok().map(|(_, cct)| cct.temperature.get());
        let apart = shown.map(|cct| cct.temperature.get()).zip(of_reference).filter(|(a, b)| (a - b).abs() > SAME_K);
        cautions.extend(apart.map(|(cct, reference)| {
            format!(
                "Rf, Rg and SSI take their reference at {reference:.0} K, the temperature without what is beyond the \
                 table; CCT is {cct:.0} K"
            )
        }));
        Ok(cautions)
    }

    /// Spectral similarity of the light to another illuminant by name, which is without filters.
    pub fn similarity_to(&self, name: &str) -> Result<Result<f64, RenditionError>> {
        let reference = self.loaded(&self.light_of(name)?, name)?.measured;
        Ok(spectral_similarity(&self.light()?.measured, &reference))
    }

    /// Tristimulus values of the light for the CIE 1931 observer, in its own units.
    pub fn light_color(&self) -> Result<Xyz> {
        let observer = self.sensor(SetKind::Observer, FIT_TARGET)?;
        let [x, y, z] = observer.integrate(self.light()?.grid.values());
        Ok(Xyz { x, y, z })
    }

    /// Reason that colors under the light say next to nothing: one band carries it, or a body that does not glow.
    pub fn light_caution(&self) -> Result<Option<String>> {
        /// Draper point in kelvins: colder bodies emit no visible light.
        const DRAPER_K: f64 = 798.0;
        let (name, kelvin) = (self.light_name(), self.document.temperature_k);
        if self.document.light == Light::BlackBody && kelvin < DRAPER_K {
            return Ok(Some(format!(
                "{name} has next to no visible light (below {DRAPER_K} K no body glows): results rest on the red ends \
                 of the tables alone and mean nothing"
            )));
        }
        let (observer, light) = (self.sensor(SetKind::Observer, FIT_TARGET)?, self.light()?.grid);
        let luminance: Vec<f64> = observer.weighted(1).iter().zip(light.values()).map(|(y, l)| y * l).collect();
        Ok(monochromatic_band(&luminance).map(|(index, share)| {
            format!(
                "{name} is mainly monochromatic, {:.0} % of its luminance within 20 nm of {:.0} nm: it shows next to \
                 no colors, and differences under it say little",
                (100.0 * share).floor(),
                wavelength_nm(index)
            )
        }))
    }

    /// Query of the nearest blackbody for the CIE 1931 observer.
    pub fn nearest_blackbody_query(&self) -> Result<NearestBlackBodyQuery> {
        let observer = self.sensor(SetKind::Observer, FIT_TARGET)?;
        Ok(NearestBlackBodyQuery { observer, constants: RadiationConstants::Paper })
    }

    /// Correlated color temperatures and Duv of many colors for the CIE 1931 observer. The locus is tabulated when first requested.
    pub fn temperatures_of(&self, colors: &[Option<Xyz>]) -> Result<Vec<Result<Cct, CctError>>> {
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
    pub fn temperature_of(&self, color: Option<Xyz>) -> Result<Result<Cct, CctError>> {
        let observer = self.sensor(SetKind::Observer, FIT_TARGET)?;
        let Some(uv) = color.and_then(Xyz::uv_prime) else { return Ok(Err(CctError::NoChromaticity)) };
        Ok(*self.results.ask(&CctQuery::new(observer, uv.uv60())))
    }

    /// Correlated color temperature and Duv of the light, filters included.
    pub fn light_temperature(&self) -> Result<Result<Cct, CctError>> {
        self.temperature_of(Some(self.light_color()?))
    }

    /// Color consistency of a camera: differences of the patches from those under the light's reference illuminant. The correction
    /// is fitted under the latter to the observer that the document fits to, or to CIE 1931.
    pub fn consistency(&self, camera: &str) -> Result<Consistency, NoConsistency> {
        let sensor = self.sensor(SetKind::Camera, camera)?;
        self.light_query_of(Vec::new())?.consistency(&sensor, self.results)
    }
}
