//! `identify`: synthetic recordings with known answers, from tables and from a picture.

use std::fmt::Write as _;

use chromascope_core::spectral::{Dataset, GridSpectrum, Quantity, Sensor};
use serde_json::Value;

use super::{column, file, number, refused, run, table};

const CHART: [&str; 4] = ["--chart", "ColorChecker 24 (Ohta 1997)", "--illuminant", "D55"];

/// Patch names with raw RGB of the chart under D55 through the measured D70, gains 2, 1, 1.5, brightest green at 40000.
fn recording() -> Vec<(String, [f64; 3])> {
    let asset = |path| Dataset::read(chromascope_data::text(path).unwrap()).unwrap();
    let camera = Sensor::from_dataset(&asset("cameras/nikon_d70_a_m_p_a_s.csv")).unwrap();
    let chart = chromascope_core::patch_set::PatchSet::from_dataset(&asset("charts/colorchecker_24_ohta_1997.csv"));
    let d55 = GridSpectrum::resample(&asset("illuminants/d55.csv").curves[0], Quantity::Light);
    let raw = |patch: &chromascope_core::patch_set::Patch| {
        let radiance = GridSpectrum::from_fn(|nm| {
            let index = (nm - 380.0).round() as usize;
            patch.grid.values()[index] * d55.values()[index]
        });
        camera.integrate(radiance.values())
    };
    let all: Vec<(String, [f64; 3])> = chart.patches().iter().map(|patch| (patch.name.clone(), raw(patch))).collect();
    let scale = 40_000.0 / all.iter().map(|(_, rgb)| rgb[1]).fold(0.0, f64::max);
    all.into_iter().map(|(name, [r, g, b])| (name, [0.8 * r * scale, g * scale, 0.7 * b * scale])).collect()
}

fn csv(rows: &[(String, [f64; 3])]) -> String {
    let rows = rows.iter().map(|(name, [r, g, b])| format!("{name},{r},{g},{b}\n"));
    "patch,R,G,B\n".to_owned() + &rows.collect::<String>()
}

#[test]
fn the_camera_is_found_from_a_table_in_any_order() {
    let mut rows = recording();
    rows.reverse();
    rows[3].1[1] = 65_535.0;
    rows[5].1[0] = 0.0;
    let path = file("identify_raw.csv", &csv(&rows));
    let residuals = path.with_file_name("identify_residuals.csv");
    let written = residuals.to_str().unwrap();
    let options = ["--clip", "65535", "--format", "csv", "--residuals", written, "--force"];
    let found = table(&[&["identify", path.to_str().unwrap()], &CHART[..], &options].concat());
    assert_eq!(found.len(), 1 + chromascope_data::files("cameras").count());
    assert_eq!(column(&found, "camera")[0], "Nikon D70 (A.M.P.A.S.)");
    assert!(number(column(&found, "rms_percent")[0]) < 1e-9);
    assert!(number(column(&found, "rms_percent")[1]) > 0.5);
    let [r, g] = ["gain_r", "gain_g"].map(|head| number(column(&found, head)[0]));
    assert!((r / g - 0.8).abs() < 1e-9);
    assert_eq!((column(&found, "values")[0], column(&found, "parameters")[0]), ("70", "26"));
    let heads = ["rank", "rank_first", "rank_last", "first_share"];
    assert_eq!(heads.map(|head| number(column(&found, head)[0])), [1.0; 4]);
    let text = std::fs::read_to_string(residuals).unwrap();
    let excluded: Vec<&str> =
        text.lines().filter(|line| line.starts_with("Nikon D70 (A.M") && !line.ends_with(',')).collect();
    let name = |index: usize| &rows[index].0;
    assert_eq!(
        excluded,
        [
            format!("Nikon D70 (A.M.P.A.S.),{},green,,clipped", name(3)),
            format!("Nikon D70 (A.M.P.A.S.),{},red,,zero or negative", name(5)),
        ]
    );
}

#[test]
fn ranks_are_ranges_that_say_how_sure_they_are() {
    // Noise of 3 %, more than tables of like cameras differ by.
    let noise = |p: usize, c: usize| 1.0 + 0.03 * (((p * 31 + c * 17) % 23) as f64 / 11.0 - 1.0);
    let rows = recording().into_iter().enumerate();
    let rows: Vec<_> = rows.map(|(p, (name, rgb))| (name, [0, 1, 2].map(|c| rgb[c] * noise(p, c)))).collect();
    let path = file("identify_noise.csv", &csv(&rows));
    let named = [&["identify", path.to_str().unwrap()], &CHART[..]].concat();
    let text = |arguments: &[&str]| String::from_utf8(run(arguments).stdout).unwrap();
    let found = table(&[&named[..], &["--format", "csv"]].concat());
    let [first, last, share] = ["rank_first", "rank_last", "first_share"].map(|head| number(column(&found, head)[0]));
    assert!(first == 1.0 && last > 1.0 && (0.0..1.0).contains(&share), "{first} {last} {share}");
    let shares: f64 = column(&found, "first_share").into_iter().map(number).sum();
    assert!((shares - 1.0).abs() < 1e-9, "{shares}");
    let best = column(&found, "camera")[0];
    let said = format!("{best}: rank 1–{last} in 95 % of 1000 resamples of the patches, smallest RMS in ");
    let aligned = text(&named);
    assert!(aligned.contains(&said) && aligned.contains("does not prove a model"), "{said} is not in {aligned}");
    assert_eq!(aligned, text(&named), "the same digits every time");
    let object: Value = serde_json::from_str(&text(&[&named[..], &["--format", "json"]].concat())).unwrap();
    assert_eq!(object["cameras"][0]["rank_range"], serde_json::json!([1, last as u64]));
    assert_eq!((object["cameras"][0]["first_share"].as_f64(), object["resamples"].as_u64()), (Some(share), Some(1000)));
}

