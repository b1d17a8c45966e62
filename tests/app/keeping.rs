//! Keeping the document: with every change, whatever a path or a number in it is, while the disk refuses, beside other windows.

use std::ffi::OsString;
use std::fs;
use std::os::unix::ffi::OsStringExt as _;
use std::path::{Path, PathBuf};
use std::time::Duration;

use chromascope::action::history::History;
use chromascope::action::{Action, ImportedAction, SceneAction};
use chromascope::app::ChromascopeApp;
use chromascope::catalog::import::import;
use chromascope::catalog::meshes::{MeshState, MeshStore};
use chromascope::command::Command;
use chromascope::document::imported::{Fingerprint, ImportedSet};
use chromascope::document::render::MeshChoice;
use chromascope::document::{Document, session};
use chromascope::files::{Files, PersistentMessageKind};
use chromascope::jobs::Executor;
use chromascope::view::SavedView;
use egui::ViewportCommand;
use egui::accesskit::Role;
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable as _;

use crate::cpu_renderer::Cpu;
use crate::import_switches::{Window, says};
use crate::waiting::until;

mod disk;
mod windows;

const LEAF: &str = "# quantity: reflectance\nnm,leaf\n400,0.05\n500,0.1\n600,0.2\n700,0.5\n";

/// A profile folder, within one that is removed afterwards.
fn profile() -> (tempfile::TempDir, PathBuf) {
    let around = tempfile::tempdir().unwrap();
    let folder = around.path().join("chromascope");
    fs::create_dir(&folder).unwrap();
    (around, folder)
}

fn open(folder: &Path) -> Files {
    Files::new(Some(folder.to_owned()))
}

fn of(kelvin: f64) -> Document {
    Document { temperature_k: kelvin, ..Document::paper() }
}

fn set(name: &str) -> ImportedSet {
    // From a file of its own, or it would be the same set as another.
    let fingerprint = Some(Fingerprint::of(name.as_bytes()));
    ImportedSet { name: name.to_owned(), fingerprint, ..import("leaf.csv", LEAF.as_bytes(), None).unwrap().set }
}

fn with_sets(sets: Vec<ImportedSet>) -> Document {
    let mut document = Document::paper();
    crate::import_sets(sets).apply(&mut document);
    document
}

/// The document that a next window begins with.
fn saved_document(folder: &Path) -> Document {
    open(folder).saved_document()
}

fn words(files: &Files, kind: PersistentMessageKind) -> Option<String> {
    files.standing().into_iter().find(|standing| standing.kind == kind).map(|standing| standing.words)
}

fn names(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).into_iter().flatten().flatten();
    let mut names: Vec<String> = entries.map(|entry| entry.file_name().to_string_lossy().into_owned()).collect();
    names.sort();
    names
}

fn window_with(executor: &Executor, document: Document, files: Files) -> Window {
    let mut window =
        Harness::builder().with_size([1280.0, 800.0]).with_pixels_per_point(1.0).renderer(Cpu::default()).build_eframe(
            |cc| ChromascopeApp::on(executor, &cc.egui_ctx, History::new(document), SavedView::default(), files),
        );
    window.run_steps(2);
    window
}

/// The program on a profile, with an executor that the test drives.
fn window(folder: &Path) -> (Executor, Window) {
    let executor = Executor::driven();
    let mut files = Files::on(&executor, Some(folder.to_owned())).without_dialogs();
    let document = files.saved_document();
    let window = window_with(&executor, document, files);
    (executor, window)
}

fn change(window: &mut Window, kelvin: f64) {
    window.state_mut().push(Action::Scene(SceneAction::SetTemperature(kelvin)));
    window.run_steps(1);
}

// ---- Paths and numbers ----

fn latin_1() -> OsString {
    OsString::from_vec(b"caf\xe9.csv".to_vec())
}

