//! Filters in front of the light, whites and isotherms, and the pane that judges the light.

use chromascope::action::history::History;
use chromascope::action::{Action, SceneAction};
use chromascope::catalog::Catalog;
use chromascope::document::imported::Role;
use chromascope::document::{Document, Light, Overlays, SetKind, session};
use chromascope::figures;
use chromascope::figures::look::FigureLook;
use chromascope::results::Results;
use chromascope::scene::Scene;
use chromascope::workspaces::PaneKind;
use chromascope_figure::FigureRoom;
use egui_kittest::kittest::Queryable as _;

use crate::screenshots::open_with;

fn with<R>(document: &Document, ask: impl FnOnce(&Scene<'_>) -> R) -> R {
    let (catalog, results) = (Catalog::built_in(), Results::default());
    ask(&Scene { document, catalog: &catalog, results: &results })
}

fn filtered(filters: &[&str]) -> Document {
    let mut document = Document::colorimetry();
    document.filters = filters.iter().map(|name| (*name).to_owned()).collect();
    document
}

#[test]
fn a_filter_multiplies_the_light_of_every_comparison() {
    let plain = with(&filtered(&[]), |scene| scene.light().unwrap());
    let half = with(&filtered(&["ND 0.3"]), |scene| {
        assert_eq!(scene.light_name(), "D65 × ND 0.3");
        assert_eq!(scene.conditions()[1].1, "D65 × ND 0.3");
        scene.light().unwrap()
    });
    for (a, b) in plain.grid.values().iter().zip(half.grid.values()) {
        assert!((a * 0.501_187_233_627_272_2 - b).abs() < 1e-9 * a, "{a} {b}");
    }
    // A gray filter changes no color, a colored one does, and tables and pictures see it alike.
    let camera = (SetKind::Camera, "Kodak DCS200");
    let colors = |document: &Document| with(document, |scene| scene.patch_colors(camera.0, camera.1).unwrap());
    let [none, gray, warm] = [&[][..], &["ND 0.3"], &["Warming 131 mired"]].map(|filters| colors(&filtered(filters)));
    let far = |a: &[chromascope_core::query::PatchColor], b: &[chromascope_core::query::PatchColor]| {
        a.iter().zip(b).map(|(a, b)| (a.xy.unwrap().x - b.xy.unwrap().x).abs()).fold(0.0, f64::max)
    };
    assert!(far(&none, &gray) < 1e-12);
    assert!(far(&none, &warm) > 0.01);
    let lights = [&["ND 0.3", "Warming 131 mired"][..], &["Warming 131 mired", "ND 0.3"]]
        .map(|filters| with(&filtered(filters), |scene| scene.light().unwrap().grid));
    assert_eq!(lights[0], lights[1], "the order changes no bit");
    let rendered = with(&filtered(&["Warming 131 mired"]), |scene| {
        scene.rendering_of(SetKind::Observer, &scene.document.reference).unwrap().light
    });
    assert_eq!(rendered, with(&filtered(&["Warming 131 mired"]), |scene| scene.light().unwrap().grid));
}

#[test]
fn a_filter_that_is_missing_is_named() {
    let error = with(&filtered(&["Lost"]), |scene| scene.light().unwrap_err().to_string());
    assert!(error.contains("no filter is named \"Lost\""), "{error}");
}

#[test]
fn filters_are_saved_and_undone() {
    let mut history = History::new(Document::colorimetry());
    let add = |name: &str| Action::Scene(SceneAction::SetFilter(name.to_owned(), true));
    history.apply(&add("ND 0.3"));
    history.apply(&add("ND 0.6"));
    history.apply(&add("ND 0.3"));
    assert_eq!(history.document().filters, ["ND 0.6", "ND 0.3"], "once each");
    let json = session::to_json(history.document()).unwrap();
    assert_eq!(session::from_json(&json).unwrap().filters, history.document().filters);
    assert_eq!(history.undo_name(), Some("Add filter ND 0.3"));
    history.undo();
    assert_eq!(history.document().filters, ["ND 0.3", "ND 0.6"]);
    history.apply(&Action::Scene(SceneAction::ClearFilters));
    assert!(history.document().filters.is_empty());
    assert!(!session::to_json(history.document()).unwrap().contains("filters"), "old programs read it as before");
}

#[test]
fn an_imported_transmittance_is_a_filter() {
    let text = b"nm,Transmittance\n380,0.1\n500,0.5\n780,0.9\n";
    let set = chromascope::catalog::import::import("gel.csv", text, None).unwrap().set;
    assert_eq!(set.role, Role::Transmittance);
    let mut document = Document::colorimetry();
    let name = set.name.clone();
    crate::import_sets(vec![set]).apply(&mut document);
    assert!(document.filters.is_empty(), "it waits in the library");
    let used = chromascope::action::ImportedAction::Use(SetKind::Filter, name.clone());
    Action::Imported(used).apply(&mut document);
    assert_eq!(document.filters, std::slice::from_ref(&name));
    with(&document, |scene| {
        let (light, d65) = (scene.light().unwrap(), with(&Document::colorimetry(), |scene| scene.light().unwrap()));
        assert!((light.grid.values()[120] / d65.grid.values()[120] - 0.5).abs() < 1e-12);
        assert_eq!(scene.chart_entry(&name).unwrap().kind, SetKind::Filter, "as patches it can still be seen");
    });
    let remove = chromascope::action::ImportedAction::Remove(name);
    Action::Imported(remove).apply(&mut document);
    assert!(document.filters.is_empty() && document.light == Light::Set("D65".to_owned()));
}

#[test]
fn whites_and_isotherms_are_drawn_where_they_belong() {
    let mut document = Document::colorimetry();
    let marks = |document: &Document| {
        with(document, |scene| figures::chromaticity::build(scene, &FigureLook::default(), [600.0, 400.0]).panel.marks)
    };
    let names = |document: &Document| marks(document).iter().map(|mark| mark.name.clone()).collect::<Vec<_>>();
    assert!(!names(&document).iter().any(|name| name.starts_with("white") || name.starts_with("isotherm")));
    document.overlays = Overlays { whites: true, isotherms: true, ..document.overlays };
    let found = names(&document);
    for name in ["white A", "white D50", "white D55", "white E", "light D65", "isotherm 5000 K"] {
        assert!(found.iter().any(|found| found == name), "{name}");
    }
    // CIE 15: A is at x 0.4476, y 0.4074, to its four decimals of the sum over 380-780 nm.
    let white = marks(&document).into_iter().find(|mark| mark.name == "white A").unwrap();
    let chromascope_figure::Shape::Points { points, .. } = white.shape else { panic!("a point") };
    assert!((points[0][0] - 0.4476).abs() < 2e-4 && (points[0][1] - 0.4074).abs() < 2e-4, "{points:?}");
}

#[test]
fn the_pane_says_all_and_why_not() {
    let shown = |document: Document| {
        let mut window = open_with(document, [1280.0, 800.0], egui::Theme::Dark);
        window.state_mut().view.show(PaneKind::LIGHT);
        window.run();
        window.state().later.wait();
        window.run();
        window
    };
    let mut document = Document::colorimetry();
    document.light = Light::Set("FL2".to_owned());
    let window = shown(document.clone());
    // Independent values: see tests/core/rendition.rs.
    window.get_by_label("Ra 64.2   Rf 70.1   Rg 86.4   SSI 62");
    window.get_by_label("Color rendering indices as bars, and color vectors");
    let figure = with(&document, |scene| {
        figures::light::KIND.figure(scene, &FigureLook::default(), FigureRoom::default()).unwrap()
    });
    assert_eq!(figure.panels.len(), 2);
    assert!(figure.table.rows.len() > 60);
    // A light without temperature: reasons instead of numbers.
    document.filters = vec!["Long-pass 600".to_owned(), "Infrared cut 660".to_owned()];
    document.light = Light::Set("E".to_owned());
    let window = shown(document);
    window.get_by_label_contains("No Ra: no reference illuminant");
    assert!(window.query_by_label("Color rendering indices as bars, and color vectors").is_none());
}
