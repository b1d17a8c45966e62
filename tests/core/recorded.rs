//! Recorded raw RGB against sensitivities: synthetic recordings with known answers.

use chromascope_core::camera::recorded::{
    Exclusion, Freedom, LinkKind, RecordedError, RecordedFit, RecordedPatch, Signal, rank_ranges,
};
use chromascope_core::query::{Ask as _, Direct, RecordedFitQuery, Shared};
use chromascope_core::spectral::{GridSpectrum, Sensor};
use proptest::prelude::*;

use crate::support::{NIKON_D70, assert_near, cases, chart, light, sensor, sensors};

const GAINS: [f64; 3] = [2.1, 1.0, 1.6];
const D55: &str = "illuminants/d55.csv";

/// The chart under a light as a camera would record it: exact integrals times gain, brightness and `exp(noise)`.
fn recording(
    sensor: &Sensor,
    light: &GridSpectrum,
    brightness: impl Fn(usize) -> f64,
    noise: impl Fn(usize, usize) -> f64,
) -> Vec<RecordedPatch> {
    let patches = chart();
    let patch = |(p, patch): (usize, &chromascope_core::patch_set::Patch)| {
        let product = |nm: f64| {
            let index = (nm - 380.0).round() as usize;
            patch.grid.values()[index] * light.values()[index]
        };
        let radiance = GridSpectrum::from_fn(product);
        let raw = sensor.integrate(radiance.values());
        let signal = |c: usize| Signal::new(GAINS[c] * brightness(p) * raw[c] * noise(p, c).exp(), f64::INFINITY);
        RecordedPatch { name: patch.name.clone(), radiance, rgb: [0, 1, 2].map(signal) }
    };
    patches.patches().iter().enumerate().map(patch).collect()
}

fn fit(patches: &[RecordedPatch], sensor: &Sensor) -> RecordedFit {
    RecordedFit::new(patches, sensor, Freedom::default()).unwrap()
}

/// Uneven light over the chart, with a geometric mean of 1.
fn uneven(patch: usize) -> f64 {
    (0.02 * (patch as f64 - 11.5)).exp()
}

#[test]
fn the_camera_that_recorded_comes_first_without_residual() {
    let patches = Shared::new(recording(&sensor(NIKON_D70), &light(D55), uneven, |_, _| 0.0));
    let mut ranked: Vec<(f64, String)> = sensors("cameras")
        .into_iter()
        .map(|(name, sensor)| {
            let query = RecordedFitQuery {
                recorded: patches.clone(),
                sensor: Shared::new(sensor),
                freedom: Freedom::default(),
            };
            (Direct.ask(&query).as_ref().as_ref().unwrap().rms(), name)
        })
        .collect();
    ranked.sort_by(|a, b| a.0.total_cmp(&b.0));
    assert_eq!(ranked[0].1, NIKON_D70);
    assert!(ranked[0].0 < 1e-13, "{}", ranked[0].0);
    // The next camera differs by far more than rounding.
    assert!(ranked[1].0 > 1e-3, "{ranked:?}");
}

#[test]
fn gains_and_brightness_come_back() {
    let camera = sensor(NIKON_D70);
    let found = fit(&recording(&camera, &light(D55), uneven, |_, _| 0.0), &camera);
    for (gain, expected) in found.gains.iter().zip(GAINS) {
        assert_near("gain", gain.unwrap(), expected, 1e-13);
    }
    for (p, brightness) in found.brightness.iter().enumerate() {
        assert_near("brightness", brightness.unwrap(), uneven(p), 1e-13);
    }
    assert_eq!((found.values, found.parameters), (72, 26));
}

/// Noise that no gain and no brightness can take up: rows and columns sum to zero.
fn orthogonal(patch: usize, channel: usize) -> f64 {
    let row = if patch.is_multiple_of(2) { 1.0 } else { -1.0 };
    0.02 * row * [1.0, -2.0, 1.0][channel]
}

