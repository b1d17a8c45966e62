//! Keys and hints in every pane: what arrows walk, what goes on below, what is still to come, what costs nothing.

use std::time::Duration;

use chromascope::action::{Action, RenderAction};
use chromascope::app::ChromascopeApp;
use chromascope::command::{Command, SessionCommand};
use chromascope::document::render::MeshChoice;
use chromascope::document::{Document, SetKind};
use chromascope::figures::metrics::TABLE;
use chromascope::jobs::Executor;
use chromascope::plot_item::PlotItem;
use chromascope::workspaces::{PaneKind, Workspace};
use chromascope_core::query::CameraMetric;
use chromascope_core::query::metrics::Better;
use egui::Key;
use egui::accesskit::Role;
use egui_kittest::Harness;
use egui_kittest::kittest::{NodeT as _, Queryable as _};

use crate::import_switches::says;
use crate::keyboard::press_like_keyboard;
use crate::screenshots::{driven, driven_with};

type Window = Harness<'static, ChromascopeApp>;

const SIZE: [f32; 2] = [1280.0, 800.0];

/// A pane with the keyboard, and all that it asked for.
fn pane(kind: PaneKind, size: [f32; 2]) -> (Executor, Window) {
    let (executor, mut window) = driven_with(Document::colorimetry(), size, egui::Theme::Dark);
    window.state_mut().push(Command::GoTo(kind));
    settle(&executor, &mut window);
    (executor, window)
}

fn settle(executor: &Executor, window: &mut Window) {
    for _ in 0..4 {
        window.run_steps(3);
        executor.run_all();
        window.state().later.wait();
    }
    window.run_steps(3);
}

fn press(window: &mut Window, key: Key) {
    window.key_press(key);
    window.run_steps(3);
}

fn selected(window: &Window) -> Option<&PlotItem> {
    window.state().view.selected.as_ref()
}

#[test]
fn arrows_walk_the_patches_of_the_report_card() {
    let (_executor, mut window) = pane(PaneKind::REPORT_CARD, SIZE);
    let before = window.render().expect("drawn");
    press(&mut window, Key::ArrowRight);
    press(&mut window, Key::ArrowRight);
    let cursor = window.state().view.cursor.clone();
    assert!(matches!(&cursor, Some(PlotItem::Patch { source: Some(_), patch }) if patch == "light skin"), "{cursor:?}");
    assert_ne!(window.render().expect("drawn"), before, "the bar is marked");
    press(&mut window, Key::Enter);
    assert_eq!(selected(&window), cursor.as_ref());
}

#[test]
fn arrows_walk_the_cameras_of_the_light() {
    // Low, so that the card goes on below.
    let (_executor, mut window) = pane(PaneKind::LIGHT, [1280.0, 560.0]);
    let is_hint = |text: Option<String>| text.is_some_and(|text| text.contains("more below"));
    let hints = |window: &Window| window.query_all_by(|node| is_hint(node.label()) || is_hint(node.value())).count();
    let before = hints(&window);
    assert!(before > 0);
    press(&mut window, Key::ArrowDown);
    press(&mut window, Key::ArrowDown);
    press(&mut window, Key::Enter);
    let second = window.state().history.document().compared.iter().filter(|set| set.kind == SetKind::Camera).nth(1);
    let name = selected(&window).and_then(PlotItem::source).map(|source| source.name.clone());
    assert_eq!(name.as_ref(), second.map(|set| &set.name));
    for _ in 0..9 {
        press(&mut window, Key::PageDown);
        window.run_steps(30);
    }
    assert_eq!(hints(&window) + 1, before, "its end is in sight");
}

#[test]
fn enter_in_head_to_head_sorts_metrics_by_the_row() {
    let (_executor, mut window) = pane(PaneKind::HEAD_TO_HEAD, SIZE);
    press(&mut window, Key::ArrowDown);
    press(&mut window, Key::ArrowDown);
    press(&mut window, Key::Enter);
    let sorting = window.state().view.saved.looks[TABLE].sorting.clone().expect("sorted");
    assert_eq!((sorting.column.as_str(), sorting.descending), (CameraMetric::ALL[1].symbol, false));
}

#[test]
fn arrows_go_into_the_controls_of_a_pane_without_items() {
    for kind in [PaneKind::CORRECTION, PaneKind::SETTINGS, PaneKind::TOLERANCE] {
        let (_executor, mut window) = pane(kind, SIZE);
        assert_eq!(window.ctx.memory(egui::Memory::focused), None);
        press(&mut window, Key::ArrowDown);
        let id = window.ctx.memory(egui::Memory::focused).expect("a control has the keyboard");
        let first = window.ctx.read_response(id).expect("drawn").rect;
        press(&mut window, Key::ArrowDown);
        let id = window.ctx.memory(egui::Memory::focused).expect("a control has the keyboard");
        assert!(window.ctx.read_response(id).expect("drawn").rect.top() > first.top(), "{kind:?}");
    }
}

