//! A human head from parameters.
//!
//! Two ellipsoids and a cylinder for skull, face and neck grow into one another; strokes of clay, smooth hills and
//! hollows of the distance from that surface, make the features; two balls lie behind the lids. The sum is about the
//! distance from the skin, and its zeros are cut into triangles, finer where the face and the ears are.

mod clay;
mod strokes;

use super::implicit::{Grid, mirrored};
use super::mesh::Mesh;
use clay::{Clay, Shape};
use std::hash::{Hash, Hasher};

/// A bald human head with a neck, looking towards +z, the top towards +y, the middle of its bounds at the origin.
///
/// Heads are equal where their parameters are so bit by bit, but for the sign of zero.
#[derive(Clone, Copy, Debug)]
pub struct Head {
    /// The height from chin to crown in meters, 0.05 to 1.
    pub size_m: f32,
    /// The width of the lower face, as a factor: 0.8 is narrow, 1.2 is square.
    pub jaw: f32,
}

impl PartialEq for Head {
    fn eq(&self, other: &Self) -> bool {
        self.bits() == other.bits()
    }
}

impl Eq for Head {}

impl Hash for Head {
    fn hash<H: Hasher>(&self, state: &mut H) {
        self.bits().hash(state);
    }
}

impl Default for Head {
    /// A grown man's.
    fn default() -> Self {
        Self { size_m: 0.23, jaw: 1.0 }
    }
}

/// The spacing of the grid's planes relative to the finest, at places along each axis in millimeters: fine at the features
/// and at the cut, coarse over the skull and the neck.
const SPACING: [&[(f32, f32)]; 3] = [
    &[(0.0, 1.0), (10.0, 0.9), (46.0, 0.9), (54.0, 2.4), (62.0, 1.6), (68.0, 0.9), (91.0, 0.9), (96.0, 2.0)],
    &[
        (-170.0, 1.2),
        (-152.0, 1.2),
        (-138.0, 3.0),
        (-105.0, 3.0),
        (-84.0, 1.2),
        (-66.0, 0.85),
        (-40.0, 0.85),
        (-32.0, 1.0),
        (6.0, 1.0),
        (10.0, 0.7),
        (32.0, 0.7),
        (42.0, 1.1),
        (66.0, 3.0),
        (135.0, 3.0),
    ],
    &[(-118.0, 3.0), (-50.0, 3.0), (-33.0, 1.0), (10.0, 1.0), (28.0, 2.2), (48.0, 1.4), (62.0, 1.0), (122.0, 1.0)],
];

/// No planes are farther apart than this many millimeters, but for the finest spacing itself.
const COARSEST_MM: f32 = 8.0;

/// Some finest spacings in millimeters and how many triangles they make.
const TRIANGLES: [(f32, f32); 8] = [
    (0.43, 1_640_000.0),
    (1.921, 82_080.0),
    (3.037, 33_500.0),
    (4.295, 18_320.0),
    (6.792, 9_610.0),
    (8.591, 6_965.0),
    (11.09, 4_135.0),
    (13.58, 2_748.0),
];

impl Head {
    fn bits(self) -> [u32; 2] {
        // Adding zero makes negative zero positive.
        [self.size_m, self.jaw].map(|v| (v + 0.0).to_bits())
    }

    /// The head's surface as about `triangles` triangles (within a few percent, 2 000 to 2 000 000).
    ///
    /// Watertight, the same for any number of threads, and symmetric in x. Parameters beyond their range, or not a number,
    /// count as the nearest or the usual ones.
    pub fn mesh(&self, triangles: usize) -> Mesh {
        let usual = Self::default();
        let within = |v: f32, low: f32, high: f32, usual: f32| if v.is_nan() { usual } else { v.clamp(low, high) };
        let finest = finest(triangles.clamp(2_000, 2_000_000) as f32);
        let shape = Shape {
            scale: within(self.size_m, 0.05, 1.0, usual.size_m) / CHIN_TO_CROWN_MM,
            jaw: within(self.jaw, 0.8, 1.25, usual.jaw),
            // Narrower creases than the triangles would look torn.
            crease: (1.5 * finest).clamp(0.8, 4.0),
        };
        let planes = SPACING.map(|knots| planes(knots, finest));
        let shift = [0.0, clay::MIDDLE_MM[1], clay::MIDDLE_MM[2]];
        let planes = std::array::from_fn(|a| planes[a].iter().map(|p| (p - shift[a]) * shape.scale).collect());
        surface(shape, planes)
    }
}

fn surface(shape: Shape, planes: [Vec<f32>; 3]) -> Mesh {
    mirrored(&Clay::new(shape), &Grid { planes }).expect("a head has a surface")
}

/// The usual head's surface as about `triangles` triangles (within a few percent, 2 000 to 2 000 000).
pub fn head(triangles: usize) -> Mesh {
    Head::default().mesh(triangles)
}

/// The height from chin to crown before scaling.
const CHIN_TO_CROWN_MM: f32 = 225.0;

/// The finest spacing in millimeters that makes this many triangles: a power of their number between known ones.
fn finest(triangles: f32) -> f32 {
    let above = TRIANGLES.partition_point(|t| t.1 > triangles).clamp(1, TRIANGLES.len() - 1);
    let ((x0, y0), (x1, y1)) = (TRIANGLES[above - 1], TRIANGLES[above]);
    x0 * (x1 / x0).powf((triangles / y0).ln() / (y1 / y0).ln())
}

/// Planes from the first knot to at least the last, `finest` times the knots' spacing apart.
fn planes(knots: &[(f32, f32)], finest: f32) -> Vec<f32> {
    let mut planes = Vec::new();
    let (mut at, end) = (knots[0].0, knots[knots.len() - 1].0);
    while at < end {
        planes.push(at);
        // The spacing in the middle of the step, by one correction.
        let step = |at: f32| (finest * spacing(knots, at)).min(COARSEST_MM.max(finest));
        at += step(at + step(at) / 2.0);
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
