//! `chromascope render`: pictures, their numbers, what is measured, and what is refused.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use chromascope::catalog::Catalog;
use chromascope::document::render::{MeshChoice, RenderSettings, SUN};
use chromascope::document::{Compared, Document, Light, SetKind, WhiteBalanceChoice};
use chromascope::results::Results;
use chromascope::scene::Scene;
use chromascope::scene::orbit::Orbit;
use chromascope::scene::render::Finish;
use chromascope_core::query::Ask as _;
use chromascope_core::query::render::picture::Pictures;
use chromascope_core::render::{Quality, RasterSize, Shadows};
use exr::prelude::{AnyChannels, AttributeValue, FlatImage, FlatSamples, Layer};
use serde_json::Value;

/// Little enough to be rendered by a program that was not optimized.
const SMALL: [&str; 8] = ["--preset", "paper", "--mesh", "sphere", "--triangles", "800", "--size", "40x30"];
/// The mesh without surroundings.
const ALONE: [&str; 6] = ["--chart", "false", "--ground", "false", "--hair", "false"];
const D70: [&str; 2] = ["--camera", "Nikon D70 (2007 figure)"];

/// A folder of one test's own, empty.
pub(crate) fn folder(name: &str) -> PathBuf {
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join("cli_render").join(name);
    if path.exists() {
        std::fs::remove_dir_all(&path).unwrap();
    }
    std::fs::create_dir_all(&path).unwrap();
    path
}

fn run(folder: &Path, arguments: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_chromascope"));
    command.arg("render").args(arguments).current_dir(folder);
    command.env_remove("DISPLAY").env_remove("WAYLAND_DISPLAY").output().unwrap()
}

