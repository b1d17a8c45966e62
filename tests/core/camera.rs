//! Loci by a few nodes against the sum and against 50 digits; white balance, Eq 13 and fitted matrices.

use chromascope_core::camera::rendering::{raw, under_light};
use chromascope_core::camera::{
    ColorTransform, LocusEvaluator, LocusMethod, Rendering, RenderingError, WhiteBalanceTarget,
};
use chromascope_core::colorimetry::rgb::XYZ_FROM_SRGB;
use chromascope_core::colorimetry::{Xy, Xyz};
use chromascope_core::correction::Correction;
use chromascope_core::light::RadiationConstants;
use chromascope_core::light::planckian::black_body;
use chromascope_core::patch_set::PatchSet;
use chromascope_core::spectral::{GridSpectrum, Primaries, Response, Sensor, SpectralDistribution};
use chromascope_math::least_squares::FitError;
use glam::{DMat3, DVec3};
use proptest::collection::vec;
use proptest::prelude::*;

use crate::support::{
    CANON_10D, CIE_1931, DCS200, NIKON_D70, REFERENCE, assert_near, assert_xy, cases, chart, dataset, kelvin, light,
    measured, reference, sensor, sensors, training,
};

const PAPER: RadiationConstants = RadiationConstants::Paper;
const CONES: &str = "observers/cie_2006_2deg_cone_fundamentals.csv";

fn everyone() -> Vec<(String, Sensor)> {
    let mut all = sensors("cameras");
    all.extend(sensors("observers"));
    assert_eq!(all.len(), 66);
    all
}

fn chromaticity(rendering: &Rendering, raw: [f64; 3]) -> Option<Xy> {
    rendering.xyz(DVec3::from_array(raw) * rendering.locus_gain).chromaticity()
}

/// Temperatures from 1000 K to 10⁶ K that no check of the evaluator falls on: even in the logarithm by the golden ratio.
fn between_checks() -> impl Iterator<Item = f64> {
    (1..=300).map(|i| 1000.0 * 1000.0_f64.powf((f64::from(i) * 0.618_033_988_749_894_9).fract()))
}

/// Documented error bound of `LocusEvaluator`, for every sensor of the library by both methods.
#[test]
fn nodes_miss_the_sum_by_less_than_1e_12_in_xy() {
    let (equal_energy, reference, training) = (GridSpectrum::constant(1.0), sensor(CIE_1931), training());
    let observer =
        ColorTransform::Observer { reference: &reference, training: &training, correction: Correction::default() };
    let (mut worst, mut most) = (0.0_f64, 0);
    for (name, sensor) in everyone() {
        let (quick, sum) = (LocusEvaluator::new(&sensor, PAPER), LocusEvaluator::by_sum(&sensor, PAPER));
        assert_eq!(sum.method(), LocusMethod::Sum);
        let LocusMethod::Nodes { count, error } = quick.method() else { panic!("{name} falls back to the sum") };
        assert!(
            error <= LocusEvaluator::<&chromascope_core::spectral::Sensor>::TARGET,
            "{name}: {error} with {count} nodes"
        );
        let ways: Vec<Rendering> = [ColorTransform::Paper, observer]
            .into_iter()
            .filter_map(|transform| Rendering::new(&sensor, &equal_energy, WhiteBalanceTarget::UNITY, transform).ok())
            .collect();
        assert!(!ways.is_empty());
        let mut own = 0.0_f64;
        for t in between_checks() {
            let (a, b) = (quick.raw(kelvin(t)), sum.raw(kelvin(t)));
            for rendering in &ways {
                own = own.max(chromaticity(rendering, a).unwrap().distance(chromaticity(rendering, b).unwrap()));
            }
        }
        assert!(own <= 1e-12, "{name}: {own} with {count} nodes");
        (worst, most) = (worst.max(own), most.max(count));
    }
    // Measured: 6.2e-14 (Nikon D5100), 10 or 12 nodes, for curves with negative lobes up to 21.
    assert!(worst < 1e-13 && most <= 21, "{worst} with up to {most} nodes");
}

