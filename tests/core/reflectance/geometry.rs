//! Directions about a surface: against 50-digit figures, and angles against vectors.

use chromascope_core::reflectance::Geometry;
use glam::{DQuat, DVec3};
use proptest::prelude::*;

use crate::support::{assert_near, cases, reference_numbers};

#[test]
fn digits_survive_next_to_the_mirror_direction() {
    for row in reference_numbers("reflectance_geometry.csv") {
        let [theta_i, theta_s, phi_s, vx, vy, vxy2, vz] = row.try_into().unwrap();
        let geometry = Geometry::from_angles(theta_i, theta_s, phi_s);
        let what = format!("{theta_i} {theta_s} {phi_s}");
        assert_near(&format!("v_y at {what}"), geometry.vy_by_k, vy, 1e-15 * vy.abs());
        assert_near(&format!("v_xy² at {what}"), geometry.vxy2_by_k2, vxy2, 2e-14 * vxy2);
        // v_x has a zero of its own away from the specular direction; against the whole of v_xy it keeps its digits.
        assert_near(&format!("v_x at {what}"), geometry.vx_by_k, vx, 1e-15 * vx.abs() + 2e-15 * vxy2.sqrt());
        assert_near(&format!("v_z at {what}"), geometry.vz_by_k, vz, 4e-16);
    }
}

#[test]
fn the_mirror_direction_has_no_tangential_part() {
    let geometry = Geometry::from_angles(0.9, 0.9, 0.0);
    assert_eq!([geometry.vx_by_k, geometry.vy_by_k, geometry.vxy2_by_k2], [0.0; 3]);
    assert_near("(l·ĥ)²", geometry.cos_half2, 0.9_f64.cos().powi(2), 1e-15);
    let normal = DVec3::Z;
    let light = DVec3::new(0.6, 0.0, 0.8);
    let exact = Geometry::from_directions(light, DVec3::new(-0.6, 0.0, 0.8), normal);
    assert_eq!([exact.vx_by_k, exact.vy_by_k, exact.vxy2_by_k2], [0.0; 3]);
}

#[test]
fn vectors_keep_their_digits_next_to_the_mirror_direction() {
    for tilt in [1e-3, 1e-6, 1e-9, 1e-12] {
        let light = DVec3::new(0.6, 0.0, 0.8);
        // A viewer turned out of the specular direction, in the plane and across it by as much.
        let viewer = DVec3::new(-0.6 + 0.8 * tilt, 0.6 * tilt, 0.8 + 0.6 * tilt);
        let geometry = Geometry::from_directions(light, viewer, DVec3::Z);
        assert_near("v_x", geometry.vx_by_k / tilt, 0.8, 1e-15 / tilt);
        assert_near("v_y", geometry.vy_by_k.abs() / tilt, 0.6, 1e-15 / tilt);
    }
}

#[test]
fn back_faces_and_grazing_rays_are_dark() {
    assert!(Geometry::from_angles(0.5, 1.5, 2.0).is_lit());
    assert!(!Geometry::from_angles(1.6, 0.2, 0.0).is_lit());
    assert!(!Geometry::from_angles(0.2, 1.6, 0.0).is_lit());
    assert!(!Geometry::DARK.is_lit());
    assert!(!Geometry::from_directions(DVec3::X, DVec3::Z, DVec3::Z).is_lit());
}

#[test]
fn what_is_no_number_is_dark() {
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        assert_eq!(Geometry::from_angles(bad, 0.1, 0.2), Geometry::DARK);
        assert_eq!(Geometry::from_angles(0.1, bad, 0.2), Geometry::DARK);
        assert_eq!(Geometry::from_angles(0.1, 0.2, bad), Geometry::DARK);
        assert_eq!(Geometry::from_directions(DVec3::Z, DVec3::splat(bad), DVec3::Z), Geometry::DARK);
    }
    // No direction at all.
    let nothing = Geometry::from_directions(DVec3::ZERO, DVec3::ZERO, DVec3::ZERO);
    assert!(!nothing.is_lit() && nothing.vx_by_k.is_finite() && nothing.vy_by_k.is_finite());
}

/// A unit vector from zenith angle and azimuth.
fn direction(theta: f64, phi: f64) -> DVec3 {
    DVec3::new(theta.sin() * phi.cos(), theta.sin() * phi.sin(), theta.cos())
}

proptest! {
    #![proptest_config(cases(1000))]

    #[test]
    fn angles_and_vectors_agree(
        theta_i in 0.01..1.56_f64, theta_s in 0.0..1.56_f64, phi_s in -7.0..7.0_f64,
        turn in -3.0..3.0_f64, axis in (-1.0..1.0_f64, -1.0..1.0_f64, 0.1..1.0_f64),
    ) {
        // φi = π, then everything turned about any axis.
        let turn = DQuat::from_axis_angle(DVec3::new(axis.0, axis.1, axis.2).normalize(), turn);
        let [light, viewer, normal] =
            [direction(theta_i, std::f64::consts::PI), direction(theta_s, phi_s), DVec3::Z].map(|v| turn * v);
        let by_vectors = Geometry::from_directions(light, viewer, normal);
        let by_angles = Geometry::from_angles(theta_i, theta_s, phi_s);
        let numbers = |g: &Geometry| [g.cos_i, g.cos_s, g.vx_by_k, g.vy_by_k, g.vxy2_by_k2, g.vz_by_k, g.cos_half2];
        for (a, b) in numbers(&by_vectors).into_iter().zip(numbers(&by_angles)) {
            prop_assert!((a - b).abs() < 1e-13, "{:?} {:?}", by_vectors, by_angles);
        }
        prop_assert!((by_angles.vx_by_k.hypot(by_angles.vy_by_k).powi(2) - by_angles.vxy2_by_k2).abs() < 1e-14);
        // l·ĥ from its definition.
        let half = (light + viewer).normalize();
        prop_assert!((light.dot(half).powi(2) - by_vectors.cos_half2).abs() < 1e-13);
    }

    #[test]
    fn light_and_viewer_can_change_places(theta_i in 0.0..1.57_f64, theta_s in 0.0..1.57_f64, phi_s in -3.2..3.2_f64) {
        let (there, back) =
            (Geometry::from_angles(theta_i, theta_s, phi_s), Geometry::from_angles(theta_s, theta_i, phi_s));
        prop_assert!((there.vxy2_by_k2 - back.vxy2_by_k2).abs() < 1e-15);
        prop_assert_eq!(there.vz_by_k, back.vz_by_k);
    }
}

#[test]
fn the_quick_way_is_the_same_or_says_that_it_is_not() {
    let unit = |i: u32| DVec3::new((1.7 * f64::from(i)).sin(), (2.3 * f64::from(i)).cos(), 0.4).normalize();
    for i in 0..500 {
        let (light, viewer, normal) = (unit(i), unit(3 * i + 1), unit(7 * i + 2));
        let (quick, holds) = Geometry::from_directions_branchless(light, viewer, normal);
        assert!(holds);
        assert_eq!(quick, Geometry::from_directions(light, viewer, normal));
    }
    for (light, normal) in [(DVec3::Z, DVec3::Z), (DVec3::NAN, DVec3::Z), (DVec3::X, DVec3::INFINITY)] {
        assert!(!Geometry::from_directions_branchless(light, DVec3::Y, normal).1);
    }
}
