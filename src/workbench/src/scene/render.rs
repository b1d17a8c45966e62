//! The rendered scene as a query.

use chromascope_core::query::render::picture::PicturesQuery;
use chromascope_core::query::render::{GeometryQuery, MeshQuery, ShadingQuery, VisibilityQuery};
use chromascope_core::query::{RenderingQuery, Shared};
use chromascope_core::render::{Quality, RasterSize, Reach, Shadows};
use chromascope_core::scene::Viewpoint;
use chromascope_core::spectral::GridSpectrum;
use chromascope_mesh::Mesh;

use super::{ComparedSensor, Result, Scene, SceneError};
use crate::catalog::load::PatchesQuery;
use crate::document::render::{BALANCE, MeshChoice, SUN};
use crate::document::{SetKind, WhiteBalanceChoice};

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Finish {
    pub size: RasterSize,
    pub quality: Quality,
    /// Sampling of shadows, where there are any.
    pub shadows: Shadows,
    /// Approximate number of samples compared with the reference.
    pub compared_samples: Option<usize>,
    /// True if the mesh hides no part of the sky: pictures before it is known which.
    pub open_sky: bool,
}

impl Finish {
    /// Of pictures that are made at once, compared in all samples.
    pub fn whole(size: RasterSize, quality: Quality) -> Self {
        let shadows = if quality == Quality::Preview { Shadows::Coarse } else { Shadows::Full };
        Self { size, quality, shadows, compared_samples: Some(usize::MAX), open_sky: false }
    }
}

impl Scene<'_> {
    /// The material's reflectance: the first of a set of several.
    pub fn material(&self, name: &str) -> Result<Shared<GridSpectrum>> {
        let no_set = || SceneError::NoSet { kind: SetKind::Material, name: name.to_owned() };
        let known = self.entry(SetKind::Material, name).or_else(|_| self.chart_entry(name)).map_err(|_| no_set())?;
        let set = self.loaded(&PatchesQuery { place: known.place, names: None }, name)?;
        let patch = set.patches().first().ok_or_else(no_set)?;
        Ok(Shared::new(patch.grid.clone()))
    }

    /// The rendered sensors: those compared, the reference first, without those for which Eq 13 is undefined.
    pub fn rendered_sources(&self) -> Vec<ComparedSensor> {
        let mut sources = self.sources();
        sources
            .retain(|source| source.is_reference || (source.visible && self.is_comparable(source.kind, &source.name)));
        sources
    }

    /// The selected mesh; a file's mesh is `own`, once it was read.
    pub fn mesh_of(&self, own: Option<&Shared<Mesh>>) -> Option<MeshQuery> {
        let settings = &self.document.render;
        match &settings.mesh {
            MeshChoice::Head if settings.garment.is_some() => Some(MeshQuery::ClothedHead(settings.triangles)),
            MeshChoice::Head => Some(MeshQuery::Head(settings.triangles)),
            MeshChoice::Fern => Some(MeshQuery::Fern(settings.triangles)),
            MeshChoice::Sphere => Some(MeshQuery::Sphere(settings.triangles)),
            MeshChoice::Plane => Some(MeshQuery::Plane),
            MeshChoice::File(_) => own.cloned().map(MeshQuery::Own),
            MeshChoice::Image(_) => None,
        }
    }

    /// A sensor under the rendered scene's light, balanced to its white.
    pub fn rendered_through(&self, kind: SetKind, name: &str) -> Result<RenderingQuery> {
        let chosen = self.rendering_of(kind, name)?;
        if !self.is_sunlit() {
            return Ok(chosen);
        }
        let (light, white) = (self.built_in_light(SUN)?.grid, self.white_target(&Self::balance())?);
        Ok(RenderingQuery { light, white, ..chosen })
    }

    /// True if the rendered mesh is under [`SUN`], balanced to [`BALANCE`], whatever the light of the other panes.
    pub fn is_sunlit(&self) -> bool {
        self.document.render.sunlight && !self.document.render.mesh.is_image()
    }

    fn balance() -> WhiteBalanceChoice {
        WhiteBalanceChoice::Light(BALANCE.to_owned())
    }

    /// The names of the rendered scene's light and white.
    pub fn rendered_conditions(&self) -> [String; 2] {
        if self.is_sunlit() {
            return [SUN.to_owned(), Self::balance().name()];
        }
        [self.light_name(), self.document.white.name()]
    }

    /// The pictures of these sensors. `background` is in linear sRGB; without one, pixels outside the mesh are transparent.
    pub fn pictures_of(
        &self,
        sources: &[ComparedSensor],
        mesh: MeshQuery,
        viewpoint: Viewpoint,
        finish: Finish,
        background: Option<[f32; 3]>,
    ) -> Result<PicturesQuery> {
        let settings = &self.document.render;
        let renderings = sources.iter().map(|source| self.rendered_through(source.kind, &source.name));
        let renderings: Vec<RenderingQuery> = renderings.collect::<Result<_, _>>()?;
        let visibility = VisibilityQuery { mesh, viewpoint, size: finish.size };
        let shadows = if settings.shadows { finish.shadows } else { Shadows::Off };
        let reach = Reach { everywhere: settings.sky > 0.0, through: settings.thin };
        let geometry = GeometryQuery { visibility, lighting: settings.lighting()?, shadows, reach };
        let shading = ShadingQuery {
            geometry,
            surface: settings.surface()?,
            roughness: settings.roughness,
            reading: settings.normalization,
            quality: finish.quality,
            sky: (settings.sky > 0.0).then(|| settings.sky.to_bits()),
            open_sky: finish.open_sky,
        };
        Ok(PicturesQuery {
            shading,
            reflectance: self.material(&settings.material)?,
            garment: settings.worn().map(|garment| self.material(garment)).transpose()?,
            reference: self.rendered_through(SetKind::Observer, &self.document.reference)?,
            sources: renderings,
            ev: settings.exposure_ev.to_bits(),
            background: background.map(|color| color.map(f32::to_bits)),
            metric: self.document.difference,
            compared_samples: finish.compared_samples,
        })
    }
}
