//! The command line, run as the user runs it, without a display.

mod compare;
mod figure;
mod figure_texts;
mod files;
mod identify;
mod inspect;
mod lights;
mod manners;
mod matrix;
mod names;
mod outputs;
mod presets;
mod radiance;
pub(crate) mod recover;
mod reference;
mod report;
mod sets;
mod written;

use std::path::PathBuf;
use std::process::{Command, Output};

use chromascope_core::colorimetry::Metric;

/// Runs the program without a display.
pub(crate) fn run(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_chromascope"))
        .args(arguments)
        .env_remove("DISPLAY")
        .env_remove("WAYLAND_DISPLAY")
        .output()
        .unwrap()
}

fn table(arguments: &[&str]) -> Vec<Vec<String>> {
    let output = run(arguments);
    assert!(output.status.success(), "{arguments:?}: {}", String::from_utf8_lossy(&output.stderr));
    let text = String::from_utf8(output.stdout).unwrap();
    text.lines().map(|line| line.split(',').map(str::to_owned).collect()).collect()
}

/// Fails with a message that holds these words, and writes nothing.
fn refused(arguments: &[&str], words: &[&str]) {
    let output = run(arguments);
    let message = String::from_utf8_lossy(&output.stderr);
    assert!(!output.status.success() && output.stdout.is_empty(), "{arguments:?}");
    for word in words {
        assert!(message.contains(word), "{arguments:?}: {message}");
    }
}

fn file(name: &str, text: &str) -> PathBuf {
    let path = std::path::Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    std::fs::write(&path, text).unwrap();
    path
}

fn number(cell: &str) -> f64 {
    cell.parse().unwrap_or_else(|_| panic!("no number: {cell}"))
}

/// The conditions that each row ends with.
const CONDITIONS: &str = "reference,illuminant,white_balance,transform,preset";
/// The paper's conditions, as each row ends with them.
const PAPER: [&str; 5] = ["Stiles & Burch 1955 2°", "E", "unity", "paper matrix (Eq 13)", "paper"];

/// The cells of a column, by its head.
fn column<'a>(rows: &'a [Vec<String>], head: &str) -> Vec<&'a str> {
    let index = rows[0].iter().position(|cell| cell == head).unwrap_or_else(|| panic!("no column {head}"));
    rows[1..].iter().map(|row| row[index].as_str()).collect()
}

#[test]
fn loci_of_the_first_screen() {
    let rows = table(&["locus"]);
    assert_eq!(
        rows[0].join(","),
        format!(
            "sensor,temperature_k,x,y,u_prime,v_prime,distance_xy,distance_uv_prime,cct_error_k,arc_length_xy,extrapolated,{CONDITIONS}"
        )
    );
    assert_eq!(rows.len(), 1 + 4 * 200);
    assert_eq!((rows[1][0].as_str(), rows[1][1].as_str()), ("CIE 1931 2°", "1000"));
    assert_eq!((rows[800][0].as_str(), rows[800][1].as_str()), ("Kodak DCS200", "20000"));
    let mired: Vec<f64> = rows[1..=200].iter().map(|row| 1e6 / number(&row[1])).collect();
    let step = mired[1] - mired[0];
    assert!(mired.windows(2).all(|pair| (pair[1] - pair[0] - step).abs() < 1e-9), "evenly in 1/T");
    let digits = |cell: &str| cell.trim_start_matches(['-', '0', '.']).chars().filter(char::is_ascii_digit).count();
    assert!(rows[1..].iter().all(|row| row[2..6].iter().all(|cell| digits(cell) >= 12)));
}

/// Computed with numpy from the same tables, by plain sums: an independent program.
#[test]
fn loci_agree_with_another_program() {
    let rows = table(&["locus", "--preset", "paper", "--temperatures", "5500,1000"]);
    // Source, T, x, y.
    for (row, expected) in [
        (1, ["Stiles & Burch 1955 2°", "5500", "0.314229510181784", "0.335803197066415"]),
        (2, ["Stiles & Burch 1955 2°", "1000", "0.565589089904457", "0.390563128410180"]),
        (8, ["Kodak DCS200", "1000", "0.392041159837522", "0.305312447020714"]),
    ] {
        assert_eq!(rows[row][..2], expected[..2]);
        for column in [2, 3] {
            assert!((number(&rows[row][column]) - number(expected[column])).abs() < 1e-11, "{:?}", rows[row]);
        }
    }
}

