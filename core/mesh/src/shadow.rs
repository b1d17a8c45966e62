//! Places of a mesh that the light does not reach.

mod split;

use crate::Mesh;
use glam::{DVec3, Vec3A};
use obvhs::cwbvh::{CwBvh, bvh2_to_cwbvh::bvh2_to_cwbvh};
use obvhs::{ray::Ray, triangle::Triangle};
use rayon::slice::ParallelSliceMut as _;

/// The most triangles in a leaf.
const LEAF: u32 = 3;

/// Acceleration tree over a mesh's triangles for occlusion tests.
///
/// Single precision, with the mesh brought to a radius of one around the origin, so that it works alike at any scale and place.
pub struct ShadowTree {
    tree: CwBvh,
    triangles: Vec<Triangle>,
    center: DVec3,
    scale: f64,
}

impl std::fmt::Debug for ShadowTree {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("ShadowTree").field("triangles", &self.triangles.len()).finish_non_exhaustive()
    }
}

impl ShadowTree {
    /// Builds the tree over a mesh of n triangles in n log n steps, wherever they lie: one on another, nested, without area.
    pub fn new(mesh: &Mesh) -> Self {
        let bounds = mesh.bounds();
        let center = bounds.center().as_dvec3();
        let scale = 1.0 / f64::from(bounds.radius).max(f64::MIN_POSITIVE);
        let corner = |i: u32| ((mesh.positions()[i as usize].as_dvec3() - center) * scale).as_vec3a();
        let triangles =
            mesh.triangles().iter().map(|&[a, b, c]| Triangle { v0: corner(a), v1: corner(b), v2: corner(c) });
        let triangles = distinct(triangles.collect());
        // Children in any order: the first occluder ends a ray.
        let tree = bvh2_to_cwbvh(&split::tree(&triangles), LEAF, false, false);
        // In the tree's order a leaf's triangles lie side by side.
        let triangles = tree.primitive_indices.iter().map(|&id| triangles[id as usize]).collect();
        Self { tree, triangles, center, scale }
    }

    /// True if something stands between a point and what lies `distance` away in a direction of unit length.
    ///
    /// Surfaces nearer than 2e-6 radii are ignored: they are the origin's own. Invalid directions are never blocked.
    pub fn is_blocked(&self, point: DVec3, direction: DVec3, distance: f64) -> bool {
        const NEAREST: f32 = 2e-6;
        let origin = ((point - self.center) * self.scale).as_vec3a();
        let farthest = (distance * self.scale) as f32;
        // Written so that a NaN distance is rejected too.
        if !(origin.is_finite() && direction.is_finite() && farthest > NEAREST) {
            return false;
        }
        // Plus zero, because the tree takes a direction of −0 for positive and its inverse for negative: whole branches are lost.
        let ray = Ray::new(origin, direction.as_vec3a() + Vec3A::ZERO, NEAREST, farthest);
        !self.tree.ray_traverse_miss(ray, |ray, id| self.triangles[id].intersect(ray))
    }
}

/// Triangles without those that repeat another: a ray that misses one misses all its copies.
fn distinct(triangles: Vec<Triangle>) -> Vec<Triangle> {
    let bits = |triangle: &Triangle| [triangle.v0, triangle.v1, triangle.v2].map(|v| v.to_array().map(f32::to_bits));
    // The multiplier of Knuth's linear congruential generator; copies have one hash, and few others do.
    let mix = |hash: u64, bits: &u32| (hash ^ u64::from(*bits)).wrapping_mul(6_364_136_223_846_793_005).rotate_left(29);
    let hash = |triangle| bits(triangle).as_flattened().iter().fold(0, mix);
    let mut order: Vec<(u64, u32)> =
        triangles.iter().zip(0..).map(|(triangle, index)| (hash(triangle), index)).collect();
    order.par_sort_unstable();
    order.dedup_by(|a, b| a.0 == b.0 && bits(&triangles[a.1 as usize]) == bits(&triangles[b.1 as usize]));
    if order.len() == triangles.len() {
        return triangles;
    }
    let mut kept: Vec<u32> = order.into_iter().map(|(_, index)| index).collect();
    kept.par_sort_unstable();
    kept.into_iter().map(|index| triangles[index as usize]).collect()
}
