//! The library: ticking, searching, hiding, the truth.

use chromascope::action::{Action, OwnAction};
use chromascope::app::ChromascopeApp;
use chromascope::catalog::{Kind, import};
use chromascope::command::Command;
use chromascope::document::Light;
use chromascope::thing::{SourceId, Thing};
use egui::accesskit::Role;
use egui_kittest::Harness;
use egui_kittest::kittest::{NodeT as _, Queryable as _};

use crate::screenshots::open;

type Window = Harness<'static, ChromascopeApp>;

fn window() -> Window {
    open([1280.0, 800.0], egui::Theme::Dark)
}

fn press(window: &mut Window, role: Role, label: &str) {
    window.get_by_role_and_label(role, label).click();
    window.run();
}

fn search(window: &mut Window, words: &str) {
    window.state_mut().push(Command::FocusSearch);
    window.run();
    window.get_by_role_and_label(Role::TextInput, "Search the library").type_text(words);
    window.run();
}

#[test]
fn ticking_a_camera_puts_it_on_show_and_off_again() {
    let mut window = window();
    assert!(window.query_by_role_and_label(Role::Button, "Hide Canon EOS 5D").is_none());
    press(&mut window, Role::CheckBox, "Canon EOS 5D");
    assert!(window.state().compares(Kind::Camera, "Canon EOS 5D"));
    window.get_by_role_and_label(Role::Button, "Hide Canon EOS 5D");
    press(&mut window, Role::CheckBox, "Canon EOS 5D");
    assert!(!window.state().compares(Kind::Camera, "Canon EOS 5D"));
}

#[test]
fn search_shows_matches_and_enter_ticks_the_first() {
    let mut window = window();
    search(&mut window, "d3300");
    assert!(window.query_by_role_and_label(Role::CheckBox, "Canon EOS 5D").is_none());
    window.key_press(egui::Key::Enter);
    window.run();
    assert!(window.state().compares(Kind::Camera, "Nikon D3300"));
    // The next search takes the place of this one.
    search(&mut window, "nothing like it");
    window.get_by_label("No match.");
    press(&mut window, Role::Button, "Clear search");
    assert_eq!(window.state().view().search, "");
}

#[test]
fn escape_clears_the_search_and_keeps_the_selection() {
    let mut window = window();
    let thing = Thing::Source(SourceId { kind: Kind::Camera, name: "Nikon D70 (2007 figure)".to_owned() });
    window.state_mut().view_mut().selected = Some(thing.clone());
    search(&mut window, "canon");
    window.key_press(egui::Key::Escape);
    window.run();
    assert_eq!(window.state().view().search, "");
    assert_eq!(window.state().view().selected, Some(thing));
    window.key_press(egui::Key::Escape);
    window.run();
    assert_eq!(window.state().view().selected, None);
}

#[test]
fn the_key_hides_and_the_name_selects() {
    let mut window = window();
    press(&mut window, Role::Button, "Hide Nikon D70 (2007)");
    let compared = window.state().history().document().compared(Kind::Camera, "Nikon D70 (2007 figure)").cloned();
    assert!(compared.is_some_and(|compared| !compared.visible));
    press(&mut window, Role::Button, "Show Nikon D70 (2007)");
    press(&mut window, Role::Button, "Nikon D70 (2007)");
    let wanted = Thing::Source(SourceId { kind: Kind::Camera, name: "Nikon D70 (2007 figure)".to_owned() });
    assert_eq!(window.state().view().selected, Some(wanted));
}

#[test]
fn another_observer_becomes_the_truth() {
    let mut window = window();
    press(&mut window, Role::Button, "Menu of CIE 1931 2°");
    press(&mut window, Role::Button, "Make reference");
    assert_eq!(window.state().history().document().truth, "CIE 1931 2°");
    window.state_mut().view_mut().search = "1931".to_owned();
    window.run();
    let truth = window.get_by_role_and_label(Role::CheckBox, "CIE 1931 2°");
    assert!(truth.accesskit_node().is_disabled(), "the truth stays");
}

#[test]
fn a_label_is_renamed_in_its_place() {
    let mut window = window();
    press(&mut window, Role::Button, "Menu of Nikon D70 (2007)");
    press(&mut window, Role::Button, "Rename…");
    let field = |window: &Window, text: &str| {
        window.get_by_role_and_label(Role::TextInput, "Label of the source").type_text(text);
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
fn lights_charts_and_materials_are_chosen() {
    let mut window = window();
    for (search, name) in [("D65", "D65"), ("190", "Training reflectances (190)")] {
        window.state_mut().view_mut().search = search.to_owned();
        window.run();
        press(&mut window, Role::RadioButton, name);
    }
    let document = window.state().history().document();
    assert_eq!(document.light, Light::Set("D65".to_owned()));
    assert_eq!(document.chart, "Training reflectances (190)");
}

#[test]
fn own_sets_come_first_and_can_be_removed() {
    let mut window = window();
    let text = "nm,red,green,blue\n400,0,1,5\n500,1,8,4\n600,9,5,1\n700,5,1,0\n";
    let mut imported = import::import("zoo.csv", text.as_bytes(), Some(chromascope::document::own::Role::Camera))
        .expect("a table of three curves");
    imported.set.name = "Zoo".to_owned();
    window.state_mut().push(Action::Own(OwnAction::Import(vec![imported.set])));
    window.run();
    let own = window.get_by_role_and_label(Role::CheckBox, "Zoo").rect();
    let first = window.get_by_role_and_label(Role::CheckBox, "ARRI D21").rect();
    assert!(own.top() < first.top());
    press(&mut window, Role::Button, "Menu of your Zoo");
    press(&mut window, Role::Button, "Remove");
    assert!(window.state().history().document().own.is_empty());
}

#[test]
fn a_source_that_cannot_be_computed_says_why() {
    let mut window = window();
    window.state_mut().view_mut().search = "cone".to_owned();
    window.run();
    press(&mut window, Role::CheckBox, "CIE 2006 2° cone fundamentals");
    let warnings = window
        .query_all_by(|node| node.label().is_some_and(|label| label.contains("Eq 13 takes RGB, not cone signals")));
    assert!(warnings.count() > 0);
}
