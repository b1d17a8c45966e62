//! Appearance of Import and its plots: no text overlaps curves or other text.

use chromascope::catalog::import::import;
use chromascope::document::{Document, SetKind};
use chromascope::figures::curves::{self, ImportItem, ImportSelection};
use chromascope::figures::look::FigureLook;
use chromascope::figures::{spectra, swatches};
use chromascope::results::Results;
use chromascope::scene::Scene;
use chromascope_core::query::Shared;
use chromascope_figure::{Panel, Shape, TextSize, text_width};
use egui::accesskit::Role;
use egui_kittest::kittest::Queryable as _;

use crate::import_switches::{drop_file, says, settle};
use crate::screenshots::open;

/// A document with a set of the user's in it, and what shows that in Import.
fn of(name: &str, text: &str) -> (Document, ImportItem) {
    let set = import(name, text.as_bytes(), None).unwrap().set;
    let mut document = Document::paper();
    let item = ImportItem::Set(set.name.clone());
    let set = Shared::new(set);
    document.put_to_use(&set);
    document.own.push(set);
    (document, item)
}

/// The highest point of the lines from a wavelength on, as a share of the panel.
fn top(panel: &Panel, from: f64) -> f64 {
    let lines = panel.marks.iter().filter_map(|mark| match &mark.shape {
        Shape::Line { points, .. } if points.len() > 2 => Some(points),
        _ => None,
    });
    let high = lines.flatten().filter(|point| point[0] >= from && point[1].is_finite()).map(|point| point[1]);
    let [low, above] = panel.y.range;
    (high.fold(low, f64::max) - low) / (above - low)
}

fn noisy() -> String {
    let value = |nm: i32| if nm > 800 { if nm % 2 == 0 { 900.0 } else { -900.0 } } else { 1.0 + f64::from(nm % 50) };
    let rows = (380..850).map(|nm| format!("{nm},{}\n", value(nm))).collect::<Vec<_>>().concat();
    format!("# title: Lamp\nnm,spectral power distribution (W)\n{rows}")
}

#[test]
fn spikes_beyond_the_plot_are_said_and_not_drawn() {
    let (document, item) = of("lamp.csv", &noisy());
    let (catalog, results) = (chromascope::catalog::Catalog::built_in(), Results::default());
    let scene = Scene { document: &document, catalog: &catalog, results: &results };
    let shown = ImportSelection::of(&scene, item, None, None).unwrap();
    let curves = curves::Curves::of(&shown, 10).unwrap();
    for height in [90.0, 160.0, 600.0] {
        let panel = curves::panel(&curves, [600.0, height], None);
        assert!(panel.note.contains("outside the visible range values run from −900 to 900"), "{}", panel.note);
        for mark in &panel.marks {
            if let Shape::Line { points, .. } | Shape::Points { points, .. } = &mark.shape {
                let within = |y: f64| !y.is_finite() || (panel.y.range[0]..=panel.y.range[1]).contains(&y);
                assert!(points.iter().all(|point| within(point[1])), "{height}");
            }
        }
        // Two lines of small text stand above the curves.
        assert!((1.0 - top(&panel, 0.0)) * (height - 24.0) >= 26.0, "{height}: {}", top(&panel, 0.0));
    }
}

#[test]
fn notes_of_plots_stand_above_the_curves() {
    let rows = (0..14).map(|i| format!(",leaf {i}")).collect::<Vec<_>>().concat();
    let row = |nm: u32| format!("{nm}{}\n", ",0.99".repeat(14));
    let (document, _) = of("a chart with a name.csv", &format!("nm{rows}\n{}", [400, 500, 600, 700].map(row).concat()));
    let (catalog, results) = (chromascope::catalog::Catalog::built_in(), Results::default());
    let scene = Scene { document: &document, catalog: &catalog, results: &results };
    for size in [[300.0, 300.0], [680.0, 640.0]] {
        for panel in &spectra::build(&scene, &FigureLook::default(), size).panels {
            if panel.note.is_empty() {
                continue;
            }
            let height = panel.area.max[1] - panel.area.min[1];
            let from = 780.0 - 400.0 * text_width(&panel.note, TextSize::Small) / size[0];
            let free = (1.0 - top(panel, from)) * height;
            assert!(free >= 16.0, "{}: {free} points of {height}", panel.note);
        }
    }
}

