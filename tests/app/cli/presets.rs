//! Presets, reference, color transform, and the columns that follow from them.

use chromascope_core::colorimetry::{Lab, delta_e_1976, delta_e_2000};

use super::{PAPER, column, number, refused, run, table};

const CANON: &str = "Canon EOS 10D (2007 figure)";

fn numbers(rows: &[Vec<String>], head: &str) -> Vec<Option<f64>> {
    column(rows, head).into_iter().map(|cell| (!cell.is_empty()).then(|| number(cell))).collect()
}

/// The numbers of a column without empty cells.
fn all(rows: &[Vec<String>], head: &str) -> Vec<f64> {
    numbers(rows, head).into_iter().map(|cell| cell.unwrap_or_else(|| panic!("{head} is empty"))).collect()
}

#[test]
fn every_table_says_under_what_it_was_made() {
    let conditions = |arguments: &[&str]| table(arguments)[1].iter().rev().take(5).rev().cloned().collect::<Vec<_>>();
    let colorimetry = ["CIE 1931 2°", "D65", "unity", "3x3 fitted to CIE 1931 2°", "colorimetry"];
    for command in ["locus", "patches"] {
        assert_eq!(conditions(&[command]), colorimetry);
        assert_eq!(conditions(&[command, "--preset", "colorimetry"]), colorimetry);
        assert_eq!(conditions(&[command, "--preset", "paper"]), PAPER);
        let named = [command, "--preset", "paper", "--reference", "CIE 1964 10°", "--transform", "fitted"];
        let light = ["--illuminant", "daylight:5000", "--white-balance", "blackbody:3000"];
        let named = conditions(&[&named[..], &light].concat());
        assert_eq!(
            named,
            ["CIE 1964 10°", "daylight 5000 K", "blackbody 3000 K", "3x3 fitted to CIE 1964 10°", "paper"]
        );
        let fit = conditions(&[command, "--reference", "Stiles & Burch 1955 2°", "--fit-to", "CIE 2015 2°"]);
        assert_eq!((fit[0].as_str(), fit[3].as_str()), ("Stiles & Burch 1955 2°", "3x3 fitted to CIE 2015 2°"));
        // An RGB observer is no target, and that the two differ is said.
        let output = run(&[command, "--reference", "Stiles & Burch 1955 2°"]);
        let said = String::from_utf8(output.stderr).unwrap();
        assert!(said.contains("fitted to CIE 1931 2°") && said.lines().count() == 1, "{said}");
        let rgb = conditions(&[command, "--reference", "Stiles & Burch 1955 2°"]);
        assert_eq!(rgb[3], "3x3 fitted to CIE 1931 2°");
    }
}

#[test]
fn presets_name_sensors_and_patches() {
    let sensors = |arguments: &[&str]| {
        let rows = table(arguments);
        let mut sensors: Vec<String> = column(&rows, "sensor").into_iter().map(str::to_owned).collect();
        sensors.dedup();
        sensors
    };
    let colorimetry = ["CIE 1931 2°", "Canon EOS 5D Mark II", "Nikon D70 (A.M.P.A.S.)", "Kodak DCS200"];
    assert_eq!(sensors(&["locus"]), colorimetry);
    assert_eq!(sensors(&["patches", "--preset", "paper"]).len(), 5);
    assert_eq!(table(&["patches", "--preset", "paper"]).len(), 1 + 5 * 5);
    assert_eq!(table(&["patches"]).len(), 1 + 4 * 24);
    let whole = ["patches", "--preset", "paper", "--chart", "ColorChecker 24 (Ohta 1997)"];
    assert_eq!(table(&whole).len(), 1 + 5 * 24);
    // The reference that is named takes the place of the preset's.
    assert_eq!(sensors(&["locus", "--reference", "CIE 1964 10°"])[..2], ["CIE 1964 10°", "Canon EOS 5D Mark II"]);
}

