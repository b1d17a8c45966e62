//! Leaflets and stems, and the surface under construction that they are added to.

use super::axis::{Arc, Frame, Spine};
use crate::mesh::Mesh;
use glam::Vec3;
use std::f32::consts::TAU;

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

/// A leaflet along a line, folded at its midrib.
#[derive(Clone, Copy, Debug)]
pub(super) struct Leaf {
    pub(super) axis: Arc,
    /// Half the largest width, in meters.
    pub(super) half_width: f32,
    /// The width at the base as a share of the largest; 0: a point.
    pub(super) base: f32,
    /// Exponent of the outline's rounding: 1.4 a lance, 4 a tongue.
    pub(super) bluntness: f32,
    /// Concentration of cuts toward the tip, −1 .. 1.
    pub(super) crowding: f32,
    /// The slope with which each half rises from the midrib.
    pub(super) crease: f32,
    /// Strength by which each half bends down again toward the edge.
    pub(super) curl: f32,
    /// Depth of the edge's teeth, as a share of the width.
    pub(super) teeth: f32,
    /// Thickness over the midrib, in meters.
    pub(super) thickness: f32,
}

/// Into how many pieces a leaflet is cut along, and across each half.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Cuts {
    pub(super) along: usize,
    pub(super) across: usize,
}

/// A cut across a leaflet: the share of the length, half the width, the midrib's frame.
struct Station {
    u: f32,
    reach: f32,
    frame: Frame,
}

impl Leaf {
    pub(super) fn triangles(&self, cuts: Cuts) -> usize {
        4 * cuts.across * (2 * cuts.along - 1 - usize::from(self.base == 0.0))
    }

    /// Half the width at station `i` of `cuts.along`, a share `u` of the length.
    fn reach(&self, cuts: Cuts, i: usize, u: f32) -> f32 {
        let opening = self.base + (1.0 - self.base) * (u * (2.0 - u)).max(0.0).powf(0.6);
        let closing = (1.0 - u.powf(self.bluntness)).max(0.0).powf(0.55);
        // Teeth stand on whole stations, else they would beat with them; too few stations show none.
        let period = (cuts.along / 12).max(2);
        let notch = if cuts.along < 8 { 0.0 } else { 1.0 - (i % period) as f32 / (period - 1) as f32 };
        self.half_width * opening * closing * (1.0 - self.teeth * notch)
    }

    /// The point `v` of the width away from the midrib, to the side of the sign `hand`, on the upper or lower surface by
    /// the sign `sheet`.
    fn point(&self, &Station { u, reach, frame }: &Station, v: f32, [hand, sheet]: [f32; 2]) -> Vec3 {
        let rise = reach * v * (self.crease - self.curl * v);
        // Exactly zero all around the edge: there both surfaces have the same points.
        let thick = sheet * self.thickness / 2.0 * (1.0 - v * v) * (6.0 * u * (1.0 - u)).min(1.0);
        frame.origin + frame.side * (hand * v * reach) + frame.up * (rise + thick)
    }

    /// Adds both surfaces; each half has its own normals, which shows the fold of the midrib.
    pub(super) fn build(&self, cuts: Cuts, surface: &mut Surface) {
        let station = |i: usize| {
            let x = i as f32 / cuts.along as f32;
            let u = x * (1.0 + self.crowding * (1.0 - x));
            Station { u, reach: self.reach(cuts, i, u), frame: self.axis.frame(u) }
        };
        let stations: Vec<Station> = (0..=cuts.along).map(station).collect();
        for sheet in [1.0, -1.0] {
            for hand in [1.0, -1.0] {
                self.patch(cuts.across, &stations, [hand, sheet], surface);
            }
        }
    }

    fn patch(&self, across: usize, stations: &[Station], [hand, sheet]: [f32; 2], surface: &mut Surface) {
        let first = surface.triangles.len();
        let flipped = hand * sheet < 0.0;
        let mut previous: Option<(u32, bool)> = None;
        for (i, station) in stations.iter().enumerate() {
            let single = i + 1 == stations.len() || (i == 0 && self.base == 0.0);
            let start = surface.next();
            for j in 0..=(if single { 0 } else { across }) {
                surface.vertex(self.point(station, j as f32 / across as f32, [hand, sheet]));
            }
            if let Some((below, was_single)) = previous {
                for j in 0..across as u32 {
                    let (a, b) = (below + j, below + j + 1);
                    let (d, c) = (start + j, start + j + 1);
                    match (was_single, single) {
                        (true, true) => {}
                        (true, false) => surface.triangle([below, c, d], flipped),
                        (false, true) => surface.triangle([a, b, start], flipped),
                        (false, false) => {
                            surface.triangle([a, b, c], flipped);
                            surface.triangle([a, c, d], flipped);
                        }
                    }
                }
            }
            previous = Some((start, single));
        }
        surface.shade(first);
    }
}

#[derive(Clone, Debug)]
pub(super) enum Line {
    Rib(Arc),
    Stalk(Spine),
}

impl Line {
    fn frame(&self, s: f32) -> Frame {
        match self {
            Self::Rib(arc) => arc.frame(s),
            Self::Stalk(spine) => spine.frame(s),
        }
    }
}

/// A tube along a line, its radius falling from base to tip.
#[derive(Clone, Debug)]
pub(super) struct Stem {
    pub(super) line: Line,
    pub(super) radius: f32,
    /// The radius before the tip as a share of the base's.
    pub(super) taper: f32,
    pub(super) sides: usize,
    pub(super) pieces: usize,
}

impl Stem {
    /// Number of triangles [`Stem::build`] makes: the mantle, the point, the base.
    pub(super) fn triangles(&self) -> usize {
        self.sides * (2 * self.pieces - 1) + self.sides - 2
    }

    /// Adds the tube, closed at both ends.
    pub(super) fn build(&self, surface: &mut Surface) {
        let (first, start, sides) = (surface.triangles.len(), surface.next(), self.sides as u32);
        for i in 0..self.pieces {
            let s = i as f32 / self.pieces as f32;
            let frame = self.line.frame(s);
            let radius = self.radius * (1.0 + (self.taper - 1.0) * s);
            for k in 0..sides {
                let (sin, cos) = (k as f32 / sides as f32 * TAU).sin_cos();
                surface.vertex(frame.origin + radius * (sin * frame.side + cos * frame.up));
            }
        }
        surface.vertex(self.line.frame(1.0).origin);
        let tip = surface.next() - 1;
        for i in 0..self.pieces as u32 {
            let (row, next) = (start + i * sides, start + (i + 1) * sides);
            for k in 0..sides {
                let l = (k + 1) % sides;
                if next == tip {
                    surface.triangle([row + k, row + l, tip], false);
                } else {
                    surface.triangle([row + k, row + l, next + l], false);
                    surface.triangle([row + k, next + l, next + k], false);
                }
            }
        }
        surface.shade(first);
        self.close_base(start, surface);
    }

    /// The base has vertices of its own: its normals would spoil the mantle's.
    fn close_base(&self, ring: u32, surface: &mut Surface) {
        let (first, start, sides) = (surface.triangles.len(), surface.next(), self.sides as u32);
        for k in 0..sides {
            surface.vertex(surface.positions[(ring + k) as usize]);
        }
        for k in 1..sides - 1 {
            surface.triangle([start, start + k, start + k + 1], true);
        }
        surface.shade(first);
    }
}
