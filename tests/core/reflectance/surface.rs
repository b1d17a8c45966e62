//! Tests of valid surface parameters, and of the notes at the limits of the model.

use std::hash::{DefaultHasher, Hash, Hasher};

use chromascope_core::reflectance::{Caution, Surface, SurfaceError};

use crate::support::assert_near;

#[test]
fn numbers_out_of_range_are_refused_by_name() {
    let good = [5e-6, 1e-5, 5e-5, 5e-5, 1.4];
    let with = |place: usize, value: f64| {
        let mut numbers = good;
        numbers[place] = value;
        let [sigma, tau, x, y, index] = numbers;
        Surface::new(sigma, tau, x, y, index).map(|_| ())
    };
    let errors =
        [SurfaceError::Sigma, SurfaceError::Tau, SurfaceError::Patch, SurfaceError::Patch, SurfaceError::Index];
    for (place, error) in errors.into_iter().enumerate() {
        for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, -1e-9, 1e4] {
            assert_eq!(with(place, bad), Err(error), "{place}: {bad}");
        }
        assert_eq!(with(place, good[place]), Ok(()));
    }
    assert_eq!(with(0, 0.0), Ok(()));
    assert_eq!([with(1, 0.0), with(2, 0.0), with(4, 0.0)].map(|r| r.is_err()), [true; 3]);
    assert_eq!([with(0, 1.0), with(1, 1e-9), with(2, 1.0), with(4, 1000.0), with(4, 0.5)], [Ok(()); 5]);
}

#[test]
fn equal_surfaces_hash_alike() {
    let hash = |surface: &Surface| {
        let mut hasher = DefaultHasher::new();
        surface.hash(&mut hasher);
        hasher.finish()
    };
    let [zero, negative_zero, other] = [0.0, -0.0, 1e-9].map(|s| Surface::new(s, 1e-5, 1e-4, 2e-4, 1.4).unwrap());
    assert_eq!(zero, negative_zero);
    assert_eq!(hash(&zero), hash(&negative_zero));
    assert_ne!(zero, other);
    assert_near("area", zero.area_m2(), 8e-8, 1e-22);
}

#[test]
fn the_render_panes_presets_are_an_empirical_lobe() {
    let skin = Surface::new(5e-6, 10e-6, 50e-6, 50e-6, 1.4).unwrap();
    assert_eq!(skin.cautions(), [Caution::Steep]);
    assert_near("slope", skin.slope(), std::f64::consts::FRAC_1_SQRT_2, 1e-15);
}

#[test]
fn cautions_say_where_the_model_is_stretched() {
    let cautions = |sigma, tau, x, y| Surface::new(sigma, tau, x, y, 1.4).unwrap().cautions();
    assert_eq!(cautions(1e-6, 10e-6, 50e-6, 50e-6), []);
    assert_eq!(cautions(1e-6, 10e-6, 50e-6, 49e-6), [Caution::SmallPatch]);
    assert_eq!(cautions(1e-7, 700e-9, 50e-6, 50e-6), [Caution::ShortCorrelation]);
    assert_eq!(cautions(1.0, 1e-9, 1e-9, 1.0), [Caution::SmallPatch, Caution::ShortCorrelation, Caution::Steep]);
    assert!(Caution::Steep.to_string().contains("brightness by angle is approximate"));
    for caution in [Caution::SmallPatch, Caution::ShortCorrelation, Caution::Steep] {
        assert!(caution.to_string().len() > 40);
    }
}
