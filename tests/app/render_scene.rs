//! The rendered scene as it opens, and the pane of its settings, in which nothing jumps.

use std::collections::{BTreeMap, BTreeSet};

use chromascope::action::{Action, RenderAction, SceneAction};
use chromascope::app::ChromascopeApp;
use chromascope::catalog::Catalog;
use chromascope::command::Command;
use chromascope::document::render::{BALANCE, GARMENT, LEAF, MeshChoice, RenderSettings, SKY, SUN};
use chromascope::document::{Document, Light, session};
use chromascope::figures::chromaticity::id;
use chromascope::figures::render::patch_at;
use chromascope::render_service::RenderedFrame;
use chromascope::results::Results;
use chromascope::scene::Scene;
use chromascope::scene::orbit::Orbit;
use chromascope::view::PixelPlace;
use chromascope::workspaces::PaneKind;
use chromascope_core::query::render::MeshQuery;
use chromascope_core::reflectance::Normalization;
use chromascope_core::render::QualityLevel;
use chromascope_mesh::stage::Stage;
use egui::accesskit::Role;
use egui_kittest::Harness;
use egui_kittest::kittest::{NodeT as _, Queryable as _};

use crate::screenshots::open;

type Window = Harness<'static, ChromascopeApp>;

fn conditions(document: &Document) -> [String; 2] {
    let (catalog, results) = (Catalog::built_in(), Results::default());
    Scene { document, catalog: &catalog, results: &results }.rendered_conditions()
}

#[test]
fn it_opens_under_sun_and_sky_whatever_light_is_chosen_elsewhere() {
    // The paper's light is a point: no sky.
    for (mut document, sky) in [(Document::colorimetry(), SKY), (Document::paper(), 0.0)] {
        assert_eq!(conditions(&document), [SUN, BALANCE]);
        assert_eq!(document.render.sky, sky);
        Action::Scene(SceneAction::SetTemperature(4000.0)).apply(&mut document);
        assert_eq!(conditions(&document)[0], SUN);
        Action::Scene(SceneAction::SetLight(Light::Set("A".to_owned()))).apply(&mut document);
        assert_eq!(conditions(&document)[0], SUN, "a light chosen elsewhere is not that of the pictures");
    }
}

#[test]
fn the_figures_have_no_sky() {
    for (action, thin) in [
        (RenderAction::Figure8, false),
        (RenderAction::Figure9, true),
        (RenderAction::PaperFigure8, false),
        (RenderAction::PaperFigure9, false),
    ] {
        let mut document = Document::colorimetry();
        Action::Render(action).apply(&mut document);
        assert_eq!((document.render.sky, document.render.thin), (0.0, thin));
        assert_eq!(conditions(&document), [SUN, BALANCE]);
    }
}

#[test]
fn a_session_saved_before_has_neither_sky_nor_light_of_its_own() {
    let mut saved: serde_json::Value = serde_json::to_value(Document::colorimetry()).unwrap();
    let settings = saved["render"].as_object_mut().unwrap();
    for field in ["sky", "thin", "sunlight", "garment"] {
        assert!(settings.remove(field).is_some(), "{field}");
    }
    let opened = session::from_json(&saved.to_string()).unwrap();
    assert_eq!((opened.render.sky, opened.render.thin, opened.render.sunlight), (0.0, false, false));
    assert_eq!(opened.render.garment, None);
}

