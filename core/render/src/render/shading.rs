//! Factors of the reflectance model at each sample: the same for every camera.

mod brightness;
mod lobes;
mod sample;

use super::diffuse::{NEARLY_ROUGH, ROUGH};
use super::diffusion::Change;
use super::geometry::{Angles, GeometryImage};
use super::measure::{LAMBDA_0_NM, SpectralWeights};
use super::plan::{self, Demand, Plan};
use super::sky::Sky;
use super::sky::ground::Bounce;
use super::stop::Stop;
use super::vertices::VertexImage;
use crate::reflectance::coherent::rho0_squared_bound;
use crate::reflectance::{
    Normalization, Precision, Specular, Surface, beta, coherent_prefactor, diffuse_prefactor, kappa,
};
use crate::scene::roughness::VertexRoughness;
use brightness::Brightness;
use chromascope_color::accuracy::{RelTolerance, Unmet};
use chromascope_color::spectral::grid::{FIRST_NM, LAST_NM};
use lobes::{Lobe, Lobes};
use rayon::prelude::*;
use sample::Place;
use std::sync::Arc;

pub use super::quality::Quality;
pub use sample::{CoherentSample, DiffuseKind, Shade};

/// Reflectance of the darkest material that untinted lobes are weighed against: which one it is a surface does not know.
const DARKEST: f64 = 1.0 / 64.0;

/// κ beyond which there is no coherent component, as for most surfaces: at the reddest light e^-100 of it is left.
const LAST_KAPPA: f64 = 100.0 * (LAST_NM / LAMBDA_0_NM) * (LAST_NM / LAMBDA_0_NM);

/// Number of samples of each kind.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct ShadingCounts {
    /// Samples whose light lies below the threshold.
    pub dark: u64,
    /// Samples that scatter all wavelengths alike.
    pub flat: u64,
    /// Samples with a spectral integral.
    pub spectral: u64,
    /// Samples with a coherent component.
    pub coherent_samples: u64,
    /// Samples whose specular component was omitted.
    pub coherent_skipped: u64,
}

/// Factors of the reflectance model at each lit sample.
#[derive(Clone, Debug)]
pub struct ShadingImage {
    geometry: Arc<GeometryImage>,
    /// Places of samples between vertices that are shaded instead.
    vertices: Option<Arc<VertexImage>>,
    surface: Surface,
    quality: Quality,
    shades: Vec<Shade>,
    coherent_samples: Vec<CoherentSample>,
    brightness: f64,
    diffuse_scale: f64,
    counts: ShadingCounts,
    range: Option<KappaRange>,
    sky: Option<Sky>,
    bounce: Option<Arc<Vec<Bounce>>>,
    spread: Option<Vec<Change>>,
}

/// Smallest and largest κ of the spectral integrals, and how many are below [`NEARLY_ROUGH`] and [`ROUGH`].
#[derive(Clone, Copy, Debug)]
struct KappaRange {
    kappa: [f64; 2],
    below: [u64; 2],
}

impl ShadingImage {
    /// Prepares every lit sample of a picture for any camera; none if stopped.
    pub fn new(
        geometry: Arc<GeometryImage>,
        surface: Surface,
        reading: Normalization,
        quality: Quality,
        stop: &Stop,
    ) -> Option<Self> {
        Self::shade(geometry, None, surface, reading, quality, stop)
    }

    /// Prepares every vertex in place of the samples between them, each with a σ and a τ of its own, as the paper does; none if
    /// stopped.
    pub fn by_vertices(
        vertices: Arc<VertexImage>,
        roughness: &[VertexRoughness],
        surface: Surface,
        reading: Normalization,
        quality: Quality,
        stop: &Stop,
    ) -> Option<Self> {
        let geometry = Arc::clone(vertices.geometry());
        Self::shade(geometry, Some((vertices, roughness)), surface, reading, quality, stop)
    }

    fn shade(
        geometry: Arc<GeometryImage>,
        vertices: Option<(Arc<VertexImage>, &[VertexRoughness])>,
        surface: Surface,
        reading: Normalization,
        quality: Quality,
        stop: &Stop,
    ) -> Option<Self> {
        let untinted = surface.specular() == Specular::Fresnel;
        let darkest = if untinted { DARKEST } else { 1.0 };
        let material = Material { reading, quality, angular_radius: geometry.angular_radius(), darkest };
        let (shades, Lobes { coherent_samples, brightness, diffuse_scale }) = match &vertices {
            None => {
                let place = |index: usize| {
                    let angles: &Angles = &geometry.angles()[index];
                    let is_matte = geometry.placed().part(index).is_matte();
                    Place { geometry: angles.geometry(), light: angles.light(), surface, is_matte }
                };
                material.shaded(geometry.angles().len(), place, stop)?
            }
            Some((vertices, roughness)) => {
                let place = |index: usize| Place {
                    geometry: vertices.geometries()[index],
                    light: 1.0,
                    surface: roughness.get(index).copied().unwrap_or_default().of(surface),
                    is_matte: false,
                };
                material.shaded(vertices.geometries().len(), place, stop)?
            }
        };
        let (range, [dark, flat, spectral]) = KappaRange::of(&shades);

        // Samples that only the sky lights, or the light from behind, are not below a threshold.
        let unlit = if vertices.is_some() { 0 } else { shades.len() as u64 - geometry.counts().lit };
        let coherent_skipped = ((shades.len() - coherent_samples.len()) as u64).saturating_sub(unlit);
        let counts = ShadingCounts {
            dark: dark.saturating_sub(unlit),
            flat,
            spectral,
            coherent_samples: coherent_samples.len() as u64,
            coherent_skipped,
        };
        let vertices = vertices.map(|(vertices, _)| vertices);
        Some(Self {
            geometry,
            vertices,
            surface,
            quality,
            shades,
            coherent_samples,
            brightness,
            diffuse_scale,
            counts,
            range,
            sky: None,
            bounce: None,
            spread: None,
        })
    }

