//! The user's own camera from pictures of a chart or from narrow bands: picture, patches, curves and profile in one column.

mod bands;
mod picture;
mod results;

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use chromascope_core::camera::chart_search::CHART_SIZE;
use chromascope_core::query::{ChartMeasurement, RecordedSet};
use egui::{Label, Rect, RichText, TextEdit, Ui};

use super::context::{Pane, PaneContext};
use crate::action::Action;
use crate::catalog::chart_picture::CONVERTERS;
use crate::catalog::file_store::FileState;
use crate::catalog::recorded_store::RecordedContent;
use crate::command::Command;
use crate::document::imported::Fingerprint;
use crate::document::measurement::{MeasuredPatch, MeasuredShot, Measurement};
use crate::document::{Light, SetKind};
use crate::format::{file_name, sentence};
use crate::panes::widgets;
use crate::panes::widgets::pick_list::{self, Line};
use crate::scene::measurement::STAND_IN_K;
use crate::scene::recovery::MeasuredCameraQuery;
use crate::theme::UNIT;
use crate::workspaces::PaneKind;

pub const PANE: Pane = Pane::new(PaneKind::MEASURE, "Measure", show).tab("Measure a camera");

const ABOUT: [&str; 3] = [
    "A raw file as DNG, a linear 16-bit TIFF or PNG, or OpenEXR: the chart evenly lit, slightly underexposed and slightly out of focus. \
        Raw files of makers (NEF, CR3, ARW and others) are converted to DNG first, with",
    "The camera's sensitivities are estimated from its raw values with those of the library as a prior: good for color, a guess where \
        the band is wide. Of other charts, click the corners and choose your own reflectances.",
    "Narrow bands: drop one table for each pass, with the columns wavelength_nm, power, exposure_s, red, green, blue, dark_red, \
        dark_green and dark_blue, or picture and dark_picture in place of these six.",
];
/// Width of these lines.
const COLUMN: f32 = 560.0;
const UNKNOWN: &str = "Daylight of unknown temperature";
const PICK: f32 = 220.0;
const NAME: f32 = 220.0;
const GRID: f32 = 80.0;

/// What the pane keeps from frame to frame.
#[derive(Default)]
struct State {
    /// Corners that are clicked or dragged.
    corners: Vec<[f64; 2]>,
    /// The corner that is dragged.
    held: Option<usize>,
    /// The picture whose chart was taken over as found.
    taken: Option<PathBuf>,
    /// The last question, and what it is of.
    asked: Option<(Measurement, MeasuredCameraQuery)>,
    shown: Option<Shown>,
    /// True for the frame after a link to the curves was clicked.
    is_led: bool,
    /// True if the answer is to be used in spite of what is doubtful about it.
    is_accepted: bool,
}

/// The last answer, with what is made of it once.
#[derive(Clone)]
struct Shown {
    query: MeasuredCameraQuery,
    measured: Arc<ChartMeasurement>,
    /// Patches of all pictures.
    recorded: RecordedSet,
    doubts: Arc<[String]>,
}

fn show(ui: &mut Ui, rect: Rect, context: &mut PaneContext<'_>) {
    let body = widgets::body(ui, &PANE, rect, context, |ui, context| {
        context.button(ui, "Open…", "Open raw pictures of a chart, or tables of narrow bands", Command::Open);
        let Measurement { shots, passes, .. } = &context.scene.document.measurement;
        if shots.is_empty() && passes.is_empty() {
            return;
        }
        results::add(ui, context);
        if ui.button("Start anew").on_hover_text("Remove all files of this measurement").clicked() {
            (context.view.recorded.photo, context.view.recorded.photos) = (None, BTreeMap::new());
            context.view.recorded.failed.clear();
            change(context, "Start a measurement anew", |measurement| *measurement = Measurement::default());
        }
    });
    widgets::scroll(ui, (PANE.kind, "measure"), body, context, |ui, context| {
        if !context.scene.document.measurement.passes.is_empty() {
            return bands::show(ui, context);
        }
        let is_empty = context.scene.document.measurement.shots.is_empty();
        if is_empty && context.view.recorded.photo.is_none() {
            about(ui, context);
        }
        picture::show(ui, context);
        if !is_empty {
            shots(ui, context);
        }
        picture::others(ui, context);
        if !is_empty && context.scene.document.measurement.mixed().is_none() {
            results::show(ui, context);
            widgets::note(ui, "The session keeps patches, corners, lights and curves, not the photographs.");
        }
    });
}