#[test]
fn the_head_wears_a_garment_but_in_the_papers_figures() {
    let (catalog, results) = (Catalog::built_in(), Results::default());
    let meshes = |document: &Document| Scene { document, catalog: &catalog, results: &results }.mesh_of(None).unwrap();
    let mut document = Document::colorimetry();
    let triangles = document.render.triangles;
    assert_eq!(document.render.worn(), Some(GARMENT));
    let stage = Stage { patches: 24, ground: true, hair: true, cropped: true };
    assert_eq!(meshes(&document), MeshQuery::Staged(Box::new(MeshQuery::ClothedHead(triangles)), stage));
    assert!(document.render.materials().ends_with(", garment: Faded jeans 076 (Vrhel)"));
    document.render.take(MeshChoice::Fern);
    assert_eq!(document.render.worn(), None, "only the head wears one");
    for figure in [RenderAction::Figure8, RenderAction::PaperFigure8] {
        let mut document = Document::colorimetry();
        Action::Render(figure).apply(&mut document);
        assert_eq!((document.render.worn(), meshes(&document)), (None, MeshQuery::Head(triangles)));
    }
    let paper = Document::paper();
    assert_eq!((paper.render.worn(), meshes(&paper)), (None, MeshQuery::Head(triangles)));
}

#[test]
fn each_patch_of_the_chart_in_the_picture_is_told_by_its_pixels() {
    let (document, catalog, results) = (Document::colorimetry(), Catalog::built_in(), Results::default());
    let scene = Scene { document: &document, catalog: &catalog, results: &results };
    let viewpoint = Orbit::of(&document.render).viewpoint(1.0).unwrap();
    let frame = RenderedFrame::of_mesh(&scene, scene.mesh_of(None).unwrap(), viewpoint, 120).unwrap();
    let source = id(&frame.sources[1]);
    let at = |index: u32| [index % 120, index / 120].map(|v| (f64::from(v) + 0.5) / 120.0);
    let of = |index| patch_at(&scene, &frame, &PixelPlace { at: at(index), source: source.clone() });
    let found: BTreeSet<String> = (0..120 * 120).filter_map(of).collect();
    let names: BTreeSet<String> = scene.patches().unwrap().patches().iter().map(|patch| patch.name.clone()).collect();
    assert_eq!(found, names);
}

#[test]
fn another_mesh_comes_with_its_own_material_unless_one_was_chosen() {
    let mut settings = RenderSettings::default();
    settings.take(MeshChoice::Fern);
    assert_eq!((settings.material.as_str(), settings.index, settings.thin), (LEAF, 1.45, true));
    settings.take(MeshChoice::Head);
    assert_eq!(settings, RenderSettings::default());
    "Grass 025 (Vrhel)".clone_into(&mut settings.material);
    settings.take(MeshChoice::Fern);
    assert_eq!(settings.material, "Grass 025 (Vrhel)");
}

fn render(window: &mut Window, change: impl FnOnce(&mut RenderSettings)) {
    let mut to = window.state().history.document().render.clone();
    change(&mut to);
    window.state_mut().push(Action::Render(RenderAction::Set { what: "Test", to: Box::new(to) }));
    window.run_steps(2);
}

/// Where the controls of the settings stand.
fn places(window: &Window) -> BTreeMap<String, [i32; 4]> {
    let names = [
        "Triangles",
        "Light elevation",
        "Light azimuth",
        "Sky",
        "Light distance",
        "Roughness σ",
        "Correlation τ",
        "Index n",
        "Exposure",
        "Field of view",
    ];
    let sliders = names.map(|name| (name.to_owned(), window.get_by_role_and_label(Role::Slider, name).rect()));
    let lists = window.query_all_by_role(Role::ComboBox).filter_map(|node| {
        let label = node.accesskit_node().label()?;
        let (name, _) = label.split_once(": ")?;
        ["Mesh", "Material", "Garment", "Normalization", "Coherent component", "Quality"]
            .contains(&name)
            .then(|| (name.to_owned(), node.rect()))
    });
    let whole =
        |rect: egui::Rect| [rect.left(), rect.top(), rect.right(), rect.bottom()].map(|side| side.round() as i32);
    sliders.into_iter().chain(lists).map(|(name, rect)| (name, whole(rect))).collect()
}

