//! Triangle that each sample of a picture sees.
//!
//! Rays through sample centers against triangles, as edge functions in the view's coordinates (Olano and Greer 1997):
//! a ray d = (x, y, 1) meets the triangle with corners a, b, c where the three triple products d·(b × c), d·(c × a),
//! d·(a × b) share a sign. Nothing is projected, so nothing is clipped, and neighbors share an edge's function up to its
//! sign to the last bit: no cracks, no sample twice.

use super::stop::Stop;
use crate::scene::Eye;
use chromascope_math::array::array;
use chromascope_mesh::Mesh;
use glam::DVec3;
use multiversion::multiversion;
use rayon::prelude::*;
use std::ops::Range;

/// Samples of a tile's side.
const TILE: usize = 16;

/// The largest side of a picture, in samples.
pub const MAX_SIDE: u32 = 16_384;

/// Number of samples a picture has: pixels, each with a square of samples.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct RasterSize {
    /// Pixels across.
    pub width: u32,
    /// Pixels down.
    pub height: u32,
    /// Samples along a pixel's side: 1 for one in its middle.
    pub samples: u32,
}

impl RasterSize {
    /// A picture with one sample a pixel.
    pub fn new(width: u32, height: u32) -> Self {
        Self { width, height, samples: 1 }
    }

    /// Size with sides of at least one and at most [`MAX_SIDE`] samples.
    #[must_use]
    pub fn clamped(self) -> Self {
        let samples = self.samples.clamp(1, 8);
        let side = |pixels: u32| pixels.clamp(1, MAX_SIDE / samples);
        Self { width: side(self.width), height: side(self.height), samples }
    }

    /// Samples across.
    pub fn columns(self) -> usize {
        self.width as usize * self.samples as usize
    }

    /// Samples down.
    pub fn rows(self) -> usize {
        self.height as usize * self.samples as usize
    }

    fn tiles(self) -> [usize; 2] {
        [self.columns().div_ceil(TILE), self.rows().div_ceil(TILE)]
    }
}

/// Triangle and place that a sample sees.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// The triangle's index, or [`Hit::NONE`].
    pub triangle: u32,
    /// The weights of the triangle's second and third corner; the first has the rest.
    pub weights: [f32; 2],
}

impl Hit {
    /// No triangle.
    pub const NONE: u32 = u32::MAX;

    const NOTHING: Self = Self { triangle: Self::NONE, weights: [0.0; 2] };

    /// True if a triangle is seen.
    pub fn is_some(self) -> bool {
        self.triangle != Self::NONE
    }

    /// The weights of the three corners.
    pub fn barycentric(self) -> [f32; 3] {
        let [b, c] = self.weights;
        [1.0 - b - c, b, c]
    }
}

/// Triangles that the samples see, row by row from the top left.
#[derive(Clone, Debug, PartialEq)]
pub struct Visibility {
    size: RasterSize,
    eye: Eye,
    hits: Vec<Hit>,
}

impl Visibility {
    /// Finds what each sample of a picture sees of a mesh, the nearest triangle from either side; none if stopped.
    ///
    /// Visibility of a mesh, equal for any number of threads. Triangles that hold no sample's center are passed over.
    pub fn new(mesh: &Mesh, eye: Eye, size: RasterSize, stop: &Stop) -> Option<Self> {
        let size = size.clamped();
        let rays = Rays::new(size, &eye);
        let corner = |p: &glam::Vec3| Corner::new(eye.view_from_world(p.as_dvec3()), &rays);
        let corners: Vec<Corner> = mesh.positions().par_iter().with_min_len(4096).map(corner).collect();
        let bins = |(run, triangles): (usize, &[[u32; 3]])| Bins::new(run * RUN, triangles, &corners, size);
        let bins: Vec<Bins> = mesh.triangles().par_chunks(RUN).enumerate().map(bins).collect();
        let mut hits = vec![Hit::NOTHING; size.columns() * size.rows()];
        let [across, _] = size.tiles();
        let scene = Scene { triangles: mesh.triangles(), corners: &corners, bins: &bins, rays: &rays };
        // A band of tiles is a run of rows, so each is written by one thread alone.
        hits.par_chunks_mut(TILE * size.columns()).enumerate().for_each(|(band, rows)| {
            let mut square = Tile::EMPTY;
            for column in 0..across {
                if stop.is_set() {
                    return;
                }
                let tile = band * across + column;
                if bins.iter().any(|bins| !bins.is_empty(tile)) {
                    draw(&mut square, tile, &scene, [column * TILE, band * TILE]);
                    square.store(rows, column * TILE, size.columns());
                }
            }
        });
        (!stop.is_set()).then_some(Self { size, eye, hits })
    }

