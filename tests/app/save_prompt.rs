//! Tests of the path prompt where the system has no file dialog: Enter saves, existing files must be confirmed, typed text is
//! never lost.

use std::fs;

use chromascope::action::history::History;
use chromascope::app::ChromascopeApp;

use chromascope::atomic::write_with;
use chromascope::catalog::import::{Origin, import_as};
use chromascope::command::Command;
use chromascope::document::imported::ImportOverrides;
use chromascope::document::{Document, SetKind};
use chromascope::export::FigureForm;
use chromascope::export::spectra::Form;
use chromascope::files::Files;
use chromascope::view::Shows;
use chromascope::view::{SavedView, Weight};
use chromascope::workspaces::PaneKind;
use chromascope_measure::Workload;
use egui::accesskit::Role;
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable as _;
use spectral_file::Watch;

use crate::cpu_renderer::Cpu;
use crate::import_switches::{Window, says, until};
use crate::waiting;

/// The window without the system's dialogs.
fn window() -> Window {
    let mut window =
        Harness::builder().with_size([1280.0, 800.0]).with_pixels_per_point(1.0).renderer(Cpu::default()).build_eframe(
            |cc| {
                let history = History::new(Document::paper());
                ChromascopeApp::new(&cc.egui_ctx, history, SavedView::default(), Files::new(None).without_dialogs())
            },
        );
    window.run();
    window
}

fn save_as(window: &mut Window, name: &str, form: Form) {
    window.state_mut().push(Command::SaveSet(SetKind::Camera, name.to_owned(), form));
    window.run_steps(2);
    until_asked(window, &format!("Save {name} as {}", form.name()));
}

/// Draws frames until the prompt says what is saved.
fn until_asked(window: &mut Window, question: &str) {
    waiting::until(question, || {
        window.run_steps(1);
        if says(window, question) { Ok(()) } else { Err("no such question".to_owned()) }
    });
    window.run_steps(2);
}

/// CSV at the wavelengths of a set, or on the first of the grids.
fn csv(index: usize) -> Form {
    Form::all().nth(index).unwrap()
}

fn typed(window: &Window) -> String {
    window.get_by_role_and_label(Role::TextInput, "Path").value().unwrap_or_default()
}

fn type_path(window: &mut Window, path: &str) {
    window.key_press_modifiers(egui::Modifiers::COMMAND, egui::Key::A);
    window.run_steps(1);
    window.get_by_role_and_label(Role::TextInput, "Path").type_text(path);
    window.run_steps(2);
    assert_eq!(typed(window), path);
}

fn said(window: &mut Window, what: &str) {
    until(window, what, |app| app.view.status.text.starts_with(what));
}

#[test]
fn enter_saves_and_what_exists_is_asked_about() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("camera.csv");
    fs::write(&path, "mine").unwrap();
    let mut window = window();
    save_as(&mut window, "Nikon D70 (2007 figure)", csv(0));
    assert_eq!(typed(&window), "Nikon D70 (2007 figure).csv");
    type_path(&mut window, path.to_str().unwrap());
    window.key_press(egui::Key::Enter);
    window.run_steps(4);
    assert!(says(&window, "That file exists"));
    assert_eq!(fs::read_to_string(&path).unwrap(), "mine");
    window.key_press(egui::Key::Enter);
    said(&mut window, "Saved ");
    assert!(fs::read_to_string(&path).unwrap().starts_with("wavelength_nm,"));
    let beside = folder.path().join("camera.csv-metadata.json");
    assert!(fs::read_to_string(&beside).unwrap().contains("\"source\": "));
    let set = import_as(
        &Origin::on_disk("camera.csv", &path, b""),
        &fs::read(&path).unwrap(),
        &ImportOverrides::default(),
        Watch::none(),
    );
    assert_eq!(set.unwrap().set.name, "Nikon D70 (2007 figure)");
    assert!(window.query_by_role_and_label(Role::TextInput, "Path").is_none());
}

/// A table and its metadata are written both or neither, and no other's metadata is lost.
#[test]
fn a_set_and_what_describes_it_go_together() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("camera.csv");
    let beside = folder.path().join("camera.csv-metadata.json");
    fs::write(&beside, "another's").unwrap();
    let mut window = window();
    save_as(&mut window, "Nikon D70 (2007 figure)", csv(0));
    type_path(&mut window, path.to_str().unwrap());
    window.key_press(egui::Key::Enter);
    window.run_steps(4);
    assert!(says(&window, "camera.csv-metadata.json exists: choose another name."));
    assert!(!path.exists() && fs::read_to_string(&beside).unwrap() == "another's");
    for before in [Some("another's"), None] {
        if before.is_none() {
            fs::remove_file(&beside).unwrap();
        }
        // Whether the other file is written or removed, it comes back; one that cannot be written ends it before that.
        let other = folder.path().join("camera.cov.csv");
        for text in [Some("new".to_owned()), None] {
            fs::write(&other, "4").unwrap();
            let files = [(beside.clone(), Some("new".to_owned())), (other.clone(), text)];
            let failed = write_with(&files, |_, error| error, || Err(std::io::ErrorKind::StorageFull.into()));
            assert_eq!(failed.map_err(|error| error.kind()), Err(std::io::ErrorKind::StorageFull));
            assert_eq!(fs::read_to_string(&beside).ok().as_deref(), before);
            assert_eq!(fs::read_to_string(&other).unwrap(), "4");
        }
        let nowhere = (folder.path().join("none/camera.cov.csv"), Some("4".to_owned()));
        let files = [(beside.clone(), Some("new".to_owned())), nowhere];
        let failed = write_with(&files, |_, error| error, || panic!("the table of files that cannot be written"));
        assert!(failed.is_err());
        assert_eq!(fs::read_to_string(&beside).ok().as_deref(), before);
        fs::remove_file(&other).unwrap();
    }
}

