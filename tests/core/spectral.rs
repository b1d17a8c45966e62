//! The integration convention, what is assumed beyond the data, and the reader of our own files.

use std::hash::{DefaultHasher, Hash, Hasher};

use chromascope_core::spectral::grid::{COUNT, wavelength_nm};
use chromascope_core::spectral::{
    Dataset, DatasetError, DistributionError, Evidence, GridSpectrum, Interpolation, Primaries, Quantity, Response,
    Sensor, SensorError, SpectralDistribution,
};
use proptest::collection::vec;
use proptest::prelude::*;

use crate::support::{CANON_10D, DCS200, REFERENCE, assert_near, cases, sensor, sensors};

const ALL: [Quantity; 4] =
    [Quantity::Light, Quantity::Reflectance, Quantity::CameraSensitivity, Quantity::MatchingFunction];

fn table(start: f64, step: f64, values: &[f64]) -> SpectralDistribution {
    let wavelengths = (0..values.len()).map(|i| start + step * i as f64).collect();
    SpectralDistribution::new(wavelengths, values.to_vec()).unwrap()
}

fn at(spectrum: &GridSpectrum, nm: f64) -> f64 {
    spectrum.values()[(nm - 380.0) as usize]
}

fn hash(value: &impl Hash) -> u64 {
    let mut hasher = DefaultHasher::new();
    value.hash(&mut hasher);
    hasher.finish()
}

#[test]
fn a_table_on_the_grid_is_taken_as_it_is() {
    let values: Vec<f64> = (0..COUNT).map(|i| (i as f64 / 30.0).sin() + 1.0).collect();
    for quantity in ALL {
        let grid = GridSpectrum::resample(&table(380.0, 1.0, &values), quantity);
        assert_eq!(grid.values().as_slice(), values, "{quantity:?}");
        assert!(grid.assumed().nothing());
    }
}

#[test]
fn smooth_quantities_from_5_nm_on_take_sprague_and_lights_never() {
    // A parabola in the middle of a long table: Sprague has it exactly, straight lines miss by h²/8 per curvature of 2.
    let parabola = |step: f64| -> SpectralDistribution {
        let n = (400.0 / step) as usize + 1;
        table(380.0, step, &(0..n).map(|i| (380.0 + step * i as f64 - 580.0).powi(2) + 1.0).collect::<Vec<_>>())
    };
    for (step, exact) in [(10.0, true), (5.0, true), (4.0, false), (2.0, false)] {
        let middle: f64 = 580.0 + (step / 2.0_f64).floor();
        let (truth, chord) = ((middle - 580.0).powi(2) + 1.0, (middle - 580.0) * step + 1.0);
        for quantity in ALL {
            let sprague = exact && quantity != Quantity::Light;
            let value = at(&GridSpectrum::resample(&parabola(step), quantity), middle);
            assert_near(&format!("{quantity:?} at {step} nm"), value, if sprague { truth } else { chord }, 1e-9);
        }
    }
}

#[test]
fn uneven_and_short_tables_are_interpolated_linearly() {
    let uneven = SpectralDistribution::new(
        vec![400.0, 410.0, 420.0, 430.0, 440.0, 450.0, 461.0],
        vec![0.0, 1.0, 4.0, 9.0, 16.0, 25.0, 36.0],
    );
    let short = table(400.0, 10.0, &[0.0, 1.0, 4.0, 9.0, 16.0]);
    for spectrum in [uneven.unwrap(), short] {
        for quantity in ALL {
            assert_near("chord", at(&GridSpectrum::resample(&spectrum, quantity), 425.0), 6.5, 1e-12);
        }
    }
}

#[test]
fn beyond_the_table_ends_hold_or_nothing_is_there() {
    let spectrum = table(400.0, 10.0, &[0.5; 31]);
    for quantity in ALL {
        let grid = GridSpectrum::resample(&spectrum, quantity);
        let beyond = if matches!(quantity, Quantity::Light | Quantity::Reflectance) { 0.5 } else { 0.0 };
        for (nm, expected) in
            [(380.0, beyond), (399.0, beyond), (400.0, 0.5), (700.0, 0.5), (701.0, beyond), (780.0, beyond)]
        {
            assert_near(&format!("{quantity:?} {nm} nm"), at(&grid, nm), expected, 1e-15);
        }
        assert_eq!(grid.assumed().below_nm, Some(400.0));
        assert_eq!(grid.assumed().above_nm, Some(700.0));
        assert!(!grid.assumed().nothing());
    }
    let wide = GridSpectrum::resample(&table(300.0, 10.0, &[0.5; 60]), Quantity::Light);
    assert!(wide.assumed().nothing());
}

