//! Tests of queries: their equality, and that their answers equal the direct computations.

use std::hash::{DefaultHasher, Hash, Hasher};

use chromascope_core::camera::{ColorTransform, Rendering, RenderingError, WhiteBalanceTarget};
use chromascope_core::colorimetry::rgb::{XYZ_FROM_SRGB, encode_srgb};
use chromascope_core::colorimetry::{Metric, Xyz};
use chromascope_core::correction::Correction;
use chromascope_core::light::RadiationConstants;
use chromascope_core::light::planckian::exitance;
use chromascope_core::patch_set::PAPER_FIVE;
use chromascope_core::query::compare::{comparable_by_paper, difference};
use chromascope_core::query::{
    Ask, ColorTransformSpec, DifferenceError, Direct, LocusQuery, MonochromaticQuery, PatchColorsQuery,
    RadiatorSignalsQuery, RenderingQuery, Shared, SpectralLocusQuery, Temperatures,
};
use chromascope_core::spectral::grid::{COUNT, wavelength_nm};
use chromascope_core::spectral::{GridSpectrum, Primaries};
use chromascope_core::units::Kelvin;
use glam::DVec3;
use proptest::prelude::*;

use crate::support::{
    CANON_10D, CIE_1931, DCS200, REFERENCE, assert_near, by_paper, cases, chart, kelvin, light, sensor, training,
};

fn hash(value: &impl Hash) -> u64 {
    let mut hasher = DefaultHasher::new();
    value.hash(&mut hasher);
    hasher.finish()
}

#[test]
fn shared_values_are_equal_when_their_contents_are() {
    let first = Shared::new(sensor(CANON_10D));
    let same = first.clone();
    let anew = Shared::new(sensor(CANON_10D));
    let other = Shared::new(sensor(DCS200));
    assert_eq!(first, same);
    assert_eq!(first, anew);
    assert_ne!(first, other);
    assert_eq!(hash(&first), hash(&anew));
    assert_eq!(first.integrals(), anew.integrals());
}

/// Value with a constant hash, so that only the contents distinguish two of them.
#[derive(PartialEq, Eq)]
struct Colliding(u8);

impl Hash for Colliding {
    fn hash<H: Hasher>(&self, _: &mut H) {}
}

#[test]
fn equal_hashes_alone_are_not_trusted() {
    assert!(Shared::new(Colliding(1)) != Shared::new(Colliding(2)));
    assert!(Shared::new(Colliding(1)) == Shared::new(Colliding(1)));
}

#[test]
fn questions_differ_when_anything_they_depend_on_does() {
    let base = by_paper(&Shared::new(sensor(CANON_10D)));
    assert_eq!(base, by_paper(&Shared::new(sensor(CANON_10D))));
    let lit = RenderingQuery { light: Shared::new(light("illuminants/a.csv")), ..base.clone() };
    let white = RenderingQuery { white: WhiteBalanceTarget([1.1040, 0.9870, 0.8233]), ..base.clone() };
    let reference = Shared::new(sensor(CIE_1931));
    let fitted = ColorTransformSpec::Observer {
        reference,
        training: Shared::new(training()),
        correction: Correction::default(),
    };
    let transform = RenderingQuery { transform: fitted, ..base.clone() };
    for other in [lit, white, transform, by_paper(&Shared::new(sensor(DCS200)))] {
        assert!(base != other);
        assert_ne!(hash(&base), hash(&other));
    }
    let (plus, minus) = (WhiteBalanceTarget([0.0, 1.0, 1.0]), WhiteBalanceTarget([-0.0, 1.0, 1.0]));
    assert_eq!((plus, hash(&plus)), (minus, hash(&minus)));
}

