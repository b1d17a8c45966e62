//! A camera measured from a picture of a chart: found or marked by hand, recovered, and put to use.

use std::path::{Path, PathBuf};

use chromascope::action::Action;
use chromascope::action::history::History;
use chromascope::app::ChromascopeApp;
use chromascope::command::Command;
use chromascope::document::render::MeshChoice;
use chromascope::document::session::{from_json, to_json};
use chromascope::document::{Document, Light, SensorId, SetKind};
use chromascope::files::Files;
use chromascope::jobs::Executor;
use chromascope::plot_item::PlotItem;
use chromascope::view::SavedView;
use chromascope::workspaces::{PaneKind, Workspace};
use chromascope_core::patch_set::PatchSet;
use chromascope_core::spectral::Dataset;
use egui_kittest::Harness;
use egui_kittest::kittest::{NodeT as _, Queryable as _};

use crate::cpu_renderer::Cpu;
use crate::recorded::{recording, recording_of};
use crate::waiting;

pub(crate) type Window = Harness<'static, ChromascopeApp>;

const CORNERS: [[f64; 2]; 4] = [[60.0, 40.0], [540.0, 40.0], [540.0, 360.0], [60.0, 360.0]];

pub(crate) fn window() -> Window {
    window_on(&Executor::default())
}

fn window_on(executor: &Executor) -> Window {
    let executor = executor.clone();
    let mut window =
        Harness::builder().with_size([1280.0, 800.0]).with_pixels_per_point(1.0).renderer(Cpu::default()).build_eframe(
            move |cc| {
                let history = History::new(Document::colorimetry());
                ChromascopeApp::on(&executor, &cc.egui_ctx, history, SavedView::default(), Files::new(None))
            },
        );
    window.run();
    window
}

