//! The rendered scene as a query.

use chromascope_core::query::render::picture::PicturesQuery;
use chromascope_core::query::render::{GeometryQuery, MeshQuery, Parts, ShadingQuery, VisibilityQuery};
use chromascope_core::query::{RenderingQuery, Shared};
use chromascope_core::render::{Quality, RasterSize, Reach, Shadows};
use chromascope_core::scene::Viewpoint;
use chromascope_core::spectral::GridSpectrum;
use chromascope_mesh::stage::Stage;
use chromascope_mesh::{Mesh, Part};

use super::{ComparedSensor, Result, Scene, SceneError};
use crate::catalog::load::PatchesQuery;
use crate::document::render::{BALANCE, HAIR, MeshChoice, SUN};
use crate::document::{CHART, SetKind, WhiteBalanceChoice};

/// Patches of [`CHART`] that card and ground are of.
const BLACK: &str = "black";
const GRAY: &str = "neutral 5";
/// A chart in the picture has no more patches: they would be smaller than pixels.
const MOST_PATCHES: usize = 600;

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
        let mesh = match &settings.mesh {
            MeshChoice::Head if settings.garment.is_some() => Some(MeshQuery::ClothedHead(settings.triangles)),
            MeshChoice::Head => Some(MeshQuery::Head(settings.triangles)),
            MeshChoice::Fern => Some(MeshQuery::Fern(settings.triangles)),
            MeshChoice::Sphere => Some(MeshQuery::Sphere(settings.triangles)),
            MeshChoice::Plane => Some(MeshQuery::Plane),
            MeshChoice::File(_) => own.cloned().map(MeshQuery::Own),
            MeshChoice::Image(_) => None,
        }?;
        let stage = self.stage();
        Some(if stage == Stage::default() { mesh } else { MeshQuery::Staged(Box::new(mesh), stage) })
    }

    fn stage(&self) -> Stage {
        let settings = &self.document.render;
        let patches = settings.chart.then(|| self.patches().map_or(0, |set| set.patches().len().min(MOST_PATCHES)));
        let cropped = settings.composed && settings.mesh == MeshChoice::Head;
        let hair = settings.hair && settings.mesh == MeshChoice::Head;
        Stage { patches: patches.unwrap_or(0) as u16, ground: settings.ground, hair, cropped }
    }

    /// Reflectances of what is no body: the garment, the chart's patches and what holds them, the ground.
    fn parts(&self) -> Result<Parts> {
        let settings = &self.document.render;
        let garment = settings.worn().map(|garment| self.material(garment)).transpose()?;
        let mut parts: Parts = garment.map(|garment| (Part::Garment, garment)).into_iter().collect();
        let stage = self.stage();
        if stage == Stage::default() {
            return Ok(parts);
        }
        if stage.hair {
            let hair = self.material(HAIR)?;
            parts.extend([Part::Hair, Part::Brows].map(|part| (part, hair.clone())));
        }
        if settings.chart {
            let set = self.patches()?;
            let patches = set.patches().iter().take(stage.patches.into());
            let grids = patches.map(|patch| Shared::new(patch.grid.clone()));
            parts.extend((0..).map(Part::Patch).zip(grids));
        }
        let card = self.patch_set(CHART, None)?;
        let named = |name: &str| card.patches().iter().find(|patch| patch.name == name);
        let gray = |part, name| named(name).map(|patch| (part, Shared::new(patch.grid.clone())));
        parts.extend([gray(Part::Card, BLACK), gray(Part::Ground, GRAY)].into_iter().flatten());
        Ok(parts)
    }

    /// The name of a patch of the chart in the picture.
    pub fn patch_name(&self, part: Part) -> Option<String> {
        let Part::Patch(index) = part else { return None };
        Some(self.patches().ok()?.patches().get(usize::from(index))?.name.clone())
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
        let diffusion = settings.diffusion && settings.mesh == MeshChoice::Head && !finish.open_sky;
        let everywhere = settings.sky > 0.0 || settings.ground || diffusion;
        let reach = Reach { everywhere, through: settings.thin };
        let geometry = GeometryQuery { visibility, lighting: settings.lighting()?, shadows, reach };
        let shading = ShadingQuery {
            geometry,
            surface: settings.surface()?,
            roughness: settings.roughness,
            reading: settings.normalization,
            quality: finish.quality,
            sky: (settings.sky > 0.0).then(|| settings.sky.to_bits()),
            open_sky: finish.open_sky,
            bounce: self.stage().ground && !finish.open_sky,
            diffusion,
        };
        Ok(PicturesQuery {
            shading,
            reflectance: self.material(&settings.material)?,
            parts: self.parts()?,
            reference: self.rendered_through(SetKind::Observer, &self.document.reference)?,
            sources: renderings,
            ev: settings.exposure_ev.to_bits(),
            background: background.map(|color| color.map(f32::to_bits)),
            metric: self.document.difference,
            exaggeration: self.document.exaggeration.factor().to_bits(),
            compared_samples: finish.compared_samples,
        })
    }
}
