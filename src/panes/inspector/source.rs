//! All about a camera, an observer, the light, or another set of the library.

use chromascope_core::spectral::{Primaries, Quantity};
use chromascope_figure::InkRole;
use egui::{Rect, Sense, Ui, Vec2};

use super::{
    assumptions, buttons, copy_text, failure, head, held_words, label_of, measured_words, no_difference, reference_id,
    show_assumptions, source_of,
};
use crate::catalog::{Entry, Place};
use crate::command::Command;
use crate::document::{Diagram, FIT_TARGET, Light, SetKind};
use crate::figures::data_set;
use crate::format::{fixed, signed};
use crate::paint;
use crate::panes::context::PaneContext;
use crate::panes::widgets;
use crate::panes::widgets::facts::{self, Fact, range_words};
use crate::plot_item::SensorId;
use crate::scene::Scene;
use crate::theme::UNIT;
use crate::view::import::ImportItem;

pub(super) fn show(ui: &mut Ui, id: &SensorId, context: &mut PaneContext<'_>) {
    let (scene, theme) = (context.scene, context.theme);
    head(ui, id, context);
    let entry = match scene.entry(id.kind, &id.name) {
        Ok(entry) => entry,
        Err(error) => return failure(ui, &theme, &error.to_string()),
    };
    let also = entry.also.as_ref().map_or_else(String::new, |also| format!(", {also}"));
    widgets::note(ui, format!("{}: {}{also}", id.kind.label(), entry.name));
    let role = source_of(&scene, id).map_or(InkRole::Observer, |source| source.role);
    curves(ui, &entry, role, context);
    let mut measured = measures(&scene, id);
    match scene.sensor(id.kind, &id.name) {
        Ok(sensor) => {
            measured.push(("Measured", measured_words(&sensor)));
            let words = facts::resampling_words(&sensor.curves()[0], sensor.primaries().quantity());
            measured.push(("Resampled", words));
            measured.extend(facts::channel_ratio(&scene, &entry));
        }
        Err(error) => failure(ui, &theme, &error.to_string()),
    }
    if let Err(error) = scene.patch_colors(id.kind, &id.name) {
        failure(ui, &theme, &error.to_string());
    }
    facts::show(ui, &theme, &measured);
    ui.add_space(UNIT);
    facts::show(ui, &theme, &facts::of(&scene, &entry, false));
    if buttons(ui, context) {
        let all = measured.iter().map(|(caption, words)| format!("{caption}\t{words}\n"));
        copy_text(ui, all.collect(), context);
    }
    let label = label_of(&scene, id);
    show_assumptions(ui, assumptions(&scene, id, &label));
    if matches!(entry.place, Place::Own(_))
        && ui.button("Reading…").on_hover_text("Check and correct how its file was read").clicked()
    {
        context.push(Command::ShowImport(ImportItem::Set(id.name.clone()), None));
    }
}

fn measures(scene: &Scene<'_>, id: &SensorId) -> Vec<Fact> {
    let mut facts: Vec<Fact> = Vec::new();
    let reference = reference_id(scene);
    let measure = scene.document.difference;
    if reference != *id
        && let Ok(differences) = scene.differences(id.kind, &id.name)
    {
        let known: Vec<f64> = differences.iter().filter_map(|d| d.ok()).collect();
        if let Some(Err(reason)) = differences.first() {
            facts.push(("Difference", no_difference(*reason)));
        } else if !known.is_empty() {
            let mean = known.iter().sum::<f64>() / known.len() as f64;
            let words = format!(
                "{} {}, mean of {} patches",
                scene.difference_name(),
                fixed(mean, measure.decimals),
                known.len()
            );
            facts.push(("Difference", words));
        }
    }
    let Ok(locus) = scene.locus(id.kind, &id.name) else { return facts };
    let words = format!("{} in xy, 1000–20000 K (the paper's “dynamic range”)", fixed(locus.length_xy(), 3));
    facts.push(("Locus length", words));
    if reference != *id
        && let Ok(Ok(())) = scene.comparable(id.kind, &id.name)
        && let Some(nearest) = scene.nearest_to_reference(id.kind, &id.name, Diagram::Xy)
    {
        let balance = scene.locus_balance();
        let (kelvin, distance) = (fixed(nearest.kelvin, 0), fixed(nearest.distance, 4));
        let words = format!("at {kelvin} K, Δxy {distance} (signals normalized to {balance}, which determines it)");
        facts.push(("Nearest to the reference", words));
    }
    facts
}

