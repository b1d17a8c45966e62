//! What the scene on show did not compute, and the time that this saved.

use egui::{Grid, Rect, RichText, ScrollArea, Ui, UiBuilder, Vec2};

use super::PaneContext;
use crate::command::Command;
use crate::figures::accuracy;
use crate::figures::pareto::duration;
use crate::laboratory::LeftOut;
use crate::theme::UNIT;
use crate::widgets;
use crate::workspaces::PaneKind;

/// Shows the pane in its rectangle.
pub fn show(ui: &mut Ui, rect: Rect, context: &mut PaneContext<'_>) {
    context.refresh_run();
    let body = widgets::pane(ui, PaneKind::LeftOut, rect, context, |_, _| {});
    context.view.accuracy.remembered = accuracy::remembered(&context.counts());
    let rows = accuracy::left_out(context.view);
    if context.view.saved.tables.contains(&PaneKind::LeftOut) {
        widgets::data_table(ui, body, "left out", &accuracy::left_out_table(&rows));
        return;
    }
    let inner = body.shrink2(Vec2::new(2.0 * UNIT, 0.0));
    let mut child = ui.new_child(UiBuilder::new().id_salt("left out").max_rect(inner));
    child.set_clip_rect(body.intersect(ui.clip_rect()));
    ScrollArea::both().id_salt("left out").auto_shrink(false).show(&mut child, |ui| {
        if context.view.accuracy.run.is_none() {
            ui.horizontal(|ui| {
                if context.laboratory.busy().is_none() && ui.button("Run").clicked() {
                    context.push(Command::Measure);
                }
                ui.label("measures what was not computed on this scene, by computing it.");
            });
        }
        table(ui, &rows, context);
    });
}

fn table(ui: &mut Ui, rows: &[LeftOut], context: &PaneContext<'_>) {
    let theme = context.theme;
    Grid::new("left out").num_columns(4).spacing([4.0 * UNIT, UNIT]).show(ui, |ui| {
        for caption in ["Left out", "Time saved", "How many", "Measured by"] {
            ui.label(RichText::new(caption).small().color(theme.weak));
        }
        ui.end_row();
        for row in rows {
            ui.label(row.what);
            ui.monospace(if context.view.fixed_clock { "–".to_owned() } else { duration(row.saved) });
            ui.monospace(count(row));
            ui.label(RichText::new(&row.how).small().color(theme.weak));
            ui.end_row();
        }
    });
}

/// A count, with its share where there is a whole.
fn count(row: &LeftOut) -> String {
    match row.of {
        Some(of) if of > 0 => format!("{} of {of} ({:.0} %)", row.count, 100.0 * row.count as f64 / of as f64),
        _ => row.count.to_string(),
    }
}
