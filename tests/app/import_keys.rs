//! Import without a mouse.

use chromascope::view::import::{ImportItem, Stop};
use chromascope::workspaces::{PaneKind, Workspace};
use egui::Key;
use egui::accesskit::{Role, Toggled};
use egui_kittest::kittest::{NodeT as _, Queryable as _};
use spectral_file::{Delimiter, Role as Kinds};

use crate::import_switches::{Window, closed, drop_file, own, settle, until};
use crate::screenshots::open;

const CAMERA: &str = "nm,red,green,blue\n400,0,1,5\n500,1,8,4\n600,9,5,1\n700,5,1,0\n";
const BROKEN: &str = "nm;leaf;bark\n400;5,0;1\n500;10,0;2\n600;oops;3\n700;50,0;4\n";
const TABS: &str = "nm\tleaf\tbark\n400\t0.5\t0.1\n500\t0.6\t0.2\n600\t0.7\t0.3\n700\t0.8\t0.4\n";

fn press(window: &mut Window, key: Key) {
    window.key_press(key);
    settle(window);
}

/// F6 until the keyboard is somewhere.
fn go_to(window: &mut Window, stop: Stop) {
    for _ in 0..8 {
        press(window, Key::F6);
        if window.state().view.import.stop == Some(stop) {
            return;
        }
    }
    panic!("F6 does not lead to {stop:?}");
}

/// Description of the focused control.
fn focus(window: &Window) -> String {
    let found = window.query_all_by(|node| node.is_focused() && node.label().is_some()).last();
    found.and_then(|node| node.accesskit_node().label()).unwrap_or_default()
}

#[test]
fn files_switches_and_curves_are_reached_and_changed_by_keys_alone() {
    let mut window = open([1280.0, 1000.0], egui::Theme::Dark);
    for (name, text) in [("a.csv", CAMERA), ("broken.csv", BROKEN), ("c.csv", TABS)] {
        drop_file(&mut window, name, text);
    }
    window.key_press_modifiers(egui::Modifiers::COMMAND, Key::Num5);
    settle(&mut window);
    assert_eq!(window.state().view.saved.workspace, Workspace::Data);

    go_to(&mut window, Stop::Files);
    assert_eq!(window.state().view.focused, Some(PaneKind::IMPORT));
    for _ in 0..3 {
        press(&mut window, Key::ArrowUp);
    }
    assert_eq!(window.state().view.import.selected, Some(ImportItem::Set("a".to_owned())));
    assert!(focus(&window).starts_with("a: 3 curves"), "{}", focus(&window));
    press(&mut window, Key::ArrowDown);
    assert_eq!(window.state().view.import.selected, Some(ImportItem::Set("c".to_owned())));

    go_to(&mut window, Stop::Switches);
    assert!(focus(&window).starts_with("This is a: "), "{}", focus(&window));
    press(&mut window, Key::Enter);
    for _ in 0..4 {
        press(&mut window, Key::ArrowDown);
    }
    let picked = window.get_by_role_and_label(Role::Button, "Illuminant");
    assert_eq!(picked.accesskit_node().toggled(), Some(Toggled::True), "it is highlighted");
    press(&mut window, Key::Enter);
    until(&mut window, "a role", |app| app.history.document().own[1].role == Kinds::Illuminant);
    assert!(focus(&window).starts_with("This is a: "), "the list has the keyboard again: {}", focus(&window));

    press(&mut window, Key::Enter);
    press(&mut window, Key::Escape);
    assert!(focus(&window).starts_with("This is a: "), "a list that is left: {}", focus(&window));

    go_to(&mut window, Stop::Picker);
    assert_eq!(focus(&window), "leaf");
    press(&mut window, Key::ArrowDown);
    assert_eq!(focus(&window), "bark");
    press(&mut window, Key::Enter);
    until(&mut window, "a curve left out", |app| app.history.document().own[1].curves.len() == 1);

    // What failed is tried otherwise, and taken with Enter in the list.
    go_to(&mut window, Stop::Files);
    press(&mut window, Key::ArrowDown);
    let Some(ImportItem::File(_)) = window.state().view.import.selected else { panic!("the file that failed") };
    press(&mut window, Key::Enter);
    assert_eq!(own(&window).len(), 2);
    go_to(&mut window, Stop::Switches);
    while !focus(&window).starts_with("Columns split by") {
        assert!(!focus(&window).is_empty());
        press(&mut window, Key::Tab);
    }
    press(&mut window, Key::Enter);
    for _ in 0..3 {
        press(&mut window, Key::ArrowDown);
    }
    press(&mut window, Key::Enter);
    assert_eq!(closed(&window, "Columns split by"), "Semicolon (chosen)");
    let tried = window.state().view.import.tried.values().next().cloned().expect("a try");
    assert_eq!(tried.options.delimiter, Some(Delimiter::Semicolon));
    assert!(window.query_by_role_and_label(Role::Button, "Forget choices").is_some());
}

#[test]
fn enter_takes_a_file_that_is_no_set_yet() {
    let mut window = open([1280.0, 1000.0], egui::Theme::Dark);
    drop_file(&mut window, "a.csv", CAMERA);
    window
        .state_mut()
        .push(chromascope::action::Action::Imported(chromascope::action::ImportedAction::Remove("a".to_owned())));
    settle(&mut window);
    go_to(&mut window, Stop::Files);
    press(&mut window, Key::Enter);
    until(&mut window, "a set", |app| app.history.document().own.len() == 1);
    assert_eq!(window.state().view.import.selected, Some(ImportItem::Set("a".to_owned())));
}
