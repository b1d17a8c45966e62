//! Hue in words that a mean of differences points to.

use chromascope_core::colorimetry::{UvPrime, Xy};
use chromascope_core::query::Displacements;

use crate::figures::look::DifferencePlane;

const NAMES: [&str; 8] = [
    "toward red",
    "toward orange",
    "toward yellow",
    "toward yellow-green",
    "toward green",
    "toward blue-green",
    "toward blue",
    "toward purple",
];

const NONE: &str = "no common hue";

/// Angles in degrees of unique red, yellow, green and blue from white: in u′v′ of the wavelengths 577, 515 and 475 nm and of the
/// red end, in a*b* as in CIECAM02 (CIE 159:2004). Between two of them lies the hue that is both.
const UNIQUE_UV: [f64; 4] = [10.0, 61.0, 149.0, 253.0];
const UNIQUE_AB: [f64; 4] = [20.0, 90.0, 164.0, 238.0];

/// Share of the mean length below which the mean vector has no direction worth a name.
const LEAST: f64 = 1.0 / 3.0;

/// Hue that the mean vector points to from the patches' mean.
pub fn of(plane: DifferencePlane, shift: &Displacements, [a, b, _]: [f64; 3]) -> &'static str {
    let [x, y] = shift.mean;
    if x.hypot(y) < LEAST * shift.mean_length || shift.mean_length == 0.0 {
        return NONE;
    }
    let uv = |x: f64, y: f64| Xy { x, y }.uv_prime();
    let ([x, y], unique) = match plane {
        DifferencePlane::Xy => match uv(a, b).zip(uv(a + x, b + y)) {
            Some((UvPrime { u, v }, to)) => ([to.u - u, to.v - v], UNIQUE_UV),
            None => return NONE,
        },
        DifferencePlane::Lab => ([x, y], UNIQUE_AB),
        DifferencePlane::UvPrime | DifferencePlane::Loci => ([x, y], UNIQUE_UV),
    };
    let angle = y.atan2(x).to_degrees();
    let center = |index: usize| {
        let (from, to) = (unique[index / 2], unique.get(index / 2 + 1).copied().unwrap_or(unique[0] + 360.0));
        if index.is_multiple_of(2) { from } else { 0.5 * (from + to) }
    };
    let distance = |index: &usize| ((angle - center(*index)).rem_euclid(360.0) - 180.0).abs();
    // Farthest from the opposite direction.
    (0..8).max_by(|a, b| distance(a).total_cmp(&distance(b))).map_or(NONE, |index| NAMES[index])
}
