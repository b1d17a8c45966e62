//! `light`, and filters in front of the illuminant.

use super::{column, file, number, refused, run, table};

#[test]
fn indices_are_those_of_another_program() {
    let rows = table(&["light", "FL2", "FL11", "A", "--format", "csv"]);
    let numbers = |head: &str| column(&rows, head).into_iter().map(number).collect::<Vec<_>>();
    // colour-science 0.4.7; see tests/core/rendition.rs.
    for (head, expected) in [
        ("ra", [64.2337, 82.8591, 99.9962]),
        ("rf", [70.1208, 80.0404, 100.0003]),
        ("rg", [86.4163, 101.0567, 100.0000]),
    ] {
        for (value, expected) in numbers(head).into_iter().zip(expected) {
            assert!((value - expected).abs() < 1e-4, "{head}: {value} {expected}");
        }
    }
    // Exact for the sums from 380 to 780 nm, see tests/core/temperature.rs; another program's are within 3 K.
    assert!((numbers("cct_k")[0] - 4224.5).abs() < 1.5, "{:?}", numbers("cct_k"));
}

#[test]
fn cameras_have_a_row_each() {
    let rows =
        table(&["light", "FL11", "--camera", "Kodak DCS200", "--camera", "Nikon D70 (A.M.P.A.S.)", "--format", "csv"]);
    assert_eq!(column(&rows, "camera"), ["Kodak DCS200", "Nikon D70 (A.M.P.A.S.)"]);
    let means: Vec<f64> = column(&rows, "consistency_mean").into_iter().map(number).collect();
    assert!(means[0] > means[1] && means[1] > 0.5, "{means:?}");
    let json = run(&["light", "FL11", "--camera", "Kodak DCS200", "--format", "json"]);
    let json: serde_json::Value = serde_json::from_slice(&json.stdout).unwrap();
    assert_eq!(json[0]["consistency"][0]["camera"], "Kodak DCS200");
    assert_eq!(json[0]["hue_bins"].as_array().unwrap().len(), 16);
    assert!((json[0]["consistency"][0]["mean"].as_f64().unwrap() - means[0]).abs() < 1e-9);
}

#[test]
fn a_light_without_answers_says_why() {
    let green = file("laser.csv", "nm,power\n518,0\n520,1\n522,0\n");
    let output = run(&["light", green.to_str().unwrap(), "--format", "csv"]);
    assert!(output.status.success());
    let (text, why) = (String::from_utf8_lossy(&output.stdout), String::from_utf8_lossy(&output.stderr));
    assert!(!text.contains("NaN") && text.lines().nth(1).unwrap().contains(",,,,,"), "{text}");
    assert!(why.contains("no CCT: the color is further than 0.05"), "{why}");
    let dark = file("dark.csv", "nm,power\n400,0\n500,0\n700,0\n");
    let output = run(&["light", dark.to_str().unwrap()]);
    let why = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(why.contains("no power between 360 and 780 nm"), "{why}");
}

#[test]
fn filters_are_in_the_conditions_and_in_the_numbers() {
    let rows = table(&["patches", "--illuminant", "D65", "--filter", "ND 0.3", "--filter", "ND 0.6"]);
    assert_eq!(column(&rows, "illuminant")[0], "D65 × ND 0.3 × ND 0.6");
    let own = file("gel.csv", "nm,Transmittance\n380,0.2\n500,0.5\n780,0.9\n");
    let rows = table(&["patches", "--illuminant", "D65", "--filter", own.to_str().unwrap()]);
    assert!(column(&rows, "illuminant")[0].contains("gel"), "{:?}", rows[1]);
    let plain = table(&["patches", "--illuminant", "D65"]);
    assert_ne!(column(&plain, "x"), column(&rows, "x"));
    refused(&["patches", "--filter", "ND 0.3", "--filter", "nd 0.3"], &["--filter", "used once"]);
    refused(&["patches", "--filter", "no such filter"], &["no such filter"]);
    let two = file("two_gels.csv", "nm,Transmittance a,Transmittance b\n400,0.2,0.3\n500,0.5,0.4\n700,0.9,0.8\n");
    refused(&["locus", "--filter", two.to_str().unwrap()], &["expected exactly one curve for a filter"]);
}

/// The last cell of a light's first row, which may hold commas.
fn cautions(light: &[&str]) -> String {
    let output = run(&[&["light"], light, &["--format", "csv"]].concat());
    let text = String::from_utf8(output.stdout).unwrap();
    let row = text.lines().nth(1).unwrap();
    row.rsplit_once(",\"").map_or_else(String::new, |(_, cell)| cell.trim_end_matches('"').to_owned())
}

