//! The paper's first two experiments with the built-in data: what it claims, and how far it holds.
//!
//! C. P. Huynh and A. Robles-Kelly 2007. Unity balance, Eq 13, truth Stiles & Burch 1955 2°. Numbers of ours, within 3 %, come
//! from an independent computation.

use chromascope_core::correction::Correction;
use chromascope_core::camera::WhiteBalanceTarget;
use chromascope_core::colorimetry::lab::lab_from_xyz;
use chromascope_core::colorimetry::rgb::srgb_white;
use chromascope_core::colorimetry::rgb::{SRGB_FROM_XYZ_PUBLISHED, srgb_from_xyz};
use chromascope_core::colorimetry::{Xy, Xyz, delta_e_2000};
use chromascope_core::light::RadiationConstants;
use chromascope_core::patch_set::{PAPER_FIVE, PatchSet};
use chromascope_core::query::{
    Ask, ColorTransformSpec, Direct, LocusQuery, PatchColor, PatchColorsQuery, RenderingQuery, Shared, Temperatures,
};
use chromascope_core::spectral::{Primaries, Response, Sensor, SpectralDistribution};
use glam::DVec3;

use crate::support::{
    CANON_10D, CIE_1931, DCS200, NIKON_D70, REFERENCE, assert_near, assert_xy, by_paper, chart, dataset, kelvin, light,
    measured, patches, reference, sensor, sensors, training,
};

const D70_AMPAS: &str = "cameras/nikon_d70_a_m_p_a_s.csv";

/// ln T from 1000 to 20000 K, close enough for minima to 10 K.
fn temperatures() -> Vec<f64> {
    (0..=2000).map(|i| 1000.0 * 20.0_f64.powf(f64::from(i) / 2000.0)).collect()
}

fn locus_at(sensor: Sensor, temperatures: Temperatures) -> Vec<Xy> {
    let rendering = by_paper(&Shared::new(sensor));
    let query = LocusQuery { rendering, temperatures, constants: RadiationConstants::Paper };
    let locus = (*Direct.ask(&query)).clone().unwrap();
    locus.points.iter().map(|point| point.xy.unwrap()).collect()
}

fn locus(sensor: Sensor, temperatures: &[f64]) -> Vec<Xy> {
    locus_at(sensor, Temperatures::List(temperatures.iter().map(|&t| kelvin(t)).collect()))
}

/// A camera's distance to the reference over temperature.
struct Distances {
    t: Vec<f64>,
    d: Vec<f64>,
}

impl Distances {
    fn of(camera: Sensor, truth: &[Xy]) -> Self {
        let t = temperatures();
        let d = locus(camera, &t).iter().zip(truth).map(|(a, b)| a.distance(*b)).collect();
        Self { t, d }
    }

    fn named(camera: &str) -> Self {
        Self::of(sensor(camera), &locus(sensor(REFERENCE), &temperatures()))
    }

    fn minimum_at(&self) -> f64 {
        let at = (0..self.d.len()).min_by(|&a, &b| self.d[a].total_cmp(&self.d[b])).unwrap();
        self.t[at]
    }

    /// The mean over ln T, whose steps are even.
    fn mean(&self, from: f64, to: f64) -> f64 {
        let inside: Vec<f64> =
            self.t.iter().zip(&self.d).filter(|(t, _)| (from..=to).contains(*t)).map(|(_, d)| *d).collect();
        let n = inside.len();
        (inside.iter().sum::<f64>() - f64::midpoint(inside[0], inside[n - 1])) / (n - 1) as f64
    }

    fn best_around_daylight(&self) -> bool {
        let daylight = self.mean(5000.0, 6200.0);
        daylight < self.mean(4000.0, 5000.0) && daylight < self.mean(6200.0, 8000.0)
    }
}

#[track_caller]
fn assert_within_3_percent(what: &str, value: f64, printed: &str) {
    // Half of the last printed digit is the reference's own.
    let decimals = printed.split_once('.').map_or(0, |(_, digits)| digits.len());
    let half = 0.5 / 10.0_f64.powf(decimals as f64);
    let expected: f64 = printed.parse().unwrap();
    assert_near(what, value, expected, 0.03 * expected + half);
}

