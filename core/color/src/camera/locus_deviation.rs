//! Deviation of a sensor's Planckian locus at one temperature, split along and off the reference's own locus.

use super::locus::LocusEvaluator;
use super::rendering::Rendering;
use crate::colorimetry::{Uv60, UvPrime};
use crate::math::array::array;
use crate::math::minimum::minimum;
use crate::spectral::Sensor;
use crate::units::Kelvin;
use glam::DVec2;
use std::ops::Deref;

/// Reciprocal temperatures of the reference's locus, in mired: 100 000 K to 500 K.
const RANGE_MIRED: [f64; 2] = [10.0, 2000.0];
/// Points that are looked at first, evenly in reciprocal temperature.
const POINTS: usize = 400;
/// Distance from the locus in the CIE 1960 diagram beyond which a correlated color temperature is meaningless (CIE 15).
const FARTHEST_UV: f64 = 0.05;
/// Share of a reciprocal temperature over which the locus's direction is taken.
const STEP: f64 = 1e-4;
/// Interval in mired that the nearest point is searched down to where Newton's method leaves it.
const SEARCH: f64 = 1e-8;
/// Half the distance over which the locus's first and second derivative are taken, in mired, and steps by these.
const STEP_MIRED: f64 = 0.01;
const STEPS: usize = 4;
/// Places in a mired from which the last step, which squares the distance, goes.
const LATTICE: f64 = 131_072.0;

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
    /// Distance from that nearest point in CIE 1960 u, v, positive above it (green and yellow); none where there is no such point.
    pub duv: Option<f64>,
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

    /// The same between the points by the polynomial of degree 7 through eight of them: to 1e-10 of [`Self::at`], for some thirtieth
    /// of its instructions. Beyond the points as there.
    fn between(&self, mired: f64) -> Option<UvPrime> {
        const NODES: usize = 8;
        let [first, last] = RANGE_MIRED;
        let place = (mired - first) * (POINTS - 1) as f64 / (last - first);
        if !(0.0..=(POINTS - 1) as f64).contains(&place) || self.points.len() != POINTS {
            return self.at(mired);
        }
        let start = (place as usize).saturating_sub(NODES / 2 - 1).min(POINTS - NODES);
        let nodes = &self.points[start..start + NODES];
        let within = place - start as f64;
        let node = within as usize;
        let place = if within == node as f64 {
            nodes[node].1
        } else {
            // Barycentric weights of evenly spaced nodes: binomial coefficients in turns of sign.
            const WEIGHTS: [f64; NODES] = [1.0, -7.0, 21.0, -35.0, 35.0, -21.0, 7.0, -1.0];
            let (mut u, mut v, mut all) = (0.0, 0.0, 0.0);
            let weights = array::<_, NODES>(|node| WEIGHTS[node] / (within - node as f64));
            for ((_, place), weight) in nodes.iter().zip(weights) {
                (u, v, all) = (u + weight * place.u, v + weight * place.v, all + weight);
            }
            Uv60 { u: u / all, v: v / all }
        };
        Some(UvPrime { u: place.u, v: place.v * 1.5 })
    }

    /// Deviation of a color that a sensor gives to a blackbody; none where the reference has no locus there.
    pub fn deviation(&self, temperature: Kelvin, color: UvPrime) -> Option<LocusDeviation> {
        Self::away(&self.points, |mired| self.at(mired), temperature, color)
    }

    /// The same on the locus between its points, exact to 1e-6 of itself: for the many colors of an uncertainty.
    pub fn deviation_between(&self, temperature: Kelvin, color: UvPrime) -> Option<LocusDeviation> {
        Self::away(&self.points, |mired| self.between(mired), temperature, color)
    }

    fn away(
        points: &[(f64, Uv60)],
        at: impl Fn(f64) -> Option<UvPrime>,
        temperature: Kelvin,
        color: UvPrime,
    ) -> Option<LocusDeviation> {
        let mired = temperature.mired();
        let true_color = at(mired)?;
        let [hotter, colder] = [at(mired * (1.0 - STEP))?, at(mired * (1.0 + STEP))?];
        let [du, dv] = [hotter.u - colder.u, hotter.v - colder.v];
        let length = du.hypot(dv);
        let [u, v] = [color.u - true_color.u, color.v - true_color.v];
        let upwards = if du >= 0.0 { 1.0 } else { -1.0 };
        let nearest = nearest(points, at, color.uv60());
        (length > 0.0).then(|| LocusDeviation {
            along: (u * du + v * dv) / length,
            off: upwards * (v * du - u * dv) / length,
            cct_error_k: nearest.map(|(kelvin, _)| kelvin - temperature.get()),
            duv: nearest.map(|(_, duv)| duv),
        })
    }
}

/// Temperature in kelvins of the nearest point of a locus, and the distance from it.
fn nearest(points: &[(f64, Uv60)], at: impl Fn(f64) -> Option<UvPrime>, color: Uv60) -> Option<(f64, f64)> {
    let away = |place: Uv60| (place.u - color.u).powi(2) + (place.v - color.v).powi(2);
    let nearer = |best: (usize, f64), (at, distance)| if distance < best.1 { (at, distance) } else { best };
    let distances = points.iter().map(|(_, place)| away(*place)).enumerate();
    let (nearest, _) = distances.fold((0, f64::INFINITY), nearer);
    if nearest == 0 || nearest + 1 == points.len() {
        return None;
    }
    let (low, high) = (points[nearest - 1].0, points[nearest + 1].0);
    let at = |mired: f64| at(mired).map_or(DVec2::INFINITY, |place| DVec2::new(place.uv60().u, place.uv60().v));
    let color = DVec2::new(color.u, color.v);
    // Newton's method: the tangent is perpendicular to the way to the color.
    let nearer = |mired: f64| {
        // On a lattice: colors that differ by rounding alone then see the same rounding of the locus.
        let mired = (mired * LATTICE + 0.5) as u64 as f64 / LATTICE;
        let [before, here, after] = [mired - STEP_MIRED, mired, mired + STEP_MIRED].map(at);
        let tangent = (after - before) / (2.0 * STEP_MIRED);
        let bend = (after - 2.0 * here + before) / (STEP_MIRED * STEP_MIRED);
        mired + tangent.dot(color - here) / (tangent.length_squared() - bend.dot(color - here))
    };
    let inside = |mired: &f64| (low..=high).contains(mired);
    let by_steps = |from: f64| (0..STEPS).try_fold(from, |mired, _| Some(nearer(mired)).filter(inside));
    let sections = || minimum(low, high, SEARCH, |mired| at(mired).distance_squared(color));
    let mired = by_steps(points[nearest].0).or_else(|| by_steps(sections()))?;
    let place = at(mired);
    let duv = place.distance(color).copysign(color.y - place.y);
    (duv.abs() <= FARTHEST_UV).then(|| (1e6 / mired, duv))
}
