//! The inspector and the foot of the window.

use chromascope::app::ChromascopeApp;
use chromascope::catalog::Catalog;
use chromascope::document::{PAPER_REFERENCE, SetKind};
use chromascope::plot_item::{PlotItem, SensorId};
use chromascope::results::Results;
use chromascope::scene::Scene;
use egui::accesskit::Role;
use egui_kittest::Harness;

use crate::import_switches::says;
use crate::library::press;
use crate::screenshots::open;

type Window = Harness<'static, ChromascopeApp>;

fn window() -> Window {
    open([1280.0, 1000.0], egui::Theme::Dark)
}

pub(crate) fn camera(name: &str) -> SensorId {
    SensorId { kind: SetKind::Camera, name: name.to_owned() }
}

pub(crate) fn patch(source: &str, name: &str) -> PlotItem {
    PlotItem::Patch { source: Some(camera(source)), patch: name.to_owned() }
}

fn select(window: &mut Window, thing: PlotItem) {
    window.state_mut().view.selected = Some(thing);
    window.run();
}

#[test]
fn a_selection_says_how_to_end_it() {
    let mut window = window();
    select(&mut window, patch("Kodak DCS200", "blue"));
    assert!(says(&window, "Kodak DCS200, blue selected; Esc shows all"));
    window.key_press(egui::Key::Escape);
    window.run();
    assert!(!says(&window, "Kodak DCS200, blue selected; Esc shows all"));
}

#[test]
fn without_a_selection_it_says_what_is_seen() {
    let window = window();
    assert!(says(&window, "A camera's spectral sensitivities differ from the eye's"));
    assert!(says(&window, "Hover reads, click selects, Esc deselects."));
    assert!(says(&window, "Ready. Drop a spectrum or camera file anywhere."));
    let cameras = Catalog::built_in().of_kind(SetKind::Camera).count();
    assert!(says(&window, &format!("3 of {cameras} cameras computed")));
}

#[test]
fn a_patch_shows_the_difference_that_the_scene_computes() {
    let mut window = window();
    select(&mut window, patch("Kodak DCS200", "blue"));
    let (catalog, results) = (Catalog::built_in(), Results::default());
    let document = window.state().history.document().clone();
    let scene = Scene { document: &document, catalog: &catalog, results: &results };
    let differences = scene.differences(SetKind::Camera, "Kodak DCS200").expect("the camera is there");
    let blue = differences[2].expect("comparable");
    assert!(says(&window, &format!("Δxy {blue:.4}")));
    assert!(says(&window, "b*: reference −40.8"), "a true minus sign");
    assert!(says(&window, "Patch 13 blue, light E"));
    // A temperature in kelvins costs the rows above it no decimals.
    let red = scene.patch_colors(SetKind::Observer, PAPER_REFERENCE).unwrap()[0].xy.expect("it has light");
    select(&mut window, patch("Kodak DCS200", "red"));
    assert!(says(&window, &format!("x: reference {:.4}", red.x)) && says(&window, "CCT: reference 2013"));
}

#[test]
fn where_there_is_no_difference_the_reason_stands() {
    let mut window = window();
    let source = SensorId { kind: SetKind::Observer, name: "CIE 1931 2°".to_owned() };
    select(&mut window, PlotItem::Patch { source: Some(source.clone()), patch: "red".to_owned() });
    assert!(says(&window, "No difference: a CIE observer is drawn directly"));
    select(&mut window, PlotItem::Radiator { source, kelvin: 5500.0 });
    assert!(says(&window, "No difference: a CIE observer is drawn directly"));
}

#[test]
fn every_kind_of_thing_has_its_page() {
    let mut window = window();
    let assumed = "Canon 10D (2007): measured 400–700 nm; counts as zero outside.";
    for (thing, words) in [
        (PlotItem::Sensor(camera("Canon EOS 10D (2007 figure)")), "0.348 in xy"),
        (PlotItem::Sensor(camera("Canon EOS 10D (2007 figure)")), assumed),
        (
            PlotItem::Radiator { source: camera("Nikon D70 (2007 figure)"), kelvin: 5500.0 },
            "blackbody, 5500 K = 181.8 mired",
        ),
        (PlotItem::Patch { source: None, patch: "red".to_owned() }, "Kodak DCS200, red"),
        (PlotItem::Light, "for CIE 1931 2°"),
    ] {
        select(&mut window, thing);
        assert!(says(&window, words), "{words}");
    }
}

