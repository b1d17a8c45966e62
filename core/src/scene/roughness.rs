//! The paper's own way to a roughness: from the mesh's own unevenness.

use super::mesh::Mesh;

/// σ at each vertex in meters: the root mean square height of its neighbors about its tangent plane.
///
/// ```text
/// σ_v² = mean over edges (v, w) of ((p_w − p_v) · n_v)²
/// ```
/// An edge between two triangles counts twice, one at a border once. 0 for a vertex without triangles. These are heights of
/// the mesh, not of the surface: on a head of 0.2 m with an edge of some millimeters, tenths of a millimeter, ten thousand
/// times what scatters light.
pub fn vertex_deviations(mesh: &Mesh) -> Vec<f32> {
    let mut sums = vec![(0.0_f64, 0_u32); mesh.positions().len()];
    for triangle in mesh.triangles() {
        for k in 0..3 {
            let (a, b) = (triangle[k] as usize, triangle[(k + 1) % 3] as usize);
            let edge = mesh.positions()[b].as_dvec3() - mesh.positions()[a].as_dvec3();
            for (at, way) in [(a, edge), (b, -edge)] {
                let height = way.dot(mesh.normals()[at].as_dvec3());
                sums[at].0 += height * height;
                sums[at].1 += 1;
            }
        }
    }
    let deviation = |(sum, count): (f64, u32)| (sum / f64::from(count.max(1))).sqrt().min(f32::MAX.into()) as f32;
    sums.into_iter().map(deviation).collect()
}