#[test]
fn a_second_question_keeps_what_was_typed() {
    let mut window = window();
    save_as(&mut window, "Nikon D70 (2007 figure)", csv(0));
    save_as(&mut window, "Canon EOS 10D (2007 figure)", csv(0));
    assert_eq!(typed(&window), "Canon EOS 10D (2007 figure).csv", "what was only offered goes");
    type_path(&mut window, "/somewhere/x.csv");
    save_as(&mut window, "Kodak DCS200", csv(1));
    assert_eq!(typed(&window), "/somewhere/x.csv");
    // The field has the keyboard: typing goes on.
    window.event(egui::Event::Text("y".to_owned()));
    window.run_steps(2);
    assert!(typed(&window).contains('y'), "{}", typed(&window));
    window.state_mut().push(Command::Open);
    window.run_steps(3);
    assert!(says(&window, "Save Kodak DCS200 as"), "opening does not take the question away");
}

#[test]
fn another_kind_of_file_takes_its_own_ending() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("m.svg");
    fs::write(&path, "mine").unwrap();
    let mut window = window();
    let ask = |window: &mut Window, form: FigureForm| {
        window.state_mut().push(Command::Export(PaneKind::SPECTRA, form));
        until_asked(window, &format!("Save Spectra as {}", form.label()));
    };
    ask(&mut window, FigureForm::Svg);
    type_path(&mut window, path.to_str().unwrap());
    window.key_press(egui::Key::Enter);
    window.run_steps(4);
    assert!(says(&window, "That file exists"));
    ask(&mut window, FigureForm::Csv);
    let csv = folder.path().join("m.csv");
    assert_eq!(typed(&window), csv.to_str().unwrap());
    assert!(!says(&window, "That file exists"));
    window.key_press(egui::Key::Enter);
    said(&mut window, "Saved ");
    assert_eq!(fs::read_to_string(&path).unwrap(), "mine");
    assert!(fs::read_to_string(&csv).unwrap().contains(','));
}

#[test]
fn a_workload_is_offered_by_its_name() {
    let report = crate::bench::report();
    let mut window = window();
    window.state_mut().view.shows = Shows::Bench(Workload::DiffuseSum);
    let measured = &mut window.state_mut().profiler.measured;
    measured.reports.insert(Workload::DiffuseSum, std::sync::Arc::new(Ok(report)));
    window.state_mut().push(Command::Export(PaneKind::METHODS, FigureForm::Csv));
    window.run_steps(8);
    assert_eq!(typed(&window), "diffuse-sum.csv");
}

#[test]
fn what_could_not_be_written_can_be_typed_again() {
    let folder = tempfile::tempdir().unwrap();
    let wrong = folder.path().join("no such folder").join("x.csv");
    let mut window = window();
    save_as(&mut window, "Nikon D70 (2007 figure)", csv(0));
    type_path(&mut window, wrong.to_str().unwrap());
    window.key_press(egui::Key::Enter);
    said(&mut window, "Cannot write ");
    assert_eq!(window.state().view.status.weight, Weight::Error);
    assert_eq!(typed(&window), wrong.to_str().unwrap());
    let right = folder.path().join("x.csv");
    type_path(&mut window, right.to_str().unwrap());
    window.key_press(egui::Key::Enter);
    said(&mut window, "Saved ");
    assert!(right.exists());
}

#[test]
fn escape_closes_the_question_and_a_folder_is_no_file() {
    let folder = tempfile::tempdir().unwrap();
    let mut window = window();
    save_as(&mut window, "Nikon D70 (2007 figure)", csv(0));
    type_path(&mut window, folder.path().to_str().unwrap());
    window.key_press(egui::Key::Enter);
    window.run_steps(4);
    assert!(says(&window, "is a folder: add a name") && !says(&window, "That file exists"));
    window.key_press(egui::Key::Escape);
    window.run_steps(3);
    assert!(window.query_by_role_and_label(Role::TextInput, "Path").is_none());
}
