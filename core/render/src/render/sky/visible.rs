//! Share of a uniform sky that each vertex of a mesh sees.
//!
//! The sky is the hemisphere above the horizon (+y), divided into 8 × 8 cells by its octahedron: the direction (x, y, z) with
//! y ≥ 0 lies at u = p + q, v = p − q of the square [−1, 1]², p = x/s, q = z/s, s = |x| + y + |z|. One ray a cell and vertex,
//! or a small neighborhood of them; between cells and between vertices what is visible is interpolated.

use crate::render::geometry::THIN;
use crate::render::stop::Stop;
use chromascope_mesh::{Mesh, ShadowTree};
use glam::{DVec3, Vec3};
use rayon::prelude::*;
use std::collections::BTreeMap;

pub(super) const SIDE: usize = 8;

/// Distance from the surface at which rays begin, in scene radii.
pub(super) const ABOVE: f64 = 1e-5;

/// Side of the cube whose vertices see the same of the sky, in scene radii, and how finely their normals are told apart: of closed
/// meshes, and of leaves, which are many and thin.
const FINE: (f32, f32) = (0.012, 2.0);
const COARSE: (f32, f32) = (0.02, 1.0);

/// Neighborhoods that one task works on.
pub(super) const CHUNK: usize = 256;

/// Cells of the sky that a vertex sees, one bit a cell.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct VisibleCells {
    /// Before the surface; cells below the tangent plane, which say nothing, count as visible.
    pub front: u64,
    /// Behind the surface, through a leaf's thickness; cells above the tangent plane count as visible.
    pub back: u64,
}

impl VisibleCells {
    /// Those of the opposite normal.
    fn turned(self, flipped: bool) -> Self {
        if flipped { Self { front: self.back, back: self.front } } else { self }
    }
}

/// Cells of the sky that the vertices of a mesh see. Depends on the mesh alone.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SkyVisibility {
    cells: Vec<VisibleCells>,
}

impl SkyVisibility {
    /// Traces one ray for each cell of the sky and each neighborhood of vertices; none if stopped. Without `back` the sky behind the
    /// surface counts as visible: nothing sees that side of a closed mesh.
    pub fn new(mesh: &Mesh, tree: &ShadowTree, back: bool, stop: &Stop) -> Option<Self> {
        let radius = f64::from(mesh.bounds().radius).max(f64::MIN_POSITIVE);
        let tracing = Tracing { tree, radius, back, directions: (0..SIDE * SIDE).map(ray).collect() };
        let (members, first) = neighborhoods(mesh, back);
        let trace = |&Member { index: vertex, flipped }: &Member| {
            let (point, normal) = (mesh.positions()[vertex as usize], mesh.normals()[vertex as usize]);
            if stop.is_set() {
                return VisibleCells::default();
            }
            tracing.from(point.as_dvec3(), normal.as_dvec3()).turned(flipped)
        };
        let traced: Vec<VisibleCells> = first.par_iter().with_max_len(CHUNK).map(trace).collect();
        let cells = members.into_iter().map(|member| traced[member.index as usize].turned(member.flipped)).collect();
        (!stop.is_set()).then_some(Self { cells })
    }

    /// The whole sky at every vertex: nothing hides it.
    pub fn open(mesh: &Mesh) -> Self {
        Self { cells: vec![VisibleCells { front: u64::MAX, back: u64::MAX }; mesh.positions().len()] }
    }

    /// Cells that each vertex sees.
    pub fn cells(&self) -> &[VisibleCells] {
        &self.cells
    }
}

/// A vertex in a neighborhood, or a neighborhood's first vertex.
#[derive(Clone, Copy)]
pub(super) struct Member {
    pub(super) index: u32,
    flipped: bool,
}

