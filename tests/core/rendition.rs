//! Rendition indices against independent programs, with laws and hostile lights.

use chromascope_core::colorimetry::ciecam02::Ciecam02;
use chromascope_core::colorimetry::{Uv60, Xyz};
use chromascope_core::light::temperature::published::Robertson;
use chromascope_core::light::temperature::single::nearest_blackbody;
use chromascope_core::light::{
    Cct, CctError, DaylightBasis, PlanckianLocus, RadiationConstants, planckian::black_body,
};
use chromascope_core::patch_set::PatchSet;
use chromascope_core::rendition::cri::rendering_indices;
use chromascope_core::rendition::fidelity::color_fidelity;
use chromascope_core::rendition::reference::reference_illuminant;
use chromascope_core::rendition::{RenditionError, Standards, spectral_similarity};
use chromascope_core::spectral::SpectralDistribution;
use proptest::prelude::*;

use crate::support::{CIE_1931, REFERENCE, assert_near, cases, dataset, kelvin, measured, reference, sensor};

fn standards() -> Standards {
    Standards {
        cie_1931: sensor(CIE_1931),
        cie_1964: sensor("observers/cie_1964_10deg.csv"),
        daylight: DaylightBasis::new(&dataset("illuminants/cie_daylight_basis.csv")).unwrap(),
        test_colors: PatchSet::from_dataset(&dataset("test-samples/cri_14.csv")),
        evaluation_colors: PatchSet::from_dataset(&dataset("test-samples/ces_99.csv")),
    }
}

fn light(file: &str, column: usize) -> SpectralDistribution {
    dataset(&format!("illuminants/{file}")).curves[column - 1].clone()
}

const FLUORESCENT: &str = "cie_fluorescent_lamps.csv";

/// Values that colour-science 0.4.7 gives for its own illuminants, in the digits of the issue; D65 and C against each other and A
/// against 2856 K from the tests and examples of the same package.
#[test]
fn published_indices_are_met() {
    let standards = standards();
    let lamps = [
        (FLUORESCENT, 2, 64.2337, 1e-4),
        (FLUORESCENT, 7, 90.21, 5e-3),
        (FLUORESCENT, 11, 82.86, 5e-3),
        ("a.csv", 1, 99.996, 5e-4),
    ];
    for (file, column, ra, tolerance) in lamps {
        let indices = rendering_indices(&light(file, column), &standards).unwrap();
        assert_near(&format!("Ra of {file} {column}"), indices.general, ra, tolerance);
    }
    for (column, rf, rg) in [(2, 70.1208, 86.4163), (11, 80.0404, 101.0567)] {
        let fidelity = color_fidelity(&light(FLUORESCENT, column), &standards).unwrap();
        assert_near(&format!("Rf of FL{column}"), fidelity.fidelity, rf, 1e-4);
        assert_near(&format!("Rg of FL{column}"), fidelity.gamut, rg, 1e-4);
    }
    let body = measured(&black_body(kelvin(2856.0), RadiationConstants::Paper));
    for (test, against, index) in [("c.csv", light("d65.csv", 1), 94.0), ("hmi.csv", light("d50.csv", 1), 72.0)] {
        assert_eq!(spectral_similarity(&light(test, 1), &against).unwrap().round(), index, "{test}");
    }
    // The grid begins at 380 nm, the index at 375 nm: the band is a thirtieth, weighted by 4/15.
    assert_eq!(spectral_similarity(&light("a.csv", 1), &body).unwrap().round(), 100.0);
}

/// All built-in lights by another program; see the table's head.
#[test]
fn indices_of_all_lights_are_those_of_another_program() {
    let standards = standards();
    let rows = reference("rendition.csv");
    assert!(rows.len() > 80, "{}", rows.len());
    let mut worst = [0.0_f64; 8];
    let mut which = [const { String::new() }; 8];
    let mut monochromatic = 0;
    for row in rows {
        let spectrum = light(&row[0], row[1].parse().unwrap());
        let expected: Vec<f64> = row[2..].iter().map(|field| field.parse().unwrap()).collect();
        let mut note = |place: usize, value: f64, expected: &f64| {
            let off = (value - expected).abs();
            if off > worst[place] {
                (worst[place], which[place]) = (off, format!("{} {}", row[0], row[1]));
            }
        };
        let indices = match rendering_indices(&spectrum, &standards) {
            // CIE 13.3 excludes lamps of one line, which the other program does not.
            Err(RenditionError::Monochromatic { nm: 590 }) => None,
            indices => Some(indices.unwrap()),
        };
        monochromatic += usize::from(indices.is_none());
        if let Some(indices) = indices {
            note(0, indices.general, &expected[0]);
            indices.special.iter().zip(&expected[1..15]).for_each(|(value, expected)| note(1, *value, expected));
        }
        let fidelity = color_fidelity(&spectrum, &standards).unwrap();
        // Between wavelengths at 5 nm the samples are interpolated here, and read from the 1 nm table there.
        let place = if spectrum.uniform_step_nm() == Some(5.0) { 2 } else { 3 };
        note(place, fidelity.fidelity, &expected[15]);
        note(place, fidelity.gamut, &expected[16]);
        note(4, fidelity.cct.temperature.get() / expected[17], &1.0);
        note(5, fidelity.cct.duv, &expected[18]);
        let [first, fifth, ninth] = [0, 4, 8].map(|bin: usize| fidelity.bins[bin]);
        note(place, first.fidelity, &expected[19]);
        note(6, fifth.chroma_shift, &expected[20]);
        note(6, ninth.hue_shift, &expected[21]);
        note(7, spectral_similarity(&spectrum, &light("d50.csv", 1)).unwrap(), &expected[22]);
    }
    assert_eq!(monochromatic, 1, "low-pressure sodium");
    let tolerances = [1e-6, 1e-6, 1e-3, 1e-2, 1e-5, 1e-5, 1e-4, 1e-6];
    assert!(worst.iter().zip(tolerances).all(|(worst, tolerance)| *worst <= tolerance), "{worst:?} {which:?}");
}

