//! Corrections and profiles by the patches of a shot, and everything of a measured camera as one query.

use chromascope_core::colorimetry::Xyz;
use chromascope_core::correction::{Correction, RgbTransform, Training};
use chromascope_core::glam::DVec3;
use chromascope_core::light::DaylightBasis;
use chromascope_core::math::random::SplitMix64;
use chromascope_core::query::{Ask as _, ChartRecoveryQuery, ChartShot, Direct, Shared};
use chromascope_core::recovery::{ChartRecovery, FitSource, RecoveryError, Shot, ShotProfile};
use chromascope_core::spectral::{GridSpectrum, Quantity};

use super::support::{A, Conditions, D65, EVEN, cameras, chart, library_without, shot};
use crate::support::{CIE_1931, dataset, kelvin, light, sensor};

const QUIET: Conditions = Conditions { noise: 1e-4, stated: 2e-3, ..EVEN };

fn mean(of: &[Option<f64>]) -> f64 {
    of.iter().map(|v| v.unwrap()).sum::<f64>() / of.len() as f64
}

/// Without noise, fit and leave-one-out errors are those of the camera's own values, computed from its table.
#[test]
fn matrix_of_a_shot_is_that_of_the_camera() {
    let cameras = cameras();
    let (_, own) = cameras.iter().find(|(name, _)| name == "nikon_d700").unwrap();
    let (observer, d65) = (sensor(CIE_1931), light(D65));
    let shots = [shot(own, &d65, QUIET, &mut SplitMix64::new(3))];
    let recovery = ChartRecovery::new(&library_without(&cameras, |name| name == "nikon_d700"), &shots).unwrap();
    let profile = ShotProfile::new(&recovery, &shots, &[0], &observer, &ChartRecoveryQuery::corrections()).unwrap();
    let [white, diffuser] = [&observer, own].map(|of| DVec3::from(of.integrate(d65.values())));
    let of = |of: &chromascope_core::spectral::Sensor, white: DVec3| -> Vec<DVec3> {
        shots[0].patches.iter().map(|p| DVec3::from(of.integrate(p.radiance.values())) / white).collect()
    };
    let (samples, targets) = (of(own, diffuser), of(&observer, DVec3::splat(white.y)));
    let training = Training { samples: &samples, targets: &targets, weights: &[1.0; 24] };
    let unit = Xyz::from_vector(white / white.y);
    for ([patches, curves], correction) in profile.fits.iter().zip(ChartRecoveryQuery::corrections()) {
        let exact = training.fit(&correction, unit).unwrap();
        let left_out = training.leave_one_out(&correction, unit, &exact, || false).unwrap();
        let error = |at: usize, xyz: DVec3| {
            let stimulus = |xyz: DVec3| chromascope_core::colorimetry::Stimulus::new(Xyz::from_vector(xyz), unit);
            let metric = chromascope_core::colorimetry::Metric::DELTA_E_2000;
            metric.between(&stimulus(targets[at]), &stimulus(xyz))
        };
        let inside: Vec<_> = (0..24).map(|at| error(at, exact.xyz(samples[at]))).collect();
        let outside: Vec<_> = (0..24).map(|at| error(at, left_out[at].unwrap())).collect();
        assert_eq!([patches.source, curves.source], [FitSource::Patches, FitSource::Curves]);
        assert!((mean(&patches.measured) - mean(&inside)).abs() < 0.1, "{:?}", correction.method);
        assert!((mean(&patches.left_out) - mean(&outside)).abs() < 0.15, "{:?}", correction.method);
        assert!((mean(&curves.predicted) - mean(&inside)).abs() < 0.3, "{:?}", correction.method);
    }
    let [RgbTransform::Matrix(found), RgbTransform::Matrix(exact)] =
        [profile.fits[0][0].transform.clone(), training.fit(&Correction::default(), unit).unwrap()]
    else {
        panic!("no matrices")
    };
    assert!((found - exact).abs_diff_eq(chromascope_core::glam::DMat3::ZERO, 0.03), "{found} {exact}");
}

fn query(shots: Vec<ChartShot>) -> ChartRecoveryQuery {
    let cameras = cameras();
    ChartRecoveryQuery {
        library: Shared::new(library_without(&cameras, |name| name == "nikon_d700")),
        shots,
        daylight: Shared::new(DaylightBasis::new(&dataset("illuminants/cie_daylight_basis.csv")).unwrap()),
        other_lights: vec![("FL2".to_owned(), Shared::new(second_lamp()))],
        other_charts: vec![
            ("Ohta".to_owned(), Shared::new(crate::support::chart())),
            ("BabelColor".to_owned(), Shared::new(chart())),
        ],
        observer: Shared::new(sensor(CIE_1931)),
    }
}

