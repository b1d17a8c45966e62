//! `recover chart`: what is printed, what is stated in the file, and what is not written.

use std::path::{Path, PathBuf};

use chromascope_core::patch_set::PatchSet;
use chromascope_core::spectral::{Dataset, GridSpectrum, Quantity, Sensor};

use super::{file, run};
use crate::measure::large_chart;

#[allow(dead_code, clippy::cast_possible_wrap, reason = "shared with the tests of the reader, whose files are small")]
#[path = "../../raw-image/writer.rs"]
pub(crate) mod dng;

const CHART: &str = "ColorChecker 24 (BabelColor average)";

/// Raw values of the chart under a light through a camera of the library, the brightest at 40000, with noise of up to 0.3 %.
pub(crate) fn recording(light: &str) -> Vec<(String, [f64; 3])> {
    let asset = |path: &str| Dataset::read(chromascope_data::text(path).unwrap()).unwrap();
    let camera = Sensor::from_dataset(&asset("cameras/nikon_d700.csv")).unwrap();
    let chart = PatchSet::from_dataset(&asset("charts/colorchecker_24_babelcolor_average.csv"));
    let light = GridSpectrum::resample(&asset(light).curves[0], Quantity::Light);
    let raw = |(at, patch): (usize, &chromascope_core::patch_set::Patch)| {
        let rgb = camera.integrate(patch.grid.times(&light).values());
        (patch.name.clone(), [0, 1, 2].map(|c: usize| rgb[c] * (1.0 + 0.003 * ((at * 7 + c * 5) % 11) as f64 / 11.0)))
    };
    let all: Vec<(String, [f64; 3])> = chart.patches().iter().enumerate().map(raw).collect();
    let most = all.iter().flat_map(|(_, rgb)| *rgb).fold(0.0, f64::max);
    all.into_iter().map(|(name, rgb)| (name, rgb.map(|value| 40_000.0 * value / most))).collect()
}

fn table(name: &str, light: &str) -> String {
    let rows = recording(light).into_iter().map(|(patch, [r, g, b])| format!("{patch},{r},{g},{b}\n"));
    file(name, &("patch,R,G,B\n".to_owned() + &rows.collect::<String>())).display().to_string()
}

/// Standard output, standard error, and true for success.
fn recover(arguments: &[&str]) -> (String, String, bool) {
    let output = run(&[&["recover", "chart"], arguments].concat());
    let [out, error] = [output.stdout, output.stderr].map(|bytes| String::from_utf8(bytes).unwrap());
    (out, error, output.status.success())
}

/// What is stated of a table in the file beside it.
fn stated(path: &str) -> String {
    std::fs::read_to_string(format!("{path}-metadata.json")).unwrap()
}

#[test]
fn light_is_named_and_doubts_are_told_before_anything_is_written() {
    let warm = table("recover_a.csv", "illuminants/a.csv");
    let (_, error, done) = recover(&[&warm, "--chart", CHART]);
    assert!(!done && error.contains("--illuminant"), "{error}");
    let written = file("recover_doubtful.csv", "").display().to_string();
    let as_daylight = [&warm, "--chart", CHART, "--illuminant", "daylight", "--out", &written, "--force"];
    let (out, error, done) = recover(&as_daylight);
    assert!(!done && out.contains("Warning: Daylight of ") && error.contains("--accept-warnings"), "{out} {error}");
    assert_eq!(std::fs::read_to_string(&written).unwrap(), "", "nothing is written");
    assert!(recover(&[&as_daylight[..], &["--accept-warnings"]].concat()).2);
    let named = [&warm, "--chart", CHART, "--illuminant", "A", "--out", &written, "--force"];
    let (out, _, done) = recover(&named);
    assert!(done && !out.contains("Warning"), "{out}");
    for words in [&format!("Chart: {CHART}"), "red, %", "leave-one-out", "ForwardMatrix", "± is expanded (k = 2)"] {
        assert!(out.contains(words), "{words}: {out}");
    }
    assert!(stated(&written).contains(&format!("24 patches of {CHART} under A")));
}

#[test]
fn a_wrong_light_is_refused_beside_a_right_one_with_its_picture() {
    let [warm, cold] = [("recover_warm.csv", "a"), ("recover_cold.csv", "d65")]
        .map(|(name, light)| table(name, &format!("illuminants/{light}.csv")));
    let lights = ["--chart", CHART, "--illuminant", "FL11", "--illuminant", "D65"];
    let (_, alone, _) = recover(&[&[warm.as_str()], &lights[..4]].concat());
    let (_, error, done) = recover(&[&[warm.as_str(), &cold], &lights[..]].concat());
    assert!(!done && error.contains("recover_warm.csv by itself") && alone.contains("the light "), "{error} {alone}");
}

/// A DNG of the chart under a light, without gaps, whose corners are [`CORNERS`].
fn photograph(name: &str, light: &str, tags: &[dng::Tag]) -> String {
    let rows = recording(light);
    let at = |index: usize| {
        let (x, y) = (index % 240 / 40, index / 240 / 40);
        rows[y * 6 + x].1.map(|value| value as u16)
    };
    let samples: Vec<u8> = (0..240 * 160).flat_map(at).flat_map(u16::to_le_bytes).collect();
    let picture = file(name, "");
    std::fs::write(&picture, dng::Dng::linear(240, 160, 16, samples).with(tags).bytes()).unwrap();
    picture.display().to_string()
}

