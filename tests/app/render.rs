//! The Render workspace: what it shows, what it requests, and what it does not.

use std::path::Path;
use std::time::Duration;

use chromascope::action::{Action, CompareAction, RenderAction};
use chromascope::app::ChromascopeApp;
use chromascope::catalog::meshes::MeshState;
use chromascope::command::Command;
use chromascope::document::render::{BALANCE, MeshChoice, RenderSettings, SUN};
use chromascope::document::{Document, Light, SetKind, WhiteBalanceChoice, session};
use chromascope::panes;
use chromascope::plot_item::SensorId;
use chromascope::scene::Scene;
use chromascope::view::{PixelPlace, RenderMode};
use chromascope::workspaces::{PaneKind, Workspace};
use chromascope_core::reflectance::{IlluminatedArea, Normalization, Specular};
use chromascope_core::render::QualityLevel;
use chromascope_figure::FigureRoom;
use egui::accesskit::Role;
use egui_kittest::Harness;
use egui_kittest::kittest::{NodeT as _, Queryable as _};

use crate::keyboard::press_like_keyboard;
use crate::screenshots::{driven, open};
use crate::waiting::until;

type Window = Harness<'static, ChromascopeApp>;

/// Waits for the pictures and shows them.
fn settle(window: &mut Window) {
    for _ in 0..3 {
        window.run_steps(2);
        window.state().render_service.wait();
    }
    window.run_steps(2);
}

fn render(window: &mut Window, change: impl FnOnce(&mut RenderSettings)) {
    let mut to = window.state().history.document().render.clone();
    change(&mut to);
    window.state_mut().push(Action::Render(RenderAction::Set { what: "Test", to: Box::new(to) }));
    window.run_steps(1);
}

/// The workspace with a coarse head, for speed.
fn window(size: [f32; 2], theme: egui::Theme) -> Window {
    in_render(open(size, theme))
}

fn in_render(mut window: Window) -> Window {
    window.state_mut().view.show(PaneKind::RENDER);
    render(&mut window, |settings| settings.triangles = 4000);
    settle(&mut window);
    window
}

fn small() -> Window {
    alone(window([900.0, 600.0], egui::Theme::Dark))
}

/// The settings over the pictures.
fn with_settings(mut window: Window) -> Window {
    let view = &mut window.state_mut().view;
    (view.column_over, view.saved.layout.right_lower_share) = (true, 0.85);
    settle(&mut window);
    window
}

/// Only the pictures.
fn alone(mut window: Window) -> Window {
    let view = &mut window.state_mut().view;
    (view.saved.layout.left, view.saved.layout.compare[1]) = (false, None);
    settle(&mut window);
    window
}

/// Number of computations of a kind of query.
fn made(window: &Window, name: &str) -> u64 {
    window.state().results.counts().get(name).map_or(0, |count| count.misses)
}

/// Number of computations of each kind of query.
fn computed(window: &Window) -> Vec<(&'static str, u64)> {
    window.state().results.counts().into_iter().map(|(name, count)| (name, count.misses)).collect()
}

/// The captions of the visible pictures.
fn captions(window: &Window) -> Vec<String> {
    let labels = window.query_all_by(|node| node.value().is_some_and(|label| label.starts_with("Picture: ")));
    labels.filter_map(|node| node.accesskit_node().value()).collect()
}

fn document(window: &Window) -> &Document {
    window.state().history.document()
}

#[test]
fn the_truth_and_three_cameras_stand_side_by_side() {
    let window = small();
    let captions = captions(&window);
    assert_eq!(captions.len(), 4, "{captions:?}");
    assert!(captions[0].starts_with("Picture: Reference"), "{captions:?}");
    assert!(
        captions[1..].iter().all(|caption| caption.contains("Δxy 0.0") && caption.contains(" facing light, median ")),
        "{captions:?}"
    );
    let shot = window.state().render_service.frame().cloned().unwrap();
    assert!(shot.is_last && shot.query.mesh().unwrap().shading.geometry.visibility.size.samples == 3);
    let pixels = &shot.made().unwrap().pictures[0].as_ref().unwrap().rgba;
    assert!(pixels.chunks_exact(4).any(|pixel| pixel[0] > 200), "it is lit");
}

