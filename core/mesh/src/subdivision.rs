//! Catmull–Clark subdivision (1978) of closed surfaces of quadrilaterals, as triangles on the limit surface.
//!
//! Every vertex is on the limit surface and has its normal, by the masks of Halstead, Kass and `DeRose` (1993). The number of
//! triangles is free: all edges are halved equally often, then the longest again, each together with all that lie
//! opposite to it across quadrilaterals, so that neighbors share all their vertices.

use crate::{Mesh, MeshError};
use glam::Vec3;
use rayon::prelude::*;
use std::f32::consts::TAU;

/// A closed surface of quadrilaterals that are counter-clockwise seen from outside.
///
/// Half-edge 4 f + k runs along side k of quadrilateral f.
pub(crate) struct Surface {
    positions: Vec<Vec3>,
    /// The vertex at which each half-edge begins.
    origin: Vec<u32>,
    /// The half-edge on the other side of the edge.
    twin: Vec<u32>,
    /// The edge to which each half-edge belongs.
    edge: Vec<u32>,
    /// The strip of each edge: edges opposite to one another across quadrilaterals are of one strip.
    strip: Vec<u32>,
}

fn next(half_edge: usize) -> usize {
    half_edge & !3 | (half_edge + 1) & 3
}

fn previous(half_edge: usize) -> usize {
    half_edge & !3 | (half_edge + 3) & 3
}

impl Surface {
    /// Joins quadrilaterals at their edges; none unless each edge has exactly two that pass it in opposite directions.
    pub(crate) fn new(positions: Vec<Vec3>, quads: &[[u32; 4]]) -> Option<Self> {
        let origin = quads.as_flattened().to_vec();
        let end = |h: usize| origin[next(h)];
        let key = |h: usize| (origin[h].min(end(h)), origin[h].max(end(h)));
        let mut sorted: Vec<usize> = (0..origin.len()).collect();
        sorted.sort_unstable_by_key(|&h| (key(h), h));
        let (mut twin, mut edge) = (vec![0; origin.len()], vec![0; origin.len()]);
        let (pairs, rest) = sorted.as_chunks::<2>();
        for (id, &[a, b]) in pairs.iter().enumerate() {
            if origin[a] != end(b) || origin[b] != end(a) || origin[a] as usize >= positions.len() {
                return None;
            }
            (twin[a], twin[b]) = (b as u32, a as u32);
            (edge[a], edge[b]) = (id as u32, id as u32);
        }
        let alone = pairs.windows(2).all(|two| key(two[0][0]) != key(two[1][0]));
        let strip = strips(&edge, pairs.len());
        (!quads.is_empty() && rest.is_empty() && alone).then_some(Self { positions, origin, twin, edge, strip })
    }

    fn faces(&self) -> usize {
        self.origin.len() / 4
    }

    /// The surface with each quadrilateral cut into four: vertices first, then edges' points, then faces'.
    fn refined(&self) -> Self {
        let (vertices, edges) = (self.positions.len(), self.strip.len());
        let corner = |h: usize| self.positions[self.origin[h] as usize];
        let centers: Vec<Vec3> =
            (0..self.faces()).map(|f| (4 * f..4 * f + 4).map(corner).sum::<Vec3>() / 4.0).collect();
        let mut edge_points = vec![Vec3::ZERO; edges];
        // Faces' points and neighbors around each vertex, and their number.
        let mut rings = vec![(Vec3::ZERO, 0.0_f32); vertices];
        let count = self.origin.len();
        let (mut origin, mut twin, mut edge) =
            (Vec::with_capacity(4 * count), Vec::with_capacity(4 * count), Vec::with_capacity(4 * count));
        let mut strip = vec![0; 2 * edges + count];
        // Halves of an edge are numbered by the half-edge that begins at them, the lower one first.
        let half = |h: usize| 2 * self.edge[h] + u32::from(self.twin[h] < h as u32);
        for h in 0..count {
            let (before, face, across) = (previous(h), h / 4, self.twin[h] as usize);
            edge_points[self.edge[h] as usize] += (centers[face] + corner(h)) / 4.0;
            let ring = &mut rings[self.origin[h] as usize];
            *ring = (ring.0 + centers[face] + corner(next(h)), ring.1 + 1.0);
            // Child quadrilateral h: corner, point of the edge ahead, center, point of the edge behind.
            let point = |h: usize| vertices as u32 + self.edge[h];
            origin.extend([self.origin[h], point(h), (vertices + edges + face) as u32, point(before)]);
            let of = |child: usize, side: usize| (4 * child + side) as u32;
            let behind = self.twin[before] as usize;
            twin.extend([of(next(across), 3), of(next(h), 2), of(before, 1), of(behind, 0)]);
            let inner = |h: usize| (2 * edges + h) as u32;
            edge.extend([half(h), inner(h), inner(before), half(behind)]);
            strip[half(h) as usize] = self.strip[self.edge[h] as usize];
            strip[2 * edges + h] = self.strip[self.edge[next(h)] as usize];
        }
        let moved = self.positions.iter().zip(rings).map(|(&v, (ring, n))| ((n - 2.0) * v + ring / n) / n);
        let positions = moved.chain(edge_points).chain(centers).collect();
        Self { positions, origin, twin, edge, strip }
    }