#[test]
fn a_sensor_says_what_its_table_leaves_in_doubt() {
    let mut window = window();
    for (name, words) in [
        ("Nikon D70 (2007 figure)", "unknown, assumed per energy: The plot does not say"),
        ("Nikon D70 (2007 figure)", "digitized from a figure"),
        ("Nikon D70 (2007 figure)", "lost: read off a printed figure"),
        ("Nikon D70 (UPenn 2011)", "implausible: neutral under D65 +153 % in R/G"),
        ("Nikon D70 (2007 figure)", "misses the raw values of a real D70 by 4.5 %"),
        ("Nikon D70 (2007 figure)", "to 1 nm by Sprague's interpolation; zero outside 400–700 nm"),
        ("Nikon D70 (2007 figure)", "its locus below 2500 K (dotted) depends on data beyond 700 nm"),
        ("Nikon D70 (2007 figure)", "signals normalized to equal energy, which determines it"),
        ("Nikon D70 (A.M.P.A.S.)", "per energy, inferred: The table says only that its unit is relative."),
        ("Kodak DCS200", "per energy, stated: Per energy, as Psychtoolbox states"),
        ("Kodak DCS200", "Zenodo 4297288"),
    ] {
        select(&mut window, PlotItem::Sensor(camera(name)));
        assert!(says(&window, words), "{name}: {words}");
    }
    select(&mut window, PlotItem::Light);
    assert!(says(&window, "Resampled"), "how the light is resampled");
}

#[test]
fn pinned_things_stand_side_by_side() {
    let mut window = window();
    for source in ["Kodak DCS200", "Nikon D70 (2007 figure)"] {
        select(&mut window, patch(source, "blue"));
        press(&mut window, Role::Button, "Pin");
    }
    assert_eq!(window.state().view.pinned.len(), 2);
    window.state_mut().view.selected = None;
    window.run();
    assert!(says(&window, "x: reference 0.2020, A 0.2534, B "));
    press(&mut window, Role::Button, "Unpin A");
    assert_eq!(window.state().view.pinned, [patch("Nikon D70 (2007 figure)", "blue")]);
}

#[test]
fn a_sensor_that_is_removed_leaves_the_inspector() {
    use chromascope::action::{Action, CompareAction};
    use chromascope::command::Command;
    let mut window = window();
    let name = "Canon EOS 5D";
    let add = Action::Compare(CompareAction::Add(SetKind::Camera, name.to_owned()));
    let remove = Action::Compare(CompareAction::Remove(SetKind::Camera, name.to_owned()));
    let other = patch("Kodak DCS200", "blue");
    for by_undo in [false, true] {
        window.state_mut().push(add.clone());
        window.run();
        let view = &mut window.state_mut().view;
        view.selected = Some(PlotItem::Sensor(camera(name)));
        view.pinned = vec![patch(name, "blue"), other.clone(), patch(name, "red")];
        view.hovered = Some(PlotItem::Radiator { source: camera(name), kelvin: 5500.0 });
        window.state_mut().push(if by_undo { Command::Undo } else { remove.clone().into() });
        window.run();
        assert!(!window.state().compares(SetKind::Camera, name));
        let view = &window.state().view;
        assert_eq!((&view.selected, &view.hovered), (&None, &None), "by undo: {by_undo}");
        assert_eq!(view.pinned, std::slice::from_ref(&other));
        assert!(!says(&window, name) || !says(&window, "Unpin B"));
        if by_undo {
            window.state_mut().push(Command::Redo);
            window.run();
        }
        window.state_mut().push(remove.clone());
        window.run();
        window.state_mut().view.pinned.clear();
    }
    // What stays compared stays selected.
    select(&mut window, patch("Kodak DCS200", "blue"));
    window.state_mut().push(add);
    window.run();
    window.state_mut().push(remove);
    window.run();
    assert_eq!(window.state().view.selected, Some(other));
}