fn about(ui: &mut Ui, context: &mut PaneContext<'_>) {
    let [picture, result, bands] = ABOUT;
    ui.add_space((0.2 * ui.clip_rect().height()).max(UNIT));
    ui.horizontal(|ui| {
        ui.add_space((0.5 * (ui.available_width() - COLUMN)).max(0.0));
        ui.vertical(|ui| {
            ui.set_max_width(COLUMN);
            ui.label("Drop a photograph of a ColorChecker here.");
            ui.add_space(UNIT);
            context.button(ui, "Open a photograph…", "A picture of a chart, or tables of narrow bands", Command::Open);
            for words in [&*format!("{picture} {CONVERTERS}, both free of charge."), result, bands] {
                ui.add_space(UNIT);
                ui.add(Label::new(RichText::new(words).small()).wrap());
            }
        });
    });
}

/// Changes the measurement of the document, in a step of this name.
fn change(context: &mut PaneContext<'_>, what: &'static str, how: impl FnOnce(&mut Measurement)) {
    let mut to = context.scene.document.measurement.clone();
    how(&mut to);
    context.push(Action::Measure(what, Box::new(to)));
}

fn heading(ui: &mut Ui, words: &str) {
    ui.add_space(2.0 * UNIT);
    ui.strong(words);
}

fn wrong(ui: &mut Ui, words: &str, context: &PaneContext<'_>) {
    ui.add(Label::new(RichText::new(sentence(words)).color(context.theme.error)).wrap());
}

/// Name of the camera.
fn camera(ui: &mut Ui, context: &mut PaneContext<'_>) {
    ui.horizontal_wrapped(|ui| {
        ui.label("Camera");
        let mut name = context.scene.document.measurement.camera.clone();
        let field = ui.add(TextEdit::singleline(&mut name).desired_width(NAME).hint_text("Maker and model"));
        widgets::labeled(&field, egui::Role::TextInput, "Name of the camera");
        if field.changed() {
            change(context, "Name of the camera", |measurement| measurement.camera = name);
        }
    });
}

/// Camera, and chart and light of each picture.
fn shots(ui: &mut Ui, context: &mut PaneContext<'_>) {
    camera(ui, context);
    for (index, shot) in context.scene.document.measurement.shots.iter().enumerate() {
        ui.push_id(index, |ui| ui.horizontal_wrapped(|ui| one_shot(ui, index, shot, context)));
    }
    if let Some(mixed) = context.scene.document.measurement.mixed() {
        wrong(ui, &format!("{mixed}: remove the pictures of one of them, or say that they are one camera"), context);
        let hint = "The curves are recovered from all pictures; profiles are for the model of the first";
        if ui.button("They are one camera").on_hover_text(hint).clicked() {
            change(context, "Pictures of one camera", |measurement| measurement.is_one_camera = true);
        }
    }
}

/// True for the picture of a shot.
fn is_it(shot: &MeasuredShot, path: &Path, of: Option<Fingerprint>) -> bool {
    of.is_some_and(|of| shot.is_of(of, &file_name(path)))
}

/// Names chart and grid of a picture, which is measured again by another grid.
fn set_chart(index: usize, chart: String, grid: [usize; 2], context: &mut PaneContext<'_>) {
    let shot = &context.scene.document.measurement.shots[index];
    let patches = if grid == shot.grid { Ok(shot.patches.clone()) } else { measured_again(shot, grid, context) };
    match patches {
        Ok(patches) => change(context, "Chart of a picture", |measurement| {
            let shot = &mut measurement.shots[index];
            (shot.chart, shot.grid, shot.patches) = (chart, grid, patches);
        }),
        Err(why) => context.view.fail(why),
    }
}

fn measured_again(
    shot: &MeasuredShot,
    grid: [usize; 2],
    context: &PaneContext<'_>,
) -> Result<Vec<MeasuredPatch>, String> {
    let mut photos = context.view.recorded.photos.iter();
    let path = photos.find(|(path, of)| is_it(shot, path, **of)).map(|(path, _)| path);
    if let Some(FileState::Ready(file)) = path.map(|path| context.recorded.get(path))
        && let RecordedContent::Picture(photo) = &file.content
    {
        return photo.picture.patches(shot.corners, grid).map_err(|error| format!("{}: {error}.", shot.file));
    }
    let [columns, rows] = grid;
    Err(format!("Open {} again first: its patches are measured in a grid of {columns} × {rows}.", shot.file))
}

