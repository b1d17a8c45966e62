//! Spectral images through cameras against patches.

use chromascope_core::camera::WhiteBalanceTarget;
use chromascope_core::colorimetry::Metric;
use chromascope_core::correction::Correction;
use chromascope_core::query::{Ask as _, ColorTransformSpec, Direct, PatchColorsQuery, RenderingQuery, Shared};
use chromascope_core::render::develop::{develop_signals, signal_differences};
use chromascope_core::render::{
    BandWeights, ColorimetricScale, Development, ImageSensor, SampleQuantity, SpectralImageError, SpectralImageSignals,
    Stop,
};
use chromascope_core::spectral::{GridSpectrum, Sensor};
use glam::DVec3;

use crate::support::{CIE_1931, NIKON_D70, assert_near, chart, light, sensor, training};

const D55: &str = "illuminants/d55.csv";

fn rendering(path: &str) -> RenderingQuery {
    RenderingQuery {
        sensor: Shared::new(sensor(path)),
        light: Shared::new(light(D55)),
        white: WhiteBalanceTarget::UNITY,
        transform: ColorTransformSpec::Observer {
            reference: Shared::new(sensor(CIE_1931)),
            training: Shared::new(training()),
            correction: Correction::default(),
        },
    }
}

#[test]
fn a_constant_image_equals_patches() {
    let queries = [rendering(CIE_1931), rendering(NIKON_D70)];
    let renderings = queries.each_ref().map(|query| (*Direct.ask(query)).clone().unwrap());
    let chart = chart();
    let wavelengths = chart.patches()[0].measured.wavelengths_nm().to_vec();
    let sensors =
        [0, 1].map(|i: usize| ImageSensor { sensor: &queries[i].sensor, divisors: renderings[i].white_integrals });
    let weights = BandWeights::new(&wavelengths, SampleQuantity::Reflectance, &queries[0].light, &sensors).unwrap();
    // One row a patch, constant along it.
    let mut image = SpectralImageSignals::new(weights, 5, chart.patches().len()).unwrap();
    for patch in chart.patches() {
        let pixel: Vec<f32> = patch.measured.values().iter().map(|&v| v as f32).collect();
        image.push(&pixel.repeat(5));
    }
    let (placed, signals) = image.finish();
    assert_eq!(placed.samples().len(), 5 * 24);
    let patches = Shared::new(chart);
    let colors = queries.each_ref().map(|rendering| {
        let query = PatchColorsQuery { rendering: rendering.clone(), patches: patches.clone() };
        (*Direct.ask(&query)).clone().unwrap()
    });
    let scales = renderings.each_ref().map(|rendering| ColorimetricScale::new(rendering, 1.0));
    for (scale, (signals, colors)) in scales.iter().zip(signals.iter().zip(&colors)) {
        for (index, signal) in signals.iter().enumerate() {
            let (pixel, patch) = (scale.color(*signal), &colors[index / 5]);
            // Single precision: 2⁻²⁴ a sample and a weight.
            assert_near("X", pixel.xyz.x, patch.xyz.x, 2e-6);
            assert_near("Y", pixel.xyz.y, patch.xyz.y, 2e-6);
            assert_near("Z", pixel.xyz.z, patch.xyz.z, 2e-6);
        }
    }
    let both = [&signals[1][..], &signals[0][..]];
    let (map, _) = signal_differences(Metric::DELTA_E_2000, both, [&scales[1], &scales[0]], 1, &Stop::NEVER).unwrap();
    for (index, difference) in map.iter().enumerate() {
        let expected = Metric::DELTA_E_2000.between(&colors[0][index / 5], &colors[1][index / 5]).unwrap();
        assert_near("difference", f64::from(*difference), expected, 1e-3);
    }
    // The pixels on screen are the patches' colors too.
    let picture =
        develop_signals(&placed, &signals[1], &Development::new(&renderings[1], 1.0, None), &Stop::NEVER).unwrap();
    for (index, pixel) in picture.rgba.chunks_exact(4).enumerate() {
        let srgb = colors[1][index / 5].srgb.bytes.map(i32::from);
        for c in 0..3 {
            assert!((i32::from(pixel[c]) - srgb[c]).abs() <= 1, "{pixel:?} is not {srgb:?}");
        }
    }
}

fn one(sensor: &Sensor) -> [ImageSensor<'_>; 1] {
    [ImageSensor { sensor, divisors: DVec3::ONE }]
}

fn signal(weights: BandWeights, pixel: &[f32]) -> [f32; 3] {
    let mut image = SpectralImageSignals::new(weights, 1, 1).unwrap();
    image.push(pixel);
    image.finish().1[0][0]
}

#[test]
fn radiances_are_integrated_as_they_are_whatever_the_light() {
    let camera = sensor(NIKON_D70);
    let nm = [400.0, 431.0, 505.5, 600.0, 700.0];
    let pixel = [1.0, 3.0, 2.0, 5.0, 4.0];
    let weights = BandWeights::new(&nm, SampleQuantity::Radiance, &light(D55), &one(&camera)).unwrap();
    let found = signal(weights, &pixel.map(|v| v as f32));
    let spectrum = chromascope_core::spectral::SpectralDistribution::new(nm.to_vec(), pixel.to_vec()).unwrap();
    let grid = GridSpectrum::resample(&spectrum, chromascope_core::spectral::Quantity::Light);
    let expected = camera.integrate(grid.values());
    for c in 0..3 {
        assert_near("signal", f64::from(found[c]), expected[c], 1e-6 * expected[c]);
    }
}

#[test]
fn ends_are_held_and_pixels_without_values_left_out() {
    let camera = sensor(NIKON_D70);
    let flat = GridSpectrum::constant(1.0);
    for quantity in [SampleQuantity::Reflectance, SampleQuantity::Radiance] {
        // A constant is a constant over the whole grid, whatever the bands cover.
        for nm in [vec![550.0], vec![500.0, 600.0], (0..8).map(|i| 450.0 + 10.0 * f64::from(i)).collect()] {
            let weights = BandWeights::new(&nm, quantity, &flat, &one(&camera)).unwrap();
            let found = signal(weights, &vec![0.5; nm.len()]);
            for (found, integral) in found.iter().zip(camera.integrals()) {
                assert_near("constant", f64::from(*found), 0.5 * integral, 5e-7 * integral);
            }
        }
    }
    let weights = BandWeights::new(&[500.0, 600.0], SampleQuantity::Radiance, &flat, &one(&camera)).unwrap();
    let mut image = SpectralImageSignals::new(weights.clone(), 2, 2).unwrap();
    image.push(&[1.0, 1.0, f32::NAN, 1.0]);
    image.push(&[1.0, f32::INFINITY, 1.0, 2.0, 9.0, 9.0]);
    let (placed, signals) = image.finish();
    assert_eq!((placed.samples(), signals[0].len()), (&[0, 3][..], 2));

    let outside = BandWeights::new(&[900.0, 1000.0], SampleQuantity::Radiance, &flat, &one(&camera));
    assert_eq!(outside.err(), Some(SpectralImageError::NotVisible { first: 900.0, last: 1000.0 }));
    let huge = SpectralImageSignals::new(weights, 1 << 40, 1);
    assert_eq!(huge.err(), Some(SpectralImageError::Size { width: 1 << 40, height: 1 }));
}
