//! Polygons cut into triangles, concave ones too.

use super::report::{MeshReadError, Tally};
use super::soup::Soup;
use earcut::{Earcut, refine};
use glam::{DVec2, DVec3};
use rayon::prelude::*;
use std::ops::Range;

/// The most corners of a concave polygon, whose cutting may take time with their square.
const MAX_CONCAVE: usize = 4096;

/// Corners between two looks at whether to stop: also how many concave polygons there can be between them.
const STOP_EVERY: usize = 1 << 17;

/// Faces that one thread cuts at a time.
const PIECE: usize = 1 << 10;

/// Triangles and the faces they were cut from.
#[derive(Default)]
pub(super) struct Cut {
    /// Three corners each, as indices among the soup's corners.
    pub(super) triangles: Vec<[u32; 3]>,
    /// The face of each triangle, ascending.
    pub(super) faces: Vec<u32>,
    /// Omitted triangles, without area.
    pub(super) degenerate: Tally,
    pub(super) crossing: Tally,
}

/// Cuts all faces; triangles without area are omitted.
pub(super) fn cut(soup: &Soup, stop: &dyn Fn() -> bool) -> Result<Cut, MeshReadError> {
    let mut cut = Cut::default();
    let mut from = 0;
    while from < soup.faces() {
        if stop() {
            return Err(MeshReadError::Stopped);
        }
        let to = soup.faces_within(from, STOP_EVERY);
        let starts = (from..to).into_par_iter().step_by(PIECE);
        let pieces: Vec<_> = starts.map(|start| piece(soup, start..(start + PIECE).min(to))).collect();
        for piece in pieces {
            cut.append(&piece?);
        }
        from = to;
    }
    Ok(cut)
}

fn piece(soup: &Soup, faces: Range<usize>) -> Result<Cut, MeshReadError> {
    let mut cut = Cut::default();
    let mut polygon = Polygon::default();
    for face in faces {
        let corners = soup.face(face);
        let first = corners.start as u32;
        if corners.len() == 3 {
            cut.add(soup, face, [first, first + 1, first + 2]);
            continue;
        }
        polygon.take(soup, corners.clone());
        if !polygon.cut() {
            let place = soup.place(face);
            if polygon.points.len() > MAX_CONCAVE {
                return Err(MeshReadError::FaceTooLong { place, corners: corners.len(), limit: MAX_CONCAVE });
            }
            if !polygon.clip_ears() {
                cut.crossing.add(place);
            }
        }
        if polygon.triangles.is_empty() {
            cut.degenerate.add(soup.place(face));
        }
        for triangle in &polygon.triangles {
            cut.add(soup, face, triangle.map(|i| polygon.corners[i as usize]));
        }
    }
    Ok(cut)
}

impl Cut {
    fn append(&mut self, later: &Self) {
        self.triangles.extend_from_slice(&later.triangles);
        self.faces.extend_from_slice(&later.faces);
        self.degenerate.merge(later.degenerate);
        self.crossing.merge(later.crossing);
    }

    /// Appends a triangle, or counts it where it has no area.
    #[inline]
    fn add(&mut self, soup: &Soup, face: usize, triangle: [u32; 3]) {
        let [a, b, c] = triangle.map(|i| soup.positions[soup.corners[i as usize].position as usize].as_dvec3());
        let (u, v) = (b - a, c - a);
        let longest = u.length_squared().max(v.length_squared()).max((c - b).length_squared());
        let size = a.abs().max(b.abs()).max(c.abs()).max_element();
        // Below this height the rounding of the coordinates, not the file, makes the triangle's normal.
        let height = grain(size);
        if u.cross(v).length_squared() <= height * height * longest {
            self.degenerate.add(soup.place(face));
        } else {
            self.triangles.push(triangle);
            self.faces.push(face as u32);
        }
    }
}

/// Distance by which rounding to single precision moves a point with this farthest coordinate.
fn grain(size: f64) -> f64 {
    2.0 * f64::from(f32::EPSILON) * size
}

/// A polygon in its plane, with room that is used again for the next one.
#[derive(Default)]
struct Polygon {
    /// The corners that differ from the one before, as indices among the soup's.
    corners: Vec<u32>,
    /// Their places in space.
    space: Vec<DVec3>,
    /// Their places in the plane, counter-clockwise.
    points: Vec<DVec2>,
    /// Distance by which rounding to single precision moves a corner.
    grain: f64,
    /// Triangles of indices among `corners`.
    triangles: Vec<[u32; 3]>,
}

