//! Tests of the coherent component's pattern: its mean over the light source, its bound, and when it may be skipped.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use chromascope_core::reflectance::coherent::{
    mean_sinc_squared, rho0_squared, rho0_squared_bound, sinc, sine_integral,
};
use chromascope_core::reflectance::{Geometry, Surface};
use proptest::prelude::*;

use super::integral;
use crate::support::{assert_near, cases, reference_numbers};

#[test]
fn sinc_has_its_maximum_and_its_zeros() {
    assert_eq!([sinc(0.0), sinc(-0.0)], [1.0; 2]);
    assert_eq!(sinc(1e-9), 1.0);
    assert_near("half a period", sinc(FRAC_PI_2), 2.0 / PI, 1e-16);
    assert_near("a zero", sinc(PI), 0.0, 1e-16);
    assert_eq!([f64::INFINITY, f64::NEG_INFINITY, f64::NAN].map(sinc), [0.0; 3]);
}

#[test]
fn the_mean_agrees_with_sixty_digits() {
    for row in reference_numbers("reflectance_sinc.csv") {
        let [u0, w, mean] = row.try_into().unwrap();
        assert_near(&format!("u0 {u0}, w {w}"), mean_sinc_squared(u0, w), mean, 1e-14);
        assert_eq!(mean_sinc_squared(-u0, w), mean_sinc_squared(u0, w));
        if w > 0.5 && u0 - w > 100.0 {
            assert_near(&format!("u0 {u0}, w {w}"), mean_sinc_squared(u0, w) / mean, 1.0, 1e-9);
        }
    }
}

#[test]
fn the_mean_agrees_with_quadrature() {
    for [u0, w] in [[0.0, 0.3], [2.0, 0.7], [1.0, 5.0], [40.0, 3.0], [98.0, 30.0], [140.0, 20.0]] {
        let expected = integral(u0 - w, u0 + w, 200, |u| sinc(u).powi(2)) / (2.0 * w);
        assert_near(&format!("u0 {u0}, w {w}"), mean_sinc_squared(u0, w), expected, 1e-14);
    }
}

#[test]
fn the_sine_integral_is_the_integral_of_sinc() {
    for x in [0.1, 1.0, 3.999, 4.001, 10.0, 30.0, 100.0] {
        let expected = integral(0.0, x, 100, sinc);
        assert_near(&format!("Si({x})"), sine_integral(x), expected, 5e-15);
        assert_eq!(sine_integral(-x), -sine_integral(x));
    }
    assert_eq!(sine_integral(0.0), 0.0);
    assert_near("Si(∞)", sine_integral(f64::INFINITY), FRAC_PI_2, 0.0);
    assert_near("Si(1e200)", sine_integral(1e200), FRAC_PI_2, 1e-16);
    assert_eq!(sine_integral(f64::NAN), 0.0);
}

#[test]
fn a_point_light_gives_the_pattern_itself() {
    let surface = Surface::new(1e-7, 1e-5, 50e-6, 20e-6, 1.4).unwrap();
    let geometry = Geometry::from_angles(0.5, 0.51, 0.004);
    let k = TAU / 550e-9;
    let expected = (sinc(k * geometry.vx_by_k * 50e-6) * sinc(k * geometry.vy_by_k * 20e-6)).powi(2);
    assert_near("no radius", rho0_squared(&geometry, &surface, k, 0.0), expected, 1e-15);
    for radius in [1e-9, 1e-7, 1e-5] {
        // A mean deviates by the second power of the width.
        let reach = k * 50e-6 * radius;
        assert_near("a small radius", rho0_squared(&geometry, &surface, k, radius), expected, reach * reach + 1e-15);
    }
}

#[test]
fn what_is_no_number_has_no_pattern() {
    for bad in [f64::NAN, f64::INFINITY] {
        assert_eq!(mean_sinc_squared(bad, 1.0), 0.0);
        assert_eq!(mean_sinc_squared(1.0, bad), 0.0);
    }
    assert_eq!(mean_sinc_squared(0.7, -1.0), mean_sinc_squared(0.7, 0.0));
}

/// A number between two powers of ten, every size alike.
fn between(low: f64, high: f64) -> impl Strategy<Value = f64> {
    (low.log10()..high.log10()).prop_map(|exponent| 10.0_f64.powf(exponent))
}

proptest! {
    #![proptest_config(cases(2000))]

    #[test]
    fn the_bound_holds(
        half_x in between(1e-9, 1.0), half_y in between(1e-9, 1.0), radius in between(1e-9, 1.0),
        angles in (0.0..1.57_f64, 0.0..1.57_f64, -3.2..3.2_f64), nm in 200.0..2500.0_f64,
    ) {
        let surface = Surface::new(1e-7, 1e-5, half_x, half_y, 1.4).unwrap();
        let geometry = Geometry::from_angles(angles.0, angles.1, angles.2);
        for radius in [0.0, radius] {
            let k = TAU / (nm * 1e-9);
            let (mean, bound) =
                (rho0_squared(&geometry, &surface, k, radius), rho0_squared_bound(&geometry, &surface, k, radius));
            prop_assert!((0.0..=1.0 + 1e-15).contains(&mean), "{}", mean);
            prop_assert!(mean <= bound * (1.0 + 1e-9), "{} {}", mean, bound);
        }
    }
}