#[test]
fn the_papers_cameras_agree_best_around_daylight() {
    for (camera, minimum, band) in
        [(CANON_10D, 6031.0, "0.0037"), (NIKON_D70, 5950.0, "0.0028"), (DCS200, 5774.0, "0.0064")]
    {
        let distances = Distances::named(camera);
        let at = distances.minimum_at();
        assert!((5000.0..=6200.0).contains(&at), "{camera}: minimum at {at} K");
        assert_near(camera, at, minimum, 10.0);
        assert_within_3_percent(camera, distances.mean(5000.0, 6200.0), band);
        assert!(distances.best_around_daylight(), "{camera}");
    }
}

/// Unity balance makes a flat spectrum agree exactly, and the flattest blackbody lies there: so it says little about balance, and
/// holds for nearly every camera. One with unusual sensitivities may have its minimum elsewhere.
#[test]
fn nearly_every_camera_of_the_library_agrees_best_around_daylight() {
    let truth = locus(sensor(REFERENCE), &temperatures());
    let cameras = sensors("cameras");
    let count = cameras.len();
    let agrees = |camera: Sensor| {
        let distances = Distances::of(camera, &truth);
        (5000.0..=6200.0).contains(&distances.minimum_at()) && distances.best_around_daylight()
    };
    let around_daylight = cameras.into_iter().filter(|(_, camera)| agrees(camera.clone())).count();
    assert!(around_daylight * 10 >= count * 9, "{around_daylight} of {count}");
    // The extremes that the documentation names.
    assert_near("lowest minimum", Distances::named(DCS200).minimum_at(), 5775.0, 10.0);
    assert_near("highest minimum", Distances::named("cameras/canon_powershot_s90.csv").minimum_at(), 6137.0, 10.0);
}

#[test]
fn canon_and_nikon_are_nearer_than_the_kodak_over_the_whole_range() {
    for (camera, mean, at_1000, at_20000) in [
        (CANON_10D, "0.021", "0.017", "0.028"),
        (NIKON_D70, "0.021", "0.032", "0.024"),
        (DCS200, "0.081", "0.193", "0.060"),
    ] {
        let distances = Distances::named(camera);
        assert_within_3_percent(camera, distances.mean(1000.0, 20000.0), mean);
        assert_within_3_percent(camera, distances.d[0], at_1000);
        assert_within_3_percent(camera, distances.d[distances.d.len() - 1], at_20000);
    }
}

#[test]
fn the_kodak_is_nearer_than_the_canon_only_in_a_narrow_band() {
    let (kodak, canon) = (Distances::named(DCS200), Distances::named(CANON_10D));
    let nearer: Vec<f64> = (0..kodak.t.len()).filter(|&i| kodak.d[i] < canon.d[i]).map(|i| kodak.t[i]).collect();
    let (first, last) = (nearer[0], nearer[nearer.len() - 1]);
    assert!(nearer.windows(2).all(|pair| pair[1] / pair[0] < 1.0016), "one band");
    assert_near("from", first, 5605.0, 10.0);
    assert_near("to", last, 5837.0, 10.0);
    let nikon = Distances::named(NIKON_D70);
    assert!(canon.mean(1000.0, 20000.0) < kodak.mean(1000.0, 20000.0));
    assert!(nikon.mean(1000.0, 20000.0) < kodak.mean(1000.0, 20000.0));
}

#[test]
fn the_kodaks_locus_is_the_shortest() {
    let expected =
        [(REFERENCE, "0.387"), (CANON_10D, "0.348"), (NIKON_D70, "0.332"), (D70_AMPAS, "0.342"), (DCS200, "0.124")];
    let default = Temperatures::Range { from: kelvin(1000.0), to: kelvin(20000.0), count: 200 };
    let length = |points: Vec<Xy>| -> f64 { points.windows(2).map(|pair| pair[0].distance(pair[1])).sum() };
    for (name, expected) in expected {
        let fine = length(locus(sensor(name), &temperatures()));
        assert_within_3_percent(name, fine, expected);
        // The 200 points of the first screen are chords: short by less than 1e-4 of the length.
        let chords = length(locus_at(sensor(name), default.clone()));
        assert!(chords <= fine + 1e-6 && chords > fine * (1.0 - 1e-3), "{name}: {chords} against {fine}");
        if name != DCS200 {
            assert!(fine > 0.2);
        }
    }
}

