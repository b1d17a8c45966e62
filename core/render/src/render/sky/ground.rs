//! Light that a level ground beneath the mesh sends up: one diffuse reflection.
//!
//! ```text
//! E(v) = ρ_g/π ∫_below V(v, ω) E_g(x) cos θ dω,   E_g(x) = V(x, l) cos θ_g + s
//! I_c = E/ρ_g cos⁴α ∫ C_c ρ̄(λ) S ρ_g L dλ / ∫ C_c L dλ,   ρ̄ = 2 ∫ ρ_d(θs; λ) cos θs sin θs dθs
//! ```
//! x = place of the ground in direction ω from the vertex v; l = direction of the light; s and `ρ_d` as for the sky. The cells of
//! the sky, mirrored at the horizon, are the directions: one ray a cell and neighborhood of vertices, and one from each place of
//! the ground that is seen to the light; sums over them are scaled so that the ground seen whole has its exact share, (1 − `n_y`)/2.
//! It has no end here. The ground itself is taken to see the whole sky, and the coherent component gives none of
//! this light. Of sheets both sides get what the front does.

use super::super::geometry::GeometryImage;
use super::super::measure::SpectralWeights;
use super::super::stop::Stop;
use super::super::visibility::Visibility;
use super::visible::{ABOVE, CHUNK, SIDE, neighborhoods, ray};
use super::{STEPS, Sky};
use crate::scene::PlacedLight;
use chromascope_mesh::{Mesh, ShadowTree};
use glam::DVec3;
use rayon::prelude::*;
use std::f64::consts::PI;

/// A ray to the ground ends before it by this share.
const BEFORE: f64 = 1e-4;

/// Cells below the horizon in which each vertex of a mesh sees the ground at its foot. Depends on the mesh alone.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct GroundView {
    /// The neighborhood of each vertex.
    of_vertex: Vec<u32>,
    /// A vertex of each neighborhood, and its cells.
    cells: Vec<(u32, u64)>,
}

/// Irradiance from a white ground over that of a surface that faces the light: under the light, and under a sky with s = 1.
pub type Bounce = [f32; 2];

/// A ray from a vertex to the ground.
struct ToGround {
    cell: usize,
    from: DVec3,
    direction: DVec3,
    distance: f64,
    /// cos θ dω/π, about.
    weight: f64,
}

impl ToGround {
    fn place(&self) -> DVec3 {
        self.from + self.direction * self.distance
    }
}

/// Direction of each cell, and its solid angle over π.
fn directions() -> Vec<(DVec3, f64)> {
    let of = |cell| {
        let up = ray(cell);
        // The octahedron's point is up/|up|₁: an area of it appears under |up|₁³ times its share of the square (2/8)²/2.
        let sum = up.abs().element_sum();
        (DVec3::new(up.x, -up.y, up.z), sum * sum * sum * 2.0 / ((SIDE * SIDE) as f64 * PI))
    };
    (0..SIDE * SIDE).map(of).collect()
}

/// Rays from a vertex to a ground without an end.
fn rays(mesh: &Mesh, vertex: u32, directions: &[(DVec3, f64)]) -> impl Iterator<Item = ToGround> {
    let bounds = mesh.bounds();
    let [point, normal] = [mesh.positions(), mesh.normals()].map(|all| all[vertex as usize].as_dvec3());
    let from = point + normal * (f64::from(bounds.radius) * ABOVE);
    directions.iter().enumerate().filter_map(move |(cell, &(direction, solid))| {
        let (cos, distance) = (direction.dot(normal), (f64::from(bounds.min.y) - from.y) / direction.y);
        (cos > 0.0).then_some(ToGround { cell, from, direction, distance, weight: cos * solid })
    })
}

impl GroundView {
    /// Traces one ray for each cell and each neighborhood of vertices; none if stopped.
    pub fn new(mesh: &Mesh, tree: &ShadowTree, stop: &Stop) -> Option<Self> {
        let ((members, first), directions) = (neighborhoods(mesh, false), directions());
        let trace = |vertex: u32| {
            let free = |to: &ToGround| !tree.is_blocked(to.from, to.direction, to.distance * (1.0 - BEFORE));
            let seen = rays(mesh, vertex, &directions).filter(|to| !stop.is_set() && free(to));
            (vertex, seen.fold(0, |cells, to| cells | 1 << to.cell))
        };
        let cells = first.par_iter().with_max_len(CHUNK).map(|member| trace(member.index)).collect();
        let of_vertex = members.into_iter().map(|member| member.index).collect();
        (!stop.is_set()).then_some(Self { of_vertex, cells })
    }