proptest! {
    #![proptest_config(cases(256))]

    #[test]
    fn temperatures_are_even_in_reciprocal(from in 1.0..1e6, to in 1.0..1e6, count in 3_usize..400) {
        let (from, to) = (kelvin(from), kelvin(to));
        let all = Temperatures::Range { from, to, count }.to_vec();
        prop_assert_eq!(all.len(), count);
        prop_assert_eq!((all[0], all[count - 1]), (from, to));
        let step = (to.mired() - from.mired()) / (count - 1) as f64;
        let size = from.mired().max(to.mired());
        for pair in all.windows(2) {
            prop_assert!((pair[1].mired() - pair[0].mired() - step).abs() < 1e-14 * size);
        }
    }

    #[test]
    fn units_hold_what_is_positive_and_finite(value in proptest::num::f64::ANY) {
        let good = value.is_finite() && value > 0.0;
        prop_assert_eq!(Kelvin::new(value).is_ok(), good);
        if let (Ok(a), Ok(b)) = (Kelvin::new(value), Kelvin::new(value)) {
            prop_assert!(a == b && hash(&a) == hash(&b) && a.cmp(&b).is_eq());
        }
    }
}

#[test]
fn few_temperatures() {
    let range = |count| Temperatures::Range { from: kelvin(2000.0), to: kelvin(9000.0), count }.to_vec();
    assert_eq!(range(0), []);
    assert_eq!(range(1), [kelvin(2000.0)]);
    assert_eq!(range(2), [kelvin(2000.0), kelvin(9000.0)]);
    let list = vec![kelvin(9000.0), kelvin(10.0), kelvin(9000.0)];
    assert_eq!(Temperatures::List(list.clone()).to_vec(), list);
}

/// Eq 16 and Eq 13 written out.
fn patch_by_hand(path: &str, s: &GridSpectrum, l: &GridSpectrum, white: [f64; 3]) -> ([f64; 3], Xyz) {
    let camera = sensor(path);
    let rgb = [0, 1, 2].map(|c: usize| {
        let (mut above, mut below) = (0.0, 0.0);
        for i in 0..COUNT {
            above += camera.weighted(c)[i] * s.values()[i] * l.values()[i];
            below += camera.weighted(c)[i] * l.values()[i];
        }
        white[c] * above / below
    });
    (rgb, Xyz::from_vector(XYZ_FROM_SRGB * DVec3::from_array(rgb)))
}

#[test]
fn patch_colors_are_eq_16_and_13_written_out() {
    let (lit, white) = (light("illuminants/a.csv"), [1.1040, 0.9870, 0.8233]);
    let five = chart().subset(&PAPER_FIVE);
    assert_eq!(five.patches().len(), 5);
    for path in [CANON_10D, REFERENCE] {
        let rendering = RenderingQuery {
            sensor: Shared::new(sensor(path)),
            light: Shared::new(lit.clone()),
            white: WhiteBalanceTarget(white),
            transform: ColorTransformSpec::Paper,
        };
        let colors =
            (*Direct.ask(&PatchColorsQuery { rendering, patches: Shared::new(five.clone()) })).clone().unwrap();
        for (patch, color) in five.patches().iter().zip(&colors) {
            let (rgb, xyz) = patch_by_hand(path, &patch.grid, &lit, white);
            let found = color.rgb.unwrap();
            assert!(rgb.iter().zip(found).all(|(a, b)| (a - b).abs() < 1e-14), "{path} {}", patch.name);
            assert!((xyz.to_vector() - color.xyz.to_vector()).abs().max_element() < 1e-14);
            assert!(color.xy.unwrap().distance(xyz.chromaticity().unwrap()) < 1e-14);
            assert!(color.uv.unwrap().distance(xyz.uv_prime().unwrap()) < 1e-14);
            // Eq 13 takes RGB as linear sRGB; the adopted white is that of a perfect diffuser, which takes `white`.
            assert!(found.iter().zip(color.linear).all(|(a, b)| (a - b).abs() < 1e-14));
            assert_eq!(color.srgb, encode_srgb(color.linear));
            let lab = chromascope_core::colorimetry::lab::lab_from_xyz(
                xyz,
                Xyz::from_vector(XYZ_FROM_SRGB * DVec3::from_array(white)),
            )
            .unwrap();
            assert_near("L*", color.lab.unwrap().l, lab.l, 1e-11);
        }
    }
}

