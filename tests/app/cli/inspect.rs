//! `inspect`: what is said, what is written, what is overruled, what fails.

use std::path::{Path, PathBuf};
use std::process::Output;

use serde_json::Value;
use spectral_file::{ReadOptions, Role, read};

use super::{refused, run};

const LEAF: &str = "nm;Reflectance (%)\n400;5,5\n410;6,0\n420;---\n430;8,25\n";

/// A folder of a test's own, empty.
pub(super) fn folder(name: &str) -> PathBuf {
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("inspect_{name}"));
    let _absent = std::fs::remove_dir_all(&path);
    std::fs::create_dir(&path).unwrap();
    path
}

pub(super) fn put(folder: &Path, name: &str, text: &str) -> String {
    let path = folder.join(name);
    std::fs::write(&path, text).unwrap();
    path.to_str().unwrap().to_owned()
}

pub(super) fn inspect(arguments: &[&str]) -> Output {
    run(&[&["inspect"], arguments].concat())
}

pub(super) fn said(output: &Output) -> (String, String) {
    (String::from_utf8(output.stdout.clone()).unwrap(), String::from_utf8(output.stderr.clone()).unwrap())
}

pub(super) fn done(arguments: &[&str]) -> String {
    let output = inspect(arguments);
    let (out, err) = said(&output);
    // What a file leaves open is named beside what was read.
    let asked = err.lines().all(|line| line.contains("nothing says") && line.contains("; add --"));
    assert_eq!((output.status.code(), asked), (Some(0), true), "{arguments:?}: {err}");
    out
}

pub(super) fn json(arguments: &[&str]) -> Value {
    serde_json::from_str(&done(&[arguments, &["--json"]].concat())).unwrap()
}

#[test]
fn merged_rows_are_not_called_left_out() {
    let twice = put(&folder("merged"), "twice.csv", "nm,a\n400,1\n410,2\n410,4\n420,5\n420,5\n430,6\n440,7\n");
    let text = done(&[&twice]);
    let rows = text.lines().find(|line| line.starts_with("  Rows: ")).unwrap();
    assert!(rows.contains("2 rows merged with others of the same wavelength (mean): lines 3, 4;"), "{rows}");
    assert!(rows.contains("; 1 row skipped: line 6 (the same as an earlier row)"), "{rows}");
}

#[test]
fn every_decision_has_a_line() {
    let leaf = put(&folder("lines"), "leaf.txt", LEAF);
    let text = done(&[&leaf]);
    assert!(text.starts_with(&format!("{leaf}\n  Role: reflectances (certain): ")), "{text}");
    let table = read(LEAF.as_bytes(), &ReadOptions::default()).unwrap();
    for decision in table.decisions() {
        let line = format!("  {}: {} ({}): {}\n", decision.what, decision.value, decision.certainty, decision.why);
        assert!(text.contains(&line), "{line}{text}");
    }
    for line in ["  Range: 400 to 430 nm\n", "  Step: 10 nm\n", "  Curves: 1: ", "  Warning: 1 missing value, line 4"] {
        assert!(text.contains(line), "{line}: {text}");
    }
}

#[test]
fn the_table_is_fractions_and_reads_back() {
    let folder = folder("table");
    let leaf = put(&folder, "leaf.txt", LEAF);
    let out = folder.join("out.csv");
    assert!(done(&[&leaf, "--csv", out.to_str().unwrap()]).contains("Role"), "the report stays");
    let text = std::fs::read_to_string(&out).unwrap();
    assert!(
        text.starts_with("wavelength_nm,leaf [reflectance factor in 1]\n")
            && text.ends_with("\n400,0.055\n410,0.06\n430,0.0825\n"),
        "{text}"
    );
    let (first, again) =
        (read(LEAF.as_bytes(), &ReadOptions::default()), read(text.as_bytes(), &ReadOptions::default()));
    let (first, again) = (first.unwrap(), again.unwrap());
    assert_eq!(first.curves[0].wavelengths_nm, again.curves[0].wavelengths_nm);
    assert_eq!(first.curves[0].values, again.curves[0].values);
    // To standard output, the report beside it.
    let output = inspect(&[&leaf, "--csv", "-"]);
    let (table, report) = said(&output);
    assert!(output.status.success() && table == text && report.contains("Role: reflectances"), "{report}");
    // At the multiples of a step, and nothing beyond the curve.
    let output = inspect(&[&leaf, "--csv", "-", "--step", "5"]);
    let (table, report) = said(&output);
    assert!(table.contains("\n405,0.0574") && table.ends_with("\n430,0.0825\n"), "{table}");
    assert!(report.contains("  Written: resampled to 5 nm"), "{report}");
}

