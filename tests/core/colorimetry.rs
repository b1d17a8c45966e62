//! Tristimulus values, diagrams, Lab, differences, adaptation, RGB: published values and laws.

use chromascope_core::colorimetry::adaptation::bradford;
use chromascope_core::colorimetry::diagram::{area_color, spectral_locus, wavelength_color};
use chromascope_core::colorimetry::difference::{DELTA_E_2000_ERROR, delta_e_1994};
use chromascope_core::colorimetry::lab::lab_from_xyz;
use chromascope_core::colorimetry::rgb::{
    GAMUTS, SRGB_FROM_XYZ_PUBLISHED, XYZ_FROM_SRGB, encode_srgb, srgb_from_xyz, srgb_inverse_transfer, srgb_transfer,
    srgb_white,
};
use chromascope_core::colorimetry::{
    Lab, Metric, Stimulus, UvPrime, Xy, Xyz, delta_e_1976, delta_e_2000, delta_e_2000_into,
};
use glam::{DMat3, DVec3};
use proptest::prelude::*;

use crate::support::{CIE_1931, assert_near, assert_xy, cases, light, reference_numbers, sensor};

/// CIE 15:2004, Table T.3, 2° observer, with Y = 1.
const A: Xyz = Xyz::new(1.0985, 1.0, 0.3558);
const D65: Xyz = Xyz::new(0.9504, 1.0, 1.0888);

#[test]
fn ciede2000_gives_the_34_published_differences() {
    let rows = reference_numbers("ciede2000_sharma_2005.csv");
    assert_eq!(rows.len(), 34);
    for (pair, row) in rows.iter().enumerate() {
        let (a, b) = (Lab { l: row[0], a: row[1], b: row[2] }, Lab { l: row[3], a: row[4], b: row[5] });
        // Four decimals are printed.
        assert_near(&format!("pair {}", pair + 1), delta_e_2000(a, b), row[6], 5.001e-5);
        assert_near(&format!("pair {} reversed", pair + 1), delta_e_2000(b, a), row[6], 5.001e-5);
    }
}

#[test]
fn ciede2000_matches_fifty_digits_on_both_sides_of_its_leaps() {
    for row in reference_numbers("ciede2000_exact.csv") {
        let (a, b) = (Lab { l: row[0], a: row[1], b: row[2] }, Lab { l: row[3], a: row[4], b: row[5] });
        for found in [delta_e_2000(a, b), delta_e_2000(b, a)] {
            assert_near(&format!("{a:?} {b:?}"), found, row[6], DELTA_E_2000_ERROR * row[6]);
        }
    }
}

#[test]
fn many_differences_are_each_to_the_last_bit_on_any_number_of_threads() {
    let rows = vec![reference_numbers("ciede2000_exact.csv"); 50].concat();
    let labs = |from: usize| -> Vec<Lab> {
        rows.iter().map(|row| Lab { l: row[from], a: row[from + 1], b: row[from + 2] }).collect()
    };
    let (mut firsts, seconds) = (labs(0), labs(3));
    firsts[7].a = f64::NAN;
    let each: Vec<f64> = firsts.iter().zip(&seconds).map(|(&a, &b)| delta_e_2000(a, b)).collect();
    assert!(each.iter().all(|d| d.is_finite()));
    for threads in [1, 3] {
        let mut answers = vec![-1.0; rows.len() + 2];
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| delta_e_2000_into(&firsts, &seconds, &mut answers));
        assert_eq!(answers[..rows.len()], each);
        assert_eq!(answers[rows.len()..], [-1.0, -1.0]);
    }
}

#[test]
fn standard_illuminants_have_their_published_chromaticities() {
    let observer = sensor(CIE_1931);
    // CIE 15:2004, Table T.3: x, y, u′, v′. Five decimals from 360 to 830 nm; ours begins at 380 nm.
    for (path, x, y, u, v) in [
        ("illuminants/a.csv", 0.44758, 0.40745, 0.25597, 0.52429),
        ("illuminants/c.csv", 0.31006, 0.31616, 0.20089, 0.46089),
        ("illuminants/d50.csv", 0.34567, 0.35851, 0.20916, 0.48808),
        ("illuminants/d55.csv", 0.33243, 0.34744, 0.20443, 0.48075),
        ("illuminants/d65.csv", 0.31272, 0.32903, 0.19783, 0.46834),
        ("illuminants/d75.csv", 0.29903, 0.31488, 0.19353, 0.45853),
        ("illuminants/e.csv", 1.0 / 3.0, 1.0 / 3.0, 4.0 / 19.0, 9.0 / 19.0),
    ] {
        let [big_x, big_y, big_z] = observer.integrate(light(path).values());
        let xyz = Xyz::new(big_x, big_y, big_z);
        assert_xy(path, xyz.chromaticity().unwrap(), [x, y], 8e-5);
        let uv = xyz.uv_prime().unwrap();
        assert_near(path, uv.u, u, 8e-5);
        assert_near(path, uv.v, v, 8e-5);
    }
}

