//! The rules of the architecture that no type holds: who may use whom, who may touch what, how long things may be.
//!
//! Read from the source text, with test modules, comments and strings blanked out. Each check takes a path and a text,
//! so that the tests at the end can plant what it must find.

mod circles;
mod clocks;
mod rust_text;

use std::{
    collections::BTreeSet,
    fmt, fs,
    path::{Path, PathBuf},
    process::Command,
};

use rust_text::{code, functions, paths};

/// Modules of `chromascope-color`, then of `chromascope-render`, in their order: each uses only those before it.
const CORE_LAYERS: &[&str] = &[
    "accuracy",
    "units",
    "spectral",
    "colorimetry",
    "light",
    "patch_set",
    "correction",
    "rendition",
    "camera",
    "metamers",
    "recovery",
    "data",
    "reflectance",
    "scene",
    "render",
];

/// Modules of the app in their order, those of the workbench first: each uses only those before it. The pictures are in
/// `src/workbench/src/lib.rs` and `src/lib.rs`.
const APP_LAYERS: &[&str] = &[
    "format",
    "names",
    "hosted",
    "terminal",
    "palette",
    "atomic",
    "document",
    "action",
    "results",
    "jobs",
    "catalog",
    "help",
    "scene",
    "export",
    "plot_item",
    "render_service",
    "profiler",
    "figures",
    "report",
    "cli",
    "files",
    "theme",
    "paint",
    "workspaces",
    "view",
    "command",
    "panes",
    "app",
];

/// Modules of the Python package in their order.
const PYTHON_LAYERS: &[&str] = &["arrays", "spectra", "commands", "sets", "color", "computed", "drawn"];

/// Uses against that order, which can only become fewer.
const AGAINST_ORDER: &[(&str, &str)] = &[];

/// Other crates under the names that `chromascope-color` gives them.
const REEXPORTED: &[&str] = &["math"];

/// Names that the core never uses, as equal input must give equal output.
const NOT_IN_THE_CORE: &[&str] =
    &["egui", "eframe", "std::env", "std::fs", "std::net", "std::process", "std::thread", "std::time"];

/// What only a window needs: the workbench and its command line build without.
const WINDOW: &[&str] = &["accesskit", "eframe", "egui", "egui_plot", "epaint", "glow", "rfd", "winit"];

/// Modules below `panes` that every pane may use.
const PARTS_OF_PANES: &[&str] = &["context", "widgets"];

/// Modules of the app that may make colors, and that may touch the disk.
const MAKES_COLORS: &[&str] = &["paint", "theme"];
const TOUCHES_DISK: &[&str] = &["atomic", "catalog", "cli", "export", "files", "main"];
const DISK: &[&str] = &["std::fs", "tempfile"];

const FILE_LINES: usize = 600;
const CORE_FUNCTION_LINES: usize = 80;
const APP_FUNCTION_LINES: usize = 120;

#[test]
fn core_modules_use_only_what_is_above_them() {
    for krate in ["core/color", "core/render"] {
        hold(sources(&format!("{krate}/src")).iter().flat_map(|(path, text)| core_layers(path, text)));
    }
}

#[test]
fn crates_of_the_core_are_functions_of_their_arguments() {
    for krate in [
        "core",
        "core/figure",
        "core/math",
        "core/mesh",
        "core/profile",
        "core/query",
        "core/raw-image",
        "core/spectral-file",
        "core/spectral-image",
        "core/text",
    ] {
        hold(sources(&format!("{krate}/src")).iter().flat_map(|(path, text)| pure(path, text)));
    }
}

#[test]
fn app_modules_keep_to_their_part() {
    let sources = sources("src");
    let panes: BTreeSet<String> = sources
        .iter()
        .map(|(path, _)| module(path))
        .filter(|module| module.len() > 1 && module[0] == "panes")
        .map(|module| module[1].clone())
        .filter(|module| !PARTS_OF_PANES.contains(&module.as_str()))
        .collect();
    hold(sources.iter().flat_map(|(path, text)| app_layers(path, text, &panes)));
}

#[test]
fn app_modules_use_only_what_is_before_them() {
    hold(sources("src").iter().flat_map(|(path, text)| app_order(path, text)));
}