#[test]
fn only_what_cannot_be_negative_is_clamped() {
    let mut dip = vec![1.0; 41];
    dip[20] = -0.5;
    for (quantity, lowest) in [
        (Quantity::Light, -0.5),
        (Quantity::Reflectance, 0.0),
        (Quantity::CameraSensitivity, 0.0),
        (Quantity::MatchingFunction, -0.5),
    ] {
        let grid = GridSpectrum::resample(&table(380.0, 10.0, &dip), quantity);
        assert_near(&format!("{quantity:?}"), at(&grid, 580.0), lowest, 1e-15);
    }
    // Sprague overshoots beside a step; that too is set to zero where it must be.
    let step: Vec<f64> = (0..41).map(|i| if i < 20 { 0.0 } else { 1.0 }).collect();
    let lowest = |quantity| {
        let grid = GridSpectrum::resample(&table(380.0, 10.0, &step), quantity);
        grid.values().iter().copied().fold(f64::INFINITY, f64::min)
    };
    assert!(lowest(Quantity::MatchingFunction) < -0.01);
    assert_eq!(lowest(Quantity::Reflectance), 0.0);
}

fn flat(start: f64, step: f64, count: usize) -> Sensor {
    let curve = table(start, step, &vec![1.0; count]);
    Sensor::new(Primaries::Camera, [curve.clone(), curve.clone(), curve], Response::PerEnergy).unwrap()
}

#[test]
fn integrals_are_trapezoids_over_the_support() {
    // A flat curve's integral is the width of its support on the grid.
    for (sensor, width) in [
        (flat(380.0, 1.0, 401), 400.0),
        (flat(400.0, 10.0, 31), 300.0),
        (flat(300.0, 5.0, 121), 400.0),
        (flat(400.4, 1.0, 301), 299.0),
        (flat(390.0, 5.0, 69), 340.0),
    ] {
        for integral in sensor.integrals() {
            assert_near("width", integral, width, 1e-9);
        }
        let [first, last] = sensor.support_nm();
        assert_near("support", last - first, width, 1e-12);
        for (index, nm) in [(first, 0.5), (last, 0.5), (first + 1.0, 1.0)].map(|(nm, w)| ((nm - 380.0) as usize, w)) {
            assert_near("weight", sensor.weighted(1)[index], nm, 1e-12);
            assert_near("curve", sensor.at_index(index)[1], 1.0, 1e-12);
        }
    }
    let truth = sensor(REFERENCE);
    assert_eq!(truth.support_nm(), [390.0, 730.0]);
    let unsigned: f64 = truth.weighted(0).iter().map(|v| v.abs()).sum();
    assert!(unsigned > truth.integrals()[0], "the negative lobe counts");
    let ones = [1.0; COUNT];
    let apart = truth.integrate(&ones).iter().zip(truth.integrals()).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    assert!(apart < 1e-13);
}

#[test]
fn per_photon_curves_become_per_energy() {
    let curve = table(400.0, 10.0, &[1.0; 31]);
    let make =
        |response| Sensor::new(Primaries::Camera, [curve.clone(), curve.clone(), curve.clone()], response).unwrap();
    let photon = make(Response::PerPhoton);
    for index in 20..=320 {
        assert_near("λ / 550", photon.at_index(index)[0], wavelength_nm(index) / 550.0, 1e-12);
    }
    assert_eq!(photon.response(), Response::PerPhoton);
    assert_eq!(make(Response::Unknown).integrals(), make(Response::PerEnergy).integrals());
    assert_eq!(make(Response::Unknown).response(), Response::Unknown);
    assert_eq!(sensor(CANON_10D).response(), Response::Unknown, "the plot does not say");
    assert_eq!(sensor(DCS200).response(), Response::PerEnergy);
}

#[test]
fn a_blind_channel_makes_no_sensor() {
    let (seeing, dark, beyond) =
        (table(400.0, 10.0, &[1.0; 31]), table(400.0, 10.0, &[0.0; 31]), table(800.0, 10.0, &[1.0; 31]));
    for blind in [dark, beyond] {
        let made = Sensor::new(Primaries::Camera, [seeing.clone(), blind, seeing.clone()], Response::PerEnergy);
        assert_eq!(made, Err(SensorError::Blind { channel: 1 }));
    }
    let negative = table(400.0, 10.0, &[-1.0; 31]);
    let made = Sensor::new(Primaries::Camera, [seeing.clone(), seeing, negative], Response::PerEnergy);
    assert_eq!(made, Err(SensorError::Blind { channel: 2 }), "negative sensitivities of a camera are none");
}

#[test]
fn the_whole_library_makes_sensors() {
    assert!(!sensors("cameras").is_empty() && !sensors("observers").is_empty());
}