#[test]
fn the_spectral_locus_passes_through_the_published_points() {
    let locus = spectral_locus(&sensor(CIE_1931));
    // CIE 15:2004, Table T.4.
    for (nm, x, y) in [
        (400.0, 0.1733, 0.0048),
        (450.0, 0.1566, 0.0177),
        (480.0, 0.0913, 0.1327),
        (500.0, 0.0082, 0.5384),
        (520.0, 0.0743, 0.8338),
        (550.0, 0.3016, 0.6923),
        (580.0, 0.5125, 0.4866),
        (600.0, 0.6270, 0.3725),
        (700.0, 0.7347, 0.2653),
    ] {
        let point = locus.iter().find(|point| point.wavelength_nm == nm).unwrap();
        assert_xy(&format!("{nm} nm"), point.xy, [x, y], 5.1e-5);
    }
    assert_eq!(locus.len(), 401);
}

const RED: [f64; 3] = [53.232_882, 80.105_327, 67.222_782];

#[test]
fn lab_gives_published_and_exact_values() {
    // A mid gray of 18 % and its neighbors: L* = 116 ∛0.18 − 16 (CIE 15:2004, 8.2.1).
    let gray = lab_from_xyz(Xyz::new(0.18 * D65.x, 0.18, 0.18 * D65.z), D65).unwrap();
    assert_near("L*", gray.l, 49.496_1, 5e-5);
    assert_near("a*", gray.a, 0.0, 1e-13);
    assert_near("b*", gray.b, 0.0, 1e-13);
    let white = lab_from_xyz(D65, D65).unwrap();
    assert_near("white", white.l, 100.0, 1e-12);
    let black = lab_from_xyz(Xyz::new(0.0, 0.0, 0.0), D65).unwrap();
    assert_near("black", black.l, 0.0, 1e-12);
    // The linear part: L* = (29/3)³ Y/Yₙ.
    let dark = lab_from_xyz(Xyz::new(0.0, 0.005, 0.0), D65).unwrap();
    assert_near("dark", dark.l, (29.0_f64 / 3.0).powi(3) * 0.005, 1e-12);
    // Red of sRGB by Eq 13's four decimals, computed by hand: cube roots of 0.4124/0.9505, 0.2126, 0.0193/1.0890.
    let red = lab_from_xyz(Xyz::from_vector(XYZ_FROM_SRGB.col(0)), srgb_white()).unwrap();
    assert_near("L*", red.l, RED[0], 1e-6);
    assert_near("a*", red.a, RED[1], 1e-6);
    assert_near("b*", red.b, RED[2], 1e-6);
    assert_eq!(lab_from_xyz(D65, Xyz::new(0.0, 1.0, 1.0)), None);
}

#[test]
fn bradford_has_the_published_matrices() {
    // Lindbloom, Chromatic Adaptation: A → D65 and D65 → D50, from whites of ASTM E308.
    let (a, d65, d50) =
        (Xyz::new(1.0985, 1.0, 0.35585), Xyz::new(0.95047, 1.0, 1.08883), Xyz::new(0.96422, 1.0, 0.82521));
    let rows = |m: [[f64; 3]; 3]| DMat3::from_cols_array_2d(&m).transpose();
    let a_to_d65 = rows([
        [0.844_696_5, -0.117_922_5, 0.394_810_8],
        [-0.136_630_3, 1.104_122_6, 0.129_171_8],
        [0.079_848_9, -0.134_899_9, 3.192_400_9],
    ]);
    let d65_to_d50 = rows([
        [1.047_811_2, 0.022_886_6, -0.050_127_0],
        [0.029_542_4, 0.990_484_4, -0.017_049_1],
        [-0.009_234_5, 0.015_043_6, 0.752_131_6],
    ]);
    for (from, to, published, what) in [(a, d65, a_to_d65, "A to D65"), (d65, d50, d65_to_d50, "D65 to D50")] {
        let matrix = bradford(from, to).unwrap();
        let off = (matrix - published).to_cols_array().into_iter().fold(0.0_f64, |m, v| m.max(v.abs()));
        // Seven decimals are printed.
        assert!(off < 1.1e-7, "{what} off by {off}: {matrix}");
    }
    assert_eq!(bradford(Xyz::new(0.0, 0.0, 0.0), D65), None);
}

