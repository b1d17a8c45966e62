//! What people see, pinned: the output of every command, text and numbers of every kind of figure, every template as a
//! session, and the words of every workspace, as they are in `tests/golden`.
//!
//! Words agree exactly, numbers to [`REL`]. `UPDATE_GOLDEN=1 cargo test` writes them.

use std::fmt::Write as _;
use std::fs;
use std::path::{Path, PathBuf};

use chromascope::document::{Document, session};
use chromascope::view::SavedView;
use chromascope::view::template::TEMPLATES;
use chromascope::workspaces::Workspace;
use egui_kittest::kittest::{NodeT as _, Queryable as _};

use crate::cli::run;

/// Relative difference of two numbers that are the same.
const REL: f64 = 1e-9;

/// Commands by the name of their file. `OUT` is a folder whose files belong to the output, `DATA` a folder with small tables.
const COMMANDS: &[(&str, &[&str])] = &[
    ("help", &["--help"]),
    ("help_locus", &["locus", "--help"]),
    ("help_patches", &["patches", "--help"]),
    ("help_compare", &["compare", "--help"]),
    ("help_light", &["light", "--help"]),
    ("help_matrix", &["matrix", "--help"]),
    ("help_figure", &["figure", "--help"]),
    ("help_report", &["report", "--help"]),
    (
        "report_session",
        &["report", "--session", "DATA/work.chromascope", "--out", "OUT/report", "--picture-size", "16"],
    ),
    ("help_render", &["render", "--help"]),
    ("help_identify", &["identify", "--help"]),
    ("help_inspect", &["inspect", "--help"]),
    ("list", &["list"]),
    ("locus", &["locus", "--count", "12"]),
    ("locus_daylight", &["locus", "--preset", "paper", "--temperatures", "1000,2856,5503,6504,20000"]),
    ("patches", &["patches"]),
    ("patches_paper", &["patches", "--preset", "paper", "--camera", "Nikon D3300"]),
    ("patches_file", &["patches", "--chart", "DATA/leaf.csv", "--values", "plain"]),
    ("patches_radiance", &["patches", "--radiance", "DATA/radiance.csv"]),
    ("compare", &["compare"]),
    ("compare_csv", &["compare", "--camera", "Nikon D70 (A.M.P.A.S.)", "--camera", "Kodak DCS200", "--format", "csv"]),
    ("compare_json", &["compare", "--camera", "Nikon D3300", "--camera", "Canon EOS 5D Mark II", "--format", "json"]),
    ("light", &["light", "D65", "FL2"]),
    ("light_csv", &["light", "FL2", "--format", "csv"]),
    ("light_json", &["light", "A", "--format", "json"]),
    ("matrix", &["matrix", "Nikon D3300", "--illuminant", "D55"]),
    ("matrix_dng", &["matrix", "Nikon D3300", "--illuminant", "D55", "--second-illuminant", "A", "--format", "dng"]),
    ("identify", &["identify", "DATA/recorded.csv", "--chart", "ColorChecker 24 (Ohta 1997)", "--illuminant", "D55"]),
    (
        "identify_csv",
        &[
            "identify",
            "DATA/recorded.csv",
            "--chart",
            "ColorChecker 24 (Ohta 1997)",
            "--illuminant",
            "D55",
            "--format",
            "csv",
        ],
    ),
    ("inspect", &["inspect", "DATA/leaf.csv", "DATA/radiance.csv", "DATA/semicolons.csv"]),
    ("inspect_json", &["inspect", "DATA/semicolons.csv", "--json"]),
    ("render_stats", &["render", "--size", "24x24", "--out", "OUT/pictures", "--stats", "OUT/stats.json"]),
    (
        "render_leaf_stats",
        &["render", "--mesh", "fern", "--size", "24x24", "--out", "OUT/pictures", "--stats", "OUT/stats.json"],
    ),
];

/// Kinds of figures with their further arguments.
const FIGURES: &[(&str, &[&str])] = &[
    ("chromaticity", &[]),
    ("strip", &[]),
    ("spectra", &[]),
    ("swatches", &[]),
    ("light", &[]),
    ("render", &["--dpi", "36"]),
    ("difference", &["--dpi", "36"]),
    ("metrics", &["--camera", "Nikon D3300", "--camera", "Canon EOS 5D Mark II"]),
    ("head-to-head", &["--camera", "Nikon D3300", "--camera", "Canon EOS 5D Mark II"]),
    ("report-card", &["--camera", "Nikon D3300"]),
    ("curves", &["DATA/leaf.csv"]),
    ("recorded", &["DATA/recorded.csv", "--chart", "ColorChecker 24 (Ohta 1997)", "--illuminant", "D55"]),
];

#[test]
fn commands_write_what_they_wrote() {
    for (name, arguments) in COMMANDS {
        check(&format!("command_{name}"), &written(arguments));
    }
}

#[test]
fn figures_have_the_texts_and_numbers_they_had() {
    for (kind, more) in FIGURES {
        for start in ["colorimetry", "paper"] {
            let mut text = String::new();
            for form in ["svg", "csv"] {
                let out = format!("OUT/figure.{form}");
                let arguments = [&["figure", kind, "--preset", start, "--out", &out], *more].concat();
                text += &written(&arguments);
            }
            check(&format!("figure_{kind}_{start}"), &text);
        }
    }
}

