//! Surroundings of a mesh: a chart of patches beside it, and the ground beneath it.

use crate::{Mesh, Part};
use glam::Vec3;
use std::f32::consts::TAU;

/// Azimuth that the chart faces, in degrees to the right of the mesh's front: where the eye is at first.
const FACING_DEG: f32 = -25.0;
/// Width of a chart of 6 × 4 patches and depth, in radii of the mesh.
const WIDTH: f32 = 0.72;
const DEPTH: f32 = 0.015;
/// Share of its cell that a patch fills, and the frame's width in cells.
const FILLED: f32 = 0.86;
const FRAME: f32 = 0.35;
/// From the mesh to the chart's frame, in radii.
const GAP: f32 = 0.1;
/// From the middle of the mesh towards where the chart faces, in radii: before the shadow of the mesh.
const AHEAD: f32 = 0.3;
/// Heights that are tried for the chart, and how much more room than needed beside the mesh it may take, in radii.
const LEVELS: u8 = 16;
const ROOM: f32 = 0.03;
/// Radii of the ground's first ring and of its end, a level horizon, in radii of the mesh.
const GROUND: [f32; 2] = [0.04, 300.0];
/// Its division; each ring is wider than the last by the same factor.
const RINGS: u32 = 64;
const SECTORS: u32 = 96;

/// Share of a cropped mesh's height that a picture of the whole leaves out: of a head on its shoulders, all below the chest.
const CROPPED: f32 = 0.2;

/// What stands about a mesh.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Stage {
    /// Number of the chart's patches; 0 without a chart.
    pub patches: u16,
    /// True for a level plane beneath the mesh.
    pub ground: bool,
    /// True if the mesh is the head, with hair and brows.
    pub hair: bool,
    /// True if a picture of the whole leaves the lowest part of the mesh out.
    pub cropped: bool,
}

impl Stage {
    /// A mesh with this about it. Bounds stay those of the mesh alone; a picture of the whole shows the chart, but not all of the
    /// ground.
    #[expect(clippy::missing_panics_doc, reason = "what is built here is finite")]
    pub fn about(self, mesh: &Mesh) -> Mesh {
        let mut built = Built::default();
        if self.patches > 0 {
            built.chart(mesh, self.patches);
        }
        let framed = built.positions.len();
        if self.ground {
            built.ground(mesh);
        }
        let bounds = mesh.bounds();
        let mut staged = mesh.clone();
        if !built.triangles.is_empty() {
            let others = Mesh::new(built.positions, built.normals, built.triangles).expect("quadrilaterals are finite");
            staged = staged.among(others.with_parts(built.parts), framed);
        }
        if self.hair {
            staged = staged.with_hair();
        }
        if self.cropped {
            staged = staged.framed_above(bounds.min.y + CROPPED * (bounds.max.y - bounds.min.y));
        }
        staged
    }
}

/// Columns and rows of a chart, as near to 3 : 2 as they come: 6 × 4 of 24.
pub fn layout(patches: u16) -> [u16; 2] {
    let columns = (f32::from(patches) * 1.5).sqrt().ceil().max(1.0) as u16;
    [columns, patches.div_ceil(columns)]
}

#[derive(Default)]
struct Built {
    positions: Vec<Vec3>,
    normals: Vec<Vec3>,
    triangles: Vec<[u32; 3]>,
    parts: Vec<Part>,
}

impl Built {
    /// A parallelogram about a middle that faces u × v.
    fn quad(&mut self, middle: Vec3, u: Vec3, v: Vec3, part: Part) {
        let first = self.positions.len() as u32;
        self.positions.extend([middle - u - v, middle + u - v, middle + u + v, middle - u + v]);
        self.normals.extend([u.cross(v).normalize_or_zero(); 4]);
        self.triangles.extend([[first, first + 1, first + 2], [first, first + 2, first + 3]]);
        self.parts.extend([part; 2]);
    }

    /// A box about a middle with these half edges, right-handed.
    fn cuboid(&mut self, middle: Vec3, [u, v, w]: [Vec3; 3]) {
        for (u, v, w) in [(u, v, w), (v, w, u), (w, u, v)] {
            self.quad(middle + w, u, v, Part::Card);
            self.quad(middle - w, v, u, Part::Card);
        }
    }

