//! Rays along the axes, and from and to nowhere.

use chromascope_core::render::{RasterSize, ShadowTree};
use chromascope_core::scene::shapes;
use glam::DVec3;

/// A direction with a component of −0 is the same as with 0.
#[test]
fn a_ray_is_stopped_whatever_the_sign_of_its_zeros() {
    let tree = ShadowTree::new(&shapes::sphere(4000));
    let point = DVec3::new(-0.107, -0.193, 0.024);
    for zero in [0.0, -0.0, -1e-106, 1e-106] {
        assert!(tree.is_blocked(point, DVec3::new(0.43, 0.9, zero), 10.0), "z {zero}");
        assert!(tree.is_blocked(DVec3::new(0.013, 0.017, 0.5), DVec3::new(zero, zero, -1.0), 10.0), "x, y {zero}");
    }
}

#[test]
fn nothing_is_in_the_way_of_what_is_no_direction() {
    let tree = ShadowTree::new(&shapes::sphere(500));
    assert!(!tree.is_blocked(DVec3::ZERO, DVec3::new(f64::NAN, 0.0, 1.0), 1.0));
    assert!(!tree.is_blocked(DVec3::ZERO, DVec3::new(f64::INFINITY, 0.0, 1.0), 1.0));
    assert!(!tree.is_blocked(DVec3::ZERO, DVec3::Z, f64::NAN));
}

#[test]
fn a_size_of_any_numbers_has_a_count() {
    let size = RasterSize { width: u32::MAX, height: u32::MAX, samples: 8 };
    assert_eq!([size.columns(), size.rows()], [u32::MAX as usize * 8; 2]);
}
