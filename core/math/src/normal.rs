//! Normal numbers with a covariance: its root, and draws that have it.

use crate::dot::{dot, dot_inline};
use crate::random::SplitMix64;
use multiversion::multiversion;

/// Pairs of draws where nothing tells which directions matter: a spread is known to 6 %.
const PAIRS: usize = 128;
/// Fewest pairs of draws.
const FEWEST: usize = 31;
/// Part of a vector below which it lies in the space of others.
const DEPENDENT: f64 = 1e-6;
/// Part of a variance below which what the others leave of it counts as rounding.
const ROUNDING: f64 = 1e-5;
/// Correlation beyond the possible that rounding explains.
const IMPOSSIBLE: f64 = 1e-3;

/// Root A of a covariance `A Aᵀ`: `A z` has it, z being independent standard normal numbers.
#[derive(Clone, Debug, PartialEq)]
pub struct CovarianceRoot {
    size: usize,
    columns: Vec<(usize, Vec<f64>)>,
}

impl CovarianceRoot {
    /// The root with these columns for so many numbers, each column as the place of its first value and the values from there.
    pub fn new(size: usize, columns: Vec<(usize, Vec<f64>)>) -> Self {
        Self { size, columns }
    }

    /// Root of a covariance of so many numbers by rows: Cholesky's method with complete pivoting on the correlations. None for a matrix
    /// that has a negative eigenvalue beyond rounding.
    pub fn of(covariance: &[f64], size: usize) -> Option<Self> {
        let scale: Vec<f64> = (0..size).map(|i| covariance[i * size + i].max(0.0).sqrt()).collect();
        let correlation = |at: usize| match (covariance[at], scale[at / size] * scale[at % size]) {
            (value, product) if product > 0.0 => value / product,
            // Without variance there is no covariance either.
            (value, _) => value.abs() * f64::MAX,
        };
        let all: Vec<f64> = (0..size * size).map(correlation).collect();
        let mut rest: Vec<Vec<f64>> = all.chunks(size.max(1)).map(<[f64]>::to_vec).collect();
        if !all.iter().all(|value| value.abs() <= 1.0 + IMPOSSIBLE) {
            return None;
        }
        let mut columns = Vec::new();
        for _ in 0..size {
            let pivot = (0..size).max_by(|&a, &b| rest[a][a].total_cmp(&rest[b][b]));
            let Some(pivot) = pivot.filter(|&at| rest[at][at] > ROUNDING) else { break };
            let length = rest[pivot][pivot].sqrt();
            let column: Vec<f64> = rest[pivot].iter().map(|v| v / length).collect();
            for (row, by) in rest.iter_mut().zip(&column) {
                row.iter_mut().zip(&column).for_each(|(value, part)| *value -= by * part);
            }
            columns.push((0, column.iter().zip(&scale).map(|(v, by)| v * by).collect()));
        }
        rest.iter().flatten().all(|v| v.abs() <= IMPOSSIBLE).then_some(Self { size, columns })
    }

    /// Root of the covariance of the numbers, each multiplied by a factor.
    #[must_use]
    pub fn scaled(&self, factors: &[f64]) -> Self {
        let product = |(first, column): &(usize, Vec<f64>)| {
            (*first, column.iter().zip(&factors[*first..]).map(|(value, by)| value * by).collect())
        };
        Self { size: self.size, columns: self.columns.iter().map(product).collect() }
    }

    /// `A z`.
    pub fn times(&self, numbers: &[f64]) -> Vec<f64> {
        let mut all = vec![0.0; self.size];
        for ((first, column), number) in self.columns.iter().zip(numbers) {
            all[*first..].iter_mut().zip(column).for_each(|(value, part)| *value += number * part);
        }
        all
    }

