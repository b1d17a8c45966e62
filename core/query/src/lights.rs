//! Queries about a light alone, and about cameras under it and under its reference illuminant.

use super::ask::{Ask, Query, Shared};
use super::correction::ErrorSummary;
use super::patches::{ColorTransformSpec, RenderingQuery};
use chromascope_color::camera::rendering::{raw, under_light, white_divisors};
use chromascope_color::camera::{RenderingError, WhiteBalanceTarget};
use chromascope_color::colorimetry::delta_e_2000;
use chromascope_color::correction::Correction;
use chromascope_color::light::Cct;
use chromascope_color::patch_set::PatchSet;
use chromascope_color::rendition::cri::rendering_indices;
use chromascope_color::rendition::fidelity::color_fidelity;
use chromascope_color::rendition::reference::reference_illuminant;
use chromascope_color::rendition::similarity::similarity_reference;
use chromascope_color::rendition::{ColorFidelity, RenderingIndices, RenditionError, Standards, spectral_similarity};
use chromascope_color::spectral::grid::{FIRST_NM, LAST_NM};
use chromascope_color::spectral::{GridSpectrum, Sensor, SpectralDistribution};

/// Rendition indices of a light.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct RenditionQuery {
    /// The light as measured.
    pub light: Shared<SpectralDistribution>,
    /// Standard data from which the indices are computed.
    pub standards: Shared<Standards>,
}

/// Rendition indices of a light, each with its own reason where there is none.
#[derive(Clone, Debug, PartialEq)]
pub struct Rendition {
    /// Ra and R1 to R14 (CIE 13.3).
    pub rendering: Result<RenderingIndices, RenditionError>,
    /// Rf, Rg and hue bins (TM-30).
    pub fidelity: Result<ColorFidelity, RenditionError>,
    /// Reference illuminant of TM-30 on the grid, and the light's temperature and Duv.
    pub reference: Result<(Shared<GridSpectrum>, Cct), RenditionError>,
    /// Spectral similarity index to a blackbody below 4000 K, to daylight from there on, at the light's temperature; unrounded.
    pub similarity: Result<f64, RenditionError>,
    /// Rf, Rg and the similarity index if the table's end values were held to 380 and 780 nm; none for a table that reaches there.
    pub held: Option<Result<[f64; 3], RenditionError>>,
}

/// The light with its end values held to the ends of the grid; none if it reaches them.
fn held(light: &SpectralDistribution) -> Option<SpectralDistribution> {
    let ([first, last], mut nm, mut values) =
        (light.range_nm(), light.wavelengths_nm().to_vec(), light.values().to_vec());
    if first > FIRST_NM {
        nm.insert(0, FIRST_NM);
        values.insert(0, values[0]);
    }
    if last < LAST_NM {
        nm.push(LAST_NM);
        values.push(values[values.len() - 1]);
    }
    (nm.len() > light.values().len()).then(|| SpectralDistribution::new(nm, values).ok())?
}

impl Query for RenditionQuery {
    type Answer = Rendition;
    const NAME: &'static str = "rendition";

    fn answer(&self, _: &impl Ask) -> Rendition {
        let reference = reference_illuminant(&self.light, &self.standards);
        let similarity = |light: &SpectralDistribution, cct: Cct| {
            spectral_similarity(light, &similarity_reference(cct.temperature, &self.standards)?)
        };
        let held = held(&self.light).map(|light| {
            let ColorFidelity { fidelity, gamut, cct, .. } = color_fidelity(&light, &self.standards)?;
            Ok([fidelity, gamut, similarity(&light, cct)?])
        });
        let similarity = reference.as_ref().map_err(|&error| error).and_then(|(_, cct)| similarity(&self.light, *cct));
        Rendition {
            held,
            rendering: rendering_indices(&self.light, &self.standards),
            fidelity: color_fidelity(&self.light, &self.standards),
            reference: reference.map(|(spectrum, cct)| (Shared::new(spectrum), cct)),
            similarity,
        }
    }
}

/// Color consistency of a camera: differences of its colors under a light from those under the reference illuminant. The idea of
/// EBU's television lighting consistency index, for any camera.
///
/// ```text
/// Xᵢ = M (Iᵢ / W),   I = ∫ C S L dλ,   W = ∫ C L dλ
/// ```
/// The camera is balanced to each of the two lights, and corrected by one matrix M, that of the reference illuminant: a camera
/// knows its white balance, not the spectrum of the light. The differences are ΔE*00 between the two, L*a*b* relative to the
/// perfect diffuser, which is the same under both.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct ConsistencyQuery {
    /// The camera.
    pub sensor: Shared<Sensor>,
    /// The test light.
    pub light: Shared<GridSpectrum>,
    /// Its reference illuminant.
    pub reference: Shared<GridSpectrum>,
    /// Observer that the correction is fitted to.
    pub observer: Shared<Sensor>,
    /// Reflectances that the correction is fitted over.
    pub training: Shared<PatchSet>,
    /// The patches that are compared.
    pub patches: Shared<PatchSet>,
}

/// Differences between a camera's colors under a light and under the reference illuminant.
#[derive(Clone, Debug, PartialEq)]
pub struct Consistency {
    /// Index of each patch that has L*a*b* under both lights, with its ΔE*00.
    pub differences: Vec<(usize, f64)>,
    /// Mean ΔE*00.
    pub mean: f64,
    /// 95th percentile, as [`chromascope_math::quantile::quantile`] defines it.
    pub percentile_95: f64,
    /// Largest ΔE*00.
    pub max: f64,
    /// Patch with the largest difference.
    pub worst: usize,
}

/// Reason that a camera has no consistency under a light.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[allow(missing_docs, reason = "each variant says in its message what is wrong")]
pub enum ConsistencyError {
    #[error(transparent)]
    Rendering(#[from] RenderingError),
    #[error("no patch to compare")]
    NoPatch,
}

impl Query for ConsistencyQuery {
    type Answer = Result<Consistency, ConsistencyError>;
    const NAME: &'static str = "camera consistency";

    fn answer(&self, ask: &impl Ask) -> Self::Answer {
        let corrected = RenderingQuery {
            sensor: self.sensor.clone(),
            light: self.reference.clone(),
            white: WhiteBalanceTarget::UNITY,
            transform: ColorTransformSpec::Observer {
                reference: self.observer.clone(),
                training: self.training.clone(),
                correction: Correction::default(),
            },
        };
        let rendering = ask.ask(&corrected);
        let rendering = (*rendering).as_ref().map_err(|&error| error)?;
        let labs = |light: &GridSpectrum| -> Result<Vec<_>, ConsistencyError> {
            let (product, white) = (under_light(&self.sensor, light), white_divisors(&self.sensor, light)?);
            let lab = |values| rendering.lab(rendering.xyz(raw(&product, values) / white));
            Ok(self.patches.patches().iter().map(|patch| lab(patch.grid.values())).collect())
        };
        let (tests, references) = (labs(&self.light)?, labs(&self.reference)?);
        let pairs = tests.into_iter().zip(references);
        let all: Vec<Option<f64>> = pairs.map(|(a, b)| Some(delta_e_2000(b?, a?))).collect();
        let ErrorSummary { mean, p95, max, worst } = ErrorSummary::new(&all).ok_or(ConsistencyError::NoPatch)?;
        let known = all.iter().enumerate();
        let differences = known.filter_map(|(index, difference)| Some((index, (*difference)?))).collect();
        Ok(Consistency { differences, mean, percentile_95: p95, max, worst })
    }
}
