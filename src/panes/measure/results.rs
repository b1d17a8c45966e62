//! What the pictures say: patches, curves, profile, and the cameras that are nearest.

use std::sync::Arc;

use chromascope_core::camera::recorded::Freedom;
use chromascope_core::query::ChartMeasurement;
use egui::{Id, Label, RichText, Sense, Ui, Vec2};

use super::{State, heading, wrong};
use crate::action::{Action, ImportedAction};
use crate::command::Command;
use crate::document::SetKind;
use crate::export::measured;
use crate::export::profile::shot::ShotCorrection;
use crate::figures::measured as figure;
use crate::format::fixed;
use crate::paint::{self, PlotOptions};
use crate::panes::context::PaneContext;
use crate::panes::widgets;
use crate::panes::widgets::table::DataTable;
use crate::scene::recorded::{RANK_CAUTION, RankedCamera};
use crate::workspaces::PaneKind;

const CURVES: f32 = 300.0;
const WIDTH: f32 = 720.0;
/// Cameras of the library that are named.
const NEAREST: usize = 5;

pub(super) fn show(ui: &mut Ui, context: &mut PaneContext<'_>) {
    let measured = match answer(context) {
        Err(why) => return wrong(ui, &why, context),
        Ok(None) => {
            ui.weak("Computing…");
            return;
        }
        Ok(Some(measured)) => measured,
    };
    curves(ui, &measured, context);
    for line in measured::conditions(&measured) {
        ui.add(Label::new(RichText::new(line).small()).wrap());
    }
    profile(ui, &measured, context);
    identify(ui, context);
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

/// What was recovered from the pictures as they are; the last answer while another is computed.
fn answer(context: &mut PaneContext<'_>) -> Result<Option<Arc<ChartMeasurement>>, String> {
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
    if let Some(made) = made {
        let made = (*made).clone().map_err(|error| error.to_string())?;
        state.shown = Some((query, made));
    }
    Ok(state.shown.as_ref().map(|(_, made)| Arc::clone(made)))
}

fn curves(ui: &mut Ui, measured: &ChartMeasurement, context: &mut PaneContext<'_>) {
    heading(ui, "Curves");
    let size = Vec2::new(ui.available_width().min(WIDTH), CURVES);
    let (place, _) = ui.allocate_exact_size(size, Sense::hover());
    let nearest = measured.nearest.first().and_then(|(name, _)| context.scene.sensor(SetKind::Camera, name).ok());
    let panel = figure::panel(measured, nearest.as_deref(), [size.x, size.y].map(f64::from));
    let options = PlotOptions { zoomable: false, reset: context.view.reset_plots, ..PlotOptions::default() };
    let shown = paint::plot(ui, Id::unique("measured curves"), &panel, &context.theme, place, options);
    widgets::labeled(&shown.response, egui::Role::Canvas, "Sensitivities recovered from the pictures");
    if let Some([nm, _]) = shown.hovered {
        widgets::read_at_pointer(&shown.response, &figure::at(measured, nm));
    }
    let nearest: Vec<String> = measured
        .nearest
        .iter()
        .take(3)
        .map(|(name, distance)| format!("{name} ({} %)", fixed(100.0 * distance, 1)))
        .collect();
    let words = format!(
        "Good for color, a guess where the band (2 standard deviations) is wide. Dotted: share of the data at each wavelength, the rest \
         is the library's. Dashed: the nearest table. Nearest by the difference of the curves: {}.",
        nearest.join(", ")
    );
    ui.add(Label::new(RichText::new(words).small().color(context.theme.weak)).wrap());
}

/// Button that puts what is shown to use.
pub(super) fn add(ui: &mut Ui, context: &mut PaneContext<'_>) {
    let State { shown, asked, .. } = context.states.of::<State>();
    let asked = asked.as_ref().map(|(_, query)| query);
    let Some((_, measured)) = shown.clone().filter(|(query, _)| asked == Some(query)) else { return };
    let hint = "As a camera with its uncertainties: it is compared and ranked, and saved from Data in all formats";
    let words = "Add to the library and compare";
    if ui.button(words).on_hover_text(hint).clicked() {
        let scene = context.scene;
        let sets = vec![measured::set(&scene.document.measurement, &measured)];
        context.push(Action::Imported(ImportedAction::Import { sets, built_in: scene.catalog.names().clone() }));
        context.view.say("Added to your cameras, and compared.");
    }
}

fn profile(ui: &mut Ui, measured: &ChartMeasurement, context: &mut PaneContext<'_>) {
    heading(ui, "Profile");
    for (light, profile) in &measured.profiles {
        ui.label(format!("Under {light}: ΔE*00, predicted by the curves and measured in the picture"));
        let table = measured::corrections(profile);
        ui.push_id(light, |ui| {
            DataTable::new(PaneKind::MEASURE, "Profile", &table).with_scrolling().show_compact(ui, context);
        });
    }
    if let Some(words) = measured::left_out(measured) {
        ui.add(Label::new(RichText::new(words).small()).wrap());
    }
    let camera = context.scene.document.measurement.camera.clone();
    let terms = "Fitted to a photograph of a chart by its owner";
    let correction = ShotCorrection { camera: &camera, model: None, terms, profiles: &measured.profiles };
    ui.horizontal_wrapped(|ui| {
        for form in ShotCorrection::FORMS {
            let (label, why) = form.words();
            if !ui.button(label).on_hover_text(format!("{why}: the 3×3 matrix fitted to the patches")).clicked() {
                continue;
            }
            match correction.written(form) {
                Ok(bytes) => context.push(Command::SaveProfile(camera.clone(), form, bytes.into())),
                Err(error) => context.view.fail(error.to_string()),
            }
        }
    });
}

/// Cameras whose tables explain the values of the first picture best.
fn identify(ui: &mut Ui, context: &mut PaneContext<'_>) {
    let scene = context.scene;
    let Some(shot) = scene.document.measurement.shots.first() else { return };
    let set = scene.recorded_of(shot);
    let Ok(query) =
        set.and_then(|set| scene.recorded_ranking(&set, Freedom::default(), &[]).map_err(|error| error.to_string()))
    else {
        return;
    };
    let Ok(Some(shown)) = context.later.ask("Measure: nearest cameras", vec![query]).last() else { return };
    let Ok(ranked) = shown.answer.as_ref().as_ref() else { return };
    heading(ui, "Which table is this camera?");
    let one = |(place, camera): (usize, &RankedCamera)| {
        let rms = camera.fit.as_ref().ok()?.rms();
        Some(format!("{}. {}, RMS {} %", place + 1, camera.name, fixed(100.0 * rms, 2)))
    };
    let lines: Vec<String> = ranked.iter().take(NEAREST).enumerate().filter_map(one).collect();
    ui.add(Label::new(lines.join("   ")).wrap());
    widgets::note(ui, RANK_CAUTION);
}