    /// Draws of `A z` in pairs of opposite sign, the same at each call.
    ///
    /// ```text
    /// z = ±(V q + w − V Vᵀ w),   V an orthonormal basis of Aᵀ kernels, q of exactly unit covariance, w random
    /// ```
    /// What depends linearly on them by the kernels thus has exactly its linearized uncertainty (spherical cubature of degree 3). Of no more
    /// independent numbers than kernels, or than 128 without any, all has.
    pub fn draws(self, kernels: &[Vec<f64>]) -> impl Iterator<Item = Vec<f64>> + use<> {
        let dimensions = self.columns.len();
        let most = if kernels.is_empty() { PAIRS } else { kernels.len() };
        let basis = (dimensions > most).then(|| self.basis(kernels));
        let count = match &basis {
            Some(basis) if basis.is_empty() => PAIRS,
            Some(basis) => basis.len(),
            None => dimensions,
        };
        let points = cubature(count.max(FEWEST)).into_iter();
        let mut random = SplitMix64::new(1);
        points.flat_map(move |point| {
            let numbers = basis.as_ref().map(|basis| {
                let free: Vec<f64> = (0..dimensions).map(|_| nearly_normal(&mut random)).collect();
                let mut numbers = without(&free, basis);
                for (by, axis) in point.iter().zip(basis) {
                    numbers.iter_mut().zip(axis).for_each(|(number, part)| *number += by * part);
                }
                numbers
            });
            let draw = self.times(&numbers.unwrap_or(point));
            let opposite = draw.iter().map(|value| -value).collect();
            [draw, opposite]
        })
    }

    fn basis(&self, kernels: &[Vec<f64>]) -> Vec<Vec<f64>> {
        let kernel =
            |kernel: &Vec<f64>| self.columns.iter().map(|(first, column)| dot(column, &kernel[*first..])).collect();
        let kernels: Vec<Vec<f64>> = kernels.iter().map(kernel).collect();
        orthonormal(Vec::new(), &kernels)
    }
}

/// An orthonormal basis with what some vectors add to its space, by Gram and Schmidt's method done twice: nothing where they lie in it.
pub fn orthonormal<'a>(mut basis: Vec<Vec<f64>>, vectors: impl IntoIterator<Item = &'a Vec<f64>>) -> Vec<Vec<f64>> {
    for vector in vectors {
        let rest = without(&without(vector, &basis), &basis);
        let [length, left] = [vector, &rest].map(|of| dot(of, of).sqrt());
        if left > DEPENDENT * length {
            basis.push(rest.iter().map(|v| v / left).collect());
        }
    }
    basis
}

/// Coordinates of a vector in an orthonormal basis.
pub fn coordinates(vector: &[f64], basis: &[Vec<f64>]) -> Vec<f64> {
    basis.iter().map(|axis| dot(vector, axis)).collect()
}

/// Points of a standard normal distribution of so many dimensions, always the same: with their opposites they have mean 0 and exactly the
/// covariance 1. Rows of a random orthogonal matrix by Gram and Schmidt's method, done twice, times the root of their number.
fn cubature(count: usize) -> Vec<Vec<f64>> {
    let mut random = SplitMix64::new(0);
    let mut rows: Vec<Vec<f64>> = Vec::with_capacity(count);
    while rows.len() < count {
        let row: Vec<f64> = (0..count).map(|_| nearly_normal(&mut random)).collect();
        let rest = without(&without(&row, &rows), &rows);
        let length = rest.iter().map(|v| v * v).sum::<f64>().sqrt();
        rows.push(rest.iter().map(|v| v / length).collect());
    }
    let length = (count as f64).sqrt();
    rows.iter_mut().flatten().for_each(|value| *value *= length);
    rows
}

/// A number of mean 0 and variance 1: directions need no exact normal numbers, and sums of twelve uniform ones round alike on every machine.
fn nearly_normal(random: &mut SplitMix64) -> f64 {
    (0..12).map(|_| random.unit()).sum::<f64>() - 6.0
}

/// A vector without its components in the space of orthonormal ones.
fn without(vector: &[f64], space: &[Vec<f64>]) -> Vec<f64> {
    let mut rest = vector.to_vec();
    take_out(&mut rest, space);
    rest
}

/// Takes from a vector its components in the space of orthonormal ones.
#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl+avx512bw+avx512cd", "x86_64+avx2", "aarch64+neon"))]
pub fn take_out(vector: &mut [f64], space: &[Vec<f64>]) {
    for axis in space {
        let along = dot_inline(vector, axis);
        vector.iter_mut().zip(axis).for_each(|(v, a)| *v -= along * a);
    }
}
