//! Blackbodies against 50 digits, daylight against the CIE's tables.

use chromascope_core::colorimetry::Xyz;
use chromascope_core::light::daylight::chromaticity;
use chromascope_core::light::planckian::{black_body, exitance, relative_exitance};
use chromascope_core::light::{DaylightBasis, DaylightError, RadiationConstants};
use chromascope_core::spectral::grid::{COUNT, wavelength_nm};
use chromascope_core::spectral::{GridSpectrum, Quantity};
use proptest::prelude::*;

use crate::support::{CIE_1931, assert_near, assert_xy, cases, dataset, kelvin, reference_numbers, sensor};

const EDITIONS: [RadiationConstants; 2] = [RadiationConstants::Paper, RadiationConstants::Si2019];

#[test]
fn constants_are_those_published() {
    assert_eq!(RadiationConstants::Paper.first(), 3.74183e-16);
    assert_eq!(RadiationConstants::Paper.second(), 1.4388e-2);
    // CODATA 2018 prints the exact values to ten digits.
    assert_near("c1", RadiationConstants::Si2019.first() / 3.741_771_852e-16, 1.0, 2e-10);
    assert_near("c2", RadiationConstants::Si2019.second() / 1.438_776_877e-2, 1.0, 4e-10);
}

#[test]
fn planck_matches_fifty_digits() {
    for row in reference_numbers("planckian.csv") {
        let (t, nm) = (row[0], row[1]);
        for (edition, constants) in EDITIONS.into_iter().enumerate() {
            let what = format!("{t} K, {nm} nm, {constants:?}");
            // The law's own conditioning: an exponent x carries the rounding of its argument, x ε.
            let x = constants.second() * 1e9 / (nm * t);
            let conditioning = 1e-15 + 3.0 * x * f64::EPSILON;
            let value = exitance(nm, kelvin(t), constants);
            if row[2 + edition] == 0.0 {
                assert!(value < 3e-308, "{what}: {value}");
            } else {
                assert_near(&what, value / row[2 + edition], 1.0, conditioning);
            }
            let ratio = relative_exitance(nm, 780.0, kelvin(t), constants);
            if row[4 + edition] == 0.0 {
                assert!(ratio < 3e-308, "{what}: {ratio}");
            } else {
                // Here only the difference of the exponents counts.
                let x = constants.second() * 1e9 / t * (1.0 / nm - 1.0 / 780.0);
                assert_near(&what, ratio / row[4 + edition], 1.0, 2e-15 + 3.0 * x * f64::EPSILON);
            }
        }
    }
}

#[test]
fn wiens_laws_hold() {
    for constants in EDITIONS {
        for t in [4500.0, 5500.0, 7000.0] {
            // λ_max T = c₂ / 4.965114231744276, 2.897771955e-3 m K with the exact constants (CODATA 2018).
            let body = black_body(kelvin(t), constants);
            let at = (0..COUNT).max_by(|&a, &b| body.values()[a].total_cmp(&body.values()[b])).unwrap();
            assert_near("peak", wavelength_nm(at), constants.second() * 1e9 / (4.965_114_231_744_276 * t), 0.5);
            assert_near("height", body.values()[at], 1.0, 1e-5);
        }
        // Beside it, where exp(x) outweighs 1 by far: Wien's approximation.
        let (nm, t) = (400.0_f64, 900.0);
        let x = constants.second() * 1e9 / (nm * t);
        let wien = constants.first() / (nm * 1e-9).powi(5) * (-x).exp();
        let planck = exitance(nm, kelvin(t), constants);
        assert_near("Wien", planck / wien, 1.0, 1e-14);
        // And where x is small: Rayleigh and Jeans, to first order x/2.
        let t = 1e9;
        let x = constants.second() * 1e9 / (nm * t);
        let jeans = constants.first() / (nm * 1e-9).powi(5) / x;
        let planck = exitance(nm, kelvin(t), constants);
        assert_near("Rayleigh-Jeans", planck / jeans, 1.0 - x / 2.0, 1e-9);
    }
}

#[test]
fn illuminant_a_is_a_black_body_with_its_own_constant() {
    // CIE 15: c₂ = 1.435e-2 m K at 2848 K, hence 2855.54 K with 1.4388e-2.
    let tabulated = dataset("illuminants/a.csv");
    let body = |nm: f64| relative_exitance(nm, 560.0, kelvin(2848.0 * 1.4388 / 1.435), RadiationConstants::Paper);
    for (&nm, &value) in tabulated.curves[0].wavelengths_nm().iter().zip(tabulated.curves[0].values()) {
        assert_near(&format!("{nm} nm"), 100.0 * body(nm) / value, 1.0, 6e-6);
    }
}

