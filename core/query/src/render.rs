//! Queries about pictures of meshes, split where the inputs split.
//!
//! A viewpoint depends on no light, a light's position on no spectrum, a surface on no camera, a camera's signals on no white
//! balance: moving a slider recomputes only what depends on it.

pub mod difference;
pub mod picture;
pub mod returned;
mod sky;

use super::ask::{Ask, Query, Shared};
use chromascope_color::accuracy::RelTolerance;
use chromascope_color::camera::RenderingError;
use chromascope_color::camera::rendering::{raw, under_light, white_divisors};
use chromascope_color::spectral::grid::wavelength_nm;
use chromascope_color::spectral::{GridSpectrum, Sensor};
use chromascope_mesh::stage::Stage;
use chromascope_mesh::{Mesh, Part, ShadowTree, fern, head, shapes};
use chromascope_render::reflectance::diffusion;
use chromascope_render::reflectance::leaf::{LeafModel, ScatteredShare};
use chromascope_render::reflectance::power::{LAMBDA_0_NM, factor};
use chromascope_render::reflectance::{Geometry, Normalization, Specular, Surface, wavelength_power};
use chromascope_render::render::diffusion::changes;
use chromascope_render::render::{
    CameraImage, Demand, GeometryImage, MattePart, Plan, Quality, RasterSize, Reach, ShadingImage, Shadows, Sky,
    SpectralWeights, Transmitted, VertexImage, Visibility,
};
use chromascope_render::scene::roughness::{VertexRoughness, vertex_roughness};
use chromascope_render::scene::{Lighting, Viewpoint};
use chromascope_text::choices;
use std::sync::Arc;

pub use sky::{BounceQuery, GroundViewQuery, SkyImageQuery, SkyReflectanceQuery, SkyVisibilityQuery};

/// Least share of the brightness of an even (Lambertian) scatterer that a material facing the light is exposed for. Steeper
/// surfaces send less straight back and more to grazing views: exposed for that, they would be white there.
pub const LEAST_FACING: f64 = 0.2;

/// A mesh.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum MeshQuery {
    /// The head, with about this many triangles.
    Head(usize),
    /// The head in a garment.
    ClothedHead(usize),
    /// The fern.
    Fern(usize),
    /// A sphere.
    Sphere(usize),
    /// A square that faces the front.
    Plane,
    /// The user's own.
    Own(Shared<Mesh>),
    /// A mesh with what stands about it.
    Staged(Box<MeshQuery>, Stage),
}

impl Query for MeshQuery {
    type Answer = Shared<Mesh>;
    const NAME: &'static str = "mesh";
    const ALWAYS_COMPLETE: bool = true;
    const CAPACITY: usize = 3;

    fn bytes(mesh: &Self::Answer) -> usize {
        size_of_val(mesh.positions()) + size_of_val(mesh.normals()) + size_of_val(mesh.triangles())
    }

    fn answer(&self, ask: &impl Ask) -> Self::Answer {
        match self {
            Self::Head(triangles) => Shared::new(head::head(*triangles)),
            Self::ClothedHead(triangles) => Shared::new(head::clothed(*triangles)),
            Self::Fern(triangles) => Shared::new(fern::fern(*triangles)),
            Self::Sphere(triangles) => Shared::new(shapes::sphere(*triangles)),
            Self::Plane => Shared::new(shapes::plane(2)),
            Self::Own(mesh) => mesh.clone(),
            Self::Staged(mesh, stage) => Shared::new(stage.about(&ask.ask(&**mesh))),
        }
    }
}

impl MeshQuery {
    /// True if nothing sees the inner side of its surface.
    fn is_closed(&self) -> bool {
        match self {
            Self::Head(_) | Self::ClothedHead(_) | Self::Sphere(_) => true,
            Self::Fern(_) | Self::Plane | Self::Own(_) => false,
            Self::Staged(mesh, _) => mesh.is_closed(),
        }
    }
}

/// Shadow tree of a mesh.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct ShadowTreeQuery(pub MeshQuery);

