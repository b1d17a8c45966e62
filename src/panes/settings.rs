//! Settings of the view that has the focus.

use egui::{Rect, Ui, Vec2};

use super::context::{Pane, PaneContext};
use crate::panes::widgets;
use crate::theme::UNIT;
use crate::workspaces::PaneKind;

pub const PANE: Pane = Pane::new(PaneKind::SETTINGS, "Settings", show);

fn show(ui: &mut Ui, rect: Rect, context: &mut PaneContext<'_>) {
    let of = context.view.settings_view().and_then(|view| context.pane(view));
    let Some((of, settings)) = of.and_then(|of| Some((of, of.settings?))) else {
        return widgets::ground(ui, PANE.kind, rect, context);
    };
    let body = widgets::pane(ui, &PANE, rect, context, |ui, _| widgets::note(ui, format!("of {}", of.tab)));
    settings(ui, body.with_max_y(body.bottom() - Vec2::splat(UNIT).y), context);
}
