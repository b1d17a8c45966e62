//! Playing the tour, and bringing the user's own document and view back.

use super::ChromascopeApp;
use crate::action::Action;
use crate::action::history::History;
use crate::command::{Command, TourMove};
use crate::plot_item::PlotItem;
use crate::view::tour::Tour;
use crate::view::{DiagramFit, SavedView};
use crate::workspaces::{Layout, PaneKind};

pub(super) struct Interrupted {
    pub(super) history: History,
    saved: SavedView,
    selected: Option<PlotItem>,
    pinned: Vec<PlotItem>,
    maximized: Option<PaneKind>,
    focused: Option<PaneKind>,
}

impl ChromascopeApp {
    pub(super) fn tour(&mut self, to: TourMove) {
        let now = self.view.tour;
        match (to, now) {
            (TourMove::Begin(tour), _) => {
                self.begin_tour();
                self.show_step(tour, 0);
            }
            (TourMove::Next, Some((tour, step))) if step + 1 < tour.steps().len() => self.show_step(tour, step + 1),
            (TourMove::Back, Some((tour, step))) => self.show_step(tour, step.saturating_sub(1)),
            (TourMove::Next | TourMove::End, _) => self.end_tour(),
            (TourMove::Back, None) => {}
        }
    }

    fn begin_tour(&mut self) {
        if self.interrupted.is_some() {
            return;
        }
        let view = &mut self.view;
        view.help = crate::view::HelpView::default();
        self.interrupted = Some(Interrupted {
            history: std::mem::take(&mut self.history),
            saved: view.saved.clone(),
            selected: view.selected.take(),
            pinned: std::mem::take(&mut view.pinned),
            maximized: view.maximized.take(),
            focused: view.focused.take(),
        });
    }

    fn show_step(&mut self, tour: Tour, index: usize) {
        let Some(interrupted) = &self.interrupted else { return };
        let step = &tour.steps()[index];
        self.history = History::new(tour.document(step, &interrupted.history.document().own));
        let view = &mut self.view;
        view.tour = Some((tour, index));
        view.saved.layout = Layout::default();
        view.saved.tables.clear();
        view.saved.diagram_fit = DiagramFit::Data;
        view.saved.render = crate::view::RenderLook::default();
        (view.card, view.numerics, view.adding) = (None, false, false);
        view.show(step.pane);
        view.maximized = step.maximized;
        view.page = step.is_printed.then_some(step.pane);
        view.selected = step.selected();
        view.pinned.clear();
        view.focused = None;
        view.reset_plots = true;
        view.status = crate::view::Status::default();
    }

    /// Brings back what the user had, to the last step of undo.
    pub(super) fn end_tour(&mut self) {
        let Some(interrupted) = self.interrupted.take() else { return };
        let Interrupted { history, mut saved, selected, pinned, maximized, focused } = interrupted;
        let view = &mut self.view;
        saved.recent.clone_from(&view.saved.recent);
        saved.import.clone_from(&view.saved.import);
        self.history = history;
        (view.saved, view.selected, view.pinned) = (saved, selected, pinned);
        (view.maximized, view.focused, view.tour, view.page) = (maximized, focused, None, None);
        view.reset_plots = true;
        view.say("The tour is over; your document is as it was.");
    }

    /// Ends the tour before a command that is meant for the user's own document.
    pub(super) fn end_tour_before(&mut self, command: &Command) {
        let is_own = matches!(
            command,
            Command::Open
                | Command::OpenRecorded
                | Command::OpenFolder
                | Command::Session(_)
                | Command::OpenDocument(_)
                | Command::OpenPath(_)
                | Command::Paste(_)
                | Command::Do(Action::Imported(_) | Action::Start(_) | Action::Reset)
        );
        if is_own {
            self.end_tour();
        }
    }

    pub(super) fn own_view(&self) -> &SavedView {
        self.interrupted.as_ref().map_or(&self.view.saved, |interrupted| &interrupted.saved)
    }
}
