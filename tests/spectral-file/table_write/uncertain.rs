//! Uncertainties and covariances, out and in again.

use super::{CAMERA, Curves, beside, has, sheet, written};
use proptest::collection::vec;
use proptest::prelude::*;
use spectral_file::write::{Beside, Content, Format, Grid, Note, Prepared, Sheet, Trace, WriteError, Written, write};
use spectral_file::{Certainty, Covariance, ReadOptions, SpectralFile, Uncertainty, read};

const LIGHT: Content<'static> = Content::Illuminant;
const CONTENTS: [Content<'static>; 6] =
    [CAMERA, Content::Observer, Content::Reflectance, Content::Transmittance, LIGHT, Content::Other];

/// Numbers of a file, which are k u, as uncertainties u.
fn stated(numbers: impl Iterator<Item = f64>, coverage: f64) -> Uncertainty {
    Uncertainty { standard: numbers.map(|number| number / coverage).collect(), coverage }
}

/// Three curves, the second without uncertainties.
fn uncertain(curves: &Curves, coverage: f64) -> [Option<Uncertainty>; 3] {
    let of = |index: usize| {
        let numbers = curves.0[index].2.iter().enumerate().map(|(row, value)| 0.001 * row as f64 + value.abs() / 70.0);
        Some(stated(numbers, coverage))
    };
    [of(0), None, of(2)]
}

fn with<'a>(curves: &'a Curves, uncertainties: &'a [Option<Uncertainty>]) -> Vec<Trace<'a>> {
    let traces = curves.traces().into_iter().zip(uncertainties);
    traces.map(|(trace, of)| Trace { uncertainty: of.as_ref(), ..trace }).collect()
}

fn same(table: &SpectralFile, traces: &[Trace<'_>]) {
    let names = |curves: &[spectral_file::Curve]| curves.iter().map(|curve| curve.name.clone()).collect::<Vec<_>>();
    assert_eq!(names(&table.curves), traces.iter().map(|trace| trace.name).collect::<Vec<_>>());
    for (curve, trace) in table.curves.iter().zip(traces) {
        assert_eq!(curve.name, trace.name);
        assert_eq!((&*curve.wavelengths_nm, &*curve.values), (trace.wavelengths_nm, trace.values), "{}", trace.name);
        assert_eq!(curve.uncertainty.as_ref(), trace.uncertainty, "{}", trace.name);
    }
}

#[test]
fn a_column_stands_behind_its_curve_and_names_its_factor() {
    let leaf = stated([0.004, 0.0196].into_iter(), 1.96);
    let lamp = stated([0.5, 0.25].into_iter(), 1.0);
    let wavelengths_nm = &[400.0, 410.0][..];
    let one = Trace { name: "leaf, \"old\"", wavelengths_nm, values: &[0.5, 0.25], uncertainty: Some(&leaf) };
    let text = written(&sheet(Content::Reflectance, &[one]), Format::Csv, Grid::Native).text;
    let heads =
        "\"leaf, \"\"old\"\" [reflectance factor in 1]\",\"leaf, \"\"old\"\" [expanded uncertainty (k=1.96) in 1]\"";
    assert_eq!(text, format!("wavelength_nm,{heads}\n400,0.5,0.004\n410,0.25,0.0196\n"));
    let two = [Trace { uncertainty: None, ..one }, Trace { name: "lamp", uncertainty: Some(&lamp), ..one }];
    let sheet = Sheet { unit: Some("W/m²/nm"), ..sheet(LIGHT, &two) };
    let text = written(&sheet, Format::Csv, Grid::Native).text;
    let heads = text.lines().next().unwrap();
    assert!(
        heads.ends_with(",lamp [spectral irradiance in W/m²/nm],lamp [standard uncertainty (k=1) in W/m²/nm]"),
        "{heads}"
    );
}

#[test]
fn what_is_uncertain_comes_back_of_every_kind() {
    let curves = Curves::bells(&["R", "G", "B"], [400.0, 700.0], 10.0);
    for coverage in [1.0, 2.0, 1.96, 2.5, 3.0] {
        let uncertainties = uncertain(&curves, coverage);
        let traces = with(&curves, &uncertainties);
        for content in CONTENTS {
            for unit in [None, Some("W/m²/nm"), Some("a [b]")].into_iter().take(if content == LIGHT { 3 } else { 1 }) {
                for format in [Format::Csv, Format::CommentedCsv] {
                    let sheet = Sheet { unit, ..sheet(content, &traces) };
                    let out = written(&sheet, format, Grid::Native);
                    assert!(out.notes.is_empty(), "{:?}", out.notes);
                    let table = beside(&out);
                    same(&table, &traces);
                    let decisions = table.decisions();
                    let said = decisions.iter().find(|decision| decision.what == "Uncertainty").unwrap();
                    assert_eq!(said.certainty, Certainty::Certain, "{said}");
                    assert!(table.warnings.is_empty(), "{:?}", table.warnings);
                }
            }
        }
    }
}

/// A reader guesses by words; what the program itself writes is what its heads say.
#[test]
fn no_name_turns_a_curve_into_an_uncertainty_or_into_nothing() {
    let names = [
        "Std.Dev.",
        "U (k=2)",
        "sd",
        "leaf",
        "leaf sd",
        "leaf",
        "Temperature",
        "Time (s)",
        "dark",
        "Raw counts",
        "reference",
        "uncertainty [standard uncertainty (k=1) in 1]",
        "±",
        "999",
        "[x]",
        "a in b",
        "é",
        "mean",
    ];
    let curves = Curves::bells(&names, [400.0, 700.0], 10.0);
    let u: Vec<_> = (0..names.len()).map(|at| (at % 3 > 0).then(|| stated((0..31).map(f64::from), 2.0))).collect();
    for content in CONTENTS {
        for uncertainties in [u.clone(), vec![None; names.len()]] {
            let traces = with(&curves, &uncertainties);
            let out = written(&sheet(content, &traces), Format::Csv, Grid::Native);
            assert!(out.notes.is_empty(), "{:?}", out.notes);
            same(&beside(&out), &traces);
        }
    }
    // Numbers that stand for none elsewhere are values here.
    let values = [1.0, -999.0, 9999.0, 1.0];
    let trace = Trace { name: "a", wavelengths_nm: &[400.0, 410.0, 420.0, 430.0], values: &values, uncertainty: None };
    same(&beside(&written(&sheet(LIGHT, &[trace]), Format::Csv, Grid::Native)), &[trace]);
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 64, failure_persistence: None, ..ProptestConfig::default() })]

    /// Any uncertainty comes back to the last bit; its factor too, if it is that of numbers of a file.
    #[test]
    fn uncertainties_come_back_to_the_last_bit(
        names in vec("[\\PC\"',;]{0,90}", 2),
        numbers in vec(prop_oneof![0.0..1.0, Just(0.0), 0.0..1e300, (0_u32..1000).prop_map(|n| f64::from(n) / 1000.0)], 2..20),
        coverage in prop_oneof![1.0..4.0, Just(2.0), Just(1.96), 1e-3..1e3],
        are_numbers in any::<bool>(),
    ) {
        let standard = if are_numbers { stated(numbers.iter().copied(), coverage).standard } else { numbers.clone() };
        let uncertainty = Uncertainty { standard, coverage };
        let wavelengths: Vec<f64> = (0..numbers.len()).map(|row| 400.0 + row as f64).collect();
        let trace = |name, uncertainty| Trace { name, wavelengths_nm: &wavelengths, values: &wavelengths, uncertainty };
        let traces = [trace(&names[0], Some(&uncertainty)), trace(&names[1], None)];
        let table = beside(&written(&sheet(LIGHT, &traces), Format::Csv, Grid::Native));
        prop_assert_eq!(table.curves.len(), 2, "{:?}", table.warnings);
        prop_assert_eq!(&table.curves[1].uncertainty, &None);
        let again = table.curves[0].uncertainty.as_ref().unwrap();
        prop_assert_eq!(&again.standard, &uncertainty.standard);
        prop_assert!(again.coverage == coverage || !are_numbers && again.coverage == 1.0);
    }
}