/// A picture of the chart with gaps of a width between its patches, on a dark frame.
pub(crate) fn picture(name: &str, gap: u32) -> PathBuf {
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

pub(crate) fn until(window: &mut Window, words: &str) {
    waiting::until(words, || {
        window.run_steps(2);
        window.query_by_label_contains(words).map(|_| ()).ok_or_else(|| "not yet".to_owned())
    });
}

/// Names the light of a picture.
pub(crate) fn name_light(window: &mut Window, shot: usize, light: Light) {
    let mut to = window.state().history.document().measurement.clone();
    to.shots[shot].light = Some(light);
    window.state_mut().push(Command::Do(Action::Measure("Light of a picture", Box::new(to))));
    window.run_steps(2);
}

fn can(window: &Window, button: &str) -> bool {
    !window.get_by_label(button).accesskit_node().is_disabled()
}

/// The light that pictures of these tests are recorded under.
fn own_light() -> Light {
    Document::colorimetry().light
}

pub(crate) fn cameras(window: &Window) -> Vec<String> {
    let own = &window.state().history.document().own;
    own.iter().filter(|set| SetKind::of_own(set) == SetKind::Camera).map(|set| set.name.clone()).collect()
}

const ADD: &str = "Add to the library and compare";

#[test]
fn a_photographed_chart_becomes_a_camera() {
    let mut window = window();
    window.state_mut().push(Command::OpenPath(picture("measured.png", 12)));
    until(&mut window, "Choose the light that measured.png");
    assert!(!can(&window, ADD), "nothing is known without the light");
    assert!(window.state().view.is_shown(PaneKind::MEASURE), "wherever a picture is opened, it leads there");
    name_light(&mut window, 0, own_light());
    until(&mut window, "1. Nikon D70 (A.M.P.A.S.)");
    for words in ["red, %", "leave-one-out", "± is expanded", "ForwardMatrix", "not the photographs", "BabelColor"] {
        assert!(window.query_all_by_label_contains(words).next().is_some(), "{words}");
    }
    let shots = window.state().history.document().measurement.shots.clone();
    for (corner, wanted) in shots[0].corners.iter().zip(CORNERS) {
        assert!((corner[0] - wanted[0]).hypot(corner[1] - wanted[1]) < 3.0, "{:?}", shots[0].corners);
    }
    // All that is known of the picture is in the document: it opens elsewhere, without the picture.
    let document = window.state().history.document().clone();
    assert_eq!(from_json(&to_json(&document).unwrap()).unwrap().measurement, document.measurement);
    for _ in 0..2 {
        window.get_by_label(ADD).click();
        window.run_steps(3);
        assert_eq!(cameras(&window), ["My camera (measured)"], "added again, it takes its own place");
        until(&mut window, "1. Nikon D70 (A.M.P.A.S.)");
    }
    let document = window.state().history.document();
    let set = document.own.iter().find(|set| SetKind::of_own(set) == SetKind::Camera).expect("it is a camera");
    assert!(set.covariance.is_some() && set.curves.iter().all(|curve| curve.uncertainty.is_some()));
    assert!(document.compared(SetKind::Camera, &set.name).is_some());
    let id = SensorId { kind: SetKind::Camera, name: set.name.clone() };
    window.get_by_label("Show in Rank").click();
    window.run_steps(3);
    assert_eq!(window.state().view.selected, Some(PlotItem::Sensor(id)));
    assert_eq!(window.state().view.saved.workspace, Workspace::Rank);
    assert_eq!(window.state().history.undo_name(), Some("Add camera My camera (measured)"));
    for _ in 0..4 {
        window.state_mut().push(Command::Undo);
        window.run_steps(2);
    }
    assert!(window.state().history.document().measurement.shots.is_empty(), "each change is a step back");
}

/// A wrong light is refused beside a right one as it is alone, and what is on show is not put to use meanwhile.
#[test]
fn results_of_other_conditions_are_not_put_to_use() {
    let executor = Executor::driven();
    let mut window = window_on(&executor);
    let settle = |window: &mut Window| {
        for _ in 0..6 {
            executor.run_all();
            window.run_steps(2);
        }
    };
    for name in ["first.png", "second.png"] {
        window.state_mut().push(Command::OpenPath(picture(name, 12)));
        window.run_steps(2);
        settle(&mut window);
    }
    for shot in 0..2 {
        name_light(&mut window, shot, own_light());
    }
    settle(&mut window);
    assert!(can(&window, ADD) && window.query_by_label("Computing…").is_none());
    name_light(&mut window, 1, Light::Set("FL11".to_owned()));
    assert!(!can(&window, ADD) && !can(&window, "DCP…") && window.query_by_label("Computing…").is_some());
    settle(&mut window);
    assert!(!can(&window, ADD) && window.query_by_label_contains("second.png by itself").is_some());
    name_light(&mut window, 1, own_light());
    settle(&mut window);
    assert!(can(&window, ADD));
}

/// Clicks corners in a picture of a size.
fn click_corners(window: &mut Window, [width, height]: [f32; 2], corners: [[f64; 2]; 4]) {
    let plot = window.get_by_label("Picture of the chart").rect();
    let scale = (plot.width() / width).min(plot.height() / height);
    let at =
        |[x, y]: [f64; 2]| plot.center() + scale * (egui::vec2(x as f32, y as f32) - egui::vec2(width, height) / 2.0);
    for corner in corners {
        window.hover_at(at(corner));
        window.run_steps(1);
        for pressed in [true, false] {
            let (pos, button, modifiers) = (at(corner), egui::PointerButton::Primary, egui::Modifiers::NONE);
            window.event(egui::Event::PointerButton { pos, button, pressed, modifiers });
        }
        window.run_steps(3);
    }
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
    click_corners(&mut window, [600.0, 400.0], CORNERS);
    until(&mut window, "Choose the light that gapless.png");
    let shots = &window.state().history.document().measurement.shots;
    for (corner, wanted) in shots[0].corners.iter().zip(CORNERS) {
        assert!((corner[0] - wanted[0]).hypot(corner[1] - wanted[1]) < 6.0, "{:?}", shots[0].corners);
    }
}

#[test]
fn pictures_dropped_together_are_all_measured() {
    let mut window = window();
    let broken = Path::new(env!("CARGO_TARGET_TMPDIR")).join("broken.dng");
    std::fs::write(&broken, b"II*\0 no picture").unwrap();
    let all = vec![picture("first.tiff", 12), broken, picture("second.tiff", 12)];
    window.state_mut().open_at_start(all);
    let shots = |window: &Window| window.state().history.document().measurement.shots.clone();
    waiting::until("both pictures", || {
        window.run_steps(2);
        let names: Vec<_> = shots(&window).into_iter().map(|shot| shot.file).collect();
        if names == ["first.tiff", "second.tiff"] { Ok(()) } else { Err(format!("{names:?}")) }
    });
    // The one that is not shown can be.
    window.get_by_label("first.tiff").click();
    until(&mut window, "Picture: first.tiff");
}

/// Cameras number their files anew: pictures are told apart by what they hold.
#[test]
fn pictures_of_one_name_in_two_folders_are_two() {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR"));
    let in_folder = |name: &str, gap: u32| {
        std::fs::create_dir_all(folder.join(name)).unwrap();
        picture(&format!("{name}/DSC_0001.png"), gap)
    };
    let (day, lamp) = (in_folder("day", 12), in_folder("lamp", 14));
    let mut window = window();
    let holds = |window: &mut Window, wanted: &[&str]| {
        waiting::until("the pictures", || {
            window.run_steps(2);
            let shots = &window.state().history.document().measurement.shots;
            let names: Vec<&str> = shots.iter().map(|shot| shot.file.as_str()).collect();
            if names == wanted { Ok(()) } else { Err(format!("{names:?}")) }
        });
    };
    window.state_mut().push(Command::OpenPath(day.clone()));
    holds(&mut window, &["DSC_0001.png"]);
    // As in documents of earlier versions, which know names only.
    let mut json: serde_json::Value =
        serde_json::from_str(&to_json(window.state().history.document()).unwrap()).unwrap();
    json["measurement"]["shots"][0].as_object_mut().unwrap().remove("contents").unwrap();
    let old = from_json(&json.to_string()).unwrap().measurement;
    assert!(old.shots[0].contents.is_none() && old.origin().is_some());
    assert_eq!(old.place(window.state().history.document().measurement.origin().unwrap(), "DSC_0001.png"), Some(0));
    for path in [lamp, day] {
        window.state_mut().push(Command::OpenPath(path));
        holds(&mut window, &["day/DSC_0001.png", "lamp/DSC_0001.png"]);
    }
    window.get_by_label("lamp/DSC_0001.png").click();
    until(&mut window, "Picture: lamp/DSC_0001.png");
    // Folders of one name are told apart by those around them.
    window.state_mut().push(Command::OpenPath(in_folder("lamp/day", 16)));
    holds(&mut window, &["day/DSC_0001.png", "lamp/DSC_0001.png", "lamp/day/DSC_0001.png"]);
}

/// An OpenEXR is a spectral image by its channels, else a picture.
#[test]
fn an_openexr_is_opened_by_what_it_holds() {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR"));
    let rgb = image::open(picture("plain_source.png", 12)).unwrap().to_rgb32f();
    rgb.save(folder.join("plain.exr")).unwrap();
    let mut window = window();
    window.state_mut().push(Command::OpenPath(folder.join("plain.exr")));
    until(&mut window, "Choose the light that plain.exr");
    let spectral = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/spectral-image/data/openexr_reflectance.exr");
    window.state_mut().push(Command::OpenPath(spectral.clone()));
    waiting::until("the image", || {
        window.run_steps(2);
        let shown = &window.state().history.document().render.mesh;
        if *shown == MeshChoice::Image(spectral.clone()) { Ok(()) } else { Err(format!("{shown:?}")) }
    });
}

/// The tables of the selected camera's model, with what they differ by.
#[test]
fn tables_of_one_model_stand_on_a_page() {
    let mut window = window();
    let id = SensorId { kind: SetKind::Camera, name: "Nikon D70 (A.M.P.A.S.)".to_owned() };
    window.state_mut().push(Command::Select(PlotItem::Sensor(id)));
    window.state_mut().push(Command::GoTo(PaneKind::TABLES));
    until(&mut window, "each through its own matrix");
    for name in ["A.M.P.A.S.", "2007 figure", "UPenn 2011", "ΔE*00 to first", "blue at 400 nm"] {
        assert!(window.query_all_by_label_contains(name).next().is_some(), "{name}");
    }
}

#[test]
fn own_tables_of_one_file_name_are_told_apart_by_their_folders() {
    let text = std::fs::read_to_string("assets/cameras/nikon_d70_a_m_p_a_s.csv").unwrap();
    let mut window = window();
    for name in ["first", "second"] {
        let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("tables").join(name);
        std::fs::create_dir_all(&folder).unwrap();
        // Another table, not the same one again.
        let own = text.replacen("Nikon D70 (A.M.P.A.S.)", "Own", 1) + &format!("# note: {name}\n");
        std::fs::write(folder.join("own.csv"), own).unwrap();
        window.state_mut().push(Command::OpenPath(folder.join("own.csv")));
        window.run_steps(2);
        window.state().opened.wait();
        window.run_steps(3);
    }
    assert_eq!(cameras(&window), ["Own", "Own (2)"]);
    window.state_mut().push(Command::Select(PlotItem::Sensor(SensorId { kind: SetKind::Camera, name: "Own".into() })));
    window.state_mut().push(Command::GoTo(PaneKind::TABLES));
    until(&mut window, "each through its own matrix");
    for name in ["first/own.csv", "second/own.csv"] {
        assert!(window.query_all_by_label_contains(name).next().is_some(), "{name}");
    }
}

#[test]
fn a_picture_that_holds_no_raw_values_says_what_to_do() {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR"));
    image::RgbImage::new(8, 8).save(folder.join("photo.png")).unwrap();
    let eight_bits = std::fs::read(folder.join("photo.png")).unwrap();
    let mut window = window();
    for (name, bytes, words) in [
        ("photo.cr2", &b"II*\0\x10\0\0\0CR\x02\0"[..], "DNG Converter"),
        ("photo.NEF", b"no TIFF", "dnglab"),
        ("photo.cr3", b"\0\0\0\x18ftypcrx ", "DNG Converter"),
        ("photo.jpg", &eight_bits, "tone curve hides the raw values"),
        ("photo.heic", b"\0\0\0\x18ftypheic", "tone curve hides the raw values"),
    ] {
        std::fs::write(folder.join(name), bytes).unwrap();
        window.state_mut().push(Command::OpenPath(folder.join(name)));
        let told = format!("{name}: ");
        until(&mut window, &told);
        let told = window.query_by_label_contains(&told).unwrap().accesskit_node();
        assert!(told.label().or(told.value()).is_some_and(|told| told.contains(words)), "{name}");
    }
}

/// A chart of 14 × 10 patches, A1 to N10, in a file column by column, and a picture of it; with a name for both.
pub(crate) fn large_chart(name: &str) -> (PathBuf, PathBuf) {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR"));
    let text = chromascope_data::text("charts/training_reflectances_190.csv").unwrap();
    let rows = text.lines().filter(|line| !line.starts_with('#'));
    let mut table = format!("# title: {name}\n# quantity: reflectance factor\n# unit: 1\n");
    for (index, row) in rows.enumerate() {
        let cells: Vec<&str> = row.split(',').collect();
        let names = (0..140).map(|at| format!("{}{}", char::from(b'A' + at / 10), at % 10 + 1)).collect::<Vec<_>>();
        let values = if index == 0 { names.join(",") } else { cells[1..=140].join(",") };
        table += &[cells[0], ",", &values, "\n"].concat();
    }
    let (chart, picture) = (folder.join(format!("{name}.csv")), folder.join(format!("{name}.png")));
    std::fs::write(&chart, &table).unwrap();
    let recorded = recording_of(&PatchSet::from_dataset(&Dataset::read(&table).unwrap()));
    let pixel = |x: u32, y: u32| {
        let ((column, u), (row, v)) = ((x / 40, x % 40), (y / 40, y % 40));
        let noise = 1.0 + 0.004 * f64::from((x * 31 + y * 17) % 13) / 13.0;
        // Letters are columns.
        let value = |c: usize| (recorded[(column * 10 + row) as usize].1[c] * noise) as u16;
        image::Rgb(if (4..36).contains(&u) && (4..36).contains(&v) { [0, 1, 2].map(value) } else { [900; 3] })
    };
    image::ImageBuffer::<image::Rgb<u16>, Vec<u16>>::from_fn(560, 400, pixel).save(&picture).unwrap();
    (chart, picture)
}

#[test]
fn a_chart_of_another_grid_is_measured_by_its_own_reflectances() {
    let (chart, picture) = large_chart("My large chart");
    let mut window = window();
    window.state_mut().push(Command::OpenPath(chart));
    window.run_steps(2);
    window.state().opened.wait();
    window.state_mut().push(Command::OpenPath(picture));
    until(&mut window, "click the top left corner");
    // A little outside, where the picture ends.
    click_corners(&mut window, [560.0, 400.0], [[0.5, 0.5], [559.5, 0.5], [559.5, 399.5], [0.5, 399.5]]);
    until(&mut window, "Choose the light that My large chart.png");
    let shot = |window: &Window| window.state().history.document().measurement.shots[0].clone();
    assert_eq!((shot(&window).grid, shot(&window).patches.len()), ([6, 4], 24));
    window.get_by_label("Chart of the picture: ColorChecker 24 (BabelColor average)").click();
    window.run_steps(3);
    window.get_all_by_label("My large chart").last().unwrap().click();
    window.run_steps(3);
    assert_eq!((shot(&window).grid, shot(&window).patches.len()), ([14, 10], 140));
    assert!(window.query_by_label("Grid of the picture: 14 × 10").is_some());
    name_light(&mut window, 0, own_light());
    until(&mut window, "1. Nikon D70 (A.M.P.A.S.)");
    assert!(window.query_all_by_label_contains("N10").next().is_some() && can(&window, ADD));
    let document = window.state().history.document().clone();
    assert_eq!(from_json(&to_json(&document).unwrap()).unwrap().measurement, document.measurement);
    for _ in 0..2 {
        window.state_mut().push(Command::Undo);
        window.run_steps(2);
    }
    assert_eq!((shot(&window).grid, shot(&window).patches.len()), ([6, 4], 24), "chart and grid are one step");
}

fn passes(name: &str) -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    std::fs::create_dir_all(&folder).unwrap();
    let put = |number: u32| {
        let path = folder.join(format!("pass{number}.csv"));
        let asset = format!("test-samples/nikon_d70_narrowband_pass{number}.csv");
        std::fs::write(&path, chromascope_data::text(&asset).unwrap()).unwrap();
        path
    };
    [1, 2].map(put).to_vec()
}

