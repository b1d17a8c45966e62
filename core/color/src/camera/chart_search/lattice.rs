//! Lattices of neighboring quadrilaterals.

use std::collections::BTreeMap;

use chromascope_math::dense::Cholesky;
use glam::{DMat3, DVec2};

use super::found::project;
use super::quads::Quad;

/// Rounds in which a lattice is extended.
const PASSES: usize = 4;
/// Distance of a quadrilateral from its cell's middle, as a share of the distance between cells.
const OFF: f64 = 0.15;
/// Fewest quadrilaterals of a lattice.
pub(super) const FEWEST: usize = 7;
/// Most cells from the first one, each way.
const REACH: i32 = 8;
/// Distance between a neighbor and its expected place, as a share of the distance between neighbors.
const NEAR: f64 = 0.25;
/// Ratio of two neighbors' areas.
const ALIKE: std::ops::Range<f64> = 0.5..2.0;
/// Sine of the largest angle between a neighbor's sides and the steps to neighbors.
const ASKEW: f64 = 0.25;
/// Cells nearest to the first one that the first homography is fitted to.
const FIRST: usize = 12;

/// Quadrilaterals at whole coordinates of a plane in perspective.
#[derive(Debug)]
pub(super) struct Lattice {
    /// Index of the quadrilateral at each cell.
    pub cells: BTreeMap<[i32; 2], usize>,
    pub low: [i32; 2],
    pub high: [i32; 2],
    /// Homography of cells' centers, at whole coordinates, into the picture.
    pub picture_from_cells: DMat3,
}

/// Lattices in which quadrilaterals lie, none in two of them.
pub(super) fn lattices(quads: &[Quad]) -> Vec<Lattice> {
    let mut taken = vec![false; quads.len()];
    let mut lattices = Vec::new();
    for seed in 0..quads.len() {
        if taken[seed] {
            continue;
        }
        let Some(lattice) = fitted(grown(seed, quads), quads) else { continue };
        let fresh = lattice.cells.values().filter(|index| !taken[**index]).count();
        lattice.cells.values().for_each(|index| taken[*index] = true);
        if 2 * fresh >= lattice.cells.len() {
            lattices.push(lattice);
        }
    }
    lattices
}

/// Middle of a cell in the lattice's coordinates.
pub(super) fn point(cell: [i32; 2]) -> DVec2 {
    DVec2::new(f64::from(cell[0]), f64::from(cell[1]))
}

/// Nearest quadrilateral of a size and with sides along two steps to a place, within a distance.
fn nearest(quads: &[Quad], place: DVec2, within: f64, area: f64, steps: [DVec2; 2]) -> Option<usize> {
    let askew = |side: DVec2, step: DVec2| (side.perp_dot(step) / (side.length() * step.length())).abs() > ASKEW;
    let fits = |quad: &Quad| {
        let [a, b] = quad.sides;
        let turned = |a, b| !askew(a, steps[0]) && !askew(b, steps[1]);
        ALIKE.contains(&(quad.area / area)) && (turned(a, b) || turned(b, a))
    };
    let candidate = |(index, quad): (usize, &Quad)| {
        let distance = quad.center.distance(place);
        (distance < within && fits(quad)).then_some((distance, index))
    };
    quads.iter().enumerate().filter_map(candidate).min_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, index)| index)
}

/// Cells reached from one quadrilateral by steps to neighbors, the nearest first.
fn grown(seed: usize, quads: &[Quad]) -> Vec<([i32; 2], usize)> {
    let own = quads[seed];
    // The gap is unknown: neighbors are looked for from 1.05 to 1.8 sides away.
    let step = |side: DVec2| {
        let neighbor = |stretch: f64| {
            let found = [side, -side]
                .map(|side| nearest(quads, own.center + side * stretch, 0.12 * side.length(), own.area, own.sides));
            let signed = [(found[0], 1.0), (found[1], -1.0)];
            signed.into_iter().find_map(|(index, sign)| Some((quads[index?].center - own.center) * sign))
        };
        [1.05, 1.15, 1.25, 1.35, 1.5, 1.65, 1.8].into_iter().find_map(neighbor)
    };
    let (first, second) = (step(own.sides[0]), step(own.sides[1]));
    let stretch = |step: DVec2, side: DVec2| step.length() / side.length();
    let steps = match (first, second) {
        (Some(first), Some(second)) => [first, second],
        (Some(first), None) => [first, own.sides[1] * stretch(first, own.sides[0])],
        (None, Some(second)) => [own.sides[0] * stretch(second, own.sides[1]), second],
        (None, None) => return Vec::new(),
    };
    let mut cells = vec![([0, 0], seed)];
    let mut onward = vec![steps];
    let mut used = vec![false; quads.len()];
    used[seed] = true;
    let mut next = 0;
    while next < cells.len() {
        let (cell, here, steps) = (cells[next].0, quads[cells[next].1], onward[next]);
        next += 1;
        for (axis, sign) in [(0, 1), (0, -1), (1, 1), (1, -1)] {
            let mut there: [i32; 2] = cell;
            there[axis] += sign;
            if there[axis].abs() > REACH || cells.iter().any(|(cell, _)| *cell == there) {
                continue;
            }
            let step = steps[axis] * f64::from(sign);
            let found = nearest(quads, here.center + step, NEAR * step.length(), here.area, steps);
            let Some(index) = found.filter(|index| !std::mem::replace(&mut used[*index], true)) else { continue };
            cells.push((there, index));
            let mut steps = steps;
            steps[axis] = (quads[index].center - here.center) * f64::from(sign);
            onward.push(steps);
        }
    }
    cells
}

