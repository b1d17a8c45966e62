//! Fresnel's formulas, against 80-digit figures and their own laws.

use chromascope_core::reflectance::fresnel::{reflectance, transmittance, transmittance_by_cosine};
use proptest::prelude::*;

use crate::support::{assert_near, cases, reference_numbers};

fn relative(value: f64, expected: f64) -> f64 {
    if expected == 0.0 { value.abs() } else { (value / expected - 1.0).abs() }
}

#[test]
fn all_digits_survive_everywhere() {
    let mut worst = [0.0_f64; 3];
    for row in reference_numbers("reflectance_fresnel.csv") {
        let [cos, index, f, t, t_by_cos] = row.try_into().unwrap();
        // At n = 1 the last column is 1/cos, which is cut.
        let expected = [f, t, t_by_cos.min(1e15)];
        let values = [reflectance(cos, index), transmittance(cos, index), transmittance_by_cosine(cos, index)];
        for i in 0..3 {
            worst[i] = worst[i].max(relative(values[i], expected[i]));
        }
    }
    assert!(worst.iter().all(|error| *error < 1e-13), "{worst:?}");
}

#[test]
fn matched_media_pass_all_light() {
    for cos in [1e-300, 1e-9, 0.3, 1.0] {
        assert_eq!(reflectance(cos, 1.0), 0.0);
        assert_near("T", transmittance(cos, 1.0), 1.0, 1e-15);
    }
}

#[test]
fn all_light_stays_behind_at_grazing_and_beyond() {
    for index in [0.5, 1.0, 1.5] {
        for cos in [0.0, -0.0, -0.5, -1.0, f64::NAN] {
            assert_eq!(reflectance(cos, index), 1.0);
            assert_eq!(transmittance(cos, index), 0.0);
            assert_eq!(transmittance_by_cosine(cos, index), 0.0);
        }
    }
    for index in [0.0, -1.0, f64::NAN, f64::INFINITY, 1e31] {
        assert_eq!(reflectance(0.5, index), 1.0);
        assert_eq!(transmittance(0.5, index), 0.0);
    }
}

#[test]
fn below_index_one_reflection_becomes_total() {
    // sin θ = n at the critical angle.
    let index = 0.8_f64;
    let critical = (1.0 - index * index).sqrt();
    assert_eq!(reflectance(critical - 1e-9, index), 1.0);
    assert!(reflectance(critical + 1e-9, index) < 1.0);
}

#[test]
fn at_brewsters_angle_half_the_light_is_unpolarized_loss() {
    // tan θ = n: the parallel part vanishes, the other has r = (n² − 1)/(n² + 1).
    let index = 1.5_f64;
    let cos = 1.0 / (1.0 + index * index).sqrt();
    let r = (index * index - 1.0) / (index * index + 1.0);
    assert_near("F", reflectance(cos, index), r * r / 2.0, 1e-16);
}

proptest! {
    #![proptest_config(cases(2000))]

    /// The second factor of Eq 3 as the paper writes it.
    #[test]
    fn a_leaving_ray_passes_as_one_that_enters(cos in 0.01..1.0_f64, index in 1.01..3.0_f64) {
        let sin = (1.0 - cos * cos).sqrt();
        let inside = (sin / index).asin().cos();
        prop_assert!((reflectance(inside, 1.0 / index) - reflectance(cos, index)).abs() < 1e-12);
    }
}
