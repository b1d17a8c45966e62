//! Tests of the written texts against the requirements of the target programs.

use super::{CAMERA, Curves, has, sheet, written};
use chromascope_core::spectral::{Dataset, Response};
use spectral_file::write::{Beside, Content, Format, Grid, Note, Sheet, Trace, write};

const W: [f64; 3] = [400.0, 410.0, 420.0];

fn three() -> [Trace<'static>; 3] {
    let trace = |name, values| Trace { name, wavelengths_nm: &W, values, uncertainty: None };
    [trace("red", &[0.0, 0.25, 1.0]), trace("green", &[0.1, 1.0, 1e-7]), trace("blue", &[1.0, 0.5, -0.0])]
}

fn comments() -> Vec<(String, String)> {
    let pair = |key: &str, value: &str| (key.to_owned(), value.to_owned());
    vec![pair("source", "made\nup"), pair("license", "CC0-1.0"), pair("unit", "not said twice")]
}

#[test]
fn csv() {
    let (curves, comments) = (three(), comments());
    let sheet = Sheet { comments: &comments, ..sheet(CAMERA, &curves) };
    let out = written(&sheet, Format::CommentedCsv, Grid::Native);
    assert_eq!(out.beside, Beside::default());
    let names = ["red", "green", "blue"].map(|name| format!("{name} [relative spectral sensitivity per energy in 1]"));
    let table = format!("wavelength_nm,{}\n400,0,0.1,1\n410,0.25,1,0.5\n420,1,1e-7,-0\n", names.join(","));
    let head =
        "# title: Made up\n# manufacturer: Nobody\n# model: N1\n# quantity: relative spectral sensitivity\n# unit: 1\n";
    let more = "# response: per energy\n# source: made up\n# license: CC0-1.0\n";
    assert_eq!(out.text, format!("{head}{more}{table}"));
    assert_eq!(write(&sheet, Format::Csv, Grid::Native).unwrap().text, table);
    let content = Content::Camera { channels: [0, 1, 2], per_photon: Some(true), manufacturer: None, model: None };
    let own = written(&Sheet { content, ..sheet }, Format::CommentedCsv, Grid::Native);
    let data = Dataset::read(&own.text).unwrap();
    assert_eq!((data.header.response(), data.header.title.as_str()), (Response::PerPhoton, "Made up"));
}

#[test]
fn what_is_known_goes_along() {
    let curves = [Trace { name: "lamp", ..three()[0] }];
    let pair = |key: &str, value: &str| (key.to_owned(), value.to_owned());
    let comments = [pair("license", "CC0-1.0"), pair("License", "MIT"), pair("a: b", "c"), pair("empty", " \n")];
    let lamp = Sheet { title: "", unit: Some("W/m²/nm"), comments: &comments, ..sheet(Content::Illuminant, &curves) };
    let csv = written(&lamp, Format::CommentedCsv, Grid::Native).text;
    let head = "# title: lamp\n# quantity: spectral irradiance\n# unit: W/m²/nm\n# license: CC0-1.0\n# License: MIT\n";
    assert!(
        csv.starts_with(&format!("{head}# a  b: c\nwavelength_nm,lamp [spectral irradiance in W/m²/nm]\n")),
        "{csv}"
    );
    let json = written(&lamp, Format::RawtoacesJson, Grid::Native);
    assert!(json.text.contains("\"license\": \"CC0-1.0; MIT\"") && json.notes.is_empty());
    assert!(json.text.contains("\"comments\": \"quantity: spectral irradiance; unit: W/m²/nm; a: b: c\""));
    let leaf = written(&Sheet { content: Content::Reflectance, ..lamp }, Format::CommentedCsv, Grid::Native).text;
    assert!(leaf.starts_with("# title: lamp\n# quantity: reflectance factor\n# unit: 1\n"), "a fraction has no unit");
}