#[test]
fn templates_are_the_sessions_they_were() {
    for template in &TEMPLATES {
        let document = template.document();
        let text = session::to_session(&document, &SavedView::default().for_session()).unwrap();
        check(&format!("session_{}", file_name(template.name)), &thinned(&text));
    }
}

#[test]
fn workspaces_say_what_they_said() {
    for (start, document) in [("paper", Document::paper()), ("colorimetry", Document::colorimetry())] {
        for workspace in Workspace::ALL {
            let size = [1280.0, 800.0];
            let (executor, mut harness) = crate::screenshots::driven_with(document.clone(), size, egui::Theme::Dark);
            harness.state_mut().view.saved.workspace = workspace;
            harness.state_mut().view.fixed_clock = true;
            for _ in 0..4 {
                harness.run_steps(3);
                executor.run_all();
            }
            harness.run_steps(3);
            let mut text = String::new();
            for node in harness.query_all_by(|_| true) {
                let node = node.accesskit_node();
                let (label, value) = (node.label().unwrap_or_default(), node.value().unwrap_or_default());
                if !label.is_empty() || !value.is_empty() {
                    writeln!(text, "{:?}: {label} = {value}", node.role()).unwrap();
                }
            }
            check(&format!("window_{start}_{}", file_name(workspace.label())), &text);
        }
    }
}

fn file_name(name: &str) -> String {
    name.to_lowercase().replace(|letter: char| !letter.is_ascii_alphanumeric(), "_")
}

/// What a command prints and writes.
fn written(arguments: &[&str]) -> String {
    let (out, data) = (tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap());
    for (name, text) in tables() {
        fs::write(data.path().join(name), text).unwrap();
    }
    let (out, data) = (out.path().to_str().unwrap(), data.path().to_str().unwrap());
    let given: Vec<String> = arguments.iter().map(|word| word.replace("OUT", out).replace("DATA", data)).collect();
    let output = run(&given.iter().map(String::as_str).collect::<Vec<_>>());
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).replace(out, "OUT").replace(data, "DATA");
    assert!(output.status.success(), "{arguments:?}: {}", text(&output.stderr));
    let mut all = thinned(&without_times(&text(&output.stdout)));
    let mut files: Vec<PathBuf> = Vec::new();
    below(Path::new(out), &mut files);
    files.sort();
    for path in files {
        let name = text(path.to_str().unwrap().as_bytes());
        writeln!(all, "== {name}").unwrap();
        match path.extension().and_then(|ending| ending.to_str()) {
            Some("html") => all += &words(&text(&fs::read(&path).unwrap())),
            Some("svg") => all += &texts(&fs::read_to_string(&path).unwrap()),
            Some("csv" | "json" | "txt") => all += &thinned(&without_times(&text(&fs::read(&path).unwrap()))),
            _ => {}
        }
    }
    all
}

/// A text without run times: those of a sentence, of JSON and of a column.
fn without_times(text: &str) -> String {
    let is_time = |line: &&str| {
        ["_ms\"", "\"time_ratio\"", "\"ns_per_sample\"", "\"all\"", "\"reading_mesh\"", "\"writing_files\""]
            .iter()
            .any(|key| line.contains(key))
    };
    let column = text.lines().next().and_then(|head| head.split(',').position(|name| name == "time_ms"));
    let line = |line: &str| match column {
        Some(column) => {
            let cells = line.split(',').enumerate().filter(|(at, _)| *at != column);
            cells.map(|(_, cell)| cell).collect::<Vec<_>>().join(",")
        }
        None => line.split(" samples lit: ").next().unwrap_or_default().to_owned(),
    };
    text.lines().filter(|line| !is_time(line)).map(|text| line(text) + "\n").collect()
}

fn below(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() { below(&path, found) } else { found.push(path) }
    }
}

/// The texts of an SVG, one per line, sorted: their places are not pinned.
fn texts(svg: &str) -> String {
    let inside = |part: &str| {
        let text = &part[..part.find("</text>").unwrap_or(part.len())];
        let plain = text.split('<').filter_map(|piece| piece.split_once('>')).map(|(_, text)| text);
        plain.collect::<String>()
    };
    let mut found: Vec<String> = svg.split("<text").skip(1).map(|part| inside(&format!("<{part}"))).collect();
    found.sort();
    found.join("\n") + "\n"
}

/// The words of a page without its figures, line by line.
fn words(page: &str) -> String {
    let body = page.split_once("<body>").unwrap().1;
    let whole = body.split("<svg").map(|part| part.split_once("</svg>").map_or(part, |(_, after)| after));
    let plain = |line: &str| {
        line.split('<')
            .map(|piece| piece.split_once('>').map_or(piece, |(_, text)| text).trim())
            .collect::<Vec<_>>()
            .join(" ")
    };
    whole
        .collect::<String>()
        .lines()
        .map(|line| plain(line).trim().to_owned() + "\n")
        .filter(|line| line != "\n")
        .collect()
}

