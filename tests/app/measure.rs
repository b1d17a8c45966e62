//! A camera measured from a picture of a chart: found or marked by hand, recovered, and put to use.

use std::path::{Path, PathBuf};

use chromascope::action::history::History;
use chromascope::app::ChromascopeApp;
use chromascope::command::Command;
use chromascope::document::session::{from_json, to_json};
use chromascope::document::{Document, SetKind};
use chromascope::files::Files;
use chromascope::jobs::Executor;
use chromascope::view::SavedView;
use chromascope::workspaces::PaneKind;
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable as _;

use crate::cpu_renderer::Cpu;
use crate::recorded::recording;
use crate::waiting;

type Window = Harness<'static, ChromascopeApp>;

const CORNERS: [[f64; 2]; 4] = [[60.0, 40.0], [540.0, 40.0], [540.0, 360.0], [60.0, 360.0]];

fn window() -> Window {
    let mut window =
        Harness::builder().with_size([1280.0, 800.0]).with_pixels_per_point(1.0).renderer(Cpu::default()).build_eframe(
            |cc| {
                let history = History::new(Document::colorimetry());
                ChromascopeApp::on(&Executor::default(), &cc.egui_ctx, history, SavedView::default(), Files::new(None))
            },
        );
    window.run();
    window
}

/// A picture of the chart with gaps of a width between its patches, on a dark frame.
fn picture(name: &str, gap: u32) -> PathBuf {
    let (rows, path) = (recording(), Path::new(env!("CARGO_TARGET_TMPDIR")).join(name));
    let pixel = |x: u32, y: u32| {
        if !(60..540).contains(&x) || !(40..360).contains(&y) {
            return image::Rgb([9000, 12000, 8000]);
        }
        let ((column, u), (row, v)) = (((x - 60) / 80, (x - 60) % 80), ((y - 40) / 80, (y - 40) % 80));
        let inside = [u, v].iter().all(|at| (gap / 2..80 - gap / 2).contains(at));
        // Some noise, equal on each run.
        let noise = |c: u32| 1.0 + 0.01 * (f64::from((x * 31 + y * 17 + c * 7) % 13) / 6.0 - 1.0);
        let value = |c: u32| (rows[(row * 6 + column) as usize].1[c as usize] * noise(c)) as u16;
        image::Rgb(if inside { [0, 1, 2].map(value) } else { [900, 1100, 800] })
    };
    image::ImageBuffer::<image::Rgb<u16>, Vec<u16>>::from_fn(600, 400, pixel).save(&path).unwrap();
    path
}

fn until(window: &mut Window, words: &str) {
    waiting::until(words, || {
        window.run_steps(2);
        window.query_by_label_contains(words).map(|_| ()).ok_or_else(|| "not yet".to_owned())
    });
}

#[test]
fn a_photographed_chart_becomes_a_camera() {
    let mut window = window();
    window.state_mut().push(Command::OpenPath(picture("measured.png", 12)));
    until(&mut window, "Add to the library");
    assert!(window.state().view.is_shown(PaneKind::MEASURE), "wherever a picture is opened, it leads there");
    let shots = window.state().history.document().measurement.shots.clone();
    for (corner, wanted) in shots[0].corners.iter().zip(CORNERS) {
        assert!((corner[0] - wanted[0]).hypot(corner[1] - wanted[1]) < 3.0, "{:?}", shots[0].corners);
    }
    // All that is known of the picture is in the document: it opens elsewhere, without the picture.
    let document = window.state().history.document().clone();
    assert_eq!(from_json(&to_json(&document).unwrap()).unwrap().measurement, document.measurement);
    // The table of the camera that recorded it fits best.
    until(&mut window, "1. Nikon D70 (A.M.P.A.S.)");
    window.get_by_label("Add to the library and compare").click();
    window.run_steps(3);
    let document = window.state().history.document();
    let set = document.own.iter().find(|set| SetKind::of_own(set) == SetKind::Camera).expect("it is a camera");
    assert!(set.covariance.is_some() && set.curves.iter().all(|curve| curve.uncertainty.is_some()));
    assert!(document.compared(SetKind::Camera, &set.name).is_some());
    window.state_mut().push(Command::Undo);
    window.state_mut().push(Command::Undo);
    window.run_steps(2);
    assert!(window.state().history.document().measurement.shots.is_empty(), "each change is a step back");
}

#[test]
fn where_no_chart_is_found_its_corners_are_clicked() {
    let mut window = window();
    window.state_mut().push(Command::OpenPath(picture("gapless.png", 0)));
    until(&mut window, "Picture of the chart");
    window.state_mut().push(Command::Do(chromascope::action::Action::Measure("none", Box::default())));
    window.run_steps(2);
    if window.query_by_label_contains("click the top left corner").is_none() {
        return;
    }
    let plot = window.get_by_label("Picture of the chart").rect();
    let scale = (plot.width() / 600.0).min(plot.height() / 400.0);
    let at = |[x, y]: [f64; 2]| plot.center() + egui::vec2((x as f32 - 300.0) * scale, (y as f32 - 200.0) * scale);
    for corner in CORNERS {
        window.hover_at(at(corner));
        window.run_steps(1);
        for pressed in [true, false] {
            let (pos, button, modifiers) = (at(corner), egui::PointerButton::Primary, egui::Modifiers::NONE);
            window.event(egui::Event::PointerButton { pos, button, pressed, modifiers });
        }
        window.run_steps(3);
    }
    until(&mut window, "Add to the library");
    let shots = &window.state().history.document().measurement.shots;
    for (corner, wanted) in shots[0].corners.iter().zip(CORNERS) {
        assert!((corner[0] - wanted[0]).hypot(corner[1] - wanted[1]) < 6.0, "{:?}", shots[0].corners);
    }
}

#[test]
fn a_picture_that_holds_no_raw_values_says_what_to_do() {
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join("photo.cr2");
    std::fs::write(&path, b"II*\0\x10\0\0\0CR\x02\0").unwrap();
    let mut window = window();
    window.state_mut().push(Command::OpenPath(path));
    until(&mut window, "DNG");
}
