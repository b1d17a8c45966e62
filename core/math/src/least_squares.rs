//! Small least-squares problems with an exact side condition.

use glam::{DMat3, DVec3};

/// Reason that a fit has no answer.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, thiserror::Error)]
pub enum FitError {
    /// The three channels do not span three dimensions over the samples.
    #[error("the three channels are linearly dependent over the training samples")]
    Dependent,
    /// The vector that is to be kept is zero.
    #[error("the white has no signal")]
    NoWhite,
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
///
/// [`FitError`] where the samples do not determine a matrix.
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
    let mut first: Vec<f64> = samples.iter().map(|a| n1.dot(*a)).collect();
    let mut second: Vec<f64> = samples.iter().map(|a| n2.dot(*a)).collect();
    let scale = samples.iter().map(|a| a.length_squared()).sum::<f64>().sqrt();
    let r11 = normalize(&mut first, scale)?;
    let r12: f64 = first.iter().zip(&second).map(|(q, v)| q * v).sum();
    second.iter_mut().zip(&first).for_each(|(v, q)| *v -= r12 * q);
    let r22 = normalize(&mut second, scale)?;
    let (mut c1, mut c2) = (DVec3::ZERO, DVec3::ZERO);
    for ((sample, target), (q1, q2)) in samples.iter().zip(targets).zip(first.iter().zip(&second)) {
        let residual = *target - fixed * along.dot(*sample);
        c1 += residual * *q1;
        c2 += residual * *q2;
    }
    let z2 = c2 / r22;
    let z1 = (c1 - z2 * r12) / r11;
    let matrix = outer(fixed, along) + outer(z1, n1) + outer(z2, n2);
    // Samples or targets beyond what a double can square carry no information either.
    if matrix.is_finite() { Ok(matrix) } else { Err(FitError::Dependent) }
}

/// Scales a column to unit length and returns the length it had.
fn normalize(column: &mut [f64], scale: f64) -> Result<f64, FitError> {
    let norm = column.iter().map(|v| v * v).sum::<f64>().sqrt();
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
