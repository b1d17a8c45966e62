//! CIE 1976 L*a*b*.

use super::tristimulus::Xyz;
use crate::math::cbrt::cbrt;

/// Coordinates in the CIE 1976 L*a*b* space, relative to a white.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lab {
    /// Lightness, 0 black to 100 white.
    pub l: f64,
    /// Red against green.
    pub a: f64,
    /// Yellow against blue.
    pub b: f64,
}

/// L*a*b* of a color relative to a white (CIE 15:2004, 8.2.1), or none where the white has a component that is not
/// positive or is infinite.
///
/// ```text
/// L* = 116 f(Y/Yₙ) − 16,   a* = 500 (f(X/Xₙ) − f(Y/Yₙ)),   b* = 200 (f(Y/Yₙ) − f(Z/Zₙ))
/// f(t) = ∛t                     t > (6/29)³
/// f(t) = t (29/6)² / 3 + 4/29   otherwise, negative values included
/// ```
pub fn lab_from_xyz(color: Xyz, white: Xyz) -> Option<Lab> {
    let positive = [white.x, white.y, white.z].iter().all(|&w| w > 0.0 && w.is_finite());
    let [x, y, z] = [color.x / white.x, color.y / white.y, color.z / white.z].map(f);
    let lab = Lab { l: 116.0 * y - 16.0, a: 500.0 * (x - y), b: 200.0 * (y - z) };
    (positive && lab.l.is_finite() && lab.a.is_finite() && lab.b.is_finite()).then_some(lab)
}

/// XYZ of a color in L*a*b* relative to a white: the inverse of [`lab_from_xyz`], to a few units in the last place.
///
/// ```
/// use chromascope_core::colorimetry::{Xyz, lab::lab_from_xyz, lab::xyz_from_lab};
/// let (white, color) = (Xyz::new(0.9505, 1.0, 1.089), Xyz::new(0.2, 0.004, 0.3));
/// let back = xyz_from_lab(lab_from_xyz(color, white).unwrap(), white);
/// assert!((back.x - color.x).abs() < 1e-14 && (back.y - color.y).abs() < 1e-14 && (back.z - color.z).abs() < 1e-14);
/// ```
pub fn xyz_from_lab(lab: Lab, white: Xyz) -> Xyz {
    let ratio = |f: f64| if f > EDGE { f * f * f } else { 3.0 * EDGE * EDGE * (f - 4.0 / 29.0) };
    let y = (lab.l + 16.0) / 116.0;
    Xyz { x: white.x * ratio(y + lab.a / 500.0), y: white.y * ratio(y), z: white.z * ratio(y - lab.b / 200.0) }
}

impl Lab {
    /// Color whose difference from a reference is this one's times a factor; L* is not below 0.
    ///
    /// ```text
    /// reference + k (self − reference)
    /// ```
    #[must_use]
    pub fn exaggerated(self, reference: Self, factor: f64) -> Self {
        let far = |own: f64, reference: f64| reference + factor * (own - reference);
        Self { l: far(self.l, reference.l).max(0.0), a: far(self.a, reference.a), b: far(self.b, reference.b) }
    }
}

/// L* of a ratio Y/Yₙ.
pub fn lightness(ratio: f64) -> f64 {
    116.0 * f(ratio) - 16.0
}

/// End of the straight part of the formula above, compressed.
const EDGE: f64 = 6.0 / 29.0;

/// The compressed ratio of the formula above.
fn f(t: f64) -> f64 {
    if t > EDGE * EDGE * EDGE { cbrt(t) } else { t / (3.0 * EDGE * EDGE) + 4.0 / 29.0 }
}
