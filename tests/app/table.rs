//! The table of every pane: order, filter, columns, keyboard, links, copying.

use chromascope::app::ChromascopeApp;
use chromascope::command::Command;
use chromascope::jobs::Executor;
use chromascope::panes::widgets::table::DataTable;
use chromascope::plot_item::{PlotItem, SensorId};
use chromascope::view::{Sorting, TableLook, View};
use chromascope::workspaces::PaneKind;
use chromascope_figure::{Cell, Table};
use egui::accesskit::Role;
use egui_kittest::Harness;
use egui_kittest::kittest::{NodeT as _, Queryable};

use crate::panes::window_of;
use crate::screenshots::open;

/// The window with the numbers of the swatches in place of their picture.
fn numbers() -> Harness<'static, ChromascopeApp> {
    let mut window = open([1280.0, 800.0], egui::Theme::Dark);
    window.state_mut().view.saved.tables.insert(PaneKind::SWATCHES);
    window.state_mut().push(Command::Maximize(PaneKind::SWATCHES));
    window.state_mut().view.focused = Some(PaneKind::SWATCHES);
    window.run_steps(3);
    window
}

/// Sensor and difference of the rows in sight, from above.
fn rows<S>(window: &Harness<'static, S>) -> Vec<String> {
    let mut rows: Vec<(f32, String)> = window
        .query_all_by_role(Role::Row)
        .map(|row| (row.rect().top(), row.accesskit_node().label().unwrap_or_default()))
        .collect();
    rows.sort_by(|a, b| a.0.total_cmp(&b.0));
    rows.into_iter().map(|(_, label)| label).collect()
}

fn head(window: &Harness<'static, ChromascopeApp>, name: &str) -> egui::Rect {
    window.get_by_role_and_label(Role::ColumnHeader, name).rect()
}

fn look(window: &Harness<'static, ChromascopeApp>) -> TableLook {
    window.state().view.saved.looks.get("Swatches").cloned().unwrap_or_default()
}

fn patch(name: &str, sensor: &str) -> PlotItem {
    let source = SensorId { kind: chromascope::document::SetKind::Camera, name: sensor.to_owned() };
    PlotItem::Patch { source: Some(source), patch: name.to_owned() }
}

/// Text that the last frame put on the clipboard.
fn copied(window: &Harness<'static, ChromascopeApp>) -> Option<String> {
    window.output().platform_output.commands.iter().find_map(|command| match command {
        egui::OutputCommand::CopyText(text) => Some(text.clone()),
        _ => None,
    })
}

#[test]
fn a_head_sorts_both_ways_and_then_as_given() {
    let mut window = numbers();
    let given = rows(&window);
    assert_eq!(given.len(), 20, "four sensors, five patches: {given:?}");
    for (sorting, first) in [(Some(false), "Canon 10D"), (Some(true), "S&B 1955"), (None, given[0].as_str())] {
        window.get_by_role_and_label(Role::ColumnHeader, "sensor").click();
        window.run_steps(3);
        let expected = sorting.map(|descending| Sorting { column: "sensor".to_owned(), descending });
        assert_eq!(look(&window).sorting, expected);
        assert!(rows(&window)[0].starts_with(first), "{sorting:?}: {:?}", rows(&window));
    }
    assert_eq!(rows(&window), given);
}

#[test]
fn a_filter_leaves_the_rows_with_its_words() {
    let mut window = numbers();
    window.get_by_role_and_label(Role::TextInput, "Filter rows").focus();
    window.run_steps(2);
    window.get_by_role_and_label(Role::TextInput, "Filter rows").type_text("nikon BLUE");
    window.run_steps(3);
    assert_eq!(rows(&window).len(), 1);
    assert!(window.query_by_label("1 of 20").is_some());
    window.get_by_label("Clear").click();
    window.run_steps(3);
    assert_eq!(rows(&window).len(), 20);
}

#[test]
fn columns_are_chosen_and_kept() {
    let mut window = numbers();
    assert!(window.query_by_role_and_label(Role::ColumnHeader, "srgb_r").is_some());
    window.get_by_label("Columns").click();
    window.run_steps(3);
    window.get_by_role_and_label(Role::CheckBox, "srgb_r").click();
    window.run_steps(3);
    assert!(window.query_by_role_and_label(Role::ColumnHeader, "srgb_r").is_none());
    let saved = window.state().saved_view();
    let read: chromascope::view::SavedView = ron::from_str(&ron::to_string(&saved).unwrap()).unwrap();
    assert_eq!(read.looks["Swatches"].columns, [("srgb_r".to_owned(), false)].into());
}

#[test]
fn rows_are_linked_with_all_panes() {
    let mut window = numbers();
    let row = rows(&window).iter().position(|row| row.contains("DCS200")).expect("a camera");
    let at = window.query_all_by_role(Role::Row).nth(row).expect("its row").rect();
    window.hover_at(at.left_center() + egui::vec2(4.0, 0.0));
    window.run_steps(3);
    assert!(window.state().view.hovered.is_some(), "under the pointer in all panes");
    window.query_all_by_role(Role::Row).nth(row).expect("its row").click();
    window.run_steps(3);
    assert_eq!(window.state().view.selected, Some(patch("red", "Kodak DCS200")));
    for key in [egui::Key::ArrowDown, egui::Key::ArrowDown, egui::Key::ArrowUp] {
        window.key_press(key);
        window.run_steps(2);
    }
    assert_eq!(window.state().view.selected, Some(patch("green", "Kodak DCS200")));
    window.key_press(egui::Key::End);
    window.run_steps(2);
    let last = window.state().view.selected.clone();
    assert!(last.is_some() && last != Some(patch("green", "Kodak DCS200")));
}

