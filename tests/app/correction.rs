//! The Correction pane and the document's correction.

use std::collections::BTreeSet;
use std::path::PathBuf;
use std::sync::{Arc, Mutex};

use chromascope::action::history::History;
use chromascope::action::{Action, SceneAction};
use chromascope::app::ChromascopeApp;
use chromascope::command::Command;
use chromascope::document::correction::CorrectionChoice;
use chromascope::document::{Document, FIT_TARGET, SetKind, TRAINING, TransformChoice};
use chromascope::files::{Answer, Dialogs, Files, Question};
use chromascope::jobs::Executor;
use chromascope::plot_item::PlotItem;
use chromascope::view::SavedView;
use chromascope::workspaces::PaneKind;
use chromascope_core::correction::CorrectionMethod;
use egui::accesskit::Role;
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable as _;

use crate::cpu_renderer::Cpu;
use crate::screenshots::open_with;
use crate::waiting::until;

const PANE: PaneKind = PaneKind::CORRECTION;

#[test]
fn old_documents_open_with_the_former_fit_and_new_ones_come_back() {
    let document = Document::colorimetry();
    let saved = serde_json::to_value(&document).unwrap();
    assert!(saved.get("correction").is_none(), "a document without a choice is saved as before");
    let choice = CorrectionChoice {
        method: CorrectionMethod::by_id("root-polynomial-3").unwrap(),
        keeps_white: false,
        training: "mine".to_owned(),
        weights: [2.0, 1.0, 0.5, 1.0],
        second_light: Some("A".to_owned()),
    };
    let document = Document { correction: choice, ..document };
    let back: Document = serde_json::from_value(serde_json::to_value(&document).unwrap()).unwrap();
    assert_eq!(back, document);
    let unknown = serde_json::json!({ "correction": { "method": "magic" } });
    assert!(serde_json::from_value::<Document>(unknown).unwrap_err().to_string().contains("magic"));
}

#[test]
fn choosing_a_correction_leaves_eq_13() {
    let mut document = Document::paper();
    let choice = CorrectionChoice { method: CorrectionMethod::None, ..CorrectionChoice::default() };
    Action::Scene(SceneAction::SetCorrection(choice.clone())).apply(&mut document);
    assert_eq!(document.transform, TransformChoice::Observer(FIT_TARGET.to_owned()));
    assert_eq!(document.correction, choice);
    assert_eq!(document.correction.training, TRAINING);
}

#[test]
fn the_pane_shows_matrix_errors_and_checks() {
    let mut document = Document::colorimetry();
    document.correction.second_light = Some("A".to_owned());
    let mut harness = open_with(document, [900.0, 1600.0], egui::Theme::Dark);
    harness.state_mut().push(Command::Maximize(PANE));
    until("the correction", || {
        harness.step();
        let shown = harness.query_all_by_label_contains("leave-one-out").next().is_some();
        if shown { Ok(()) } else { Err("no errors are shown".to_owned()) }
    });
    for words in ["leave-one-out", "ColorMatrix1", "ForwardMatrix2", "450 nm", "ACES IDT", "DCP…"] {
        assert!(harness.query_all_by_label_contains(words).next().is_some(), "{words}");
    }
}

/// Saves to a folder under the name that is offered.
struct Saves(PathBuf, Mutex<Vec<PathBuf>>);

impl Dialogs for Saves {
    fn ask(&self, question: &Question) -> Answer {
        let Question::Save { name, .. } = question else { return Answer::Cancelled };
        let path = self.0.join(name);
        self.1.lock().unwrap().push(path.clone());
        Answer::Chosen(vec![path])
    }
}

#[test]
fn each_kind_of_file_is_saved_from_the_pane() {
    let folder = tempfile::tempdir().unwrap();
    let dialogs = Arc::new(Saves(folder.path().to_owned(), Mutex::default()));
    let files = Files::new(None).with_dialogs(dialogs.clone());
    let mut harness = Harness::builder().with_size([900.0, 1600.0]).renderer(Cpu::default()).build_eframe(move |cc| {
        let history = History::new(Document::colorimetry());
        ChromascopeApp::on(&Executor::default(), &cc.egui_ctx, history, SavedView::default(), files)
    });
    harness.state_mut().push(Command::Maximize(PANE));
    until("the correction", || {
        harness.step();
        harness.query_by_label("DCP…").map(|_| ()).ok_or_else(|| "no buttons".to_owned())
    });
    let begins: [(&str, usize, &[u8]); 6] = [
        ("DCP…", 0, b"IIRC"),
        ("ICC v4…", 36, b"acsp"),
        ("ICC v2…", 36, b"acsp"),
        ("ACES CLF…", 0, b"<?xml"),
        ("DNG text…", 0, b"UniqueCameraModel: Canon EOS 5D Mark II"),
        ("Text…", 0, b"Canon EOS 5D Mark II"),
    ];
    for (count, (button, at, expected)) in begins.into_iter().enumerate() {
        harness.get_by_label(button).click();
        until(button, || {
            harness.step();
            let saved = dialogs.1.lock().unwrap().get(count).cloned();
            let bytes = saved.and_then(|path| std::fs::read(path).ok()).filter(|bytes| bytes.len() > 100);
            let bytes = bytes.ok_or_else(|| "nothing is written".to_owned())?;
            assert_eq!(&bytes[at..at + expected.len()], expected, "{button}");
            Ok(())
        });
    }
    let endings: Vec<_> = dialogs.1.lock().unwrap().iter().map(|path| path.extension().unwrap().to_owned()).collect();
    assert_eq!(endings, ["dcp", "icc", "icc", "clf", "txt", "txt"]);
    let names: BTreeSet<PathBuf> = dialogs.1.lock().unwrap().iter().cloned().collect();
    assert_eq!(names.len(), 6, "each has a name of its own");
}

