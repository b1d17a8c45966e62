//! Black bodies through the sensors on show, by each method.

use chromascope_core::accuracy::RelTolerance;
use chromascope_core::camera::{LocusEvaluator, LocusMethod};
use chromascope_core::light::RadiationConstants;
use chromascope_core::query::{Ask, Shared};
use chromascope_core::spectral::Sensor;
use chromascope_core::spectral::grid::{COUNT, LAST_NM, wavelength_nm};
use chromascope_core::units::Kelvin;
use chromascope_math::exp::exp;

use super::method::{Method, largest, measured, together};
use super::stopwatch::once;
use super::{Family, Point, SceneRunQuery, Subject, Trial};

/// So many temperatures, evenly in 1/T over the range on show.
const TEMPERATURES: usize = 200;
const FROM_K: f64 = 1000.0;
const TO_K: f64 = 20_000.0;
/// Of the 1 nm grid each so many-th wavelength is taken.
const STEPS: [usize; 5] = [1, 2, 5, 10, 20];
/// The tolerances that are tried, as powers of ten.
const TOLERANCES: [i32; 5] = [-2, -4, -6, -9, -12];

/// Measures; none without sensors, and if stopped.
pub(super) fn trial(run: &SceneRunQuery, ask: &impl Ask) -> Option<Trial> {
    let temperatures: Vec<Kelvin> = (0..TEMPERATURES)
        .filter_map(|i| {
            let t = i as f64 / (TEMPERATURES - 1) as f64;
            Kelvin::new(1.0 / (1.0 / FROM_K + t * (1.0 / TO_K - 1.0 / FROM_K))).ok()
        })
        .collect();
    let through = |sensor: &Shared<Sensor>| {
        let methods = methods(sensor, RadiationConstants::Paper, &temperatures);
        measured(&methods, |_, value, exact| off(value, exact), &ask.stop())
    };
    let sources: Vec<Vec<Point>> = run.sensors.iter().map(through).collect::<Option<_>>()?;
    let points = together(&sources);
    (!points.is_empty()).then_some(Trial { subject: Subject::Loci, inputs: temperatures.len(), points, set: None })
}

/// How far apart two triples of signals are, relative to the largest. Methods may differ by a factor common to the three,
/// which no chromaticity shows: they are compared as shares of their largest.
fn off(value: [f64; 3], exact: [f64; 3]) -> f64 {
    let (mine, theirs) = (largest(value), largest(exact));
    if !(mine > 0.0 && theirs > 0.0) {
        return if mine == theirs { 0.0 } else { 1.0 };
    }
    value.iter().zip(exact).fold(0.0, |worst, (a, b)| worst.max((a / mine - b / theirs).abs()))
}

/// The methods, the reference first.
fn methods<'a>(sensor: &Shared<Sensor>, constants: RadiationConstants, temperatures: &'a [Kelvin]) -> Vec<Method<'a>> {
    let method = |name, family, preparation, certified, at: Box<dyn Fn(Kelvin) -> [f64; 3] + 'a>| {
        let values = Box::new(move || temperatures.iter().map(|&t| at(t)).collect());
        Method { name, family, preparation, certified, values }
    };
    let mut methods = Vec::new();
    for step in STEPS {
        let (stepped, preparation) = once(|| Stepped::new(sensor, constants, step));
        let at = Box::new(move |t| stepped.raw(t));
        methods.push(method(format!("{step} nm sum"), Family::Sum, preparation, None, at));
    }
    let (evaluator, preparation) = once(|| LocusEvaluator::by_sum(sensor.clone(), constants));
    let name = "the program's 1 nm sum, several wavelengths at once".to_owned();
    methods.push(method(name, Family::Quality, preparation, None, Box::new(move |t| evaluator.raw(t))));
    let (evaluator, preparation) = once(|| LocusEvaluator::new(sensor.clone(), constants));
    let (name, certified) = match evaluator.method() {
        LocusMethod::Nodes { count, error } => (format!("the program's: up to {count} nodes"), Some(error)),
        LocusMethod::Sum => ("the program's: the sum".to_owned(), None),
    };
    methods.push(method(name, Family::Quality, preparation, certified, Box::new(move |t| evaluator.raw(t))));
    for exponent in TOLERANCES {
        let Ok(accuracy) = RelTolerance::new(10_f64.powi(exponent)) else { continue };
        let (evaluator, preparation) = once(|| LocusEvaluator::within(sensor.clone(), constants, accuracy));
        let Ok(evaluator) = evaluator else { continue };
        let name = format!("within 1e{exponent}");
        let certified = Some(accuracy.max_relative_error());
        methods.push(method(name, Family::Tolerance, preparation, certified, Box::new(move |t| evaluator.raw(t))));
    }
    methods
}

