//! Tests of the Import pane: the files, and the text of the selected one.

use std::sync::Arc;

use chromascope::app::ChromascopeApp;
use chromascope::workspaces::PaneKind;
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable as _;

use crate::import_switches::{says, settle};
use crate::own_data::Dropped;
use crate::screenshots::open;
use crate::waiting::until;

type Window = Harness<'static, ChromascopeApp>;

const LEAF: &str = "nm;leaf (%)\n400;5,0\n500;10,0\n600;20,0\n700;50,0\n";

/// The window with files that were dropped on it, in Import.
fn window(size: [f32; 2], theme: egui::Theme, files: &[(&str, Vec<u8>)]) -> Window {
    let mut window = open(size, theme);
    window.state_mut().view.show(PaneKind::IMPORT);
    for (index, (name, bytes)) in files.iter().enumerate() {
        let file = Dropped((*name).into(), bytes.clone());
        window.input_mut().dropped_files.push(Arc::new(file));
        until(name, || {
            window.run_steps(1);
            let opened = &window.state().opened;
            let read = opened.files().len() > index && opened.progress().is_none();
            if read { Ok(()) } else { Err(window.state().view.status.text.clone()) }
        });
    }
    settle(&mut window);
    window
}

/// Number of computations of each kind of query on the files.
fn computed(window: &Window) -> Vec<(&'static str, u64)> {
    let counts = window.state().results.counts().into_iter().filter(|(name, _)| name.ends_with(" a file"));
    counts.map(|(name, count)| (name, count.misses)).collect()
}

#[test]
fn without_a_file_there_are_ways_to_open_one() {
    let mut window = open([1280.0, 800.0], egui::Theme::Dark);
    window.state_mut().view.show(PaneKind::IMPORT);
    window.run_steps(2);
    for words in ["Open…", "Open folder…", "paste data"] {
        assert!(says(&window, words), "{words}");
    }
}

#[test]
fn a_file_that_failed_shows_the_line_where() {
    let row = |i: u32| if i == 300 { "700,oops\n".to_owned() } else { format!("{},0.{i}\n", 400 + i) };
    let text = format!("nm,leaf\n{}", (0..400).map(row).collect::<Vec<_>>().concat());
    let files = [("leaf.csv", LEAF.as_bytes().to_vec()), ("noisy.csv", text.into_bytes())];
    let mut window = window([1280.0, 800.0], egui::Theme::Dark, &files);
    // What failed is selected at once.
    assert!(says(&window, "302: 700,oops") && !says(&window, "2: 400;5,0"));
    window.state_mut().view.focused = Some(PaneKind::IMPORT);
    // In the list of files; the set is in the table above, too.
    window.get_all_by_label_contains("leaf: ").last().expect("listed").click();
    settle(&mut window);
    assert!(says(&window, "2: 400;5,0"));
    window.state_mut().view.import.line = Some(5);
    window.run_steps(2);
    assert_eq!(window.state().view.import.line, None);
    window.key_press(egui::Key::ArrowDown);
    settle(&mut window);
    assert!(says(&window, "302: 700,oops"));
    window.key_press(egui::Key::Delete);
    settle(&mut window);
    assert!(!says(&window, "noisy.csv: line") && says(&window, "2: 400;5,0"));
}

#[test]
fn a_value_under_the_pointer_says_what_it_is() {
    let mut window = window([1280.0, 800.0], egui::Theme::Light, &[("leaf.csv", LEAF.as_bytes().to_vec())]);
    let line = window.get_by_label("3: 500;10,0").rect();
    window.hover_at(egui::pos2(line.left() + 48.0 + 5.5 * 7.5, line.center().y));
    window.run_steps(3);
    assert_eq!(window.state().view.import.hovered_curve, Some(0));
    window.hover_at(egui::pos2(10.0, 10.0));
    window.run_steps(3);
    assert_eq!(window.state().view.import.hovered_curve, None);
}

#[test]
fn of_a_long_file_only_the_lines_in_sight_are_laid_out() {
    let row = |i: u32| format!("{}\t0.{:04}\n", 300.0 + f64::from(i) / 100.0, i % 9999);
    let rows = (0..100_000).map(row).collect::<Vec<_>>().concat();
    let mut window = window([1280.0, 800.0], egui::Theme::Dark, &[("long.txt", rows.into_bytes())]);
    window.state_mut().view.maximized = Some(PaneKind::IMPORT);
    settle(&mut window);
    let read = computed(&window);
    for line in (1..100_000).step_by(9_973) {
        window.state_mut().view.import.line = Some(line);
        window.run_steps(2);
        assert!(says(&window, &format!("{line}: ")), "{line}");
        let is_line = |text: &str| text.split_once(": ").is_some_and(|(number, _)| number.parse::<u32>().is_ok());
        let lines =
            window.query_all_by(|node| node.label().or(node.value()).is_some_and(|text| is_line(&text))).count();
        assert!((10..100).contains(&lines), "{lines} lines of text at line {line}");
    }
    assert_eq!(computed(&window), read, "scrolling reads nothing again");
}
