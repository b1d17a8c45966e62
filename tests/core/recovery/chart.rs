//! Charts: hold-outs over the library, and the posterior by a second method.

use chromascope_core::camera::recorded::{RecordedPatch, Signal};
use chromascope_core::math::random::SplitMix64;
use chromascope_core::recovery::{ChartRecovery, Library, RecoveryError, Shot, left_out};
use chromascope_core::spectral::Sensor;
use rayon::prelude::*;

use super::support::{A, Conditions, D65, EVEN, cameras, library_without, maker, model, normal, shot};
use crate::support::{CIE_1931, light, patches, sensor};

/// Errors of one recovered camera, over 400–700 nm.
struct Score {
    name: String,
    /// Root mean square of each channel's error relative to its own, at the scale that fits best.
    errors: [f64; 3],
    /// The same of the library's plain mean.
    mean: [f64; 3],
    /// Share of the samples within two standard deviations.
    inside: f64,
    noise_ratio: f64,
    unlikeness: f64,
}

const FIRST: usize = 2;
const LAST: usize = 32;

fn error(own: &[f64], truth: &[f64]) -> (f64, f64) {
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    let scale = dot(own, truth) / dot(truth, truth);
    let squares: f64 = own.iter().zip(truth).map(|(a, b)| (a - scale * b).powi(2)).sum();
    ((squares / (scale * scale * dot(truth, truth))).sqrt(), scale)
}

fn score(name: &str, sensor: &Sensor, library: &Library, recovery: &ChartRecovery) -> Score {
    let truth = |c: usize| -> Vec<f64> { (FIRST..=LAST).map(|i| sensor.at_index(10 * i)[c]).collect() };
    let mean = library.prior(&[]).mean;
    let standard = recovery.curves.standard();
    let (mut errors, mut of_mean, mut inside) = ([0.0; 3], [0.0; 3], 0);
    for c in 0..3 {
        let (own, truth) = (&recovery.curves.values[c][FIRST..=LAST], truth(c));
        let (relative, scale) = error(own, &truth);
        errors[c] = relative;
        of_mean[c] = error(&mean[c * 41 + FIRST..=c * 41 + LAST], &truth).0;
        let pairs = own.iter().zip(&truth).zip(&standard[c][FIRST..=LAST]);
        inside += pairs.filter(|((own, truth), sd)| (*own - scale * *truth).abs() <= 2.0 * *sd).count();
    }
    let inside = inside as f64 / (3 * (LAST - FIRST + 1)) as f64;
    Score {
        name: name.to_owned(),
        errors,
        mean: of_mean,
        inside,
        noise_ratio: recovery.noise_ratio,
        unlikeness: recovery.unlikeness,
    }
}

const OHTA: &str = "charts/colorchecker_24_ohta_1997.csv";
const DAYLIGHT: &str = "illuminants/daylight_stanford.csv";
/// Pixels with little noise, shading and glare, with what the command line assumes of noise and charts.
const PHOTOGRAPH: Conditions = Conditions { noise: 0.002, uneven: 0.05, glare: [0.004; 3], stated: 0.015, ..EVEN };

/// All cameras, each or each maker left out.
fn hold_out(lights: &[&str], with: Conditions, by_maker: bool) -> Vec<Score> {
    let cameras = cameras();
    let lights: Vec<_> = lights.iter().map(|path| light(path)).collect();
    let one = |(seed, (name, sensor)): (usize, &(String, Sensor))| {
        let is_omitted = |other: &str| if by_maker { maker(other) == maker(name) } else { model(other) == model(name) };
        let library = library_without(&cameras, is_omitted);
        let mut random = SplitMix64::new(seed as u64);
        let shots: Vec<_> = lights.iter().map(|light| shot(sensor, light, with, &mut random)).collect();
        score(
            name,
            sensor,
            &library,
            &ChartRecovery::new(&library, &shots).unwrap_or_else(|error| panic!("{name}: {error}")),
        )
    };
    cameras.par_iter().enumerate().map(one).collect()
}

