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
