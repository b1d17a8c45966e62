//! The field of the temperature: what is typed replaces the text, and is taken or refused, never changed.

use chromascope::action::{Action, SceneAction};
use chromascope::app::ChromascopeApp;
use chromascope::command::Command;
use chromascope::document::Light;
use egui::accesskit::Role;
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable as _;

use crate::import_switches::says;
use crate::keyboard::press_like_keyboard;
use crate::screenshots::open;

type Window = Harness<'static, ChromascopeApp>;

fn window() -> Window {
    open([1280.0, 800.0], egui::Theme::Dark)
}

fn kelvin(window: &Window) -> f64 {
    window.state().history.document().temperature_k
}

fn text(window: &Window) -> Option<String> {
    window.query_by_role_and_label(Role::TextInput, "Temperature in kelvins").and_then(|field| field.value())
}

/// T, then the text, letter by letter.
fn type_temperature(window: &mut Window, words: &str) {
    press_like_keyboard(window, "t");
    type_on(window, words);
}

fn type_on(window: &mut Window, words: &str) {
    press_like_keyboard(window, words);
}

fn press(window: &mut Window, key: egui::Key) {
    window.key_press(key);
    window.run_steps(3);
}

#[test]
fn what_is_typed_after_t_replaces_the_text() {
    let mut window = window();
    for (words, wanted) in
        [("3200", 3200.0), ("6504", 6504.0), ("1000", 1000.0), ("20000", 20_000.0), ("5003 K", 5003.0)]
    {
        type_temperature(&mut window, words);
        assert_eq!(text(&window).as_deref(), Some(words));
        press(&mut window, egui::Key::Enter);
        assert_eq!(kelvin(&window), wanted);
        assert_eq!(text(&window), None, "the number is taken");
    }
    // The slider is the other way; both are steps of undo.
    window.state_mut().push(Command::Undo);
    window.run();
    assert_eq!(kelvin(&window), 20_000.0);
}

#[test]
fn what_is_no_temperature_is_refused_and_stays() {
    let mut window = window();
    let before = window.state().history.document().clone();
    for words in ["999", "20001", "50000", "-5", "warm", "nan", "inf", ""] {
        type_temperature(&mut window, "1");
        press(&mut window, egui::Key::Backspace);
        type_on(&mut window, words);
        press(&mut window, egui::Key::Enter);
        assert_eq!(*window.state().history.document(), before, "{words}");
        assert_eq!(text(&window).as_deref(), Some(words), "it can be mended");
        assert!(says(&window, "1000 to 20000 K"), "{words}");
        press(&mut window, egui::Key::Escape);
        assert_eq!(text(&window), None, "Esc gives it up");
        assert!(!says(&window, "1000 to 20000 K"));
        assert_eq!(*window.state().history.document(), before);
    }
    // The corrected text is accepted.
    type_temperature(&mut window, "320");
    press(&mut window, egui::Key::Enter);
    type_on(&mut window, "0");
    assert!(!says(&window, "1000 to 20000 K"), "the reason goes while it is mended");
    press(&mut window, egui::Key::Enter);
    assert_eq!(kelvin(&window), 3200.0);
}

#[test]
fn daylight_begins_at_4000() {
    let mut window = window();
    window.state_mut().push(Action::Scene(SceneAction::SetLight(Light::Daylight)));
    window.run();
    let before = window.state().history.document().clone();
    type_temperature(&mut window, "3200");
    press(&mut window, egui::Key::Enter);
    assert!(says(&window, "4000 to 20000 K"));
    assert_eq!(*window.state().history.document(), before);
}

#[test]
fn leaving_the_field_takes_a_number_and_keeps_what_is_none() {
    let mut window = window();
    type_temperature(&mut window, "2856");
    press(&mut window, egui::Key::Tab);
    assert_eq!(kelvin(&window), 2856.0);
    // The control that has the keyboard now keeps letters to itself.
    window.state_mut().push(Command::FocusTemperature);
    window.run_steps(3);
    type_on(&mut window, "99999");
    press(&mut window, egui::Key::Tab);
    assert_eq!(kelvin(&window), 2856.0);
    assert_eq!(text(&window).as_deref(), Some("99999"));
    assert!(says(&window, "1000 to 20000 K"));
    // Another temperature takes its place.
    window.state_mut().push(Action::Scene(SceneAction::SetTemperature(4000.0)));
    window.run();
    assert_eq!(text(&window), None);
}

#[test]
fn it_can_be_dragged_and_moved_with_arrows() {
    let mut window = window();
    let before = kelvin(&window);
    let at = window.get_by_role_and_label(Role::Slider, "Temperature in kelvins").rect().center();
    window.drag_at(at);
    window.run_steps(2);
    window.hover_at(at + egui::vec2(20.0, 0.0));
    window.run_steps(2);
    window.drop_at(at + egui::vec2(20.0, 0.0));
    window.run();
    assert!(kelvin(&window) > before);
    window.state_mut().push(Command::Undo);
    window.run();
    assert_eq!(kelvin(&window), before, "a drag is one step");
    type_temperature(&mut window, "");
    press(&mut window, egui::Key::ArrowUp);
    assert_eq!(kelvin(&window), before + 10.0);
    assert_eq!(text(&window), Some(format!("{}", before + 10.0)));
}
