//! Which triangle each sample of a picture sees.
//!
//! Rays through sample centers against triangles, as edge functions in the view's coordinates (Olano and Greer 1997):
//! a ray d = (x, y, 1) meets the triangle with corners a, b, c where the three triple products d·(b × c), d·(c × a),
//! d·(a × b) share a sign. Nothing is projected, so nothing is clipped, and neighbors share an edge's function up to its
//! sign to the last bit: no cracks, no sample twice.

use super::Stop;
use crate::scene::{Eye, Mesh};
use glam::DVec3;
use rayon::prelude::*;
use std::ops::Range;

/// Samples of a tile's side.
const TILE: usize = 16;

/// The largest side of a picture, in samples.
pub const MAX_SIDE: u32 = 16_384;

/// How many samples a picture has: pixels, each with a square of samples.
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

    /// The same with sides of at least one and at most [`MAX_SIDE`] samples.
    #[must_use]
    pub fn clamped(self) -> Self {
        let samples = self.samples.clamp(1, 8);
        let side = |pixels: u32| pixels.clamp(1, MAX_SIDE / samples);
        Self { width: side(self.width), height: side(self.height), samples }
    }

    /// Samples across.
    pub fn columns(self) -> usize {
        (self.width * self.samples) as usize
    }

    /// Samples down.
    pub fn rows(self) -> usize {
        (self.height * self.samples) as usize
    }

    /// Tiles across and down.
    fn tiles(self) -> [usize; 2] {
        [self.columns().div_ceil(TILE), self.rows().div_ceil(TILE)]
    }
}

/// What a sample sees.
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

    /// Whether a triangle is seen.
    pub fn is_some(self) -> bool {
        self.triangle != Self::NONE
    }

    /// The weights of the three corners.
    pub fn barycentric(self) -> [f32; 3] {
        let [b, c] = self.weights;
        [1.0 - b - c, b, c]
    }
}

/// What each sample sees, row by row from the top left.
#[derive(Clone, Debug, PartialEq)]
pub struct Visibility {
    size: RasterSize,
    eye: Eye,
    hits: Vec<Hit>,
}

impl Visibility {
    /// Finds what each sample of a picture sees of a mesh, the nearest triangle from either side; none if stopped.
    ///
    /// The same for any number of threads. Triangles that hold no sample's center are passed over.
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
            let mut square = Tile::default();
            for column in 0..across {
                if stop.is_set() {
                    return;
                }
                let tile = band * across + column;
                if bins.iter().any(|bins| !bins.is_empty(tile)) {
                    square.draw(tile, &scene, [column * TILE, band * TILE]);
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

    /// What each sample sees, row by row from the top left.
    pub fn hits(&self) -> &[Hit] {
        &self.hits
    }

    /// Where samples look.
    pub fn rays(&self) -> Rays {
        Rays::new(self.size, &self.eye)
    }
}

/// Where samples look: x and y of a ray that goes one ahead.
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

    fn x(&self, column: usize) -> f64 {
        self.left + (column as f64 + 0.5) * self.step
    }

    fn y(&self, row: usize) -> f64 {
        self.top - (row as f64 + 0.5) * self.step
    }
}

/// A vertex before the eye.
#[derive(Clone, Copy)]
struct Corner {
    /// In view coordinates, ahead positive.
    place: DVec3,
    /// Where it is seen, in samples from the left and the top; nowhere behind the eye.
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

    /// All samples if the triangle reaches behind the eye.
    fn new(corners: [&Corner; 3], size: RasterSize) -> Self {
        let (columns, rows) = (size.columns(), size.rows());
        let [Some(a), Some(b), Some(c)] = corners.map(|corner| corner.seen) else {
            let hidden = corners.iter().all(|corner| corner.seen.is_none());
            return if hidden { Self::EMPTY } else { Self([0, columns as u16, 0, rows as u16]) };
        };
        let [left, right] = span(a[0].min(b[0]).min(c[0]), a[0].max(b[0]).max(c[0]), columns);
        let [top, bottom] = span(a[1].min(b[1]).min(c[1]), a[1].max(b[1]).max(c[1]), rows);
        Self([left, right, top, bottom])
    }

    fn is_empty(self) -> bool {
        let [left, right, top, bottom] = self.0;
        left >= right || top >= bottom
    }

    fn tiles(self, across: usize) -> impl Iterator<Item = usize> {
        let [left, right, top, bottom] = self.0.map(usize::from);
        let rows = if self.is_empty() { 0..0 } else { top / TILE..bottom.div_ceil(TILE) };
        rows.flat_map(move |y| (left / TILE..right.div_ceil(TILE)).map(move |x| y * across + x))
    }
}

/// The samples with centers between two places counted in samples, one more at either side against rounding; casts
/// saturate, so that any place is one.
fn span(from: f64, to: f64, count: usize) -> [u16; 2] {
    const SLACK: f64 = 1e-6;
    let first = (from + (0.5 - SLACK)).max(0.0) as usize;
    let end = (to + (0.5 + SLACK)).max(0.0) as usize;
    [first.min(count) as u16, end.min(count) as u16]
}

/// Triangles that one task sorts into tiles.
const RUN: usize = 8192;

/// The triangles of one run that each tile may show, in ascending order.
struct Bins {
    /// The run's first triangle.
    first: u32,
    extents: Vec<Extent>,
    starts: Vec<u32>,
    ids: Vec<u32>,
}

impl Bins {
    /// Sorts a run of triangles into tiles.
    fn new(first: usize, triangles: &[[u32; 3]], corners: &[Corner], size: RasterSize) -> Self {
        let [across, down] = size.tiles();
        let extent = |triangle: &[u32; 3]| Extent::new(triangle.map(|i| &corners[i as usize]), size);
        let extents: Vec<Extent> = triangles.iter().map(extent).collect();
        let mut starts = vec![0_u32; across * down + 1];
        for extent in &extents {
            extent.tiles(across).for_each(|tile| starts[tile + 1] += 1);
        }
        for tile in 0..across * down {
            starts[tile + 1] += starts[tile];
        }
        let mut next = starts.clone();
        let mut ids = vec![0; *next.last().unwrap_or(&0) as usize];
        for (id, extent) in extents.iter().enumerate() {
            for tile in extent.tiles(across) {
                ids[next[tile] as usize] = id as u32;
                next[tile] += 1;
            }
        }
        Self { first: first as u32, extents, starts, ids }
    }