#[test]
fn narrow_bands_become_a_camera() {
    let mut window = window();
    window.state_mut().push(Command::OpenPath(picture("before_bands.png", 12)));
    until(&mut window, "Choose the light that before_bands.png");
    let folder = passes("bands")[0].parent().unwrap().to_owned();
    std::fs::write(folder.join("readme.md"), "No spectra.").unwrap();
    window.state_mut().push(Command::OpenPath(folder));
    until(&mut window, "Name the raw value from which on a mean is saturated");
    assert!(window.state().view.is_shown(PaneKind::MEASURE) && !can(&window, ADD));
    assert!(window.state().history.document().measurement.shots.is_empty(), "bands are measured in place of pictures");
    window.state_mut().push(Command::GoTo(PaneKind::IMPORT));
    window.run_steps(3);
    assert!(window.state().view.is_shown(PaneKind::IMPORT), "measuring does not cover it");
    window.state_mut().push(Command::GoTo(PaneKind::MEASURE));
    window.run_steps(3);
    window.get_by_label_contains("16384, the largest, of ").click();
    until(&mut window, "Saturated, skipped and filled from the library's tables: blue at 410, 420, 430, 440 nm");
    for words in ["Pass 1: pass1.csv, 31 bands", "Dark, skipped", "Passes scatter by", "Exponent of the response"] {
        assert!(window.query_all_by_label_contains(words).next().is_some(), "{words}");
    }
    let document = window.state().history.document().clone();
    assert_eq!(from_json(&to_json(&document).unwrap()).unwrap().measurement, document.measurement);
    for _ in 0..2 {
        window.get_by_label(ADD).click();
        window.run_steps(3);
        assert_eq!(cameras(&window), ["My camera (measured)"], "added again, it takes its own place");
    }
    let set = window.state().history.document().own[0].clone();
    assert!(set.covariance.is_some() && set.curves.iter().all(|curve| curve.uncertainty.is_some()));
    assert_eq!(set.decisions[0], "Recovered from 31 narrow bands in pass1.csv, pass2.csv");
    window.get_by_label("Show in Rank").click();
    window.run_steps(3);
    assert_eq!(window.state().view.saved.workspace, Workspace::Rank);
    while !window.state().history.document().measurement.passes.is_empty() {
        window.state_mut().push(Command::Undo);
        window.run_steps(2);
    }
    assert_eq!(window.state().history.document().measurement.shots.len(), 1, "the picture's patches are back");
}

