//! Keys as a keyboard sends them, with the text they type: single letters, lists that keep theirs, panes that keys mean.

use chromascope::app::ChromascopeApp;
use chromascope::command::{Command, key_bindings};
use chromascope::document::render::MeshChoice;
use chromascope::document::{Document, Light};
use chromascope::view::{View, Weight};
use chromascope::workspaces::{PaneKind, Side};
use egui::accesskit::Role;
use egui::{Event, Key, Modifiers};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable as _;

use crate::import_switches::says;
use crate::screenshots::open_with;

type Window = Harness<'static, ChromascopeApp>;

const SIZE: [f32; 2] = [1280.0, 800.0];

/// Types as a keyboard does: each key and the text that it types arrive in one frame.
pub(crate) fn press_like_keyboard(window: &mut Window, words: &str) {
    for letter in words.chars() {
        let key = Key::from_name(&letter.to_uppercase().to_string());
        let event = |pressed| {
            key.map(|key| Event::Key { key, physical_key: None, pressed, repeat: false, modifiers: Modifiers::NONE })
        };
        let events = event(true).into_iter().chain([Event::Text(letter.to_string())]);
        window.input_mut().events.extend(events);
        window.step();
        window.input_mut().events.extend(event(false));
        window.step();
    }
    window.run_steps(2);
}

fn window(pane: PaneKind, size: [f32; 2]) -> Window {
    let mut window = open_with(Document::colorimetry(), size, egui::Theme::Dark);
    window.state_mut().view.show(pane);
    window.run_steps(3);
    window
}

/// What a key can change, in words.
fn state(window: &Window) -> String {
    let document = window.state().history.document();
    let View { saved, maximized, column_over, focus_temperature, status, .. } = &window.state().view;
    let bars = saved.difference_bars;
    format!("{document:?} {:?} {maximized:?} {column_over} {focus_temperature} {bars} {}", saved.layout, status.text)
}

/// All keys of one letter or digit.
fn single_letters() -> impl Iterator<Item = (char, Command)> {
    let plain = key_bindings(PaneKind::CHROMATICITY).into_iter().filter(|binding| binding.rests_while_typing);
    plain.filter_map(|binding| {
        let mut name = binding.shortcut.logical_key.name().to_lowercase();
        (name.len() == 1).then(|| (name.remove(0), binding.command))
    })
}

#[test]
fn each_letter_does_what_it_says_and_types_nothing() {
    assert_eq!(single_letters().filter(|(key, _)| key.is_alphabetic()).count(), 6);
    for (key, command) in single_letters() {
        let mut window = window(PaneKind::CHROMATICITY, SIZE);
        let before = state(&window);
        press_like_keyboard(&mut window, &key.to_string());
        let sensors = window.state().history.document().compared.len();
        let is_there = !matches!(command, Command::ToggleSource(index) if index >= sensors);
        let field = window.query_by_role_and_label(Role::TextInput, "Temperature in kelvins");
        assert_eq!(field.is_some(), command == Command::FocusTemperature, "{key}");
        match field {
            Some(field) => assert_eq!(field.value().as_deref(), Some("5500"), "the key itself is not typed"),
            None => assert_eq!(state(&window) != before, is_there, "{key}: {command:?}"),
        }
        assert_eq!(window.state().view.search, "");
    }
}

#[test]
fn what_comes_with_the_key_t_in_a_slow_frame_goes_into_the_field() {
    let mut window = window(PaneKind::CHROMATICITY, SIZE);
    let key = |key| Event::Key { key, physical_key: None, pressed: true, repeat: false, modifiers: Modifiers::NONE };
    let text = |text: &str| Event::Text(text.to_owned());
    window.input_mut().events.extend([key(Key::T), text("t"), key(Key::Num4), text("4"), key(Key::Num2), text("2")]);
    window.run_steps(2);
    press_like_keyboard(&mut window, "00");
    window.key_press(Key::Enter);
    window.run_steps(3);
    assert_eq!(window.state().history.document().temperature_k, 4200.0);
    assert!(window.state().history.document().compared.iter().all(|sensor| sensor.visible), "no sensor was hidden");
}