#[test]
fn srgb_encodes_as_the_standard_says() {
    // IEC 61966-2-1: 8-bit codes of linear values.
    for (linear, code) in [(0.0, 0), (0.003_130_8, 10), (0.18, 118), (0.2159, 128), (0.5, 188), (1.0, 255)] {
        assert_eq!(encode_srgb([linear; 3]).bytes, [code; 3], "{linear}");
        assert!(!encode_srgb([linear; 3]).clipped);
    }
    assert!(encode_srgb([1.01, 0.5, 0.5]).clipped && encode_srgb([0.5, -0.01, 0.5]).clipped);
    assert!(!encode_srgb([1.0 + 1e-9, -1e-9, 0.5]).clipped, "rounding is no clipping");
    for strange in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let encoded = encode_srgb([strange, 0.5, 1.0]);
        assert!(encoded.clipped && encoded.bytes == [0, 188, 255], "{strange}");
    }
}

#[test]
fn eq_13_and_its_inverses() {
    let white = srgb_white();
    assert_xy("white", white.chromaticity().unwrap(), [0.3127, 0.3290], 5e-5);
    assert!((XYZ_FROM_SRGB * DVec3::ONE - DVec3::new(0.9505, 1.0, 1.089)).abs().max_element() < 1e-15);
    let unit = srgb_from_xyz() * XYZ_FROM_SRGB;
    assert!((unit - DMat3::IDENTITY).to_cols_array().iter().all(|v| v.abs() < 1e-15));
    let apart = (srgb_from_xyz() - SRGB_FROM_XYZ_PUBLISHED).to_cols_array();
    assert!(apart.iter().all(|v| v.abs() < 5.1e-5), "{apart:?}");
    // The columns of Eq 13 are the primaries of sRGB.
    for (column, primary) in GAMUTS[0].primaries.iter().enumerate() {
        let xy = Xyz::from_vector(XYZ_FROM_SRGB.col(column)).chromaticity().unwrap();
        assert_xy("primary", xy, [primary.x, primary.y], 2e-4);
    }
}

#[test]
fn screen_colors_of_the_diagram_are_total() {
    let observer = sensor(CIE_1931);
    for nm in [f64::NAN, f64::NEG_INFINITY, -1e300, 380.0, 555.0, 780.0, 1e300] {
        let _ = wavelength_color(&observer, nm);
    }
    let [r, g, b] = wavelength_color(&observer, 520.0);
    assert!(g > r && g > b);
    for xy in [[0.0, 0.0], [f64::NAN, 0.3], [1e300, 1e-300], [-5.0, 1.0], [1.0 / 3.0, 0.0]] {
        let _ = area_color(Xy { x: xy[0], y: xy[1] });
    }
    let [r, g, b] = area_color(Xy { x: 0.3127, y: 0.3290 });
    assert!(r.abs_diff(g) <= 1 && g.abs_diff(b) <= 1 && r > 230, "white is neutral and bright: {r} {g} {b}");
}

#[test]
fn screen_colors_of_the_diagram_have_no_kinks() {
    // A kink at the edge of a screen's range changes the slope of a channel by tens of levels.
    let step = 0.004;
    for row in 10..200 {
        let y = step * f64::from(row);
        let colors: Vec<[u8; 3]> =
            (0..200).map(|i| step * f64::from(i)).filter(|x| x + y < 1.0).map(|x| area_color(Xy { x, y })).collect();
        for three in colors.windows(3) {
            for channel in 0..3 {
                let [a, b, c] = [0, 1, 2].map(|i| i32::from(three[i][channel]));
                assert!((a - 2 * b + c).abs() <= 3, "y {y}: {three:?}");
            }
        }
    }
}

/// Every finite number alike, the hostile ones among them.
fn any_finite() -> impl Strategy<Value = f64> {
    proptest::num::f64::NORMAL | proptest::num::f64::SUBNORMAL | proptest::num::f64::ZERO
}

fn a_lab() -> impl Strategy<Value = Lab> {
    (0.0..100.0, -120.0..120.0, -120.0..120.0).prop_map(|(l, a, b)| Lab { l, a, b })
}

fn any_lab() -> impl Strategy<Value = Lab> {
    (any_finite(), any_finite(), any_finite()).prop_map(|(l, a, b)| Lab { l, a, b })
}

