//! Cameras by figures of merit: ranked, with uncertainties, linked with all panes.

use chromascope_core::query::CameraMetric;
use chromascope_core::query::metrics::MetricValue;
use chromascope_figure::{Cell, Column, Table};
use egui::{Rect, Ui};

use super::context::{Pane, PaneContext};
use crate::action::{Action, CompareAction};
use crate::document::SetKind;
use crate::figures::metrics::{self, TABLE};
use crate::format::fixed;
use crate::jobs::PATIENCE;
use crate::panes::widgets;
use crate::panes::widgets::table::{DataTable, Drawn};
use crate::plot_item::{PlotItem, SensorId};
use crate::scene::metrics::{Ranked, RankedCameras, Ranking};
use crate::scene::uncertainty::rank_cell;
use crate::theme::UNIT;
use crate::workspaces::PaneKind;

/// Place of the column that draws the metric that rows are sorted by.
const WHISKERS: usize = 2;
const DOT: f32 = 3.5;

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
            _ => "No camera is compared.",
        };
        return widgets::say(ui, body, words, context.theme.weak);
    }
    let sorting = context.view.saved.looks.get(TABLE).and_then(|look| look.sorting.clone());
    let metric = metrics::sorted_by(&context.scene, sorting.as_ref());
    let table = table(&ranked, metric, context);
    let span = metric.map_or([0.0, 1.0], |metric| span(&ranked, metric));
    let sources = context.scene.sources();
    let theme = context.theme;
    let draw = |painter: &egui::Painter, place: Rect, row: usize| {
        let Some(MetricValue { value: Ok(value), uncertainty }) = metric.and_then(|m| metrics::value(&ranked, row, m))
        else {
            return;
        };
        let id = &ranked.cameras[row].id;
        let source = sources.iter().find(|source| (source.kind, &source.name) == (id.kind, &id.name));
        let color = source.map_or(theme.weak, |source| theme.role(source.role));
        let x = |value: f64| {
            let share = ((value - span[0]) / (span[1] - span[0])).clamp(0.0, 1.0) as f32;
            place.left() + DOT + share * (place.width() - 2.0 * DOT)
        };
        if let Some(uncertainty) = uncertainty {
            let u = uncertainty.coverage * uncertainty.standard;
            painter.hline(x(value - u)..=x(value + u), place.center().y, egui::Stroke::new(1.5, color));
        }
        let at = egui::pos2(x(value), place.center().y);
        painter.circle_filled(at, DOT, color);
        if source.is_some() {
            // Told from the others without its color, too.
            painter.circle_stroke(at, DOT + 2.5, egui::Stroke::new(1.0, color));
        }
    };
    let item = |row: usize| Some(PlotItem::Sensor(ranked.cameras[row].id.clone()));
    let shown = DataTable::new(PaneKind::METRICS, TABLE, &table).with_items(&item);
    let shown =
        shown.with_drawn(Drawn { column: WHISKERS, width: (0.23 * body.width()).clamp(90.0, 150.0), draw: &draw });
    let shown = match metrics::usual(&context.scene) {
        Some(usual) => shown.sorted_by(usual),
        None => shown,
    };
    let known: Vec<_> = metrics::uncertainties(&ranked, 0..ranked.cameras.len()).collect();
    let body = widgets::lines::foot(ui, body, &context.scene.metrics_words_with(CameraMetric::ALL, known), context);
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
    let by =
        "By the column that rows are sorted by, among the cameras listed. A range where values do not differ at 95 %.";
    table.insert(1, head("rank", by), ranks.into_iter().map(rank_cell));
    metrics::insert_worst(&mut table, ranked, &context.scene, Some(3));
    let any = (0..ranked.cameras.len()).any(|camera| metrics::figures(ranked, camera).is_some());
    let of = metric.filter(|_| any).map_or_else(Column::default, |metric| {
        let [low, high] = span(ranked, metric).map(|end| fixed(end, 2));
        Column { unit: format!("{low} to {high}"), ..Column::default() }
    });
    let hint = "Dot: the value that rows are sorted by; whisker: where it lies at 95 %. Compared cameras have their \
                color; double click or Enter adds a camera to the comparison.";
    table.insert(
        WHISKERS,
        Column { name: "95 % interval".to_owned(), hint: hint.to_owned(), ..of },
        ranked.cameras.iter().map(|_| Cell::from("")),
    );
    table
}

/// Range of a metric over all cameras, with their uncertainties.
fn span(ranked: &Ranked, metric: CameraMetric) -> [f64; 2] {
    let values = (0..ranked.cameras.len()).filter_map(|camera| metrics::value(ranked, camera, metric));
    let ends = values.filter_map(|value| {
        let u = value.uncertainty.map_or(0.0, |uncertainty| uncertainty.coverage * uncertainty.standard);
        value.value.ok().map(|value| [value - u, value + u])
    });
    let [low, high] = ends.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], [a, b]| [low.min(a), high.max(b)]);
    match low.is_finite() {
        true if high > low => [low, high],
        true => [low - 0.5, low + 0.5],
        false => [0.0, 1.0],
    }
}