#[test]
fn a_unit_of_sensitivities_needs_a_file_of_them() {
    let path = file("identify_per.csv", &csv(&recording()));
    let options = ["--camera", "Nikon D70 (A.M.P.A.S.)", "--per", "photon"];
    refused(
        &[&["identify", path.to_str().unwrap()], &CHART[..], &options].concat(),
        &["--per", "give --camera a file"],
    );
}

#[test]
fn spectra_beside_the_raw_values_and_radiances_give_the_same() {
    let asset = Dataset::read(chromascope_data::text("charts/colorchecker_24_ohta_1997.csv").unwrap()).unwrap();
    let nm = asset.curves[0].wavelengths_nm();
    let mut text = format!("patch,R,G,B,{}\n", nm.iter().map(f64::to_string).collect::<Vec<_>>().join(","));
    for ((name, [r, g, b]), curve) in recording().iter().zip(&asset.curves) {
        let values = curve.values().iter().map(f64::to_string).collect::<Vec<_>>().join(",");
        writeln!(text, "{name},{r},{g},{b},{values}").unwrap();
    }
    let path = file("identify_both.csv", &text);
    let arguments =
        ["identify", path.to_str().unwrap(), "--illuminant", "D55", "--values", "plain", "--format", "json"];
    let output = run(&[&arguments[..], &["--camera", "Nikon D70 (A.M.P.A.S.)", "--camera", "Canon EOS 5D"]].concat());
    let json: Value = serde_json::from_slice(&output.stdout).unwrap_or_else(|_| panic!("{output:?}"));
    assert_eq!(json["cameras"].as_array().unwrap().len(), 2);
    assert_eq!(json["cameras"][0]["camera"], "Nikon D70 (A.M.P.A.S.)");
    assert!(json["cameras"][0]["rms_percent"].as_f64().unwrap() < 1e-9);
    assert_eq!(json["patches"][0]["name"], "dark skin");
    // The same spectra as radiances are another light: the same camera no longer fits.
    let radiance = [&arguments[..2], &["--radiance", "--format", "csv", "--camera", "Nikon D70 (A.M.P.A.S.)"]].concat();
    let found = table(&radiance);
    assert!(number(column(&found, "rms_percent")[0]) > 0.5, "{found:?}");
}

#[test]
fn a_picture_gives_the_same_as_its_table() {
    let rows = recording();
    let path = std::path::Path::new(env!("CARGO_TARGET_TMPDIR")).join("identify_chart.tif");
    // Patches of 20 × 20 pixels from (30, 10) on, with a border of 4 pixels.
    let pixel = |x: u32, y: u32| {
        let (Some(x), Some(y)) = (x.checked_sub(30), y.checked_sub(10)) else { return image::Rgb([1000; 3]) };
        let (column, row) = (x / 20, y / 20);
        let border = [x % 20, y % 20].iter().any(|at| !(4..16).contains(at));
        if column >= 6 || row >= 4 || border {
            return image::Rgb([300; 3]);
        }
        image::Rgb(rows[(row * 6 + column) as usize].1.map(|value| value.round() as u16))
    };
    image::ImageBuffer::<image::Rgb<u16>, Vec<u16>>::from_fn(160, 100, pixel).save(&path).unwrap();
    let image = path.to_str().unwrap();
    let corners = ["--corners", "30,10", "150,10", "150,90", "30,90"];
    let found = table(&[&["identify", "--image", image, "--format", "csv"], &corners[..], &CHART].concat());
    assert_eq!(column(&found, "camera")[0], "Nikon D70 (A.M.P.A.S.)");
    // Rounded to 16 bits.
    assert!(number(column(&found, "rms_percent")[0]) < 0.05, "{found:?}");

    let crossed = ["--corners", "30,10", "150,90", "150,10", "30,90"];
    refused(&[&["identify", "--image", image], &crossed[..], &CHART].concat(), &["identify_chart.tif", "convex"]);
    let beside = ["--corners", "30,10", "190,10", "150,90", "30,90"];
    refused(&[&["identify", "--image", image], &beside[..], &CHART].concat(), &["corner 2", "160 x 100"]);
    let eight = path.with_file_name("identify_8bit.png");
    image::RgbImage::new(8, 8).save(&eight).unwrap();
    let eight = eight.to_str().unwrap();
    refused(&[&["identify", "--image", eight], &corners[..], &CHART].concat(), &["8-bit", "16-bit RGB"]);
}

