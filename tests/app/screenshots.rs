//! The README's pictures, drawn by the CPU renderer and compared with the committed ones.
//!
//! `UPDATE_SCREENSHOTS=1 cargo test` writes them.

use std::path::Path;

use chromascope::action::history::History;
use chromascope::action::{Action, CompareAction, RenderAction, SceneAction};
use chromascope::app::ChromascopeApp;
use chromascope::command::Command;
use chromascope::document::{Diagram, Document, Overlays, SetKind, Subset, TransformChoice};
use chromascope::files::Files;
use chromascope::jobs::Executor;
use chromascope::plot_item::{PlotItem, SensorId};
use chromascope::profiler::SceneRun;
use chromascope::view::RenderMode;
use chromascope::view::import::ImportItem;
use chromascope::view::{DiagramFit, SavedView};
use chromascope::workspaces::PaneKind;
use egui_kittest::Harness;

use crate::cpu_renderer::{Cpu, compare};

/// The program in a window of the given size, with the paper's start.
pub(crate) fn open(size: [f32; 2], theme: egui::Theme) -> Harness<'static, ChromascopeApp> {
    open_with(Document::paper(), size, theme)
}

/// The program in a window of the given size, with a document.
pub(crate) fn open_with(document: Document, size: [f32; 2], theme: egui::Theme) -> Harness<'static, ChromascopeApp> {
    open_on(&Executor::default(), document, size, theme)
}

/// The paper's start with an executor that the test drives.
pub(crate) fn driven(size: [f32; 2], theme: egui::Theme) -> (Executor, Harness<'static, ChromascopeApp>) {
    driven_with(Document::paper(), size, theme)
}

/// A document with an executor that the test drives.
pub(crate) fn driven_with(
    document: Document,
    size: [f32; 2],
    theme: egui::Theme,
) -> (Executor, Harness<'static, ChromascopeApp>) {
    let executor = Executor::driven();
    let harness = open_on(&executor, document, size, theme);
    (executor, harness)
}

fn open_on(
    executor: &Executor,
    document: Document,
    size: [f32; 2],
    theme: egui::Theme,
) -> Harness<'static, ChromascopeApp> {
    // Each answer of a worker that arrives asks for frames of its own, and a busy machine brings them one by one.
    let mut harness = Harness::builder()
        .with_max_steps(64)
        .with_size(size)
        .with_pixels_per_point(1.0)
        .with_theme(theme)
        .renderer(Cpu::default())
        .build_eframe(|cc| {
            let history = History::new(document);
            ChromascopeApp::on(executor, &cc.egui_ctx, history, SavedView::default(), Files::new(None))
        });
    harness.run();
    harness
}

/// Compares the window with its picture. The time of the last update is masked: it is never the same twice.
fn check(mut harness: Harness<'static, ChromascopeApp>, name: &str) {
    harness.state_mut().view.fixed_clock = true;
    harness.run();
    let image = harness.render().expect("the renderer draws");
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("screenshots").join(name);
    compare(&image, &path).unwrap_or_else(|difference| panic!("{difference}"));
}

fn select(harness: &mut Harness<'static, ChromascopeApp>, source: &str, patch: &str) {
    let source = Some(SensorId { kind: SetKind::Camera, name: source.to_owned() });
    harness.state_mut().view.selected = Some(PlotItem::Patch { source, patch: patch.to_owned() });
    harness.run();
}

#[test]
fn compare_dark() {
    check(open_with(Document::colorimetry(), [1280.0, 800.0], egui::Theme::Dark), "compare_dark.png");
}

#[test]
fn compare_light() {
    check(open_with(Document::colorimetry(), [1280.0, 800.0], egui::Theme::Light), "compare_light.png");
}

#[test]
fn compare_small() {
    check(open_with(Document::colorimetry(), [900.0, 600.0], egui::Theme::Dark), "compare_small.png");
}

#[test]
fn metrics() {
    let mut harness = open_with(Document::colorimetry(), [1280.0, 800.0], egui::Theme::Light);
    harness.state_mut().view.show(PaneKind::METRICS);
    harness.run_steps(3);
    harness.state().later.wait();
    check(harness, "metrics.png");
}

#[test]
fn selected_patch() {
    let mut harness = open([1280.0, 800.0], egui::Theme::Light);
    select(&mut harness, "Kodak DCS200", "blue");
    check(harness, "selected.png");
}

#[test]
fn all_patches_by_observer() {
    let mut harness = open([1600.0, 1000.0], egui::Theme::Dark);
    let observer = TransformChoice::Observer("CIE 1931 2°".to_owned());
    for action in [SceneAction::SetSubset(Subset::All), SceneAction::SetTransform(observer)] {
        harness.state_mut().push(Action::Scene(action));
    }
    harness.run();
    let camera = CompareAction::Add(SetKind::Camera, "Sony ILCE-7M3".to_owned());
    harness.state_mut().push(Action::Compare(camera));
    harness.run();
    check(harness, "observer_24.png");
}

#[test]
fn whole_diagram() {
    let mut harness = open([1280.0, 800.0], egui::Theme::Dark);
    let overlays =
        Overlays { camera_spectral_loci: true, daylight: true, srgb: true, rec2020: true, ..Overlays::default() };
    for action in [SceneAction::SetDiagram(Diagram::UvPrime), SceneAction::SetOverlays(overlays)] {
        harness.state_mut().push(Action::Scene(action));
    }
    harness.state_mut().view.saved.diagram_fit = DiagramFit::Whole;
    harness.state_mut().push(Command::Maximize(PaneKind::CHROMATICITY));
    check(harness, "whole_diagram.png");
}