/// Median and ninth tenth of the channels' errors, mean share inside, share of cameras better than the mean.
fn summary(scores: &[Score]) -> [f64; 5] {
    let mut errors: Vec<f64> = scores.iter().flat_map(|score| score.errors).collect();
    errors.sort_by(f64::total_cmp);
    let at = |share: f64| errors[(share * (errors.len() - 1) as f64).round() as usize];
    let of = |errors: [f64; 3]| errors.iter().map(|e| e * e).sum::<f64>();
    let count = scores.len() as f64;
    let better = scores.iter().filter(|score| of(score.errors) < of(score.mean)).count() as f64 / count;
    let inside = scores.iter().map(|score| score.inside).sum::<f64>() / count;
    let ratio = scores.iter().map(|score| score.noise_ratio).sum::<f64>() / count;
    [at(0.5), at(0.9), inside, better, ratio]
}

#[test]
#[ignore = "prints the table of hold-outs"]
#[allow(clippy::print_stdout, reason = "the table is what a run on demand is for")]
fn table_of_hold_outs() {
    let uneven = Conditions { uneven: 0.1, glare: [0.01, 0.005, 0.01], ..EVEN };
    let all: [(&str, &[&str], Conditions); 6] = [
        ("D65, even", &[D65], EVEN),
        ("D65, uneven 10 %, glare", &[D65], uneven),
        ("D65 and A, even", &[D65, A], EVEN),
        ("photograph", &[D65], PHOTOGRAPH),
        ("photograph, other light", &[D65], Conditions { light: Some(DAYLIGHT), ..PHOTOGRAPH }),
        ("photograph, other chart", &[D65], Conditions { chart: Some(OHTA), ..PHOTOGRAPH }),
    ];
    for (label, lights, with) in all {
        for by_maker in [false, true] {
            let scores = hold_out(lights, with, by_maker);
            println!("{label}, maker out {by_maker}: {:.4?}", summary(&scores));
            for s in scores.iter().filter(|s| s.unlikeness > 1.0 || s.inside < 0.9) {
                println!(
                    "  {} {:.3?} mean {:.3?} inside {:.2} unlike {:.2}",
                    s.name, s.errors, s.mean, s.inside, s.unlikeness
                );
            }
        }
    }
}

/// Reached when this was written: 4.2 and 6.8 %, 99 and 96 % inside. Seven other draws of the noise give up to 4.5 and 6.9 %.
#[test]
fn unknown_cameras_are_recovered_within_their_uncertainties() {
    let [median, _, inside, better, ratio] = summary(&hold_out(&[D65], EVEN, false));
    assert!(median < 0.045 && inside > 0.97 && better >= 0.9, "{median} {inside} {better}");
    assert!((ratio - 1.0).abs() < 0.05, "{ratio}");
    let [one, tenth, inside, better, _] = summary(&hold_out(&[D65], EVEN, true));
    assert!(one < 0.07 && tenth < 0.125 && inside > 0.95 && better >= 0.9, "{one} {tenth} {inside} {better}");
    let [two, _, inside, ..] = summary(&hold_out(&[D65, A], EVEN, true));
    assert!(two < one && inside > 0.95, "{two} {inside}");
}

/// A recording for which the search of the curves that are zero somewhere went round in circles.
#[test]
fn bounds_are_found_however_far_the_start_is_from_them() {
    let cameras = cameras();
    let place = cameras.iter().position(|(name, _)| name == "canon_eos_10d_2007_figure").unwrap();
    let (name, sensor) = &cameras[place];
    let library = library_without(&cameras, |other| maker(other) == maker(name));
    let recorded = shot(sensor, &light(D65), EVEN, &mut SplitMix64::new(place as u64 + 1000));
    let found = ChartRecovery::new(&library, &[recorded]).unwrap();
    assert!((found.noise_ratio - 1.0).abs() < 0.5, "{}", found.noise_ratio);
}

/// A chart of another edition (in residuals up to twice the stated noise) and a measured daylight named as D65.
#[test]
fn uncertainties_hold_where_chart_and_light_are_not_those_named() {
    for with in [Conditions { chart: Some(OHTA), ..PHOTOGRAPH }, Conditions { light: Some(DAYLIGHT), ..PHOTOGRAPH }] {
        let [median, _, inside, better, _] = summary(&hold_out(&[D65], with, true));
        assert!(median < 0.11 && inside > 0.93 && better >= 0.95, "{median} {inside} {better}");
    }
}