    /// The picture's size.
    pub fn size(&self) -> RasterSize {
        self.size
    }

    /// The eye it was seen from.
    pub fn eye(&self) -> &Eye {
        &self.eye
    }

    /// Triangles that the samples see, row by row from the top left.
    pub fn hits(&self) -> &[Hit] {
        &self.hits
    }

    /// Rays of the samples.
    pub fn rays(&self) -> Rays {
        Rays::new(self.size, &self.eye)
    }
}

/// Rays of the samples: x and y of a ray that goes one ahead.
#[derive(Clone, Copy, Debug)]
pub struct Rays {
    step: f64,
    left: f64,
    top: f64,
    columns: usize,
}

impl Rays {
    fn new(size: RasterSize, eye: &Eye) -> Self {
        let step = 2.0 * eye.half_height / size.rows() as f64;
        let left = -0.5 * step * size.columns() as f64;
        Self { step, left, top: eye.half_height, columns: size.columns() }
    }

    /// The direction of a sample's ray in view coordinates, one ahead.
    pub fn at(&self, sample: usize) -> DVec3 {
        DVec3::new(self.x(sample % self.columns), self.y(sample / self.columns), 1.0)
    }

    pub(super) fn x(&self, column: usize) -> f64 {
        self.left + (column as f64 + 0.5) * self.step
    }

    pub(super) fn y(&self, row: usize) -> f64 {
        self.top - (row as f64 + 0.5) * self.step
    }
}

/// A vertex before the eye.
#[derive(Clone, Copy)]
struct Corner {
    /// In view coordinates, ahead positive.
    place: DVec3,
    /// Position in samples from the left and the top; none behind the viewer.
    seen: Option<[f64; 2]>,
}

impl Corner {
    fn new(place: DVec3, rays: &Rays) -> Self {
        let seen = (place.z > 0.0).then(|| {
            let scale = 1.0 / (place.z * rays.step);
            [place.x * scale - rays.left / rays.step, rays.top / rays.step - place.y * scale]
        });
        Self { place, seen }
    }
}

/// The samples that a triangle may cover: from left, to right, from top, to bottom, the ends excluded.
#[derive(Clone, Copy)]
struct Extent([u16; 4]);

impl Extent {
    const EMPTY: Self = Self([0; 4]);

    fn new(corners: [&Corner; 3], size: RasterSize) -> Self {
        let [Some(a), Some(b), Some(c)] = [corners[0].seen, corners[1].seen, corners[2].seen] else {
            return Self::reaching_behind(corners, size);
        };
        let [left, right] = span(a[0].min(b[0]).min(c[0]), a[0].max(b[0]).max(c[0]), size.columns());
        let [top, bottom] = span(a[1].min(b[1]).min(c[1]), a[1].max(b[1]).max(c[1]), size.rows());
        Self([left, right, top, bottom])
    }