    /// This under a sky as well, whose samples are all that see the mesh: those of a geometry that lists them everywhere.
    #[must_use]
    pub fn under(self, sky: Sky) -> Self {
        Self { sky: Some(sky), ..self }
    }

    /// This over a ground, by its light at each lit sample.
    #[must_use]
    pub fn over(self, bounce: Arc<Vec<Bounce>>) -> Self {
        Self { bounce: Some(bounce), ..self }
    }

    /// This with light spread within skin, by its change at each lit sample.
    #[must_use]
    pub fn spread_by(self, changes: Vec<Change>) -> Self {
        Self { spread: Some(changes), ..self }
    }

    /// Change of light by its spread within skin at each lit sample, if it spreads.
    pub fn spread(&self) -> Option<&[Change]> {
        self.spread.as_deref()
    }

    /// Light from the ground at each lit sample, if there is one.
    pub fn bounce(&self) -> Option<&[Bounce]> {
        self.bounce.as_ref().map(|bounce| bounce.as_slice())
    }

    /// The sky, if there is one.
    pub fn sky(&self) -> Option<&Sky> {
        self.sky.as_ref()
    }

    /// The angles it is made of.
    pub fn geometry(&self) -> &Arc<GeometryImage> {
        &self.geometry
    }

    /// The surface.
    pub fn surface(&self) -> &Surface {
        &self.surface
    }

    /// Accuracy of the integrals.
    pub fn quality(&self) -> Quality {
        self.quality
    }

    /// Places of samples between vertices that are shaded instead.
    pub fn vertices(&self) -> Option<&VertexImage> {
        self.vertices.as_deref()
    }

    /// The lit samples, in the order of [`GeometryImage::samples`], or the vertices in their place.
    pub fn shades(&self) -> &[Shade] {
        &self.shades
    }

    /// The samples or vertices with a coherent component, ascending.
    pub fn coherent_samples(&self) -> &[CoherentSample] {
        &self.coherent_samples
    }

    /// Estimate from below of the brightest sample's reflectance factor, to which errors are relative.
    pub fn brightness(&self) -> f64 {
        self.brightness
    }

    /// Tolerance of the diffuse component's integral, relative to its peak, that keeps the picture's: smaller where no sample is
    /// seen from near the specular direction, by a power of 16, but not below the error of S.
    pub fn plan_tolerance(&self) -> Option<RelTolerance> {
        let tolerance = self.quality.tolerance()?;
        let best = Precision::Full.max_relative_error();
        let least = (best / tolerance.max_relative_error()).min(1.0);
        let scale = (4.0 * (self.diffuse_scale.log2() / 4.0).floor()).exp2();
        Some(tolerance.times(scale.max(least)))
    }

    /// Number of samples or vertices of each kind.
    pub fn counts(&self) -> ShadingCounts {
        self.counts
    }

    /// Demand of the picture on a camera's plan; none where no sample has a spectral integral.
    pub fn demand(&self) -> Option<Demand> {
        self.range.map(|range| Demand::of_picture(range.kappa, range.below[1]))
    }

    /// The quality whose [`Plan::fixed`] serves where no plan is searched.
    pub fn fixed_quality(&self) -> Quality {
        Plan::fixed_quality(self.quality, self.plan_tolerance())
    }

    /// Tolerance and demand of a plan that is to be searched ([`Plan::new`]); none where [`Plan::fixed`] serves.
    pub fn plan_request(&self) -> Option<(RelTolerance, Demand)> {
        let (range, tolerance) = self.range.zip(self.plan_tolerance())?;
        let is_searched = Plan::is_searched(self.quality, tolerance, range.below);
        is_searched.then(|| (tolerance, Demand::of_picture(range.kappa, range.below[1])))
    }

    /// The plan for a camera: found by search if [`Self::plan_request`] requires it.
    ///
    /// # Errors
    /// See [`Plan::new`].
    pub fn plan(&self, measure: &SpectralWeights) -> Result<Plan, Unmet> {
        match self.plan_request() {
            Some((tolerance, demand)) => Plan::new(measure, tolerance, demand),
            None => Ok(Plan::fixed(measure, self.fixed_quality())),
        }
    }
}

impl KappaRange {
    const NONE: Self = Self { kappa: [f64::INFINITY, 0.0], below: [0; 2] };