/// Check values of colour-science 0.4 (`delta_E_CIE1994`, graphic arts), the first color as reference.
#[test]
fn delta_e_1994_gives_published_differences_and_weighs_by_the_reference() {
    let lab = |[l, a, b]: [f64; 3]| Lab { l, a, b };
    let reference = lab([100.0, 21.572_103_57, 272.228_193_5]);
    for (sample, expected) in [
        ([100.0, 426.679_453_53, 72.395_908_35], 83.779_225_500_887),
        ([100.0, 74.052_169_81, 276.453_181_93], 10.053_931_954_554),
        ([100.0, 8.322_819_57, -73.582_977_16], 57.535_453_706_667),
    ] {
        assert_near("ΔE*94", delta_e_1994(reference, lab(sample)), expected, 1e-11);
    }
    let (gray, vivid) = (lab([50.0, 0.0, 0.0]), lab([50.0, 100.0, 0.0]));
    assert_near("chroma of the gray", delta_e_1994(gray, vivid), 100.0, 1e-12);
    assert_near("chroma of the vivid", delta_e_1994(vivid, gray), 100.0 / 5.5, 1e-12);
}

#[test]
fn an_entry_of_the_table_is_all_that_a_metric_needs() {
    let reference = Stimulus::new(Xyz::new(0.2, 0.21, 0.19), D65);
    let samples = [[0.25, 0.21, 0.19], [0.2, 0.21, 0.3], [0.1, 0.21, 0.1]].map(|[x, y, z]| Xyz::new(x, y, z));
    for (index, &metric) in Metric::ALL.iter().enumerate() {
        let unique = |of: fn(&Metric) -> &str| Metric::ALL.iter().filter(|other| of(other) == of(&metric)).count() == 1;
        assert!(unique(|m| m.id) && unique(|m| m.column) && unique(|m| m.label) && unique(|m| m.symbol), "{metric:?}");
        assert!(metric.id.bytes().all(|b| b.is_ascii_lowercase() || b.is_ascii_digit() || b == b'-'), "{metric:?}");
        assert!(metric.column.starts_with("delta_") && metric.symbol.starts_with('Δ'), "{metric:?}");
        assert_eq!(Metric::by_id(metric.id), Some(Metric::ALL[index]));
        assert_eq!(metric.between(&reference, &reference), Some(0.0));
        for sample in samples {
            let difference = metric.between(&reference, &Stimulus::new(sample, D65)).unwrap();
            // Both a plain difference and a step of the last decimal show on the scale.
            assert!(
                difference > 0.5 * 0.1_f64.powi(i32::try_from(metric.decimals).unwrap()),
                "{metric:?}: {difference}"
            );
            assert!(difference > 0.05 * metric.full_scale && difference < 20.0 * metric.full_scale, "{metric:?}");
        }
        let dark = Stimulus::new(Xyz::new(0.0, 0.0, 0.0), Xyz::new(0.0, 1.0, 1.0));
        assert_eq!(metric.between(&dark, &reference), None, "undefined is no difference");
        let under_eq_13 = metric.name(true);
        assert!(!under_eq_13.contains("ΔE"), "Eq 13 has no CIE color difference");
        assert_eq!(under_eq_13 == metric.name(false), !metric.needs_adopted_white());
    }
    assert_eq!(Metric::by_id("delta-e"), None);
}

