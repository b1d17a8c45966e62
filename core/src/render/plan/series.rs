//! ln J as a series of Chebyshev's polynomials in both of a table's variables: few sums over wavelengths, from which a table of
//! any size is made by products of matrices.

use super::extent::Extent;
use super::spline;
use crate::reflectance::{Precision, diffuse_sum};
use crate::render::measure::Node;
use rayon::prelude::*;
use std::f64::consts::PI;

/// ln of the positive measure's J, and the three channels' J in units of it.
pub(super) type Cell = [f64; 4];

/// `ln J(t, v) = Σ_ab c_ab T_a(t) T_b(2v − 1)`, and the channels' shares likewise.
pub(super) struct Series {
    pub(super) extent: Extent,
    /// Terms along t and along v.
    terms: [usize; 2],
    coefficients: Vec<Cell>,
}

impl Series {
    /// By the values at Chebyshev's nodes, as many as there are terms.
    pub(super) fn new(extent: &Extent, terms: [usize; 2], nodes: &[Node], precision: Precision) -> Self {
        let [ts, vs] = terms.map(places);
        let along = to_coefficients(terms[1]);
        let rows: Vec<Vec<Cell>> =
            ts.par_iter().map(|&t| transformed(&along, &cells(extent, t, &vs, nodes, precision))).collect();
        let coefficients: Vec<Vec<Cell>> = to_coefficients(terms[0]).par_iter().map(|row| mixed(row, &rows)).collect();
        Self { extent: *extent, terms, coefficients: coefficients.concat() }
    }

    /// The coefficients of the spline of a degree with so many intervals along t and v: row by row.
    pub(super) fn splined(&self, degree: usize, intervals: [usize; 2]) -> Vec<Cell> {
        let [across, along] = [0, 1].map(|axis: usize| spline::of_chebyshev(degree, intervals[axis], self.terms[axis]));
        let rows: Vec<Vec<Cell>> =
            self.coefficients.par_chunks(self.terms[1].max(1)).map(|row| transformed(&along, row)).collect();
        let rows: Vec<Vec<Cell>> = across.par_iter().map(|weights| mixed(weights, &rows)).collect();
        rows.concat()
    }
}

/// Chebyshev's nodes on −1…1.
pub(super) fn places(count: usize) -> Vec<f64> {
    (0..count).map(|j| (PI * (2 * j + 1) as f64 / (2 * count) as f64).cos()).collect()
}

/// From the values at [`places`] to the coefficients: a row for each.
pub(super) fn to_coefficients(count: usize) -> Vec<Vec<f64>> {
    let wave: Vec<f64> = (0..4 * count).map(|i| (PI * i as f64 / (2 * count) as f64).cos()).collect();
    let row = |k: usize| {
        let weight = if k == 0 { 1.0 } else { 2.0 } / count as f64;
        (0..count).map(|j| weight * wave[k * (2 * j + 1) % (4 * count)]).collect()
    };
    (0..count).map(row).collect()
}

/// Each row of a matrix with a row of cells.
fn transformed(matrix: &[Vec<f64>], cells: &[Cell]) -> Vec<Cell> {
    let product = |weights: &Vec<f64>| {
        let mut sum = [0.0; 4];
        for (weight, cell) in weights.iter().zip(cells) {
            for lane in 0..4 {
                sum[lane] += weight * cell[lane];
            }
        }
        sum
    };
    matrix.iter().map(product).collect()
}

/// Rows of cells added with weights.
fn mixed(weights: &[f64], rows: &[Vec<Cell>]) -> Vec<Cell> {
    let mut sum = vec![[0.0; 4]; rows.first().map_or(0, Vec::len)];
    for (weight, row) in weights.iter().zip(rows) {
        for (sum, cell) in sum.as_flattened_mut().iter_mut().zip(row.as_flattened()) {
            *sum += weight * cell;
        }
    }
    sum
}

/// ln J and the channels' shares at one t and many v as Chebyshev's variable has them.
pub(super) fn cells(extent: &Extent, t: f64, vs: &[f64], nodes: &[Node], precision: Precision) -> Vec<Cell> {
    let points: Vec<[f64; 2]> = vs.iter().map(|v| extent.at(t, 0.5 * (v + 1.0))).collect();
    let mut sums = vec![[0.0; 4]; points.len()];
    for node in nodes {
        for (sum, [kappa, beta]) in sums.iter_mut().zip(&points) {
            let g = kappa * node.scale;
            let value = diffuse_sum(g, beta * g, precision);
            let [red, green, blue] = node.weights;
            for (sum, weight) in sum.iter_mut().zip([node.reference, red, green, blue]) {
                *sum += weight * value;
            }
        }
    }
    for sum in &mut sums {
        // No weight anywhere is black at any temperature.
        let whole = sum[0];
        *sum = if whole > 0.0 { [whole.ln(), sum[1] / whole, sum[2] / whole, sum[3] / whole] } else { [0.0; 4] };
    }
    sums
}
