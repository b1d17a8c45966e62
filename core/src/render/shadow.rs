//! Which places of a mesh the light does not reach.

use crate::scene::Mesh;
use glam::{DVec3, Vec3A};
use obvhs::cwbvh::{CwBvh, builder::build_cwbvh_from_tris};
use obvhs::{BvhBuildParams, ray::Ray, triangle::Triangle};

/// A tree over a mesh's triangles that says whether something stands in a ray's way.
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
    /// Builds the tree over a mesh.
    pub fn new(mesh: &Mesh) -> Self {
        let bounds = mesh.bounds();
        let center = bounds.center().as_dvec3();
        let scale = 1.0 / f64::from(bounds.radius).max(f64::MIN_POSITIVE);
        let corner = |i: u32| ((mesh.positions()[i as usize].as_dvec3() - center) * scale).as_vec3a();
        let triangles: Vec<Triangle> = mesh
            .triangles()
            .iter()
            .map(|&[a, b, c]| Triangle { v0: corner(a), v1: corner(b), v2: corner(c) })
            .collect();
        #[allow(
            clippy::default_trait_access,
            reason = "the core does not name clock types; the builder's time is thrown away"
        )]
        let tree = build_cwbvh_from_tris(&triangles, BvhBuildParams::medium_build(), &mut Default::default());
        // In the tree's order a leaf's triangles lie side by side.
        let triangles = tree.primitive_indices.iter().map(|&id| triangles[id as usize]).collect();
        Self { tree, triangles, center, scale }
    }

    /// Whether something stands between a point and what lies `distance` away in a direction of unit length.
    ///
    /// What lies nearer than 2e-6 radii is not in the way: it is the surface itself. Nothing is in the way of what is no
    /// direction.
    pub fn is_blocked(&self, point: DVec3, direction: DVec3, distance: f64) -> bool {
        const NEAREST: f32 = 2e-6;
        let origin = ((point - self.center) * self.scale).as_vec3a();
        let farthest = (distance * self.scale) as f32;
        // Written so that a distance that is no number falls out too.
        if !(origin.is_finite() && direction.is_finite() && farthest > NEAREST) {
            return false;
        }
        // Plus zero, because the tree takes a direction of −0 for positive and its inverse for negative: whole branches are lost.
        let ray = Ray::new(origin, direction.as_vec3a() + Vec3A::ZERO, NEAREST, farthest);
        !self.tree.ray_traverse_miss(ray, |ray, id| self.triangles[id].intersect(ray))
    }
}
