//! Root polynomials: terms, exposure, refusal.

use chromascope_core::camera::{ColorTransform, Rendering, RenderingError, WhiteBalanceTarget};
use chromascope_core::correction::root_polynomial::{Degree, RootPolynomial};
use chromascope_core::correction::{Correction, CorrectionMethod, RgbTransform};
use glam::DVec3;
use proptest::prelude::*;

use super::{correction, rounding, set, white};
use crate::support::{CIE_1931, NIKON_D70, REFERENCE, cases, light, sensor, training};

/// Terms of r = 0.2, g = 0.5, b = 0.8 in the order of Finlayson, Mackiewicz & Hurlbert (2015), as colour-science 0.4.7 lists them
/// (`matrix_augmented_Finlayson2015`, `root_polynomial_expansion=True`).
const TERMS: [f64; 22] = [
    0.2,
    0.5,
    0.8,
    0.316_227_766_016_837_94,
    0.632_455_532_033_675_9,
    0.4,
    0.368_403_149_864_038_7,
    0.683_990_378_670_678_8,
    0.503_968_419_957_949_3,
    0.271_441_761_659_490_7,
    0.584_803_547_642_573_3,
    0.317_480_210_393_639_94,
    0.430_886_938_006_376_8,
    0.251_486_685_936_587_1,
    0.282_842_712_474_619,
    0.397_635_364_383_525_3,
    0.562_341_325_190_349_1,
    0.565_685_424_949_238,
    0.711_311_764_015_569_2,
    0.355_655_882_007_784_6,
    0.447_213_595_499_957_9,
    0.502_973_371_873_174_1,
];

#[test]
fn terms_are_those_of_the_publication() {
    for (degree, count) in [(Degree::Two, 6), (Degree::Three, 13), (Degree::Four, 22)] {
        let mut terms = degree.terms(DVec3::new(0.2, 0.5, 0.8));
        assert_eq!(terms.len(), count);
        let mut known = TERMS[..count].to_vec();
        terms.sort_by(f64::total_cmp);
        known.sort_by(f64::total_cmp);
        for (term, known) in terms.iter().zip(&known) {
            assert!((term - known).abs() < 1e-14, "{degree:?}: {terms:?}");
        }
    }
}

#[test]
fn coefficients_are_those_of_numpy() {
    let set = set();
    let fit = set.training().fit(&correction(CorrectionMethod::RootPolynomial(Degree::Two), false), white()).unwrap();
    let RgbTransform::RootPolynomial(polynomial) = fit else { panic!("a root polynomial was asked for") };
    // numpy.linalg.lstsq on the six terms.
    let known = [
        [0.501_088_267_944_364_1, 0.135_090_413_712_162_16, -0.101_709_231_230_951_23],
        [-0.065_642_929_457_724_71, 0.706_352_478_091_953, -0.134_978_935_164_534_63],
        [0.214_369_805_742_557_62, -0.149_994_035_291_497_16, 1.665_526_994_058_780_7],
        [0.540_568_193_272_591_4, 0.415_201_659_672_656_1, 0.289_935_786_621_410_84],
        [-0.135_896_741_051_604_54, -0.005_423_013_245_334_332, -0.864_973_047_576_894_2],
        [-0.110_449_271_300_086_05, -0.106_065_403_689_342_28, 0.138_926_583_337_467_1],
    ];
    for (c, known) in polynomial.coefficients().iter().zip(known) {
        assert!((*c - DVec3::from_array(known)).abs().max_element() < 1e-7, "{c} {known:?}");
    }
}

#[test]
fn each_term_has_a_name() {
    let names: Vec<String> = (0..22).map(RootPolynomial::term_name).collect();
    assert_eq!(names[..7], ["r", "g", "b", "√(r g)", "√(g b)", "√(r b)", "∛(r g²)"]);
    assert_eq!(names[13], "∜(r³ g)");
    assert_eq!(names.iter().collect::<std::collections::BTreeSet<_>>().len(), 22);
}

proptest! {
    #![proptest_config(cases(64))]

    #[test]
    fn exposure_scales_the_color(r in 0.0..2.0, g in 0.0..2.0, b in 0.0..2.0, factor in 1e-3..1e3_f64, degree in 0..3_usize) {
        let degree = [Degree::Two, Degree::Three, Degree::Four][degree];
        let set = set();
        let fit = set.training().fit(&correction(CorrectionMethod::RootPolynomial(degree), true), white()).unwrap();
        let rgb = DVec3::new(r, g, b);
        let (one, scaled) = (fit.xyz(rgb), fit.xyz(rgb * factor));
        prop_assert!((scaled - one * factor).abs().max_element() <= 1e-11 * factor * (1.0 + rgb.max_element()) * 1e2);
    }
}

#[test]
fn derivative_at_white_is_the_polynomial_of_white() {
    let set = set();
    let fit = set.training().fit(&correction(CorrectionMethod::RootPolynomial(Degree::Two), false), white()).unwrap();
    let rounding = rounding(&fit);
    let RgbTransform::RootPolynomial(polynomial) = fit else { panic!("a root polynomial was asked for") };
    let at_white = polynomial.at_white();
    assert!((at_white * DVec3::ONE - polynomial.xyz(DVec3::ONE)).abs().max_element() < rounding);
    for axis in [DVec3::X, DVec3::Y, DVec3::Z] {
        let h = 1e-6;
        let slope = (polynomial.xyz(DVec3::ONE + axis * h) - polynomial.xyz(DVec3::ONE - axis * h)) / (2.0 * h);
        assert!((slope - at_white * axis).abs().max_element() < 1e-6);
    }
}

#[test]
fn renderings_take_cameras_and_refuse_observers_with_negative_lobes() {
    let (reference, training) = (sensor(CIE_1931), training());
    let method = CorrectionMethod::RootPolynomial(Degree::Three);
    let correction = Correction { method, ..Correction::default() };
    let transform = ColorTransform::Observer { reference: &reference, training: &training, correction };
    let (d55, white) = (light("illuminants/d55.csv"), WhiteBalanceTarget([1.1, 0.987, 0.823]));
    let refused = Rendering::new(&sensor(REFERENCE), &d55, white, transform);
    assert_eq!(refused.unwrap_err(), RenderingError::NegativeLobes { is_rgb: true });
    let camera = Rendering::new(&sensor(NIKON_D70), &d55, white, transform).unwrap();
    assert!(camera.root_polynomial.is_some());
    let kept = camera.xyz(camera.white).to_vector() - camera.lab_white.to_vector();
    assert!(kept.abs().max_element() < 1e-12, "{kept}");
}