#[test]
fn loci_match_fifty_digits() {
    for row in reference("loci.csv") {
        let (t, x, y): (f64, f64, f64) = (row[1].parse().unwrap(), row[2].parse().unwrap(), row[3].parse().unwrap());
        let sensor = sensor(&row[0]);
        let rendering =
            Rendering::new(&sensor, &GridSpectrum::constant(1.0), WhiteBalanceTarget::UNITY, ColorTransform::Paper)
                .unwrap();
        for evaluator in [LocusEvaluator::new(&sensor, PAPER), LocusEvaluator::by_sum(&sensor, PAPER)] {
            let xy = chromaticity(&rendering, evaluator.raw(kelvin(t))).unwrap();
            assert_xy(&format!("{} at {t} K, {:?}", row[0], evaluator.method()), xy, [x, y], 1e-12);
        }
    }
}

proptest! {
    #![proptest_config(cases(128))]

    #[test]
    fn loci_are_total_over_all_temperatures(exponent in -300.0..300.0, which in 0_usize..4) {
        let sensor = sensor([REFERENCE, CANON_10D, DCS200, CIE_1931][which]);
        let signals = LocusEvaluator::new(&sensor, PAPER).raw(kelvin(10.0_f64.powf(exponent)));
        prop_assert!(signals.iter().all(|v| v.is_finite()), "{signals:?}");
        prop_assert!(signals.iter().any(|v| *v != 0.0));
    }
}

#[test]
fn the_locus_is_continuous_where_the_method_changes() {
    for (name, sensor) in everyone() {
        let evaluator = LocusEvaluator::new(&sensor, PAPER);
        for edge in [1000.0, 1e6] {
            let [a, b] =
                [edge * (1.0 - 1e-13), edge * (1.0 + 1e-13)].map(|t| DVec3::from_array(evaluator.raw(kelvin(t))));
            let jump = (a / a.abs().max_element() - b / b.abs().max_element()).abs().max_element();
            assert!(jump < 1e-11, "{name} jumps by {jump} at {edge} K");
        }
    }
}

#[test]
fn a_comb_of_a_sensor_is_evaluated_by_the_sum_or_right() {
    // Nothing smooth: a few nodes cannot know it, unless they are its points.
    let values: Vec<f64> = (0..401).map(|i| if i % 97 == 3 { 1.0 } else { -0.3 * f64::from(i % 7 == 0) }).collect();
    let curve = SpectralDistribution::new((0..401).map(|i| 380.0 + f64::from(i)).collect(), values).unwrap();
    let comb = Sensor::new(Primaries::Rgb, [curve.clone(), curve.clone(), curve], Response::PerEnergy).unwrap();
    let (quick, sum) = (LocusEvaluator::new(&comb, PAPER), LocusEvaluator::by_sum(&comb, PAPER));
    for t in between_checks() {
        let (a, b) = (quick.raw(kelvin(t)), sum.raw(kelvin(t)));
        assert_near("comb", a[0] / b[0], 1.0, 1e-9);
    }
}