#[test]
fn a_path_that_is_not_utf_8_is_kept_as_it_is() {
    let (_around, folder) = profile();
    let path = Path::new("/measured").join(latin_1());
    let mut document = with_sets(vec![ImportedSet { path: Some(path.clone()), ..set("coffee") }, set("leaf")]);
    document.render.mesh = MeshChoice::File(path.clone());
    open(&folder).save_document(&document).unwrap();
    assert_eq!(saved_document(&folder), document);
    let json = session::to_json(&document).unwrap();
    assert_eq!(session::from_json(&json).unwrap(), document);
    // Other paths stay readable, and documents of before are read.
    document.own.clear();
    document.render.mesh = MeshChoice::File(PathBuf::from("/measured/head.obj"));
    let json = session::to_json(&document).unwrap();
    assert!(json.contains("\"/measured/head.obj\""), "{json}");
    // The view, which eframe writes in a form of its own.
    let view = SavedView { recent: vec![path, PathBuf::from("/measured/leaf.csv")], ..SavedView::default() };
    let ron = ron::to_string(&view).unwrap();
    assert_eq!(ron::from_str::<SavedView>(&ron).unwrap(), view);
}

#[test]
fn a_mesh_whose_path_is_not_utf_8_is_shown() {
    let (_around, folder) = profile();
    let path = folder.join(OsString::from_vec(b"caf\xe9.obj".to_vec()));
    fs::write(&path, "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").unwrap();
    let store = MeshStore::on(&Executor::default(), || {});
    until("the mesh", || match store.get(&path) {
        MeshState::Ready(_) => Ok(()),
        other => Err(format!("{other:?}")),
    });
}

#[test]
fn a_number_that_json_does_not_have_costs_no_document() {
    let (_around, folder) = profile();
    let mut odd = set("odd");
    odd.curves[0].values[1] = f64::NAN;
    odd.curves[0].values[2] = f64::INFINITY;
    let document = with_sets(vec![odd, set("leaf")]);
    open(&folder).save_document(&document).unwrap();
    let again = saved_document(&folder);
    assert_eq!(again.own.len(), 2);
    assert_eq!(again.own[1], document.own[1]);
    assert!(again.own[0].curves[0].values[1].is_nan());
    assert!(session::from_json(&session::to_json(&document).unwrap()).is_ok());
}

#[test]
fn numbers_are_read_back_to_the_last_bit() {
    let mut leaf = set("leaf");
    let values = &mut leaf.curves[0].values;
    // Multiples of an irrational number: all digits matter.
    *values = (1..=500).map(|i| (f64::from(i) * std::f64::consts::SQRT_2).fract()).collect();
    leaf.curves[0].wavelengths = (1..=500).map(|i| 300.0 + f64::from(i) / 3.0).collect();
    let document = with_sets(vec![leaf]);
    assert_eq!(session::from_json(&session::to_json(&document).unwrap()).unwrap(), document);
    let (_around, folder) = profile();
    open(&folder).save_document(&document).unwrap();
    assert_eq!(saved_document(&folder), document);
}

// ---- Sets beside the document ----

#[test]
fn curves_are_written_once_and_a_change_costs_little() {
    let (_around, folder) = profile();
    let mut files = open(&folder);
    files.saved_document();
    let mut leaf = set("leaf");
    leaf.curves[0].values = (0..100_000).map(|i| f64::from(i).sqrt()).collect();
    leaf.curves[0].wavelengths = (0..100_000).map(|i| 300.0 + f64::from(i) / 100.0).collect();
    let mut document = with_sets(vec![leaf, set("twig")]);
    files.save_document(&document).unwrap();
    let curves = names(&folder.join("curves"));
    assert_eq!(curves.len(), 1, "one file for all that came at once: {curves:?}");
    let size = |name: &str| fs::metadata(folder.join(name)).unwrap().len();
    assert!(size("document.json") < 10_000 && size(&format!("curves/{}", curves[0])) > 1_000_000);
    // Another temperature, another name: neither writes the curves again.
    document.temperature_k = 3000.0;
    files.save_document(&document).unwrap();
    let renamed = ImportedSet { name: "branch".to_owned(), ..(*document.own[0]).clone() };
    Action::Imported(ImportedAction::Replace {
        name: "leaf".to_owned(),
        with: Box::new(renamed),
        built_in: crate::built_in_names(),
    })
    .apply(&mut document);
    files.save_document(&document).unwrap();
    assert_eq!(names(&folder.join("curves")), curves);
    drop(files);
    assert_eq!(saved_document(&folder), document);
}