#[test]
fn differences_of_patches_are_those_of_their_coordinates() {
    let rows = table(&["patches"]);
    let [l, a, b] = ["lab_l", "lab_a", "lab_b"].map(|head| all(&rows, head));
    let [x, y, u, v] = ["x", "y", "u_prime", "v_prime"].map(|head| all(&rows, head));
    let [xx, yy, zz] = ["x_tristimulus", "y_tristimulus", "z_tristimulus"].map(|head| all(&rows, head));
    let [de00, de76] = ["delta_e_2000", "delta_e_1976"].map(|head| all(&rows, head));
    let [duv, dxy] = ["delta_uv_prime", "delta_xy"].map(|head| all(&rows, head));
    for row in 0..4 * 24 {
        let reference = row % 24;
        let lab = |row: usize| Lab { l: l[row], a: a[row], b: b[row] };
        let close = |given: f64, expected: f64| assert!((given - expected).abs() < 1e-9, "{row}: {given} {expected}");
        close(de00[row], delta_e_2000(lab(reference), lab(row)));
        close(de76[row], delta_e_1976(lab(reference), lab(row)));
        close(dxy[row], (x[row] - x[reference]).hypot(y[row] - y[reference]));
        close(duv[row], (u[row] - u[reference]).hypot(v[row] - v[reference]));
        let sum = xx[row] + 15.0 * yy[row] + 3.0 * zz[row];
        close(u[row], 4.0 * xx[row] / sum);
        close(v[row], 9.0 * yy[row] / sum);
        close(l[row], 116.0 * yy[row].cbrt() - 16.0);
    }
    assert!(de00[..24].iter().all(|de| *de == 0.0) && de00[24..].iter().all(|de| *de > 0.0));
}

/// Eq 13 takes RGB as sRGB whatever the sensor, so that distances in L*a*b* are no ΔE*.
#[test]
fn the_papers_matrix_has_distances_but_no_delta_e() {
    let output = run(&["patches", "--preset", "paper"]);
    let said = String::from_utf8(output.stderr).unwrap();
    assert!(output.status.success() && said.matches("L*a*b*, CCT and \u{394}E* are left empty").count() == 1, "{said}");
    let rows = table(&["patches", "--preset", "paper"]);
    for head in ["delta_e_2000", "delta_e_1976"] {
        assert!(numbers(&rows, head).iter().all(Option::is_none), "{head}");
    }
    // Nor have colors of Eq 13 a CIE L*a*b* or a color temperature; those of the CIE observer have.
    for head in ["lab_l", "lab_a", "lab_b", "cct_k", "duv"] {
        let values = numbers(&rows, head);
        assert!(values[..20].iter().all(Option::is_none), "{head}");
        assert!(values[20..].iter().any(Option::is_some), "{head}");
    }
    let distances = numbers(&rows, "delta_xy");
    assert!(distances[..20].iter().all(Option::is_some) && distances[20..].iter().all(Option::is_none));
    // Between two XYZ observers, which Eq 13 leaves alone, ΔE* is one.
    let direct = ["patches", "--transform", "paper", "--observer", "CIE 1964 10°", "--camera", "Kodak DCS200"];
    let output = run(&direct);
    let said = String::from_utf8(output.stderr).unwrap();
    assert_eq!(said.matches("--transform fitted").count(), 2, "differences, and L*a*b*: {said}");
    let rows = table(&direct);
    let differences = numbers(&rows, "delta_e_2000");
    assert!(differences[..24].iter().all(Option::is_some) && differences[24..].iter().all(Option::is_none));
    assert!(numbers(&rows, "delta_uv_prime")[24..].iter().all(Option::is_none));
}

#[test]
fn loci_have_distances_cct_errors_and_lengths() {
    let rows = table(&["locus", "--temperatures", "1000,2856,6504,20000,25000"]);
    let [x, y, u, v] = ["x", "y", "u_prime", "v_prime"].map(|head| all(&rows, head));
    let [dxy, duv, arc] = ["distance_xy", "distance_uv_prime", "arc_length_xy"].map(|head| all(&rows, head));
    let cct = numbers(&rows, "cct_error_k");
    for (row, start) in (0..4).flat_map(|sensor| (0..5).map(move |row| (5 * sensor + row, 5 * sensor))) {
        let reference = row - start;
        assert!((dxy[row] - (x[row] - x[reference]).hypot(y[row] - y[reference])).abs() < 1e-12);
        assert!((duv[row] - (u[row] - u[reference]).hypot(v[row] - v[reference])).abs() < 1e-12);
        let length: f64 = (start..row).map(|k| (x[k + 1] - x[k]).hypot(y[k + 1] - y[k])).sum();
        assert!((arc[row] - length).abs() < 1e-12, "{row}");
    }
    // The reference makes no error by itself.
    assert!(cct[..5].iter().all(|error| error.unwrap().abs() < 0.02), "{cct:?}");
    // A camera that is fitted under D65 sees D65's temperature nearly right, and incandescent light less so.
    let of = |row: usize| cct[row].unwrap().abs();
    assert!(of(7) > 0.0 && of(7) < 400.0, "{cct:?}");
}

