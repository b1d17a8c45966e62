//! Sets of files: folders of any depth, several values for an option, and what is said of many files in one line.

use std::path::Path;

use serde_json::Value;

use super::files::{asset, folder, text};
use super::{refused, run};

const CAMERA: &str = "cameras/kodak_dcs200.csv";
const LAMP: &str = "nm,Relative power\n400,0.1\n500,0.5\n700,0.9\n";

fn put(folder: &Path, name: &str, contents: &str) {
    let path = folder.join(name);
    std::fs::create_dir_all(path.parent().unwrap()).unwrap();
    std::fs::write(path, contents).unwrap();
}

/// A folder of cameras at several depths, among what lies about in such folders.
fn cameras(name: &str) -> std::path::PathBuf {
    let folder = folder(name);
    let table = std::fs::read_to_string(asset(CAMERA)).unwrap();
    let table = table.lines().filter(|line| !line.starts_with('#')).collect::<Vec<_>>().join("\n");
    for name in ["b/deep/er/two.csv", "a/one.csv", "three.csv"] {
        put(&folder, name, &table);
    }
    put(&folder, "README.md", "# Cameras\nMeasured in 2007.\n");
    put(&folder, ".git/config", "1,2\n3,4\n");
    put(&folder, "a/one.csv-metadata.json", "{}");
    put(&folder, "b/lamp.csv", LAMP);
    #[cfg(unix)]
    std::os::unix::fs::symlink("..", folder.join("b/loop")).unwrap();
    folder
}

/// Names of the ranked sensors, and what was said on standard error.
fn ranked(arguments: &[&str]) -> (Vec<String>, String) {
    let output = run(&[&["compare", "--metrics", "vora", "--format", "csv"], arguments].concat());
    let said = String::from_utf8(output.stderr).unwrap();
    assert!(output.status.success(), "{arguments:?}: {said}");
    let rows = String::from_utf8(output.stdout).unwrap();
    (rows.lines().skip(1).map(|row| row.split(',').next().unwrap().to_owned()).collect(), said)
}

#[test]
fn a_folder_of_any_depth_stands_for_its_cameras() {
    let folder = cameras("nested cameras");
    let (names, said) = ranked(&["--camera", text(&folder), "--sort", "name"]);
    assert_eq!(names, ["one", "two", "three"], "in order of path");
    let skipped = said.lines().find(|line| line.contains("3 of 5 files used; skipped: ")).expect("a line");
    let (links, not_used) = (usize::from(cfg!(unix)), "1 refused (");
    for words in ["1 hidden (.git)", "1 beside their tables", "1 without readable spectra (", "README.md)", not_used] {
        assert!(skipped.contains(words), "{words}: {skipped}");
    }
    assert_eq!(skipped.matches("reached again by a link (b/loop)").count(), links, "{skipped}");
    assert_eq!(said.matches("assumed to be responses per energy").count(), 1, "{said}");
    assert!(said.contains("; likewise 2 more: "), "{said}");
    refused(&["matrix", text(&folder), "--illuminant", "D50"], &["the folder has 3 cameras"]);
    let none = folder.join("none");
    put(&none, "notes.txt", "nothing but words\n");
    put(&none, "more.txt", "nothing but words\n");
    refused(&["compare", "--camera", text(&none)], &["0 of 2 files used", "2 without readable spectra ("]);
    refused(&["inspect", text(&none)], &["no spectra were found; skipped: 2 without readable spectra ("]);
}

#[test]
fn inspect_reads_what_holds_spectra_in_a_folder() {
    let folder = cameras("nested spectra");
    let output = run(&["inspect", text(&folder)]);
    let (report, said) = (String::from_utf8(output.stdout).unwrap(), String::from_utf8(output.stderr).unwrap());
    assert!(output.status.success(), "{said}");
    let places: Vec<usize> =
        ["one.csv", "two.csv", "lamp.csv", "three.csv"].map(|name| report.find(name).expect(name)).into();
    assert!(places.is_sorted(), "{report}");
    assert_eq!(said.lines().count(), 1, "{said}");
    assert!(said.contains("skipped: ") && said.contains("1 without readable spectra ("), "{said}");
    let output = run(&["inspect", text(&folder), "--json"]);
    let found: Value = serde_json::from_slice(&output.stdout).unwrap();
    let kinds: Vec<&str> = found.as_array().unwrap().iter().filter_map(|file| file["kind"].as_str()).collect();
    assert_eq!(kinds, ["camera", "camera", "illuminant", "camera"]);
}