#[test]
fn a_document_that_holds_its_curves_is_taken_apart() {
    let (_around, folder) = profile();
    let document = with_sets(vec![set("leaf"), set("twig")]);
    let mut json: serde_json::Value = serde_json::from_str(&session::to_json(&document).unwrap()).unwrap();
    json["version"] = 2.into();
    fs::write(folder.join("document.json"), json.to_string()).unwrap();
    let mut files = open(&folder);
    assert_eq!(files.saved_document(), document);
    files.save_document(&document).unwrap();
    assert_eq!(names(&folder.join("curves")).len(), 1);
    // The version before opens what it wrote.
    assert_eq!(fs::read_to_string(folder.join("document-version-2.json")).unwrap(), json.to_string());
    drop(files);
    assert_eq!(saved_document(&folder), document);
}

#[test]
fn a_set_whose_curves_are_gone_costs_only_itself() {
    let (_around, folder) = profile();
    let mut document = with_sets(vec![set("leaf")]);
    let mut files = open(&folder);
    files.save_document(&document).unwrap();
    let first = names(&folder.join("curves"));
    let mut twig = set("twig");
    twig.curves[0].values[0] = 0.25;
    crate::import_sets(vec![twig]).apply(&mut document);
    files.save_document(&document).unwrap();
    drop(files);
    fs::write(folder.join("curves").join(&first[0]), "[[").unwrap();
    let before = fs::read(folder.join("document.json")).unwrap();
    let mut files = open(&folder);
    let again = files.saved_document();
    assert_eq!(again.own.iter().map(|set| set.name.as_str()).collect::<Vec<_>>(), ["twig"]);
    let said = words(&files, PersistentMessageKind::SetAside).unwrap();
    assert!(said.contains("leaf") && said.contains("document-unreadable-1.json"), "{said}");
    assert_eq!(fs::read(folder.join("document-unreadable-1.json")).unwrap(), before);
}

#[test]
fn a_set_that_cannot_be_written_does_not_stop_the_rest() {
    let (_around, folder) = profile();
    let executor = Executor::driven();
    let mut files = Files::on(&executor, Some(folder.clone()));
    let document = files.saved_document();
    // In the place of the folder of curves there is a file.
    fs::write(folder.join("curves"), "").unwrap();
    let mut document = Document { temperature_k: 4321.0, ..document };
    crate::import_sets(vec![set("leaf")]).apply(&mut document);
    let why = files.save_document(&document).unwrap_err();
    assert!(why.starts_with("leaf could not be saved (") && why.ends_with("; the rest is"), "{why}");
    assert_eq!(
        session::from_json(&fs::read_to_string(folder.join("document.json")).unwrap()).unwrap().temperature_k,
        4321.0
    );
    assert!(words(&files, PersistentMessageKind::NotSaved).is_some_and(|words| words.contains("leaf")));
    // It is tried again until it is.
    fs::remove_file(folder.join("curves")).unwrap();
    executor.advance(Duration::from_secs(2));
    files.autosave(&document, &egui::Context::default());
    executor.run_all();
    assert_eq!(words(&files, PersistentMessageKind::NotSaved), None);
    drop(files);
    assert_eq!(saved_document(&folder), document);
}

// ---- Documents that cannot be read ----

