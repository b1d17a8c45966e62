//! Tests of the numerical tools: against the standard library, published nodes, 50-digit solutions, and the cases documented
//! as exact.

use chromascope_math::cbrt::cbrt;
use chromascope_math::dense::{Cholesky, bounded_minimum};
use chromascope_math::dot::{dot, dot_each};
use chromascope_math::exp::exp;
use chromascope_math::gauss::{Rule, gauss_rule, interpolatory_rule};
use chromascope_math::interpolation::{Sprague, linear};
use chromascope_math::least_squares::{FitError, matrix_keeping};
use chromascope_math::ln::{ln, ln_1p, short_ln};
use glam::{DMat3, DVec3};
use proptest::collection::vec;
use proptest::prelude::*;

use crate::support::{assert_near, cases, reference_numbers};

#[test]
fn exp_agrees_with_the_standard_library() {
    let mut worst = 0.0_f64;
    for i in 0..=140_000 {
        // An irrational step, so that no argument is special.
        let x = -700.0 + f64::from(i) * 0.009_999_871_3;
        worst = worst.max((exp(x) / x.exp() - 1.0).abs());
    }
    for x in [0.0, -0.0, 1e-300, -1e-17, std::f64::consts::LN_2 / 2.0, 709.0_f64.min(700.0), -700.0] {
        worst = worst.max((exp(x) / x.exp() - 1.0).abs());
    }
    // Two roundings of the polynomial's last step and one of the library's.
    assert!(worst < 4e-16, "{worst}");
    assert_eq!(exp(0.0), 1.0);
    assert_eq!(exp(1e300), exp(700.0));
    assert_eq!(exp(f64::NEG_INFINITY), exp(-700.0));
}

/// Distance between a number and the expected one, in units in the last place.
fn units_apart(found: f64, right: f64) -> u64 {
    found.to_bits().abs_diff(right.to_bits())
}

#[test]
fn logarithms_agree_with_the_standard_library() {
    let (mut worst, mut worst_1p) = (0, 0);
    for i in 0..=200_000 {
        // Powers of e over the whole range, and nearer and nearer to 1 from both sides.
        let wide = (-708.0 + f64::from(i) * 0.007_083_127_1).exp();
        let near = (-36.0 + f64::from(i) * 0.000_179_871_3).exp();
        for x in [wide, 1.0 + near, 1.0 / (1.0 + near), near] {
            worst = worst.max(units_apart(ln(x), x.ln()));
            worst_1p = worst_1p.max(units_apart(ln_1p(x), x.ln_1p()));
        }
    }
    for x in [f64::MIN_POSITIVE, 0.5_f64.sqrt(), 2.0_f64.sqrt(), 0.5, 2.0, 1e16, f64::MAX] {
        worst = worst.max(units_apart(ln(x), x.ln()));
        worst_1p = worst_1p.max(units_apart(ln_1p(x), x.ln_1p()));
    }
    assert!(worst <= 2 && worst_1p <= 2, "{worst} {worst_1p}");
    assert_eq!((ln(1.0), ln_1p(0.0), ln_1p(-3.0)), (0.0, 0.0, 0.0));
    assert_eq!((ln(0.0), ln(f64::INFINITY)), (ln(f64::MIN_POSITIVE), ln(f64::MAX)));
}

#[test]
fn short_logarithms_are_near_enough() {
    let off = |i: i32| {
        let x = 1.003_f64.powi(i);
        (short_ln(x) - x.ln()).abs() / x.ln().abs().max(1.0)
    };
    assert!((-60_000..=60_000).map(off).fold(0.0, f64::max) < 2e-14);
}

