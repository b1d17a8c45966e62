//! The factor of Eq 12: its parts, energy, exchange of light and viewer, a microfacet model, limits.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use chromascope_core::reflectance::coherent::rho0_squared;
use chromascope_core::reflectance::fresnel::transmittance;
use chromascope_core::reflectance::{
    Geometry, IlluminatedArea, Normalization, Precision, Specular, Surface, beta, coherent_prefactor,
    diffuse_prefactor, diffuse_sum, factor, factors, fresnel, kappa, wavelength_power,
};
use proptest::prelude::*;

use super::{integral, rough};
use crate::support::{assert_near, cases};

/// The share of light from θi that leaves, by the factor's integral over all directions: ∫ f cos θs dω.
fn albedo(surface: &Surface, theta_i: f64, pieces: [u32; 2]) -> f64 {
    let ring = |theta_s: f64| {
        let around = |phi: f64| {
            factor(surface, &Geometry::from_angles(theta_i, theta_s, phi), 550.0, Normalization::Radiometric, 0.0)
        };
        // Symmetric about the plane of incidence.
        2.0 * integral(0.0, PI, pieces[1], around) * theta_s.sin() * theta_s.cos()
    };
    integral(0.0, FRAC_PI_2, pieces[0], ring) / PI
}

#[test]
fn the_papers_coherent_component_is_36_times_too_bright() {
    let paper = Surface::new(0.05e-6, 10e-6, 50e-6, 50e-6, 1.4).unwrap();
    let dielectric = paper.with_specular(Specular::Fresnel);
    for reading in [Normalization::Radiometric, Normalization::Paper, Normalization::Microfacet] {
        let ratio = |theta: f64| {
            let mirrored = Geometry::from_angles(theta, theta, 0.0);
            let at = |surface| factors(surface, &mirrored, 550.0, reading, 0.0);
            let ([diffuse, tinted], [same, untinted]) = (at(&paper), at(&dielectric));
            assert_eq!(diffuse, same, "the diffuse component is left as it is");
            untinted / tinted
        };
        assert_near("normal incidence", ratio(0.0), 1.0 / 36.0, 1e-15);
        for theta in [0.3, 1.0, 1.5_f64] {
            assert_near(
                "Fresnel at the angle of incidence",
                ratio(theta),
                fresnel::reflectance(theta.cos(), 1.4),
                1e-12,
            );
        }
    }
}

#[test]
fn the_area_as_printed_is_a_quarter_of_the_patch() {
    let whole = Surface::new(0.05e-6, 10e-6, 50e-6, 40e-6, 1.4).unwrap();
    let printed = whole.with_area(IlluminatedArea::Xy);
    assert_near("A = 4XY", whole.area_m2(), 8e-9, 1e-22);
    assert_near("A = XY", printed.area_m2(), 2e-9, 1e-22);
    let mirrored = Geometry::from_angles(0.4, 0.4, 0.0);
    let ratio = |reading| {
        let at = |surface| factors(surface, &mirrored, 550.0, reading, 0.0);
        let (printed, whole) = (at(&printed), at(&whole));
        [printed[0] / whole[0], printed[1] / whole[1]]
    };
    for (reading, [diffuse, coherent]) in [
        (Normalization::Paper, [4.0, 1.0]),
        (Normalization::Radiometric, [1.0, 0.25]),
        (Normalization::Microfacet, [1.0, 0.25]),
    ] {
        let [found_diffuse, found_coherent] = ratio(reading);
        assert_near("diffuse", found_diffuse, diffuse, 1e-12);
        assert_near("coherent", found_coherent, coherent, 1e-12);
    }
}