/// The lattice's homography: fitted to the first cells, then to all quadrilaterals at the cells' places as far as two cells beyond those
/// found, again and again.
fn fitted(grown: Vec<([i32; 2], usize)>, quads: &[Quad]) -> Option<Lattice> {
    let mut cells: BTreeMap<[i32; 2], usize> = grown.into_iter().take(FIRST).collect();
    for pass in 0..=PASSES {
        if cells.len() < FEWEST {
            return None;
        }
        let pairs: Vec<[DVec2; 2]> = cells.iter().map(|(cell, index)| [point(*cell), quads[*index].center]).collect();
        let picture_from_cells = least_squares(&pairs)?;
        let range = |axis: usize| {
            let values = cells.keys().map(|cell| cell[axis]);
            values.fold([i32::MAX, i32::MIN], |[low, high], value| [low.min(value), high.max(value)])
        };
        let [x, y] = [range(0), range(1)];
        if pass == PASSES {
            return Some(Lattice { cells, low: [x[0], y[0]], high: [x[1], y[1]], picture_from_cells });
        }
        let area = cells.values().map(|index| quads[*index].area).sum::<f64>() / cells.len() as f64;
        let places = (y[0] - 2..=y[1] + 2).flat_map(|row| (x[0] - 2..=x[1] + 2).map(move |column| [column, row]));
        let found = |cell: [i32; 2]| {
            let place = project(picture_from_cells, point(cell));
            let steps = [[1, 0], [0, 1]].map(|step: [i32; 2]| {
                project(picture_from_cells, point([cell[0] + step[0], cell[1] + step[1]])) - place
            });
            Some((cell, nearest(quads, place, OFF * steps[0].length(), area, steps)?))
        };
        cells = places.filter(|cell| cell.iter().all(|at| at.abs() <= REACH)).filter_map(found).collect();
    }
    None
}

/// Homography of points onto others that minimizes Σ |(g·p + 1) q − A p|² about their means, by its normal equations.
fn least_squares(pairs: &[[DVec2; 2]]) -> Option<DMat3> {
    let n = pairs.len() as f64;
    let [from, to] = [0, 1].map(|k: usize| pairs.iter().map(|pair| pair[k]).sum::<DVec2>() / n);
    let scale = (pairs.iter().map(|pair| pair[1].distance_squared(to)).sum::<f64>() / n).sqrt();
    let (mut matrix, mut right) = (vec![0.0; 64], vec![0.0; 8]);
    for [p, q] in pairs {
        let (p, q) = (*p - from, (*q - to) / scale);
        let rows = [
            ([p.x, p.y, 1.0, 0.0, 0.0, 0.0, -p.x * q.x, -p.y * q.x], q.x),
            ([0.0, 0.0, 0.0, p.x, p.y, 1.0, -p.x * q.y, -p.y * q.y], q.y),
        ];
        for (row, target) in rows {
            add_row(&mut matrix, &mut right, &row, target, 1.0);
        }
    }
    let h = Cholesky::new(matrix, 8)?.solve(right);
    let fitted = DMat3::from_cols_array(&[h[0], h[3], h[6], h[1], h[4], h[7], h[2], h[5], 1.0]);
    let to_picture = DMat3::from_translation(to) * DMat3::from_scale(DVec2::splat(scale));
    Some(to_picture * fitted * DMat3::from_translation(-from))
}

/// Adds an equation to normal equations.
pub(super) fn add_row(matrix: &mut [f64], right: &mut [f64], row: &[f64], target: f64, weight: f64) {
    for (i, a) in row.iter().enumerate() {
        right[i] += weight * a * target;
        for (j, b) in row.iter().enumerate() {
            matrix[i * row.len() + j] += weight * a * b;
        }
    }
}
