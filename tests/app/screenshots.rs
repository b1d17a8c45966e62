//! The README's pictures, drawn by the CPU renderer and compared with the committed ones.
//!
//! `UPDATE_SCREENSHOTS=1 cargo test` writes them.

use std::path::Path;

use chromascope::action::{Action, CompareAction, RenderAction, SceneAction};
use chromascope::app::ChromascopeApp;
use chromascope::catalog::Kind;
use chromascope::command::Command;
use chromascope::document::history::History;
use chromascope::document::{Diagram, Document, Overlays, Subset, WayChoice};
use chromascope::files::Files;
use chromascope::thing::{SourceId, Thing};
use chromascope::view::render::RenderMode;
use chromascope::view::{DiagramFit, SavedView};
use chromascope::workspaces::{PaneKind, Workspace};
use egui_kittest::Harness;

use crate::cpu_renderer::{Cpu, compare};

/// The program in a window of the given size, as it starts.
pub(crate) fn open(size: [f32; 2], theme: egui::Theme) -> Harness<'static, ChromascopeApp> {
    let mut harness = Harness::builder()
        .with_size(size)
        .with_pixels_per_point(1.0)
        .with_theme(theme)
        .renderer(Cpu::default())
        .build_eframe(|cc| {
            let history = History::new(Document::default());
            ChromascopeApp::new(&cc.egui_ctx, history, SavedView::default(), Files::new(None))
        });
    harness.run();
    harness
}

/// Compares the window with its picture. The time of the last update is masked: it is never the same twice.
fn check(mut harness: Harness<'static, ChromascopeApp>, name: &str) {
    harness.state_mut().view_mut().fixed_clock = true;
    harness.run();
    let image = harness.render().expect("the renderer draws");
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("screenshots").join(name);
    compare(&image, &path).unwrap_or_else(|difference| panic!("{difference}"));
}

fn select(harness: &mut Harness<'static, ChromascopeApp>, source: &str, patch: &str) {
    let source = Some(SourceId { kind: Kind::Camera, name: source.to_owned() });
    harness.state_mut().view_mut().selected = Some(Thing::Patch { source, patch: patch.to_owned() });
    harness.run();
}

#[test]
fn compare_dark() {
    check(open([1280.0, 800.0], egui::Theme::Dark), "compare_dark.png");
}

#[test]
fn compare_light() {
    check(open([1280.0, 800.0], egui::Theme::Light), "compare_light.png");
}

#[test]
fn compare_small() {
    check(open([900.0, 600.0], egui::Theme::Dark), "compare_small.png");
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
    let observer = WayChoice::Observer("CIE 1931 2°".to_owned());
    for action in [SceneAction::SetSubset(Subset::All), SceneAction::SetWay(observer)] {
        harness.state_mut().push(Action::Scene(action));
    }
    harness.run();
    let camera = CompareAction::Add(Kind::Camera, "Sony ILCE-7M3".to_owned());
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
    harness.state_mut().view_mut().saved.diagram_fit = DiagramFit::Whole;
    harness.state_mut().push(Command::Maximize(PaneKind::Chromaticity));
    check(harness, "whole_diagram.png");
}

#[test]
fn spectra() {
    let mut harness = open([1280.0, 800.0], egui::Theme::Light);
    harness.state_mut().view_mut().saved.workspace = Workspace::Spectra;
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
    harness.state_mut().view_mut().saved.workspace = Workspace::Render;
    change(harness.state_mut());
    for _ in 0..4 {
        harness.run_steps(2);
        harness.state().studio().wait();
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
        app.view_mut().saved.render.mode = RenderMode::Difference;
    };
    check(render([1280.0, 800.0], egui::Theme::Dark, difference), "render_difference.png");
}
