//! `patches --radiance`: measured radiances, integrated as they are.

use super::{column, file, number, refused, table};

fn numbers(rows: &[Vec<String>], head: &str) -> Vec<f64> {
    column(rows, head).into_iter().map(number).collect()
}

/// D65 times gray, as an instrument measures a tile and a gray in a booth.
fn booth() -> String {
    let d65 = std::fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/assets/illuminants/d65.csv")).unwrap();
    let mut text = String::from("wavelength_nm,white tile,gray\n");
    for line in d65.lines().filter(|line| line.starts_with(|c: char| c.is_ascii_digit())) {
        let (nm, power) = line.split_once(',').unwrap();
        text.extend([nm, ",", power, ",", &(0.2 * number(power)).to_string(), "\n"]);
    }
    text
}

#[test]
fn radiances_are_reflectances_times_light() {
    let radiance = file("booth.csv", &booth());
    let radiance = radiance.to_str().unwrap();
    let gray = file("booth_chart.csv", "wavelength_nm,white tile,gray\n380,1,0.2\n780,1,0.2\n");
    let sensors = ["--camera", "Nikon D850", "--observer", "CIE 1931 2°"];
    let measured =
        table(&[&["patches", "--radiance", radiance, "--radiance-white", "White tile"], &sensors[..]].concat());
    let chart = ["patches", "--chart", gray.to_str().unwrap(), "--illuminant", "D65"];
    let computed = table(&[&chart[..], &sensors].concat());
    assert_eq!(measured.len(), 1 + 4);
    for head in ["x_tristimulus", "y_tristimulus", "z_tristimulus", "x", "y", "lab_l", "lab_a", "lab_b", "delta_xy"] {
        let pairs = numbers(&measured, head).into_iter().zip(numbers(&computed, head));
        assert!(pairs.into_iter().all(|(a, b)| (a - b).abs() < 1e-9), "{head}");
    }
    assert_eq!(column(&measured, "r")[0], "1.00000000000000");
    assert_eq!(column(&measured, "illuminant")[0], "radiance of white tile");
}

#[test]
fn without_a_white_there_is_chromaticity_but_no_lab() {
    let radiance = file("booth_bare.csv", &booth());
    let rows = table(&["patches", "--radiance", radiance.to_str().unwrap(), "--observer", "CIE 1931 2°"]);
    assert_eq!(format!("{:.5}", numbers(&rows, "x")[0]), "0.31274");
    for head in ["lab_l", "delta_e_2000", "delta_e_1976"] {
        assert!(column(&rows, head).iter().all(|cell| cell.is_empty()), "{head}");
    }
    assert_eq!(numbers(&rows, "delta_xy"), [0.0, 0.0]);
}

#[test]
fn no_light_is_named_beside_radiances() {
    let radiance = file("booth_refused.csv", &booth());
    let radiance = radiance.to_str().unwrap();
    refused(&["patches", "--radiance", radiance, "--illuminant", "D65"], &["--illuminant"]);
    refused(&["patches", "--radiance", radiance, "--chart", "ColorChecker five"], &["--chart"]);
    let unknown = ["patches", "--radiance", radiance, "--radiance-white", "tile 2"];
    refused(&unknown, &["no radiance is named \"tile 2\"", "white tile"]);
}
