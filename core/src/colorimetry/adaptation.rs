//! Chromatic adaptation: what a color under one white looks like under another.

use super::tristimulus::Xyz;
use glam::{DMat3, DVec3};

/// Cone-like responses from tristimulus values, rows L, M, S (Lam 1985, "Bradford").
const BRADFORD: DMat3 = DMat3::from_cols(
    DVec3::new(0.8951, -0.7502, 0.0389),
    DVec3::new(0.2664, 1.7135, -0.0685),
    DVec3::new(-0.1614, 0.0367, 1.0296),
);

/// The linear Bradford adaptation from one white to another, or none where the first has a response of zero or the
/// matrix's numbers would overflow.
///
/// ```text
/// A = B⁻¹ diag(B w′ / B w) B
/// ```
/// It carries `from` to `to` exactly (to rounding).
pub fn bradford(from: Xyz, to: Xyz) -> Option<DMat3> {
    let (a, b) = (BRADFORD * from.to_vector(), BRADFORD * to.to_vector());
    let gains = b / a;
    let possible = a.abs().min_element() > 1e-9 * a.abs().max_element();
    let adaptation = BRADFORD.inverse() * DMat3::from_diagonal(gains) * BRADFORD;
    (possible && adaptation.is_finite()).then_some(adaptation)
}
