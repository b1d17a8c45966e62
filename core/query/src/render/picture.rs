//! Pictures side by side: one exposure for all, differences to the reference.

use super::difference::{Difference, DifferenceQuery};
use super::{CameraImageQuery, LEAST_FACING, Parts, ShadingQuery, SpectralWeightsQuery};
use crate::ask::{Ask, Query, Shared};
use crate::patches::RenderingQuery;
use chromascope_color::camera::RenderingError;
use chromascope_color::colorimetry::{Metric, Xyz};
use chromascope_color::spectral::GridSpectrum;
use chromascope_mesh::Part;
use chromascope_render::reflectance::power::factors;
use chromascope_render::reflectance::{Geometry, Normalization, Specular, Surface, wavelength_power};
use chromascope_render::render::develop::develop;
use chromascope_render::render::exaggerate::{Exaggeration, develop_exaggerated};
use chromascope_render::render::{
    CameraImage, ColorimetricScale, Development, GeometryCounts, GeometryImage, Picture, ShadingCounts, SpectralWeights,
};
use glam::DVec3;
use std::sync::Arc;

/// The luminance that a material facing the light takes at 0 EV.
pub const MID_LUMINANCE: f64 = 0.4;

/// XYZ of a material that faces light and viewer, through the reference.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct ExposureQuery {
    /// The reference.
    pub reference: RenderingQuery,
    /// The material.
    pub reflectance: Shared<GridSpectrum>,
    /// Its roughness.
    pub surface: Surface,
    /// Normalization of Eq 1.
    pub reading: Normalization,
    /// The light's angular radius in radians, as bits.
    pub angular_radius: u64,
    /// True if a white that faces the light is to be the screen's: with a chart in the picture, which then shows colors as swatches do.
    pub by_white: bool,
}

/// Reference of exposure and of color measurements.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ExposureReference {
    /// XYZ of the material, through the reference.
    pub material: Xyz,
    /// Y of a white of the same roughness.
    pub white: f64,
    /// Y that is shown at [`MID_LUMINANCE`]: by a white 0.4 of its own; else that of the material, but not below [`LEAST_FACING`] of what it would be if it scattered evenly, where the
    /// normalization makes P a reflectance.
    pub exposed: f64,
}

impl ExposureReference {
    /// The factor on all cameras' signals at an exposure in EV: `2^EV · 0.4 / Y`, Y = [`Self::exposed`]. 0 for a black material.
    pub fn factor(&self, ev: f64) -> f64 {
        if self.exposed > 0.0 { ev.exp2() * MID_LUMINANCE / self.exposed } else { 0.0 }
    }
}

impl Query for ExposureQuery {
    type Answer = Result<ExposureReference, RenderingError>;
    const NAME: &'static str = "exposure";

    fn answer(&self, ask: &impl Ask) -> Self::Answer {
        let rendering = ask.ask(&self.reference);
        let rendering = (*rendering).as_ref().map_err(|&e| e)?;
        let measure = |reflectance: Shared<GridSpectrum>| {
            let (sensor, light) = (self.reference.sensor.clone(), self.reference.light.clone());
            ask.ask(&SpectralWeightsQuery { sensor, light, reflectance, reading: Normalization::Lambertian })
        };
        let (white, material) = (measure(Shared::new(GridSpectrum::constant(1.0))), measure(self.reflectance.clone()));
        let white = (*white).as_ref().map_err(|&e| e)?;
        let material = (*material).as_ref().map_err(|&e| e)?;
        let xyz = |measure: &SpectralWeights| rendering.xyz(rendering.white * self.signals(measure, white));
        let (facing, is_reflectance) = (xyz(material), wavelength_power(self.reading) != 0);
        let even = rendering.xyz(rendering.white * DVec3::from_array(material.totals())).y;
        let facing_white = xyz(white).y;
        let exposed = match (self.by_white, is_reflectance) {
            (true, _) => MID_LUMINANCE * if is_reflectance { facing_white.max(LEAST_FACING) } else { facing_white },
            (false, true) => facing.y.max(LEAST_FACING * even),
            (false, false) => facing.y,
        };
        Ok(ExposureReference { material: facing, white: facing_white, exposed })
    }
}

impl ExposureQuery {
    /// `∫ C_c S P L dλ / ∫ C_c L dλ` with light, eye and normal along one line, where nothing oscillates: a few wavelengths do.
    /// An untinted coherent component is weighed by the measure of a white.
    fn signals(&self, material: &SpectralWeights, white: &SpectralWeights) -> DVec3 {
        let facing = Geometry::from_angles(0.0, 0.0, 0.0);
        let radius = f64::from_bits(self.angular_radius);
        let component = |measure: &SpectralWeights, which: usize| {
            let at = |nm| factors(&self.surface, &facing, nm, self.reading, radius)[which];
            measure.fine().iter().map(|node| DVec3::from_array(node.weights) * at(node.wavelength_nm)).sum::<DVec3>()
        };
        let untinted = self.surface.specular() == Specular::Fresnel;
        component(material, 0) + component(if untinted { white } else { material }, 1)
    }
}

