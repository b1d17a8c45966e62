//! What a surface makes of the angles: the same for every camera.

mod brightness;
mod lobes;

use super::Stop;
use super::diffuse::{DARK, DiffuseTable, ROUGH};
use super::geometry::{Angles, GeometryImage};
use super::measure::LAMBDA_0_NM;
use super::plan::{self, Demand};
use super::vertices::VertexImage;
use crate::accuracy::Accuracy;
use crate::reflectance::coherent::rho0_squared_bound;
use crate::reflectance::{
    Geometry, Precision, Reading, Specular, Surface, beta, coherent_prefactor, diffuse_prefactor, kappa, ln_diffuse_sum,
};
use crate::scene::roughness::VertexRoughness;
use crate::spectral::grid::{FIRST_NM, LAST_NM};
use rayon::prelude::*;
use std::sync::Arc;

use brightness::Brightness;
use lobes::{Lobe, Lobes};

/// Mirror terms below this share of the brightest sample are left out at [`Quality::Full`] and below.
pub const MIRROR_SHARE: f64 = 1e-7;

/// The same for fifteen wavelengths, and for what others are compared with: below what the integral itself is off by.
const FINE_MIRROR_SHARE: f64 = 1e-10;
const EXACT_MIRROR_SHARE: f64 = 1e-14;

/// The share of an accuracy's error that mirror terms left out may take.
const MIRROR_OF_ERROR: f64 = 0.1;

/// Reflectance of the darkest material that untinted lobes are weighed against: which one it is a surface does not know.
const DARKEST: f64 = 1.0 / 64.0;

/// How exactly the spectral integral is made.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Quality {
    /// Moments and table; of the mirror lobe's oscillation only the mean, from a path of 2 µm on: while something moves.
    Preview,
    /// Moments and table: error below 1e-5 of the peak.
    #[default]
    Full,
    /// Fifteen wavelengths: below 1e-9.
    Fine,
    /// The sum over 401 wavelengths.
    Exact,
    /// The sum over 401 wavelengths with the paper's three cases of g: to see their error.
    Regimes,
    /// The cheapest way that keeps this error, relative to the picture's brightest sample, chosen for each camera
    /// ([`super::Plan`], [`super::mirror::Reach`]): of the diffuse part and of the mirror term, both before signals are rounded to
    /// single precision (6e-8 of themselves).
    Within(Accuracy),
}

impl Quality {
    /// The accuracy that was asked for in numbers.
    pub const fn accuracy(self) -> Option<Accuracy> {
        if let Self::Within(accuracy) = self { Some(accuracy) } else { None }
    }

    /// Mirror terms below this share of the brightest sample are left out.
    pub fn mirror_share(self) -> f64 {
        match self {
            Self::Preview | Self::Full => MIRROR_SHARE,
            Self::Fine => FINE_MIRROR_SHARE,
            Self::Exact | Self::Regimes => EXACT_MIRROR_SHARE,
            Self::Within(accuracy) => MIRROR_OF_ERROR * accuracy.max_relative_error(),
        }
    }
}

/// How a sample's integral is made.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Way {
    /// Nothing comes from it.
    Dark,
    /// All wavelengths are scattered alike.
    Flat,
    /// By moments.
    Moments,
    /// By the table.
    Table,
    /// By a sum over wavelengths.
    Sum,
    /// As each camera's plan says.
    Planned,
}

/// One lit sample of a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shade {
    /// The diffuse part's factor beside J: `cos θi cos⁴α` and what the reading makes of the angles.
    pub front: f64,
    /// g at 550 nm.
    pub kappa: f64,
    /// b / g.
    pub beta: f64,
    /// Where that lies in a camera's table, if it is made by the table: [`DiffuseTable::position`].
    pub position: [f64; 2],
    /// How its integral is made.
    pub way: Way,
}

impl Shade {
    const DARK: Self = Self { front: 0.0, kappa: 0.0, beta: 0.0, position: [0.0; 2], way: Way::Dark };

    /// A sample whose way each camera decides.
    fn planned(front: f64, kappa: f64, beta: f64) -> Self {
        if front <= 0.0 || kappa <= 0.0 {
            return Self::DARK;
        }
        let way = if plan::is_lit(kappa, beta) { Way::Planned } else { Way::Dark };
        Self { front, kappa, beta, position: [0.0; 2], way }
    }
}

/// A sample with a mirror term worth having.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mirror {
    /// The sample's place among the lit ones.
    pub index: u32,
    /// The factor beside `ρ0² e^-g`.
    pub front: f64,
    /// g at 550 nm.
    pub kappa: f64,
    /// `v_x / k` and `v_y / k`.
    pub v: [f64; 2],
}

/// How many samples take which way.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct ShadingCounts {
    /// Samples whose light lies below the threshold.
    pub dark: u64,
    /// Samples that scatter all wavelengths alike.
    pub flat: u64,
    /// Samples by moments.
    pub moments: u64,
    /// Samples by the table.
    pub table: u64,
    /// Samples by a sum over wavelengths.
    pub sums: u64,
    /// Samples as each camera's plan says.
    pub planned: u64,
    /// Samples with a mirror term.
    pub mirrors: u64,
    /// Samples whose mirror term was left out.
    pub mirrors_skipped: u64,
}

