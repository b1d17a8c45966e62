//! Tests of `figure`: forms by the ending, size of the page, sessions.

use std::fs;

use chromascope::figures::FIGURES;
use chromascope::panes;
use chromascope_core::query::CameraMetric;
use serde_json::Value;

use super::run;

#[test]
fn a_figure_takes_the_form_of_its_file_and_the_session_it_is_given() {
    let folder = tempfile::tempdir().expect("a folder");
    let at = |name: &str| folder.path().join(name).to_string_lossy().into_owned();
    fs::write(at("work.json"), "{\"format\":\"chromascope\",\"version\":1,\"diagram\":\"uv-prime\"}").expect("written");
    for (name, beginning) in [
        ("a.pdf", &b"%PDF-"[..]),
        ("a.svg", b"<svg"),
        ("a.png", b"\x89PNG"),
        ("a.tif", b"II*\0"),
        ("a.csv", b"sensor,"),
        ("a.json", b"{"),
    ] {
        let out = at(name);
        let done = run(&["figure", "chromaticity", "--session", &at("work.json"), "--width", "3in", "--out", &out]);
        assert!(done.status.success(), "{name}: {}", String::from_utf8_lossy(&done.stderr));
        assert!(fs::read(&out).expect("a file").starts_with(beginning), "{name}");
    }
    let svg = fs::read_to_string(at("a.svg")).expect("text");
    assert!(svg.contains("width=\"76.2mm\""));
    assert!(svg.contains(">u′</text>") && svg.contains(">v′</text>"), "the diagram of the session");
}

#[test]
fn a_figure_without_a_form_or_a_unit_is_refused() {
    let turned = &["--orbit", "30,20,5", "--out", "figure.pdf"];
    for arguments in [&["--out", "figure.txt"][..], &[], &["--width", "85", "--out", "figure.pdf"], turned] {
        let done = run(&[&["figure", "spectra"], arguments].concat());
        assert_eq!(done.status.code(), Some(2), "{arguments:?}");
    }
}

#[test]
fn skipped_work_says_where_its_table_is() {
    let done = run(&["figure", "work-saved", "--out", "figure.pdf"]);
    let said = String::from_utf8_lossy(&done.stderr).into_owned();
    assert!(!done.status.success() && said.contains("render --stats"), "{said}");
}

#[test]
fn every_kind_of_figure_is_listed_and_panes_have_no_others() {
    let help = String::from_utf8(run(&["figure", "--help"]).stdout).expect("text");
    for kind in FIGURES {
        assert!(help.contains(&format!("- {}:", kind.key)), "{} is not in\n{help}", kind.key);
        assert_eq!(FIGURES.iter().filter(|other| other.key == kind.key).count(), 1, "{}", kind.key);
    }
    for (pane, kind) in panes::ALL.iter().filter_map(|pane| Some((pane, pane.figure?))) {
        assert!(FIGURES.iter().any(|listed| std::ptr::eq(*listed, kind)), "{}", pane.title);
        assert_eq!(kind.key, pane.title.to_lowercase().replace(' ', "-"));
    }
}

#[test]
fn every_figure_of_a_scene_is_made_at_one_column() {
    let folder = tempfile::tempdir().expect("a folder");
    let at = |name: &str| folder.path().join(name).to_string_lossy().into_owned();
    let raw = "patch,R,G,B\ndark skin,0.12,0.09,0.06\nlight skin,0.38,0.29,0.25\nblue sky,0.16,0.19,0.31\n\
               foliage,0.11,0.14,0.06\nblue flower,0.25,0.22,0.40\nbluish green,0.29,0.43,0.43\n";
    fs::write(at("raw.csv"), raw).expect("written");
    let curves = "nm,first,second\n400,0.1,0.3\n500,0.5,0.2\n600,0.7,0.1\n700,0.8,0.9\n";
    fs::write(at("curves.csv"), curves).expect("written");
    let (raw, curves) = (at("raw.csv"), at("curves.csv"));
    for (kind, arguments) in [
        ("strip", &[][..]),
        ("light", &["--illuminant", "A"]),
        ("render", &["--mesh", "sphere", "--dpi", "40", "--orbit", "30,-20,5"]),
        ("difference", &["--mesh", "plane", "--dpi", "40"]),
        ("head-to-head", &[]),
        ("report-card", &[]),
        ("recorded", &[raw.as_str()]),
        ("curves", &[curves.as_str()]),
        ("correction", &["--second-light", "A"]),
    ] {
        let out = at(&format!("{kind}.svg"));
        let done = run(&[&["figure", kind, "--out", &out], arguments].concat());
        assert!(done.status.success(), "{kind}: {}", String::from_utf8_lossy(&done.stderr));
        let svg = fs::read_to_string(&out).expect("a file");
        assert!(svg.contains("width=\"85mm\"") && svg.contains("<text"), "{kind}");
    }
}