proptest! {
    #![proptest_config(cases(256))]

    #[test]
    fn hotter_is_brighter_and_bluer(t in 500.0..50_000.0, factor in 1.01..3.0) {
        for nm in [400.0, 550.0, 700.0] {
            let at = |t: f64| exitance(nm, kelvin(t), RadiationConstants::Paper);
            prop_assert!(at(t * factor) > at(t));
        }
        let blue = |t: f64| relative_exitance(450.0, 650.0, kelvin(t), RadiationConstants::Paper);
        prop_assert!(blue(t * factor) > blue(t));
    }
}

fn basis() -> DaylightBasis {
    DaylightBasis::new(&dataset("illuminants/cie_daylight_basis.csv")).unwrap()
}

#[test]
fn daylight_lies_where_the_cie_says() {
    // colour-science 0.4, CCT_to_xy_CIE_D, its documented example.
    assert_xy("D65", chromaticity(kelvin(6_504.389_383_05)).unwrap(), [0.312_707_7, 0.329_112_8], 1e-7);
    // CIE 15:2004, Table T.3, five decimals; the tables' own temperatures are 1.4388/1.4380 of their names. The tabulated
    // whites are sums over the spectra, whose y the formula misses by 1.1e-4; so the spectra are what must hit them, as far as
    // a sum that begins at 380 nm can.
    let observer = sensor(CIE_1931);
    for (name, x, y) in
        [(5000.0, 0.34567, 0.35851), (5500.0, 0.33243, 0.34744), (6500.0, 0.31272, 0.32903), (7500.0, 0.29903, 0.31488)]
    {
        let t = kelvin(name * 1.4388 / 1.4380);
        assert_near("x", chromaticity(t).unwrap().x, x, 5e-5);
        let light = GridSpectrum::resample(&basis().light(t).unwrap(), Quantity::Light);
        let [big_x, big_y, big_z] = observer.integrate(light.values());
        assert_xy("white", Xyz::new(big_x, big_y, big_z).chromaticity().unwrap(), [x, y], 8e-5);
    }
    // The two branches meet at 7000 K to the digits of their coefficients.
    let (below, above) = (chromaticity(kelvin(7000.0)).unwrap(), chromaticity(kelvin(7_000.000_001)).unwrap());
    assert!(below.distance(above) < 1e-5);
}

/// The published tables come from M₁ and M₂ rounded to three decimals, and print one to five digits themselves; nothing else
/// may differ.
#[test]
fn daylight_spectra_match_the_cies_tables() {
    let vectors = dataset("illuminants/cie_daylight_basis.csv");
    for (path, name, digits) in [
        ("illuminants/d50.csv", 5000.0, 0.0005),
        ("illuminants/d55.csv", 5500.0, 0.0005),
        ("illuminants/d65.csv", 6500.0, 0.0005),
        ("illuminants/d75.csv", 7500.0, 0.0005),
    ] {
        let computed = basis().light(kelvin(name * 1.4388 / 1.4380)).unwrap();
        let table = dataset(path);
        for (&nm, &value) in table.curves[0].wavelengths_nm().iter().zip(table.curves[0].values()) {
            let at = computed.wavelengths_nm().iter().position(|&w| w == nm).unwrap();
            let rounding = 0.0005 * (vectors.curves[1].values()[at].abs() + vectors.curves[2].values()[at].abs());
            assert_near(&format!("{path} {nm} nm"), computed.values()[at], value, rounding + digits);
        }
    }
}

#[test]
fn daylight_is_refused_outside_its_range() {
    for t in [1.0, 3999.999, 25_000.001, 1e15] {
        assert_eq!(chromaticity(kelvin(t)), Err(DaylightError::Temperature(kelvin(t))));
        assert!(basis().light(kelvin(t)).is_err());
    }
    assert!(chromaticity(kelvin(4000.0)).is_ok() && chromaticity(kelvin(25_000.0)).is_ok());
    assert_eq!(DaylightBasis::new(&dataset("illuminants/e.csv")), Err(DaylightError::Basis));
}

#[test]
fn exitance_is_a_number_at_any_wavelength_and_temperature() {
    for nm in [5e-324, 1e-300, 1e-60, 1.0, 1e60, 1e300] {
        for t in [5e-324, 1e-300, 1.0, 1e100, 1e300] {
            let e = exitance(nm, kelvin(t), RadiationConstants::Paper);
            assert!(e.is_finite() && e >= 0.0, "{nm} nm, {t} K: {e}");
        }
    }
}

#[test]
fn no_black_body_is_subnormal() {
    for t in 1..200 {
        let body = black_body(kelvin(0.25 * f64::from(t)), RadiationConstants::Paper);
        assert!(body.values().iter().all(|v| !v.is_subnormal()), "{} K", 0.25 * f64::from(t));
    }
}
