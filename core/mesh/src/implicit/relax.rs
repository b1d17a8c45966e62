//! Evening out the vertices along the surface.

use super::weld::Half;
use super::{Field, Sample};
use crate::mesh::smooth_normals;
use glam::Vec3;
use rayon::prelude::*;

/// How often each vertex is moved towards the middle of its neighbors.
const ROUNDS: usize = 4;
/// How far it is moved there.
const SHARE: f32 = 0.6;

/// The cosine between a vertex's normal and its triangles' from which on it is left, and up to which it is replaced.
const AGREEMENT: [f32; 2] = [0.95, 0.6];

/// Brings vertices onto the surface and away from their nearest neighbors: marching cubes' slivers become triangles of
/// about one size.
pub(super) fn relax<F: Field>(half: &mut Half<F>) {
    let mut normals = project(half, 1);
    for _ in 0..ROUNDS {
        let middles = middles(half);
        normals = move_all(half, |at, p, cell, v| {
            let step = (middles[v] - p) * SHARE;
            let aside = step - normals[v] * step.dot(normals[v]);
            onto(at, p + aside.clamp_length_max(0.5 * cell), cell)
        });
    }
}

/// Brings the vertices onto the surface by Newton's steps, and gives the normals there.
pub(super) fn project<F: Field>(half: &mut Half<F>, steps: usize) -> Vec<Vec3> {
    move_all(half, |at, p, cell, _| (0..steps).fold(p, |p, _| onto(at, p, cell)))
}

/// Brings normals that differ from their triangles' towards these.
pub(super) fn agree<F>(half: &Half<F>, normals: &mut [Vec3]) {
    let means = smooth_normals(&half.positions, &half.triangles);
    for (v, (normal, mut mean)) in normals.iter_mut().zip(means).enumerate() {
        if half.on_plane[v] {
            // The mirrored triangles make up for x.
            mean = Vec3::new(0.0, mean.y, mean.z).normalize_or(*normal);
        }
        let share = ((AGREEMENT[0] - normal.dot(mean)) / (AGREEMENT[0] - AGREEMENT[1])).clamp(0.0, 1.0);
        *normal = normal.lerp(mean, share).normalize_or(mean);
    }
}

/// One of Newton's steps, not longer than a part of a cell.
fn onto(at: &dyn Fn(Vec3) -> Sample, p: Vec3, cell: f32) -> Vec3 {
    let Sample { value, gradient } = at(p);
    let step = gradient * (value / gradient.length_squared().max(0.05));
    p - step.clamp_length_max(0.5 * cell)
}

/// Moves each vertex, those on the plane x = 0 within it and the others on their side, and gives the normals there.
fn move_all<F: Field>(
    half: &mut Half<F>,
    moved: impl Fn(&dyn Fn(Vec3) -> Sample, Vec3, f32, usize) -> Vec3 + Sync,
) -> Vec<Vec3> {
    let place = |v: usize, field: &F| {
        let (p, cell) = (half.positions[v], half.cell[v]);
        let at = |p: Vec3| field.at(p);
        let mut q = moved(&at, p, cell, v);
        q.x = if half.on_plane[v] { 0.0 } else { q.x.max(0.01 * cell) };
        let mut normal = field.at(q).gradient;
        if half.on_plane[v] {
            normal.x = 0.0;
        }
        (q, normal.normalize_or(Vec3::Z))
    };
    let placed: Vec<Vec<(Vec3, Vec3)>> = half
        .fields
        .par_iter()
        .with_min_len(4)
        .map(|(range, field)| range.clone().map(|v| place(v, field)).collect())
        .collect();
    let mut normals = Vec::with_capacity(half.positions.len());
    for (v, (p, normal)) in placed.into_iter().flatten().enumerate() {
        half.positions[v] = p;
        normals.push(normal);
    }
    normals
}

/// The mean of each vertex's neighbors in the whole mesh, the mirrored ones too.
fn middles<F>(half: &Half<F>) -> Vec<Vec3> {
    let mut sums = vec![(Vec3::ZERO, 0.0_f32); half.positions.len()];
    for triangle in &half.triangles {
        for k in 0..3 {
            let [a, b] = [triangle[k], triangle[(k + 1) % 3]].map(|v| v as usize);
            let both = half.on_plane[a] && half.on_plane[b];
            // An edge is met once from each side; an edge in the plane only once here, and its neighbor across is b's.
            add(&mut sums[a], half.positions[b]);
            if both {
                add(&mut sums[b], half.positions[a]);
            } else if half.on_plane[a] {
                add(&mut sums[a], half.positions[b]);
            }
        }
    }
    sums.into_iter().map(|(sum, count)| sum / count.max(1.0)).collect()
}

fn add(sum: &mut (Vec3, f32), p: Vec3) {
    sum.0 += p;
    sum.1 += 1.0;
}
