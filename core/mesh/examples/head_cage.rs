//! Writes the control cages of the head and its garment, `core/mesh/src/head.obj`, from a head that ends with a jagged neck.
//!
//! ```text
//! cargo run -p chromascope-mesh --example head_cage -- head.obj > core/mesh/src/head.obj
//! ```
//!
//! The given OBJ file is the head of `MakeHuman`'s base mesh with the target `caucasian-male-young`, in meters, y up and z
//! forward, with the groups `skin` and `eyes`. Taken of it is the skin above the lowest loop of edges around the neck. From
//! there, rings of quadrilaterals follow curves from the neck over the shoulders to the edge of a base, and a grid closes it.
//! The garment is a solid around the shoulders: its rings stand off that surface, and the first lie in the neck, out of sight.
#![allow(clippy::print_stdout, clippy::print_stderr, clippy::disallowed_methods, reason = "a program of its own")]

use glam::{Vec3, vec2, vec3};
use std::collections::{BTreeMap, BTreeSet, VecDeque};
use std::f32::consts::PI;
use std::io::{Error, ErrorKind, Write as _};

/// The height from chin to crown that the source has, and that the head is brought to.
const CHIN_TO_CROWN: [f32; 2] = [0.225, 0.23];

/// The center of the source's left eyeball, by least squares over all of it but the cornea.
const EYEBALL: Vec3 = vec3(0.02929, 0.02072, 0.06429);

/// From left to right.
const MIRROR: Vec3 = vec3(-1.0, 1.0, 1.0);

/// The facts at the top of the file.
const HEADER: &str = "\
# title: Head
# quantity: control cage of a head with neck and shoulders, quadrilaterals for Catmull-Clark subdivision
# unit: m
# source: MakeHuman base mesh hm08 with the target caucasian-male-young (makehumancommunity/mpfb2)
# license: public domain (CC0 1.0: Data Collection AB, Joel Palmius and Jonas Hauquier, 2020)
# note: The skin above the lowest closed loop of edges around the neck, 0.23 m from chin to crown; shoulders, base and, as a group \
of its own, a garment are added. Written by the example head_cage of chromascope-mesh.
# note: The front looks towards +z, the top towards +y. Closed; it has no eyeballs.
";

/// An outline of the shoulders: half the width, the depths in front of the neck's axis and behind it, and the heights in
/// front, aside and behind, in the source's meters.
struct Outline {
    wide: f32,
    front: f32,
    back: f32,
    heights: [f32; 3],
}

/// Depth of the neck's axis.
const AXIS: f32 = -0.040;

/// Outlines from the neck down to the edge of the base, each with the number of rings up to it.
const OUTLINES: [(usize, Outline); 5] = [
    (4, Outline { wide: 0.080, front: 0.068, back: 0.057, heights: [-0.168, -0.127, -0.112] }),
    (3, Outline { wide: 0.118, front: 0.084, back: 0.072, heights: [-0.190, -0.145, -0.155] }),
    (3, Outline { wide: 0.138, front: 0.096, back: 0.078, heights: [-0.213, -0.175, -0.190] }),
    (3, Outline { wide: 0.136, front: 0.095, back: 0.074, heights: [-0.232, -0.210, -0.217] }),
    (1, Outline { wide: 0.127, front: 0.086, back: 0.066, heights: [-0.238, -0.221, -0.226] }),
];

/// Rings of the garment: how many rings below the neck, and how far off the skin in the source's meters. From inside the neck up
/// behind the collar, over its edge and down to the base.
const GARMENT: [(f32, f32); 22] = [
    (3.6, -0.0080),
    (3.3, -0.0010),
    (3.0, 0.0022),
    (2.5, 0.0026),
    (2.1, 0.0032),
    (1.85, 0.0052),
    (2.1, 0.0072),
    (2.5, 0.0076),
    (3.2, 0.0078),
    (3.75, 0.0078),
    (3.95, 0.0072),
    (4.0, 0.0056),
    (4.15, 0.0050),
    (5.0, 0.0050),
    (6.0, 0.0050),
    (7.0, 0.0050),
    (8.5, 0.0050),
    (10.0, 0.0050),
    (11.5, 0.0050),
    (13.0, 0.0050),
    (13.6, 0.0055),
    (14.0, 0.0060),
];

/// Vertices and quadrilaterals.
#[derive(Default)]
struct Cage {
    positions: Vec<Vec3>,
    quads: Vec<[usize; 4]>,
}