impl Polygon {
    /// Takes a face's corners and lays them into the plane.
    fn take(&mut self, soup: &Soup, range: Range<usize>) {
        self.triangles.clear();
        self.corners.clear();
        self.space.clear();
        let position = |i: usize| soup.corners[i].position;
        let mut before = range.end - 1;
        for i in range.clone() {
            if position(i) != position(before) {
                self.corners.push(i as u32);
                self.space.push(soup.positions[position(i) as usize].as_dvec3());
            }
            before = i;
        }
        self.grain = self.space.iter().map(|p| grain(p.abs().max_element())).fold(0.0, f64::max);
        let normal = self.normal();
        self.points.clear();
        let sign = |v: f64| if v < 0.0 { -1.0 } else { 1.0 };
        let steepest = normal.abs();
        // Along the steepest axis: areas shrink by one factor, and no turn changes its sense.
        let flat = |p: &DVec3| match steepest.max_position() {
            0 => DVec2::new(p.y * sign(normal.x), p.z),
            1 => DVec2::new(p.z * sign(normal.y), p.x),
            _ => DVec2::new(p.x * sign(normal.z), p.y),
        };
        self.points.extend(self.space.iter().map(flat));
    }

    /// Twice the area times the normal (Newell): right for polygons that are not quite plane, too.
    fn normal(&self) -> DVec3 {
        let Some(&origin) = self.space.first() else { return DVec3::ZERO };
        self.space.windows(2).map(|pair| (pair[0] - origin).cross(pair[1] - origin)).sum()
    }

    /// Twice the area of a triangle in the plane; negative where it turns clockwise.
    fn area(&self, [a, b, c]: [usize; 3]) -> f64 {
        (self.points[b] - self.points[a]).perp_dot(self.points[c] - self.points[a])
    }

    /// Cuts what is easily cut: triangles, quads, convex polygons. Returns whether that was done.
    fn cut(&mut self) -> bool {
        let n = self.points.len();
        match n {
            0..3 => {}
            3 => self.triangles.push([0, 1, 2]),
            4 => return self.cut_quad(),
            _ => {
                let turns = (0..n).all(|i| self.area([i, (i + 1) % n, (i + 2) % n]) > 0.0);
                // A polygon may turn to the left all along and go around twice: then the fan folds back.
                if !turns || !(1..n - 1).all(|i| self.area([0, i, i + 1]) > 0.0) {
                    return false;
                }
                self.triangles.extend((1..n as u32 - 1).map(|i| [0, i, i + 1]));
            }
        }
        true
    }

    /// Cuts a quad along the shorter of the diagonals inside it. Returns false where none is inside.
    fn cut_quad(&mut self) -> bool {
        let inside = |a: [usize; 3], b: [usize; 3]| self.area(a) > 0.0 && self.area(b) > 0.0;
        let first = inside([0, 1, 2], [0, 2, 3]);
        let second = inside([1, 2, 3], [1, 3, 0]);
        let [p, q] = [[0, 2], [1, 3]].map(|[a, b]: [usize; 2]| self.space[a].distance_squared(self.space[b]));
        // If both diagonals are equally good, all quads of a grid are cut alike.
        match (first, second) {
            (false, false) => return false,
            (true, false) => self.triangles.extend([[0, 1, 2], [0, 2, 3]]),
            (true, true) if p <= q * (1.0 + 1e-4) => self.triangles.extend([[0, 1, 2], [0, 2, 3]]),
            _ => self.triangles.extend([[1, 2, 3], [1, 3, 0]]),
        }
        true
    }

    /// Cuts ears, then turns diagonals until no two triangles would be of a better shape with the other one. Returns false
    /// where the triangles do not cover the polygon once: it crosses itself.
    fn clip_ears(&mut self) -> bool {
        let points: Vec<[f64; 2]> = self.points.iter().map(DVec2::to_array).collect();
        let mut corners: Vec<u32> = Vec::new();
        Earcut::new().earcut(points.iter().copied(), &[], &mut corners);
        refine(&mut corners, &points);
        self.triangles.extend_from_slice(corners.as_chunks().0);
        let covered: f64 = self.triangles.iter().map(|t| self.area(t.map(|i| i as usize)).abs()).sum();
        let enclosed: f64 = (2..points.len()).map(|i| self.area([0, i - 1, i])).sum();
        let sides = self.points.iter().zip(self.points.iter().cycle().skip(1));
        let around: f64 = sides.map(|(a, b)| a.distance(*b)).sum();
        (covered - enclosed).abs() <= self.grain * around
    }
}