    /// Memory in bytes.
    pub fn bytes(&self) -> usize {
        size_of_val(&*self.of_vertex) + size_of_val(&*self.cells)
    }

    /// Light from a white ground at each vertex; without a tree nothing shades the ground. None if stopped.
    pub fn at_vertices(
        &self,
        mesh: &Mesh,
        light: PlacedLight,
        tree: Option<&ShadowTree>,
        stop: &Stop,
    ) -> Option<Vec<Bounce>> {
        let (above, directions) = (f64::from(mesh.bounds().radius) * ABOVE, directions());
        let lit = |&(vertex, cells): &(u32, u64)| {
            let is_lit = |to: &ToGround| {
                let place = to.place() + DVec3::Y * above;
                let way = light.seen_from(place).filter(|(way, _)| way.y > 0.0);
                way.is_some_and(|(way, far)| tree.is_none_or(|tree| !tree.is_blocked(place, way, far)))
            };
            let seen =
                rays(mesh, vertex, &directions).filter(|to| cells >> to.cell & 1 == 1 && !stop.is_set() && is_lit(to));
            seen.fold(0_u64, |cells, to| cells | 1 << to.cell)
        };
        let lit: Vec<u64> = self.cells.par_iter().with_max_len(CHUNK).map(lit).collect();
        let at = |(vertex, &of): (usize, &u32)| {
            let (seen, lit) = (self.cells[of as usize].1, lit[of as usize]);
            let (mut all, mut sums) = (0.0, [0.0; 2]);
            for to in rays(mesh, vertex as u32, &directions) {
                let has = |cells: u64| if cells >> to.cell & 1 == 1 { to.weight } else { 0.0 };
                let cos = light.seen_from(to.place()).map_or(0.0, |(way, _)| way.y);
                all += to.weight;
                sums = [sums[0] + has(lit) * cos, sums[1] + has(seen)];
            }
            // All of the ground together: (1 − n_y)/2.
            let whole = f64::midpoint(1.0, -f64::from(mesh.normals()[vertex].y));
            sums.map(|sum| if all > 0.0 { (whole * sum / all) as f32 } else { 0.0 })
        };
        let all = self.of_vertex.par_iter().enumerate().with_min_len(CHUNK).map(at).collect();
        (!stop.is_set()).then_some(all)
    }
}

/// Light from a white ground at the lit samples of a picture, times cos⁴α.
pub fn at_samples(vertices: &[Bounce], mesh: &Mesh, visibility: &Visibility, geometry: &GeometryImage) -> Vec<Bounce> {
    let lit = geometry.samples().par_iter().zip(geometry.angles()).with_min_len(4096);
    let mix = |(&sample, angles): (&u32, &super::Angles)| {
        let hit = visibility.hits()[sample as usize];
        let corners = mesh.triangles()[hit.triangle as usize].map(|v| vertices[v as usize]);
        std::array::from_fn(|k| {
            let sum: f32 = corners.iter().zip(hit.barycentric()).map(|(corner, weight)| weight * corner[k]).sum();
            angles.falloff * sum
        })
    };
    lit.map(mix).collect()
}

/// Light from a white ground at a sample, under the light and a sky.
pub(in crate::render) fn from_below(bounce: Bounce, sky: Option<&Sky>) -> f32 {
    bounce[0] + sky.map_or(0.0, |sky| sky.share as f32) * bounce[1]
}

/// Adds the ground's light to the signals of all lit samples.
pub(in crate::render) fn add(
    bounce: &[Bounce],
    sky: Option<&Sky>,
    measure: &SpectralWeights,
    signals: &mut [[f32; 3]],
) {
    let Some(table) = &measure.bounce else { return };
    // In all directions alike: from below, a steep surface does not shine along its outline as under light from everywhere.
    let weights = (0..=STEPS).map(|step| step as f32).zip(&table.diffuse);
    let sum = weights.fold([0.0; 3], |sum, (weight, row)| std::array::from_fn(|c| sum[c] + weight * row[c]));
    let mean = sum.map(|sum| sum * 2.0 / (STEPS * (STEPS + 1)) as f32);
    let lit = signals.par_iter_mut().zip(bounce).with_min_len(4096);
    lit.for_each(|(signal, &bounce)| {
        let light = from_below(bounce, sky);
        signal.iter_mut().zip(mean).for_each(|(signal, share)| *signal += light * share);
    });
}