/// Picture of a camera.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct PictureQuery {
    /// Its signals.
    pub image: CameraImageQuery,
    /// White balance.
    pub rendering: RenderingQuery,
    /// Exposure in EV, as bits.
    pub ev: u64,
    /// Reference of exposure.
    pub exposure: ExposureQuery,
    /// Background in linear sRGB as bits; none leaves it transparent.
    pub background: Option<[u32; 3]>,
    /// Reference from which its differences are multiplied; none shows them as they are.
    pub exaggerated: Option<Exaggerated>,
}

/// Reference of a picture whose differences from it are multiplied.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Exaggerated {
    /// The reference's signals.
    pub image: CameraImageQuery,
    /// Their balance and color transform.
    pub rendering: RenderingQuery,
    /// The factor, as bits.
    pub factor: u64,
}

impl PictureQuery {
    /// The picture with its differences multiplied; samples are clipped where they are in the picture as it is.
    fn exaggerated(&self, of: &Exaggerated, ask: &impl Ask) -> <Self as Query>::Answer {
        let plain = ask.ask(&Self { exaggerated: None, ..self.clone() });
        let (facing, own) = (ask.ask(&self.exposure), ask.ask(&self.rendering));
        let (reference, images) = (ask.ask(&of.rendering), [&self.image, &of.image].map(|image| ask.ask(image)));
        let facing = (*facing).as_ref().map_err(|&e| e)?;
        let [own, reference] = [&own, &reference].map(|rendering| (**rendering).as_ref().map_err(|&e| e));
        let (own, reference) = (own?, reference?);
        let [image, of_reference] = [&images[0], &images[1]].map(|image| (**image).as_ref().map_err(|&e| e));
        let Some(((image, of_reference), plain)) = image?.as_ref().zip(of_reference?.as_ref()).zip((*plain).clone()?)
        else {
            return Ok(None);
        };
        let scales = [own, reference].map(|rendering| ColorimetricScale::new(rendering, facing.white));
        let how = Exaggeration {
            scales: [&scales[0], &scales[1]],
            srgb_from_xyz: own.srgb_from_xyz,
            brightness: facing.factor(f64::from_bits(self.ev)) * facing.white,
            factor: f64::from_bits(of.factor),
            background: self.background.map(|color| color.map(f32::from_bits)),
        };
        let signals = [image.signals(), of_reference.signals()];
        let picture = develop_exaggerated(image.placed(), signals, &how, &ask.stop());
        Ok(picture.map(|picture| Arc::new(Picture { clipped: plain.clipped, ..picture })))
    }
}

impl Query for PictureQuery {
    type Answer = Result<Option<Arc<Picture>>, RenderingError>;
    const NAME: &'static str = "picture";
    const CAPACITY: usize = 64;

    fn bytes(picture: &Self::Answer) -> usize {
        picture.as_ref().ok().and_then(Option::as_ref).map_or(0, |picture| picture.rgba.len())
    }

    fn answer(&self, ask: &impl Ask) -> Self::Answer {
        if let Some(of) = &self.exaggerated {
            return self.exaggerated(of, ask);
        }
        let facing = ask.ask(&self.exposure);
        let facing = (*facing).as_ref().map_err(|&e| e)?;
        let rendering = ask.ask(&self.rendering);
        let rendering = (*rendering).as_ref().map_err(|&e| e)?;
        let image = ask.ask(&self.image);
        let Some(image) = (*image).as_ref().map_err(|&e| e)? else { return Ok(None) };
        let background = self.background.map(|color| color.map(f32::from_bits));
        let development = Development::new(rendering, facing.factor(f64::from_bits(self.ev)), background);
        Ok(develop(image, &development, &ask.stop()).map(Arc::new))
    }
}

/// Pictures of one shaded mesh through several sensors.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct PicturesQuery {
    /// The shaded mesh.
    pub shading: ShadingQuery,
    /// The material.
    pub reflectance: Shared<GridSpectrum>,
    /// Reflectances of parts of the mesh, ascending by part; others have that of the body.
    pub parts: Parts,
    /// The reference; exposure and differences go by it.
    pub reference: RenderingQuery,
    /// All visible sensors, the reference among them or not.
    pub sources: Vec<RenderingQuery>,
    /// Exposure in EV, as bits.
    pub ev: u64,
    /// Background in linear sRGB as bits.
    pub background: Option<[u32; 3]>,
    /// Metric of the differences from the reference.
    pub metric: Metric,
    /// Factor on the pictures' differences from the reference as bits; numbers and maps stay as they are.
    pub exaggeration: u64,
    /// About how many samples are compared with the reference; none compares nothing.
    pub compared_samples: Option<usize>,
}