/// Opens the pane with a camera that is not compared.
fn pane_of(camera: &str, size: [f32; 2]) -> Harness<'static, ChromascopeApp> {
    let mut harness = open_with(Document::colorimetry(), size, egui::Theme::Dark);
    harness.state_mut().view.selected = Some(PlotItem::of_set(SetKind::Camera, camera));
    harness.state_mut().push(Command::Maximize(PANE));
    harness
}

fn shows(harness: &mut Harness<'static, ChromascopeApp>, words: &str) {
    until(words, || {
        harness.step();
        let shown = harness.query_all_by_label_contains(words).next().is_some();
        if shown { Ok(()) } else { Err("it is not shown".to_owned()) }
    });
}

#[test]
fn a_camera_of_the_library_is_corrected_without_being_compared() {
    let mut harness = pane_of("Nikon D850", [900.0, 1600.0]);
    shows(&mut harness, "UniqueCameraModel: Nikon D850");
    harness.get_by_label("Camera: Nikon D850").click();
    harness.run_steps(3);
    harness.get_by_role_and_label(Role::TextInput, "Filter Camera").type_text("rebel");
    harness.run_steps(2);
    harness.key_press(egui::Key::Enter);
    shows(&mut harness, "UniqueCameraModel: Canon EOS 400D DIGITAL");
}

#[test]
fn every_tab_and_the_files_are_of_the_camera_selected_in_rank() {
    let mut harness = open_with(Document::colorimetry(), [1280.0, 800.0], egui::Theme::Dark);
    harness.state_mut().view.show(PANE);
    shows(&mut harness, "UniqueCameraModel: Canon EOS 5D Mark II");
    harness.state_mut().view.selected = Some(PlotItem::of_set(SetKind::Camera, "Kodak DCS200"));
    harness.step();
    assert!(harness.query_all_by_label_contains("UniqueCameraModel: Canon").next().is_none(), "of another camera");
    shows(&mut harness, "UniqueCameraModel: Kodak DCS200");
    harness.get_by_label("File").click();
    shows(&mut harness, "Color correction of Kodak DCS200");
    harness.key_press(egui::Key::Escape);
    for pane in [PaneKind::REPORT_CARD, PANE] {
        harness.state_mut().view.show(pane);
        shows(&mut harness, "Camera: Kodak DCS200");
    }
}

#[test]
fn a_lost_channel_ratio_is_said_and_mended_in_the_pane() {
    let mut harness = pane_of("Nikon D5100", [900.0, 1600.0]);
    shows(&mut harness, "Channel ratio lost: each channel is scaled to the same maximum");
    shows(&mut harness, "hold that ratio: give AsShotNeutral");
    harness.get_by_role_and_label(Role::TextInput, "Neutral").focus();
    harness.step();
    harness.get_by_role_and_label(Role::TextInput, "Neutral").type_text("0.47,1,0.72");
    shows(&mut harness, "AsShotNeutral (D65): 0.470000 1.000000 0.720000");
    assert!(harness.query_all_by_label_contains("Channel ratio lost").next().is_none());
}

#[test]
fn corrections_are_saved_from_every_menu() {
    let mut harness = open_with(Document::colorimetry(), [1280.0, 800.0], egui::Theme::Dark);
    harness.get_by_label("File").click();
    shows(&mut harness, "Color correction of ");
    harness.key_press(egui::Key::Escape);
    for (typed, found) in
        [("dcp", "DCP…"), ("icc", "ICC v2…"), ("clf", "ACES CLF…"), ("save matrix", "DNG text…"), ("profile", "DCP…")]
    {
        harness.state_mut().push(Command::FindAnything);
        harness.run_steps(3);
        harness.get_by_role_and_label(Role::TextInput, "Find anything").type_text(typed);
        shows(&mut harness, &format!("Save the color correction as {found}"));
        harness.state_mut().push(Command::Escape);
        harness.step();
    }
    harness.state_mut().push(Command::Maximize(PANE));
    shows(&mut harness, "Export Correction");
    harness.get_by_label("Export Correction").click();
    until("the share menu", || {
        harness.step();
        let count = harness.query_all_by_label("ICC v2…").count();
        if count == 2 { Ok(()) } else { Err(format!("{count} in the pane and the menu")) }
    });
}
