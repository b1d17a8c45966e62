//! Texts of every figure: none on a mark, on another text or beyond the edge, in any width, with few sensors and many.

use std::fmt::Write as _;
use std::fs;

use chromascope::palette::Colors;
use chromascope_figure::{InkRole, Palette as _};

use super::run;
#[path = "../../figure/faults.rs"]
mod faults;

/// A name longer than any of the library.
const LONG: &str = "Prototype of the Laboratory for Colorimetry, second run (2026)";

/// Cameras beside the one with the long name.
const CAMERAS: [&str; 8] = [
    "Kodak DCS200",
    "Nikon D70 (2007 figure)",
    "Canon EOS 10D (2007 figure)",
    "Canon EOS 5D Mark III",
    "Sony DSC-RX100M4",
    "Nikon D850",
    "Fujifilm X-T4",
    "Sony ILCE-7M3",
];

/// Figures with the arguments that they need beyond cameras.
const KINDS: [(&str, &[&str]); 21] = [
    ("chromaticity", &[]),
    ("chromaticity", &["--preset", "paper"]),
    ("chromaticity", &["--range", "full"]),
    ("differences", &[]),
    ("differences", &["--plane", "lab"]),
    ("differences", &["--plane", "xy", "--illuminant", "A"]),
    ("differences", &["--plane", "loci"]),
    ("differences", &["--exaggerate", "10"]),
    ("strip", &[]),
    ("strip", &["--preset", "paper"]),
    ("spectra", &[]),
    ("spectra", &["--preset", "paper"]),
    ("swatches", &[]),
    ("light", &["--illuminant", "A"]),
    ("light", &["--illuminant", "FL2"]),
    ("render", &["--mesh", "sphere", "--dpi", "36"]),
    ("difference", &["--mesh", "plane", "--dpi", "36"]),
    ("metrics", &[]),
    ("head-to-head", &[]),
    ("report-card", &[]),
    ("correction", &["--second-light", "A"]),
];

/// Faults of a figure's texts.
fn faults_of(kind: &str, arguments: &[&str]) -> Vec<String> {
    let out = tempfile::Builder::new().suffix(".svg").tempfile().expect("a file").into_temp_path();
    let path = out.to_string_lossy();
    let done = run(&[&["figure", kind, "--force", "--out", &path], arguments].concat());
    assert!(done.status.success(), "{kind}: {}", String::from_utf8_lossy(&done.stderr));
    let hex =
        |role: InkRole| Colors::LIGHT.rgb(role).iter().fold("#".to_owned(), |hex, byte| format!("{hex}{byte:02x}"));
    let svg = fs::read_to_string(&out).expect("a file");
    faults::faults(&svg, &hex(InkRole::Plot), &hex(InkRole::Grid))
}

#[test]
fn no_text_of_a_figure_meets_a_mark_a_text_or_the_edge() {
    let folder = tempfile::tempdir().expect("a folder");
    let long = folder.path().join(format!("{LONG}.csv"));
    let peak = |nm: f64, middle: f64| (-((nm - middle) / 45.0).powi(2)).exp();
    let rows = (38..=78).map(|i| 10.0 * f64::from(i));
    let table = rows.fold("nm,red,green,blue\n".to_owned(), |mut table, nm| {
        let [red, green, blue] = [610.0, 540.0, 450.0].map(|middle| peak(nm, middle));
        let _ = writeln!(table, "{nm},{red:.6},{green:.6},{blue:.6}");
        table
    });
    fs::write(&long, table).expect("written");
    let long = long.to_string_lossy().into_owned();
    let mut found = String::new();
    for (kind, arguments) in KINDS {
        for (width, count) in ["85mm", "174mm"].into_iter().flat_map(|width| [1, 4, 9].map(|count| (width, count))) {
            let count = match kind {
                "head-to-head" if count == 1 => 2,
                "head-to-head" | "report-card" | "correction" if count > 1 => continue,
                _ => count,
            };
            let cameras = [&long[..]].into_iter().chain(CAMERAS).take(count);
            let sensors: Vec<&str> = cameras.flat_map(|camera| ["--camera", camera]).collect();
            let all = [arguments, &["--width", width], &sensors[..]].concat();
            for fault in faults_of(kind, &all) {
                let _ = writeln!(found, "{kind} {arguments:?}, {width}, {count} cameras: {fault}");
            }
        }
    }
    let raw = folder.path().join("raw.csv");
    let patches = "patch,R,G,B\ndark skin,0.12,0.09,0.06\nlight skin,0.38,0.29,0.25\nblue sky,0.16,0.19,0.31\n\
                   foliage,0.11,0.14,0.06\nblue flower,0.25,0.22,0.40\nbluish green,0.29,0.43,0.43\n";
    fs::write(&raw, patches).expect("written");
    for (kind, file) in [("recorded", raw.to_string_lossy().into_owned()), ("curves", long.clone())] {
        for width in ["85mm", "174mm"] {
            for fault in faults_of(kind, &[&file, "--width", width]) {
                let _ = writeln!(found, "{kind}, {width}: {fault}");
            }
        }
    }
    assert!(found.is_empty(), "\n{found}{} faults", found.lines().count());
}
