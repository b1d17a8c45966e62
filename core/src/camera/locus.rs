//! Black bodies through a sensor (Eq 15), by a few nodes instead of 401 samples, with the error that was checked.

use std::ops::Deref;

use crate::accuracy::{Accuracy, Unmet};
use crate::light::RadiationConstants;
use crate::math::exp::exp;
use crate::math::gauss::{Rule, gauss_rule, interpolatory_rule};
use crate::spectral::Sensor;
use crate::spectral::grid::{COUNT, wavelength_nm};
use crate::units::Kelvin;

/// Below this temperature a few nodes no longer suffice and the full sum is taken.
const NODES_FROM_K: f64 = 1000.0;
/// Above this the law is a polynomial in all but name; the full sum is taken only because no check covers it.
const NODES_TO_K: f64 = 1e6;
/// Node counts tried, fewest first.
const COUNTS: [usize; 7] = [10, 12, 14, 17, 20, 24, 28];
/// Temperatures at which a rule is checked against the full sum.
const CHECKS_K: [f64; 9] = [1000.0, 1100.0, 1300.0, 1700.0, 2500.0, 4000.0, 8000.0, 20_000.0, 1e6];

/// How many temperatures a rule is checked at where an accuracy is asked for, evenly in 1/T over the range of nodes.
const DENSE_CHECKS: usize = 48;
/// The node counts that can be asked for.
const FEWEST: usize = 2;
const MOST: usize = 28;
/// An error seen at those temperatures is taken to be at most this much larger between them.
const MARGIN: f64 = 2.0;
/// What rounding leaves of the 1 nm sum, relative to the largest signal: the exponents that weigh are below 40.
const SUM_ROUNDING: f64 = 1e-14;

/// The longest wavelength has the smallest exponent c₂/(λT). From here on exp − 1 loses nothing by cancellation, so that the
/// loops need no branch and vectorize; below (above 50000 K) the standard library's function of that name is taken.
const PLAIN_FROM: f64 = 0.35;

/// How a locus was computed.
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

/// One channel's rule with what depends on no temperature already multiplied.
#[derive(Clone, Debug, PartialEq)]
struct Channel {
    /// c₂/λ in kelvins, at each node.
    exponents: Vec<f64>,
    /// The rule's weight times (λ₀/λ)⁵, at each node.
    weights: Vec<f64>,
}

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
    grid: Box<[GridTerm; COUNT]>,
    channels: Option<[Channel; 3]>,
    method: LocusMethod,
}

/// What the sum needs of a grid wavelength λ, with λ₀ the anchor. Beyond it, where no channel responds, the fifth power is set to zero.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct GridTerm {
    /// 1/λ, in 1/nm.
    reciprocal: f64,
    /// (λ₀ − λ) / (λ λ₀), in 1/nm: the difference of the reciprocals without cancellation.
    gap: f64,
    /// (λ₀/λ)⁵.
    fifth: f64,
}

impl<S: Deref<Target = Sensor>> LocusEvaluator<S> {
    /// The error aimed at, relative to the largest of the three signals.
    pub const TARGET: f64 = 1e-13;

    /// Makes the rules for a sensor and checks them. Costs as much as fifty sums or so.
    pub fn new(sensor: S, constants: RadiationConstants) -> Self {
        let mut evaluator = Self::by_sum(sensor, constants);
        let checks: Vec<(f64, [f64; 3])> =
            CHECKS_K.iter().filter_map(|&t| Some((t, evaluator.sum(Kelvin::new(t).ok()?)))).collect();
        let mut best = f64::INFINITY;
        for count in COUNTS {
            let channels = [0, 1, 2].map(|c| evaluator.channel(c, count));
            let error = evaluator.check(&channels, &checks);
            if error < best {
                best = error;
                let count = channels.iter().map(|c| c.exponents.len()).max().unwrap_or(count);
                evaluator.method = LocusMethod::Nodes { count, error };
                evaluator.channels = Some(channels);
            }
            if best <= Self::TARGET {
                return evaluator;
            }
        }
        // A rule that missed the target by little is no reason for a thirty times slower sum; one that failed is.
        if best > 1e-11 {
            evaluator.channels = None;
            evaluator.method = LocusMethod::Sum;
        }
        evaluator
    }