impl Query for ShadowTreeQuery {
    type Answer = ShadowTree;
    const NAME: &'static str = "shadow tree";
    const ALWAYS_COMPLETE: bool = true;
    const CAPACITY: usize = 3;

    fn answer(&self, ask: &impl Ask) -> Self::Answer {
        ShadowTree::new(&ask.ask(&self.0))
    }
}

/// Triangle that each sample sees. None if stopped.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct VisibilityQuery {
    /// The mesh.
    pub mesh: MeshQuery,
    /// Viewpoint.
    pub viewpoint: Viewpoint,
    /// Number of samples.
    pub size: RasterSize,
}

impl Query for VisibilityQuery {
    type Answer = Option<Visibility>;
    const NAME: &'static str = "visibility";
    const CAPACITY: usize = 6;

    fn bytes(visibility: &Self::Answer) -> usize {
        visibility.as_ref().map_or(0, |visibility| size_of_val(visibility.hits()))
    }

    fn answer(&self, ask: &impl Ask) -> Self::Answer {
        let mesh = ask.ask(&self.mesh);
        Visibility::new(&mesh, self.viewpoint.eye_before(&mesh), self.size, &ask.stop())
    }
}

/// Angles at each lit sample. None if stopped.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct GeometryQuery {
    /// Visibility.
    pub visibility: VisibilityQuery,
    /// Position of the light.
    pub lighting: Lighting,
    /// Fineness of shadows.
    pub shadows: Shadows,
    /// Samples that are listed beside those that the light reaches from before.
    pub reach: Reach,
}

impl Query for GeometryQuery {
    type Answer = Option<Arc<GeometryImage>>;
    const NAME: &'static str = "geometry";
    const CAPACITY: usize = 6;

    fn bytes(geometry: &Self::Answer) -> usize {
        let of = |geometry: &Arc<GeometryImage>| {
            size_of_val(geometry.angles()) + size_of_val(geometry.samples()) + size_of_val(geometry.placed().seen())
        };
        geometry.as_ref().map_or(0, of)
    }

    fn answer(&self, ask: &impl Ask) -> Self::Answer {
        let mesh = ask.ask(&self.visibility.mesh);
        let tree = (self.shadows != Shadows::Off).then(|| ask.ask(&ShadowTreeQuery(self.visibility.mesh.clone())));
        let shadows = tree.as_deref().map(|tree| (tree, self.shadows));
        let visibility = ask.ask(&self.visibility);
        let visibility = (*visibility).as_ref()?;
        GeometryImage::within(&mesh, visibility, &self.lighting, shadows, self.reach, &ask.stop()).map(Arc::new)
    }
}

/// Roughness of a mesh at each of its vertices.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct MeshRoughnessQuery(pub MeshQuery);

impl Query for MeshRoughnessQuery {
    type Answer = Vec<VertexRoughness>;
    const NAME: &'static str = "mesh roughness";
    const ALWAYS_COMPLETE: bool = true;
    const CAPACITY: usize = 3;

    fn answer(&self, ask: &impl Ask) -> Self::Answer {
        vertex_roughness(&ask.ask(&self.0))
    }
}

choices! {
    /// Origin of σ and τ.
    #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
    #[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "kebab-case"))]
    pub enum Roughness {
        /// The surface's own, the same everywhere.
        #[default]
        Surface = "surface", "Of the surface", "σ and τ as they are set, the same everywhere";
        /// Heights and radius of each vertex's neighborhood in the mesh; P is interpolated between vertices. The paper's.
        Mesh = "mesh", "From the mesh",
            "As in the paper: at each vertex σ from the heights of its neighbors about the tangent plane, τ from the radius of that \
             neighborhood; P at the vertices, interpolated. These are lengths of the mesh, not of the material: tenths of \
             millimeters and millimeters, so g is tens of millions, and the width of the specular lobe, 2σ/τ, is the angle between \
             neighboring triangles. It narrows with more triangles.";
    }
}

