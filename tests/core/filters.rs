//! Filters in front of lights, and the consistency of cameras under them.

use chromascope_core::light::filter::{filtered, transmittance};
use chromascope_core::query::{Ask as _, ConsistencyQuery, Direct, Shared};
use chromascope_core::spectral::{Dataset, GridSpectrum, Quantity, SpectralDistribution};
use proptest::prelude::*;

use crate::support::{CIE_1931, DCS200, assert_near, cases, dataset, light, patches, sensor, training};

fn filters(path: &str) -> Vec<GridSpectrum> {
    let Dataset { curves, .. } = dataset(path);
    curves.iter().map(|curve| GridSpectrum::resample(curve, Quantity::Reflectance)).collect()
}

#[test]
fn an_ideal_window_changes_no_bit() {
    let clear = transmittance([&GridSpectrum::constant(1.0), &GridSpectrum::constant(1.0)]);
    let d65 = light("illuminants/d65.csv");
    assert_eq!(d65.times(&clear), d65);
    // At 10 nm too, where another transmittance would add wavelengths.
    for path in ["illuminants/d65.csv", "illuminants/iso_7589_daylight_photoflood.csv"] {
        let table = &dataset(path).curves[0];
        assert_eq!(filtered(table, &clear).unwrap(), *table);
    }
}

#[test]
fn densities_add() {
    let nd = filters("filters/neutral_density.csv");
    // 0.3 + 0.6 = 0.9.
    let both = transmittance([&nd[0], &nd[1]]);
    assert!(both.values().iter().zip(nd[2].values()).all(|(a, b)| (a - b).abs() < 1e-12));
}

/// A mired shift of m turns a blackbody of M into one of M + m, by Wien's law up to the other end of the table.
#[test]
fn a_mired_shift_moves_a_blackbody() {
    use chromascope_core::light::{RadiationConstants, planckian::black_body};
    use chromascope_core::units::Kelvin;
    let shift = filters("filters/mired_shift.csv").into_iter().next().unwrap();
    let body = |mired: f64| black_body(Kelvin::from_mired(mired).unwrap(), RadiationConstants::Paper);
    let (from, to) = (body(312.5), body(312.5 - 131.0));
    let seen = from.times(&shift);
    let ratio = |i: usize| seen.values()[i] / to.values()[i];
    // Wien omits 1 − exp(−x), x = c₂/(λT): it differs by 3.4 % at 780 nm between the two temperatures.
    let (blue, red) = (ratio(0), ratio(400));
    let bend = |mired: f64| 1.0 - (-1.4388e1 / 780.0 * mired).exp();
    assert_near("ratio", red / blue, bend(181.5) / bend(312.5), 1e-3);
}

#[test]
fn a_filtered_table_keeps_its_wavelengths_or_gets_finer() {
    let edge = &filters("filters/edges.csv")[1];
    let five = &dataset("illuminants/a.csv").curves[0];
    assert_eq!(filtered(five, edge).unwrap().wavelengths_nm(), five.wavelengths_nm());
    let ten = &dataset("illuminants/iso_7589_daylight_photoflood.csv").curves[0];
    let finer = filtered(ten, edge).unwrap();
    assert_eq!(finer.uniform_step_nm(), Some(1.0));
    assert_eq!(finer.range_nm(), ten.range_nm());
    let grid = GridSpectrum::resample(ten, Quantity::Light).times(edge);
    let seen = GridSpectrum::resample(&finer, Quantity::Light);
    assert!(grid.values().iter().zip(seen.values()).take(310).all(|(a, b)| (a - b).abs() <= 1e-12 * a.abs()));
    // What was not measured of the light stays marked.
    assert_eq!(grid.assumed().above_nm, Some(690.0));
}

proptest! {
    #![proptest_config(cases(32))]

    #[test]
    fn the_order_of_filters_changes_no_bit(levels in prop::collection::vec(prop::collection::vec(0.0_f64..1.0, 7), 0..5), turn in 0_usize..5) {
        let make = |values: &Vec<f64>| {
            let nm = (0..7).map(|i| 380.0 + 66.0 * f64::from(i)).collect();
            GridSpectrum::resample(&SpectralDistribution::new(nm, values.clone()).unwrap(), Quantity::Reflectance)
        };
        let filters: Vec<GridSpectrum> = levels.iter().map(make).collect();
        let mut turned = filters.clone();
        turned.rotate_left(turn % filters.len().max(1));
        turned.reverse();
        prop_assert_eq!(transmittance(&filters), transmittance(&turned));
    }
}

/// By numpy: Sprague and linear interpolation to 1 nm, the white-keeping matrix from its normal equations, colour-science's
/// `delta_E_CIE2000`; `ColorChecker` (`BabelColor` average), mean, 95 %, maximum, worst patch.
#[test]
fn consistency_matches_another_program() {
    let d70 = "cameras/nikon_d70_a_m_p_a_s.csv";
    let (fl11, led) = (("cie_fluorescent_lamps", 11, "d65"), ("cie_led_lamps", 1, "a"));
    let expected = [
        (d70, fl11, [3.528_800_758, 9.138_357_697, 9.603_613_327], 12),
        (d70, led, [2.077_730_671, 4.151_191_018, 4.894_657_733], 9),
        (DCS200, fl11, [6.175_328_110, 15.835_096_223, 23.622_762_496], 6),
        (DCS200, led, [1.979_883_933, 4.816_300_123, 13.348_328_546], 14),
    ];
    for (camera, (lamp, column, reference), [mean, p95, max], worst) in expected {
        let lamp = &dataset(&format!("illuminants/{lamp}.csv")).curves[column - 1];
        let query = ConsistencyQuery {
            sensor: Shared::new(sensor(camera)),
            light: Shared::new(GridSpectrum::resample(lamp, Quantity::Light)),
            reference: Shared::new(light(&format!("illuminants/{reference}.csv"))),
            observer: Shared::new(sensor(CIE_1931)),
            training: Shared::new(training()),
            patches: Shared::new(patches("charts/colorchecker_24_babelcolor_average.csv")),
        };
        let answer = (*Direct.ask(&query)).clone().unwrap();
        for (what, value, expected) in
            [("mean", answer.mean, mean), ("95 %", answer.percentile_95, p95), ("maximum", answer.max, max)]
        {
            assert_near(&format!("{what} of {camera}"), value, expected, 1e-6);
        }
        assert_eq!(answer.worst, worst, "{camera}");
        // Under the reference itself nothing changes.
        let same = ConsistencyQuery { light: query.reference.clone(), ..query };
        assert_eq!((*Direct.ask(&same)).clone().unwrap().max, 0.0);
    }
}
