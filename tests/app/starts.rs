//! The two named starts; what a change of reference or color transform does; the names of differences.

use chromascope::action::{Action, CompareAction, RenderAction, SceneAction};
use chromascope::app::ChromascopeApp;
use chromascope::catalog::Catalog;
use chromascope::command::Command;
use chromascope::document::start::Start;
use chromascope::document::{
    CIE_1931, Diagram, Document, Light, PAPER_REFERENCE, SetKind, Subset, TransformChoice, WhiteBalanceChoice, session,
};
use chromascope::figures::look::FigureLook;
use chromascope::results::Results;
use chromascope::scene::{Caution, Scene};
use chromascope::workspaces::PaneKind;
use chromascope_core::colorimetry::lab::lab_from_xyz;
use chromascope_core::colorimetry::{Lab, Metric, Xyz, delta_e_2000};
use chromascope_core::query::PatchColor;
use chromascope_figure::FigureRoom;
use egui::accesskit::Role;
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable as _;

use crate::screenshots::open_with;

const SIZE: [f32; 2] = [1280.0, 800.0];

fn document(window: &Harness<'static, ChromascopeApp>) -> Document {
    window.state().history.document().clone()
}

fn refer_to(name: &str, counts_in_xyz: bool) -> Action {
    Action::Compare(CompareAction::SetReference { name: name.to_owned(), counts_in_xyz })
}

fn fit_to(name: &str) -> Action {
    Action::Scene(SceneAction::SetTransform(TransformChoice::Observer(name.to_owned())))
}

#[test]
fn colorimetry_is_the_default_and_says_what_it_is() {
    let document = Document::default();
    assert_eq!(document, Start::Colorimetry.document());
    assert_eq!((document.reference.as_str(), &document.light), (CIE_1931, &Light::Set("D65".to_owned())));
    assert_eq!(document.transform, TransformChoice::Observer(CIE_1931.to_owned()));
    assert_eq!((document.subset, document.difference), (Subset::All, Metric::DELTA_E_2000));
    let paper = Document::paper();
    assert_eq!((paper.reference.as_str(), &paper.light), (PAPER_REFERENCE, &Light::Set("E".to_owned())));
    assert_eq!((&paper.transform, paper.subset, paper.difference), (&TransformChoice::Paper, Subset::Five, Metric::XY));
}

#[test]
fn every_sensor_of_both_starts_is_built_in_and_compares() {
    let (catalog, results) = (Catalog::built_in(), Results::default());
    for start in Start::ALL {
        let document = start.document();
        let scene = Scene { document: &document, catalog: &catalog, results: &results };
        assert_eq!(scene.caution(), None);
        for (name, kind) in start.sensors() {
            let colors = scene.patch_colors(*kind, name).unwrap();
            assert_eq!(colors.len(), if start == Start::Paper { 5 } else { 24 });
        }
        for source in scene.sources().iter().filter(|source| source.kind == SetKind::Camera) {
            let differences = scene.differences(source.kind, &source.name).unwrap();
            assert!(differences.iter().all(|d| d.is_ok_and(|d| d > 0.0)), "{}: {differences:?}", source.name);
        }
    }
}

#[test]
fn a_start_is_one_click_away_and_a_reset_goes_back_to_it() {
    let mut window = open_with(Document::default(), SIZE, egui::Theme::Dark);
    window.get_by_role_and_label(Role::Button, "The 2007 paper").click();
    window.run();
    assert_eq!(document(&window), Document::paper());
    window.state_mut().push(Action::Scene(SceneAction::SetSubset(Subset::All)));
    window.run();
    window.state_mut().push(Action::Reset);
    window.run();
    assert_eq!(document(&window), Document::paper());
    window.get_by_role_and_label(Role::Button, "Colorimetry").click();
    window.run();
    assert_eq!(document(&window), Document::colorimetry());
}

