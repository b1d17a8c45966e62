//! Cameras and observers that are added, hidden and renamed; the library, of which all other sets are used.

use chromascope::app::ChromascopeApp;
use chromascope::catalog::import;
use chromascope::command::Command;
use chromascope::document::{Light, SetKind};
use chromascope::plot_item::{PlotItem, SensorId};
use chromascope::workspaces::PaneKind;
use egui::accesskit::Role;
use egui_kittest::Harness;
use egui_kittest::kittest::{NodeT as _, Queryable as _};

use crate::screenshots::open;

type Window = Harness<'static, ChromascopeApp>;

fn window() -> Window {
    adding([1280.0, 800.0])
}

fn adding(size: [f32; 2]) -> Window {
    let mut window = open(size, egui::Theme::Dark);
    window.state_mut().view.adding = true;
    window.run();
    window
}

pub(crate) fn press(window: &mut Window, role: Role, label: &str) {
    window.get_by_role_and_label(role, label).click();
    // Answers that arrive meanwhile ask for frames of their own.
    window.run_steps(4);
}

fn search(window: &mut Window, words: &str) {
    window.state_mut().push(Command::FocusSearch);
    window.run();
    window.get_by_role_and_label(Role::TextInput, "Search the cameras").type_text(words);
    // The set that comes under the pointer is previewed, which takes frames of its own.
    window.run_steps(8);
}

#[test]
fn ticking_a_camera_puts_it_on_show_and_off_again() {
    let mut window = window();
    assert!(window.query_by_role_and_label(Role::Button, "Hide Canon EOS 5D").is_none());
    press(&mut window, Role::CheckBox, "Canon EOS 5D");
    assert!(window.state().compares(SetKind::Camera, "Canon EOS 5D"));
    window.get_by_role_and_label(Role::Button, "Hide Canon EOS 5D");
    press(&mut window, Role::CheckBox, "Canon EOS 5D");
    assert!(!window.state().compares(SetKind::Camera, "Canon EOS 5D"));
}

#[test]
fn search_shows_matches_and_enter_ticks_the_first() {
    let mut window = window();
    search(&mut window, "d3300");
    assert!(window.query_by_role_and_label(Role::CheckBox, "Canon EOS 5D").is_none());
    window.key_press(egui::Key::Enter);
    window.run();
    assert!(window.state().compares(SetKind::Camera, "Nikon D3300"));
    // The next search takes the place of this one.
    search(&mut window, "nothing like it");
    window.get_by_label("No match.");
    press(&mut window, Role::Button, "Clear search");
    assert_eq!(window.state().view.search, "");
}

#[test]
fn escape_clears_the_search_and_keeps_the_selection() {
    let mut window = window();
    let thing = PlotItem::Sensor(SensorId { kind: SetKind::Camera, name: "Nikon D70 (2007 figure)".to_owned() });
    window.state_mut().view.selected = Some(thing.clone());
    search(&mut window, "canon");
    window.key_press(egui::Key::Escape);
    window.run();
    assert_eq!(window.state().view.search, "");
    assert_eq!(window.state().view.selected, Some(thing));
    window.key_press(egui::Key::Escape);
    window.run();
    assert!(!window.state().view.adding);
    window.key_press(egui::Key::Escape);
    window.run();
    assert_eq!(window.state().view.selected, None);
}

#[test]
fn the_key_hides_and_the_name_selects() {
    let mut window = window();
    press(&mut window, Role::Button, "Hide Nikon D70 (2007)");
    let compared = window.state().history.document().compared(SetKind::Camera, "Nikon D70 (2007 figure)").cloned();
    assert!(compared.is_some_and(|compared| !compared.visible));
    press(&mut window, Role::Button, "Show Nikon D70 (2007)");
    press(&mut window, Role::Button, "Nikon D70 (2007)");
    let wanted = PlotItem::Sensor(SensorId { kind: SetKind::Camera, name: "Nikon D70 (2007 figure)".to_owned() });
    assert_eq!(window.state().view.selected, Some(wanted));
}