fn patch_colors(path: &str, patches: PatchSet) -> Vec<([f64; 3], Xy)> {
    let rendering = by_paper(&Shared::new(sensor(path)));
    let colors = Direct.ask(&PatchColorsQuery { rendering, patches: Shared::new(patches) });
    (*colors).clone().unwrap().iter().map(|color| (color.rgb.unwrap(), color.xy.unwrap())).collect()
}

#[test]
fn a_perfect_white_is_exactly_white_through_every_camera() {
    let white = SpectralDistribution::new(vec![380.0, 780.0], vec![1.0, 1.0]).unwrap();
    for (path, _) in sensors("cameras") {
        let (rgb, xy) = patch_colors(&path, PatchSet::new([("perfect".to_owned(), white.clone())]))[0];
        assert_eq!(rgb, [1.0; 3], "{path}");
        assert_xy(&path, xy, [0.3127, 0.3290], 5e-5);
    }
}

#[test]
fn patches_differ_from_the_truth_as_computed_independently() {
    let five = chart().subset(&PAPER_FIVE);
    let truth = patch_colors(REFERENCE, five.clone());
    // Red, green, blue, white, orange yellow.
    let expected = [
        (CANON_10D, ["0.009", "0.049", "0.050", "", "0.027"]),
        (NIKON_D70, ["0.010", "0.033", "0.043", "", "0.027"]),
        (DCS200, ["0.111", "0.077", "0.087", "", "0.131"]),
    ];
    for (camera, expected) in expected {
        let colors = patch_colors(camera, five.clone());
        let distances: Vec<f64> = colors.iter().zip(&truth).map(|(a, b)| a.1.distance(b.1)).collect();
        assert!(distances[3] <= 0.0035, "{camera}: white patch off by {}", distances[3]);
        for patch in [0, 1, 2, 4] {
            assert_within_3_percent(&format!("{camera} {}", PAPER_FIVE[patch]), distances[patch], expected[patch]);
        }
        if camera == DCS200 {
            assert!([0, 1, 2, 4].iter().all(|&patch| distances[patch] > 0.07));
        } else {
            assert!(distances[0].max(distances[4]) < distances[1].min(distances[2]), "{camera}: {distances:?}");
        }
    }
}

#[test]
fn patches_match_fifty_digits() {
    for row in reference("patches.csv") {
        let (rgb, xy) = patch_colors(&row[0], chart().subset(&[&row[1]]))[0];
        let expected: Vec<f64> = row[2..].iter().map(|field| field.parse().unwrap()).collect();
        let what = format!("{} {}", row[0], row[1]);
        for channel in 0..3 {
            assert_near(&what, rgb[channel], expected[channel], 1e-14);
        }
        assert_xy(&what, xy, [expected[3], expected[4]], 1e-14);
    }
}

#[test]
fn eq_13_and_the_cie_observer_differ_by_construction() {
    let truth = locus(sensor(REFERENCE), &[5500.0, 1000.0]);
    let cie = locus(sensor(CIE_1931), &[5500.0, 1000.0]);
    assert_near("5500 K", truth[0].distance(cie[0]), 0.019, 0.0005);
    assert_near("1000 K", truth[1].distance(cie[1]), 0.099, 0.0005);
}

