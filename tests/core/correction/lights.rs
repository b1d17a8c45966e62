//! DNG matrices, and renderings and renders through each correction.

use chromascope_core::camera::Rendering;
use chromascope_core::colorimetry::Metric;
use chromascope_core::correction::dng::{D50, DngMatrices, first_weight};
use chromascope_core::correction::neutral::{Neutral, NeutralError};
use chromascope_core::correction::root_polynomial::Degree;
use chromascope_core::correction::{Correction, CorrectionMethod};
use chromascope_core::query::correction::{CorrectionSheetQuery, dng_matrices};
use chromascope_core::query::{
    Ask as _, ColorTransformSpec, CorrectionReportQuery, Direct, RenderingQuery, Shared, StimulusCheck,
};
use chromascope_core::render::ColorimetricScale;
use glam::DVec3;

use super::correction;
use crate::support::{CIE_1931, kelvin, light, sensor, training};

fn query(camera: &str, illuminant: &str, correction: Correction) -> RenderingQuery {
    let (reference, training) = (Shared::new(sensor(CIE_1931)), Shared::new(training()));
    RenderingQuery {
        sensor: Shared::new(sensor(camera)),
        light: Shared::new(light(illuminant)),
        white: chromascope_core::camera::WhiteBalanceTarget([1.104, 0.987, 0.8233]),
        transform: ColorTransformSpec::Observer { reference, training, correction },
    }
}

fn rendering(query: &RenderingQuery) -> Rendering {
    (*Direct.ask(query)).clone().unwrap()
}

const D200: &str = "cameras/nikon_d200.csv";

#[test]
fn dng_matrices_carry_white_to_d50_and_back_to_the_cameras_white() {
    let rendering = rendering(&query(D200, "illuminants/a.csv", Correction::default()));
    let DngMatrices { color, forward, balance } = dng_matrices(&rendering).unwrap();
    let d50 = D50.with_unit_luminance().unwrap().to_vector();
    assert!((forward * DVec3::ONE - d50).abs().max_element() < 1e-12);
    assert!(((color * d50).max_element() - 1.0).abs() < 1e-12);
    // ColorMatrix takes the light's white to the raw white, up to brightness.
    let neutral = color * rendering.lab_white.to_vector();
    let raw = rendering.white_integrals;
    assert!((neutral / neutral.y - raw / raw.y).abs().max_element() < 1e-12);
    assert!((DVec3::from_array(balance) * raw / raw.max_element() - DVec3::ONE).abs().max_element() < 1e-12);
}

/// `ColorMatrix` times white is the neutral that was given, and the other light's is scaled by the same gains.
#[test]
fn gains_bring_white_to_a_given_neutral_under_both_lights() {
    let given: Neutral = "0.47 1 0.72".parse().unwrap();
    let lights = ["illuminants/d65.csv", "illuminants/a.csv"];
    let renderings = lights.map(|light| rendering(&query("cameras/nikon_d5100.csv", light, Correction::default())));
    let [first, second] = renderings.each_ref().map(|rendering| dng_matrices(rendering).unwrap());
    let gains = given.to_vector() / first.neutral();
    let d50 = D50.with_unit_luminance().unwrap().to_vector();
    let scaled = [first, second].map(|dng| dng.with_gains(gains).unwrap());
    for ((rendering, plain), scaled) in renderings.iter().zip([first, second]).zip(scaled) {
        assert_eq!(scaled.forward, plain.forward);
        assert!(((scaled.color * d50).max_element() - 1.0).abs() < 1e-12);
        let [before, white] = [plain, scaled].map(|dng| dng.color * rendering.lab_white.to_vector());
        assert!((white / white.y - gains * before / (gains * before).y).abs().max_element() < 1e-12);
        assert!((white / white.max_element() - scaled.neutral()).abs().max_element() < 1e-12);
    }
    assert!((scaled[0].neutral() - given.to_vector()).abs().max_element() < 1e-15);
    assert_eq!(first.with_gains(DVec3::new(1.0, 0.0, 1.0)), None);
}

#[test]
fn a_neutral_is_three_positive_numbers_and_no_multipliers() {
    let of = |text: &str| text.parse::<Neutral>();
    assert_eq!(of("1,2,1.5").unwrap().to_vector(), DVec3::new(0.5, 1.0, 0.75));
    assert_eq!(of(" 0.5, 1 ,0.7 "), of("0.5 1 0.7"));
    for wrong in ["", "1", "1,1", "1,1,1,1", "0,1,1", "-1,1,1", "nan,1,1", "inf,1,1", "1e-320,1,1", "a,b,c", "1;1;1"] {
        assert_eq!(of(wrong), Err(NeutralError::Numbers), "{wrong}");
    }
    assert_eq!(of("2.1,1,1.5"), Err(NeutralError::Multipliers));
    assert!(of("1.1,1,0.3").is_ok() && of("1,1,1").is_ok());
}

