//! Methods of the locus against the plain sum.

use chromascope_core::light::RadiationConstants;
use chromascope_core::spectral::grid::{COUNT, wavelength_nm};
use chromascope_core::spectral::{Primaries, Response, Sensor, SpectralDistribution};
use chromascope_core::units::Kelvin;
use chromascope_measure::loci::{LocusMethod, gauss_rule, locus_methods};

fn camera() -> Sensor {
    let curve = |at: f64| {
        let sample = |i: i32| {
            let nm = 380.0 + f64::from(i);
            (nm, (-((nm - at) / 40.0).powi(2)).exp())
        };
        let (wavelengths, values): (Vec<f64>, Vec<f64>) = (0..=400).map(sample).unzip();
        SpectralDistribution::new(wavelengths, values).expect("a curve")
    };
    let curves = [600.0, 540.0, 460.0].map(curve);
    Sensor::new(Primaries::Camera, curves, Response::PerEnergy).expect("a sensor")
}

/// The sum as it is written, over every `step`-th wavelength.
fn plain_sum(sensor: &Sensor, step: usize, kelvins: f64) -> [f64; 3] {
    let second = RadiationConstants::Paper.second() * 1e9;
    let term = |index: usize, c: usize| {
        let nm = wavelength_nm(index);
        sensor.weighted(c)[index] * (550.0 / nm).powi(5) / (second / (nm * kelvins)).exp_m1()
    };
    [0, 1, 2].map(|c: usize| (0..COUNT).step_by(step).map(|index| term(index, c)).sum())
}

#[test]
fn a_step_of_20_nm_takes_a_twentieth_of_the_terms() {
    let sensor = camera();
    let methods = locus_methods(&sensor, RadiationConstants::Paper);
    for (method, step) in methods.iter().zip([1, 2, 5, 10, 20]) {
        assert_eq!(method.name, format!("{step} nm sum"));
        let found = ((method.make)().unwrap().raw)(Kelvin::new(5500.0).unwrap());
        for (found, expected) in found.into_iter().zip(plain_sum(&sensor, step, 5500.0)) {
            assert!((found / expected - 1.0).abs() < 1e-13, "{step} nm: {found:e}, not {expected:e}");
        }
    }
}

#[test]
fn each_method_agrees_with_the_plain_sum_as_far_as_it_says() {
    let sensor = camera();
    let shares = |method: &LocusMethod<'_>, kelvins: f64| {
        let made = (method.make)().expect("within reach");
        let raw = (made.raw)(Kelvin::new(kelvins).expect("a temperature"));
        let largest = raw.into_iter().fold(0.0_f64, f64::max);
        (raw.map(|signal| signal / largest), made.error_bound)
    };
    let mut methods = locus_methods(&sensor, RadiationConstants::Paper);
    methods.push(gauss_rule(&sensor, RadiationConstants::Paper, 12));
    for kelvins in [1000.0, 5500.0, 20_000.0] {
        let (exact, _) = shares(&methods[0], kelvins);
        for method in methods.iter().filter(|method| !method.name.ends_with("nm sum") || method.name.len() > 9) {
            let (found, bound) = shares(method, kelvins);
            let off = found.iter().zip(exact).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            assert!(off <= bound.unwrap_or(0.0).max(1e-12), "{} at {kelvins} K: {off:e}", method.name);
        }
    }
}
