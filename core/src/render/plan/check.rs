//! A fixed set of (κ, β) with the integral there: what every way is compared with.

use super::Against;
use super::domain::{Demand, beta_at};
use crate::reflectance::Precision;
use crate::render::diffuse::{DARK, by_nodes};
use crate::render::measure::{Measure, Node};
use rayon::prelude::*;

/// The largest error between the points of the check is taken to be at most this much larger than at them.
pub const MARGIN: f64 = 2.0;

/// What the sum over all wavelengths is off by: S at full precision.
pub(super) const REFERENCE: f64 = 1e-13;

/// How many κ there are, and how many β at each.
const KAPPAS: usize = 96;
const BETAS: usize = 16;
/// Ways whose error is smooth in κ and β, as that of sums over a few wavelengths, are compared at each third point. Strides have
/// no divisor in common with the number of β, so that none is left out.
const SMOOTH_STRIDE: usize = 3;

/// The wavelengths that may stand for all in the check, if they are compared with all at each of this many points.
const STAND_INS: [usize; 2] = [20, 28];
const COMPARED_STRIDE: usize = 25;

/// A place and what the integral is there.
pub(super) struct Point {
    pub(super) kappa: f64,
    pub(super) beta: f64,
    pub(super) exact: [f64; 3],
    /// What errors are relative to.
    pub(super) scale: f64,
}

pub(super) struct Check {
    points: Vec<Point>,
    /// What `exact` may be off by.
    reference: f64,
}

impl Check {
    /// By the sum over all wavelengths; where 20 or 28 wavelengths are as good as that at each 25th point, by those.
    pub(super) fn new(measure: &Measure, against: Against, demand: Demand) -> Self {
        let few = points(measure.dense(), against, demand, COMPARED_STRIDE);
        for count in STAND_INS {
            let nodes = measure.shared(count);
            let off = |point: &Point| off(point, by_nodes(&nodes, point.kappa, point.beta, Precision::Full));
            let apart = few.par_iter().map(off).reduce(|| 0.0, f64::max);
            if apart <= REFERENCE {
                let points = points(&nodes, against, demand, 1);
                return Self { points, reference: MARGIN * apart + REFERENCE };
            }
        }
        Self { points: points(measure.dense(), against, demand, 1), reference: REFERENCE }
    }

    /// The largest error of a way that is smooth in κ and β, over the points for which `asked` holds, without margin.
    pub(super) fn error(&self, asked: impl Fn(f64) -> bool + Sync, way: impl Fn(f64, f64) -> [f64; 3] + Sync) -> f64 {
        let asked = self.points.par_iter().step_by(SMOOTH_STRIDE).filter(|point| asked(point.kappa));
        asked.map(|point| off(point, way(point.kappa, point.beta))).reduce(|| 0.0, f64::max)
    }

    pub(super) fn points(&self) -> &[Point] {
        &self.points
    }

    /// What an error seen certifies.
    pub(super) fn certified(&self, seen: f64) -> f64 {
        MARGIN * seen + self.reference
    }
}

/// Each so manyth point, by a sum over these wavelengths; only where something is promised.
fn points(nodes: &[Node], against: Against, demand: Demand, stride: usize) -> Vec<Point> {
    let [from, to] = demand.kappa();
    let largest = |kappa: f64, beta: f64| {
        let sums = by_nodes(nodes, kappa, beta, Precision::Full);
        (sums, sums.into_iter().map(f64::abs).fold(0.0, f64::max))
    };
    let row = |i: usize| {
        let kappa = from * (to / from).powf(i as f64 / (KAPPAS - 1) as f64);
        let peak = largest(kappa, 0.0).1;
        let shift = (i as f64 * 0.618_033_988_749_894_9).fract();
        let point = |j: usize| {
            // The edge itself, then a little beyond v = 1 too; each row lies between the others'.
            let v = if j == 0 { 0.0 } else { 1.05 * (j as f64 - shift) / (BETAS - 1) as f64 };
            let beta = beta_at(kappa, v);
            let (exact, value) = largest(kappa, beta);
            let scale = if against == Against::Peak { peak } else { value };
            let promised = against == Against::Peak || value > (-DARK).exp() * peak;
            promised.then_some(Point { kappa, beta, exact, scale })
        };
        (0..BETAS).filter(|j| (i * BETAS + j).is_multiple_of(stride)).filter_map(point).collect::<Vec<_>>()
    };
    (0..KAPPAS).into_par_iter().map(row).collect::<Vec<_>>().into_iter().flatten().collect()
}

/// A point's error. Black is exact if it is black.
pub(super) fn off(point: &Point, found: [f64; 3]) -> f64 {
    let off = point.exact.iter().zip(found).fold(0.0_f64, |most, (a, b)| most.max((a - b).abs()));
    if off == 0.0 { 0.0 } else { off / point.scale }
}
