//! A human head from parameters.
//!
//! Three ellipsoids and cylinders for skull, face and neck grow into one another; strokes of clay, smooth hills and
//! hollows of the distance from that surface, make the features; two balls lie behind the lids. The sum is about the
//! distance from the skin, and its zeros are cut into triangles, finer where the face and the ears are.

mod clay;
mod strokes;

use super::implicit::{Grid, mirrored};
use super::mesh::Mesh;
use clay::{Clay, Shape};
use std::hash::{Hash, Hasher};

/// A bald human head with a neck, looking towards +z, the top towards +y, the middle of its bounds at the origin.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Head {
    /// The height from chin to crown in meters, 0.05 to 1.
    pub size_m: f32,
    /// The width of the lower face, as a factor: 0.8 is narrow, 1.2 is square.
    pub jaw: f32,
}

impl Eq for Head {}

impl Hash for Head {
    fn hash<H: Hasher>(&self, state: &mut H) {
        // Negative zero equals zero, so it must hash as zero.
        [self.size_m, self.jaw].map(|v| (v + 0.0).to_bits()).hash(state);
    }
}

impl Default for Head {
    /// A grown man's.
    fn default() -> Self {
        Self { size_m: 0.23, jaw: 1.0 }
    }
}

/// The spacing of the grid's planes relative to the finest, at places along each axis in millimeters.
const SPACING: [&[(f32, f32)]; 3] = [
    &[(0.0, 1.0), (40.0, 1.0), (56.0, 1.6), (66.0, 1.1), (92.0, 1.1), (98.0, 2.0)],
    &[(-170.0, 2.0), (-110.0, 2.0), (-85.0, 1.0), (42.0, 1.0), (60.0, 2.0), (135.0, 2.0)],
    &[(-118.0, 2.0), (-50.0, 2.0), (-32.0, 1.2), (12.0, 1.2), (30.0, 1.6), (50.0, 1.0), (122.0, 1.0)],
];

/// The triangles that a finest spacing of 1 mm makes.
const TRIANGLES_AT_1_MM: f32 = 369_000.0;

impl Head {
    /// The head's surface as about `triangles` triangles (within a few percent, 2 000 to 2 000 000).
    ///
    /// Watertight, the same for any number of threads, and symmetric in x. Parameters beyond their range, or not a number,
    /// count as the nearest or the usual ones.
    pub fn mesh(&self, triangles: usize) -> Mesh {
        let usual = Self::default();
        let within = |v: f32, low: f32, high: f32, usual: f32| if v.is_nan() { usual } else { v.clamp(low, high) };
        let shape = Shape {
            scale: within(self.size_m, 0.05, 1.0, usual.size_m) / CHIN_TO_CROWN_MM,
            jaw: within(self.jaw, 0.8, 1.25, usual.jaw),
        };
        let finest = (TRIANGLES_AT_1_MM / triangles.clamp(2_000, 2_000_000) as f32).sqrt();
        let planes = SPACING.map(|knots| planes(knots, finest));
        let shift = [0.0, clay::MIDDLE_MM[1], clay::MIDDLE_MM[2]];
        let planes = std::array::from_fn(|a| planes[a].iter().map(|p| (p - shift[a]) * shape.scale).collect());
        mirrored(&Clay::new(shape), &Grid { planes }).expect("a head has a surface")
    }
}

/// The usual head's surface as about `triangles` triangles (within a few percent, 2 000 to 2 000 000).
pub fn head(triangles: usize) -> Mesh {
    Head::default().mesh(triangles)
}

/// The height from chin to crown before scaling.
const CHIN_TO_CROWN_MM: f32 = 225.0;

/// Planes from the first knot to at least the last, `finest` times the knots' spacing apart.
fn planes(knots: &[(f32, f32)], finest: f32) -> Vec<f32> {
    let mut planes = Vec::new();
    let (mut at, end) = (knots[0].0, knots[knots.len() - 1].0);
    while at < end {
        planes.push(at);
        // The spacing in the middle of the step, by one correction.
        let step = finest * spacing(knots, at);
        at += finest * spacing(knots, at + step / 2.0);
    }
    planes.push(at);
    planes
}

/// The spacing at a place between the knots.
fn spacing(knots: &[(f32, f32)], at: f32) -> f32 {
    let above = knots.partition_point(|k| k.0 < at).clamp(1, knots.len() - 1);
    let ((x0, y0), (x1, y1)) = (knots[above - 1], knots[above]);
    y0 + (y1 - y0) * ((at - x0) / (x1 - x0)).clamp(0.0, 1.0)
}