#[test]
fn only_the_diffuse_component_is_reciprocal() {
    let surface = Surface::new(0.05e-6, 10e-6, 50e-6, 20e-6, 1.4).unwrap();
    let (normal, light, viewer) = (glam::DVec3::Z, glam::DVec3::new(-0.5, 0.1, 0.8), glam::DVec3::new(0.49, 0.0, 0.9));
    let (light, viewer) = (light.normalize(), viewer.normalize());
    let by = |light, viewer| {
        let geometry = Geometry::from_directions(light, viewer, normal);
        factors(&surface, &geometry, 550.0, Normalization::Microfacet, 0.0)
    };
    let ([diffuse, coherent], [diffuse_back, coherent_back]) = (by(light, viewer), by(viewer, light));
    assert!((diffuse_back / diffuse - 1.0).abs() < 1e-12 && diffuse > 0.0, "{diffuse} {diffuse_back}");
    // The plane of incidence, along which X lies, turns with the exchange.
    assert!((coherent_back / coherent - 1.0).abs() > 0.01, "{coherent} {coherent_back}");
    assert!(coherent > 0.0);
}

#[test]
fn a_rough_surface_without_a_boundary_returns_what_falls_on_it() {
    // The rest of the light is in slopes that send it below the horizon.
    for ratio in [0.5, 1.0, 2.0, 5.0] {
        let surface = rough(1e-3, ratio * 1e-3, 1.0);
        let expected = 1.0 - (-ratio * ratio / 4.0).exp();
        assert_near(&format!("τ/σ {ratio}"), albedo(&surface, 0.0, [60, 1]), expected, 1e-7);
    }
}

#[test]
fn oblique_light_is_returned_a_little_more_than_whole() {
    // Known of this form factor: 2.8 % at a slope of 2σ/τ = 0.1 and 70°.
    let surface = rough(1e-3, 20e-3, 1.0);
    assert_near("albedo", albedo(&surface, 70.0_f64.to_radians(), [60, 60]), 1.028, 1e-3);
}

#[test]
fn a_smooth_surface_returns_all_light_as_a_mirror() {
    // ∫ π A/λ² ρ0² cos θi/cos θs · cos θs dω/π over a patch of many wavelengths: ∫ sinc² = π along each axis.
    let surface = Surface::new(0.0, 1e-5, 20e-6, 20e-6, 1.4).unwrap();
    let k = TAU / 550e-9;
    let width = 0.3;
    let lobe = |theta_s: f64| {
        let around = |phi: f64| {
            factor(&surface, &Geometry::from_angles(0.0, theta_s, phi), 550.0, Normalization::Radiometric, 0.0)
        };
        4.0 * integral(0.0, FRAC_PI_2, 40, around) * theta_s.sin() * theta_s.cos()
    };
    let inside = integral(0.0, width, 300, lobe) / PI;
    // What sinc² leaves beyond u is 1/(π u) of the whole, on each axis.
    let missing = 2.0 / (PI * k * 20e-6 * width);
    assert!((inside - 1.0).abs() < 2.0 * missing, "{inside}");
}

#[test]
fn a_slightly_rough_surface_loses_to_the_mirror_what_it_scatters() {
    // g = 1 at normal incidence, correlation and patch many wavelengths long: the scattered share is 1 − e^-g.
    let sigma = 550e-9 / (4.0 * PI);
    let surface = Surface::new(sigma, 40e-6, 1e-3, 1e-3, 1.0).unwrap();
    let scattered = |theta_s: f64| {
        let geometry = Geometry::from_angles(0.0, theta_s, 0.0);
        let g = kappa(&surface, &geometry);
        let sum = diffuse_sum(g, beta(&surface, &geometry) * g, Precision::Full);
        2.0 * diffuse_prefactor(&surface, &geometry, Normalization::Radiometric) * sum * theta_s.sin() * theta_s.cos()
    };
    // g itself falls with θs over the lobe, hence no more digits.
    assert_near("scattered", integral(0.0, 0.3, 100, scattered), 1.0 - (-1.0_f64).exp(), 1e-4);
}