#[test]
fn the_workbench_builds_without_a_window() {
    let asked = "tree --offline --package chromascope-workbench --all-features --edges normal --prefix none";
    let told = Command::new(env!("CARGO")).args(asked.split(' ')).current_dir(root()).output().expect("cargo runs");
    assert!(told.status.success(), "{}", String::from_utf8_lossy(&told.stderr));
    let tree = String::from_utf8(told.stdout).expect("text");
    let packages: BTreeSet<&str> = tree.lines().filter_map(|line| line.split(' ').next()).collect();
    assert!(packages.contains("clap") && packages.contains("chromascope-core"), "{packages:?}");
    let found: Vec<_> = WINDOW.iter().filter(|name| packages.contains(*name)).collect();
    assert!(found.is_empty(), "the workbench depends on {found:?}");
}

#[test]
fn files_and_functions_stay_short() {
    for folder in ["core", "src", "tests"] {
        hold(sources(folder).iter().flat_map(|(path, text)| budgets(path, text)));
    }
}

#[test]
fn no_file_names_a_place_outside_the_repository() {
    let mut found = Vec::new();
    walk(&root(), &mut |path| {
        if let Ok(text) = fs::read_to_string(root().join(path)) {
            found.extend(outside_places(path, &text));
        }
    });
    hold(found);
}

/// A broken rule, and where.
#[derive(Debug, PartialEq)]
struct Violation {
    file: String,
    line: usize,
    rule: String,
}

impl fmt::Display for Violation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:{}: {}", self.file, self.line, self.rule)
    }
}

#[track_caller]
fn hold(violations: impl IntoIterator<Item = Violation>) {
    let lines: Vec<String> = violations.into_iter().map(|found| found.to_string()).collect();
    assert!(lines.is_empty(), "{} broken:\n{}\n", lines.len(), lines.join("\n"));
}

// ---- The rules ----

fn core_layers(file: &str, text: &str) -> Vec<Violation> {
    let own = module(file);
    let mut found = Report::new(file);
    let layer = |name: &String| CORE_LAYERS.iter().position(|layer| layer == name);
    let place = own.first().map(|own| (own, layer(own)));
    if let Some((own, None)) = place {
        found.push(1, format!("`{own}` has no layer: give it one in tests/app/architecture.rs"));
    }
    for path in paths(&own, &code(text)) {
        if let Some(name) = NOT_IN_THE_CORE.iter().find(|name| path.starts_with(name)) {
            found.push(path.line, format!("the core never uses `{name}`"));
        }
        let (Some((own, Some(place))), Some(used)) = (place, path.names.get(1)) else {
            continue;
        };
        if path.names[0] != "crate" || used == own || REEXPORTED.contains(&used.as_str()) {
            continue;
        }
        let rule = match layer(used) {
            Some(other) if other < place => continue,
            Some(_) => format!("`{own}` may not use `{used}`, only {}", CORE_LAYERS[..place].join(", ")),
            None => format!("`crate::{used}` names no module of the core: write the path through its module"),
        };
        found.push(path.line, rule);
    }
    found.violations
}

fn pure(file: &str, text: &str) -> Vec<Violation> {
    let mut found = Report::new(file);
    for path in paths(&module(file), &code(text)) {
        if let Some(name) = NOT_IN_THE_CORE.iter().find(|name| path.starts_with(name)) {
            found.push(path.line, format!("the core never uses `{name}`"));
        }
    }
    found.violations
}

fn app_layers(file: &str, text: &str, panes: &BTreeSet<String>) -> Vec<Violation> {
    let own = module(file);
    let own: Vec<&str> = own.iter().map(String::as_str).collect();
    let top = own.first().copied().unwrap_or(if file.ends_with("main.rs") { "main" } else { "lib" });
    let mut found = Report::new(file);
    for path in paths(&module(file), &code(text)) {
        let names: Vec<&str> = path.names.iter().map(String::as_str).collect();
        if let (["panes", pane, ..], ["crate", "panes", used, ..]) = (&own[..], &names[..])
            && used != pane
            && (*used == "*" || panes.contains(*used))
        {
            found.push(path.line, format!("panes do not use each other: `{pane}` uses `{used}`"));
        }
        if !MAKES_COLORS.contains(&top)
            && let Some(made) = names.windows(2).find_map(|pair| made_color(pair[0], pair[1]))
        {
            found.push(path.line, format!("only `paint` and `theme` make colors: `{made}`"));
        }
        if !TOUCHES_DISK.contains(&top)
            && let Some(disk) = DISK.iter().find(|disk| path.starts_with(disk))
        {
            let rule = "only `atomic`, `files`, `catalog`, `export` and the command line touch the disk";
            found.push(path.line, format!("{rule}: `{disk}`"));
        }
    }
    found.violations
}