/// Curves of different wavelengths, and their covariance.
fn covariant() -> (Curves, Covariance) {
    let curves = Curves(vec![
        ("a".to_owned(), vec![400.0, 410.0, 430.0], vec![0.1, 0.2, 0.3]),
        ("b".to_owned(), vec![405.0, 410.0], vec![0.5, 0.6]),
    ]);
    let value = |at: usize| if at / 5 == at % 5 { 4e-5 / 3.0 } else { 1e-6 / (1 + at / 5 + at % 5) as f64 };
    (curves, Covariance { size: 5, values: (0..25).map(value).collect() })
}

#[test]
fn a_covariance_goes_into_a_file_beside_and_comes_back() {
    let (curves, covariance) = covariant();
    let traces = curves.traces();
    for (content, format) in [(Content::Reflectance, Format::Csv), (LIGHT, Format::CommentedCsv)] {
        let sheet = Sheet { covariance: Some(&covariance), ..sheet(content, &traces) };
        let out = written(&sheet, format, Grid::Native);
        assert!(out.notes.is_empty());
        let table = beside(&out);
        assert_eq!(table.covariance.as_ref(), Some(&covariance));
        // Once more, with the uncertainties that it gave.
        let traces: Vec<Trace<'_>> = table.curves.iter().map(Trace::from).collect();
        assert!(traces.iter().all(|trace| trace.uncertainty.is_some()));
        let again = beside(&written(&Sheet { curves: &traces, ..sheet }, format, Grid::Native));
        assert_eq!((&again.curves, &again.covariance), (&table.curves, &table.covariance));
        let stepped = written(&sheet, format, Grid::Step(5.0));
        assert_eq!(stepped.beside.covariance, None);
        assert!(stepped.notes.contains(&Note::NoCovariance), "{:?}", stepped.notes);
    }
}

