//! What the pictures say: patches, curves, profile, and the cameras that are nearest.

use std::sync::Arc;

use chromascope_core::camera::recorded::Freedom;
use chromascope_core::query::{ChartMeasurement, RecordedSet, Shared};
use chromascope_core::recovery::RecoveredCurves;
use egui::{Align, Button, Id, Label, RichText, Sense, Ui, Vec2};

use super::{Shown, State, bands, heading, wrong};
use crate::action::{Action, ImportedAction};
use crate::command::Command;
use crate::document::imported::ImportedSet;
use crate::document::measurement::Measurement;
use crate::document::{Document, SensorId, SetKind};
use crate::export::measured;
use crate::export::profile::CorrectionForm;
use crate::export::profile::shot::ShotCorrection;
use crate::figures::{measured as figure, metrics};
use crate::format::{fixed, rank_in_words};
use crate::paint::{self, PlotOptions};
use crate::panes::context::PaneContext;
use crate::panes::widgets;
use crate::panes::widgets::table::DataTable;
use crate::plot_item::PlotItem;
use crate::scene::metrics::{RankedCameras, Ranking};
use crate::scene::recorded::{RANK_CAUTION, RankedCamera};
use crate::theme::UNIT;
use crate::workspaces::{PaneKind, Workspace};

const UPDATE: &str = "Update in the library";
const CURVES: f32 = 300.0;
/// Width from which on tables stand side by side.
const TWO_COLUMNS: f32 = 1100.0;
const GAP: f32 = 4.0 * UNIT;
const LIGHT: &str = "The curves depend on it: a measured spectrum or the lamp's illuminant (A for halogen and tungsten, FL for \
    fluorescent lamps); \"Daylight of unknown temperature\" outdoors only.";
/// Cameras of the library that are named.
const NEAREST: usize = 5;

pub(super) fn show(ui: &mut Ui, context: &mut PaneContext<'_>) {
    let shots = &context.scene.document.measurement.shots;
    if let Some(shot) = shots.iter().find(|shot| shot.light.is_none()) {
        heading(ui, &format!("Choose the light that {} was photographed under.", shot.file));
        ui.add(Label::new(LIGHT).wrap());
        return;
    }
    let (is_current, Shown { measured, recorded, doubts, .. }) = match answer(context) {
        Err(why) => return wrong(ui, &why, context),
        Ok(None) => {
            ui.weak("Computing…");
            return;
        }
        Ok(Some(shown)) => shown,
    };
    if !is_current {
        heading(ui, "Computing…");
    }
    ui.add_enabled_ui(is_current, |ui| {
        headline(ui, &measured, context);
        warn(ui, &doubts, context);
        added(ui, &measured.recovery.curves, context);
        curves(ui, &measured, context);
        for line in measured::conditions(&measured) {
            ui.add(Label::new(RichText::new(line).small()).wrap());
        }
        if ui.available_width() < TWO_COLUMNS {
            profile(ui, &measured, context);
            identify(ui, &recorded, context);
            return patches(ui, &measured, context);
        }
        ui.horizontal_top(|ui| {
            let width = 0.5 * ui.available_width() - GAP;
            ui.vertical(|ui| {
                ui.set_max_width(width);
                profile(ui, &measured, context);
                identify(ui, &recorded, context);
            });
            ui.add_space(GAP);
            ui.vertical(|ui| patches(ui, &measured, context));
        });
    });
}

fn patches(ui: &mut Ui, measured: &ChartMeasurement, context: &mut PaneContext<'_>) {
    heading(ui, "Patches");
    for (at, shot) in measured.shots.iter().enumerate() {
        let name = context.scene.document.measurement.shots.get(at).map_or("", |shot| shot.file.as_str());
        if measured.shots.len() > 1 {
            ui.label(name);
        }
        let table = measured::patches(shot, &measured.recovery, at);
        ui.push_id(("patches", at), |ui| {
            DataTable::new(PaneKind::MEASURE, "Measured patches", &table).with_scrolling().show_compact(ui, context);
        });
    }
}

