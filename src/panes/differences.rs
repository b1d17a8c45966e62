//! Each camera's differences from the reference: arrows of the patches, or offsets of the loci.

use egui::{Rect, Ui, Vec2};

use super::context::{Pane, PaneContext};
use crate::figures::differences;
use crate::panes::widgets;
use crate::theme::UNIT;
use crate::workspaces::PaneKind;

pub const PANE: Pane =
    Pane::new(PaneKind::DIFFERENCES, "Differences", show).figure(&differences::KIND).under_conditions().table();

fn show(ui: &mut Ui, rect: Rect, context: &mut PaneContext<'_>) {
    let body = widgets::pane(ui, &PANE, rect, context, |ui, context| {
        widgets::switch(ui, &mut context.view.saved.difference_plane);
    });
    let body = body.shrink2(Vec2::new(UNIT, 0.0));
    if widgets::figure_numbers(ui, &PANE, body, context) {
        return;
    }
    let body = widgets::lines::caution(ui, body, context);
    widgets::differences::plots(ui, body, context.view.saved.difference_plane, context);
    widgets::walk::along(ui, PANE.kind, context, widgets::walk::patches_by_sensor);
}