#[test]
fn csv_of_several_grids_and_odd_names() {
    let a = Trace {
        name: "say \"a, b\"",
        wavelengths_nm: &[401.0, 405.0, 412.0],
        values: &[0.1, 0.5, 0.2],
        uncertainty: None,
    };
    let b = Trace { name: " two\r\nlines ", wavelengths_nm: &[405.0, 500.5], values: &[0.25, 1.0], uncertainty: None };
    let c = Trace { name: "", wavelengths_nm: &[411.0, 412.0], values: &[1.0, 2.0], uncertainty: None };
    let curves = [a, b, c];
    let sheet = sheet(Content::Other, &curves);
    let out = write(&sheet, Format::Csv, Grid::Native).unwrap();
    let no = "[unspecified quantity]";
    let rows = "401,0.1,,\n405,0.5,0.25,\n411,,,1\n412,0.2,,2\n500.5,,1,\n";
    assert_eq!(out.text, format!("wavelength_nm,\"say \"\"a, b\"\" {no}\",two  lines {no},Curve 3 {no}\n{rows}"));
    assert_eq!(out.notes, [Note::Renamed(2)]);
    let out = write(&sheet, Format::Csv, Grid::Step(7.0)).unwrap();
    let rows: Vec<&str> = out.text.lines().skip(1).collect();
    assert_eq!((rows.len(), rows[0].split(',').next(), rows[13].split(',').next()), (14, Some("406"), Some("497")));
    assert!(rows[0].ends_with(','), "the third begins at 411: {}", rows[0]);
    assert!(rows[1].starts_with("413,,0.31"), "the first ends at 412: {}", rows[1]);
    assert!(out.notes.contains(&Note::Blank(1)) && out.notes.contains(&Note::Clipped { from_nm: 406.0, to_nm: 497.0 }));
}

#[test]
fn rawtoaces() {
    let (curves, comments) = (three(), comments());
    let sheet = Sheet { comments: &comments, created: Some("2026-01-01T00:00:00Z"), ..sheet(CAMERA, &curves) };
    let out = written(&sheet, Format::RawtoacesJson, Grid::Native);
    assert!(out.notes.is_empty(), "{:?}", out.notes);
    let wanted = r#"{
    "header": {
        "schema_version": "1.0.0",
        "manufacturer": "Nobody",
        "model": "N1",
        "type": null,
        "description": "Made up",
        "document_creator": "Chromascope",
        "unique_identifier": null,
        "measurement_equipment": null,
        "laboratory": null,
        "document_creation_date": "2026-01-01T00:00:00Z",
        "comments": "quantity: relative spectral sensitivity; response: per energy; source: made up",
        "license": "CC0-1.0"
    },
    "spectral_data": {
        "units": "relative",
        "reflection_geometry": null,
        "transmission_geometry": null,
        "bandwidth_FWHM": null,
        "bandwidth_corrected": null,
        "index": {
            "main": ["R", "G", "B"]
        },
        "data": {
            "main": {
                "400": [0, 0.1, 1],
                "410": [0.25, 1, 0.5],
                "420": [1, 1e-7, -0]
            }
        }
    }
}
"#;
    assert_eq!(out.text, wanted);
}

/// The metadata beside a table, in the vocabulary of CSV on the Web.
#[test]
fn metadata_beside() {
    let comments: Vec<_> = [("license", "CC0-1.0"), ("License", "MIT"), ("note", "say \"a\"\nb")].to_vec();
    let comments: Vec<_> = comments.iter().map(|(key, value)| ((*key).to_owned(), (*value).to_owned())).collect();
    let curves = three();
    let sheet = Sheet { comments: &comments, ..sheet(CAMERA, &curves) };
    let wanted = r#"{
    "@context": "http://www.w3.org/ns/csvw",
    "url": "my%20%C3%A9.csv",
    "dc:title": "Made up",
    "dc:license": "CC0-1.0; MIT",
    "notes": [
        { "manufacturer": "Nobody" },
        { "model": "N1" },
        { "quantity": "relative spectral sensitivity" },
        { "unit": "1" },
        { "response": "per energy" },
        { "note": "say \"a\" b" }
    ]
}
"#;
    assert_eq!(written(&sheet, Format::Csv, Grid::Native).beside.metadata.unwrap().text("my é.csv"), wanted);
}