#[test]
fn white_of_d55_has_the_papers_twelve_digits() {
    // ASTM E308 and CIE 15: D55, 2°.
    let published = Xyz::new(0.95682, 1.0, 0.92149);
    let round = |v: [f64; 3]| v.map(|v| (v * 1e4).round() / 1e4);
    assert_eq!(round(WhiteBalanceTarget::from_xyz(published).0), [1.1040, 0.9870, 0.8233]);
    let exact = srgb_from_xyz() * published.to_vector();
    assert_eq!(round(exact.to_array()), [1.1040, 0.9869, 0.8233]);
    assert!((SRGB_FROM_XYZ_PUBLISHED * published.to_vector() - exact).abs().max_element() < 7.9e-5);
    // The published white is a 5 nm sum that begins below 380 nm; with our tables it gives the same digits.
    assert_eq!(round(WhiteBalanceTarget::from_xyz(five_nm_white()).0), [1.1040, 0.9870, 0.8233]);
    let own = WhiteBalanceTarget::from_light(&dataset("illuminants/d55.csv").curves[0], &sensor(CIE_1931)).unwrap();
    assert_eq!(round(own.0), [1.1040, 0.9870, 0.8233]);
    // A blackbody of 5500 K is no D55.
    let radiator = chromascope_core::light::planckian::black_body(kelvin(5500.0), RadiationConstants::Paper);
    let glow = WhiteBalanceTarget::from_light(&measured(&radiator), &sensor(CIE_1931)).unwrap();
    assert!((DVec3::from_array(glow.0) - DVec3::from_array(own.0)).abs().max_element() > 0.03);
}

/// D55 at Y = 1 by the 5 nm sum from 360 to 780 nm.
fn five_nm_white() -> Xyz {
    let (d55, observer) = (dataset("illuminants/d55.csv"), dataset(CIE_1931));
    let at = |curve: &SpectralDistribution, nm: f64| -> f64 {
        let index = curve.wavelengths_nm().iter().position(|&w| w == nm).unwrap();
        curve.values()[index]
    };
    let sums = [0, 1, 2].map(|c: usize| -> f64 {
        let wavelengths = (72..=156).map(|i| 5.0 * f64::from(i));
        wavelengths.map(|nm| at(&d55.curves[0], nm) * at(&observer.curves[c], nm)).sum()
    });
    Xyz::new(sums[0] / sums[1], 1.0, sums[2] / sums[1])
}

/// Cameras through 3×3 matrices fitted to CIE 1931 2° under a light.
fn fitted(path: &str, illuminant: &str) -> RenderingQuery {
    RenderingQuery {
        sensor: Shared::new(sensor(path)),
        light: Shared::new(light(illuminant)),
        white: WhiteBalanceTarget::UNITY,
        transform: ColorTransformSpec::Observer {
            reference: Shared::new(sensor(CIE_1931)),
            training: Shared::new(training()), correction: Correction::default(),
        },
    }
}

fn colors(rendering: RenderingQuery, patches: &PatchSet) -> Vec<PatchColor> {
    (*Direct.ask(&PatchColorsQuery { rendering, patches: Shared::new(patches.clone()) })).clone().unwrap()
}

/// The README says "in xy": by a color difference that is one, red is the worst of the five.
#[test]
fn red_and_orange_yellow_are_nearer_only_in_chromaticity_by_eq_13() {
    let five = chart().subset(&PAPER_FIVE);
    let truth = colors(by_paper(&Shared::new(sensor(REFERENCE))), &five);
    let reference = colors(fitted(CIE_1931, "illuminants/d65.csv"), &five);
    for (camera, red, green, blue, orange_yellow) in
        [(CANON_10D, 3.04, 1.11, 0.92, 0.90), (NIKON_D70, 2.16, 1.11, 1.27, 0.73)]
    {
        let own = colors(by_paper(&Shared::new(sensor(camera))), &five);
        let uv = |patch: usize| own[patch].uv.unwrap().distance(truth[patch].uv.unwrap());
        assert!(uv(0).max(uv(4)) < uv(1).min(uv(2)), "{camera}: u′v′ by Eq 13");
        let own = colors(fitted(camera, "illuminants/d65.csv"), &five);
        let expected = [red, green, blue, f64::NAN, orange_yellow];
        for patch in [0, 1, 2, 4] {
            let difference = delta_e_2000(own[patch].lab.unwrap(), reference[patch].lab.unwrap());
            assert_near(&format!("{camera} {}", PAPER_FIVE[patch]), difference, expected[patch], 0.006);
        }
        assert!(red > green.max(blue), "{camera}: red is no nearer");
    }
}