    /// A triangle that reaches behind the eye: from what is seen of it to the picture's border, on the sides that its edges
    /// pass the eye on.
    fn reaching_behind(corners: [&Corner; 3], size: RasterSize) -> Self {
        let (mut from, mut to) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
        let mut include = |[x, y]: [f64; 2]| {
            from = [from[0].min(x), from[1].min(y)];
            to = [to[0].max(x), to[1].max(y)];
        };
        for k in 0..3 {
            let (corner, other) = (corners[k], corners[(k + 1) % 3]);
            if let Some(seen) = corner.seen {
                include(seen);
            }
            if corner.seen.is_some() != other.seen.is_some() {
                // Where the edge passes the plane of the eye, turned so that the eye's depths do not divide.
                let (a, b) = (corner.place, other.place);
                let beside = (a * (-b.z) + b * a.z) * if a.z > 0.0 { 1.0 } else { -1.0 };
                let rounding = (a.abs() * b.z.abs() + b.abs() * a.z.abs()) * 1e-9;
                // Both ways where rounding hides the side.
                let far = |v: f64, rounding: f64| {
                    let way =
                        |sign: f64| if sign * v >= -rounding { sign * f64::INFINITY } else { -sign * f64::INFINITY };
                    [way(-1.0), way(1.0)]
                };
                let (x, y) = (far(beside.x, rounding.x), far(-beside.y, rounding.y));
                include([x[0], y[0]]);
                include([x[1], y[1]]);
            }
        }
        if from[0] > to[0] {
            return Self::EMPTY;
        }
        let [left, right] = span(from[0], to[0], size.columns());
        let [top, bottom] = span(from[1], to[1], size.rows());
        Self([left, right, top, bottom])
    }

    fn is_empty(self) -> bool {
        let [left, right, top, bottom] = self.0;
        left >= right || top >= bottom
    }

    fn tiles(self, across: usize) -> impl Iterator<Item = usize> {
        let [left, right, top, bottom] = array(|k| usize::from(self.0[k]));
        let rows = if self.is_empty() { 0..0 } else { top / TILE..bottom.div_ceil(TILE) };
        rows.flat_map(move |y| (left / TILE..right.div_ceil(TILE)).map(move |x| y * across + x))
    }
}

/// The samples with centers between two places counted in samples, one more at either side against rounding; casts
/// saturate, so that any place is one.
fn span(from: f64, to: f64, count: usize) -> [u16; 2] {
    const SLACK: f64 = 1e-6;
    let within = |place: f64| place.max(0.0).min(count as f64) as i32 as u16;
    [within(from + (0.5 - SLACK)), within(to + (0.5 + SLACK))]
}

/// Triangles that one task sorts into tiles.
const RUN: usize = 8192;

/// A triangle that may be seen, and where.
#[derive(Clone, Copy)]
struct Outline {
    extent: Extent,
    /// No corner is nearer than this; not positive if one is behind the eye.
    ahead: f32,
    /// True if it is drawn first: of a closed surface these hide the others.
    facing: bool,
}

impl Outline {
    fn new(corners: [&Corner; 3], size: RasterSize) -> Self {
        let extent = Extent::new(corners, size);
        let nearest = corners.iter().map(|corner| corner.place.z).fold(f64::INFINITY, f64::min);
        let facing = match [corners[0].seen, corners[1].seen, corners[2].seen] {
            // Rows run down, so what is counter-clockwise to the eye has a negative area here.
            [Some(a), Some(b), Some(c)] => (b[0] - a[0]) * (c[1] - a[1]) <= (b[1] - a[1]) * (c[0] - a[0]),
            _ => true,
        };
        Self { extent, ahead: (nearest * (1.0 - 1e-6)) as f32, facing }
    }
}

/// The triangles of one run that each tile may show: those that face the eye, then the others, each in ascending order.
struct Bins {
    first: u32,
    outlines: Vec<Outline>,
    tiles: usize,
    starts: Vec<u32>,
    ids: Vec<u32>,
}