#[test]
fn fitted_renderings_share_their_targets_and_nothing_else_changes() {
    let (reference, training) = (Shared::new(sensor(CIE_1931)), Shared::new(training()));
    let light = Shared::new(light("illuminants/a.csv"));
    let by_hand =
        ColorTransform::Observer { reference: &reference, training: &training, correction: Correction::default() };
    for path in [CANON_10D, REFERENCE, CIE_1931] {
        let transform = ColorTransformSpec::Observer {
            reference: reference.clone(),
            training: training.clone(),
            correction: Correction::default(),
        };
        let query = RenderingQuery {
            sensor: Shared::new(sensor(path)),
            light: light.clone(),
            white: WhiteBalanceTarget::UNITY,
            transform,
        };
        assert_eq!(
            *Direct.ask(&query),
            Rendering::new(&query.sensor, &light, WhiteBalanceTarget::UNITY, by_hand),
            "{path}"
        );
    }
    let dark = Shared::new(GridSpectrum::constant(0.0));
    let transform = ColorTransformSpec::Observer {
        reference: reference.clone(),
        training: training.clone(),
        correction: Correction::default(),
    };
    let query = RenderingQuery {
        sensor: Shared::new(sensor(CANON_10D)),
        light: dark,
        white: WhiteBalanceTarget::UNITY,
        transform,
    };
    assert_eq!(*Direct.ask(&query), Err(RenderingError::BlindToLight { channel: 0 }));
}

#[test]
fn loci_are_eq_15_and_13_written_out() {
    let constants = RadiationConstants::Si2019;
    let list: Vec<Kelvin> = [20_000.0, 1500.0, 5500.0].map(kelvin).to_vec();
    for path in [CANON_10D, REFERENCE, CIE_1931] {
        let source = Shared::new(sensor(path));
        let query =
            LocusQuery { rendering: by_paper(&source), temperatures: Temperatures::List(list.clone()), constants };
        let locus = (*Direct.ask(&query)).clone().unwrap();
        let raw =
            Direct.ask(&RadiatorSignalsQuery { sensor: source.clone(), temperatures: query.temperatures, constants });
        assert_eq!(locus.method, raw.method);
        for (point, t) in locus.points.iter().zip(&list) {
            assert_eq!(point.temperature, *t);
            let spectrum = GridSpectrum::from_fn(|nm| exitance(nm, *t, constants));
            let signals = DVec3::from_array(source.integrate(spectrum.values()));
            let xyz = match source.primaries() {
                Primaries::Xyz => signals,
                _ => XYZ_FROM_SRGB * (signals / DVec3::from_array(source.integrals())),
            };
            let xy = Xyz::from_vector(xyz).chromaticity().unwrap();
            assert!(point.xy.unwrap().distance(xy) < 1e-12, "{path} {t}");
            assert!(point.uv.unwrap().distance(xy.uv_prime().unwrap()) < 1e-12);
        }
        let steps: f64 = locus.points.windows(2).map(|p| p[0].xy.unwrap().distance(p[1].xy.unwrap())).sum();
        assert_near("length", locus.length_xy(), steps, 0.0);
    }
}

#[test]
fn monochromatic_light_is_the_sensitivities_balanced() {
    let source = Shared::new(sensor(CANON_10D));
    let points = (*Direct.ask(&MonochromaticQuery { rendering: by_paper(&source) })).clone().unwrap();
    let point = points.iter().find(|point| point.wavelength_nm == 550.0).unwrap();
    let signals = DVec3::from_array(source.at_index(170)) / DVec3::from_array(source.integrals());
    let xy = Xyz::from_vector(XYZ_FROM_SRGB * signals).chromaticity().unwrap();
    assert!(point.xy.distance(xy) < 1e-14);
    assert!(points.iter().all(|point| (400.0..=700.0).contains(&point.wavelength_nm)));
    // A CIE observer's is the outline of the diagram, where its response is not next to nothing.
    let observer = Shared::new(sensor(CIE_1931));
    let outline = Direct.ask(&SpectralLocusQuery { observer: observer.clone() });
    let own = (*Direct.ask(&MonochromaticQuery { rendering: by_paper(&observer) })).clone().unwrap();
    assert!(own.len() > 250 && own.len() < outline.len());
    for point in own {
        let index = outline.iter().position(|o| o.wavelength_nm == point.wavelength_nm).unwrap();
        assert!(outline[index].xy.distance(point.xy) < 1e-14);
    }
    assert_eq!(wavelength_nm(170), 550.0);
}