#[test]
fn the_start_is_kept_between_runs() {
    let json = session::to_json(&Document::paper()).unwrap();
    assert_eq!(session::from_json(&json).unwrap().start, Start::Paper);
}

#[test]
fn a_document_of_version_1_is_the_papers_with_its_cameras_under_their_present_names() {
    let json = r#"{"format": "chromascope", "version": 1, "compared": [
        {"name": "Stiles & Burch 1955 2°", "kind": "observer", "slot": 0},
        {"name": "Nikon D70", "kind": "camera", "slot": 1},
        {"name": "Canon EOS 10D", "kind": "camera", "slot": 0, "label": "mine"}],
        "way": "paper", "difference": "delta-e2000", "kept": 7}"#;
    let document = session::from_json(json).unwrap();
    assert_eq!((document.start, &document.transform), (Start::Paper, &TransformChoice::Paper));
    assert_eq!((document.reference.as_str(), &document.light), (PAPER_REFERENCE, &Light::Set("E".to_owned())));
    assert!(document.compared(SetKind::Camera, "Nikon D70 (2007 figure)").is_some());
    let canon = document.compared(SetKind::Camera, "Canon EOS 10D (2007 figure)").unwrap();
    assert_eq!((canon.slot, canon.label.as_deref()), (0, Some("mine")));
    assert_eq!(document.difference, Metric::XY, "what was called ΔE*00 under Eq 13 was none");
    assert_eq!(document.unknown.get("kept").and_then(serde_json::Value::as_u64), Some(7));
    let again = session::from_json(&session::to_json(&document).unwrap()).unwrap();
    assert_eq!(again, document);
}

#[test]
fn eq_13_has_no_delta_e() {
    let paper = Document::paper();
    assert_eq!(Metric::DELTA_E_2000.name(paper.transform.is_eq_13()), "Δ of Eq 13 colors");
    assert!(!paper.transform.metrics()[0].needs_adopted_white());
    let fitted = TransformChoice::Observer(CIE_1931.to_owned());
    assert_eq!(Metric::DELTA_E_2000.name(fitted.is_eq_13()), "ΔE*00");
    assert_eq!(fitted.metrics()[0], Metric::DELTA_E_2000);

    let mut document = Document::paper();
    fit_to(CIE_1931).apply(&mut document);
    assert_eq!(document.difference, Metric::DELTA_E_2000);
    Action::Scene(SceneAction::SetDifference(Metric::UV_PRIME)).apply(&mut document);
    fit_to("CIE 1964 10°").apply(&mut document);
    assert_eq!(document.difference, Metric::UV_PRIME, "a choice under one fit holds under the next");
    document.diagram = Diagram::UvPrime;
    document.difference = Metric::by_id("delta-e1976").unwrap();
    Action::Scene(SceneAction::SetTransform(TransformChoice::Paper)).apply(&mut document);
    assert_eq!(document.difference, Metric::UV_PRIME, "the distance in the diagram that is shown");
}

#[test]
fn a_measure_that_was_chosen_stays_and_a_distance_follows_the_diagram() {
    let mut document = Document::colorimetry();
    Action::Scene(SceneAction::SetDifference(Metric::UV_PRIME)).apply(&mut document);
    Action::Scene(SceneAction::SetTransform(TransformChoice::Paper)).apply(&mut document);
    assert_eq!(document.difference, Metric::UV_PRIME);
    fit_to(CIE_1931).apply(&mut document);
    assert_eq!(document.difference, Metric::UV_PRIME);
    let mut document = Document::paper();
    Action::Scene(SceneAction::SetDiagram(Diagram::UvPrime)).apply(&mut document);
    assert_eq!(document.difference, Metric::UV_PRIME);
    Action::Scene(SceneAction::SetDifference(Metric::DELTA_E_2000)).apply(&mut document);
    Action::Scene(SceneAction::SetDiagram(Diagram::Xy)).apply(&mut document);
    assert_eq!(document.difference, Metric::DELTA_E_2000, "what was chosen stays");
}

