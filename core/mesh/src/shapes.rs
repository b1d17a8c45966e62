//! A sphere and a plane, to study a material on.

use super::mesh::Mesh;
use glam::Vec3;

/// The radius of the sphere and half the side of the plane, in meters.
const SIZE: f32 = 0.1;

/// A sphere of radius 0.1 m with about this many triangles (at least 128): rings and sectors, exact normals.
pub fn sphere(triangles: usize) -> Mesh {
    sphere_of(SIZE, triangles)
}

/// A sphere of any radius in meters, otherwise as [`sphere`].
pub(crate) fn sphere_of(radius: f32, triangles: usize) -> Mesh {
    // Rings × sectors with twice as many sectors: 4 r² − 4 r triangles.
    let rings = (((triangles.clamp(128, 2_000_000) as f64) / 4.0).sqrt().ceil() as u32).max(6);
    let sectors = 2 * rings;
    let mut normals = vec![Vec3::Y];
    for ring in 1..rings {
        let (sin_polar, cos_polar) = (std::f32::consts::PI * ring as f32 / rings as f32).sin_cos();
        for sector in 0..sectors {
            let (sin, cos) = (std::f32::consts::TAU * sector as f32 / sectors as f32).sin_cos();
            normals.push(Vec3::new(sin_polar * sin, cos_polar, sin_polar * cos));
        }
    }
    normals.push(Vec3::NEG_Y);
    let last = normals.len() as u32 - 1;
    let at = |ring: u32, sector: u32| 1 + (ring - 1) * sectors + sector % sectors;
    let mut faces = Vec::new();
    for sector in 0..sectors {
        faces.push([0, at(1, sector), at(1, sector + 1)]);
        for ring in 1..rings - 1 {
            let (a, b) = (at(ring, sector), at(ring, sector + 1));
            let (c, d) = (at(ring + 1, sector), at(ring + 1, sector + 1));
            faces.push([a, c, d]);
            faces.push([a, d, b]);
        }
        faces.push([at(rings - 1, sector), last, at(rings - 1, sector + 1)]);
    }
    let positions = normals.iter().map(|n| *n * radius).collect();
    built(positions, normals, faces)
}

/// A square of 0.2 m facing +z, with about this many triangles (at least 2).
pub fn plane(triangles: usize) -> Mesh {
    let cells = ((triangles.clamp(2, 2_000_000) as f64 / 2.0).sqrt().round() as u32).max(1);
    let at = |i: u32| SIZE * (2.0 * i as f32 / cells as f32 - 1.0);
    let rows = 0..=cells;
    let positions: Vec<Vec3> = rows.flat_map(|y| (0..=cells).map(move |x| Vec3::new(at(x), at(y), 0.0))).collect();
    let mut faces = Vec::new();
    for y in 0..cells {
        for x in 0..cells {
            let a = y * (cells + 1) + x;
            let (b, c, d) = (a + 1, a + cells + 1, a + cells + 2);
            faces.push([a, b, d]);
            faces.push([a, d, c]);
        }
    }
    let normals = vec![Vec3::Z; positions.len()];
    built(positions, normals, faces)
}

fn built(positions: Vec<Vec3>, normals: Vec<Vec3>, faces: Vec<[u32; 3]>) -> Mesh {
    Mesh::new(positions, normals, faces).expect("a shape's vertices are finite and named within range")
}