#[test]
fn a_perfect_white_takes_the_reference_on_either_way() {
    let (reference, training) = (sensor(CIE_1931), training());
    let observer =
        ColorTransform::Observer { reference: &reference, training: &training, correction: Correction::default() };
    let ones = [1.0; 401];
    for path in ["illuminants/e.csv", "illuminants/a.csv", "illuminants/d65.csv"] {
        let light = light(path);
        let seen = DVec3::from_array(reference.integrate(light.values()));
        for white in [
            WhiteBalanceTarget::UNITY,
            WhiteBalanceTarget([1.1040, 0.9870, 0.8233]),
            WhiteBalanceTarget([2.3, 0.6, -0.05]),
        ] {
            for (name, sensor) in everyone() {
                let signals = |rendering: &Rendering| {
                    rendering.patch_signals(raw(&under_light(&sensor, &light), &ones).to_array())
                };
                let fitted = Rendering::new(&sensor, &light, white, observer).unwrap();
                let xyz = fitted.xyz(signals(&fitted)).to_vector();
                if sensor.primaries() != Primaries::Xyz {
                    assert_eq!(signals(&fitted).to_array(), white.0, "{name} {path}");
                    assert!((xyz - seen / seen.y).abs().max_element() < 1e-13, "{name} {path}");
                }
                let screen = DVec3::from_array(fitted.linear_srgb(Xyz::from_vector(xyz)));
                assert!((screen - DVec3::ONE).abs().max_element() < 1e-12, "{name} {path}: {screen}");
                assert_near(&name, fitted.lab(Xyz::from_vector(xyz)).unwrap().l, 100.0, 1e-10);
                let Ok(paper) = Rendering::new(&sensor, &light, white, ColorTransform::Paper) else { continue };
                if paper.is_rgb {
                    assert_eq!(signals(&paper).to_array(), white.0, "{name} {path}");
                    let xyz = paper.xyz(signals(&paper)).to_vector();
                    assert!((xyz - XYZ_FROM_SRGB * DVec3::from_array(white.0)).abs().max_element() < 1e-14);
                }
            }
        }
    }
}

#[test]
fn the_balance_moves_rgb_but_not_what_a_fitted_matrix_makes_of_it() {
    let (reference, training, camera) = (sensor(CIE_1931), training(), sensor(NIKON_D70));
    let (light, chart) = (light("illuminants/d55.csv"), chart());
    let transform =
        ColorTransform::Observer { reference: &reference, training: &training, correction: Correction::default() };
    let at = |white: WhiteBalanceTarget| {
        let rendering = Rendering::new(&camera, &light, white, transform).unwrap();
        let under = under_light(&camera, &light);
        let signals =
            chart.patches().iter().map(|patch| rendering.patch_signals(raw(&under, patch.grid.values()).to_array()));
        signals.map(|rgb| (rgb, rendering.xyz(rgb).to_vector())).collect::<Vec<_>>()
    };
    for ((rgb, xyz), (other_rgb, other_xyz)) in
        at(WhiteBalanceTarget::UNITY).iter().zip(at(WhiteBalanceTarget([1.5, 1.0, 0.4])))
    {
        assert!((*xyz - other_xyz).abs().max_element() < 1e-14);
        assert!((*rgb - other_rgb).abs().max_element() > 0.01);
    }
}

#[test]
fn fits_match_fifty_digits() {
    let (reference_observer, training) = (sensor(CIE_1931), training());
    let transform = ColorTransform::Observer {
        reference: &reference_observer,
        training: &training,
        correction: Correction::default(),
    };
    for row in reference("observer_fits.csv") {
        let rendering =
            Rendering::new(&sensor(&row[0]), &light(&row[1]), WhiteBalanceTarget::UNITY, transform).unwrap();
        let expected: Vec<f64> = row[2..].iter().map(|field| field.parse().unwrap()).collect();
        let rows = DMat3::from_cols_slice(&expected).transpose();
        let off = (rendering.xyz_from_signals - rows).to_cols_array().into_iter().fold(0.0_f64, |m, v| m.max(v.abs()));
        assert!(off < 1e-12, "{} {}: off by {off}", row[0], row[1]);
    }
}

#[test]
fn a_sensor_that_is_a_matrix_of_the_observer_is_the_observer() {
    // The Luther condition, which cone fundamentals of the same observer meet: CIE 2006 cones and CIE 2015 XYZ.
    let (reference, training) = (sensor("observers/cie_2015_2deg.csv"), training());
    let (cones, light, chart) = (sensor(CONES), light("illuminants/d65.csv"), chart());
    let fitted = Rendering::new(
        &cones,
        &light,
        WhiteBalanceTarget::UNITY,
        ColorTransform::Observer { reference: &reference, training: &training, correction: Correction::default() },
    )
    .unwrap();
    let direct = Rendering::new(&reference, &light, WhiteBalanceTarget::UNITY, ColorTransform::Paper).unwrap();
    for patch in chart.patches() {
        let signals = |sensor: &Sensor| raw(&under_light(sensor, &light), patch.grid.values()).to_array();
        let a = fitted.xyz(fitted.patch_signals(signals(&cones))).to_vector();
        let b = direct.xyz(direct.patch_signals(signals(&reference))).to_vector();
        // The two tables agree to 2e-6, as the header of the cones says.
        assert!((a - b).abs().max_element() < 5e-6, "{}: {a} {b}", patch.name);
    }
}

