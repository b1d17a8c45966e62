//! `chromascope render --image`: spectral images through cameras.

use std::path::Path;
use std::process::{Command, Output};

use chromascope_core::spectral::Dataset;

use crate::cli_render::folder;

fn run(folder: &Path, arguments: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_chromascope"));
    command.args(arguments).current_dir(folder);
    command.env_remove("DISPLAY").env_remove("WAYLAND_DISPLAY").output().unwrap()
}

fn said(folder: &Path, arguments: &[&str]) -> String {
    let output = run(folder, arguments);
    assert!(output.status.success(), "{arguments:?}: {}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).unwrap()
}

fn refused(folder: &Path, arguments: &[&str], words: &[&str]) {
    let output = run(folder, arguments);
    let message = String::from_utf8_lossy(&output.stderr);
    assert!(!output.status.success(), "{arguments:?}");
    for word in words {
        assert!(message.contains(word), "{arguments:?}: {message}");
    }
}

/// An ENVI image of 24 × 2 pixels: the chart's patches side by side.
pub(crate) fn chart_image(folder: &Path, interleave: &str, fields: &str) {
    let chart = Dataset::read(chromascope_data::text("charts/colorchecker_24_ohta_1997.csv").unwrap()).unwrap();
    let nm = chart.curves[0].wavelengths_nm();
    let (width, height, bands) = (chart.curves.len(), 2, nm.len());
    let sample = |band: usize, column: usize| (chart.curves[column].values()[band] as f32).to_le_bytes();
    let mut bytes = Vec::new();
    for i in 0..width * height * bands {
        let (band, column) = match interleave {
            "bip" => (i % bands, i / bands % width),
            "bil" => (i / width % bands, i % width),
            _ => (i / width / height, i % width),
        };
        bytes.extend(sample(band, column));
    }
    let list = nm.iter().map(f64::to_string).collect::<Vec<_>>().join(", ");
    let header = format!(
        "ENVI\nsamples = {width}\nlines = {height}\nbands = {bands}\ndata type = 4\nbyte order = 0\ninterleave = {interleave}\n\
         wavelength units = Nanometers\nwavelength = {{{list}}}\n{fields}"
    );
    std::fs::write(folder.join("chart.hdr"), header).unwrap();
    std::fs::write(folder.join("chart.img"), bytes).unwrap();
}

const D70: [&str; 6] = ["--camera", "Nikon D70 (A.M.P.A.S.)", "--illuminant", "D65", "--white-balance", "unity"];

#[test]
fn an_image_of_the_chart_equals_patches_in_every_order() {
    let folder = folder("image_orders");
    let patches = said(&folder, &[&["patches", "--chart", "ColorChecker 24 (Ohta 1997)"], &D70[..]].concat());
    let heads: Vec<&str> = patches.lines().next().unwrap().split(',').collect();
    let at = heads.iter().position(|head| *head == "delta_e_2000").unwrap();
    let differences: Vec<f64> =
        patches.lines().skip(1).map(|row| row.split(',').nth(at).unwrap().parse().unwrap()).collect();
    assert_eq!(differences.len(), 24);
    let mean = differences.iter().sum::<f64>() / 24.0;
    let max = differences.iter().copied().fold(0.0, f64::max);
    let mut pictures = Vec::new();
    for interleave in ["bil", "bip", "bsq"] {
        chart_image(&folder, interleave, "reflectance scale factor = 1\n");
        let text = said(&folder, &[&["render", "--image", "chart.hdr", "--force"], &D70[..]].concat());
        assert!(text.contains(&format!("ΔE*00 mean {mean:.2}")), "{text}: mean {mean}");
        assert!(text.contains(&format!("max {max:.2}")), "{text}: max {max}");
        assert!(text.contains("48 of 48 pixels"), "{text}");
        pictures.push(std::fs::read(folder.join("chart_nikon-d70-a-m-p-a-s.png")).unwrap());
    }
    assert!(pictures.windows(2).all(|pair| pair[0] == pair[1]));
    // The same numbers as OpenEXR: Y of the patch in the middle of the gray row.
    said(&folder, &[&["render", "--image", "chart.img", "--format", "exr"], &D70[..]].concat());
    assert!(folder.join("chart_nikon-d70-a-m-p-a-s.exr").is_file());
}

#[test]
fn images_that_say_too_little_are_refused_with_a_remedy() {
    let folder = folder("image_refused");
    chart_image(&folder, "bil", "");
    let image = ["render", "--image", "chart.hdr"];
    refused(&folder, &[&image[..], &D70].concat(), &["chart.hdr", "--image-quantity"]);
    let radiance = said(&folder, &[&image[..], &D70, &["--image-quantity", "radiance"]].concat());
    assert!(radiance.contains("white at Y = "), "{radiance}");
    refused(&folder, &["render", "--image", "chart.hdr", "--mesh", "head"], &["--mesh"]);
    refused(&folder, &["render", "--image", "none.hdr"], &["none.hdr"]);
    std::fs::remove_file(folder.join("chart.img")).unwrap();
    refused(&folder, &image, &["chart.hdr: no data beside this header"]);
    std::fs::write(folder.join("chart.img"), [0; 100]).unwrap();
    refused(&folder, &image, &["chart.img", "100 bytes", "header states"]);
}

#[test]
fn openexr_with_spectral_channels_is_an_image() {
    let folder = folder("image_openexr");
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/spectral-image/data/openexr_reflectance.exr");
    std::fs::copy(source, folder.join("four.exr")).unwrap();
    let text = said(&folder, &[&["render", "--image", "four.exr"], &D70[..]].concat());
    assert!(text.contains("4x3, 5 bands, 12 of 12 pixels"), "{text}");
    // What this program writes has no spectrum.
    said(&folder, &[&["render", "--image", "four.exr", "--format", "exr"], &D70[..]].concat());
    refused(&folder, &["render", "--image", "four_nikon-d70-a-m-p-a-s.exr"], &["no spectral channels", "S0.550"]);
}
