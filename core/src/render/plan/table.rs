//! ln J over (ln κ, v), interpolated by polynomials of odd degree, as fine as is wanted.

use super::candidate::Method;
use super::domain::{beta_at, ln_last, position};
use super::run::RUN;
use crate::math::exp::exp;
use crate::render::diffuse::cell;
use crate::render::measure::Node;
use rayon::prelude::*;

/// A table's fineness: each step halves a cell.
#[derive(Clone, Copy, Debug)]
pub(super) struct Size {
    pub(super) degree: usize,
    /// Intervals along ln κ and along v.
    intervals: [usize; 2],
    pub(super) nodes: usize,
    pub(super) step: u32,
    ln_kappa: [f64; 2],
}

/// The steps of the coarsest table, in ln κ and in ln(1 + β).
const COARSEST: f64 = 0.8;
/// Cells get longer along v than along κ: where v is stretched most there is least to see.
const ALONG_V: f64 = 1.0;

impl Size {
    /// The size of a table after `step` halvings of its cells.
    pub(super) fn new(kappa: [f64; 2], degree: usize, step: u32) -> Self {
        let h = COARSEST * (-0.5 * f64::from(step)).exp2();
        let ln_kappa = kappa.map(f64::ln);
        let along = |length: f64, h: f64| (length / h).ceil().max(1.0) as usize;
        let intervals = [along(ln_kappa[1] - ln_kappa[0], h), along(ln_last(kappa[0]), ALONG_V * h).max(degree)];
        // The wavelengths keep step with the cells, so that neither alone decides the error.
        let nodes = 4 + step as usize * (degree + 1) / 8;
        Self { degree, intervals, nodes, step, ln_kappa }
    }

    /// Places along ln κ and along v.
    pub(super) fn places(&self) -> [usize; 2] {
        let beside = self.beside();
        [self.intervals[0] + 1 + 2 * beside, self.intervals[1] + 1 + beside]
    }

    /// A table of this size as a way.
    pub(super) fn method(&self) -> Method {
        let [kappas, betas] = self.places();
        Method::Table { degree: self.degree, kappas, betas, nodes: self.nodes }
    }

    /// Places beyond an end, so that what is read lies in the middle of what it is read from; not before v = 0, where β ends.
    fn beside(&self) -> usize {
        self.degree / 2
    }

    /// The steps along ln κ and along v.
    fn steps(&self) -> [f64; 2] {
        let steps = self.intervals.map(|count| count as f64);
        [(self.ln_kappa[1] - self.ln_kappa[0]) / steps[0], 1.0 / steps[1]]
    }

    /// κ and v at a place.
    fn at(&self, place: [usize; 2]) -> [f64; 2] {
        let h = self.steps();
        [(self.ln_kappa[0] + (place[0] as f64 - self.beside() as f64) * h[0]).exp(), place[1] as f64 * h[1]]
    }

    /// What reading along one of the axes alone makes of J at a place that a table of this size holds, the places beside it
    /// filled by these wavelengths: the table's error is about the sum of both.
    pub(super) fn read_along(&self, axis: usize, nodes: &[Node], kappa: f64, beta: f64) -> [f64; 3] {
        let (position, h) = (position(kappa, beta), self.steps());
        let places = [(position[0] - self.ln_kappa[0]) / h[0] + self.beside() as f64, position[1] / h[1]];
        let (count, place) = (self.degree + 1, places[axis]);
        let from = (place - 0.5 * self.degree as f64).round().clamp(0.0, (self.places()[axis] - count) as f64) as usize;
        let mut mixed = [0.0; 4];
        for k in from..from + count {
            let [kappa, v] = if axis == 0 { [self.at([k, 0])[0], position[1]] } else { [kappa, self.at([0, k])[1]] };
            let others = (from..from + count).filter(|&j| j != k);
            let weight: f64 = others.map(|j| (place - j as f64) / (k as f64 - j as f64)).product();
            let cell = cell(nodes, kappa, beta_at(kappa, v));
            mixed.iter_mut().zip(cell).for_each(|(sum, value)| *sum += weight * value);
        }
        of_cell(mixed)
    }
}

/// J as a cell has it.
pub(super) fn of_cell(cell: Cell) -> [f64; 3] {
    let peak = exp(cell[0]);
    [cell[1] * peak, cell[2] * peak, cell[3] * peak]
}

/// ln of the positive measure's J, and the three channels' J in units of it.
type Cell = [f64; 4];

#[derive(Clone, Debug, PartialEq)]
pub(super) struct Table {
    degree: usize,
    kappa: [f64; 2],
    /// `place = offset + slope · position`.
    offset: [f64; 2],
    slope: [f64; 2],
    places: [usize; 2],
    cells: Vec<Cell>,
    nodes: Vec<Node>,
}

impl Table {
    /// Fills a table.
    pub(super) fn new(size: &Size, kappa: [f64; 2], nodes: Vec<Node>) -> Self {
        let places = size.places();
        let rows = (0..places[0]).into_par_iter().map(|i| {
            let place = |j| {
                let [kappa, v] = size.at([i, j]);
                cell(&nodes, kappa, beta_at(kappa, v))
            };
            (0..places[1]).map(place).collect::<Vec<_>>()
        });
        let cells = rows.collect::<Vec<_>>().concat();
        let slope = size.steps().map(f64::recip);
        let offset = [size.beside() as f64 - size.ln_kappa[0] * slope[0], 0.0];
        Self { degree: size.degree, kappa, offset, slope, places, cells, nodes }
    }

