//! Polygons cut into triangles, concave ones too.

use super::error::MeshReadError;
use super::report::Tally;
use super::soup::Soup;
use glam::{DVec2, DVec3};

/// The most corners of a concave polygon, whose cutting takes time with their square.
const MAX_CONCAVE: usize = 4096;

/// Faces between two looks at whether to stop.
const STOP_EVERY: usize = 1 << 14;

/// Triangles and the faces they were cut from.
pub(super) struct Cut {
    /// Three corners each, as indices among the soup's corners.
    pub(super) triangles: Vec<[u32; 3]>,
    /// The face of each triangle, ascending.
    pub(super) faces: Vec<u32>,
    /// Triangles without area, left out.
    pub(super) degenerate: Tally,
    /// Polygons that cross themselves.
    pub(super) crossing: Tally,
}

/// Cuts all faces; triangles without area are left out.
pub(super) fn cut(soup: &Soup, stop: &dyn Fn() -> bool) -> Result<Cut, MeshReadError> {
    let mut cut =
        Cut { triangles: Vec::new(), faces: Vec::new(), degenerate: Tally::default(), crossing: Tally::default() };
    let mut polygon = Polygon::default();
    for face in 0..soup.faces() {
        if face % STOP_EVERY == 0 && stop() {
            return Err(MeshReadError::Stopped);
        }
        let corners = soup.face(face);
        let first = corners.start as u32;
        if corners.len() == 3 {
            cut.add(soup, face, [first, first + 1, first + 2]);
            continue;
        }
        polygon.take(soup, corners.clone());
        let way = if polygon.cut() {
            Ok(())
        } else if polygon.points.len() > MAX_CONCAVE {
            Err(MeshReadError::FaceTooLong { place: soup.place(face), corners: corners.len(), limit: MAX_CONCAVE })
        } else {
            if !polygon.clip_ears() {
                cut.crossing.add(soup.place(face));
            }
            Ok(())
        };
        way?;
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
    /// Appends a triangle, or counts it where it has no area.
    #[inline]
    fn add(&mut self, soup: &Soup, face: usize, triangle: [u32; 3]) {
        let [a, b, c] = triangle.map(|i| soup.positions[soup.corners[i as usize].position as usize].as_dvec3());
        let (u, v) = (b - a, c - a);
        let longest = u.length_squared().max(v.length_squared()).max((c - b).length_squared());
        let size = a.abs().max(b.abs()).max(c.abs()).max_element();
        // Below this height the rounding of the coordinates, not the file, makes the triangle's normal.
        let height = 2.0 * f64::from(f32::EPSILON) * size;
        if u.cross(v).length_squared() <= height * height * longest {
            self.degenerate.add(soup.place(face));
        } else {
            self.triangles.push(triangle);
            self.faces.push(face as u32);
        }
    }
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
    /// What is still uncut: for each corner the one before and the one after.
    around: Vec<[u32; 2]>,
    /// Triangles of indices among `corners`.
    triangles: Vec<[u32; 3]>,
}

impl Polygon {
    /// Takes a face's corners and lays them into the plane.
    fn take(&mut self, soup: &Soup, range: std::ops::Range<usize>) {
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
        // Where both are as good, all quads of a grid are cut the same way.
        match (first, second) {
            (false, false) => return false,
            (true, false) => self.triangles.extend([[0, 1, 2], [0, 2, 3]]),
            (true, true) if p <= q * (1.0 + 1e-4) => self.triangles.extend([[0, 1, 2], [0, 2, 3]]),
            _ => self.triangles.extend([[1, 2, 3], [1, 3, 0]]),
        }
        true
    }

    /// Cuts ear after ear (Meisters 1975). Returns false where at some time no ear was left: the polygon crosses itself.
    fn clip_ears(&mut self) -> bool {
        let n = self.points.len() as u32;
        self.around.clear();
        self.around.extend((0..n).map(|i| [(i + n - 1) % n, (i + 1) % n]));
        let (mut left, mut at, mut missed, mut simple) = (n, 0_u32, 0, true);
        while left > 3 {
            let [before, after] = self.around[at as usize];
            if missed < left && !self.is_ear(before, at, after) {
                missed += 1;
                at = after;
                continue;
            }
            let triangle = [before, at, after];
            // Corners in line are no ears until their neighbors are gone, but they cross nothing.
            simple &= missed < left || self.area(triangle.map(|i| i as usize)) == 0.0;
            self.triangles.push(triangle);
            self.around[before as usize][1] = after;
            self.around[after as usize][0] = before;
            left -= 1;
            missed = 0;
            // From the next corner but one, so that a round polygon is not cut into a fan of slivers.
            at = self.around[after as usize][1];
        }
        let [before, after] = self.around[at as usize];
        self.triangles.push([before, at, after]);
        simple && self.area([before, at, after].map(|i| i as usize)) >= 0.0
    }

    /// Whether a corner turns to the left and no other corner that is left lies in its triangle.
    fn is_ear(&self, before: u32, at: u32, after: u32) -> bool {
        let [a, b, c] = [before, at, after].map(|i| self.points[i as usize]);
        if (b - a).perp_dot(c - a) <= 0.0 {
            return false;
        }
        let inside = |p: DVec2| {
            (b - a).perp_dot(p - a) >= 0.0 && (c - b).perp_dot(p - b) >= 0.0 && (a - c).perp_dot(p - c) >= 0.0
        };
        let mut other = self.around[after as usize][1];
        while other != before {
            let p = self.points[other as usize];
            // A corner met twice, as where a bridge leads to a hole, does not stop the ear that ends on it.
            if p != a && p != b && p != c && inside(p) {
                return false;
            }
            other = self.around[other as usize][1];
        }
        true
    }
}