/// Standard output of a run. Pictures of earlier calls in the same folder are replaced.
fn rendered(folder: &Path, arguments: &[&str]) -> String {
    let output = run(folder, &[arguments, &["--force"]].concat());
    assert!(output.status.success(), "{arguments:?}: {}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).unwrap()
}

/// Fails with this code and a message that holds these words, and leaves no picture.
fn refused(folder: &Path, arguments: &[&str], code: i32, words: &[&str]) {
    let output = run(folder, arguments);
    let message = String::from_utf8_lossy(&output.stderr);
    assert_eq!((output.status.code(), output.stdout.len()), (Some(code), 0), "{arguments:?}: {message}");
    for word in words {
        assert!(message.contains(word), "{arguments:?}: {message}");
    }
    assert!(pictures_in(folder).is_empty(), "{arguments:?}");
}

fn pictures_in(folder: &Path) -> Vec<String> {
    let paths = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    let pictures = paths.filter(|path| path.extension().is_some_and(|ending| ending == "png" || ending == "exr"));
    let mut names: Vec<String> =
        pictures.map(|path| path.file_name().unwrap().to_string_lossy().into_owned()).collect();
    names.sort();
    names
}

/// The small pictures, requested as the window does.
fn as_in_the_window(samples: u32, quality: Quality) -> (Pictures, [f64; 3]) {
    let compared = |name: &str, kind| Compared { name: name.to_owned(), kind, slot: 0, visible: true, label: None };
    let document = Document {
        compared: vec![compared("Nikon D70 (2007 figure)", SetKind::Camera)],
        light: Light::Set(SUN.to_owned()),
        white: WhiteBalanceChoice::Light("D55".to_owned()),
        render: RenderSettings { mesh: MeshChoice::Sphere, triangles: 800, sky: 0.0, ..RenderSettings::default() },
        ..Document::paper()
    };
    let (catalog, results) = (Catalog::built_in(), Results::default());
    let scene = Scene { document: &document, catalog: &catalog, results: &results };
    let viewpoint = Orbit::of(&RenderSettings { mesh: MeshChoice::Sphere, ..RenderSettings::default() })
        .viewpoint(40.0 / 30.0)
        .unwrap();
    let size = RasterSize { width: 40, height: 30, samples };
    let finish = Finish { size, quality, shadows: Shadows::Full, compared_samples: Some(usize::MAX), open_sky: false };
    let query = scene.pictures_of(&scene.sources(), scene.mesh_of(None).unwrap(), viewpoint, finish, None).unwrap();
    let rendering = (*results.ask(&query.sources[0])).clone().unwrap();
    let pictures = (*results.ask(&query)).clone().unwrap().unwrap();
    (pictures, rendering.white.to_array())
}

fn read_exr(path: &Path) -> (Layer<AnyChannels<FlatSamples>>, BTreeMap<String, Vec<f32>>) {
    let FlatImage { layer_data, .. } = exr::prelude::read_all_flat_layers_from_file(path).unwrap();
    assert_eq!(layer_data.len(), 1);
    let layer = layer_data.into_iter().next().unwrap();
    let channels = layer.channel_data.list.iter();
    let channels = channels.map(|channel| match &channel.sample_data {
        FlatSamples::F32(values) => (channel.name.to_string(), values.clone()),
        other => panic!("{other:?}"),
    });
    let channels = channels.collect();
    (layer, channels)
}

#[test]
fn without_sources_those_of_the_preset() {
    let folder = folder("first");
    let text = rendered(&folder, &[&SMALL[..], &["--out", "new/folder"]].concat());
    let lines: Vec<&str> = text.lines().collect();
    let starts = ["s-b-1955", "canon-10d-2007", "nikon-d70-2007", "kodak-dcs200"];
    for (line, start) in lines.iter().zip(starts) {
        assert!(
            line.starts_with(&format!("new/folder/sphere_{start}.png: ").replace('/', std::path::MAIN_SEPARATOR_STR)),
            "{line}"
        );
    }
    assert!(lines[0].ends_with(": the reference") && lines[1].contains("Δxy 0.0"));
    assert!(lines[1].contains(" facing light, median ") && lines[1].contains(", max "), "{}", lines[1]);
    assert_eq!(lines[4], "surface: Returns 0.49 of the light at normal incidence (0.03 at 85°)");
    assert!(lines[5].starts_with("4 pictures of 40x30, ") && lines[5].contains(" ms ("), "{}", lines[5]);
    assert_eq!(lines.len(), 6);
    assert_eq!(pictures_in(&folder.join("new/folder")).len(), 4);
    rendered(&folder, &["--mesh", "sphere", "--triangles", "800", "--size", "8x8", "--out", "default"]);
    let expected = ["canon-eos-5d-mark-ii", "cie-1931-2", "kodak-dcs200", "nikon-d70-a-m-p-a-s"];
    assert_eq!(pictures_in(&folder.join("default")), expected.map(|name| format!("sphere_{name}.png")));
}

#[test]
fn nothing_that_exists_is_replaced_unless_told_to() {
    let folder = folder("kept");
    let stats = folder.join("stats.json");
    let arguments = [&SMALL[..], &D70, &["--stats", "stats.json"]].concat();
    std::fs::write(&stats, "mine").unwrap();
    // One of two outputs is refused, so that neither is written.
    refused(&folder, &arguments, 1, &["stats.json", "--force"]);
    assert_eq!(std::fs::read_to_string(&stats).unwrap(), "mine");
    assert!(run(&folder, &[&arguments[..], &["--force"]].concat()).status.success());
    assert!(std::fs::read_to_string(&stats).unwrap().starts_with('{'));
    let picture = pictures_in(&folder).into_iter().find(|name| name.starts_with("sphere_nikon-d70")).unwrap();
    std::fs::remove_file(&stats).unwrap();
    std::fs::write(folder.join(&picture), "mine").unwrap();
    let output = run(&folder, &arguments);
    assert_eq!((output.status.code(), stats.exists()), (Some(1), false));
    // A file that is read is not overwritten, even with `--force`.
    std::fs::write(folder.join("gray.csv"), "wavelength_nm,gray\n380,0.2\n780,0.2\n").unwrap();
    let arguments = [&SMALL[..], &D70, &["--material", "gray.csv", "--stats", "./gray.csv", "--force"]].concat();
    let output = run(&folder, &arguments);
    let message = String::from_utf8_lossy(&output.stderr);
    assert!(
        output.status.code() == Some(1) && message.contains("gray.csv: not overwritten because this command reads it"),
        "{message}"
    );
    assert!(std::fs::read_to_string(folder.join("gray.csv")).unwrap().starts_with("wavelength_nm"));
}

#[test]
fn a_png_shows_the_windows_pixels() {
    let folder = folder("png");
    rendered(&folder, &[&SMALL[..], &D70].concat());
    let picture = image::open(folder.join("sphere_nikon-d70-2007.png")).unwrap().into_rgba8();
    let (window, _) = as_in_the_window(1, Quality::Full);
    let window = window.pictures[0].as_ref().unwrap();
    assert_eq!((picture.width() as usize, picture.height() as usize), (window.width, window.height));
    assert_eq!(picture.as_raw(), &window.rgba);
    assert!(window.rgba.chunks(4).any(|pixel| pixel[3] == 255 && pixel[0] > 100), "something is lit");
    assert_eq!(window.rgba[..4], [0; 4], "the corner is clear");
}

#[test]
fn exr_holds_the_numbers() {
    let folder = folder("exr");
    rendered(&folder, &[&SMALL[..], &D70, &["--samples", "2", "--format", "exr", "--exposure", "-3"]].concat());
    let path = folder.join("sphere_nikon-d70-2007.exr");
    let (layer, channels) = read_exr(&path);
    assert_eq!((layer.size.width(), layer.size.height()), (40, 30));
    assert_eq!(channels.keys().collect::<Vec<_>>(), ["A", "B", "G", "R", "X", "Y", "Z"]);

    let (window, white) = as_in_the_window(2, Quality::Full);
    let image = window.images[0].as_ref().unwrap();
    let place = |sample: u32| (sample as usize / 80 / 2) * 40 + sample as usize % 80 / 2;
    let mut expected = vec![[0.0_f64; 4]; 40 * 30];
    for (&sample, signal) in image.placed().samples().iter().zip(image.signals()) {
        for c in 0..3 {
            expected[place(sample)][c] += white[c] * f64::from(signal[c]) / 4.0;
        }
    }
    image.placed().seen().iter().for_each(|&sample| expected[place(sample)][3] += 0.25);
    let peak = expected.iter().map(|pixel| pixel[1]).fold(0.0, f64::max);
    assert!(peak > 0.05, "{peak}");
    for (c, name) in ["R", "G", "B", "A"].into_iter().enumerate() {
        for (pixel, expected) in channels[name].iter().zip(&expected) {
            assert!((f64::from(*pixel) - expected[c]).abs() < 1e-7 * peak.max(1.0), "{name}: {pixel} {expected:?}");
        }
    }
    assert!(expected.iter().any(|pixel| pixel[3] > 0.0 && pixel[3] < 1.0), "an edge");
    // Eq 13 has fixed coefficients: of a balanced white with R = G = B, Y is that very number.
    let outside = channels["A"].iter().position(|&a| a == 0.0).unwrap();
    assert!(["X", "Y", "Z"].iter().all(|name| channels[*name][outside] == 0.0));
    assert!(channels["Y"].iter().copied().fold(0.0, f32::max) > 0.05);
}

#[test]
fn exr_says_what_it_is_of_and_is_the_same_each_time() {
    let folder = folder("exr_header");
    let surface = ["--sigma", "4e-6", "--tau", "9e-6", "--patch", "30e-6,60e-6", "--ior", "1.5", "--light", "-1,0,1"];
    let arguments = [&SMALL[..], &D70, &surface, &["--format", "exr", "--reading", "paper"]].concat();
    rendered(&folder, &arguments);
    let path = folder.join("sphere_nikon-d70-2007.exr");
    let first = std::fs::read(&path).unwrap();
    rendered(&folder, &arguments);
    assert!(first == std::fs::read(&path).unwrap(), "two runs, the same bytes");

    let (layer, _) = read_exr(&path);
    let text = |value: &AttributeValue| match value {
        AttributeValue::Text(text) => String::from_utf8(text.as_slice().to_vec()).unwrap(),
        other => panic!("{other:?}"),
    };
    let of = |name: &str| layer.attributes.other.get(&exr::prelude::Text::from(name)).unwrap();
    assert_eq!(text(of("camera")), "Nikon D70 (2007 figure)");
    assert_eq!(text(of("balance")), "D55");
    assert_eq!(text(of("illuminant")), "Direct sun (ASTM G173)");
    assert_eq!(text(of("reading")), "paper");
    assert_eq!(text(of("specular")), "paper");
    let number = |name: &str| match of(name) {
        AttributeValue::F64(number) => *number,
        other => panic!("{other:?}"),
    };
    let numbers =
        [("sigma", 4e-6), ("tau", 9e-6), ("halfSideX", 30e-6), ("halfSideY", 60e-6), ("refractiveIndex", 1.5)];
    for (name, expected) in numbers {
        assert!((number(name) / expected - 1.0).abs() < 1e-12, "{name}");
    }
    let AttributeValue::FloatVec3((x, y, z)) = of("lightDirection") else { panic!("no direction") };
    assert!((x + 0.5_f32.sqrt()).abs() < 1e-6 && y.abs() < 1e-6 && (z - 0.5_f32.sqrt()).abs() < 1e-6);
    let AttributeValue::FloatVec3((r, _, b)) = of("balanceFactors") else { panic!("no balance") };
    assert!((r - 1.104).abs() < 1e-3 && (b - 0.8233).abs() < 1e-3, "the paper's");
    let software = layer.attributes.software_name.as_ref().unwrap().to_string();
    assert_eq!(software, concat!("chromascope ", env!("CARGO_PKG_VERSION")));
    assert!(layer.attributes.comments.is_some());
}

#[test]
fn a_cie_observer_has_no_red_green_and_blue() {
    let folder = folder("exr_cie");
    let text = rendered(&folder, &[&SMALL[..], &["--observer", "CIE 1931 2°", "--format", "exr"]].concat());
    assert!(text.contains("add --transform fitted"), "{text}");
    let (_, channels) = read_exr(&folder.join("sphere_cie-1931-2.exr"));
    assert_eq!(channels.keys().collect::<Vec<_>>(), ["A", "X", "Y", "Z"]);
    let fitted = ["--observer", "CIE 1931 2°", "--transform", "fitted"];
    assert!(rendered(&folder, &[&SMALL[..], &fitted].concat()).contains(": ΔE*00 "));
}

#[test]
fn a_head_wears_the_garment_that_is_named() {
    let folder = folder("garment");
    let stats = |garment: &[&str]| -> Value {
        let head = ["--size", "40x30", "--triangles", "10000", "--observer", "CIE 1931 2°", "--force", "--stats", "-"];
        let output = run(&folder, &[&head[..], &D70, garment].concat());
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        serde_json::from_slice(&output.stdout).unwrap()
    };
    let [bare, shirt] = [["--garment", "none"], ["--garment", "green sport shirt"]].map(|garment| stats(&garment));
    assert_eq!(
        (&bare["settings"]["garment"], &bare["sources"][1]["difference"]["garment_facing_light"]),
        (&Value::Null, &Value::Null)
    );
    assert_eq!(shirt["settings"]["garment"], "Green sport shirt 073 (Vrhel)");
    let difference = |stats: &Value, of: &str| stats["sources"][1]["difference"][of].as_f64();
    assert!(difference(&shirt, "garment_facing_light").is_some_and(|difference| difference > 0.0));
    assert_eq!(difference(&shirt, "facing_light"), difference(&bare, "facing_light"), "of the skin");
    assert_ne!(difference(&shirt, "mean_of_lit"), difference(&bare, "mean_of_lit"));
}

#[test]
fn statistics_are_json() {
    let folder = folder("stats");
    let smooth = ["--sigma", "3e-7", "--tau", "3e-6", "--patch", "2e-6,2e-6", "--sky", "0", "--stats", "-"];
    let output = run(&folder, &[&SMALL[..], &D70, &smooth].concat());
    let message = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success() && message.contains("sphere_nikon-d70-2007.png: Δxy 0.0"), "{message}");
    let json: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(json["size"], serde_json::json!({ "width": 40, "height": 30, "samples_per_side": 1 }));
    assert_eq!(json["settings"]["sigma_m"], 3e-7);
    let count = |name: &str| json["samples"][name].as_u64().unwrap_or_else(|| panic!("{name}"));
    assert_eq!(count("all"), 1200);
    assert_eq!(count("seen"), count("lit") + count("facing_away") + count("in_shadow"));
    let kinds = ["below_threshold", "lambertian", "spectral"].map(count);
    assert_eq!(count("lit"), kinds.iter().sum::<u64>());
    assert_eq!(count("lit"), count("mirror_terms") + count("mirror_terms_skipped"));
    assert!(count("spectral") > 0 && count("shadow_rays") > 0, "{}", json["samples"]);
    assert_eq!(json["plans"]["built"], 0, "few samples do not pay for one");
    for stage in ["mesh", "visibility", "geometry", "shading", "camera image", "picture", "difference"] {
        assert!(json["stages"][stage]["own_ms"].as_f64().is_some_and(|ms| ms >= 0.0), "{stage}");
        assert!(json["stages"][stage]["misses"].as_u64().is_some_and(|misses| misses >= 1), "{stage}");
    }
    let source = &json["sources"][0];
    assert_eq!(source["name"], "Nikon D70 (2007 figure)");
    assert_eq!(source["difference"]["samples_of_lit"], json["samples"]["lit"]);
    let difference = &source["difference"];
    assert_eq!(difference["measure"], "Δxy");
    let of = |name: &str| difference[name].as_f64().unwrap_or_else(|| panic!("{name}"));
    assert!(of("facing_light") > 0.0 && of("median_above_l20") <= of("p95_above_l20"), "{difference}");
    assert!(of("samples_above_l20") <= json["samples"]["lit"].as_f64().unwrap(), "{difference}");
    assert!(json["settings"]["returned_light"]["normal_incidence"].as_f64().is_some_and(|share| share > 0.3));
    assert_eq!(source["integrals"]["nodes"]["wavelengths"], 15, "{}", source["integrals"]);
    assert_eq!(source["integrals"]["nodes"]["samples"], json["samples"]["spectral"]);
    assert_eq!(source["plan"]["chosen"]["method"], "15 wavelengths for all channels, S to 1e-13");
    let accuracy = &json["accuracy"];
    let error = |transform: &str| accuracy[transform]["error_to_peak"]["max"].as_f64().unwrap();
    assert!(error("chosen") <= 1e-5 && error("exact") == 0.0 && error("regimes") > 1e-4, "{accuracy}");
    assert_eq!(source["error_to_peak"]["max"].as_f64().unwrap(), error("chosen"));
    for transform in ["chosen", "exact", "regimes"] {
        let time = accuracy[transform]["ns_per_sample"].as_f64().unwrap();
        assert!(time.is_finite() && time >= 0.0 && accuracy[transform].get("time_ratio").is_some(), "{accuracy}");
    }
    // Sums over few wavelengths count as those over all.
    let sums = |transform: &str| accuracy[transform]["samples_by_sums"].as_u64().unwrap();
    assert!(sums("chosen") > 0 && sums("exact") >= sums("chosen") && sums("regimes") == sums("exact"), "{accuracy}");
    assert!(accuracy["samples"].as_u64().is_some_and(|samples| samples > 0 && samples <= 2000));
}

