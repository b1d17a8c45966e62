//! Means over bands: of lines that points lose, of straight and constant curves, at the ends, in every format.

use spectral_file::write::{Content, Format, Grid, Note, Trace, WriteError, write};

use super::{CAMERA, back, has, sheet, written};

/// A light with a line of one nanometer between the multiples of 5 nm.
fn line() -> (Vec<f64>, Vec<f64>) {
    let wavelengths: Vec<f64> = (380..=780).map(f64::from).collect();
    let values = wavelengths.iter().map(|&nm| if nm == 437.0 { 101.0 } else { 1.0 }).collect();
    (wavelengths, values)
}

#[test]
fn averages_keep_what_points_lose() {
    let (wavelengths_nm, values) = line();
    let traces = [Trace { name: "lamp", wavelengths_nm: &wavelengths_nm, values: &values, uncertainty: None }];
    let points = written(&sheet(Content::Illuminant, &traces), Format::Csv, Grid::Step(5.0));
    assert!(back(&points.text).curves[0].values.iter().all(|value| *value == 1.0));
    let known = points.beside.metadata.unwrap().text("lamp.csv");
    assert!(known.contains("{ \"resampling\": \"values every 5 nm, samples picked\" }"), "{known}");
    assert!(has(&points.notes, |note| matches!(note, Note::Thinned { .. })));
    let bands = written(&sheet(Content::Illuminant, &traces), Format::Csv, Grid::Average(5.0));
    let told = "\"band averages every 5 nm: means of the linear interpolant over ±2.5 nm\"";
    let known = bands.beside.metadata.unwrap().text("lamp.csv");
    assert!(known.contains(told), "{known}");
    assert!(has(&bands.notes, |note| matches!(note, Note::Averaged(5.0))));
    assert!(!has(&bands.notes, |note| matches!(note, Note::Thinned { .. })));
    let curve = &back(&bands.text).curves[0];
    // The triangle of height 100 over 436 to 438 nm: its area to the left and the right of 437.5 nm is 87.5 and 12.5.
    let at = |nm: f64| curve.values[curve.wavelengths_nm.iter().position(|w| *w == nm).unwrap()];
    assert!((at(435.0) - 18.5).abs() < 1e-12 && (at(440.0) - 3.5).abs() < 1e-12);
    // Whole bands alone: from 385 to 775 nm; constants to the last bit.
    assert_eq!([curve.wavelengths_nm[0], *curve.wavelengths_nm.last().unwrap()], [385.0, 775.0]);
    assert!(curve.wavelengths_nm.iter().zip(&curve.values).all(|(w, v)| (435.0..=440.0).contains(w) || *v == 1.0));
}

#[test]
fn averages_of_straight_pieces_are_exact() {
    // Uneven steps; between them straight: v = λ up to 450 nm, then 900 − λ.
    let wavelengths = [400.0, 403.5, 420.25, 450.0, 471.0, 500.0];
    let values: Vec<f64> = wavelengths.iter().map(|&nm| if nm <= 450.0 { nm } else { 900.0 - nm }).collect();
    let traces = [Trace { name: "a", wavelengths_nm: &wavelengths, values: &values, uncertainty: None }];
    let out = written(&sheet(Content::Other, &traces), Format::Csv, Grid::Average(10.0));
    for (nm, value) in back(&out.text).curves[0].wavelengths_nm.iter().zip(&back(&out.text).curves[0].values) {
        let mean = match *nm {
            450.0 => 450.0 - 2.5,
            nm if nm < 450.0 => nm,
            nm => 900.0 - nm,
        };
        assert!((value - mean).abs() < 1e-9, "{nm}: {value}, not {mean}");
    }
    let huge = [f64::MAX, -f64::MAX, f64::MAX];
    let traces = [Trace { name: "a", wavelengths_nm: &[400.0, 410.0, 420.0], values: &huge, uncertainty: None }];
    let out = written(&sheet(Content::Other, &traces), Format::Csv, Grid::Average(4.0));
    assert!(back(&out.text).curves[0].values.iter().all(|value| value.is_finite()));
}

#[test]
fn every_format_says_which_was_used() {
    let (wavelengths_nm, values) = line();
    let one = [Trace { name: "a", wavelengths_nm: &wavelengths_nm, values: &values, uncertainty: None }];
    let three = [one[0], Trace { name: "b", ..one[0] }, Trace { name: "c", ..one[0] }];
    for format in Format::ALL {
        let camera = matches!(format, Format::ArgyllCmf);
        let sheet = if camera { sheet(CAMERA, &three) } else { sheet(Content::Illuminant, &one) };
        for (grid, told) in [(Grid::Average(5.0), "band averages every 5 nm"), (Grid::Step(5.0), "values every 5 nm")] {
            let out = write(&sheet, format, grid).unwrap();
            let known = out.beside.metadata.map(|metadata| metadata.text("a.csv")).unwrap_or_default();
            assert!(out.text.contains(told) || known.contains(told), "{format}: {}", out.text);
            let curve = &back(&out.text).curves[0];
            assert!(curve.values.contains(&1.0), "{format}");
            assert_eq!(curve.values.iter().any(|value| *value > 2.0), grid == Grid::Average(5.0), "{format} {grid:?}");
        }
        assert!(!write(&sheet, format, Grid::Native).unwrap().text.contains("resampling"), "{format}");
    }
    for step in [f64::NAN, 0.0, -5.0, f64::INFINITY] {
        assert_eq!(write(&sheet(Content::Illuminant, &one), Format::Csv, Grid::Average(step)), Err(WriteError::Step));
    }
    let wide = write(&sheet(Content::Illuminant, &one), Format::Csv, Grid::Average(1e4));
    assert_eq!(wide, Err(WriteError::NoOverlap));
}