#[test]
fn between_samples_they_are_those_of_samples_that_err_alike() {
    let curves = Curves::bells(&["R", "G", "B"], [400.0, 700.0], 10.0);
    let uncertainties = uncertain(&curves, 2.0);
    let traces = with(&curves, &uncertainties);
    let sheet = sheet(CAMERA, &traces);
    for (grid, alike) in [(Grid::Step(5.0), true), (Grid::Step(20.0), false), (Grid::Average(20.0), true)] {
        let out = written(&sheet, Format::Csv, grid);
        assert_eq!(has(&out.notes, |note| *note == Note::Alike), alike, "{:?}", out.notes);
        let table = beside(&out);
        assert_eq!(table.curves[1].uncertainty, None);
        let mut prepared = Prepared::new(&sheet, grid).unwrap();
        let mut curves = table.curves.iter();
        prepared.each(|wavelengths, values, standard| {
            let curve = curves.next().unwrap();
            assert_eq!((wavelengths, values), (&*curve.wavelengths_nm, &*curve.values));
            assert_eq!(standard, curve.uncertainty.as_ref().map(|of| &*of.standard));
            true
        });
        let own = uncertainties[0].as_ref().unwrap();
        let (known, found) = (&own.standard, table.curves[0].uncertainty.as_ref().unwrap());
        assert_eq!(found.coverage, 2.0);
        for (nm, u) in table.curves[0].wavelengths_nm.iter().zip(&found.standard) {
            let at = |nm: f64| {
                let (below, t) = (((nm - 400.0) / 10.0).floor(), (nm - 400.0) / 10.0 % 1.0);
                known[below as usize] * (1.0 - t) + known[(below as usize + 1).min(30)] * t
            };
            // The mean of a line with a bend in the middle.
            let mean = |nm: f64| (at(nm - 10.0) + 2.0 * at(nm) + at(nm + 10.0)) / 4.0;
            let wanted = if matches!(grid, Grid::Average(_)) { mean(*nm) } else { at(*nm) };
            assert!((u / wanted - 1.0).abs() < 1e-12, "{grid:?} {nm}: {u}, not {wanted}");
        }
    }
}

#[test]
fn a_format_without_a_place_for_them_says_so() {
    let curves = Curves::bells(&["R", "G", "B"], [400.0, 700.0], 10.0);
    let uncertainties = uncertain(&curves, 2.0);
    let traces = with(&curves, &uncertainties);
    let known: Vec<Trace<'_>> = curves.traces();
    for format in Format::ALL.into_iter().filter(|format| !format.is_csv()) {
        let out = written(&sheet(CAMERA, &traces), format, Grid::Native);
        assert!(out.notes.contains(&Note::NoUncertainty), "{format}: {:?}", out.notes);
        let plain = written(&sheet(CAMERA, &known), format, Grid::Native);
        assert!(!plain.notes.contains(&Note::NoUncertainty), "{format}");
        assert_eq!((out.text, out.beside), (plain.text, Beside::default()), "{format}");
    }
}

#[test]
fn what_is_no_uncertainty_is_refused() {
    let wavelengths_nm = &[400.0, 410.0][..];
    let bad = [(vec![0.1], 1.0), (vec![0.1, -0.1], 1.0), (vec![0.1, f64::NAN], 1.0), (vec![0.1, 0.1], 0.0)];
    for (standard, coverage) in bad {
        let uncertainty = Uncertainty { standard, coverage };
        let trace = Trace { name: "a", wavelengths_nm, values: &[0.1, 0.2], uncertainty: Some(&uncertainty) };
        for format in Format::ALL {
            assert_eq!(
                write(&sheet(Content::Reflectance, &[trace]), Format::Csv, Grid::Native),
                Err(WriteError::Uncertainty(1)),
                "{format}"
            );
        }
    }
    let (curves, covariance) = covariant();
    let traces = curves.traces();
    let sheet = Sheet { covariance: Some(&covariance), ..sheet(Content::Other, &traces[..1]) };
    assert_eq!(write(&sheet, Format::Csv, Grid::Native), Err(WriteError::Covariance));
}

/// A column whose curve is empty, which another program may leave, is no curve.
#[test]
fn a_column_without_its_curve_is_nothing() {
    let head =
        "wavelength_nm,a [reflectance factor in 1],a [standard uncertainty (k=1) in 1],b [reflectance factor in 1]";
    let table = read(&format!("{head}\n400,,0.1,0.5\n410,,0.1,0.6\n"), &ReadOptions::default()).unwrap();
    assert_eq!(table.curves.len(), 1);
    assert_eq!((&*table.curves[0].name, &table.curves[0].uncertainty), ("b", &None));
    // In another order they are judged by their words.
    let text =
        "wavelength_nm,b [reflectance factor in 1],a [standard uncertainty (k=1) in 1]\n400,0.5,0.1\n410,0.6,0.1\n";
    let table = read(text, &ReadOptions::default()).unwrap();
    assert!(table.curves[0].name.starts_with("b ["));
    let out = Written { text: text.to_owned(), beside: Beside::default(), notes: Vec::new() };
    assert!(beside(&out).reading.header_line.is_some());
}