/// A trapezoid over each so many-th wavelength of the grid, one after the other, relative to the exitance at the last.
///
/// ```text
/// Σ w (λ₀/λ)⁵ e^-(x − x₀) (1 − e^-x₀)/(1 − e^-x),   x = c₂/(λT),   x₀ = c₂/(λ₀T)
/// ```
struct Stepped {
    /// c₂ in nm K.
    second: f64,
    /// Of each wavelength 1/λ in 1/nm and the three weights times (λ₀/λ)⁵.
    terms: Vec<(f64, [f64; 3])>,
}

impl Stepped {
    fn new(sensor: &Sensor, constants: RadiationConstants, step: usize) -> Self {
        let term = |index: usize| {
            let nm = wavelength_nm(index);
            // The grid's weights hold the trapezoid's halves at its ends already.
            (1.0 / nm, [0, 1, 2].map(|c: usize| sensor.weighted(c)[index] * (LAST_NM / nm).powi(5)))
        };
        let terms = (0..COUNT).step_by(step).map(term).collect();
        Self { second: constants.second() * 1e9, terms }
    }

    fn raw(&self, t: Kelvin) -> [f64; 3] {
        let scale = self.second / t.get();
        let last = scale / LAST_NM;
        let anchor = -(-last).exp_m1();
        let mut sums = [0.0; 3];
        for (reciprocal, weights) in &self.terms {
            let x = scale * reciprocal;
            let value = anchor * exp(last - x) / (1.0 - exp(-x));
            sums.iter_mut().zip(weights).for_each(|(sum, weight)| *sum += weight * value);
        }
        sums
    }
}

#[cfg(test)]
mod tests {
    use chromascope_core::render::Stop;

    use super::*;
    use crate::catalog::Catalog;
    use crate::document::Document;
    use crate::document::SetKind;
    use crate::results::Results;
    use crate::scene::Scene;

    #[test]
    fn sums_of_one_kind_compare() {
        let (document, catalog, results) = (Document::paper(), Catalog::built_in(), Results::default());
        let scene = Scene { document: &document, catalog: &catalog, results: &results };
        let sensor = scene.sensor(SetKind::Camera, "Nikon D70 (2007 figure)").expect("a built-in camera");
        let temperatures: Vec<Kelvin> = (1..=20).filter_map(|i| Kelvin::new(1000.0 * f64::from(i)).ok()).collect();
        let terms = STEPS.map(|step| Stepped::new(&sensor, RadiationConstants::Paper, step).terms.len());
        assert_eq!(terms, [401, 201, 81, 41, 21], "a step of 20 nm adds a twentieth of the terms");
        let methods = methods(&sensor, RadiationConstants::Paper, &temperatures);
        let points = measured(&methods, |_, value, exact| off(value, exact), &Stop::NEVER).expect("nothing stops it");
        for step in STEPS {
            let name = format!("{step} nm sum");
            assert!(points.iter().any(|point| point.name == name), "{name} is measured");
        }
        let program = points.iter().find(|point| point.name.starts_with("the program's 1 nm sum")).expect("one");
        assert!(program.max < 1e-13, "two ways to the same sum: {:e}", program.max);
    }
}
