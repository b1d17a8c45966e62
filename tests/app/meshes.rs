//! The user's meshes: recognized, read in the background, opened in one step, refused with a sentence.

use std::cell::Cell;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use chromascope::action::history::History;
use chromascope::app::ChromascopeApp;
use chromascope::catalog::meshes::{LoadedMesh, MeshFailure, MeshState, MeshStore, is_mesh, read};
use chromascope::command::Command;
use chromascope::document::render::MeshChoice;
use chromascope::document::{Document, session};
use chromascope::files::Files;
use chromascope::jobs::Executor;
use chromascope::view::{SavedView, Weight};
use chromascope::workspaces::{PaneKind, Workspace};
use egui_kittest::Harness;
use tempfile::TempDir;

use crate::cpu_renderer::Cpu;
use crate::own_data::Dropped;
use crate::screenshots::{driven, open};
use crate::waiting;

const SQUARE: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvn 0 0 1\nf 1//1 2//1 3//1 4//1\n";
const TRIANGLE: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n";
const BROKEN: &str = "v 0 0 0\nv 1 zero 0\nv 1 1 0\nf 1 2 3\n";

fn folder_with(name: &str, text: &str) -> (TempDir, PathBuf) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join(name);
    fs::write(&path, text).unwrap();
    (folder, path)
}

/// A wavy sheet with the given number of squares on a side, as text.
fn sheet(side: usize) -> String {
    use std::fmt::Write as _;
    let mut text = String::new();
    for (x, y) in (0..=side).flat_map(|y| (0..=side).map(move |x| (x, y))) {
        writeln!(text, "v {x} {y} {}", (x * y) % 7).unwrap();
    }
    for corner in (0..side).flat_map(|y| (0..side).map(move |x| y * (side + 1) + x + 1)) {
        let above = corner + side + 1;
        writeln!(text, "f {corner} {} {} {above}", corner + 1, above + 1).unwrap();
    }
    text
}

fn store() -> MeshStore {
    MeshStore::on(&Executor::default(), || {})
}

/// A store that reads when its driven executor runs.
fn driven_store() -> (Executor, MeshStore) {
    let executor = Executor::driven();
    let store = MeshStore::on(&executor, || {});
    (executor, store)
}

fn wait<T>(what: &str, mut found: impl FnMut() -> Option<T>) -> T {
    waiting::until(what, || found().ok_or_else(|| "not yet".to_owned()))
}

fn opened(store: &MeshStore, path: &Path) -> Result<Arc<LoadedMesh>, String> {
    store.open(path);
    let opened = wait("opening", || store.poll().pop());
    assert_eq!(opened.path, path);
    opened.result
}

fn settled(store: &MeshStore, path: &Path) -> MeshState {
    wait("reading", || Some(store.get(path)).filter(|state| !matches!(state, MeshState::Loading)))
}

fn window() -> Harness<'static, ChromascopeApp> {
    open([1280.0, 800.0], egui::Theme::Dark)
}

/// Draws frames until no mesh is being read and something was said about it.
fn until_opened(harness: &mut Harness<'static, ChromascopeApp>) -> (String, Weight) {
    harness.run_steps(1);
    wait("a word about the mesh", || {
        harness.run_steps(1);
        let status = &harness.state().view.status;
        let done = !status.text.is_empty() && harness.state().meshes.opening().is_none();
        (done && !status.text.starts_with("Reading")).then(|| (status.text.clone(), status.weight))
    })
}

fn mesh_shown(harness: &Harness<'static, ChromascopeApp>) -> MeshChoice {
    harness.state().history.document().render.mesh.clone()
}

#[test]
fn a_dropped_mesh_is_looked_at_in_one_step() {
    let (_folder, path) = folder_with("square.obj", SQUARE);
    let mut harness = window();
    harness.input_mut().dropped_files.push(Arc::new(Dropped(path.clone(), Vec::new())));
    let (text, weight) = until_opened(&mut harness);
    assert_eq!(text, "square.obj: 4 vertices, 2 triangles, open edges 4.");
    assert_eq!(weight, Weight::Note);
    assert_eq!(mesh_shown(&harness), MeshChoice::File(path.clone()));
    assert_eq!(harness.state().view.saved.recent, [path]);
    assert!(harness.state().view.is_shown(PaneKind::RENDER));
    assert_eq!(harness.state().history.undo_name(), Some("Open square.obj"));
    harness.state_mut().push(Command::Undo);
    harness.run_steps(2);
    assert_eq!(*harness.state().history.document(), Document::paper());
}

#[test]
fn what_should_be_known_about_a_mesh_is_said() {
    let (_folder, path) = folder_with("triangle.obj", TRIANGLE);
    let mut harness = window();
    harness.state_mut().push(Command::OpenPath(path));
    let (text, _) = until_opened(&mut harness);
    let notes = "No normals in the file; computed from the faces.";
    assert_eq!(text, format!("triangle.obj: 3 vertices, 1 triangle, open edges 3. {notes}"));
}

