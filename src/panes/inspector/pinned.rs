//! Pinned items, side by side.

use chromascope_core::query::PatchColor;
use egui::{RichText, ScrollArea, Ui};

use super::{difference_words, label_of, note, numbers, patch, radiator, reference_id};
use crate::format::fixed;
use crate::panes::context::PaneContext;
use crate::panes::widgets::{Icon, icon_button};
use crate::plot_item::PlotItem;
use crate::scene::Scene;

/// The letter of a pinned item.
fn letter(index: usize) -> String {
    let letters = 'A'..='Z';
    letters.clone().nth(index).map_or_else(|| (index + 1).to_string(), String::from)
}

/// Shows the pinned items and their numbers.
pub(super) fn show(ui: &mut Ui, context: &mut PaneContext<'_>) {
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
    let scene = context.scene;
    let things = context.view.pinned.clone();
    ScrollArea::horizontal().id_salt("pinned").auto_shrink([false, true]).show(ui, |ui| {
        patches(ui, &scene, &things, context);
        radiators(ui, &scene, &things, context);
    });
    if things
        .iter()
        .any(|thing| matches!(thing, PlotItem::Sensor(_) | PlotItem::Light | PlotItem::Patch { source: None, .. }))
    {
        note(ui, &theme, "Only points and swatches have values to compare.");
    }
}

fn name(scene: &Scene<'_>, thing: &PlotItem) -> String {
    match thing {
        PlotItem::Light => format!("light {}", scene.light_name()),
        PlotItem::Sensor(id) => label_of(scene, id),
        PlotItem::Patch { source: None, patch } => format!("patch {patch}"),
        PlotItem::Patch { source: Some(id), patch } => format!("{}, {patch}", label_of(scene, id)),
        PlotItem::Radiator { source, kelvin } => format!("{}, {} K", label_of(scene, source), fixed(*kelvin, 0)),
    }
}

/// Pinned patches; the reference is first where all are the same patch.
fn patches(ui: &mut Ui, scene: &Scene<'_>, things: &[PlotItem], context: &PaneContext<'_>) {
    let mut heads: Vec<String> = Vec::new();
    let mut colors: Vec<Option<PatchColor>> = Vec::new();
    let mut differences: Vec<String> = Vec::new();
    let mut names: Vec<&str> = Vec::new();
    let measure = scene.document.difference;
    for (index, thing) in things.iter().enumerate() {
        let PlotItem::Patch { source: Some(id), patch } = thing else { continue };
        heads.push(letter(index));
        colors.push(patch::color_of(scene, id, patch).ok().flatten());
        names.push(patch);
        let difference = patch::index_of(scene, patch)
            .and_then(|place| scene.differences(id.kind, &id.name).ok()?.get(place).copied())
            .and_then(Result::ok);
        differences.push(match difference {
            Some(value) => format!("{} {}", letter(index), difference_words(measure, value)),
            None => format!("{} –", letter(index)),
        });
    }
    let Some(first) = names.first() else { return };
    if names.iter().all(|name| name == first) {
        heads.insert(0, "reference".to_owned());
        colors.insert(0, patch::color_of(scene, &reference_id(scene), first).ok().flatten());
    }
    note(
        ui,
        &context.theme,
        format!("{} from the reference: {}", context.scene.difference_name(), differences.join(", ")),
    );
    numbers::show(ui, "pinned patches", &heads, &numbers::of_patches(scene, &colors), context);
}

/// Pinned blackbodies; the reference is first where all have the same temperature.
fn radiators(ui: &mut Ui, scene: &Scene<'_>, things: &[PlotItem], context: &PaneContext<'_>) {
    let mut heads = Vec::new();
    let mut points = Vec::new();
    let mut temperatures = Vec::new();
    for (index, thing) in things.iter().enumerate() {
        let PlotItem::Radiator { source, kelvin } = thing else { continue };
        heads.push(letter(index));
        points.push(radiator::point_of(scene, source, *kelvin).ok().flatten());
        temperatures.push(*kelvin);
    }
    let Some(&first) = temperatures.first() else { return };
    if temperatures.iter().all(|kelvin| *kelvin == first) {
        heads.insert(0, "reference".to_owned());
        points.insert(0, radiator::point_of(scene, &reference_id(scene), first).ok().flatten());
    }
    numbers::show(ui, "pinned blackbodies", &heads, &radiator::rows_of(scene, &points), context);
}
