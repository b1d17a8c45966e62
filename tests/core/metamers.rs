//! Metamers against a search of every pair.

use chromascope_core::camera::WhiteBalanceTarget;
use chromascope_core::colorimetry::Lab;
use chromascope_core::metamers::{Confusion, MetamerLimits, MetamerLimitsError, Seen, search};
use chromascope_core::query::{Ask, ColorTransformSpec, Direct, MetamersQuery, RenderingQuery, Shared};

use crate::support::{CIE_1931, DCS200, assert_near, chart, light, reference, sensor, training};

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