#[test]
fn figure_8_is_the_same_after_the_papers_own() {
    let mut document = Document::paper();
    Action::Render(RenderAction::Figure8).apply(&mut document);
    let first = document.clone();
    Action::Render(RenderAction::PaperFigure8).apply(&mut document);
    assert_ne!(document.render, first.render);
    Action::Render(RenderAction::Figure8).apply(&mut document);
    assert_eq!(document.render, first.render);
}

/// True if a control in the window contains these words.
fn says(window: &Harness<'static, ChromascopeApp>, words: &str) -> bool {
    window.query_all_by_label_contains(words).next().is_some()
}

#[test]
fn under_eq_13_no_figure_says_delta_e_00() {
    let mut document = Document::paper();
    document.difference = Metric::DELTA_E_2000;
    let (catalog, results) = (Catalog::built_in(), Results::default());
    let scene = Scene { document: &document, catalog: &catalog, results: &results };
    let figure =
        chromascope::figures::swatches::KIND.figure(&scene, &FigureLook::default(), FigureRoom::default()).unwrap();
    assert!(figure.caption.contains("Δ of Eq 13 colors") && !figure.caption.contains("ΔE"), "{}", figure.caption);
    let mut window = open_with(document, SIZE, egui::Theme::Light);
    window.run();
    assert!(!says(&window, "ΔE*00") && says(&window, "Δ of Eq 13 colors"));
}

#[test]
fn a_cie_reference_under_eq_13_offers_the_fit() {
    let mut window = open_with(Document::paper(), SIZE, egui::Theme::Dark);
    window.state_mut().push(refer_to(CIE_1931, true));
    window.run();
    assert!(says(&window, "cameras cannot be compared with it"));
    assert!(matches!(document(&window).transform, TransformChoice::Paper), "nothing changes by itself");
    let buttons: Vec<_> = window.query_all_by_role_and_label(Role::Button, "Fit 3×3 to CIE 1931 2°").collect();
    assert_eq!(buttons.len(), 2, "in Chromaticity and in Swatches");
    buttons[0].click();
    drop(buttons);
    window.run();
    assert_eq!(document(&window).transform, TransformChoice::Observer(CIE_1931.to_owned()));
    assert_eq!(document(&window).difference, Metric::DELTA_E_2000);
    assert!(!says(&window, "cannot be compared with"));
}

#[test]
fn the_fit_follows_the_reference_and_a_difference_of_the_two_is_said() {
    let mut window = open_with(Document::colorimetry(), SIZE, egui::Theme::Dark);
    window.state_mut().push(refer_to("CIE 1964 10°", true));
    window.run();
    assert_eq!(document(&window).transform, TransformChoice::Observer("CIE 1964 10°".to_owned()));
    assert_eq!(document(&window).compared(SetKind::Observer, CIE_1931).map(|c| c.visible), Some(true));
    window.state_mut().push(fit_to(CIE_1931));
    window.run();
    assert!(says(&window, "Compared with CIE 1964 10°, but the color transform is fitted to CIE 1931 2°."));
    window.query_all_by_role_and_label(Role::Button, "Fit 3×3 to CIE 1964 10°").next().unwrap().click();
    window.run();
    assert_eq!(document(&window).transform, TransformChoice::Observer("CIE 1964 10°".to_owned()));
    // Stiles & Burch is RGB: nothing can be fitted to it, so the fit stays and its target is named.
    window.state_mut().push(refer_to(PAPER_REFERENCE, false));
    window.run();
    assert_eq!(document(&window).transform, TransformChoice::Observer("CIE 1964 10°".to_owned()));
    assert!(says(&window, "Compared with Stiles & Burch 1955 2°, but"));
    assert!(window.query_by_role_and_label(Role::Button, "Fit 3×3 to Stiles & Burch 1955 2°").is_none());
}

