//! The pane's own controls.

use egui::Ui;

use crate::action::{Action, RenderAction};
use crate::panes::context::PaneContext;
use crate::panes::widgets;
use crate::theme::UNIT;

/// Shows the arrangement of pictures and the presets of the paper's figures.
pub(super) fn show(ui: &mut Ui, context: &mut PaneContext<'_>) {
    if let Some(mode) = widgets::choice(ui, context.view.saved.render.mode) {
        context.view.saved.render.mode = mode;
        ui.ctx().request_repaint();
    }
    ui.add_space(UNIT);
    let figures = [
        (RenderAction::Figure8, "Figure 8", "The paper's head"),
        (RenderAction::Figure9, "Figure 9", "The paper's fern"),
    ];
    // All of them have room in a narrow pane.
    ui.spacing_mut().button_padding.x = 0.5 * UNIT;
    ui.spacing_mut().item_spacing.x = 0.75 * UNIT;
    for (action, words, mesh) in figures {
        let hint = format!(
            "{mesh} in parallel sunlight without sky, balanced to D55, with the reflectance model chosen under Surface \
             (initially radiometric). Also sets light and white balance; the compared sensors stay."
        );
        if ui.button(words).on_hover_text(hint).clicked() {
            set_up(action, context);
        }
    }
    let menu = ui.menu_button("⋯", |ui| {
        for action in [RenderAction::PaperFigure8, RenderAction::PaperFigure9] {
            let words = Action::Render(action.clone()).name();
            let hint = "The paper's setup: a point light, and Eq 12 with P as printed: no Fresnel factor, A = XY. \
                        The paper does not give σ and τ; they are this program's.";
            if ui.button(words).on_hover_text(hint).clicked() {
                set_up(action, context);
                ui.close();
            }
        }
    });
    menu.response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Button, true, "Figures as in the paper"));
    menu.response.on_hover_text("Figures 8 and 9 as in the paper: point light, the paper's normalization");
}

fn set_up(action: RenderAction, context: &mut PaneContext<'_>) {
    context.view.saved.render.orbit = None;
    context.push(Action::Render(action));
}
