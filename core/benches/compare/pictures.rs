//! The scene of the benches: the head under the sun, through the truth and the paper's cameras.

use crate::asker::Remembering;
use crate::library::{patches, sensor, text};
use chromascope_core::camera::WhiteBalanceTarget;
use chromascope_core::query::render::picture::{PicturesQuery, SourceOf};
use chromascope_core::query::render::{
    CameraImageQuery, GeometryQuery, MeshQuery, Roughness, ShadingQuery, VisibilityQuery,
};
use chromascope_core::query::{Ask, ColorTransformSpec, RenderingQuery, Shared};
use chromascope_core::reflectance::{Normalization, Surface};
use chromascope_core::render::{CameraImage, Quality, RasterSize, Shadows};
use chromascope_core::scene::{Lighting, Viewpoint, lighting::SUN_RADIUS};
use chromascope_core::spectral::{Dataset, GridSpectrum, Quantity, Sensor};
use std::sync::Arc;

/// A camera's weights are made once; a picture is made anew.
pub(crate) struct RenderService {
    pub(crate) sources: Vec<RenderingQuery>,
    pub(crate) skin: Shared<GridSpectrum>,
    pub(crate) mesh: MeshQuery,
    pub(crate) size: RasterSize,
    pub(crate) shadows: Shadows,
    pub(crate) quality: Quality,
    pub(crate) reading: Normalization,
    pub(crate) sigma_m: f64,
    pub(crate) yaw: f64,
    pub(crate) light_right: f64,
    pub(crate) ev: f64,
}

/// The grid values of a file's first curve.
fn curve(path: &str) -> GridSpectrum {
    let data = Dataset::read(&text(path)).unwrap();
    GridSpectrum::resample(&data.curves[0], Quantity::Light)
}

impl RenderService {
    /// These sources, the truth first.
    pub(crate) fn new(sensors: &[Shared<Sensor>]) -> Self {
        let light = Shared::new(curve("illuminants/direct_sun_astm_g173.csv"));
        let observer = sensor(&text("observers/cie_1931_2deg.csv"));
        let d55 = Dataset::read(&text("illuminants/d55.csv")).unwrap();
        let white = WhiteBalanceTarget::from_light(&d55.curves[0], &observer).unwrap();
        let rendering = |sensor: &Shared<Sensor>| RenderingQuery {
            sensor: sensor.clone(),
            light: light.clone(),
            white,
            transform: ColorTransformSpec::Paper,
        };
        let skin = patches("materials/skin_vrhel.csv");
        let skin = Shared::new(skin.patches()[0].grid.clone());
        Self {
            sources: sensors.iter().map(rendering).collect(),
            skin,
            mesh: MeshQuery::Head(100_000),
            size: RasterSize::new(512, 512),
            shadows: Shadows::Coarse,
            quality: Quality::Full,
            reading: Normalization::Radiometric,
            sigma_m: 5e-6,
            yaw: 0.3,
            light_right: -25.0,
            ev: 0.0,
        }
    }

    pub(crate) fn surface(&self) -> Surface {
        Surface::new(self.sigma_m, 10e-6, 50e-6, 50e-6, 1.4).unwrap()
    }

    pub(crate) fn visibility(&self) -> VisibilityQuery {
        let viewpoint = Viewpoint::new(self.yaw, 0.1, 3.6, 30_f64.to_radians()).unwrap();
        VisibilityQuery { mesh: self.mesh.clone(), viewpoint, size: self.size }
    }

    pub(crate) fn geometry(&self) -> GeometryQuery {
        let (up, right) = (25_f64.to_radians(), self.light_right.to_radians());
        let lighting = Lighting::from_angles(up, right, SUN_RADIUS).unwrap();
        GeometryQuery { visibility: self.visibility(), lighting, shadows: self.shadows }
    }

    pub(crate) fn shading(&self) -> ShadingQuery {
        ShadingQuery {
            geometry: self.geometry(),
            surface: self.surface(),
            roughness: Roughness::Surface,
            reading: self.reading,
            quality: self.quality,
        }
    }

    pub(crate) fn pictures(&self) -> PicturesQuery {
        PicturesQuery {
            metric: chromascope_core::colorimetry::Metric::DELTA_E_2000,
            shading: self.shading(),
            reflectance: self.skin.clone(),
            reference: self.sources[0].clone(),
            sources: self.sources.iter().map(|rendering| SourceOf { rendering: rendering.clone() }).collect(),
            ev: self.ev.to_bits(),
            background: Some([0.2_f32.to_bits(); 3]),
            compared_samples: None,
        }
    }

    /// The question for one source's signals.
    pub(crate) fn image(&self, source: usize) -> CameraImageQuery {
        self.pictures().image(&self.sources[source])
    }

    /// The signals of all sources.
    pub(crate) fn images(&self, ask: &Remembering) -> Vec<CameraImage> {
        (0..self.sources.len()).map(|source| (*ask.ask(&self.image(source))).clone().unwrap().unwrap()).collect()
    }

    /// The pictures, made if they are not known.
    pub(crate) fn take(&self, ask: &Remembering) -> usize {
        let pictures: Arc<_> = ask.ask(&self.pictures());
        let pictures = (*pictures).as_ref().unwrap().as_ref().unwrap();
        pictures.pictures.iter().map(|picture| picture.as_ref().unwrap().rgba.len()).sum()
    }
}