#[test]
fn a_mesh_that_cannot_be_read_changes_nothing() {
    let (_folder, path) = folder_with("broken.obj", BROKEN);
    let mut harness = window();
    harness.state_mut().push(Command::OpenPath(path));
    let (text, weight) = until_opened(&mut harness);
    assert!(text.starts_with("broken.obj, line 2, column 5: not a number"), "{text}");
    assert!(text.ends_with("Nothing was changed."), "{text}");
    assert_eq!(weight, Weight::Error);
    assert_eq!(*harness.state().history.document(), Document::paper());
    assert!(harness.state().view.saved.recent.is_empty());
    assert_eq!(harness.state().view.saved.workspace, Workspace::default());
}

#[test]
fn meshes_are_told_from_spectra_by_name_and_by_content() {
    for name in ["head.obj", "HEAD.OBJ", "a.ply", "b.stl"] {
        assert!(is_mesh(Path::new(name), b""), "{name}");
    }
    let meshes: [&[u8]; 4] = [
        b"# a square\n\ng one\nv 0 0 0\n",
        b"ply\r\nformat ascii 1.0\n",
        b"solid a\n  facet normal 0 0 1\n",
        b"\tv -1e3 .5 7 1 0 0\n",
    ];
    for text in meshes {
        assert!(is_mesh(Path::new("head.txt"), text) && is_mesh(Path::new("head"), text));
    }
    let spectra: [&[u8]; 5] =
        [b"nm,leaf\n400,0.1\n", b"v,one,two\n400 1 2\n", b"solid paint\n400 0.1\n", b"", b"v 400 0.1\n"];
    for text in spectra {
        assert!(!is_mesh(Path::new("leaf.csv"), text), "{}", String::from_utf8_lossy(text));
    }
}

#[test]
fn all_formats_are_opened() {
    let ply = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n\
        element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n1 1 0\n3 0 1 2\n";
    let stl = "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 1 1 0\nendloop\nendfacet\n\
        endsolid a\n";
    for (name, text) in [("a.obj", TRIANGLE), ("a.ply", ply), ("a.stl", stl)] {
        let (_folder, path) = folder_with(name, text);
        let mesh = opened(&store(), &path).unwrap_or_else(|error| panic!("{error}"));
        assert_eq!(mesh.summary, format!("{name}: 3 vertices, 1 triangle, open edges 3"));
    }
}

#[test]
fn a_mesh_of_another_ending_is_opened_as_a_mesh() {
    let (_folder, path) = folder_with("square.txt", SQUARE);
    let mut harness = window();
    harness.state_mut().push(Command::OpenPath(path.clone()));
    until_opened(&mut harness);
    assert_eq!(mesh_shown(&harness), MeshChoice::File(path));
}

#[test]
fn a_mesh_that_is_nowhere_on_disk_is_refused() {
    let mut harness = window();
    let nowhere = Dropped(PathBuf::from("square.obj"), SQUARE.into());
    harness.input_mut().dropped_files.push(Arc::new(nowhere));
    let (text, weight) = until_opened(&mut harness);
    assert!(text.contains("save it first") && weight == Weight::Error, "{text}");
    assert_eq!(*harness.state().history.document(), Document::paper());
}

#[test]
fn a_missing_mesh_is_named_with_what_to_do() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("gone.obj");
    let store = store();
    let MeshState::Failed(sentence) = settled(&store, &path) else { panic!("there is no such file") };
    assert!(sentence.starts_with("gone.obj is not in ") && sentence.ends_with("or choose Head or Fern."), "{sentence}");
    let refused = opened(&store, &path).unwrap_err();
    assert!(refused.ends_with("Nothing was changed."), "{refused}");
    fs::write(&path, TRIANGLE).unwrap();
    assert!(matches!(store.get(&path), MeshState::Failed(_)), "the disk is not watched");
    assert!(opened(&store, &path).is_ok());
    assert!(matches!(store.get(&path), MeshState::Ready(_)));
}

#[test]
fn a_session_with_a_missing_mesh_opens() {
    let mut document = Document::paper();
    document.render.mesh = MeshChoice::File(PathBuf::from("/no/such/head.obj"));
    let json = session::to_json(&document).unwrap();
    assert_eq!(session::from_json(&json).unwrap(), document);
    let mut harness = Harness::builder().with_size([1280.0, 800.0]).renderer(Cpu::default()).build_eframe(|cc| {
        let mut saved = SavedView::default();
        saved.layout.put(Workspace::Compare, 0, PaneKind::RENDER);
        ChromascopeApp::new(&cc.egui_ctx, History::new(document), saved, Files::new(None))
    });
    harness.run_steps(3);
    let MeshState::Failed(_) = settled(&harness.state().meshes, Path::new("/no/such/head.obj")) else {
        panic!("there is no such file");
    };
    harness.run_steps(3);
    assert_eq!(mesh_shown(&harness), MeshChoice::File(PathBuf::from("/no/such/head.obj")));
}