#[test]
fn one_color_has_the_temperature_that_the_table_gives() {
    let observer = sensor(CIE_1931);
    let locus = PlanckianLocus::new(&observer, RadiationConstants::Paper).unwrap();
    let one = |color| nearest_blackbody(&observer, RadiationConstants::Paper, color);
    for kelvins in [1001.0, 1500.0, 2856.0, 4000.0, 6504.0, 10_000.0, 19_990.0] {
        for duv in [-0.049, -0.01, 0.0, 0.002, 0.049] {
            let color = locus.off(Cct { temperature: kelvin(kelvins), duv }).unwrap();
            let found = one(color).unwrap();
            assert_near(&format!("{kelvins} K, {duv}"), found.temperature.mired(), 1e6 / kelvins, 1e-6);
            assert_near("Duv", found.duv, duv, 1e-12);
        }
    }
    let far = [Uv60 { u: 0.1, v: 0.38 }, Uv60 { u: 0.45, v: 0.3 }, Uv60 { u: 50.0, v: 0.3 }];
    assert!(
        far.into_iter().all(|color| one(color) == Err(CctError::TooFar) && locus.cct(color) == Err(CctError::TooFar))
    );
    let hot = Uv60 { u: 0.180, v: 0.264 };
    assert_eq!((one(hot), locus.cct(hot)), (Err(CctError::TooHot), Err(CctError::TooHot)));
    let none = Uv60 { u: f64::NAN, v: 0.3 };
    assert_eq!(one(none), Err(CctError::NoChromaticity));
}

/// Table 1 of Robertson 1968, as Wyszecki and Stiles 1982 reprint it (Table 1(3.11)).
#[test]
fn robertsons_table_is_met_by_rounding() {
    let printed = Robertson::as_printed(&sensor(CIE_1931)).unwrap();
    let rows = printed.rows();
    let some = [
        (0, 0.18006, 0.26352, -0.24341),
        (1, 0.18066, 0.26589, -0.25479),
        (10, 0.19032, 0.29326, -0.47888),
        (14, 0.21142, 0.32312, -1.0182),
        (23, 0.28039, 0.35577, -5.3762),
        (30, 0.33724, 0.36051, -116.45),
    ];
    for (index, u, v, slope) in some {
        let [mired, at_u, at_v, t] = rows[index];
        assert_near(&format!("slope at {mired}"), t / slope, 1.0, 1e-12);
        assert_eq!([at_u, at_v], [u, v], "{mired}");
    }
    assert!(Robertson::as_printed(&sensor(REFERENCE)).is_err());
}

/// Example of CIE 159 as colour-science 0.4.7 computes it: `XYZ_to_CIECAM02` with D = 1, `L_A` = 100, `Y_b` = 20, average surround, then
/// `JMh_CIECAM02_to_CAM02UCS`.
#[test]
fn appearance_matches_another_program() {
    let model = Ciecam02::new(Xyz::new(0.9505, 1.0, 1.0888)).unwrap();
    let expected = [
        ([0.1901, 0.2, 0.2178], [54.749_687_682_586, 0.000_498_485_589, -0.019_460_684_994, 271.467_310_955_31]),
        ([0.5706, 0.4306, 0.3196], [76.839_534_993_276, 29.874_142_904_546, 10.753_976_009_787, 19.797_661_633_614]),
        ([0.0353, 0.0656, 0.0214], [31.930_979_156_373, -22.618_961_278_569, 18.017_652_385_551, 141.460_121_530_064]),
        ([0.0953, 0.1, 0.43552], [37.676_964_777_309, -20.853_559_726_976, -33.374_538_833_811, 238.001_440_533_697]),
    ];
    for (xyz, [j, a, b, hue]) in expected {
        let [x, y, z] = xyz;
        let ucs = model.ucs(Xyz::new(x, y, z)).unwrap();
        for (what, value, expected) in [("J", ucs.j, j), ("a", ucs.a, a), ("b", ucs.b, b), ("h", ucs.hue, hue)] {
            assert_near(&format!("{what} of {xyz:?}"), value, expected, 1e-9);
        }
    }
    assert_eq!(Ciecam02::new(Xyz::new(0.0, 0.0, 0.0)), None);
}