/// Pictures side by side.
#[derive(Clone, Debug)]
pub struct Pictures {
    /// Of each source its picture, or why there is none.
    pub pictures: Vec<Result<Arc<Picture>, RenderingError>>,
    /// Of each source its signals, to read pixels from.
    pub images: Vec<Option<CameraImage>>,
    /// Of each source how far it is from the reference.
    pub differences: Vec<Option<Arc<Difference>>>,
    /// The angles at the lit samples, to read pixels from.
    pub angles: Arc<GeometryImage>,
    /// Reference of exposure.
    pub facing: ExposureReference,
    /// Reason that samples are dark.
    pub geometry: GeometryCounts,
    /// Methods of integration.
    pub shading: ShadingCounts,
}

impl PicturesQuery {
    /// Reference of exposure.
    pub fn exposure(&self) -> ExposureQuery {
        ExposureQuery {
            reference: self.reference.clone(),
            reflectance: self.reflectance.clone(),
            surface: self.shading.surface,
            reading: self.shading.reading,
            angular_radius: self.shading.geometry.lighting.angular_radius().to_bits(),
            by_white: self.parts.iter().any(|(part, _)| matches!(part, Part::Patch(_))),
        }
    }

    /// A source's signals.
    pub fn image(&self, rendering: &RenderingQuery) -> CameraImageQuery {
        let measure = SpectralWeightsQuery {
            sensor: rendering.sensor.clone(),
            light: rendering.light.clone(),
            reflectance: self.reflectance.clone(),
            reading: self.shading.reading,
        };
        CameraImageQuery { shading: self.shading.clone(), measure, parts: self.parts.clone() }
    }

    /// A source's picture.
    pub fn picture(&self, rendering: &RenderingQuery) -> PictureQuery {
        PictureQuery {
            image: self.image(rendering),
            rendering: rendering.clone(),
            ev: self.ev,
            exposure: self.exposure(),
            background: self.background,
            exaggerated: (f64::from_bits(self.exaggeration) != 1.0 && *rendering != self.reference).then(|| {
                Exaggerated {
                    image: self.image(&self.reference),
                    rendering: self.reference.clone(),
                    factor: self.exaggeration,
                }
            }),
        }
    }

    /// Difference of a sensor from the reference, at each `stride`-th lit sample.
    pub fn difference(&self, rendering: &RenderingQuery, stride: usize) -> DifferenceQuery {
        DifferenceQuery {
            metric: self.metric,
            image: self.image(rendering),
            rendering: rendering.clone(),
            reference: self.image(&self.reference),
            exposure: self.exposure(),
            stride,
        }
    }

    fn compare(&self, ask: &impl Ask, lit: usize) -> Vec<Option<Arc<Difference>>> {
        let Some(wanted) = self.compared_samples else { return vec![None; self.sources.len()] };
        let stride = lit.div_ceil(wanted.max(1)).max(1);
        let of = |source: &RenderingQuery| {
            if *source == self.reference {
                return None;
            }
            let answer = ask.ask(&self.difference(source, stride));
            (*answer).as_ref().ok().and_then(Clone::clone)
        };
        self.sources.iter().map(of).collect()
    }
}

impl Query for PicturesQuery {
    type Answer = Result<Option<Pictures>, RenderingError>;
    const NAME: &'static str = "pictures";
    // Each holds on to all of its parts.
    const CAPACITY: usize = 2;

    fn answer(&self, ask: &impl Ask) -> Self::Answer {
        let facing = *ask.ask(&self.exposure());
        let facing = facing?;
        let shading = ask.ask(&self.shading);
        let Some(shading) = (*shading).as_ref() else { return Ok(None) };
        let mut pictures = Vec::with_capacity(self.sources.len());
        let mut images = Vec::with_capacity(self.sources.len());
        for source in &self.sources {
            match &*ask.ask(&self.picture(source)) {
                Ok(Some(picture)) => pictures.push(Ok(Arc::clone(picture))),
                Ok(None) => return Ok(None),
                Err(error) => pictures.push(Err(*error)),
            }
            let image = ask.ask(&self.image(source));
            images.push((*image).as_ref().ok().and_then(Clone::clone));
        }
        let angles = Arc::clone(shading.geometry());
        let geometry = angles.counts();
        let differences = self.compare(ask, angles.samples().len());
        Ok(Some(Pictures { pictures, images, differences, facing, angles, geometry, shading: shading.counts() }))
    }
}