    /// The wavelengths that it is made of.
    pub(super) fn nodes(&self) -> &[Node] {
        &self.nodes
    }

    pub(super) fn bytes(&self) -> usize {
        size_of_val(self.cells.as_slice())
    }

    pub(super) fn degree(&self) -> usize {
        self.degree
    }

    #[inline]
    pub(super) fn holds(&self, kappa: f64) -> bool {
        self.kappa[0] <= kappa && kappa <= self.kappa[1]
    }

    /// Where a run of samples lies between the places.
    #[allow(clippy::inline_always, reason = "only inside the caller is it compiled for the caller's instruction set")]
    #[inline(always)]
    pub(super) fn around<const N: usize>(&self, kappa: &[f64; RUN], beta: &[f64; RUN]) -> Around<N> {
        let mut around = Around { v: [0.0; RUN], start: [0; RUN], across: [[0.0; RUN]; N], along: [[0.0; RUN]; N] };
        let last = self.places.map(|count| (count - N) as f64);
        let (mut t, mut s, width) = ([0.0; RUN], [0.0; RUN], self.places[1] as f64);
        for i in 0..RUN {
            let [ln_kappa, v] = position(kappa[i], beta[i]);
            let (x, y) = (self.offset[0] + self.slope[0] * ln_kappa, self.slope[1] * v);
            let (row, column) = (first::<N>(x, last[0]), first::<N>(y, last[1]));
            (around.v[i], t[i], s[i]) = (v, x - row, y - column);
            // An integer, in the low bits of its mantissa.
            around.start[i] = (row * width + column + ROUNDER).to_bits() as u32;
        }
        lagrange(&t, &mut around.across);
        lagrange(&s, &mut around.along);
        around
    }

    /// A cell between the places, by polynomials through `N` of them each way; v from 0 to 1.
    #[allow(clippy::inline_always, reason = "only inside the caller is it compiled for the caller's instruction set")]
    #[inline(always)]
    pub(super) fn read<const N: usize>(&self, around: &Around<N>, i: usize) -> Cell {
        let along: [f64; N] = std::array::from_fn(|k| around.along[k][i]);
        let cells = self.cells.get(around.start[i] as usize..).unwrap_or_default();
        let mut rows = cells.chunks(self.places[1]);
        let mut mixed = [0.0; 4];
        for across in &around.across {
            let Some(row) = rows.next().and_then(|row| row.first_chunk::<N>()) else { return mixed };
            let mut line = [0.0; 4];
            for k in 0..N {
                for lane in 0..4 {
                    line[lane] += along[k] * row[k][lane];
                }
            }
            for lane in 0..4 {
                mixed[lane] += across[i] * line[lane];
            }
        }
        mixed
    }
}

/// Where a run of samples lies between the places of a table.
pub(super) struct Around<const N: usize> {
    /// v, above 1 where it is dark.
    pub(super) v: [f64; RUN],
    /// The first of the places around each.
    start: [u32; RUN],
    /// Their weights along ln κ and along v.
    across: [[f64; RUN]; N],
    along: [[f64; RUN]; N],
}

/// Adding and subtracting this rounds a double below 2⁵¹ to the nearest integer.
const ROUNDER: f64 = 6_755_399_441_055_744.0;

/// The first of the N places around a position, not beyond the last.
#[allow(clippy::inline_always, reason = "only inside the caller is it compiled for the caller's instruction set")]
#[inline(always)]
fn first<const N: usize>(position: f64, last: f64) -> f64 {
    let nearest = position - (N - 1) as f64 * 0.5 + ROUNDER - ROUNDER;
    nearest.max(0.0).min(last)
}

/// The weights of Lagrange's polynomials on 0, 1, …, N − 1.
#[allow(clippy::inline_always, reason = "only inside the caller is it compiled for the caller's instruction set")]
#[inline(always)]
fn lagrange<const N: usize>(t: &[f64; RUN], weights: &mut [[f64; RUN]; N]) {
    // ∏(k − j): (−1)^(N−1−k) k! (N−1−k)!, from the first to the last.
    let mut denominator = 1.0;
    for j in 1..N {
        denominator *= -(j as f64);
    }
    let mut product = [1.0; RUN];
    for (k, weights) in weights.iter_mut().enumerate() {
        let share = 1.0 / denominator;
        denominator *= -((k + 1) as f64) / (N - 1 - k).max(1) as f64;
        for i in 0..RUN {
            weights[i] = product[i] * share;
            product[i] *= t[i] - k as f64;
        }
    }
    let mut product = [1.0; RUN];
    for (k, weights) in weights.iter_mut().enumerate().rev() {
        for i in 0..RUN {
            weights[i] *= product[i];
            product[i] *= t[i] - k as f64;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn moment<const N: usize>(t: &[f64; RUN], power: i32, i: usize) -> f64 {
        let mut weights = [[0.0; RUN]; N];
        lagrange(t, &mut weights);
        weights.iter().zip(0..).map(|(w, k)| w[i] * f64::from(k).powi(power)).sum()
    }

    #[test]
    fn polynomials_are_met_exactly() {
        let t = std::array::from_fn(|i| -0.4 + 0.09 * i as f64);
        for (i, &x) in t.iter().enumerate() {
            let off = |sum: f64, power: i32| (sum - x.powi(power)).abs() / 12_f64.powi(power);
            assert!(off(moment::<4>(&t, 3, i), 3) < 1e-13);
            assert!(off(moment::<6>(&t, 5, i), 5) < 1e-13);
            assert!(off(moment::<12>(&t, 11, i), 11) < 1e-13);
        }
    }
}
