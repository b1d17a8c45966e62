//! The panes: each reads the document, asks for answers, and says what is to be done. None knows another.

pub mod accuracy;
pub mod chromaticity;
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

use chromascope_core::accuracy::Accuracy;
use chromascope_core::query::NearestBlackBodyQuery;
use chromascope_core::query::render::PicturesQuery;
use chromascope_core::render::Quality;
use chromascope_figure::Figure;
use egui::{Rect, Ui};

use crate::catalog::meshes::MeshStore;
use crate::catalog::opened::Opened;
use crate::command::Command;
use crate::jobs::Background;
use crate::profiler::{Profiler, SceneRunQuery};
use crate::render_service::RenderService;
use crate::results::Count;
use crate::scene::Scene;
use crate::theme::Theme;
use crate::view::View;
use crate::workspaces::PaneKind;

/// What is said where something is measured.
const NOT_KEPT: &str = "Measured results are lost when the program ends; export them to save them.";

/// What a pane is given.
pub struct PaneContext<'a> {
    /// The document, the data sets and the answers.
    pub scene: Scene<'a>,
    /// The colors.
    pub theme: Theme,
    /// What is looked at and how.
    pub view: &'a mut View,
    /// The user's mesh files.
    pub meshes: &'a MeshStore,
    /// The spectral files that were opened.
    pub opened: &'a Opened,
    /// Tells the nearest black body of a color, once it is asked.
    pub radiators: &'a Background<NearestBlackBodyQuery>,
    /// Where pictures are made.
    pub studio: &'a mut RenderService,
    /// Where the scene's cost is measured.
    pub laboratory: &'a mut Profiler,
    /// What is to be done when the frame is over.
    pub commands: &'a mut Vec<Command>,
}

impl PaneContext<'_> {
    /// Has something done when the frame is over.
    pub fn push(&mut self, command: impl Into<Command>) {
        self.commands.push(command.into());
    }

    /// Takes in what was measured since the last frame.
    pub fn refresh_run(&mut self) {
        let own = self.meshes.chosen(&self.scene.document.render.mesh);
        let scene = SceneRunQuery::of(&self.scene, own.as_ref(), self.view.saved.render.orbit);
        if let Some((run, is_current)) = self.laboratory.shown(&scene) {
            (self.view.accuracy.run, self.view.accuracy.is_current) = (Some(run), is_current);
        }
        if let Some((workload, report)) = self.laboratory.report() {
            self.view.accuracy.reports.insert(workload, report);
        }
    }

    /// The pictures as they would be made within the document's tolerance.
    pub fn planned_pictures(&self) -> Option<PicturesQuery> {
        let own = self.meshes.chosen(&self.scene.document.render.mesh);
        let quality = Accuracy::new(self.scene.document.render.tolerance).ok().map(Quality::Within)?;
        SceneRunQuery::pictures_of(&self.scene, own.as_ref(), self.view.saved.render.orbit, quality)
    }

    /// Hits, misses and times of each kind of question, the window's and the pictures'.
    pub fn counts(&self) -> Vec<(&'static str, Count)> {
        let mut counts: Vec<(&'static str, Count)> = self.scene.results.counts().into_iter().collect();
        counts.extend(self.studio.counts());
        counts
    }
}

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