#[test]
fn words_are_of_what_is_drawn() {
    let folder = tempfile::tempdir().expect("a folder");
    let drawn = |kind: &str, options: &[&str]| {
        let out = folder.path().join("figure.svg").to_string_lossy().into_owned();
        let done = run(&[&["figure", kind, "--force", "--out", &out], options].concat());
        assert!(done.status.success(), "{kind}: {}", String::from_utf8_lossy(&done.stderr));
        fs::read_to_string(&out).expect("a file")
    };
    // The reference has no distance to itself, and no CIE observer one to a camera by Eq 13.
    let strip = drawn("strip", &["--preset", "paper"]);
    assert!(strip.contains(">Kodak DCS200</text>") && !strip.contains("(reference)</text>"));
    assert!(!strip.contains(">CIE 1931 2°</text>"));
    // A legend names sensors once; without one they are named at their loci.
    let named = |svg: &str| svg.matches(">Kodak DCS200</text>").count();
    assert_eq!(named(&drawn("chromaticity", &[])), 1);
    assert_eq!(named(&drawn("chromaticity", &["--legend", "none"])), 1);
    assert!(!drawn("differences", &["--plane", "loci"]).contains("Patches:"));
    // Each camera has its map, the reference being among them or not.
    let two = ["--camera", "Kodak DCS200", "--camera", "Nikon D200", "--mesh", "plane", "--dpi", "36"];
    let maps = drawn("difference", &two);
    assert!(maps.contains("DCS200</text>") && maps.contains("D200</text>") && maps.matches("<image").count() == 3);
    assert!(drawn("spectra", &["--preset", "paper"]).contains("five of"));
}

#[test]
fn axes_end_where_they_are_told_to_and_layers_are_left_out() {
    let folder = tempfile::tempdir().expect("a folder");
    let drawn = |kind: &str, options: &[&str]| {
        let out = folder.path().join("figure.svg").to_string_lossy().into_owned();
        let done = run(&[&["figure", kind, "--force", "--out", &out], options].concat());
        assert!(done.status.success(), "{kind}: {}", String::from_utf8_lossy(&done.stderr));
        fs::read_to_string(&out).expect("a file")
    };
    let spectra = drawn("spectra", &["--x-range", "500,600", "--typeface", "serif"]);
    assert!(spectra.contains(">500</text>") && spectra.contains(">600</text>") && !spectra.contains(">400</text>"));
    assert!(spectra.contains("font-family=\"Tinos,"));
    let whole = drawn("chromaticity", &[]);
    let bare = drawn("chromaticity", &["--no-loci", "--x-range", "0.3,0.5", "--y-range", "0.3,0.42"]);
    assert!(whole.contains("Loci from") && whole.contains("Rings") && !bare.contains("Loci from 1000"), "{bare}");
    assert!(bare.contains(">0.35</text>") && !bare.contains(">0.8</text>"));
    let arrows = run(&["figure", "differences", "--y-range", "0,0.01", "--force", "--out", "arrows.svg"]);
    let why = String::from_utf8_lossy(&arrows.stderr);
    assert!(arrows.status.code() == Some(2) && why.contains("--y-range") && why.contains("no axis"), "{why}");
}