#[test]
fn what_is_missing_is_named_with_its_remedy() {
    let good = file("identify_good.csv", &csv(&recording()));
    let good = good.to_str().unwrap();
    refused(&["identify", good, "--chart", "ColorChecker 24 (Ohta 1997)"], &["--illuminant"]);
    refused(&["identify", good, "--illuminant", "D55"], &["identify_good.csv", "without spectra", "--chart"]);
    let bad = file("identify_bad.csv", "patch,R,G,B\ndark skin,1,x,3\n");
    refused(&[&["identify", bad.to_str().unwrap()], &CHART[..]].concat(), &["identify_bad.csv", "line 2, column 3"]);
    let unknown = file("identify_unknown.csv", "patch,R,G,B\nno such,1,2,3\n");
    refused(&[&["identify", unknown.to_str().unwrap()], &CHART[..]].concat(), &["line 2", "\"no such\"", "dark skin"]);
    let few = file("identify_few.csv", "patch,R,G,B\nwhite,1,2,3\n");
    refused(&[&["identify", few.to_str().unwrap()], &CHART[..]].concat(), &["3 usable values for 3 fitted"]);
    refused(&[&["identify", good, "--clip", "0"], &CHART[..]].concat(), &["--clip"]);
    refused(&[&["identify", good, "--raw", good], &CHART[..]].concat(), &["leave out"]);
}

const CORNERS: [&str; 5] = ["--corners", "0,0", "9,0", "9,9", "0,9"];

#[test]
fn a_tiff_with_text_for_a_number_is_refused_in_our_words() {
    // Its width is text of 4 GB.
    let entry = |tag: u16, kind: u16, count: u32, value: u32| {
        [&tag.to_le_bytes()[..], &kind.to_le_bytes(), &count.to_le_bytes(), &value.to_le_bytes()].concat()
    };
    let entries = [entry(256, 2, u32::MAX, 8), entry(257, 4, 1, 10), entry(258, 3, 1, 16)].concat();
    let bytes = [&b"II*\0\x08\0\0\0\x03\0"[..], &entries, &[0; 64]].concat();
    let path = std::path::Path::new(env!("CARGO_TARGET_TMPDIR")).join("identify_text_width.tif");
    std::fs::write(&path, bytes).unwrap();
    let arguments = [&["identify", "--image", path.to_str().unwrap()], &CORNERS[..], &CHART].concat();
    refused(&arguments, &["TIFF tag 256", "save the picture again"]);
    let message = String::from_utf8_lossy(&run(&arguments).stderr).into_owned();
    assert!(!message.contains(".rs:"), "no line of a dependency: {message}");
}

/// Zeros, `1 + 258 matches` of them, as zlib packs them with fixed codes.
fn packed_zeros(matches: u32) -> Vec<u8> {
    let (mut bytes, mut last, mut used) = (vec![0x78, 0x01], 0_u8, 0);
    let mut push = |code: u32, length: u32| {
        for bit in (0..length).rev() {
            last |= ((code >> bit & 1) as u8) << used;
            used += 1;
            if used == 8 {
                bytes.push(last);
                (last, used) = (0, 0);
            }
        }
    };
    // The last block, of fixed codes; a zero; runs of 258; the end.
    push(0b110, 3);
    push(0x30, 8);
    (0..matches).for_each(|_| push(0b1_1000_1010_0000, 13));
    push(0, 14);
    let sum = (1 + 258 * u64::from(matches)) % 65521;
    bytes.extend(((sum as u32) << 16 | 1).to_be_bytes());
    bytes
}

#[cfg(target_os = "linux")]
#[test]
fn the_profile_of_a_picture_takes_no_memory_of_note() {
    let path = std::path::Path::new(env!("CARGO_TARGET_TMPDIR")).join("identify_profile.png");
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, 10, 10);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Sixteen);
    let mut writer = encoder.write_header().unwrap();
    // 900 MB.
    writer.write_chunk(png::chunk::iCCP, &[&b"profile\0\0"[..], &packed_zeros(3_500_000)].concat()).unwrap();
    writer.write_image_data(&[7; 600]).unwrap();
    drop(writer);
    std::fs::write(&path, bytes).unwrap();
    let mut child = std::process::Command::new(env!("CARGO_BIN_EXE_chromascope"))
        .args(["identify", "--image", path.to_str().unwrap()])
        .args(CORNERS)
        .args(CHART)
        .stderr(std::process::Stdio::piped())
        .stdout(std::process::Stdio::null())
        .spawn()
        .unwrap();
    let status = format!("/proc/{}/status", child.id());
    let mut most = 0_u64;
    while child.try_wait().unwrap().is_none() {
        let text = std::fs::read_to_string(&status).unwrap_or_default();
        let peak = text.lines().find_map(|line| line.strip_prefix("VmHWM:")?.trim().strip_suffix(" kB")?.parse().ok());
        most = most.max(peak.unwrap_or(0));
        std::thread::yield_now();
    }
    assert!(most > 0 && most < 500 << 10, "{most} kB");
}