#[test]
fn the_coherent_component_and_the_area_can_be_chosen() {
    let folder = folder("specular");
    let small = ["--mesh", "sphere", "--triangles", "800", "--size", "24x24", "--sigma", "0", "--stats", "-"];
    let of = |arguments: &[&str]| -> Value {
        serde_json::from_str(&rendered(&folder, &[&small[..], &D70, arguments].concat())).unwrap()
    };
    let share = |stats: &Value| stats["settings"]["returned_light"]["normal_incidence"].as_f64().unwrap();
    let [paper, fresnel] = ["paper", "fresnel"].map(|specular| of(&["--specular", specular]));
    assert_eq!(
        (&paper["settings"]["specular"], &fresnel["settings"]["specular"]),
        (&"paper".into(), &"fresnel".into())
    );
    assert!((share(&paper) - 1.0).abs() < 1e-9 && (share(&fresnel) - 1.0 / 36.0).abs() < 1e-9);
    let printed = of(&["--specular", "paper", "--area", "xy"]);
    assert_eq!(printed["settings"]["area_m2"], 2.5e-9);
    assert!((share(&printed) - 0.25).abs() < 1e-9);
    let help = String::from_utf8(run(&folder, &["--help"]).stdout).unwrap();
    let words = help.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(
        words.contains("0.49 and 0.03 of the light (radiometric)") && words.contains("Only the diffuse component"),
        "{words}"
    );
}

