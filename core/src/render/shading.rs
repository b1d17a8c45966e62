//! What a surface makes of the angles: the same for every camera.

use super::Stop;
use super::diffuse::{DARK, DiffuseTable, ROUGH};
use super::geometry::{Angles, GeometryImage};
use super::measure::LAMBDA_0_NM;
use crate::reflectance::{
    Geometry, Precision, Reading, Surface, beta, coherent_prefactor, diffuse_prefactor, kappa, ln_diffuse_sum,
};
use crate::spectral::grid::{FIRST_NM, LAST_NM};
use rayon::prelude::*;
use std::sync::Arc;

/// Mirror terms below this share of a surface facing the light are left out.
pub const MIRROR_SHARE: f64 = 1e-7;

/// How exactly the spectral integral is made.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Quality {
    /// Moments and table, mirror terms every 10 nm: while something moves.
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
    /// Where that lies in a camera's table, if it is made by the table.
    pub position: [f64; 2],
    /// How its integral is made.
    pub way: Way,
}

impl Shade {
    const DARK: Self = Self { front: 0.0, kappa: 0.0, beta: 0.0, position: [0.0; 2], way: Way::Dark };
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
    /// Samples with a mirror term.
    pub mirrors: u64,
    /// Samples whose mirror term was left out.
    pub mirrors_skipped: u64,
}

/// What a surface makes of the angles at each lit sample.
#[derive(Clone, Debug)]
pub struct ShadingImage {
    geometry: Arc<GeometryImage>,
    surface: Surface,
    quality: Quality,
    shades: Vec<Shade>,
    mirrors: Vec<Mirror>,
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
        let material = Material::new(surface, reading, quality, geometry.angular_radius());
        let chunk = GeometryImage::chunk();
        let shade = |angles: &Angles| if stop.is_set() { Shade::DARK } else { material.shade(angles) };
        let shades: Vec<Shade> = geometry.angles().par_iter().with_min_len(chunk).map(shade).collect();
        let mirrors = |(run, angles): (usize, &[Angles])| {
            if stop.is_set() { Vec::new() } else { material.mirrors(run * chunk, angles) }
        };
        let mirrors: Vec<Vec<Mirror>> = geometry.angles().par_chunks(chunk).enumerate().map(mirrors).collect();
        if stop.is_set() {
            return None;
        }
        let mirrors = mirrors.concat();
        let counts = counts(&shades, mirrors.len());
        Some(Self { geometry, surface, quality, shades, mirrors, counts })
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

    /// The lit samples, in the order of [`GeometryImage::samples`].
    pub fn shades(&self) -> &[Shade] {
        &self.shades
    }

    /// The samples with a mirror term, ascending.
    pub fn mirrors(&self) -> &[Mirror] {
        &self.mirrors
    }

    /// How many samples take which way.
    pub fn counts(&self) -> ShadingCounts {
        self.counts
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
            ..a
        });
    ShadingCounts { mirrors: mirrors as u64, mirrors_skipped: (shades.len() - mirrors) as u64, ..all }
}

/// One surface in one reading.
struct Material {
    surface: Surface,
    reading: Reading,
    quality: Quality,
    angular_radius: f64,
    /// Below this a mirror term is left out.
    threshold: f64,
}

impl Material {
    fn new(surface: Surface, reading: Reading, quality: Quality, angular_radius: f64) -> Self {
        let facing = crate::reflectance::factor(
            &surface,
            &Geometry::from_angles(0.0, 0.0, 0.0),
            LAMBDA_0_NM,
            reading,
            angular_radius,
        );
        Self { surface, reading, quality, angular_radius, threshold: facing * MIRROR_SHARE }
    }

    fn mirrors(&self, first: usize, angles: &[Angles]) -> Vec<Mirror> {
        let all = angles.iter().enumerate();
        all.filter_map(|(offset, angles)| self.mirror(&angles.geometry(), angles.light(), first + offset)).collect()
    }

    fn shade(&self, angles: &Angles) -> Shade {
        let (geometry, light) = (&angles.geometry(), angles.light());
        if self.reading == Reading::Lambertian {
            return Shade { front: light, kappa: 0.0, beta: 0.0, position: [0.0; 2], way: Way::Flat };
        }
        let front = light * diffuse_prefactor(&self.surface, geometry, self.reading);
        let (kappa, beta) = (kappa(&self.surface, geometry), beta(&self.surface, geometry));
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

    /// The mirror term of a sample, unless it is certainly too small.
    fn mirror(&self, geometry: &Geometry, light: f64, index: usize) -> Option<Mirror> {
        if self.reading == Reading::Lambertian {
            return None;
        }
        let kappa = kappa(&self.surface, geometry);
        let (bluest, reddest) = (LAMBDA_0_NM / FIRST_NM, LAMBDA_0_NM / LAST_NM);
        // Most surfaces: no patch and no reading lifts e^-100 above the threshold.
        if kappa * reddest * reddest > 100.0 {
            return None;
        }
        let front = light * coherent_prefactor(&self.surface, geometry, self.reading);
        // Red is where g is least and the lobe widest; blue is where the reading weighs most.
        let damping = (-kappa * reddest * reddest).exp() * bluest * bluest;
        if front * damping <= self.threshold {
            return None;
        }
        let wave_number = std::f64::consts::TAU / (LAST_NM * 1e-9);
        let envelope = |half_side: f64, v: f64| {
            let u = wave_number * half_side * (v.abs() - self.angular_radius).max(0.0);
            if u > 1.0 { 1.0 / (u * u) } else { 1.0 }
        };
        let lobe =
            envelope(self.surface.half_x_m(), geometry.vx_by_k) * envelope(self.surface.half_y_m(), geometry.vy_by_k);
        (front * damping * lobe > self.threshold).then_some(Mirror {
            index: index as u32,
            front,
            kappa,
            v: [geometry.vx_by_k, geometry.vy_by_k],
        })
    }
}
