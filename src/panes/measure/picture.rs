//! The picture of a chart: corners found or clicked, dragged where they are off.

use std::path::PathBuf;

use chromascope_core::camera::chart_grid::ChartGrid;
use chromascope_figure::{Axis, Dash, InkRole, Mark, Marker, Panel, Shape, Tag};
use egui::{Id, Label, RichText, Sense, Ui, Vec2};

use super::{State, change, heading, wrong};
use crate::catalog::file_store::FileState;
use crate::catalog::recorded_store::{ChartPhoto, RecordedContent};
use crate::document::PHOTOGRAPHED_CHART;
use crate::document::measurement::{MeasuredPatch, MeasuredShot};
use crate::format::file_name;
use crate::paint::{self, PlotOptions};
use crate::panes::context::PaneContext;
use crate::panes::widgets;

const CORNERS: [&str; 4] = ["top left", "top right", "bottom right", "bottom left"];
/// Of patches with clipped pixels, which are dashed too.
const CLIPPED: InkRole = InkRole::Rgb([235, 50, 60]);
/// Height of the picture relative to that of the pane.
const HEIGHT: f32 = 0.62;
/// Distance in points from which a corner is taken hold of.
const REACH: f32 = 14.0;

pub(super) fn show(ui: &mut Ui, context: &mut PaneContext<'_>) {
    let Some(path) = context.view.recorded.photo.clone() else { return };
    let name = file_name(&path);
    heading(ui, &format!("Picture: {name}"));
    let file = match context.recorded.get(&path) {
        FileState::Ready(file) => file,
        FileState::Loading => {
            ui.weak(format!("Reading {name}…"));
            return;
        }
        FileState::Failed(why) => {
            // Others that are not measured yet go on without it.
            context.view.recorded.photos.retain(|other| *other != path);
            next(context);
            if context.view.recorded.photo.as_ref() != Some(&path) {
                return context.view.fail(why.clone());
            }
            return wrong(ui, &why, context);
        }
    };
    let RecordedContent::Picture(photo) = &file.content else { return };
    let shot = context.scene.document.measurement.shots.iter().position(|shot| shot.file == name);
    let state = context.states.of::<State>();
    if let Some(index) = shot
        && state.held.is_none()
    {
        state.corners = context.scene.document.measurement.shots[index].corners.to_vec();
    } else if shot.is_none() && state.taken.as_ref() != Some(&path) {
        state.taken = Some(path);
        state.corners = photo.found.map_or_else(Vec::new, |corners| corners.to_vec());
        if photo.found.is_some() {
            take(&name, photo, context);
        }
    }
    let corners = context.states.of::<State>().corners.clone();
    let words = match (corners.len(), photo.found) {
        (4, _) => "Drag a corner where the grid does not lie on the patches.".to_owned(),
        (count, _) => {
            format!("No chart was found for certain: click the {} corner of the grid of patches.", CORNERS[count])
        }
    };
    ui.add(Label::new(RichText::new(words).small().color(context.theme.weak)).wrap());
    draw(ui, &name, photo, &corners, context);
}

/// Shows a picture that is not measured yet in place of one that is.
fn next(context: &mut PaneContext<'_>) {
    let recorded = &mut context.view.recorded;
    let shots = &context.scene.document.measurement.shots;
    let is_open = |path: &&PathBuf| {
        recorded.photo.as_ref() != Some(*path) && shots.iter().all(|shot| shot.file != file_name(path))
    };
    if let Some(path) = recorded.photos.iter().find(is_open).cloned() {
        recorded.photo = Some(path);
    }
}

/// Puts the patches within the corners into the document.
fn take(name: &str, photo: &ChartPhoto, context: &mut PaneContext<'_>) {
    let state = context.states.of::<State>();
    let Ok(corners) = <[[f64; 2]; 4]>::try_from(state.corners.as_slice()) else { return };
    let patches = match photo.picture.patches(corners) {
        Ok(patches) => patches,
        Err(error) => {
            state.corners.clear();
            return context.view.fail(format!("{name}: {error}."));
        }
    };
    let (name, camera) = (name.to_owned(), photo.picture.camera());
    change(context, "Patches of a picture", |measurement| {
        if measurement.camera.is_empty() {
            measurement.camera = camera.unwrap_or_else(|| "My camera".to_owned());
        }
        match measurement.shots.iter_mut().find(|shot| shot.file == name) {
            Some(shot) => (shot.corners, shot.patches) = (corners, patches),
            None => measurement.shots.push(new_shot(name, corners, patches)),
        }
    });
    next(context);
}