proptest! {
    #![proptest_config(cases(128))]

    #[test]
    fn three_dots_at_once_are_three_dots(a in vec(-1.0..1.0, 401), b in vec(-1.0..1.0, 401), x in vec(-1.0..1.0, 401)) {
        let array = |v: &[f64]| -> [f64; 401] { v.try_into().unwrap() };
        let (a, b, x) = (array(&a), array(&b), array(&x));
        prop_assert_eq!(dot_each([&a, &b, &x], &x), [dot(&a, &x), dot(&b, &x), dot(&x, &x)]);
    }

    #[test]
    fn sprague_reproduces_quartics_inside_and_lines_everywhere(c in vec(-1.0..1.0, 5), n in 8_usize..40, x in 0.0..1.0) {
        let poly = |x: f64| c.iter().rev().fold(0.0, |sum, c| sum * x + c);
        // On [-1, 1], where the powers do not cancel.
        let step = 2.0 / (n - 1) as f64;
        let samples: Vec<f64> = (0..n).map(|i| poly(-1.0 + step * i as f64)).collect();
        let sprague = Sprague::new(-1.0, step, &samples).unwrap();
        // From the third sample to the third last; beyond, CIE 167's extension keeps no curvature.
        let inside = -1.0 + 2.0 * step + x * (2.0 - 4.0 * step);
        prop_assert!((sprague.at(inside) - poly(inside)).abs() < 2e-13, "{} {}", sprague.at(inside), poly(inside));
        let line: Vec<f64> = (0..n).map(|i| c[0] + c[1] * i as f64 / n as f64).collect();
        let at = x * (n - 1) as f64;
        let off: f64 = Sprague::new(0.0, 1.0, &line).unwrap().at(at) - (c[0] + c[1] * at / n as f64);
        prop_assert!(off.abs() < 2e-13);
    }

    #[test]
    fn interpolation_keeps_constants_and_samples(values in vec(-10.0..10.0, 6..30), constant in -5.0..5.0, x in -100.0..1000.0) {
        let xs: Vec<f64> = (0..values.len()).map(|i| 400.0 + 5.0 * i as f64).collect();
        let sprague = Sprague::new(400.0, 5.0, &values).unwrap();
        for (x, y) in xs.iter().zip(&values) {
            prop_assert!((sprague.at(*x) - y).abs() < 1e-14 * 150.0);
            prop_assert_eq!(linear(&xs, &values, *x), *y);
        }
        let flat = vec![constant; values.len()];
        prop_assert!((Sprague::new(400.0, 5.0, &flat).unwrap().at(x) - constant).abs() < 1e-14 * 150.0);
        prop_assert_eq!(linear(&xs, &flat, x), constant);
        let (low, high) = values.iter().fold((f64::MAX, f64::MIN), |(l, h), v| (l.min(*v), h.max(*v)));
        prop_assert!((low..=high).contains(&linear(&xs, &values, x)));
    }
}

#[test]
fn interpolation_is_total() {
    assert_eq!(linear(&[], &[], 1.0), 0.0);
    assert_eq!(linear(&[500.0], &[2.0], 1.0), 2.0);
    assert_eq!(linear(&[1.0, 3.0], &[10.0, 30.0], 2.0), 20.0);
    assert!(Sprague::new(0.0, 1.0, &[1.0; 5]).is_none());
    assert!(Sprague::new(0.0, 0.0, &[1.0; 6]).is_none());
    let ends = Sprague::new(0.0, 1.0, &[1.0, 4.0, 2.0, 5.0, 3.0, 6.0]).unwrap();
    assert_near("below", ends.at(-1e300), 1.0, 1e-14);
    assert_near("above", ends.at(1e300), 6.0, 1e-14);
}

#[test]
fn gauss_rules_of_a_gauss_legendre_measure_are_the_published_rules() {
    let table = reference_numbers("gauss_legendre.csv");
    let rule = |count: f64| -> (Vec<f64>, Vec<f64>) {
        table.iter().filter(|row| row[0] == count).map(|row| (row[1], row[2])).unzip()
    };
    // Twelve nodes stand exactly for the uniform measure up to degree 23, so its smaller Gauss rules are those of the measure.
    let (points, masses) = rule(12.0);
    for count in [2, 3, 5, 8] {
        let found = gauss_rule(&points, &masses, count);
        let (nodes, weights) = rule(count as f64);
        for i in 0..count {
            assert_near("node", found.nodes[i], nodes[i], 2e-15);
            assert_near("weight", found.weights[i], weights[i], 4e-15);
        }
    }
}

#[test]
fn a_gauss_rule_of_few_points_is_the_measure_itself() {
    let rule = gauss_rule(&[400.0, 500.0, 600.0], &[1.0, 0.0, 2.0], 5);
    assert_eq!(rule, Rule { nodes: vec![400.0, 600.0], weights: vec![1.0, 2.0] });
    assert_eq!(gauss_rule(&[], &[], 3).nodes.len(), 0);
    assert_eq!(gauss_rule(&[1.0, 2.0], &[1.0, 1.0], 0).nodes.len(), 0);
    let one = gauss_rule(&[1.0, 2.0, 4.0], &[1.0, 1.0, 2.0], 1);
    assert_near("mean", one.nodes[0], 2.75, 1e-15);
    assert_near("mass", one.weights[0], 4.0, 1e-15);
}

