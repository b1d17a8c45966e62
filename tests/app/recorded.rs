//! The pane Recorded: a table of raw values opened, ranked and drawn.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use chromascope::action::history::History;
use chromascope::app::ChromascopeApp;
use chromascope::catalog::chart_picture::ChartPicture;
use chromascope::catalog::recorded::read_table;
use chromascope::command::Command;
use chromascope::document::Document;
use chromascope::files::{Answer, Dialogs, Files, Question};
use chromascope::jobs::Executor;
use chromascope::panes;
use chromascope::view::SavedView;
use chromascope::workspaces::PaneKind;
use chromascope_core::patch_set::{Patch, PatchSet};
use chromascope_core::spectral::{Dataset, GridSpectrum, Sensor};
use chromascope_figure::FigureRoom;
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable as _;
use proptest::prelude::*;

use crate::cpu_renderer::Cpu;
use crate::waiting;

struct Chooses(PathBuf);

impl Dialogs for Chooses {
    fn ask(&self, _: &Question) -> Answer {
        Answer::Chosen(vec![self.0.clone()])
    }
}

type Window = Harness<'static, ChromascopeApp>;

fn window(path: &Path, size: [f32; 2], theme: egui::Theme) -> Window {
    window_on(&Executor::default(), path, size, theme)
}

fn window_on(executor: &Executor, path: &Path, size: [f32; 2], theme: egui::Theme) -> Window {
    let files = Files::new(None).with_dialogs(Arc::new(Chooses(path.to_owned())));
    let mut window = Harness::builder()
        .with_size(size)
        .with_pixels_per_point(1.0)
        .with_theme(theme)
        .renderer(Cpu::default())
        .build_eframe(|cc| {
            let history = History::new(Document::colorimetry());
            ChromascopeApp::on(executor, &cc.egui_ctx, history, SavedView::default(), files)
        });
    window.run();
    window.state_mut().push(Command::Maximize(PaneKind::RECORDED));
    window.run_steps(2);
    window
}

/// Opens the file that the dialog answers with.
fn open(window: &mut Window) {
    window.get_by_label("Open raw values…").click();
    waiting::until("reading", || {
        window.run_steps(2);
        let done =
            window.query_by_label_contains("Reading").is_none() && window.query_by_label("Open raw values…").is_none();
        done.then_some(()).ok_or_else(|| "not yet".to_owned())
    });
    fitted(window);
}

/// Waits until the cameras are fitted, if there is something to fit.
fn fitted(window: &mut Window) {
    window.run_steps(2);
    window.state().later.wait();
    window.run_steps(2);
}

/// Raw values of the chart that the window starts with, under its light, through the measured D70, with noise.
pub(crate) fn recording() -> Vec<(String, [f64; 3])> {
    let start = Document::colorimetry().chart;
    let (_, chart) =
        chromascope_data::files("charts").find(|(_, text)| Dataset::read_header(text).unwrap().title == start).unwrap();
    recording_of(&PatchSet::from_dataset(&Dataset::read(chart).unwrap()))
}

/// The same of another chart.
pub(crate) fn recording_of(chart: &PatchSet) -> Vec<(String, [f64; 3])> {
    let document = Document::colorimetry();
    let asset = |path: &str| Dataset::read(chromascope_data::text(path).unwrap()).unwrap();
    let camera = Sensor::from_dataset(&asset("cameras/nikon_d70_a_m_p_a_s.csv")).unwrap();
    let catalog = chromascope::catalog::Catalog::built_in();
    let results = chromascope::results::Results::default();
    let scene = chromascope::scene::Scene { document: &document, catalog: &catalog, results: &results };
    let light = scene.light().unwrap().grid;
    let patch = |(index, patch): (usize, &Patch)| {
        let values = patch.grid.values();
        let radiance = GridSpectrum::from_fn(|nm| {
            let at = (nm - 380.0).round() as usize;
            values[at] * light.values()[at]
        });
        let raw = camera.integrate(radiance.values());
        let noise = |c: usize| 1.0 + 0.01 * ((index * 7 + c * 5) % 11) as f64 / 11.0;
        (patch.name.clone(), [0, 1, 2].map(|c: usize| raw[c] * [0.8, 1.0, 0.7][c] * noise(c)))
    };
    let all: Vec<(String, [f64; 3])> = chart.patches().iter().enumerate().map(patch).collect();
    let largest = all.iter().flat_map(|(_, rgb)| *rgb).fold(0.0, f64::max);
    all.into_iter().map(|(name, rgb)| (name, rgb.map(|v| v / largest * 50_000.0))).collect()
}

fn table() -> PathBuf {
    let rows = recording().into_iter().map(|(name, [r, g, b])| format!("{name},{r},{g},{b}\n"));
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join("recorded.csv");
    std::fs::write(&path, "patch,R,G,B\n".to_owned() + &rows.collect::<String>()).unwrap();
    path
}

