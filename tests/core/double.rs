//! Numbers of two doubles, against 80 digits and themselves. All pairs here: mpmath 1.3.0, the nearest double and what it lacks.

use chromascope_math::double::Double;

fn d(value: f64) -> Double {
    Double::new(value)
}

fn pair([high, low]: [f64; 2]) -> Double {
    d(high) + d(low)
}

#[track_caller]
fn close(found: Double, expected: [f64; 2]) {
    let off = ((found - pair(expected)) / pair(expected)).value().abs();
    assert!(off <= 1e-29, "{found:?} is off by {off:e} from {expected:?}");
}

#[test]
#[allow(clippy::approx_constant, reason = "what the constants are held to")]
fn functions_hold_29_digits() {
    close(d(7.6875).exp(), [2_180.915_452_553_049_4, -6.074_839_179_663_703e-14]);
    close(d(-31.25).exp(), [2.681_003_867_781_803_4e-14, -1.326_858_161_136_482_2e-30]);
    close(d(0.40625).exp(), [1.501_177_800_000_122_8, -4.538_495_530_045_995_4e-17]);
    close(d(-600.5).exp(), [1.607_546_769_793_794_2e-261, 3.537_726_127_764_541e-279]);
    close(d(639.75).exp(), [6.916_634_038_342_133e277, 2.389_409_743_966_655_3e261]);
    close((d(1.0) / d(1024.0)).exp_m1(), [0.000_977_039_492_416_535_1, 1.023_970_399_284_635_2e-19]);
    close((d(-3.0) / d(8.0)).exp_m1(), [-0.312_710_721_209_027_8, 1.842_314_816_988_643e-17]);
    close((d(77.0) / d(4.0)).exp_m1(), [229_175_809.865_643_4, -6.037_223_692_476_743e-9]);
    close(d(10.0).ln(), [2.302_585_092_994_046, -2.170_756_223_382_249_4e-16]);
    close(d(1e-280).ln(), [-644.723_826_038_332_8, 5.363_311_128_527_145_5e-14]);
    close(d(3e250).ln(), [576.744_885_537_179_6, -5.377_238_790_904_794e-14]);
    close(d(1.000_976_562_5).ln(), [0.000_976_085_973_055_458_9, -2.879_115_653_409_671_4e-20]);
    close(d(0.999_999_046_325_683_6).ln(), [-9.536_747_711_538_9e-7, -7.079_287_424_876_893e-23]);
    close((d(3.0) / d(4096.0)).ln(), [-7.219_153_878_051_234, -1.469_539_850_865_399_4e-16]);
    close(d(10.0).sqrt(), [3.162_277_660_168_379_5, -1.907_881_697_071_660_3e-16]);
    close(d(3e-250).sqrt(), [1.732_050_807_568_877_4e-125, -6.837_972_339_878_681e-142]);
    close(d(7e250).sqrt(), [2.645_751_311_064_590_6e125, 6.000_150_320_585_467e107]);
    close(d(1.1).powi(40), [45.259_255_568_176_1, -3.310_506_352_228_251_3e-15]);
    close(d(1.0) / d(3.0), [0.333_333_333_333_333_3, 1.850_371_707_708_594e-17]);
    close([0.1, 1e-9, -3e5, 7.7].map(d).into_iter().sum(), [-299_992.199_999_999, 2.211_147_984_054_668_4e-11]);
    close(Double::LN_2, [0.693_147_180_559_945_3, 2.319_046_813_846_299_6e-17]);
}

#[test]
fn what_has_no_answer_does_not_pass_for_one() {
    for none in [d(0.0).ln(), d(-1.0).ln(), d(f64::NAN).ln(), d(1.0) / d(0.0), d(f64::MAX) * d(2.0), d(1e6).exp()] {
        assert!(!none.value().is_finite() || !none.low().is_finite(), "{none:?}");
    }
    assert_eq!(d(-2.0).sqrt(), d(0.0));
    assert_eq!(d(-1e6).exp(), d(0.0));
}

#[test]
fn an_error_is_told_with_its_sign_and_digits() {
    let third = d(1.0) / d(3.0);
    let above = third.value().next_up();
    assert!((third.error_of(above) / 3.700_743_415_417_189e-17 - 1.0).abs() < 1e-15, "{:e}", third.error_of(above));
    assert!(third.error_of(third.value()) < 0.0 && third.error_of(1e9) == 1e9 - 1.0 / 3.0);
    assert_eq!((-third).abs(), third);
}
