//! Instruction sets of the diffuse sum.

use super::*;
use crate::reflectance::ln_diffuse_sum;

#[test]
fn every_instruction_set_gives_the_same_bits() {
    for precision in Precision::ALL {
        for i in 0..200 {
            let g = 1e-3 * 1.2_f64.powi(i % 97);
            let b = g * 0.07 * f64::from(i);
            let (portable, chosen) = (ln(g, b, precision), ln_diffuse_sum(g, b, precision));
            assert_eq!(portable.map(f64::to_bits), Some(chosen.to_bits()), "g {g}, b {b}");
        }
    }
}

#[test]
fn there_is_a_piece_down_to_e_to_the_minus_27() {
    for i in 0..300 {
        let g = 0.07 * 1.1_f64.powi(i);
        let dark = ln_diffuse_sum(g, 0.0, Precision::Full) - 27.0;
        let mut b = 0.1 * g;
        while ln_diffuse_sum(g, b, Precision::Full) > dark {
            assert!(ln(g, b, Precision::Fine).is_some(), "g {g}, b {b}");
            b *= 1.1;
        }
    }
}

#[test]
fn what_has_no_piece_is_left_to_others() {
    for (g, b) in [(1e-4, 1.0), (1e13, 0.0), (1.0, 1e6), (f64::NAN, 1.0), (-1.0, 1.0), (1.0, f64::NAN), (0.0, 0.0)] {
        assert_eq!(ln(g, b, Precision::Full), None, "g {g}, b {b}");
    }
}