/// A light-emitting diode of full width `width` at half height.
fn diode(center: f64, width: f64) -> GridSpectrum {
    GridSpectrum::from_fn(|nm| (-4.0 * std::f64::consts::LN_2 * ((nm - center) / width).powi(2)).exp())
}

#[test]
fn a_balance_made_of_cancellation_is_refused_or_flagged() {
    let truth = sensor(REFERENCE);
    let made =
        |center: f64| Rendering::new(&truth, &diode(center, 20.0), WhiteBalanceTarget::UNITY, ColorTransform::Paper);
    let at_525 = made(525.0);
    assert!(at_525.as_ref().map_or(true, |r| r.conditioning < 0.05), "{at_525:?}");
    // The integral of r̄ changes its sign close by: somewhere there it is next to nothing.
    let (mut low, mut high) = (515.0, 535.0);
    let red = |center: f64| truth.integrate(diode(center, 20.0).values())[0];
    assert!(red(low) < 0.0 && red(high) > 0.0);
    for _ in 0..60 {
        let middle = f64::midpoint(low, high);
        if red(middle) < 0.0 { low = middle } else { high = middle }
    }
    assert!((523.0..527.0).contains(&low), "{low}");
    assert_eq!(made(low), Err(RenderingError::BlindToLight { channel: 0 }));
    assert!(made(low + 0.05).unwrap().conditioning < 0.01);
    // Ordinary light keeps most of it.
    for path in ["illuminants/e.csv", "illuminants/a.csv", "illuminants/d55.csv"] {
        let rendering = Rendering::new(&truth, &light(path), WhiteBalanceTarget::UNITY, ColorTransform::Paper).unwrap();
        assert!(rendering.conditioning > 0.85, "{path}: {}", rendering.conditioning);
    }
}

#[test]
fn a_channel_that_sees_nothing_of_the_light_is_named() {
    let camera = sensor(CANON_10D);
    let dark = GridSpectrum::constant(0.0);
    for transform in [
        ColorTransform::Paper,
        ColorTransform::Observer {
            reference: &sensor(CIE_1931),
            training: &training(),
            correction: Correction::default(),
        },
    ] {
        assert_eq!(
            Rendering::new(&camera, &dark, WhiteBalanceTarget::UNITY, transform),
            Err(RenderingError::BlindToLight { channel: 0 })
        );
    }
    // Beyond 700 nm the 2007 figure has nothing in any channel; at 699 nm green and blue are zero already.
    let red = GridSpectrum::from_fn(|nm| f64::from(nm == 700.0));
    assert_eq!(
        Rendering::new(&camera, &red, WhiteBalanceTarget::UNITY, ColorTransform::Paper),
        Err(RenderingError::BlindToLight { channel: 1 })
    );
    assert_eq!(
        Rendering::new(&sensor(CIE_1931), &dark, WhiteBalanceTarget::UNITY, ColorTransform::Paper),
        Err(RenderingError::BlindToLight { channel: 1 }),
        "an observer needs Y alone"
    );
}