#[test]
fn names_above_swatches_keep_to_their_columns() {
    let names = (0..5).map(|i| format!(",a leaf with a very long name {i}")).collect::<Vec<_>>().concat();
    let row = |nm: u32| format!("{nm},0.1,0.2,0.3,0.4,0.5\n");
    let (mut document, _) = of("leaves.csv", &format!("nm{names}\n{}", [400, 500, 600, 700].map(row).concat()));
    for entry in chromascope::catalog::Catalog::built_in().of_kind(SetKind::Camera).take(6) {
        document.compare(&entry.name, SetKind::Camera);
    }
    let (catalog, results) = (chromascope::catalog::Catalog::built_in(), Results::default());
    let scene = Scene { document: &document, catalog: &catalog, results: &results };
    for layout in [chromascope::view::SwatchLayout::Rows, chromascope::view::SwatchLayout::Charts] {
        let look = FigureLook { swatch_layout: layout, ..FigureLook::default() };
        let panel = swatches::build(&scene, &look, [700.0, 200.0]).panel;
        let mut words: Vec<[f64; 3]> = Vec::new();
        for mark in &panel.marks {
            if let Shape::Text { at, text, anchor, size, .. } = &mark.shape {
                let width = text_width(text, *size);
                let left = at[0] - anchor.0 * width;
                words.push([left, left + width, at[1]]);
            }
        }
        for (index, a) in words.iter().enumerate() {
            for b in &words[..index] {
                let apart = (a[2] - b[2]).abs() > 4.0 || a[0] >= b[1] || b[0] >= a[1];
                assert!(apart, "{layout:?}: {a:?} {b:?}");
            }
        }
    }
}

#[test]
fn notes_are_led_to_where_they_are_out_of_sight() {
    let mut window = open([900.0, 600.0], egui::Theme::Light);
    let head = (0..12).map(|i| format!(",leaf {i}")).collect::<Vec<_>>().concat();
    let row = |nm: u32| format!("{nm}{}\n", ",0.5".repeat(12));
    let text = format!("nm{head}\n{}", [400, 500, 500, 600, 700].map(row).concat());
    drop_file(&mut window, "leaves.csv", &text);
    window.get_by_role_and_label(Role::Button, "1 note").click();
    settle(&mut window);
    let inside = |node: egui_kittest::Node<'_>| node.rect().bottom() < 540.0;
    let note = window.query_all_by(|node| {
        node.value().is_some_and(|v| v.contains("counted once"))
            || node.label().is_some_and(|l| l.contains("counted once"))
    });
    assert!(note.into_iter().any(inside), "the note is in sight");
    assert!(says(&window, "decisions"));
}

#[test]
fn the_marks_before_files_have_a_legend() {
    let mut window = open([1280.0, 800.0], egui::Theme::Dark);
    drop_file(&mut window, "leaf.csv", "nm;leaf\n400;5,5\n500;10,5\n600;20,5\n700;50,5\n");
    let all = ["read, with guesses that nobody has looked at", "not used", "not read"];
    assert!(all.iter().all(|words| !says(&window, words)));
    window.get_by_role_and_label(Role::Label, "1 file").hover();
    for _ in 0..60 {
        window.run_steps(1);
    }
    assert!(all.iter().all(|words| says(&window, words)));
}

#[test]
fn the_foot_of_a_file_that_failed_stays_above_the_status() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("broken.csv");
    std::fs::write(&path, "nm,a\n400,1\n410,2\n420,0.2x\n430,3\n440,4\n450,5\n").unwrap();
    for size in [[900.0, 600.0], [1280.0, 800.0], [1920.0, 1200.0]] {
        let mut window = open(size, egui::Theme::Dark);
        window.state_mut().push(chromascope::command::Command::OpenPath(path.clone()));
        crate::import_switches::until(&mut window, "a failure", |app| !app.view.status.text.is_empty());
        window.state_mut().view.show(chromascope::workspaces::PaneKind::IMPORT);
        window.run_steps(4);
        // The status bar is 24 points high.
        let foot = window.get_by_role_and_label(Role::CheckBox, "Reload when the file changes").rect();
        assert!(foot.bottom() <= size[1] - 24.0, "{foot:?} in {size:?}");
    }
}
