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

/// L* of a ratio Y/Yₙ.
pub fn lightness(ratio: f64) -> f64 {
    116.0 * f(ratio) - 16.0
}

/// The compressed ratio of the formula above.
fn f(t: f64) -> f64 {
    const EDGE: f64 = 6.0 / 29.0;
    if t > EDGE * EDGE * EDGE { cbrt(t) } else { t / (3.0 * EDGE * EDGE) + 4.0 / 29.0 }
}