#[test]
fn a_figure_sets_light_and_white_in_one_step() {
    let mut window = small();
    let before = document(&window).clone();
    window.get_by_role_and_label(Role::Button, "Figure 9").click();
    window.run_steps(2);
    assert_eq!(document(&window).light, Light::Set(SUN.to_owned()));
    assert_eq!(document(&window).white, WhiteBalanceChoice::Light(BALANCE.to_owned()));
    assert_eq!(window.state().history.undo_name(), Some("Figure 9"));
    window.state_mut().push(Command::Undo);
    window.run_steps(2);
    assert_eq!(*document(&window), before);
}

#[test]
fn a_figure_is_radiometric() {
    let mut window = small();
    render(&mut window, |settings| settings.normalization = Normalization::Paper);
    window.get_by_role_and_label(Role::Button, "Figure 8").click();
    window.run_steps(2);
    assert_eq!(document(&window).render.normalization, Normalization::Radiometric);
    assert_eq!(document(&window).white, WhiteBalanceChoice::Light(BALANCE.to_owned()));
}

#[test]
fn a_figure_as_in_the_paper_has_a_point_light_and_the_papers_normalization() {
    let mut document = Document::colorimetry();
    assert_eq!(document.render.specular, Specular::Fresnel);
    assert_eq!(Document::paper().render.specular, Specular::Paper);
    for (action, name, mesh) in [
        (RenderAction::PaperFigure8, "Figure 8, as in the paper", MeshChoice::Head),
        (RenderAction::PaperFigure9, "Figure 9, as in the paper", MeshChoice::Fern),
    ] {
        let action = Action::Render(action);
        assert_eq!(action.name(), name);
        action.apply(&mut document);
        let settings = &document.render;
        assert_eq!(
            (&settings.mesh, settings.normalization, settings.specular),
            (&mesh, Normalization::Paper, Specular::Paper)
        );
        assert_eq!((settings.area, settings.light_radius), (IlluminatedArea::Xy, 0.0));
        assert!(settings.light_distance.is_some());
        assert_eq!(document.light, Light::Set(SUN.to_owned()));
    }
    // The program's own has parallel light and the radiometric normalization again, and its start's specular component.
    Action::Render(RenderAction::Figure8).apply(&mut document);
    assert_eq!((document.render.light_distance, document.render.area), (None, IlluminatedArea::FourXy));
    assert_eq!(
        (document.render.normalization, document.render.specular),
        (Normalization::Radiometric, Specular::Fresnel)
    );
}

#[test]
fn a_saved_session_keeps_the_coherent_component_that_it_was_made_with() {
    let mut saved: serde_json::Value = serde_json::to_value(Document::colorimetry()).unwrap();
    let settings = saved["render"].as_object_mut().unwrap();
    assert_eq!((settings.remove("specular"), settings.remove("area")), (Some("fresnel".into()), Some("4xy".into())));
    let opened = session::from_json(&saved.to_string()).unwrap();
    assert_eq!((opened.render.specular, opened.render.area), (Specular::Paper, IlluminatedArea::FourXy));
}

#[test]
fn the_surface_says_its_limits_where_it_is_chosen() {
    // Tall, so that all of the settings are in sight.
    let mut window = with_settings(window([900.0, 1500.0], egui::Theme::Dark));
    let says = |window: &Window, words: &str| {
        window.query_all_by(|node| node.value().is_some_and(|label| label.contains(words))).count() > 0
    };
    assert!(says(&window, "Returns 0.49 of the light at normal incidence (0.03 at 85°)"));
    render(&mut window, |settings| settings.normalization = Normalization::Microfacet);
    assert!(says(&window, "more than 1 from 7") && says(&window, "Only the diffuse component is reciprocal"));
    render(&mut window, |settings| settings.normalization = Normalization::Lambertian);
    assert!(!says(&window, "Returns 0"));
    // Both choices of the coherent component and of the area are there.
    render(&mut window, |settings| settings.normalization = Normalization::Radiometric);
    assert!(window.query_by_role_and_label(Role::ComboBox, "Coherent component: As in the paper").is_some());
    window.get_by_role_and_label(Role::RadioButton, "A = XY").click();
    window.run_steps(2);
    assert_eq!(document(&window).render.area, IlluminatedArea::Xy);
}

