//! Hair and brows of the head.

use crate::mesh::Part;
use glam::Vec3;

/// Height of the hairline by the distance to the front, in meters: down the forehead's side, before and over the ear, down to the
/// nape.
const HAIRLINE: [(f32, f32); 9] = [
    (0.100, 0.146),
    (0.074, 0.143),
    (0.052, 0.126),
    (0.040, 0.096),
    (0.024, 0.072),
    (0.010, 0.070),
    (-0.030, 0.066),
    (-0.050, 0.030),
    (-0.110, 0.018),
];
/// The ear lies beyond this, and below that.
const EAR: (f32, f32) = (0.0745, 0.088);
/// Brows: inner and outer end, height at the ends, rise between, and half of their width, in meters.
const BROW: ([f32; 2], f32, f32, f32) = ([0.011, 0.054], 0.0925, 0.0085, 0.0042);

/// The part of the head that a place on it is of: skin, or hair cut short.
pub(crate) fn part_at(place: Vec3) -> Part {
    let aside = place.x.abs();
    let line = HAIRLINE.windows(2).find(|two| place.z >= two[1].0).map_or(HAIRLINE[8].1, |two| {
        let ((near, low), (far, high)) = (two[1], two[0]);
        low + (high - low) * ((place.z - near) / (far - near)).min(1.0)
    });
    let is_ear = aside > EAR.0 && place.y < EAR.1;
    let ([inner, outer], height, rise, half) = BROW;
    let along = (aside - inner) / (outer - inner);
    let brow = height + rise * (along * std::f32::consts::PI * 0.75).sin();
    if place.y > line && !is_ear {
        Part::Hair
    } else if place.z > 0.0 && (0.0..=1.0).contains(&along) && (place.y - brow).abs() < half * (1.15 - 0.7 * along) {
        Part::Brows
    } else {
        Part::Body
    }
}