#[test]
fn a_reference_illuminant_renders_perfectly() {
    let standards = standards();
    for kelvins in [1800.0, 2856.0, 4300.0, 4999.0, 5500.0, 6504.0, 12_000.0] {
        let body = measured(&black_body(kelvin(kelvins), RadiationConstants::Paper));
        let (own, cct) = reference_illuminant(&body, &standards).unwrap();
        let fidelity = color_fidelity(&measured(&own), &standards).unwrap();
        // A mixture and daylight are not exactly at the temperature that they are made for.
        let least = if kelvins < 4000.0 { 99.999 } else { 99.9 };
        assert!(fidelity.fidelity > least && (fidelity.gamut - 100.0).abs() < 0.1, "{kelvins}: {fidelity:?}");
        // The light ends at 380 nm, the locus of the index at 360 nm: that is 0.13 % at 12 000 K.
        assert_near("temperature", cct.temperature.get() / kelvins, 1.0, 1.5e-3);
        if kelvins < 5000.0 {
            // Robertson's temperature is within 0.1 % and Ra falls by 0.01 for it.
            let indices = rendering_indices(&body, &standards).unwrap();
            assert!(indices.general > 99.9, "{kelvins}: {indices:?}");
        }
    }
}

#[test]
fn lights_without_an_answer_say_why() {
    let standards = standards();
    let flat = |value: f64| SpectralDistribution::new(vec![380.0, 780.0], vec![value; 2]).unwrap();
    let narrow = |nm: f64| SpectralDistribution::new(vec![nm - 2.0, nm, nm + 2.0], vec![0.0, 1.0, 0.0]).unwrap();
    let infrared = SpectralDistribution::new(vec![800.0, 900.0], vec![1.0, 1.0]).unwrap();
    let no_power = |error: RenditionError| matches!(error, RenditionError::NoPower { .. });
    for dark in [&flat(0.0), &infrared] {
        assert!(no_power(color_fidelity(dark, &standards).unwrap_err()));
        assert!(no_power(spectral_similarity(dark, &flat(1.0)).unwrap_err()));
        assert!(no_power(spectral_similarity(&flat(1.0), dark).unwrap_err()));
    }
    assert!(no_power(rendering_indices(&flat(0.0), &standards).unwrap_err()));
    for green in [narrow(520.0), narrow(460.0)] {
        let expected = RenditionError::Temperature(CctError::TooFar);
        let cri = rendering_indices(&green, &standards).unwrap_err();
        assert!(matches!(cri, RenditionError::Temperature(_) | RenditionError::Monochromatic { .. }), "{cri:?}");
        let fidelity = color_fidelity(&green, &standards).unwrap_err();
        assert!(fidelity == expected || matches!(fidelity, RenditionError::Temperature(_)), "{fidelity:?}");
        assert!(!cri.to_string().is_empty());
    }
    let mut short = standards.clone();
    short.test_colors = short.test_colors.subset(&["TCS01"]);
    let error = rendering_indices(&flat(1.0), &short).unwrap_err();
    assert_eq!(error, RenditionError::Samples { found: 1, expected: 14 });
    let mut blind = standards;
    blind.cie_1931 = sensor(REFERENCE);
    assert!(matches!(rendering_indices(&flat(1.0), &blind).unwrap_err(), RenditionError::Observer(_)));
}

proptest! {
    #![proptest_config(cases(24))]

    /// The scale of a light is free, and every answer is a number or a reason.
    #[test]
    fn scale_changes_nothing(values in prop::collection::vec(-0.02_f64..1.0, 81), exponent in -90_i32..90) {
        let standards = standards();
        let nm: Vec<f64> = (0..81).map(|i| 380.0 + 5.0 * f64::from(i)).collect();
        let one = SpectralDistribution::new(nm.clone(), values.clone()).unwrap();
        let scale = 10_f64.powi(exponent);
        let other = SpectralDistribution::new(nm, values.iter().map(|v| v * scale).collect()).unwrap();
        match (rendering_indices(&one, &standards), rendering_indices(&other, &standards)) {
            (Ok(a), Ok(b)) => prop_assert!((a.general - b.general).abs() < 1e-6 && a.general <= 100.0),
            (a, b) => prop_assert!(a.is_err() && b.is_err(), "{a:?} {b:?}"),
        }
        match (color_fidelity(&one, &standards), color_fidelity(&other, &standards)) {
            (Ok(a), Ok(b)) => {
                prop_assert!((a.fidelity - b.fidelity).abs() < 1e-4, "{} {}", a.fidelity, b.fidelity);
                prop_assert!((0.0..=100.0 + 1e-3).contains(&a.fidelity) && a.gamut.is_finite());
            }
            (a, b) => prop_assert!(a.is_err() && b.is_err(), "{a:?} {b:?}"),
        }
        let [a, b] = [&one, &other].map(|light| spectral_similarity(light, &one).unwrap());
        prop_assert!((a - 100.0).abs() < 1e-9 && (b - 100.0).abs() < 1e-9);
    }
}
