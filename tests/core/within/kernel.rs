//! Instruction sets of batches.

use super::sealed::Kernel;
use super::*;

/// Numbers without any order.
fn numbers(count: usize, seed: u64) -> Vec<f64> {
    let mut state = seed;
    let next = |_| {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1_u64 << 53) as f64 - 0.3
    };
    (0..count).map(next).collect()
}

#[test]
fn every_instruction_set_and_way_to_read_gives_the_same_bits() {
    for (length, count, channels) in [(1, 1, 1), (3, 2, 2), (4, 5, 9), (81, 7, 13), (401, 4, 60)] {
        let (spectra, curves) = (numbers(length * count, 1), numbers(length * channels, 5));
        let packed = <f64 as Kernel>::pack(&curves, length);
        let mut answers = vec![0.0; count * channels];
        <f64 as Kernel>::multiply(&spectra, length, &packed, &mut answers, channels, false);
        for far in [false, true] {
            let mut others = vec![0.0; count * channels];
            f64::portable::multiply((&spectra, length), &packed, (&mut others, channels), far);
            assert_eq!(answers, others);
        }
        let narrow = |values: &[f64]| -> Vec<f32> { values.iter().map(|&v| v as f32).collect() };
        let (spectra, packed) = (narrow(&spectra), <f32 as Kernel>::pack(&narrow(&curves), length));
        let mut answers = vec![0.0; count * channels];
        <f32 as Kernel>::multiply(&spectra, length, &packed, &mut answers, channels, true);
        let mut others = vec![0.0; count * channels];
        f32::portable::multiply((&spectra, length), &packed, (&mut others, channels), false);
        assert_eq!(answers, others);
    }
}