#[test]
fn another_observer_becomes_the_truth() {
    let mut window = window();
    press(&mut window, Role::Button, "Menu of CIE 1931 2°");
    press(&mut window, Role::Button, "Make reference");
    assert_eq!(window.state().history.document().reference, "CIE 1931 2°");
    window.state_mut().view.search = "1931".to_owned();
    window.run();
    let reference = window.get_by_role_and_label(Role::CheckBox, "CIE 1931 2°");
    assert!(reference.accesskit_node().is_disabled(), "the truth stays");
}

#[test]
fn a_label_is_renamed_in_its_place() {
    let mut window = window();
    press(&mut window, Role::Button, "Menu of Nikon D70 (2007)");
    press(&mut window, Role::Button, "Rename…");
    let field = |window: &Window, text: &str| {
        window.get_by_role_and_label(Role::TextInput, "Label of the sensor").type_text(text);
    };
    window.run();
    window.key_combination_modifiers(egui::Modifiers::COMMAND, &[egui::Key::A]);
    field(&window, "Grandfather's");
    window.run();
    window.key_press(egui::Key::Enter);
    window.run();
    window.get_by_role_and_label(Role::Button, "Hide Grandfather's");
    window.state_mut().push(Command::Undo);
    window.run();
    window.get_by_role_and_label(Role::Button, "Hide Nikon D70 (2007)");
}

#[test]
fn lights_charts_and_filters_are_used_from_the_table_of_data() {
    let mut window = window();
    window.state_mut().view.show(PaneKind::LIBRARY);
    for (kind, name, used) in [
        (SetKind::Illuminant, "D65", "Use as light"),
        (SetKind::Chart, "Training reflectances (190)", "Use as chart"),
        (SetKind::Filter, "ND 0.6", "Use as filter"),
    ] {
        window.state_mut().view.selected = Some(PlotItem::of_set(kind, name));
        window.run_steps(3);
        press(&mut window, Role::Button, used);
    }
    assert_eq!(window.state().history.document().filters, ["ND 0.6"]);
    press(&mut window, Role::Button, "Remove filter");
    assert!(window.state().history.document().filters.is_empty());
    let document = window.state().history.document();
    assert_eq!(document.light, Light::Set("D65".to_owned()));
    assert_eq!(document.chart, "Training reflectances (190)");
}

#[test]
fn own_sets_come_first_and_can_be_removed() {
    let mut window = window();
    let text = "nm,red,green,blue\n400,0,1,5\n500,1,8,4\n600,9,5,1\n700,5,1,0\n";
    let mut imported = import::import("zoo.csv", text.as_bytes(), Some(chromascope::document::imported::Role::Camera))
        .expect("a table of three curves");
    imported.set.name = "Zoo".to_owned();
    window.state_mut().push(crate::import_sets(vec![imported.set]));
    window.run();
    let own = window.get_by_role_and_label(Role::CheckBox, "Zoo").rect();
    let first = window.get_by_role_and_label(Role::CheckBox, "ARRI D21").rect();
    assert!(own.top() < first.top());
    press(&mut window, Role::Button, "Menu of your Zoo");
    press(&mut window, Role::Button, "Remove");
    assert!(window.state().history.document().own.is_empty());
}

#[test]
fn a_source_that_cannot_be_computed_says_why() {
    let mut window = window();
    window.state_mut().view.search = "cone".to_owned();
    window.run();
    press(&mut window, Role::CheckBox, "CIE 2006 2° cone fundamentals");
    let warnings = window
        .query_all_by(|node| node.label().is_some_and(|label| label.contains("Eq 13 takes RGB, not cone signals")));
    assert!(warnings.count() > 0);
}

/// The cameras compared, in order of name.
fn cameras(window: &Window) -> Vec<String> {
    let compared = &window.state().history.document().compared;
    let mut names: Vec<String> =
        compared.iter().filter(|source| source.kind == SetKind::Camera).map(|source| source.name.clone()).collect();
    names.sort();
    names
}

