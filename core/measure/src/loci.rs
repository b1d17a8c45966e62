//! The methods of the three signals of blackbodies through a sensor (Eq 14).
//!
//! Signals are up to a factor common to the three channels and all temperatures of a method, which no chromaticity shows.

use crate::method::Family;
use chromascope_core::accuracy::{RelTolerance, Unmet};
use chromascope_core::camera::{LocusEvaluator, LocusMethod as CoreMethod};
use chromascope_core::light::RadiationConstants;
use chromascope_core::spectral::Sensor;
use chromascope_core::spectral::grid::{COUNT, wavelength_nm};
use chromascope_core::units::Kelvin;
use chromascope_math::exp::exp;
use chromascope_math::gauss;
use std::sync::Arc;

/// Steps of the sums over the 1 nm grid, in nanometers.
const STEPS: [usize; 5] = [1, 2, 5, 10, 20];
/// The tolerances that are tried, as powers of ten.
const TOLERANCES: [i32; 5] = [-2, -4, -6, -9, -12];
/// Name of the method that the program takes.
pub const CHECKED_NODES: &str = "the program's nodes";

/// A method by its name.
pub struct LocusMethod<'a> {
    /// Its name.
    pub name: String,
    /// Its kind.
    pub family: Family,
    /// Prepares it: everything that is done once, before the first temperature.
    pub make: Box<dyn Fn() -> Result<Prepared<'a>, Unmet> + Send + Sync + 'a>,
}

/// A method that is ready.
#[derive(Clone)]
pub struct Prepared<'a> {
    /// Signals of a temperature.
    pub raw: Arc<dyn Fn(Kelvin) -> [f64; 3] + Send + Sync + 'a>,
    /// Estimated error bound relative to the largest of the three signals, where there is one.
    pub error_bound: Option<f64>,
}

impl<'a> Prepared<'a> {
    fn new(raw: impl Fn(Kelvin) -> [f64; 3] + Send + Sync + 'a) -> Self {
        Self { raw: Arc::new(raw), error_bound: None }
    }

    fn evaluator(evaluator: LocusEvaluator<&'a Sensor>) -> Self {
        let error_bound = match evaluator.method() {
            CoreMethod::Nodes { error, .. } => Some(error),
            CoreMethod::Sum => None,
        };
        Self { error_bound, ..Self::new(move |t| evaluator.raw(t)) }
    }
}

fn method<'a>(
    name: impl Into<String>,
    family: Family,
    make: impl Fn() -> Result<Prepared<'a>, Unmet> + Send + Sync + 'a,
) -> LocusMethod<'a> {
    LocusMethod { name: name.into(), family, make: Box::new(make) }
}

/// All methods of the program and plain sums, the sum over each nanometer first.
pub fn locus_methods(sensor: &Sensor, constants: RadiationConstants) -> Vec<LocusMethod<'_>> {
    let sum = |step: usize| {
        let make = move || {
            let terms = plain_terms(sensor, constants, step);
            Ok(Prepared::new(move |t| plain_sum(&terms, t)))
        };
        method(format!("{step} nm sum"), Family::Sum, make)
    };
    let mut methods: Vec<LocusMethod<'_>> = STEPS.map(sum).into();
    let by_sum = move || Ok(Prepared::evaluator(LocusEvaluator::by_sum(sensor, constants)));
    methods.push(method("the program's 1 nm sum", Family::Quality, by_sum));
    let nodes = move || Ok(Prepared::evaluator(LocusEvaluator::new(sensor, constants)));
    methods.push(method(CHECKED_NODES, Family::Quality, nodes));
    for exponent in TOLERANCES {
        let Ok(tolerance) = RelTolerance::new(10_f64.powi(exponent)) else { continue };
        let within = move || {
            let evaluator = LocusEvaluator::within(sensor, constants, tolerance)?;
            let error_bound = Some(tolerance.max_relative_error());
            Ok(Prepared { error_bound, ..Prepared::evaluator(evaluator) })
        };
        methods.push(method(format!("within 1e{exponent}"), Family::Tolerance, within));
    }
    methods
}

/// The Gauss rule of the given size for each channel's own weights.
pub fn gauss_rule(sensor: &Sensor, constants: RadiationConstants, count: usize) -> LocusMethod<'_> {
    let make = move || {
        let points: Vec<f64> = (0..COUNT).map(wavelength_nm).collect();
        let channels = [0, 1, 2].map(|c: usize| {
            let rule = gauss::gauss_rule(&points, sensor.weighted(c), count);
            let term = |(&nm, &weight): (&f64, &f64)| {
                let (rate, fifth) = law(constants, nm);
                (rate, weight * fifth)
            };
            rule.nodes.iter().zip(&rule.weights).map(term).collect::<Vec<_>>()
        });
        let sum = move |t: Kelvin| {
            let reciprocal = 1.0 / t.get();
            [0, 1, 2].map(|c: usize| {
                channels[c].iter().map(|(rate, weight)| weight / (exp(rate * reciprocal) - 1.0)).sum::<f64>()
            })
        };
        Ok(Prepared::new(sum))
    };
    method(format!("Gauss {count}"), Family::Sum, make)
}

/// The parts of Planck's law at a wavelength that depend on no temperature: c₂/λ in kelvins and (550 nm/λ)⁵.
fn law(constants: RadiationConstants, nm: f64) -> (f64, f64) {
    (constants.second() * 1e9 / nm, (550.0 / nm).powi(5))
}

/// Of every `step`-th wavelength of the grid c₂/λ and the three weights.
fn plain_terms(sensor: &Sensor, constants: RadiationConstants, step: usize) -> Vec<(f64, [f64; 3])> {
    let term = |index: usize| {
        let (rate, fifth) = law(constants, wavelength_nm(index));
        // The grid's weights hold the trapezoid's halves at its ends already.
        (rate, [0, 1, 2].map(|c: usize| sensor.weighted(c)[index] * fifth))
    };
    (0..COUNT).step_by(step).map(term).collect()
}

/// `Σ w (λ₀/λ)⁵ / (exp(c₂/λT) − 1)`, one wavelength after the other.
fn plain_sum(terms: &[(f64, [f64; 3])], t: Kelvin) -> [f64; 3] {
    let reciprocal = 1.0 / t.get();
    let mut sums = [0.0; 3];
    for (rate, weights) in terms {
        let value = 1.0 / (exp(rate * reciprocal) - 1.0);
        sums.iter_mut().zip(weights).for_each(|(sum, weight)| *sum += weight * value);
    }
    sums
}
