//! Spectral images in the window: opened, drawn, read and dimmed like meshes, at a bounded size.

use std::path::{Path, PathBuf};

use chromascope::action::{Action, RenderAction};
use chromascope::app::ChromascopeApp;
use chromascope::catalog::Catalog;
use chromascope::catalog::spectral_images::{RowsRead, load, read_signals};
use chromascope::command::Command;
use chromascope::document::render::MeshChoice;
use chromascope::document::{Document, Light, SetKind, session};
use chromascope::figures::render::pixel_of;
use chromascope::panes;
use chromascope::plot_item::SensorId;
use chromascope::render_service::pixel::PixelShows;
use chromascope::scene::Scene;
use chromascope::scene::spectral_image::screen_steps;
use chromascope::view::{PixelPlace, RenderMode};
use chromascope::workspaces::PaneKind;
use chromascope_core::render::{BandWeights, ImageSensor, SampleQuantity, Stop};
use chromascope_core::spectral::{Dataset, GridSpectrum, Sensor};
use chromascope_figure::{Cell, FigureRoom};
use egui::accesskit::Role;
use egui_kittest::Harness;
use egui_kittest::kittest::{NodeT as _, Queryable as _};
use glam::DVec3;

use crate::cli_render_image::chart_image;
use crate::screenshots::open_with;
use crate::waiting::until;
use spectral_image::ImageQuantity;

type Window = Harness<'static, ChromascopeApp>;

fn folder(name: &str) -> PathBuf {
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join("spectral_images").join(name);
    if path.exists() {
        std::fs::remove_dir_all(&path).unwrap();
    }
    std::fs::create_dir_all(&path).unwrap();
    path
}

/// An ENVI image of bytes, pixel by pixel.
fn bytes_image(path: &Path, [width, height]: [usize; 2], nm: &[u32], sample: impl Fn(usize, usize, usize) -> u8) {
    let list = nm.iter().map(u32::to_string).collect::<Vec<_>>().join(", ");
    let header = format!(
        "ENVI\nsamples = {width}\nlines = {height}\nbands = {}\ndata type = 1\ninterleave = bip\n\
         wavelength units = Nanometers\nwavelength = {{{list}}}\nreflectance scale factor = 255\n",
        nm.len()
    );
    std::fs::write(path.with_extension("hdr"), header).unwrap();
    let pixel = |i: usize| (0..nm.len()).map(move |band| [i % width, i / width, band]);
    let bytes: Vec<u8> = (0..width * height).flat_map(pixel).map(|[x, y, band]| sample(x, y, band)).collect();
    std::fs::write(path.with_extension("img"), bytes).unwrap();
}

fn mesh(window: &Window) -> MeshChoice {
    window.state().history.document().render.mesh.clone()
}

/// Waits for the pictures and shows them.
fn settle(window: &mut Window) {
    until("pictures", || {
        window.run_steps(2);
        window.state().render_service.wait();
        window.run_steps(2);
        let is_there = window.state().render_service.is_settled();
        is_there.then_some(()).ok_or_else(|| "not yet".to_owned())
    });
}

/// Opens a file as the menu, a drop and an argument do.
fn opened(document: Document, path: &Path, size: [f32; 2]) -> Window {
    let mut window = open_with(document, size, egui::Theme::Dark);
    window.state_mut().push(Command::OpenPath(path.to_owned()));
    until("opening", || {
        window.run_steps(2);
        if mesh(&window).is_image() { Ok(()) } else { Err(format!("{:?}", window.state().view.status)) }
    });
    settle(&mut window);
    window
}

/// The captions of the pictures on show.
fn captions(window: &Window) -> Vec<String> {
    let labels = window.query_all_by(|node| node.value().is_some_and(|label| label.starts_with("Picture: ")));
    labels.filter_map(|node| node.accesskit_node().value()).collect()
}

const CHART: &str = "ColorChecker 24 (Ohta 1997)";
const OBSERVER: &str = "observers/cie_1931_2deg.csv";

