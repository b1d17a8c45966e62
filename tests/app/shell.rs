//! The frame around the panes: the two places at the foot, previews of the library's sets, pinned items as columns.

use chromascope::app::ChromascopeApp;
use chromascope::document::{Document, SetKind};
use chromascope::plot_item::{PlotItem, SensorId};
use egui::accesskit::Role;
use egui_kittest::Harness;
use egui_kittest::kittest::{NodeT as _, Queryable as _};

use crate::screenshots::{open, open_with};

type Window = Harness<'static, ChromascopeApp>;

const SIZE: [f32; 2] = [1280.0, 800.0];
/// Camera of the library that neither start compares.
const OTHER: &str = "Canon EOS 5D";

fn camera(name: &str) -> SensorId {
    SensorId { kind: SetKind::Camera, name: name.to_owned() }
}

fn patch(source: &str, name: &str) -> PlotItem {
    PlotItem::Patch { source: Some(camera(source)), patch: name.to_owned() }
}

fn says(window: &Window, words: &str) -> bool {
    let said = |text: Option<String>| text.is_some_and(|text| text.contains(words));
    window.query_all_by(|node| said(node.label()) || said(node.value())).next().is_some()
}

/// Steps until egui's time has gone on by so many seconds.
fn wait(window: &mut Window, seconds: f64) {
    let end = window.ctx.input(|input| input.time) + seconds;
    while window.ctx.input(|input| input.time) < end {
        window.step();
    }
}

fn row(window: &mut Window, name: &str) -> egui::Rect {
    window.state_mut().view_mut().search = name.to_owned();
    window.run();
    window.get_by_role_and_label(Role::CheckBox, name).rect()
}

#[test]
fn a_message_fades_after_six_seconds_and_an_error_stays() {
    let mut window = open(SIZE, egui::Theme::Dark);
    window.state_mut().view_mut().say("Something was done.");
    window.step();
    wait(&mut window, 5.0);
    assert!(says(&window, "Something was done."));
    wait(&mut window, 1.5);
    assert!(!says(&window, "Something was done.") && window.state().view().status.text.is_empty());
    assert!(says(&window, "cameras computed"), "facts return to their place");
    window.state_mut().view_mut().fail("Something failed.");
    wait(&mut window, 20.0);
    assert!(says(&window, "Something failed."));
}

#[test]
fn the_reading_under_the_pointer_is_never_covered_by_a_message() {
    let mut window = open(SIZE, egui::Theme::Dark);
    window.state_mut().view_mut().say("Undone: Difference.");
    let at = row(&mut window, OTHER).center();
    window.hover_at(at);
    window.run();
    let both = ["Undone: Difference.", &format!("camera {OTHER}")].map(|words| {
        let said = |text: Option<String>| text.is_some_and(|text| text.contains(words));
        let foot = |node: &egui_kittest::Node<'_>| node.rect().top() > SIZE[1] - 30.0;
        window.query_all_by(|node| said(node.label()) || said(node.value())).find(foot).map(|node| node.rect())
    });
    let [Some(message), Some(reading)] = both else { panic!("{both:?}") };
    assert!(!message.intersects(reading), "{message:?} {reading:?}");
}

#[test]
fn a_set_of_the_library_is_seen_before_it_is_ticked() {
    let mut window = open_with(Document::colorimetry(), SIZE, egui::Theme::Dark);
    let ghost = |window: &Window| {
        let app = window.state();
        let (catalog, results) = (chromascope::catalog::Catalog::built_in(), chromascope::results::Results::default());
        let document = app.history().document();
        let scene = chromascope::scene::Scene { document, catalog: &catalog, results: &results };
        let built = chromascope::figures::chromaticity::build(&scene, app.view(), None, [640.0, 480.0]);
        (built.panel.marks.iter().any(|mark| mark.name.contains("(not compared)")), built.panel.x.range)
    };
    let before = ghost(&window);
    let at = row(&mut window, OTHER).center();
    window.hover_at(at);
    window.run();
    assert!(says(&window, &format!("Curves of {OTHER}")) && says(&window, "Terms"));
    let (shown, range) = ghost(&window);
    assert!(!before.0 && shown, "its locus is in the diagram");
    assert_eq!(before.1, range, "the diagram stands still");
    assert!(!window.state().compares(SetKind::Camera, OTHER));
    window.drag_at(at);
    window.drop_at(at);
    window.run();
    assert!(window.state().compares(SetKind::Camera, OTHER) && !ghost(&window).0);
}

#[test]
fn every_kind_of_set_shows_its_curves_source_and_terms() {
    let mut window = open(SIZE, egui::Theme::Light);
    let catalog = chromascope::catalog::Catalog::built_in();
    for kind in
        [SetKind::Camera, SetKind::Observer, SetKind::Chart, SetKind::Illuminant, SetKind::Filter, SetKind::Material]
    {
        let entry = catalog.of_kind(kind).last().expect("there are such sets");
        window.state_mut().view_mut().selected = Some(PlotItem::of_set(kind, &entry.name));
        window.run();
        for words in [&format!("Curves of {}", entry.name), "Source", "Terms"] {
            assert!(says(&window, words), "{kind:?}: {words}");
        }
        assert!(window.state().view().selected_elsewhere || window.state().compares(kind, &entry.name));
    }
}

#[test]
fn pinned_items_are_columns_of_the_selected_items_table() {
    let mut window = open([1280.0, 1000.0], egui::Theme::Dark);
    let view = window.state_mut().view_mut();
    view.pinned = vec![patch("Kodak DCS200", "blue"), patch("Nikon D70 (2007 figure)", "blue")];
    view.selected = Some(patch("Canon EOS 10D (2007 figure)", "blue"));
    window.run();
    assert!(says(&window, "x: reference 0.2020, camera 0."));
    let said: Vec<String> = window.query_all_by(|_| true).filter_map(|node| node.accesskit_node().label()).collect();
    let row = said.iter().find(|words| words.starts_with("Δxy: ")).expect("differences are a row");
    for head in ["camera 0.", "A 0.", "B 0."] {
        assert!(row.contains(head), "{row}");
    }
    assert_eq!(said.iter().filter(|words| words.starts_with("x: ")).count(), 1, "one table");
}
