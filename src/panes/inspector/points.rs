//! Patches and blackbodies as columns of one table; the pinned items, as such columns; the pinned pixel of the rendered pictures.

use chromascope_core::query::{DifferenceError, LocusPoint, PatchColor, Temperatures};
use chromascope_core::units::Kelvin;
use egui::{RichText, Ui};

use super::numbers::{self, Point};
use super::{buttons, copy_text, label_of, note, reference_id};
use crate::figures::chromaticity::id;
use crate::figures::render::headline::{Detail, Measure};
use crate::figures::render::{self, NO_VALUE, facts, pixel_of};
use crate::format::fixed;
use crate::panes::context::PaneContext;
use crate::panes::widgets::lines::key_and_label;
use crate::panes::widgets::table::show_pairs;
use crate::panes::widgets::{Icon, icon_button, pixel_spectrum};
use crate::plot_item::{PlotItem, SensorId};
use crate::render_service::pixel::PixelShows;
use crate::scene::{Scene, SceneError};
use crate::theme::UNIT;
use crate::view::render::PixelPlace;
use crate::workspaces::PaneKind;

/// The table of a page, with the pinned items as columns A, B, …, and the page's buttons.
pub(super) fn points_table(ui: &mut Ui, mut points: Vec<Point>, page: &PlotItem, context: &mut PaneContext<'_>) {
    let scene = context.scene;
    points.extend(points_of(&scene, &context.view.pinned, Some(page)));
    numbers::show(ui, "points", &points, context);
    if buttons(ui, context) {
        copy_text(ui, numbers::to_tsv(&scene, &points), context);
    }
}

/// Columns of pinned items, lettered; the page's own is omitted.
fn points_of(scene: &Scene<'_>, pinned: &[PlotItem], page: Option<&PlotItem>) -> Vec<Point> {
    let columns = pinned.iter().enumerate().filter(|(_, item)| Some(*item) != page);
    columns.filter_map(|(index, item)| Some(point_of(scene, item)?.with_head(letter(index)))).collect()
}

/// Color of an item with its difference from the reference; none of items that have no color.
fn point_of(scene: &Scene<'_>, item: &PlotItem) -> Option<Point> {
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

fn letter(index: usize) -> String {
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

/// One point of a sensor's locus.
pub(super) fn blackbody_of(scene: &Scene<'_>, id: &SensorId, kelvin: f64) -> Result<Option<LocusPoint>, SceneError> {
    let temperatures = Temperatures::List(vec![Kelvin::new(kelvin)?]);
    Ok(scene.locus_at(id.kind, &id.name, temperatures)?.points.first().copied())
}

pub(super) fn show_pinned(ui: &mut Ui, context: &mut PaneContext<'_>) {
    if context.view.pinned.is_empty() {
        return;
    }
    let theme = context.theme;
    ui.separator();
    ui.label(RichText::new("Pinned").strong());
    let mut unpin = None;
    for (index, thing) in context.view.pinned.clone().iter().enumerate() {
        ui.horizontal(|ui| {
            if icon_button(ui, Icon::Close, &format!("Unpin {}", letter(index))).clicked() {
                unpin = Some(index);
            }
            ui.label(RichText::new(letter(index)).strong());
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
            numbers::show(ui, "pinned", &points, context);
        }
    }
    if pinned.iter().any(|thing| point_of(&context.scene, thing).is_none()) {
        note(ui, &theme, "Only points and swatches have values to compare.");
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
    if all.all(|other| other == first) { Some(point_of(scene, &first)?.with_head("reference")) } else { None }
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

/// Pinned pixel, if pictures are visible.
pub(super) fn pinned_pixel<'a>(context: &'a PaneContext<'_>) -> Option<&'a PixelPlace> {
    let (saved, render) = (&context.view.saved, &context.view.render);
    render.pinned.as_ref().filter(|_| saved.layout.shows(saved.workspace, PaneKind::RENDER))
}

pub(super) fn show_pixel(ui: &mut Ui, context: &PaneContext<'_>) {
    let Some((pinned, shot)) = pinned_pixel(context).zip(context.render_service.frame()) else { return };
    ui.add_space(UNIT);
    ui.label(RichText::new("Pinned pixel").strong());
    let measure = Measure::of_frame(shot);
    if let Some(reading) = pixel_of(&context.scene, shot, pinned) {
        pixel_spectrum::show(ui, "spectrum in inspector", shot, reading.at, context);
    }
    for source in shot.sources.iter() {
        let place = PixelPlace { source: id(source), ..pinned.clone() };
        let Some(reading) = pixel_of(&context.scene, shot, &place) else { continue };
        key_and_label(ui, source, &context.theme);
        let made = shot.made().zip(render::index_of(shot, &place.source));
        if let Some(difference) = made.and_then(|(made, at)| made.differences.get(at)?.as_ref()) {
            note(ui, &context.theme, measure.words(difference, Detail::Quantiles));
        }
        match reading.shows {
            PixelShows::Nothing => note(ui, &context.theme, "Beside the mesh."),
            PixelShows::NoValue => note(ui, &context.theme, NO_VALUE),
            PixelShows::Unlit => note(ui, &context.theme, "No light reaches it."),
            PixelShows::Lit(lit) => {
                let id = format!("pinned pixel {}", source.name);
                show_pairs(ui, PaneKind::INSPECTOR, &id, &facts(&lit, measure), context);
            }
        }
    }
}