/// True with the results of the pictures as they are; false with the last ones while others are computed.
fn answer(context: &mut PaneContext<'_>) -> Result<Option<(bool, Shown)>, String> {
    let scene = context.scene;
    let measurement = &scene.document.measurement;
    let state = context.states.of::<State>();
    let known = state.asked.take().filter(|(of, _)| of == measurement);
    let query = match known {
        Some((_, query)) => query,
        None => scene.measurement()?.ok_or("no picture")?,
    };
    state.asked = Some((measurement.clone(), query.clone()));
    let made = context.later.ask(PaneKind::MEASURE, vec![query.clone()]).current()?;
    if let Some(made) = made
        && state.shown.as_ref().is_none_or(|shown| shown.query != query)
    {
        let measured = (*made).clone().map_err(|error| error.to_string())?;
        let recorded = Shared::new(measured.shots.iter().flat_map(|shot| shot.patches.clone()).collect());
        let doubts = measured::doubts(&measured).into();
        (state.shown, state.is_accepted) = (Some(Shown { query: query.clone(), measured, recorded, doubts }), false);
    }
    Ok(state.shown.clone().map(|shown| (shown.query == query, shown)))
}

/// Results that can be put to use: those of the pictures as they are, with consent where they are doubtful.
fn usable(context: &mut PaneContext<'_>) -> Result<Arc<ChartMeasurement>, &'static str> {
    let measurement = &context.scene.document.measurement;
    let State { shown, asked, is_accepted, .. } = context.states.of::<State>();
    let asked = asked.as_ref().filter(|(of, _)| of == measurement).map(|(_, query)| query);
    let Some(shown) = shown.as_ref().filter(|shown| asked == Some(&shown.query)) else {
        return Err("There is no result of these pictures, lights and charts");
    };
    if !*is_accepted && !shown.doubts.is_empty() {
        return Err("Read the warnings, and confirm there that light and chart are right");
    }
    Ok(Arc::clone(&shown.measured))
}

/// Warnings, and consent to what they are about.
fn warn(ui: &mut Ui, doubts: &[String], context: &mut PaneContext<'_>) {
    for doubt in doubts {
        ui.add(Label::new(RichText::new(format!("{doubt}.")).color(context.theme.warning)).wrap());
    }
    if !doubts.is_empty() {
        let is_accepted = &mut context.states.of::<State>().is_accepted;
        ui.checkbox(is_accepted, "Light and chart are right: use it all the same");
    }
}

/// The result in one line, with a link to what is below.
fn headline(ui: &mut Ui, measured: &ChartMeasurement, context: &mut PaneContext<'_>) {
    let first = context.scene.document.measurement.shots.first().map_or("", |shot| shot.file.as_str());
    ui.add(Label::new(RichText::new(measured::headline(measured, first).unwrap_or_default()).strong()).wrap());
    context.states.of::<State>().is_led |= ui.button("Curves, profile and patches").clicked();
}

/// The camera of this measurement in the library; true with other curves than these.
fn in_library<'a>(curves: &RecoveredCurves, document: &'a Document) -> Option<(&'a ImportedSet, bool)> {
    let Document { own, measurement, .. } = document;
    let known: &ImportedSet = own.iter().find(|set| set.measured.is_some() && set.measured == measurement.origin())?;
    Some((known, known.curves.iter().zip(&curves.values).any(|(of, values)| of.values != *values)))
}

/// Rank and ways on, once the camera is in the library.
pub(super) fn added(ui: &mut Ui, curves: &RecoveredCurves, context: &mut PaneContext<'_>) {
    let Some((known, is_stale)) = in_library(curves, context.scene.document) else { return };
    let name = known.name.clone();
    ui.horizontal_wrapped(|ui| {
        if is_stale {
            let words = format!("{name} in the library has the curves of before: see {UPDATE} above.");
            ui.colored_label(context.theme.warning, words);
        } else {
            ui.label(format!("{name} is one of your cameras{}.", rank(&name, context).unwrap_or_default()));
        }
        for workspace in [Workspace::Rank, Workspace::Compare] {
            if ui.button(format!("Show in {}", workspace.label())).clicked() {
                context.push(Command::Select(camera(&name)));
                context.push(Command::Show(workspace));
            }
        }
    });
}