proptest! {
    #![proptest_config(cases(512))]

    #[test]
    fn differences_are_symmetric_and_zero_only_for_equal_colors(a in a_lab(), b in a_lab()) {
        for difference in [delta_e_1976, delta_e_2000] {
            let (ab, ba) = (difference(a, b), difference(b, a));
            prop_assert!((ab - ba).abs() <= 1e-12 * ab, "{ab} {ba}");
            prop_assert!(ab > 0.0 || a == b);
            prop_assert_eq!(difference(a, a), 0.0);
        }
    }

    #[test]
    fn differences_are_total(a in any_lab(), b in any_lab()) {
        for difference in [delta_e_1976, delta_e_1994, delta_e_2000] {
            prop_assert!(difference(a, b).is_finite());
            prop_assert!(difference(a, b) >= 0.0);
        }
    }

    #[test]
    fn huge_differences_are_not_taken_for_none(scale in 3.0..300.0) {
        let far = Lab { l: 50.0, a: 10.0_f64.powf(scale), b: 0.0 };
        let gray = Lab { l: 50.0, a: 0.0, b: 0.0 };
        prop_assert!(delta_e_2000(far, gray) > 1.0);
    }

    #[test]
    fn chromaticity_does_not_change_with_scale(x in 1e-3..1.0, y in 1e-3..1.0, z in 1e-3..1.0, exponent in -300.0..300.0) {
        let k = 10.0_f64.powf(exponent);
        let (a, b) = (Xyz::new(x, y, z), Xyz::new(k * x, k * y, k * z));
        let (p, q) = (a.chromaticity().unwrap(), b.chromaticity().unwrap());
        prop_assert!(p.distance(q) < 1e-15);
        prop_assert!((p.x - x / (x + y + z)).abs() < 1e-15);
        let (p, q) = (a.uv_prime().unwrap(), b.uv_prime().unwrap());
        prop_assert!(p.distance(q) < 1e-15);
        prop_assert!((p.u - 4.0 * x / (x + 15.0 * y + 3.0 * z)).abs() < 1e-15);
        prop_assert!((p.uv60().v - 6.0 * y / (x + 15.0 * y + 3.0 * z)).abs() < 1e-15);
    }

    #[test]
    fn the_diagrams_lead_to_one_another_and_back(x in 0.0..0.8, y in 0.01..0.9) {
        let xy = Xy { x, y };
        let uv = xy.uv_prime().unwrap();
        prop_assert!(uv.xy().unwrap().distance(xy) < 1e-13);
        let xyz = xy.with_unit_luminance().unwrap();
        prop_assert!(xyz.y == 1.0 && xyz.chromaticity().unwrap().distance(xy) < 1e-14);
        prop_assert!(xyz.uv_prime().unwrap().distance(uv) < 1e-14);
    }

    #[test]
    fn whatever_is_finite_has_a_finite_chromaticity_or_none(x in any_finite(), y in any_finite(), z in any_finite()) {
        let xyz = Xyz::new(x, y, z);
        if let Some(xy) = xyz.chromaticity() {
            prop_assert!(xy.x.is_finite() && xy.y.is_finite());
            prop_assert!(xy.uv_prime().is_none_or(|uv| uv.u.is_finite() && uv.v.is_finite()));
            let lifted = xy.with_unit_luminance();
            prop_assert!(lifted.is_none_or(|v| v.to_vector().is_finite()));
        }
        prop_assert!(xyz.uv_prime().is_none_or(|uv| uv.u.is_finite() && uv.v.is_finite()));
        let lab = lab_from_xyz(xyz, D65);
        prop_assert!(lab.is_none_or(|lab| lab.l.is_finite() && lab.a.is_finite() && lab.b.is_finite()));
        let _ = lab_from_xyz(D65, xyz);
        let _ = encode_srgb([x, y, z]);
        if let Some(matrix) = bradford(xyz, D65) {
            prop_assert!(matrix.is_finite());
        }
    }

    #[test]
    fn coordinates_of_any_size_give_finite_numbers_or_none(x in any_finite(), y in any_finite()) {
        let finite = |v: Option<DVec3>| v.is_none_or(DVec3::is_finite);
        let xy = Xy { x, y };
        prop_assert!(finite(xy.with_unit_luminance().map(Xyz::to_vector)));
        prop_assert!(finite(xy.uv_prime().map(|uv| DVec3::new(uv.u, uv.v, 0.0))));
        let uv = UvPrime { u: x, v: y };
        prop_assert!(finite(uv.xy().map(|xy| DVec3::new(xy.x, xy.y, 0.0))));
    }

    #[test]
    fn adaptation_carries_white_to_white(x in 0.7..1.2, z in 0.3..1.5) {
        let white = Xyz::new(x, 1.0, z);
        for (from, to) in [(white, D65), (A, white)] {
            let there = bradford(from, to).unwrap();
            prop_assert!((there * from.to_vector() - to.to_vector()).abs().max_element() < 1e-14);
            let back = bradford(to, from).unwrap() * there;
            prop_assert!((back - DMat3::IDENTITY).to_cols_array().iter().all(|v| v.abs() < 1e-13));
        }
    }

    #[test]
    fn the_transfer_function_and_its_inverse_agree(v in -0.2..2.0) {
        prop_assert!((srgb_inverse_transfer(srgb_transfer(v)) - v).abs() < 4e-8, "the standard's two pieces meet to 3e-8");
    }
}

#[test]
fn infinite_whites_and_adaptations_beyond_all_numbers_are_refused() {
    let usual = Xyz::new(0.95, 1.0, 1.09);
    assert_eq!(lab_from_xyz(usual, Xyz::new(0.95, 1.0, f64::INFINITY)), None);
    assert_eq!(bradford(Xyz::new(1.0, 0.0, 0.0), Xyz::new(f64::MAX, 0.0, 0.0)), None);
}