#[test]
fn each_document_that_cannot_be_read_is_set_aside_under_a_name_of_its_own() {
    let (_around, folder) = profile();
    let whole = session::to_json(&Document::paper()).unwrap();
    let mut invalid = whole.clone().into_bytes();
    invalid[20] = 0xFF;
    let truncated = whole.as_bytes()[..whole.len() / 2].to_vec();
    let newer = whole.replace("\"version\": 4", "\"version\": 99").into_bytes();
    for (index, (broken, why)) in
        [(invalid, "not text"), (truncated, "EOF"), (newer, "newer version of Chromascope")].into_iter().enumerate()
    {
        fs::write(folder.join("document.json"), &broken).unwrap();
        let mut files = open(&folder);
        assert_eq!(files.saved_document(), Document::default());
        let aside = folder.join(format!("document-unreadable-{}.json", index + 1));
        let said = words(&files, PersistentMessageKind::SetAside).unwrap();
        assert!(said.contains(why) && said.contains(&aside.display().to_string()), "{said}");
        files.save_document(&of(3000.0)).unwrap();
        assert_eq!(fs::read(&aside).unwrap(), broken);
        assert!(words(&files, PersistentMessageKind::SetAside).is_some(), "it stays");
        files.dismiss(PersistentMessageKind::SetAside);
        assert_eq!(words(&files, PersistentMessageKind::SetAside), None);
    }
}

#[test]
fn a_sentence_about_the_document_stays_until_it_is_dismissed() {
    let (_around, folder) = profile();
    fs::write(folder.join("document.json"), b"\xff").unwrap();
    let (_executor, mut window) = window(&folder);
    let sentence = "The last document could not be read";
    window.state_mut().view.say("Something else.");
    window.run_steps(2);
    assert!(says(&window, sentence));
    window.get_by_role_and_label(Role::Button, "Dismiss").click();
    window.run_steps(2);
    assert!(!says(&window, sentence));
}

// ---- Saving while someone works, and while the disk refuses ----

#[test]
fn changes_without_pause_are_on_disk_within_a_second() {
    let (_around, folder) = profile();
    let (executor, mut window) = window(&folder);
    let mut writes = 0;
    for step in 0..100 {
        let kelvin = 3000.0 + f64::from(step);
        change(&mut window, kelvin);
        while executor.run_one("keep") {
            writes += 1;
        }
        executor.advance(Duration::from_millis(50));
        let text = fs::read_to_string(folder.join("document.json")).unwrap();
        let age = kelvin - session::from_json(&text).unwrap().temperature_k;
        assert!(age * 50.0 < 1000.0, "{age} changes of 50 ms are not on disk");
    }
    assert!((10..=40).contains(&writes), "{writes} writes in 5 s");
}

/// Takes a folder away, and puts a file in its place.
fn vanish(folder: &Path) -> PathBuf {
    let away = folder.with_extension("away");
    fs::rename(folder, &away).unwrap();
    fs::write(folder, "").unwrap();
    away
}

fn come_back(folder: &Path, away: &Path) {
    fs::remove_file(folder).unwrap();
    fs::rename(away, folder).unwrap();
}

#[test]
fn a_failed_save_is_said_and_tried_again_until_it_succeeds() {
    let (_around, folder) = profile();
    let (executor, mut window) = window(&folder);
    change(&mut window, 3333.0);
    executor.run_one("keep");
    let away = vanish(&folder);
    change(&mut window, 3456.0);
    let mut tries = 0;
    for _ in 0..100 {
        while executor.run_one("keep") {
            tries += 1;
        }
        executor.advance(Duration::from_millis(100));
        window.run_steps(1);
    }
    assert!((4..=6).contains(&tries), "{tries} in 10 s");
    assert!(says(&window, "Changes are not saved: "));
    come_back(&folder, &away);
    executor.advance(Duration::from_secs(2));
    window.run_steps(1);
    while executor.run_one("keep") {}
    window.run_steps(2);
    assert!(!says(&window, "Changes are not saved: "));
    drop(window);
    assert_eq!(saved_document(&folder).temperature_k, 3456.0);
    assert!(open(&folder).other_documents().is_empty(), "what stood there was this window's own");
}

