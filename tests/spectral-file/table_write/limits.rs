//! Limits of writing: curves that cannot be written, extreme ones, and many at once.

use super::{CAMERA, Curves, back, has, sheet, written};
use spectral_file::write::{Content, Format, Grid, Note, Trace, WriteError, write};

const W: [f64; 4] = [400.0, 410.0, 420.0, 430.0];
const V: [f64; 4] = [0.1, 0.2, 0.3, 0.4];

fn trace<'a>(wavelengths_nm: &'a [f64], values: &'a [f64]) -> Trace<'a> {
    Trace { name: "a", wavelengths_nm, values, uncertainty: None }
}

fn error(content: Content<'_>, curves: &[Trace<'_>], format: Format, grid: Grid) -> WriteError {
    write(&sheet(content, curves), format, grid).unwrap_err()
}

#[test]
fn what_is_no_curve() {
    let bad = |curve: Trace<'_>| error(Content::Other, &[trace(&W, &V), curve], Format::Csv, Grid::Native);
    assert_eq!(error(Content::Other, &[], Format::Csv, Grid::Native), WriteError::NoCurves);
    assert_eq!(bad(trace(&W, &V[1..])), WriteError::Lengths(2));
    assert_eq!(bad(trace(&W[1..2], &V[1..2])), WriteError::TooShort(2));
    for wavelengths in [[2.0, 1.0], [1.0, 1.0], [0.0, 1.0], [1.0, f64::INFINITY], [f64::NAN, 1.0]] {
        assert_eq!(bad(trace(&wavelengths, &[1.0, 2.0])), WriteError::Wavelengths(2), "{wavelengths:?}");
    }
    assert_eq!(bad(trace(&W[..2], &[1.0, f64::NAN])), WriteError::NotFinite(2));
    for step in [0.0, -1.0, 1e-4, f64::NAN, f64::INFINITY] {
        assert_eq!(error(Content::Other, &[trace(&W, &V)], Format::Csv, Grid::Step(step)), WriteError::Step);
    }
}

#[test]
fn what_a_format_does_not_take() {
    let [one, two] = [1, 2].map(|count| vec![trace(&W, &V); count]);
    for content in [Content::Reflectance, Content::Transmittance, Content::Illuminant] {
        let wanted = WriteError::OtherContent(Format::ArgyllCmf);
        assert_eq!(error(content, &one, Format::ArgyllCmf, Grid::Native), wanted);
    }
    let count = |format, found, wanted| WriteError::Count { format, found, wanted };
    let cases = [
        (Content::Observer, &one, Format::ArgyllCmf, count(Format::ArgyllCmf, 1, 3)),
        (Content::Observer, &two, Format::RawtoacesJson, count(Format::RawtoacesJson, 2, 3)),
        (Content::Illuminant, &two, Format::RawtoacesJson, count(Format::RawtoacesJson, 2, 1)),
        (Content::Reflectance, &two, Format::DcamprofJson, count(Format::DcamprofJson, 2, 1)),
        (CAMERA, &two, Format::Csv, WriteError::Channels),
    ];
    for (content, curves, format, wanted) in cases {
        assert_eq!(format.fits(&sheet(content, curves)), Err(wanted));
        assert_eq!(error(content, curves, format, Grid::Native), wanted);
        assert!(!wanted.to_string().is_empty());
    }
}

#[test]
fn steps_that_a_format_does_not_take() {
    let curves = Curves::bells(&["a"], [300.0, 1100.0], 1.0);
    let traces = curves.traces();
    let error = |format, step| error(Content::Other, &traces, format, Grid::Step(step));
    for format in [Format::ArgyllSp, Format::Cgats] {
        assert_eq!(error(format, 0.5), WriteError::StepOfFormat { format, step_nm: 0.5 });
    }
    let (format, step_nm) = (Format::RawtoacesJson, 0.1);
    assert_eq!(error(format, step_nm), WriteError::StepOfFormat { format, step_nm });
    assert_eq!(error(Format::Cgats, 2000.0), WriteError::NoOverlap);
    assert_eq!(error(Format::Csv, 2000.0), WriteError::NoOverlap);
    assert_eq!(
        write(&sheet(Content::Other, &traces), Format::Csv, Grid::Step(0.001)).unwrap().text.lines().count(),
        800_002
    );
}