    /// Patches on a card on a post, on the right of the mesh seen from where the chart faces.
    fn chart(&mut self, mesh: &Mesh, patches: u16) {
        let bounds = mesh.bounds();
        let (sin, cos) = FACING_DEG.to_radians().sin_cos();
        let (right, up, ahead) = (Vec3::new(cos, 0.0, -sin), Vec3::Y, Vec3::new(sin, 0.0, cos));
        let [columns, rows] = layout(patches).map(f32::from);
        let cell = bounds.radius * WIDTH / (columns + 2.0 * FRAME);
        let half = Vec3::new(columns, rows, 0.0) * (0.5 * cell) + Vec3::new(FRAME, FRAME, 0.0) * cell;
        // Beside all that is at its height, as low as it stands nearest.
        let reach = |level: f32| {
            let heights = level - half.y - GAP * bounds.radius..level + half.y + 3.0 * GAP * bounds.radius;
            let beside = mesh.positions().iter().filter(|p| heights.contains(&p.y));
            beside.map(|p| (*p - bounds.center()).dot(right)).fold(0.0, f32::max)
        };
        let least = bounds.min.y + half.y + GAP * bounds.radius;
        let rise = (bounds.max.y - half.y - least).max(0.0) / f32::from(LEVELS);
        let levels: Vec<(f32, f32)> =
            (0..=LEVELS).map(|k| least + rise * f32::from(k)).map(|y| (y, reach(y))).collect();
        let nearest = levels.iter().map(|level| level.1).fold(f32::INFINITY, f32::min);
        let beside = levels.iter().find(|level| level.1 <= nearest + ROOM * bounds.radius);
        let (level, reach) = beside.copied().unwrap_or((least, nearest));
        let middle = bounds.center().with_y(level)
            + right * (reach + GAP * bounds.radius + half.x)
            + ahead * (AHEAD * bounds.radius);
        let depth = DEPTH * bounds.radius;
        self.cuboid(middle - ahead * depth, [right * half.x, up * half.y, ahead * depth]);
        let foot = bounds.min.y.min(level - half.y);
        let post = 0.5 * (level - half.y - foot);
        self.cuboid((middle - ahead * depth).with_y(foot + post), [right * depth, up * post, ahead * depth]);
        for patch in 0..patches {
            let (column, row) = (f32::from(patch % columns as u16), f32::from(patch / columns as u16));
            let aside = right * (column + 0.5 - 0.5 * columns) - up * (row + 0.5 - 0.5 * rows);
            let size = 0.5 * FILLED * cell;
            self.quad(middle + aside * cell + ahead * (0.1 * depth), right * size, up * size, Part::Patch(patch));
        }
    }

    fn ground(&mut self, mesh: &Mesh) {
        let bounds = mesh.bounds();
        let middle = bounds.center().with_y(bounds.min.y);
        let first = self.positions.len() as u32;
        self.positions.push(middle);
        for ring in 1..=RINGS {
            let share = (ring - 1) as f32 / (RINGS - 1) as f32;
            let radius = bounds.radius * GROUND[0] * (GROUND[1] / GROUND[0]).powf(share);
            let at = |sector: u32| {
                let (sin, cos) = (TAU * sector as f32 / SECTORS as f32).sin_cos();
                middle + Vec3::new(sin, 0.0, cos) * radius
            };
            self.positions.extend((0..SECTORS).map(at));
        }
        self.normals.resize(self.positions.len(), Vec3::Y);
        let at = |ring: u32, sector: u32| match ring {
            0 => first,
            _ => first + 1 + (ring - 1) * SECTORS + sector % SECTORS,
        };
        for ring in 0..RINGS {
            for sector in 0..SECTORS {
                let [a, b, c, d] =
                    [at(ring, sector), at(ring + 1, sector), at(ring + 1, sector + 1), at(ring, sector + 1)];
                self.triangles.push([a, b, c]);
                if ring > 0 {
                    self.triangles.push([a, c, d]);
                }
            }
        }
        self.parts.resize(self.triangles.len(), Part::Ground);
    }
}