#[test]
fn rows_are_copied_as_shown_with_their_conditions() {
    let mut window = numbers();
    window.get_by_role_and_label(Role::TextInput, "Filter rows").focus();
    window.run_steps(2);
    window.get_by_role_and_label(Role::TextInput, "Filter rows").type_text("D70");
    window.run_steps(2);
    window.state_mut().view.saved.looks.get_mut("Swatches").unwrap().columns = [("srgb_r".to_owned(), false)].into();
    // The field has the keyboard no longer.
    window.key_press(egui::Key::Tab);
    window.run_steps(2);
    window.event(egui::Event::Copy);
    window.step();
    let text = copied(&window).expect("copied");
    let lines: Vec<&str> = text.lines().collect();
    assert_eq!(lines.len(), 6, "{text}");
    assert!(lines[0].starts_with("sensor\tpatch\tr\tg\tb\t") && !lines[0].contains("srgb_r"), "{}", lines[0]);
    assert!(
        lines[0].contains("\treference\tilluminant\t") && lines[1].contains("\tStiles & Burch 1955 2°\tE\tunity\t"),
        "{text}"
    );
    assert!(lines[1..].iter().all(|line| line.starts_with("Nikon D70 (2007)\t")), "{text}");
}

#[test]
fn only_rows_in_sight_are_laid_out() {
    let mut window = numbers();
    window.state_mut().view.saved.tables.insert(PaneKind::CHROMATICITY);
    window.state_mut().push(Command::Maximize(PaneKind::SWATCHES));
    window.state_mut().push(Command::Maximize(PaneKind::CHROMATICITY));
    window.run_steps(3);
    let laid_out = rows(&window).len();
    assert!((20..60).contains(&laid_out), "{laid_out}");
    let top = head(&window, "sensor").top();
    window.state_mut().view.focused = Some(PaneKind::CHROMATICITY);
    let first = rows(&window);
    window.key_press(egui::Key::End);
    window.run_steps(4);
    let last = rows(&window);
    assert!((20..60).contains(&last.len()) && last != first, "scrolled to the last row: {last:?}");
    assert_eq!(head(&window, "sensor").top(), top, "the head stays");
}

/// Cameras and heads of a table as it is shown.
fn shown(look: &TableLook, starts_hidden: bool) -> [Vec<String>; 2] {
    let mut table = Table::new(["camera", "error"]);
    table.columns[1].starts_hidden = starts_hidden;
    for (name, value) in [("Nikon D70", Some(0.4)), ("Canon 10D", Some(0.3)), ("Sony", None), ("Nikon D90", Some(0.4))]
    {
        table.push([Cell::from(name), Cell::from(value)]);
    }
    let mut view = View::default();
    view.saved.looks.insert("Errors".to_owned(), look.clone());
    let window = window_of(&Executor::driven(), view, move |ui, context| {
        DataTable::new(PaneKind::new("Errors"), "Errors", &table).show(ui, ui.max_rect(), context);
    });
    let first = |row: String| row.split(':').next().unwrap_or_default().to_owned();
    let heads = window.query_all_by_role(Role::ColumnHeader).filter_map(|head| head.accesskit_node().label());
    [rows(&window).into_iter().map(first).collect(), heads.collect()]
}

#[test]
fn sorting_is_stable_and_leaves_empty_cells_last() {
    let mut look = TableLook::default();
    let sorted = |look: &TableLook| shown(look, false)[0].clone();
    assert_eq!(sorted(&look), ["Nikon D70", "Canon 10D", "Sony", "Nikon D90"]);
    look.sort_by("error", false);
    assert_eq!(sorted(&look), ["Canon 10D", "Nikon D70", "Nikon D90", "Sony"]);
    look.sort_by("error", false);
    assert_eq!(sorted(&look), ["Nikon D70", "Nikon D90", "Canon 10D", "Sony"]);
    look.sort_by("error", false);
    assert_eq!(look.sorting, None);
}

#[test]
fn every_word_of_the_filter_is_in_some_cell() {
    let look = TableLook { filter: " d90 NIKON".to_owned(), ..TableLook::default() };
    assert_eq!(shown(&look, false)[0], ["Nikon D90"]);
}

#[test]
fn the_first_column_stays() {
    let hidden = [("camera".to_owned(), false), ("error".to_owned(), false)].into();
    let look = TableLook { columns: hidden, ..TableLook::default() };
    assert_eq!(shown(&look, false)[1], ["camera"]);
    assert_eq!(shown(&TableLook::default(), true)[1], ["camera"]);
    assert_eq!(shown(&TableLook::default(), false)[1], ["camera", "error"]);
}
