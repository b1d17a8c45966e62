//! `chromascope matrix` and `--correction`.

use super::{column, file, number, refused, run, table};

const D200: [&str; 4] = ["matrix", "Nikon D200", "--illuminant", "ISO 7589 studio tungsten"];

fn output(more: &[&str]) -> Vec<u8> {
    let output = run(&[&D200[..], more].concat());
    assert!(output.status.success(), "{more:?}: {}", String::from_utf8_lossy(&output.stderr));
    output.stdout
}

fn text(more: &[&str]) -> String {
    String::from_utf8(output(more)).unwrap()
}

/// The matrix of rawtoaces for its own D200 under studio tungsten.
#[test]
fn clf_holds_the_matrix_of_rawtoaces() {
    let xml = text(&["--format", "clf"]);
    let (_, rest) = xml.split_once("<Array dim=\"3 3\">").unwrap();
    let numbers: Vec<f64> = rest.split_once('<').unwrap().0.split_whitespace().map(number).collect();
    let known = [
        0.744_769_1,
        0.143_420_0,
        0.111_810_8,
        0.045_176_0,
        1.008_262_2,
        -0.053_438_2,
        0.024_714_4,
        -0.124_552_5,
        1.099_838_1,
    ];
    assert!(numbers.iter().zip(known).all(|(a, b)| (a - b).abs() < 1e-5), "{numbers:?}");
    assert!(xml.contains("1.1397265 1.0000000 2.324015"), "{xml}");
}

#[test]
fn text_says_errors_of_training_and_left_out_with_their_maxima() {
    let text = text(&["--fit", "lab-least-squares"]);
    for words in
        ["uncorrected", "training", "leave-one-out", "95 %", "max", "white", "450 nm", "ForwardMatrix", "ACES IDT"]
    {
        assert!(text.contains(words), "{words}: {text}");
    }
}

#[test]
fn dcp_and_icc_are_files_of_their_kinds() {
    let dcp = output(&["--format", "dcp", "--second-illuminant", "D65", "--model", "NIKON D200"]);
    assert_eq!(&dcp[..4], b"IIRC");
    assert!(dcp.windows(11).any(|window| window == b"NIKON D200\0"));
    let icc = output(&["--format", "icc"]);
    assert_eq!(&icc[36..40], b"acsp");
    let dng = text(&["--format", "dng", "--second-illuminant", "FL2"]);
    assert!(dng.contains("CalibrationIlluminant1: 24") && dng.contains("CalibrationIlluminant2: 255"), "{dng}");
    assert!(dng.contains("IlluminantData2: 0.37"), "{dng}");
}

fn with<'a>(more: &[&'a str]) -> Vec<&'a str> {
    [&D200[..], more].concat()
}

#[test]
fn what_means_nothing_is_refused_with_a_remedy() {
    refused(&with(&["--format", "dcp", "--fit", "root-polynomial"]), &["DCP", "choose a matrix"]);
    refused(&with(&["--format", "icc", "--second-illuminant", "A"]), &["--second-illuminant", "one light"]);
    refused(&with(&["--weights", "hair=2"]), &["neutrals, skin, foliage, sky"]);
    refused(&with(&["--weights", "skin=-1"]), &["0 to 100"]);
    refused(&with(&["--fit", "best"]), &["min-delta-e", "root-polynomial-4"]);
    refused(&["matrix", "Nikon D200"], &["--illuminant"]);
    refused(&["patches", "--transform", "paper", "--correction", "matrix"], &["--correction", "--transform fitted"]);
    let few = file("matrix_few.csv", "wavelength_nm,a,b\n400,0.1,0.5\n500,0.2,0.4\n700,0.9,0.1\n");
    let few = few.to_str().unwrap();
    refused(&with(&["--fit", "root-polynomial", "--training", few]), &["2 training samples", "larger training set"]);
}

/// A correction reaches the tables: fitted over the chart itself it is nearer to the chart.
#[test]
fn corrections_reach_the_tables() {
    let mean = |more: &[&str]| {
        let chart = ["patches", "--camera", "Nikon D200", "--illuminant", "D55", "--chart", "colorchecker ohta"];
        let rows = table(&[&chart[..], more].concat());
        let values: Vec<f64> = column(&rows, "delta_e_2000").into_iter().map(number).collect();
        values.iter().sum::<f64>() / values.len() as f64
    };
    let own = ["--training", "colorchecker ohta"];
    let none = mean(&["--correction", "none"]);
    let matrix = mean(&own);
    let least = mean(&[&["--correction", "min-delta-e"], &own[..]].concat());
    let roots = mean(&[&["--correction", "root-polynomial"], &own[..]].concat());
    assert!(least < matrix && matrix < none && roots < matrix, "{least} {roots} {matrix} {none}");
    let rows = table(&["patches", "--camera", "Nikon D200", "--correction", "root-polynomial"]);
    assert!(column(&rows, "transform").iter().all(|cell| cell.contains("Root polynomial of degree 2")));
}

#[test]
fn a_second_light_may_be_a_formula_and_filters_stand_before_both() {
    let dng = text(&["--format", "dng", "--second-illuminant", "blackbody:5000"]);
    assert!(dng.contains("CalibrationIlluminant2: 255") && dng.contains("AsShotNeutral (blackbody 5000 K)"), "{dng}");
    let filtered = text(&["--format", "dng", "--filter", "Cooling 131 mired"]);
    assert!(filtered.contains("studio tungsten \u{d7} Cooling 131 mired"), "{filtered}");
    assert_ne!(filtered, text(&["--format", "dng"]));
    refused(&with(&["--second-illuminant", "blackbody:warm"]), &["--second-illuminant", "blackbody:5500"]);
}

#[test]
fn a_light_has_one_temperature_wherever_it_stands() {
    for light in ["D55", "D65", "A", "FL2"] {
        let output = run(&["matrix", "Nikon D200", "--illuminant", light]);
        let text = String::from_utf8(output.stdout).unwrap();
        let (_, rest) = text.split_once(&format!("Under {light}, ")).unwrap();
        let kelvin = rest.split_once(" K").unwrap().0;
        let rows = super::table(&["light", light, "--format", "csv"]);
        assert_eq!(kelvin, format!("{:.0}", number(column(&rows, "cct_k")[0])), "{light}");
    }
}
