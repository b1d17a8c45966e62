//! Patches and blackbodies as columns of one table.

use chromascope_core::query::{DifferenceError, LocusPoint, PatchColor, Temperatures};
use chromascope_core::units::Kelvin;
use egui::Ui;

use super::numbers::{self, Point};
use super::{buttons, copy_text, reference_id};
use crate::panes::context::PaneContext;
use crate::plot_item::{PlotItem, SensorId};
use crate::scene::{Scene, SceneError};

/// The table of a page, with the pinned items as columns A, B, …, and the page's buttons.
pub(super) fn points_table(ui: &mut Ui, mut points: Vec<Point>, page: &PlotItem, context: &mut PaneContext<'_>) {
    let scene = context.scene;
    points.extend(points_of(&scene, &context.view.pinned, Some(page)));
    let (heads, rows) = (numbers::heads(&points), numbers::rows_of(&scene, &points));
    numbers::show(ui, "points", &heads, &rows, context);
    if buttons(ui, context) {
        copy_text(ui, numbers::to_tsv(&heads, &rows), context);
    }
}

/// Columns of pinned items, lettered; the page's own is omitted.
pub(super) fn points_of(scene: &Scene<'_>, pinned: &[PlotItem], page: Option<&PlotItem>) -> Vec<Point> {
    let columns = pinned.iter().enumerate().filter(|(_, item)| Some(*item) != page);
    columns.filter_map(|(index, item)| Some(point_of(scene, item)?.with_head(letter(index)))).collect()
}

/// Color of an item with its difference from the reference; none of items that have no color.
pub(super) fn point_of(scene: &Scene<'_>, item: &PlotItem) -> Option<Point> {
    match item {
        PlotItem::Patch { source: Some(id), patch } => {
            let difference = difference_of(scene, id, patch).and_then(Result::ok);
            let difference = difference.filter(|_| *id != reference_id(scene));
            Some(Point::of_patch("", color_of(scene, id, patch).ok().flatten()).with_difference(difference))
        }
        PlotItem::Radiator { source, kelvin } => {
            Some(Point::of_blackbody("", blackbody_of(scene, source, *kelvin).ok().flatten()))
        }
        PlotItem::Patch { source: None, .. } | PlotItem::Sensor(_) | PlotItem::Light | PlotItem::DataSet { .. } => None,
    }
}

pub(super) fn letter(index: usize) -> String {
    let letters = 'A'..='Z';
    letters.clone().nth(index).map_or_else(|| (index + 1).to_string(), String::from)
}

pub(super) fn index_of(scene: &Scene<'_>, patch: &str) -> Option<usize> {
    scene.patches().ok()?.patches().iter().position(|p| p.name == patch)
}

pub(super) fn color_of(scene: &Scene<'_>, id: &SensorId, patch: &str) -> Result<Option<PatchColor>, SceneError> {
    let colors = scene.patch_colors(id.kind, &id.name)?;
    Ok(index_of(scene, patch).and_then(|index| colors.get(index).copied()))
}

/// Difference of a patch through a sensor from the reference's, or why there is none.
pub(super) fn difference_of(scene: &Scene<'_>, id: &SensorId, patch: &str) -> Option<Result<f64, DifferenceError>> {
    scene.differences(id.kind, &id.name).ok()?.get(index_of(scene, patch)?).copied()
}

pub(super) fn blackbody_of(scene: &Scene<'_>, id: &SensorId, kelvin: f64) -> Result<Option<LocusPoint>, SceneError> {
    let temperatures = Temperatures::List(vec![Kelvin::new(kelvin)?]);
    Ok(scene.locus_at(id.kind, &id.name, temperatures)?.points.first().copied())
}