#[test]
fn a_mesh_that_is_gone_is_said_in_place_of_pictures() {
    let mut window = small();
    render(&mut window, |settings| settings.mesh = MeshChoice::File("/nowhere/bust.obj".into()));
    until("a word about the mesh", || match window.state().meshes.get(Path::new("/nowhere/bust.obj")) {
        MeshState::Loading => Err("it is being read".to_owned()),
        MeshState::Ready(_) | MeshState::Failed(_) => Ok(()),
    });
    window.run_steps(2);
    assert!(captions(&window).is_empty());
    assert!(window.state().render_service.frame().is_none() && window.state().render_service.busy().is_none());
}

#[test]
fn dragging_orbits_and_changes_nothing_else() {
    let mut window = small();
    let before = document(&window).clone();
    let step = window.state().history.undo_name().map(str::to_owned);
    let [from, to] = [egui::pos2(150.0, 250.0), egui::pos2(200.0, 250.0)];
    window.hover_at(from);
    window.drag_at(from);
    window.run_steps(2);
    window.hover_at(to);
    window.run_steps(2);
    window.drop_at(to);
    settle(&mut window);
    let orbit = window.state().view.saved.render.orbit.expect("it was turned");
    assert!((orbit.yaw_deg + 45.0).abs() < 4.1 && orbit.pitch_deg == 5.0, "{orbit:?}");
    assert_eq!(*document(&window), before);
    assert_eq!(window.state().history.undo_name().map(str::to_owned), step);
    assert!(window.state().view.render.pinned.is_none(), "a drag is no click");
    window.key_press(egui::Key::Home);
    window.run_steps(2);
    assert!(window.state().view.saved.render.orbit.is_none());
}

#[test]
fn exposure_asks_for_no_signals() {
    let mut window = small();
    let (images, pictures) = (made(&window, "camera image"), made(&window, "picture"));
    render(&mut window, |settings| settings.exposure_ev = 1.0);
    settle(&mut window);
    assert_eq!(made(&window, "camera image"), images);
    assert_eq!(made(&window, "picture"), pictures + 4, "the finest ones alone");
}

#[test]
fn the_lights_place_leaves_what_is_seen_alone() {
    let mut window = small();
    let (seen, angles) = (made(&window, "visibility"), made(&window, "geometry"));
    render(&mut window, |settings| settings.light_up_deg = 40.0);
    settle(&mut window);
    assert_eq!(made(&window, "visibility"), seen);
    assert!(made(&window, "geometry") > angles);
}

#[test]
fn a_hidden_camera_is_not_computed() {
    let mut window = small();
    let hide = CompareAction::SetVisible(SetKind::Camera, "Nikon D70 (2007 figure)".to_owned(), false);
    window.state_mut().push(Action::Compare(hide));
    settle(&mut window);
    assert_eq!(captions(&window).len(), 3);
    // A change that requests the finest pictures alone, so that none is begun and given up on the way.
    let pictures = made(&window, "picture");
    render(&mut window, |settings| settings.exposure_ev = 0.5);
    settle(&mut window);
    assert_eq!(made(&window, "picture"), pictures + 3);
    let shot = window.state().render_service.frame().cloned().unwrap();
    assert!(shot.sources.iter().all(|source| source.name != "Nikon D70 (2007 figure)"));
    assert_eq!(shot.sources.len(), 3);
}