#[test]
fn under_eq_13_too_the_reference_reads_true_temperatures() {
    let rows = table(&["locus", "--preset", "paper", "--temperatures", "2856,5500"]);
    let cct = numbers(&rows, "cct_error_k");
    assert!(cct[..2].iter().all(|error| error.unwrap().abs() < 0.02), "{cct:?}");
    // By a search over 20,000 points of the table, 1.4 K apart at 5500 K: 10D, D70, DCS200 at 2856 and 5500 K.
    let expected = [73.3, 130.9, 95.1, 92.0, 1589.4, 155.1];
    for (found, expected) in cct[2..8].iter().zip(expected) {
        assert!((found.unwrap() - expected).abs() < 0.7, "{cct:?}");
    }
    assert!(cct[8..].iter().all(Option::is_none), "a CIE observer is not comparable under Eq 13: {cct:?}");
}

#[test]
fn a_cct_error_is_the_same_number_wherever_it_stands() {
    for preset in ["paper", "colorimetry"] {
        for kelvin in ["2856", "4000", "9300"] {
            let common = ["--preset", preset, "--camera", CANON, "--camera", "Kodak DCS200"];
            let locus = table(&[&["locus", "--temperatures", kelvin], &common[..]].concat());
            let compare =
                [&["compare", "--metrics", "cct-error", "--format", "csv", "--temperature", kelvin], &common[..]];
            let compare = table(&compare.concat());
            for camera in [CANON, "Kodak DCS200"] {
                let of = |rows: &[Vec<String>], column: &str| {
                    let at = rows[0].iter().position(|cell| cell == column).unwrap();
                    rows.iter().find(|row| row.iter().any(|cell| cell == camera)).unwrap()[at].parse::<f64>().unwrap()
                };
                let [a, b] = [of(&locus, "cct_error_k"), of(&compare, "cct_error_k")];
                assert!((a - b).abs() < 1e-6, "{preset}, {camera} at {kelvin} K: {a} and {b}");
            }
        }
    }
}

#[test]
fn loci_mark_what_is_drawn_dotted() {
    let rows = table(&["locus", "--camera", CANON, "--camera", "Kodak DCS200", "--temperatures", "2400,2600"]);
    let of = |camera: &str| -> Vec<String> {
        let at = rows[0].iter().position(|cell| cell == "extrapolated").unwrap();
        rows.iter().filter(|row| row[0] == camera).map(|row| row[at].clone()).collect()
    };
    assert_eq!(of(CANON), ["true", "false"], "its table ends at 700 nm");
    assert_eq!(of("Kodak DCS200"), ["false", "false"], "its table ends at 780 nm");
}

#[test]
fn white_balance_is_taken_by_loci_too() {
    let locus = ["locus", "--preset", "paper", "--camera", "Kodak DCS200", "--count", "2"];
    let of = |white: &[&str]| table(&[&locus[..], white].concat());
    assert_eq!(of(&[]), of(&["--white", "unity"]));
    assert_ne!(all(&of(&["--white", "D55"]), "x"), all(&of(&[]), "x"));
    assert_eq!(of(&["--white", "D55"]), of(&["--white-balance", "D55"]));
}

#[test]
fn camera_files_can_be_taken_per_photon() {
    let nikon = std::fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/assets/cameras/nikon_d850.csv")).unwrap();
    let energy = super::file("per_energy.csv", &nikon);
    let mut photon = String::from("wavelength_nm,red,green,blue\n");
    let figures = nikon.lines().filter(|line| line.starts_with(|c: char| c.is_ascii_digit()));
    for line in figures {
        let cells: Vec<f64> = line.split(',').map(number).collect();
        // Per photon: of light of equal power there are as many photons as wavelength.
        let row: Vec<String> = cells[1..].iter().map(|value| (value / cells[0]).to_string()).collect();
        photon.extend([cells[0].to_string(), ",".to_owned(), row.join(","), "\n".to_owned()]);
    }
    let photon = super::file("per_photon.csv", &photon);
    let x = |file: &std::path::Path, per: &str| {
        all(&table(&["locus", "--camera", file.to_str().unwrap(), "--per", per, "--count", "3"]), "x")
    };
    let pairs = x(&energy, "energy").into_iter().zip(x(&photon, "photon"));
    assert!(pairs.into_iter().all(|(a, b)| (a - b).abs() < 2e-4), "{:?}", x(&photon, "photon"));
    assert!((x(&energy, "photon")[0] - x(&energy, "energy")[0]).abs() > 1e-3);
    refused(&["patches", "--camera", "Nikon D850", "--per", "photon"], &["--per", "--camera"]);
}

#[test]
fn files_give_all_their_curves() {
    let names: Vec<String> = (0..250).map(|index| format!("p{index}")).collect();
    let values = vec!["0.5"; 250].join(",");
    let text = format!("wavelength_nm,{}\n380,{values}\n780,{values}\n", names.join(","));
    let chart = super::file("many.csv", &text);
    assert_eq!(table(&["patches", "--chart", chart.to_str().unwrap(), "--camera", "Kodak DCS200"]).len(), 1 + 250);
}