    /// Triangles on the limit surface, about as many as requested: at least two for each quadrilateral.
    pub(crate) fn limit(self, triangles: usize) -> Result<Mesh, MeshError> {
        let mut surface = self;
        while 8 * surface.faces() <= triangles {
            surface = surface.refined();
        }
        let halved = surface.longest_strips(triangles);
        let fine = surface.refined();
        let quads = surface.cut(&halved);
        // Vertices in the order of their first use, so that neighbors lie near one another in memory.
        let mut places = vec![u32::MAX; fine.positions.len()];
        let mut used = Vec::new();
        for &vertex in quads.as_flattened() {
            if places[vertex as usize] == u32::MAX {
                places[vertex as usize] = used.len() as u32;
                used.push(vertex);
            }
        }
        let mut outgoing = vec![0; fine.positions.len()];
        for (half_edge, &vertex) in fine.origin.iter().enumerate() {
            outgoing[vertex as usize] = half_edge;
        }
        let masks: Vec<Vec<[f32; 4]>> = (0..=fine.valence(&outgoing)).map(mask).collect();
        let limits: Vec<(Vec3, Vec3)> =
            used.par_iter().with_min_len(1024).map(|&v| fine.limit_at(outgoing[v as usize], &masks)).collect();
        let (positions, normals): (Vec<Vec3>, Vec<Vec3>) = limits.into_iter().unzip();
        let cut = |quad: &[u32; 4]| {
            let [a, b, c, d] = quad.map(|v| places[v as usize]);
            let length2 = |from: u32, to: u32| positions[from as usize].distance_squared(positions[to as usize]);
            // Along the shorter diagonal.
            if length2(a, c) <= length2(b, d) { [[a, b, c], [a, c, d]] } else { [[b, c, d], [b, d, a]] }
        };
        let triangles = quads.iter().flat_map(cut).collect();
        Mesh::new(positions, normals, triangles)
    }

    /// Marks the strips to be halved again: the longest edges first, until about the requested number of triangles is
    /// reached.
    fn longest_strips(&self, triangles: usize) -> Vec<bool> {
        let count = self.strip.iter().max().map_or(0, |&last| last as usize + 1);
        let mut lengths = vec![(0.0_f32, 0.0_f32); count];
        for (h, &edge) in self.edge.iter().enumerate() {
            let ends = [h, next(h)].map(|h| self.positions[self.origin[h] as usize]);
            let (sum, edges) = &mut lengths[self.strip[edge as usize] as usize];
            (*sum, *edges) = (*sum + ends[0].distance(ends[1]), *edges + 1.0);
        }
        let mut order: Vec<usize> = (0..count).collect();
        order.sort_by(|&a, &b| (lengths[b].0 / lengths[b].1).total_cmp(&(lengths[a].0 / lengths[a].1)));
        let mut rank = vec![0; count];
        order.iter().enumerate().for_each(|(at, &strip)| rank[strip] = at);
        let made = |halved: usize| {
            let pieces = |h: usize| 1 + usize::from(rank[self.strip[self.edge[h] as usize] as usize] < halved);
            (0..self.faces()).map(|f| 2 * pieces(4 * f) * pieces(4 * f + 1)).sum::<usize>()
        };
        // The first number of strips that makes too many, or one fewer where that is nearer.
        let (mut low, mut high) = (0, count);
        while low < high {
            let middle = usize::midpoint(low, high);
            if made(middle) < triangles { low = middle + 1 } else { high = middle }
        }
        if low > 0 && triangles.abs_diff(made(low - 1)) < triangles.abs_diff(made(low)) {
            low -= 1;
        }
        rank.into_iter().map(|rank| rank < low).collect()
    }

