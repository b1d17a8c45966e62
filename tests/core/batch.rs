//! Responses of many spectra at once against compensated sums, one by one, and what is refused.

use chromascope_core::camera::rendering::{raw, under_light};
use chromascope_core::camera::{Batch, BatchError};
use proptest::prelude::*;

use crate::support::{CANON_10D, CIE_1931, DCS200, REFERENCE, cases, chart, light, sensor};

/// Numbers between −0.2 and 1 without any order.
fn numbers(count: usize, seed: u64) -> Vec<f64> {
    let mut state = seed;
    let next = |_| {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1_u64 << 53) as f64 * 1.2 - 0.2
    };
    (0..count).map(next).collect()
}

/// The sum of products to twice the digits (Ogita, Rump and Oishi 2005), and that of their magnitudes.
fn compensated(a: &[f64], b: &[f64]) -> (f64, f64) {
    let (mut sum, mut rest, mut size) = (0.0_f64, 0.0, 0.0);
    for (a, b) in a.iter().zip(b) {
        let product = a * b;
        let next = sum + product;
        let part = next - sum;
        rest += a.mul_add(*b, -product) + ((sum - (next - part)) + (product - part));
        (sum, size) = (next, size + product.abs());
    }
    (sum + rest, size)
}

fn narrow(values: &[f64]) -> Vec<f32> {
    values.iter().map(|&v| v as f32).collect()
}

fn wide(values: &[f32]) -> Vec<f64> {
    values.iter().map(|&v| f64::from(v)).collect()
}

fn check(length: usize, count: usize, channels: usize) {
    let (spectra, curves) = (numbers(length * count, 1), numbers(length * channels, 2));
    let batch = Batch::new(&curves, length).unwrap();
    let answers = batch.responses(&spectra).unwrap();
    let (thin_spectra, thin_curves) = (narrow(&spectra), narrow(&curves));
    let thin_batch = Batch::new(&thin_curves, length).unwrap();
    let thin = thin_batch.responses(&thin_spectra).unwrap();
    assert_eq!((answers.len(), thin.len()), (count * channels, count * channels));
    let (thin_spectra, thin_curves) = (wide(&thin_spectra), wide(&thin_curves));
    for n in 0..count {
        for c in 0..channels {
            let (s, k) = (n * length..(n + 1) * length, c * length..(c + 1) * length);
            let what = format!("spectrum {n}, channel {c} of {channels}, {length} samples");
            let (exact, size) = compensated(&spectra[s.clone()], &curves[k.clone()]);
            let off = (answers[n * channels + c] - exact).abs();
            assert!(off <= batch.max_error() * size, "{what}: {off}");
            let (exact, size) = compensated(&thin_spectra[s], &thin_curves[k]);
            let off = (f64::from(thin[n * channels + c]) - exact).abs();
            assert!(off <= thin_batch.max_error() * size, "{what} in f32: {off}");
        }
    }
}

#[test]
fn responses_are_compensated_sums_within_the_promise() {
    for length in [1, 2, 3, 4, 5, 8, 31, 81, 401] {
        for (count, channels) in [(1, 1), (2, 3), (3, 4), (4, 5), (24, 12), (7, 60)] {
            check(length, count, channels);
        }
    }
}

#[test]
fn every_number_of_channels_up_to_sixty() {
    for channels in 1..=60 {
        check(41, 5, channels);
    }
}

#[test]
fn each_response_is_the_same_alone_and_on_any_number_of_threads() {
    let (length, count, channels) = (81, 1003, 7);
    let (spectra, curves) = (numbers(length * count, 3), numbers(length * channels, 4));
    let batch = Batch::new(&curves, length).unwrap();
    let one = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap();
    let answers = one.install(|| batch.responses(&spectra).unwrap());
    let three = rayon::ThreadPoolBuilder::new().num_threads(3).build().unwrap();
    assert!(three.install(|| batch.responses(&spectra).unwrap()) == answers);
    for n in [0, 1, 500, 1002] {
        let spectrum = &spectra[n * length..(n + 1) * length];
        assert_eq!(batch.responses(spectrum).unwrap(), answers[n * channels..(n + 1) * channels]);
        for (c, curve) in curves.chunks(length).enumerate() {
            let alone = Batch::new(curve, length).unwrap().responses(spectrum).unwrap();
            assert_eq!(alone, [answers[n * channels + c]]);
        }
    }
}