#[test]
fn a_table_is_opened_ranked_and_drawn() {
    let mut window = window(&table(), [1280.0, 800.0], egui::Theme::Dark);
    open(&mut window);
    assert!(window.query_by_label_contains("recorded.csv: Nikon D70 (A.M.P.A.S.), RMS 0.").is_some());
    assert!(
        window.query_by_label_contains("in 95 % of 1000 resamples of the patches, smallest RMS in 100 %").is_some()
    );
    let figure = |window: &Window| {
        let app = window.state();
        let catalog = chromascope::catalog::Catalog::built_in();
        let scene =
            chromascope::scene::Scene { document: app.history.document(), catalog: &catalog, results: &app.results };
        panes::figure(PaneKind::RECORDED, &scene, &app.look(PaneKind::RECORDED, &scene), FigureRoom::default()).unwrap()
    };
    let shown = figure(&window);
    assert!(shown.title.contains("Nikon D70 (A.M.P.A.S.)"));
    assert_eq!(shown.table.rows.len(), 72);
    assert!(shown.caption.contains("rank 1 in 95 %") && shown.table.to_csv().lines().all(|line| !line.ends_with(',')));
    // Another camera's residuals at a click on its row.
    window.get_all_by_label("Nikon D70 (UPenn 2011)").last().unwrap().click();
    window.run_steps(3);
    assert!(figure(&window).title.contains("UPenn"));
    // With one gain for all channels the gains that were put in are the residuals.
    window.get_by_label("Channel gains").click();
    window.run_steps(3);
    assert!(!window.state().view.recorded.freedom.gains);
    fitted(&mut window);
    assert!(window.query_by_label_contains("recorded.csv: Nikon D70 (A.M.P.A.S.), RMS 0.").is_none());
}

#[test]
fn cameras_are_parsed_and_fitted_beside_the_window() {
    let executor = Executor::driven();
    let mut window = window_on(&executor, &table(), [1280.0, 800.0], egui::Theme::Dark);
    let made = |name: &str| executor.results().counts().get(name).map_or(0, |count| count.misses);
    let before = made("sensor");
    window.get_by_label("Open raw values…").click();
    waiting::until("reading", || {
        window.run_steps(2);
        while ["recorded", "dialogs"].iter().any(|name| executor.run_one(name)) {}
        window.query_by_label("Fitting the cameras…").map(|_| ()).ok_or_else(|| format!("{:?}", executor.queued()))
    });
    window.run_steps(3);
    assert_eq!((made("sensor"), made("recorded fit")), (before, 0), "the window waits for the worker");
    fitted(&mut window);
    let fits = made("recorded fit");
    assert!(fits > 50 && made("sensor") - before > 40, "{fits}");
    assert!(window.query_by_label_contains("recorded.csv: Nikon D70 (A.M.P.A.S.), RMS 0.").is_some());
    window.run_steps(3);
    assert_eq!(made("recorded fit"), fits);
}

#[test]
fn a_files_fault_is_told_and_another_can_be_opened() {
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join("recorded_broken.csv");
    std::fs::write(&path, "patch,R,G,B\nno such patch,1,2,3\n").unwrap();
    let mut window = window(&path, [900.0, 600.0], egui::Theme::Light);
    window.get_by_label("Open raw values…").click();
    waiting::until("reading", || {
        window.run_steps(2);
        let found = window.query_by_label_contains("line 2: no spectrum is named").map(|_| ());
        found.ok_or_else(|| "not yet".to_owned())
    });
    assert!(window.query_by_label("Open raw values…").is_some());
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 300, failure_persistence: None, ..ProptestConfig::default() })]

    /// Any text is a table or refused; its rows are those of the file.
    #[test]
    fn any_table_is_read_or_refused(text in "(patch,R,G,B(,4[0-9]0){0,3}|R;G;B|1\\t2\\t3)\n([a-z\"#é,;\\t0-9.\\-]{0,20}\n){0,6}") {
        if let Ok(table) = read_table(text.as_bytes()) {
            let lines = text.lines().count();
            prop_assert!(table.rows.len() <= lines && table.rows.iter().all(|row| row.line <= lines));
            prop_assert!(table.rows.iter().flat_map(|row| row.rgb).all(|value| value.is_nan() || value.is_finite()));
        }
    }

    /// A picture that is cut or changed is decoded or refused.
    #[test]
    fn any_picture_is_decoded_or_refused(cut in 0_usize..2000, at in 0_usize..2000, byte: u8) {
        let mut bytes = std::io::Cursor::new(Vec::new());
        image::ImageBuffer::<image::Rgb<u16>, Vec<u16>>::new(16, 12).write_to(&mut bytes, image::ImageFormat::Tiff).unwrap();
        let mut bytes = bytes.into_inner();
        let length = bytes.len();
        bytes[at % length] = byte;
        bytes.truncate(length - cut.min(length));
        if let Ok(picture) = ChartPicture::decode(&bytes) {
            prop_assert!(picture.size().iter().all(|side| *side < 1 << 20));
        }
    }
}