#[test]
fn a_white_too_bright_for_a_faint_sensor_is_refused() {
    let e = GridSpectrum::constant(1.0);
    let at = |nm: f64| SpectralDistribution::new(vec![nm, nm + 1.0], vec![1e-250; 2]).unwrap();
    let faint = Sensor::new(Primaries::Camera, [at(450.0), at(550.0), at(650.0)], Response::PerEnergy).unwrap();
    let balanced = |white| Rendering::new(&faint, &e, white, ColorTransform::Paper);
    assert!(balanced(WhiteBalanceTarget::UNITY).unwrap().locus_gain.is_finite());
    let bright = WhiteBalanceTarget([1.0, 1e100, 0.5]);
    assert_eq!(balanced(bright), Err(RenderingError::GainOverflow { channel: 1 }));
    // A matrix would divide by a white that is nearly nothing.
    let transform = ColorTransform::Observer {
        reference: &sensor(CIE_1931),
        training: &training(),
        correction: Correction::default(),
    };
    let dark = WhiteBalanceTarget([1.0, 1e-310, 1.0]);
    assert_eq!(Rendering::new(&sensor(CANON_10D), &e, dark, transform), Err(RenderingError::NoWhite));
}

/// Nothing is divided by Z, so deep red light, which z̄ does not see, is no reason to refuse.
#[test]
fn a_cie_observer_sees_deep_red_light() {
    let observer = sensor(CIE_1931);
    let red = GridSpectrum::from_fn(|nm| f64::from((660.0..=670.0).contains(&nm)));
    let rendering = Rendering::new(&observer, &red, WhiteBalanceTarget::UNITY, ColorTransform::Paper).unwrap();
    let white = rendering.xyz(rendering.patch_signals(observer.integrate(red.values())));
    assert_near("Y", white.y, 1.0, 1e-15);
    // CIE 15: 660 to 670 nm lies at 0.7300 to 0.7320, 0.2700 to 0.2680.
    assert_xy("deep red", white.chromaticity().unwrap(), [0.7310, 0.2690], 0.001);
    assert!(rendering.linear_srgb(white).iter().all(|v| v.is_finite()));
    assert_eq!(rendering.lab(white), None);
}

#[test]
fn what_eq_13_does_not_cover_is_refused() {
    let (cones, e, training) = (sensor(CONES), GridSpectrum::constant(1.0), training());
    assert_eq!(
        Rendering::new(&cones, &e, WhiteBalanceTarget::UNITY, ColorTransform::Paper),
        Err(RenderingError::ConesNeedObserver)
    );
    let (xyz, rgb, camera) = (sensor(CIE_1931), sensor(REFERENCE), sensor(CANON_10D));
    let fit = |reference| {
        Rendering::new(
            &cones,
            &e,
            WhiteBalanceTarget::UNITY,
            ColorTransform::Observer { reference, training: &training, correction: Correction::default() },
        )
    };
    assert!(!fit(&xyz).unwrap().is_rgb);
    assert_eq!(fit(&rgb), Err(RenderingError::Reference));
    assert_eq!(fit(&camera), Err(RenderingError::Reference));
    let nothing = PatchSet::new([]);
    let transform = ColorTransform::Observer { reference: &xyz, training: &nothing, correction: Correction::default() };
    assert_eq!(
        Rendering::new(&camera, &e, WhiteBalanceTarget::UNITY, transform),
        Err(RenderingError::Fit(FitError::Dependent))
    );
    let one_channel = camera.curves()[1].clone();
    let gray =
        Sensor::new(Primaries::Camera, [one_channel.clone(), one_channel.clone(), one_channel], Response::PerEnergy);
    let transform =
        ColorTransform::Observer { reference: &xyz, training: &training, correction: Correction::default() };
    assert_eq!(
        Rendering::new(&gray.unwrap(), &e, WhiteBalanceTarget::UNITY, transform),
        Err(RenderingError::Fit(FitError::Dependent))
    );
}

#[test]
fn a_white_that_no_matrix_can_undo_is_refused() {
    let (reference, training) = (sensor(CIE_1931), training());
    let transform =
        ColorTransform::Observer { reference: &reference, training: &training, correction: Correction::default() };
    let made = Rendering::new(
        &sensor(CANON_10D),
        &GridSpectrum::constant(1.0),
        WhiteBalanceTarget([1.0, 0.0, 1.0]),
        transform,
    );
    assert_eq!(made, Err(RenderingError::NoWhite));
}

