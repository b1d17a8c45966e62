//! Miniature files, each with the truth beside it: no file may be misread without a word.
//!
//! `corpus/<case>.<ending>` is a file as a program or an instrument writes it, with made-up numbers; `corpus/<case>.truth` says
//! the values that an expert on that program reads in it. A truth is lines of `key: value`; `#` begins a comment:
//!
//! - `role`, `quantity`, `unit` (of the first curve): as displayed; `unit: -` for none.
//! - `sure: Role` and `guess: Role`: whether a decision, by the name it is listed under, follows from the file or is a guess.
//!   A guess that would change values by a factor must be one.
//! - `says: text`: part of a warning, or of a decision as listed (`Scale: divided by 100`). `silent: yes`: no warning at all.
//! - `refused: text`: the file is not read, and the error says so.
//! - `curve <name>: 400=0.05 410=0.06`: every sample, wavelength in nanometers; the curves in their order.
//!   `curves: 3` where they are too many to list.
//! - `take: part 2`: the part that is chosen, where a file has several.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use spectral_file::{Certainty, Dropped, Preview, ReadOptions, SpectralFile, Watch, What, read, read_marked};

/// Relative distance between a value and its truth, which is written in decimals.
const CLOSE: f64 = 1e-12;

fn folder() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../tests/spectral-file/corpus")
}

/// The cases: a file and its truth.
fn cases() -> Vec<(PathBuf, String)> {
    let entries = fs::read_dir(folder()).expect("the corpus is there");
    let mut files: Vec<PathBuf> = entries.map(|entry| entry.expect("listed").path()).collect();
    files.sort();
    let (truths, files): (Vec<_>, Vec<_>) =
        files.into_iter().partition(|path| path.extension().is_some_and(|ending| ending == "truth"));
    assert_eq!(truths.len(), files.len(), "each file has one truth beside it");
    files
        .into_iter()
        .map(|file| {
            let truth = file.with_extension("truth");
            let text = fs::read_to_string(&truth).unwrap_or_else(|error| panic!("{}: {error}", truth.display()));
            (file, text)
        })
        .collect()
}

fn close(a: f64, b: f64) -> bool {
    a == b || (a - b).abs() <= CLOSE * a.abs().max(b.abs())
}

/// Differences between a reading and its truth.
fn faults(file: &Path, truth: &str) -> Vec<String> {
    let lines = truth.lines().map(str::trim).filter(|line| !line.is_empty() && !line.starts_with('#'));
    let claims: Vec<(&str, &str)> =
        lines.map(|line| line.split_once(": ").map_or((line, ""), |(key, value)| (key, value.trim()))).collect();
    let mut options = ReadOptions::default();
    for (key, value) in &claims {
        if *key == "take" {
            options.part = value.strip_prefix("part ").and_then(|part| part.parse().ok());
        }
    }
    let bytes = fs::read(file).expect("it is there");
    let refused = claims.iter().find(|(key, _)| *key == "refused").map(|(_, value)| *value);
    match (read(&bytes, &options), refused) {
        (Err(error), Some(part)) if error.to_string().contains(part) => Vec::new(),
        (Err(error), _) => vec![format!("refused: {error}")],
        (Ok(table), Some(_)) => vec![format!("read, but it should be refused: {:?}", table.curves)],
        (Ok(table), None) => against(&table, &claims),
    }
}

fn against(table: &SpectralFile, claims: &[(&str, &str)]) -> Vec<String> {
    let decisions = table.decisions();
    let mut said: Vec<String> = table.warnings.iter().map(ToString::to_string).collect();
    let warnings = said.len();
    said.extend(decisions.iter().map(|decision| format!("{}: {} ({})", decision.what, decision.value, decision.why)));
    let mut faults = Vec::new();
    let mut expect = |what: &str, found: &str, truth: &str| {
        if found != truth {
            faults.push(format!("{what}: {found}, in truth {truth}"));
        }
    };
    let mut curves = 0;
    for (key, value) in claims {
        match *key {
            "role" => expect("role", &table.role.value.to_string(), value),
            "quantity" => expect("quantity", &table.reading.quantity.value.to_string(), value),
            "unit" => expect("unit", table.curves[0].unit.as_deref().unwrap_or("-"), value),
            "curves" => {
                expect("curves", &table.curves.len().to_string(), value);
                curves = table.curves.len();
            }
            "sure" | "guess" => {
                let found = decisions.iter().find(|decision| decision.what == *value);
                let sure = found.map(|decision| decision.certainty == Certainty::Certain);
                expect(value, &format!("{sure:?}"), &format!("{:?}", Some(*key == "sure")));
            }
            "says" if !said.iter().any(|said| said.contains(value)) => expect("said", &format!("{said:?}"), value),
            "silent" => expect("warnings", &said[..warnings].join("; "), ""),
            "says" | "take" => {}
            _ => match key.strip_prefix("curve ") {
                Some(name) => {
                    let fault = table.curves.get(curves).map_or(Some("is missing".to_owned()), |curve| {
                        let samples: Vec<(f64, f64)> =
                            curve.wavelengths_nm.iter().copied().zip(curve.values.iter().copied()).collect();
                        of_curve(&curve.name, &samples, name, value)
                    });
                    if let Some(fault) = fault {
                        expect(&format!("curve {name}"), &fault, "");
                    }
                    curves += 1;
                }
                None => panic!("a truth does not say “{key}”"),
            },
        }
    }
    expect("curves in all", &table.curves.len().to_string(), &curves.to_string());
    faults
}

