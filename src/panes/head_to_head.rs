//! Two cameras side by side: values, differences, and whether these exceed the uncertainty.

use chromascope_core::query::CameraMetric;
use chromascope_core::query::metrics::Better;
use egui::{Rect, Ui, Vec2};

use super::context::{Pane, PaneContext};
use crate::figures::{head_to_head as figure, metrics};
use crate::panes::widgets;
use crate::panes::widgets::pick_list::{self, Line};
use crate::panes::widgets::table::DataTable;
use crate::plot_item::SensorId;
use crate::scene::metrics::{Ranked, RankedCameras, Ranking};
use crate::theme::UNIT;
use crate::view::Sorting;
use crate::workspaces::PaneKind;

/// Width from which on the better camera has a column.
const WITH_BETTER: f32 = 440.0;

pub const PANE: Pane =
    Pane::new(PaneKind::HEAD_TO_HEAD, "Head to head", show).tab("Against").figure(&figure::KIND).under_conditions();

fn show(ui: &mut Ui, rect: Rect, context: &mut PaneContext<'_>) {
    let body = widgets::body(ui, &PANE, rect, context, |_, _| {});
    // All cameras, or those of the table: one request serves both panes.
    let ranked = context.states.of::<Ranking>().ask(context.later, &context.scene, context.view.saved.metrics.cameras);
    let pair = figure::pair(&ranked, &context.scene, &context.view.look(PANE.kind));
    let mut child = widgets::clipped(ui, "pair", body);
    let chosen = [choose(&mut child, 0, &ranked, pair[0], context), choose(&mut child, 1, &ranked, pair[1], context)];
    for (place, chosen) in chosen.into_iter().enumerate() {
        if let Some(id) = chosen {
            context.view.saved.metrics.pair[place] = Some(id);
            ui.ctx().request_repaint();
        }
    }
    let [Some(a), Some(b)] = pair else {
        let words = if context.view.saved.metrics.cameras == RankedCameras::Library {
            "Choose two cameras."
        } else {
            "Choose two cameras; the list has fewer than two."
        };
        child.weak(words);
        return;
    };
    let top = child.min_rect().bottom() + UNIT;
    let known: Vec<_> = metrics::uncertainties(&ranked, [a, b]).collect();
    let body = widgets::lines::foot(ui, body, &context.scene.metrics_words_with(CameraMetric::ALL, known), context);
    let mut table = metrics::head_to_head(&ranked, [a, b]);
    // That of the difference decides; the cameras' own would need more room than there is, and stand under the pointer.
    for cell in table.rows.iter_mut().flat_map(|row| &mut row[3..]) {
        *cell = std::mem::take(cell).with(|note| {
            note.hint = note.behind().unwrap_or_default();
            note.uncertainty = None;
        });
    }
    // Gray says it, too.
    table.columns[metrics::BETTER].starts_hidden = body.width() < WITH_BETTER;
    let shown = DataTable::new(PaneKind::HEAD_TO_HEAD, "Head to head", &table).with_quantities();
    // In a narrow pane the table reaches to its edge, so that the first three columns are shown whole.
    let reach = if table.columns[metrics::BETTER].starts_hidden { UNIT } else { 0.0 };
    let place = Rect::from_min_max(
        egui::pos2(body.left() - 1.5 * reach, top.min(body.bottom())),
        body.max + Vec2::new(2.0 * reach, 0.0),
    );
    let shown = shown.show(ui, place, context);
    if let Some(metric) = shown.activated.and_then(|row| CameraMetric::ALL.get(row)) {
        let sorting = Sorting { column: metric.symbol.to_owned(), descending: metric.better == Better::Higher };
        context.view.saved.looks.entry(metrics::TABLE.to_owned()).or_default().sorting = Some(sorting);
    }
}

fn choose(
    ui: &mut Ui,
    place: usize,
    ranked: &Ranked,
    now: Option<usize>,
    context: &PaneContext<'_>,
) -> Option<SensorId> {
    let letter = ["A", "B"][place];
    let mut chosen = None;
    ui.horizontal(|ui| {
        ui.strong(letter);
        let words = now.map_or("Choose a camera", |now| ranked.cameras[now].id.name.as_str());
        let name = format!("Camera {letter}");
        let follows = context.view.saved.metrics.pair[place].is_none();
        let hint = if follows { "Follows the selection until you choose" } else { "A camera of the comparison" };
        let width = ui.available_width();
        let index = pick_list::drop_down(ui, (&name, hint), words, width, &context.theme, || {
            let cameras = ranked.cameras.iter().enumerate();
            cameras.map(|(index, camera)| Line::new(&camera.id.name, Some(index) == now)).collect()
        });
        chosen = index.map(|index| ranked.cameras[index].id.clone());
    });
    chosen
}
