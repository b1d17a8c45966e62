//! Pinned items, as columns of one table, and the pinned pixel of the rendered pictures, through every sensor.

use egui::Ui;

use super::numbers::{self, Point, letter, point_of, points_of};
use super::{label_of, reference_id};
use crate::format::fixed;
use crate::panes::context::PaneContext;
use crate::panes::widgets::{self, Icon, icon_button};
use crate::plot_item::PlotItem;
use crate::scene::Scene;
use crate::view::PixelPlace;
use crate::workspaces::PaneKind;

pub(super) fn show(ui: &mut Ui, context: &mut PaneContext<'_>) {
    if context.view.pinned.is_empty() {
        return;
    }
    ui.separator();
    ui.strong("Pinned");
    let mut unpin = None;
    for (index, thing) in context.view.pinned.clone().iter().enumerate() {
        ui.horizontal(|ui| {
            if icon_button(ui, Icon::Close, &format!("Unpin {}", letter(index))).clicked() {
                unpin = Some(index);
            }
            ui.strong(letter(index));
            ui.add(egui::Label::new(name(&context.scene, thing)).truncate());
        });
    }
    if let Some(index) = unpin {
        context.view.pinned.remove(index);
    }
    let pinned = context.view.pinned.clone();
    if !has_table(context) {
        let scene = context.scene;
        let mut points: Vec<Point> = reference_of(&scene, &pinned).into_iter().collect();
        points.extend(points_of(&scene, &pinned, None));
        if !points.is_empty() {
            numbers::show(ui, "pinned", numbers::table(&scene, &points), context);
        }
    }
    if pinned.iter().any(|thing| point_of(&context.scene, thing).is_none()) {
        widgets::note(ui, "Only points and swatches have values to compare.");
    }
}

/// True if the page above has a table, of which the pinned items are columns.
fn has_table(context: &PaneContext<'_>) -> bool {
    let shown = context.view.selected.as_ref().or(context.view.hovered.as_ref());
    matches!(shown, Some(PlotItem::Patch { source: Some(_), .. } | PlotItem::Radiator { .. }))
}

/// The reference's column, where all items are of one patch, or of one temperature.
fn reference_of(scene: &Scene<'_>, pinned: &[PlotItem]) -> Option<Point> {
    let reference = reference_id(scene);
    let seen = |item: &PlotItem| match item {
        PlotItem::Patch { source: Some(_), patch } => {
            Some(PlotItem::Patch { source: Some(reference.clone()), patch: patch.clone() })
        }
        PlotItem::Radiator { kelvin, .. } => Some(PlotItem::Radiator { source: reference.clone(), kelvin: *kelvin }),
        _ => None,
    };
    let mut all = pinned.iter().filter_map(seen);
    let first = all.next()?;
    let head = "reference".to_owned();
    if all.all(|other| other == first) { Some(Point { head, ..point_of(scene, &first)? }) } else { None }
}

fn name(scene: &Scene<'_>, thing: &PlotItem) -> String {
    match thing {
        PlotItem::Light => format!("light {}", scene.light_name()),
        PlotItem::DataSet { name, .. } => name.clone(),
        PlotItem::Sensor(id) => label_of(scene, id),
        PlotItem::Patch { source: None, patch } => format!("patch {patch}"),
        PlotItem::Patch { source: Some(id), patch } => format!("{}, {patch}", label_of(scene, id)),
        PlotItem::Radiator { source, kelvin } => format!("{}, {} K", label_of(scene, source), fixed(*kelvin, 0)),
    }
}

pub(super) fn pinned_pixel<'a>(context: &'a PaneContext<'_>) -> Option<&'a PixelPlace> {
    let render = &context.view.render;
    render.pinned.as_ref().filter(|_| context.view.is_shown(PaneKind::RENDER))
}