#[test]
fn the_correction_says_that_it_goes_on() {
    let (_executor, mut window) = pane(PaneKind::CORRECTION, SIZE);
    assert!(says(&window, "more below"));
    window.state_mut().push(SessionCommand::New(Some("Will a matrix fix it?")));
    window.run_steps(3);
    let (executor, mut window) = pane(PaneKind::CORRECTION, SIZE);
    window.state_mut().push(SessionCommand::New(Some("Will a matrix fix it?")));
    settle(&executor, &mut window);
    assert_eq!(window.state().view.maximized, Some(PaneKind::CORRECTION), "matrix and errors are in sight");
}

#[test]
fn a_first_click_on_a_head_shows_the_best_first() {
    let (_executor, mut window) = pane(PaneKind::METRICS, [1920.0, 1200.0]);
    let heads = |window: &Window| -> Vec<String> {
        let all = window.query_all_by_role(Role::ColumnHeader).filter(|node| node.rect().max.x < 1300.0);
        all.filter_map(|node| node.accesskit_node().label()).collect()
    };
    let mut seen = 0;
    for metric in CameraMetric::ALL.iter().skip(1) {
        let Some(head) = heads(&window).into_iter().find(|head| head.split(" (").next() == Some(metric.symbol)) else {
            continue;
        };
        window
            .query_all_by_role(Role::ColumnHeader)
            .find(|node| node.accesskit_node().label() == Some(head.clone()))
            .expect("in sight")
            .click();
        window.run_steps(3);
        let sorting = window.state().view.saved.looks[TABLE].sorting.clone().expect("sorted");
        assert_eq!((sorting.column.as_str(), sorting.descending), (metric.symbol, metric.better == Better::Higher));
        seen += 1;
    }
    assert!(seen > 3, "{seen} heads");
}

#[test]
fn progress_of_the_ranking_is_worded_as_such() {
    let (_executor, mut window) = driven_with(Document::colorimetry(), SIZE, egui::Theme::Dark);
    window.state_mut().view.show(PaneKind::METRICS);
    window.run_steps(3);
    assert!(says(&window, "Computing: 0 of 5"));
    window.state().later.wait();
    window.run_steps(3);
    assert!(!says(&window, "Computing: "));
}

#[test]
fn pictures_of_something_else_are_marked_unless_the_new_ones_come_at_once() {
    let (executor, mut window) = driven(SIZE, egui::Theme::Dark);
    window.state_mut().view.show(PaneKind::RENDER);
    settle(&executor, &mut window);
    assert!(!says(&window, "Rendering fern"));
    let settings = window.state().history.document().render.clone();
    let to = Box::new(chromascope::document::render::RenderSettings { mesh: MeshChoice::Fern, ..settings });
    window.state_mut().push(Action::Render(RenderAction::Set { what: "Mesh", to }));
    window.step();
    assert!(!says(&window, "Rendering fern"), "nothing flickers");
    window.run_steps(2);
    assert!(says(&window, "Rendering fern"));
    settle(&executor, &mut window);
    assert!(!says(&window, "Rendering fern"));
}

#[test]
fn an_idle_window_asks_for_no_frame() {
    let (executor, mut window) = driven_with(Document::colorimetry(), SIZE, egui::Theme::Dark);
    let delay = |window: &Window| window.output().viewport_output[&egui::ViewportId::ROOT].repaint_delay;
    for workspace in Workspace::ALL {
        window.state_mut().push(Command::Show(workspace));
        settle(&executor, &mut window);
        window.state_mut().view.say("Something was done.");
        window.run_steps(2);
        // The next frame is wanted where the message begins to fade.
        assert!(delay(&window) > Duration::from_secs(4), "{workspace:?}: {:?}", delay(&window));
        // Of a quarter of a second each.
        window.run_steps(32);
        assert!(!says(&window, "Something was done."));
        assert_eq!(delay(&window), Duration::MAX, "{workspace:?}");
    }
}

#[test]
fn the_temperature_keeps_the_keyboard_while_the_start_is_still_loading() {
    for by_tab in [false, true] {
        let (executor, mut window) = driven_with(Document::colorimetry(), SIZE, egui::Theme::Dark);
        let at = window.get_by_role_and_label(Role::Slider, "Temperature in kelvins").rect().center();
        if by_tab {
            window.get_by_role_and_label(Role::Slider, "Temperature in kelvins").focus();
            window.step();
        } else {
            window.drag_at(at);
            window.drop_at(at);
            window.step();
        }
        for letter in ["4", "3", "2", "1"] {
            press_like_keyboard(&mut window, letter);
            executor.run_next();
            window.state_mut().view.show(PaneKind::METRICS);
            window.step();
        }
        press(&mut window, Key::Enter);
        assert_eq!(window.state().history.document().temperature_k, 4321.0, "{by_tab}");
    }
}
