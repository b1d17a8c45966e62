//! `chromascope matrix` and `--correction`.

use super::{column, file, number, refused, run, table};

const D200: [&str; 4] = ["matrix", "Nikon D200", "--illuminant", "ISO 7589 studio tungsten"];

const NEUTRAL: &str = "0.85,1,0.42";

fn output(more: &[&str]) -> Vec<u8> {
    let output = run(&[&D200[..], more].concat());
    assert!(output.status.success(), "{more:?}: {}", String::from_utf8_lossy(&output.stderr));
    output.stdout
}

fn text(more: &[&str]) -> String {
    String::from_utf8(output(more)).unwrap()
}

#[test]
fn json_has_all_digits_of_the_text() {
    let found: serde_json::Value = serde_json::from_str(&text(&["--format", "json", "--neutral", NEUTRAL])).unwrap();
    let words = text(&["--neutral", NEUTRAL]).split_whitespace().collect::<Vec<_>>().join(" ");
    for matrix in
        ["/lights/0/xyz_from_rgb", "/lights/0/dng/forward_matrix", "/lights/0/dng/color_matrix", "/idt/aces_from_rgb"]
    {
        let rows = found.pointer(matrix).and_then(serde_json::Value::as_array).unwrap();
        let numbers = rows.iter().flat_map(|row| row.as_array().unwrap());
        let rounded: Vec<String> = numbers.map(|number| format!("{:.7}", number.as_f64().unwrap())).collect();
        assert!(words.contains(&rounded.join(" ")), "{matrix}: {words}");
    }
    // Without a neutral, what its implausible channel ratio would decide is missing.
    let found: serde_json::Value = serde_json::from_str(&text(&["--format", "json"])).unwrap();
    assert!(found["lights"][0]["dng"]["color_matrix"].is_null() && found["idt"]["balance"].is_null());
    assert!(found["lights"][0]["xyz_from_rgb"].is_array());
}

