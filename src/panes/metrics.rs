//! Cameras by figures of merit: ranked, with uncertainties, linked with all panes.

use chromascope_core::query::metrics::Better;
use chromascope_core::query::{CameraMetric, MetricValue};
use chromascope_figure::{Cell, Table};
use egui::{Rect, Ui};

use super::context::{Pane, PaneContext};
use crate::action::{Action, CompareAction};
use crate::command::Command;
use crate::document::SetKind;
use crate::figures::metrics::{self, TABLE};
use crate::jobs::PATIENCE;
use crate::panes::widgets;
use crate::panes::widgets::table::{CellNote, Column, DataTable};
use crate::plot_item::{PlotItem, SensorId};
use crate::scene::metrics::{Ranked, RankedCameras, Ranking};
use crate::theme::UNIT;
use crate::view::table::Sorting;
use crate::workspaces::PaneKind;

/// Columns before the metrics: camera, rank, compared.
const BEFORE: usize = 3;
/// Columns of differences that the table starts with; all other groups are shown whole.
const SHOWN: [&str; 5] = ["delta-e2000-mean", "delta-e2000-p95", "delta-e2000-max", "uv-prime-mean", "xy-mean"];

pub const PANE: Pane = Pane {
    kind: PaneKind::METRICS,
    title: "Metrics",
    show,
    figure: Some(&metrics::KIND),
    under_conditions: true,
    table: false,
};

fn show(ui: &mut Ui, rect: Rect, context: &mut PaneContext<'_>) {
    let body = widgets::body(ui, &PANE, rect, context, switches);
    let body = widgets::caution::show(ui, body, context);
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
    let rows = Rows::new(&ranked, metric, context);
    let (columns, table) = (columns(), rows.table(context));
    let note = |row: usize, column: usize| rows.note(row, column);
    let item = |row: usize| Some(PlotItem::Sensor(ranked.cameras[row].id.clone()));
    let shown =
        DataTable::new(PaneKind::METRICS, TABLE, &table).with_columns(columns).with_notes(&note).with_items(&item);
    let shown = match metrics::first(&context.scene) {
        Some(first) => {
            shown.sorted_by(Sorting { column: first.symbol.to_owned(), descending: first.better == Better::Higher })
        }
        None => shown,
    };
    let known: Vec<_> = metrics::uncertainties(&ranked, 0..ranked.cameras.len()).collect();
    let body = widgets::caution::foot(ui, body, &context.scene.metrics_words_with(known), context);
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
        context.button(
            ui,
            "Report card",
            "The selected camera on one page (Esc returns)",
            Command::Maximize(PaneKind::REPORT_CARD),
        );
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

fn columns() -> Vec<Column> {
    let before = [
        ("camera", ""),
        ("rank", "By the column that rows are sorted by. A range where values do not differ at 95 %."),
        ("compared", "Double click or Enter adds a camera to the comparison."),
    ];
    let before =
        before.map(|(name, hint)| Column { name: name.to_owned(), hint: hint.to_owned(), ..Column::default() });
    let metrics = CameraMetric::ALL.iter().map(|metric| Column {
        name: metric.symbol.to_owned(),
        unit: metrics::unit(metric).to_owned(),
        hint: format!(
            "{}.{} ± one standard uncertainty. Gray numbers do not differ from the selected camera's at 95 %.",
            metric.label,
            match metric.better {
                Better::Lower => " Smaller is better.",
                Better::Higher => " Larger is better.",
                Better::Neither => "",
            }
        ),
        group: metric.group.label().to_owned(),
        decimals: Some(metric.decimals),
        largest_first: metric.better == Better::Higher,
        shaded: metric.better != Better::Neither,
        starts_hidden: metric.group == CameraMetric::ALL[0].group && !SHOWN.contains(&metric.id),
    });
    before.into_iter().chain(metrics).collect()
}

struct Rows<'a> {
    ranked: &'a Ranked,
    ranks: Vec<Option<[usize; 2]>>,
    selected: Option<usize>,
}

impl<'a> Rows<'a> {
    fn new(ranked: &'a Ranked, metric: Option<CameraMetric>, context: &PaneContext<'_>) -> Self {
        let ranks = metric.map_or_else(Vec::new, |metric| metrics::ranks(ranked, metric));
        let selected = selected(context).and_then(|id| ranked.cameras.iter().position(|camera| camera.id == id));
        Self { ranked, ranks, selected }
    }

    fn rank(&self, row: usize) -> Option<[usize; 2]> {
        self.ranks.get(row).copied().flatten()
    }

    fn value(&self, row: usize, column: usize) -> Option<MetricValue> {
        metrics::value(self.ranked, row, *CameraMetric::ALL.get(column.checked_sub(BEFORE)?)?)
    }

    fn table(&self, context: &PaneContext<'_>) -> Table {
        let mut table = Table::new(["camera", "rank", "compared"]);
        table.columns.extend(CameraMetric::ALL.iter().map(|metric| metric.symbol.to_owned()));
        for (row, camera) in self.ranked.cameras.iter().enumerate() {
            let compared = context.scene.document.compared(camera.id.kind, &camera.id.name).is_some();
            let first = [
                Cell::from(camera.id.name.as_str()),
                Cell::from(self.rank(row).map(|[best, _]| best as f64)),
                Cell::from(if compared { "✓" } else { "" }),
            ];
            let values = (0..CameraMetric::ALL.len())
                .map(|at| Cell::from(self.value(row, BEFORE + at).and_then(|value| value.value.ok())));
            table.push(first.into_iter().chain(values));
        }
        table
    }

    fn note(&self, row: usize, column: usize) -> CellNote {
        if column == 1 {
            let range = self.rank(row).filter(|[best, worst]| best < worst);
            let words = range.map(|[best, worst]| format!("{best}–{worst}"));
            return CellNote { is_gray: words.is_some(), words, ..CellNote::default() };
        }
        if column < BEFORE {
            return CellNote::default();
        }
        let Some(value) = self.value(row, column) else {
            let why = self.ranked.metrics[row].as_ref().and_then(|made| made.as_ref().err());
            return CellNote { hint: why.cloned().unwrap_or_default(), ..CellNote::default() };
        };
        let other = self.selected.filter(|selected| *selected != row).and_then(|row| self.value(row, column));
        CellNote {
            uncertainty: value.uncertainty.map(|by| by.standard),
            is_extrapolated: value.uncertainty.is_some_and(|by| by.is_extrapolated),
            is_gray: other.and_then(|other| metrics::differ(value, other)) == Some(false),
            hint: value.value.err().map_or_else(String::new, |why| format!("{why}.")),
            ..CellNote::default()
        }
    }
}