#[test]
fn tables_of_bands_that_are_wrong_say_why() {
    let [first, second] = passes("wrong_bands").try_into().unwrap();
    let text = std::fs::read_to_string(&first).unwrap();
    std::fs::write(&first, text.replacen("400,0.00296", "400,none", 1)).unwrap();
    let mut window = window();
    window.state_mut().push(Command::OpenPath(first.clone()));
    until(&mut window, "column power: not a number");
    std::fs::write(&first, text.replacen("400,0.00296", "395,0.00296", 1)).unwrap();
    window.state_mut().open_at_start(vec![second, first]);
    until(&mut window, "16384, the largest");
    window.get_by_label_contains("16384, the largest, of ").click();
    until(&mut window, "Pass 2 has other bands than the first");
    assert!(!can(&window, ADD));
    // A picture is measured in place of bands.
    window.state_mut().push(Command::OpenPath(picture("after_bands.png", 12)));
    until(&mut window, "Choose the light that after_bands.png");
    assert!(window.state().history.document().measurement.passes.is_empty());
}

#[test]
fn pictures_of_bands_become_a_camera() {
    let [first, second] = [1, 2].map(|number| crate::cli::recover::pass_of_pictures("bands_of_pictures", number));
    let mut window = window();
    window.state_mut().open_at_start(vec![first.clone(), second]);
    until(&mut window, "Saturated, skipped and filled from the library's tables: blue at 410, 420, 430, 440 nm");
    let pass = "Pass 1: pass1.csv, 31 bands: means of 12 × 10 pixels at 18, 15 of each picture";
    until(&mut window, pass);
    assert!(can(&window, ADD));
    let document = window.state().history.document().clone();
    assert_eq!(document.measurement.clip, Some(65535.0), "the end of the scale is that of the pictures");
    let stated = std::fs::read_to_string(&first).unwrap();
    std::fs::write(&first, format!("# region: 20,16,8,8\n{stated}")).unwrap();
    window.state_mut().push(Command::OpenPath(first));
    until(&mut window, "31 bands: means of 8 × 8 pixels at 20, 16 of each picture");
    assert_eq!(window.state().history.document().measurement.passes.len(), 2, "it is the same pass");
    let document = window.state().history.document().clone();
    assert_eq!(from_json(&to_json(&document).unwrap()).unwrap().measurement, document.measurement);
}