#[test]
fn noise_gives_its_own_rms() {
    let camera = sensor(NIKON_D70);
    let found = fit(&recording(&camera, &light(D55), uneven, orthogonal), &camera);
    // (1 + 4 + 1) / 3 = 2 in squares.
    assert_near("rms", found.rms(), 0.02 * 2_f64.sqrt(), 1e-13);
    assert_near("deviation", found.deviation(), 0.02 * (2.0 * 72.0_f64 / 46.0).sqrt(), 1e-13);
    assert_near("green", found.channel_rms()[1].unwrap(), 0.04, 1e-13);
    assert_near("a patch", found.patch_rms(3).unwrap(), 0.02 * 2_f64.sqrt(), 1e-13);
    assert_near("a residual", found.residuals[2][1].unwrap(), -0.04, 1e-13);
}

#[test]
fn held_parameters_leave_their_differences_as_residuals() {
    let camera = sensor(NIKON_D70);
    let patches = recording(&camera, &light(D55), uneven, |_, _| 0.0);
    let held = |gains, brightness| RecordedFit::new(&patches, &camera, Freedom { gains, brightness }).unwrap();
    // Standard deviations of ln g and of ln b, each about its mean.
    let spread = |logs: &[f64]| {
        let mean = logs.iter().sum::<f64>() / logs.len() as f64;
        (logs.iter().map(|v| (v - mean).powi(2)).sum::<f64>() / logs.len() as f64).sqrt()
    };
    let of_gains = spread(&GAINS.map(f64::ln));
    let of_brightness = spread(&(0..24).map(|p| uneven(p).ln()).collect::<Vec<_>>());
    assert_near("gains held", held(false, true).rms(), of_gains, 1e-13);
    assert_near("brightness held", held(true, false).rms(), of_brightness, 1e-13);
    assert_near("both held", held(false, false).rms(), of_gains.hypot(of_brightness), 1e-13);
    assert_eq!([held(false, true), held(true, false), held(false, false)].map(|fit| fit.parameters), [24, 3, 1]);
    assert!(held(true, false).brightness.iter().all(|b| *b == Some(1.0)));
}

#[test]
fn clipped_zero_and_missing_values_are_left_out_with_their_reason() {
    let camera = sensor(NIKON_D70);
    let mut patches = recording(&camera, &light(D55), uneven, |_, _| 0.0);
    patches[18].rgb = [4095.0; 3].map(|value| Signal::new(value, 4095.0));
    patches[3].rgb[2] = Signal::new(0.0, 4095.0);
    patches[5].rgb[0] = Signal::new(f64::NAN, 4095.0);
    assert_eq!(Signal::new(f64::NEG_INFINITY, 4095.0).value(), Err(Exclusion::NotPositive));
    assert_eq!(Signal::new(f64::INFINITY, f64::INFINITY).value(), Err(Exclusion::Clipped));
    let found = fit(&patches, &camera);
    assert_eq!(found.values, 67);
    assert_eq!(found.parameters, 25);
    assert!(found.rms() < 1e-13);
    assert_eq!(found.residuals[18], [Err(Exclusion::Clipped); 3]);
    assert_eq!((found.residuals[3][2], found.residuals[5][0]), (Err(Exclusion::NotPositive), Err(Exclusion::Missing)));
    assert_eq!((found.brightness[18], found.patch_rms(18)), (None, None));
    for (gain, expected) in found.gains.iter().zip(GAINS) {
        assert_near("ratio of gains", gain.unwrap() / found.gains[0].unwrap(), expected / GAINS[0], 1e-12);
    }
}

#[test]
fn too_few_values_are_refused() {
    let camera = sensor(NIKON_D70);
    let patches = &recording(&camera, &light(D55), uneven, |_, _| 0.0)[..1];
    let refused = RecordedFit::new(patches, &camera, Freedom::default());
    assert_eq!(refused, Err(RecordedError::TooFew { values: 3, parameters: 3 }));
    assert_eq!(
        RecordedFit::new(&[], &camera, Freedom::default()),
        Err(RecordedError::TooFew { values: 0, parameters: 0 })
    );
}

