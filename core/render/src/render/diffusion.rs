//! Light that spreads within skin before it leaves.
//!
//! ```text
//! I_c += Σ_k [(G_k ∗ q) − q] ∫ C_c S w_k(λ) L dλ / ∫ C_c L dλ
//! ```
//! q = light that a white of the surface sends to the viewer at 550 nm by its diffuse component; `G_k` = Gaussians of
//! [`SPREADS_MM`]; `w_k` = their shares of the light at a wavelength ([`crate::reflectance::diffusion`]). Evenly lit places stay as
//! they are, and what a place loses others gain. Light that has spread leaves in the directions in which light leaves where it
//! entered. Sky and ground, which light a face without edges, are left as they are.
//!
//! A Gaussian is taken along rows and then along columns of the picture, by distances in space and weighed by the area that a sample
//! sees, as far as the surface is unbroken and of skin. Where it is steep in both directions of the picture, the Gaussian is longer
//! along one diagonal than along the other; the mean of its square is the same.

use super::geometry::Angles;
use super::shading::{DiffuseKind, ShadingImage};
use super::stop::Stop;
use super::visibility::Visibility;
use crate::reflectance::diffusion::SPREADS_MM;
use crate::reflectance::{Precision, diffuse_sum};
use chromascope_mesh::{Mesh, Part};
use glam::{DVec3, Vec3};
use rayon::prelude::*;

/// Light by each Gaussian less the light without, in units of q.
pub type Change = [f32; 3];

/// Standard deviations beyond which a Gaussian is nothing.
const REACH: f32 = 3.0;
/// Samples are taken together up to this share of a standard deviation.
const TOGETHER: f64 = 1.0 / 6.0;
/// Samples seen at a flatter angle than this weigh as those at it.
const FLATTEST: f32 = 0.05;

/// A place of skin in the picture.
#[derive(Clone, Copy)]
struct Place {
    sample: u32,
    point: Vec3,
    area: f32,
}

/// Change of light at each lit sample of a mesh in meters, 0 where it sees no skin; none if stopped, or where vertices are shaded in
/// place of samples.
pub fn changes(mesh: &Mesh, visibility: &Visibility, shading: &ShadingImage, stop: &Stop) -> Option<Vec<Change>> {
    if shading.vertices().is_some() {
        return None;
    }
    let (geometry, eye, columns) = (shading.geometry(), visibility.eye(), visibility.size().columns());
    let own: Vec<u32> = (0..geometry.samples().len() as u32)
        .filter(|&index| geometry.placed().part(index as usize) == Part::Body)
        .collect();
    let place = |&index: &u32| {
        let (sample, angles): (u32, &Angles) = (geometry.samples()[index as usize], &geometry.angles()[index as usize]);
        let hit = visibility.hits()[sample as usize];
        let corners = mesh.triangles()[hit.triangle as usize].map(|v| mesh.positions()[v as usize].as_dvec3());
        let point: DVec3 = corners.iter().zip(hit.barycentric()).map(|(&p, weight)| p * f64::from(weight)).sum();
        // A sample has a solid angle of cos³α.
        let seen = angles.falloff.powf(0.75) * point.distance_squared(eye.position) as f32;
        Place { sample, point: (point - eye.center).as_vec3(), area: seen / angles.cos_s.max(FLATTEST) }
    };
    let light = |&index: &u32| {
        let (shade, angles) = (&shading.shades()[index as usize], &geometry.angles()[index as usize]);
        let share = match shade.kind {
            DiffuseKind::Dark => return 0.0,
            DiffuseKind::Flat => 1.0,
            DiffuseKind::Spectral => diffuse_sum(shade.kappa, shade.beta * shade.kappa, Precision::Coarse),
        };
        (shade.front * share) as f32 / angles.falloff.max(f32::MIN_POSITIVE)
    };
    let places: Vec<Place> = own.par_iter().with_min_len(4096).map(place).collect();
    let lights: Vec<f32> = own.par_iter().with_min_len(1024).map(light).collect();
    let pitch = 2.0 * eye.half_height * eye.position.distance(eye.center) / visibility.size().rows() as f64;
    let lines = Lines { places: &places, spreads: SPREADS_MM.map(|spread| spread * 1e-3), pitch, stop };
    let across: Vec<u32> = (0..own.len() as u32).collect();
    let mut down = across.clone();
    down.par_sort_by_key(|&at| places[at as usize].sample as usize % columns);
    let spread: Vec<Change> = lights.iter().map(|&light| [light; 3]).collect();
    let spread = lines.spread(&across, |sample| sample as usize / columns, &spread);
    let spread = lines.spread(&down, |sample| sample as usize % columns, &spread);
    let mut changes = vec![[0.0; 3]; geometry.samples().len()];
    for ((&index, spread), light) in own.iter().zip(spread).zip(lights) {
        changes[index as usize] = spread.map(|spread| geometry.angles()[index as usize].falloff * (spread - light));
    }
    (!stop.is_set()).then_some(changes)
}

