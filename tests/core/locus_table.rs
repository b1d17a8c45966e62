//! Tables of blackbodies' chromaticities against the 1 nm sum, 50 digits, and curves that no table can hold.

use chromascope_core::accuracy::RelTolerance;
use chromascope_core::camera::locus_table::{COLDEST_K, HOTTEST_K};
use chromascope_core::camera::{ColorTransform, LocusEvaluator, Rendering, WhiteBalanceTarget};
use chromascope_core::camera::{LocusTable, LocusTableError};
use chromascope_core::colorimetry::Xy;
use chromascope_core::correction::Correction;
use chromascope_core::light::RadiationConstants;
use chromascope_core::spectral::{GridSpectrum, Sensor};
use chromascope_core::units::Kelvin;
use glam::DVec3;
use rayon::prelude::*;

use crate::support::{
    CANON_10D, CIE_1931, DCS200, NIKON_D70, REFERENCE, assert_near, kelvin, reference_numbers, sensor, sensors,
    training,
};

const PAPER: RadiationConstants = RadiationConstants::Paper;

fn rendering(sensor: &Sensor, transform: ColorTransform<'_>) -> Option<Rendering> {
    Rendering::new(sensor, &GridSpectrum::constant(1.0), WhiteBalanceTarget::UNITY, transform).ok()
}

fn cie_table() -> LocusTable {
    let observer = sensor(CIE_1931);
    LocusTable::new(&observer, &rendering(&observer, ColorTransform::Paper).unwrap(), PAPER)
}

/// Temperatures over the whole table, even in the logarithm by the golden ratio: half of them up to 10⁶ K.
fn anywhere(count: u32) -> impl Iterator<Item = Kelvin> {
    (1..=count).map(|i| {
        let decades = if i % 2 == 0 { 6.0 } else { 15.0 };
        kelvin(10_f64.powf(decades * (f64::from(i) * 0.618_033_988_749_894_9).fract()))
    })
}

fn off(a: Xy, b: Xy) -> f64 {
    (a.x - b.x).abs().max((a.y - b.y).abs())
}

/// The largest difference from the 1 nm sum, and what the table says it is.
fn measure(sensor: &Sensor, rendering: &Rendering, count: u32) -> (f64, LocusTable) {
    let (sum, table) = (LocusEvaluator::by_sum(sensor, PAPER), LocusTable::new(sensor, rendering, PAPER));
    let error = |t: Kelvin| {
        let exact = rendering.xyz(DVec3::from_array(sum.raw(t)) * rendering.locus_gain).chromaticity().unwrap();
        off(table.xy(t).unwrap(), exact)
    };
    (anywhere(count).map(error).fold(0.0, f64::max), table)
}

#[test]
fn every_sensor_has_a_table_that_keeps_its_own_error() {
    let (reference, training) = (sensor(CIE_1931), training());
    let observer =
        ColorTransform::Observer { reference: &reference, training: &training, correction: Correction::default() };
    let (cameras, observers) = (sensors("cameras"), sensors("observers"));
    let all: Vec<_> = cameras.iter().chain(&observers).collect();
    let made: Vec<usize> = all
        .par_iter()
        .map(|(name, sensor)| {
            let ways: Vec<_> = [ColorTransform::Paper, observer]
                .into_iter()
                .filter_map(|transform| rendering(sensor, transform))
                .collect();
            for rendering in &ways {
                let (seen, table) = measure(sensor, rendering, 400);
                let said = table.max_error();
                assert!(said <= LocusTable::TARGET, "{name} says {said:.1e}, {:?}", table.size());
                // Rounding of both, and what lies beside the extremes of Chebyshev's error.
                assert!(seen <= 1.1 * said + 1e-15, "{name}: {seen:.1e}, said {said:.1e}");
            }
            ways.len()
        })
        .collect();
    // 66 sensors on two ways; cones have none on the paper's.
    assert_eq!(made.iter().sum::<usize>(), 130);
}

#[test]
fn a_larger_error_takes_a_smaller_table_that_keeps_it() {
    for path in [CIE_1931, CANON_10D, DCS200] {
        let sensor = sensor(path);
        let rendering = rendering(&sensor, ColorTransform::Paper).unwrap();
        let exact = LocusTable::new(&sensor, &rendering, PAPER);
        let within = |target| LocusTable::within(&sensor, &rendering, PAPER, RelTolerance::new(target).unwrap());
        assert_eq!(within(f64::MIN_POSITIVE), exact);
        let mut size = exact.size()[0];
        for target in [1e-11, 1e-9, 1e-6, 1e-4] {
            let table = within(target);
            assert!(table.max_error() <= target && table.size()[0] <= size, "{path}: {:?}", table.size());
            size = table.size()[0];
            for t in anywhere(400) {
                let seen = off(table.xy(t).unwrap(), exact.xy(t).unwrap());
                assert!(seen <= 1.5 * target, "{path} at {t}: {seen:.1e} of {target:.0e}");
            }
        }
        assert!(2 * size < exact.size()[0]);
    }
}

