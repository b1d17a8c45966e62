//! Introduction for newcomers, or the selected or hovered item.

mod numbers;
mod patch;
mod pinned;
mod pixel;
mod source;
mod welcome;

use chromascope_core::query::DifferenceError;
use chromascope_core::spectral::{Assumed, Evidence, Sensor};
use egui::{Rect, RichText, Ui};

use super::context::{Pane, PaneContext};
use crate::command::Command;
use crate::document::SetKind;
use crate::figures::chromaticity::label as label_of;
use crate::format::number;
use crate::panes::widgets;
use crate::panes::widgets::facts::range_words;
use crate::plot_item::{PlotItem, SensorId};
use crate::scene::{ComparedSensor, Scene};
use crate::theme::{Theme, UNIT};
use crate::workspaces::PaneKind;

pub const PANE: Pane = Pane::new(PaneKind::INSPECTOR, "Inspector", show);

fn show(ui: &mut Ui, rect: Rect, context: &mut PaneContext<'_>) {
    widgets::scrolling_pane(ui, &PANE, rect, context, |ui, context| {
        ui.spacing_mut().item_spacing.y = 0.5 * UNIT;
        content(ui, context);
        ui.add_space(2.0 * UNIT);
    });
}

fn content(ui: &mut Ui, context: &mut PaneContext<'_>) {
    match context.view.selected.clone().or_else(|| context.view.hovered.clone()) {
        None if pinned::pinned_pixel(context).is_some() || !context.view.pinned.is_empty() => {}
        None => welcome::show(ui, context),
        Some(PlotItem::Patch { source: Some(id), patch }) => patch::one(ui, &id, &patch, context),
        Some(PlotItem::Patch { source: None, patch }) => patch::across(ui, &patch, context),
        Some(PlotItem::Radiator { source, kelvin }) => patch::blackbody(ui, &source, kelvin, context),
        Some(PlotItem::Sensor(id)) => source::show(ui, &id, context),
        Some(PlotItem::Light) => source::light(ui, context),
        Some(PlotItem::DataSet { kind, name }) => source::set(ui, kind, &name, context),
    }
    pixel::show(ui, context);
    pinned::show(ui, context);
}

fn source_of(scene: &Scene<'_>, id: &SensorId) -> Option<ComparedSensor> {
    scene.sources().into_iter().find(|source| source.kind == id.kind && source.name == id.name)
}

fn reference_id(scene: &Scene<'_>) -> SensorId {
    SensorId { kind: SetKind::Observer, name: scene.document.reference.clone() }
}

fn head(ui: &mut Ui, id: &SensorId, context: &PaneContext<'_>) {
    match source_of(&context.scene, id) {
        Some(source) => {
            widgets::lines::key_and_label(ui, &source, &context.theme);
        }
        None => {
            ui.label(&id.name);
        }
    }
}

fn failure(ui: &mut Ui, theme: &Theme, words: &str) {
    ui.label(RichText::new(words).color(theme.error));
}

fn no_difference(reason: DifferenceError) -> String {
    format!("No difference: {reason}.")
}

/// Buttons of a selected item. Returns whether its numbers are to be copied.
fn buttons(ui: &mut Ui, context: &mut PaneContext<'_>) -> bool {
    let Some(selected) = context.view.selected.clone() else { return false };
    let mut copy = false;
    ui.add_space(UNIT);
    ui.horizontal_wrapped(|ui| {
        let pinned = context.view.pinned.contains(&selected);
        let words = if pinned { "Unpin" } else { "Pin" };
        context.button(ui, words, "Pin for comparison (P)", Command::Pin);
        copy = ui.button("Copy numbers").on_hover_text("For a spreadsheet, in full precision").clicked();
        if !context.view.is_shown(PaneKind::SPECTRA) && ui.button("Show in Spectra").clicked() {
            context.push(Command::GoTo(PaneKind::SPECTRA));
        }
    });
    copy
}

fn copy_text(ui: &Ui, text: String, context: &mut PaneContext<'_>) {
    ui.ctx().copy_text(text);
    context.view.say("Inspector: numbers copied.");
}

fn held_words(what: &str, assumed: Assumed) -> Option<String> {
    match (assumed.below_nm, assumed.above_nm) {
        (None, None) => None,
        (Some(first), None) => Some(format!("{what} begins at {} nm; its first value is held below.", number(first))),
        (None, Some(last)) => Some(format!("{what} ends at {} nm; its last value is held beyond.", number(last))),
        (Some(first), Some(last)) => {
            let range = range_words([first, last]);
            Some(format!("{what} covers {range}; its end values are held outside."))
        }
    }
}

/// The wavelengths that a sensor was measured over, once if the channels agree.
fn measured_words(sensor: &Sensor) -> String {
    let ranges = sensor.curves().each_ref().map(chromascope_core::spectral::SpectralDistribution::range_nm);
    if ranges[1] == ranges[0] && ranges[2] == ranges[0] {
        return range_words(ranges[0]);
    }
    let names = sensor.primaries().channels();
    let parts = names.iter().zip(ranges).map(|(name, range)| format!("{name} {}", range_words(range)));
    parts.collect::<Vec<_>>().join(", ")
}

fn assumptions(scene: &Scene<'_>, id: &SensorId, label: &str) -> Vec<String> {
    let mut words = Vec::new();
    if let Ok(sensor) = scene.sensor(id.kind, &id.name) {
        words.push(format!("{label}: measured {}; counts as zero outside.", measured_words(&sensor)));
        let header = scene.entry(id.kind, &id.name).ok().and_then(|entry| entry.header);
        match header.map(|header| header.response_evidence()) {
            Some(Evidence::Unknown) => {
                words.push(format!("{label}: per energy or per photon is not stated; assumed per energy."));
            }
            Some(Evidence::Inferred) => words.push(format!("{label}: per energy is inferred, not stated.")),
            Some(Evidence::Stated) | None => {}
        }
        if let Some(below) = sensor.extrapolated_below_k() {
            let end = number(sensor.support_nm()[1]);
            words.push(format!(
                "{label}: its locus below {below:.0} K (dotted) depends on data beyond {end} nm, which the table \
                 lacks."
            ));
        }
    }
    if let Ok(light) = scene.light() {
        words.extend(held_words(&format!("Light {}", scene.light_name()), light.grid.assumed()));
    }
    words
}

fn show_assumptions(ui: &mut Ui, words: Vec<String>) {
    if words.is_empty() {
        return;
    }
    ui.add_space(UNIT);
    for words in words {
        widgets::note(ui, words);
    }
}