/// Rank in the library by the metric that it is sorted by at first, once it is computed.
fn rank(name: &str, context: &mut PaneContext<'_>) -> Option<String> {
    let ranked = context.states.of::<Ranking>().ask(context.later, &context.scene, RankedCameras::Library);
    let at = ranked.cameras.iter().position(|camera| camera.id.name == name)?;
    let metric = metrics::first(&context.scene)?;
    let rank = rank_in_words(Some(metrics::ranks(&ranked, metric)[at]?));
    Some(format!(", {rank} of {} by {}", ranked.cameras.len(), metric.symbol))
}

fn camera(name: &str) -> PlotItem {
    PlotItem::Sensor(SensorId { kind: SetKind::Camera, name: name.to_owned() })
}

/// Recovered curves, with a table of the library behind them.
pub(super) fn plot(ui: &mut Ui, curves: &RecoveredCurves, nearest: Option<&str>, context: &mut PaneContext<'_>) {
    if std::mem::take(&mut context.states.of::<State>().is_led) {
        ui.scroll_to_cursor(Some(Align::TOP));
    }
    heading(ui, "Curves");
    let size = Vec2::new(ui.available_width(), CURVES);
    let (place, _) = ui.allocate_exact_size(size, Sense::hover());
    let nearest = nearest.and_then(|name| context.scene.sensor(SetKind::Camera, name).ok());
    let panel = figure::panel(curves, nearest.as_deref(), [size.x, size.y].map(f64::from));
    let options = PlotOptions { zoomable: false, reset: context.view.reset_plots, ..PlotOptions::default() };
    let shown = paint::plot(ui, Id::unique("measured curves"), &panel, &context.theme, place, options);
    widgets::labeled(&shown.response, egui::Role::Canvas, "Recovered sensitivities");
    if let Some([nm, _]) = shown.hovered {
        widgets::read_at_pointer(&shown.response, &figure::at(curves, nm));
    }
}

fn curves(ui: &mut Ui, measured: &ChartMeasurement, context: &mut PaneContext<'_>) {
    let nearest = measured.nearest.first().map(|(name, _)| name.as_str());
    plot(ui, &measured.recovery.curves, nearest, context);
    let words = "Good for color, a guess where the band (2 standard deviations) is wide. Dotted: share of the data at each wavelength, the \
        rest is the library's. Dashed: the nearest table.";
    ui.add(Label::new(RichText::new(words).small().color(context.theme.weak)).wrap());
}

/// Button that puts what is shown to use.
pub(super) fn add(ui: &mut Ui, context: &mut PaneContext<'_>) {
    if context.scene.document.measurement.passes.is_empty() {
        return put(ui, usable(context), |of| &of.recovery.curves, measured::set_of_chart, context);
    }
    let found = bands::answer(context).ok().flatten().ok_or("There is no result of these bands");
    put(ui, found, |of| &of.curves, measured::set_of_bands, context);
}

fn put<T>(
    ui: &mut Ui,
    usable: Result<Arc<T>, &'static str>,
    curves: impl Fn(&T) -> &RecoveredCurves,
    set: impl Fn(&Measurement, &T) -> ImportedSet,
    context: &mut PaneContext<'_>,
) {
    let hint = "As a camera with its uncertainties: it is compared and ranked, and saved from Data in all formats";
    let known = usable.as_ref().ok().and_then(|of| in_library(curves(of), context.scene.document));
    let stale = known.filter(|(_, is_stale)| *is_stale).map(|(set, _)| set.name.clone());
    let words = if stale.is_some() { UPDATE } else { "Add to the library and compare" };
    let button = ui.add_enabled(usable.is_ok(), Button::new(words));
    let button = button.on_hover_text(hint).on_disabled_hover_text(usable.as_ref().err().map_or(hint, |why| *why));
    if let Some(measured) = usable.ok().filter(|_| button.clicked()) {
        let scene = context.scene;
        let set = set(&scene.document.measurement, &measured);
        let (document, built_in) = (scene.document, scene.catalog.names().clone());
        let name = document.free_name(SetKind::Camera, &set.name, document.same_set(&set), &built_in);
        let (action, said) = match stale {
            Some(old) => {
                let what = format!("Update camera {old}");
                let action = ImportedAction::ReplaceAll { what, with: vec![(old, set)], beside: Vec::new(), built_in };
                (action, "Updated in your cameras.")
            }
            None => (ImportedAction::Import { sets: vec![set], built_in }, "Added to your cameras, and compared."),
        };
        context.push(Action::Imported(action));
        context.push(Command::Select(camera(&name)));
        context.view.say(said);
    }
}