#[test]
fn a_question_without_an_answer_says_why_everywhere() {
    let cones = Shared::new(sensor("observers/cie_2006_2deg_cone_fundamentals.csv"));
    let rendering = by_paper(&cones);
    let constants = RadiationConstants::Paper;
    let locus = LocusQuery { rendering: rendering.clone(), temperatures: Temperatures::List(vec![]), constants };
    assert_eq!(*Direct.ask(&locus), Err(RenderingError::ConesNeedObserver));
    assert_eq!(
        *Direct.ask(&MonochromaticQuery { rendering: rendering.clone() }),
        Err(RenderingError::ConesNeedObserver)
    );
    let patches = Shared::new(chart());
    assert_eq!(*Direct.ask(&PatchColorsQuery { rendering, patches }), Err(RenderingError::ConesNeedObserver));
}

#[test]
fn cie_observers_are_not_compared_with_what_eq_13_draws() {
    use Primaries::{Camera, Cones, Rgb, Xyz};
    for (a, b, allowed) in [
        (Camera, Camera, true),
        (Camera, Rgb, true),
        (Rgb, Rgb, true),
        (Xyz, Xyz, true),
        (Xyz, Camera, false),
        (Xyz, Rgb, false),
        (Cones, Camera, true),
    ] {
        let expected = if allowed { Ok(()) } else { Err(DifferenceError::Ways) };
        assert_eq!(comparable_by_paper(a, b), expected, "{a:?} {b:?}");
        assert_eq!(comparable_by_paper(b, a), expected, "{b:?} {a:?}");
    }
}

#[test]
fn differences_are_between_what_is_there() {
    let ask = |path: &str| {
        let rendering = by_paper(&Shared::new(sensor(path)));
        (*Direct.ask(&PatchColorsQuery { rendering, patches: Shared::new(chart()) })).clone().unwrap()
    };
    let (a, b) = (ask(CANON_10D)[14], ask(REFERENCE)[14]);
    let distance = a.xy.unwrap().distance(b.xy.unwrap());
    assert_eq!(difference(Metric::XY, &a, &b), Ok(distance));
    assert_eq!(difference(Metric::UV_PRIME, &a, &b), Ok(a.uv.unwrap().distance(b.uv.unwrap())));
    for &metric in Metric::ALL {
        assert_eq!(difference(metric, &a, &a), Ok(0.0));
        assert!(difference(metric, &a, &b).unwrap() > 0.0);
    }
    let mut dark = b;
    (dark.xy, dark.uv, dark.lab) = (None, None, None);
    assert_eq!(difference(Metric::XY, &a, &dark), Err(DifferenceError::NoChromaticity));
    assert_eq!(difference(Metric::DELTA_E_2000, &a, &dark), Err(DifferenceError::NoLab));
    let query = LocusQuery {
        rendering: by_paper(&Shared::new(sensor(REFERENCE))),
        temperatures: Temperatures::List(vec![kelvin(2000.0), kelvin(3000.0)]),
        constants: RadiationConstants::Paper,
    };
    let points = (*Direct.ask(&query)).clone().unwrap().points;
    assert_eq!(difference(Metric::XY, &points[0], &points[0]), Ok(0.0));
    assert!(difference(Metric::UV_PRIME, &points[0], &points[1]).unwrap() > 0.0);
    let mut gap = points[1];
    gap.xy = None;
    assert_eq!(difference(Metric::XY, &points[0], &gap), Err(DifferenceError::NoChromaticity));
}