#[test]
fn spectra_that_no_cache_holds_have_the_same_responses() {
    let (length, channels) = (81, 3);
    let (few, curves) = (numbers(length * 499, 3), numbers(length * channels, 4));
    let batch = Batch::new(&curves, length).unwrap();
    let once = batch.responses(&few).unwrap();
    let many = batch.responses(&few.repeat(5)).unwrap();
    assert!(many.chunks(once.len()).all(|part| part == once));
}

#[test]
fn a_chart_through_four_sensors_is_what_the_renderer_sees() {
    let (chart, light) = (chart(), light("illuminants/d55.csv"));
    let spectra: Vec<f64> = chart.patches().iter().flat_map(|patch| *patch.grid.values()).collect();
    let products = [REFERENCE, CANON_10D, DCS200, CIE_1931].map(|path| under_light(&sensor(path), &light));
    let curves: Vec<f64> = products.iter().flatten().flat_map(|curve| **curve).collect();
    let batch = Batch::new(&curves, 401).unwrap();
    assert_eq!(batch.channels(), 12);
    let answers = batch.responses(&spectra).unwrap();
    for (patch, answers) in chart.patches().iter().zip(answers.chunks(12)) {
        for (product, answers) in products.iter().zip(answers.chunks(3)) {
            for (one, many) in raw(product, patch.grid.values()).to_array().iter().zip(answers) {
                assert!((one - many).abs() <= 1e-13 * one.abs(), "{one} {many}");
            }
        }
    }
}

#[test]
fn what_is_no_whole_number_of_curves_is_refused() {
    assert_eq!(Batch::new(&[1.0; 7], 3), Err(BatchError::Ragged { samples: 7, length: 3 }));
    assert_eq!(Batch::new(&[1.0; 7], 0), Err(BatchError::Ragged { samples: 7, length: 0 }));
    assert_eq!(Batch::new(&[1.0, f64::NAN], 2), Err(BatchError::NotFinite));
    assert_eq!(Batch::new(&[1.0, f32::INFINITY], 2), Err(BatchError::NotFinite));
    let batch = Batch::new(&[1.0; 6], 3).unwrap();
    assert_eq!(batch.responses(&[1.0; 4]), Err(BatchError::Ragged { samples: 4, length: 3 }));
    assert_eq!(batch.responses_into(&[1.0; 3], &mut [0.0; 3]), Err(BatchError::Answers { answers: 3, wanted: 2 }));
}

#[test]
fn nothing_gives_nothing() {
    let empty: [f64; 0] = [];
    assert!(Batch::new(&[1.0; 6], 3).unwrap().responses(&empty).unwrap().is_empty());
    assert!(Batch::new(&empty, 3).unwrap().responses(&[1.0; 6]).unwrap().is_empty());
    assert!(Batch::new(&empty, 0).unwrap().responses(&empty).unwrap().is_empty());
}

proptest! {
    #![proptest_config(cases(64))]

    #[test]
    fn hostile_spectra_give_finite_responses_and_spare_their_neighbors(
        bad in prop_oneof![Just(f64::NAN), Just(f64::INFINITY), Just(f64::MAX), Just(-f64::MAX), Just(5e-324)],
        place in 0_usize..5 * 17,
    ) {
        let mut spectra = numbers(5 * 17, 5);
        let batch = Batch::new(&numbers(6 * 17, 6).iter().map(|c| 1e3 * c).collect::<Vec<_>>(), 17).unwrap();
        let before = batch.responses(&spectra).unwrap();
        spectra[place] = bad;
        let after = batch.responses(&spectra).unwrap();
        prop_assert!(after.iter().all(|v| v.is_finite()));
        for (n, (before, after)) in before.chunks(6).zip(after.chunks(6)).enumerate() {
            prop_assert!(n == place / 17 || before == after);
        }
    }
}