#[test]
fn hostile_samples_make_no_spectrum() {
    let new = SpectralDistribution::new;
    assert_eq!(new(vec![], vec![]), Err(DistributionError::Empty));
    assert_eq!(new(vec![1.0], vec![]), Err(DistributionError::Lengths { wavelengths: 1, values: 0 }));
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, -1e101, 1e101] {
        assert!(matches!(new(vec![400.0, 500.0], vec![1.0, bad]), Err(DistributionError::Value { index: 1, .. })));
    }
    for bad in [f64::NAN, f64::INFINITY, 400.0, 399.0, 0.0, -1.0] {
        assert!(
            matches!(new(vec![400.0, bad], vec![1.0, 1.0]), Err(DistributionError::Order { index: 1, .. })),
            "{bad}"
        );
    }
    assert!(matches!(new(vec![0.0], vec![1.0]), Err(DistributionError::Order { index: 0, .. })));
    let one = new(vec![555.0], vec![2.0]).unwrap();
    assert_eq!((one.range_nm(), one.uniform_step_nm()), ([555.0, 555.0], None));
    assert!(one.map(|_, v| v / 0.0).is_err());
}

#[test]
fn equal_spectra_hash_alike() {
    let (plus, minus) = (table(400.0, 1.0, &[0.0, 1.0]), table(400.0, 1.0, &[-0.0, 1.0]));
    assert_eq!(plus, minus);
    assert_eq!(hash(&plus), hash(&minus));
    let (plus, minus) = (GridSpectrum::constant(0.0), GridSpectrum::constant(-0.0));
    assert_eq!(plus, minus);
    assert_eq!(hash(&plus), hash(&minus));
    let strange = GridSpectrum::from_fn(|nm| if nm < 500.0 { f64::NAN } else { f64::INFINITY });
    assert_eq!(strange, GridSpectrum::constant(0.0));
}

const FILE: &str = "# title: A thing\n# quantity: reflectance factor\n# unit: 1\n# source: us\n# license: MIT\n# note: one\n\
                    # note: two\nwavelength_nm,a,b\n400,0.1,0.2\n500,0.3,-4e-1\n";

#[test]
fn a_data_file_is_read_whole() {
    let data = Dataset::read(FILE).unwrap();
    assert_eq!((data.header.title.as_str(), data.header.notes.len()), ("A thing", 2));
    assert_eq!(data.header.columns, ["a", "b"]);
    assert_eq!(data.curves[1].values(), [0.2, -0.4]);
    assert_eq!(data.header.response(), Response::Unknown);
    assert_eq!(data.header.response_evidence(), Evidence::Unknown);
    assert_eq!((data.header.response_note(), data.header.is_digitized()), (None, false));
    assert_eq!(Dataset::read_header(FILE).unwrap(), data.header);
    assert_eq!(Dataset::read(&FILE.replace('\n', "\r\n")).unwrap(), data);
}

#[test]
fn a_response_is_stated_inferred_or_unknown() {
    for (said, response, evidence) in [
        ("per energy (stated)", Response::PerEnergy, Evidence::Stated),
        ("per energy (inferred)", Response::PerEnergy, Evidence::Inferred),
        ("per photon (inferred)", Response::PerPhoton, Evidence::Inferred),
        ("per photon", Response::PerPhoton, Evidence::Stated),
        ("unknown", Response::Unknown, Evidence::Unknown),
        ("", Response::Unknown, Evidence::Unknown),
    ] {
        let text = FILE.replace("# source", &format!("# response: {said}\n# origin: digitized figure\n# source"));
        let header = Dataset::read_header(&text.replace("note: two", "note: Taken as per energy")).unwrap();
        assert_eq!((header.response(), header.response_evidence()), (response, evidence), "{said}");
        assert_eq!(header.response_note(), Some("Taken as per energy"));
        assert!(header.is_digitized());
    }
}

#[test]
fn interpolation_says_what_resampling_does() {
    let values: Vec<f64> = (0..41).map(|i| f64::from(i * i)).collect();
    for (step, smooth) in [(1.0, Interpolation::None), (2.0, Interpolation::Linear), (10.0, Interpolation::Sprague)] {
        for quantity in ALL {
            let light = quantity == Quantity::Light && step > 1.0;
            let expected = if light { Interpolation::Linear } else { smooth };
            assert_eq!(Interpolation::of(&table(380.0, step, &values), quantity), expected, "{quantity:?} {step} nm");
        }
    }
    assert_eq!(Interpolation::of(&table(380.5, 1.0, &values), Quantity::Light), Interpolation::Linear);
    assert_eq!(Interpolation::of(&table(400.0, 10.0, &values[..5]), Quantity::Reflectance), Interpolation::Linear);
}