/// Factors of the reflectance model at each lit sample. None if stopped.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct ShadingQuery {
    /// The angles.
    pub geometry: GeometryQuery,
    /// The surface.
    pub surface: Surface,
    /// Origin of σ and τ.
    pub roughness: Roughness,
    /// Normalization of Eq 1.
    pub reading: Normalization,
    /// Accuracy of the integrals.
    pub quality: Quality,
    /// Irradiance of a level surface by a uniform sky over that of a surface that faces the light, as bits; none without a sky. Its
    /// light needs a geometry that lists all samples ([`Reach::everywhere`]).
    pub sky: Option<u64>,
    /// True if the mesh hides no part of the sky: before it is known which.
    pub open_sky: bool,
    /// True if the ground sends light up.
    pub bounce: bool,
    /// True if light spreads within the body as within skin. It needs a geometry that lists all samples, and a mesh in meters.
    pub diffusion: bool,
}

impl Query for ShadingQuery {
    type Answer = Option<ShadingImage>;
    const NAME: &'static str = "shading";
    const CAPACITY: usize = 6;

    fn bytes(shading: &Self::Answer) -> usize {
        shading.as_ref().map_or(0, |shading| {
            let spread = shading.spread().map_or(0, size_of_val);
            size_of_val(shading.shades()) + size_of_val(shading.coherent_samples()) + spread
        })
    }

    fn answer(&self, ask: &impl Ask) -> Self::Answer {
        let mut shading = self.lit(ask)?;
        if self.diffusion && shading.vertices().is_none() {
            let seen = &self.geometry.visibility;
            let (mesh, visibility) = (ask.ask(&seen.mesh), ask.ask(seen));
            let changes = changes(&mesh, (*visibility).as_ref()?, &shading, &ask.stop())?;
            shading = shading.spread_by(changes);
        }
        if self.bounce {
            let bounce = ask.ask(&BounceQuery(self.geometry.clone()));
            shading = shading.over(Arc::clone((*bounce).as_ref()?));
        }
        let Some(share) = self.sky.filter(|_| self.geometry.reach.everywhere) else { return Some(shading) };
        let image = ask.ask(&self.sky_image());
        let image = Arc::clone((*image).as_ref()?);
        Some(shading.under(Sky { image, share: f64::from_bits(share) }))
    }
}

impl ShadingQuery {
    fn sky_image(&self) -> SkyImageQuery {
        SkyImageQuery {
            visibility: self.geometry.visibility.clone(),
            surface: self.surface,
            reading: self.reading,
            fineness: self.quality.sky_fineness(self.geometry.visibility.size.clamped().samples),
            through: self.geometry.reach.through,
            shadows: self.geometry.shadows != Shadows::Off && !self.open_sky,
        }
    }

    fn lit(&self, ask: &impl Ask) -> Option<ShadingImage> {
        let geometry = ask.ask(&self.geometry);
        let geometry = (*geometry).as_ref()?;
        if self.roughness == Roughness::Mesh {
            let GeometryQuery { visibility: seen, lighting, .. } = &self.geometry;
            let (mesh, roughness) = (ask.ask(&seen.mesh), ask.ask(&MeshRoughnessQuery(seen.mesh.clone())));
            let visibility = ask.ask(seen);
            let visibility = (*visibility).as_ref()?;
            let vertices = VertexImage::new(&mesh, visibility, Arc::clone(geometry), lighting, &ask.stop())?;
            let (surface, reading, quality) = (self.surface, self.reading, self.quality);
            return ShadingImage::by_vertices(Arc::new(vertices), &roughness, surface, reading, quality, &ask.stop());
        }
        ShadingImage::new(Arc::clone(geometry), self.surface, self.reading, self.quality, &ask.stop())
    }
}

/// Spectral weights of a camera under a light, for a reflectance.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct SpectralWeightsQuery {
    /// The camera or observer.
    pub sensor: Shared<Sensor>,
    /// The light.
    pub light: Shared<GridSpectrum>,
    /// The reflectance.
    pub reflectance: Shared<GridSpectrum>,
    /// Normalization of Eq 1.
    pub reading: Normalization,
}