/// A table of the schema of rawtoaces-data 1.0.0: members that it requires, their types, and texts that are not empty.
#[test]
fn rawtoaces_by_its_schema() {
    let header = [
        ("schema_version", true),
        ("description", true),
        ("document_creation_date", true),
        ("document_creator", true),
        ("license", true),
        ("comments", false),
        ("laboratory", false),
        ("manufacturer", false),
        ("measurement_equipment", false),
        ("model", false),
        ("type", false),
        ("unique_identifier", false),
    ];
    let units = ["transmittance", "reflectance", "relative", "other"];
    let curves = three();
    for content in [CAMERA, Content::Observer, Content::Reflectance, Content::Transmittance, Content::Illuminant] {
        let curves = if content == Content::Illuminant { &curves[..1] } else { &curves };
        for title in ["", "Made up"] {
            let sheet = Sheet { title, created: Some("2026-01-01T00:00:00Z"), ..sheet(content, curves) };
            let out = written(&sheet, Format::RawtoacesJson, Grid::Native).text;
            let json: serde_json::Value = serde_json::from_str(&out).unwrap();
            let found = json["header"].as_object().unwrap();
            assert_eq!(found.len(), header.len(), "{content:?}");
            for (key, required) in header {
                let text = found[key].as_str();
                assert!(if required { text.is_some_and(|text| !text.is_empty()) } else { text != Some("") }, "{key}");
            }
            let data = &json["spectral_data"];
            assert!(units.contains(&data["units"].as_str().unwrap()), "{out}");
            let geometry = |key: &str| data[key].as_str();
            let (reflected, transmitted) = (geometry("reflection_geometry"), geometry("transmission_geometry"));
            assert_eq!(reflected, (content == Content::Reflectance).then_some("other"));
            assert_eq!(transmitted, (content == Content::Transmittance).then_some("other"));
            assert!(["bandwidth_FWHM", "bandwidth_corrected"].iter().all(|key| data[key].is_null()));
            let names = data["index"]["main"].as_array().unwrap();
            let rows = data["data"]["main"].as_object().unwrap();
            assert!(rows.values().all(|row| row.as_array().unwrap().len() == names.len()));
            let places: Vec<_> = ["400", "410", "420"].iter().map(|key| out.find(&format!("\"{key}\": ["))).collect();
            assert!(places.is_sorted() && places[0].is_some(), "in the order of wavelengths: {out}");
        }
    }
}

/// The keys are taken in the order of their text, and distances compared exactly in single precision.
#[test]
fn rawtoaces_gets_only_steps_that_it_takes_for_even() {
    let check = |curves: &Curves, grid: Grid| {
        let traces = curves.traces();
        let out = written(&sheet(Content::Other, &traces), Format::RawtoacesJson, grid);
        let json: serde_json::Value = serde_json::from_str(&out.text).unwrap();
        let rows = json["spectral_data"]["data"]["main"].as_object().unwrap();
        let mut keys: Vec<&str> = rows.keys().map(String::as_str).collect();
        keys.sort_unstable();
        let read: Vec<f32> = keys.iter().map(|key| key.parse().unwrap()).collect();
        let step = read[1] - read[0];
        assert!(step > 0.0 && read.windows(2).all(|pair| pair[1] - pair[0] == step), "{read:?}");
        (read[0], read[read.len() - 1], step, out.notes)
    };
    let wide = check(&Curves::bells(&["a"], [300.0, 1100.0], 5.0), Grid::Native);
    assert_eq!((wide.0, wide.1, wide.2), (300.0, 995.0, 5.0));
    assert_eq!(wide.3, [Note::Clipped { from_nm: 300.0, to_nm: 995.0 }]);
    let half = check(&Curves::bells(&["a"], [300.0, 700.0], 2.5), Grid::Native);
    assert_eq!((half.2, half.3.len()), (2.5, 0));
    let tenth = check(&Curves::bells(&["a"], [380.0, 780.0], 0.1), Grid::Native);
    assert_eq!(tenth.2, 1.0);
    assert!(has(&tenth.3, |note| matches!(note, Note::Thinned { to_nm: 1.0, .. })));
    let third = check(&Curves::bells(&["a"], [380.0, 780.0], 10.0 / 3.0), Grid::Native);
    assert_eq!(third.2, 1.0);
}

