//! Pairs of measured reflectances that a camera confuses and the reference does not, and the reverse.

use chromascope_figure::{Cell, Column, Table};
use egui::{Rect, RichText, Ui};

use super::context::{Pane, PaneContext};
use crate::action::{Action, RenderAction, SceneAction};
use crate::document::render::RenderSettings;
use crate::document::{SetKind, Subset};
use crate::panes::widgets;
use crate::panes::widgets::table::DataTable;
use crate::plot_item::{PlotItem, SensorId};
use crate::scene::metrics::{FoundMetamers, MetamerRow};
use crate::theme::UNIT;
use crate::workspaces::PaneKind;

pub const PANE: Pane = Pane::new(PaneKind::METAMERS, "Metamers", show).under_conditions();

/// The pair that was clicked, as a row.
#[derive(Default)]
pub struct ClickedPair(pub Option<usize>);

fn show(ui: &mut Ui, rect: Rect, context: &mut PaneContext<'_>) {
    let body = widgets::body(ui, &PANE, rect, context, switches);
    let mut child = widgets::clipped(ui, "metamers", body);
    let Some(camera) = context.view.camera(&context.scene) else {
        child.weak("Add a camera.");
        return;
    };
    let confusion = context.view.saved.metrics.confusion.confusion();
    let query = context.scene.metamers_query(camera.kind, &camera.name, confusion).map_err(|error| error.to_string());
    let found = match query.and_then(|query| context.later.ask(PANE.kind, vec![query]).current()) {
        Ok(found) => found,
        Err(why) => {
            child.label(RichText::new(why).color(context.theme.error));
            return;
        }
    };
    let Some(found) = found else {
        child.weak("Searching…");
        return;
    };
    let found = match found.as_ref() {
        Ok(found) => found,
        Err(why) => {
            child.weak(format!("{}: {why}.", camera.name));
            return;
        }
    };
    let (count, noun) = (found.rows.len(), if found.rows.len() == 1 { "pair" } else { "pairs" });
    let words = format!("{}: {count} {noun} of {} reflectances", camera.name, found.searched);
    widgets::note(&mut child, words);
    let chosen = context.states.of::<ClickedPair>().0.filter(|row| *row < found.rows.len());
    if let Some(row) = chosen {
        buttons(&mut child, &found.rows[row], context);
    }
    let top = child.min_rect().bottom() + UNIT;
    let place = body.with_min_y(top.min(body.bottom()));
    pairs(ui, place, &camera, found, context);
}

fn switches(ui: &mut Ui, context: &mut PaneContext<'_>) {
    if let Some(confusion) = widgets::choice(ui, context.view.saved.metrics.confusion) {
        context.view.saved.metrics.confusion = confusion;
        context.states.of::<ClickedPair>().0 = None;
        ui.ctx().request_repaint();
    }
}

fn pairs(ui: &mut Ui, place: Rect, camera: &SensorId, found: &FoundMetamers, context: &mut PaneContext<'_>) {
    let hints = [
        "",
        "The pair as the reference renders it",
        "The pair as the camera renders it",
        "Difference to the reference observer.",
        "",
        "Largest difference of a balanced camera channel, each through the CIE lightness function (0 to 100).",
    ];
    let heads = ["reflectance", "reference", "camera", "ΔE*00", "its metamer", "ΔL*"].into_iter().zip(hints);
    let mut table = Table::new(heads.map(|(head, hint)| Column {
        hint: hint.to_owned(),
        decimals: Some(2),
        largest_first: true,
        ..Column::from(head)
    }));
    for row in &found.rows {
        let [a, b] =
            row.names.each_ref().map(|[set, name]| if set == name { name.clone() } else { format!("{name} ({set})") });
        let [reference, camera] = [row.pair.observer_difference, row.pair.camera_difference];
        let [seen, recorded] = row.colors.map(|pair| {
            let named = pair.map(|[r, g, b]| format!("#{r:02x}{g:02x}{b:02x}")).join(" ");
            Cell::from(named).with(|note| note.swatch = Some(pair))
        });
        table.push([Cell::from(a), seen, recorded, Cell::from(reference), Cell::from(b), Cell::from(camera)]);
    }
    let item = |row: usize| {
        let source = Some(camera.clone());
        Some(PlotItem::Patch { source, patch: found.rows.get(row)?.names[0][1].clone() })
    };
    let shown = DataTable::new(PANE.kind, "Metamers", &table).with_items(&item);
    if let Some(row) = shown.show(ui, place, context).clicked {
        context.states.of::<ClickedPair>().0 = Some(row);
        let patch = |name: &str| PlotItem::Patch { source: Some(camera.clone()), patch: name.to_owned() };
        context.view.pinned = found.rows[row].names.iter().map(|[_, name]| patch(name)).collect();
    }
}

fn buttons(ui: &mut Ui, row: &MetamerRow, context: &mut PaneContext<'_>) {
    ui.horizontal_wrapped(|ui| {
        for ([set, patch], kind) in row.names.iter().zip(row.kinds) {
            if kind == SetKind::Material {
                let hint = "Render the mesh with this reflectance";
                if ui.button(format!("{set} on the mesh")).on_hover_text(hint).clicked() {
                    let to = RenderSettings { material: set.clone(), ..context.scene.document.render.clone() };
                    context.push(Action::Render(RenderAction::Set { what: "Material", to: Box::new(to) }));
                }
            } else if context.scene.document.chart != *set || context.scene.document.subset != Subset::All {
                let hint = "Show all patches of this chart in all panes";
                if ui.button(format!("Show {patch}")).on_hover_text(hint).clicked() {
                    context.push(Action::Scene(SceneAction::SetChart(set.clone())));
                    context.push(Action::Scene(SceneAction::SetSubset(Subset::All)));
                }
            }
        }
    });
}