    /// Quadrilaterals, cut across the edges whose strip is halved, as indices of the refined surface's vertices.
    fn cut(&self, halved: &[bool]) -> Vec<[u32; 4]> {
        let (vertices, edges) = (self.positions.len() as u32, self.strip.len() as u32);
        let mut quads = Vec::new();
        for face in 0..self.faces() {
            let corners: [u32; 4] = std::array::from_fn(|k| self.origin[4 * face + k]);
            let points: [u32; 4] = std::array::from_fn(|k| vertices + self.edge[4 * face + k]);
            let is_halved = |k: usize| halved[self.strip[self.edge[4 * face + k] as usize] as usize];
            let ([a, b, c, d], [ab, bc, cd, da]) = (corners, points);
            match (is_halved(0), is_halved(1)) {
                (false, false) => quads.push(corners),
                (true, false) => quads.extend([[a, ab, cd, d], [ab, b, c, cd]]),
                (false, true) => quads.extend([[a, b, bc, da], [da, bc, c, d]]),
                (true, true) => {
                    let center = vertices + edges + face as u32;
                    quads.extend((0..4).map(|k| [corners[k], points[k], center, points[(k + 3) % 4]]));
                }
            }
        }
        quads
    }

    /// The half-edges around the vertex at which one begins, counter-clockwise.
    fn around(&self, first: usize) -> impl Iterator<Item = usize> {
        let after = move |&h: &usize| Some(self.twin[previous(h)] as usize).filter(|&h| h != first);
        std::iter::successors(Some(first), after)
    }

    fn valence(&self, outgoing: &[usize]) -> usize {
        outgoing.iter().map(|&h| self.around(h).count()).max().unwrap_or(0)
    }

    /// The place and the normal on the limit surface of the vertex at which a half-edge begins.
    fn limit_at(&self, first: usize, masks: &[Vec<[f32; 4]>]) -> (Vec3, Vec3) {
        let corner = |h: usize| self.positions[self.origin[h] as usize];
        let (v, valence) = (corner(first), self.around(first).count());
        let (mut sum, mut tangents) = (Vec3::ZERO, [Vec3::ZERO; 2]);
        for (h, [edge_cos, edge_sin, face_cos, face_sin]) in self.around(first).zip(&masks[valence]) {
            let (edge, face) = (corner(next(h)) - v, corner(next(next(h))) - v);
            sum += 4.0 * edge + face;
            tangents[0] += *edge_cos * edge + *face_cos * face;
            tangents[1] += *edge_sin * edge + *face_sin * face;
        }
        let n = valence as f32;
        (v + sum / (n * (n + 5.0)), tangents[0].cross(tangents[1]).normalize_or_zero())
    }
}

/// The weights of each neighbor and each face's far corner in both tangents, around a vertex of the given valence.
fn mask(valence: usize) -> Vec<[f32; 4]> {
    let step = TAU / valence.max(1) as f32;
    let edge = 1.0 + step.cos() + (step / 2.0).cos() * (2.0 * (9.0 + step.cos())).sqrt();
    let weights = |i: usize| {
        let ((sin, cos), (sin_after, cos_after)) = ((step * i as f32).sin_cos(), (step * (i + 1) as f32).sin_cos());
        [edge * cos, edge * sin, cos + cos_after, sin + sin_after]
    };
    (0..valence).map(weights).collect()
}

/// Numbers the strips of edges: those opposite to one another across quadrilaterals are of one.
fn strips(edge: &[u32], edges: usize) -> Vec<u32> {
    let mut root: Vec<u32> = (0..edges as u32).collect();
    for quad in edge.as_chunks::<4>().0 {
        for k in 0..2 {
            let (a, b) = (find(&mut root, quad[k]), find(&mut root, quad[k + 2]));
            root[a.max(b) as usize] = a.min(b);
        }
    }
    let mut numbers = 0;
    let mut strip = vec![0; edges];
    for at in 0..edges {
        let first = find(&mut root, at as u32) as usize;
        // The root comes first: it has the lowest index of its strip.
        strip[at] = if first == at {
            numbers += 1;
            numbers - 1
        } else {
            strip[first]
        };
    }
    strip
}

/// The lowest edge of a strip, by links that end there; they become shorter.
fn find(root: &mut [u32], mut at: u32) -> u32 {
    while root[at as usize] != at {
        root[at as usize] = root[root[at as usize] as usize];
        at = root[at as usize];
    }
    at
}