/// A session that names a camera and a mesh that nobody has.
const SESSION: &str = r#"{"format": "chromascope", "version": 4, "light": {"set": "A"}, "compared": [
    {"name": "CIE 1931 2°", "kind": "observer", "slot": 0}, {"name": "Nikon D3300", "kind": "camera", "slot": 1},
    {"name": "Kodak DCS200", "kind": "camera", "slot": 2}, {"name": "Nobody's", "kind": "camera", "slot": 3},
    {"name": "Canon EOS 5D", "kind": "camera", "slot": 4, "visible": false}], "render": {"mesh": {"file": "gone.obj"}}}"#;

/// Small tables and a session, by the names of their files.
fn tables() -> [(&'static str, String); 5] {
    let grid = || (38..=73).map(|ten| 10.0 * f64::from(ten));
    let mut leaf = "wavelength_nm,leaf\n".to_owned();
    let mut radiance = "# Quantity: radiance\nwavelength_nm,lamp (W/sr/m2/nm),wall (W/sr/m2/nm)\n".to_owned();
    let mut semicolons = "Wellenlänge;Transmission Filter [%]\n".to_owned();
    for nm in grid() {
        let green = (-((nm - 550.0) / 40.0).powi(2)).exp();
        writeln!(leaf, "{nm},{:.4}", 0.05 + 0.1 * green).unwrap();
        writeln!(radiance, "{nm},{:.5},{:.5}", 0.01 + nm / 1e5, 0.002 + 0.003 * green).unwrap();
        writeln!(semicolons, "{nm},0;{}", format!("{:.2}", 90.0 * green).replace('.', ",")).unwrap();
    }
    [
        ("leaf.csv", leaf),
        ("radiance.csv", radiance),
        ("semicolons.csv", semicolons),
        ("recorded.csv", RECORDED.to_owned()),
        ("work.chromascope", SESSION.to_owned()),
    ]
}

/// Raw values of some patches.
const RECORDED: &str = "patch,R,G,B\nblue,0.040,0.060,0.160\ngreen,0.065,0.140,0.060\nred,0.120,0.035,0.030\n\
    yellow,0.330,0.370,0.060\nwhite,0.560,0.870,0.610\nblack,0.020,0.031,0.022\ncyan,0.06,0.15,0.18\n\
    neutral 5,0.13,0.2,0.14\nfoliage,0.06,0.08,0.03\norange,0.26,0.2,0.05\npurple,0.06,0.06,0.09\n";

/// A long text by its beginning, every twentieth line and their number.
fn thinned(text: &str) -> String {
    const BEGINNING: usize = 150;
    let lines: Vec<&str> = text.lines().collect();
    if lines.len() <= 4 * BEGINNING {
        return text.to_owned();
    }
    let kept = lines.iter().enumerate().filter(|(index, _)| *index < BEGINNING || index % 20 == 0);
    let kept: Vec<&str> = kept.map(|(_, line)| *line).collect();
    format!("{}\n{} lines\n", kept.join("\n"), lines.len())
}

/// Compares a text with its file, or writes it.
fn check(name: &str, text: &str) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/golden").join(format!("{name}.txt"));
    if std::env::var_os("UPDATE_GOLDEN").is_some() {
        fs::write(&path, text).unwrap();
        return;
    }
    let expected = fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    for (index, (left, right)) in text.lines().zip(expected.lines()).enumerate() {
        assert!(same(left, right), "{name}, line {}:\n now {left}\nthen {right}", index + 1);
    }
    assert_eq!(text.lines().count(), expected.lines().count(), "lines of {name}");
}

/// True if two lines have the same words and numbers.
fn same(left: &str, right: &str) -> bool {
    let (left, right) = (pieces(left), pieces(right));
    left.len() == right.len() && left.iter().zip(&right).all(|(left, right)| alike(left, right))
}

fn alike(left: &str, right: &str) -> bool {
    let numbers = left.parse::<f64>().ok().zip(right.parse::<f64>().ok());
    left == right || numbers.is_some_and(|(left, right)| (left - right).abs() <= REL * left.abs().max(right.abs()))
}

/// A line, cut where numbers begin and end.
fn pieces(line: &str) -> Vec<&str> {
    let is_number = |letter: char| letter.is_ascii_digit() || matches!(letter, '.' | '-' | 'e');
    let mut pieces = Vec::new();
    let mut rest = line;
    while let Some(first) = rest.chars().next() {
        let end = rest.find(|letter| is_number(letter) != is_number(first)).unwrap_or(rest.len());
        let (piece, after) = rest.split_at(end);
        pieces.push(piece);
        rest = after;
    }
    pieces
}

#[test]
fn words_agree_exactly_and_numbers_closely() {
    assert!(same("x 0.12345678901 nm", "x 0.12345678902 nm"));
    assert!(!same("x 0.1234567 nm", "x 0.1234568 nm"));
    assert!(!same("x 0.1 nm", "x 0.1 µm"));
    assert!(!same("x 0.1", "x 0.1 0.2"));
}
