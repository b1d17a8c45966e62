//! Cameras by figures of merit: ranked, with uncertainties, linked with all panes.

use chromascope_core::query::CameraMetric;
use chromascope_core::query::metrics::Better;
use chromascope_figure::{Cell, Column, Table};
use egui::{Rect, Ui};

use super::context::{Pane, PaneContext};
use crate::action::{Action, CompareAction};
use crate::command::Command;
use crate::document::SetKind;
use crate::figures::metrics::{self, TABLE};
use crate::jobs::PATIENCE;
use crate::panes::widgets;
use crate::panes::widgets::table::DataTable;
use crate::plot_item::{PlotItem, SensorId};
use crate::scene::metrics::{Ranked, RankedCameras, Ranking};
use crate::scene::uncertainty::rank_cell;
use crate::theme::UNIT;
use crate::view::Sorting;
use crate::workspaces::PaneKind;

/// Columns of differences that the table starts with; all other groups are shown whole.
const SHOWN: [&str; 5] = ["delta-e2000-mean", "delta-e2000-p95", "delta-e2000-max", "uv-prime-mean", "xy-mean"];

pub const PANE: Pane = Pane::new(PaneKind::METRICS, "Metrics", show).figure(&metrics::KIND).under_conditions();

fn show(ui: &mut Ui, rect: Rect, context: &mut PaneContext<'_>) {
    let body = widgets::body(ui, &PANE, rect, context, switches);
    let body = widgets::lines::caution(ui, body, context);
    let which = context.view.saved.metrics.cameras;
    let ranked = context.states.of::<Ranking>().ask(context.later, &context.scene, which);
    if let Some(why) = Ranking::seen(context.later).failure {
        return widgets::say(ui, body, format!("Cameras could not be ranked: {why}."), context.theme.error);
    }
    if ranked.cameras.is_empty() {
        let words = match which {
            RankedCameras::Yours => "No camera of yours. Drop a file of sensitivities on the window.",
            _ => "Tick a camera in the Library.",
        };
        return widgets::say(ui, body, words, context.theme.weak);
    }
    let sorting = context.view.saved.looks.get(TABLE).and_then(|look| look.sorting.clone());
    let metric = metrics::sorted_by(&context.scene, sorting.as_ref());
    let table = table(&ranked, metric, context);
    let item = |row: usize| Some(PlotItem::Sensor(ranked.cameras[row].id.clone()));
    let shown = DataTable::new(PaneKind::METRICS, TABLE, &table).with_items(&item);
    let shown = match metrics::first(&context.scene) {
        Some(first) => {
            shown.sorted_by(Sorting { column: first.symbol.to_owned(), descending: first.better == Better::Higher })
        }
        None => shown,
    };
    let known: Vec<_> = metrics::uncertainties(&ranked, 0..ranked.cameras.len()).collect();
    let body = widgets::lines::foot(ui, body, &context.scene.metrics_words_with(known), context);
    if let Some(row) = shown.show(ui, body, context).activated {
        compare(&ranked.cameras[row].id, context);
    }
}

fn switches(ui: &mut Ui, context: &mut PaneContext<'_>) {
    widgets::switch(ui, &mut context.view.saved.metrics.cameras);
    ui.add_space(UNIT);
    widgets::pixel::show(ui, context);
    if let Some(PlotItem::Sensor(id)) = context.view.selected.clone().filter(|_| selected(context).is_some()) {
        let compared = context.scene.document.compared(id.kind, &id.name).is_some();
        let (words, hint) = if compared {
            ("Remove", "Remove the selected camera from the comparison (Enter)")
        } else {
            ("Compare", "Add the selected camera to the comparison (Enter, double click)")
        };
        if ui.button(words).on_hover_text(hint).clicked() {
            compare(&id, context);
        }
        let hint = "The selected camera on one page (Esc returns)";
        context.button(ui, "Report card", hint, Command::Maximize(PaneKind::REPORT_CARD));
    }
    let waiting = Ranking::seen(context.later);
    let slow = waiting.busy.is_some_and(|busy| busy >= PATIENCE);
    if let Some((done, all)) = waiting.progress().filter(|_| slow) {
        widgets::note(ui, format!("Computing: {done} of {all}"));
    }
    if waiting.busy.is_some() {
        ui.ctx().request_repaint_after(PATIENCE);
    }
}

fn selected(context: &PaneContext<'_>) -> Option<SensorId> {
    context.view.selected.as_ref()?.source().filter(|id| id.kind == SetKind::Camera).cloned()
}

fn compare(id: &SensorId, context: &mut PaneContext<'_>) {
    let (kind, name) = (id.kind, id.name.clone());
    let compared = context.scene.document.compared(kind, &name).is_some();
    let action = if compared { CompareAction::Remove(kind, name) } else { CompareAction::Add(kind, name) };
    context.push(Action::Compare(action));
}

/// The table of all cameras: ranked by a metric, numbers gray that do not differ from the selected camera's.
fn table(ranked: &Ranked, metric: Option<CameraMetric>, context: &PaneContext<'_>) -> Table {
    let mut table = metrics::table(ranked);
    for (column, metric) in table.columns.iter_mut().skip(1).zip(CameraMetric::ALL) {
        column.starts_hidden = metric.group == CameraMetric::ALL[0].group && !SHOWN.contains(&metric.id);
    }
    let selected = selected(context).and_then(|id| ranked.cameras.iter().position(|camera| camera.id == id));
    for (row, cells) in table.rows.iter_mut().enumerate().filter(|(row, _)| Some(*row) != selected) {
        for (cell, metric) in cells.iter_mut().skip(1).zip(CameraMetric::ALL) {
            let other = selected.and_then(|selected| metrics::value(ranked, selected, *metric));
            let pair = other.zip(metrics::value(ranked, row, *metric));
            if pair.and_then(|(a, b)| metrics::differ(b, a)) == Some(false) {
                *cell = std::mem::take(cell).with(|note| note.is_gray = true);
            }
        }
    }
    let ranks = metric.map_or_else(Vec::new, |metric| metrics::ranks(ranked, metric));
    let head = |name: &str, hint: &str| Column { hint: hint.to_owned(), ..Column::from(name) };
    let by = "By the column that rows are sorted by. A range where values do not differ at 95 %.";
    table.insert(1, head("rank", by), ranks.into_iter().map(rank_cell));
    let compared = ranked.cameras.iter().map(|camera| context.scene.document.compared(camera.id.kind, &camera.id.name));
    let marks = compared.map(|compared| Cell::from(if compared.is_some() { "✓" } else { "" }));
    table.insert(2, head("compared", "Double click or Enter adds a camera to the comparison."), marks);
    table
}