#[test]
fn many_curves_are_named_in_the_caption() {
    let folder = tempfile::tempdir().expect("a folder");
    let at = |name: &str| folder.path().join(name).to_string_lossy().into_owned();
    let line =
        |first: String, cell: &dyn Fn(u32) -> String| (0..14).fold(first, |line, i| line + "," + &cell(i)) + "\n";
    let head = line("wavelength".to_owned(), &|curve| format!("leaf{curve}"));
    let row = |tens: u32| line((10 * tens).to_string(), &|curve| (0.01 * f64::from(curve + 1)).to_string());
    fs::write(at("leaves.csv"), (38..=78).fold(head, |text, tens| text + &row(tens))).expect("written");
    let done = run(&["figure", "curves", &at("leaves.csv"), "--out", &at("leaves.svg")]);
    assert!(done.status.success(), "{}", String::from_utf8_lossy(&done.stderr));
    let svg = fs::read_to_string(at("leaves.svg")).expect("a file");
    assert!((0..14).all(|curve| svg.contains(&format!("leaf{curve}"))), "{svg}");
}

/// Value and uncertainty of each metric's column of a camera, by `compare`.
fn compared(camera: &str, options: &[&str]) -> Vec<(String, [Option<f64>; 2])> {
    let named = ["compare", "--camera", camera, "--metrics", "all", "--format", "json"];
    let object: Value = serde_json::from_slice(&run(&[&named[..], options].concat()).stdout).expect("JSON");
    let value = |metric: &CameraMetric| {
        let told = &object["cameras"][0]["values"][metric.id];
        (metric.column.to_owned(), ["value", "uncertainty"].map(|key| told[key].as_f64()))
    };
    CameraMetric::ALL.iter().map(value).collect()
}

/// Rows of a figure's numbers by their columns.
fn numbers(kind: &str, arguments: &[&str]) -> Vec<serde_json::Map<String, Value>> {
    let out = tempfile::Builder::new().suffix(".json").tempfile().expect("a file");
    let path = out.path().to_string_lossy().into_owned();
    let done = run(&[&["figure", kind, "--force", "--out", &path], arguments].concat());
    assert!(done.status.success(), "{kind}: {}", String::from_utf8_lossy(&done.stderr));
    let object: Value = serde_json::from_str(&fs::read_to_string(&path).expect("a file")).expect("JSON");
    let heads: Vec<String> = serde_json::from_value(object["columns"].clone()).expect("heads");
    let rows = object["rows"].as_array().expect("rows").iter();
    rows.map(|row| heads.iter().cloned().zip(row.as_array().expect("cells").iter().cloned()).collect()).collect()
}

#[test]
fn figures_of_metrics_have_the_numbers_and_the_temperature_of_compare() {
    let pair = ["Nikon D70 (A.M.P.A.S.)", "Sigma SD1"];
    for (options, kelvin) in [
        (&[][..], "2856"),
        (&["--temperature", "4100", "--full-well", "40000", "--read-noise", "3"], "4100"),
        (&["--illuminant", "blackbody:3000"], "3000"),
    ] {
        let wanted = pair.map(|camera| compared(camera, options));
        assert!(wanted[0].iter().filter(|(_, [value, by])| value.is_some() && by.is_some()).count() > 30);
        let cameras = [&["--camera", pair[0], "--camera", pair[1]], options].concat();
        let said = |row: &serde_json::Map<String, Value>| assert_eq!(row["temperature_k"], kelvin, "{options:?}");
        let card = numbers("report-card", &[&["--camera", pair[0]], options].concat());
        for (row, (column, value)) in card.iter().zip(&wanted[0]) {
            let told = ["value", "uncertainty"].map(|key| row[key].as_f64());
            assert_eq!((row["metric"].as_str(), told), (Some(column.as_str()), *value), "{options:?}");
            said(row);
        }
        let rows = numbers("head-to-head", &cameras);
        assert_eq!(rows.len(), wanted[0].len());
        for (index, row) in rows.iter().enumerate() {
            let [[a, u], [b, v]] = [0, 1].map(|camera| wanted[camera][index].1);
            let told = ["A", "A uncertainty", "B", "B uncertainty"].map(|key| row[key].as_f64());
            assert_eq!(told, [a, u, b, v], "{options:?}: {row:?}");
            assert_eq!(row["A − B"].as_f64(), a.zip(b).map(|(a, b)| a - b));
            said(row);
        }
        let all = numbers("metrics", &cameras);
        let row = all.iter().find(|row| row["camera"] == pair[0]).expect("the camera");
        for (column, value) in &wanted[0] {
            let told = [row[column].as_f64(), row[&format!("{column}_uncertainty")].as_f64()];
            assert_eq!(told, *value, "{options:?}: {column}");
        }
        said(row);
        let svg = tempfile::Builder::new().suffix(".svg").tempfile().expect("a file");
        let path = svg.path().to_string_lossy().into_owned();
        assert!(
            run(&[&["figure", "head-to-head", "--force", "--width", "180mm", "--out", &path], &cameras[..]].concat())
                .status
                .success()
        );
        let svg = fs::read_to_string(&path).expect("a file");
        // Lines of the caption are texts of their own.
        let words: Vec<&str> = svg.split('<').filter_map(|tag| Some(tag.split_once('>')?.1.trim())).collect();
        let words = words.join(" ").split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(words.contains(&format!("Locus metrics at {kelvin} K.")), "{words}");
    }
}