/// Every format that the window has, and what is known about the curves in each: here a camera of 611 bands.
#[test]
fn every_format_is_written_and_read_back() {
    let folder = folder("formats");
    let rows =
        (300..=910).map(|nm| format!("{nm},{0},0.5,0.25\n", f64::from(nm) / 1000.0)).collect::<Vec<_>>().concat();
    let head = "# title: Nikon D1\n# license: CC0-1.0\n# response: per energy\nwavelength_nm,R,G,B\n";
    let camera = put(&folder, "camera.csv", &format!("{head}{rows}"));
    for (format, out) in [
        ("csv", "a.csv"),
        ("rawtoaces", "a.json"),
        ("dcamprof", "b.json"),
        ("sp", "a.sp"),
        ("cmf", "a.cmf"),
        ("cgats", "a.txt"),
    ] {
        let out = folder.join(out).to_str().unwrap().to_owned();
        let output = inspect(&[&camera, "--role", "camera", "--format", format, "--out", &out]);
        let (_, told) = said(&output);
        assert!(output.status.success(), "{format}: {told}");
        assert_eq!(told.contains("only 310 to 910 nm is written"), ["sp", "cmf"].contains(&format), "{format}: {told}");
        let again = json(&[&out]);
        assert_eq!(again["kind"], "camera", "{format}");
        let of = |what: &str| again["curves"][0][what].as_array().unwrap().clone();
        for (nm, value) in of("wavelengths_nm").iter().zip(of("values")) {
            assert_eq!(value.as_f64().unwrap(), nm.as_f64().unwrap() / 1000.0, "{format} {nm}");
        }
        assert!(of("values").len() >= 601, "{format}");
    }
    let rawtoaces = std::fs::read_to_string(folder.join("a.json")).unwrap();
    assert!(rawtoaces.contains("\"manufacturer\": \"Nikon\"") && rawtoaces.contains("\"license\": \"CC0-1.0\""));
    let csv = folder.join("a.csv").to_str().unwrap().to_owned();
    assert!(std::fs::read_to_string(&csv).unwrap().starts_with("wavelength_nm,R ["));
    let comments = json(&[&csv])["reading"]["comments"].to_string();
    assert!(["Nikon D1", "CC0-1.0", "per energy"].iter().all(|known| comments.contains(known)), "{comments}");
    // Metadata of another table are not replaced, nor left beside one that they do not describe.
    std::fs::remove_file(&csv).unwrap();
    let taken = ["inspect", &camera, "--role", "camera", "--csv", &csv];
    refused(&taken, &["a.csv-metadata.json", "exists", "--force"]);
    assert!(run(&[&taken[..], &["--force", "--notes"]].concat()).status.success());
    assert!(!folder.join("a.csv-metadata.json").exists());
    assert!(std::fs::read_to_string(&csv).unwrap().starts_with("# title: Nikon D1\n"));
    refused(&["inspect", &camera, "--notes", "--format", "sp", "--out", "x.sp"], &["--notes is for CSV"]);
}

#[test]
fn averages_stand_beside_points() {
    let rows: Vec<String> = (400..=430).map(|nm| format!("{nm},{}\n", if nm == 407 { 11 } else { 1 })).collect();
    let lamp = put(&folder("averages"), "lamp.csv", &format!("nm,Lamp (W/m2/nm)\n{}", rows.concat()));
    let output = inspect(&[&lamp, "--csv", "-", "--step", "10"]);
    let (table, report) = said(&output);
    assert!(table.ends_with("\n400,1\n410,1\n420,1\n430,1\n"), "{table}");
    assert!(report.contains("without averaging"), "{report}");
    let output = inspect(&[&lamp, "--csv", "-", "--step", "10", "--average"]);
    let (table, report) = said(&output);
    // The triangle over 406 to 408 nm has the area 10; whole bands alone are written.
    assert!(table.ends_with("\n410,2\n420,1\n"), "{table}");
    assert!(report.contains("  Written: averaged over bands of 10 nm (means of the linear interpolant)"), "{report}");
    let curve = &json(&[&lamp, "--step", "10", "--average"])["curves"][0];
    assert_eq!(curve["values"], serde_json::json!([2.0, 1.0]));
}