/// Cameras with other filters than all others are far from the prior, and their bands are wide enough.
#[test]
fn cameras_unlike_the_library_are_found() {
    let scores = hold_out(&[D65], EVEN, true);
    let of = |name: &str| scores.iter().find(|score| score.name == name).unwrap();
    for name in ["kodak_dcs200", "sigma_sd1_merrill_npl"] {
        assert!(
            of(name).unlikeness > 1.3 && of(name).inside > 0.9,
            "{name} {} {}",
            of(name).unlikeness,
            of(name).inside
        );
    }
    let like = scores.iter().filter(|score| score.unlikeness < 1.2).count();
    assert!(like as f64 > 0.85 * scores.len() as f64, "{like}");
}

#[test]
fn recordings_that_tell_nothing_true_are_refused() {
    let cameras = cameras();
    let (name, sensor) = cameras.iter().find(|(name, _)| name.contains("d700")).unwrap();
    let library = library_without(&cameras, |other| other == name);
    let good = shot(sensor, &light(D65), Conditions { uneven: 0.1, glare: [0.01; 3], ..EVEN }, &mut SplitMix64::new(5));
    let found = ChartRecovery::new(&library, std::slice::from_ref(&good)).unwrap();
    assert!(found.glare.iter().all(|glare| (0.001..0.02).contains(glare)), "{:?}", found.glare);
    assert!((0.05..0.2).contains(&found.unevenness), "{}", found.unevenness);
    let few = Shot { patches: good.patches[..5].to_vec(), ..good.clone() };
    assert_eq!(ChartRecovery::new(&library, &[few]), Err(RecoveryError::TooFew { usable: 5 }));
    let mut clipped = good.clone();
    for patch in &mut clipped.patches[..10] {
        patch.rgb = [0.0, 0.0, 0.0].map(|v| Signal::new(v, 0.0));
    }
    let error = ChartRecovery::new(&library, &[clipped]).unwrap_err();
    assert_eq!(error, RecoveryError::Clipped { clipped: 30, values: 72 });
    // The chart turned by 180°.
    let mut turned = good.clone();
    let values: Vec<_> = turned.patches.iter().rev().map(|patch| patch.rgb).collect();
    turned.patches.iter_mut().zip(values).for_each(|(patch, rgb)| patch.rgb = rgb);
    let wrong = ChartRecovery::new(&library, std::slice::from_ref(&turned)).unwrap_err();
    assert!(matches!(wrong, RecoveryError::Fit { ratio } if ratio > 2.0), "{wrong}");
    let other = [("the chart turned".to_owned(), std::slice::from_ref(&good))];
    let named = ChartRecovery::against(&library, &[turned], other).unwrap_err();
    assert!(matches!(&named, RecoveryError::Contradicted { what, .. } if what == "the chart turned"), "{named}");
    let noisy = Shot { noise: vec![[10.0; 3]; 24], ..good };
    let error = ChartRecovery::new(&library, &[noisy]).unwrap_err();
    assert!(matches!(error, RecoveryError::Uninformative { .. }), "{error}");
}

#[test]
fn equal_input_gives_equal_output() {
    let cameras = cameras();
    let library = library_without(&cameras, |name| name.contains("nikon"));
    let recorded = shot(&cameras[0].1, &light(D65), EVEN, &mut SplitMix64::new(1));
    let once = ChartRecovery::new(&library, std::slice::from_ref(&recorded)).unwrap();
    assert_eq!(once, ChartRecovery::new(&library, &[recorded]).unwrap());
    assert!(once.curves.values.iter().flatten().all(|value| (0.0..=1.0).contains(value)));
}