#[test]
fn a_number_that_was_refused_goes_with_escape_from_anywhere() {
    let mut window = window(PaneKind::CHROMATICITY, SIZE);
    press_like_keyboard(&mut window, "tabc");
    window.key_press(Key::Enter);
    window.run_steps(2);
    window.key_press(Key::Tab);
    window.run_steps(2);
    window.ctx.memory_mut(|memory| memory.focused().map(|id| memory.surrender_focus(id)));
    window.state_mut().push(Command::Help("glossary", 0));
    window.run_steps(3);
    assert!(says(&window, "1000 to 20000 K"));
    window.key_press(Key::Escape);
    window.run_steps(3);
    assert!(!says(&window, "1000 to 20000 K"));
    assert!(window.state().view.help.page.is_some(), "it did nothing else");
}

#[test]
fn a_temperature_without_effect_says_why() {
    let why = "no effect on the panes of Data.";
    let mut window = window(PaneKind::IMPORT, SIZE);
    press_like_keyboard(&mut window, "t");
    assert!(says(&window, why), "{}", window.state().view.status.text);
    assert!(!window.ctx.text_edit_focused(), "letters go on to be keys");
    window.get_by_role_and_label(Role::Slider, "Temperature in kelvins").click();
    window.run_steps(2);
    window.state_mut().view.say("");
    press_like_keyboard(&mut window, "4321");
    window.key_press(Key::Enter);
    window.run_steps(3);
    assert_eq!(window.state().history.document().temperature_k, 4321.0);
    assert!(says(&window, why));
}

#[test]
fn letters_in_an_open_list_or_menu_are_its_own() {
    for (pane, opens) in [
        (PaneKind::CHROMATICITY, "File"),
        (PaneKind::CHROMATICITY, "View"),
        (PaneKind::CHROMATICITY, "Export Chromaticity"),
        (PaneKind::CHROMATICITY, "Light: D65"),
        (PaneKind::RENDER, "Mesh: Head"),
    ] {
        let mut window = window(pane, SIZE);
        window.get_by_label(opens).click();
        window.run_steps(3);
        assert!(egui::Popup::is_any_open(&window.ctx), "{opens}");
        let before = state(&window);
        for (key, _) in single_letters() {
            press_like_keyboard(&mut window, &key.to_string());
        }
        for key in [Key::E, Key::K, Key::Num3, Key::Z] {
            window.key_press_modifiers(Modifiers::COMMAND, key);
            window.run_steps(2);
        }
        assert_eq!(state(&window), before, "{opens}");
        let view = &window.state().view;
        assert!(view.palette.is_none() && view.page.is_none() && view.is_shown(pane), "{opens}");
    }
}

#[test]
fn short_lists_are_filtered_as_one_types() {
    let mut window = window(PaneKind::RENDER, SIZE);
    let choose = |window: &mut Window, list: &str, typed: &str| {
        window.get_by_label_contains(list).click();
        window.run_steps(3);
        press_like_keyboard(window, typed);
        window.key_press(Key::Enter);
        window.run_steps(4);
    };
    choose(&mut window, "Mesh: ", "fern");
    assert_eq!(window.state().history.document().render.mesh, MeshChoice::Fern);
    assert_eq!(window.state().view.maximized, None);
    window.state_mut().push(Command::FigurePage(PaneKind::CHROMATICITY));
    window.run_steps(3);
    choose(&mut window, "Size: ", "two");
    assert_eq!(window.state().view.saved.page.paper.width_mm, Some(174.0));
}

#[test]
fn panes_of_controls_do_not_fill_the_window() {
    let mut window = window(PaneKind::RENDER, SIZE);
    assert!(window.query_by_label_contains("Maximize Settings").is_none());
    assert!(window.query_by_label_contains("Maximize Render (F)").is_some());
    window.state_mut().push(Command::GoTo(PaneKind::SETTINGS));
    window.run_steps(3);
    press_like_keyboard(&mut window, "f");
    assert_eq!(window.state().view.maximized, None);
    assert!(says(&window, "Settings keeps its size"));
}