#[test]
fn pixels_of_a_chart_image_equal_its_patches() {
    let folder = folder("patches");
    chart_image(&folder, "bil", "reflectance scale factor = 1\n");
    let mut document = Document::colorimetry();
    document.chart = CHART.to_owned();
    let window = opened(document, &folder.join("chart.img"), [1280.0, 800.0]);
    assert!(window.state().view.is_shown(PaneKind::RENDER));
    let (app, catalog) = (window.state(), Catalog::built_in());
    let scene = Scene { document: app.history.document(), catalog: &catalog, results: &app.results };
    let shot = app.render_service.frame().cloned().expect("pictures");
    for source in shot.sources.iter().filter(|source| !source.is_reference) {
        let differences = scene.differences(source.kind, &source.name).unwrap();
        let id = SensorId { kind: source.kind, name: source.name.clone() };
        for (patch, expected) in differences.iter().enumerate() {
            let at = [(patch as f64 + 0.5) / 24.0, 0.5];
            let reading = pixel_of(&scene, &shot, &PixelPlace { at, source: id.clone() }).expect("a pixel");
            assert_eq!(reading.at, [patch, 1]);
            let PixelShows::Lit(lit) = reading.shows else { panic!("{reading:?}") };
            let (read, expected) = (lit.difference.unwrap(), expected.as_ref().unwrap());
            assert!((read - expected).abs() < 2e-3 * (1.0 + expected), "{}, {patch}: {read} {expected}", source.name);
        }
        let mean = differences.iter().map(|d| d.as_ref().unwrap()).sum::<f64>() / 24.0;
        let caption = captions(&window).into_iter().find(|words| words.contains(&source.label)).expect("a caption");
        assert!(caption.contains(&format!("mean {mean:.1}, median ")), "{caption}: {mean}");
    }
}

#[test]
fn an_image_is_undone_kept_in_a_session_and_missed() {
    let folder = folder("session");
    chart_image(&folder, "bsq", "reflectance scale factor = 1\n");
    let path = folder.join("chart.hdr");
    let mut window = opened(Document::colorimetry(), &path, [1280.0, 800.0]);
    assert_eq!(window.state().history.undo_name(), Some("Open chart.hdr"));
    let document = window.state().history.document().clone();
    window.state_mut().push(Command::Undo);
    window.run_steps(3);
    assert_eq!(mesh(&window), MeshChoice::Head);
    window.state_mut().push(Command::Redo);
    settle(&mut window);
    assert_eq!(mesh(&window), MeshChoice::Image(path.clone()));
    let text = serde_json::to_string(&document).unwrap();
    assert_eq!(serde_json::from_str::<Document>(&text).unwrap(), document);
    assert!(!session::is_session(b"ENVI\n"));
    std::fs::remove_file(&path).unwrap();
    let mut window = open_with(document, [1280.0, 800.0], egui::Theme::Dark);
    window.state_mut().view.show(PaneKind::RENDER);
    until("the reason", || {
        window.run_steps(2);
        match window.state().images.get(&path) {
            chromascope::catalog::spectral_images::ImageState::Failed(why) => {
                assert!(why.contains("chart.hdr is not in") && why.ends_with("choose a mesh."), "{why}");
                Ok(())
            }
            _ => Err("it is being read".to_owned()),
        }
    });
    window.run_steps(3);
    assert!(window.state().render_service.frame().is_none());
}

#[test]
fn header_and_data_dropped_together_are_one_image() {
    let folder = folder("drop");
    chart_image(&folder, "bip", "reflectance scale factor = 1\n");
    let window = opened(Document::colorimetry(), &folder, [900.0, 600.0]);
    assert!(mesh(&window).is_image());
    assert_eq!(window.state().history.undo_name(), Some("Open chart.hdr"));
    assert!(window.state().history.document().own.is_empty());
}

