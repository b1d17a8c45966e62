//! Every format, content and grid, there and back.

use super::{CAMERA, Curves, Sheet, back, bell, beside, has, sheet, written};
use chromascope_core::spectral::{GridSpectrum, Quantity, SpectralDistribution};
use spectral_file::write::{Beside, Content, Format, Grid, Note, Trace, Written, write};
use spectral_file::{Certainty, Curve, Role};

const CONTENTS: [Content<'static>; 6] =
    [CAMERA, Content::Observer, Content::Reflectance, Content::Transmittance, Content::Illuminant, Content::Other];

/// Returns whether two doubles are equal but for the last bit, which a reader of JSON may lose.
fn same(format: Format, a: f64, b: f64) -> bool {
    let json = matches!(format, Format::RawtoacesJson | Format::DcamprofJson);
    a == b || (json && (a - b).abs() <= 2.3e-16 * a.abs())
}

/// Each content with as many curves as a format takes.
fn each(mut check: impl FnMut(Format, Content<'static>, &[&str])) {
    for format in Format::ALL {
        for content in CONTENTS {
            for names in [["red", "green", "blue"].as_slice(), ["one"].as_slice()] {
                let curves = Curves::bells(names, [400.0, 700.0], 10.0);
                if format.fits(&sheet(content, &curves.traces())).is_ok() {
                    check(format, content, names);
                }
            }
        }
    }
}

#[test]
fn own_wavelengths_come_back_to_the_last_bit() {
    let mut count = 0;
    each(|format, content, names| {
        for step in [1.0, 4.0, 5.0, 10.0] {
            let curves = Curves::bells(names, [400.0, 700.0], step);
            let traces = curves.traces();
            let out = written(&sheet(content, &traces), format, Grid::Native);
            let kept = |note: &Note| !matches!(note, Note::NoNames);
            assert!(!out.notes.iter().any(kept), "{format} {content:?}: {:?}", out.notes);
            let table = back(&out.text);
            assert_eq!(table.curves.len(), names.len(), "{format} {content:?}");
            for (curve, trace) in table.curves.iter().zip(&traces) {
                assert_eq!(curve.wavelengths_nm, trace.wavelengths_nm, "{format} {content:?}");
                let mut pairs = curve.values.iter().zip(trace.values);
                assert!(pairs.all(|(a, b)| same(format, *a, *b)), "{format} {content:?} {step}");
            }
            count += 1;
        }
    });
    assert_eq!(count, 62 * 4);
}

/// The largest errors so far: by polynomials inside, by polynomials in the two cells at each end, and linearly.
#[derive(Debug, Default)]
struct Worst([f64; 3]);

impl Worst {
    fn take(&mut self, curve: &Curve, index: usize, native: f64, straight: bool) {
        for (&w, &value) in curve.wavelengths_nm.iter().zip(&curve.values) {
            let end = (w - 400.0).min(700.0 - w) < 2.0 * native;
            let worst = &mut self.0[if straight { 2 } else { usize::from(end) }];
            *worst = worst.max((value - bell(index, w)).abs());
        }
    }
}

#[test]
fn other_grids_come_back_within_the_error_of_interpolation() {
    let mut worst = [Worst::default(), Worst::default()];
    each(|format, content, names| {
        for (worst, native) in worst.iter_mut().zip([5.0, 10.0]) {
            let curves = Curves::bells(names, [400.0, 700.0], native);
            let traces = curves.traces();
            for step in [1.0, 5.0, 10.0] {
                let out = written(&sheet(content, &traces), format, Grid::Step(step));
                assert_eq!(has(&out.notes, |note| matches!(note, Note::Resampled { .. })), step < native);
                assert_eq!(has(&out.notes, |note| matches!(note, Note::Thinned { .. })), step > native);
                let straight = matches!(content, Content::Illuminant | Content::Other);
                for (index, curve) in back(&out.text).curves.iter().enumerate() {
                    let grid = (0..=(300.0 / step) as u32).map(|i| 400.0 + step * f64::from(i));
                    assert!(grid.eq(curve.wavelengths_nm.iter().copied()), "{format} {content:?} {step}");
                    worst.take(curve, index, native, straight);
                    let mut samples =
                        curve.wavelengths_nm.iter().zip(&curve.values).filter(|(w, _)| *w % native == 0.0);
                    assert!(samples.all(|(w, value)| same(format, *value, bell(index, *w))), "{format} {step}");
                }
            }
        }
    });
    // As the documentation of the module has them.
    let told = [[4e-6, 6e-4, 3.5e-3], [1.2e-4, 2.5e-3, 1.4e-2]];
    for (found, told) in worst.iter().zip(told) {
        assert!(found.0.iter().zip(told).all(|(found, told)| *found < told && *found > told / 3.0), "{worst:?}");
    }
}

#[test]
fn resampling_is_what_the_program_computes_with() {
    let contents = [
        (Content::Reflectance, Quantity::Reflectance),
        (CAMERA, Quantity::CameraSensitivity),
        (Content::Observer, Quantity::MatchingFunction),
        (Content::Illuminant, Quantity::Light),
    ];
    for (content, quantity) in contents {
        for step in [2.0, 5.0, 10.0] {
            let mut curves = Curves::bells(&["a", "b", "c"], [380.0, 780.0], step);
            for (index, value) in curves.0[1].2.iter_mut().enumerate() {
                *value *= if index % 3 == 0 { 1.0 } else { 0.4 };
            }
            let traces = curves.traces();
            let table = back(&write(&sheet(content, &traces), Format::Csv, Grid::Step(1.0)).unwrap().text);
            for (curve, trace) in table.curves.iter().zip(&traces) {
                let distribution = SpectralDistribution::new(trace.wavelengths_nm.to_vec(), trace.values.to_vec());
                let ours = GridSpectrum::resample(&distribution.unwrap(), quantity);
                assert_eq!(curve.values, ours.values(), "{content:?} {step}");
            }
        }
    }
}

#[test]
fn what_they_are_comes_back() {
    let curves = Curves::bells(&["R", "G", "B"], [400.0, 700.0], 10.0);
    let (three, one) = (curves.traces(), &curves.traces()[2..]);
    let camera = beside(&written(&sheet(CAMERA, &three), Format::Csv, Grid::Native));
    assert_eq!((camera.role.value, camera.reading.camera_columns), (Role::Camera, Some([0, 1, 2])));
    assert_eq!(camera.reading.comment("manufacturer"), Some("Nobody"));
    assert_eq!(camera.reading.comment("response"), Some("per energy"));
    for format in [Format::RawtoacesJson, Format::DcamprofJson] {
        let camera = back(&written(&sheet(CAMERA, &three), format, Grid::Native).text);
        assert_eq!((camera.role.value, camera.reading.camera_columns), (Role::Camera, Some([0, 1, 2])));
    }
    for format in [Format::RawtoacesJson, Format::DcamprofJson, Format::ArgyllCmf] {
        let energy = back(&written(&sheet(CAMERA, &three), format, Grid::Native).text).reading.per_photon.unwrap();
        assert_eq!((energy.value, energy.certainty), (false, Certainty::Certain), "{format}");
        let open = Content::Camera { channels: [0, 1, 2], per_photon: None, manufacturer: None, model: None };
        let open = back(&written(&sheet(open, &three), format, Grid::Native).text).reading.per_photon.unwrap();
        assert_eq!(open.certainty, Certainty::Guess, "{format}");
    }
    let light = back(&written(&sheet(Content::Illuminant, one), Format::RawtoacesJson, Grid::Native).text);
    assert_eq!((light.role.value, light.curves[0].name.as_str()), (Role::Illuminant, "Made up"));
    let light = back(&written(&sheet(Content::Illuminant, one), Format::Csv, Grid::Native).text);
    assert_eq!((light.role.value, light.curves[0].name.as_str()), (Role::Illuminant, "B"));
    let leaf = back(&written(&sheet(Content::Reflectance, one), Format::Csv, Grid::Native).text);
    assert_eq!(leaf.role.value, Role::Reflectance);
    assert_eq!(leaf.curves[0].values, one[0].values);
}

#[test]
fn what_curves_are_is_certain_in_every_format() {
    use spectral_file::Quantity as Is;
    each(|format, content, names| {
        let (role, quantity) = match content {
            CAMERA | Content::Observer => (Role::Camera, Is::Sensitivity),
            Content::Reflectance => (Role::Reflectance, Is::Reflectance),
            Content::Transmittance => (Role::Transmittance, Is::Transmittance),
            Content::Illuminant => (Role::Illuminant, Is::SpectralPower),
            _ => (Role::Unknown, Is::Unknown),
        };
        let curves = Curves::bells(names, [400.0, 700.0], 10.0);
        let traces = curves.traces();
        let units = [("W/m²/nm", Is::Irradiance), ("mW/sr/m²/nm", Is::Radiance), ("W/nm", Is::RadiantFlux)];
        let units = units.into_iter().filter(|_| content == Content::Illuminant).map(|(unit, is)| (Some(unit), is));
        for (unit, quantity) in units.chain([(None, quantity)]) {
            let sheet = Sheet { unit, ..sheet(content, &traces) };
            let mut texts = vec![written(&sheet, format, Grid::Native)];
            if format == Format::Csv {
                // Without the lines above the table, its heads say it; without its heads, those lines or the metadata beside.
                let full = written(&sheet, Format::CommentedCsv, Grid::Native).text;
                let bare = format!("wavelength_nm,{}\n", names.join(","));
                let above = full.lines().filter(|line| line.starts_with('#')).map(|line| format!("{line}\n"));
                let plain = texts[0].clone();
                let rows = plain.text.split_once('\n').unwrap().1;
                let alone = |text| Written { text, beside: Beside::default(), notes: Vec::new() };
                let below = above.chain([bare.clone(), rows.to_owned()]).collect();
                texts.extend([below, full.clone(), plain.text.clone()].map(alone));
                // An open question has no words that metadata could give.
                if content != Content::Other {
                    texts.push(Written { text: format!("{bare}{rows}"), ..plain.clone() });
                }
            }
            for written in texts {
                let (table, text) = (beside(&written), &written.text);
                let found = (table.role.value, table.role.certainty);
                assert_eq!(
                    found,
                    (role, Certainty::Certain),
                    "{format} {content:?} {unit:?}: {}\n{text}",
                    table.role.why
                );
                assert_ne!(table.reading.values.certainty, Certainty::Open, "{format} {content:?} {unit:?}");
                // rawtoaces has a list of its own for units.
                let kept = content != Content::Illuminant || format != Format::RawtoacesJson;
                assert!(
                    !kept || table.reading.quantity.value == quantity,
                    "{format} {content:?} {unit:?}: {:?}",
                    table.reading.quantity
                );
                assert!(!kept || unit.is_none() || table.curves[0].unit.as_deref() == unit, "{format} {content:?}");
                let per_photon = table.reading.per_photon.filter(|_| content == CAMERA);
                assert!(per_photon.is_none_or(|said| said.certainty == Certainty::Certain && !said.value), "{format}");
            }
        }
    });
}

/// What stood above a table comes back from the metadata beside it; the table's own words come first.
#[test]
fn metadata_are_what_comments_were() {
    let pair = |key: &str, value: &str| (key.to_owned(), value.to_owned());
    let comments = [pair("source", "here"), pair("license", "CC0-1.0"), pair("note", "one"), pair("note", "two")];
    let curves = Curves::bells(&["R", "G", "B"], [400.0, 700.0], 10.0);
    let traces = curves.traces();
    for (content, unit) in [(CAMERA, None), (Content::Illuminant, Some("W/m²/nm")), (Content::Reflectance, None)] {
        let sheet = Sheet { unit, comments: &comments, ..sheet(content, &traces) };
        for grid in [Grid::Native, Grid::Average(20.0)] {
            let [plain, above] = [Format::Csv, Format::CommentedCsv].map(|format| written(&sheet, format, grid));
            assert!(plain.text.starts_with("wavelength_nm,R ["), "{}", plain.text);
            let (mut plain, mut above) = (beside(&plain), beside(&above));
            plain.reading.header.sort();
            above.reading.header.sort();
            assert_eq!(plain.reading.header, above.reading.header);
            assert_eq!((&plain.curves, plain.role.value), (&above.curves, above.role.value));
        }
        let stale = written(&Sheet { content: Content::Transmittance, ..sheet }, Format::Csv, Grid::Native).beside;
        let read = beside(&Written { beside: stale, ..written(&sheet, Format::Csv, Grid::Native) });
        let own = beside(&written(&sheet, Format::Csv, Grid::Native));
        assert_eq!((read.role.value, read.reading.quantity), (own.role.value, own.reading.quantity));
    }
}

#[test]
fn a_read_file_goes_out_and_comes_back() {
    let table = back("wavelength_nm,a,b\n400,0.1,\n405,0.2,0.7\n410.5,,0.3\n420,0.25,0.2\n");
    let traces: Vec<Trace<'_>> = table.curves.iter().map(Trace::from).collect();
    let again = back(&write(&sheet(Content::Reflectance, &traces), Format::Csv, Grid::Native).unwrap().text);
    let bare = |curve: &Curve| (curve.name.clone(), curve.wavelengths_nm.clone(), curve.values.clone());
    assert!(again.curves.iter().map(bare).eq(table.curves.iter().map(bare)));
}

#[test]
fn names_that_mean_other_values_are_replaced() {
    let curves =
        Curves::bells(&["wavelength x", "leaf %", "Absorbance", "dBm", "nm", "50% gray"], [400.0, 700.0], 10.0);
    let traces = curves.traces();
    for content in [Content::Reflectance, Content::Transmittance, Content::Illuminant, Content::Other] {
        let plain = write(&sheet(content, &traces), Format::Csv, Grid::Native).unwrap();
        let full = written(&sheet(content, &traces), Format::Csv, Grid::Native);
        let sp = written(&sheet(content, &traces), Format::Cgats, Grid::Native);
        for written in [plain, full, sp] {
            assert!(written.notes.contains(&Note::Renamed(5)), "{:?}", written.notes);
            let table = back(&written.text);
            assert_eq!(table.curves.len(), 6, "{content:?}");
            for (curve, (_, _, values)) in table.curves.iter().zip(&curves.0) {
                assert_eq!(&curve.values, values, "{content:?} {}", curve.name);
            }
            assert_eq!((table.curves[0].name.as_str(), table.curves[5].name.as_str()), ("Curve 1", "50% gray"));
            assert_eq!(table.curves[1].name, "leaf");
        }
    }
}
