//! The spectral integral by plans, moments and nodes beside the sum over 401 wavelengths.

use chromascope_core::accuracy::RelTolerance;
use chromascope_core::camera::rendering::white_divisors;
use chromascope_core::reflectance::Precision;
use chromascope_core::render::diffuse::{DARK, NEARLY_ROUGH, ROUGH, by_moments, by_nodes, by_regimes, rough_basis};
use chromascope_core::render::{Demand, IntegrationMethod, LAMBDA_0_NM, Plan, Quality, SpectralWeights};
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
fn plans_of_pictures_keep_their_tolerance() {
    // Every range of κ that pictures request, few samples and many, and the κ beyond its ends.
    for (power, tolerance) in [(0, 1e-5), (2, 1e-5), (2, 1e-9)] {
        for (i, measure) in measures(power).iter().enumerate() {
            let kappa = [[0.3, 90.0], [1e-6, 1e5], [200.0, 1e6]][i % 3];
            let demand = Demand::of_picture(kappa, if i % 2 == 0 { 100_000 } else { 300 });
            let plan = Plan::new(measure, RelTolerance::new(tolerance).unwrap(), demand).unwrap();
            let points = lattice(200).map(|[s, t]| [within(kappa[0], kappa[1], s), within(1.0, 1e3, t) - 1.0]);
            let ends = lattice(40).map(|[s, t]| [within(1e-15, 1e-10, s), 200.0 * t]);
            let ends = ends.chain(lattice(40).map(|[s, t]| [within(1e9, 1e15, s), 40.0 * t]));
            let error = worst(measure, points.chain(ends), |kappa, beta| plan.at(kappa, beta));
            assert!(error < tolerance, "{error:.2e}: {}", plan.explanation());
        }
    }
}

#[test]
fn fixed_plans_keep_what_is_known_of_them() {
    for measure in measures(2) {
        for quality in [Quality::Preview, Quality::Full, Quality::Fine] {
            let plan = Plan::fixed(&measure, quality);
            let points = lattice(200).map(|[s, t]| [within(1e-4, 1e5, s), within(1.0, 1e3, t) - 1.0]);
            let error = worst(&measure, points, |kappa, beta| plan.at(kappa, beta));
            assert!(error < 2.0 * plan.explanation().error_bound(), "{quality:?}: {error:.2e}");
            assert!(quality.tolerance().unwrap().allows(error), "{quality:?}: {error:.2e}");
        }
        let [reference, regimes] = [Quality::Reference, Quality::Regimes].map(|quality| Plan::fixed(&measure, quality));
        assert_eq!(reference.at(3.0, 2.0), by_nodes(measure.dense(), 3.0, 2.0, Precision::Full));
        assert_eq!(regimes.at(3.0, 2.0), by_regimes(measure.dense(), 3.0, 2.0));
    }
}

#[test]
fn a_plan_says_how_each_sample_is_integrated() {
    let measure = &measures(2)[0];
    let plan = Plan::fixed(measure, Quality::Full);
    let said = |plan: &Plan, kappa, beta| plan.method(kappa, beta).to_string();
    assert_eq!(said(&plan, 200.0, 1.0), "8 moments (κ ≥ 64.0)");
    assert_eq!(said(&plan, 2.0, 1.0), "9 wavelengths for all channels, S to 1e-10");
    assert_eq!(plan.method(2.0, 1.0).node_count(), 9);
    assert_eq!(plan.method(2.0, 1e6), IntegrationMethod::Nothing);
    assert_eq!(said(&Plan::fixed(measure, Quality::Reference), 2.0, 1e6), "all 401 wavelengths, S to 1e-13");
    assert_eq!(Plan::fixed(measure, Quality::Regimes).method(2.0, 1.0), IntegrationMethod::Regimes);
    let demand = Demand::of_picture([1e-6, 90.0], 100_000);
    let plan = Plan::new(measure, RelTolerance::new(1e-5).unwrap(), demand).unwrap();
    let methods = [1e3, 5.0, 1e-9].map(|kappa| plan.method(kappa, 0.1));
    assert!(matches!(methods[0], IntegrationMethod::Moments { .. }), "{methods:?}");
    assert!(matches!(methods[1], IntegrationMethod::Table { .. }), "{methods:?}");
    assert!(matches!(methods[2], IntegrationMethod::Shared { .. }), "{methods:?}");
    assert_eq!(methods.map(|method| method.node_count() > 0), [false, false, true]);
}

/// Splines whose errors did not fall with the power of the spacing, four to ten by their degree, would need larger tables.
#[test]
fn tables_are_as_small_as_splines_allow() {
    for (tolerance, most) in [(1e-4, 4_600), (1e-6, 34_000), (1e-8, 370_000), (1e-10, 95_000)] {
        for measure in measures(2) {
            let demand = Demand::of_picture([0.3, 90.0], 100_000_000);
            let plan = Plan::new(&measure, RelTolerance::new(tolerance).unwrap(), demand).unwrap();
            let found = plan.method(5.0, 0.1);
            let IntegrationMethod::Table { kappas, betas, .. } = found else { panic!("{found}, to {tolerance:e}") };
            assert!(kappas * betas <= most, "{found}, to {tolerance:e}");
        }
    }
}

#[test]
fn moments_keep_their_error() {
    for measure in measures(2) {
        let points = lattice(200).map(|[s, t]| [within(ROUGH, 1e8, s), within(1.0, 1.0 + DARK, t) - 1.0]);
        let moments = |kappa, beta| by_moments(measure.moments(), &rough_basis(kappa, beta));
        let error = worst(&measure, points, moments);
        assert!(error < 1e-9, "{error:.2e}");
        let points = lattice(200).map(|[s, t]| [within(NEARLY_ROUGH, ROUGH, s), within(1.0, 1.0 + DARK, t) - 1.0]);
        let error = worst(&measure, points, moments);
        assert!(error < 1e-6, "{error:.2e}");
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
    for quality in [Quality::Preview, Quality::Full, Quality::Reference] {
        assert_eq!(Plan::fixed(&black, quality).at(1.0, 1.0), [0.0; 3]);
    }
    assert_eq!(by_nodes(black.fine(), 1.0, 1.0, Precision::Full), [0.0; 3]);
}
