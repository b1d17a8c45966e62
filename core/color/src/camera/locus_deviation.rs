//! Deviation of a sensor's Planckian locus at one temperature, split along and off the reference's own locus.

use super::locus::LocusEvaluator;
use super::rendering::Rendering;
use crate::colorimetry::{Uv60, UvPrime};
use crate::math::minimum::minimum;
use crate::spectral::Sensor;
use crate::units::Kelvin;
use std::ops::Deref;

/// Reciprocal temperatures of the reference's locus, in mired: 100 000 K to 500 K.
const RANGE_MIRED: [f64; 2] = [10.0, 2000.0];
/// Points that are looked at first, evenly in reciprocal temperature.
const POINTS: usize = 400;
/// Distance from the locus in the CIE 1960 diagram beyond which a correlated color temperature is meaningless (CIE 15).
const FARTHEST_UV: f64 = 0.05;
/// Share of a reciprocal temperature over which the locus's direction is taken.
const STEP: f64 = 1e-4;
/// Interval in mired that the nearest point is searched down to.
const SEARCH: f64 = 1e-8;
/// Distance of the points of the parabola through it, in mired.
const PARABOLA: f64 = 0.01;

/// Deviation of a blackbody's color through a sensor from the reference's.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LocusDeviation {
    /// Component of the difference in u′, v′ along the reference's locus, positive towards higher temperatures.
    pub along: f64,
    /// Component across it, positive towards larger v′ (green and yellow).
    pub off: f64,
    /// Correlated color temperature on the reference's own locus, nearest in CIE 1960 u, v as CIE 15 defines it, minus the true
    /// temperature, in kelvins; none beyond 500 K and 100 000 K, and farther than 0.05 in u, v from the locus.
    pub cct_error_k: Option<f64>,
}

/// The reference's own Planckian locus, as its colors are shown.
#[derive(Clone, Debug)]
pub struct ReferenceLocus<S> {
    evaluator: LocusEvaluator<S>,
    rendering: Rendering,
    /// Mired, and place in the CIE 1960 diagram.
    points: Vec<(f64, Uv60)>,
}

impl<S: Deref<Target = Sensor>> ReferenceLocus<S> {
    /// Prepares the locus of the reference.
    pub fn new(evaluator: LocusEvaluator<S>, rendering: Rendering) -> Self {
        let mut locus = Self { evaluator, rendering, points: Vec::new() };
        let [first, last] = RANGE_MIRED;
        let mired = (0..POINTS).map(|i| first + (last - first) * i as f64 / (POINTS - 1) as f64);
        locus.points = mired.filter_map(|mired| Some((mired, locus.at(mired)?.uv60()))).collect();
        locus
    }

    /// Color of a blackbody on the reference's locus.
    fn at(&self, mired: f64) -> Option<UvPrime> {
        let temperature = Kelvin::from_mired(mired).ok()?;
        self.rendering.blackbody(self.evaluator.raw(temperature)).uv_prime()
    }

    /// Deviation of a color that a sensor gives to a blackbody; none where the reference has no locus there.
    pub fn deviation(&self, temperature: Kelvin, color: UvPrime) -> Option<LocusDeviation> {
        let mired = temperature.mired();
        let true_color = self.at(mired)?;
        let [hotter, colder] = [self.at(mired * (1.0 - STEP))?, self.at(mired * (1.0 + STEP))?];
        let [du, dv] = [hotter.u - colder.u, hotter.v - colder.v];
        let length = du.hypot(dv);
        let [u, v] = [color.u - true_color.u, color.v - true_color.v];
        let upwards = if du >= 0.0 { 1.0 } else { -1.0 };
        (length > 0.0).then(|| LocusDeviation {
            along: (u * du + v * dv) / length,
            off: upwards * (v * du - u * dv) / length,
            cct_error_k: self.nearest_k(color.uv60()).map(|kelvin| kelvin - temperature.get()),
        })
    }

    fn nearest_k(&self, color: Uv60) -> Option<f64> {
        let away = |place: Uv60| (place.u - color.u).hypot(place.v - color.v);
        let distance = |place: &(f64, Uv60)| away(place.1);
        let nearest =
            (0..self.points.len()).min_by(|&a, &b| distance(&self.points[a]).total_cmp(&distance(&self.points[b])))?;
        if nearest == 0 || nearest + 1 == self.points.len() {
            return None;
        }
        let (low, high) = (self.points[nearest - 1].0, self.points[nearest + 1].0);
        let at = |mired: f64| self.at(mired).map_or(f64::INFINITY, |place| away(place.uv60()));
        let mired = minimum(low, high, SEARCH, at);
        // Golden sections end where the distance is flat to rounding; the parabola through three points about there does not.
        let [before, here, after] = [mired - PARABOLA, mired, mired + PARABOLA].map(|place| at(place).powi(2));
        let vertex = mired - 0.5 * PARABOLA * (after - before) / (after - 2.0 * here + before);
        let mired = if (vertex - mired).abs() < PARABOLA { vertex } else { mired };
        (at(mired) <= FARTHEST_UV).then(|| 1e6 / mired)
    }
}