#[test]
fn nothing_in_the_settings_jumps_when_values_change() {
    let mut window = open([1280.0, 1400.0], egui::Theme::Light);
    window.state_mut().view.show(PaneKind::RENDER);
    render(&mut window, |settings| settings.mesh = MeshChoice::Sphere);
    render(&mut window, |settings| settings.triangles = 2000);
    window.state().render_service.wait();
    window.run_steps(2);
    let before = places(&window);
    assert_eq!(before.len(), 16, "{before:?}");
    let widths: Vec<i32> =
        before.values().filter(|rect| rect[2] - rect[0] < 150).map(|rect| rect[2] - rect[0]).collect();
    assert!(widths.is_empty(), "sliders and lists are as wide as the pane: {widths:?}");
    let changes: [fn(&mut RenderSettings); 9] = [
        |settings| settings.sigma_um = 0.02,
        |settings| settings.sigma_um = 123.0,
        |settings| settings.tau_um = 0.01,
        |settings| settings.normalization = Normalization::Lambertian,
        |settings| settings.normalization = Normalization::Microfacet,
        |settings| settings.light_distance = Some(2.0),
        |settings| settings.quality = QualityLevel::Tolerance,
        |settings| settings.mesh = MeshChoice::Plane,
        |settings| settings.sky = 0.0,
    ];
    for (index, change) in changes.into_iter().enumerate() {
        render(&mut window, change);
        assert_eq!(places(&window), before, "change {index}");
    }
    window.state().render_service.wait();
    window.run_steps(2);
    let source = window.state().render_service.frame().map(|frame| frame.sources[0].clone()).unwrap();
    let source = chromascope::plot_item::SensorId { kind: source.kind, name: source.name };
    window.state_mut().view.render.pinned = Some(PixelPlace { at: [0.5, 0.5], source });
    window.run_steps(2);
    assert_eq!(places(&window), before, "a pinned pixel");
}

#[test]
fn pictures_of_what_moves_do_not_wait_until_it_is_known_where_the_mesh_hides_the_sky() {
    let (executor, mut window) =
        crate::screenshots::driven_with(Document::colorimetry(), [1280.0, 800.0], egui::Theme::Light);
    window.state_mut().view.show(PaneKind::RENDER);
    window.run_steps(3);
    let known = |executor: &chromascope::jobs::Executor| {
        executor.results().counts().get("sky visibility").map_or(0, |count| count.misses)
    };
    // The open sky is one answer, the sky that the mesh hides another.
    assert!(executor.run_one("pictures"));
    window.run_steps(2);
    assert!(window.state().render_service.frame().is_some() && known(&executor) == 1);
    executor.run_all();
    assert_eq!(known(&executor), 2);
    render(&mut window, |settings| settings.triangles = 50_000);
    assert!(executor.run_one("pictures"));
    assert_eq!(known(&executor), 3, "another mesh is first seen under the open sky too");
}

#[test]
fn the_scene_bar_tells_the_light_that_the_pictures_are_under() {
    let mut window = crate::screenshots::open_with(Document::colorimetry(), [1280.0, 800.0], egui::Theme::Light);
    let shows = |window: &Window, words: &str| window.query_all_by_label_contains(words).next().is_some();
    assert!(!shows(&window, "pictures: sun"), "the views have the light of the scene bar");
    window.state_mut().view.show(PaneKind::RENDER);
    window.run_steps(3);
    assert!(shows(&window, "Light: D65") && shows(&window, "pictures: sun"), "another light is not kept silent");
    window.get_by_label("pictures: sun").click();
    window.run_steps(3);
    assert!(!shows(&window, "pictures: sun") && !window.state().history.document().render.sunlight);
    window.state_mut().push(Command::Undo);
    window.run_steps(2);
    assert!(shows(&window, "pictures: sun"));
    window.state_mut().push(Action::Scene(SceneAction::SetLight(Light::Set("A".to_owned()))));
    window.run_steps(3);
    assert!(!shows(&window, "pictures: sun") && shows(&window, "Light: A"), "a light that is chosen is for all views");
}