fn profile(ui: &mut Ui, measured: &ChartMeasurement, context: &mut PaneContext<'_>) {
    heading(ui, "Profile");
    for (light, profile) in &measured.profiles {
        ui.label(format!("Under {light}"));
        let table = measured::corrections(profile);
        ui.push_id(light, |ui| {
            DataTable::new(PaneKind::MEASURE, "Profile", &table).with_scrolling().show_compact(ui, context);
        });
        if let Some(matrix) = measured::matrix(profile) {
            ui.add(Label::new(RichText::new(format!("Matrix {}:", measured::MATRIX)).small()).wrap());
            ui.add(Label::new(RichText::new(matrix).monospace()).selectable(true));
        }
    }
    for words in [measured::COLUMNS, measured::UNCERTAINTY] {
        ui.add(Label::new(RichText::new(words).small()).wrap());
    }
    let measurement = &context.scene.document.measurement;
    let (camera, model) = (measurement.camera.clone(), measurement.model());
    let terms = "Fitted to a photograph of a chart by its owner";
    let correction = ShotCorrection { camera: &camera, model, terms, profiles: &measured.profiles };
    let usable = usable(context);
    ui.horizontal_wrapped(|ui| {
        for (form, at) in correction.files() {
            let (label, why) = form.words();
            let is_one = form == CorrectionForm::Dcp || measured.profiles.len() == 1;
            let under = if is_one { String::new() } else { format!(" under {}", measured.profiles[at].0) };
            let hint = format!("{why}: the 3×3 matrix fitted to the patches{under}");
            let label = label.replace('…', &format!("{under}…"));
            let button = ui.add_enabled(usable.is_ok(), Button::new(label)).on_hover_text(hint);
            if !button.on_disabled_hover_text(usable.as_ref().err().map_or("", |why| *why)).clicked() {
                continue;
            }
            match correction.written((form, at)) {
                Ok(bytes) => context.push(Command::SaveProfile(camera.clone() + &under, form, bytes.into())),
                Err(error) => context.view.fail(error.to_string()),
            }
        }
    });
    ui.add(Label::new(RichText::new(correction.model_in_words()).small()).wrap());
}

/// Cameras whose tables explain the values of all pictures best; without those recovered from them.
fn identify(ui: &mut Ui, recorded: &RecordedSet, context: &mut PaneContext<'_>) {
    let scene = context.scene;
    let Document { own, measurement, .. } = scene.document;
    let is_own = |name: &str| own.iter().any(|set| set.name == name && set.measured == measurement.origin());
    let names: Vec<String> =
        scene.entries(SetKind::Camera).map(|entry| entry.name).filter(|name| !is_own(name)).collect();
    let Ok(query) = scene.recorded_ranking(recorded, Freedom::default(), &names) else { return };
    let Ok(Some(shown)) = context.later.ask("Measure: nearest cameras", vec![query]).last() else { return };
    let Ok(ranked) = shown.answer.as_ref().as_ref() else { return };
    heading(ui, "Which table is this camera?");
    let one = |(place, camera): (usize, &RankedCamera)| {
        let rms = camera.fit.as_ref().ok()?.rms();
        Some(format!("{}. {}, RMS {} %", place + 1, camera.name, fixed(100.0 * rms, 2)))
    };
    let lines: Vec<String> = ranked.iter().take(NEAREST).enumerate().filter_map(one).collect();
    ui.add(Label::new(lines.join("\n")).wrap());
    widgets::note(ui, RANK_CAUTION);
}