#[test]
fn a_changed_file_is_read_anew_and_an_unchanged_one_is_not() {
    let (_folder, path) = folder_with("mesh.obj", SQUARE);
    let store = store();
    let first = opened(&store, &path).unwrap();
    assert!(Arc::ptr_eq(&first, &opened(&store, &path).unwrap()));
    fs::write(&path, TRIANGLE).unwrap();
    let second = opened(&store, &path).unwrap();
    assert_eq!(second.mesh.triangles().len(), 1);
    fs::write(&path, BROKEN).unwrap();
    assert!(opened(&store, &path).unwrap_err().starts_with("mesh.obj, line 2"));
    let MeshState::Ready(kept) = store.get(&path) else { panic!("the mesh that was read stays") };
    assert!(Arc::ptr_eq(&kept, &second));
}

#[test]
fn reading_stops_when_it_is_no_longer_wanted() {
    let (_folder, path) = folder_with("sheet.obj", &sheet(300));
    let asked = Cell::new(0);
    let stop = || asked.replace(asked.get() + 1) >= 3;
    assert!(matches!(read(&path, &stop), Err(MeshFailure::Stopped(..))));
    assert_eq!(asked.get(), 4, "once stopped, it is not asked again");

    let (executor, store) = driven_store();
    store.open(&path);
    assert_eq!(store.opening(), Some(path.clone()));
    assert_eq!(store.cancel(), Some(path.clone()));
    assert_eq!(store.cancel(), None);
    executor.run_all();
    assert!(store.poll().is_empty());
    let MeshState::Failed(sentence) = store.get(&path) else { panic!("it was stopped") };
    assert_eq!(sentence, "Reading sheet.obj stopped; open it again, or choose Head or Fern.");
}

#[test]
fn the_mesh_opened_last_is_the_one_that_is_told() {
    let (folder, first) = folder_with("first.obj", SQUARE);
    let last = folder.path().join("last.obj");
    fs::write(&last, TRIANGLE).unwrap();
    let (executor, store) = driven_store();
    store.open(&first);
    store.open(&last);
    executor.run_all();
    let told: Vec<PathBuf> = store.poll().into_iter().map(|opened| opened.path).collect();
    assert_eq!(told, [last]);
}

#[test]
fn what_nobody_wants_is_not_read_to_its_end() {
    let (folder, path) = folder_with("sheet.obj", &sheet(300));
    let (executor, store) = driven_store();
    assert!(matches!(store.get(&path), MeshState::Loading));
    store.keep(Some(&folder.path().join("other.obj")));
    executor.run_all();
    // A mesh that had been read to its end would be there at once.
    assert!(matches!(store.get(&path), MeshState::Loading));
    store.keep(Some(&path));
    executor.run_all();
    assert!(matches!(store.get(&path), MeshState::Ready(_)));
    store.keep(None);
    assert!(matches!(store.get(&path), MeshState::Ready(_)), "small meshes are remembered");
}

#[test]
fn escape_stops_opening() {
    let (_folder, path) = folder_with("sheet.obj", SQUARE);
    let (executor, mut harness) = driven([1280.0, 800.0], egui::Theme::Dark);
    harness.state_mut().push(Command::OpenPath(path.clone()));
    harness.run_steps(1);
    assert!(executor.run_one("files"), "it is told from spectra");
    harness.run_steps(1);
    assert_eq!(harness.state().meshes.opening(), Some(path));
    assert!(harness.state().view.status.text.starts_with("Reading sheet.obj… Esc stops."));
    harness.state_mut().push(Command::Escape);
    harness.run_steps(2);
    executor.run_all();
    harness.run_steps(2);
    assert_eq!(harness.state().view.status.text, "Reading sheet.obj stopped. Nothing was changed.");
    assert_eq!(*harness.state().history.document(), Document::paper());
}

#[test]
fn a_file_that_is_too_large_is_refused_before_it_is_read() {
    let (_folder, path) = folder_with("huge.obj", "");
    fs::File::options().write(true).open(&path).unwrap().set_len(2_500_000_000).unwrap();
    let read_on = || panic!("a part of it was read");
    assert!(matches!(read(&path, &read_on), Err(MeshFailure::TooLarge { bytes: 2_500_000_000, .. })));
    let refused = opened(&store(), &path).unwrap_err();
    let why = "huge.obj: 2500 MB, but the limit is 1000 MB; simplify the mesh or export a part of it.";
    assert_eq!(refused, format!("{why} Nothing was changed."));
}

#[test]
fn what_is_no_file_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("folder.obj");
    fs::create_dir(&path).unwrap();
    assert_eq!(opened(&store(), &path).unwrap_err(), "folder.obj is not a file. Nothing was changed.");
    fs::write(folder.path().join("empty.obj"), "").unwrap();
    let refused = opened(&store(), &folder.path().join("empty.obj")).unwrap_err();
    assert!(refused.starts_with("empty.obj: the file is empty"), "{refused}");
}
