//! Directions that are distributed as the slopes of a rough surface's diffuse lobe.

use crate::reflectance::fresnel::transmittance;
use crate::reflectance::{Geometry, Normalization, Surface, kappa};
use glam::Vec3;
use std::f32::consts::TAU;

/// Least height about the horizon over which the sky begins, in y of the unit direction.
pub(super) const EDGE: f32 = 0.05;

/// That height for a single direction over the hemisphere: half of the distance between directions goes with 1/√count.
const EDGE_OF_ONE: f32 = 1.25;

/// Steps of Fresnel's transmittance over the cosine.
const STEPS: usize = 128;

/// Directions about a normal, for the mean over the diffuse lobe.
pub(super) struct Lobe {
    /// Slopes of facets in units of the lobe's width, or for Lambert directions on the unit disk.
    nodes: Vec<[f32; 2]>,
    /// (2σ/τ)².
    slope2: f32,
    /// g for light and viewer at the zenith.
    g: f32,
    form: Form,
    transmittances: Vec<f32>,
}

#[derive(Clone, Copy, PartialEq)]
enum Form {
    Lambert,
    /// cos θi in G², as in Eq 3.
    Eq3,
    Microfacet,
}

/// 0 below the horizon, 1 above, linear from −edge to edge.
pub(super) fn above(y: f32, edge: f32) -> f32 {
    (0.5 + y / (2.0 * edge)).clamp(0.0, 1.0)
}

impl Lobe {
    pub(super) fn new(surface: &Surface, reading: Normalization, directions: usize) -> Self {
        const GOLDEN: f32 = 0.618_034;
        let form = match reading {
            Normalization::Lambertian => Form::Lambert,
            Normalization::Microfacet => Form::Microfacet,
            Normalization::Radiometric | Normalization::Paper => Form::Eq3,
        };
        let count = directions.max(1);
        let node = |k: usize| {
            let share = (k as f32 + 0.5) / count as f32;
            // e^-r² of slopes, even on the disk.
            let r = if form == Form::Lambert { share.sqrt() } else { (-(1.0 - share).ln()).sqrt() };
            let (sin, cos) = (TAU * (k as f32 * GOLDEN).fract()).sin_cos();
            [r * cos, r * sin]
        };
        let slope = (2.0 * surface.sigma_m() / surface.tau_m()) as f32;
        let zenith = Geometry::from_angles(0.0, 0.0, 0.0);
        let step = |index: usize| transmittance(index as f64 / STEPS as f64, surface.index()) as f32;
        Self {
            nodes: (0..count).map(node).collect(),
            slope2: slope * slope,
            g: kappa(surface, &zenith) as f32,
            form,
            transmittances: (0..=STEPS).map(step).collect(),
        }
    }

    /// Mean of what is visible over the lobe; for Lambert over the cosine.
    pub(super) fn visible_mean(&self, normal: Vec3, to_viewer: Vec3, visible: impl Fn(Vec3) -> f32) -> f32 {
        let cos_s = normal.dot(to_viewer).clamp(0.0, 1.0);
        let along = (to_viewer - normal * cos_s).try_normalize();
        let along = along.unwrap_or_else(|| normal.any_orthonormal_vector());
        let across = normal.cross(along);
        // The mean of n/g in Σ gⁿ/(n! n) e^(-b/n): the width of the slopes where g is large, of diffraction by τ where it is small.
        let g = (self.g * cos_s * cos_s).max(f32::MIN_POSITIVE);
        let width = (self.slope2 / -(-g).exp_m1()).min(1e12).sqrt();
        let sin_s = (1.0 - cos_s * cos_s).max(0.0).sqrt();
        // Facets turn what they reflect by twice their slope.
        let reach = if self.form == Form::Lambert { 1.0 } else { (2.0 * width).min(1.0) };
        let edge = (EDGE_OF_ONE * reach / (self.nodes.len() as f32).sqrt()).max(EDGE);
        let (mut seen, mut all) = (0.0, 0.0);
        for &[p, q] in &self.nodes {
            let (local, weight) = match self.form {
                Form::Lambert => (Vec3::new(p, q, (1.0 - p * p - q * q).max(0.0).sqrt()), 1.0),
                Form::Eq3 | Form::Microfacet => self.reflected([p * width, q * width], sin_s, cos_s),
            };
            if weight <= 0.0 {
                continue;
            }
            all += weight;
            let direction = along * local.x + across * local.y + normal * local.z;
            let above = above(direction.y, edge);
            if above > 0.0 {
                seen += weight * above * visible(direction);
            }
        }
        if all > 0.0 { seen / all } else { 0.0 }
    }

    /// The direction that a facet of a slope sends to the viewer, and `f cos θi dωi` in proportion, over the density of slopes.
    fn reflected(&self, [p, q]: [f32; 2], sin_s: f32, cos_s: f32) -> (Vec3, f32) {
        let cos_h = 1.0 / (1.0 + p * p + q * q).sqrt();
        let facet = Vec3::new(p, q, 1.0) * cos_h;
        let viewer = Vec3::new(sin_s, 0.0, cos_s);
        let half = facet.dot(viewer);
        let light = facet * (2.0 * half) - viewer;
        let cos_i = light.z;
        if half <= 0.0 || cos_i <= 0.0 {
            return (light, 0.0);
        }
        let at = cos_i.min(1.0) * STEPS as f32;
        let low = (at as usize).min(STEPS - 1);
        let t = at - low as f32;
        let transmitted = self.transmittances[low] * (1.0 - t) + self.transmittances[low + 1] * t;
        let vz = cos_i + cos_s;
        // S ≈ e^-β/g with g ∝ vz²; dωi = 4 (v·h) cos³θh dp dq.
        let form = if self.form == Form::Microfacet { half * half / vz } else { cos_i };
        (light, transmitted * form * form / (vz * vz) * half * cos_h * cos_h * cos_h)
    }
}
