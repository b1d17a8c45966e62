//! The Correction pane and the document's correction.

use chromascope::action::{Action, SceneAction};
use chromascope::command::Command;
use chromascope::document::correction::CorrectionChoice;
use chromascope::document::{Document, FIT_TARGET, TRAINING, TransformChoice};
use chromascope::workspaces::PaneKind;
use chromascope_core::correction::CorrectionMethod;
use egui_kittest::kittest::Queryable as _;

use crate::screenshots::open_with;
use crate::waiting::until;

const PANE: PaneKind = PaneKind::new("Correction");

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