#[test]
fn qualities_agree_and_readings_do_not() {
    let folder = folder("qualities");
    // Qualities are those of integrals over wavelength: the sky's visibility has its own.
    let small = ["--mesh", "sphere", "--triangles", "800", "--size", "16x12", "--format", "exr", "--sky", "0"];
    let of = |arguments: &[&str]| {
        rendered(&folder, &[&small[..], &ALONE, &D70, arguments].concat());
        read_exr(&folder.join("sphere_nikon-d70-2007.exr")).1["G"].clone()
    };
    let exact = of(&["--quality", "reference"]);
    assert_eq!(exact, of(&["--quality", "exact"]), "its name before");
    let peak = exact.iter().copied().fold(0.0, f32::max);
    let distance = |other: &[f32]| exact.iter().zip(other).map(|(a, b)| (a - b).abs()).fold(0.0, f32::max) / peak;
    for (quality, bound) in [("preview", 1e-4), ("full", 1e-5), ("fine", 1e-6)] {
        assert!(distance(&of(&["--quality", quality])) < bound, "{quality}");
    }
    for reading in ["paper", "microfacet", "lambertian"] {
        assert!(distance(&of(&["--reading", reading])) > 0.01, "{reading}");
    }
    let coarse = of(&["--no-shadows", "--exposure", "2"]);
    assert!(distance(&coarse) < 1e-6, "a sphere shadows nothing, and numbers are before exposure");
}