#[test]
fn sources_and_temperatures_keep_their_order() {
    let rows = table(&[
        "locus",
        "--camera",
        "nikon d70",
        "--observer",
        "cie1931 2",
        "--camera",
        "CANON EOS-10D",
        "--temperatures",
        "6500,3000",
    ]);
    let heads: Vec<(&str, &str)> = rows[1..].iter().map(|row| (row[0].as_str(), row[1].as_str())).collect();
    let names = ["Nikon D70 (A.M.P.A.S.)", "CIE 1931 2°", "Canon EOS 10D (2007 figure)"];
    let expected: Vec<(&str, &str)> = names.iter().flat_map(|name| [(*name, "6500"), (*name, "3000")]).collect();
    assert_eq!(heads, expected);
}

#[test]
fn any_temperature_is_finite() {
    let rows = table(&["locus", "--temperatures", "1,1e15"]);
    assert!(rows[1..].iter().all(|row| row[2..10].iter().all(|cell| cell.is_empty() || number(cell).is_finite())));
}

#[test]
fn patches_of_the_default_chart() {
    let rows = table(&["patches", "--observer", "CIE 1931 2°", "--camera", "Kodak DCS200"]);
    assert_eq!(
        rows[0].join(","),
        format!(
            "sensor,patch,r,g,b,x_tristimulus,y_tristimulus,z_tristimulus,x,y,u_prime,v_prime,lab_l,lab_a,lab_b,\
             cct_k,duv,{},{CONDITIONS}",
            Metric::ALL.iter().map(|metric| metric.column).collect::<Vec<_>>().join(",")
        )
    );
    assert_eq!(rows.len(), 1 + 2 * 24);
    assert!(rows[1][2..5].iter().all(String::is_empty), "CIE observers have no RGB");
    assert!(rows[25][2..5].iter().all(|cell| !cell.is_empty()));
    let five = table(&["patches", "--chart", "ColorChecker five", "--camera", "Kodak DCS200"]);
    let names: Vec<&str> = five[1..].iter().map(|row| row[1].as_str()).collect();
    assert_eq!(names, ["red", "green", "blue", "white", "orange yellow"]);
}

#[test]
fn a_perfect_white_takes_the_white() {
    let chart = file("perfect_white.csv", "wavelength_nm,white\n380,1\n780,1\n");
    let chart = chart.to_str().unwrap();
    let unity = table(&["patches", "--chart", chart, "--camera", "Sony ILCE-9", "--illuminant", "A"]);
    assert!(unity[1][2..5].iter().all(|cell| number(cell) == 1.0), "{:?}", unity[1]);
    let d55 = table(&["patches", "--chart", chart, "--camera", "Sony ILCE-9", "--white", "D55"]);
    let digits: Vec<String> = d55[1][2..5].iter().map(|cell| format!("{:.4}", number(cell))).collect();
    assert_eq!(digits, ["1.1040", "0.9870", "0.8233"], "the paper's");
    let fitted = ["patches", "--chart", chart, "--illuminant", "D65", "--transform", "fitted"];
    let rows = table(&[&fitted[..], &["--camera", "Kodak DCS200", "--observer", "CIE 1931 2°"]].concat());
    for (camera, observer) in rows[1][5..10].iter().zip(&rows[2][5..10]) {
        assert!((number(camera) - number(observer)).abs() < 1e-12, "white stays white");
    }
}

#[test]
fn a_camera_file_is_a_camera() {
    let text = std::fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/assets/cameras/nikon_d850.csv")).unwrap();
    let figures = text.lines().filter(|line| !line.starts_with('#')).collect::<Vec<_>>().join("\n");
    let path = file("my camera.csv", &figures);
    let rows = table(&["locus", "--camera", path.to_str().unwrap(), "--camera", "Nikon D850", "--count", "7"]);
    assert_eq!(rows[1][0], "my camera");
    for row in 1..=7 {
        assert_eq!(rows[row][2..], rows[row + 7][2..]);
    }
}

#[test]
fn decimal_commas_and_percent_are_read() {
    let points = file("leaf.csv", "nm;leaf\n400;5,0\n500;10,0\n600;20,0\n700;50,0\n");
    let fractions = file("leaf2.csv", "nm,leaf\n400,0.05\n500,0.10\n600,0.20\n700,0.50\n");
    let of = |path: &PathBuf, values: &str| {
        let chart = ["patches", "--chart", path.to_str().unwrap(), "--values", values];
        table(&[&chart[..], &["--camera", "Nikon D70 (2007 figure)"]].concat())[1][2..].to_vec()
    };
    assert_eq!(of(&points, "percent"), of(&fractions, "plain"));
    // Nothing is divided by 100 unless requested.
    refused(&["patches", "--chart", points.to_str().unwrap()], &["leaf.csv", "--values percent"]);
}

