//! The diffuse sum, against 60-digit sums, an integral without a series in it, and its limits.

use chromascope_core::reflectance::{Precision, diffuse_sum, diffuse_sums_into, ln_diffuse_sum};

use crate::support::{assert_near, reference_numbers};

/// Each precision with its bound of the relative error.
const PROMISES: [(Precision, f64); 3] = [(Precision::Coarse, 1e-6), (Precision::Fine, 1e-10), (Precision::Full, 1e-13)];

/// Twice the error from rounding b alone.
fn conditioning(ln_s: f64) -> f64 {
    2.0 * f64::EPSILON * ln_s.abs()
}

#[test]
fn every_precision_keeps_its_promise() {
    for (precision, promise) in PROMISES {
        let (mut worst, mut worst_ln) = (0.0_f64, 0.0_f64);
        for row in reference_numbers("reflectance_sum.csv") {
            let [g, b, ln_s, s] = row.try_into().unwrap();
            let value = diffuse_sum(g, b, precision);
            if s == 0.0 {
                assert_eq!(value, 0.0, "g {g}, b {b}");
            } else {
                worst = worst.max((value / s - 1.0).abs() - conditioning(ln_s));
            }
            let excess = (ln_diffuse_sum(g, b, precision) - ln_s).abs() - conditioning(ln_s);
            worst_ln = worst_ln.max(excess);
        }
        assert!(worst <= promise, "{precision:?}: {worst}");
        assert!(worst_ln <= promise, "{precision:?}, logarithm: {worst_ln}");
    }
}

#[test]
fn an_integral_without_a_series_agrees() {
    for row in reference_numbers("reflectance_integral.csv") {
        let [g, b, s] = row.try_into().unwrap();
        assert_near(&format!("g {g}, b {b}"), diffuse_sum(g, b, Precision::Full) / s, 1.0, 1e-13);
    }
}

#[test]
fn at_no_inclination_the_corrections_are_factorials() {
    // S(g, 0) = e^-g (Ei(g) − ln g − γ), whose expansion has k! for coefficients: from g = 1e3 on eight of them are all digits.
    for g in [1e3, 2.5e3, 1e5, 1e12, 1e13] {
        let (mut term, mut expected) = (1.0, 1.0);
        for k in 1..=8 {
            term *= f64::from(k) / g;
            expected += term;
        }
        assert_near(&format!("g {g}"), g * diffuse_sum(g, 0.0, Precision::Full) / expected, 1.0, 2e-14);
    }
}

#[test]
fn many_at_once_are_the_same_bits() {
    let mut g: Vec<f64> = (0..1000).map(|i| 10.0_f64.powf(-5.0 + 20.0 * f64::from(i * 37 % 1000) / 1000.0)).collect();
    let mut b: Vec<f64> = (0..1000).map(|i| g[i] * 10.0_f64.powf(-6.0 + 0.01 * i as f64)).collect();
    g[..6].copy_from_slice(&[0.0, -1.0, f64::NAN, f64::INFINITY, 1e-310, 1.0]);
    b[5..10].copy_from_slice(&[f64::NAN, f64::INFINITY, -1.0, 0.0, 1e300]);
    for (precision, _) in PROMISES {
        for count in [1, 9, 16, 17, 1000] {
            let mut sums = vec![-1.0; 1001];
            diffuse_sums_into(&g[..count], &b, precision, &mut sums);
            for i in 0..count {
                assert_eq!(sums[i].to_bits(), diffuse_sum(g[i], b[i], precision).to_bits(), "{} {}", g[i], b[i]);
            }
            assert!(sums[count..].iter().all(|&rest| rest == -1.0));
        }
    }
}

