//! One camera on one page, as it is exported.

use chromascope_figure::{Figure, InkRole, Shape, Stroke};
use egui::{Id, Rect, ScrollArea, Ui, Vec2};

use super::context::{Pane, PaneContext};
use crate::figures::report_card;
use crate::format::sentence;
use crate::paint::{self, PlotOptions};
use crate::panes::widgets;
use crate::plot_item::{PlotItem, SensorId};
use crate::scene::metrics::{CameraFigures, unloaded};
use crate::theme::UNIT;
use crate::workspaces::PaneKind;

const NARROWEST: f32 = 300.0;

const BARS: &str = "patches";

pub const PANE: Pane = Pane::new(PaneKind::REPORT_CARD, "Report card", show)
    .tab("Overview")
    .figure(&report_card::KIND)
    .under_conditions()
    .table();

fn show(ui: &mut Ui, rect: Rect, context: &mut PaneContext<'_>) {
    let body = widgets::body(ui, &PANE, rect, context, |ui, context| {
        let width = (ui.available_width() - UNIT).max(140.0);
        widgets::sets::camera(ui, width, context);
    });
    // Less what the scroll bar keeps, and half a number at the end of an axis.
    let width = f64::from((body.width() - 6.0 * UNIT).max(NARROWEST));
    let Some(camera) = context.view.camera(&context.scene) else {
        widgets::say(ui, body, "Add a camera.", context.theme.weak);
        return;
    };
    let mut page = match made(&camera, context) {
        Ok(Some(metrics)) => report_card::page(&context.scene, &camera, &metrics, width),
        Ok(None) => return,
        Err(why) => {
            widgets::say(ui, body, sentence(&why), context.theme.error);
            return;
        }
    };
    if widgets::numbers(ui, &PANE, body, context, |_| Some(page.table.clone())) {
        return;
    }
    let moved = widgets::walk::along(ui, PANE.kind, context, |context| {
        vec![context.scene.patches().map_or_else(|_| Vec::new(), |set| widgets::walk::patches(&set, Some(&camera)))]
    });
    let marked = [&context.view.hovered, &context.view.selected].map(|item| match item {
        Some(PlotItem::Patch { source: Some(source), patch }) if *source == camera => Some(patch.clone()),
        _ => None,
    });
    for mark in page.panels.iter_mut().filter(|panel| panel.name == BARS).flat_map(|panel| &mut panel.marks) {
        if matches!(mark.shape, Shape::Rect { .. }) && marked.iter().flatten().any(|patch| *patch == mark.name) {
            mark.stroke = Some(Stroke::solid(InkRole::Text, 2.0));
        }
    }
    let body = body.expand2(Vec2::new(2.0 * UNIT, 0.0));
    widgets::scroll(ui, (PANE.kind, "report card"), body, context, |ui, context| {
        ScrollArea::horizontal().auto_shrink([false, true]).show(ui, |ui| draw(ui, &page, moved, context));
    });
}

/// Figures of merit of the camera, their uncertainties a little later; the last ones while those of other conditions are made.
fn made(camera: &SensorId, context: &PaneContext<'_>) -> Result<Option<CameraFigures>, String> {
    let query = context.scene.card_query(camera).map_err(|error| error.to_string())?;
    let shown = context.later.ask(PANE.kind, vec![query.clone(), query.with_uncertainties()]).last()?;
    let shown = shown.filter(|shown| shown.job.is_of_same_camera(&query));
    shown.map(|shown| (*shown.answer).clone().map_err(|error| unloaded(&camera.name, error))).transpose()
}

fn draw(ui: &mut Ui, page: &Figure, follow: bool, context: &PaneContext<'_>) {
    let size = Vec2::new(page.size[0] as f32, page.size[1] as f32);
    let (area, _) = ui.allocate_exact_size(size, egui::Sense::hover());
    for panel in &page.panels {
        let [min, max] = [panel.area.min, panel.area.max].map(|[x, y]| area.min + Vec2::new(x as f32, y as f32));
        let options = PlotOptions { zoomable: false, ..PlotOptions::default() };
        let id = Id::unique(("report card", &panel.name));
        let shown = paint::plot(ui, id, panel, &context.theme, Rect::from_min_max(min, max), options);
        let said = format!("{}: {}", page.title, panel.name);
        widgets::labeled(&shown.response, egui::Role::Canvas, &said);
        if follow && panel.name == BARS {
            shown.response.scroll_to_me(None);
        }
    }
}
