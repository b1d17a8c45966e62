//! Random curves and names.

use super::{Curves, back, sheet};
use proptest::collection::vec;
use proptest::prelude::ProptestConfig;
use proptest::prelude::*;
use spectral_file::write::{Content, Format, Grid, Note, Sheet, Trace, write};
use spectral_file::{ReadOptions, Values, read};

/// A value that no reader takes for a gap.
fn value() -> impl Strategy<Value = f64> {
    prop_oneof![-1e3..1e3, 0.0..1.0, proptest::num::f64::NORMAL].prop_filter("a gap", |value| *value != -9999.0)
}

fn ascending(most: usize) -> impl Strategy<Value = Vec<f64>> {
    vec(0.01..40.0, 2..most).prop_map(|steps| {
        let mut at = 200.0;
        steps
            .iter()
            .map(|step| {
                at += step;
                at
            })
            .collect()
    })
}

fn curves(most: usize) -> impl Strategy<Value = Curves> {
    let curve = ("\\PC{0,12}", ascending(30)).prop_flat_map(|(name, wavelengths)| {
        vec(value(), wavelengths.len()).prop_map(move |values| (name.clone(), wavelengths.clone(), values))
    });
    vec(curve, 1..most).prop_map(Curves)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 128, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn csv_comes_back_bit_for_bit(curves in curves(5)) {
        let traces = curves.traces();
        let comments = [("note".to_owned(), "made up".to_owned())];
        let sheet = Sheet { comments: &comments, ..sheet(Content::Illuminant, &traces) };
        let table = back(&write(&sheet, Format::Csv, Grid::Native).unwrap().text);
        prop_assert_eq!(table.curves.len(), traces.len());
        for (curve, trace) in table.curves.iter().zip(&traces) {
            prop_assert_eq!(curve.wavelengths_nm.as_slice(), trace.wavelengths_nm);
            prop_assert!(curve.values.iter().zip(trace.values).all(|(a, b)| a.to_bits() == b.to_bits()));
        }
    }

    #[test]
    fn even_grids_come_back(
        start in 150_u32..500,
        step in 1_u32..12,
        curves in (2_usize..40).prop_flat_map(|bands| vec(vec(value(), bands), 1..4)),
    ) {
        let wavelengths: Vec<f64> = (0..curves[0].len() as u32).map(|i| f64::from(start + step * i)).collect();
        let trace = |values| Trace { name: "a", wavelengths_nm: &wavelengths, values, uncertainty: None };
        let traces: Vec<Trace<'_>> = curves.iter().map(|values| trace(values.as_slice())).collect();
        for format in Format::ALL {
            let sheet = sheet(Content::Other, &traces);
            if format.fits(&sheet).is_err() {
                continue;
            }
            // What is neither light nor a fraction has no unit in the file, so that some values look like percent.
            let plain = ReadOptions { values: Some(Values::Plain), ..ReadOptions::default() };
            let table = read(write(&sheet, format, Grid::Native).unwrap().text.as_bytes(), &plain).unwrap();
            for (curve, trace) in table.curves.iter().zip(&traces) {
                prop_assert_eq!(curve.wavelengths_nm.as_slice(), trace.wavelengths_nm);
                // The reader of JSON is not exact in the last bits of numbers with large exponents.
                let json = matches!(format, Format::RawtoacesJson | Format::DcamprofJson);
                let near = |(a, b): (&f64, &f64)| a == b || (json && ((a - b) / b).abs() <= 2e-15);
                prop_assert!(curve.values.iter().zip(trace.values).all(near), "{format}");
            }
        }
    }

    #[test]
    fn names_come_back(names in vec("[\\PC\\n\\t\"',;]{0,16}", 2..6)) {
        let names: Vec<&str> = names.iter().map(String::as_str).collect();
        let curves = Curves::bells(&names, [400.0, 700.0], 10.0);
        let traces = curves.traces();
        // Signs of units are taken out of names.
        prop_assume!(!names.iter().any(|name| name.contains(['%', 'λ', 'å', 'Å', 'Å'])));
        for format in [Format::Csv, Format::Cgats, Format::RawtoacesJson] {
            let written = write(&sheet(Content::Transmittance, &traces), format, Grid::Native).unwrap();
            // Names that would be taken for units, such as "dB", are replaced, which is said.
            if written.notes.iter().any(|note| matches!(note, Note::Renamed(..))) {
                continue;
            }
            let table = back(&written.text);
            for (index, (curve, name)) in table.curves.iter().zip(&names).enumerate() {
                let spaced: String = name.trim().chars().map(|c| if c.is_control() { ' ' } else { c }).collect();
                let spaced = spaced.replace(['\u{2028}', '\u{2029}'], " ");
                let blank = format!("Curve {}", index + 1);
                let wanted = if spaced.trim().is_empty() { &blank } else { spaced.trim() };
                prop_assert_eq!(&curve.name, wanted, "{}", format);
                prop_assert_eq!(&curve.values.len(), &31);
            }
        }
    }

    #[test]
    fn anything_is_finite_and_in_range(curves in curves(4), step in prop_oneof![0.3..60.0, Just(1.0), Just(5.0)]) {
        let traces = curves.traces();
        for content in [Content::Other, Content::Observer, Content::Reflectance, Content::Illuminant] {
            for format in Format::ALL {
                for grid in [Grid::Native, Grid::Step(step)] {
                    let Ok(out) = write(&sheet(content, &traces), format, grid) else { continue };
                    prop_assert!(!out.text.contains("inf") && !out.text.contains("NaN"));
                }
            }
        }
        let Ok(out) = write(&sheet(Content::Other, &traces), Format::Csv, Grid::Step(step)) else { return Ok(()) };
        for line in out.text.lines().skip(1) {
            // The names have no line breaks left, so that every line below the first is a row.
            let cells: Vec<&str> = line.split(',').collect();
            let w: f64 = cells[0].parse().unwrap();
            prop_assert!(((w / step).round() * step - w).abs() < 1e-6);
            for (cell, trace) in cells[1..].iter().zip(&traces) {
                let inside = trace.wavelengths_nm[0] - 1e-5 <= w && w <= trace.wavelengths_nm.last().unwrap() + 1e-5;
                prop_assert!(inside || cell.is_empty());
            }
        }
    }
}