impl Cage {
    /// The skin of an OBJ file.
    fn skin(text: &str) -> Option<Self> {
        let (mut cage, mut is_skin) = (Self::default(), false);
        for line in text.lines() {
            let (key, rest) = line.split_once(' ').unwrap_or_default();
            let words = rest.split_ascii_whitespace();
            match key {
                "g" => is_skin = rest.trim() == "skin",
                "v" => {
                    let numbers: Option<Vec<f32>> = words.map(|word| word.parse().ok()).collect();
                    cage.positions.push(Vec3::from_array(numbers?.try_into().ok()?));
                }
                "f" if is_skin => {
                    let index = |word: &str| Some(word.split('/').next()?.parse::<usize>().ok()? - 1);
                    let corners: Option<Vec<usize>> = words.map(index).collect();
                    cage.quads.push(corners?.try_into().ok()?);
                }
                _ => {}
            }
        }
        Some(cage)
    }

    /// The quadrilaterals on both sides of each edge.
    fn edges(&self) -> BTreeMap<[usize; 2], Vec<usize>> {
        let mut edges: BTreeMap<[usize; 2], Vec<usize>> = BTreeMap::new();
        for (face, quad) in self.quads.iter().enumerate() {
            for k in 0..4 {
                edges.entry(ends(quad[k], quad[(k + 1) % 4])).or_default().push(face);
            }
        }
        edges
    }

    /// The lowest loop of edges around the neck, from the front to the left (+x): each next edge shares no quadrilateral with
    /// the one before.
    fn neck(&self) -> Option<Vec<usize>> {
        let edges = self.edges();
        let straight = |from: usize, at: usize| {
            let mut ahead = edges.keys().filter(|edge| edge.contains(&at)).map(|edge| edge[usize::from(edge[0] == at)]);
            let beside: Vec<usize> = edges.get(&ends(from, at))?.iter().flat_map(|&face| self.quads[face]).collect();
            let four = edges.keys().filter(|edge| edge.contains(&at)).count() == 4;
            ahead.find(|v| !beside.contains(v)).filter(|_| four)
        };
        let around = |first: usize| {
            let aside = |edge: &&[usize; 2]| edge.contains(&first) && edge.iter().any(|&v| self.positions[v].x > 0.0);
            let edge = edges.keys().find(aside)?;
            let mut ring = vec![first, edge[usize::from(edge[0] == first)]];
            loop {
                let next = straight(ring[ring.len() - 2], ring[ring.len() - 1])?;
                if next == first {
                    return Some(ring);
                }
                ring.push(next);
            }
        };
        // In front of the neck: the ears' height and the mouth have loops too.
        let mut firsts: Vec<usize> = (0..self.positions.len()).collect();
        firsts.retain(|&v| self.positions[v].x == 0.0 && self.positions[v].z > 0.0);
        firsts.sort_by(|&a, &b| self.positions[a].y.total_cmp(&self.positions[b].y));
        firsts.into_iter().find_map(around)
    }

    /// Part on the crown's side of a loop of edges, and that loop's new indices.
    fn above(&self, ring: &[usize]) -> Option<(Self, Vec<usize>)> {
        let cut: BTreeSet<[usize; 2]> = (0..ring.len()).map(|i| ends(ring[i], ring[(i + 1) % ring.len()])).collect();
        let edges = self.edges();
        let height = |face: &usize| self.positions[self.quads[*face][0]].y;
        let crown = (0..self.quads.len()).max_by(|a, b| height(a).total_cmp(&height(b)))?;
        let (mut kept, mut open) = (BTreeSet::from([crown]), VecDeque::from([crown]));
        while let Some(face) = open.pop_front() {
            let quad = self.quads[face];
            for edge in (0..4).map(|k| ends(quad[k], quad[(k + 1) % 4])).filter(|edge| !cut.contains(edge)) {
                open.extend(edges[&edge].iter().filter(|&&other| kept.insert(other)));
            }
        }
        let used: BTreeSet<usize> = kept.iter().flat_map(|&face| self.quads[face]).collect();
        let places: BTreeMap<usize, usize> = used.iter().copied().zip(0..).collect();
        let quads = kept.iter().map(|&face| self.quads[face].map(|v| places[&v])).collect();
        let positions = used.iter().map(|&v| self.positions[v]).collect();
        Some((Self { positions, quads }, ring.iter().map(|v| places[v]).collect()))
    }