fn app_order(file: &str, text: &str) -> Vec<Violation> {
    let own = module(file);
    let mut found = Report::new(file);
    let layers = if file.starts_with("src/python/") { PYTHON_LAYERS } else { APP_LAYERS };
    let layer = |name: &str| layers.iter().position(|layer| *layer == name);
    let Some(top) = own.first() else { return found.violations };
    let Some(place) = layer(top) else {
        found.push(1, format!("`{top}` has no place in the order: give it one in tests/app/architecture.rs"));
        return found.violations;
    };
    for path in paths(&own, &code(text)) {
        let [first, used, ..] = path.names.as_slice() else { continue };
        if first != "crate" || used == top || AGAINST_ORDER.contains(&(top.as_str(), used.as_str())) {
            continue;
        }
        if layer(used).is_none_or(|other| other > place) {
            found.push(path.line, format!("`{top}` may not use `{used}`, only {}", layers[..place].join(", ")));
        }
    }
    found.violations
}

/// A path that ends in a color of its own, such as `Color32::RED` or `Color32::from_rgb`.
fn made_color(kind: &str, name: &str) -> Option<String> {
    let constructor = name.starts_with("from_") || name == "new";
    let constant = name != "TRANSPARENT" && name.chars().all(|c| c.is_ascii_uppercase() || c == '_');
    let made = match kind {
        "Color32" => constructor || constant,
        "Hsva" | "Rgba" => constructor,
        _ => false,
    };
    made.then(|| format!("{kind}::{name}"))
}

fn budgets(file: &str, text: &str) -> Vec<Violation> {
    let mut found = Report::new(file);
    if file.ends_with("/mod.rs") {
        found.push(1, "a module is `x.rs` beside `x/`, never `mod.rs`".to_owned());
    }
    if file.starts_with("tests/") {
        return found.violations;
    }
    let kept = code(text);
    let tests = kept.skipped_lines;
    let lines = text.lines().count() - tests;
    if lines > FILE_LINES {
        found.push(FILE_LINES, format!("{lines} lines without tests, at most {FILE_LINES}"));
    }
    let limit = if file.starts_with("core/") { CORE_FUNCTION_LINES } else { APP_FUNCTION_LINES };
    for (name, line, length) in functions(&kept) {
        if length > limit {
            found.push(line, format!("`{name}` has {length} lines, at most {limit}"));
        }
    }
    found.violations
}

fn outside_places(file: &str, text: &str) -> Vec<Violation> {
    // In parts, so that this file does not name them.
    let [slash, library, shared, work] = ["/", concat!(".lib", "rary"), concat!("..", "/sha", "red"), "work/"];
    let mut found = Report::new(file);
    for (at, line) in text.lines().enumerate() {
        let absolute =
            |(start, _): (usize, &str)| !line[..start].ends_with(|c: char| c.is_alphanumeric() || "._-~".contains(c));
        let named = [
            line.match_indices(&[slash, work].concat()).any(absolute),
            line.contains(&[slash, library].concat()) || line.contains(&[library, slash].concat()),
            line.contains(&[shared, slash].concat()),
        ];
        if named.contains(&true) {
            found.push(at + 1, "names a place outside the repository".to_owned());
        }
    }
    found.violations
}

struct Report {
    file: String,
    violations: Vec<Violation>,
}

impl Report {
    fn new(file: &str) -> Self {
        Self { file: file.to_owned(), violations: Vec::new() }
    }

    fn push(&mut self, line: usize, rule: String) {
        let violation = Violation { file: self.file.clone(), line, rule };
        if !self.violations.contains(&violation) {
            self.violations.push(violation);
        }
    }
}

// ---- Files ----

fn root() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
}

/// The Rust files below a folder of the repository, each with its path from the root and its text.
fn sources(folder: &str) -> Vec<(String, String)> {
    let mut found = Vec::new();
    walk(&root().join(folder), &mut |path| {
        if Path::new(path).extension().is_some_and(|extension| extension == "rs") {
            let text = fs::read_to_string(root().join(path)).expect("source is UTF-8");
            found.push((path.to_owned(), text));
        }
    });
    found
}

