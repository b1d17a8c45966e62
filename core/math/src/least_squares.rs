//! Small least-squares problems with an exact side condition.

use crate::dot::dot_inline;
use glam::{DMat3, DVec3};
use multiversion::multiversion;

/// Reason that a fit has no answer.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, thiserror::Error)]
#[allow(missing_docs, reason = "each variant says in its message what is wrong")]
pub enum FitError {
    #[error("the three channels are linearly dependent over the training samples")]
    Dependent,
    #[error(
        "{samples} training samples cannot determine {needed} coefficients a channel; choose a larger training set"
    )]
    TooFew { samples: usize, needed: usize },
    #[error("the white has no signal")]
    NoWhite,
    #[error("all training samples have weight 0; give at least one class a weight above 0")]
    NoWeight,
    #[error("this program is built without the search for a minimum color difference (feature `fits`)")]
    NoOptimizer,
}

/// The matrix M that minimizes `Σ |Mᵢⱼ aₖ − bₖ|²` among all with `M white = image`.
///
/// For each row m: m = image / |white|² white + N z with N an orthonormal basis of white's complement; z by modified
/// Gram–Schmidt on the samples' two remaining coordinates, which never forms the normal equations and so keeps the
/// conditioning of the samples themselves. The side condition holds to rounding.
///
/// Refuses with [`FitError::Dependent`] when a channel carries less than 1e-10 of new information, or none that is finite.
///
/// # Errors
/// [`FitError`] where the samples do not determine a matrix.
#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl+avx512bw+avx512cd", "x86_64+avx2", "aarch64+neon"))]
pub fn matrix_keeping(samples: &[DVec3], targets: &[DVec3], white: DVec3, image: DVec3) -> Result<DMat3, FitError> {
    // By its largest component, because the squares of a tiny white underflow.
    let largest = white.abs().max_element();
    let length = if largest > 0.0 { largest * (white / largest).length() } else { 0.0 };
    if length == 0.0 || !length.is_finite() {
        return Err(FitError::NoWhite);
    }
    let along = white / length;
    let n1 = along.any_orthonormal_vector();
    let n2 = along.cross(n1);
    let fixed = image / length;
    let mut all: Vec<f64> = Vec::with_capacity(3 * samples.len());
    for n in [along, n1, n2] {
        all.extend(samples.iter().map(|a| n.dot(*a)));
    }
    let scale = dot_inline(&all, &all).sqrt();
    let (fixed_part, both) = all.split_at_mut(samples.len());
    let (first, second) = both.split_at_mut(samples.len());
    let r11 = normalize(first, scale)?;
    let r12 = dot_inline(first, second);
    second.iter_mut().zip(&*first).for_each(|(v, q)| *v -= r12 * q);
    let r22 = normalize(second, scale)?;
    let (mut c1, mut c2) = (DVec3::ZERO, DVec3::ZERO);
    for ((part, target), (q1, q2)) in fixed_part.iter().zip(targets).zip(first.iter().zip(&*second)) {
        let residual = *target - fixed * *part;
        c1 += residual * *q1;
        c2 += residual * *q2;
    }
    let z2 = c2 / r22;
    let z1 = (c1 - z2 * r12) / r11;
    let matrix = outer(fixed, along) + outer(z1, n1) + outer(z2, n2);
    // Samples or targets beyond what a double can square carry no information either.
    if matrix.is_finite() { Ok(matrix) } else { Err(FitError::Dependent) }
}

/// Coefficients of a linear model of three responses, and the leverage of each sample.
#[derive(Clone, Debug, PartialEq)]
pub struct LinearFit {
    /// One coefficient of each response for each term.
    pub coefficients: Vec<DVec3>,
    /// Diagonal of the hat matrix, 0 to 1: the error at a sample that the fit omits is its residual over one minus this.
    pub leverages: Vec<f64>,
}

