//! The pane's own controls.

use egui::Ui;

use crate::action::{Action, RenderAction};
use crate::panes::PaneContext;
use crate::theme::UNIT;
use crate::view::render::RenderMode;
use crate::widgets;

/// How pictures stand, and the paper's figures.
pub(super) fn show(ui: &mut Ui, context: &mut PaneContext<'_>) {
    let modes = [
        (RenderMode::Grid, "Grid", "All sources side by side"),
        (RenderMode::Split, "Split", "The truth at the left, a source at the right, with a divider to drag"),
        (RenderMode::One, "One", "One source, large (double click a picture)"),
        (RenderMode::Difference, "Difference", "How far each source is from the truth, pixel by pixel"),
    ];
    if let Some(mode) = widgets::segmented(ui, &modes, context.view.saved.render.mode) {
        context.view.saved.render.mode = mode;
        ui.ctx().request_repaint();
    }
    ui.add_space(UNIT);
    let figures = [
        (
            RenderAction::Figure8,
            "Figure 8",
            "The paper's head under direct sunlight, balanced to D55, in the reading of Eq 1 that is chosen under Surface. Sets Light \
             and White too, in one step; ticked sources stay.",
        ),
        (
            RenderAction::Figure9,
            "Figure 9",
            "The paper's fern under direct sunlight, balanced to D55, in the reading of Eq 1 that is chosen under Surface. Sets Light \
             and White too, in one step; ticked sources stay.",
        ),
    ];
    for (action, words, hint) in figures {
        if ui.button(words).on_hover_text(hint).clicked() {
            context.view.saved.render.orbit = None;
            context.push(Action::Render(action));
        }
    }
}
