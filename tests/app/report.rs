//! The report on the paper: its claims, the committed sample, and its making from the window.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use chromascope::action::history::History;
use chromascope::app::ChromascopeApp;
use chromascope::command::Command;
use chromascope::document::start::Start;
use chromascope::document::{Document, SetKind};
use chromascope::figures::FIGURES;
use chromascope::files::{Answer, Dialogs, Files, Question};
use chromascope::jobs::Executor;
use chromascope::report::{Judged, NUMBERS, PAGE, PIXELS, RANKING, Report, Verdict, numbers};
use chromascope::results::Results;
use chromascope::view::{ReportOn, SavedView};
use egui_kittest::Harness;

use crate::cpu_renderer::Cpu;
use crate::waiting::until;

/// Folder of the sample, which `chromascope report --picture-size 240` made.
const SAMPLE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/assets/report");

fn paper() -> Report {
    Report::new(Start::Paper.document(), false, PIXELS)
}

fn sample(name: &str) -> String {
    let path = Path::new(SAMPLE).join(name);
    std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

/// The numbers of a claim, by quantity and sensor.
fn found(judged: &[Judged], claim: &str) -> (Verdict, BTreeMap<(String, String), f64>) {
    let judged = judged.iter().find(|judged| judged.claim.key == claim).unwrap_or_else(|| panic!("no claim {claim}"));
    let finding = judged.finding.as_ref().unwrap();
    let values = finding.values.iter().map(|v| ((v.quantity.clone(), v.sensor.clone()), v.number));
    (finding.verdict, values.collect())
}

#[test]
fn claims_are_judged_by_what_is_found() {
    const REFERENCE: &str = "Stiles & Burch 1955 2°";
    const CANON: &str = "Canon EOS 10D (2007 figure)";
    const NIKON: &str = "Nikon D70 (2007 figure)";
    const KODAK: &str = "Kodak DCS200";
    /// Sensor, number, tolerance.
    type Numbers = [(&'static str, f64, f64)];
    let judged = paper().judged(&Results::default());
    // Numbers of an independent computation, each with its own accuracy.
    #[rustfmt::skip]
    let expected: [(&str, Verdict, &str, &Numbers); 10] = [
        ("locus-length", Verdict::Holds, "length in xy",
            &[(REFERENCE, 0.387, 0.002), (CANON, 0.348, 0.001), (NIKON, 0.332, 0.002), (KODAK, 0.124, 0.001)]),
        ("daylight-minimum", Verdict::Holds, "nearest at", &[(CANON, 6034.0, 2.0), (NIKON, 5949.0, 2.0), (KODAK, 5773.0, 2.0)]),
        ("daylight-is-the-cameras", Verdict::Fails, "nearest at, fitted under A",
            &[(CANON, 2858.0, 3.0), (NIKON, 2858.0, 3.0), (KODAK, 2858.0, 3.0)]),
        ("canon-and-nikon-nearer", Verdict::Holds, "nearer than the Canon from", &[(KODAK, 5605.0, 3.0)]),
        ("white-alike", Verdict::Partly, "B of the white patch", &[(REFERENCE, 0.865, 5e-4), (KODAK, 0.886, 5e-4)]),
        ("red-nearer-delta-e", Verdict::Fails, "ΔE*00 red", &[(CANON, 3.04, 0.006), (NIKON, 2.16, 0.006)]),
        ("kodak-head-brighter", Verdict::Holds, "Y of the skin, relative to the reference", &[(KODAK, 1.11, 5e-3)]),
        ("kodak-head-saturated", Verdict::Ambiguous, "saturation (HSV) of the skin",
            &[(REFERENCE, 0.655, 1e-3), (KODAK, 0.437, 1e-3)]),
        ("fern-greener", Verdict::Partly, "a* of the leaf, of Eq 13 colors",
            &[(REFERENCE, -8.04, 0.01), (CANON, -8.15, 0.01), (NIKON, -8.74, 0.01)]),
        ("match-skin-differ-leaf", Verdict::Fails, "Δ of Eq 13 colors, leaf at L* 50", &[(CANON, 4.30, 0.006), (NIKON, 3.31, 0.006)]),
    ];
    for (claim, verdict, quantity, sensors) in expected {
        let (found, values) = found(&judged, claim);
        assert_eq!(found, verdict, "{claim}");
        for (sensor, number, accuracy) in sensors {
            let value = values[&(quantity.to_owned(), (*sensor).to_owned())];
            assert!((value - number).abs() <= *accuracy, "{claim}, {sensor}: {value} is not {number} ± {accuracy}");
        }
    }
    for (claim, verdict) in [
        ("red-nearer-xy", Verdict::Holds),
        ("kodak-farthest", Verdict::Holds),
        ("kodak-fern-white", Verdict::Holds),
        ("balance", Verdict::Holds),
        ("falloff", Verdict::Holds),
        ("white-stays-white", Verdict::Fails),
    ] {
        assert_eq!(found(&judged, claim).0, verdict, "{claim}");
    }
}

#[test]
fn what_the_paper_does_not_say_is_not_counted_among_its_claims() {
    let judged = paper().judged(&Results::default());
    let (claims, further): (Vec<&Judged>, Vec<&Judged>) = judged.iter().partition(|judged| judged.claim.is_of_paper());
    assert_eq!((claims.len(), further.len()), (13, 4));
    assert!(claims.iter().all(|judged| !judged.claim.paper.contains("at all temperatures")));
    let files = paper().make(paper().steps() - 1, &Results::default()).unwrap();
    let text = |name: &str| {
        let file = files.iter().find(|file| file.name == name).unwrap();
        String::from_utf8(file.bytes.clone()).unwrap()
    };
    let page = text(PAGE);
    let summary =
        "Of 13 claims: holds 9, holds in part 2, does not hold 1, ambiguous 1, not judged 0. 4 further checks";
    assert!(page.contains(summary));
    // The saturation claim as the paper has it.
    assert!(page.contains("tends further to the white, which makes the head appear slightly brighter"));
    assert_eq!(page.matches("<p class=\"note\">Kodak DCS200 in place of the paper's DCS420</p>").count(), 6);
    assert_eq!(page.matches("Further checks: not in the paper").count(), 1);
    let table = text(NUMBERS);
    let head = table.lines().find(|line| !line.starts_with('#')).unwrap();
    assert_eq!(head, "claim,part,paper,verdict,condition,quantity,sensor,value,unit,rounding");
    // Three tables of one camera: the digits of a number are not how well it is known.
    let (_, lengths) = found(&judged, "locus-length");
    let end = |end: &str| lengths[&(format!("length in xy, {end} among 3 tables of one Nikon D70"), String::new())];
    assert!(end("most") - end("least") > 0.005, "{lengths:?}");
}

#[test]
fn claims_about_cameras_that_are_not_there_are_not_judged() {
    let mut document = Start::Paper.document();
    document.compared.retain(|compared| compared.name != "Kodak DCS200");
    let judged = Report::of_document(&document).judged(&Results::default());
    for claim in ["locus-length", "canon-and-nikon-nearer", "kodak-farthest", "kodak-head-brighter"] {
        let (verdict, values) = found(&judged, claim);
        assert!(verdict == Verdict::Open && !values.is_empty(), "{claim}");
    }
    assert_eq!(found(&judged, "fern-greener").0, Verdict::Partly);
    document.chart = "ColorChecker 24 (BabelColor average)".to_owned();
    let judged = Report::of_document(&Document { subset: chromascope::document::Subset::All, ..document })
        .judged(&Results::default());
    assert!(found(&judged, "red-nearer-xy").1.keys().all(|(quantity, _)| quantity.contains("mean of 24 patches")));
}

/// Fields of a line of CSV; quotes around a field, none within.
fn fields(line: &str) -> Vec<String> {
    let mut fields = vec![String::new()];
    let mut is_quoted = false;
    for c in line.chars() {
        match c {
            '"' => is_quoted = !is_quoted,
            ',' if !is_quoted => fields.push(String::new()),
            c => fields.last_mut().unwrap().push(c),
        }
    }
    fields
}

#[test]
fn the_sample_says_what_is_found_now() {
    let now = numbers(&paper().judged(&Results::default())).to_csv();
    let rows = |text: &str| -> Vec<Vec<String>> {
        text.lines().filter(|line| !line.starts_with('#')).skip(1).map(fields).collect()
    };
    let (now, sample) = (rows(&now), rows(&sample(NUMBERS)));
    assert_eq!(now.len(), sample.len(), "the report has other rows: make the sample again");
    for (now, sample) in now.iter().zip(&sample) {
        let number = |row: &[String], at: usize| row[at].parse::<f64>().unwrap();
        for at in [0, 1, 2, 3, 4, 5, 6, 8, 9] {
            assert_eq!(now[at], sample[at], "make the sample again");
        }
        // Either may be rounded away from the other.
        let rounding = 2.0 * number(sample, 9) * (1.0 + 1e-9);
        assert!((number(now, 7) - number(sample, 7)).abs() <= rounding, "{now:?} is not {sample:?}");
    }
}

/// A page without its figures and without digits.
fn words_of(page: &str) -> String {
    let (before, rest) = page.split_once("<h2>Figures</h2>").expect("a heading of figures");
    let (_, after) = rest.split_once("<h2>What stands").expect("a heading of data");
    format!("{before}{after}").chars().filter(|c| !c.is_ascii_digit()).collect()
}

#[test]
fn the_samples_page_is_whole_and_needs_no_network() {
    let page = sample(PAGE);
    let files = paper().make(paper().steps() - 1, &Results::default()).unwrap();
    let now = files.iter().find(|file| file.name == PAGE).unwrap();
    assert_eq!(words_of(&page), words_of(std::str::from_utf8(&now.bytes).unwrap()), "make the sample again");
    assert!(page.len() < 1_000_000, "{} bytes", page.len());
    assert_eq!(page.matches("<svg").count(), 9);
    for (start, allowed) in [("href=\"", ["figure", "data:", "#"]), ("src=\"", ["data:"; 3]), ("url(", ["#"; 3])] {
        for (at, _) in page.match_indices(start) {
            let rest = &page[at + start.len()..];
            let end = rest.chars().take(20).collect::<String>();
            assert!(allowed.iter().any(|allowed| rest.starts_with(allowed)), "{start}{end}");
        }
    }
    assert!(!page.contains("<script") && !page.contains("<link") && !page.contains("@import"));
    let ids: Vec<&str> =
        page.match_indices(" id=\"").map(|(at, start)| page[at + start.len()..].split('"').next().unwrap()).collect();
    assert_eq!(ids.iter().collect::<BTreeSet<_>>().len(), ids.len(), "an id stands twice");
}

/// Chooses a folder.
struct Chooses(PathBuf);

impl Dialogs for Chooses {
    fn ask(&self, question: &Question) -> Answer {
        match question {
            Question::Folder { .. } => Answer::Chosen(vec![self.0.clone()]),
            _ => Answer::Cancelled,
        }
    }
}

type Window = Harness<'static, ChromascopeApp>;

/// A window with a report on the paper begun in a folder.
fn begun(executor: &Executor, folder: &Path) -> Window {
    begun_on(executor, folder, ReportOn::Paper)
}

fn begun_on(executor: &Executor, folder: &Path, on: ReportOn) -> Window {
    let files = Files::new(None).with_dialogs(Arc::new(Chooses(folder.to_owned())));
    let builder = Harness::builder().with_size([1280.0, 800.0]).with_pixels_per_point(1.0).renderer(Cpu::default());
    let mut window = builder.build_eframe(|cc| {
        ChromascopeApp::on(executor, &cc.egui_ctx, History::new(Document::paper()), SavedView::default(), files)
    });
    window.run();
    begin(executor, &mut window, on);
    window
}

/// Begins a report and waits for its folder.
fn begin(executor: &Executor, window: &mut Window, on: ReportOn) {
    window.state_mut().push(Command::Report(on));
    until("the first figure", || {
        window.step();
        if executor.run_one("report") { Ok(()) } else { Err("no report is made".to_owned()) }
    });
}

#[test]
fn a_report_of_the_window_shows_its_progress_and_can_be_stopped() {
    use egui_kittest::kittest::Queryable as _;
    let parent = tempfile::tempdir().unwrap();
    let executor = Executor::driven();
    let mut window = begun(&executor, parent.path());
    executor.run_one("report");
    window.step();
    assert!(window.query_all_by_label_contains("Report: Figure 3, 3 of 10").next().is_some());
    let folder = parent.path().join("Chromascope report");
    assert!(folder.join("figure2.pdf").is_file() && !folder.join("figure3.pdf").exists());
    window.get_by_label("Stop").click();
    window.run_steps(3);
    assert!(window.state().view.status.text.starts_with("Report stopped after 2 of 10 steps"));
    executor.run_all();
    assert!(!folder.join("figure3.pdf").exists());
    // Another one has a folder of its own, and its last step needs none before it.
    begin(&executor, &mut window, ReportOn::Paper);
    assert!(parent.path().join("Chromascope report 2/figure1.svg").is_file());
    window.key_press(egui::Key::Escape);
    window.run_steps(2);
    assert!(window.state().view.status.text.contains("Chromascope report 2"));
}

#[test]
fn a_report_that_cannot_be_written_says_why() {
    let parent = tempfile::tempdir().unwrap();
    let executor = Executor::driven();
    let mut window = begun(&executor, parent.path());
    std::fs::remove_dir_all(parent.path().join("Chromascope report")).unwrap();
    executor.run_one("report");
    window.run_steps(2);
    let said = window.state().view.status.text.clone();
    assert!(said.contains("not finished") && said.contains("figure2.pdf"), "{said}");
    executor.run_all();
    assert!(!parent.path().join("Chromascope report").exists());
}

#[test]
fn a_report_of_the_window_is_whole() {
    let parent = tempfile::tempdir().unwrap();
    let executor = Executor::driven();
    let mut window = begun(&executor, parent.path());
    executor.run_all();
    window.run_steps(2);
    let said = window.state().view.status.text.clone();
    let folder = parent.path().join("Chromascope report");
    assert!(said.starts_with("Report saved") && said.contains(PAGE), "{said}");
    for name in paper().names() {
        let bytes = std::fs::read(folder.join(&name)).unwrap_or_else(|error| panic!("{name}: {error}"));
        let start: &[u8] = match name.rsplit('.').next() {
            Some("pdf") => b"%PDF-",
            Some("png") => b"\x89PNG",
            Some("svg") => b"<svg",
            Some("html") => b"<!DOCTYPE html>",
            _ => b"",
        };
        assert!(bytes.starts_with(start) && !bytes.is_empty(), "{name}");
    }
    let page = std::fs::read_to_string(folder.join(PAGE)).unwrap();
    assert_eq!(page.matches("<svg").count(), 9);
}

#[test]
fn the_library_is_written_to_a_folder_with_a_descriptor_of_its_files() {
    let parent = tempfile::tempdir().unwrap();
    let executor = Executor::driven();
    let mut window = begun_on(&executor, parent.path(), ReportOn::Library);
    executor.run_all();
    window.run_steps(2);
    let folder = parent.path().join("Chromascope library");
    let said = &window.state().view.status.text;
    assert_eq!(*said, format!("Report saved: {}.", folder.join("datapackage.json").display()));
    let text = std::fs::read_to_string(folder.join("datapackage.json")).unwrap();
    let described: serde_json::Value = serde_json::from_str(&text).unwrap();
    let resources = described["resources"].as_array().unwrap();
    assert!(resources.len() > 300);
    for resource in resources {
        let file = folder.join(resource["path"].as_str().unwrap());
        assert_eq!(std::fs::metadata(&file).unwrap().len(), resource["bytes"].as_u64().unwrap(), "{}", file.display());
    }
}

#[test]
fn a_report_on_a_comparison_is_one_page_that_needs_no_other_file() {
    let parent = tempfile::tempdir().unwrap();
    let executor = Executor::driven();
    let mut window = begun_on(&executor, parent.path(), ReportOn::Comparison);
    executor.run_all();
    window.run_steps(2);
    let folder = parent.path().join("Chromascope report");
    let mut names: Vec<_> = std::fs::read_dir(&folder).unwrap().map(|entry| entry.unwrap().file_name()).collect();
    names.sort();
    assert_eq!(names, [RANKING, PAGE]);
    let page = std::fs::read_to_string(folder.join(PAGE)).unwrap();
    let reported = FIGURES.iter().filter(|kind| kind.is_reported);
    for kind in reported.clone() {
        assert!(page.contains(&format!("<figure id=\"{}\">", kind.key)), "{}: {page}", kind.key);
    }
    assert_eq!(page.matches("<svg").count(), reported.count());
    assert!(
        !page.replace("href=\"data:", "").contains("href=") && !page.contains("<script") && !page.contains("Missing")
    );
    let cameras = Document::paper().compared.into_iter().filter(|of| of.kind == SetKind::Camera);
    assert!(
        cameras.clone().count() > 1 && cameras.into_iter().all(|of| page.contains(&format!("<td>{}</td>", of.name)))
    );
}
