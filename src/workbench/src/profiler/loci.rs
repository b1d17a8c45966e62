//! Blackbodies through the visible sensors, by each method.

use chromascope_core::light::RadiationConstants;
use chromascope_core::query::{Ask, Shared};
use chromascope_core::spectral::Sensor;
use chromascope_core::units::Kelvin;
use chromascope_measure::harness::timed;
use chromascope_measure::loci::{LocusMethod, locus_methods};
use chromascope_measure::method::{Method, Point, compare, largest, together};

use super::{SceneRunJob, Subject, Trial};

/// Number of temperatures, evenly spaced in 1/T over the visible range.
const TEMPERATURES: usize = 200;
const FROM_K: f64 = 1000.0;
const TO_K: f64 = 20_000.0;

/// Measures; none without sensors, and if stopped.
pub(super) fn trial(run: &SceneRunJob, ask: &impl Ask) -> Option<Trial> {
    let temperatures: Vec<Kelvin> = (0..TEMPERATURES)
        .filter_map(|i| {
            let t = i as f64 / (TEMPERATURES - 1) as f64;
            Kelvin::new(1.0 / (1.0 / FROM_K + t * (1.0 / TO_K - 1.0 / FROM_K))).ok()
        })
        .collect();
    let through = |sensor: &Shared<Sensor>| {
        let methods = locus_methods(sensor, RadiationConstants::Paper);
        let methods: Vec<Method<'_>> = methods.into_iter().filter_map(|method| ready(method, &temperatures)).collect();
        compare(&methods, |_, value, exact| off(value, exact), &ask.stop())
    };
    let sensors: Vec<Vec<Point>> = run.sensors.iter().map(through).collect::<Option<_>>()?;
    let points = together(&sensors);
    (!points.is_empty()).then_some(Trial { subject: Subject::Loci, inputs: temperatures.len(), points, set: None })
}

/// A method with its preparation done; none where a tolerance cannot be met.
fn ready<'a>(method: LocusMethod<'a>, temperatures: &'a [Kelvin]) -> Option<Method<'a>> {
    let (made, preparation) = timed(&method.make);
    let made = made.ok()?;
    let values = Box::new(move || temperatures.iter().map(|&t| (made.raw)(t)).collect());
    Some(Method { name: method.name, family: method.family, preparation, error_bound: made.error_bound, values })
}

/// Largest difference of two triples of signals, as shares of the largest signal of each: methods may differ by a common factor.
fn off(value: [f64; 3], exact: [f64; 3]) -> f64 {
    let (mine, theirs) = (largest(value), largest(exact));
    if !(mine > 0.0 && theirs > 0.0) {
        return if mine == theirs { 0.0 } else { 1.0 };
    }
    value.iter().zip(exact).fold(0.0, |worst, (a, b)| worst.max((a / mine - b / theirs).abs()))
}