#[test]
fn a_large_image_is_decimated_and_says_so() {
    let folder = folder("large");
    let path = folder.join("ramp.hdr");
    bytes_image(&path, [2100, 1000], &[420, 520, 620], |x, _, _| (x / 10) as u8);
    let image = load(&path).unwrap();
    assert_eq!(screen_steps(&image.info), [6, 2]);
    let mut window = opened(Document::colorimetry(), &path, [1280.0, 800.0]);
    // The message about the opened file fades.
    window.run_steps(40);
    let shot = window.state().render_service.frame().cloned().unwrap();
    let made = shot.made().unwrap().image().unwrap();
    assert_eq!((made.placed().size().width, made.placed().size().height), (1050, 500));
    assert!(made.image.read.tile_bytes < 1 << 20, "one row at a time: {}", made.image.read.tile_bytes);
    let words = "2100 × 1000 pixels, every second pixel across and down, 3 bands";
    assert!(window.query_by_label_contains(words).is_some());
    let (app, catalog) = (window.state(), Catalog::built_in());
    let scene = Scene { document: app.history.document(), catalog: &catalog, results: &app.results };
    let source = SensorId { kind: SetKind::Observer, name: "CIE 1931 2°".to_owned() };
    let reading = pixel_of(&scene, &shot, &PixelPlace { at: [0.5, 0.5], source }).unwrap();
    assert_eq!(reading.at, [1050, 500], "as in the file");
    let PixelShows::Lit(lit) = reading.shows else { panic!("{:?}", reading.shows) };
    let y = 105.0 / 255.0;
    assert!((lit.lab.unwrap().l - (116.0 * f64::cbrt(y) - 16.0)).abs() < 0.01, "a gray of {y}: {:?}", lit.lab);
    assert_eq!(image.source.rows.share(), 0.0);
}

#[test]
fn reading_is_stopped_between_rows_and_tells_how_far_it_is() {
    let folder = folder("stop");
    let path = folder.join("cube.hdr");
    bytes_image(&path, [40, 30], &[450, 550], |_, y, _| y as u8);
    let image = load(&path).unwrap();
    let observer = Sensor::from_dataset(&Dataset::read(chromascope_data::text(OBSERVER).unwrap()).unwrap()).unwrap();
    let weights = || {
        let flat = GridSpectrum::constant(1.0);
        let sensors = [ImageSensor { sensor: &observer, divisors: DVec3::ONE }];
        BandWeights::new(&[450.0, 550.0], SampleQuantity::Radiance, &flat, &sensors).unwrap()
    };
    let rows = RowsRead::default();
    let mut disk = image.source.open(None).unwrap();
    read_signals(&mut disk, weights(), (3, 1.0), &rows, &Stop::NEVER).unwrap();
    assert_eq!(rows.share(), 1.0);
    let stop = std::sync::Arc::new(std::sync::atomic::AtomicBool::new(true));
    let error = read_signals(&mut disk, weights(), (3, 1.0), &rows, &Stop::at(stop)).unwrap_err();
    assert_eq!((error.to_string(), rows.share()), ("stopped".to_owned(), 0.0));
    // A file that changed is not taken for the one that was opened.
    bytes_image(&path, [40, 31], &[450, 550], |_, y, _| y as u8);
    assert!(image.source.open(None).is_err_and(|error| error.to_string().contains("changed")));
}

#[test]
fn controls_that_do_nothing_are_dim_with_a_reason() {
    let folder = folder("dim");
    chart_image(&folder, "bil", "reflectance scale factor = 1\n");
    let mut window = opened(Document::colorimetry(), &folder.join("chart.hdr"), [1280.0, 1200.0]);
    let dim = |window: &Window, label: &str| {
        let nodes: Vec<_> = window.query_all_by_label(label).collect();
        assert!(!nodes.is_empty(), "{label}");
        nodes.iter().any(|node| node.accesskit_node().is_disabled())
    };
    for label in ["Light elevation", "Shadows", "Field of view"] {
        assert!(dim(&window, label), "{label}");
    }
    assert!(!dim(&window, "Exposure"));
    assert_eq!(window.query_all_by_label_contains("These do nothing to a spectral image").count(), 2);
    let mut to = window.state().history.document().render.clone();
    to.mesh = MeshChoice::Sphere;
    to.triangles = 2000;
    window.state_mut().push(Action::Render(RenderAction::Set { what: "Mesh", to: Box::new(to) }));
    settle(&mut window);
    assert!(!dim(&window, "Light elevation"));
}

