//! Rankings of cameras, as the user requests them.

use chromascope::catalog::Catalog;
use chromascope::document::{Document, SetKind, TRAINING};
use chromascope::results::Results;
use chromascope::scene::Scene;
use chromascope_core::query::{Ask as _, CameraMetric};
use serde_json::Value;

use super::{column, file, number, refused, run, table};

fn text(arguments: &[&str]) -> String {
    let output = run(arguments);
    assert!(output.status.success(), "{arguments:?}: {}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).unwrap()
}

fn json(arguments: &[&str]) -> Value {
    serde_json::from_str(&text(&[arguments, &["--format", "json"]].concat())).unwrap()
}

#[test]
fn the_whole_library_is_ranked() {
    let rows = table(&["compare", "--format", "csv", "--metrics", "metamerism-index,vora", "--sort", "vora"]);
    let vora: Vec<f64> = column(&rows, "vora_value").into_iter().map(number).collect();
    assert_eq!(vora.len(), 58);
    assert!(vora.is_sorted_by(|a, b| a >= b));
    let ranks = |head: &str| column(&rows, head).into_iter().map(number).collect::<Vec<_>>();
    let (first, last, own) = (ranks("rank_first"), ranks("rank_last"), ranks("vora_value_uncertainty"));
    // Each camera has its own uncertainty, so the ends of ranges need not be in order, but each range holds the row's place.
    let places = first.iter().zip(&last).enumerate();
    assert!(places.clone().all(|(at, (first, last))| (*first..=*last).contains(&(at as f64 + 1.0))));
    assert!(first[0] == 1.0 && last[57] == 58.0 && last[0] < 58.0 && first[57] > 1.0);
    assert!(own.iter().all(|u| *u > 0.0) && first.iter().zip(&last).any(|(a, b)| a < b));
    // Kodak DCS200: published 0.8444 and 67.6.
    let kodak = rows.iter().position(|row| row[0] == "Kodak DCS200").unwrap() - 1;
    assert!((vora[kodak] - 0.8444).abs() < 5e-5);
    assert!((number(column(&rows, "metamerism_index")[kodak]) - 67.6).abs() < 0.05);
}

#[test]
fn an_own_file_has_its_place_among_the_built_in() {
    let own = file("own.csv", &std::fs::read_to_string("assets/cameras/nikon_d700.csv").unwrap());
    let own = own.to_str().unwrap();
    let metrics = ["--library", "--format", "csv", "--metrics", "vora"];
    let rows = table(&[&["compare", "--camera", own], &metrics[..]].concat());
    assert_eq!(rows.len(), 1 + 59);
    // A built-in camera that is named stands once.
    let rows = table(&[&["compare", "--camera", "Kodak DCS200"], &metrics[..]].concat());
    assert_eq!(rows.len(), 1 + 58);
}

/// Another laboratory's table of a model, and the user's own, differ from the first by what the window's page has.
#[test]
fn tables_of_one_model_are_compared() {
    let text_of_own = std::fs::read_to_string("assets/cameras/nikon_d70_a_m_p_a_s.csv").unwrap();
    let own = file("tables_own.csv", &text_of_own.replacen("Nikon D70 (A.M.P.A.S.)", "Own table", 1));
    let named =
        ["compare", "--tables-of", "Nikon D70 (A.M.P.A.S.)", "--camera", own.to_str().unwrap(), "--metrics", "vora"];
    let rows = table(&[&named[..], &["--format", "csv"]].concat());
    let of = |head: &str, name: &str| {
        let row = rows.iter().position(|row| row[0].starts_with(name)).unwrap_or_else(|| panic!("{name}")) - 1;
        column(&rows, head)[row].to_owned()
    };
    assert_eq!((rows.len(), of("from_first_delta_e2000", "Nikon D70 (A.M.P.A.S.)").as_str()), (1 + 4, ""));
    let [same, upenn, figure] =
        ["Own table", "Nikon D70 (UPenn", "Nikon D70 (2007"].map(|name| number(&of("from_first_delta_e2000", name)));
    assert!(same < 1e-9 && (0.05..1.0).contains(&upenn) && figure > upenn, "{same} {upenn} {figure}");
    assert!(number(&of("curve_r_percent", "Nikon D70 (UPenn")) > 1.0);
    let object = json(&named);
    let tables: Vec<&Value> = object["cameras"].as_array().unwrap().iter().map(|of| &of["from_first"]).collect();
    assert!(tables.iter().any(|of| of["delta_e2000"].as_f64().is_some_and(|value| (value - upenn).abs() < 1e-9)));
    assert!(text(&named).contains("First: Nikon D70 (A.M.P.A.S.). Mean ΔE*00"));
    // A model may be named without what distinguishes its tables.
    assert_eq!(table(&["compare", "--tables-of", "nikon d70", "--format", "csv", "--metrics", "vora"]).len(), 1 + 3);
    refused(&["compare", "--tables-of", "Nonesuch 1"], &["no camera is named"]);
}

#[test]
fn one_number_in_three_forms() {
    let named = ["compare", "--camera", "Kodak DCS200", "--metrics", "delta-e2000-mean,cct-error"];
    let rows = table(&[&named[..], &["--format", "csv"]].concat());
    let mean = number(column(&rows, "delta_e_2000_mean")[0]);
    let object = json(&named);
    assert_eq!((&object["format"], &object["version"]), (&"chromascope-comparison".into(), &1.into()));
    let told = &object["cameras"][0]["values"]["delta-e2000-mean"];
    assert!((told["value"].as_f64().unwrap() - mean).abs() < 1e-13);
    assert!(told["uncertainty"].as_f64().unwrap() > 0.0);
    let budget = &told["budget"];
    assert_eq!((&budget["source"], &budget["degrees_of_freedom"]), (&"prior".into(), &14.0.into()));
    assert_eq!(budget["extrapolated"], true, "a DCS200 is unlike the models of the prior");
    assert!(budget["curves"].as_f64().unwrap() > 0.0 && budget["response"] == 0.0, "its table states per energy");
    assert_eq!(column(&rows, "uncertainty_source"), ["prior"]);
    assert!((number(column(&rows, "coverage_factor_95")[0]) - 2.466).abs() < 1e-3);
    assert_eq!(object["conditions"]["illuminant"], "D65");
    let worst = object["cameras"][0]["worst_patches"].as_array().unwrap();
    assert!(worst.len() == 5 && worst.iter().all(Value::is_string), "{worst:?}");
    let aligned = text(&named);
    let uncertainty = told["uncertainty"].as_f64().unwrap();
    assert!((0.0995..0.995).contains(&uncertainty), "two decimals: {uncertainty}");
    assert!(
        aligned.contains(&format!("{mean:.2} ± {uncertainty:.2}")) && aligned.contains("CCT error [K]"),
        "{aligned}"
    );
    let heads = ["uncertainty_source", "coverage_factor_95", "degrees_of_freedom", "extrapolated"];
    assert!(heads.iter().all(|head| !column(&rows, head)[0].is_empty()));
    let dagger = column(&rows, "extrapolated")[0] == "true";
    assert_eq!((aligned.contains('†'), aligned.contains("95 %: ± ")), (dagger, true), "{aligned}");
    // numpy and colour-science, tests/core/reference/camera_metrics.csv.
    assert!((mean - 2.041_838_01).abs() < 1e-7);
}

#[test]
fn aligned_columns_are_aligned() {
    let aligned = text(&["compare", "--sort", "name"]);
    let lines: Vec<Vec<char>> =
        aligned.lines().take_while(|line| !line.is_empty()).map(|line| line.chars().collect()).collect();
    assert_eq!(lines.len(), 59);
    let places = |line: &[char]| -> Vec<usize> { (0..line.len()).filter(|&i| line[i] == '±').collect() };
    // ± stands in one column where all values have one.
    let first = places(&lines[1]);
    assert!(first.len() > 5);
    for line in &lines[1..] {
        assert_eq!(places(line)[0], first[0]);
    }
}

#[test]
fn the_library_shares_what_does_not_depend_on_the_camera() {
    let (document, catalog, results) = (Document::default(), Catalog::built_in(), Results::default());
    let scene = Scene { document: &document, catalog: &catalog, results: &results };
    for entry in catalog.of_kind(SetKind::Camera) {
        let query = scene.camera_metrics_query(SetKind::Camera, &entry.name).unwrap();
        assert!(results.ask(&query).values[0].is_ok(), "{}", entry.name);
    }
    let counts = results.counts();
    let expected = [
        ("camera metrics", 58),
        ("fit targets", 1),
        ("locus rules", 1),
        ("reference locus", 1),
        ("metamerism index samples", 1),
        // One for each fit.
        ("metamerism index", 2 * 58),
        ("space quality", 58),
        ("rendering", 59),
        ("patch colors", 59),
    ];
    for (name, misses) in expected {
        assert_eq!(counts[name].misses, misses, "{name}");
    }
}

#[test]
fn corrections_are_those_named() {
    let mean = |correction: &str| {
        let arguments =
            ["compare", "--camera", "Kodak DCS200", "--metrics", "delta-e2000-mean,xy-mean", "--chart", TRAINING];
        let object = json(&[&arguments[..], &["--correction", correction]].concat());
        let value = |id: &str| object["cameras"][0]["values"][id]["value"].as_f64();
        (value("delta-e2000-mean"), value("xy-mean"), object["conditions"]["transform"].as_str().unwrap().to_owned())
    };
    let [none, matrix, least, roots] = ["none", "matrix", "min-delta-e", "root-polynomial"].map(mean);
    assert!(least.0 < matrix.0 && matrix.0 < none.0, "{matrix:?} {least:?} {none:?}");
    assert!(roots.0.is_some() && roots.0 != matrix.0, "{matrix:?} {roots:?}");
    assert!([&none, &matrix, &least].iter().all(|other| other.2 != roots.2) && matrix.2.contains("CIE 1931 2°"));
    let paper = json(&["compare", "--camera", "Kodak DCS200", "--transform", "paper", "--metrics", "delta-e2000-mean"]);
    assert!(paper["cameras"][0]["values"]["delta-e2000-mean"]["reason"].as_str().is_some());
}

#[test]
fn a_filter_changes_what_depends_on_the_light() {
    let values = |more: &[&str]| {
        let named = ["compare", "--camera", "Kodak DCS200", "--metrics", "delta-e2000-mean,vora,metamerism-index"];
        let object = json(&[&named[..], more].concat());
        ["delta-e2000-mean", "vora", "metamerism-index"].map(|id| object["cameras"][0]["values"][id]["value"].as_f64())
    };
    let filter = file("green.csv", "wavelength_nm,transmittance\n380,0.1\n480,0.2\n540,0.9\n600,0.3\n780,0.1\n");
    let (plain, green) = (values(&[]), values(&["--filter", filter.to_str().unwrap()]));
    assert!(plain[0] != green[0] && plain[1..] == green[1..], "{plain:?} {green:?}");
}

#[test]
fn all_metrics_are_told_and_missing_ones_explained() {
    let object = json(&["compare", "--camera", "ARRI D21", "--metrics", "all"]);
    assert_eq!(object["metrics"].as_array().unwrap().len(), CameraMetric::ALL.len());
    let values = &object["cameras"][0]["values"];
    assert!(values["noise-red"]["reason"].as_str().unwrap().contains("same maximum"));
    assert!(values["gray-snr"]["reason"].as_str().is_some());
    let aligned = text(&["compare", "--camera", "Nikon D850", "--metrics", "gray-snr", "--full-well", "40000"]);
    assert!(aligned.contains("SNR [dB]") && !aligned.contains("not given"), "{aligned}");
    let help = text(&["compare", "--help"]);
    assert!(CameraMetric::ALL[20..].iter().all(|metric| help.contains(metric.id)));
}

#[test]
fn a_camera_of_the_user_s_is_ranked_with_the_others() {
    let row = |i: u32| format!("{},{},{},{}", 380 + 10 * i, i % 7, (i + 2) % 5, (i * i) % 11);
    let rows = (0..36).map(row).collect::<Vec<_>>().join("\n");
    let path = file("compared.csv", &format!("wavelength,red,green,blue\n{rows}"));
    let path = path.to_str().unwrap();
    let rows =
        table(&["compare", "--camera", path, "--camera", "Nikon D850", "--metrics", "luther", "--format", "csv"]);
    assert_eq!(rows.len(), 3);
    assert_eq!(rows[1][0], "Nikon D850");
}

#[test]
fn what_cannot_be_asked_is_refused_with_a_remedy() {
    refused(&["compare", "--metrics", "delta-e2000-men"], &["delta-e2000-mean"]);
    refused(&["compare", "--sort", "beauty"], &["beauty"]);
    refused(&["compare", "--temperature", "0"], &["--temperature", "kelvins"]);
    refused(&["compare", "--full-well=-5"], &["--full-well"]);
    refused(&["compare", "--full-well", "100", "--read-noise", "200"], &["read noise"]);
    refused(&["compare", "--correction", "min-delta-e", "--transform", "paper"], &["--transform"]);
    refused(&["compare", "--camera", "Polaroid"], &["Polaroid"]);
}