impl Bins {
    fn new(first: usize, triangles: &[[u32; 3]], corners: &[Corner], size: RasterSize) -> Self {
        let [across, down] = size.tiles();
        let tiles = across * down;
        let outline = |&[a, b, c]: &[u32; 3]| {
            Outline::new([&corners[a as usize], &corners[b as usize], &corners[c as usize]], size)
        };
        let outlines: Vec<Outline> = triangles.iter().map(outline).collect();
        let places = |outline: &Outline| {
            let side = if outline.facing { 0 } else { tiles };
            outline.extent.tiles(across).map(move |tile| side + tile)
        };
        let mut starts = vec![0_u32; 2 * tiles + 1];
        for outline in outlines.iter().filter(|outline| !outline.extent.is_empty()) {
            places(outline).for_each(|place| starts[place + 1] += 1);
        }
        for place in 0..2 * tiles {
            starts[place + 1] += starts[place];
        }
        let mut next = starts.clone();
        let mut ids = vec![0; *next.last().unwrap_or(&0) as usize];
        for (id, outline) in outlines.iter().enumerate().filter(|(_, outline)| !outline.extent.is_empty()) {
            for place in places(outline) {
                ids[next[place] as usize] = id as u32;
                next[place] += 1;
            }
        }
        Self { first: first as u32, outlines, tiles, starts, ids }
    }

    /// The run's triangles in a tile, either those that face the eye or the others.
    fn of(&self, tile: usize, facing: bool) -> impl Iterator<Item = (u32, Outline)> {
        let place = if facing { tile } else { self.tiles + tile };
        let ids = &self.ids[self.starts[place] as usize..self.starts[place + 1] as usize];
        ids.iter().map(|&id| (self.first + id, self.outlines[id as usize]))
    }

    fn is_empty(&self, tile: usize) -> bool {
        [tile, self.tiles + tile].iter().all(|&place| self.starts[place] == self.starts[place + 1])
    }
}

/// Mesh and view that all tiles are drawn from.
struct Scene<'a> {
    triangles: &'a [[u32; 3]],
    corners: &'a [Corner],
    bins: &'a [Bins],
    rays: &'a Rays,
}

/// Samples of a row that are drawn side by side.
const LANES: usize = 4;

/// Samples from one row of a tile to the next: what runs past the right end is thrown away.
const STRIDE: usize = TILE + LANES;

/// A square of samples being drawn: what is nearest so far. All numbers are of one size, so that the loops vectorize.
struct Tile {
    /// One over the depth; infinite past the right end, so that nothing is drawn there.
    nearness: [f64; TILE * STRIDE],
    ids: [f64; TILE * STRIDE],
    /// The edge functions of the second and third corner, and the sum of all three.
    edges: [[f64; TILE * STRIDE]; 3],
    /// Rays of the columns.
    xs: [f64; STRIDE],
}

/// Draws what a tile may show; its left and top samples are given. Compiled for several instruction sets, the best chosen
/// at run time; no operation is fused, so all of them give the same bits.
#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl+avx512bw+avx512cd", "x86_64+avx2", "aarch64+neon"))]
fn draw(tile: &mut Tile, index: usize, scene: &Scene<'_>, corner: [usize; 2]) {
    draw_portable(tile, index, scene, corner);
}

/// Portable form for any processor.
#[inline(always)]
fn draw_portable(tile: &mut Tile, index: usize, scene: &Scene<'_>, corner: [usize; 2]) {
    tile.clear(scene.rays, corner[0]);
    tile.draw(index, true, scene, corner, 0.0);
    let floor = tile.floor();
    tile.draw(index, false, scene, corner, floor);
}

impl Tile {
    const EMPTY: Self = Self {
        nearness: [0.0; TILE * STRIDE],
        ids: [0.0; TILE * STRIDE],
        edges: [[0.0; TILE * STRIDE]; 3],
        xs: [0.0; STRIDE],
    };

