//! The context that every pane and widget works in.

use std::any::{Any, TypeId};
use std::collections::HashMap;

use egui::{Rect, Response, Ui};

use crate::action::{Action, RenderAction};
use crate::catalog::meshes::MeshStore;
use crate::catalog::opened::Opened;
use crate::catalog::recorded_store::RecordedStore;
use crate::catalog::spectral_images::ImageStore;
use crate::command::Command;
use crate::document::render::RenderSettings;
use crate::figures::curves::ImportSelection;
use crate::figures::kind::FigureKind;
use crate::figures::look::FigureLook;
use crate::jobs::Later;
use crate::profiler::Profiler;
use crate::render_service::RenderService;
use crate::scene::Scene;
use crate::theme::Theme;
use crate::view::View;
use crate::workspaces::PaneKind;

/// A pane: what its file says about it, in one constant.
#[must_use]
pub struct Pane {
    pub kind: PaneKind,
    pub title: &'static str,
    /// Its title among the tabs of its slot.
    pub tab: &'static str,
    pub show: Show,
    /// Its figure as it is saved; `None` for a pane without one.
    pub figure: Option<&'static FigureKind>,
    /// The figure's numbers depend on the document's conditions, and are written with them.
    pub under_conditions: bool,
    /// The pane can show its numbers as a table instead.
    pub table: bool,
    /// What the right column offers while the pane is the view that has the focus.
    pub settings: Option<Show>,
}

pub type Show = fn(&mut Ui, Rect, &mut PaneContext<'_>);

impl Pane {
    pub const fn new(kind: PaneKind, title: &'static str, show: Show) -> Self {
        Self { kind, title, tab: title, show, figure: None, under_conditions: false, table: false, settings: None }
    }

    pub const fn figure(self, kind: &'static FigureKind) -> Self {
        Self { figure: Some(kind), ..self }
    }

    pub const fn tab(self, tab: &'static str) -> Self {
        Self { tab, ..self }
    }

    pub const fn settings(self, settings: Show) -> Self {
        Self { settings: Some(settings), ..self }
    }

    pub const fn under_conditions(self) -> Self {
        Self { under_conditions: true, ..self }
    }

    pub const fn table(self) -> Self {
        Self { table: true, ..self }
    }
}

/// What panes keep from frame to frame: each a struct of its own, in its own file.
#[derive(Default)]
pub struct PaneStates(HashMap<TypeId, Box<dyn Any>>);

impl PaneStates {
    /// The state of a type; as new at first.
    #[expect(clippy::missing_panics_doc, reason = "a state is of the type that it is kept under")]
    pub fn of<S: Default + 'static>(&mut self) -> &mut S {
        let state = self.0.entry(TypeId::of::<S>()).or_insert_with(|| Box::<S>::default());
        state.downcast_mut().expect("a state is of the type that it is kept under")
    }
}

pub struct PaneContext<'a> {
    pub panes: &'static [&'static Pane],
    pub scene: Scene<'a>,
    pub theme: Theme,
    pub view: &'a mut View,
    pub meshes: &'a MeshStore,
    pub images: &'a ImageStore,
    pub opened: &'a Opened,
    pub recorded: &'a RecordedStore,
    pub later: &'a Later,
    pub states: &'a mut PaneStates,
    pub render_service: &'a mut RenderService,
    pub profiler: &'a mut Profiler,
    pub commands: &'a mut Vec<Command>,
}

impl PaneContext<'_> {
    pub fn pane(&self, kind: PaneKind) -> Option<&'static Pane> {
        self.panes.iter().copied().find(|pane| pane.kind == kind)
    }

    pub fn title(&self, kind: PaneKind) -> &'static str {
        self.pane(kind).map_or("", |pane| pane.title)
    }

    pub fn look(&self, pane: PaneKind) -> FigureLook {
        look(pane, (&self.scene, self.view), self.render_service, self.profiler, self.opened)
    }

    pub fn import_selection(&self) -> Option<ImportSelection> {
        self.view.import.selection(&self.scene, self.opened)?.refreshed(self.opened)
    }

    /// A button that has something done.
    pub fn button(&mut self, ui: &mut Ui, words: &str, hint: &str, command: impl Into<Command>) {
        if hinted(ui.button(words), hint).clicked() {
            self.push(command);
        }
    }

    /// A line of a menu that has something done.
    pub fn item(&mut self, ui: &mut Ui, words: &str, hint: &str, command: impl Into<Command>) {
        if hinted(ui.button(words), hint).clicked() {
            self.push(command);
            ui.close();
        }
    }

    /// Has something done when the frame is over.
    pub fn push(&mut self, command: impl Into<Command>) {
        self.commands.push(command.into());
    }
}

fn hinted(response: Response, hint: &str) -> Response {
    if hint.is_empty() { response } else { response.on_hover_text(hint) }
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