#[test]
fn json_holds_what_was_read() {
    let leaf = put(&folder("json"), "leaf.txt", LEAF);
    let found = json(&[&leaf]);
    let table = read(LEAF.as_bytes(), &ReadOptions::default()).unwrap();
    assert_eq!(found["file"], leaf.as_str());
    assert_eq!(found["kind"], "reflectance");
    let curve = &found["curves"][0];
    assert_eq!(curve["wavelengths_nm"], serde_json::json!(table.curves[0].wavelengths_nm));
    assert_eq!(curve["values"], serde_json::json!(table.curves[0].values));
    assert_eq!(
        (&curve["unit"], &curve["quantity"], &curve["missing"]),
        (&"1".into(), &"reflectance".into(), &1.into())
    );
    let decisions = table.decisions();
    assert_eq!(found["decisions"].as_array().unwrap().len(), decisions.len());
    for (found, decision) in found["decisions"].as_array().unwrap().iter().zip(decisions) {
        assert_eq!((&found["what"], &found["value"]), (&decision.what.into(), &decision.value.into()));
        assert_eq!(found["why"], decision.why);
        assert!(["certain", "guess", "chosen"].contains(&found["certainty"].as_str().unwrap()));
    }
    assert_eq!(found["warnings"][0]["line"], 4);
    let reading = &found["reading"];
    assert_eq!((&reading["delimiter"], &reading["decimal_mark"]), (&"semicolon".into(), &"comma".into()));
    assert_eq!(reading["step_nm"]["max"], 10.0);
    let resampled = json(&[&leaf, "--step", "5"]);
    assert_eq!(
        resampled["curves"][0]["wavelengths_nm"],
        serde_json::json!([400.0, 405.0, 410.0, 415.0, 420.0, 425.0, 430.0])
    );
    assert!(resampled["notes"][0].as_str().unwrap().starts_with("resampled to 5 nm"));
}

#[test]
fn whatever_is_guessed_can_be_overruled() {
    let folder = folder("switches");
    let plain = put(&folder, "plain.txt", "400 5 1\n500 50 2\n600 90 3\n");
    let of = |file: &str, switches: &[&str]| json(&[&[file], switches].concat());
    let chosen = |found: &Value, what: &str| {
        let decisions = found["decisions"].as_array().unwrap();
        decisions.iter().any(|decision| decision["what"] == what && decision["certainty"] == "chosen")
    };
    for role in ["camera", "reflectance", "transmittance", "illuminant", "unknown"] {
        let found = of(&plain, &["--role", role]);
        assert!(found["kind"] == role && chosen(&found, "Role"), "{found}");
    }
    for (values, second) in [("plain", 50.0), ("percent", 0.5), ("decibels", 1e5), ("absorbance", 10_f64.powf(-50.0))] {
        let found = of(&plain, &["--role", "reflectance", "--values", values]);
        let value = found["curves"][0]["values"][1].as_f64().unwrap();
        assert!((value - second).abs() <= 1e-12 * second && chosen(&found, "Values"), "{found}");
    }
    for (written, units, nm) in [
        ("500", &["nanometer", "nm"][..], 500.0),
        ("0.5", &["micrometer", "um", "µm"], 500.0),
        ("5000", &["angstrom"], 500.0),
        ("20000", &["wavenumber"], 500.0),
        ("599.584916", &["terahertz", "thz"], 500.0),
        ("599584916000000", &["hertz", "hz"], 500.0),
        ("5000", &["nm"], 5000.0),
    ] {
        let further = written.parse::<f64>().unwrap() * 1.2;
        let file = put(&folder, "unit.txt", &format!("{written} 5\n{further} 6\n"));
        for unit in units {
            let found = of(&file, &["--unit", unit]);
            let wavelengths = found["curves"][0]["wavelengths_nm"].as_array().unwrap();
            assert!(wavelengths.contains(&nm.into()) && chosen(&found, "Wavelengths"), "{unit}: {found}");
        }
    }

    let semicolons = put(&folder, "semicolons.txt", "400;1,5\n500;2,5\n600;3,5\n");
    assert!(chosen(&of(&semicolons, &["--delimiter", "semicolon"]), "Separator"));
    assert!(chosen(&of(&semicolons, &["--decimal-mark", "comma"]), "Decimal mark"));
    let found = of(&plain, &["--orientation", "down", "--wavelength-column", "1"]);
    assert!(chosen(&found, "Orientation") && found["reading"]["wavelength_column"] == 1, "{found}");
    assert!(chosen(&of(&plain, &["--reader", "table"]), "Layout"));
    let counts = put(&folder, "counts.txt", "nm,Raw counts,Reflectance\n400,100,0.5\n500,200,0.6\n600,300,0.7\n");
    assert_eq!(of(&counts, &["--raw"])["curves"].as_array().unwrap().len(), 2);
    assert_eq!(of(&counts, &["--raw=false"])["curves"].as_array().unwrap().len(), 1);
    let argyll = "SPECT\n\nNUMBER_OF_FIELDS 3\nBEGIN_DATA_FORMAT\nSPEC_400 SPEC_500 SPEC_600\nEND_DATA_FORMAT\n\
                  NUMBER_OF_SETS 1\nBEGIN_DATA\n1 2 3\nEND_DATA\n";
    let two = put(&folder, "two.sp", &format!("{argyll}{}", argyll.replace("1 2 3", "4 5 6")));
    assert_eq!(
        of(&two, &["--part", "2", "--values", "plain"])["curves"][0]["values"],
        serde_json::json!([4.0, 5.0, 6.0])
    );
}