    /// The fewest nodes, from two up, that keep the three signals within an accuracy, relative to the largest of the three;
    /// the 1 nm sum where no number of nodes does.
    ///
    /// Checked at 48 temperatures from 1000 K to 10⁶ K, evenly in 1/T, against the 1 nm sum, with a margin of two; outside that
    /// range the sum itself is taken. [`Self::method`] tells the error seen. Costs as much as a hundred sums or so.
    ///
    /// # Errors
    /// Below 1e-14 even the sum is rounded more.
    pub fn within(sensor: S, constants: RadiationConstants, accuracy: Accuracy) -> Result<Self, Unmet> {
        accuracy.met_by(SUM_ROUNDING)?;
        let mut evaluator = Self::by_sum(sensor, constants);
        let last = (DENSE_CHECKS - 1) as f64;
        let kelvin = |i: usize| {
            let t = i as f64 / last;
            1.0 / ((1.0 - t) / NODES_FROM_K + t / NODES_TO_K)
        };
        // Rounding must not carry the ends out of the range.
        let inside = (0..DENSE_CHECKS).map(|i| kelvin(i).clamp(NODES_FROM_K, NODES_TO_K));
        let checks: Vec<(f64, [f64; 3])> =
            inside.filter_map(|t| Some((t, evaluator.sum(Kelvin::new(t).ok()?)))).collect();
        for count in FEWEST..=MOST {
            let channels = [0, 1, 2].map(|c| evaluator.channel(c, count));
            let error = evaluator.check(&channels, &checks);
            if accuracy.allows(MARGIN * error + SUM_ROUNDING) {
                let count = channels.iter().map(|c| c.exponents.len()).max().unwrap_or(count);
                evaluator.method = LocusMethod::Nodes { count, error };
                evaluator.channels = Some(channels);
                break;
            }
        }
        Ok(evaluator)
    }

    /// The 1 nm sum, whatever it costs: the reference.
    pub fn by_sum(sensor: S, constants: RadiationConstants) -> Self {
        let anchor_nm = last_response_nm(&sensor);
        let mut grid = Box::new([GridTerm::default(); COUNT]);
        for (index, term) in grid.iter_mut().enumerate() {
            let nm = wavelength_nm(index);
            term.reciprocal = 1.0 / nm;
            if nm <= anchor_nm {
                term.gap = (anchor_nm - nm) / (nm * anchor_nm);
                term.fifth = (anchor_nm / nm).powi(5);
            }
        }
        Self { sensor, constants, anchor_nm, grid, channels: None, method: LocusMethod::Sum }
    }

    /// How this evaluator works, with its error.
    pub fn method(&self) -> LocusMethod {
        self.method
    }

    /// The three raw integrals at a temperature, up to a positive factor common to the three.
    pub fn raw(&self, temperature: Kelvin) -> [f64; 3] {
        let t = temperature.get();
        match &self.channels {
            Some(channels) if (NODES_FROM_K..=NODES_TO_K).contains(&t) => self.by_nodes(channels, t),
            _ => self.sum(temperature),
        }
    }

    /// The 1 nm sum relative to the exitance at the sensor's last wavelength (the ratio of `relative_exitance`).
    fn sum(&self, temperature: Kelvin) -> [f64; 3] {
        let mut spectrum = [0.0; COUNT];
        // Capped so that temperatures far below any body's stay finite too.
        let scale = (self.constants.second() * 1e9 / temperature.get()).min(1e300);
        let anchor = -(-scale / self.anchor_nm).exp_m1();
        let terms = spectrum.iter_mut().zip(self.grid.iter());
        if scale / self.anchor_nm > PLAIN_FROM {
            for (value, term) in terms {
                *value = exp(-scale * term.gap) * term.fifth * anchor / (1.0 - exp(-scale * term.reciprocal));
            }
        } else {
            for (value, term) in terms {
                *value = (-scale * term.gap).exp() * term.fifth * anchor / -(-scale * term.reciprocal).exp_m1();
            }
        }
        self.sensor.integrate(&spectrum)
    }

    /// The sum over the nodes, in the same scale as [`Self::sum`].
    fn by_nodes(&self, channels: &[Channel; 3], t: f64) -> [f64; 3] {
        let reciprocal = 1.0 / t;
        let anchor = self.constants.second() * 1e9 / self.anchor_nm * reciprocal;
        let scale = anchor.exp_m1();
        let plain = anchor > PLAIN_FROM;
        [0, 1, 2].map(|c: usize| {
            let Channel { exponents, weights } = &channels[c];
            let terms = exponents.iter().zip(weights);
            let sum: f64 = if plain {
                terms.map(|(e, w)| w / (exp(e * reciprocal) - 1.0)).sum()
            } else {
                terms.map(|(e, w)| w / (e * reciprocal).exp_m1()).sum()
            };
            sum * scale
        })
    }

    /// One channel's rule with `count` nodes.
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
        let c2 = self.constants.second() * 1e9;
        let weights = weights.iter().zip(&nodes).map(|(w, nm)| w * (self.anchor_nm / nm).powi(5)).collect();
        Channel { exponents: nodes.iter().map(|nm| c2 / nm).collect(), weights }
    }

    /// The largest error of candidate rules against the sum, relative to the largest of the three signals.
    fn check(&self, channels: &[Channel; 3], checks: &[(f64, [f64; 3])]) -> f64 {
        let mut worst = 0.0_f64;
        for &(kelvin, exact) in checks {
            let nodes = self.by_nodes(channels, kelvin);
            let magnitude = exact.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
            let off = exact.iter().zip(nodes).fold(0.0_f64, |m, (a, b)| m.max((a - b).abs()));
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