fn one_shot(ui: &mut Ui, index: usize, shot: &MeasuredShot, context: &mut PaneContext<'_>) {
    let (scene, theme) = (context.scene, context.theme);
    let recorded = &mut context.view.recorded;
    match recorded.photos.iter().find(|(path, of)| is_it(shot, path, **of)) {
        Some((path, _)) if recorded.photo.as_ref() != Some(path) => {
            if ui.button(&shot.file).on_hover_text("Show this picture").clicked() {
                recorded.photo = Some(path.clone());
            }
        }
        _ => drop(ui.label(&shot.file)),
    }
    ui.label("under");
    let daylight = Line { also: "sun outdoors sky cloudy".to_owned(), ..Line::new(UNKNOWN, shot.is_daylight()) };
    let mut lights = vec![(daylight, (Light::Daylight, None))];
    let of_scene = (scene.document.light.clone(), Some(scene.document.temperature_k));
    if !matches!(of_scene.0, Light::Set(_)) {
        let is_on = (shot.light.as_ref(), shot.temperature_k) == (Some(&of_scene.0), of_scene.1);
        lights.push((Line::new(format!("As in the scene bar: {}", scene.light_name()), is_on), of_scene));
    }
    lights.extend(scene.entries(SetKind::Illuminant).map(|entry| {
        let light = Light::Set(entry.name.clone());
        (Line::of_set(&entry, shot.light.as_ref() == Some(&light)), (light, None))
    }));
    let now = match (&shot.light, shot.temperature_k) {
        (None, _) => "Choose the light".to_owned(),
        (Some(Light::Set(name)), _) => name.clone(),
        (Some(Light::BlackBody), kelvin) => format!("blackbody {:.0} K", kelvin.unwrap_or(STAND_IN_K)),
        (Some(Light::Daylight), Some(kelvin)) => format!("daylight {kelvin:.0} K"),
        (Some(Light::Daylight), None) => UNKNOWN.to_owned(),
    };
    let hint = ("Light of the picture", "The light that the chart was photographed under");
    let lines = || lights.iter().map(|(line, _)| line.clone()).collect();
    if let Some(chosen) = pick_list::drop_down(ui, hint, now, PICK, &theme, lines) {
        let (light, temperature_k) = lights[chosen].1.clone();
        change(context, "Light of a picture", |measurement| {
            let shot = &mut measurement.shots[index];
            (shot.light, shot.temperature_k) = (Some(light), temperature_k);
        });
    }
    ui.label("on");
    let charts: Vec<_> = [SetKind::Chart, SetKind::Material].into_iter().flat_map(|kind| scene.entries(kind)).collect();
    let lines = || charts.iter().map(|entry| Line::of_set(entry, entry.name == shot.chart)).collect();
    let hint = ("Chart of the picture", "Measured reflectances of the chart, yours or those of its edition");
    if let Some(chosen) = pick_list::drop_down(ui, hint, shot.chart.as_str(), PICK, &theme, lines) {
        let name = charts[chosen].name.clone();
        let grids = scene.grids_of(&name);
        let grid = grids.iter().find(|grid| **grid == shot.grid).or(grids.first());
        set_chart(index, name, grid.copied().unwrap_or(shot.grid), context);
    }
    let grids = scene.grids_of(&shot.chart);
    if shot.grid != CHART_SIZE || grids.first() != Some(&CHART_SIZE) {
        let words = |[columns, rows]: [usize; 2]| format!("{columns} × {rows}");
        let lines = || grids.iter().map(|grid| Line::new(words(*grid), *grid == shot.grid)).collect();
        let hint = ("Grid of the picture", "Patches across and down, from the first corner");
        if let Some(chosen) = pick_list::drop_down(ui, hint, words(shot.grid), GRID, &theme, lines) {
            set_chart(index, shot.chart.clone(), grids[chosen], context);
        }
    }
    let recorded = &mut context.view.recorded;
    if ui.button("Remove").on_hover_text("Remove this picture from the measurement").clicked() {
        // Else it would be taken again beside the next one.
        recorded.photos.retain(|path, of| !is_it(shot, path, *of));
        recorded.photo.take_if(|path| !recorded.photos.contains_key(path));
        context.states.of::<State>().taken.take_if(|path| !recorded.photos.contains_key(path));
        change(context, "Remove a picture", |measurement| {
            measurement.shots.remove(index);
        });
    }
}