    /// The places below each vertex of the neck, from there to the edge of the base.
    fn curves(&self, neck: &[usize]) -> Vec<Vec<Vec3>> {
        let count = neck.len();
        let curve = |i: usize| [vec![self.positions[neck[i]]], self.curve(neck, i)].concat();
        // The right half is the left one's mirror image, to the last bit.
        let mirrored = |i: usize| curve(i).into_iter().map(|p| p * MIRROR).collect();
        (0..count).map(|i| if 2 * i <= count { curve(i) } else { mirrored(count - i) }).collect()
    }

    /// Adds a ring of places, joined to another.
    fn add_ring(&mut self, last: Option<&[usize]>, places: impl Iterator<Item = Vec3>) -> Vec<usize> {
        let first = self.positions.len();
        self.positions.extend(places);
        let ring: Vec<usize> = (first..self.positions.len()).collect();
        for i in last.iter().flat_map(|_| 0..ring.len()) {
            let (last, next) = (last.unwrap_or_default(), (i + 1) % ring.len());
            self.quads.push([last[i], ring[i], ring[next], last[next]]);
        }
        ring
    }

    /// A garment around the surface of these curves, closed inside the neck and below.
    fn garment(curves: &[Vec<Vec3>]) -> Self {
        let (mut cage, count) = (Self::default(), curves.len());
        let place = |i: usize, (step, off): (f32, f32)| {
            let at = |i: usize, step: f32| {
                let curve = &curves[i % count];
                let low = (step.max(0.0) as usize).min(curve.len() - 2);
                curve[low].lerp(curve[low + 1], step - low as f32)
            };
            let down = at(i, (step + 0.5).min(14.0)) - at(i, step - 0.5);
            let around = at(i + 1, step) - at(i + count - 1, step);
            at(i, step) + off * down.cross(around).normalize()
        };
        let places = |ring: (f32, f32)| {
            let left: Vec<Vec3> = (0..=count / 2).map(|i| place(i, ring)).collect();
            (0..count).map(move |i| if 2 * i <= count { left[i] } else { left[count - i] * MIRROR })
        };
        let first = cage.add_ring(None, places(GARMENT[0]));
        let mut last = first.clone();
        for ring in &GARMENT[1..] {
            last = cage.add_ring(Some(&last), places(*ring));
        }
        cage.close(&last);
        // Upward: the other way around.
        cage.close(&(0..count).map(|i| first[(count - i) % count]).collect::<Vec<_>>());
        cage
    }

    /// The places of the rings below one vertex of the neck.
    fn curve(&self, neck: &[usize], index: usize) -> Vec<Vec3> {
        let start = self.positions[neck[index]];
        let angle = self.angle(neck, index);
        let (sin, cos) = angle.sin_cos();
        let mut knots = vec![start];
        knots.extend(OUTLINES.iter().map(|(_, outline)| {
            let depth = if cos > 0.0 { outline.front } else { outline.back } * cos;
            let [front, side, back] = outline.heights;
            let height = side * sin * sin + if cos > 0.0 { front } else { back } * cos * cos;
            vec3(outline.wide * sin, height, AXIS + depth)
        }));
        let mut places = Vec::new();
        for (i, (rings, _)) in OUTLINES.iter().enumerate() {
            let (from, to) = (knots[i], knots[i + 1]);
            let chord = from.distance(to);
            // Slopes of a Catmull–Rom spline over the chords' lengths; the neck's own at its end.
            let slope = |k: usize| match k {
                0 => self.way(neck, index),
                k if k + 1 == knots.len() => (knots[k] - knots[k - 1]).normalize(),
                k => {
                    let (a, b) = (knots[k] - knots[k - 1], knots[k + 1] - knots[k]);
                    (a / a.length() * b.length() + b / b.length() * a.length()) / (a.length() + b.length())
                }
            };
            let (d0, d1) = (slope(i) * chord, slope(i + 1) * chord);
            places.extend((1..=*rings).map(|k| {
                let t = k as f32 / *rings as f32;
                let (t2, t3) = (t * t, t * t * t);
                let ends = from * (2.0 * t3 - 3.0 * t2 + 1.0) + to * (3.0 * t2 - 2.0 * t3);
                ends + d0 * (t3 - 2.0 * t2 + t) + d1 * (t3 - t2)
            }));
        }
        places
    }

    /// The direction in which the surface goes on below a vertex of the neck: the mean over its neighbors on the ring.
    fn way(&self, neck: &[usize], index: usize) -> Vec3 {
        let count = neck.len();
        let below = |index: usize| {
            let at = neck[index % count];
            let quads = self.quads.iter().filter(|quad| quad.contains(&at)).flatten();
            let above: BTreeSet<usize> = quads.copied().filter(|v| !neck.contains(v)).collect();
            let middle = above.iter().map(|&v| self.positions[v]).sum::<Vec3>() / above.len() as f32;
            (self.positions[at] - middle).normalize()
        };
        (index + count - 3..=index + count + 3).map(below).sum::<Vec3>().normalize()
    }

