//! The paper's own roughness: heights and spacing of the mesh's vertices.

use crate::reflectance::Surface;
use chromascope_mesh::Mesh;

/// Roughness of the mesh about one vertex, in meters.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct VertexRoughness {
    /// σ: RMS height of the neighbors about the tangent plane.
    pub sigma_m: f32,
    /// τ: radius of the neighborhood, the distance of the farthest neighbor.
    pub tau_m: f32,
}

impl VertexRoughness {
    /// A surface with this σ and τ in place of its own; out of range, they count as the nearest that is in it.
    pub fn of(self, surface: Surface) -> Surface {
        surface.with_sigma(self.sigma_m.into()).with_tau(self.tau_m.into())
    }
}

/// σ and τ at each vertex, as the paper takes them from the mesh.
///
/// ```text
/// σ_v² = mean over edges (v, w) of ((p_w − p_v) · n_v)²
/// τ_v  = max over edges (v, w) of |p_w − p_v|
/// ```
/// An edge between two triangles counts twice, one at a border once. 0 for a vertex without triangles. These are lengths of
/// the mesh, not of the material: on a head of 0.2 m with edges of some millimeters σ is tenths of a millimeter, ten thousand times
/// the roughness that scatters light. σ/τ is the mesh's own slope between neighbors, and with it the lobe's width.
pub fn vertex_roughness(mesh: &Mesh) -> Vec<VertexRoughness> {
    let mut sums = vec![(0.0_f64, 0_u32, 0.0_f64); mesh.positions().len()];
    for triangle in mesh.triangles() {
        for k in 0..3 {
            let (a, b) = (triangle[k] as usize, triangle[(k + 1) % 3] as usize);
            let edge = mesh.positions()[b].as_dvec3() - mesh.positions()[a].as_dvec3();
            let length2 = edge.length_squared();
            for (at, transform) in [(a, edge), (b, -edge)] {
                let height = transform.dot(mesh.normals()[at].as_dvec3());
                sums[at].0 += height * height;
                sums[at].1 += 1;
                sums[at].2 = sums[at].2.max(length2);
            }
        }
    }
    let single = |length: f64| length.min(f32::MAX.into()) as f32;
    let roughness = |(sum, count, longest2): (f64, u32, f64)| VertexRoughness {
        sigma_m: single((sum / f64::from(count.max(1))).sqrt()),
        tau_m: single(longest2.sqrt()),
    };
    sums.into_iter().map(roughness).collect()
}
