//! `chromascope bench`: the command writes all or nothing, and says how to get it where it was not built.

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use chromascope_measure::{Effort, ErrorOf, ErrorScale, Machine, Measurement, Report, Workload};

/// A report with two invented measurements.
pub(crate) fn report() -> Report {
    let measurement = |method: &str, seconds: f64, error: f64| Measurement {
        workload: Workload::DiffuseSum,
        case: "g from 1 to 60".to_owned(),
        method: method.to_owned(),
        threads: 1,
        item: "sum".to_owned(),
        items: 1000,
        rounds: 3,
        seconds_per_item: seconds,
        least_seconds_per_item: seconds,
        spread: 0.1,
        build_seconds: 0.0,
        error: ErrorOf {
            what: "S, relative, against the sum in 106 bits".to_owned(),
            scale: ErrorScale::Relative,
            max_abs: error,
            rms_abs: error,
            max_rel: error,
            rms_rel: error,
            checked: 20,
            refused: 0,
        },
        baseline: "term by term".to_owned(),
        ratio: seconds / 2e-7,
        roof: None,
    };
    Report {
        program: chromascope_measure::program(),
        began: "2026-11-21T18:05:11Z".to_owned(),
        machine: Machine::unmeasured(),
        effort: Effort::Trial,
        whole: true,
        measurements: vec![measurement("term by term", 2e-7, 1e-15), measurement("uniform, 1e-13", 7e-8, 2e-15)],
    }
}

#[test]
fn a_report_is_drawn_and_read_back() {
    let report = report();
    let figure = report.figure(Workload::DiffuseSum).unwrap();
    let paper = chromascope::export::Paper::default();
    let svg = chromascope::export::svg(&figure, &chromascope::palette::Colors::LIGHT, paper);
    assert!(svg.contains("uniform") && !svg.contains("NaN") && !svg.contains("inf\""));
    chromascope::export::png(&svg, 0.5).unwrap();
    assert_eq!(serde_json::from_str::<Report>(&report.to_json().unwrap()).unwrap(), report);
}

/// Names the program built with the benchmark, which the ignored tests need.
const WITH_BENCH: &str = "CHROMASCOPE_WITH_BENCH";

fn bench(arguments: &[&str]) -> Output {
    run(env!("CARGO_BIN_EXE_chromascope"), arguments)
}

fn run(program: &str, arguments: &[&str]) -> Output {
    let mut command = Command::new(program);
    command.arg("bench").args(arguments).env_remove("DISPLAY").env_remove("WAYLAND_DISPLAY").output().unwrap()
}

fn scratch(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    let _gone = std::fs::remove_dir_all(&folder);
    folder
}

#[test]
#[ignore = "measures: needs a program built with --features bench, see .ci/run"]
fn the_command_writes_figures_a_table_and_json() {
    let program = std::env::var(WITH_BENCH).unwrap();
    let bench = |arguments: &[&str]| run(&program, arguments);
    let folder = scratch("bench_files");
    let output = bench(&["--trial", "--only", "diffuse-sum", "--out", folder.to_str().unwrap()]);
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let mut names: Vec<String> =
        std::fs::read_dir(&folder).unwrap().map(|f| f.unwrap().file_name().to_string_lossy().into_owned()).collect();
    names.sort();
    assert_eq!(names, ["bench.csv", "bench.json", "diffuse-sum.png", "diffuse-sum.svg"]);
    let report: chromascope_measure::Report =
        serde_json::from_str(&std::fs::read_to_string(folder.join("bench.json")).unwrap()).unwrap();
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(report.measurements.iter().all(|m| said.contains(&m.method)), "{said}");
    assert!(String::from_utf8_lossy(&output.stdout).contains("bench_files"));
    assert!(
        report.program.starts_with("Chromascope ") && report.began.ends_with('Z'),
        "{} {}",
        report.program,
        report.began
    );

    let arguments = ["--trial", "--only", "diffuse-sum", "--out", folder.to_str().unwrap()];
    let output = bench(&arguments);
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(!output.status.success() && said.contains("--replace"), "{said}");
    assert!(bench(&[&arguments[..], &["--replace"]].concat()).status.success());
}

#[test]
fn the_command_lists_its_workloads() {
    let output = bench(&["--list"]);
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    assert!(output.status.success() && Workload::ALL.iter().all(|workload| text.contains(workload.key())));
}

#[cfg(not(feature = "bench"))]
#[test]
fn a_build_without_the_benchmark_says_how_to_get_it() {
    let output = bench(&["--trial", "--out", "no such folder"]);
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(output.status.code() == Some(1) && output.stdout.is_empty(), "{said}");
    assert!(said.contains("cargo run --release --features bench"), "{said}");
    assert!(!std::path::Path::new("no such folder").exists());
}

#[test]
#[ignore = "needs a program built with --features bench, see .ci/run"]
fn the_command_refuses() {
    let program = std::env::var(WITH_BENCH).unwrap();
    for (arguments, words) in [
        (&["--trial"][..], "--out"),
        (&["--trial", "--out", concat!(env!("CARGO_MANIFEST_DIR"), "/Cargo.toml")], "is a file"),
        (&["--trial", "--out", concat!(env!("CARGO_MANIFEST_DIR"), "/Cargo.toml/below")], "cannot write"),
        (&["--trial", "--only", "loci", "--out", "x"], "diffuse-sum"),
    ] {
        let output = run(&program, arguments);
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(!output.status.success() && said.contains(words), "{arguments:?}: {said}");
    }
}