/// Calls with the path from the root, written with `/`, of every file but git's and what building makes.
fn walk(folder: &Path, visit: &mut impl FnMut(&str)) {
    let Ok(entries) = fs::read_dir(folder) else {
        return;
    };
    let mut entries: Vec<PathBuf> = entries.filter_map(|entry| Some(entry.ok()?.path())).collect();
    entries.sort();
    for path in entries {
        if ["target", ".git"].iter().any(|skipped| path.ends_with(skipped)) {
            continue;
        }
        if path.is_dir() {
            walk(&path, visit);
        } else if let Ok(path) = path.strip_prefix(root()) {
            visit(&path.to_string_lossy().replace('\\', "/"));
        }
    }
}

/// The module that a file is: `core/color/src/light/planck.rs` is `light::planck`. Empty for the root of a crate. The window knows the
/// modules of the workbench under the names that they have there.
fn module(file: &str) -> Vec<String> {
    let below = file.rsplit_once("src/").map_or(file, |(_, below)| below);
    let below = below.strip_suffix(".rs").unwrap_or(below);
    let names: Vec<String> = below.split('/').map(str::to_owned).collect();
    if ["lib", "main"].contains(&below) { Vec::new() } else { names }
}

// ---- The rules find what they are for ----

fn found(violations: &[Violation]) -> Vec<String> {
    violations.iter().map(ToString::to_string).collect()
}

#[test]
fn a_module_that_looks_down_is_found() {
    let text = "//! Uses crate::camera and std::fs, says this comment.
use crate::{
    math::{self, dot::dot},
    spectral::Sensor as S, light::{planckian as p, Daylight},
};
use super::camera::Response;
const TEXT: &str = \"crate::patch_set::X\"; // crate::patch_set::X
fn f<'a>(c: char) -> super::super::patch_set::Object { if c == '\"' { crate::units::Kelvin::new() } else { self::g() } }
pub use crate::*;
use crate::Xyz;
#[cfg(test)]
mod tests { use crate::query::Ask; }
mod inner { use super::super::super::scene::Mesh; }
";
    let rule = "may not use";
    let only = "only accuracy, units, spectral";
    let expected = [
        format!("core/color/src/colorimetry/lab.rs:4: `colorimetry` {rule} `light`, {only}"),
        format!("core/color/src/colorimetry/lab.rs:8: `colorimetry` {rule} `patch_set`, {only}"),
        "core/color/src/colorimetry/lab.rs:9: `crate::*` names no module of the core: write the path through its module"
            .to_owned(),
        "core/color/src/colorimetry/lab.rs:10: `crate::Xyz` names no module of the core: write the path through its module"
            .to_owned(),
        format!("core/color/src/colorimetry/lab.rs:13: `colorimetry` {rule} `scene`, {only}"),
    ];
    assert_eq!(found(&core_layers("core/color/src/colorimetry/lab.rs", text)), expected);
    let expected =
        ["core/color/src/colorimetry.rs:1: `colorimetry` may not use `camera`, only accuracy, units, spectral"];
    assert_eq!(found(&core_layers("core/color/src/colorimetry.rs", "use super::camera::Response;")), expected);
    assert_eq!(found(&core_layers("core/color/src/lib.rs", "pub mod camera; pub use crate::camera::Way;")), [""; 0]);
    let unknown = core_layers("core/color/src/shiny.rs", "");
    assert!(unknown[0].rule.contains("`shiny` has no layer"));
}