/// Argyll takes 601 bands: the ends go that hold least, and never a band of 380 to 780 nm.
#[test]
fn more_bands_than_argyll_takes_lose_their_ends() {
    let kept = |range: [f64; 2], peak: f64, grid| {
        let wavelengths: Vec<f64> = (0..=(range[1] - range[0]) as u32).map(|i| range[0] + f64::from(i)).collect();
        let values: Vec<f64> = wavelengths.iter().map(|w| if *w == peak { 1.0 } else { 0.0 }).collect();
        let curve = Trace { name: "a", wavelengths_nm: &wavelengths, values: &values, uncertainty: None };
        let out = written(&sheet(Content::Illuminant, &[curve]), Format::ArgyllSp, grid);
        let back = back(&out.text);
        let [from_nm, to_nm] = back.reading.range_nm;
        let clipped = Note::Clipped { from_nm, to_nm };
        assert!(out.notes.contains(&clipped) && !has(&out.notes, |note| matches!(note, Note::Thinned { .. })));
        let read = &back.curves[0];
        let same = |(w, value): (&f64, &f64)| *value == f64::from(*w == peak);
        assert!(read.wavelengths_nm.iter().zip(&read.values).all(same));
        (from_nm, to_nm)
    };
    for grid in [Grid::Native, Grid::Step(1.0)] {
        assert_eq!(kept([300.0, 1100.0], 500.0, grid), (300.0, 900.0), "the middle nearest to 580 nm");
        assert_eq!(kept([200.0, 1000.0], 500.0, grid), (280.0, 880.0));
        assert_eq!(kept([200.0, 1000.0], 950.0, grid), (350.0, 950.0), "what carries most stays");
        assert_eq!(kept([170.0, 1000.0], 170.0, grid), (280.0, 880.0), "out of reach of 780 nm");
        assert_eq!(kept([170.0, 1000.0], 185.0, grid), (185.0, 785.0));
        assert_eq!(kept([350.0, 960.0], 350.0, grid), (350.0, 950.0));
        assert_eq!(kept([1000.0, 2500.0], 2000.0, grid), (1000.0, 1600.0));
    }
}

#[test]
fn curves_of_different_ranges_share_what_they_have() {
    let long = Curves::bells(&["a", "b"], [380.0, 780.0], 5.0);
    let short = Curves::bells(&["c"], [401.0, 699.0], 2.0);
    let both: Vec<Trace<'_>> = long.traces().into_iter().chain(short.traces()).collect();
    for format in [Format::ArgyllSp, Format::Cgats, Format::RawtoacesJson] {
        let out = written(&sheet(Content::Reflectance, &both), format, Grid::Native);
        let table = back(&out.text);
        assert_eq!((table.reading.range_nm, table.reading.step_nm.max), ([401.0, 699.0], 1.0), "{format}");
        assert!(has(&out.notes, |note| *note == Note::Clipped { from_nm: 401.0, to_nm: 699.0 }), "{:?}", out.notes);
        assert!(has(&out.notes, |note| *note == Note::Resampled { step_nm: 1.0, smooth: true }), "{:?}", out.notes);
    }
    let shifted = Curves::bells(&["c"], [400.0, 900.0], 5.0);
    let both: Vec<Trace<'_>> = long.traces().into_iter().chain(shifted.traces()).collect();
    let out = written(&sheet(Content::Reflectance, &both), Format::Cgats, Grid::Native);
    assert_eq!(out.notes, [Note::Clipped { from_nm: 400.0, to_nm: 780.0 }]);
    let apart = [trace(&W, &V), trace(&[500.0, 510.0], &V[..2])];
    assert_eq!(error(Content::Other, &apart, Format::Cgats, Grid::Native), WriteError::NoOverlap);
}