    /// The range of all spectral integrals, if there are any, and the numbers of dark, flat and spectral samples.
    fn of(shades: &[Shade]) -> (Option<Self>, [u64; 3]) {
        let of_run = |shades: &[Shade]| {
            let (mut range, mut counts) = (Self::NONE, [0; 3]);
            for shade in shades {
                counts[shade.kind as usize] += 1;
                if shade.kind == DiffuseKind::Spectral {
                    range.kappa = [range.kappa[0].min(shade.kappa), range.kappa[1].max(shade.kappa)];
                    range.below[0] += u64::from(shade.kappa < NEARLY_ROUGH);
                    range.below[1] += u64::from(shade.kappa < ROUGH);
                }
            }
            (range, counts)
        };
        let both = |(a, m): (Self, [u64; 3]), (b, n): (Self, [u64; 3])| {
            let kappa = [a.kappa[0].min(b.kappa[0]), a.kappa[1].max(b.kappa[1])];
            let below = [a.below[0] + b.below[0], a.below[1] + b.below[1]];
            (Self { kappa, below }, [m[0] + n[0], m[1] + n[1], m[2] + n[2]])
        };
        let runs = shades.par_chunks(GeometryImage::chunk()).map(of_run);
        let (range, counts) = runs.reduce(|| (Self::NONE, [0; 3]), both);
        ((counts[DiffuseKind::Spectral as usize] > 0).then_some(range), counts)
    }
}

/// One reading of the model.
struct Material {
    reading: Normalization,
    quality: Quality,
    angular_radius: f64,
    /// Reflectance that diffuse parts are weighed with beside lobes: 1 where both take the material's color.
    darkest: f64,
}

impl Material {
    /// The shades of a list of places, and their coherent components; none if stopped.
    fn shaded(&self, count: usize, place: impl Fn(usize) -> Place + Sync, stop: &Stop) -> Option<(Vec<Shade>, Lobes)> {
        let chunk = GeometryImage::chunk();
        let shade = |index| if stop.is_set() { Shade::DARK } else { self.shade(&place(index)) };
        let shades: Vec<Shade> = (0..count).into_par_iter().with_min_len(chunk).map(shade).collect();
        let (diffuse, share) = (Brightness::of(&shades), self.quality.coherent_share());
        // The lobes' own contribution to the brightness would raise this limit, never lower it.
        let least = share * diffuse.brightest * self.darkest;
        let lobes = |run: usize| {
            let all = (run * chunk..count.min((run + 1) * chunk)).take_while(|_| !stop.is_set());
            let near = all.filter(|&index| shades[index].kappa <= LAST_KAPPA);
            near.filter_map(|index| self.lobe(&place(index), index, least)).collect()
        };
        let lobes: Vec<Vec<Lobe>> = (0..count.div_ceil(chunk)).into_par_iter().map(lobes).collect();
        if stop.is_set() {
            return None;
        }
        let height = |lobe: &Lobe| lobe.brightness(&place(lobe.coherent.index as usize), self.angular_radius);
        let lobes = Lobes::worth_having(&lobes.concat(), diffuse, self.darkest, height, share);
        Some((shades, lobes))
    }

    fn shade(&self, place: &Place) -> Shade {
        let Place { geometry, light, surface, is_matte } = place;
        let light = *light;
        if *is_matte || self.reading == Normalization::Lambertian {
            return Shade { front: light, kappa: 0.0, beta: 0.0, kind: DiffuseKind::Flat };
        }
        let front = light * diffuse_prefactor(surface, geometry, self.reading);
        let (kappa, beta) = (kappa(surface, geometry), beta(surface, geometry));
        if front <= 0.0 || kappa <= 0.0 {
            return Shade::DARK;
        }
        let is_dark = self.quality.leaves_dark() && !plan::is_lit(kappa, beta);
        Shade { front, kappa, beta, kind: if is_dark { DiffuseKind::Dark } else { DiffuseKind::Spectral } }
    }

    /// The coherent component of a sample, if it may be above the least that counts.
    fn lobe(&self, place: &Place, index: usize, least: f64) -> Option<Lobe> {
        let Place { geometry, light, surface, is_matte } = place;
        if *is_matte || self.reading == Normalization::Lambertian {
            return None;
        }
        let kappa = kappa(surface, geometry);
        let (bluest, reddest) = (LAMBDA_0_NM / FIRST_NM, LAMBDA_0_NM / LAST_NM);
        if kappa > LAST_KAPPA {
            return None;
        }
        let front = light * coherent_prefactor(surface, geometry, self.reading);
        // Red is where g is least and the lobe widest; blue is where the reading weighs most.
        let height = front * (-kappa * reddest * reddest).exp() * bluest * bluest;
        if height <= least {
            return None;
        }
        let wave_number = std::f64::consts::TAU / (LAST_NM * 1e-9);
        let most = height * rho0_squared_bound(geometry, surface, wave_number, self.angular_radius);
        let coherent = CoherentSample { index: index as u32, front, kappa, v: [geometry.vx_by_k, geometry.vy_by_k] };
        (most > least).then_some(Lobe { coherent, most })
    }
}