/// Chebyshev polynomials on the grid's range: bounded by 1, so that errors are relative to the mass.
fn chebyshev(degree: usize, nm: f64) -> f64 {
    (degree as f64 * ((nm - 580.0) / 200.0).clamp(-1.0, 1.0).acos()).cos()
}

fn total(rule: &Rule, degree: usize) -> f64 {
    rule.nodes.iter().zip(&rule.weights).map(|(x, w)| w * chebyshev(degree, *x)).sum()
}

fn grid(n: usize) -> Vec<f64> {
    (0..n).map(|i| 380.0 + 400.0 * i as f64 / (n - 1) as f64).collect()
}

proptest! {
    #![proptest_config(cases(64))]

    #[test]
    fn masses_over_many_orders_of_magnitude_stay_exact(exponents in vec(-40.0..0.0_f64, 60..401), count in 1_usize..29) {
        let masses: Vec<f64> = exponents.iter().map(|e| 10.0_f64.powf(*e)).collect();
        let points = grid(masses.len());
        let rule = gauss_rule(&points, &masses, count);
        let mass: f64 = masses.iter().sum();
        for degree in 0..2 * count {
            let exact: f64 = points.iter().zip(&masses).map(|(x, m)| m * chebyshev(degree, *x)).sum();
            prop_assert!((total(&rule, degree) - exact).abs() < 1e-12 * mass, "degree {degree} of {count} nodes");
        }
        prop_assert!(rule.weights.iter().all(|w| *w >= 0.0 && w.is_finite()));
    }
}

#[test]
fn interpolatory_rules_take_nodes_on_samples() {
    let rule = interpolatory_rule(&[400.0, 500.0], &[400.0, 450.0, 500.0], &[1.0, 2.0, -1.0]);
    assert_eq!(rule.weights, [2.0, 0.0]);
    assert_eq!(interpolatory_rule(&[450.0], &[400.0, 500.0], &[1.0, 2.0]).weights, [3.0]);
}

/// The made-up problem of `constrained_fit.csv`.
fn problem() -> (Vec<DVec3>, Vec<DVec3>) {
    (0..40)
        .map(|k| {
            let k = f64::from(k);
            let a = DVec3::new(0.5 + 0.4 * k.sin(), 0.45 + 0.3 * (1.7 * k).cos(), 0.55 + 0.35 * (2.3 * k + 1.0).sin());
            let b = DVec3::new(
                0.5 + 0.3 * (k + 0.2).sin(),
                0.5 + 0.35 * (1.6 * k).cos(),
                0.4 + 0.3 * (2.1 * k + 1.0).sin(),
            );
            (a, b)
        })
        .unzip()
}

#[test]
fn the_constrained_fit_matches_fifty_digits() {
    let (samples, targets) = problem();
    let (white, image) = (DVec3::new(1.0, 0.9, 1.2), DVec3::new(0.95, 1.0, 1.09));
    let matrix = matrix_keeping(&samples, &targets, white, image).unwrap();
    for (row, expected) in reference_numbers("constrained_fit.csv").iter().enumerate() {
        for (value, expected) in matrix.row(row).to_array().into_iter().zip(expected) {
            assert_near("element", value, *expected, 1e-14);
        }
    }
}

#[test]
fn fits_without_an_answer_are_refused() {
    let (samples, targets) = problem();
    let flat: Vec<DVec3> = samples.iter().map(|a| DVec3::new(a.x, a.y, a.x)).collect();
    assert_eq!(matrix_keeping(&flat, &targets, DVec3::ONE, DVec3::ONE), Err(FitError::Dependent));
    assert_eq!(matrix_keeping(&[], &[], DVec3::ONE, DVec3::ONE), Err(FitError::Dependent));
    assert_eq!(matrix_keeping(&samples[..1], &targets, DVec3::ONE, DVec3::ONE), Err(FitError::Dependent));
    assert_eq!(matrix_keeping(&samples, &targets, DVec3::ZERO, DVec3::ONE), Err(FitError::NoWhite));
    assert_eq!(matrix_keeping(&samples, &targets, DVec3::NAN, DVec3::ONE), Err(FitError::NoWhite));
    for hostile in [f64::NAN, f64::INFINITY, 1e300] {
        let mut spoiled = samples.clone();
        spoiled[3].y = hostile;
        assert_eq!(matrix_keeping(&spoiled, &targets, DVec3::ONE, DVec3::ONE), Err(FitError::Dependent), "{hostile}");
    }
}

