//! The context that every pane and widget works in.

use chromascope_core::accuracy::RelTolerance;
use chromascope_core::query::NearestBlackBodyQuery;
use chromascope_core::query::render::picture::PicturesQuery;
use chromascope_core::render::{Quality, Shadows};
use egui::{Rect, Ui};

use crate::action::{Action, RenderAction};
use crate::catalog::meshes::MeshStore;
use crate::catalog::opened::Opened;
use crate::catalog::recorded_store::RecordedStore;
use crate::catalog::spectral_images::ImageStore;
use crate::command::Command;
use crate::document::render::RenderSettings;
use crate::export::page::PageJob;
use crate::figures::curves::{CurveCache, ImportSelection};
use crate::figures::kind::FigureKind;
use crate::figures::look::FigureLook;
use crate::jobs::Background;
use crate::profiler::plans::PlanAnswer;
use crate::profiler::{Profiler, SceneRunJob};
use crate::ranking::Ranking;
use crate::render_service::RenderService;
use crate::report::ReportJob;
use crate::results::Count;
use crate::scene::Scene;
use crate::theme::Theme;
use crate::view::View;
use crate::workspaces::PaneKind;

/// A pane: what its file says about it, in one constant.
pub struct Pane {
    /// Id in layouts.
    pub kind: PaneKind,
    /// Title; its file has the same name.
    pub title: &'static str,
    /// Draws the pane in exactly its rectangle.
    pub show: fn(&mut Ui, Rect, &mut PaneContext<'_>),
    /// Its figure as it is saved; `None` for a pane without one.
    pub figure: Option<&'static FigureKind>,
    /// The figure's numbers depend on the document's conditions, and are written with them.
    pub under_conditions: bool,
    /// The pane can show its numbers as a table instead.
    pub table: bool,
}

/// Reason that there are no plans.
pub struct NothingRendered;

/// Everything a pane is given for a frame.
pub struct PaneContext<'a> {
    /// All panes.
    pub panes: &'static [&'static Pane],
    /// The document, the data sets and the answers.
    pub scene: Scene<'a>,
    /// The colors.
    pub theme: Theme,
    /// View state: selection, zoom, layout.
    pub view: &'a mut View,
    /// The user's mesh files.
    pub meshes: &'a MeshStore,
    /// The user's spectral images.
    pub images: &'a ImageStore,
    /// The spectral files that were opened.
    pub opened: &'a Opened,
    /// The report that is being made.
    pub report: &'a Background<ReportJob>,
    /// The file of recorded raw values.
    pub recorded: &'a RecordedStore,
    /// Finds the nearest blackbody of a color, on demand.
    pub radiators: &'a Background<NearestBlackBodyQuery>,
    /// Picture of the window about the program.
    pub portrait: &'a Background<PicturesQuery>,
    /// Pixels of the Figure page.
    pub pages: &'a Background<PageJob>,
    /// Renderer of the pictures.
    pub render_service: &'a mut RenderService,
    /// Profiler of the scene.
    pub profiler: &'a mut Profiler,
    /// Ranks cameras.
    pub ranking: &'a mut Ranking,
    /// The curves that Import drew last.
    pub curves: &'a mut Option<CurveCache>,
    /// Commands carried out after the frame.
    pub commands: &'a mut Vec<Command>,
}

impl PaneContext<'_> {
    /// A pane, if there is one of this id.
    pub fn pane(&self, kind: PaneKind) -> Option<&'static Pane> {
        self.panes.iter().copied().find(|pane| pane.kind == kind)
    }

    /// Title of a pane.
    pub fn title(&self, kind: PaneKind) -> &'static str {
        self.pane(kind).map_or("", |pane| pane.title)
    }

    /// The camera whose color correction is shown and saved.
    pub fn correction_camera(&self) -> Option<String> {
        self.view.correction.camera(&self.scene)
    }

    /// What the pane's figure takes from the window.
    pub fn look(&self, pane: PaneKind) -> FigureLook {
        look(pane, (&self.scene, self.view), self.render_service, self.profiler, self.opened)
    }

    /// The item selected in Import; requests its preview if that is not available yet.
    pub fn import_selection(&self) -> Option<ImportSelection> {
        self.view.import.selection(&self.scene, self.opened)?.refreshed(self.opened)
    }

    /// Has something done when the frame is over.
    pub fn push(&mut self, command: impl Into<Command>) {
        self.commands.push(command.into());
    }

    /// Applies the measurements finished since the last frame.
    pub fn refresh_run(&mut self) {
        let own = self.meshes.chosen(&self.scene.document.render.mesh);
        let scene = SceneRunJob::of(&self.scene, own.as_ref(), self.view.saved.render.orbit);
        self.profiler.refresh(&scene);
    }

    /// The plan of each rendered sensor, as pictures within the document's tolerance would take it; `Ok(None)` until one is
    /// made. An error where nothing is rendered.
    pub fn plans(&self) -> Result<Option<Vec<PlanAnswer>>, NothingRendered> {
        let own = self.meshes.chosen(&self.scene.document.render.mesh);
        let quality = RelTolerance::new(self.scene.document.render.tolerance).ok().map(Quality::Within);
        let orbit = self.view.saved.render.orbit;
        let pictures = quality.and_then(|quality| SceneRunJob::pictures_of(&self.scene, own.as_ref(), orbit, quality));
        let mut pictures = pictures.ok_or(NothingRendered)?;
        let geometry = &mut pictures.shading.geometry;
        let frame = self.render_service.frame();
        let visible = frame.and_then(|frame| Some(&frame.query.mesh()?.shading.geometry)).filter(|visible| {
            visible.visibility.mesh == geometry.visibility.mesh
                && visible.lighting == geometry.lighting
                && (visible.shadows == Shadows::Off) == (geometry.shadows == Shadows::Off)
        });
        // All angles of the current pictures are cached; those of the next pictures soon will be.
        let soon = self.render_service.is_looked_at()
            && self.render_service.failure().is_none()
            && !self.view.render.cancelled;
        if let Some(visible) = visible {
            geometry.clone_from(visible);
        }
        if visible.is_some() || !soon {
            self.profiler.plan(&pictures);
        }
        Ok(self.profiler.plans(&pictures))
    }

    /// Hits, misses and times of each kind of query, the window's and the pictures'.
    pub fn counts(&self) -> Vec<(&'static str, Count)> {
        self.scene.results.counts().into_iter().collect()
    }
}

/// What a pane's figure takes from the view, with the latest answers.
pub fn look(
    pane: PaneKind,
    (scene, view): (&Scene<'_>, &View),
    render_service: &RenderService,
    profiler: &Profiler,
    opened: &Opened,
) -> FigureLook {
    FigureLook {
        pictures: render_service.frame().cloned(),
        measured: profiler.measured.clone(),
        curves: view.import.selection(scene, opened),
        ..view.look(pane)
    }
}

/// Changes the settings of pictures; changes of the same name during one drag are one step.
pub fn set_render(context: &mut PaneContext<'_>, what: &'static str, change: impl FnOnce(&mut RenderSettings)) {
    let mut to = context.scene.document.render.clone();
    change(&mut to);
    context.push(Action::Render(RenderAction::Set { what, to: Box::new(to) }));
}
