//! Matrices that minimize color differences, by Levenberg–Marquardt.

use super::{Correction, CorrectionMethod, RgbTransform, Training};
use crate::colorimetry::difference::delta_e_2000_vector;
use crate::colorimetry::lab::lab_from_xyz;
use crate::colorimetry::{Lab, Xyz};
use crate::math::least_squares::FitError;
use glam::{DMat3, DVec3};
use levenberg_marquardt::{LeastSquaresProblem, LevenbergMarquardt};
use nalgebra::{DMatrix, DVector, Dyn, Owned};

/// Quantity that a fit minimizes over its training samples.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Objective {
    /// Sum of squares of ΔE\*ab: least squares in L\*a\*b\*, as rawtoaces fits.
    LabSquares,
    /// Mean ΔE\*ab.
    DeltaE1976,
    /// Mean CIEDE2000.
    DeltaE2000,
}

impl Objective {
    /// Difference of a color from its target as a vector, whose length is ΔE.
    fn vector(self, target: Lab, color: Lab) -> DVec3 {
        match self {
            Self::LabSquares | Self::DeltaE1976 => {
                DVec3::new(color.l - target.l, color.a - target.a, color.b - target.b)
            }
            Self::DeltaE2000 => DVec3::from_array(delta_e_2000_vector(target, color)),
        }
    }

    /// Derivatives of [`Self::vector`] by L*, a* and b*: columns. Central differences where there is no short formula.
    fn derivative(self, target: Lab, color: Lab) -> DMat3 {
        if self != Self::DeltaE2000 {
            return DMat3::IDENTITY;
        }
        let step = 1e-5;
        let along = |axis: DVec3| {
            let at = |t: f64| Lab { l: color.l + axis.x * t, a: color.a + axis.y * t, b: color.b + axis.z * t };
            (self.vector(target, at(step)) - self.vector(target, at(-step))) / (2.0 * step)
        };
        DMat3::from_cols(along(DVec3::X), along(DVec3::Y), along(DVec3::Z))
    }

    fn squares(self) -> bool {
        self == Self::LabSquares
    }
}

/// Below this difference a sample's weight in a mean grows no further: the mean is exact to half of it.
const SMALLEST: f64 = 1e-5;
/// The most rounds of reweighting.
const ROUNDS: usize = 200;
/// Relative gain of a round below which the mean counts as minimal.
const GAIN: f64 = 1e-9;

/// The 3×3 that minimizes an objective over training samples, among all or among those that carry (1, 1, 1) to `white`.
///
/// ```text
/// min Σ wᵢ ΔEᵢ²      LabSquares
/// min Σ wᵢ ΔEᵢ       by iteratively reweighted least squares: weights wᵢ / ΔEᵢ of the round before, which never increases the sum
/// ```
/// Each least-squares problem is solved by MINPACK's Levenberg–Marquardt method from the last round's matrix, the first from the
/// least-squares matrix in XYZ; the result is never worse than that. A local minimum: nothing proves that there is no lower one.
/// Free parameters: 6 with white kept, 9 without.
///
/// # Errors
/// [`FitError`] where the samples do not determine a matrix, or the white has no L\*a\*b\*.
pub fn minimize(
    training: Training<'_>,
    white: Xyz,
    keeps_white: bool,
    objective: Objective,
) -> Result<DMat3, FitError> {
    minimize_near(training, white, keeps_white, objective, None)
}

