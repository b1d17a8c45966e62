//! Metamers against a search of every pair, and synthetic ones against their definition.

use chromascope_core::camera::WhiteBalanceTarget;
use chromascope_core::colorimetry::Lab;
use chromascope_core::metamers::{
    Confusion, MetamerLimits, MetamerLimitsError, Seen, metameric_black, search, synthetic_metamer,
};
use chromascope_core::query::{Ask, ColorTransformSpec, Direct, MetamersQuery, RenderingQuery, Shared};
use chromascope_core::spectral::GridSpectrum;

use crate::support::{CANON_10D, CIE_1931, DCS200, assert_near, chart, light, reference, sensor, training};

fn query(confusion: Confusion) -> MetamersQuery {
    let light = Shared::new(light("illuminants/a.csv"));
    let rendering = |path: &str| RenderingQuery {
        sensor: Shared::new(sensor(path)),
        light: light.clone(),
        white: WhiteBalanceTarget::UNITY,
        transform: ColorTransformSpec::Paper,
    };
    let limits = match confusion {
        Confusion::Camera => MetamerLimits::new(1.0, 2.0),
        Confusion::Observer => MetamerLimits::new(2.0, 1.0),
    };
    MetamersQuery {
        rendering: rendering(DCS200),
        reference: rendering(CIE_1931),
        sets: vec![Shared::new(chart()), Shared::new(training())],
        confusion,
        limits: limits.unwrap(),
        most: 1000,
    }
}

#[test]
fn the_pairs_found_are_those_of_a_search_of_all() {
    let rows = reference("metamers.csv");
    for (confusion, name) in [(Confusion::Camera, "camera"), (Confusion::Observer, "observer")] {
        let asked = query(confusion);
        let found = Direct.ask(&asked);
        let found = (*found).as_ref().unwrap();
        let expected: Vec<&Vec<String>> = rows.iter().filter(|row| row[0] == name).collect();
        assert_eq!((found.pairs.len(), found.searched), (expected.len(), 214), "{name}");
        for (pair, row) in found.pairs.iter().zip(expected) {
            assert_eq!(pair.places.map(|place| place.to_string()), [row[1].clone(), row[2].clone()], "{name}");
            assert_near(name, pair.camera_difference, row[3].parse().unwrap(), 1e-6);
            assert_near(name, pair.observer_difference, row[4].parse().unwrap(), 1e-6);
        }
        assert!(found.pairs.len() > 2, "{name}: too few to prove anything");
        let few = Direct.ask(&MetamersQuery { most: 2, ..asked });
        assert_eq!((*few).as_ref().unwrap().pairs, found.pairs[..2]);
    }
}

#[test]
fn places_of_a_list_are_patches_of_sets() {
    let asked = query(Confusion::Camera);
    assert_eq!(
        [0, 23, 24, 213, 214].map(|place| asked.at(place)),
        [Some([0, 0]), Some([0, 23]), Some([1, 0]), Some([1, 189]), None]
    );
}

#[test]
fn what_is_no_color_makes_no_pair() {
    let seen = |value: f64| Seen { rgb: [value; 3], lab: Lab { l: value, a: 0.0, b: 0.0 } };
    let colors = [seen(f64::NAN), seen(f64::INFINITY), seen(0.5)];
    for confusion in [Confusion::Camera, Confusion::Observer] {
        assert!(search(&colors, confusion, MetamerLimits::USUAL, 10, || false).is_empty());
        let two = [seen(10.0), Seen { rgb: [10.0; 3], ..seen(50.0) }];
        let found = |stop: bool| search(&two, Confusion::Camera, MetamerLimits::USUAL, 10, || stop).len();
        assert_eq!([found(false), found(true)], [1, 0], "a search that is stopped ends");
        assert!(search(&[], confusion, MetamerLimits::USUAL, 10, || false).is_empty());
    }
    for limit in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert_eq!(MetamerLimits::new(limit, 1.0), Err(MetamerLimitsError));
        assert_eq!(MetamerLimits::new(1.0, limit), Err(MetamerLimitsError));
    }
}

#[test]
fn pairs_brighter_than_white_are_found() {
    let seen = |l: f64, red: f64| Seen { rgb: [red, 1.0, 1.0], lab: Lab { l, a: 0.0, b: 0.0 } };
    // S_L is 2.94 at L* 180: ΔE*00 of 2.9 / 2.94 is confused, though ΔL* exceeds 1.75.
    let colors = [seen(178.55, 1.0), seen(181.45, 2.0)];
    let limits = MetamerLimits::new(1.0, 2.0).unwrap();
    let pairs = search(&colors, Confusion::Observer, limits, 10, || false);
    assert_eq!(pairs.len(), 1);
    assert_near("ΔE*00", pairs[0].observer_difference, 2.9 / (1.0 + 0.015 * 16_900.0 / 16_920_f64.sqrt()), 1e-12);
}

#[test]
fn a_metameric_black_is_invisible_to_rounding() {
    for (path, lamp) in [(CANON_10D, "illuminants/a.csv"), (DCS200, "illuminants/d65.csv")] {
        let (camera, light) = (sensor(path), light(lamp));
        let any = GridSpectrum::from_fn(|nm| (nm / 17.0).sin() + 0.3);
        let black = metameric_black(&camera, &light, any.values()).unwrap();
        assert!(black.iter().any(|v| v.abs() > 0.1));
        for channel in 0..3 {
            let terms = || camera.weighted(channel).iter().zip(light.values()).zip(&black).map(|((c, l), s)| c * s * l);
            let (sum, size) = (terms().sum::<f64>(), terms().map(f64::abs).sum::<f64>());
            assert!(sum.abs() <= 1e-14 * size, "{path} {channel}: {sum} of {size}");
        }
    }
}

#[test]
fn a_synthetic_metamer_is_the_same_to_the_camera_alone() {
    let (camera, observer, light) = (sensor(DCS200), sensor(CIE_1931), light("illuminants/d65.csv"));
    for patch in chart().patches() {
        let other = synthetic_metamer(&camera, &observer, &light, &patch.grid).unwrap();
        assert!(other.values().iter().all(|value| (0.0..=1.0).contains(value)), "{}", patch.name);
        let difference = |sensor: &chromascope_core::spectral::Sensor, channel: usize| {
            let products = sensor.weighted(channel).iter().zip(light.values());
            let pairs = products.zip(patch.grid.values().iter().zip(other.values()));
            let (sum, size) =
                pairs.fold((0.0, 0.0), |(sum, size), ((c, l), (a, b))| (sum + c * l * (b - a), size + (c * l).abs()));
            sum / size
        };
        for channel in 0..3 {
            assert!(difference(&camera, channel).abs() < 1e-14, "{} {channel}", patch.name);
        }
        let seen = (0..3).map(|channel| difference(&observer, channel).abs()).fold(0.0, f64::max);
        assert!(seen > 1e-3, "{}: {seen}", patch.name);
    }
    // The observer's own black is no black of its own curves.
    let gray = GridSpectrum::constant(0.5);
    assert_eq!(synthetic_metamer(&observer, &observer, &light, &gray), None);
}