#[test]
fn a_tilted_light_a_shifted_channel_and_a_wrong_patch_are_named() {
    let camera = sensor(NIKON_D70);
    let d55 = light(D55);
    let assumed = recording(&camera, &d55, |_| 1.0, |_, _| 0.0);
    let record = |recorded: Vec<RecordedPatch>| {
        let mixed: Vec<RecordedPatch> = assumed
            .iter()
            .zip(recorded)
            .map(|(patch, recorded)| RecordedPatch { rgb: recorded.rgb, ..patch.clone() })
            .collect();
        fit(&mixed, &camera).links[0]
    };
    let tilted = GridSpectrum::from_fn(|nm| d55.values()[(nm - 380.0) as usize] * (1.0 + 0.02 * (nm - 580.0) / 100.0));
    let light = record(recording(&camera, &tilted, |_| 1.0, |_, _| 0.0));
    assert_eq!(light.kind, LinkKind::Light);
    assert_near("tilt", light.amount, 0.02, 5e-4);
    assert!(light.share > 0.999, "{light:?}");

    // The green channel's table 2 nm too far to the blue is a recording of a spectrum seen 2 nm off.
    let mut shifted = assumed.clone();
    for patch in &mut shifted {
        let values = *patch.radiance.values();
        let moved = GridSpectrum::from_fn(|nm| values[((nm + 2.0).min(780.0) - 380.0) as usize]);
        patch.rgb[1] = Signal::new(GAINS[1] * camera.integrate(moved.values())[1], f64::INFINITY);
    }
    let channel = record(shifted);
    assert_eq!(channel.kind, LinkKind::Channel(1));
    assert_near("shift", channel.amount, 2.0, 0.1);
    assert!(channel.share > 0.99, "{channel:?}");

    let wrong = record(recording(&camera, &d55, |_| 1.0, |p, c| if p == 7 && c == 0 { 0.3 } else { 0.0 }));
    assert_eq!(wrong.kind, LinkKind::Patch(7));
}

proptest! {
    #![proptest_config(cases(40))]

    /// Scaling a channel or a patch changes no residual where both are free, whatever is missing.
    #[test]
    fn scale_of_channels_and_patches_does_not_matter(
        noise in prop::collection::vec(prop::array::uniform3(-0.1..0.1), 24),
        missing in prop::collection::vec(any::<prop::sample::Index>(), 0..40),
        gain in -3.0..3.0, bright in -3.0..3.0,
    ) {
        let camera = sensor(NIKON_D70);
        let mut patches = recording(&camera, &light(D55), |_| 1.0, |p, c| noise[p][c]);
        for at in missing {
            let at = at.index(72);
            patches[at / 3].rgb[at % 3] = Signal::new(f64::NAN, f64::INFINITY);
        }
        let scaled: Vec<RecordedPatch> = patches.iter().enumerate().map(|(p, patch)| {
            let mut patch = patch.clone();
            for c in 0..3 {
                let factor: f64 = if c == 2 { gain } else { 0.0 } + if p == 4 { bright } else { 0.0 };
                if let Ok(value) = patch.rgb[c].value() {
                    patch.rgb[c] = Signal::new(value * factor.exp(), f64::INFINITY);
                }
            }
            patch
        }).collect();
        match [&patches, &scaled].map(|p| RecordedFit::new(p, &camera, Freedom::default())) {
            [Ok(a), Ok(b)] => {
                prop_assert_eq!(a.parameters, b.parameters);
                for (a, b) in a.residuals.iter().flatten().zip(b.residuals.iter().flatten()) {
                    prop_assert!((a.unwrap_or(0.0) - b.unwrap_or(0.0)).abs() < 1e-11);
                }
                // Least squares: what is left is orthogonal to every channel.
                for c in 0..3 {
                    let sum: f64 = a.residuals.iter().filter_map(|row| row[c].ok()).sum();
                    prop_assert!(sum.abs() < 1e-11, "{}", sum);
                }
            }
            [a, b] => prop_assert_eq!(a, b),
        }
    }
}

