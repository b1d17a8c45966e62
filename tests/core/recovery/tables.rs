//! Tables of one model against each other.

use chromascope_core::recovery::{TableDifference, open_ends};
use chromascope_core::spectral::{Primaries, Response, Sensor, SpectralDistribution};

use super::support::D65;
use crate::support::{CIE_1931, light, sensor, training};

fn difference(tables: [&Sensor; 2]) -> TableDifference {
    TableDifference::new(tables, &light(D65), &sensor(CIE_1931), &training()).unwrap()
}

/// The scale of a channel is no difference; another laboratory's table is a small one, another maker's a large one.
#[test]
fn tables_of_one_model_differ_less_than_those_of_two() {
    let [upenn, academy, canon] = ["nikon_d70_upenn_2011", "nikon_d70_a_m_p_a_s", "canon_eos_5d_mark_ii"]
        .map(|name| sensor(&format!("cameras/{name}.csv")));
    let none = difference([&upenn, &upenn]);
    assert!(none.delta_e < 1e-9 && none.curves.iter().all(|v| *v < 1e-6), "{none:?}");
    let scaled = |curve: &SpectralDistribution, by: f64| {
        let values = curve.values().iter().map(|v| v * by).collect();
        SpectralDistribution::new(curve.wavelengths_nm().to_vec(), values).unwrap()
    };
    let [r, g, b] = upenn.curves();
    let other = Sensor::new(Primaries::Camera, [scaled(r, 2.0), scaled(g, 1.0), scaled(b, 0.5)], upenn.response());
    let gains = difference([&upenn, &other.unwrap()]);
    assert!(gains.delta_e < 1e-6 && gains.curves.iter().all(|v| *v < 1e-6), "{gains:?}");
    let (same, two) = (difference([&upenn, &academy]), difference([&upenn, &canon]));
    assert!((0.05..1.0).contains(&same.delta_e) && same.delta_e < two.delta_e, "{same:?} {two:?}");
    assert!(same.curves.iter().zip(two.curves).all(|(same, two)| *same < two), "{same:?} {two:?}");
}

#[test]
fn open_ends_are_those_above_a_twentieth_of_the_peak() {
    let nm = vec![400.0, 500.0, 600.0];
    let curve = |values: [f64; 3]| SpectralDistribution::new(nm.clone(), values.to_vec()).unwrap();
    let curves = [curve([0.0, 0.5, 1.0]), curve([0.04, 1.0, 0.04]), curve([1.0, 0.5, 0.06])];
    let table = Sensor::new(Primaries::Camera, curves, Response::PerEnergy).unwrap();
    let ends: Vec<(usize, f64)> = open_ends(&table).into_iter().map(|(c, nm, _)| (c, nm)).collect();
    assert_eq!(ends, [(0, 600.0), (2, 400.0), (2, 600.0)]);
}