/// Rows or columns of a picture along which light spreads.
struct Lines<'a> {
    places: &'a [Place],
    /// In meters.
    spreads: [f64; 3],
    /// From one sample to the next at the middle of the mesh, in meters.
    pitch: f64,
    stop: &'a Stop,
}

impl Lines<'_> {
    /// Light of all places by each Gaussian along the lines of an order.
    fn spread(&self, order: &[u32], line_of: impl Fn(u32) -> usize + Sync, light: &[Change]) -> Vec<Change> {
        let line = |at: u32| line_of(self.places[at as usize].sample);
        let lines: Vec<&[u32]> = order.chunk_by(|&a, &b| line(a) == line(b)).collect();
        let along = |line: &&[u32]| if self.stop.is_set() { Vec::new() } else { self.along(line, light) };
        let found: Vec<Vec<Change>> = lines.par_iter().map(along).collect();
        let mut all = vec![[0.0; 3]; light.len()];
        for (&at, change) in lines.iter().zip(&found).flat_map(|(line, found)| line.iter().zip(found)) {
            all[at as usize] = *change;
        }
        all
    }

    fn along(&self, line: &[u32], light: &[Change]) -> Vec<Change> {
        // Sums from the line's start: area, and area times light.
        let mut sums = vec![[0.0_f64; 4]];
        for &at in line {
            let (area, light, [a, b, c, d]) =
                (f64::from(self.places[at as usize].area), light[at as usize].map(f64::from), sums[sums.len() - 1]);
            sums.push([a + area, b + area * light[0], c + area * light[1], d + area * light[2]]);
        }
        let mut out = vec![[0.0; 3]; line.len()];
        for (k, spread) in self.spreads.into_iter().enumerate() {
            // An odd number of samples, about the one in their middle.
            let half = ((TOGETHER * spread / self.pitch) as usize).min(line.len()) / 2;
            let spread = spread as f32;
            for (at, out) in out.iter_mut().enumerate() {
                let point = self.places[line[at] as usize].point;
                let mut total = [0.0_f64; 2];
                // True if the samples about one are within reach.
                let mut take = |middle: usize| {
                    let away = self.places[line[middle] as usize].point.distance_squared(point) / (spread * spread);
                    if away > REACH * REACH {
                        return false;
                    }
                    let (first, last) = (sums[middle.saturating_sub(half)], sums[(middle + half + 1).min(line.len())]);
                    let weight = f64::from((-0.5 * away).exp());
                    total[0] += weight * (last[0] - first[0]);
                    total[1] += weight * (last[k + 1] - first[k + 1]);
                    true
                };
                let step = 2 * half + 1;
                let _ = (at..line.len()).step_by(step).all(&mut take);
                let _ = (1..=at / step).all(|back| take(at - back * step));
                out[k] = if total[0] > 0.0 { (total[1] / total[0]) as f32 } else { light[line[at] as usize][k] };
            }
        }
        out
    }
}