/// What a surface makes of the angles at each lit sample.
#[derive(Clone, Debug)]
pub struct ShadingImage {
    geometry: Arc<GeometryImage>,
    /// Where samples lie between vertices that are shaded in their place.
    vertices: Option<Arc<VertexImage>>,
    surface: Surface,
    quality: Quality,
    shades: Vec<Shade>,
    mirrors: Vec<Mirror>,
    mirror_scale: f64,
    diffuse_scale: f64,
    counts: ShadingCounts,
}

impl ShadingImage {
    /// Prepares every lit sample of a picture for any camera; none if stopped.
    pub fn new(
        geometry: Arc<GeometryImage>,
        surface: Surface,
        reading: Reading,
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
        reading: Reading,
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
        reading: Reading,
        quality: Quality,
        stop: &Stop,
    ) -> Option<Self> {
        let untinted = surface.specular() == Specular::Fresnel;
        let darkest = if untinted { DARKEST } else { 1.0 };
        let material = Material { reading, quality, angular_radius: geometry.angular_radius(), darkest };
        let (shades, Lobes { mirrors, scale: mirror_scale, diffuse_scale }) = match &vertices {
            None => {
                let place = |index: usize| {
                    let angles: &Angles = &geometry.angles()[index];
                    Place { geometry: angles.geometry(), light: angles.light(), surface }
                };
                material.shaded(geometry.angles().len(), place, stop)?
            }
            Some((vertices, roughness)) => {
                let place = |index: usize| Place {
                    geometry: vertices.geometries()[index],
                    light: 1.0,
                    surface: roughness.get(index).copied().unwrap_or_default().of(surface),
                };
                material.shaded(vertices.geometries().len(), place, stop)?
            }
        };
        let counts = counts(&shades, mirrors.len());
        let vertices = vertices.map(|(vertices, _)| vertices);
        Some(Self { geometry, vertices, surface, quality, shades, mirrors, mirror_scale, diffuse_scale, counts })
    }

    /// The angles it is made of.
    pub fn geometry(&self) -> &Arc<GeometryImage> {
        &self.geometry
    }

    /// The surface.
    pub fn surface(&self) -> &Surface {
        &self.surface
    }

    /// How exactly integrals are made.
    pub fn quality(&self) -> Quality {
        self.quality
    }

    /// Where samples lie between vertices that are shaded in their place.
    pub fn vertices(&self) -> Option<&VertexImage> {
        self.vertices.as_deref()
    }

    /// The lit samples, in the order of [`GeometryImage::samples`], or the vertices in their place.
    pub fn shades(&self) -> &[Shade] {
        &self.shades
    }

    /// The samples or vertices with a mirror term, ascending.
    pub fn mirrors(&self) -> &[Mirror] {
        &self.mirrors
    }

    /// The brightest sample as a share of the highest lobe, as a power of two not above 1: errors relative to a lobe's height
    /// have to be so much smaller where no sample sees a lobe's middle.
    pub fn mirror_scale(&self) -> f64 {
        self.mirror_scale
    }

    /// The accuracy of lobes, relative to their height, that keeps the one that was asked for of the picture.
    pub fn mirror_accuracy(&self) -> Option<Accuracy> {
        self.quality.accuracy().map(|accuracy| accuracy.times(self.mirror_scale))
    }

    /// The accuracy of the diffuse part's integral, relative to its peak, that keeps the one that was asked for of the picture:
    /// smaller where no sample is seen from near the mirror's direction, but not below what S is good for.
    pub fn plan_accuracy(&self) -> Option<Accuracy> {
        let accuracy = self.quality.accuracy()?;
        let best = Precision::Full.max_relative_error();
        let least = (best / accuracy.max_relative_error()).min(1.0);
        Some(accuracy.times(self.diffuse_scale.max(least)))
    }

    /// How many samples or vertices take which way.
    pub fn counts(&self) -> ShadingCounts {
        self.counts
    }

    /// What is asked of a camera's plan, if anything is.
    pub fn demand(&self) -> Option<Demand> {
        let chunks = self.shades.par_iter().with_min_len(GeometryImage::chunk());
        let planned = chunks.filter(|shade| shade.way == Way::Planned);
        let of = |shade: &Shade| ([shade.kappa; 2], u64::from(shade.kappa < ROUGH));
        let both = |([a, b], n): ([f64; 2], u64), ([c, d], m): ([f64; 2], u64)| ([a.min(c), b.max(d)], n + m);
        planned.map(of).reduce_with(both).map(|(kappa, samples)| Demand::new(kappa, samples))
    }

    /// Whether a camera needs a table for this.
    pub fn needs_table(&self) -> bool {
        self.counts.table > 0
    }
}

/// Whether even the reddest light, which scatters widest, is far below its peak.
fn is_dark(kappa: f64, beta: f64) -> bool {
    let g = kappa * (LAMBDA_0_NM / LAST_NM).powi(2);
    ln_diffuse_sum(g, beta * g, Precision::Coarse) < ln_diffuse_sum(g, 0.0, Precision::Coarse) - DARK
}