#[test]
fn a_temperature_that_the_light_contradicts_or_the_window_lacks_is_refused() {
    let of_light = ["--illuminant", "blackbody:3000", "--temperature", "4000"];
    for (arguments, words) in [(&of_light[..], "leave --temperature out"), (&["--temperature", "100"], "1000 to 20000")]
    {
        let done = run(&[&["figure", "report-card", "--out", "card.pdf"], arguments].concat());
        let said = String::from_utf8_lossy(&done.stderr);
        assert!(done.status.code() == Some(2) && said.contains(words), "{said}");
    }
    let done = run(&["figure", "report-card", "--out", "card.pdf", "--full-well", "-1"]);
    assert!(!done.status.success());
}

#[test]
fn more_cameras_than_a_figure_shows_are_refused() {
    let cameras = ["--camera", "Nikon D200", "--camera", "Kodak DCS200", "--camera", "Nikon D3300"];
    for (kind, arguments, words) in [
        ("report-card", &cameras[..4], "`report-card` shows one camera, and 2 are named"),
        ("correction", &["--second-light", "A", cameras[0], cameras[1], cameras[2], cameras[3]], "shows one camera"),
        ("head-to-head", &cameras, "`head-to-head` shows two cameras, and 3 are named"),
    ] {
        let done = run(&[&["figure", kind, "--out", "card.pdf"], arguments].concat());
        let said = String::from_utf8_lossy(&done.stderr);
        assert!(done.status.code() == Some(2) && said.contains(words), "{said}");
    }
}

#[test]
fn numbers_are_all_or_those_within_the_axes() {
    let folder = tempfile::tempdir().expect("a folder");
    let rows = |name: &str, arguments: &[&str]| {
        let out = folder.path().join(name).to_string_lossy().into_owned();
        let done = run(&[&["figure", "chromaticity", "--out", &out], arguments].concat());
        assert!(done.status.success(), "{}", String::from_utf8_lossy(&done.stderr));
        let text = fs::read_to_string(&out).expect("a file");
        text.lines().skip(1).map(|line| line.split(',').map(str::to_owned).collect()).collect::<Vec<Vec<String>>>()
    };
    let range = ["--range", "0.3,0.4,0.3,0.4"];
    let all = rows("all.csv", &range);
    let visible = rows("visible.csv", &[&range[..], &["--numbers", "visible"]].concat());
    assert!(!visible.is_empty() && visible.len() < all.len() / 2, "{} of {}", visible.len(), all.len());
    // The diagram enlarges one range to equal units on both axes.
    assert!(visible.iter().all(|row| all.contains(row) && row[5].parse::<f64>().is_ok_and(|y| y > 0.2 && y < 0.5)));
    let data = rows("data.csv", &["--numbers", "visible"]);
    assert!(data.len() > visible.len());
}

#[test]
fn a_height_that_rows_do_not_have_is_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    let out = folder.path().join("a.svg").to_string_lossy().into_owned();
    let done = run(&["figure", "head-to-head", "--height", "50mm", "--out", &out]);
    assert_eq!(done.status.code(), Some(2));
    assert!(String::from_utf8_lossy(&done.stderr).contains("mm high"));
    let done = run(&["figure", "chromaticity", "--height", "120mm", "--out", &out]);
    assert!(done.status.success(), "{}", String::from_utf8_lossy(&done.stderr));
    assert!(fs::read_to_string(&out).expect("a file").contains("height=\"120"));
}