/// The matrix of rawtoaces for its own D200 under studio tungsten.
#[test]
fn clf_holds_the_matrix_of_rawtoaces() {
    // The neutral of the table itself: its channel ratio is implausible, so that one must be given.
    let xml = text(&["--format", "clf", "--neutral", "0.877403482,1,0.430289752"]);
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
    let dcp = output(&["--format", "dcp", "--second-illuminant", "D65", "--model", "NIKON D200", "--neutral", NEUTRAL]);
    assert_eq!(&dcp[..4], b"IIRC");
    assert!(dcp.windows(11).any(|window| window == b"NIKON D200\0"));
    let icc = output(&["--format", "icc"]);
    assert_eq!(&icc[36..40], b"acsp");
    let dng = text(&["--format", "dng", "--second-illuminant", "FL2", "--neutral", NEUTRAL]);
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

/// Numbers behind a key of DNG's lines.
fn numbers_of(dng: &str, key: &str) -> Vec<f64> {
    let line = dng.lines().find_map(|line| line.strip_prefix(key)?.strip_prefix(": "));
    line.unwrap_or_else(|| panic!("{key}: {dng}")).split_whitespace().map(number).collect()
}

#[test]
fn a_table_without_channel_ratio_needs_a_neutral_for_what_holds_it() {
    for (camera, reason) in [
        ("Nikon D5100", "lost"),
        ("Nikon D5100 (NPL)", "same maximum"),
        ("Nikon D70 (UPenn 2011)", "implausible"),
        ("Nikon D70 (2007 figure)", "printed figure"),
        ("Canon EOS 10D (2007 figure)", "printed figure"),
    ] {
        let of = |more: &[&str]| run(&[&["matrix", camera, "--illuminant", "D65"], more].concat());
        for format in ["dng", "dcp", "clf"] {
            refused(
                &["matrix", camera, "--illuminant", "D65", "--format", format],
                &[reason, "--neutral R,G,B", "under D65"],
            );
            let given = of(&["--format", format, "--neutral", "0.47,1,0.72"]);
            assert!(given.status.success(), "{camera} {format}: {}", String::from_utf8_lossy(&given.stderr));
        }
        let icc = of(&["--format", "icc"]);
        assert!(icc.status.success(), "balanced RGB has no ratio");
        let text = String::from_utf8(of(&[]).stdout).unwrap();
        assert!(text.contains(reason) && text.contains("--neutral") && text.contains("ForwardMatrix"), "{text}");
        assert!(!text.contains("ColorMatrix") && !text.contains("balance "), "{text}");
    }
    let whole = String::from_utf8(run(&["matrix", "Nikon D850", "--illuminant", "D65"]).stdout).unwrap();
    assert!(whole.contains("Channel ratio plausible") && whole.contains("DNG ColorMatrix"), "{whole}");
}

#[test]
fn with_a_neutral_the_files_white_is_that_neutral() {
    let two = ["matrix", "Nikon D5100", "--illuminant", "D65", "--second-illuminant", "A"];
    let of = |more: &[&str]| {
        let output = run(&[&two[..], more].concat());
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        String::from_utf8(output.stdout).unwrap()
    };
    let dng = of(&["--format", "dng", "--neutral", "0.47,1,0.72"]);
    assert_eq!(numbers_of(&dng, "AsShotNeutral (D65)"), [0.47, 1.0, 0.72]);
    // Of two lights the warmer stands first; D65 is the second.
    for (matrix, white, neutral) in [
        ("ColorMatrix2", [0.950_43, 1.0, 1.088_80], [0.47, 1.0, 0.72]),
        ("ColorMatrix1", [1.098_47, 1.0, 0.355_82], {
            let neutral = numbers_of(&dng, "AsShotNeutral (A)");
            [neutral[0], neutral[1], neutral[2]]
        }),
    ] {
        let rows = numbers_of(&dng, matrix);
        let rgb: Vec<f64> = rows.chunks(3).map(|row| row.iter().zip(white).map(|(a, b)| a * b).sum()).collect();
        let largest = rgb.iter().copied().fold(0.0, f64::max);
        for (got, known) in rgb.iter().zip(neutral) {
            assert!((got / largest - known).abs() < 1e-4, "{matrix} {rgb:?} {neutral:?}");
        }
    }
    // The second light is scaled by the gains of the first.
    let again = of(&["--format", "dng", "--neutral", "0.94,1,0.36"]);
    let (before, after) = (numbers_of(&dng, "AsShotNeutral (A)"), numbers_of(&again, "AsShotNeutral (A)"));
    for (channel, gain) in [(0, 2.0), (2, 0.5)] {
        let ratio = after[channel] / after[1] / (before[channel] / before[1]);
        assert!((ratio - gain).abs() < 1e-4, "{before:?} {after:?}");
    }
    refused(&[&two[..], &["--neutral", "2,1,1.5"]].concat(), &["reciprocals"]);
    refused(&[&two[..], &["--neutral", "1,1"]].concat(), &["R,G,B"]);
}

#[test]
fn raw_files_name_the_model() {
    for (camera, model) in [
        ("Nikon D70 (A.M.P.A.S.)", "Nikon D70"),
        ("Nikon D5100 (NPL)", "Nikon D5100"),
        ("Canon Digital Rebel XTi", "Canon EOS 400D DIGITAL"),
        ("Sony ILCE-7M3", "Sony ILCE-7M3"),
        ("Kodak DCS200", "Kodak DCS200"),
    ] {
        let output = run(&["matrix", camera, "--illuminant", "D65", "--format", "dng", "--neutral", "0.5,1,0.7"]);
        let dng = String::from_utf8(output.stdout).unwrap();
        assert_eq!(dng.lines().next(), Some(&*format!("UniqueCameraModel: {model}")));
    }
}

#[test]
fn icc_is_written_in_two_versions_with_the_tables_terms() {
    let [two, four] = ["2", "4"].map(|version| output(&["--format", "icc", "--icc-version", version]));
    assert_eq!((two[8], four[8]), (2, 4));
    assert_eq!(output(&["--format", "icc"]), four);
    assert!(four[84..100].iter().any(|byte| *byte != 0) && two[84..100].iter().all(|byte| *byte == 0));
    assert!(two.windows(10).any(|window| window == b"Apache-2.0"));
}

#[test]
fn the_clf_has_an_accuracy_of_its_own() {
    let text = text(&[]);
    let (_, idt) = text.split_once("ACES IDT").unwrap();
    assert!(idt.contains("Another fit than of DCP and ICC"), "{idt}");
    let line = idt.lines().find(|line| line.starts_with("training")).unwrap();
    let numbers: Vec<f64> = line.split_whitespace().skip(1).take(3).map(number).collect();
    assert!(numbers[0] > 0.5 && numbers[0] < numbers[1] && numbers[1] < numbers[2], "{line}");
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
    assert!(column(&rows, "transform").iter().all(|cell| cell.contains("Root polynomial")));
}

#[test]
fn a_second_light_may_be_a_formula_and_filters_stand_before_both() {
    let dng = text(&["--format", "dng", "--second-illuminant", "blackbody:5000", "--neutral", NEUTRAL]);
    assert!(dng.contains("CalibrationIlluminant2: 255") && dng.contains("AsShotNeutral (blackbody 5000 K)"), "{dng}");
    let filtered = text(&["--format", "dng", "--filter", "Cooling 131 mired", "--neutral", NEUTRAL]);
    assert!(filtered.contains("studio tungsten \u{d7} Cooling 131 mired"), "{filtered}");
    assert_ne!(filtered, text(&["--format", "dng", "--neutral", NEUTRAL]));
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
