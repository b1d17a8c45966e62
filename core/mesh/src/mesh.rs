//! Triangles with a normal at each vertex.

use glam::Vec3;
use std::hash::{Hash, Hasher};

/// Reason that vertices and triangles make no mesh.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, thiserror::Error)]
#[allow(missing_docs, reason = "each variant says in its message what is wrong")]
pub enum MeshError {
    #[error("there are no triangles")]
    Empty,
    #[error("{positions} vertices but {normals} normals")]
    Normals { positions: usize, normals: usize },
    #[error("triangle {triangle} names vertex {vertex}, which is not there")]
    Vertex { triangle: usize, vertex: u32 },
    #[error("vertex {vertex} is not finite")]
    NotFinite { vertex: usize },
}

/// A box around a mesh, edges along the axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    /// The smallest coordinates.
    pub min: Vec3,
    /// The largest coordinates.
    pub max: Vec3,
    /// The radius of the smallest sphere around the box's center that holds the mesh.
    pub radius: f32,
}

impl Bounds {
    /// The middle of the box.
    pub fn center(self) -> Vec3 {
        // In double precision: the sum of the largest overflows in single.
        self.min.as_dvec3().midpoint(self.max.as_dvec3()).as_vec3()
    }
}

/// Triangles with a unit normal at each vertex, counter-clockwise seen from outside; y up, the front towards +z, in meters.
///
/// Past its constructors every index is in range, every number finite and every normal of unit length.
#[derive(Clone, Debug, PartialEq)]
pub struct Mesh {
    positions: Vec<Vec3>,
    normals: Vec<Vec3>,
    triangles: Vec<[u32; 3]>,
    garment: usize,
    bounds: Bounds,
}

impl Eq for Mesh {}

impl Hash for Mesh {
    fn hash<H: Hasher>(&self, state: &mut H) {
        // Equal meshes have equal counts and bounds; the rest is left to the comparison.
        self.positions.len().hash(state);
        self.triangles.len().hash(state);
        for v in [self.bounds.min, self.bounds.max] {
            // Negative zero equals zero, so it must hash as zero.
            (v + 0.0).to_array().map(f32::to_bits).hash(state);
        }
    }
}

impl Mesh {
    /// Takes vertices with their normals, which are brought to unit length (a zero normal becomes +z), and triangles.
    ///
    /// # Errors
    /// [`MeshError`] if the counts of positions and normals differ, a triangle names a missing vertex, or a vertex is not finite.
    pub fn new(positions: Vec<Vec3>, normals: Vec<Vec3>, triangles: Vec<[u32; 3]>) -> Result<Self, MeshError> {
        if positions.len() != normals.len() {
            return Err(MeshError::Normals { positions: positions.len(), normals: normals.len() });
        }
        check(&positions, &triangles)?;
        if let Some(vertex) = normals.iter().position(|n| !n.is_finite()) {
            return Err(MeshError::NotFinite { vertex });
        }
        let normals = normals.into_iter().map(unit).collect();
        let bounds = bounds(&positions, &triangles);
        let garment = triangles.len();
        Ok(Self { positions, normals, triangles, garment, bounds })
    }

    /// Takes vertices and triangles; each vertex's normal is the mean of its triangles' by area and angle at the vertex.
    ///
    /// # Errors
    /// [`MeshError`] as for [`Mesh::new`].
    pub fn with_smooth_normals(positions: Vec<Vec3>, triangles: Vec<[u32; 3]>) -> Result<Self, MeshError> {
        check(&positions, &triangles)?;
        let normals = smooth_normals(&positions, &triangles);
        Self::new(positions, normals, triangles)
    }

    /// The vertices.
    pub fn positions(&self) -> &[Vec3] {
        &self.positions
    }

    /// The unit normals, one for each vertex.
    pub fn normals(&self) -> &[Vec3] {
        &self.normals
    }

    /// The triangles, as indices of vertices.
    pub fn triangles(&self) -> &[[u32; 3]] {
        &self.triangles
    }

    /// The mesh with its triangles from this index on a garment: a part that may be of another material.
    #[must_use]
    pub fn with_garment(self, first: usize) -> Self {
        Self { garment: first, ..self }
    }

    /// True if a triangle is of the garment.
    pub fn is_garment(&self, triangle: u32) -> bool {
        triangle as usize >= self.garment
    }

    /// The box around all vertices that a triangle uses.
    pub fn bounds(&self) -> Bounds {
        self.bounds
    }
}

fn unit(v: Vec3) -> Vec3 {
    // In double precision: the squares of a tiny mesh's areas underflow in single.
    v.as_dvec3().try_normalize().map_or(Vec3::Z, glam::DVec3::as_vec3)
}

/// The mean of the normals of the triangles around each vertex, weighted by the angle at the vertex (Thürmer and Wüthrich
/// 1998), which does not depend on how a polygon was cut into triangles.
pub fn smooth_normals(positions: &[Vec3], triangles: &[[u32; 3]]) -> Vec<Vec3> {
    let mut sums = vec![glam::DVec3::ZERO; positions.len()];
    for triangle in triangles {
        let corners = triangle.map(|i| positions[i as usize].as_dvec3());
        for k in 0..3 {
            let (a, b) = (corners[(k + 1) % 3] - corners[k], corners[(k + 2) % 3] - corners[k]);
            // A triangle without area has no normal and adds none.
            if let Some(normal) = a.cross(b).try_normalize() {
                sums[triangle[k] as usize] += normal * a.angle_between(b);
            }
        }
    }
    sums.into_iter().map(|sum| sum.try_normalize().map_or(Vec3::Z, glam::DVec3::as_vec3)).collect()
}

fn check(positions: &[Vec3], triangles: &[[u32; 3]]) -> Result<(), MeshError> {
    if triangles.is_empty() {
        return Err(MeshError::Empty);
    }
    if let Some(vertex) = positions.iter().position(|p| !p.is_finite()) {
        return Err(MeshError::NotFinite { vertex });
    }
    for (triangle, corners) in triangles.iter().enumerate() {
        if let Some(&vertex) = corners.iter().find(|&&i| i as usize >= positions.len()) {
            return Err(MeshError::Vertex { triangle, vertex });
        }
    }
    Ok(())
}

fn bounds(positions: &[Vec3], triangles: &[[u32; 3]]) -> Bounds {
    let mut bounds = Bounds { min: Vec3::INFINITY, max: Vec3::NEG_INFINITY, radius: 0.0 };
    let corners = || triangles.iter().flatten().map(|&v| positions[v as usize]);
    for p in corners() {
        bounds.min = bounds.min.min(p);
        bounds.max = bounds.max.max(p);
    }
    // In double precision: the squares of a tiny mesh's distances underflow in single.
    let center = bounds.center().as_dvec3();
    bounds.radius =
        corners().map(|p| p.as_dvec3().distance_squared(center)).fold(0.0, f64::max).sqrt().min(f32::MAX.into()) as f32;
    bounds
}