/// Fits of a few cameras to the chart under D55 through the D70, with noise.
fn noisy_fits() -> (Vec<String>, Vec<RecordedFit>) {
    let noise = |p: usize, c: usize| 0.01 * (((p * 31 + c * 17) % 23) as f64 / 11.0 - 1.0);
    let patches = recording(&sensor(NIKON_D70), &light(D55), uneven, noise);
    sensors("cameras").into_iter().map(|(name, sensor)| (name, fit(&patches, &sensor))).unzip()
}

#[test]
fn rank_ranges_hold_the_rank_and_are_the_same_on_every_run() {
    let (names, fits) = noisy_fits();
    let all: Vec<&RecordedFit> = fits.iter().collect();
    let ranges = rank_ranges(&all, Freedom::default());
    let mut order: Vec<usize> = (0..all.len()).collect();
    order.sort_by(|&a, &b| all[a].rms().total_cmp(&all[b].rms()));
    for (rank, &at) in order.iter().enumerate() {
        let [first, last] = ranges[at].range;
        assert!(first <= rank + 1 && rank < last && last <= all.len(), "{}: {:?}", names[at], ranges[at]);
    }
    assert_eq!(names[order[0]], NIKON_D70);
    let shares: f64 = ranges.iter().map(|range| range.first).sum();
    assert_near("one is first in each resample", shares, 1.0, 1e-9);
    assert_eq!(ranges, rank_ranges(&all, Freedom::default()));
    // The patches are drawn before any camera is looked at, so that the order of the cameras does not matter.
    let reversed: Vec<&RecordedFit> = all.iter().rev().copied().collect();
    let mut again = rank_ranges(&reversed, Freedom::default());
    again.reverse();
    assert_eq!(ranges, again);
}

#[test]
fn equal_fits_share_their_rank_and_a_sure_one_has_no_range() {
    let camera = sensor(NIKON_D70);
    let good = fit(&recording(&camera, &light(D55), uneven, orthogonal), &camera);
    let bad = fit(&recording(&camera, &light(D55), uneven, |p, c| 3.0 * orthogonal(p, c)), &camera);
    let ranges = rank_ranges(&[&good, &bad, &good], Freedom::default());
    assert_eq!(ranges.iter().map(|range| range.range).collect::<Vec<_>>(), [[1, 1], [3, 3], [1, 1]]);
    assert_eq!(ranges.iter().map(|range| range.first).collect::<Vec<_>>(), [1.0, 0.0, 1.0]);
}

#[test]
fn half_of_the_patches_for_each_camera_leaves_the_rank_open() {
    // The first camera is right in even patches and the second in odd ones, by the same amounts: either may be first.
    let camera = sensor(NIKON_D70);
    let half = |parity: usize| {
        let noise = |p: usize, c: usize| if p % 2 == parity { orthogonal(p / 2, c) } else { 0.0 };
        fit(&recording(&camera, &light(D55), uneven, noise), &camera)
    };
    let (even, odd) = (half(0), half(1));
    let ranges = rank_ranges(&[&even, &odd], Freedom::default());
    for range in ranges {
        assert_eq!(range.range, [1, 2]);
        // Of 24 patches with replacement as many are even as odd in 16 %.
        assert!((0.42..0.66).contains(&range.first), "{range:?}");
    }
}

#[test]
fn one_patch_ranks_nothing() {
    let camera = sensor(NIKON_D70);
    let patches = &recording(&camera, &light(D55), uneven, |_, _| 0.0)[..1];
    let held = Freedom { gains: false, brightness: false };
    let one = RecordedFit::new(patches, &camera, held).unwrap();
    assert_eq!(rank_ranges(&[&one, &one, &one], held)[0].range, [1, 3]);
    assert!(rank_ranges(&[], held).is_empty());
}