impl Query for SpectralWeightsQuery {
    type Answer = Result<SpectralWeights, RenderingError>;
    const NAME: &'static str = "measure";
    const ALWAYS_COMPLETE: bool = true;

    fn answer(&self, _: &impl Ask) -> Self::Answer {
        let divisors = white_divisors(&self.sensor, &self.light)?;
        Ok(SpectralWeights::new(&self.sensor, &self.light, &self.reflectance, divisors, wavelength_power(self.reading)))
    }
}

impl SpectralWeightsQuery {
    /// The measure that a shaded mesh takes, over a ground of some reflectance: where lobes are untinted, with the weights of a white
    /// for them.
    pub fn in_picture(
        &self,
        shading: &ShadingImage,
        ground: Option<&Shared<GridSpectrum>>,
        ask: &impl Ask,
    ) -> Arc<<Self as Query>::Answer> {
        let surface = shading.surface();
        let sky = shading.sky().map(|_| *surface);
        let lobes = sky.is_some() || !shading.coherent_samples().is_empty();
        let untinted = surface.specular() == Specular::Fresnel && lobes;
        let through = shading.geometry().reach().through.then_some(*surface);
        let ground = ground.filter(|_| shading.bounce().is_some()).map(|ground| (*surface, ground.clone()));
        let spread = shading.spread().is_some();
        if !untinted && through.is_none() && sky.is_none() && ground.is_none() && !spread {
            return ask.ask(self);
        }
        ask.ask(&PictureWeightsQuery { own: self.clone(), untinted, through, sky, ground, spread })
    }
}

/// Spectral weights with those of all that a picture has beside the light on a surface of the material's color.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
struct PictureWeightsQuery {
    own: SpectralWeightsQuery,
    /// True if the coherent component takes the weights of a white.
    untinted: bool,
    /// The surface, where light passes through as through a leaf.
    through: Option<Surface>,
    /// The surface, under a sky.
    sky: Option<Surface>,
    /// The surface over a ground, and the ground's reflectance.
    ground: Option<(Surface, Shared<GridSpectrum>)>,
    /// True if light spreads within it as within skin.
    spread: bool,
}

impl Query for PictureWeightsQuery {
    type Answer = <SpectralWeightsQuery as Query>::Answer;
    const NAME: &'static str = "measure in a picture";
    const ALWAYS_COMPLETE: bool = true;
    const CAPACITY: usize = 64;

    fn answer(&self, ask: &impl Ask) -> Self::Answer {
        let of = |query: &SpectralWeightsQuery| (*ask.ask(query)).clone();
        let mut own = of(&self.own)?;
        if self.untinted {
            let reflectance = Shared::new(GridSpectrum::constant(1.0));
            own.untinted = Some(Arc::new(of(&SpectralWeightsQuery { reflectance, ..self.own.clone() })?));
        }
        if let Some(surface) = self.through {
            let reflectance = (*ask.ask(&LeafTransmittanceQuery(self.own.reflectance.clone()))).clone();
            let reading = Normalization::Lambertian;
            let signals = of(&SpectralWeightsQuery { reflectance, reading, ..self.own.clone() })?.totals();
            let share = ask.ask(&ScatteredShareQuery { surface, reading: self.own.reading });
            own.transmitted = Some(Transmitted { signals, share });
        }
        if let Some(surface) = self.sky {
            let reflectance = ask.ask(&SkyReflectanceQuery { surface, reading: self.own.reading });
            own.sky = Some(Arc::new(reflectance.signals(&own)));
        }
        if let Some((surface, ground)) = &self.ground {
            let reflectance = Shared::new(product(&self.own.reflectance, ground));
            let twice = of(&SpectralWeightsQuery { reflectance, ..self.own.clone() })?;
            let reflectance = ask.ask(&SkyReflectanceQuery { surface: *surface, reading: self.own.reading });
            own.bounce = Some(Arc::new(reflectance.signals(&twice)));
        }
        if self.spread {
            let mut spread = [[0.0; 3]; 3];
            for (totals, reflectance) in spread.iter_mut().zip(&*ask.ask(&SpreadQuery(self.own.reflectance.clone()))) {
                *totals = of(&SpectralWeightsQuery { reflectance: reflectance.clone(), ..self.own.clone() })?.totals();
            }
            own.spread = Some(spread);
        }
        Ok(own)
    }
}

