//! A human head with neck and shoulders, from a control cage.
//!
//! The cage is data (`head.obj`): the base mesh of `MakeHuman` with its young Caucasian male target (CC0),
//! continued below the neck. The head is its Catmull–Clark limit surface, with a ball behind the lids of each eye.

use crate::subdivision::Surface;
use crate::{Mesh, shapes};
use glam::Vec3;
use std::str::FromStr;

const CAGE: &str = include_str!("head.obj");

/// Center of the left eyeball in meters; the right one is its mirror image.
const EYE: Vec3 = Vec3::new(0.02994, 0.07713, 0.06958);

/// Radius of an eyeball in meters.
const EYE_RADIUS: f32 = 0.0162;

/// The share of the triangles that one eyeball has.
const EYE_SHARE: usize = 64;

/// Fewest triangles that a head is made of, about: two for each quadrilateral of its cage, and the eyes.
pub const FEWEST: usize = 10_000;

/// Most triangles that a head is made of.
const MOST: usize = 2_000_000;

/// The surface of a bald head with neck and shoulders as about `triangles` triangles, from [`FEWEST`] to 2 000 000.
///
/// It looks towards +z, the top towards +y; 0.23 m from chin to crown, the middle of its bounds near the origin. Closed, but
/// for the eyeballs, which are spheres of their own. The same for any number of threads.
pub fn head(triangles: usize) -> Mesh {
    let triangles = triangles.min(MOST);
    let eye = shapes::sphere_of(EYE_RADIUS, triangles / EYE_SHARE);
    let skin = skin(triangles.saturating_sub(2 * eye.triangles().len()));
    let right = EYE * Vec3::new(-1.0, 1.0, 1.0);
    joined([(&skin, Vec3::ZERO), (&eye, EYE), (&eye, right)])
}

fn skin(triangles: usize) -> Mesh {
    let cage = cage(CAGE).and_then(|(positions, quads)| Surface::new(positions, &quads));
    let cage = cage.expect("the head's cage is closed and of quadrilaterals");
    cage.limit(triangles).expect("the head's cage is finite")
}

/// Several meshes, each moved, as one.
fn joined(parts: [(&Mesh, Vec3); 3]) -> Mesh {
    let (mut positions, mut normals, mut triangles) = (Vec::new(), Vec::new(), Vec::new());
    for (mesh, by) in parts {
        let first = positions.len() as u32;
        positions.extend(mesh.positions().iter().map(|&p| p + by));
        normals.extend_from_slice(mesh.normals());
        triangles.extend(mesh.triangles().iter().map(|corners| corners.map(|v| v + first)));
    }
    Mesh::new(positions, normals, triangles).expect("parts are meshes")
}

/// Vertices and quadrilaterals of an OBJ file; none if a line of either holds anything but numbers.
fn cage(text: &str) -> Option<(Vec<Vec3>, Vec<[u32; 4]>)> {
    let (mut positions, mut quads) = (Vec::new(), Vec::new());
    for line in text.lines() {
        if let Some(place) = line.strip_prefix("v ") {
            positions.push(Vec3::from_array(numbers(place)?));
        } else if let Some(corners) = line.strip_prefix("f ") {
            quads.push(numbers::<u32, 4>(corners)?.map(|vertex| vertex.wrapping_sub(1)));
        }
    }
    Some((positions, quads))
}

fn numbers<T: FromStr, const N: usize>(text: &str) -> Option<[T; N]> {
    let words: Option<Vec<T>> = text.split_ascii_whitespace().map(|word| word.parse().ok()).collect();
    words?.try_into().ok()
}
