//! Smooth surfaces, whose light is mostly coherent: their error and their work, from 1 µm to 1 mm, under the sun and a point light.

use chromascope_core::accuracy::RelTolerance;
use chromascope_core::camera::rendering::white_divisors;
use chromascope_core::query::render::MeshQuery;
use chromascope_core::query::{Ask, Direct};
use chromascope_core::reflectance::Surface;
use chromascope_core::render::shading::CoherentSample;
use chromascope_core::render::{CoherentIntegral, Quality, RasterSize, SpectralWeights};
use chromascope_core::scene::lighting::SUN_RADIUS;
use chromascope_core::spectral::GridSpectrum;

use super::fixture::{Counting, FrameCase};
use super::images::apart;
use crate::support;

const SIGMAS_M: [f64; 5] = [0.3e-6, 0.1e-6, 0.05e-6, 0.01e-6, 0.0];
const HALF_WIDTHS_M: [f64; 4] = [1e-6, 10e-6, 50e-6, 1e-3];
const RADII: [f64; 2] = [0.0, SUN_RADIUS];

/// Every smooth surface under every light.
fn each_smooth_surface(start: &FrameCase, check: impl Fn(&FrameCase, &str)) {
    for sigma_m in SIGMAS_M {
        for half_width_m in HALF_WIDTHS_M {
            for angular_radius in RADII {
                let name = format!("σ {sigma_m}, half-width {half_width_m}, radius {angular_radius}");
                check(&FrameCase { sigma_m, half_width_m, angular_radius, ..start.clone() }, &name);
            }
        }
    }
}

#[test]
fn every_smooth_surface_keeps_its_error_against_401_wavelengths() {
    let mut start = FrameCase { size: RasterSize::new(12, 12), ..FrameCase::new() };
    start.sources.truncate(2);
    // Tables do not depend on the surface: they are made once.
    let ask = Counting::default();
    let within = |error| Quality::Within(RelTolerance::new(error).unwrap());
    each_smooth_surface(&start, |studio, name| {
        let exact = FrameCase { quality: Quality::Reference, ..studio.clone() }.take(&ask);
        // Signals are kept in single precision.
        for (quality, bound) in
            [(Quality::Full, 1e-5), (Quality::Preview, 1e-3), (within(1e-3), 1e-3), (within(1e-6), 1.2e-6)]
        {
            let error = apart(&FrameCase { quality, ..studio.clone() }.take(&ask), &exact);
            assert!(error <= bound, "{name}, {quality:?}: {error:.1e}");
        }
    });
}

#[test]
fn views_places_of_the_light_and_roughnesses_share_their_plans() {
    // Large enough that a search pays.
    let mut start = FrameCase {
        size: RasterSize::new(256, 256),
        mesh: MeshQuery::Head(9_000),
        sigma_m: 0.3e-6,
        ..FrameCase::new()
    };
    start.sources.truncate(1);
    let ask = Counting::default();
    let plans = |services: &[FrameCase]| -> usize {
        for service in services {
            drop(service.take(&ask));
        }
        ask.made().get("plan").copied().unwrap_or_default()
    };
    assert_eq!(plans(&[start.clone()]), 1, "a search pays");
    let turned: Vec<FrameCase> =
        (-8..=8).map(|step| FrameCase { yaw: 0.3 * f64::from(step), ..start.clone() }).collect();
    let lit: Vec<FrameCase> =
        (-6..=6).map(|step| FrameCase { light_right: 12.0 * f64::from(step), ..start.clone() }).collect();
    let rough: Vec<FrameCase> =
        (0..8).map(|step| FrameCase { sigma_m: (0.1 + 0.1 * f64::from(step)) * 1e-6, ..start.clone() }).collect();
    assert_eq!([plans(&turned), plans(&lit), plans(&rough)], [0, 0, 0]);
}

/// Integrals along paths from a nanometer to a millimeter, of points and of disks, over a whole band and over three single wavelengths,
/// whose weights are off by no less than the interpolation between the nodes.
#[test]
fn lobes_keep_their_tolerance_along_all_paths() {
    const HALF_WIDTH_M: f64 = 1e-5;
    let surface = Surface::new(0.1e-6, 1e-6, HALF_WIDTH_M, HALF_WIDTH_M, 1.5).unwrap();
    let (sensor, light) = (support::sensor(support::NIKON_D70), support::light("illuminants/d65.csv"));
    let divisors = white_divisors(&sensor, &light).unwrap();
    let lines = GridSpectrum::from_fn(|nm| if [437.0, 541.0, 683.0].contains(&nm) { 1.0 } else { 1e-12 });
    let mut nodes = [0; 3];
    for reflectance in [GridSpectrum::constant(1.0), lines] {
        let measure = SpectralWeights::new(&sensor, &light, &reflectance, divisors, 2);
        let height = (0..3).map(|c: usize| measure.dense().iter().map(|n| n.weights[c].abs()).sum::<f64>());
        let height = height.fold(0.0, f64::max);
        for spread in [0.0, 1e-15, 4e-9, 0.05e-6, 0.23e-6, 4.6e-6] {
            let integral = |error| CoherentIntegral::new(&measure, &surface, spread / HALF_WIDTH_M, error);
            for step in 0..140 {
                let path = 1e-9 * 1.1_f64.powi(step) / HALF_WIDTH_M;
                for (kappa, other) in [(0.0, 0.0), (0.9, 0.31), (7.0, 1.0)] {
                    let coherent = CoherentSample { index: 0, front: 1.0, kappa, v: [path, other * path] };
                    let exact = integral(0.0).at(&coherent);
                    for error in [1e-2, 1e-4, 1e-6, 1e-9] {
                        let found = integral(error).at(&coherent);
                        let off = found.iter().zip(exact).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max) / height;
                        assert!(off <= error, "{coherent:?}, spread {spread}: {off:.1e}, not {error:e}");
                        nodes[integral(error).evaluations(&coherent).div_ceil(208).min(2)] += 1;
                    }
                }
            }
        }
    }
    assert!(nodes.into_iter().all(|count| count > 300), "none, rules and the grid: {nodes:?}");
}

#[test]
fn no_smooth_surface_takes_many_wavelengths() {
    // Of a head, few samples see the sun's image: next to the brightest of these, few coherent terms count.
    let start = FrameCase { size: RasterSize::new(64, 64), mesh: MeshQuery::Head(9_000), ..FrameCase::new() };
    each_smooth_surface(&start, |studio, name| {
        let question = studio.question();
        let shading = Direct.ask(&question.shading);
        let shading = (*shading).as_ref().unwrap();
        for source in &question.sources {
            let measure = Direct.ask(&question.image(source).measure);
            let integral = CoherentIntegral::in_picture(shading, (*measure).as_ref().unwrap());
            let evaluations: usize =
                shading.coherent_samples().iter().map(|coherent| integral.evaluations(coherent)).sum();
            let mean = evaluations as f64 / shading.shades().len() as f64;
            // Nothing averages the fringes of a point light: it takes up to the largest rule's 208 nodes, never the grid's 401.
            let limit = if studio.angular_radius > 0.0 { 60.0 } else { 208.0 };
            assert!(mean <= limit, "{name}: {mean:.1} wavelengths for each lit sample");
        }
    });
}