#[test]
fn headlights_fade_toward_the_rim() {
    let skin = Surface::new(5e-6, 10e-6, 50e-6, 50e-6, 1.4).unwrap();
    let radiometric = [1.0, 0.93, 0.64, 0.36, 0.09, 0.0];
    let paper = [1.0, 0.88, 0.49, 0.23, 0.045, 0.0];
    for (reading, expected) in [(Normalization::Radiometric, radiometric), (Normalization::Paper, paper)] {
        // Light and viewer in one direction.
        let brightness =
            |theta: f64| theta.cos() * factor(&skin, &Geometry::from_angles(theta, theta, PI), 550.0, reading, 0.0);
        for (degrees, expected) in [0.0_f64, 20.0, 40.0, 50.0, 60.0, 80.0].into_iter().zip(expected) {
            let falloff = brightness(degrees.to_radians()) / brightness(0.0);
            assert_near(&format!("{reading:?} at {degrees}°"), falloff, expected, 0.0075);
        }
    }
}

#[test]
fn grazing_views_stay_finite() {
    let skin = Surface::new(5e-6, 10e-6, 50e-6, 50e-6, 1.4).unwrap();
    let at = |cos_s: f64| {
        let geometry = Geometry::from_angles(0.5, FRAC_PI_2 - cos_s, 0.3);
        diffuse_prefactor(&skin, &geometry, Normalization::Radiometric)
    };
    assert_near("the limit is reached", at(1e-12) / at(1e-9), 1.0, 1e-8);
    assert!(at(1e-12) > 0.0);
}

#[test]
fn a_smooth_surface_has_no_diffuse_part() {
    let smooth = Surface::new(0.0, 10e-6, 50e-6, 50e-6, 1.4).unwrap();
    let geometry = Geometry::from_angles(0.3, 0.301, 0.001);
    assert_eq!([kappa(&smooth, &geometry), beta(&smooth, &geometry)], [0.0; 2]);
    let paper = factor(&smooth, &geometry, 600.0, Normalization::Paper, 0.0);
    assert_near("P", paper, rho0_squared(&geometry, &smooth, TAU / 600e-9, 0.0), 1e-15);
    // The limit is approached as σ².
    let nearly = Surface::new(1e-12, 10e-6, 50e-6, 50e-6, 1.4).unwrap();
    assert_near("σ → 0", factor(&nearly, &geometry, 600.0, Normalization::Paper, 0.0), paper, 1e-9);
}

#[test]
fn rough_surfaces_scatter_all_wavelengths_alike_unless_read_literally() {
    let skin = Surface::new(5e-6, 10e-6, 50e-6, 50e-6, 1.4).unwrap();
    let geometry = Geometry::from_angles(0.3, 0.5, 2.0);
    let ratio = |reading| factor(&skin, &geometry, 700.0, reading, 0.0) / factor(&skin, &geometry, 450.0, reading, 0.0);
    assert_near("radiometric", ratio(Normalization::Radiometric), 1.0, 1e-4);
    assert_near("paper", ratio(Normalization::Paper), (700.0_f64 / 450.0).powi(2), 1e-3);
    assert_eq!(ratio(Normalization::Lambertian), 1.0);
}

#[test]
fn the_default_is_the_radiometric_reading() {
    assert_eq!(Normalization::default(), Normalization::Radiometric);
}

/// Every size alike.
fn between(low: f64, high: f64) -> impl Strategy<Value = f64> {
    (low.ln()..high.ln()).prop_map(f64::exp)
}