const CORNERS: [&str; 5] = ["--corners", "0,0", "240,0", "240,160", "0,160"];

#[test]
fn the_camera_of_a_dng_names_the_curves() {
    let tags = [dng::text(271, "NIKON CORPORATION"), dng::text(272, "NIKON D700"), dng::text(50708, "Nikon D700 X")];
    let picture = photograph("recover_camera.dng", "illuminants/d65.csv", &tags);
    let [written, profile] =
        ["recover_camera.csv", "recover_camera.dcp"].map(|name| file(name, "").display().to_string());
    let named = ["--illuminant", "D65", "--out", &written, "--profile", &profile, "--force"];
    let (out, error, done) = recover(&[&[picture.as_str(), "--title", "My own"], &CORNERS[..], &named].concat());
    assert!(done && !error.contains("--model"), "{out} {error}");
    assert!(stated(&written).contains("My own"));
    // By which raw developers offer the profile, and the same for one that is made of the curves.
    let has_model = |bytes: &[u8]| bytes.windows(13).any(|at| at == b"Nikon D700 X\0");
    assert!(has_model(&std::fs::read(&profile).unwrap()));
    let matrix = run(&["matrix", &written, "--illuminant", "D65", "--format", "dng"]);
    assert!(matrix.stdout.starts_with(b"UniqueCameraModel: Nikon D700 X\n"), "{matrix:?}");
    let (_, _, done) = recover(&[&[picture.as_str(), "--model", "Other"], &CORNERS[..], &named].concat());
    assert!(done && !has_model(&std::fs::read(&profile).unwrap()));
    let table = table("recover_no_model.csv", "illuminants/d65.csv");
    let (_, error, done) = recover(&[&[table.as_str(), "--chart", CHART], &named[..]].concat());
    assert!(
        done && error.contains("\"Recovered camera\", by the camera's name") && error.contains("--model"),
        "{error}"
    );
}

#[test]
fn pictures_of_two_models_are_not_mixed() {
    let one = photograph("recover_one.dng", "illuminants/d65.csv", &[dng::text(50708, "One")]);
    let other = photograph("recover_other.dng", "illuminants/a.csv", &[dng::text(50708, "Other")]);
    let named = [&[one.as_str(), &other, "--illuminant", "D65", "--illuminant", "A"], &CORNERS[..]].concat();
    let (_, error, done) = recover(&named);
    assert!(!done && error.contains("of the model \"One\"") && error.contains("recover_other.dng from a \"Other\""));
    assert!(error.contains("name its model with --model"), "{error}");
    assert!(recover(&[&named[..], &["--model", "One"]].concat()).2);
}

#[test]
fn a_chart_of_another_grid_is_recovered_by_its_own_reflectances() {
    let (chart, picture) = large_chart("Command line chart");
    let [chart, picture] = [&chart, &picture].map(|path| path.to_str().unwrap());
    let light = chromascope::document::Document::colorimetry();
    let chromascope::document::Light::Set(light) = light.light else { panic!("{:?}", light.light) };
    let named = [picture, "--chart", chart, "--illuminant", &light];
    let corners = ["--corners", "0,0", "560,0", "560,400", "0,400"];
    let (_, error, done) = recover(&[&named[..], &["--layout", "14x10"]].concat());
    assert!(!done && error.contains("--corners"), "{error}");
    let (_, error, done) = recover(&[&named[..], &corners].concat());
    assert!(!done && error.contains("140 patches, the picture 24"), "{error}");
    let written = file("recover_grid.csv", "").display().to_string();
    let out = ["--grid", "14x10", "--out", &written, "--force"];
    let (out, error, done) = recover(&[&named[..], &corners, &out].concat());
    assert!(done && !out.contains("Warning"), "{out} {error}");
    // Row by row, whatever the order of the file.
    let at = |name: &str| out.lines().position(|line| line.trim_start().starts_with(name)).unwrap();
    assert!(at("A1 ") < at("B1 ") && at("B1 ") < at("N1 ") && at("N1 ") < at("A2 "), "{out}");
    assert!(stated(&written).contains("raw values of 140 patches of"));
}

#[test]
fn narrow_bands_are_printed_with_what_was_left_out() {
    let pass = |number: u32| {
        let text = chromascope_data::text(&format!("test-samples/nikon_d70_narrowband_pass{number}.csv")).unwrap();
        file(&format!("recover_bands_{number}.csv"), text).display().to_string()
    };
    let [first, second] = [pass(1), pass(2)];
    let output = run(&["recover", "narrowband", &first, &second, "--clip", "16384"]);
    let out = String::from_utf8(output.stdout).unwrap();
    assert!(output.status.success() && out.contains("tables: blue at 410, 420, 430, 440 nm"), "{out}");
    let few = file(
        "recover_few_bands.csv",
        &std::fs::read_to_string(&first).unwrap().lines().take(12).fold(String::new(), |all, line| all + line + "\n"),
    );
    let output = run(&["recover", "narrowband", few.to_str().unwrap(), "--clip", "16384"]);
    let error = String::from_utf8(output.stderr).unwrap();
    assert!(error.contains("recover_few_bands.csv: 4 bands; at least 8 are needed"), "{error}");
}