#[test]
fn ctrl_e_prints_a_pane_that_has_a_figure() {
    for (pane, size, printed) in [
        (PaneKind::CHROMATICITY, SIZE, PaneKind::CHROMATICITY),
        (PaneKind::RENDER, [900.0, 600.0], PaneKind::RENDER),
        (PaneKind::SPECTRA, SIZE, PaneKind::SPECTRA),
        (PaneKind::RECORDED, SIZE, PaneKind::METRICS),
        (PaneKind::IMPORT, SIZE, PaneKind::CHROMATICITY),
    ] {
        let mut window = window(PaneKind::CHROMATICITY, size);
        window.get_by_label("Compared").click();
        window.run_steps(2);
        assert_eq!(window.state().view.focused, Some(PaneKind::COMPARED));
        window.state_mut().view.show(pane);
        window.state_mut().view.focused = Some(pane);
        window.run_steps(3);
        window.state().render_service.wait();
        window.state().later.wait();
        window.run_steps(3);
        window.key_press_modifiers(Modifiers::COMMAND, Key::E);
        window.run_steps(3);
        let view = &window.state().view;
        assert_eq!(view.page, Some(printed), "{pane:?}: {}", view.status.text);
        assert_ne!(view.status.weight, Weight::Error);
    }
}

#[test]
fn the_keyboard_leaves_a_pane_that_leaves_the_screen() {
    let mut window = window(PaneKind::CHROMATICITY, SIZE);
    window.state_mut().push(Command::GoTo(PaneKind::SWATCHES));
    window.run_steps(3);
    assert_eq!(window.state().view.focused, Some(PaneKind::SWATCHES));
    window.state_mut().push(Command::Toggle(Side::Lower));
    window.run_steps(3);
    assert_eq!(window.state().view.focused, None);
    press_like_keyboard(&mut window, "f");
    assert_eq!(window.state().view.maximized, Some(PaneKind::CHROMATICITY));
}

/// Worst patch of the three cameras of the first screen under illuminant A.
#[test]
fn the_worst_patch_under_another_light_takes_fifteen_keys_at_most() {
    let mut window = window(PaneKind::CHROMATICITY, SIZE);
    let mut keys = 0;
    for typed in ["a", "worst"] {
        window.key_press_modifiers(Modifiers::COMMAND, Key::K);
        window.run_steps(3);
        press_like_keyboard(&mut window, typed);
        window.key_press(Key::Enter);
        window.run_steps(4);
        keys += 2 + typed.len();
    }
    assert!(keys <= 15, "{keys}");
    assert_eq!(window.state().history.document().light, Light::Set("A".to_owned()));
    let selected = window.state().view.selected.clone().expect("the worst patch");
    assert_eq!(selected.source().map(|source| source.name.as_str()), Some("Kodak DCS200"));
    assert!(says(&window, selected.patch().expect("a patch")), "its name and difference are read in the Inspector");
}

#[test]
fn a_number_in_the_palette_sets_the_temperature() {
    let mut window = window(PaneKind::CHROMATICITY, SIZE);
    window.key_press_modifiers(Modifiers::COMMAND, Key::K);
    window.run_steps(3);
    press_like_keyboard(&mut window, "3200");
    window.key_press(Key::Enter);
    window.run_steps(3);
    assert_eq!(window.state().history.document().temperature_k, 3200.0);
}

#[test]
fn a_narrow_window_still_offers_the_difference() {
    let mut window = window(PaneKind::CHROMATICITY, [900.0, 600.0]);
    let button = window.get_by_label_contains("Difference: ");
    assert!(button.rect().right() <= 900.0, "{}", button.rect());
    button.click();
    window.run_steps(3);
    press_like_keyboard(&mut window, "1976");
    window.key_press(Key::Enter);
    window.run_steps(3);
    assert_eq!(window.state().history.document().difference.id, "delta-e1976");
    assert_eq!(window.state().history.document().light, Light::Set("D65".to_owned()));
}

#[test]
fn only_panes_with_a_figure_offer_to_print_it() {
    let mut window = window(PaneKind::METRICS, SIZE);
    let mut said = |pane| {
        window.state_mut().push(Command::GoTo(pane));
        window.run_steps(3);
        window.state().view.status.text.clone()
    };
    assert_eq!(said(PaneKind::REPORT_CARD), "Report card (F fills the window, Ctrl+E prints)");
    assert_eq!(said(PaneKind::METAMERS), "Metamers (F fills the window)");
    assert_eq!(said(PaneKind::RECORDED), "Recorded (F fills the window)", "no raw values are open");
}