#[test]
fn a_core_that_looks_outside_is_found() {
    let text = "use std::{
    fmt,
    time::Instant,
};
fn f() { ::std::fs::read(\"x\"); let _: std::thread::JoinHandle<()>; }
use egui;
";
    let expected = [
        "core/color/src/math.rs:3: the core never uses `std::time`",
        "core/color/src/math.rs:5: the core never uses `std::fs`",
        "core/color/src/math.rs:5: the core never uses `std::thread`",
        "core/color/src/math.rs:6: the core never uses `egui`",
    ];
    assert_eq!(found(&pure("core/color/src/math.rs", text)), expected);
}

#[test]
fn an_app_module_that_looks_up_is_found() {
    let check = |file: &str, text: &str| found(&app_order(file, text));
    let text =
        "use crate::format::number;\nuse crate::{action::Action, document};\nfn f(_: super::super::view::View) {}";
    let rule = "src/workbench/src/document/own.rs:";
    let only = "only format, names, hosted, terminal, palette, atomic";
    let expected = [
        format!("{rule}2: `document` may not use `action`, {only}"),
        format!("{rule}3: `document` may not use `view`, {only}"),
    ];
    assert_eq!(check("src/workbench/src/document/own.rs", text), expected);
    assert_eq!(check("src/app.rs", text), [""; 0]);
    assert_eq!(check("src/lib.rs", "pub mod view; pub use crate::view::View;"), [""; 0]);
    let unknown = check("src/shiny.rs", "");
    assert!(unknown[0].contains("`shiny` has no place in the order"));
}

#[test]
fn app_modules_out_of_their_part_are_found() {
    let panes = ["spectra", "swatches"].map(str::to_owned).into();
    let check = |file: &str, text: &str| {
        let found = app_layers(file, text, &panes);
        found.into_iter().map(|found| (found.line, found.rule)).collect::<Vec<_>>()
    };
    let lines = |file: &str, text: &str| check(file, text).into_iter().map(|(line, _)| line).collect::<Vec<_>>();

    let pane = "use super::swatches::Grid;\nuse crate::panes::{Pane, spectra::Axis};\nuse crate::panes::*;";
    assert_eq!(lines("src/panes/spectra.rs", pane), [1, 3]);
    assert_eq!(lines("src/panes/swatches.rs", pane), [2, 3]);
    assert_eq!(lines("src/panes.rs", pane), [0; 0]);

    let colors = "fn f() { Color32::from_rgb(1, 2, 3) }\nlet c = egui::Color32::WHITE;\nColor32::TRANSPARENT;\nimage::Rgba([1]);\necolor::Hsva::new(1.0);\nColor32::default()";
    assert_eq!(lines("src/panes/widgets/strip.rs", colors), [1, 2, 5]);
    assert_eq!(lines("src/theme.rs", colors), [0; 0]);
    assert_eq!(lines("src/paint/image.rs", colors), [0; 0]);

    let disk = "use std::{io, fs};\nfs::read(\"x\");\nstd::fs::write(\"x\", \"y\");";
    assert_eq!(lines("src/app.rs", disk), [1, 3]);
    assert_eq!(lines("src/lib.rs", disk), [1, 3]);
    for allowed in
        ["src/files.rs", "src/workbench/src/catalog/own.rs", "src/export.rs", "src/cli/locus.rs", "src/main.rs"]
    {
        assert_eq!(lines(allowed, disk), [0; 0]);
    }
    let rule = &check("src/app.rs", disk)[0].1;
    assert_eq!(rule, "only `atomic`, `files`, `catalog`, `export` and the command line touch the disk: `std::fs`");
}

#[test]
fn what_has_grown_too_long_is_found() {
    let function = |lines: usize| {
        let body = "    let brace = ('{', \"{\", r#\"}\"{\"#, b'{'); // {\n".repeat(lines - 2);
        format!("/* fn no() {{ /* */ */\nfn long<const N: usize>(_: [u8; {{ 3 }}]) -> u8 {{\n{body}}}\nfn short();\n")
    };
    assert_eq!(budgets("core/color/src/math.rs", &function(80)), []);
    let expected = ["core/color/src/math.rs:2: `long` has 81 lines, at most 80"];
    assert_eq!(found(&budgets("core/color/src/math.rs", &function(81))), expected);
    assert_eq!(budgets("src/app.rs", &function(120)), []);
    assert_eq!(found(&budgets("src/app.rs", &function(121))), ["src/app.rs:2: `long` has 121 lines, at most 120"]);

    let tests = format!("#[cfg(test)]\n#[allow(clippy::x)]\nmod tests {{\n{}}}\n", function(300));
    let file = |lines: usize| format!("{}{tests}", "const X: u8 = 1;\n".repeat(lines));
    assert_eq!(budgets("src/app.rs", &file(600)), []);
    assert_eq!(found(&budgets("src/app.rs", &file(601))), ["src/app.rs:600: 601 lines without tests, at most 600"]);
    assert_eq!(budgets("tests/app/x.rs", &file(601)), []);
    assert_eq!(budgets("tests/app/mod.rs", "").len(), 1);
}

#[test]
fn a_place_outside_the_repository_is_found() {
    let [slash, library, shared, work] = ["/", concat!(".lib", "rary"), concat!("..", "/sha", "red"), "work/"];
    for bad in [
        format!("`{slash}{work}main`"),
        format!("see {shared}/data"),
        format!("the{slash}{library}"),
        format!("{library}/search"),
    ] {
        assert_eq!(
            found(&outside_places("README.md", &format!("fine\n{bad}\n"))),
            ["README.md:2: names a place outside the repository"]
        );
    }
    for fine in
        [format!("https://example.org{slash}{work}2007"), format!("state{library}.names()"), format!("frame{work}")]
    {
        assert_eq!(outside_places("README.md", &fine), []);
    }
}
