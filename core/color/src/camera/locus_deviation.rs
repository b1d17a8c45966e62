//! Deviation of a sensor's Planckian locus at one temperature, split along and off the reference's own locus.

use super::locus::LocusEvaluator;
use super::rendering::Rendering;
use crate::colorimetry::{Uv60, UvPrime};
use crate::math::array::array;
use crate::math::minimum::minimum;
use crate::spectral::Sensor;
use crate::units::Kelvin;
use glam::DVec2;
use multiversion::multiversion;
use std::ops::Deref;

/// Reciprocal temperatures of the reference's locus, in mired: 100 000 K to 500 K.
const RANGE_MIRED: [f64; 2] = [10.0, 2000.0];
/// Points that are looked at first, evenly in reciprocal temperature.
const POINTS: usize = 400;
/// Points that are looked at side by side: two registers of any width.
const LANES: usize = 16;
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
    /// Points: mired, then u and v in the CIE 1960 diagram, infinite where whole registers need more.
    points: [Vec<f64>; 3],
}

impl<S: Deref<Target = Sensor>> ReferenceLocus<S> {
    /// Prepares the locus of the reference.
    pub fn new(evaluator: LocusEvaluator<S>, rendering: Rendering) -> Self {
        let mut locus = Self { evaluator, rendering, points: Default::default() };
        let [first, last] = RANGE_MIRED;
        let mired = (0..POINTS).map(|i| first + (last - first) * i as f64 / (POINTS - 1) as f64);
        let points: Vec<_> = mired.filter_map(|mired| Some((mired, locus.at(mired)?.uv60()))).collect();
        locus.points = [0, 1, 2].map(|of| points.iter().map(|(mired, at)| [*mired, at.u, at.v][of]).collect());
        let whole = points.len().next_multiple_of(LANES);
        for list in &mut locus.points[1..] {
            list.resize(whole, f64::INFINITY);
        }
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
        let [all, u, v] = &self.points;
        if !(0.0..=(POINTS - 1) as f64).contains(&place) || all.len() != POINTS {
            return self.at(mired);
        }
        let start = (place as usize).saturating_sub(NODES / 2 - 1).min(POINTS - NODES);
        let nodes = start..start + NODES;
        let within = place - start as f64;
        let node = within as usize;
        let place = if within == node as f64 {
            Uv60 { u: u[start + node], v: v[start + node] }
        } else {
            // Barycentric weights of evenly spaced nodes: binomial coefficients in turns of sign.
            const WEIGHTS: [f64; NODES] = [1.0, -7.0, 21.0, -35.0, 35.0, -21.0, 7.0, -1.0];
            let mut sums = [0.0; 3];
            let weights = array::<_, NODES>(|node| WEIGHTS[node] / (within - node as f64));
            for ((u, v), weight) in u[nodes.clone()].iter().zip(&v[nodes]).zip(weights) {
                sums = [sums[0] + weight * u, sums[1] + weight * v, sums[2] + weight];
            }
            Uv60 { u: sums[0] / sums[2], v: sums[1] / sums[2] }
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
        points: &[Vec<f64>; 3],
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

/// The point nearest to a color, of several the first; the first of all where none has a distance.
#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl+avx512bw+avx512cd", "x86_64+avx2", "aarch64+neon"))]
fn nearest_point(u: &[f64], v: &[f64], color: Uv60) -> usize {
    let (mut least, mut nearest) = ([f64::INFINITY; LANES], [0.0; LANES]);
    for (block, (u, v)) in u.as_chunks::<LANES>().0.iter().zip(v.as_chunks::<LANES>().0).enumerate() {
        for lane in 0..LANES {
            let square = (u[lane] - color.u).powi(2) + (v[lane] - color.v).powi(2);
            let is_nearer = square < least[lane];
            least[lane] = if is_nearer { square } else { least[lane] };
            nearest[lane] = if is_nearer { (block * LANES + lane) as f64 } else { nearest[lane] };
        }
    }
    let nearer = |best, own| if own < best { own } else { best };
    least.into_iter().zip(nearest).fold((f64::INFINITY, 0.0), nearer).1 as usize
}

/// Temperature in kelvins of the nearest point of a locus, and the distance from it.
fn nearest([mired, u, v]: &[Vec<f64>; 3], at: impl Fn(f64) -> Option<UvPrime>, color: Uv60) -> Option<(f64, f64)> {
    let nearest = nearest_point(u, v, color);
    if nearest == 0 || nearest + 1 >= mired.len() {
        return None;
    }
    let (from, low, high) = (mired[nearest], mired[nearest - 1], mired[nearest + 1]);
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
    let mired = by_steps(from).or_else(|| by_steps(sections()))?;
    let place = at(mired);
    let duv = place.distance(color).copysign(color.y - place.y);
    (duv.abs() <= FARTHEST_UV).then(|| (1e6 / mired, duv))
}
