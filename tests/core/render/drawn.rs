//! Drawn scenes within drawn tolerances: mirrors, grazing lights, planes seen from the side, where the picture's brightest sample
//! is far darker than what a surface facing the light would be.

use std::sync::Arc;

use chromascope_core::accuracy::RelTolerance;
use chromascope_core::camera::rendering::white_divisors;
use chromascope_core::reflectance::{Normalization, Surface, wavelength_power};
use chromascope_core::render::{
    CameraImage, GeometryImage, Quality, RasterSize, ShadingImage, SpectralWeights, Stop, Visibility,
};
use chromascope_core::scene::lighting::SUN_RADIUS;
use chromascope_core::scene::{Lighting, Viewpoint};
use chromascope_mesh::{Mesh, shapes};
use proptest::prelude::*;
use proptest::test_runner::{RngAlgorithm, TestRng, TestRunner};

use crate::support;

/// Below this all is black by any measure; there, light beyond e^-30 of the peak is omitted.
const BLACK: f64 = 1e-12;

#[derive(Clone, Debug)]
struct Drawn {
    camera: usize,
    reading: usize,
    /// Powers of ten: σ, τ and the patch's half-width in meters, the tolerance.
    powers: [f64; 4],
    index: f64,
    is_plane: bool,
    /// The eye's yaw and pitch, the light's two angles, in radians.
    angles: [f64; 4],
    /// The light's radius in radians.
    radius: usize,
}

fn drawn() -> impl Strategy<Value = Drawn> {
    let powers = [-9.0..-5.0, -6.0..-4.5, -5.3..-3.7, -6.0..-1.0_f64];
    let angles = [-1.4..1.4, -0.5..0.5, -1.3..1.3, -2.6..2.6_f64];
    (0..4_usize, 0..3_usize, powers, 1.1..2.5_f64, any::<bool>(), angles, 0..3_usize).prop_map(
        |(camera, reading, powers, index, is_plane, angles, radius)| Drawn {
            camera,
            reading,
            powers,
            index,
            is_plane,
            angles,
            radius,
        },
    )
}

impl Drawn {
    fn mesh(&self) -> Mesh {
        if self.is_plane { shapes::plane(2) } else { shapes::sphere(2000) }
    }

    fn accuracy(&self) -> RelTolerance {
        RelTolerance::new(10_f64.powf(self.powers[3])).unwrap()
    }

    /// The lit part of the scene; `None` if nothing is lit.
    fn geometry(&self) -> Option<GeometryImage> {
        let [yaw, pitch, up, right] = self.angles;
        let eye = if self.is_plane { [yaw, pitch] } else { [0.0; 2] };
        let eye = Viewpoint::new(eye[0], eye[1], 4.0, 0.6).unwrap();
        let radius = [0.0, SUN_RADIUS, 0.02][self.radius];
        let lighting = Lighting::from_angles(up, right, radius).unwrap();
        let mesh = self.mesh();
        let size = RasterSize::new(16, 16);
        let visibility = Visibility::new(&mesh, eye.eye(mesh.bounds()), size, &Stop::NEVER).unwrap();
        let geometry = GeometryImage::new(&mesh, &visibility, &lighting, None, &Stop::NEVER).unwrap();
        (!geometry.angles().is_empty()).then_some(geometry)
    }

    /// The error relative to the picture's brightest sample; none for a black picture.
    fn error(&self, measures: &[[SpectralWeights; 3]; 4], quality: Quality) -> Option<f64> {
        let geometry = Arc::new(self.geometry()?);
        let reading = [Normalization::Radiometric, Normalization::Microfacet, Normalization::Paper][self.reading];
        let measure = &measures[self.camera][self.reading];
        let [sigma, tau, half, _] = self.powers.map(|power| 10_f64.powf(power));
        let surface = Surface::new(sigma, tau, half, half, self.index).unwrap();
        let shading = |quality| ShadingImage::new(geometry.clone(), surface, reading, quality, &Stop::NEVER).unwrap();
        let image = |shading: &ShadingImage| {
            let plan = Arc::new(shading.plan(measure).unwrap());
            CameraImage::new(shading, measure, plan, &Stop::NEVER)
        };
        let exact = image(&shading(Quality::Reference)).unwrap();
        let found = image(&shading(quality));
        let signals =
            |image: &CameraImage| -> Vec<f64> { image.signals().iter().flatten().map(|&v| v.into()).collect() };
        let (found, exact) = (signals(&found.unwrap()), signals(&exact));
        let peak = exact.iter().fold(0.0_f64, |most, signal| most.max(signal.abs()));
        let apart = found.iter().zip(&exact).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        (peak > BLACK).then(|| apart / peak)
    }
}

#[test]
fn every_scene_keeps_the_tolerance_relative_to_its_brightest_sample() {
    let light = support::light("illuminants/direct_sun_astm_g173.csv");
    let skin = support::patches("materials/skin_vrhel.csv").patches()[0].grid.clone();
    let measures = [support::REFERENCE, support::CANON_10D, support::NIKON_D70, support::DCS200].map(|path| {
        let sensor = support::sensor(path);
        let divisors = white_divisors(&sensor, &light).unwrap();
        [Normalization::Radiometric, Normalization::Microfacet, Normalization::Paper]
            .map(|reading| SpectralWeights::new(&sensor, &light, &skin, divisors, wavelength_power(reading)))
    });
    let mut runner = TestRunner::new_with_rng(support::cases(60), TestRng::deterministic_rng(RngAlgorithm::ChaCha));
    let kept = runner.run(&drawn(), |drawn| {
        // Signals are kept in single precision.
        for (quality, bound) in [
            (Quality::Within(drawn.accuracy()), drawn.accuracy().max_relative_error() + 1.2e-7),
            (Quality::Full, 1e-5),
            (Quality::Fine, 1.3e-7),
        ] {
            if let Some(error) = drawn.error(&measures, quality) {
                prop_assert!(error <= bound, "{:?}: {:.1e} of {:.1e}", quality, error, bound);
            }
        }
        Ok(())
    });
    kept.unwrap_or_else(|failure| panic!("{failure}"));
}