fn second_lamp() -> GridSpectrum {
    GridSpectrum::resample(&dataset("illuminants/cie_fluorescent_lamps.csv").curves[1], Quantity::Light)
}

fn d700(light: &GridSpectrum) -> Shot {
    let cameras = cameras();
    let own = &cameras.iter().find(|(name, _)| name == "nikon_d700").unwrap().1;
    shot(own, light, Conditions { uneven: 0.05, ..EVEN }, &mut SplitMix64::new(8))
}

fn given(shot: Shot, light: &str, is_daylight: bool) -> ChartShot {
    let [light, picture] = [light.to_owned(), format!("under_{light}.dng")];
    ChartShot { shot: Shared::new(shot), is_daylight, light, chart: "BabelColor".to_owned(), picture }
}

#[test]
fn two_lights_make_two_profiles_of_one_camera() {
    let shots = vec![given(d700(&light(D65)), "D65", false), given(d700(&light(A)), "A", false)];
    let found = (*Direct.ask(&query(shots))).clone().unwrap();
    assert_eq!(found.profiles.iter().map(|(light, _)| light.as_str()).collect::<Vec<_>>(), ["D65", "A"]);
    assert_eq!((found.left_out.len(), found.nearest.len(), found.daylight), (24, 57, None));
    assert!(mean(&found.left_out.iter().map(|(_, error)| *error).collect::<Vec<_>>()) < 1.0);
    for (_, profile) in &found.profiles {
        assert!(mean(&profile.fits[0][0].left_out) < 3.0);
    }
}

#[test]
fn unknown_daylight_is_found_within_its_uncertainty() {
    let basis = DaylightBasis::new(&dataset("illuminants/cie_daylight_basis.csv")).unwrap();
    let truth = GridSpectrum::resample(&basis.light(kelvin(5000.0)).unwrap(), Quantity::Light);
    // The stand-in's spectrum has no part in the answer.
    let stand_in = d700(&truth).under(&light(D65));
    let found = (*Direct.ask(&query(vec![given(stand_in, "daylight", true)]))).clone().unwrap();
    let [found_k, deviation] = found.daylight.unwrap();
    assert!((found_k - 5000.0).abs() < 3.0 * deviation, "{found_k} ± {deviation}");
}

#[test]
fn another_light_is_refused_by_name() {
    // Recorded under FL2, named as D65.
    let wrong = d700(&second_lamp()).under(&light(D65));
    let error = (*Direct.ask(&query(vec![given(wrong, "D65", false)]))).clone().unwrap_err();
    assert!(matches!(&error, RecoveryError::Contradicted { what, .. } if what == "the light FL2"), "{error}");
}

/// Together with a good picture the wrong one would be fitted by curves that no camera has.
#[test]
fn the_light_of_each_of_several_pictures_is_judged_by_itself() {
    let wrong = given(d700(&second_lamp()).under(&light(D65)), "D65", false);
    let good = given(d700(&light(A)), "A", false);
    let error = (*Direct.ask(&query(vec![good, wrong]))).clone().unwrap_err();
    let RecoveryError::Picture { picture, reason } = &error else { panic!("{error}") };
    assert_eq!(picture, "under_D65.dng");
    assert!(matches!(&**reason, RecoveryError::Contradicted { what, .. } if what == "the light FL2"), "{error}");
}

#[test]
fn another_edition_of_the_chart_is_named_where_it_fits_better() {
    let cameras = cameras();
    let own = &cameras.iter().find(|(name, _)| name == "nikon_d700").unwrap().1;
    for (chart, better) in [(None, None), (Some("charts/colorchecker_24_ohta_1997.csv"), Some("Ohta"))] {
        let with = Conditions { noise: 0.002, stated: 0.015, chart, ..EVEN };
        let recorded = given(shot(own, &light(D65), with, &mut SplitMix64::new(2)), "D65", false);
        let found = (*Direct.ask(&query(vec![recorded]))).clone().unwrap();
        assert_eq!((found.better_chart.as_deref(), found.charts.as_slice()), (better, &["BabelColor".to_owned()][..]));
    }
}