/// L* 50 for the reference, by scaling the reflectance.
fn at_lightness_50(rendering: &RenderingQuery, material: &PatchSet) -> PatchSet {
    let scaled = |factor: f64| {
        let patch = &material.patches()[0];
        PatchSet::new([(patch.name.clone(), patch.measured.map(|_, v| v * factor).unwrap())])
    };
    let (mut low, mut high) = (0.01, 20.0);
    for _ in 0..60 {
        let middle = f64::midpoint(low, high);
        if colors(rendering.clone(), &scaled(middle))[0].lab.unwrap().l > 50.0 {
            high = middle;
        } else {
            low = middle;
        }
    }
    scaled(low)
}

/// Skin seems worse than leaves because it is lighter: at equal lightness the two are nearly the same, and by the fitted transform
/// the leaf is worse.
#[test]
fn skin_against_leaf_compares_lightness() {
    let skin = patches("materials/skin_vrhel.csv").subset(&["Skin Caucasian mean (Vrhel)"]);
    let leaf = patches("materials/leaves_vrhel.csv").subset(&["Fern-like bush leaf 024 (Vrhel)"]);
    let sun = "illuminants/direct_sun_astm_g173.csv";
    let d55 = WhiteBalanceTarget::from_light(&dataset("illuminants/d55.csv").curves[0], &sensor(CIE_1931)).unwrap();
    let eq_13 = |path: &str| RenderingQuery {
        light: Shared::new(light(sun)),
        white: d55,
        ..by_paper(&Shared::new(sensor(path)))
    };
    let difference = |a: RenderingQuery, b: RenderingQuery, material: &PatchSet| {
        let (a, b) = (colors(a, material)[0], colors(b, material)[0]);
        // As before Lab's adopted white followed the balance: the white of sRGB.
        let d65 = |xyz: Xyz| lab_from_xyz(xyz, srgb_white()).unwrap();
        [delta_e_2000(a.lab.unwrap(), b.lab.unwrap()), delta_e_2000(d65(a.xyz), d65(b.xyz))]
    };
    // Eq 13 with the adopted white of the balance, Eq 13 with D65, fitted; skin and leaf each.
    for (camera, own, in_d65, by_fit) in [
        (CANON_10D, [4.41, 4.30], [3.95, 3.91], [2.19, 3.22]),
        (NIKON_D70, [4.08, 3.31], [3.64, 3.02], [1.49, 2.43]),
        (D70_AMPAS, [3.91, 3.17], [f64::NAN; 2], [1.00, 1.55]),
    ] {
        for (index, material) in [&skin, &leaf].into_iter().enumerate() {
            let equal = at_lightness_50(&eq_13(REFERENCE), material);
            let [now, before] = difference(eq_13(REFERENCE), eq_13(camera), &equal);
            let what = format!("{camera} {}", material.patches()[0].name);
            assert_near(&what, now, own[index], 0.006);
            if in_d65[index].is_finite() {
                assert_near(&format!("{what}, D65"), before, in_d65[index], 0.03);
            }
            let equal = at_lightness_50(&fitted(CIE_1931, sun), material);
            let [now, _] = difference(fitted(CIE_1931, sun), fitted(camera, sun), &equal);
            assert_near(&format!("{what}, fitted"), now, by_fit[index], 0.006);
        }
    }
}

/// The minimum near daylight is the balance speaking: balanced to A, every camera agrees best at A.
#[test]
fn the_minimum_follows_the_balance() {
    let along = |rendering: RenderingQuery| -> Vec<Xy> {
        let temperatures = Temperatures::List(temperatures().iter().map(|&t| kelvin(t)).collect());
        let locus = Direct.ask(&LocusQuery { rendering, temperatures, constants: RadiationConstants::Paper });
        (*locus).clone().unwrap().points.iter().map(|point| point.xy.unwrap()).collect()
    };
    let a = "illuminants/a.csv";
    let reference = along(fitted(CIE_1931, a));
    for camera in [CANON_10D, NIKON_D70, D70_AMPAS, DCS200] {
        let own = along(fitted(camera, a));
        let d = own.iter().zip(&reference).map(|(a, b)| a.distance(*b)).collect();
        assert_near(camera, Distances { t: temperatures(), d }.minimum_at(), 2858.0, 6.0);
    }
    // The white-balance target is no balance of loci: it multiplies the camera's signals and the reference's alike.
    let target = WhiteBalanceTarget::from_light(&dataset(a).curves[0], &sensor(CIE_1931)).unwrap();
    let with_target = |path: &str| along(RenderingQuery { white: target, ..by_paper(&Shared::new(sensor(path))) });
    let d = with_target(NIKON_D70).iter().zip(with_target(REFERENCE)).map(|(a, b)| a.distance(b)).collect();
    assert_near("target A, Eq 13", Distances { t: temperatures(), d }.minimum_at(), 5944.0, 20.0);
}