    #[inline(always)]
    fn clear(&mut self, rays: &Rays, left: usize) {
        for row in self.nearness.chunks_exact_mut(STRIDE) {
            let (inside, outside) = row.split_at_mut(TILE);
            // Above zero, so that a hit's numbers can be divided by their sum.
            inside.fill(f64::MIN_POSITIVE);
            outside.fill(f64::INFINITY);
        }
        self.ids.fill(f64::from(Hit::NONE));
        for (column, x) in self.xs.iter_mut().enumerate() {
            *x = rays.x(left + column);
        }
    }

    /// The nearness that all samples have at least.
    #[inline(always)]
    fn floor(&self) -> f64 {
        // Bits of what is not negative are in the order of the numbers, and whole numbers are compared in vectors.
        f64::from_bits(self.nearness.iter().fold(u64::MAX, |least, v| least.min(v.to_bits())))
    }

    /// Draws the triangles of one side that are not certainly behind what all samples see.
    #[inline(always)]
    fn draw(&mut self, index: usize, facing: bool, scene: &Scene<'_>, [left, top]: [usize; 2], floor: f64) {
        for bins in scene.bins {
            for (id, outline) in bins.of(index, facing) {
                let ahead = f64::from(outline.ahead);
                if floor * ahead > 1.0 {
                    continue;
                }
                let [from, to, above, below] = array(|k| usize::from(outline.extent.0[k]));
                let across = from.max(left) - left..to.min(left + TILE) - left;
                let down = above.max(top) - top..below.min(top + TILE) - top;
                if !facing && self.hides(ahead, &across, &down) {
                    continue;
                }
                let corners = scene.triangles[id as usize];
                let corners = array(|k| scene.corners[corners[k] as usize].place);
                self.triangle(id, corners, |row| scene.rays.y(top + row), [across, down]);
            }
        }
    }

    /// True if all of these samples see something nearer than a depth.
    #[inline(always)]
    fn hides(&self, ahead: f64, across: &Range<usize>, down: &Range<usize>) -> bool {
        ahead > 0.0
            && down.clone().all(|row| {
                across.clone().step_by(LANES).all(|column| {
                    let [a, b, c, d] = lanes(&self.nearness, row * STRIDE + column);
                    least(least(a, b), least(c, d)) * ahead > 1.0
                })
            })
    }

    /// Writes the samples of a triangle that are nearer than what was there; of equals the one with the lowest index stays.
    #[inline(always)]
    fn triangle(
        &mut self,
        id: u32,
        [a, b, c]: [DVec3; 3],
        y: impl Fn(usize) -> f64,
        [across, down]: [Range<usize>; 2],
    ) {
        let edges = [b.cross(c), c.cross(a), a.cross(b)];
        let volume = a.dot(edges[0]);
        let scale = 1.0 / volume.abs();
        if !(scale > 0.0 && scale.is_finite()) {
            return;
        }
        // Seen from the other side all signs are turned; a sample on an edge belongs to one side of it alone.
        let edges = if volume < 0.0 { array(|k| -edges[k]) } else { edges };
        let limits: [f64; 3] = array(|k| if owns_its_border(edges[k]) { 0.0 } else { f64::MIN_POSITIVE });
        for row in down {
            let y = y(row);
            let bases: [f64; 3] = array(|k| edges[k].y * y + edges[k].z);
            for column in across.clone().step_by(LANES) {
                let lines = array(|k| (edges[k].x, bases[k], limits[k]));
                self.four(f64::from(id), row, column, lines, scale);
            }
        }
    }