#[test]
fn a_tolerance_is_kept_and_said() {
    let folder = folder("tolerance");
    let common = [&SMALL[..], &D70[..], &["--sigma", "0.3e-6", "--stats", "-"]].concat();
    for (tolerance, error) in [("1e-3", 1e-3), ("1e-7", 1.6e-7)] {
        let said = rendered(&folder, &[&common[..], &["--tolerance", tolerance]].concat());
        let json: Value = serde_json::from_str(&said).unwrap();
        assert_eq!(
            (&json["settings"]["quality"], &json["settings"]["tolerance"]),
            (&"tolerance".into(), &tolerance.parse::<f64>().unwrap().into())
        );
        for source in json["sources"].as_array().unwrap() {
            let plan = &source["plan"];
            assert!(plan["estimated_error_bound"].as_f64().unwrap() <= tolerance.parse().unwrap());
            let mirrors = json["samples"]["mirror_terms"].as_u64().unwrap() > 0;
            let lobes = mirrors.then(|| tolerance.parse::<f64>().unwrap());
            assert_eq!((plan["mirror_error"].as_f64(), plan["single_precision"].as_f64()), (lobes, Some(6e-8)));
            // Signals are kept in single precision, 6e-8 of themselves.
            assert!(source["error_to_peak"]["max"].as_f64().unwrap() <= error, "{source}");
        }
    }
    let words = rendered(&folder, &[&SMALL[..], &D70[..], &["--tolerance", "1e-6"]].concat());
    assert!(words.contains("; diffuse component: estimated error bound ") && words.contains(" of the peak"), "{words}");
    let flat = rendered(&folder, &[&SMALL[..], &D70[..], &["--tolerance", "1e-6", "--reading", "lambertian"]].concat());
    assert!(flat.contains("; no sample takes a spectral integral\n"), "{flat}");
    let smooth = [&SMALL[..], &D70[..], &["--tolerance", "1e-9", "--sigma", "0.1e-6"]].concat();
    let words = rendered(&folder, &smooth);
    let parts = ["; specular lobes within 1e-9 of the brightest sample", "; stored in single precision (6e-8)"];
    assert!(parts.iter().all(|part| words.contains(part)), "{words}");
    refused(&self::folder("tolerance refused"), &["--tolerance", "1e-15"], 2, &["1e-15", "1e-13"]);
    refused(&self::folder("tolerance and quality"), &["--tolerance", "1e-5", "--quality", "fine"], 2, &["--quality"]);
}

