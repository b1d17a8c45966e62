//! Edges of a mesh: open, doubled or flipped ones, and corners that share a computed normal.

use super::build::usable;
use super::report::{MeshReadError, Tally};
use super::soup::{NONE, Smoothing, Soup};
use super::triangulate::Cut;
use glam::Vec3;
use rayon::prelude::*;

/// Faces that meet at more than this angle keep an edge between them where the file names no smoothing: its cosine, of 60°.
const CREASE_COSINE: f32 = 0.5;

/// Positions between two looks at whether to stop.
const STOP_EVERY: usize = 1 << 16;

pub(super) struct Edges {
    pub(super) non_manifold: Tally,
    pub(super) duplicates: Tally,
    pub(super) boundary: usize,
    pub(super) flipped: Tally,
    pub(super) unused: usize,
    /// For each corner of each triangle the parent in its fan's tree, in the end the root; empty where the file has all
    /// normals.
    parents: Vec<u32>,
}

impl Edges {
    /// True if each edge has two triangles that agree.
    pub(super) fn is_closed(&self) -> bool {
        self.boundary == 0 && self.non_manifold.count == 0 && self.flipped.count == 0
    }

    /// The fan of a triangle's corner (three times the triangle, plus 0 to 2): corners of a fan share their normal.
    pub(super) fn fan(&self, corner: u32) -> u32 {
        self.parents.get(corner as usize).copied().unwrap_or(NONE)
    }
}

/// One side of an edge: the vertex of higher index, and the corner at which the triangle comes to it.
type Side = (u32, u32);

pub(super) fn survey(soup: &Soup, cut: &Cut, stop: &dyn Fn() -> bool) -> Result<Edges, MeshReadError> {
    let (starts, mut sides) = sides(soup, cut);
    let needed = cut.triangles.as_flattened().iter().any(|&c| usable(soup, soup.corners[c as usize].normal) == NONE);
    let mut edges = Edges {
        non_manifold: Tally::default(),
        duplicates: Tally::default(),
        boundary: 0,
        flipped: Tally::default(),
        unused: unused(soup, cut),
        parents: if needed { (0..3 * cut.triangles.len() as u32).collect() } else { Vec::new() },
    };
    let normals = if needed { normals(soup, cut) } else { Vec::new() };
    let mut suspects = Vec::new();
    for position in 0..soup.positions.len() {
        if position % STOP_EVERY == 0 && stop() {
            return Err(MeshReadError::Stopped);
        }
        let around = &mut sides[starts[position] as usize..starts[position + 1] as usize];
        around.sort_unstable();
        for edge in around.chunk_by(|a, b| a.0 == b.0) {
            edges.look(soup, cut, &normals, edge, &mut suspects);
        }
    }
    // A parent is below its child, so that going upwards each finds its parent's root.
    for corner in 0..edges.parents.len() {
        edges.parents[corner] = edges.parents[edges.parents[corner] as usize];
    }
    edges.duplicates = duplicates(soup, cut, suspects);
    Ok(edges)
}

impl Edges {
    fn look(&mut self, soup: &Soup, cut: &Cut, normals: &[Vec3], edge: &[Side], suspects: &mut Vec<u32>) {
        let place = |side: &Side| soup.place(cut.faces[side.1 as usize / 3] as usize);
        let agree = |a: &Side, b: &Side| position(soup, cut, a.1) != position(soup, cut, b.1);
        match edge {
            [_] => self.boundary += 1,
            [a, b] if agree(a, b) => {}
            [a, b] => {
                self.flipped.add(place(a));
                suspects.extend([a.1 / 3, b.1 / 3]);
            }
            _ => {
                self.non_manifold.add(place(&edge[0]));
                suspects.extend(edge.iter().map(|side| side.1 / 3));
            }
        }
        if self.parents.is_empty() {
            return;
        }
        for pair in edge.windows(2) {
            let [a, b] = [pair[0].1, pair[1].1];
            if agree(&pair[0], &pair[1]) && is_smooth(soup, cut, normals, [a / 3, b / 3]) {
                // The one triangle comes from where the other goes to.
                join(&mut self.parents, a, next(b));
                join(&mut self.parents, next(a), b);
            }
        }
    }
}