/// The neighborhood of each vertex, and the first vertex of each: vertices of one small cube whose normals are alike, where both
/// sides are looked at up to the sign.
pub(super) fn neighborhoods(mesh: &Mesh, both_sides: bool) -> (Vec<Member>, Vec<Member>) {
    let bounds = mesh.bounds();
    let (side, fineness) = if both_sides { COARSE } else { FINE };
    let scale = 1.0 / (side * bounds.radius).max(f32::MIN_POSITIVE);
    let mut known = BTreeMap::new();
    let mut first = Vec::new();
    let of = |(vertex, (point, normal)): (usize, (&Vec3, &Vec3))| {
        let cube = ((*point - bounds.min) * scale).as_ivec3();
        let towards = (*normal * fineness).round().as_ivec3();
        let flipped = both_sides && towards.to_array().into_iter().find(|&v| v != 0).is_some_and(|v| v < 0);
        let index =
            *known.entry((cube.to_array(), if flipped { -towards } else { towards }.to_array())).or_insert_with(|| {
                first.push(Member { index: vertex as u32, flipped });
                first.len() as u32 - 1
            });
        Member { index, flipped }
    };
    let members = mesh.positions().iter().zip(mesh.normals()).enumerate().map(of).collect();
    (members, first)
}

/// Rays to the sky from the vertices of a mesh.
struct Tracing<'a> {
    tree: &'a ShadowTree,
    radius: f64,
    back: bool,
    directions: Vec<DVec3>,
}

impl Tracing<'_> {
    fn from(&self, point: DVec3, normal: DVec3) -> VisibleCells {
        let mut cells = VisibleCells::default();
        for (cell, &direction) in self.directions.iter().enumerate() {
            let is_before = direction.dot(normal) > 0.0;
            let free = if is_before {
                !self.tree.is_blocked(point + normal * (self.radius * ABOVE), direction, f64::INFINITY)
            } else {
                !self.back || !self.tree.is_blocked(point + direction * (self.radius * THIN), direction, f64::INFINITY)
            };
            cells.front |= u64::from(free || !is_before) << cell;
            cells.back |= u64::from(free || is_before) << cell;
        }
        cells
    }
}

/// Visible share of the sky in a direction, from 0 to 1, where cells are interpolated, mixed from three vertices by weights.
/// Directions below the horizon count as the nearest on it.
pub fn visible_share(masks: [u64; 3], weights: [f32; 3], direction: Vec3) -> f32 {
    let every = masks[0] & masks[1] & masks[2];
    let any = masks[0] | masks[1] | masks[2];
    if every == u64::MAX {
        return 1.0;
    }
    let y = direction.y.max(0.0);
    let scale = 1.0 / (direction.x.abs() + y + direction.z.abs()).max(f32::MIN_POSITIVE);
    let (p, q) = (direction.x * scale, direction.z * scale);
    let axis = |at: f32| {
        let at = (at.clamp(-1.0, 1.0) + 1.0) * (0.5 * SIDE as f32) - 0.5;
        let low = at.max(0.0) as usize;
        (low, (low + 1).min(SIDE - 1), (at - low as f32).clamp(0.0, 1.0))
    };
    let ((u0, u1, u), (v0, v1, v)) = (axis(p + q), axis(p - q));
    let cell = |row: usize, column: usize| {
        let bit = 1_u64 << (row * SIDE + column);
        if every & bit != 0 {
            1.0
        } else if any & bit == 0 {
            0.0
        } else {
            (0..3).map(|k| if masks[k] & bit != 0 { weights[k] } else { 0.0 }).sum()
        }
    };
    let low = cell(v0, u0) * (1.0 - u) + cell(v0, u1) * u;
    let high = cell(v1, u0) * (1.0 - u) + cell(v1, u1) * u;
    low * (1.0 - v) + high * v
}

/// Direction of a cell's ray: near its middle, so that no plane through the vertex runs through the rays of a whole row of cells.
pub(super) fn ray(cell: usize) -> DVec3 {
    // Steps of the plastic number's sequence (Roberts 2018), which fills a square evenly.
    let aside = |step: f64| 0.8 * ((cell as f64 * step).fract() - 0.5);
    let at = |index: usize, aside: f64| (index as f64 + 0.5 + aside) * 2.0 / SIDE as f64 - 1.0;
    let (u, v) = (at(cell % SIDE, aside(0.754_877_666_246_693)), at(cell / SIDE, aside(0.569_840_290_998_053)));
    let (x, z) = (f64::midpoint(u, v), (u - v) / 2.0);
    DVec3::new(x, (1.0 - x.abs() - z.abs()).max(0.0), z).normalize()
}