#[test]
fn a_folder_that_cannot_be_written_is_told_at_the_start() {
    let around = tempfile::tempdir().unwrap();
    fs::write(around.path().join("file"), "").unwrap();
    let (_executor, mut window) = window(&around.path().join("file").join("chromascope"));
    assert!(says(&window, "Saving is not possible: "));
    assert!(!close(&mut window), "nothing was changed, so nothing is lost");
}

/// Requests the window to close. Returns whether it stayed open.
fn close(window: &mut Window) -> bool {
    let root = window.input_mut().viewports.entry(egui::ViewportId::ROOT).or_default();
    root.events.push(egui::ViewportEvent::Close);
    window.step();
    sent(window, &ViewportCommand::CancelClose)
}

fn sent(window: &Window, command: &ViewportCommand) -> bool {
    window.output().viewport_output[&egui::ViewportId::ROOT].commands.contains(command)
}

fn click(window: &mut Window, button: &str) -> bool {
    window.get_by_role_and_label(Role::Button, button).click();
    (0..3).any(|_| {
        window.step();
        sent(window, &ViewportCommand::Close)
    })
}

const QUESTION: &str = "Your changes are not saved";

#[test]
fn closing_asks_while_changes_are_not_saved() {
    let (_around, folder) = profile();
    let (_executor, mut window) = window(&folder);
    assert!(!close(&mut window), "all is saved");
    let away = vanish(&folder);
    change(&mut window, 3456.0);
    assert!(close(&mut window));
    window.run_steps(2);
    assert!(says(&window, QUESTION));
    assert!(!click(&mut window, "Cancel"));
    assert!(!says(&window, QUESTION));
    assert!(close(&mut window));
    window.run_steps(2);
    assert!(click(&mut window, "Close without saving"));
    assert!(!close(&mut window), "it was agreed to");
    come_back(&folder, &away);
}

/// Waits until a document has taken the place of the one before.
fn opens(executor: &Executor, window: &mut Window, document: &Document) {
    until("the document", || {
        executor.run_all();
        window.run_steps(1);
        let now = Document { session: None, ..window.state().history.document().clone() };
        if now == *document { Ok(()) } else { Err(window.state().view.status.text.clone()) }
    });
}

#[test]
fn what_cannot_be_saved_is_saved_elsewhere_and_opened_from_there() {
    let (around, folder) = profile();
    let (_executor, mut window) = window(&folder);
    let away = vanish(&folder);
    window.state_mut().push(crate::import_sets(vec![set("leaf")]));
    change(&mut window, 3456.0);
    assert!(close(&mut window));
    window.run_steps(2);
    assert!(!click(&mut window, "Save elsewhere…"));
    let path = around.path().join("saved.chromascope");
    until("the question where to", || {
        window.run_steps(1);
        if says(&window, "Save the document") { Ok(()) } else { Err("it is not asked".to_owned()) }
    });
    window.run_steps(2);
    window.key_press_modifiers(egui::Modifiers::COMMAND, egui::Key::A);
    window.run_steps(1);
    window.get_by_role_and_label(Role::TextInput, "Path").type_text(path.to_str().unwrap());
    window.run_steps(1);
    window.key_press(egui::Key::Enter);
    until("the end", || {
        window.step();
        if sent(&window, &ViewportCommand::Close) { Ok(()) } else { Err("it is open".to_owned()) }
    });
    let document = window.state().history.document().clone();
    assert_eq!(session::from_json(&fs::read_to_string(&path).unwrap()).unwrap(), document);
    drop(window);
    come_back(&folder, &away);
    // In the next session it is opened like any file; what was there is kept.
    let (executor, mut window) = self::window(&folder);
    window.state_mut().push(Command::OpenPath(path));
    opens(&executor, &mut window, &document);
}
