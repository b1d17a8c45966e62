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
    close(d(0.375).atan2(d(-1.25)), [2.850_135_859_111_926_4, -2.043_392_043_737_472_2e-16]);
    close(d(-7.0).atan2(d(2.0)), [-1.292_496_667_789_785_3, 6.830_804_768_926_66e-17]);
    close(d(1e-9).atan2(d(3.0)), [3.333_333_333_333_333_7e-10, -1.724_527_510_720_042_2e-26]);
    close(d(2.5).atan2(d(0.0)), [1.570_796_326_794_896_6, 6.123_233_995_736_766e-17]);
    close(d(10.0).cbrt(), [2.154_434_690_031_884, -9.273_902_111_110_189e-17]);
    close(d(-1e-200).cbrt(), [-2.154_434_690_031_883_8e-67, 4.612_815_024_072_827e-84]);
    close(d(7e150).cbrt(), [1.912_931_182_772_389e50, -1.093_480_396_956_313_9e34]);
    close(d(10.0).sqrt(), [3.162_277_660_168_379_5, -1.907_881_697_071_660_3e-16]);
    close(d(3e-250).sqrt(), [1.732_050_807_568_877_4e-125, -6.837_972_339_878_681e-142]);
    close(d(7e250).sqrt(), [2.645_751_311_064_590_6e125, 6.000_150_320_585_467e107]);
    close(d(1.1).powi(40), [45.259_255_568_176_1, -3.310_506_352_228_251_3e-15]);
    close(d(1.0) / d(3.0), [0.333_333_333_333_333_3, 1.850_371_707_708_594e-17]);
    close([0.1, 1e-9, -3e5, 7.7].map(d).into_iter().sum(), [-299_992.199_999_999, 2.211_147_984_054_668_4e-11]);
    close(Double::FRAC_PI_2, [1.570_796_326_794_896_6, 6.123_233_995_736_766e-17]);
    close(Double::LN_2, [0.693_147_180_559_945_3, 2.319_046_813_846_299_6e-17]);
    close(Double::LN_TAU, [1.837_877_066_409_345_6, -7.756_588_316_134_483e-17]);
}

#[test]
#[allow(clippy::approx_constant, reason = "an angle near half a turn is where digits are lost")]
fn sines_and_cosines_hold_29_places() {
    let close = |found: Double, expected: [f64; 2]| {
        let off = (found - pair(expected)).value().abs();
        assert!(off <= 1e-29, "{found:?} is off by {off:e} from {expected:?}");
    };
    close(d(5.0).sin_cos().0, [-0.958_924_274_663_138_5, -1.492_631_694_612_635_6e-17]);
    close(d(5.0).sin_cos().1, [0.283_662_185_463_226_25, 1.819_299_000_446_236_8e-17]);
    close(d(-1.125).sin_cos().0, [-0.902_267_594_099_095_2, 1.969_530_728_064_91e-17]);
    close(d(-1.125).sin_cos().1, [0.431_176_516_798_666_2, -2.185_256_363_605_659_6e-17]);
    close(d(1000.0).sin_cos().0, [0.826_879_540_532_002_5, 3.867_581_909_641_312e-17]);
    close(d(1000.0).sin_cos().1, [0.562_379_076_290_702_9, 5.161_142_354_384_820_4e-17]);
    close(d(3.141_592_653_5).sin_cos().0, [8.979_318_433_952_318e-11, -5.881_698_005_094_529_6e-27]);
    close(d(3.141_592_653_5).sin_cos().1, [-1.0, 4.031_407_976_915_795e-21]);
}

#[test]
fn what_has_no_answer_does_not_pass_for_one() {
    for none in [d(0.0).ln(), d(-1.0).ln(), d(f64::NAN).ln(), d(1.0) / d(0.0), d(f64::MAX) * d(2.0), d(1e6).exp()] {
        assert!(!none.value().is_finite() || !none.low().is_finite(), "{none:?}");
    }
    assert_eq!(d(-2.0).sqrt(), d(0.0));
    assert_eq!(d(0.0).cbrt(), d(0.0));
    assert_eq!(d(0.0).atan2(d(0.0)), d(0.0));
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