#[test]
fn meshes_and_materials_come_from_files() {
    let folder = folder("files");
    std::fs::write(folder.join("My Square.obj"), "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nf 1 2 3 4\n").unwrap();
    std::fs::write(folder.join("gray.csv"), "wavelength_nm,dark,light\n380,0.2,0.9\n780,0.2,0.9\n").unwrap();
    let arguments = ["--mesh", "My Square.obj", "--material", "gray.csv", "--size", "24x24"];
    let output = run(&folder, &[&arguments[..], &D70].concat());
    let message = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{message}");
    assert!(message.contains("using the first, dark") && message.contains("My Square.obj: "), "{message}");
    assert_eq!(pictures_in(&folder), ["my-square_nikon-d70-2007.png"]);
    let behind = rendered(&folder, &[&arguments[..], &ALONE, &D70, &["--light=0,0,-1", "--sky", "0"]].concat());
    assert!(behind.contains(": no light\n"), "{behind}");
}

#[test]
fn mistakes_are_named() {
    let folder = folder("mistakes");
    refused(&folder, &["--mesh", "haed"], 2, &["--mesh", "haed", "did you mean head", "OBJ"]);
    refused(&folder, &["--mesh", "missing.obj"], 1, &["missing.obj is not in", "mistakes"]);
    std::fs::write(folder.join("broken.obj"), "v 0 0 0\nv 1 0 x\n").unwrap();
    refused(&folder, &["--mesh", "broken.obj"], 1, &["broken.obj, line 2", "decimal point"]);
    refused(&folder, &["--material", "Vrhel"], 1, &["could be", "(Vrhel)"]);
    refused(&folder, &["--material", "Lead 001"], 1, &["no material is named \"Lead 001\""]);
    refused(&folder, &["--camera", "Nikn D70"], 1, &["did you mean", "Nikon D70 (A.M.P.A.S.)"]);
    refused(&folder, &["--sigma", "5"], 2, &["--sigma", "meters", "5e-6"]);
    refused(&folder, &["--tau", "0"], 2, &["--tau", "10e-6"]);
    refused(&folder, &["--patch", "1e-6"], 2, &["--half-widths", "expected 2 numbers", "50e-6,50e-6"]);
    refused(&folder, &["--patch", "2,2"], 2, &["--half-widths", "meters"]);
    refused(&folder, &["--ior", "-1"], 2, &["--ior", "1.4"]);
    refused(&folder, &["--light", "0,0,0"], 2, &["--light", "-0.4,0.5,1"]);
    refused(&folder, &["--light", "1,nan,0"], 2, &["--light", "nan"]);
    refused(&folder, &["--orbit", "0,0,0.01"], 2, &["--orbit", "0.05", "20,5,3.6"]);
    refused(&folder, &["--orbit", "0,91,3"], 2, &["--orbit", "-90 to 90"]);
    refused(&folder, &["--fov", "170"], 2, &["--fov", "150°"]);
    refused(&folder, &["--size", "512"], 2, &["--size", "512x512"]);
    refused(&folder, &["--size", "9000x9000"], 2, &["--size", "81 million", "40 million"]);
    refused(&folder, &["--exposure", "100"], 2, &["--exposure", "-64 to 64"]);
    refused(&folder, &["--reading", "papre"], 2, &["'paper'"]);
    refused(&folder, &["--quality", "best"], 2, &["--quality", "reference"]);
    refused(&folder, &["--white", "daylight:warm"], 2, &["--white", "daylight:5500"]);
    refused(&folder, &["--fit-to", "CIE 1964 10°", "--transform", "paper"], 2, &["--transform fitted"]);
    let cones = ["--transform", "paper", "--observer", "CIE 2006 2° cone fundamentals"];
    refused(&folder, &cones, 1, &["Eq 13", "--transform fitted"]);
    refused(&folder, &["--out", "broken.obj"], 2, &["--out", "broken.obj", "folder"]);
}

