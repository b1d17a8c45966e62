//! A human head with neck and shoulders, from a control cage.
//!
//! The cage is data (`head.obj`): the base mesh of `MakeHuman` with its young Caucasian male target (CC0),
//! continued below the neck, and a garment with a collar around the shoulders, which a head may wear or not. The head is its
//! Catmull–Clark limit surface, with a ball behind the lids of each eye; the garment is another.

use crate::subdivision::Surface;
use crate::{Mesh, Part, shapes};
use glam::Vec3;
use std::str::FromStr;

const CAGE: &str = include_str!("head.obj");

/// Center of the left eyeball in meters; the right one is its mirror image.
const EYE: Vec3 = Vec3::new(0.02994, 0.07713, 0.06958);

const EYE_RADIUS: f32 = 0.0162;

/// The share of the triangles that one eyeball has.
const EYE_SHARE: usize = 64;

/// The share of the triangles that a garment has.
const GARMENT_SHARE: usize = 5;

/// Fewest triangles that a bare head and a clothed one are made of, about: two for each quadrilateral of the cages, and the eyes.
pub const FEWEST: [usize; 2] = [10_000, 13_000];

const MOST: usize = 2_000_000;

/// The surface of a bald head with neck and shoulders as about `triangles` triangles, from [`FEWEST`] to 2 000 000.
///
/// It looks towards +z, the top towards +y; 0.23 m from chin to crown, the middle of its bounds near the origin. Closed, but
/// for the eyeballs, which are spheres of their own. The same for any number of threads.
pub fn head(triangles: usize) -> Mesh {
    let triangles = triangles.min(MOST);
    let eye = shapes::sphere_of(EYE_RADIUS, triangles / EYE_SHARE);
    let skin = surface(false, triangles.saturating_sub(2 * eye.triangles().len()));
    let right = EYE * Vec3::new(-1.0, 1.0, 1.0);
    joined(&[(&skin, Vec3::ZERO), (&eye, EYE), (&eye, right)])
}

/// [`head`] in a garment with a collar: a closed surface of its own, which hides the shoulders and comes last
/// ([`Part::Garment`]).
pub fn clothed(triangles: usize) -> Mesh {
    let triangles = triangles.min(MOST);
    let garment = surface(true, triangles / GARMENT_SHARE);
    let head = head(triangles.saturating_sub(garment.triangles().len()));
    let parts = [(&head, Part::Body), (&garment, Part::Garment)];
    let parts = parts.iter().flat_map(|(mesh, part)| std::iter::repeat_n(*part, mesh.triangles().len())).collect();
    joined(&[(&head, Vec3::ZERO), (&garment, Vec3::ZERO)]).with_parts(parts)
}

/// Limit surface of the head's cage, or of the garment's.
fn surface(is_garment: bool, triangles: usize) -> Mesh {
    let (head, garment) = CAGE.split_once("g garment\n").expect("the cage has two groups");
    let cage = cage(if is_garment { garment } else { head });
    let surface = cage.and_then(|(positions, quads)| Surface::new(positions, &quads));
    surface.expect("cages are closed and of quadrilaterals").limit(triangles).expect("cages are finite")
}

fn joined(parts: &[(&Mesh, Vec3)]) -> Mesh {
    let (mut positions, mut normals, mut triangles) = (Vec::new(), Vec::new(), Vec::new());
    for &(mesh, by) in parts {
        let first = positions.len() as u32;
        positions.extend(mesh.positions().iter().map(|&p| p + by));
        normals.extend_from_slice(mesh.normals());
        triangles.extend(mesh.triangles().iter().map(|corners| corners.map(|v| v + first)));
    }
    Mesh::new(positions, normals, triangles).expect("parts are meshes")
}

/// Vertices and quadrilaterals of a part of an OBJ file; none if a line of either holds anything but numbers.
fn cage(text: &str) -> Option<(Vec<Vec3>, Vec<[u32; 4]>)> {
    let (mut positions, mut quads) = (Vec::new(), Vec::<[u32; 4]>::new());
    for line in text.lines() {
        if let Some(place) = line.strip_prefix("v ") {
            positions.push(Vec3::from_array(numbers(place)?));
        } else if let Some(corners) = line.strip_prefix("f ") {
            quads.push(numbers(corners)?);
        }
    }
    // Indices count through the file.
    let first = quads.as_flattened().iter().copied().min()?;
    quads.as_flattened_mut().iter_mut().for_each(|vertex| *vertex -= first);
    Some((positions, quads))
}

fn numbers<T: FromStr, const N: usize>(text: &str) -> Option<[T; N]> {
    let words: Option<Vec<T>> = text.split_ascii_whitespace().map(|word| word.parse().ok()).collect();
    words?.try_into().ok()
}