#[test]
fn cie_observers_are_drawn_directly_on_either_way() {
    let (observer, training, light) = (sensor(CIE_1931), training(), light("illuminants/d65.csv"));
    let other = sensor("observers/cie_1964_10deg.csv");
    let transform =
        ColorTransform::Observer { reference: &other, training: &training, correction: Correction::default() };
    let a = Rendering::new(&observer, &light, WhiteBalanceTarget::UNITY, ColorTransform::Paper).unwrap();
    let b = Rendering::new(&observer, &light, WhiteBalanceTarget([9.0, 1.0, 1.0]), transform).unwrap();
    assert_eq!(a, b);
    assert_eq!(a.xyz_from_signals, DMat3::IDENTITY);
    let e = Rendering::new(&observer, &GridSpectrum::constant(1.0), WhiteBalanceTarget::UNITY, ColorTransform::Paper)
        .unwrap();
    assert_xy("equal energy", e.lab_white.chromaticity().unwrap(), [1.0 / 3.0, 1.0 / 3.0], 2e-5);
}

#[test]
fn whites_of_lights_are_their_colors() {
    let observer = sensor(CIE_1931);
    let white = WhiteBalanceTarget::from_light(&dataset("illuminants/d65.csv").curves[0], &observer).unwrap();
    for v in white.0 {
        assert_near("D65", v, 1.0, 1.5e-3);
    }
    assert!(WhiteBalanceTarget::from_light(&measured(&GridSpectrum::constant(0.0)), &observer).is_none());
    assert!(WhiteBalanceTarget::from_chromaticity(Xy { x: 0.3, y: 0.0 }).is_none());
    let glow = WhiteBalanceTarget::from_light(&measured(&black_body(kelvin(1000.0), PAPER)), &observer).unwrap();
    assert!(glow.0[2] < 0.0, "a black body of 1000 K is outside sRGB");
}

fn hostile() -> impl Strategy<Value = Vec<f64>> {
    vec(prop_oneof![Just(0.0), Just(1e100), Just(-1e100), Just(1e-100), -1.0..1.0, 1e-300..1e-290], 41)
}

proptest! {
    #![proptest_config(cases(128))]

    #[test]
    fn renderings_are_finite_or_refused(a in hostile(), b in hostile(), c in hostile(), l in hostile(), s in hostile()) {
        let table = |v: &Vec<f64>| {
            SpectralDistribution::new((0..41).map(|i| 380.0 + 10.0 * f64::from(i)).collect(), v.clone()).unwrap()
        };
        let Ok(camera) = Sensor::new(Primaries::Rgb, [table(&a), table(&b), table(&c)], Response::PerEnergy) else {
            return Ok(());
        };
        let light = GridSpectrum::from_fn(|nm| l[((nm - 380.0) / 10.0) as usize]);
        let training = PatchSet::new([("a", &s), ("b", &a), ("c", &l), ("d", &c)].map(|(n, v)| (n.to_owned(), table(v))));
        let reference = sensor(CIE_1931);
        for transform in [ColorTransform::Paper, ColorTransform::Observer { reference: &reference, training: &training, correction: Correction::default() }] {
            let Ok(rendering) = Rendering::new(&camera, &light, WhiteBalanceTarget::UNITY, transform) else { continue };
            prop_assert!(rendering.xyz_from_signals.is_finite() && rendering.srgb_from_xyz.is_finite());
            prop_assert!(rendering.white_integrals.is_finite() && rendering.locus_gain.is_finite());
        }
    }
}

#[test]
fn an_observer_whose_luminance_is_nothing_beside_the_rest_is_refused() {
    let curve = |value: f64| SpectralDistribution::new(vec![380.0, 780.0], vec![value; 2]).unwrap();
    let curves = [curve(1e100), curve(1e-250), curve(1.0)];
    let observer = Sensor::new(Primaries::Xyz, curves, Response::PerEnergy).unwrap();
    let answer =
        Rendering::new(&observer, &GridSpectrum::constant(1.0), WhiteBalanceTarget::UNITY, ColorTransform::Paper);
    assert_eq!(answer, Err(RenderingError::BlindToLight { channel: 1 }));
}
