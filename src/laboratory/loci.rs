//! Black bodies through the sensors on show, by each method.

use chromascope_core::accuracy::Accuracy;
use chromascope_core::camera::{LocusEvaluator, LocusMethod};
use chromascope_core::light::RadiationConstants;
use chromascope_core::query::{Ask, Shared};
use chromascope_core::spectral::Sensor;
use chromascope_core::units::Kelvin;

use super::method::{Method, largest, measured, together};
use super::stopwatch::once;
use super::{Family, Point, SceneRunOf, Subject, Trial};

/// So many temperatures, evenly in 1/T over the range on show.
const TEMPERATURES: usize = 200;
const FROM_K: f64 = 1000.0;
const TO_K: f64 = 20_000.0;
/// Of the 1 nm grid each so many-th wavelength is taken.
const STEPS: [usize; 5] = [1, 2, 5, 10, 20];
/// The tolerances that are tried, as powers of ten.
const TOLERANCES: [i32; 5] = [-2, -4, -6, -9, -12];

/// Measures; none without sensors, and if stopped.
pub(super) fn trial(run: &SceneRunOf, ask: &impl Ask) -> Option<Trial> {
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
        let sensor = sensor.clone();
        let at: Box<dyn Fn(Kelvin) -> [f64; 3]> = if step == 1 {
            let evaluator = LocusEvaluator::by_sum(sensor, constants);
            Box::new(move |t| evaluator.raw(t))
        } else {
            Box::new(move |t| stepped(&sensor, constants, t, step))
        };
        methods.push(method(format!("{step} nm sum"), Family::Sum, 0.0, None, at));
    }
    let (evaluator, preparation) = once(|| LocusEvaluator::new(sensor.clone(), constants));
    let (name, certified) = match evaluator.method() {
        LocusMethod::Nodes { count, error } => (format!("the program's: up to {count} nodes"), Some(error)),
        LocusMethod::Sum => ("the program's: the sum".to_owned(), None),
    };
    methods.push(method(name, Family::Quality, preparation, certified, Box::new(move |t| evaluator.raw(t))));
    for exponent in TOLERANCES {
        let Ok(accuracy) = Accuracy::new(10_f64.powi(exponent)) else { continue };
        let (evaluator, preparation) = once(|| LocusEvaluator::within(sensor.clone(), constants, accuracy));
        let Ok(evaluator) = evaluator else { continue };
        let name = format!("within 1e{exponent}");
        let certified = Some(accuracy.max_relative_error());
        methods.push(method(name, Family::Tolerance, preparation, certified, Box::new(move |t| evaluator.raw(t))));
    }
    methods
}

/// A trapezoid over each so many-th wavelength of the grid, relative to the exitance at its last wavelength.
fn stepped(sensor: &Sensor, constants: RadiationConstants, t: Kelvin, step: usize) -> [f64; 3] {
    use chromascope_core::spectral::grid::{COUNT, LAST_NM, wavelength_nm};
    let scale = constants.second() * 1e9 / t.get();
    let anchor = -(-scale / LAST_NM).exp_m1();
    let mut sums = [0.0; 3];
    for index in (0..COUNT).step_by(step) {
        let nm = wavelength_nm(index);
        let gap = (LAST_NM - nm) / (nm * LAST_NM);
        let e = (-scale * gap).exp() * (LAST_NM / nm).powi(5) * anchor / -(-scale / nm).exp_m1();
        for (c, sum) in sums.iter_mut().enumerate() {
            // The grid's weights hold the trapezoid's halves at its ends already.
            *sum += sensor.weighted(c)[index] * e;
        }
    }
    sums
}