#[test]
fn the_kodaks_skin_is_less_saturated() {
    let skin = patches("materials/skin_vrhel.csv").subset(&["Skin Caucasian mean (Vrhel)"]);
    let d55 = WhiteBalanceTarget::from_light(&dataset("illuminants/d55.csv").curves[0], &sensor(CIE_1931)).unwrap();
    let sun = Shared::new(light("illuminants/direct_sun_astm_g173.csv"));
    for (path, expected) in [(REFERENCE, 0.66), (CANON_10D, 0.61), (NIKON_D70, 0.61), (DCS200, 0.44)] {
        let rendering = RenderingQuery { light: sun.clone(), white: d55, ..by_paper(&Shared::new(sensor(path))) };
        let [r, g, b] = colors(rendering, &skin)[0].linear;
        let (high, low) = (r.max(g).max(b), r.min(g).min(b));
        assert_near(path, (high - low) / high, expected, 0.006);
    }
}

/// A camera's table without what lies beyond a wavelength.
fn cut(path: &str, last: f64) -> Sensor {
    let curves: Vec<SpectralDistribution> = dataset(path)
        .curves
        .iter()
        .map(|curve| {
            let samples = curve.wavelengths_nm().iter().zip(curve.values()).filter(|(nm, _)| **nm <= last);
            let (nm, values) = samples.map(|(nm, value)| (*nm, *value)).unzip();
            SpectralDistribution::new(nm, values).unwrap()
        })
        .collect();
    Sensor::new(Primaries::Camera, curves.try_into().unwrap(), Response::PerEnergy).unwrap()
}

/// Two thirds of the D70's distance at 1000 K is the size of what a table's end at 700 nm does there.
#[test]
fn below_2500_k_a_table_that_ends_at_700_nm_misses_its_tail() {
    let t = [1000.0, 1500.0, 2000.0, 2500.0, 3000.0, 6500.0];
    let (truth, whole, short) =
        (locus(sensor(REFERENCE), &t), locus(sensor(D70_AMPAS), &t), locus(cut(D70_AMPAS, 700.0), &t));
    let moved: Vec<f64> = whole.iter().zip(&short).map(|(a, b)| a.distance(*b)).collect();
    let (measured, figure) = (truth[0].distance(whole[0]), truth[0].distance(locus(sensor(NIKON_D70), &t)[0]));
    assert_near("moved at 1000 K", moved[0], 0.0213, 1e-4);
    assert_near("share of the measured table's distance", moved[0] / measured, 0.64, 0.01);
    assert_near("share of the 2007 figure's distance", moved[0] / figure, 0.67, 0.015);
    // It moves the point, but not away: the whole table is no nearer to the reference.
    assert!(truth[0].distance(short[0]) < measured);
    assert_near("moved at 1500 K", moved[1], 0.0047, 1e-4);
    assert!(moved.windows(2).all(|pair| pair[1] < pair[0]), "{moved:?}");
    assert!(moved[2] > 0.001 && moved[3..].iter().all(|d| *d < 0.001), "{moved:?}");
    for (table, below) in [(cut(D70_AMPAS, 700.0), Some(2500.0)), (cut(D70_AMPAS, 715.0), Some(2500.0))] {
        assert_eq!(table.extrapolated_below_k(), below);
    }
    for whole in [cut(D70_AMPAS, 720.0), sensor(D70_AMPAS), sensor(REFERENCE), sensor(CIE_1931)] {
        assert_eq!(whole.extrapolated_below_k(), None);
    }
    let short = sensors("cameras").into_iter().filter(|(_, camera)| camera.extrapolated_below_k().is_some());
    assert_eq!(short.count(), 4, "cameras whose tables end before 720 nm");
}
