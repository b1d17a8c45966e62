//! Hue in words that a mean of differences points to.
//!
//! One way for all planes: a gray of the patches' mean L\* is shifted by the mean vector from the adopted white, and its hue
//! angle by CIECAM02 under that white is named. An approximation where the patches' mean is far from gray, since lines of equal
//! hue are curved, and for observers other than CIE 1931 2°, of which CIECAM02 is not.

use chromascope_core::colorimetry::ciecam02::Ciecam02;
use chromascope_core::colorimetry::lab::xyz_from_lab;
use chromascope_core::colorimetry::{Lab, UvPrime, Xy, Xyz};
use chromascope_core::query::Displacements;

use crate::figures::look::DifferencePlane;

/// Hue angles of CIECAM02 in degrees: unique red, yellow, green and blue (CIE 159:2004), and the middles between them.
const HUES: [(&str, f64); 8] = [
    ("toward red", 20.14),
    ("toward orange", 55.07),
    ("toward yellow", 90.0),
    ("toward yellow-green", 127.125),
    ("toward green", 164.25),
    ("toward blue-green", 200.89),
    ("toward blue", 237.53),
    ("toward purple", 308.835),
];

/// In place of a hue.
pub const NONE: &str = "no dominant hue";

/// Share of the mean length below which the mean vector has no direction worth a name.
const LEAST: f64 = 1.0 / 3.0;

/// Hue of the mean vector, from gray of an L\* under an adopted white.
pub fn of(plane: DifferencePlane, shift: &Displacements, l: f64, white: Xyz) -> &'static str {
    let [x, y] = shift.mean;
    if x.hypot(y) < LEAST * shift.mean_length || shift.mean_length == 0.0 {
        return NONE;
    }
    let gray = xyz_from_lab(Lab { l, a: 0.0, b: 0.0 }, white);
    let bright = |xy: Xy| Some(Xyz::from_vector(gray.y * xy.with_unit_luminance()?.to_vector()));
    let shifted = match plane {
        DifferencePlane::Lab => Some(xyz_from_lab(Lab { l, a: x, b: y }, white)),
        DifferencePlane::Xy => white.chromaticity().and_then(|at| bright(Xy { x: at.x + x, y: at.y + y })),
        DifferencePlane::UvPrime | DifferencePlane::Loci => {
            white.uv_prime().and_then(|at| bright(UvPrime { u: at.u + x, v: at.v + y }.xy()?))
        }
    };
    let seen = shifted.and_then(|color| Ciecam02::new(white)?.ucs(color));
    let angle = |hue: f64, of: f64| ((hue - of + 180.0).rem_euclid(360.0) - 180.0).abs();
    let nearest =
        seen.and_then(|seen| HUES.iter().min_by(|a, b| angle(seen.hue, a.1).total_cmp(&angle(seen.hue, b.1))));
    nearest.map_or(NONE, |(name, _)| name)
}
