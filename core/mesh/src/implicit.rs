//! Surfaces given by a function, as triangles.
//!
//! Marching cubes (Lorensen and Cline 1987) over a grid whose planes need not be evenly spaced, so that small features can
//! get more triangles than large smooth areas. Only the blocks of cells that the surface can pass are looked at. The
//! vertices are then evened out along the surface and brought onto it.

mod blocks;
mod cubes;
mod relax;
mod weld;

use super::mesh::{Mesh, MeshError};
use glam::Vec3;

/// A function's value and its gradient at a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// The value: negative inside, about the distance from the surface in meters.
    pub value: f32,
    /// The gradient, of a length near one around the surface.
    pub gradient: Vec3,
}

/// A function whose zeros are a surface.
pub trait Field: Sync + Sized {
    /// The value and gradient at a point; finite everywhere.
    fn at(&self, p: Vec3) -> Sample;

    /// The same function for points no farther than `radius` from `center`, where parts without effect may be left out;
    /// nothing where the surface comes nowhere near.
    fn near(&self, center: Vec3, radius: f32) -> Option<Self>;
}

/// The planes that cut space into cells: ascending coordinates for each axis, in meters.
#[derive(Clone, Debug, PartialEq)]
pub struct Grid {
    /// The planes across each axis; at least two for there to be any cell.
    pub planes: [Vec<f32>; 3],
}

impl Grid {
    /// How many cells there are along each axis.
    fn cells(&self) -> [usize; 3] {
        self.planes.each_ref().map(|planes| planes.len().saturating_sub(1))
    }

    /// The corner where three planes meet.
    fn corner(&self, [i, j, k]: [usize; 3]) -> Vec3 {
        Vec3::new(self.planes[0][i], self.planes[1][j], self.planes[2][k])
    }
}

/// The part of a surface with x ≥ 0 inside a grid that begins at x = 0, and its mirror image: one mesh, joined at x = 0.
///
/// Watertight where the surface stays inside the grid: each edge has exactly two triangles. The same mesh for any number
/// of threads. Normals are the gradient's, but those of the triangles around where these turn away from it, as in creases and
/// around features that the cells are too coarse for. A vertex is within about a thousandth of a cell of the surface, but for
/// creases narrower than a cell.
pub fn mirrored<F: Field + Send>(field: &F, grid: &Grid) -> Result<Mesh, MeshError> {
    let mut half = weld::weld(blocks::blocks(field, grid));
    relax::relax(&mut half);
    let mut normals = relax::project(&mut half, 2);
    relax::agree(&half, &mut normals);
    // The others' mirror images follow after all vertices; those on the plane are their own.
    let count = half.positions.len() as u32;
    let mut image: Vec<u32> = (0..count).collect();
    let (mut positions, mut all_normals) = (half.positions.clone(), normals.clone());
    for (v, &on_plane) in half.on_plane.iter().enumerate() {
        if !on_plane {
            image[v] = positions.len() as u32;
            positions.push(half.positions[v] * Vec3::new(-1.0, 1.0, 1.0));
            all_normals.push(normals[v] * Vec3::new(-1.0, 1.0, 1.0));
        }
    }
    let reflected = half.triangles.iter().map(|&[a, b, c]| [c, b, a].map(|v| image[v as usize]));
    let triangles = half.triangles.iter().copied().chain(reflected).collect();
    Mesh::new(positions, all_normals, triangles)
}