    /// The run's triangles in a tile, with the samples they may cover.
    fn of(&self, tile: usize) -> impl Iterator<Item = (u32, Extent)> {
        let ids = &self.ids[self.starts[tile] as usize..self.starts[tile + 1] as usize];
        ids.iter().map(|&id| (self.first + id, self.extents[id as usize]))
    }

    fn is_empty(&self, tile: usize) -> bool {
        self.starts[tile] == self.starts[tile + 1]
    }
}

/// What all tiles are drawn from.
struct Scene<'a> {
    triangles: &'a [[u32; 3]],
    corners: &'a [Corner],
    bins: &'a [Bins],
    rays: &'a Rays,
}

/// A square of samples being drawn: the nearest hit so far and one over its depth.
struct Tile {
    hits: [Hit; TILE * TILE],
    nearness: [f64; TILE * TILE],
}

impl Default for Tile {
    fn default() -> Self {
        Self { hits: [Hit::NOTHING; TILE * TILE], nearness: [0.0; TILE * TILE] }
    }
}

impl Tile {
    /// Draws what a tile may show; its left and top samples are given.
    fn draw(&mut self, tile: usize, scene: &Scene<'_>, [left, top]: [usize; 2]) {
        *self = Self::default();
        for (id, extent) in scene.bins.iter().flat_map(|bins| bins.of(tile)) {
            let corners = scene.triangles[id as usize].map(|i| scene.corners[i as usize].place);
            let [from, to, above, below] = extent.0.map(usize::from);
            let across = from.max(left) - left..to.min(left + TILE) - left;
            let down = above.max(top) - top..below.min(top + TILE) - top;
            self.triangle(id, corners, scene.rays, [left, top], [across, down]);
        }
    }

    /// Writes the samples of a triangle that are nearer than what was there; the first of equals stays.
    fn triangle(
        &mut self,
        id: u32,
        [a, b, c]: [DVec3; 3],
        rays: &Rays,
        [left, top]: [usize; 2],
        [across, down]: [Range<usize>; 2],
    ) {
        if self.hides(a.z.min(b.z).min(c.z), &across, &down) {
            return;
        }
        let edges = [b.cross(c), c.cross(a), a.cross(b)];
        let volume = a.dot(edges[0]);
        if volume == 0.0 || !volume.is_finite() {
            return;
        }
        // Seen from the other side all signs are turned; a sample on an edge belongs to one side of it alone.
        let edges = if volume < 0.0 { edges.map(|edge| -edge) } else { edges };
        let volume = volume.abs();
        for row in down {
            let y = rays.y(top + row);
            let bases = edges.map(|edge| edge.y * y + edge.z);
            for column in across.clone() {
                let x = rays.x(left + column);
                let e = [0, 1, 2].map(|k: usize| edges[k].x * x + bases[k]);
                let inside = (0..3).all(|k| e[k] > 0.0 || (e[k] == 0.0 && owns_its_border(edges[k])));
                if !inside {
                    continue;
                }
                let sum = e[0] + e[1] + e[2];
                let nearness = sum / volume;
                let at = row * TILE + column;
                if nearness > self.nearness[at] {
                    self.nearness[at] = nearness;
                    let share = 1.0 / sum;
                    self.hits[at] = Hit { triangle: id, weights: [(e[1] * share) as f32, (e[2] * share) as f32] };
                }
            }
        }
    }

    /// Whether all of these samples see something nearer than a depth, with a margin above rounding.
    fn hides(&self, depth: f64, across: &Range<usize>, down: &Range<usize>) -> bool {
        depth > 0.0
            && down.clone().all(|row| {
                let line = &self.nearness[row * TILE..][across.clone()];
                line.iter().all(|nearness| nearness * depth > 1.0 + 1e-9)
            })
    }

    fn store(&self, rows: &mut [Hit], left: usize, columns: usize) {
        let width = TILE.min(columns - left);
        for (row, line) in rows.chunks_exact_mut(columns).enumerate() {
            line[left..left + width].copy_from_slice(&self.hits[row * TILE..row * TILE + width]);
        }
    }
}

/// Which of two neighbors has the samples exactly on their common edge: the one into which the edge's normal points to
/// positive x, else y, else z; the other's normal is the opposite.
fn owns_its_border(edge: DVec3) -> bool {
    let first = [edge.x, edge.y, edge.z].into_iter().find(|v| *v != 0.0);
    first.is_some_and(|v| v > 0.0)
}