/// Difference between a curve and its truth.
fn of_curve(name: &str, samples: &[(f64, f64)], true_name: &str, truth: &str) -> Option<String> {
    let number = |text: &str| text.parse::<f64>().unwrap_or_else(|_| panic!("“{text}” is no number"));
    let truth: Vec<(f64, f64)> = truth
        .split_whitespace()
        .map(|pair| {
            let (nm, value) = pair.split_once('=').unwrap_or_else(|| panic!("“{pair}” is no wavelength=value"));
            (number(nm), number(value))
        })
        .collect();
    let same = samples.len() == truth.len()
        && samples.iter().zip(&truth).all(|(a, b)| (a.0 - b.0).abs() <= 1e-9 * b.0 && close(a.1, b.1));
    (name != true_name || !same).then(|| format!("“{name}” {samples:?}"))
}

#[test]
fn every_file_is_read_as_what_it_is() {
    let wrong: Vec<String> = cases()
        .iter()
        .filter_map(|(file, truth)| {
            let faults = faults(file, truth);
            let name = file.file_name().unwrap_or_default().to_string_lossy();
            (!faults.is_empty()).then(|| format!("{name}:\n    {}", faults.join("\n    ")))
        })
        .collect();
    assert!(wrong.is_empty(), "{} files are misread:\n{}", wrong.len(), wrong.join("\n"));
}

#[test]
fn a_wrong_truth_is_found() {
    let file = folder().join("plain_reflectance.csv");
    let truth = fs::read_to_string(folder().join("plain_reflectance.truth")).expect("it is there");
    assert_eq!(faults(&file, &truth), Vec::<String>::new());
    for (from, to) in [
        ("0.055", "0.0551"),
        ("role: reflectances", "role: transmittances"),
        ("Leaf Refl", "Leaves Refl"),
        ("sure", "guess"),
    ] {
        assert!(truth.contains(from), "{from}");
        assert!(!faults(&file, &truth.replace(from, to)).is_empty(), "{from} for {to}");
    }
    assert!(!faults(&file, &format!("{truth}\nsays: something else\n")).is_empty());
    assert!(!faults(&file, &format!("{truth}\nrefused: it\n")).is_empty());
}

/// Beginnings of the names of files whose values are not marked: ratios of several blocks stand nowhere in the text, and the
/// lists of ENLIGHTEN are not recorded.
const UNMARKED: [&str; 2] = ["link_", "enlighten_"];

#[test]
fn every_value_is_marked_where_it_stands() {
    for (file, _) in cases() {
        let name = file.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let bytes = fs::read(&file).expect("it is there");
        let Ok((table, marker)) = read_marked(&bytes, &ReadOptions::default(), Watch::none()) else { continue };
        let preview = Preview::new(&bytes).expect("it was read");
        let (mut found, mut compressed) = (BTreeSet::new(), false);
        for mark in (1..=preview.line_count()).flat_map(|line| preview.marks(line, &table, &marker)) {
            compressed |= matches!(mark.what, What::Block(..));
            if let What::Value { curve, nm, .. } = mark.what {
                assert!(found.insert((curve, nm.to_bits())), "{name}: {nm} nm of curve {curve} twice");
            }
        }
        let samples: usize = table.curves.iter().map(|curve| curve.values.len()).sum();
        let merged = table.reading.dropped_rows.iter().any(|row| row.why == Dropped::Averaged);
        if !(compressed || merged || UNMARKED.iter().any(|start| name.starts_with(start))) {
            assert_eq!(found.len(), samples, "{name}");
        }
    }
}
