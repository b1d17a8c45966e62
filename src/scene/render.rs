//! The rendered scene as a question.

use chromascope_core::query::render::{GeometryOf, MeshOf, PicturesOf, ShadingOf, SourceOf, VisibilityOf};
use chromascope_core::query::{RenderingOf, Shared};
use chromascope_core::render::{Quality, RasterSize, Shadows};
use chromascope_core::scene::Viewpoint;
use chromascope_core::spectral::GridSpectrum;
use chromascope_mesh::Mesh;

use super::{Scene, SceneError, Source};
use crate::catalog::Kind;
use crate::document::render::MeshChoice;

/// How finely a picture is made.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Finish {
    /// Pixels and samples.
    pub size: RasterSize,
    /// How exactly integrals are made.
    pub quality: Quality,
    /// How finely shadows are traced, where there are any.
    pub shadows: Shadows,
    /// About how many samples are compared with the truth.
    pub compared_samples: Option<usize>,
}

impl Scene<'_> {
    /// The material's reflectance: the first of a set of several.
    pub fn material(&self, name: &str) -> Result<Shared<GridSpectrum>, SceneError> {
        let no_set = || SceneError::NoSet { kind: Kind::Material, name: name.to_owned() };
        let known =
            self.entry(Kind::Material, name).or_else(|_| self.entry(Kind::Chart, name)).map_err(|_| no_set())?;
        let set = self.loaded_patches(known.place, name, None)?;
        let patch = set.patches().first().ok_or_else(no_set)?;
        Ok(Shared::new(patch.grid.clone()))
    }

    /// The sources that are rendered: those on show, the truth first, without those that Eq 13 says nothing about beside it.
    pub fn rendered_sources(&self) -> Vec<Source> {
        let mut sources = self.sources();
        sources.retain(|source| {
            source.is_truth || (source.visible && matches!(self.comparable(source.kind, &source.name), Ok(Ok(()))))
        });
        sources
    }

    /// The mesh in question; a file's mesh is `own`, once it was read.
    pub fn mesh_of(&self, own: Option<&Shared<Mesh>>) -> Option<MeshOf> {
        let settings = &self.document.render;
        match &settings.mesh {
            MeshChoice::Head => Some(MeshOf::Head(settings.triangles)),
            MeshChoice::Fern => Some(MeshOf::Fern(settings.triangles)),
            MeshChoice::Sphere => Some(MeshOf::Sphere(settings.triangles)),
            MeshChoice::Plane => Some(MeshOf::Plane),
            MeshChoice::File(_) => own.cloned().map(MeshOf::Own),
        }
    }

    /// The pictures of these sources. `background` is in linear sRGB; without one, what is beside the mesh is transparent.
    pub fn pictures_of(
        &self,
        sources: &[Source],
        mesh: MeshOf,
        viewpoint: Viewpoint,
        finish: Finish,
        background: Option<[f32; 3]>,
    ) -> Result<PicturesOf, SceneError> {
        let settings = &self.document.render;
        let renderings = sources.iter().map(|source| self.rendering_of(source.kind, &source.name));
        let renderings: Vec<RenderingOf> = renderings.collect::<Result<_, _>>()?;
        let visibility = VisibilityOf { mesh, viewpoint, size: finish.size };
        let shadows = if settings.shadows { finish.shadows } else { Shadows::Off };
        let geometry = GeometryOf { visibility, lighting: settings.lighting()?, shadows };
        let shading = ShadingOf {
            geometry,
            surface: settings.surface()?,
            roughness: settings.roughness.roughness(),
            reading: settings.reading.reading(),
            quality: finish.quality,
        };
        Ok(PicturesOf {
            shading,
            reflectance: self.material(&settings.material)?,
            truth: self.rendering_of(Kind::Observer, &self.document.truth)?,
            sources: renderings.into_iter().map(|rendering| SourceOf { rendering }).collect(),
            ev: settings.exposure_ev.to_bits(),
            background: background.map(|color| color.map(f32::to_bits)),
            compared_samples: finish.compared_samples,
        })
    }
}
