//! The paper's three cases: what they are, and by how much they are wrong.

use chromascope_core::reflectance::{Precision, Regime, diffuse_sum, diffuse_sum_by_regimes};

use crate::support::assert_near;

/// The relative error of the paper's cases.
fn error(g: f64, b: f64) -> f64 {
    diffuse_sum_by_regimes(g, b) / diffuse_sum(g, b, Precision::Full) - 1.0
}

#[test]
fn roughness_has_three_cases() {
    assert_eq!([0.0, 0.0999, -1.0, f64::NAN].map(Regime::of), [Regime::Slight; 4]);
    assert_eq!([0.1, 1.0, 10.0].map(Regime::of), [Regime::Moderate; 3]);
    assert_eq!([10.001, 1e8, f64::INFINITY].map(Regime::of), [Regime::Rough; 3]);
}

#[test]
fn one_term_misses_what_inclination_brings_out() {
    // The first omitted term is (g/4) e^(b/2) of the included one.
    for b in [0.0_f64, 1.0, 4.0] {
        let g = 1e-5;
        assert_near(&format!("b {b}"), error(g, b), -g / 4.0 * (b / 2.0).exp(), 2e-8);
    }
    assert_near("g 0.01, b 0", error(0.01, 0.0), -0.0025, 5e-5);
    assert_near("g 0.01, b 4", error(0.01, 4.0), -0.018, 5e-4);
    assert_near("g 0.01, b 16", error(0.01, 16.0), -0.89, 0.01);
    for (b, expected) in [(0.0, -0.025), (4.0, -0.16), (16.0, -0.99)] {
        assert_near(&format!("g 0.1, b {b}"), error(0.099_999, b), expected, 0.002);
    }
}

#[test]
fn ten_terms_do_for_small_g_only() {
    assert!(error(0.1, 0.0).abs() < 1e-13);
    assert!(error(1.0, 1.0).abs() < 1e-7);
    assert_near("g 10, b 0", error(10.0, 0.0), -0.29, 0.005);
    assert_near("g 10, b 100", error(10.0, 100.0), -0.96, 0.005);
}

#[test]
fn equation_four_is_wrong_in_the_tail() {
    assert_near("g 10, b 0", error(10.000_01, 0.0), -0.12, 0.005);
    assert_near("g 10, b 100", error(10.000_01, 100.0), -0.78, 0.005);
    for (g, expected) in [(100.0, [-0.010, 0.005, -0.033, -0.24]), (1000.0, [-0.001, 0.0005, -0.0035, -0.03])] {
        for (beta, expected) in [0.0, 1.0, 5.0, 10.0].into_iter().zip(expected) {
            assert_near(&format!("g {g}, β {beta}"), error(g, beta * g), expected, 0.06 * f64::abs(expected));
        }
    }
}

#[test]
fn the_cases_do_not_meet() {
    let step = |g: f64, b: f64| diffuse_sum_by_regimes(g + 1e-9, b) / diffuse_sum_by_regimes(g - 1e-9, b) - 1.0;
    assert!(step(0.1, 8.0).abs() > 0.05, "{}", step(0.1, 8.0));
    assert!(step(10.0, 100.0).abs() > 0.5, "{}", step(10.0, 100.0));
}

#[test]
fn the_cases_are_numbers_everywhere() {
    let sizes = [0.0, -1.0, 5e-324, 1e-150, 0.1, 10.0, 700.0, 1e10, 1e200, f64::MAX, f64::INFINITY, f64::NAN];
    for g in sizes {
        for b in sizes {
            let value = diffuse_sum_by_regimes(g, b);
            assert!((0.0..=1.0).contains(&value), "g {g}, b {b}: {value}");
        }
    }
}