#[test]
fn a_camera_of_four_channels_has_its_own_blue() {
    let rows =
        "400,0.01,0.01,0.01,0.3\n450,0.02,0.1,0.1,0.9\n500,0.1,0.6,0.6,0.4\n600,0.9,0.3,0.3,0.02\n700,0.1,0,0,0\n";
    let four = file("four.csv", &format!("nm,R,G1,G2,B\n{rows}"));
    let three: String = rows
        .lines()
        .map(|row| row.split(',').collect::<Vec<_>>())
        .fold(String::new(), |text, cells| text + &[cells[0], cells[1], cells[2], cells[4]].join(",") + "\n");
    let three = file("three.csv", &format!("nm,R,G,B\n{three}"));
    let of = |path: &PathBuf| {
        let rows = table(&["patches", "--per", "energy", "--camera", path.to_str().unwrap()]);
        rows.into_iter().map(|row| row[1..].to_vec()).collect::<Vec<_>>()
    };
    assert_eq!(of(&four), of(&three));
    let nameless = file("nameless.csv", &rows.replace(',', ";"));
    refused(&["patches", "--camera", nameless.to_str().unwrap()], &["4 curves", "red, green and blue"]);
}

#[test]
fn mistakes_are_named() {
    refused(&["locus", "--camera", "Nikn D70"], &["Nikn D70", "did you mean", "Nikon D70 (2007 figure)"]);
    refused(&["locus", "--camera", "Nikon"], &["could be", "Nikon D200"]);
    refused(&["locus", "--camera", "missing.csv"], &["missing.csv"]);
    refused(&["locus", "--fit-to", "CIE 1964 10°", "--transform", "paper"], &["--transform fitted"]);
    let cones = ["--observer", "CIE 2006 2° cone fundamentals"];
    refused(&[&["locus", "--transform", "paper"], &cones[..]].concat(), &["Eq 13", "--transform fitted"]);
    refused(&["locus", "--from", "2000", "--temperatures", "3000"], &["--from"]);
    refused(&["locus", "--count", "0"], &["--count"]);
    refused(&["locus", "--temperatures=-5"], &["-5"]);
    refused(&["patches", "--white", "daylight:warm"], &["daylight:5500"]);
    refused(&["patches", "--white", "daylight:2000"], &["4000"]);
    let broken = file("broken.csv", "nm,leaf\n400,0.1\n410,0.2\n420,oops\n430,0.2\n440,0.3\n");
    refused(&["patches", "--chart", broken.to_str().unwrap()], &["broken.csv", "line 4", "column 2"]);
}

#[test]
fn out_is_a_file_or_standard_output() {
    let path = std::path::Path::new(env!("CARGO_TARGET_TMPDIR")).join("locus_out.csv");
    let _absent = std::fs::remove_file(&path);
    let arguments = ["locus", "--count", "3", "--out"];
    let output = run(&[&arguments[..], &[path.to_str().unwrap()]].concat());
    assert!(output.status.success() && output.stdout.is_empty());
    let dash = run(&[&arguments[..], &["-"]].concat());
    assert_eq!(std::fs::read(&path).unwrap(), dash.stdout);
    refused(&["locus", "--out", "/no/such/folder/x.csv"], &["/no/such/folder/x.csv"]);
}

#[test]
fn lists_are_names_one_a_line() {
    let lines = |kind: &str| String::from_utf8(run(&["list", kind]).stdout).unwrap().lines().count();
    let files = |folder| std::fs::read_dir(std::path::Path::new("assets").join(folder)).unwrap();
    let data =
        |folder| files(folder).filter(|f| f.as_ref().unwrap().path().extension().is_some_and(|e| e == "csv")).count();
    assert_eq!((lines("cameras"), lines("observers")), (data("cameras"), data("observers")));
    assert_eq!(lines("charts"), data("charts") + 1, "the paper's five patches are a chart too");
    assert!(lines("illuminants") > 40 && lines("materials") > 100);
    assert!(run(&["--version"]).status.success() && run(&["--help"]).status.success());
}

#[test]
fn without_a_display_the_window_says_so() {
    refused(&[], &["display", "xvfb", "chromascope locus"]);
}