/// DNG specification 1.6.0.0, chapter 6: linear in the inverse of the temperature, clamped.
#[test]
fn matrices_are_mixed_linearly_in_the_inverse_of_the_temperature() {
    let weight = |t| first_weight(kelvin(t), kelvin(2856.0), kelvin(6504.0));
    let known = (1.0 / 4000.0 - 1.0 / 6504.0) / (1.0 / 2856.0 - 1.0 / 6504.0);
    assert!((weight(4000.0) - known).abs() < 1e-12);
    assert_eq!([weight(2000.0), weight(2856.0), weight(6504.0), weight(9000.0)], [1.0, 1.0, 0.0, 0.0]);
    assert_eq!(first_weight(kelvin(5000.0), kelvin(5000.0), kelvin(5000.0)), 1.0);
}

#[test]
fn between_two_lights_the_mixture_is_better_than_either_alone() {
    let report = |illuminant| CorrectionReportQuery {
        rendering: query(D200, illuminant, Correction::default()),
        metric: Metric::DELTA_E_2000,
    };
    let second = Some(report("illuminants/d65.csv"));
    let sheet =
        CorrectionSheetQuery { first: report("illuminants/a.csv"), second, observer: Shared::new(sensor(CIE_1931)) };
    let sheet = (*Direct.ask(&sheet)).clone().unwrap();
    // CIE 15: A is 2856 K, D65 6504 K.
    assert!((sheet.first.temperature.unwrap().get() - 2856.0).abs() < 2.0);
    assert!((sheet.second.unwrap().unwrap().temperature.unwrap().get() - 6504.0).abs() < 3.0);
    let points = sheet.between.unwrap();
    assert_eq!(points.len(), 17);
    let total = |of: fn(&chromascope_core::query::TwoLightPoint) -> f64| points.iter().map(of).sum::<f64>();
    let [mixed, first, second, own] = [total(|p| p.mixed), total(|p| p.first), total(|p| p.second), total(|p| p.own)];
    // Least squares in XYZ do not minimize ΔE, so the mixture may come out a little below the light's own fit.
    assert!(mixed < first && mixed < second && own < first && own < second, "{own} {mixed} {first} {second}");
    let (a, b) = (points.first().unwrap(), points.last().unwrap());
    assert!((a.mixed - a.first).abs() < 1e-9 && (b.mixed - b.second).abs() < 1e-9);
}

#[test]
fn a_report_says_what_a_matrix_does_to_white_and_blue() {
    let report = |method, keeps_white| {
        let rendering = query(D200, "illuminants/d55.csv", correction(method, keeps_white));
        (*Direct.ask(&CorrectionReportQuery { rendering, metric: Metric::DELTA_E_2000 })).clone().unwrap()
    };
    let kept = report(CorrectionMethod::LeastSquares, true);
    assert!(kept.white.difference.unwrap() < 1e-6);
    assert!(!kept.white.is_negative());
    let free = report(CorrectionMethod::LeastSquares, false);
    assert!(free.white.difference.unwrap() > 0.05, "{:?}", free.white.difference);
    assert_eq!(kept.blue.len(), 4);
    assert!(kept.blue.iter().all(StimulusCheck::clips), "narrow blue lights are outside sRGB");
    // Summaries are what they are called.
    for summary in [kept.before.unwrap(), kept.training.unwrap(), kept.left_out.unwrap()] {
        assert!(summary.mean < summary.p95 && summary.p95 <= summary.max, "{summary:?}");
    }
    assert!(kept.training.unwrap().mean < kept.before.unwrap().mean);
    assert_eq!(kept.count, 190);
    assert!(report(CorrectionMethod::RootPolynomial(Degree::Two), true).dng.is_none());
}

/// A render's pixel is colored as a patch of the same signals.
#[test]
fn renders_take_every_correction() {
    for method in CorrectionMethod::ALL {
        let rendering = rendering(&query(D200, "illuminants/d55.csv", correction(method, true)));
        let scale = ColorimetricScale::new(&rendering, 1.0);
        let raw = [0.31_f32, 0.22, 0.45];
        let patch = rendering.xyz(rendering.white * DVec3::from_array(raw.map(f64::from))).to_vector();
        let pixel = scale.color(raw).xyz.to_vector();
        assert!((patch - pixel).abs().max_element() < 1e-12, "{method:?}: {patch} {pixel}");
    }
}
