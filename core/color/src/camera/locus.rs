//! Blackbodies through a sensor (Eq 15), by a few nodes instead of 401 samples, with the error that was checked.

mod terms;

use self::terms::Terms;
use crate::accuracy::{RelTolerance, Unmet};
use crate::light::RadiationConstants;
use crate::math::gauss::{Rule, gauss_rule, interpolatory_rule};
use crate::spectral::Sensor;
use crate::spectral::grid::{COUNT, wavelength_nm};
use crate::units::Kelvin;
use std::ops::Deref;

/// Below this temperature a few nodes no longer suffice and the full sum is taken.
const NODES_FROM_K: f64 = 1000.0;
/// Above this the law is a polynomial in all but name; the full sum is taken only because no check covers it.
const NODES_TO_K: f64 = 1e6;
/// Node counts tried, fewest first.
const COUNTS: [usize; 7] = [10, 12, 14, 17, 20, 24, 28];
/// Temperatures at which a rule is checked against the full sum.
const CHECKS_K: [f64; 9] = [1000.0, 1100.0, 1300.0, 1700.0, 2500.0, 4000.0, 8000.0, 20_000.0, 1e6];

/// Number of temperatures a rule is checked at for a given tolerance, evenly in 1/T over the range of nodes.
const DENSE_CHECKS: usize = 48;
/// Available node counts.
const FEWEST: usize = 2;
const MOST: usize = 28;
/// An error seen at those temperatures is taken to be at most this much larger between them.
const MARGIN: f64 = 2.0;
/// Rounding error of the 1 nm sum, relative to the largest signal: the exponents that weigh are below 40.
const SUM_ROUNDING: f64 = 1e-14;

/// Method by which a locus was computed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum LocusMethod {
    /// Quadrature made for this sensor, checked against the 1 nm sum.
    Nodes {
        /// The nodes of the largest channel.
        count: usize,
        /// The largest error seen in the checks, relative to the largest of the three signals.
        error: f64,
    },
    /// The 1 nm sum itself.
    Sum,
}

/// One channel's rule: wavelengths in nanometers with their weights.
type Channel = Vec<(f64, f64)>;

/// Evaluates `∫ C_c(λ) E(λ, T) dλ` for one sensor at any temperature, up to a factor common to the three channels.
///
/// Borrows the sensor (`&Sensor`) or shares it.
///
/// Per channel the Gauss rule of its own curve; for curves with negative lobes, which have none, the Gauss nodes of the
/// absolute curve with interpolatory weights. The fewest nodes are taken whose error against the 1 nm sum stays below the
/// target at nine temperatures from 1000 K to 10⁶ K; outside that range, and if no rule reaches the target, the sum itself in
/// ratio form, which is stable for any temperature.
#[derive(Clone, Debug)]
pub struct LocusEvaluator<S> {
    sensor: S,
    constants: RadiationConstants,
    anchor_nm: f64,
    all: Terms,
    nodes: Option<Terms>,
    method: LocusMethod,
}

impl<S: Deref<Target = Sensor>> LocusEvaluator<S> {
    /// The error aimed at, relative to the largest of the three signals.
    pub const TARGET: f64 = 1e-13;

    /// Makes the rules for a sensor and checks them. Costs as much as fifty sums or so.
    pub fn new(sensor: S, constants: RadiationConstants) -> Self {
        let mut evaluator = Self::by_sum(sensor, constants);
        let checks = evaluator.sums_at(CHECKS_K.into_iter());
        let mut best = f64::INFINITY;
        for count in COUNTS {
            let (nodes, count) = evaluator.rules(count);
            let error = evaluator.check(&nodes, &checks);
            if error < best {
                best = error;
                evaluator.method = LocusMethod::Nodes { count, error };
                evaluator.nodes = Some(nodes);
            }
            if best <= Self::TARGET {
                return evaluator;
            }
        }
        // A rule that missed the target by little is no reason for a thirty times slower sum; one that failed is.
        if best > 1e-11 {
            evaluator.nodes = None;
            evaluator.method = LocusMethod::Sum;
        }
        evaluator
    }