    /// The direction of a vertex of the neck seen from its axis: 0 in front, a quarter turn at the left; half as seen, half
    /// by its place along the ring.
    fn angle(&self, neck: &[usize], index: usize) -> f32 {
        let place = self.positions[neck[index]];
        let even = 2.0 * PI * index as f32 / neck.len() as f32;
        let seen = vec2(place.z - AXIS, place.x).to_angle().rem_euclid(2.0 * PI);
        let seen = if index == 0 { 0.0 } else { seen };
        even + 0.5 * (seen - even)
    }

    /// Closes a ring with a grid whose columns run from front to back.
    fn close(&mut self, ring: &[usize]) {
        let count = ring.len();
        // An even number of columns, with the middle in front.
        let columns = count / 4 / 2 * 2 + 2;
        let rows = count / 2 - columns;
        let half = columns / 2;
        let mut grid = vec![vec![0; columns + 1]; rows + 1];
        for (row, line) in grid.iter_mut().enumerate() {
            for (column, vertex) in line.iter_mut().enumerate() {
                // From +x to −x and from front to back; inside comes later.
                let place = if row == 0 {
                    count + half - column
                } else if row == rows {
                    half + rows + column
                } else if column == 0 {
                    half + row
                } else {
                    count - half - row
                };
                *vertex = ring[place % count];
            }
        }
        let border = grid.clone();
        for (row, line) in grid.iter_mut().enumerate().take(rows).skip(1) {
            for (column, vertex) in line.iter_mut().enumerate().take(columns).skip(1) {
                let (u, v) = (column as f32 / columns as f32, row as f32 / rows as f32);
                let at = |r: usize, c: usize| self.positions[border[r][c]];
                let across = at(row, 0).lerp(at(row, columns), u) + at(0, column).lerp(at(rows, column), v);
                let corners = at(0, 0).lerp(at(0, columns), u).lerp(at(rows, 0).lerp(at(rows, columns), u), v);
                *vertex = self.positions.len();
                self.positions.push(across - corners);
            }
        }
        for row in 0..rows {
            for column in 0..columns {
                let [a, b] = [row, row + 1].map(|r| [grid[r][column], grid[r][column + 1]]);
                self.quads.push([a[0], a[1], b[1], b[0]]);
            }
        }
    }
}

fn ends(a: usize, b: usize) -> [usize; 2] {
    [a.min(b), a.max(b)]
}

fn main() -> Result<(), Error> {
    let invalid = |what: &'static str| Error::new(ErrorKind::InvalidData, what);
    let path = std::env::args().nth(1).ok_or_else(|| invalid("the path of an OBJ file is missing"))?;
    let skin = Cage::skin(&std::fs::read_to_string(path)?).ok_or_else(|| invalid("not of quadrilaterals"))?;
    let ring = skin.neck().ok_or_else(|| invalid("no loop of edges around the neck"))?;
    let (mut cage, neck) = skin.above(&ring).ok_or_else(|| invalid("nothing above the neck"))?;
    let curves = cage.curves(&neck);
    let base = (1..curves[0].len()).fold(neck, |last, step| cage.add_ring(Some(&last), curves.iter().map(|c| c[step])));
    cage.close(&base);
    let garment = Cage::garment(&curves);
    let scale = CHIN_TO_CROWN[1] / CHIN_TO_CROWN[0];
    let low = cage.positions.iter().copied().reduce(Vec3::min).unwrap_or_default();
    let high = cage.positions.iter().copied().reduce(Vec3::max).unwrap_or_default();
    let middle = low.midpoint(high) * vec3(0.0, 1.0, 1.0);
    eprintln!("center of an eyeball: {:.5}", (EYEBALL - middle) * scale);
    let mut out = std::io::stdout().lock();
    for (heading, cage, first) in [(HEADER, &cage, 1), ("g garment\n", &garment, 1 + cage.positions.len())] {
        out.write_all(heading.as_bytes())?;
        for p in &cage.positions {
            let p = ((*p - middle) * scale * 1e5).round() / 1e5 + 0.0;
            writeln!(out, "v {:.5} {:.5} {:.5}", p.x, p.y, p.z)?;
        }
        for quad in &cage.quads {
            let [a, b, c, d] = quad.map(|v| v + first);
            writeln!(out, "f {a} {b} {c} {d}")?;
        }
    }
    Ok(())
}