/// A table of the pictures of a pass, 16 bits of its 14, in a folder of its own: 48 × 40 pixels, the band in the middle quarter of width and
/// height.
pub(crate) fn pass_of_pictures(name: &str, number: u32) -> PathBuf {
    const WHITE: f64 = 65535.0 / 16384.0;
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    std::fs::create_dir_all(&folder).unwrap();
    let text = chromascope_data::text(&format!("test-samples/nikon_d70_narrowband_pass{number}.csv")).unwrap();
    let mut table = String::from("wavelength_nm,power,exposure_s,picture,dark_picture\n");
    for row in text.lines().filter(|line| line.starts_with(|c: char| c.is_ascii_digit())) {
        let cells: Vec<&str> = row.split(',').collect();
        let picture = |name: &str, means: &[&str]| {
            let rgb: Vec<u16> =
                means.iter().map(|mean| (WHITE * mean.parse::<f64>().unwrap()).round() as u16).collect();
            let pixel = |x, y| {
                let is_band = (18..30).contains(&x) && (15..25).contains(&y);
                image::Rgb(if is_band { [rgb[0], rgb[1], rgb[2]] } else { [60_000, 50, 30_000] })
            };
            image::ImageBuffer::from_fn(48, 40, pixel).save(folder.join(name)).unwrap();
        };
        let [lit, dark] = ["lit", "dark"].map(|what| format!("{}_{what}_{number}.png", cells[0]));
        picture(&lit, &cells[3..6]);
        picture(&dark, &cells[6..9]);
        table += &[&cells[..3].join(","), ",", &lit, ",", &dark, "\n"].concat();
    }
    let path = folder.join(format!("pass{number}.csv"));
    std::fs::write(&path, table).unwrap();
    path
}

#[test]
fn pictures_of_bands_say_what_their_means_say() {
    let text = chromascope_data::text("test-samples/nikon_d70_narrowband_pass1.csv").unwrap();
    let means = file("recover_means.csv", text).display().to_string();
    let table = pass_of_pictures("recover_pictures", 1);
    let pictures = table.display().to_string();
    let curves = |arguments: &[&str]| {
        let output = run(&[&["recover", "narrowband"], arguments].concat());
        let out = String::from_utf8(output.stdout).unwrap();
        assert!(output.status.success(), "{out} {}", String::from_utf8_lossy(&output.stderr));
        let rows = out.lines().filter(|line| line.trim_start().starts_with(|c: char| c.is_ascii_digit()));
        let cells = rows.map(|row| row.split_whitespace().filter_map(|cell| cell.parse().ok()).collect::<Vec<f64>>());
        (cells.collect::<Vec<_>>(), out)
    };
    let (of_means, _) = curves(&[&means, "--clip", "16384"]);
    let (of_pictures, out) = curves(&[&pictures]);
    assert!(out.contains("tables: blue at 410, 420, 430, 440 nm"), "{out}");
    assert!(out.contains("pass1.csv: means of 12 × 10 pixels at 18, 15 of each picture"), "{out}");
    assert_eq!(of_means.len(), of_pictures.len());
    for (mean, picture) in of_means.iter().flatten().zip(of_pictures.iter().flatten()) {
        // Sixteen bits round a dark blue of 20 by 0.6 %.
        assert!((mean - picture).abs() <= 3e-3, "{mean} {picture}");
    }
    let stated = std::fs::read_to_string(&table).unwrap();
    std::fs::write(&table, format!("# region: 20,16,8,8\n{stated}")).unwrap();
    assert!(curves(&[&pictures]).1.contains("means of 8 × 8 pixels at 20, 16"));
    assert!(curves(&[&pictures, "--region", "19,17,6,6"]).1.contains("means of 6 × 6 pixels at 19, 17"));
    let refused = |arguments: &[&str], why: &str| {
        let output = run(&[&["recover", "narrowband"], arguments].concat());
        let error = String::from_utf8(output.stderr).unwrap();
        assert!(!output.status.success() && error.contains(why), "{error}");
    };
    refused(&[&pictures, "--region", "40,16,20,8"], "line 3, 400_lit_1.png: the region of 20 x 8 pixels at 40, 16");
    refused(&[&pictures, "--region", "1,2,3"], "LEFT,TOP,WIDTH,HEIGHT");
    refused(&[&means], "name the raw value from which on a mean is saturated");
    std::fs::write(&table, format!("# region: a\n{stated}")).unwrap();
    refused(&[&pictures], "pass1.csv: line 1: expected # region: LEFT,TOP,WIDTH,HEIGHT");
    std::fs::write(&table, stated.replace("410_lit_1", "none")).unwrap();
    refused(&[&pictures], "line 3, none.png: ");
}