/// Light that falls off by 16 % from one corner of the chart to the other, divided by what a gray frame would say it is: medians of the
/// curves' errors and of the patches' brightness against the truth.
fn falling_off(by_maker: bool, gray: fn(usize) -> f64) -> [f64; 2] {
    let (cameras, light) = (cameras(), light(D65));
    let one = |(seed, (name, sensor)): (usize, &(String, Sensor))| {
        let is_omitted = |other: &str| if by_maker { maker(other) == maker(name) } else { model(other) == model(name) };
        let library = library_without(&cameras, is_omitted);
        let mut recorded =
            shot(sensor, &light, Conditions { uneven: 0.0, ..PHOTOGRAPH }, &mut SplitMix64::new(seed as u64));
        let left = |at: usize| fall_off(at) / gray(at);
        for (at, (patch, noise)) in recorded.patches.iter_mut().zip(&mut recorded.noise).enumerate() {
            patch.rgb = patch.rgb.map(|value| Signal::new(value.value().unwrap() * left(at), f64::INFINITY));
            *noise = noise.map(|noise| noise * left(at));
        }
        let found = ChartRecovery::new(&library, &[recorded]).unwrap();
        let logs: Vec<f64> = found.brightness[0].iter().enumerate().map(|(at, b)| (b / left(at)).ln()).collect();
        let mean = logs.iter().sum::<f64>() / logs.len() as f64;
        let patches = (logs.iter().map(|log| (log - mean).powi(2)).sum::<f64>() / logs.len() as f64).sqrt();
        (score(name, sensor, &library, &found), patches)
    };
    let (scores, mut patches): (Vec<Score>, Vec<f64>) = cameras.par_iter().enumerate().map(one).unzip();
    patches.sort_by(f64::total_cmp);
    [summary(&scores)[0], patches[patches.len() / 2]]
}

fn fall_off(at: usize) -> f64 {
    1.0 + 0.08 * ((at % 6) as f64 / 5.0 + (at / 6) as f64 / 3.0 - 1.0)
}

/// As it is 2.7 %, with a gray frame 2.7 % (5.1 and 5.2 % without the maker); the patches are known to 0.2 %. So no gray frame is asked for.
#[test]
fn light_that_falls_off_costs_no_more_than_a_gray_frame_would_save() {
    for by_maker in [false, true] {
        let ([own, patches], [with_gray, _]) = (falling_off(by_maker, |_| 1.0), falling_off(by_maker, fall_off));
        assert!(own < 1.05 * with_gray && patches < 0.003, "{own} {with_gray} {patches}");
    }
}

/// 140 reflectances in 14 columns: light that falls off over them is known by its plane, and the curves are nearer than by 24 patches.
#[test]
fn a_larger_chart_says_more() {
    let (cameras, light, training) = (cameras(), light(D65), patches("charts/training_reflectances_190.csv"));
    let (name, camera) = cameras.iter().find(|(name, _)| name == "nikon_d700").unwrap();
    let library = library_without(&cameras, |other| model(other) == model(name));
    let mut random = SplitMix64::new(3);
    let fall_off = |at: usize| 1.0 + 0.08 * ((at % 14) as f64 / 6.5 - 1.0);
    let patch = |(at, patch): (usize, &chromascope_core::patch_set::Patch)| {
        let radiance = patch.grid.times(&light);
        let raw = camera.integrate(radiance.values());
        let rgb =
            raw.map(|value| Signal::new(value * fall_off(at) * (1.0 + 0.01 * normal(&mut random)), f64::INFINITY));
        RecordedPatch { name: format!("p{at}"), radiance, rgb }
    };
    let recorded: Vec<RecordedPatch> = training.patches()[..140].iter().enumerate().map(patch).collect();
    let large = Shot::new(recorded, Some(14), light.clone(), &[], 0.01);
    let found = ChartRecovery::new(&library, std::slice::from_ref(&large)).unwrap();
    let logs: Vec<f64> = found.brightness[0].iter().enumerate().map(|(at, b)| (b / fall_off(at)).ln()).collect();
    let mean = logs.iter().sum::<f64>() / logs.len() as f64;
    let patches = (logs.iter().map(|log| (log - mean).powi(2)).sum::<f64>() / logs.len() as f64).sqrt();
    assert!(patches < 0.01, "{patches}");
    let small = ChartRecovery::new(&library, &[shot(camera, &light, EVEN, &mut random)]).unwrap();
    let [large_errors, small_errors] =
        [&found, &small].map(|found| score(name, camera, &library, found).errors.iter().sum::<f64>());
    assert!(large_errors < small_errors, "{large_errors} {small_errors}");
    let errors = left_out(&library, &[large], &sensor(CIE_1931)).unwrap();
    assert!(errors.iter().enumerate().all(|(at, (name, error))| *name == format!("p{at}") && error.unwrap() < 5.0));
    assert_eq!(errors.len(), 140);
}