#[test]
fn a_lamp_of_one_line_has_no_rendering_index() {
    let output = run(&["light", "Low-pressure sodium"]);
    let (text, why) = (String::from_utf8(output.stdout).unwrap(), String::from_utf8(output.stderr).unwrap());
    assert!(text.contains("Ra \u{2013}") && text.contains("R9 \u{2013}"), "{text}");
    assert!(
        why.contains("no Ra: four fifths of the luminance lie within 20 nm of 590 nm") && why.contains("CIE 13.3"),
        "{why}"
    );
    assert!(cautions(&["Low-pressure sodium"]).contains("mainly monochromatic"));
    // A lamp of three lines is none.
    assert!(!column(&table(&["light", "FL11", "--format", "csv"]), "ra")[0].is_empty());
}

#[test]
fn cautions_of_the_pane_are_on_the_command_line() {
    for form in ["table", "json"] {
        let output = run(&["light", "FL5", "--format", form]);
        let text = String::from_utf8(output.stdout).unwrap();
        assert!(text.contains("farther than 0.0054 from the reference illuminant"), "{form}: {text}");
    }
    assert!(cautions(&["FL5"]).contains("farther than 0.0054"));
    assert_eq!(cautions(&["D65"]), "");
}

#[test]
fn a_cut_table_says_what_that_does() {
    let planck = |nm: f64| nm.powi(-5) / ((1.4388e7 / (nm * 2856.0)).exp() - 1.0) * 1e17;
    let row = |nm: u32| format!("{nm},{}\n", planck(f64::from(nm)));
    let text =
        |range: std::ops::RangeInclusive<u32>| format!("nm,power\n{}", range.step_by(5).map(row).collect::<String>());
    let cut = file("blackbody_400_700.csv", &text(400..=700));
    let said = cautions(&[cut.to_str().unwrap()]);
    assert!(said.contains("the table covers 400 to 700 nm: beyond, Ra takes its end values"), "{said}");
    assert!(said.contains("held, they would be Rf") && said.contains("SSI"), "{said}");
    let whole = file("blackbody_380_780.csv", &text(380..=780));
    assert_eq!(cautions(&[whole.to_str().unwrap()]), "");
    // One temperature shown, another used: both are said.
    let said = cautions(&["ISO 7589 photoflood"]);
    assert!(said.contains("take their reference at 3418 K") && said.contains("CCT is 3400 K"), "{said}");
}

#[test]
fn similarity_is_taken_to_a_light_of_choice() {
    let of = |light: &str, reference: &str| {
        let rows = table(&["light", light, "--ssi-reference", reference, "--format", "csv"]);
        (column(&rows, "ssi_reference")[0].to_owned(), number(column(&rows, "ssi_to")[0]))
    };
    let (name, same) = of("D50", "D50");
    assert!(name == "D50" && (same - 100.0).abs() < 1e-9, "{name} {same}");
    // As the core's, to a published whole number.
    let (_, hmi) = of("HMI", "D50");
    assert_eq!(hmi.round(), 72.0);
    let (name, tungsten) = of("A", "blackbody:3200");
    assert!(name == "blackbody 3200 K" && (90.0..99.0).contains(&tungsten), "{name} {tungsten}");
    // Filters are in front of the light, not of the reference.
    let rows = table(&["light", "D50", "--ssi-reference", "D50", "--filter", "Warming 131 mired", "--format", "csv"]);
    assert!(number(column(&rows, "ssi_to")[0]) < 90.0);
    refused(&["light", "D65", "--ssi-reference", "no such light"], &["no such light"]);
}

#[test]
fn the_first_hue_bin_is_in_the_table() {
    let rows = table(&["light", "FL2", "--format", "csv"]);
    let json = run(&["light", "FL2", "--format", "json"]);
    let json: serde_json::Value = serde_json::from_slice(&json.stdout).unwrap();
    for (head, key) in [("rf_h1", "rf_h"), ("rcs_h1", "rcs_h")] {
        let expected = json[0]["hue_bins"][0][key].as_f64().unwrap();
        assert!((number(column(&rows, head)[0]) - expected).abs() < 1e-9, "{head}");
    }
}

#[test]
fn a_light_that_shows_no_colors_says_so() {
    let said = |arguments: &[&str]| String::from_utf8(run(arguments).stderr).unwrap();
    let camera = ["--camera", "Kodak DCS200"];
    let compare =
        |light: &str| said(&[&["compare", "--metrics", "condition", "--illuminant", light], &camera[..]].concat());
    assert!(compare("blackbody:100").contains("blackbody 100 K has next to no visible light"));
    assert!(compare("Low-pressure sodium").contains("mainly monochromatic"));
    assert!(!compare("blackbody:1500").contains("light") && !compare("FL11").contains("monochromatic"));
    assert!(said(&["matrix", "Kodak DCS200", "--illuminant", "blackbody:100"]).contains("mean nothing"));
}

#[test]
fn a_bare_temperature_is_answered_with_what_to_write() {
    for typed in ["6500K", "6500", "6500 k"] {
        refused(&["compare", "--illuminant", typed], &["is a temperature", "daylight:6500", "blackbody:6500"]);
    }
}