fn product(a: &GridSpectrum, b: &GridSpectrum) -> GridSpectrum {
    let mut values = a.values().iter().zip(b.values());
    GridSpectrum::from_fn(|_| values.next().map_or(0.0, |(a, b)| a * b))
}

/// Parts of a reflectance whose light leaves skin spread by each of a few radii ([`diffusion::shares`]).
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
struct SpreadQuery(Shared<GridSpectrum>);

impl Query for SpreadQuery {
    type Answer = [Shared<GridSpectrum>; 3];
    const NAME: &'static str = "spread in skin";
    const ALWAYS_COMPLETE: bool = true;
    const CAPACITY: usize = 16;

    fn answer(&self, _: &impl Ask) -> Self::Answer {
        let of = |(index, &value): (usize, &f64)| diffusion::shares(wavelength_nm(index), value).map(|s| s * value);
        let parts: Vec<[f64; 3]> = self.0.values().iter().enumerate().map(of).collect();
        std::array::from_fn(|k| {
            let mut values = parts.iter().map(|part| part[k]);
            Shared::new(GridSpectrum::from_fn(|_| values.next().unwrap_or_default()))
        })
    }
}

/// Share of light that a leaf's surface scatters ([`ScatteredShare`]).
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
struct ScatteredShareQuery {
    surface: Surface,
    reading: Normalization,
}

impl Query for ScatteredShareQuery {
    type Answer = ScatteredShare;
    const NAME: &'static str = "leaf surface";
    const ALWAYS_COMPLETE: bool = true;
    const CAPACITY: usize = 16;

    fn answer(&self, _: &impl Ask) -> Self::Answer {
        ScatteredShare::new(&self.surface, self.reading)
    }
}

/// Transmittance of a leaf of a reflectance ([`LeafModel`]).
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct LeafTransmittanceQuery(pub Shared<GridSpectrum>);

impl Query for LeafTransmittanceQuery {
    type Answer = Shared<GridSpectrum>;
    const NAME: &'static str = "leaf transmittance";
    const ALWAYS_COMPLETE: bool = true;
    const CAPACITY: usize = 16;

    fn answer(&self, _: &impl Ask) -> Self::Answer {
        let (leaf, mut values) = (LeafModel::new(), self.0.values().iter());
        Shared::new(GridSpectrum::from_fn(|_| values.next().map_or(0.0, |&value| leaf.transmittance(value))))
    }
}

/// Signals of a camera at each lit sample of a mesh. None inside if stopped.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct CameraImageQuery {
    /// The shaded mesh.
    pub shading: ShadingQuery,
    /// The camera under the light.
    pub measure: SpectralWeightsQuery,
    /// Reflectances of parts of the mesh, ascending by part; others have that of the body.
    pub parts: Parts,
}

impl Query for CameraImageQuery {
    type Answer = Result<Option<CameraImage>, RenderingError>;
    const NAME: &'static str = "camera image";
    const CAPACITY: usize = 64;

    fn bytes(image: &Self::Answer) -> usize {
        let of = |image: &CameraImage| size_of_val(image.signals()) + size_of_val(image.placed().samples());
        image.as_ref().ok().and_then(Option::as_ref).map_or(0, of)
    }

