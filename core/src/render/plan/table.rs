//! ln J over (ln κ, v), interpolated by cubics or quintics, as fine as is wanted.

use super::domain::{beta_at, ln_last};
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
        let nodes = 4 + (if degree == 3 { step / 2 } else { 3 * step / 4 }) as usize;
        Self { degree, intervals, nodes, ln_kappa }
    }

    /// Places along ln κ and along v.
    pub(super) fn places(&self) -> [usize; 2] {
        let beside = self.beside();
        [self.intervals[0] + 1 + 2 * beside, self.intervals[1] + 1 + beside]
    }

    /// Places beyond an end, so that what is read lies in the middle of what it is read from; not before v = 0, where β ends.
    fn beside(&self) -> usize {
        self.degree / 2
    }
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
        let steps = size.intervals.map(|count| count as f64);
        let h = [(size.ln_kappa[1] - size.ln_kappa[0]) / steps[0], 1.0 / steps[1]];
        let (beside, places) = (size.beside() as f64, size.places());
        let rows = (0..places[0]).into_par_iter().map(|i| {
            let kappa = (size.ln_kappa[0] + (i as f64 - beside) * h[0]).exp();
            (0..places[1]).map(|j| cell(&nodes, kappa, beta_at(kappa, j as f64 * h[1]))).collect::<Vec<_>>()
        });
        let cells = rows.collect::<Vec<_>>().concat();
        let slope = h.map(f64::recip);
        let offset = [beside - size.ln_kappa[0] * slope[0], 0.0];
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

    /// A cell between the places, by polynomials through `N` of them each way; v from 0 to 1.
    #[allow(clippy::inline_always, reason = "only inside the caller is it compiled for the caller's instruction set")]
    #[inline(always)]
    pub(super) fn read<const N: usize>(&self, position: [f64; 2]) -> Cell {
        let (i, across) = place::<N>(self.offset[0] + self.slope[0] * position[0], self.places[0]);
        let (j, along) = place::<N>(self.slope[1] * position[1], self.places[1]);
        let mut mixed = [0.0; 4];
        for (k, u) in across.into_iter().enumerate() {
            let row = &self.cells[(i + k) * self.places[1] + j..][..N];
            let mut line = [0.0; 4];
            for (cell, v) in row.iter().zip(along) {
                for lane in 0..4 {
                    line[lane] += v * cell[lane];
                }
            }
            for lane in 0..4 {
                mixed[lane] += u * line[lane];
            }
        }
        mixed
    }
}

/// The first of the N places around a position, and their weights.
#[allow(clippy::inline_always, reason = "only inside the caller is it compiled for the caller's instruction set")]
#[inline(always)]
fn place<const N: usize>(position: f64, count: usize) -> (usize, [f64; N]) {
    let first = (position as usize).saturating_sub(N / 2 - 1).min(count - N);
    (first, lagrange(position - first as f64))
}

/// The weights of Lagrange's polynomials on 0, 1, …, N − 1.
#[allow(clippy::inline_always, reason = "only inside the caller is it compiled for the caller's instruction set")]
#[inline(always)]
fn lagrange<const N: usize>(t: f64) -> [f64; N] {
    // 1/∏(k − j): (−1)^(N−1−k) / (k! (N−1−k)!), from the first to the last.
    let mut denominator = 1.0;
    for j in 1..N {
        denominator *= -(j as f64);
    }
    let (mut before, mut after) = ([1.0; N], [1.0; N]);
    for k in 1..N {
        before[k] = before[k - 1] * (t - (k - 1) as f64);
        after[N - 1 - k] = after[N - k] * (t - (N - k) as f64);
    }
    let mut weights = [0.0; N];
    for k in 0..N {
        weights[k] = before[k] * after[k] * (1.0 / denominator);
        denominator *= -((k + 1) as f64) / (N - 1 - k).max(1) as f64;
    }
    weights
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn polynomials_are_met_exactly() {
        for t in [-0.4, 0.0, 1.3, 2.5, 4.9] {
            let cubic: f64 = lagrange::<4>(t).iter().zip(0..).map(|(w, k)| w * f64::from(k).powi(3)).sum();
            let quintic: f64 = lagrange::<6>(t).iter().zip(0..).map(|(w, k)| w * f64::from(k).powi(5)).sum();
            assert!((cubic - t.powi(3)).abs() < 1e-12 * 30.0, "{cubic}");
            assert!((quintic - t.powi(5)).abs() < 1e-12 * 3000.0, "{quintic}");
        }
    }
}
