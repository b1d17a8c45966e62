//! The panes: each reads the document, asks for answers, and says what is to be done. None knows another.

pub mod accuracy;
pub mod chromaticity;
pub mod context;
pub mod curves;
pub mod help;
pub mod import;
pub mod inspector;
pub mod library;
pub mod menu;
pub mod render;
pub mod render_setup;
pub mod scene_bar;
pub mod skipped_work;
pub mod spectra;
pub mod status_bar;
pub mod swatches;
pub mod tolerance;
pub mod understood;
pub mod widgets;

use chromascope_figure::Figure;
use egui::{Rect, Ui};

use context::PaneContext;

use crate::scene::Scene;
use crate::view::View;
use crate::workspaces::PaneKind;

/// What is said where something is measured.
const NOT_KEPT: &str = "Measured results are not kept when the program ends: export them.";

/// Shows a pane in exactly its rectangle.
pub fn show(ui: &mut Ui, pane: PaneKind, rect: Rect, context: &mut PaneContext<'_>) {
    match pane {
        PaneKind::Library => library::show(ui, rect, context),
        PaneKind::Chromaticity => chromaticity::show(ui, rect, context),
        PaneKind::Swatches => swatches::show(ui, rect, context),
        PaneKind::Spectra => spectra::show(ui, rect, context),
        PaneKind::Inspector => inspector::show(ui, rect, context),
        PaneKind::Render => render::show(ui, rect, context),
        PaneKind::RenderSetup => render_setup::show(ui, rect, context),
        PaneKind::Import => import::show(ui, rect, context),
        PaneKind::Curves => curves::show(ui, rect, context),
        PaneKind::Understood => understood::show(ui, rect, context),
        PaneKind::Accuracy => accuracy::show(ui, rect, context),
        PaneKind::SkippedWork => skipped_work::show(ui, rect, context),
        PaneKind::Tolerance => tolerance::show(ui, rect, context),
    }
}

/// A pane's figure as it would be saved: the same as on screen, with its numbers. None for panes without one.
pub fn figure(pane: PaneKind, scene: &Scene<'_>, view: &View) -> Option<Figure> {
    match pane {
        PaneKind::Chromaticity => Some(crate::figures::chromaticity::figure(scene, view)),
        PaneKind::Swatches => Some(crate::figures::swatches::figure(scene, view)),
        PaneKind::Spectra => Some(crate::figures::spectra::figure(scene, view)),
        PaneKind::Render => crate::figures::render::figure(scene, view),
        PaneKind::Curves => crate::figures::curves::figure(scene, view),
        PaneKind::Accuracy => crate::figures::accuracy::figure(view),
        PaneKind::SkippedWork => crate::figures::skipped_work::figure(view),
        PaneKind::Tolerance
        | PaneKind::Library
        | PaneKind::Inspector
        | PaneKind::RenderSetup
        | PaneKind::Import
        | PaneKind::Understood => None,
    }
}
