//! Triangles with a normal at each vertex.

use glam::Vec3;
use rayon::prelude::*;
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

/// Part of a scene that may be of a material of its own.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Part {
    /// The mesh itself: skin, leaf.
    #[default]
    Body,
    /// The head's garment.
    Garment,
    /// The head's hair.
    Hair,
    /// Its brows.
    Brows,
    /// A patch of the chart beside the mesh, in the chart's order.
    Patch(u16),
    /// What holds the chart.
    Card,
    /// The ground beneath the mesh.
    Ground,
}

impl Part {
    /// True if it scatters light evenly (Lambert), whatever the surface of the body: cloth, hair, cardboard.
    pub fn is_matte(self) -> bool {
        self != Self::Body
    }

    /// True if it is of the mesh, not of what stands about it.
    pub fn is_subject(self) -> bool {
        !matches!(self, Self::Patch(_) | Self::Card | Self::Ground)
    }
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
    /// Of each triangle; empty where all are of the body.
    parts: Vec<Part>,
    /// True if the body is the head, with hair and brows.
    has_hair: bool,
    /// Number of vertices that are to be seen whole, the first ones, and the least height of those.
    framed: (usize, f32),
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
        let framed = (positions.len(), f32::NEG_INFINITY);
        Ok(Self { positions, normals, triangles, parts: Vec::new(), has_hair: false, framed, bounds })
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

    /// The mesh with a part for each triangle, in their order; triangles without one are of the body.
    #[must_use]
    pub fn with_parts(self, parts: Vec<Part>) -> Self {
        Self { parts, ..self }
    }

    /// The part that each triangle is of; empty where all are of the body.
    pub fn parts(&self) -> &[Part] {
        &self.parts
    }

    /// The part that a triangle is of, as a whole.
    pub fn part(&self, triangle: u32) -> Part {
        self.parts.get(triangle as usize).copied().unwrap_or_default()
    }

    /// The mesh of which pictures show everything above a height, and what is below as far as it comes.
    #[must_use]
    pub fn framed_above(self, height: f32) -> Self {
        Self { framed: (self.framed.0, height), ..self }
    }

    /// True if a picture of the whole leaves the lowest part out.
    pub fn is_cropped(&self) -> bool {
        self.framed.1 > f32::NEG_INFINITY
    }

    /// The vertices that a picture of the whole shows.
    pub fn framed(&self) -> impl ParallelIterator<Item = &Vec3> {
        let (count, least) = self.framed;
        self.positions[..count].par_iter().with_min_len(4096).filter(move |p| p.y >= least)
    }

    /// The part of a place on a triangle by the weights of its second and third corner. Hair and brows end within triangles.
    pub fn part_at(&self, triangle: u32, weights: [f32; 2]) -> Part {
        match self.part(triangle) {
            Part::Body if self.has_hair => {
                let [a, b, c] = self.triangles[triangle as usize].map(|v| self.positions[v as usize]);
                crate::hair::part_at(a + weights[0] * (b - a) + weights[1] * (c - a))
            }
            part => part,
        }
    }

    /// The head with hair and brows.
    pub(crate) fn with_hair(mut self) -> Self {
        self.parts.resize(self.triangles.len(), Part::Body);
        Self { has_hair: true, ..self }
    }

    /// The mesh with others about it, which its bounds leave out; the first `framed` of their vertices are to be seen whole.
    pub(crate) fn among(self, others: Self, framed: usize) -> Self {
        let first = self.positions.len() as u32;
        let mut all = self;
        all.parts.resize(all.triangles.len(), Part::Body);
        all.parts.extend(others.parts);
        all.positions.extend(others.positions);
        all.normals.extend(others.normals);
        all.triangles.extend(others.triangles.iter().map(|corners| corners.map(|v| v + first)));
        all.framed.0 += framed;
        all
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