#[test]
fn a_camera_with_more_channels_and_per_photon() {
    let curves = Curves::bells(&["b", "infrared", "g", "r"], [400.0, 700.0], 10.0);
    let traces = curves.traces();
    let content = Content::Camera { channels: [3, 2, 0], per_photon: Some(true), manufacturer: None, model: None };
    for format in [Format::RawtoacesJson, Format::DcamprofJson, Format::ArgyllCmf] {
        let out = written(&sheet(content, &traces), format, Grid::Native);
        assert!(out.notes.contains(&Note::PerEnergy) && out.notes.contains(&Note::LeftOut(1)));
        assert_eq!(out.notes.contains(&Note::Unidentified), format == Format::RawtoacesJson);
        let table = back(&out.text);
        let wanted = |index: usize, i: usize| traces[index].values[i] * (traces[index].wavelengths_nm[i] / 550.0);
        for (curve, index) in table.curves.iter().zip([3, 2, 0]) {
            let near = |(i, value): (usize, &f64)| (value - wanted(index, i)).abs() <= 2.3e-16 * value;
            assert!(curve.values.iter().enumerate().all(near), "{format}");
        }
    }
    let csv = written(&sheet(content, &traces), Format::CommentedCsv, Grid::Native);
    assert!(csv.notes.is_empty() && csv.text.contains("# response: per photon\n"));
    assert_eq!(back(&csv.text).curves.len(), 4);
}

#[test]
fn values_at_the_ends_of_the_doubles() {
    let values = [f64::MAX, -f64::MAX, 5e-324, 1e-310, -0.0, 1.0 / 3.0, f64::MIN_POSITIVE, 9_007_199_254_740_993.0];
    let wavelengths: Vec<f64> = (0..8).map(|i| 400.0 + 10.0 * f64::from(i)).collect();
    let curves = [trace(&wavelengths, &values)];
    for format in [Format::Csv, Format::ArgyllSp, Format::Cgats] {
        let out = written(&sheet(Content::Illuminant, &curves), format, Grid::Native);
        let bits = |values: &[f64]| values.iter().map(|value| value.to_bits()).collect::<Vec<_>>();
        assert_eq!(bits(&back(&out.text).curves[0].values), bits(&values), "{format}");
        for content in [Content::Illuminant, Content::Reflectance, Content::Observer] {
            let Ok(out) = write(&sheet(content, &curves), format, Grid::Step(1.0)) else { continue };
            assert!(!out.text.contains("inf") && !out.text.contains("NaN"), "{format} {content:?}");
        }
    }
    let tiny = [trace(&[f64::MIN_POSITIVE, 1e-300], &[1.0, 2.0]), trace(&[1e300, 1e308], &[1.0, 2.0])];
    for format in Format::ALL {
        for curve in &tiny {
            for grid in [Grid::Native, Grid::Step(1.0), Grid::Step(1e300)] {
                // Only that it ends: what such files are worth is another matter.
                let _ = write(&sheet(Content::Other, std::slice::from_ref(curve)), format, grid);
            }
        }
    }
}

#[test]
fn twenty_thousand_curves() {
    let names: Vec<String> = (0..20_000).map(|i| format!("patch {i}")).collect();
    let wavelengths: Vec<f64> = (0..31).map(|i| 400.0 + 10.0 * f64::from(i)).collect();
    let values: Vec<f64> = (0..31).map(|i| 0.01 + f64::from(i) / 40.0).collect();
    let curves: Vec<Trace<'_>> = names
        .iter()
        .map(|name| Trace { name, wavelengths_nm: &wavelengths, values: &values, uncertainty: None })
        .collect();
    for format in [Format::Csv, Format::Cgats] {
        let table = back(&written(&sheet(Content::Reflectance, &curves), format, Grid::Native).text);
        assert_eq!((table.curves.len(), table.curves[19_999].name.as_str()), (20_000, "patch 19999"), "{format}");
        assert_eq!(table.curves[777].values, values, "{format}");
    }
    let too_large = write(&sheet(Content::Reflectance, &curves), Format::Csv, Grid::Step(0.01));
    assert_eq!(too_large.unwrap_err(), WriteError::TooLarge);
}