#[test]
fn several_files_go_into_a_folder_and_one_that_fails_keeps_none_back() {
    let folder = folder("several");
    let (a, b) =
        (put(&folder, "a.txt", "400 0.5\n500 0.6\n"), put(&folder, "b.txt", "400 0.7\n410 x\n420 0.8\n430 0.9\n"));
    let c = put(&folder, "c.tsv", "400\t0.1\n500\t0.2\n");
    let within = folder.join("within");
    std::fs::create_dir(&within).unwrap();
    let other = put(&within, "a.dat", "400 0.3\n500 0.4\n");
    let out = folder.join("out");
    let output =
        inspect(&[&a, &b, &c, within.to_str().unwrap(), "--role", "reflectance", "--csv", out.to_str().unwrap()]);
    let (report, errors) = said(&output);
    assert_eq!(output.status.code(), Some(1));
    assert!(errors.starts_with(&format!("chromascope: {b}, line 2: no number in column 2")), "{errors}");
    assert!(errors.ends_with("chromascope: 1 of 4 files failed\n"), "{errors}");
    assert!([&a, &c, &other].iter().all(|name| report.contains(&format!("{name}\n  Role"))), "{report}");
    let mut names: Vec<_> = std::fs::read_dir(&out).unwrap().map(|entry| entry.unwrap().file_name()).collect();
    names.sort();
    assert_eq!(names, ["a-2.csv", "a.csv", "c.csv"]);
    let table = std::fs::read(out.join("a-2.csv")).unwrap();
    assert_eq!(read(&table, &ReadOptions::default()).unwrap().curves[0].values, [0.3, 0.4]);

    let output = inspect(&[&a, &b, "--json"]);
    let (out, errors) = said(&output);
    let found: Value = serde_json::from_str(&out).unwrap();
    assert_eq!((output.status.code(), errors.is_empty()), (Some(1), false));
    assert_eq!(found[0]["curves"][0]["values"], serde_json::json!([0.5, 0.6]));
    assert_eq!((&found[1]["error"]["line"], &found[1]["error"]["column"]), (&2.into(), &2.into()));
    assert!(found[1]["error"]["text"].as_str().unwrap().contains("no number"));
}

#[test]
fn what_is_read_is_not_written_over() {
    let folder = folder("same");
    let text = "nm,Reflectance\n400,5\n500,60\n";
    let leaf = put(&folder, "leaf.csv", text);
    refused(
        &["inspect", folder.to_str().unwrap(), "--csv", folder.to_str().unwrap(), "--json", "--part", "x"],
        &["part"],
    );
    for out in [leaf.as_str(), folder.to_str().unwrap()] {
        let output = inspect(&[&leaf, "--csv", out]);
        assert_eq!(output.status.code(), Some(1));
        assert!(said(&output).1.contains("this command reads it"));
        assert_eq!(std::fs::read_to_string(&leaf).unwrap(), text);
    }
}

#[test]
fn infinite_values_are_no_answer_in_any_form() {
    let folder = folder("infinite");
    let head =
        "##TITLE=moss\n##JCAMP-DX=4.24\n##DATA TYPE=UV/VIS SPECTRUM\n##XUNITS=NANOMETERS\n##YUNITS=REFLECTANCE\n";
    let rows = "##XFACTOR=1\n##YFACTOR=1e307\n##FIRSTX=410\n##LASTX=440\n##NPOINTS=4\n##XYDATA=(X++(Y..Y))\n410 12 34 56 78\n##END=\n";
    let file = put(&folder, "moss.jdx", &format!("{head}{rows}"));
    for arguments in [&[file.as_str()][..], &["--json", &file], &["--csv", "-", &file]] {
        let output = inspect(arguments);
        let (out, err) = said(&output);
        assert!(!output.status.success() && !out.contains("null,null"), "{arguments:?}: {out}");
        assert!(err.contains("line 12") && err.contains("beyond the largest number"), "{arguments:?}: {err}");
    }
}