#[test]
fn dcamprof() {
    let (curves, comments) = (three(), comments());
    let sheet_of = Sheet { comments: &comments, ..sheet(CAMERA, &curves) };
    let out = written(&sheet_of, Format::DcamprofJson, Grid::Native);
    let wanted = r#"{
    "camera_name": "Made up",
    "comments": [
        "quantity: relative spectral sensitivity",
        "response: per energy",
        "source: made up",
        "license: CC0-1.0"
    ],
    "ssf_bands": [400, 410, 420],
    "red_ssf": [0, 0.25, 1],
    "green_ssf": [0.1, 1, 1e-7],
    "blue_ssf": [1, 0.5, -0]
}
"#;
    assert_eq!(out.text, wanted);
    let bells = Curves::bells(&["a"], [380.0, 780.0], 5.0);
    let light = written(&sheet(Content::Illuminant, &bells.traces()), Format::DcamprofJson, Grid::Native);
    assert!(light.text.starts_with("{\n    \"description\": \"Made up\",\n"), "{}", light.text);
    assert!(light.text.contains("    \"bands\": [380, 780, 5],\n    \"spectrum\": ["));
    assert_eq!(light.notes, [Note::NoNames]);
    let uneven = Trace {
        name: "a",
        wavelengths_nm: &[400.0, 401.5, 420.0, 430.0],
        values: &[1.0, 2.0, 3.0, 4.0],
        uncertainty: None,
    };
    let uneven = written(&sheet(Content::Other, &[uneven]), Format::DcamprofJson, Grid::Native);
    assert!(uneven.text.contains("\"bands\": [400, 401.5, 420, 430]"), "{}", uneven.text);
}

#[test]
fn argyll() {
    let (curves, comments) = (three(), comments());
    let sheet_of = Sheet { comments: &comments, created: Some("2026-01-01"), ..sheet(CAMERA, &curves) };
    let cmf = written(&sheet_of, Format::ArgyllCmf, Grid::Native);
    let wanted = "CMF\n\nDESCRIPTOR \"Made up\"\nORIGINATOR \"Chromascope\"\nCREATED \"2026-01-01\"\n\
        # quantity: relative spectral sensitivity\n# response: per energy\n# source: made up\n# license: CC0-1.0\n\n\
        KEYWORD \"MEAS_TYPE\"\nMEAS_TYPE \"SENSITIVITY\"\nKEYWORD \"SPECTRAL_BANDS\"\nSPECTRAL_BANDS \"3\"\n\
        KEYWORD \"SPECTRAL_START_NM\"\nSPECTRAL_START_NM \"400.0\"\nKEYWORD \"SPECTRAL_END_NM\"\n\
        SPECTRAL_END_NM \"420.0\"\nKEYWORD \"SPECTRAL_NORM\"\nSPECTRAL_NORM \"1.0\"\n\nNUMBER_OF_FIELDS 3\n\
        BEGIN_DATA_FORMAT\nSPEC_400 SPEC_410 SPEC_420\nEND_DATA_FORMAT\n\nNUMBER_OF_SETS 3\nBEGIN_DATA\n\
        0.0 0.25 1.0\n0.1 1.0 1.0e-7\n1.0 0.5 -0.0\nEND_DATA\n";
    assert_eq!((cmf.text.as_str(), cmf.notes.as_slice()), (wanted, [Note::NoNames].as_slice()));
    let lamp = written(&sheet(Content::Illuminant, &curves[..1]), Format::ArgyllSp, Grid::Native);
    assert!(
        lamp.text.starts_with("SPECT\n\nDESCRIPTOR \"Made up\"\n") && lamp.text.contains("MEAS_TYPE \"EMISSION\"\n")
    );
    assert!(lamp.text.ends_with("NUMBER_OF_SETS 1\nBEGIN_DATA\n0.0 0.25 1.0\nEND_DATA\n"), "{}", lamp.text);
}