fn next(corner: u32) -> u32 {
    if corner % 3 == 2 { corner - 2 } else { corner + 1 }
}

fn position(soup: &Soup, cut: &Cut, corner: u32) -> u32 {
    soup.corners[cut.triangles.as_flattened()[corner as usize] as usize].position
}

/// All sides of edges, gathered by the vertex of lower index: where each vertex's begin, and the sides.
fn sides(soup: &Soup, cut: &Cut) -> (Vec<u32>, Vec<Side>) {
    let count = 3 * cut.triangles.len() as u32;
    let ends = |corner: u32| [position(soup, cut, corner), position(soup, cut, next(corner))];
    let mut starts = vec![0_u32; soup.positions.len() + 1];
    for corner in 0..count {
        let [a, b] = ends(corner);
        starts[a.min(b) as usize] += 1;
    }
    let mut sum = 0;
    for start in &mut starts {
        sum += *start;
        *start = sum;
    }
    let mut sides = vec![(0, 0); count as usize];
    // Filling from the back turns each vertex's end into its beginning.
    for corner in (0..count).rev() {
        let [a, b] = ends(corner);
        let slot = &mut starts[a.min(b) as usize];
        *slot -= 1;
        sides[*slot as usize] = (a.max(b), corner);
    }
    (starts, sides)
}

fn unused(soup: &Soup, cut: &Cut) -> usize {
    let mut used = vec![false; soup.positions.len()];
    for &corner in cut.triangles.as_flattened() {
        used[soup.corners[corner as usize].position as usize] = true;
    }
    used.iter().filter(|used| !**used).count()
}

fn is_smooth(soup: &Soup, cut: &Cut, normals: &[Vec3], pair: [u32; 2]) -> bool {
    let [f, g] = pair.map(|t| cut.faces[t as usize]);
    if f == g {
        return true;
    }
    match (soup.smoothing(f), soup.smoothing(g)) {
        (Smoothing::Group(s), Smoothing::Group(t)) => s == t,
        (Smoothing::Auto, Smoothing::Auto) => {
            let [m, n] = pair.map(|t| normals[t as usize]);
            m.dot(n) >= CREASE_COSINE
        }
        _ => false,
    }
}

/// The unit normals of all triangles, of which none is without area.
fn normals(soup: &Soup, cut: &Cut) -> Vec<Vec3> {
    let at = |corner: u32| soup.positions[soup.corners[corner as usize].position as usize].as_dvec3();
    let normal = |triangle: &[u32; 3]| {
        let [a, b, c] = triangle.map(at);
        (b - a).cross(c - a).normalize_or_zero().as_vec3()
    };
    cut.triangles.par_iter().map(normal).collect()
}

/// Triangles among these on the same three vertices as an earlier one.
fn duplicates(soup: &Soup, cut: &Cut, mut suspects: Vec<u32>) -> Tally {
    suspects.sort_unstable();
    suspects.dedup();
    let mut keys: Vec<([u32; 3], u32)> = suspects
        .into_iter()
        .map(|t| {
            let mut key = [0, 1, 2].map(|k| position(soup, cut, 3 * t + k));
            key.sort_unstable();
            (key, t)
        })
        .collect();
    keys.sort_unstable();
    let mut tally = Tally::default();
    for pair in keys.windows(2).filter(|pair| pair[0].0 == pair[1].0) {
        tally.add(soup.place(cut.faces[pair[1].1 as usize] as usize));
    }
    tally
}

fn root(parents: &[u32], mut corner: u32) -> u32 {
    while parents[corner as usize] != corner {
        corner = parents[corner as usize];
    }
    corner
}

/// Joins two corners' trees under the lower root, with path compression.
fn join(parents: &mut [u32], a: u32, b: u32) {
    let low = root(parents, a).min(root(parents, b));
    for mut corner in [a, b] {
        while parents[corner as usize] > low {
            corner = std::mem::replace(&mut parents[corner as usize], low);
        }
    }
}