#[test]
fn a_hidden_workspace_asks_nothing() {
    let mut window = small();
    window.state_mut().push(Command::Show(Workspace::Data));
    settle(&mut window);
    let before = computed(&window);
    render(&mut window, |settings| settings.sigma_um = 3.0);
    settle(&mut window);
    assert_eq!(computed(&window), before);
    assert!(window.state().render_service.busy().is_none());
}

#[test]
fn nothing_moves_when_nothing_changes() {
    let mut window = small();
    let serial = window.state().render_service.frame().unwrap().serial;
    let before = computed(&window);
    window.run_steps(4);
    assert!(!window.ctx.has_requested_repaint());
    assert_eq!(computed(&window), before);
    assert_eq!(window.state().render_service.frame().unwrap().serial, serial);
}

#[test]
fn a_narrow_window_has_a_handle_for_the_settings() {
    let mut window = window([900.0, 600.0], egui::Theme::Dark);
    let settings = |window: &Window| window.query_by_label_contains("Mesh: ").is_some();
    assert!(!settings(&window));
    window.get_by_role_and_label(Role::Button, "Show the right column (I)").click();
    window.run_steps(3);
    assert!(settings(&window), "they lie over the pictures");
    window.key_press(egui::Key::Escape);
    window.run_steps(2);
    assert!(!settings(&window));
    press_like_keyboard(&mut window, "i");
    assert!(settings(&window));
}

#[test]
fn a_double_click_shows_one_picture_and_all_again() {
    let mut window = small();
    let click = |window: &mut Window, at: egui::Pos2| {
        window.drag_at(at);
        window.drop_at(at);
    };
    // A step here takes a quarter of a second.
    window.ctx.options_mut(|options| options.input_options.max_double_click_delay = 5.0);
    let at = egui::pos2(343.0, 320.0);
    window.hover_at(at);
    window.run_steps(1);
    click(&mut window, at);
    click(&mut window, at);
    window.run_steps(3);
    assert_eq!(window.state().view.saved.render.mode, RenderMode::One);
    let chosen = window.state().view.render.chosen.clone().expect("the picture's source");
    assert_eq!(chosen.kind, SetKind::Camera);
    window.key_press(egui::Key::Escape);
    window.run_steps(2);
    assert_eq!(window.state().view.saved.render.mode, RenderMode::Grid);
    press_like_keyboard(&mut window, "d");
    assert_eq!(window.state().view.saved.render.mode, RenderMode::Difference);
}

#[test]
fn the_divider_moves_by_drag_and_by_keys() {
    let mut window = small();
    window.state_mut().view.saved.render.mode = RenderMode::Split;
    settle(&mut window);
    let divider = "Divider between reference and sensor";
    let start = window.get_by_role_and_label(Role::Slider, divider).rect().center();
    window.hover_at(start);
    window.drag_at(start);
    window.run_steps(2);
    window.hover_at(start + egui::vec2(60.0, 0.0));
    window.run_steps(2);
    window.drop_at(start + egui::vec2(60.0, 0.0));
    window.run_steps(2);
    let dragged = window.state().view.saved.render.split;
    assert!(dragged > 0.55, "{dragged}");
    assert!(window.state().view.saved.render.orbit.is_none(), "the mesh stays");
    window.get_by_role_and_label(Role::Slider, divider).focus();
    window.run_steps(2);
    window.key_press(egui::Key::ArrowLeft);
    window.run_steps(2);
    assert!((window.state().view.saved.render.split - (dragged - 0.02)).abs() < 1e-5);
}

