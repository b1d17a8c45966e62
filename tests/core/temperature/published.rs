//! The approximations that others published: their own examples, how good they claim to be, and where they end.

use super::{LOCUS, reference_colors};
use crate::support::{CIE_1931, REFERENCE, assert_near, kelvin, sensor};
use chromascope_core::colorimetry::{Uv60, Xy};
use chromascope_core::light::temperature::published::{Ohno, Robertson, hernandez_andres_1999, mccamy_1992};
use chromascope_core::light::{CctError, LocusError, RadiationConstants};

const D65: Xy = Xy { x: 0.3127, y: 0.3290 };

fn xy(color: Uv60) -> Xy {
    // x = 3u / (2u − 8v + 4), y = 2v / (2u − 8v + 4).
    let d = 2.0 * color.u - 8.0 * color.v + 4.0;
    Xy { x: 3.0 * color.u / d, y: 2.0 * color.v / d }
}

fn robertson() -> Robertson {
    Robertson::new(&sensor(CIE_1931), RadiationConstants::Paper).unwrap()
}

fn ohno() -> Ohno {
    Ohno::new(&sensor(CIE_1931), RadiationConstants::Paper).unwrap()
}

#[test]
fn formulas_give_their_documented_examples() {
    // colour-science 0.4: xy_to_CCT_McCamy1992, xy_to_CCT_Hernandez1999.
    assert_near("McCamy", mccamy_1992(D65).unwrap().get(), 6_505.080_591_307_478, 1e-8);
    assert_near("Hernández-Andrés", hernandez_andres_1999(D65).unwrap().get(), 6_500.742_043_178_653, 1e-8);
}

#[test]
fn formulas_are_as_good_as_claimed_on_the_locus() {
    for step in 0..=400 {
        let t = 2860.0 + 9.09 * f64::from(step);
        let color = xy(LOCUS.at(kelvin(t)).unwrap());
        assert_near("McCamy", mccamy_1992(color).unwrap().get() / t, 1.0, 3e-3);
        let t = 3100.0 + 40.0 * f64::from(step);
        let color = xy(LOCUS.at(kelvin(t)).unwrap());
        assert_near("Hernández-Andrés", hernandez_andres_1999(color).unwrap().get() / t, 1.0, 0.02);
    }
}

#[test]
fn formulas_end_where_they_were_published_to_end() {
    let on = |t: f64| xy(LOCUS.at(kelvin(t)).unwrap());
    assert_eq!(mccamy_1992(on(2800.0)), Err(CctError::TooCold));
    assert_eq!(mccamy_1992(on(6600.0)), Err(CctError::TooHot));
    assert_eq!(hernandez_andres_1999(on(2500.0)), Err(CctError::TooCold));
    for formula in [mccamy_1992, hernandez_andres_1999] {
        assert_eq!(formula(Xy { x: f64::NAN, y: 0.3 }), Err(CctError::NoChromaticity));
        assert_eq!(formula(Xy { x: 0.3, y: 0.1 }), Err(CctError::TooFar));
        for x in [-1e300, -1.0, 0.0, 1.0, 1e300] {
            for y in [0.173_501, 0.1859, 0.3, 1e300] {
                assert!(formula(Xy { x, y }).is_ok_and(|t| t.get().is_finite()) || formula(Xy { x, y }).is_err());
            }
        }
    }
}

#[test]
fn tabulated_methods_are_near_the_truth_in_their_range() {
    let (robertson, ohno) = (robertson(), ohno());
    for (t, duv, color) in reference_colors() {
        let what = format!("{t} K, {duv}");
        // A color on the very limit may go over it.
        if duv.abs() == 0.05 {
            continue;
        }
        if t > 1667.0 {
            let found = robertson.cct(color).unwrap_or_else(|e| panic!("{what}: {e}"));
            assert_near(&what, found.temperature.mired(), 1e6 / t, 0.5);
        }
        let found = ohno.cct(color).unwrap_or_else(|e| panic!("{what}: {e}"));
        assert_near(&what, found.temperature.get() / t, 1.0, if duv == 0.0 { 5e-5 } else { 4e-4 });
        assert_near(&what, found.duv, duv, 1e-4);
    }
}

#[test]
fn tabulated_methods_refuse_what_is_outside() {
    let (robertson, ohno) = (robertson(), ohno());
    let on = |t: f64| LOCUS.at(kelvin(t)).unwrap();
    assert_eq!(robertson.cct(on(1600.0)), Err(CctError::TooCold));
    let infinitely_hot = Uv60 { u: 0.1800, v: 0.2636 };
    assert!(robertson.cct(Uv60 { u: 0.1798, v: 0.2620 }) == Err(CctError::TooHot));
    assert_eq!(ohno.cct(infinitely_hot), Err(CctError::TooHot));
    assert_eq!(ohno.cct(Uv60 { u: 0.47, v: 0.3526 }), Err(CctError::TooCold));
    for far in [Uv60 { u: 0.2, v: 0.5 }, Uv60 { u: 1e300, v: 1.0 }] {
        assert_eq!(ohno.cct(far), Err(CctError::TooFar));
        assert!(robertson.cct(far).is_err());
    }
    for bad in [f64::NAN, f64::INFINITY] {
        assert_eq!(ohno.cct(Uv60 { u: bad, v: 0.3 }), Err(CctError::NoChromaticity));
        assert_eq!(robertson.cct(Uv60 { u: 0.2, v: bad }), Err(CctError::NoChromaticity));
    }
    assert_eq!(Robertson::new(&sensor(REFERENCE), RadiationConstants::Paper), Err(LocusError::NotXyz));
    assert_eq!(Ohno::new(&sensor(REFERENCE), RadiationConstants::Paper), Err(LocusError::NotXyz));
}
