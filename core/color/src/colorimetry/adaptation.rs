//! Chromatic adaptation: what a color under one white looks like under another.

use super::tristimulus::Xyz;
use glam::{DMat3, DVec3};

/// Cone-like responses from tristimulus values, rows L, M, S (Lam 1985, "Bradford").
const BRADFORD: DMat3 = DMat3::from_cols(
    DVec3::new(0.8951, -0.7502, 0.0389),
    DVec3::new(0.2664, 1.7135, -0.0685),
    DVec3::new(-0.1614, 0.0367, 1.0296),
);

/// Sharpened cone responses of CIECAM02 (CIE 159:2004), rows L, M, S.
pub(super) const CAT02: DMat3 = DMat3::from_cols(
    DVec3::new(0.7328, -0.7036, 0.0030),
    DVec3::new(0.4296, 1.6975, 0.0136),
    DVec3::new(-0.1624, 0.0061, 0.9834),
);

/// The linear Bradford adaptation from one white to another, or none where the first has a response of zero or the
/// matrix's numbers would overflow.
///
/// ```text
/// A = B⁻¹ diag(B w′ / B w) B
/// ```
/// It carries `from` to `to` exactly (to rounding).
pub fn bradford(from: Xyz, to: Xyz) -> Option<DMat3> {
    von_kries(BRADFORD, from, to)
}

/// Full adaptation with the matrix of CIECAM02, or none as for [`bradford`].
pub fn cat02(from: Xyz, to: Xyz) -> Option<DMat3> {
    von_kries(CAT02, from, to)
}

fn von_kries(cones: DMat3, from: Xyz, to: Xyz) -> Option<DMat3> {
    let (a, b) = (cones * from.to_vector(), cones * to.to_vector());
    let gains = b / a;
    let possible = a.abs().min_element() > 1e-9 * a.abs().max_element();
    let adaptation = cones.inverse() * DMat3::from_diagonal(gains) * cones;
    (possible && adaptation.is_finite()).then_some(adaptation)
}