fn temperature_words(scene: &Scene<'_>) -> String {
    match scene.light_temperature() {
        Ok(Ok(cct)) => format!("CCT {} K, Duv {} for {FIT_TARGET}", fixed(cct.temperature.get(), 0), signed(cct.duv)),
        Ok(Err(error)) => format!("no CCT: {error}"),
        Err(error) => error.to_string(),
    }
}

pub(super) fn light(ui: &mut Ui, context: &mut PaneContext<'_>) {
    let (scene, theme) = (context.scene, context.theme);
    ui.strong(format!("Light {}", scene.light_name()));
    let light = match scene.light() {
        Ok(light) => light,
        Err(error) => return failure(ui, &theme, &error.to_string()),
    };
    let mut measured: Vec<Fact> = vec![
        ("Range", range_words(light.measured.range_nm())),
        ("Resampled", facts::resampling_words(&light.measured, Quantity::Light)),
    ];
    if let Ok(observer) = scene.sensor(SetKind::Observer, FIT_TARGET)
        && observer.primaries() == Primaries::Xyz
    {
        let [x, y, z] = observer.integrate(light.grid.values());
        let xyz = chromascope_core::colorimetry::Xyz::new(x, y, z);
        if let Some((xy, uv)) = xyz.chromaticity().zip(xyz.uv_prime()) {
            let words = format!(
                "x {} y {}, u′ {} v′ {} for {FIT_TARGET}",
                fixed(xy.x, 4),
                fixed(xy.y, 4),
                fixed(uv.u, 4),
                fixed(uv.v, 4)
            );
            measured.push(("Chromaticity", words));
        }
    }
    measured.push(("Temperature", temperature_words(&scene)));
    for name in &scene.document.filters {
        measured.push(("Filter", name.clone()));
    }
    match &scene.document.light {
        Light::Set(name) => {
            if let Ok(entry) = scene.entry(SetKind::Illuminant, name) {
                if let Some(also) = &entry.also {
                    ui.label(also);
                }
                measured.extend(facts::of(&scene, &entry, false));
                if entry.is_own() && ui.button("Reading…").clicked() {
                    context.push(Command::ShowImport(ImportItem::Set(name.clone()), None));
                }
            }
        }
        Light::BlackBody => measured.push(("Source", "Planck's law, Eq 14, with the paper's constants".to_owned())),
        Light::Daylight => measured.push(("Source", "CIE 15: daylight from its three components".to_owned())),
    }
    facts::show(ui, &theme, &measured);
    if buttons(ui, context) {
        let rows = light.measured.wavelengths_nm().iter().zip(light.measured.values());
        let lines: Vec<String> = rows.map(|(nm, value)| format!("{nm}\t{value}")).collect();
        copy_text(ui, format!("wavelength_nm\tpower\n{}\n", lines.join("\n")), context);
    }
    let words = held_words(&format!("Light {}", scene.light_name()), light.grid.assumed());
    show_assumptions(ui, words.into_iter().collect());
}

const CURVES: f32 = 104.0;

pub(super) fn set(ui: &mut Ui, kind: SetKind, name: &str, context: &mut PaneContext<'_>) {
    let (scene, theme) = (context.scene, context.theme);
    let entry = match scene.entry(kind, name) {
        Ok(entry) => entry,
        Err(error) => return failure(ui, &theme, &error.to_string()),
    };
    ui.strong(&entry.name);
    let also = entry.also.as_ref().map_or_else(String::new, |also| format!(", {also}"));
    widgets::note(ui, format!("{}{also}", kind.label()));
    curves(ui, &entry, InkRole::Text, context);
    let known = facts::of(&scene, &entry, true);
    facts::show(ui, &theme, &known);
    if buttons(ui, context) {
        let lines: Vec<String> = known.iter().map(|(caption, words)| format!("{caption}\t{words}\n")).collect();
        copy_text(ui, lines.concat(), context);
    }
}

fn curves(ui: &mut Ui, entry: &Entry, role: InkRole, context: &PaneContext<'_>) {
    let size = Vec2::new(ui.available_width(), CURVES);
    let panel = match data_set::panel(context.scene.results, entry, role, [f64::from(size.x), f64::from(size.y)]) {
        Ok(Some(panel)) => panel,
        Ok(None) => return,
        Err(error) => return failure(ui, &context.theme, &error.to_string()),
    };
    let (rect, response) = ui.allocate_exact_size(size, Sense::hover());
    widgets::labeled(&response, egui::Role::Image, format!("Curves of {}", entry.name));
    paint::still(ui.painter(), &panel, &context.theme, Rect::from_min_size(rect.min, size));
    ui.add_space(UNIT);
}
