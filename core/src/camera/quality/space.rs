//! Agreement of the space that a sensor's curves span with an observer's.

use crate::math::dot::dot;
use crate::spectral::Sensor;
use crate::spectral::grid::COUNT;

/// Share of a curve's length below which what is left of it beside the others is rounding.
const DEPENDENT: f64 = 1e-10;

/// Agreement of a sensor's space with an observer's, independent of light, balance and color transform.
///
/// Curves are taken at 380, 381, …, 780 nm without weights. `P_C` and `P_A` project onto the spaces of the sensor's curves C and the
/// observer's A.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpaceQuality {
    /// Vora value (Vora and Trussell 1993, J. Opt. Soc. Am. A 10, 1499): 1 where the spaces are the same, 0 where they are orthogonal.
    ///
    /// ```text
    /// ν = tr(P_A P_C) / 3
    /// ```
    pub vora: f64,
    /// Luther residual: relative RMS of the observer's curves that no linear combination of the sensor's reaches; 0 to 1.
    ///
    /// ```text
    /// min_M ‖A − C M‖ / ‖A‖ = ‖A − P_C A‖ / ‖A‖
    /// ```
    /// 0 where the Luther–Ives condition holds. Depends on which curves span the observer's space.
    pub luther: f64,
    /// Quality factor of each channel (Neugebauer 1956, J. Opt. Soc. Am. 46, 821): `|P_A c|² / |c|²`, 0 to 1.
    pub factors: [f64; 3],
}

impl SpaceQuality {
    /// Agreement of a sensor with an observer; none where the curves of one of them are linearly dependent.
    pub fn new(sensor: &Sensor, observer: &Sensor) -> Option<Self> {
        Self::of(&curves(sensor), &curves(observer))
    }

    /// Agreement of two sets of curves on the grid, each set in one scale.
    pub(crate) fn of(channels: &[Vec<f64>; 3], matching: &[Vec<f64>; 3]) -> Option<Self> {
        let (own, seen) = (basis(channels)?, basis(matching)?);
        let vora = own.iter().map(|curve| inside(curve, &seen)).sum::<f64>() / 3.0;
        let power: f64 = matching.iter().map(|curve| dot(curve, curve)).sum();
        let left: f64 = matching.iter().map(|curve| outside(curve, &own)).sum();
        let factor = |curve: &Vec<f64>| inside(curve, &seen) / dot(curve, curve);
        let [r, g, b] = channels;
        Some(Self { vora, luther: (left / power).sqrt(), factors: [factor(r), factor(g), factor(b)] })
    }
}

/// The three curves on the grid, each scaled to its largest value: neither spaces nor ratios within a curve's set change where all
/// three have one scale, and squares neither overflow nor vanish.
pub(crate) fn curves(sensor: &Sensor) -> [Vec<f64>; 3] {
    let mut curves =
        [0, 1, 2].map(|channel: usize| (0..COUNT).map(|i| sensor.at_index(i)[channel]).collect::<Vec<_>>());
    let largest = curves.iter().flatten().fold(0.0_f64, |m, v| m.max(v.abs()));
    curves.iter_mut().flatten().for_each(|v| *v /= largest);
    curves
}

/// Orthonormal basis of the space of three curves, by Gram and Schmidt's method done twice.
pub(crate) fn basis(curves: &[Vec<f64>; 3]) -> Option<Vec<Vec<f64>>> {
    let mut found: Vec<Vec<f64>> = Vec::with_capacity(3);
    for curve in curves {
        let length = dot(curve, curve).sqrt();
        let rest = remove(&remove(curve, &found), &found);
        let left = dot(&rest, &rest).sqrt();
        if left.is_nan() || left <= DEPENDENT * length {
            return None;
        }
        found.push(rest.iter().map(|v| v / left).collect());
    }
    Some(found)
}

/// A curve without its components in a space.
pub(crate) fn remove(curve: &[f64], space: &[Vec<f64>]) -> Vec<f64> {
    let mut rest = curve.to_vec();
    for axis in space {
        let along = dot(&rest, axis);
        rest.iter_mut().zip(axis).for_each(|(v, a)| *v -= along * a);
    }
    rest
}

/// Squared length of a curve's projection onto a space.
fn inside(curve: &[f64], space: &[Vec<f64>]) -> f64 {
    space.iter().map(|axis| dot(curve, axis).powi(2)).sum()
}

/// Squared length of what a projection onto a space leaves of a curve; by subtraction, so that it is exact where little is left.
fn outside(curve: &[f64], space: &[Vec<f64>]) -> f64 {
    let rest = remove(curve, space);
    dot(&rest, &rest)
}