#[test]
fn an_unstated_quantity_is_asked_for_and_radiances_take_no_light() {
    let folder = folder("quantity");
    chart_image(&folder, "bil", "");
    let path = folder.join("chart.hdr");
    let mut document = Document::colorimetry();
    document.render.mesh = MeshChoice::Image(path);
    let mut window = open_with(document, [1280.0, 800.0], egui::Theme::Dark);
    window.state_mut().view.show(PaneKind::RENDER);
    until("the question", || {
        window.run_steps(2);
        window.state().render_service.wait();
        let frame = window.state().render_service.has_made();
        frame.then_some(()).ok_or_else(|| "nothing was asked".to_owned())
    });
    window.run_steps(2);
    assert!(window.state().render_service.frame().is_none(), "no picture without a quantity");
    let xy = |window: &mut Window, quantity: ImageQuantity, light: &str| {
        let mut to = window.state().history.document().render.clone();
        to.image_quantity = Some(quantity);
        window.state_mut().push(Action::Render(RenderAction::Set { what: "Quantity", to: Box::new(to) }));
        let light = Light::Set(light.to_owned());
        window.state_mut().push(Action::Scene(chromascope::action::SceneAction::SetLight(light)));
        window.run_steps(3);
        settle(window);
        let (app, catalog) = (window.state(), Catalog::built_in());
        let scene = Scene { document: app.history.document(), catalog: &catalog, results: &app.results };
        let shot = app.render_service.frame().cloned().unwrap();
        let source = SensorId { kind: SetKind::Observer, name: "CIE 1931 2°".to_owned() };
        let reading = pixel_of(&scene, &shot, &PixelPlace { at: [18.5 / 24.0, 0.5], source }).unwrap();
        let PixelShows::Lit(lit) = reading.shows else { panic!("{:?}", reading.shows) };
        lit.xy.unwrap()
    };
    let [d65, a] = ["D65", "A"].map(|light| xy(&mut window, ImageQuantity::Reflectance, light));
    assert!((d65.x - 0.31).abs() < 0.01 && (a.x - 0.45).abs() < 0.01, "the light's: {d65:?} {a:?}");
    let [d65, a] = ["D65", "A"].map(|light| xy(&mut window, ImageQuantity::Radiance, light));
    assert!((d65.x - a.x).abs() < 1e-4 && (a.x - 0.333).abs() < 0.01, "a flat spectrum's: {d65:?} {a:?}");
}

#[test]
fn pictures_maps_and_spectra_of_an_image_look_right() {
    let folder = folder("looks");
    chart_image(&folder, "bip", "reflectance scale factor = 1\n");
    let mut window = opened(Document::colorimetry(), &folder.join("chart.hdr"), [1280.0, 800.0]);
    let source = window.state().render_service.frame().unwrap().sources[1].clone();
    let source = SensorId { kind: source.kind, name: source.name };
    window.state_mut().view.render.pinned = Some(PixelPlace { at: [14.5 / 24.0, 0.5], source });
    window.state_mut().view.saved.render.mode = RenderMode::Difference;
    window.run_steps(3);
    settle(&mut window);
    window.run_steps(3);
    let app = window.state();
    let catalog = Catalog::built_in();
    let scene = Scene { document: app.history.document(), catalog: &catalog, results: &app.results };
    let figure = panes::figure(PaneKind::RENDER, &scene, &app.look(PaneKind::RENDER, &scene), FigureRoom::default())
        .expect("a figure");
    assert!(
        figure.caption.contains("Spectral image: chart.hdr, 24 × 2 pixels, 81 bands, reflectances"),
        "{}",
        figure.caption
    );
    let column = |name: &str| figure.table.columns.iter().position(|column| column == name).expect("a column");
    assert!(figure.table.rows.iter().all(|row| row[column("facing_light")] == Cell::Empty));
    assert_eq!(figure.table.rows[1][column("pixels_with_value")], Cell::Number(48.0));
    assert!(window.query_by_role_and_label(Role::Canvas, "spectrum of the pixel").is_some());
    assert!(captions(&window).iter().all(|caption| !caption.contains("facing light")), "{:?}", captions(&window));
}
