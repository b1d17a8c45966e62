//! The search, by Levenberg–Marquardt.

use super::{Objective, SMALLEST, lab_by_xyz, white_basis};
use crate::colorimetry::lab::lab_from_xyz;
use crate::colorimetry::{Lab, Xyz};
use crate::correction::Training;
use crate::math::least_squares::FitError;
use glam::{DMat3, DVec3};
use levenberg_marquardt::{LeastSquaresProblem, LevenbergMarquardt};
use nalgebra::{DMatrix, DVector, Dyn, Owned};

/// The most rounds of reweighting.
const ROUNDS: usize = 200;
/// Relative gain of a round below which the mean counts as minimal.
const GAIN: f64 = 1e-9;

/// The matrix of the least value, from `start` or, where it is better, from `near`.
#[allow(clippy::unnecessary_wraps, reason = "without the feature `fits` it refuses")]
pub(super) fn minimum(
    training: Training<'_>,
    targets: &[Lab],
    (white, keeps_white, objective): (Xyz, bool, Objective),
    start: DMat3,
    near: Option<DMat3>,
) -> Result<DMat3, FitError> {
    let mut problem = Problem::new(training, targets, white, keeps_white, objective, start);
    let mut start_value = problem.value(training.weights);
    if let Some(near) = near {
        let other = Problem::new(training, targets, white, keeps_white, objective, near);
        let value = other.value(training.weights);
        if value < start_value {
            (problem, start_value) = (other, value);
        }
    }
    let start = problem.matrix();
    let optimizer = LevenbergMarquardt::new();
    if objective.squares() {
        (problem, _) = optimizer.with_tol(1e-15).minimize(problem);
    } else {
        let (mut best, mut before) = (start_value, problem.params());
        for _ in 0..ROUNDS {
            problem.reweight(training.weights);
            (problem, _) = optimizer.with_tol(1e-12).with_patience(2).minimize(problem);
            let value = problem.value(training.weights);
            if value.is_nan() || value >= best {
                problem.set_params(&before);
                break;
            }
            let gain = best - value;
            (best, before) = (value, problem.params());
            if gain <= GAIN * best {
                break;
            }
        }
    }
    let matrix = problem.matrix();
    if matrix.is_finite() && problem.value(training.weights) <= start_value { Ok(matrix) } else { Ok(start) }
}

/// Solution of a positive definite system of `n` equations; none where it is not.
pub(super) fn solve(n: usize, matrix: impl Fn(usize, usize) -> f64, right: impl Fn(usize) -> f64) -> Option<Vec<f64>> {
    let solved = DMatrix::from_fn(n, n, matrix).cholesky()?.solve(&DVector::from_fn(n, |row, _| right(row)));
    Some(solved.as_slice().to_vec())
}

/// Weighted difference vectors of all samples, as a function of a matrix's free columns in a basis whose first axis is the white.
struct Problem<'a> {
    /// Samples in the basis.
    samples: Vec<DVec3>,
    targets: &'a [Lab],
    white: Xyz,
    /// Square roots of the weights.
    roots: Vec<f64>,
    objective: Objective,
    /// Orthonormal, its first column along (1, 1, 1).
    basis: DMat3,
    /// Columns of the matrix in the basis.
    columns: [DVec3; 3],
    first: usize,
}

impl<'a> Problem<'a> {
    fn new(
        training: Training<'_>,
        targets: &'a [Lab],
        white: Xyz,
        keeps_white: bool,
        objective: Objective,
        start: DMat3,
    ) -> Self {
        let basis = white_basis();
        let columns = start * basis;
        Self {
            samples: training.samples.iter().map(|sample| basis.transpose() * *sample).collect(),
            targets,
            white,
            roots: training.weights.iter().map(|weight| weight.sqrt()).collect(),
            objective,
            basis,
            columns: [columns.x_axis, columns.y_axis, columns.z_axis],
            first: usize::from(keeps_white),
        }
    }

    fn matrix(&self) -> DMat3 {
        let [x, y, z] = self.columns;
        DMat3::from_cols(x, y, z) * self.basis.transpose()
    }

    fn xyz(&self, sample: DVec3) -> DVec3 {
        let [x, y, z] = self.columns;
        x * sample.x + y * sample.y + z * sample.z
    }

    /// Difference vectors; none where a color is beyond all numbers.
    fn vectors(&self) -> Option<Vec<DVec3>> {
        let vector = |(sample, target): (&DVec3, &Lab)| {
            let lab = lab_from_xyz(Xyz::from_vector(self.xyz(*sample)), self.white)?;
            Some(self.objective.vector(*target, lab))
        };
        self.samples.iter().zip(self.targets).map(vector).collect()
    }

    /// The objective, up to a constant factor.
    fn value(&self, weights: &[f64]) -> f64 {
        let Some(vectors) = self.vectors() else { return f64::INFINITY };
        let sizes = vectors.iter().map(|v| if self.objective.squares() { v.length_squared() } else { v.length() });
        sizes.zip(weights).map(|(size, weight)| size * weight).sum()
    }

    fn reweight(&mut self, weights: &[f64]) {
        let Some(vectors) = self.vectors() else { return };
        let roots = vectors.iter().zip(weights).map(|(v, weight)| (weight / v.length().max(SMALLEST)).sqrt());
        self.roots = roots.collect();
    }
}

impl LeastSquaresProblem<f64, Dyn, Dyn> for Problem<'_> {
    type ResidualStorage = Owned<f64, Dyn>;
    type JacobianStorage = Owned<f64, Dyn, Dyn>;
    type ParameterStorage = Owned<f64, Dyn>;

    fn set_params(&mut self, params: &DVector<f64>) {
        for (column, values) in self.columns[self.first..].iter_mut().zip(params.as_slice().chunks_exact(3)) {
            *column = DVec3::from_slice(values);
        }
    }

    fn params(&self) -> DVector<f64> {
        DVector::from_iterator(3 * (3 - self.first), self.columns[self.first..].iter().flat_map(DVec3::to_array))
    }

    fn residuals(&self) -> Option<DVector<f64>> {
        let vectors = self.vectors()?;
        let weighted = vectors.iter().zip(&self.roots).flat_map(|(v, root)| (*v * *root).to_array());
        Some(DVector::from_iterator(3 * self.samples.len(), weighted))
    }

    fn jacobian(&self) -> Option<DMatrix<f64>> {
        let free = 3 - self.first;
        let mut jacobian = DMatrix::zeros(3 * self.samples.len(), 3 * free);
        for (i, (sample, target)) in self.samples.iter().zip(self.targets).enumerate() {
            let xyz = Xyz::from_vector(self.xyz(*sample));
            let lab = lab_from_xyz(xyz, self.white)?;
            let by_xyz = self.objective.derivative(*target, lab) * lab_by_xyz(xyz, self.white) * self.roots[i];
            for j in 0..free {
                let factor = sample[self.first + j];
                for component in 0..3 {
                    let column = by_xyz.col(component) * factor;
                    for row in 0..3 {
                        jacobian[(3 * i + row, 3 * j + component)] = column[row];
                    }
                }
            }
        }
        Some(jacobian)
    }
}
