//! The visible scene as a measurement job.

use chromascope_core::light::RadiationConstants;
use chromascope_core::query::render::picture::{PicturesQuery, SourceOf};
use chromascope_core::query::{LocusQuery, PatchColorsQuery, Shared};
use chromascope_core::render::{Quality, RasterSize, Shadows};
use chromascope_mesh::Mesh;

use super::SceneRunJob;
use crate::scene::orbit::Orbit;
use crate::scene::render::Finish;
use crate::scene::{ComparedSensor, Scene};

/// The pictures that are measured on: as large as a pane's, whatever the window's size.
const WIDTH: u32 = 480;
const HEIGHT: u32 = 360;

impl SceneRunJob {
    /// The measurement job of a scene; `own` is a file's mesh, once it was read.
    pub fn of(scene: &Scene<'_>, own: Option<&Shared<Mesh>>, orbit: Option<Orbit>) -> Self {
        let sources = scene.sources();
        let (shown, hidden): (Vec<&ComparedSensor>, Vec<&ComparedSensor>) =
            sources.iter().partition(|source| source.visible);
        let rendering = |source: &&ComparedSensor| scene.rendering_of(source.kind, &source.name).ok();
        let rendered = |source: &&ComparedSensor| scene.rendered_through(source.kind, &source.name).ok();
        let renderings: Vec<_> = shown.iter().filter_map(rendering).collect();
        let temperatures = Scene::locus_temperatures().ok();
        let locus = |rendering: &_| {
            let constants = RadiationConstants::Paper;
            Some(LocusQuery { rendering: Clone::clone(rendering), temperatures: temperatures.clone()?, constants })
        };
        let patches = scene.patches().ok();
        let colors =
            |rendering: &_| Some(PatchColorsQuery { rendering: Clone::clone(rendering), patches: patches.clone()? });
        Self {
            scene: super::conditions::words(scene, scene.rendered_sources().len()),
            pictures: Self::pictures_of(scene, own, orbit, scene.document.render.quality()),
            hidden: hidden.iter().filter_map(rendered).map(|rendering| SourceOf { rendering }).collect(),
            sensors: shown.iter().filter_map(|source| scene.sensor(source.kind, &source.name).ok()).collect(),
            loci: renderings.iter().filter_map(locus).collect(),
            patches: renderings.iter().filter_map(colors).collect(),
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