#[test]
fn one_option_takes_several_cameras_where_nothing_else_can_follow() {
    let folder = cameras("several cameras");
    let files = ["a/one.csv", "b/deep/er/two.csv"].map(|name| folder.join(name));
    let [one, two] = [text(&files[0]), text(&files[1])];
    let (names, _) = ranked(&["--sort", "name", "--camera", one, two, "--camera", "Nikon D70 (2007 figure)"]);
    assert_eq!(names, ["one", "two", "Nikon D70 (2007 figure)"]);
    // After the camera of `light` comes a light, as ever.
    let light = run(&["light", "--camera", one, "FL2", "--format", "csv"]);
    assert!(light.status.success() && String::from_utf8(light.stdout).unwrap().contains("FL2"));
}

#[test]
fn a_long_name_is_cut_in_its_middle() {
    let folder = folder("long names");
    let table = std::fs::read_to_string(asset(CAMERA)).unwrap();
    for end in ["first", "second"] {
        let text = table.replace("# title: Kodak DCS200\n", "");
        put(&folder, &format!("predicted-sensitivities-of-a-camera-whose-name-is-long-{end}.csv"), &text);
    }
    let output = run(&["compare", "--metrics", "vora", "--camera", text(&folder)]);
    let rows = String::from_utf8(output.stdout).unwrap();
    let is_cut = |end: &str| rows.lines().any(|row| row.contains("predicted-sens") && row.contains(end));
    assert!(rows.contains('…') && is_cut("long-first") && is_cut("long-second"), "{rows}");
}

#[test]
fn the_library_is_a_data_package() {
    let folder = folder("data package");
    let out = folder.join("library");
    assert!(run(&["list", "--out", text(&out)]).status.success());
    refused(&["list", "--out", text(&out)], &["exists", "--force"]);
    let known: Value = serde_json::from_slice(&std::fs::read(out.join("datapackage.json")).unwrap()).unwrap();
    let resources = known["resources"].as_array().unwrap();
    let listed = String::from_utf8(run(&["list"]).stdout).unwrap();
    // Five of the patches are a choice, no set.
    for name in listed.lines().filter(|name| *name != "ColorChecker five") {
        assert!(resources.iter().any(|of| of["title"] == name), "{name}");
    }
    for of in resources {
        let [path, hash] = ["path", "hash"].map(|key| of[key].as_str().unwrap());
        let bytes = std::fs::read(out.join(path)).unwrap();
        assert_eq!(of["bytes"], bytes.len(), "{path}");
        assert!(hash.strip_prefix("sha256:").is_some_and(|digits| digits.len() == 64), "{hash}");
        assert!(of["sources"][0]["title"].as_str().is_some_and(|source| !source.is_empty()), "{path}");
        if let Some(terms) = of["licenses"][0]["path"].as_str() {
            assert!(out.join(terms).is_file(), "{terms}");
        }
    }
    let read = String::from_utf8(run(&["inspect", text(&out), "--json"]).stdout).unwrap();
    let read: Vec<Value> = serde_json::from_str(&read).unwrap();
    // Beside them lie license texts and the descriptor.
    assert_eq!(read.iter().filter(|file| file.get("error").is_none()).count(), resources.len());
    let names: std::collections::BTreeSet<&str> = resources.iter().filter_map(|of| of["name"].as_str()).collect();
    assert_eq!(names.len(), resources.len());
    // The first example of FIPS 180-4.
    let abc = "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad";
    assert_eq!(chromascope::export::package::checksum("abc"), format!("sha256:{abc}"));
}