    fn answer(&self, ask: &impl Ask) -> Self::Answer {
        let shading = ask.ask(&self.shading);
        let Some(shading) = (*shading).as_ref() else { return Ok(None) };
        let image = |of: &Self, part: Option<&[bool]>| {
            let measure = of.measure.in_picture(shading, of.ground(), ask);
            let measure = (*measure).as_ref().map_err(|&e| e)?;
            let plan = of.plan(shading, measure, ask)?;
            Ok(CameraImage::of_part(shading, measure, plan, part, &ask.stop()))
        };
        let seen = shading.geometry().placed().parts();
        let own: Vec<Part> = self.parts.iter().map(|(part, _)| *part).collect();
        if own.is_empty() || seen.is_empty() {
            return image(self, None);
        }
        let body: Vec<bool> = seen.iter().map(|part| own.binary_search(part).is_err()).collect();
        let Some(all) = image(self, Some(&body))? else { return Ok(None) };
        Ok(Some(all.with_matte(shading, &self.matte()?)))
    }
}

/// Reflectances of parts of a mesh, ascending by part.
pub type Parts = Vec<(Part, Shared<GridSpectrum>)>;

impl CameraImageQuery {
    /// Reflectance of the ground, if there is one.
    pub fn ground(&self) -> Option<&Shared<GridSpectrum>> {
        self.parts.iter().find(|(part, _)| *part == Part::Ground).map(|(_, grid)| grid)
    }

    /// The signals of matte parts. A white of them is as bright as one of the body's surface at 550 nm: side by
    /// side they compare as their reflectances do.
    ///
    /// # Errors
    /// [`RenderingError`] where the sensor sees nothing of the light.
    fn matte(&self) -> Result<Vec<MattePart>, RenderingError> {
        let SpectralWeightsQuery { sensor, light, reading, .. } = &self.measure;
        let radius = self.shading.geometry.lighting.angular_radius();
        let white = factor(&self.shading.surface, &Geometry::from_angles(0.0, 0.0, 0.0), LAMBDA_0_NM, *reading, radius);
        let is_reflectance = wavelength_power(*reading) != 0;
        let scale = if is_reflectance { white.max(LEAST_FACING) } else { white } / white_divisors(sensor, light)?;
        let weights = under_light(sensor, light);
        let signals = |grid: &GridSpectrum| (scale * raw(&weights, grid.values())).to_array();
        let ground = self.ground();
        let part = |(part, grid): &(Part, Shared<GridSpectrum>)| MattePart {
            part: *part,
            facing: signals(grid),
            from_ground: ground.map_or([0.0; 3], |ground| signals(&product(grid, ground))),
        };
        Ok(self.parts.iter().map(part).collect())
    }

    /// The plan that the image is made by, where its shading and measure are known.
    ///
    /// # Errors
    /// [`RenderingError`] if no plan exists for the camera's spectral weights.
    pub fn plan(
        &self,
        shading: &ShadingImage,
        measure: &SpectralWeights,
        ask: &impl Ask,
    ) -> Result<Arc<Plan>, RenderingError> {
        let Some((tolerance, demand)) = shading.plan_request() else {
            return Ok(Arc::new(Plan::fixed(measure, shading.fixed_quality())));
        };
        let plan = ask.ask(&PlanQuery { measure: self.measure.clone(), tolerance, demand });
        (*plan).as_ref().map(Arc::clone).map_err(|&e| e)
    }
}

/// The fastest method of a camera's spectral integral within a tolerance. Depends on no surface or angle: the demands of pictures
/// are rounded out to a few ([`Demand::of_picture`]).
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct PlanQuery {
    /// The camera under the light.
    pub measure: SpectralWeightsQuery,
    /// The allowed error.
    pub tolerance: RelTolerance,
    /// Range of κ and number of samples.
    pub demand: Demand,
}

impl Query for PlanQuery {
    type Answer = Result<Arc<Plan>, RenderingError>;
    const NAME: &'static str = "plan";
    const ALWAYS_COMPLETE: bool = true;
    const CAPACITY: usize = 64;

    fn bytes(plan: &Self::Answer) -> usize {
        plan.as_ref().map_or(0, |plan| plan.bytes())
    }

    fn answer(&self, ask: &impl Ask) -> Self::Answer {
        let measure = ask.ask(&self.measure);
        let measure = (*measure).as_ref().map_err(|&e| e)?;
        Ok(Arc::new(Plan::new(measure, self.tolerance, self.demand)?))
    }
}