#[test]
fn the_meshs_own_roughness_is_a_narrow_gloss_and_has_no_one_error() {
    let folder = folder("from_mesh");
    let by = |more: &[&str]| {
        let name = if more.is_empty() { "given.json" } else { "mesh.json" };
        let head = ["--mesh", "head", "--triangles", "3000", "--size", "32x32", "--stats", name, "--garment", "none"];
        let said = rendered(&folder, &[&head[..], &ALONE, &D70, more].concat());
        (said, serde_json::from_slice::<Value>(&std::fs::read(folder.join(name)).unwrap()).unwrap())
    };
    let ((said, given), (unsaid, mesh)) = (by(&[]), by(&["--sigma-from-mesh"]));
    let bright = |stats: &Value| stats["sources"][0]["difference"]["samples_above_l20"].as_u64().unwrap();
    assert!(3 * bright(&mesh) < 2 * bright(&given), "{} and {}", bright(&mesh), bright(&given));
    assert!(given["accuracy"].is_object() && mesh["accuracy"].is_null());
    assert_eq!(mesh["settings"]["tau_from_mesh"], true);
    assert!(said.contains("surface: Returns 0.49") && !unsaid.contains("surface: "), "no one surface: {unsaid}");
}

/// Small pictures kept beside the tests: what head and fern look like through the reference and a camera, in all readings that
/// differ to the eye. `UPDATE_SCREENSHOTS=1 cargo test` writes them.
#[test]
fn head_and_fern_look_as_they_did() {
    let folder = folder("looks");
    for mesh in ["head", "fern"] {
        for reading in ["radiometric", "paper"] {
            let what =
                ["--preset", "paper", "--mesh", mesh, "--reading", reading, "--triangles", "20000", "--size", "96x96"];
            let orbit = if mesh == "fern" { "20,15,3.6" } else { "20,5,3.6" };
            let sun = ["--sky", "0", "--leaf", "false", "--orbit", orbit];
            let camera = ["--samples", "2", "--camera", "Nikon D70 (2007 figure)"];
            rendered(&folder, &[&what[..], &sun, &camera].concat());
            let picture = pictures_in(&folder).into_iter().find(|name| name.starts_with(mesh)).unwrap();
            let now = image::open(folder.join(&picture)).unwrap().to_rgba8();
            let kept = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/app/pictures");
            let kept = kept.join(format!("{mesh}_{reading}.png"));
            crate::cpu_renderer::compare(&now, &kept).unwrap_or_else(|difference| panic!("{difference}"));
        }
    }
}