#[test]
fn a_material_is_found_by_typing() {
    let mut window = with_settings(small());
    window.get_by_label_contains("Material: ").click();
    window.run_steps(2);
    window.get_by_role_and_label(Role::TextInput, "Filter Material").focus();
    window.run_steps(2);
    window.get_by_role_and_label(Role::TextInput, "Filter Material").type_text("grass");
    window.run_steps(2);
    window.get_by_label("Grass 025 (Vrhel)").click();
    window.run_steps(3);
    assert_eq!(document(&window).render.material, "Grass 025 (Vrhel)");
    assert!(window.query_by_label("Filter Material").is_none(), "the list is closed");
    // The garment has a list of its own, with bare shoulders first.
    let wool = "White and gray wool sock 047 (Vrhel)";
    window.get_by_role_and_label(Role::ComboBox, "Garment: None: bare shoulders").click();
    window.run_steps(2);
    window.get_by_role_and_label(Role::TextInput, "Filter Garment").type_text("wool");
    window.run_steps(2);
    window.get_by_label(wool).click();
    window.run_steps(3);
    assert_eq!(document(&window).render.garment.as_deref(), Some(wool));
    window.get_by_role_and_label(Role::ComboBox, &format!("Garment: {wool}")).click();
    window.run_steps(2);
    window.get_by_role_and_label(Role::TextInput, "Filter Garment").type_text("bare");
    window.run_steps(2);
    window.get_by_label("None: bare shoulders").click();
    window.run_steps(3);
    assert_eq!(
        (document(&window).render.garment.as_deref(), document(&window).render.material.as_str()),
        (None, "Grass 025 (Vrhel)")
    );
}

#[test]
fn escape_closes_a_list_before_anything_else() {
    let mut window = with_settings(small());
    window.state_mut().view.saved.render.mode = RenderMode::One;
    window.get_by_label_contains("Mesh: ").click();
    window.run_steps(2);
    assert!(window.query_by_label("Plane").is_some());
    window.key_press(egui::Key::Escape);
    window.run_steps(3);
    assert!(window.query_by_label("Plane").is_none());
    assert_eq!(window.state().view.saved.render.mode, RenderMode::One);
}

#[test]
fn a_click_keeps_a_pixel_and_escape_lets_go() {
    let mut window = small();
    // On the forehead in the second picture.
    let at = egui::pos2(343.0, 320.0);
    window.hover_at(at);
    window.run_steps(2);
    let point = window.state().view.point.clone().expect("the pointer reads");
    assert!(point.contains("pixel") && point.contains("Δxy 0.0"), "{point}");
    window.drag_at(at);
    window.drop_at(at);
    settle(&mut window);
    let pinned = window.state().view.render.pinned.clone().expect("it is kept");
    assert_eq!(pinned.source.kind, SetKind::Camera);
    let mut window = with_settings(window);
    assert!(window.query_by(|node| node.value().is_some_and(|text| text.starts_with("Pixel "))).is_some());
    assert!(window.query_by(|node| node.value().is_some_and(|text| text.contains("moments"))).is_some());
    window.state_mut().view.column_over = false;
    window.key_press(egui::Key::Escape);
    window.run_steps(2);
    assert!(window.state().view.render.pinned.is_none());
}

#[test]
fn every_way_to_stand_makes_its_pictures() {
    let mut window = small();
    for (mode, pictures) in [(RenderMode::Split, 2), (RenderMode::One, 2), (RenderMode::Difference, 4)] {
        window.state_mut().view.saved.render.mode = mode;
        settle(&mut window);
        let shot = window.state().render_service.frame().cloned().unwrap();
        assert_eq!(shot.sources.len(), pictures, "{mode:?}");
        let differences = shot.made().unwrap().differences.iter().flatten();
        assert!(mode != RenderMode::Difference || differences.into_iter().all(|difference| difference.stride == 1));
    }
    window.key_press(egui::Key::Escape);
    window.run_steps(2);
    assert_eq!(window.state().view.saved.render.mode, RenderMode::Grid);
}

#[test]
fn the_pictures_are_a_figure_with_numbers() {
    let window = small();
    let (catalog, results) = (chromascope::catalog::Catalog::built_in(), chromascope::results::Results::default());
    let scene = Scene { document: document(&window), catalog: &catalog, results: &results };
    let figure =
        panes::figure(PaneKind::RENDER, &scene, &window.state().look(PaneKind::RENDER, &scene), FigureRoom::default())
            .expect("there are pictures");
    assert_eq!(figure.table.rows.len(), 4);
    let svg =
        chromascope::export::svg(&figure, &chromascope::palette::Colors::LIGHT, chromascope::export::Paper::default());
    assert_eq!(svg.matches("data:image/png").count(), 4);
    assert!(!figure.table.to_csv().contains("NaN") && !figure.caption.contains("NaN"));
}

