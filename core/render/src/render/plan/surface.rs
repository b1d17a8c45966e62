//! ln J over a table's square as a spline: through sums over wavelengths, or through another spline.

use super::extent::Extent;
use super::nodes::for_each_node;
use super::spline::{Axis, MOST};
use crate::reflectance::Precision;
use crate::render::measure::Node;
use rayon::prelude::*;

/// ln of the positive measure's J, and the three channels' J in units of it.
pub(super) type Cell = [f64; 4];

/// A spline's coefficients, row by row.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Surface {
    pub(super) degree: usize,
    /// Along ln κ and along v.
    pub(super) intervals: [usize; 2],
    pub(super) cells: Vec<Cell>,
}

impl Surface {
    /// By sums over wavelengths.
    pub(super) fn filled(
        extent: &Extent,
        degree: usize,
        intervals: [usize; 2],
        nodes: &[Node],
        precision: Precision,
    ) -> Self {
        let axes = intervals.map(|count| Axis::new(degree, count));
        let row = |&t: &f64| cells(extent, t, axes[1].sites(), nodes, precision);
        Self::through(degree, intervals, &axes, axes[0].sites().par_iter().map(row).collect())
    }

    /// Surface on other knots.
    pub(super) fn resampled(&self, degree: usize, intervals: [usize; 2]) -> Self {
        let axes = intervals.map(|count| Axis::new(degree, count));
        let own = self.intervals.map(|count| Axis::new(self.degree, count));
        let along: Vec<(usize, [f64; MOST])> = axes[1].sites().iter().map(|&v| own[1].weights(v)).collect();
        let width = self.intervals[1] + self.degree;
        let row = |&t: &f64| {
            let (from, weights) = own[0].weights(t);
            let mut mixed = vec![[0.0; 4]; width];
            for (weight, row) in weights.iter().zip(self.cells.chunks(width).skip(from)) {
                let pairs = mixed.as_flattened_mut().iter_mut().zip(row.as_flattened());
                pairs.for_each(|(sum, value)| *sum += weight * value);
            }
            let at = |(from, weights): &(usize, [f64; MOST])| {
                let mut sum = [0.0; 4];
                for (weight, cell) in weights.iter().zip(&mixed[*from..]) {
                    for lane in 0..4 {
                        sum[lane] += weight * cell[lane];
                    }
                }
                sum
            };
            along.iter().map(at).collect()
        };
        Self::through(degree, intervals, &axes, axes[0].sites().par_iter().map(row).collect())
    }

    fn through(degree: usize, intervals: [usize; 2], axes: &[Axis; 2], mut rows: Vec<Vec<Cell>>) -> Self {
        rows.par_iter_mut().for_each(|row| axes[1].solve(row.as_flattened_mut(), 4));
        let mut cells = rows.concat();
        axes[0].solve(cells.as_flattened_mut(), 4 * axes[1].sites().len());
        Self { degree, intervals, cells }
    }
}

/// At one place along ln κ and many v.
fn cells(extent: &Extent, t: f64, vs: &[f64], nodes: &[Node], precision: Precision) -> Vec<Cell> {
    let points: Vec<[f64; 2]> = vs.iter().map(|&v| extent.at(2.0 * t - 1.0, v)).collect();
    let mut sums = vec![[0.0; 4]; points.len()];
    for_each_node(nodes, &points, precision, |node, values| {
        let [red, green, blue] = node.weights;
        for (sum, value) in sums.iter_mut().zip(values) {
            for (sum, weight) in sum.iter_mut().zip([node.reference, red, green, blue]) {
                *sum += weight * value;
            }
        }
    });
    for sum in &mut sums {
        // No weight anywhere is black at any temperature.
        let whole = sum[0];
        *sum = if whole > 0.0 { [whole.ln(), sum[1] / whole, sum[2] / whole, sum[3] / whole] } else { [0.0; 4] };
    }
    sums
}
