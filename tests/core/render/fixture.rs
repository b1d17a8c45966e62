//! Small scene for the tests of pictures, and an evaluator that caches answers and counts computations.

use std::any::Any;
use std::cell::RefCell;
use std::collections::BTreeMap;
use std::sync::Arc;

use chromascope_core::camera::WhiteBalanceTarget;
use chromascope_core::colorimetry::Metric;
use chromascope_core::query::render::MeshQuery;
use chromascope_core::query::render::picture::{Pictures, PicturesQuery};
use chromascope_core::query::render::{GeometryQuery, Parts, Roughness, ShadingQuery, VisibilityQuery};
use chromascope_core::query::{Ask, ColorTransformSpec, Query, RenderingQuery, Shared};
use chromascope_core::reflectance::{Normalization, Specular, Surface};
use chromascope_core::render::{Quality, RasterSize, Reach, Shadows};
use chromascope_core::scene::{Lighting, Viewpoint, lighting::SUN_RADIUS};
use chromascope_core::spectral::GridSpectrum;

use crate::support;

/// Scene and settings of a picture; each test changes what it is about.
#[derive(Clone)]
pub(super) struct FrameCase {
    pub sources: Vec<RenderingQuery>,
    pub reflectance: Shared<GridSpectrum>,
    pub parts: Parts,
    pub mesh: MeshQuery,
    pub size: RasterSize,
    pub yaw: f64,
    pub light_up: f64,
    pub light_right: f64,
    pub sky: Option<f64>,
    pub through: bool,
    pub sigma_m: f64,
    pub tau_m: f64,
    pub half_width_m: f64,
    pub angular_radius: f64,
    pub specular: Specular,
    pub shadows: Shadows,
    pub reading: Normalization,
    pub roughness: Roughness,
    pub quality: Quality,
    pub ev: f64,
    pub metric: Metric,
}

impl FrameCase {
    /// Skin under the sun on a sphere, through Stiles & Burch and the paper's cameras, at σ = 5 µm.
    pub(super) fn new() -> Self {
        let light = Shared::new(support::light("illuminants/direct_sun_astm_g173.csv"));
        let sensors = [support::REFERENCE, support::CANON_10D, support::NIKON_D70, support::DCS200];
        let skin = support::patches("materials/skin_vrhel.csv");
        let white =
            WhiteBalanceTarget::from_chromaticity(chromascope_core::colorimetry::Xy { x: 0.3324, y: 0.3474 }).unwrap();
        let rendering = |path: &&str| RenderingQuery {
            sensor: Shared::new(support::sensor(path)),
            light: light.clone(),
            white,
            transform: ColorTransformSpec::Paper,
        };
        Self {
            sources: sensors.iter().map(rendering).collect(),
            reflectance: Shared::new(skin.patches()[0].grid.clone()),
            parts: Parts::new(),
            mesh: MeshQuery::Sphere(2_000),
            size: RasterSize::new(40, 40),
            yaw: 0.0,
            light_up: 25.0,
            light_right: -25.0,
            sky: None,
            through: false,
            sigma_m: 5e-6,
            tau_m: 10e-6,
            half_width_m: 50e-6,
            angular_radius: SUN_RADIUS,
            specular: Specular::Paper,
            shadows: Shadows::Full,
            reading: Normalization::Radiometric,
            roughness: Roughness::Surface,
            quality: Quality::Full,
            ev: 0.0,
            metric: Metric::DELTA_E_2000,
        }
    }

    pub(super) fn surface(&self) -> Surface {
        let half = self.half_width_m;
        Surface::new(self.sigma_m, self.tau_m, half, half, 1.4).unwrap().with_specular(self.specular)
    }

    pub(super) fn question(&self) -> PicturesQuery {
        let viewpoint = Viewpoint::new(self.yaw, 0.1, 3.6, 30_f64.to_radians()).unwrap();
        let visibility = VisibilityQuery { mesh: self.mesh.clone(), viewpoint, size: self.size };
        let (up, right) = (self.light_up.to_radians(), self.light_right.to_radians());
        let lighting = Lighting::from_angles(up, right, self.angular_radius).unwrap();
        let reach = Reach { everywhere: self.sky.is_some(), through: self.through };
        let geometry = GeometryQuery { visibility, lighting, shadows: self.shadows, reach };
        let (surface, reading, quality) = (self.surface(), self.reading, self.quality);
        let sky = self.sky.map(f64::to_bits);
        PicturesQuery {
            shading: ShadingQuery {
                geometry,
                surface,
                roughness: self.roughness,
                reading,
                quality,
                sky,
                open_sky: false,
                bounce: false,
                diffusion: false,
            },
            reflectance: self.reflectance.clone(),
            parts: self.parts.clone(),
            reference: self.sources[0].clone(),
            sources: self.sources.clone(),
            ev: self.ev.to_bits(),
            background: None,
            metric: self.metric,
            exaggeration: 1_f64.to_bits(),
            compared_samples: Some(500),
        }
    }

    pub(super) fn take(&self, ask: &impl Ask) -> Pictures {
        (*ask.ask(&self.question())).clone().unwrap().unwrap()
    }
}

/// Remembers all answers; counts by kind which had to be made.
#[derive(Default)]
pub(super) struct Counting {
    known: RefCell<Vec<Known>>,
    made: RefCell<BTreeMap<&'static str, usize>>,
}

type Known = (Box<dyn Any>, Box<dyn Any>);

impl Counting {
    /// Computations since the last call.
    pub(super) fn made(&self) -> BTreeMap<&'static str, usize> {
        self.made.take()
    }
}

impl Ask for Counting {
    fn ask<Q: Query>(&self, query: &Q) -> Arc<Q::Answer> {
        let found = self.known.borrow().iter().find_map(|(question, answer)| {
            let same = question.downcast_ref::<Q>().is_some_and(|known| known == query);
            if same { answer.downcast_ref::<Arc<Q::Answer>>().cloned() } else { None }
        });
        found.unwrap_or_else(|| {
            let answer = Arc::new(query.answer(self));
            *self.made.borrow_mut().entry(Q::NAME).or_default() += 1;
            self.known.borrow_mut().push((Box::new(query.clone()), Box::new(Arc::clone(&answer))));
            answer
        })
    }
}