#[test]
fn differences_are_by_the_metric_asked_for() {
    let folder = folder("metric");
    let fitted = [&SMALL[..], &D70, &["--transform", "fitted", "--stats", "-"]].concat();
    for metric in chromascope_core::colorimetry::Metric::ALL {
        let output = run(&folder, &[&fitted[..], &["--difference", metric.id, "--force"]].concat());
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        let message = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(message.contains(&format!("sphere_nikon-d70-2007.png: {} ", metric.symbol)), "{message}");
        let json: Value = serde_json::from_slice(&output.stdout).unwrap();
        let camera = json["sources"].as_array().unwrap().iter().find(|s| s["is_reference"] == false).unwrap();
        assert_eq!(camera["difference"]["measure"], metric.symbol);
        let largest = camera["difference"]["max_of_lit"].as_f64().unwrap();
        assert!(largest > 0.01 * metric.full_scale && largest < 10.0 * metric.full_scale, "{}: {largest}", metric.id);
    }
    let output = run(&folder, &[&SMALL[..], &D70, &["--difference", "delta-e1976"]].concat());
    assert!(!output.status.success() && String::from_utf8_lossy(&output.stderr).contains("--transform fitted"));
}

#[test]
fn the_papers_start_has_no_sky() {
    let folder = folder("paper_sky");
    let digest = |more: &[&str]| {
        rendered(&folder, &[&SMALL[..], &D70, more].concat());
        std::fs::read(folder.join("sphere_nikon-d70-2007.png")).unwrap()
    };
    let paper = digest(&[]);
    assert_eq!(paper, digest(&["--sky", "0"]));
    assert_ne!(paper, digest(&["--sky", "0.15"]));
}

#[test]
fn a_steep_leaf_is_not_white_and_says_how_it_is_exposed() {
    let folder = folder("steep");
    let leaf = ["--mesh", "sphere", "--triangles", "800", "--size", "40x40", "--material", "leaf", "--ior", "1.45"];
    let clipped = |sigma: &str| {
        let more = ["--camera", "Nikon D70 (2007 figure)", "--sigma", sigma, "--stats", "-"];
        let output = run(&folder, &[&leaf[..], &more, &["--force"]].concat());
        let stats: Value = serde_json::from_slice(&output.stdout).unwrap();
        let clipped =
            stats["sources"].as_array().unwrap().iter().map(|source| source["clipped_samples"].as_u64().unwrap());
        (clipped.max().unwrap(), String::from_utf8(output.stderr).unwrap())
    };
    let (steep, said) = clipped("20e-6");
    let (usual, nothing) = clipped("5e-6");
    assert!(steep <= usual, "{steep} samples clip, {usual} at 5 µm");
    assert!(
        said.contains("seen from the light 0.01 of a diffuse white, brighter at grazing views: exposed for 0.2"),
        "{said}"
    );
    assert!(!nothing.contains("seen from the light"), "{nothing}");
}
