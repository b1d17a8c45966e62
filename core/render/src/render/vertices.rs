//! P at the vertices, interpolated: how the paper renders, with a roughness of its own at each vertex.

use super::geometry::{Angles, GeometryImage};
use super::stop::Stop;
use super::visibility::Visibility;
use crate::reflectance::Geometry;
use crate::scene::Lighting;
use chromascope_mesh::Mesh;
use rayon::prelude::*;
use std::sync::Arc;

/// A lit sample as a mixture of three vertices.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Blend {
    /// The triangle's vertices.
    pub corners: [u32; 3],
    /// Their weights.
    pub weights: [f32; 3],
    /// `cos θi cos⁴α` at the sample: the vertices give P alone.
    pub light: f32,
}

/// The angles at every vertex, and how the lit samples of a picture mix them.
#[derive(Clone, Debug)]
pub struct VertexImage {
    geometry: Arc<GeometryImage>,
    geometries: Vec<Geometry>,
    blends: Vec<Blend>,
}

impl VertexImage {
    /// Finds the angles at the vertices and what the lit samples of a picture lie between; none if stopped.
    ///
    /// A vertex whose normal is turned away from light or viewer gives nothing, so sheets are lit on their front alone.
    pub fn new(
        mesh: &Mesh,
        visibility: &Visibility,
        geometry: Arc<GeometryImage>,
        lighting: &Lighting,
        stop: &Stop,
    ) -> Option<Self> {
        let eye = visibility.eye();
        let light = lighting.before(eye);
        let geometries = |(point, normal): (&glam::Vec3, &glam::Vec3)| {
            let (point, normal) = (point.as_dvec3(), normal.as_dvec3());
            let to_viewer = (eye.position - point).try_normalize();
            let seen = light.seen_from(point).zip(to_viewer);
            seen.map_or(Geometry::DARK, |((to_light, _), to_viewer)| {
                Geometry::from_directions(to_light, to_viewer, normal)
            })
        };
        let geometries = mesh.positions().par_iter().zip(mesh.normals()).with_min_len(4096).map(geometries).collect();
        let blend = |(&sample, angles): (&u32, &Angles)| {
            let hit = visibility.hits()[sample as usize];
            let corners = mesh.triangles()[hit.triangle as usize];
            Blend { corners, weights: hit.barycentric(), light: angles.light() as f32 }
        };
        let lit = geometry.samples().par_iter().zip(geometry.angles());
        let blends = lit.with_min_len(4096).map(blend).collect();
        (!stop.is_set()).then_some(Self { geometry, geometries, blends })
    }

    /// The picture's lit samples.
    pub fn geometry(&self) -> &Arc<GeometryImage> {
        &self.geometry
    }

    /// The angles at each vertex of the mesh.
    pub fn geometries(&self) -> &[Geometry] {
        &self.geometries
    }

    /// The signals of the lit samples from those of the vertices.
    pub(super) fn mixed(&self, vertices: &[[f32; 3]]) -> Vec<[f32; 3]> {
        let mix = |blend: &Blend| {
            let mut sum = [0.0; 3];
            for (corner, weight) in blend.corners.into_iter().zip(blend.weights) {
                let vertex = vertices.get(corner as usize).copied().unwrap_or_default();
                sum.iter_mut().zip(vertex).for_each(|(sum, signal)| *sum += weight * signal);
            }
            sum.map(|signal| signal * blend.light)
        };
        self.blends.par_iter().with_min_len(4096).map(mix).collect()
    }
}
