//! The share of light that a surface returns, beside brute force over the hemisphere.

use std::f64::consts::{FRAC_PI_2, PI};

use chromascope_core::query::render::returned::ReturnedLightQuery;
use chromascope_core::query::{Ask, Direct};
use chromascope_core::reflectance::{
    Geometry, IlluminatedArea, Normalization, Precision, Specular, Surface, diffuse_prefactor, diffuse_sum,
    directional_hemispherical, kappa,
};

use super::integral;
use crate::support::assert_near;

/// The pane's default surface, skin.
fn skin() -> Surface {
    Surface::new(5e-6, 10e-6, 50e-6, 50e-6, 1.4).unwrap()
}

/// ∫ f cos θs dω of the diffuse component in polar angles about the normal.
fn brute_force(surface: &Surface, reading: Normalization, theta_i: f64) -> f64 {
    let k = 2.0 * PI / 550e-9;
    let ring = |theta_s: f64| {
        let around = |phi: f64| {
            let geometry = Geometry::from_angles(theta_i, theta_s, phi);
            let b = (k * surface.tau_m()).powi(2) * geometry.vxy2_by_k2 / 4.0;
            let sum = diffuse_sum(kappa(surface, &geometry), b, Precision::default());
            diffuse_prefactor(surface, &geometry, reading) * sum
        };
        2.0 * integral(0.0, PI, 60, around) * theta_s.sin() * theta_s.cos()
    };
    integral(0.0, FRAC_PI_2, 150, ring) / PI
}

#[test]
fn the_quadrature_agrees_with_brute_force() {
    let surfaces = [
        skin(),
        Surface::new(1e-6, 10e-6, 50e-6, 50e-6, 1.4).unwrap(),
        Surface::new(0.1e-6, 2e-6, 50e-6, 50e-6, 1.5).unwrap(),
        Surface::new(5e-6, 5e-6, 50e-6, 50e-6, 1.0).unwrap(),
        Surface::new(20e-9, 1e-6, 50e-6, 50e-6, 2.5).unwrap(),
    ];
    for surface in surfaces {
        for reading in [Normalization::Radiometric, Normalization::Microfacet, Normalization::Paper] {
            for degrees in [0.0_f64, 20.0, 60.0, 85.0] {
                let found = directional_hemispherical(&surface, reading, degrees.to_radians()).diffuse;
                let expected = brute_force(&surface, reading, degrees.to_radians());
                let apart = (found / expected - 1.0).abs();
                assert!(apart < 4e-3, "{surface:?}, {reading:?}, {degrees}°: {found} and {expected}");
            }
        }
    }
}

#[test]
fn skin_returns_half_of_the_light_and_next_to_nothing_at_grazing_incidence() {
    let returned = |reading| *Direct.ask(&ReturnedLightQuery { surface: skin(), reading });
    let radiometric = returned(Normalization::Radiometric);
    assert_near("normal incidence", radiometric.normal, 0.488, 5e-4);
    assert_near("at 85°", radiometric.grazing, 0.034, 5e-4);
    assert_eq!(radiometric.exceeds_one_from_deg, None);
    let microfacet = returned(Normalization::Microfacet);
    assert_near("normal incidence", microfacet.normal, radiometric.normal, 1e-3);
    assert_near("at 85°", microfacet.grazing, 1.384, 3e-3);
    assert!(microfacet.exceeds_one_from_deg.is_some_and(|from| (68.0..75.0).contains(&from)), "{microfacet:?}");
    assert_eq!(returned(Normalization::Lambertian).normal, 1.0);
}

#[test]
fn a_smooth_surface_returns_what_its_boundary_reflects() {
    let smooth = Surface::new(0.0, 10e-6, 50e-6, 50e-6, 1.4).unwrap();
    let normal = |surface: Surface| directional_hemispherical(&surface, Normalization::Radiometric, 0.0);
    assert_near("as in the paper", normal(smooth).coherent, 1.0, 1e-12);
    assert_near("Fresnel", normal(smooth.with_specular(Specular::Fresnel)).coherent, 1.0 / 36.0, 1e-12);
    assert_near("A = XY", normal(smooth.with_area(IlluminatedArea::Xy)).coherent, 0.25, 1e-12);
    assert_eq!(normal(smooth).diffuse, 0.0);
    for nonsense in [FRAC_PI_2 + 0.1, f64::NAN, f64::INFINITY] {
        assert_eq!(directional_hemispherical(&smooth, Normalization::Paper, nonsense).total(), 0.0);
    }
}

#[test]
fn no_surface_returns_more_light_than_falls_on_it() {
    for index in [1.2, 1.4, 1.45, 2.5] {
        for tau in [1e-6, 3e-6, 10e-6, 100e-6] {
            for sigma in [0.0, 0.02e-6, 0.1e-6, 0.3e-6, 1e-6, 2e-6, 5e-6, 20e-6, 100e-6] {
                for degrees in [0.0_f64, 20.0, 40.0, 60.0, 75.0, 85.0, 89.0] {
                    let surface = Surface::new(sigma, tau, 50e-6, 50e-6, index).unwrap();
                    for surface in [surface, surface.with_specular(Specular::Fresnel)] {
                        let radians = degrees.to_radians();
                        let returned = directional_hemispherical(&surface, Normalization::Radiometric, radians).total();
                        // The quadrature's own error.
                        assert!((0.0..=1.004).contains(&returned), "{surface:?} at {degrees}\u{b0}: {returned}");
                    }
                }
            }
        }
    }
}