#[test]
fn wrong_arguments_are_told_from_wrong_files() {
    let folder = folder("wrong");
    let leaf = put(&folder, "leaf.txt", LEAF);
    let code = |arguments: &[&str]| inspect(arguments).status.code();
    for arguments in [
        &[][..],
        &[&leaf, "--step", "0"],
        &[&leaf, "--step", "nan"],
        &[&leaf, "--average"],
        &[&leaf, "--role", "leaf"],
        &[&leaf, "--part", "0"],
        &[&leaf, "--json", "--csv", "-"],
        &[&leaf, &leaf, "--csv", "-"],
        &[&leaf, &leaf, "--csv", &leaf],
    ] {
        assert_eq!(code(arguments), Some(2), "{arguments:?}");
    }
    assert_eq!(code(&[&leaf, "missing.csv"]), Some(1));
    refused(&["inspect", "missing.csv"], &["chromascope: missing.csv: no such file or directory\n"]);
    refused(&["inspect", &put(&folder, "empty.csv", "")], &["empty.csv: the file is empty: expected a wavelength"]);
    // Every name that an option lists is taken.
    let help = String::from_utf8(inspect(&["--help"]).stdout).unwrap();
    assert!(help.contains("Examples:") && help.contains("--decimal-mark"), "{help}");
    for (option, names) in [
        ("--role", &["camera", "reflectance", "transmittance", "illuminant", "unknown"][..]),
        (
            "--reader",
            &["table", "cgats", "jcamp", "tm27", "cxf", "rawtoaces", "dcamprof", "labels", "alternate", "camspec"],
        ),
        ("--delimiter", &["comma", "comma-space", "semicolon", "tab", "spaces", "elements"]),
        ("--unit", &["nanometer", "micrometer", "angstrom", "wavenumber", "terahertz", "hertz"]),
        ("--orientation", &["down", "across"]),
    ] {
        for name in names {
            assert_ne!(code(&[&leaf, option, name]), Some(2), "{option} {name}");
        }
    }
    assert_eq!(read(LEAF.as_bytes(), &ReadOptions::default()).unwrap().role.value, Role::Reflectance);
}

#[test]
fn responses_can_be_taken_otherwise() {
    let folder = folder("per");
    let camera = put(
        &folder,
        "camera.csv",
        "nm,red,green,blue\n400,0,0.1,0.5\n500,0.1,0.8,0.4\n600,0.9,0.5,0.1\n700,0.5,0.1,0\n",
    );
    for (per, value, words) in [("photon", true, "responses per photon"), ("energy", false, "responses per energy")] {
        let text = done(&[&camera, "--role", "camera", "--per", per]);
        assert!(text.contains(&format!("{words} (chosen)")), "{text}");
        let json: Value = serde_json::from_str(&done(&[&camera, "--role", "camera", "--per", per, "--json"])).unwrap();
        assert_eq!(json["reading"]["per_photon"], value);
    }
    let leaf = put(&folder, "leaf.csv", LEAF);
    refused(&["inspect", &leaf, "--per", "photon"], &["reflectances", "--role camera"]);
    refused(&["inspect", &leaf, "--per", "quantum"], &["energy", "photon"]);
}

#[cfg(unix)]
#[test]
fn a_pipe_with_a_name_is_refused_and_standard_input_is_read_by_any_name() {
    use std::io::{Read as _, Write as _};
    let folder = folder("pipe");
    let pipe = folder.join("pipe");
    let made = std::process::Command::new("mkfifo").arg(&pipe).status().unwrap();
    assert!(made.success());
    refused(&["inspect", pipe.to_str().unwrap()], &["named pipes", "not supported", "standard input"]);
    for name in ["-", "/dev/stdin"] {
        let mut child = std::process::Command::new(env!("CARGO_BIN_EXE_chromascope"))
            .args(["inspect", name])
            .stdin(std::process::Stdio::piped())
            .stdout(std::process::Stdio::piped())
            .stderr(std::process::Stdio::piped())
            .spawn()
            .unwrap();
        let mut input = child.stdin.take().unwrap();
        if name == "-" {
            // While nothing comes, it says what it waits for.
            let wanted = "chromascope: waiting for standard input to end; Ctrl+C stops.\n";
            let mut notice = vec![0; wanted.len()];
            child.stderr.as_mut().unwrap().read_exact(&mut notice).unwrap();
            assert_eq!(String::from_utf8(notice).unwrap(), wanted);
        }
        input.write_all(LEAF.as_bytes()).unwrap();
        drop(input);
        let (out, _) = said(&child.wait_with_output().unwrap());
        assert!(out.starts_with("standard input\n") && out.contains("Role: reflectance"), "{out}");
    }
}