fn counts(shades: &[Shade], mirrors: usize) -> ShadingCounts {
    let of_run = |shades: &[Shade]| {
        let mut counts = ShadingCounts::default();
        for shade in shades {
            *match shade.way {
                Way::Dark => &mut counts.dark,
                Way::Flat => &mut counts.flat,
                Way::Moments => &mut counts.moments,
                Way::Table => &mut counts.table,
                Way::Sum => &mut counts.sums,
                Way::Planned => &mut counts.planned,
            } += 1;
        }
        counts
    };
    let all =
        shades.par_chunks(GeometryImage::chunk()).map(of_run).reduce(ShadingCounts::default, |a, b| ShadingCounts {
            dark: a.dark + b.dark,
            flat: a.flat + b.flat,
            moments: a.moments + b.moments,
            table: a.table + b.table,
            sums: a.sums + b.sums,
            planned: a.planned + b.planned,
            ..a
        });
    ShadingCounts { mirrors: mirrors as u64, mirrors_skipped: (shades.len() - mirrors) as u64, ..all }
}

/// A lit sample, or a vertex in its place.
struct Place {
    geometry: Geometry,
    /// What stands beside the reflectance factor.
    light: f64,
    surface: Surface,
}

/// One reading of the model.
struct Material {
    reading: Reading,
    quality: Quality,
    angular_radius: f64,
    /// Reflectance that diffuse parts are weighed with beside lobes: 1 where both take the material's color.
    darkest: f64,
}

impl Material {
    /// The shades of a list of places, and their mirror terms; none if stopped.
    fn shaded(&self, count: usize, place: impl Fn(usize) -> Place + Sync, stop: &Stop) -> Option<(Vec<Shade>, Lobes)> {
        let chunk = GeometryImage::chunk();
        let shade = |index| if stop.is_set() { Shade::DARK } else { self.shade(&place(index)) };
        let shades: Vec<Shade> = (0..count).into_par_iter().with_min_len(chunk).map(shade).collect();
        let (diffuse, share) = (Brightness::of(&shades), self.quality.mirror_share());
        // What the lobes add to the picture's brightness leaves out more, never less.
        let least = share * diffuse.brightest * self.darkest;
        let lobes = |run: usize| {
            let all = (run * chunk..count.min((run + 1) * chunk)).take_while(|_| !stop.is_set());
            all.filter_map(|index| self.lobe(&place(index), index, least)).collect()
        };
        let lobes: Vec<Vec<Lobe>> = (0..count.div_ceil(chunk)).into_par_iter().map(lobes).collect();
        if stop.is_set() {
            return None;
        }
        let height = |lobe: &Lobe| lobe.at_550_nm(&place(lobe.mirror.index as usize), self.angular_radius);
        let lobes = Lobes::worth_having(&lobes.concat(), diffuse, self.darkest, height, share);
        Some((shades, lobes))
    }

    fn shade(&self, place: &Place) -> Shade {
        let Place { geometry, light, surface } = place;
        let light = *light;
        if self.reading == Reading::Lambertian {
            return Shade { front: light, kappa: 0.0, beta: 0.0, position: [0.0; 2], way: Way::Flat };
        }
        let front = light * diffuse_prefactor(surface, geometry, self.reading);
        let (kappa, beta) = (kappa(surface, geometry), beta(surface, geometry));
        if self.quality.accuracy().is_some() {
            return Shade::planned(front, kappa, beta);
        }
        let way = self.way(front, kappa, beta);
        let position = if way == Way::Table { DiffuseTable::position(kappa, beta) } else { [0.0; 2] };
        Shade { front, kappa, beta, position, way }
    }

    fn way(&self, front: f64, kappa: f64, beta: f64) -> Way {
        if front <= 0.0 || kappa <= 0.0 {
            return Way::Dark;
        }
        match self.quality {
            Quality::Preview | Quality::Full if kappa >= ROUGH => {
                if beta > DARK {
                    Way::Dark
                } else {
                    Way::Moments
                }
            }
            Quality::Preview | Quality::Full if DiffuseTable::holds(kappa, beta) => Way::Table,
            Quality::Preview | Quality::Full if is_dark(kappa, beta) => Way::Dark,
            _ => Way::Sum,
        }
    }

    /// The mirror term of a sample, if it may be above the least that counts.
    fn lobe(&self, place: &Place, index: usize, least: f64) -> Option<Lobe> {
        let Place { geometry, light, surface } = place;
        if self.reading == Reading::Lambertian {
            return None;
        }
        let kappa = kappa(surface, geometry);
        let (bluest, reddest) = (LAMBDA_0_NM / FIRST_NM, LAMBDA_0_NM / LAST_NM);
        // Most surfaces: next to what the rough part gives, e^-100 is nothing.
        if kappa * reddest * reddest > 100.0 {
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
        let mirror = Mirror { index: index as u32, front, kappa, v: [geometry.vx_by_k, geometry.vy_by_k] };
        (most > least).then_some(Lobe { mirror, height, most })
    }
}
