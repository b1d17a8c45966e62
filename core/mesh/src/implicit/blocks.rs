//! Looking for the surface in blocks of cells.

use super::cubes::{Cubes, EDGES};
use super::{Field, Grid};
use glam::Vec3;

/// How many cells a block has along each axis at most.
const SIDE: usize = 4;
/// How many corners a block has along each axis at most.
const CORNERS: usize = SIDE + 1;

/// The surface within one block of cells.
pub(super) struct Block<F> {
    /// The function around the block.
    pub field: F,
    /// A number for each vertex that is the same in all blocks that have it, and its place.
    pub vertices: Vec<Vertex>,
    /// Triangles as indices of the block's vertices.
    pub triangles: Vec<[u32; 3]>,
}

/// Where the surface crosses an edge of the grid.
#[derive(Clone, Copy)]
pub(super) struct Vertex {
    /// The same for the same edge, in whatever block.
    pub key: u64,
    /// On the edge, about where the surface crosses it.
    pub position: Vec3,
    /// Whether the edge lies in the grid's first plane across x.
    pub on_plane: bool,
    /// The size of the cells around, in meters.
    pub cell: f32,
}

/// The blocks that the surface passes, in an order that depends on the grid alone.
pub(super) fn blocks<F: Field + Send>(field: &F, grid: &Grid) -> Vec<Block<F>> {
    let cells = grid.cells();
    if cells.contains(&0) {
        return Vec::new();
    }
    search(field, grid, &Cubes::new(), [[0, cells[0]], [0, cells[1]], [0, cells[2]]])
}

/// Halves a range of cells until it is a block or empty of surface.
fn search<F: Field + Send>(field: &F, grid: &Grid, cubes: &Cubes, range: [[usize; 2]; 3]) -> Vec<Block<F>> {
    let low = grid.corner(range.map(|r| r[0]));
    let high = grid.corner(range.map(|r| r[1]));
    // A cell's width more than the block: vertices move a little when they are evened out.
    let margin = 1.0 + 2.0 / range.iter().map(|r| r[1] - r[0]).min().unwrap_or(1) as f32;
    let Some(near) = field.near(low.midpoint(high), (high - low).length() / 2.0 * margin) else {
        return Vec::new();
    };
    let longest = (0..3).max_by_key(|&a| range[a][1] - range[a][0]).unwrap_or(0);
    let [from, to] = range[longest];
    if to - from <= SIDE {
        return march(near, grid, cubes, range).into_iter().collect();
    }
    let middle = from + ((to - from) / 2).next_multiple_of(SIDE);
    let (mut first, mut second) = (range, range);
    first[longest][1] = middle;
    second[longest][0] = middle;
    let (mut left, right) = rayon::join(|| search(&near, grid, cubes, first), || search(&near, grid, cubes, second));
    left.extend(right);
    left
}

/// Marches through one block's cells.
fn march<F: Field>(field: F, grid: &Grid, cubes: &Cubes, range: [[usize; 2]; 3]) -> Option<Block<F>> {
    let size = range.map(|r| r[1] - r[0]);
    let slot = |[i, j, k]: [usize; 3]| (k * CORNERS + j) * CORNERS + i;
    let mut values = [0.0_f32; CORNERS * CORNERS * CORNERS];
    for at in within(size.map(|n| n + 1)) {
        values[slot(at)] = field.at(grid.corner([0, 1, 2].map(|a| range[a][0] + at[a]))).value;
    }
    let mut found = Found { grid, values: &values, places: vec![u32::MAX; 3 * values.len()], vertices: Vec::new() };
    let mut triangles = Vec::new();
    for at in within(size) {
        let corner = |c: usize| [at[0] + (c & 1), at[1] + (c >> 1 & 1), at[2] + (c >> 2)];
        let inside = (0..8).filter(|&c| values[slot(corner(c))] < 0.0).fold(0_u8, |bits, c| bits | 1 << c);
        for &edges in cubes.triangles(inside) {
            triangles.push(edges.map(|e| {
                let [a, b] = EDGES[usize::from(e)].map(corner);
                found.vertex([slot(a), slot(b)], usize::from(e) / 4, [0, 1, 2].map(|x| range[x][0] + a[x]))
            }));
        }
    }
    let vertices = found.vertices;
    (!triangles.is_empty()).then_some(Block { field, vertices, triangles })
}

/// All index triples below a size.
fn within([nx, ny, nz]: [usize; 3]) -> impl Iterator<Item = [usize; 3]> {
    (0..nz).flat_map(move |k| (0..ny).flat_map(move |j| (0..nx).map(move |i| [i, j, k])))
}

/// The vertices found so far in a block.
struct Found<'a> {
    grid: &'a Grid,
    values: &'a [f32],
    places: Vec<u32>,
    vertices: Vec<Vertex>,
}

impl Found<'_> {
    /// The index of the vertex on the edge between two corners, of which the lower is at `corner` of the grid.
    fn vertex(&mut self, slots: [usize; 2], axis: usize, corner: [usize; 3]) -> u32 {
        let place = 3 * slots[0] + axis;
        if self.places[place] == u32::MAX {
            self.places[place] = self.vertices.len() as u32;
            let mut end = corner;
            end[axis] += 1;
            let (from, to) = (self.grid.corner(corner), self.grid.corner(end));
            let [a, b] = slots.map(|s| self.values[s]);
            // Off the corners, so that no two vertices fall together.
            let share = (a / (a - b)).clamp(0.01, 0.99);
            let [_, ny, nz] = self.grid.cells().map(|n| n as u64 + 1);
            let [i, j, k] = corner.map(|x| x as u64);
            self.vertices.push(Vertex {
                key: ((i * ny + j) * nz + k) * 3 + axis as u64,
                position: from.lerp(to, if share.is_finite() { share } else { 0.5 }),
                on_plane: corner[0] == 0 && axis != 0,
                cell: (to - from).length(),
            });
        }
        self.places[place]
    }
}
