//! Work that the visible scene skipped, and the time it saved.

use egui::{Rect, TextStyle, Ui, Vec2};

use super::context::{Pane, PaneContext};
use crate::figures::skipped_work::{self, OVERLAP};
use crate::panes::widgets;
use crate::panes::widgets::lines;
use crate::panes::widgets::table::{Column, DataTable};
use crate::theme::{ROW, UNIT};
use crate::workspaces::PaneKind;

/// The footnote of the workspace.
const NOT_SAVED: &str = "Measured results are lost when the program ends; export them to save them.";

/// The pane.
pub const PANE: Pane = Pane {
    kind: PaneKind::WORK_SAVED,
    title: "Work saved",
    show,
    figure: Some(skipped_work::figure),
    under_conditions: false,
    table: false,
};

/// Shows the pane in its rectangle.
fn show(ui: &mut Ui, rect: Rect, context: &mut PaneContext<'_>) {
    context.refresh_run();
    let body = widgets::pane(ui, &PANE, rect, context, |_, _| {});
    if !context.view.fixed_clock {
        let run = context.profiler.measured.run.as_ref().map_or(&[][..], |run| &run.skipped_work);
        context.profiler.measured.remembered = skipped_work::remembered(&context.counts(), run);
    }
    let sections = skipped_work::sections(&context.profiler.measured);
    let inner = body.shrink2(Vec2::new(2.0 * UNIT, 0.0));
    let foot = Rect::from_min_max(egui::pos2(inner.left(), inner.bottom() - ROW), inner.max);
    let is_old = sections.iter().any(|section| section.is_old);
    let measured = context.profiler.measured.run.is_some();
    let words = match (measured, is_old) {
        (false, _) => "Run, in Methods, times the work that was skipped.".to_owned(),
        (true, false) => format!("{OVERLAP} {NOT_SAVED}"),
        (true, true) => format!("Measured for an earlier scene: run again. {OVERLAP} {NOT_SAVED}"),
    };
    let color = if is_old { context.theme.warning } else { context.theme.weak };
    let cut = lines::elided(ui, foot, &words, TextStyle::Small, color);
    let response = ui.interact(foot, ui.scope_id().with("footnote"), egui::Sense::hover());
    response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Label, true, &words));
    if cut {
        response.on_hover_text(&words);
    }
    if sections.is_empty() {
        return;
    }
    let table = skipped_work::table(&sections);
    let mut columns: Vec<Column> = table.columns.iter().map(|head| Column::from_head(head)).collect();
    for (column, decimals) in columns.iter_mut().zip([None, Some(1), None, Some(0), Some(0), Some(1), None]) {
        column.decimals = decimals;
    }
    let rect = Rect::from_min_max(inner.min, egui::pos2(inner.right(), foot.top()));
    DataTable::new(PaneKind::WORK_SAVED, PANE.title, &table).with_columns(columns).show(ui, rect, context);
}
