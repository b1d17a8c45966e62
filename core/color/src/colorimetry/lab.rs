//! CIE 1976 L*a*b*.

use super::tristimulus::Xyz;
use crate::math::array::{array, each};
use crate::math::cbrt::cbrt_each;
use multiversion::multiversion;

/// Colors side by side: any register's width.
const LANES: usize = 8;

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
    let [x, y, z] = f([color.x / white.x, color.y / white.y, color.z / white.z]);
    lab(white, x, y, z)
}

/// The same of many colors, equal to the last bit; none unless all have one.
#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl+avx512bw+avx512cd", "x86_64+avx2", "aarch64+neon"))]
pub fn lab_from_each(colors: &[Xyz], white: Xyz) -> Option<Vec<Lab>> {
    let mut labs = Vec::with_capacity(colors.len());
    for colors in colors.chunks(LANES) {
        let mut ratios = [[0.0; LANES]; 3];
        for (lane, color) in colors.iter().enumerate() {
            ratios[0][lane] = color.x / white.x;
            ratios[1][lane] = color.y / white.y;
            ratios[2][lane] = color.z / white.z;
        }
        let [x, y, z] = [f(ratios[0]), f(ratios[1]), f(ratios[2])];
        for lane in 0..colors.len() {
            labs.push(lab(white, x[lane], y[lane], z[lane])?);
        }
    }
    Some(labs)
}

/// From compressed ratios.
#[inline(always)]
fn lab(white: Xyz, x: f64, y: f64, z: f64) -> Option<Lab> {
    let positive = [white.x, white.y, white.z].iter().all(|&w| w > 0.0 && w.is_finite());
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
    116.0 * f([ratio])[0] - 16.0
}

/// End of the straight part of the formula above, compressed.
const EDGE: f64 = 6.0 / 29.0;

/// The compressed ratios of the formula above.
#[inline(always)]
fn f<const N: usize>(t: [f64; N]) -> [f64; N] {
    let roots = cbrt_each(t);
    let lines = each(t, |t| t / (3.0 * EDGE * EDGE) + 4.0 / 29.0);
    array(|k| if t[k] > EDGE * EDGE * EDGE { roots[k] } else { lines[k] })
}
