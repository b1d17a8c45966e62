//! The visible scene as a measurement job.

use chromascope_core::query::Shared;
use chromascope_core::query::render::picture::PicturesQuery;
use chromascope_core::render::{Quality, RasterSize, Shadows};
use chromascope_mesh::Mesh;

use super::SceneRunJob;
use crate::scene::Scene;
use crate::scene::orbit::Orbit;
use crate::scene::render::Finish;

/// The pictures that are measured on: as large as a pane's, whatever the window's size.
const WIDTH: u32 = 480;
const HEIGHT: u32 = 360;

impl SceneRunJob {
    /// The measurement job of a scene; `own` is a file's mesh, once it was read.
    pub fn of(scene: &Scene<'_>, own: Option<&Shared<Mesh>>, orbit: Option<Orbit>) -> Self {
        let sources = scene.sources();
        let sources = sources.iter().filter(|source| source.visible);
        Self {
            scene: super::conditions::words(scene, scene.rendered_sources().len()),
            pictures: Self::pictures_of(scene, own, orbit, scene.document.render.quality()),
            sensors: sources.filter_map(|source| scene.sensor(source.kind, &source.name).ok()).collect(),
        }
    }

    /// The pictures that are measured on, at a quality; none where there is nothing to render.
    pub fn pictures_of(
        scene: &Scene<'_>,
        own: Option<&Shared<Mesh>>,
        orbit: Option<Orbit>,
        quality: Quality,
    ) -> Option<PicturesQuery> {
        let sources = scene.rendered_sources();
        let settings = &scene.document.render;
        let orbit = orbit.unwrap_or_else(|| Orbit::of(&settings.mesh));
        let viewpoint = orbit.viewpoint(f64::from(WIDTH) / f64::from(HEIGHT))?;
        let finish = Finish {
            size: RasterSize { width: WIDTH, height: HEIGHT, samples: 1 }.clamped(),
            quality,
            shadows: Shadows::Full,
            compared_samples: None,
            open_sky: false,
        };
        if sources.is_empty() {
            return None;
        }
        scene.pictures_of(&sources, scene.mesh_of(own)?, viewpoint, finish, None).ok()
    }
}