proptest! {
    #![proptest_config(cases(128))]

    #[test]
    fn white_is_kept_and_a_true_matrix_is_found(m in vec(-1.0..2.0, 9), a in vec((0.0..1.0, 0.0..1.0, 0.0..1.0), 6..60)) {
        let truth = DMat3::from_cols_slice(&m);
        let samples: Vec<DVec3> = a.iter().map(|&(x, y, z)| DVec3::new(x, y, z)).collect();
        let targets: Vec<DVec3> = samples.iter().map(|a| truth * *a).collect();
        let image = truth * DVec3::ONE;
        let Ok(found) = matrix_keeping(&samples, &targets, DVec3::ONE, image) else {
            return Ok(());
        };
        prop_assert!((found * DVec3::ONE - image).abs().max_element() < 1e-12);
        for (a, b) in samples.iter().zip(&targets) {
            prop_assert!((found * *a - *b).abs().max_element() < 1e-12);
        }
    }
}

#[test]
fn a_table_without_a_place_or_a_spacing_is_refused() {
    let samples = [1.0; 8];
    for [start, step] in
        [[f64::NAN, 5.0], [f64::INFINITY, 5.0], [380.0, f64::NAN], [380.0, f64::INFINITY], [380.0, 0.0]]
    {
        assert!(Sprague::new(start, step, &samples).is_none(), "{start} {step}");
    }
}

#[test]
fn a_tiny_white_is_kept_as_exactly_as_any() {
    let samples = [DVec3::new(1.0, 0.2, 0.1), DVec3::new(0.1, 1.0, 0.3), DVec3::new(0.3, 0.1, 1.0)];
    let (white, image) = (DVec3::new(3e-156, 0.0, 0.0), DVec3::new(0.9, 1.0, 1.1));
    let matrix = matrix_keeping(&samples, &samples, white, image).unwrap();
    assert!((matrix * white - image).abs().max_element() < 1e-14);
}

#[test]
fn cube_roots_are_the_standard_library_s() {
    let off = |i: i32| {
        let x = 1.007_f64.powi(i);
        (cbrt(x) / x.cbrt() - 1.0).abs()
    };
    // From 1e-300 to 1e300.
    let worst = (-99_000..=99_000).map(off).fold(0.0, f64::max);
    assert!(worst < 5e-16, "{worst:e}");
}

#[test]
fn dense_systems_agree_with_their_inverse_and_their_bounds() {
    const SIZE: usize = 9;
    let at = |i: usize, j: usize| if i == j { 3.0 + i as f64 } else { 1.0 / (1.0 + (i as f64 - j as f64).abs()) };
    let matrix: Vec<f64> = (0..SIZE * SIZE).map(|index| at(index / SIZE, index % SIZE)).collect();
    let factor = Cholesky::new(matrix.clone(), SIZE).unwrap();
    let inverse = factor.inverse();
    let product = |i: usize, j: usize| (0..SIZE).map(|k| matrix[i * SIZE + k] * inverse[k * SIZE + j]).sum::<f64>();
    assert!((0..SIZE * SIZE).all(|n| (product(n / SIZE, n % SIZE) - f64::from(n / SIZE == n % SIZE)).abs() < 1e-14));
    // The last unknowns alone: products of the half-solved unit vectors.
    for first in [0, 4, 8] {
        let count = SIZE - first;
        let unit: Vec<f64> = (0..count * count).map(|n| f64::from(u8::from(n / count == n % count))).collect();
        let half = factor.half_solve(first, unit);
        for (i, j) in (0..count).flat_map(|i| (0..count).map(move |j| (i, j))) {
            let dot: f64 = (0..count).map(|k| half[k * count + i] * half[k * count + j]).sum();
            assert!((dot - inverse[(first + i) * SIZE + first + j]).abs() < 1e-15, "{first} {i} {j}");
        }
    }
    // Wherever the search begins, the minimum is the same.
    let pull: Vec<f64> = (0..SIZE).map(|i| if i % 2 == 0 { 2.0 } else { -1.5 }).collect();
    let bounds = [[0.0, 0.4]; SIZE];
    let found = bounded_minimum(&matrix, &pull, &bounds, None).unwrap();
    assert!(found.contains(&0.0) && found.contains(&0.4) && found.iter().any(|x| *x > 0.0 && *x < 0.4), "{found:?}");
    for near in [[0.0; SIZE], [0.4; SIZE], [0.2; SIZE]] {
        let other = bounded_minimum(&matrix, &pull, &bounds, Some(&near)).unwrap();
        assert!(found.iter().zip(&other).all(|(a, b)| (a - b).abs() < 1e-15), "{other:?}");
    }
}