#[test]
fn spectra() {
    let mut harness = open([1280.0, 800.0], egui::Theme::Light);
    harness.state_mut().view.show(PaneKind::SPECTRA);
    harness.run();
    check(harness, "spectra.png");
}

/// The Render workspace, all pictures made.
fn render(
    size: [f32; 2],
    theme: egui::Theme,
    change: impl FnOnce(&mut ChromascopeApp),
) -> Harness<'static, ChromascopeApp> {
    let mut harness = open(size, theme);
    harness.state_mut().view.show(PaneKind::RENDER);
    change(harness.state_mut());
    for _ in 0..4 {
        harness.run_steps(2);
        harness.state().render_service.wait();
    }
    harness
}

#[test]
fn render_head() {
    check(
        render([1280.0, 800.0], egui::Theme::Light, |app| app.push(Action::Render(RenderAction::Figure8))),
        "render_head.png",
    );
}

#[test]
fn render_fern() {
    check(
        render([1280.0, 800.0], egui::Theme::Dark, |app| app.push(Action::Render(RenderAction::Figure9))),
        "render_fern.png",
    );
}

#[test]
fn render_difference() {
    let difference = |app: &mut ChromascopeApp| {
        app.push(Action::Render(RenderAction::Figure8));
        app.view.saved.render.mode = RenderMode::Difference;
    };
    check(render([1280.0, 800.0], egui::Theme::Dark, difference), "render_difference.png");
}

/// A transmittance as `SpectraWiz` writes it: a quote that is never closed, three digits of exponent, percent, filler at the ends.
fn leaf() -> String {
    let head = "\" File: C:\\spectra\\oak\n\" TRANS->  Wave:550.00nm  Pix:612  Val: 12.310  Time:120ms  Avg:10  Sm:1\n";
    let bell = |nm: f64, center: f64, width: f64| (-((nm - center) / width).powi(2)).exp();
    let rows = (0..1001).map(|i| {
        let nm = 350.0 + 0.5 * f64::from(i);
        let edge = 48.0 / (1.0 + (-(nm - 715.0) / 12.0).exp());
        let value = if nm < 355.0 { 0.001 } else { 2.0 + 14.0 * bell(nm, 552.0, 38.0) + edge };
        let (exponent, mantissa) = if value >= 10.0 { ("+001", value / 10.0) } else { ("+000", value) };
        format!(" {nm:.2}  {mantissa:.4}E{exponent}\n")
    });
    head.to_owned() + &rows.collect::<Vec<_>>().concat()
}

#[test]
fn import() {
    let folder = tempfile::tempdir().unwrap();
    let camera = "# camera: Acme One\nwavelength_nm,R,G,B\n400,0.01,0.02,0.60\n450,0.02,0.10,0.95\n500,0.05,0.60,0.50\n\
                  550,0.15,0.98,0.08\n600,0.90,0.35,0.02\n650,0.55,0.05,0.01\n700,0.05,0.01,0.00\n";
    let broken = "nm;leaf;bark\n400;0,12;0,20\n410;0,14;0,21\n420;0,15;0.2.2\n430;0,17;0,22\n440;0,18;0,23\n";
    for (name, text) in [("acme.csv", camera), ("bark.txt", broken), ("oak leaf.TRM", &leaf())] {
        std::fs::write(folder.path().join(name), text).unwrap();
    }
    let mut harness = open([1280.0, 800.0], egui::Theme::Dark);
    harness.state_mut().push(Command::OpenPath(folder.path().to_owned()));
    harness.run_steps(2);
    for _ in 0..3 {
        harness.state().opened.wait();
        harness.run_steps(3);
    }
    harness.state_mut().push(Command::ShowImport(ImportItem::Set("oak leaf".to_owned()), None));
    for _ in 0..3 {
        harness.run_steps(2);
        harness.state().opened.wait();
    }
    check(harness, "import.png");
}

/// Recorded measurements of the first screen's scene, as times are never repeatable.
#[derive(Clone, serde::Serialize, serde::Deserialize)]
pub(crate) struct Measured {
    pub(crate) run: SceneRun,
}

impl Measured {
    /// As saved in a file; with `RECORD_MEASUREMENTS=1` measured again (meant for an optimized build) and saved.
    pub(crate) fn kept() -> Self {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/app/measured.json");
        if std::env::var_os("RECORD_MEASUREMENTS").is_some() {
            let mut harness = open([1280.0, 800.0], egui::Theme::Dark);
            harness.state_mut().push(Command::MeasureScene);
            harness.run_steps(2);
            harness.state().later.wait();
            harness.run_steps(3);
            let measured = &harness.state().profiler.measured;
            let run = SceneRun::clone(measured.run.as_ref().expect("measured"));
            let measured = Self { run };
            std::fs::write(&path, serde_json::to_string_pretty(&measured).unwrap() + "\n").unwrap();
        }
        serde_json::from_str(&std::fs::read_to_string(&path).unwrap()).unwrap()
    }
}

/// The Numerics workspace with what was measured once.
pub(crate) fn accuracy(size: [f32; 2], theme: egui::Theme) -> Harness<'static, ChromascopeApp> {
    let mut harness = open(size, theme);
    let Measured { run } = Measured::kept();
    let view = &mut harness.state_mut().view;
    view.show(PaneKind::METHODS);
    view.fixed_clock = true;
    let measured = &mut harness.state_mut().profiler.measured;
    measured.run = Some(std::sync::Arc::new(run));
    measured.is_current = true;
    for _ in 0..3 {
        harness.run_steps(2);
        harness.state().later.wait();
    }
    harness
}

#[test]
fn accuracy_workspace() {
    check(accuracy([1280.0, 800.0], egui::Theme::Light), "accuracy.png");
}