proptest! {
    #![proptest_config(cases(4000))]

    #[test]
    fn the_pieces_make_the_whole(
        sigma in between(1e-9, 1e-4), tau in between(1e-7, 1e-3), half in between(1e-7, 1e-3),
        angles in (0.0..1.55_f64, 0.0..1.55_f64, -3.2..3.2_f64), nm in 380.0..780.0_f64, radius in 0.0..0.01_f64,
    ) {
        let surface = Surface::new(sigma, tau, half, 0.7 * half + 3e-8, 1.4).unwrap();
        let geometry = Geometry::from_angles(angles.0, angles.1, angles.2);
        let ratio = 550.0 / nm;
        let g = kappa(&surface, &geometry) * ratio * ratio;
        let sum = diffuse_sum(g, beta(&surface, &geometry) * g, Precision::Full);
        let pattern = rho0_squared(&geometry, &surface, TAU / (nm * 1e-9), radius) * (-g).exp();
        for reading in [Normalization::Radiometric, Normalization::Paper, Normalization::Microfacet] {
            let expected = ratio.powi(wavelength_power(reading))
                * (diffuse_prefactor(&surface, &geometry, reading) * sum
                    + coherent_prefactor(&surface, &geometry, reading) * pattern);
            let value = factor(&surface, &geometry, nm, reading, radius);
            // β g and the b of the definition round apart, e^-b/g amplifies that.
            prop_assert!((value - expected).abs() <= 1e-11 * expected + 1e-290, "{:?}: {} {}", reading, value, expected);
        }
    }

    #[test]
    fn light_and_viewer_exchange_as_each_reading_says(
        sigma in between(1e-8, 1e-4), slope in 0.01..1.0_f64, index in 1.0..3.0_f64,
        theta_i in 0.0..1.5_f64, theta_s in 0.0..1.5_f64, phi in 0.1..3.1_f64,
    ) {
        let surface = rough(sigma, 2.0 * sigma / slope, index);
        let (there, back) =
            (Geometry::from_angles(theta_i, theta_s, phi), Geometry::from_angles(theta_s, theta_i, phi));
        for (reading, expected) in [
            (Normalization::Radiometric, (there.cos_i / back.cos_i).powi(2)),
            (Normalization::Microfacet, 1.0),
            (Normalization::Paper, there.cos_i / back.cos_i),
        ] {
            let ratio = diffuse_prefactor(&surface, &there, reading) / diffuse_prefactor(&surface, &back, reading);
            prop_assert!((ratio / expected - 1.0).abs() < 1e-12, "{:?}: {} {}", reading, ratio, expected);
        }
        prop_assert_eq!(kappa(&surface, &there), kappa(&surface, &back));
        let (a, b) = (beta(&surface, &there), beta(&surface, &back));
        prop_assert!((a - b).abs() <= 1e-12 * a, "{} {}", a, b);
        let coherent = [&there, &back].map(|g| coherent_prefactor(&surface, g, Normalization::Microfacet));
        prop_assert_eq!(coherent[0], coherent[1]);
    }

    /// Beckmann's distribution of slopes, no shadowing, two transmittances in place of the facet's reflectance.
    #[test]
    fn the_microfacet_reading_is_beckmanns(
        roughness in 0.05..1.0_f64, index in 1.0..3.0_f64,
        theta_i in 0.0..1.5_f64, theta_s in 0.0..1.5_f64, phi in -3.1..3.1_f64,
    ) {
        let sigma = 1e-2;
        let surface = rough(sigma, 2.0 * sigma / roughness, index);
        let geometry = Geometry::from_angles(theta_i, theta_s, phi);
        let (cos_i, cos_s) = (theta_i.cos(), theta_s.cos());
        let half = glam::DVec3::new(
            theta_s.sin() * phi.cos() - theta_i.sin(), theta_s.sin() * phi.sin(), cos_i + cos_s,
        ).normalize();
        let tan2 = (1.0 - half.z * half.z) / (half.z * half.z);
        let alpha2 = roughness * roughness;
        let distribution = (-tan2 / alpha2).exp() / (PI * alpha2 * half.z.powi(4));
        let passed = transmittance(cos_i, index) * transmittance(cos_s, index);
        let expected = distribution * passed / (4.0 * cos_i * cos_s);
        let value = factor(&surface, &geometry, 550.0, Normalization::Microfacet, 0.0) / PI;
        // Eq 4 but for the first correction, (1 − 2β + β²/2)/g.
        let correction = (1.0 + beta(&surface, &geometry).powi(2)) / kappa(&surface, &geometry);
        prop_assert!((value / expected - 1.0).abs() <= correction + 1e-9 || expected < 1e-280, "{} {}", value, expected);
    }
}