/// [`minimize`] from a matrix that is near, where that is better than the least-squares matrix. It must preserve white if that is
/// required.
///
/// # Errors
/// As [`minimize`].
pub(super) fn minimize_near(
    training: Training<'_>,
    white: Xyz,
    keeps_white: bool,
    objective: Objective,
    near: Option<DMat3>,
) -> Result<DMat3, FitError> {
    let start = Correction { method: CorrectionMethod::LeastSquares, keeps_white, ..Correction::default() };
    let RgbTransform::Matrix(start) = training.fit(&start, white)? else { return Err(FitError::Dependent) };
    let targets: Option<Vec<Lab>> =
        training.targets.iter().map(|target| lab_from_xyz(Xyz::from_vector(*target), white)).collect();
    let targets = targets.ok_or(FitError::NoWhite)?;
    let mut problem = Problem::new(training, &targets, white, keeps_white, objective, start);
    let mut start_value = problem.value(training.weights);
    if let Some(near) = near {
        let other = Problem::new(training, &targets, white, keeps_white, objective, near);
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

/// Fits near one that was minimized, for samples that differ little: by reweighted least squares with L\*a\*b\* linearized there.
#[derive(Clone, Debug)]
pub struct Refit {
    samples: Vec<DVec3>,
    /// Difference vector of each sample and its derivative by XYZ.
    linear: Vec<(DVec3, DMat3)>,
    weights: Vec<f64>,
    matrix: DMat3,
    basis: DMat3,
    first: usize,
    squares: bool,
    rounds: usize,
}

impl Refit {
    /// Prepares fits near `matrix`, which minimizes the objective over the training samples; none where a sample has no L\*a\*b\*.
    /// `rounds` of reweighting follow a mean difference; squares need one.
    pub fn new(
        training: Training<'_>,
        white: Xyz,
        keeps_white: bool,
        (objective, rounds): (Objective, usize),
        matrix: DMat3,
    ) -> Option<Self> {
        let linear = |(sample, target): (&DVec3, &DVec3)| {
            let xyz = Xyz::from_vector(matrix * *sample);
            let [target, lab] = [lab_from_xyz(Xyz::from_vector(*target), white)?, lab_from_xyz(xyz, white)?];
            Some((objective.vector(target, lab), objective.derivative(target, lab) * lab_by_xyz(xyz, white)))
        };
        let linear = training.samples.iter().zip(training.targets).map(linear).collect::<Option<_>>()?;
        let (basis, first) = (white_basis(), usize::from(keeps_white));
        let (samples, weights) = (training.samples.to_vec(), training.weights.to_vec());
        let (squares, rounds) = (objective.squares(), if objective.squares() { 1 } else { rounds });
        Some(Self { samples, linear, weights, matrix, basis, first, squares, rounds })
    }

    /// The matrix for other samples in the same order; none where they do not determine one.
    pub fn matrix(&self, samples: &[DVec3]) -> Option<DMat3> {
        let parts = self.samples.iter().zip(samples).zip(&self.linear);
        let mut rows: Vec<(DVec3, DVec3, DMat3)> = parts
            .map(|((old, new), (vector, by_xyz))| {
                let moved = *vector + *by_xyz * (self.matrix * (*new - *old));
                (self.basis.transpose() * *new, moved, *by_xyz)
            })
            .collect();
        let mut shift = DMat3::ZERO;
        for _ in 0..self.rounds {
            let step = self.step(&rows)?;
            shift += step;
            for (sample, vector, by_xyz) in &mut rows {
                *vector += *by_xyz * (step * *sample);
            }
        }
        let matrix = self.matrix + shift * self.basis.transpose();
        matrix.is_finite().then_some(matrix)
    }

    /// Change of the columns in the basis that minimizes the weighted squares of rows of sample, difference and derivative.
    fn step(&self, rows: &[(DVec3, DVec3, DMat3)]) -> Option<DMat3> {
        let free = 3 - self.first;
        let mut normal = [[DMat3::ZERO; 3]; 3];
        let mut right = [DVec3::ZERO; 3];
        for ((sample, vector, by_xyz), weight) in rows.iter().zip(&self.weights) {
            let weight = if self.squares { *weight } else { weight / vector.length().max(SMALLEST) };
            let transposed = by_xyz.transpose() * weight;
            let (square, pull) = (transposed * *by_xyz, transposed * *vector);
            for j in 0..free {
                let a = sample[self.first + j];
                right[j] -= pull * a;
                for (k, block) in normal[j].iter_mut().enumerate().take(j + 1) {
                    *block += square * (a * sample[self.first + k]);
                }
            }
        }
        let entry = |row: usize, column: usize| {
            let (j, k) = (row.max(column) / 3, row.min(column) / 3);
            normal[j][k].col(column % 3)[row % 3]
        };
        let matrix = DMatrix::from_fn(3 * free, 3 * free, entry);
        let solved = matrix.cholesky()?.solve(&DVector::from_fn(3 * free, |row, _| right[row / 3][row % 3]));
        let mut columns = [DVec3::ZERO; 3];
        for (column, values) in columns[self.first..].iter_mut().zip(solved.as_slice().chunks_exact(3)) {
            *column = DVec3::from_slice(values);
        }
        Some(DMat3::from_cols(columns[0], columns[1], columns[2]))
    }
}

/// Orthonormal columns, the first along (1, 1, 1).
fn white_basis() -> DMat3 {
    let along = DVec3::ONE.normalize();
    let across = along.any_orthonormal_vector();
    DMat3::from_cols(along, across, along.cross(across))
}

/// Derivatives of L*, a*, b* by X, Y, Z: columns.
fn lab_by_xyz(color: Xyz, white: Xyz) -> DMat3 {
    let slope = |value: f64, white: f64| {
        let t: f64 = value / white;
        let edge = 6.0_f64 / 29.0;
        let by_t = if t > edge.powi(3) { 1.0 / (3.0 * t.cbrt().powi(2)) } else { 1.0 / (3.0 * edge * edge) };
        by_t / white
    };
    let [x, y, z] = [slope(color.x, white.x), slope(color.y, white.y), slope(color.z, white.z)];
    DMat3::from_cols(
        DVec3::new(0.0, 500.0, 0.0) * x,
        DVec3::new(116.0, -500.0, 200.0) * y,
        DVec3::new(0.0, 0.0, -200.0) * z,
    )
}