    /// Depths of some samples side by side.
    #[inline(always)]
    fn four(&mut self, id: f64, row: usize, column: usize, lines: [(f64, f64, f64); 3], scale: f64) {
        let start = row * STRIDE + column;
        let xs = lanes(&self.xs, column);
        let edge = |k: usize| each(|i| lines[k].0 * xs[i] + lines[k].1);
        let (a, b, c) = (edge(0), edge(1), edge(2));
        let sum = each(|i| a[i] + b[i] + c[i]);
        let least = each(|i| least(a[i] - lines[0].2, least(b[i] - lines[1].2, c[i] - lines[2].2)));
        let nearness = each(|i| if least[i] >= 0.0 { sum[i] * scale } else { 0.0 });
        let nearest = lanes(&self.nearness, start);
        let ids = lanes(&self.ids, start);
        let equal = each(|i| if id < ids[i] { nearness[i] } else { -1.0 });
        let gate = each(|i| if equal[i] == nearest[i] { f64::INFINITY } else { nearness[i] });
        let [second, third, sums] = &mut self.edges;
        let (ids, nearer) = (&mut self.ids, &mut self.nearness);
        put(&mut ids[start..start + LANES], [id; LANES], gate, nearest);
        put(&mut second[start..start + LANES], b, gate, nearest);
        put(&mut third[start..start + LANES], c, gate, nearest);
        put(&mut sums[start..start + LANES], sum, gate, nearest);
        put(&mut nearer[start..start + LANES], nearness, gate, nearest);
    }

    fn store(&self, rows: &mut [Hit], left: usize, columns: usize) {
        let width = TILE.min(columns - left);
        for (row, line) in rows.chunks_exact_mut(columns).enumerate() {
            for (column, hit) in line[left..left + width].iter_mut().enumerate() {
                let at = row * STRIDE + column;
                let share = 1.0 / self.edges[2][at];
                let weights = array(|k| (self.edges[k][at] * share) as f32);
                let triangle = self.ids[at] as u32;
                *hit = if triangle == Hit::NONE { Hit::NOTHING } else { Hit { triangle, weights } };
            }
        }
    }
}

#[inline(always)]
fn each(value: impl Fn(usize) -> f64) -> [f64; LANES] {
    [value(0), value(1), value(2), value(3)]
}

#[inline(always)]
fn least(a: f64, b: f64) -> f64 {
    if a < b { a } else { b }
}

#[inline(always)]
fn lanes(all: &[f64], start: usize) -> [f64; LANES] {
    let all = &all[start..start + LANES];
    each(|i| all[i])
}

/// Replaces what is behind.
#[inline(always)]
fn put(all: &mut [f64], new: [f64; LANES], gate: [f64; LANES], nearest: [f64; LANES]) {
    let kept = each(|i| if gate[i] > nearest[i] { new[i] } else { all[i] });
    if let Some(all) = all.first_chunk_mut() {
        *all = kept;
    }
}

/// True if the common edge belongs to this one of two neighbors, for samples exactly on it: the one into which the
/// edge's normal points to positive x, else y, else z; the other's normal is the opposite.
#[inline]
fn owns_its_border(edge: DVec3) -> bool {
    let first = if edge.x != 0.0 {
        edge.x
    } else if edge.y != 0.0 {
        edge.y
    } else {
        edge.z
    };
    first > 0.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_instruction_set_draws_the_same() {
        let size = RasterSize::new(16, 16);
        let rays = Rays { step: 0.1, left: -0.8, top: 0.8, columns: 16 };
        let place = |i: u32| DVec3::new((1.9 * f64::from(i)).sin(), (2.7 * f64::from(i)).cos(), 1.5 + f64::from(i % 5));
        let corners: Vec<Corner> = (0..60).map(|i| Corner::new(place(i), &rays)).collect();
        let triangles: Vec<[u32; 3]> = (0..58).map(|i| [i, i + 1, i + 2]).collect();
        let bins = [Bins::new(0, &triangles, &corners, size)];
        let scene = Scene { triangles: &triangles, corners: &corners, bins: &bins, rays: &rays };
        let drawn = |draw: fn(&mut Tile, usize, &Scene<'_>, [usize; 2])| {
            let (mut tile, mut hits) = (Tile::EMPTY, vec![Hit::NOTHING; 256]);
            draw(&mut tile, 0, &scene, [0; 2]);
            tile.store(&mut hits, 0, 16);
            hits
        };
        let chosen = drawn(draw);
        assert_eq!(chosen, drawn(draw_portable));
        assert!(chosen.iter().any(|hit| hit.is_some()));
    }
}