fn new_shot(file: String, corners: [[f64; 2]; 4], patches: Vec<MeasuredPatch>) -> MeasuredShot {
    MeasuredShot { file, chart: PHOTOGRAPHED_CHART.to_owned(), light: None, temperature_k: None, corners, patches }
}

fn draw(ui: &mut Ui, name: &str, photo: &ChartPhoto, corners: &[[f64; 2]], context: &mut PaneContext<'_>) {
    let [width, height] = photo.picture.size().map(|side| side as f64);
    let aspect = (width / height) as f32;
    let room = ui.available_width().min(HEIGHT * ui.clip_rect().height() * aspect);
    let size = Vec2::new(room, room / aspect);
    let (place, _) = ui.allocate_exact_size(size, Sense::hover());
    let mut panel = Panel::new(
        "picture",
        chromascope_figure::Rect::from_min_size([0.0, 0.0], [size.x, size.y].map(f64::from)),
        Axis::hidden([0.0, width]),
        Axis::hidden([height, 0.0]),
    );
    panel.equal_aspect = true;
    let image = Shape::Image { min: [0.0, height], max: [width, 0.0], image: photo.shown.clone() };
    panel.marks.push(Mark::new(Tag::default(), "picture of the chart", image));
    panel.marks.extend(grid(corners, context));
    let points = Shape::Points { points: corners.to_vec(), marker: Marker::Circle, radius: 5.0 };
    panel.marks.push(Mark::new(Tag::default(), "corners", points).with_stroke(InkRole::Warning, 2.0));
    let options = PlotOptions { zoomable: false, reset: context.view.reset_plots, ..PlotOptions::default() };
    let plot = paint::plot(ui, Id::unique(("picture of a chart", name)), &panel, &context.theme, place, options);
    widgets::labeled(&plot.response, egui::Role::Canvas, "Picture of the chart");
    let at = plot.response.interact_pointer_pos();
    let state = context.states.of::<State>();
    let inside = |at| {
        let [x, y] = plot.view.value(at);
        [x.clamp(0.0, width), y.clamp(0.0, height)]
    };
    if let Some(at) = at {
        let near = |corner: &[f64; 2]| plot.view.at(*corner).distance(at);
        if plot.response.drag_started() {
            let nearest = (0..corners.len()).min_by(|a, b| near(&corners[*a]).total_cmp(&near(&corners[*b])));
            state.held = nearest.filter(|index| near(&corners[*index]) < REACH);
        }
        if let Some(held) = state.held {
            state.corners[held] = inside(at);
        } else if plot.response.clicked() && corners.len() < CORNERS.len() {
            state.corners.push(inside(at));
            if state.corners.len() == CORNERS.len() {
                return take(name, photo, context);
            }
        }
    }
    if plot.response.drag_stopped() && state.held.take().is_some() {
        take(name, photo, context);
    }
}

/// Outlines of the patches' counted parts; those with clipped pixels are marked.
fn grid(corners: &[[f64; 2]], context: &PaneContext<'_>) -> Vec<Mark> {
    let Some(grid) = <[[f64; 2]; 4]>::try_from(corners).ok().and_then(|corners| ChartGrid::new(corners, 6, 4).ok())
    else {
        return Vec::new();
    };
    let shots = &context.scene.document.measurement.shots;
    let shot = shots.iter().find(|shot| shot.corners.as_slice() == corners);
    let outline = |patch: usize| {
        let points = grid.outline(patch).to_vec();
        let clipped = shot.and_then(|shot| shot.patches.get(patch)).is_some_and(|patch| patch.clipped > 0.0);
        let mark = Mark::new(Tag::default(), "patch", Shape::Line { points, closed: true });
        if clipped {
            mark.with_stroke(CLIPPED, 2.0).with_dash(Dash::Dashed)
        } else {
            mark.with_stroke(InkRole::Warning, 1.0)
        }
    };
    (0..grid.patches()).map(outline).collect()
}
