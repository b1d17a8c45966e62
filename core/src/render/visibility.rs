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
const TILE: usize = 32;

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
        let corners: Vec<DVec3> = mesh.positions().par_iter().map(|p| eye.view_from_world(p.as_dvec3())).collect();
        let bins = Bins::new(mesh.triangles(), &corners, &rays, size);
        let mut hits = vec![Hit::NOTHING; size.columns() * size.rows()];
        let [across, _] = size.tiles();
        // A band of tiles is a run of rows, so each is written by one thread alone.
        hits.par_chunks_mut(TILE * size.columns()).enumerate().for_each(|(band, rows)| {
            let mut tile = Tile::default();
            for column in 0..across {
                if stop.is_set() {
                    return;
                }
                let ids = bins.of(band * across + column);
                if !ids.is_empty() {
                    tile.draw(ids, mesh.triangles(), &corners, &rays, [column * TILE, band * TILE], size);
                    tile.store(rows, column * TILE, size.columns());
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

    /// The direction of a sample's ray in view coordinates, one ahead.
    pub fn ray(&self, sample: usize) -> DVec3 {
        let rays = Rays::new(self.size, &self.eye);
        DVec3::new(rays.x(sample % self.size.columns()), rays.y(sample / self.size.columns()), 1.0)
    }
}

/// Where samples look: x and y of a ray that goes one ahead.
struct Rays {
    step: f64,
    left: f64,
    top: f64,
}

impl Rays {
    fn new(size: RasterSize, eye: &Eye) -> Self {
        let step = 2.0 * eye.half_height / size.rows() as f64;
        let left = -0.5 * step * size.columns() as f64;
        Self { step, left, top: eye.half_height }
    }

    fn x(&self, column: usize) -> f64 {
        self.left + (column as f64 + 0.5) * self.step
    }

    fn y(&self, row: usize) -> f64 {
        self.top - (row as f64 + 0.5) * self.step
    }

    /// The columns whose sample centers lie within [from, to] of x, one more at either side against rounding.
    fn columns(&self, from: f64, to: f64, count: usize) -> Range<usize> {
        span((from - self.left) / self.step, (to - self.left) / self.step, count)
    }

    /// The rows whose sample centers lie within [from, to] of y.
    fn rows(&self, from: f64, to: f64, count: usize) -> Range<usize> {
        span((self.top - to) / self.step, (self.top - from) / self.step, count)
    }
}

/// The samples with centers between two places counted in samples; casts saturate, so that any place is one.
fn span(from: f64, to: f64, count: usize) -> Range<usize> {
    const SLACK: f64 = 1e-6;
    let first = (from - 0.5 - SLACK).ceil().max(0.0) as usize;
    let last = (to - 0.5 + SLACK).floor().max(-1.0) + 1.0;
    first.min(count)..(last as usize).min(count)
}

/// The samples that a triangle may cover: columns and rows; all of them if it reaches behind the eye.
fn extent(corners: [DVec3; 3], rays: &Rays, size: RasterSize) -> Option<[Range<usize>; 2]> {
    let behind = corners.iter().filter(|c| c.z <= 0.0).count();
    if behind == 3 {
        return None;
    }
    let (columns, rows) = (size.columns(), size.rows());
    if behind > 0 {
        return Some([0..columns, 0..rows]);
    }
    let x = corners.map(|c| c.x / c.z);
    let y = corners.map(|c| c.y / c.z);
    let across = rays.columns(x[0].min(x[1]).min(x[2]), x[0].max(x[1]).max(x[2]), columns);
    let down = rays.rows(y[0].min(y[1]).min(y[2]), y[0].max(y[1]).max(y[2]), rows);
    (!across.is_empty() && !down.is_empty()).then_some([across, down])
}

/// The triangles that each tile may show, in ascending order.
struct Bins {
    starts: Vec<u32>,
    ids: Vec<u32>,
}

impl Bins {
    fn new(triangles: &[[u32; 3]], corners: &[DVec3], rays: &Rays, size: RasterSize) -> Self {
        let [across, down] = size.tiles();
        let tiles_of = |triangle: &[u32; 3]| -> [u16; 4] {
            match extent(triangle.map(|i| corners[i as usize]), rays, size) {
                Some([x, y]) => [x.start / TILE, (x.end - 1) / TILE, y.start / TILE, (y.end - 1) / TILE]
                    .map(|tile| tile as u16),
                None => [1, 0, 1, 0],
            }
        };
        let places: Vec<[u16; 4]> = triangles.par_iter().map(tiles_of).collect();
        let tiles = |[left, right, top, bottom]: [u16; 4]| {
            (top..=bottom).flat_map(move |y| (left..=right).map(move |x| usize::from(y) * across + usize::from(x)))
        };
        let mut starts = vec![0_u32; across * down + 1];
        for place in &places {
            tiles(*place).for_each(|tile| starts[tile + 1] += 1);
        }
        for tile in 0..across * down {
            starts[tile + 1] += starts[tile];
        }
        let mut next = starts.clone();
        let mut ids = vec![0; *next.last().unwrap_or(&0) as usize];
        for (id, place) in places.iter().enumerate() {
            for tile in tiles(*place) {
                ids[next[tile] as usize] = id as u32;
                next[tile] += 1;
            }
        }
        Self { starts, ids }
    }

    fn of(&self, tile: usize) -> &[u32] {
        &self.ids[self.starts[tile] as usize..self.starts[tile + 1] as usize]
    }
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
    fn draw(
        &mut self,
        ids: &[u32],
        triangles: &[[u32; 3]],
        corners: &[DVec3],
        rays: &Rays,
        [left, top]: [usize; 2],
        size: RasterSize,
    ) {
        *self = Self::default();
        for &id in ids {
            let triangle = triangles[id as usize].map(|i| corners[i as usize]);
            if let Some([across, down]) = extent(triangle, rays, size) {
                let across = across.start.max(left) - left..across.end.min(left + TILE) - left;
                let down = down.start.max(top) - top..down.end.min(top + TILE) - top;
                self.triangle(id, triangle, rays, [left, top], [across, down]);
            }
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
        let edges = [b.cross(c), c.cross(a), a.cross(b)];
        let volume = a.dot(edges[0]);
        if volume == 0.0 || !volume.is_finite() {
            return;
        }
        // Seen from the other side all signs are turned; a sample on an edge belongs to one side of it alone.
        let edges = if volume < 0.0 { edges.map(|edge| -edge) } else { edges };
        let owns = edges.map(owns_its_border);
        let scale = 1.0 / volume.abs();
        for row in down {
            let y = rays.y(top + row);
            let bases = edges.map(|edge| edge.y * y + edge.z);
            for column in across.clone() {
                let x = rays.x(left + column);
                let e = [0, 1, 2].map(|k: usize| edges[k].x * x + bases[k]);
                let inside = (0..3).all(|k| e[k] > 0.0 || (e[k] == 0.0 && owns[k]));
                if !inside {
                    continue;
                }
                let sum = e[0] + e[1] + e[2];
                let nearness = sum * scale;
                let at = row * TILE + column;
                if nearness > self.nearness[at] {
                    self.nearness[at] = nearness;
                    self.hits[at] = Hit { triangle: id, weights: [(e[1] / sum) as f32, (e[2] / sum) as f32] };
                }
            }
        }
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