/// The coefficients c that minimize `Σᵢ |Σⱼ rᵢⱼ cⱼ − bᵢ|²`, optionally subject to `Σⱼ cⱼ = keep`.
///
/// The side condition is taken out by a Householder reflection that turns (1, …, 1) to the first axis. Modified Gram–Schmidt on
/// the remaining columns and the targets together, which is backward stable (Björck 1967).
///
/// # Errors
/// [`FitError`] where the samples do not determine the coefficients.
pub fn linear_fit<R: AsRef<[f64]>>(rows: &[R], targets: &[DVec3], keep: Option<DVec3>) -> Result<LinearFit, FitError> {
    let terms = rows.first().map_or(0, |row| row.as_ref().len());
    let fixed = usize::from(keep.is_some());
    if terms <= fixed || rows.len() < terms - fixed {
        return Err(FitError::TooFew { samples: rows.len(), needed: terms.max(fixed + 1) - fixed });
    }
    let length = (terms as f64).sqrt();
    let reflected: Option<Vec<_>> = keep.map(|_| rows.iter().map(|row| reflect(row.as_ref())).collect());
    let row = |at: usize| reflected.as_ref().map_or_else(|| rows[at].as_ref(), |rows| &rows[at][..]);
    let all = || (0..rows.len()).map(row);
    let first = keep.map(|image| image / length);
    let mut residuals: Vec<DVec3> =
        all().zip(targets).map(|(row, target)| first.map_or(*target, |first| *target - first * row[0])).collect();
    let scale = all().map(|row| dot_inline(row, row)).sum::<f64>().sqrt();
    let count = terms - fixed;
    let mut columns: Vec<f64> = Vec::with_capacity(count * rows.len());
    for j in fixed..terms {
        columns.extend(all().map(|row| row[j]));
    }
    let mut upper = vec![0.0; count * count];
    let mut projected = vec![DVec3::ZERO; count];
    for (j, (upper, projected)) in upper.chunks_mut(count).zip(&mut projected).enumerate() {
        let (column, rest) = columns[j * rows.len()..].split_at_mut(rows.len());
        upper[j] = normalize(column, scale)?;
        for (other, factor) in rest.chunks_mut(rows.len()).zip(&mut upper[j + 1..]) {
            *factor = dot_inline(column, other);
            other.iter_mut().zip(column.iter()).for_each(|(v, q)| *v -= *factor * q);
        }
        *projected = column.iter().zip(&residuals).map(|(q, b)| *b * *q).sum();
        residuals.iter_mut().zip(column.iter()).for_each(|(b, q)| *b -= *projected * *q);
    }
    for j in (0..count).rev() {
        let known: DVec3 = (j + 1..count).map(|k| projected[k] * upper[j * count + k]).sum();
        projected[j] = (projected[j] - known) / upper[j * count + j];
    }
    let leverages = (0..rows.len()).map(|i| (0..count).map(|j| columns[j * rows.len() + i].powi(2)).sum()).collect();
    let mut coefficients: Vec<DVec3> = first.into_iter().chain(projected).collect();
    if keep.is_some() {
        for channel in 0..3 {
            let row: Vec<f64> = coefficients.iter().map(|c| c[channel]).collect();
            coefficients.iter_mut().zip(reflect(&row)).for_each(|(c, value)| c[channel] = value);
        }
    }
    let finite = coefficients.iter().all(|c| c.is_finite());
    if finite { Ok(LinearFit { coefficients, leverages }) } else { Err(FitError::Dependent) }
}

/// Householder reflection that carries (1, …, 1) of n coordinates to (√n, 0, …, 0), and back.
fn reflect(row: &[f64]) -> Vec<f64> {
    let count = row.len() as f64;
    // v = (1 − √n, 1, …, 1), |v|² = 2 (n − √n); a single coordinate stays.
    let first = 1.0 - count.sqrt();
    let square = 2.0 * (count - count.sqrt());
    if square == 0.0 {
        return row.to_vec();
    }
    let along = 2.0 * (row.iter().sum::<f64>() - count.sqrt() * row[0]) / square;
    row.iter().enumerate().map(|(j, v)| v - along * if j == 0 { first } else { 1.0 }).collect()
}

/// Scales a column to unit length and returns the length it had.
#[inline(always)]
fn normalize(column: &mut [f64], scale: f64) -> Result<f64, FitError> {
    let norm = dot_inline(column, column).sqrt();
    if norm.is_nan() || norm <= 1e-10 * scale {
        return Err(FitError::Dependent);
    }
    for value in column.iter_mut() {
        *value /= norm;
    }
    Ok(norm)
}

/// The matrix `column rowᵀ`.
fn outer(column: DVec3, row: DVec3) -> DMat3 {
    DMat3::from_cols(column * row.x, column * row.y, column * row.z)
}