#[test]
fn a_data_file_that_cannot_be_read_says_where() {
    for (from, to, expected) in [
        ("# unit: 1", "# unti: 1", DatasetError::Key { line: 3 }),
        ("# unit: 1", "# unit", DatasetError::Key { line: 3 }),
        ("wavelength_nm,a,b", "nm,a,b", DatasetError::Columns { line: 8 }),
        ("wavelength_nm,a,b", "wavelength_nm", DatasetError::Columns { line: 8 }),
        ("400,0.1,0.2", "400,0.1", DatasetError::Fields { line: 9, expected: 3 }),
        ("500,0.3,-4e-1", "500,0.3,1,2", DatasetError::Fields { line: 10, expected: 3 }),
        ("500,0.3,-4e-1", "500,x,1", DatasetError::Number { line: 10, column: 2 }),
        ("500,0.3,-4e-1", ",1,1", DatasetError::Number { line: 10, column: 1 }),
    ] {
        assert_eq!(Dataset::read(&FILE.replace(from, to)), Err(expected), "{to}");
    }
    assert_eq!(Dataset::read(""), Err(DatasetError::Columns { line: 1 }));
    assert_eq!(Dataset::read("# title: x"), Err(DatasetError::Columns { line: 2 }));
    for (from, to) in [("500,", "400,"), ("-4e-1", "NaN"), ("-4e-1", "inf"), ("-4e-1", "1e200"), ("400,", "-400,")] {
        assert!(matches!(Dataset::read(&FILE.replace(from, to)), Err(DatasetError::Spectrum(_))), "{to}");
    }
    let headless = Dataset::read("wavelength_nm,a\n").unwrap_err();
    assert_eq!(headless, DatasetError::Spectrum(DistributionError::Empty));
}

fn hostile_value() -> impl Strategy<Value = f64> {
    prop_oneof![-1e100..1e100, -1.0..1.0, Just(0.0), Just(1e100), Just(-1e100), Just(5e-324)]
}

proptest! {
    #![proptest_config(cases(128))]

    #[test]
    fn resampling_keeps_constants(start in 350.0..600.0, step in 0.3..30.0, count in 1_usize..60, constant in 0.0..10.0) {
        let spectrum = table(start, step, &vec![constant; count]);
        for quantity in [Quantity::Light, Quantity::Reflectance] {
            let grid = GridSpectrum::resample(&spectrum, quantity);
            prop_assert!(grid.values().iter().all(|v| (v - constant).abs() < 1e-12));
        }
        let [first, last] = spectrum.range_nm();
        let sensitivity = GridSpectrum::resample(&spectrum, Quantity::CameraSensitivity);
        for index in 0..COUNT {
            let expected = if (first..=last).contains(&wavelength_nm(index)) { constant } else { 0.0 };
            prop_assert!((sensitivity.values()[index] - expected).abs() < 1e-12);
        }
    }

    #[test]
    fn resampling_is_linear_where_nothing_is_clamped(a in vec(-1.0..1.0, 41), b in vec(-1.0..1.0, 41), k in -3.0..3.0) {
        let sum: Vec<f64> = a.iter().zip(&b).map(|(a, b)| a + k * b).collect();
        let on = |v: &[f64]| GridSpectrum::resample(&table(380.0, 10.0, v), Quantity::MatchingFunction);
        let (a, b, sum) = (on(&a), on(&b), on(&sum));
        for index in 0..COUNT {
            let off: f64 = sum.values()[index] - a.values()[index] - k * b.values()[index];
            prop_assert!(off.abs() < 1e-12);
        }
    }

    #[test]
    fn hostile_values_stay_finite(values in vec(hostile_value(), 1..60), start in 1.0..900.0, step in 0.01..50.0) {
        let spectrum = table(start, step, &values);
        for quantity in ALL {
            prop_assert!(GridSpectrum::resample(&spectrum, quantity).values().iter().all(|v| v.is_finite()));
        }
        for response in [Response::PerEnergy, Response::PerPhoton] {
            let curves = [spectrum.clone(), spectrum.clone(), spectrum.clone()];
            if let Ok(sensor) = Sensor::new(Primaries::Rgb, curves, response) {
                prop_assert!(sensor.integrals().iter().all(|v| v.is_finite()));
            }
        }
    }

    #[test]
    fn any_text_is_read_or_refused(lines in vec("(# (title|unit|note): .*|wavelength_nm(,[a-z])*|[0-9.,eE+-]*|.*)", 0..20)) {
        let text = lines.join("\n");
        let _ = Dataset::read(&text);
        let _ = Dataset::read_header(&text);
    }
}
