//! The spectral integral: table beside nodes beside the sum over 401 wavelengths.

use chromascope_core::camera::rendering::white_divisors;
use chromascope_core::reflectance::Precision;
use chromascope_core::render::diffuse::{DARK, DiffuseTable, ROUGH, SMOOTH, by_moments, by_nodes, rough_basis};
use chromascope_core::render::{LAMBDA_0_NM, SpectralWeights};
use chromascope_core::spectral::GridSpectrum;

use crate::support;

/// Cameras and an observer with negative lobes.
const SUN: &str = "illuminants/direct_sun_astm_g173.csv";
const SENSORS: [&str; 4] = [support::REFERENCE, support::CIE_1931, support::NIKON_D70, support::CANON_10D];

/// Points of a square that leave no direction out (a rank-one lattice: the golden ratio).
fn lattice(count: usize) -> impl Iterator<Item = [f64; 2]> {
    (0..count).map(move |i| [i as f64 / count as f64, (i as f64 * 0.618_033_988_749_894_9).fract()])
}

/// Skin-like, leaf-like and white reflectances.
fn reflectances() -> [GridSpectrum; 3] {
    let skin =
        |nm: f64| 0.25 + 0.35 / (1.0 + (-(nm - 590.0) / 18.0).exp()) - 0.06 * (-((nm - 545.0) / 25.0).powi(2)).exp();
    let leaf =
        |nm: f64| 0.05 + 0.12 * (-((nm - 552.0) / 32.0).powi(2)).exp() + 0.45 / (1.0 + (-(nm - 712.0) / 9.0).exp());
    [GridSpectrum::from_fn(skin), GridSpectrum::from_fn(leaf), GridSpectrum::constant(1.0)]
}

fn measures(power: i32) -> Vec<SpectralWeights> {
    let light = support::light(SUN);
    let mut measures = Vec::new();
    for path in SENSORS {
        let sensor = support::sensor(path);
        let divisors = white_divisors(&sensor, &light).unwrap();
        for reflectance in reflectances() {
            measures.push(SpectralWeights::new(&sensor, &light, &reflectance, divisors, power));
        }
    }
    measures
}

/// The largest error of a channel relative to the largest channel at β = 0, over geometries.
fn worst(
    measure: &SpectralWeights,
    points: impl Iterator<Item = [f64; 2]>,
    transform: impl Fn(f64, f64) -> [f64; 3],
) -> f64 {
    let mut worst = 0.0_f64;
    for [kappa, beta] in points {
        let exact = by_nodes(measure.dense(), kappa, beta, Precision::Full);
        let peak = by_nodes(measure.dense(), kappa, 0.0, Precision::Full);
        let peak = peak.into_iter().map(f64::abs).fold(0.0, f64::max);
        let found = transform(kappa, beta);
        for c in 0..3 {
            worst = worst.max((found[c] - exact[c]).abs() / peak);
        }
    }
    worst
}

fn within(low: f64, high: f64, t: f64) -> f64 {
    low * (high / low).powf(t)
}

#[test]
fn the_table_keeps_its_error() {
    for power in [0, 2] {
        for measure in measures(power) {
            let table = DiffuseTable::new(&measure);
            let points = lattice(150).map(|[s, t]| [within(SMOOTH, ROUGH, s), within(1.0, 4e4, t) - 1.0]);
            let error = worst(&measure, points, |kappa, beta| table.at(kappa, beta));
            assert!(error < 2e-6, "{error:.2e}");
            // Where most of a picture lies.
            let points = lattice(100).map(|[s, t]| [within(0.5, ROUGH, s), within(1.0, 21.0, t) - 1.0]);
            let error = worst(&measure, points, |kappa, beta| table.at(kappa, beta));
            assert!(error < 2e-6, "{error:.2e}");
        }
    }
}

#[test]
fn moments_keep_their_error_and_meet_the_table() {
    for measure in measures(2) {
        let table = DiffuseTable::new(&measure);
        let points = lattice(200).map(|[s, t]| [within(ROUGH, 1e8, s), within(1.0, 1.0 + DARK, t) - 1.0]);
        let moments = |kappa, beta| by_moments(measure.moments(), &rough_basis(kappa, beta));
        let error = worst(&measure, points, moments);
        assert!(error < 2e-6, "{error:.2e}");
        let meeting = (0..40).map(|i| [ROUGH, f64::from(i) * 0.7]);
        let error = worst(&measure, meeting, |kappa, beta| {
            let (a, b) = (table.at(kappa, beta), moments(kappa, beta));
            let exact = by_nodes(measure.dense(), kappa, beta, Precision::Full);
            [0, 1, 2].map(|c: usize| exact[c] + (a[c] - b[c]))
        });
        assert!(error < 4e-6, "{error:.2e}");
    }
}

#[test]
fn fifteen_nodes_are_good_to_a_billionth() {
    for measure in measures(2) {
        let points = lattice(200).map(|[s, t]| [within(1e-4, 1e5, s), within(1.0, 1e3, t) - 1.0]);
        let error = worst(&measure, points, |kappa, beta| by_nodes(measure.fine(), kappa, beta, Precision::Full));
        assert!(error < 1e-9, "{error:.2e}");
    }
}

#[test]
fn beyond_the_dark_limit_there_is_nothing_to_see() {
    for measure in measures(2) {
        let points = lattice(200).map(|[s, t]| [within(ROUGH, 1e6, s), within(DARK, 1e3, t)]);
        let error = worst(&measure, points, |_, _| [0.0; 3]);
        // e^-30 but for the heavier tail of κ near its limit.
        assert!(error < 1e-9, "{error:.2e}");
    }
}

#[test]
fn weights_sum_to_the_plain_integrals() {
    let light = support::light(SUN);
    let sensor = support::sensor(support::REFERENCE);
    let divisors = white_divisors(&sensor, &light).unwrap();
    let white = SpectralWeights::new(&sensor, &light, &GridSpectrum::constant(1.0), divisors, 0);
    for total in white.totals() {
        assert!((total - 1.0).abs() < 1e-13);
    }
    for nodes in [white.coarse(), white.fine()] {
        for c in 0..3 {
            let sum: f64 = nodes.iter().map(|node| node.weights[c]).sum();
            assert!((sum - 1.0).abs() < 1e-9, "{sum}");
        }
    }
    let first = white.dense().iter().map(|node| node.weights[0] * (node.wavelength_nm / LAMBDA_0_NM).powi(2));
    assert!((first.sum::<f64>() / white.moments()[0][0] - 1.0).abs() < 1e-13);
}

#[test]
fn a_black_material_gives_nothing_everywhere() {
    let light = support::light(SUN);
    let sensor = support::sensor(support::NIKON_D70);
    let divisors = white_divisors(&sensor, &light).unwrap();
    let black = SpectralWeights::new(&sensor, &light, &GridSpectrum::constant(0.0), divisors, 2);
    assert_eq!(black.totals(), [0.0; 3]);
    assert_eq!(DiffuseTable::new(&black).at(1.0, 1.0), [0.0; 3]);
    assert_eq!(by_nodes(black.fine(), 1.0, 1.0, Precision::Full), [0.0; 3]);
}
