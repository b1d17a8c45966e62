//! Matrices that minimize color differences, by Levenberg–Marquardt.

#[cfg(feature = "fits")]
mod search;
#[cfg(not(feature = "fits"))]
mod search {
    //! Without the feature `fits` nothing is searched for.
    use super::{DMat3, FitError, Lab, Objective, Training, Xyz};

    pub(super) fn minimum(
        _: Training<'_>,
        _: &[Lab],
        _: (Xyz, bool, Objective),
        _: DMat3,
        _: Option<DMat3>,
    ) -> Result<DMat3, FitError> {
        Err(FitError::NoOptimizer)
    }

    pub(super) fn solve(_: usize, _: impl Fn(usize, usize) -> f64, _: impl Fn(usize) -> f64) -> Option<Vec<f64>> {
        None
    }
}

use super::{Correction, CorrectionMethod, RgbTransform, Training};
use crate::colorimetry::difference::delta_e_2000_vector;
use crate::colorimetry::lab::lab_from_xyz;
use crate::colorimetry::{Lab, Xyz};
use crate::math::least_squares::FitError;
use glam::{DMat3, DVec3};

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
pub fn minimize_near(
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
    search::minimum(training, &targets, (white, keeps_white, objective), start, near)
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
        let solved = search::solve(3 * free, entry, |row| right[row / 3][row % 3])?;
        let mut columns = [DVec3::ZERO; 3];
        for (column, values) in columns[self.first..].iter_mut().zip(solved.chunks_exact(3)) {
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