#[test]
fn cgats() {
    let mut curves = three();
    curves[1].name = "5\" \tgreen";
    let out = written(&sheet(Content::Reflectance, &curves), Format::Cgats, Grid::Native);
    assert!(out.text.starts_with("CGATS.17\n\nDESCRIPTOR \"Made up\"\nORIGINATOR \"Chromascope\"\n"), "{}", out.text);
    let table = "KEYWORD \"SAMPLE_NAME\"\n\nNUMBER_OF_FIELDS 5\nBEGIN_DATA_FORMAT\n\
        SAMPLE_ID SAMPLE_NAME SPECTRAL_NM_400 SPECTRAL_NM_410 SPECTRAL_NM_420\nEND_DATA_FORMAT\n\nNUMBER_OF_SETS 3\n\
        BEGIN_DATA\n1 \"red\" 0.0 0.25 1.0\n2 \"5\"\"  green\" 0.1 1.0 1.0e-7\n3 \"blue\" 1.0 0.5 -0.0\nEND_DATA\n";
    assert!(out.text.ends_with(table), "{}", out.text);
    assert_eq!(out.notes, [Note::Renamed(1)]);
}

/// Argyll computes the wavelength of each band from the ends and looks for a field with that number, rounded.
#[test]
fn argyll_finds_every_band() {
    let grids = [([380.0, 730.0], 10.0), ([350.0, 740.0], 10.0 / 3.0), ([300.5, 900.5], 1.0), ([200.0, 1100.0], 1.0)];
    for (range, step) in grids {
        for format in [Format::ArgyllSp, Format::Cgats] {
            let curves = Curves::bells(&["a"], range, step);
            let out = written(&sheet(Content::Reflectance, &curves.traces()), format, Grid::Native);
            let keyword = |key: &str| -> f64 {
                let line = out.text.lines().find(|line| line.starts_with(&format!("{key} \""))).unwrap();
                line.split('"').nth(1).unwrap().parse().unwrap()
            };
            let (bands, start) = (keyword("SPECTRAL_BANDS"), keyword("SPECTRAL_START_NM"));
            let end = keyword("SPECTRAL_END_NM");
            assert!(format == Format::Cgats || bands <= 601.0);
            let fields: Vec<&str> = out
                .text
                .lines()
                .find(|line| line.contains("_NM_") || line.starts_with("SPEC_"))
                .unwrap_or_default()
                .split(' ')
                .collect();
            for band in 0..bands as usize {
                let nm = start + band as f64 / (bands - 1.0) * (end - start);
                let wanted = format!("_{:03}", (nm + 0.5) as u32);
                assert_eq!(fields.iter().filter(|field| field.ends_with(&wanted)).count(), 1, "{wanted} {step}");
            }
            let values = out.text.lines().skip_while(|line| *line != "BEGIN_DATA").nth(1).unwrap();
            assert!(values.split(' ').filter(|cell| !cell.starts_with('"')).skip(1).all(|cell| cell.contains('.')));
        }
    }
}