#[test]
fn the_table_matches_fifty_digits() {
    let table = cie_table();
    for row in reference_numbers("temperature.csv").iter().filter(|row| row[1] == 0.0) {
        let uv = table.xy(kelvin(row[0])).unwrap().uv_prime().unwrap().uv60();
        assert_near(&format!("{} K", row[0]), uv.u, row[2], 1e-14);
        assert_near(&format!("{} K", row[0]), uv.v, row[3], 1e-14);
    }
}

#[test]
fn beyond_the_ends_is_refused() {
    let table = cie_table();
    for t in [5e-324, 1e-300, 1e-3, COLDEST_K * (1.0 - 1e-15), HOTTEST_K * (1.0 + 1e-15), 1e300, f64::MAX] {
        assert_eq!(table.xy(kelvin(t)), Err(LocusTableError::Outside), "{t} K");
    }
    for t in [COLDEST_K, HOTTEST_K] {
        assert!(table.xy(kelvin(t)).is_ok(), "{t} K");
    }
    let (hottest, infinite) = (table.xy(kelvin(HOTTEST_K)).unwrap(), table.xy(kelvin(1e14)).unwrap());
    assert!(off(hottest, infinite) < 1e-11);
}

#[test]
fn many_are_each_to_the_last_bit_on_any_number_of_threads() {
    for path in [CIE_1931, CANON_10D, NIKON_D70, REFERENCE] {
        let sensor = sensor(path);
        let table = LocusTable::new(&sensor, &rendering(&sensor, ColorTransform::Paper).unwrap(), PAPER);
        let mut temperatures: Vec<Kelvin> = anywhere(40_007).collect();
        (temperatures[17], temperatures[30_000]) = (kelvin(0.5), kelvin(1e16));
        let each: Vec<_> = temperatures.iter().map(|&t| table.xy(t)).collect();
        assert_eq!(each.iter().filter(|a| **a == Err(LocusTableError::Outside)).count(), 2);
        for threads in [1, 3] {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            assert!(pool.install(|| table.xys(&temperatures)) == each, "{path} on {threads}");
            let again =
                pool.install(|| LocusTable::new(&sensor, &rendering(&sensor, ColorTransform::Paper).unwrap(), PAPER));
            assert!(again == table, "{path} made on {threads}");
        }
    }
    assert!(cie_table().xys(&[]).is_empty());
}

#[test]
fn what_of_one_slice_is_beyond_the_other_stays() {
    let (table, mut answers) = (cie_table(), [Err(LocusTableError::Rough); 5]);
    table.xys_into(&[kelvin(5000.0); 3], &mut answers);
    assert!(answers[..3].iter().all(Result::is_ok));
    assert_eq!(answers[3..], [Err(LocusTableError::Rough); 2]);
    table.xys_into(&[kelvin(5000.0); 9], &mut answers);
    assert!(answers.iter().all(Result::is_ok));
}

#[test]
fn a_curve_that_leaps_is_refused_around_the_leap_only() {
    let leap = |t: Kelvin| Some(Xy { x: if t.mired() < 333.3 { 0.3 } else { 0.4 }, y: 0.3 });
    let table = LocusTable::of(leap);
    assert_eq!(table.xy(kelvin(1e6 / 333.3)), Err(LocusTableError::Rough));
    for t in [5.0, 2900.0, 3100.0, 1e9] {
        assert!(off(table.xy(kelvin(t)).unwrap(), leap(kelvin(t)).unwrap()) <= LocusTable::LIMIT, "{t} K");
    }
    assert!(table.max_error() <= LocusTable::LIMIT);
}

#[test]
fn a_curve_without_chromaticity_is_refused_everywhere() {
    let numbers = |x: f64| move |_: Kelvin| Some(Xy { x, y: 0.3 });
    let tables = [
        LocusTable::of(|_| None),
        LocusTable::of(numbers(f64::NAN)),
        LocusTable::of(numbers(f64::INFINITY)),
        LocusTable::of(numbers(f64::MAX)),
    ];
    for table in tables {
        for t in anywhere(50) {
            assert_eq!(table.xy(t), Err(LocusTableError::Rough), "{t}");
        }
    }
}