#[test]
fn there_is_no_step_between_the_pieces() {
    // Octaves of g, half octaves of 1 + b/b0, and where the polynomials end.
    let next_to = |v: f64| [f64::from_bits(v.to_bits() - 1), v];
    for (precision, promise) in PROMISES {
        for exponent in -10..=41 {
            let b0 = match exponent {
                ..4 => 2.0,
                4 => 8.0,
                5 => 32.0,
                _ => 4.0 * f64::from(exponent).exp2(),
            };
            for half in 0..=17 {
                let b = b0 * ((0.5 * f64::from(half)).exp2() - 1.0);
                let g = f64::from(exponent).exp2();
                let [left, right] = next_to(g).map(|g| ln_diffuse_sum(g, b * 1.01, precision));
                assert_near(&format!("g {g}, b {b}"), left, right, promise + conditioning(right));
                let [left, right] = [1.0 - 1e-14, 1.0 + 1e-14].map(|c| ln_diffuse_sum(1.3 * g, b * c, precision));
                let slope = 1e-13 * right.abs();
                assert_near(&format!("g {g}, b {b}, along b"), left, right, promise + slope);
            }
        }
    }
}

#[test]
fn a_slight_roughness_leaves_the_first_term() {
    for b in [0.0, 0.3, 4.0, 16.0] {
        for g in [1e-300, 1e-100, 1e-20] {
            let expected = g * f64::exp(-b);
            let value = diffuse_sum(g, b, Precision::Full);
            // Below 1e-300 nothing is left.
            let expected = if expected < 1e-300 { 0.0 } else { expected };
            assert_near(&format!("g {g}, b {b}"), value, expected, 1e-13 * expected);
        }
    }
}

#[test]
fn one_term_far_above_its_neighbors_is_found() {
    // m is 1.98; the first term is e^145 times smaller than the second.
    let (g, b) = (2.107_093_716_582e-65_f64, 590.226_292_778_497_9);
    let expected = 2.0 * g.ln() - 4.0_f64.ln() - b / 2.0;
    assert_near("ln S", ln_diffuse_sum(g, b, Precision::Full), expected, conditioning(expected));
    assert_near("S", diffuse_sum(g, b, Precision::Full).ln(), expected, conditioning(expected));
}

#[test]
fn a_great_roughness_leaves_equation_four() {
    for g in [1e6_f64, 1e9, 1e15, 1e100] {
        for beta in [0.0_f64, 0.5, 4.0, 20.0] {
            let value = diffuse_sum(g, beta * g, Precision::Full) * g / (-beta).exp();
            // The first correction is (1 − 2β + β²/2)/g.
            assert_near(&format!("g {g}, β {beta}"), value, 1.0, 1.1 * (1.0 + beta * beta) / g + 1e-13);
        }
    }
}

#[test]
fn arguments_beyond_reason_are_understood() {
    for (precision, _) in PROMISES {
        for g in [0.0, -0.0, -1.0, f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            assert_eq!(diffuse_sum(g, 1.0, precision), 0.0, "g {g}");
            assert_eq!(ln_diffuse_sum(g, 1.0, precision), f64::NEG_INFINITY, "g {g}");
        }
        for b in [f64::NAN, f64::INFINITY] {
            assert_eq!(diffuse_sum(1.0, b, precision), 0.0, "b {b}");
            assert_eq!(ln_diffuse_sum(1.0, b, precision), f64::NEG_INFINITY, "b {b}");
        }
        assert_eq!(diffuse_sum(1.0, -1.0, precision), diffuse_sum(1.0, 0.0, precision));
    }
}

#[test]
fn the_logarithm_of_a_subnormal_roughness_is_a_number() {
    for g in [5e-324, 1.6e-322, 1e-310] {
        for b in [0.0, 1500.0, 5e4] {
            let ln = ln_diffuse_sum(g, b, Precision::Full);
            assert!(ln.is_finite() && ln < -700.0, "g {g}, b {b}: {ln}");
        }
    }
}

#[test]
fn what_has_no_piece_is_summed_directly() {
    let mut sums = [0.5; 2];
    diffuse_sums_into(&[f64::NAN, 1e-300], &[0.0; 2], Precision::Full, &mut sums);
    assert!(sums == [0.0, 1e-300]);
}