#[test]
fn escape_stops_what_takes_long_and_keeps_what_was_made() {
    let (executor, window) = driven([900.0, 600.0], egui::Theme::Dark);
    let mut window = in_render(window);
    render(&mut window, |settings| (settings.quality, settings.sigma_um) = (QualityLevel::Reference, 0.3));
    window.run_steps(2);
    assert!(executor.run_one("pictures"));
    window.run_steps(1);
    let shot = window.state().render_service.frame().cloned().unwrap();
    assert!(!shot.is_last, "the first of several stages");
    assert!(!window.state().render_service.is_waiting(), "nobody has waited yet");
    executor.advance(Duration::from_secs(1));
    window.run_steps(1);
    assert!(window.state().render_service.is_waiting());
    window.key_press(egui::Key::Escape);
    // What was made before the key is still taken in with it.
    window.run_steps(2);
    assert!(window.state().render_service.busy().is_none());
    let before = window.state().render_service.frame().cloned().unwrap();
    assert_eq!(before.serial, shot.serial);
    let computed = made(&window, "shading");
    executor.run_all();
    window.run_steps(3);
    assert_eq!(made(&window, "shading"), computed, "nothing more was computed");
    assert!(window.state().render_service.busy().is_none());
    let after = window.state().render_service.frame().cloned().unwrap();
    assert_eq!(after.serial, before.serial);
    assert_eq!(captions(&window).len(), 4);
    assert_eq!(window.state().history.undo_name(), Some("Test"), "the choice stays");
}

#[test]
fn tolerance_builds_nothing_that_the_pictures_have() {
    const STAGES: [&str; 4] = ["mesh", "shadow tree", "visibility", "geometry"];
    let mut window = window([1280.0, 800.0], egui::Theme::Dark);
    let before = STAGES.map(|stage| made(&window, stage));
    render(&mut window, |settings| settings.mesh = MeshChoice::Sphere);
    let settled = |window: &mut Window| {
        for _ in 0..3 {
            settle(window);
            window.state().later.wait();
        }
        std::array::from_fn(|stage| made(window, STAGES[stage]) - before[stage])
    };
    // Pictures come coarse, fine and with several samples a pixel; the first two see the same.
    assert_eq!(settled(&mut window), [1, 1, 2, 3]);
    let shadings = made(&window, "shading");
    window.state_mut().view.show(PaneKind::TOLERANCE);
    assert_eq!(settled(&mut window), [1, 1, 2, 3]);
    assert!(made(&window, "shading") > shadings, "plans are of shaded samples");
}

#[test]
fn a_pixel_is_marked_in_the_diagram_beside_the_pictures() {
    let mut window = window([1280.0, 800.0], egui::Theme::Light);
    window.state_mut().view.show(PaneKind::CHROMATICITY);
    settle(&mut window);
    let (catalog, results) = (chromascope::catalog::Catalog::built_in(), chromascope::results::Results::default());
    let document = document(&window).clone();
    let scene = Scene { document: &document, catalog: &catalog, results: &results };
    let diamonds = |app: &ChromascopeApp| {
        let look = app.look(PaneKind::CHROMATICITY, &scene);
        let built = chromascope::figures::chromaticity::build(&scene, &look, [600.0, 400.0]);
        built.panel.marks.iter().filter(|mark| mark.name.ends_with(", pixel")).count()
    };
    assert_eq!(diamonds(window.state()), 0);
    let source = SensorId { kind: SetKind::Camera, name: "Nikon D70 (2007 figure)".to_owned() };
    window.state_mut().view.render.pinned = Some(PixelPlace { at: [0.45, 0.3], source });
    assert_eq!(diamonds(window.state()), 4, "one for each source");
}