#[test]
fn a_caution_names_its_remedy() {
    let caution = Caution::NotComparable { reference: CIE_1931.to_owned() };
    assert_eq!(caution.fit_to(), Some(CIE_1931));
    let target = || "CIE 1964 10°".to_owned();
    let differs = |can_fit| Caution::FitDiffers { target: target(), reference: PAPER_REFERENCE.to_owned(), can_fit };
    assert_eq!((differs(false).fit_to(), differs(true).fit_to()), (None, Some(PAPER_REFERENCE)));
}

/// All patches of the chart through the reference and the D70 under D55.
fn balanced(white: WhiteBalanceChoice, transform: TransformChoice) -> [Vec<PatchColor>; 2] {
    let light = Light::Set("D55".to_owned());
    let document = Document { subset: Subset::All, light, white, transform, ..Document::paper() };
    let (catalog, results) = (Catalog::built_in(), Results::default());
    let scene = Scene { document: &document, catalog: &catalog, results: &results };
    let camera = scene.patch_colors(SetKind::Camera, "Nikon D70 (2007 figure)").unwrap();
    [scene.patch_colors(SetKind::Observer, PAPER_REFERENCE).unwrap(), camera]
}

fn mean_difference([reference, camera]: &[Vec<PatchColor>; 2], lab: impl Fn(&PatchColor) -> Lab) -> f64 {
    let pairs = reference.iter().zip(camera);
    pairs.map(|(a, b)| delta_e_2000(lab(a), lab(b))).sum::<f64>() / reference.len() as f64
}

#[test]
fn the_adopted_white_follows_the_white_balance_target() {
    let d65 = Xyz::new(0.9505, 1.0, 1.089);
    let fixed = |color: &PatchColor| lab_from_xyz(color.xyz, d65).unwrap();
    let followed = |color: &PatchColor| color.lab.unwrap();
    // (target, mean relative to a fixed D65, mean relative to the target)
    let expected =
        [(WhiteBalanceChoice::Unity, 2.976, 2.976), (light("D55"), 2.874, 2.892), (light("A"), 2.197, 2.443)];
    for (white, before, now) in expected {
        let colors = balanced(white.clone(), TransformChoice::Paper);
        assert!((mean_difference(&colors, fixed) - before).abs() < 2e-3, "{white:?}");
        assert!((mean_difference(&colors, followed) - now).abs() < 2e-3, "{white:?}");
        // A gray is gray under every target: the chart's neutral 5 has a chroma below 2 in the reference's own L*a*b*.
        let gray = colors[0][21].lab.unwrap();
        assert!(gray.a.hypot(gray.b) < 2.0, "{white:?}: {gray:?}");
    }
    let fitted = |white| mean_difference(&balanced(white, TransformChoice::Observer(CIE_1931.to_owned())), followed);
    assert!((fitted(WhiteBalanceChoice::Unity) - fitted(light("A"))).abs() < 1e-9, "the matrix compensates");
}

fn light(name: &str) -> WhiteBalanceChoice {
    WhiteBalanceChoice::Light(name.to_owned())
}

#[test]
fn numbers_that_leave_the_window_say_under_what_they_were_made() {
    let mut window = open_with(Document::colorimetry(), SIZE, egui::Theme::Dark);
    for pane in [PaneKind::CHROMATICITY, PaneKind::SWATCHES] {
        window.state_mut().push(Command::CopyNumbers(pane));
        window.step();
        let commands = &window.output().platform_output.commands;
        let text = commands.iter().find_map(|command| match command {
            egui::OutputCommand::CopyText(text) => Some(text.clone()),
            _ => None,
        });
        let text = text.expect("numbers were copied");
        let mut lines = text.lines();
        assert!(lines.next().unwrap().ends_with("reference\tilluminant\twhite_balance\ttransform\tpreset"));
        let under = "CIE 1931 2°\tD65\tunity\t3x3 fitted to CIE 1931 2°\tcolorimetry";
        assert!(lines.all(|line| line.ends_with(under)), "{pane:?}");
    }
}