fn click_at(window: &mut Window, at: egui::Pos2) {
    window.hover_at(at);
    window.run_steps(1);
    for pressed in [true, false] {
        let button = egui::PointerButton::Primary;
        window.event(egui::Event::PointerButton { pos: at, button, pressed, modifiers: egui::Modifiers::NONE });
        window.run_steps(1);
    }
    window.run();
}

/// Clicks eight times at the place of a set: each click toggles that set and no other, and the list stands still.
fn click_eight_times(window: &mut Window, name: &str) {
    let before = cameras(window);
    let rect = window.get_by_role_and_label(Role::CheckBox, name).rect();
    for click in 0..8 {
        click_at(window, rect.left_center() + egui::vec2(40.0, 0.0));
        let mut wanted = before.clone();
        if (click % 2 == 0) == before.contains(&name.to_owned()) {
            wanted.retain(|known| known != name);
        } else if !wanted.contains(&name.to_owned()) {
            wanted.push(name.to_owned());
            wanted.sort();
        }
        assert_eq!(cameras(window), wanted, "{name}, click {click}");
        assert_eq!(window.get_by_role_and_label(Role::CheckBox, name).rect(), rect, "{name}, click {click}");
    }
}

/// The camera whose row is at a place.
fn camera_at(window: &Window, at: egui::Pos2) -> String {
    let row = window.get_by(|node| {
        node.role() == Role::CheckBox
            && rect_of(node).left() < 200.0
            && rect_of(node).y_range().contains(at.y)
            && rect_of(node).bottom() > at.y
    });
    row.accesskit_node().label().expect("a name")
}

fn rect_of(node: &egui_kittest::kittest::AccessKitNode<'_>) -> egui::Rect {
    node.bounding_box().map_or(egui::Rect::NOTHING, |b| {
        egui::Rect::from_min_max(egui::pos2(b.x0 as f32, b.y0 as f32), egui::pos2(b.x1 as f32, b.y1 as f32))
    })
}

#[test]
fn the_list_stands_still_while_cameras_are_ticked() {
    for size in [[1280.0, 800.0], [900.0, 600.0]] {
        let mut window = adding(size);
        let at = window.get_by_role_and_label(Role::CheckBox, "Canon EOS 5D").rect().center();
        for scroll in [0.0, -150.0, -30.0, 77.0, -400.0] {
            window.hover_at(at);
            window.event(egui::Event::MouseWheel {
                unit: egui::MouseWheelUnit::Point,
                delta: egui::vec2(0.0, scroll),
                phase: egui::TouchPhase::Move,
                modifiers: egui::Modifiers::NONE,
                source: egui::MouseWheelSource::Wheel,
            });
            window.run_steps(40);
            let name = camera_at(&window, at);
            click_eight_times(&mut window, &name);
        }
        // As many as find a place: the list below is where it was.
        for name in ["Canon EOS M", "Canon EOS R10", "Nikon D850", "Nikon Z f"] {
            search(&mut window, name);
            click_eight_times(&mut window, name);
            press(&mut window, Role::CheckBox, name);
        }
        search(&mut window, "nikon d70");
        click_eight_times(&mut window, "Nikon D70 (2007 figure)");
        click_eight_times(&mut window, "Nikon D700");
    }
}

#[test]
fn a_ticked_camera_is_in_sight_above() {
    let mut window = adding([900.0, 600.0]);
    for name in ["Canon EOS M", "Nikon D850", "Nikon Z f"] {
        search(&mut window, name);
        press(&mut window, Role::CheckBox, name);
        let row = window.get_by_role_and_label(Role::Button, &format!("Hide {name}")).rect();
        let field = window.get_by_role_and_label(Role::TextInput, "Search the cameras").rect();
        assert!(row.bottom() < field.top() && row.height() > 20.0, "{name}: {row}, {field}");
    }
}