    /// The fewest nodes, from two up, that keep the three signals within a tolerance, relative to the largest of the three;
    /// the 1 nm sum if no number of nodes does.
    ///
    /// Checked at 48 temperatures from 1000 K to 10⁶ K, evenly in 1/T, against the 1 nm sum, with a margin of two; outside that
    /// range the sum itself is used. [`Self::method`] returns the error found. Costs about as much as a hundred sums.
    ///
    /// # Errors
    /// Below 1e-14 even the sum is rounded more.
    pub fn within(sensor: S, constants: RadiationConstants, accuracy: RelTolerance) -> Result<Self, Unmet> {
        accuracy.met_by(SUM_ROUNDING)?;
        let mut evaluator = Self::by_sum(sensor, constants);
        let last = (DENSE_CHECKS - 1) as f64;
        let kelvin = |i: usize| {
            let t = i as f64 / last;
            1.0 / ((1.0 - t) / NODES_FROM_K + t / NODES_TO_K)
        };
        // Rounding must not carry the ends out of the range.
        let inside = (0..DENSE_CHECKS).map(|i| kelvin(i).clamp(NODES_FROM_K, NODES_TO_K));
        let checks = evaluator.sums_at(inside);
        for count in FEWEST..=MOST {
            let (nodes, count) = evaluator.rules(count);
            let error = evaluator.check(&nodes, &checks);
            if accuracy.allows(MARGIN * error + SUM_ROUNDING) {
                evaluator.method = LocusMethod::Nodes { count, error };
                evaluator.nodes = Some(nodes);
                break;
            }
        }
        Ok(evaluator)
    }

    /// The 1 nm sum, whatever it costs: the reference.
    pub fn by_sum(sensor: S, constants: RadiationConstants) -> Self {
        let anchor_nm = last_response_nm(&sensor);
        let weights = |index: usize| [0, 1, 2].map(|c| sensor.weighted(c)[index]);
        let terms: Vec<(f64, [f64; 3])> = (0..COUNT)
            .map(|index| (wavelength_nm(index), weights(index)))
            .take_while(|&(nm, _)| nm <= anchor_nm)
            .collect();
        let all = Terms::shared(&terms, anchor_nm);
        Self { sensor, constants, anchor_nm, all, nodes: None, method: LocusMethod::Sum }
    }

    /// Method of this evaluator, with its error.
    pub fn method(&self) -> LocusMethod {
        self.method
    }

    /// The three raw integrals at a temperature, up to a positive factor common to the three.
    pub fn raw(&self, temperature: Kelvin) -> [f64; 3] {
        let t = temperature.get();
        let terms = self.nodes.as_ref().filter(|_| (NODES_FROM_K..=NODES_TO_K).contains(&t));
        terms.unwrap_or(&self.all).sums(self.scale(temperature))
    }

    /// c₂/T in nanometers, capped so that temperatures far below any body's stay finite too.
    fn scale(&self, temperature: Kelvin) -> f64 {
        (self.constants.second() * 1e9 / temperature.get()).min(1e300)
    }

    /// The three channels' rules, with the number of nodes of the largest.
    fn rules(&self, count: usize) -> (Terms, usize) {
        let channels = [0, 1, 2].map(|c| self.channel(c, count));
        let largest = channels.iter().map(Vec::len).max().unwrap_or(count);
        (Terms::own(&channels, self.anchor_nm), largest)
    }

    fn channel(&self, channel: usize, count: usize) -> Channel {
        let masses = self.sensor.weighted(channel).as_slice();
        let points: Vec<f64> = (0..COUNT).map(wavelength_nm).collect();
        let Rule { nodes, weights } = if masses.iter().all(|&m| m >= 0.0) {
            gauss_rule(&points, masses, count)
        } else {
            let absolute: Vec<f64> = masses.iter().map(|m| m.abs()).collect();
            // Interpolatory weights are exact to degree N − 1 only, not 2N − 1: half as many nodes again.
            let nodes = gauss_rule(&points, &absolute, count + count / 2).nodes;
            interpolatory_rule(&nodes, &points, masses)
        };
        nodes.into_iter().zip(weights).collect()
    }

    fn sums_at(&self, kelvins: impl Iterator<Item = f64>) -> Vec<(Kelvin, [f64; 3])> {
        let temperatures = kelvins.filter_map(|kelvins| Kelvin::new(kelvins).ok());
        temperatures.map(|t| (t, self.all.sums(self.scale(t)))).collect()
    }

    /// The largest error of candidate rules against the sum, relative to the largest of the three signals.
    fn check(&self, nodes: &Terms, checks: &[(Kelvin, [f64; 3])]) -> f64 {
        let mut worst = 0.0_f64;
        for &(temperature, exact) in checks {
            let found = nodes.sums(self.scale(temperature));
            let magnitude = exact.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
            let off = exact.iter().zip(found).fold(0.0_f64, |m, (a, b)| m.max((a - b).abs()));
            worst = worst.max(if magnitude > 0.0 { off / magnitude } else { f64::INFINITY });
        }
        worst
    }
}

/// The last grid wavelength at which any channel responds, in nanometers.
fn last_response_nm(sensor: &Sensor) -> f64 {
    let last = (0..COUNT).rev().find(|&index| (0..3).any(|c| sensor.weighted(c)[index] != 0.0));
    wavelength_nm(last.unwrap_or(COUNT - 1))
}
