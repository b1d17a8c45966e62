//! A surface under construction: vertices, normals, triangles.

use crate::mesh::Mesh;
use glam::Vec3;

/// The cosine between a triangle's normal and its corners' from which on they share vertices.
const LEAST_AGREEMENT: f32 = 0.1;

/// Surface that parts of the plant are added to.
#[derive(Clone, Debug, Default)]
pub(super) struct Surface {
    pub(super) positions: Vec<Vec3>,
    pub(super) normals: Vec<Vec3>,
    pub(super) triangles: Vec<[u32; 3]>,
}

impl Surface {
    pub(super) fn next(&self) -> u32 {
        self.positions.len() as u32
    }

    /// A new vertex, whose normal [`Surface::shade`] gives.
    pub(super) fn vertex(&mut self, position: Vec3) {
        self.positions.push(position);
        self.normals.push(Vec3::ZERO);
    }

    /// A new triangle, its corners counter-clockwise, or clockwise where `flipped`.
    pub(super) fn triangle(&mut self, [a, b, c]: [u32; 3], flipped: bool) {
        self.triangles.push(if flipped { [a, c, b] } else { [a, b, c] });
    }

    /// Gives all vertices of the triangles from `first` on the mean normal of these triangles by area; a triangle that
    /// would look away from a corner's normal gets a vertex of its own there.
    pub(super) fn shade(&mut self, first: usize) {
        for triangle in &self.triangles[first..] {
            // Products of millimeters are far from the smallest numbers, so single precision is enough.
            let normal = self.area(*triangle);
            for &corner in triangle {
                self.normals[corner as usize] += normal;
            }
        }
        for t in first..self.triangles.len() {
            let normal = self.area(self.triangles[t]);
            for k in 0..3 {
                let corner = self.triangles[t][k] as usize;
                let shaded = self.normals[corner];
                if normal.dot(shaded) < LEAST_AGREEMENT * normal.length() * shaded.length() {
                    self.triangles[t][k] = self.next();
                    self.positions.push(self.positions[corner]);
                    self.normals.push(normal);
                }
            }
        }
    }

    /// A triangle's normal, as long as twice its area.
    fn area(&self, triangle: [u32; 3]) -> Vec3 {
        let [a, b, c] = triangle.map(|i| self.positions[i as usize]);
        (b - a).cross(c - a)
    }

    pub(super) fn append(&mut self, other: &Self) {
        let offset = self.next();
        self.positions.extend_from_slice(&other.positions);
        self.normals.extend_from_slice(&other.normals);
        self.triangles.extend(other.triangles.iter().map(|t| t.map(|i| i + offset)));
    }

    /// The mesh, its box's middle in the origin.
    pub(super) fn centered(mut self) -> Mesh {
        let low = self.positions.iter().copied().fold(Vec3::INFINITY, Vec3::min);
        let high = self.positions.iter().copied().fold(Vec3::NEG_INFINITY, Vec3::max);
        let middle = low.midpoint(high);
        self.positions.iter_mut().for_each(|p| *p -= middle);
        Mesh::new(self.positions, self.normals, self.triangles).expect("parts have vertices, all finite")
    }
}
