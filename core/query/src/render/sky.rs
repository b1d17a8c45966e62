//! Queries about light from the sky, and by way of the ground.

use super::{GeometryQuery, MeshQuery, ShadowTreeQuery, VisibilityQuery};
use crate::ask::{Ask, Query};
use chromascope_render::reflectance::{Normalization, Surface};
use chromascope_render::render::quality::SkyFineness;
use chromascope_render::render::sky::SkyView;
use chromascope_render::render::sky::ground::{self, Bounce, GroundView};
use chromascope_render::render::{Shadows, SkyImage, SkyReflectance, SkyVisibility};
use std::sync::Arc;

/// Cells of the sky that each vertex sees. None if stopped.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct SkyVisibilityQuery {
    /// The mesh.
    pub mesh: MeshQuery,
    /// True if the mesh hides the sky from itself.
    pub shadows: bool,
    /// True if the other side of its surface matters: light passes through it.
    pub through: bool,
}

impl Query for SkyVisibilityQuery {
    type Answer = Option<SkyVisibility>;
    const NAME: &'static str = "sky visibility";
    const CAPACITY: usize = 3;

    fn bytes(sky: &Self::Answer) -> usize {
        sky.as_ref().map_or(0, |sky| size_of_val(sky.cells()))
    }

    fn answer(&self, ask: &impl Ask) -> Self::Answer {
        let mesh = ask.ask(&self.mesh);
        if !self.shadows {
            return Some(SkyVisibility::open(&mesh));
        }
        let tree = ask.ask(&ShadowTreeQuery(self.mesh.clone()));
        SkyVisibility::new(&mesh, &tree, self.through || !self.mesh.is_closed(), &ask.stop())
    }
}

/// Visible shares of the sky at each sample that sees the mesh. None if stopped.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct SkyImageQuery {
    /// Visibility.
    pub visibility: VisibilityQuery,
    /// The surface.
    pub surface: Surface,
    /// Normalization of Eq 1.
    pub reading: Normalization,
    /// Exactness.
    pub fineness: SkyFineness,
    /// True if light shines through from behind.
    pub through: bool,
    /// True if the mesh hides the sky from itself.
    pub shadows: bool,
}

impl Query for SkyImageQuery {
    type Answer = Option<Arc<SkyImage>>;
    const NAME: &'static str = "sky";
    const CAPACITY: usize = 6;

    fn bytes(image: &Self::Answer) -> usize {
        image.as_ref().map_or(0, |image| size_of_val(image.samples()))
    }

    fn answer(&self, ask: &impl Ask) -> Self::Answer {
        let Self { surface, reading, fineness, through, shadows, .. } = self;
        let sky =
            ask.ask(&SkyVisibilityQuery { mesh: self.visibility.mesh.clone(), shadows: *shadows, through: *through });
        let (mesh, visibility) = (ask.ask(&self.visibility.mesh), ask.ask(&self.visibility));
        let view = SkyView { surface, reading: *reading, fineness: *fineness, through: *through };
        SkyImage::new(&mesh, (*visibility).as_ref()?, (*sky).as_ref()?, view, &ask.stop()).map(Arc::new)
    }
}

/// Cells below the horizon in which each vertex sees the ground. None if stopped.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct GroundViewQuery(pub MeshQuery);

impl Query for GroundViewQuery {
    type Answer = Option<GroundView>;
    const NAME: &'static str = "ground view";
    const CAPACITY: usize = 3;

    fn bytes(view: &Self::Answer) -> usize {
        view.as_ref().map_or(0, GroundView::bytes)
    }

    fn answer(&self, ask: &impl Ask) -> Self::Answer {
        GroundView::new(&ask.ask(&self.0), &ask.ask(&ShadowTreeQuery(self.0.clone())), &ask.stop())
    }
}

/// Light that a white ground sends to each lit sample of a picture; without full shadows nothing shades the ground. None if stopped.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct BounceQuery(pub GeometryQuery);

impl Query for BounceQuery {
    type Answer = Option<Arc<Vec<Bounce>>>;
    const NAME: &'static str = "bounce";
    const CAPACITY: usize = 6;

    fn bytes(bounce: &Self::Answer) -> usize {
        bounce.as_ref().map_or(0, |bounce| size_of_val(bounce.as_slice()))
    }

    fn answer(&self, ask: &impl Ask) -> Self::Answer {
        let GeometryQuery { visibility: seen, lighting, shadows, .. } = &self.0;
        let (mesh, view) = (ask.ask(&seen.mesh), ask.ask(&GroundViewQuery(seen.mesh.clone())));
        let (visibility, geometry) = (ask.ask(seen), ask.ask(&self.0));
        let (visibility, geometry) = ((*visibility).as_ref()?, (*geometry).as_ref()?);
        let tree = (*shadows == Shadows::Full).then(|| ask.ask(&ShadowTreeQuery(seen.mesh.clone())));
        let light = lighting.before(visibility.eye());
        let vertices = (*view).as_ref()?.at_vertices(&mesh, light, tree.as_deref(), &ask.stop())?;
        Some(Arc::new(ground::at_samples(&vertices, &mesh, visibility, geometry)))
    }
}

/// Hemispherical-directional reflectance of a surface over angle and wavelength.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct SkyReflectanceQuery {
    /// The surface.
    pub surface: Surface,
    /// Normalization of Eq 1.
    pub reading: Normalization,
}

impl Query for SkyReflectanceQuery {
    type Answer = SkyReflectance;
    const NAME: &'static str = "sky reflectance";
    const ALWAYS_COMPLETE: bool = true;
    const CAPACITY: usize = 16;

    fn bytes(reflectance: &Self::Answer) -> usize {
        reflectance.bytes()
    }

    fn answer(&self, _: &impl Ask) -> Self::Answer {
        SkyReflectance::new(self.surface, self.reading)
    }
}
