//! The picture of a chart: corners found or clicked, dragged where they are off.

use std::path::{Path, PathBuf};

use chromascope_core::camera::chart_grid::ChartGrid;
use chromascope_core::camera::chart_search::CHART_SIZE;
use chromascope_figure::{Axis, Dash, InkRole, Mark, Marker, Panel, Shape, Tag};
use egui::{Id, Label, RichText, Sense, Ui, Vec2};

use super::{State, change, heading};
use crate::catalog::file_store::FileState;
use crate::catalog::recorded_store::{ChartPhoto, RecordedContent};
use crate::document::PHOTOGRAPHED_CHART;
use crate::document::imported::Fingerprint;
use crate::document::measurement::{MY_CAMERA, MeasuredShot};
use crate::format::{file_name, path_end};
use crate::paint::{self, PlotOptions};
use crate::panes::context::PaneContext;
use crate::panes::widgets;

const CORNERS: [&str; 4] = ["top left", "top right", "bottom right", "bottom left"];
/// Of what lies on the picture, whose colors are not the theme's: one of both stands out from any patch.
const ON_PICTURE: [InkRole; 2] = [InkRole::Rgb([255; 3]), InkRole::Rgb([0; 3])];
/// Of patches with clipped pixels, which are dashed too.
const CLIPPED: InkRole = InkRole::Rgb([235, 50, 60]);
/// Height of the picture relative to that of the pane.
const HEIGHT: f32 = 0.62;
/// Distance in points from which a corner is taken hold of.
const REACH: f32 = 14.0;

pub(super) fn show(ui: &mut Ui, context: &mut PaneContext<'_>) {
    let Some(path) = context.view.recorded.photo.clone() else { return };
    let name = file_name(&path);
    let file = match context.recorded.get(&path) {
        FileState::Ready(file) => file,
        FileState::Loading => {
            heading(ui, &format!("Picture: {name}"));
            ui.weak(format!("Reading {name}…"));
            return;
        }
        FileState::Failed(why) => {
            // Others that are not measured yet go on without it.
            discard(&path, context);
            context.view.recorded.failed.insert(path, why);
            ui.ctx().request_repaint();
            return;
        }
    };
    let RecordedContent::Picture(photo) = &file.content else { return };
    context.view.recorded.photos.insert(path.clone(), Some(photo.contents));
    let measurement = &context.scene.document.measurement;
    let shot = measurement.place(photo.contents, &name);
    heading(ui, &format!("Picture: {}", shot.map_or(&name, |index| &measurement.shots[index].file)));
    let state = context.states.of::<State>();
    if let Some(index) = shot
        && state.held.is_none()
    {
        state.corners = measurement.shots[index].corners.to_vec();
    } else if shot.is_none() && state.taken.as_ref() != Some(&path) {
        state.taken = Some(path.clone());
        state.corners = photo.found.map_or_else(Vec::new, |corners| corners.to_vec());
        if photo.found.is_some() {
            take(&path, photo, context);
        }
    }
    let corners = context.states.of::<State>().corners.clone();
    let words = match (corners.len(), photo.found) {
        (4, _) => "Drag a corner where the grid does not lie on the patches.".to_owned(),
        (count, _) => {
            format!(
                "No chart of 24 patches was found for certain: click the {} corner of the grid of patches, just outside the \
                 patch there. Of another chart, choose its reflectances below as soon as all four are clicked.",
                CORNERS[count]
            )
        }
    };
    ui.add(Label::new(RichText::new(words).small().color(context.theme.weak)).wrap());
    draw(ui, &path, photo, &corners, context);
}

/// Pictures that are not measured yet.
fn open(context: &PaneContext<'_>) -> Vec<PathBuf> {
    let measurement = &context.scene.document.measurement;
    let is_open =
        |path: &Path, of: Option<Fingerprint>| of.and_then(|of| measurement.place(of, &file_name(path))).is_none();
    let photos = context.view.recorded.photos.iter();
    photos.filter(|(path, of)| is_open(path, **of)).map(|(path, _)| path.clone()).collect()
}

/// Says which pictures are not measured, beside the list of those that are: they can be done without.
pub(super) fn others(ui: &mut Ui, context: &mut PaneContext<'_>) {
    let open = open(context).into_iter().map(|path| (format!("{} is not measured yet.", file_name(&path)), path));
    let failed = context.view.recorded.failed.clone().into_iter().map(|(path, why)| (why + ".", path));
    for (words, path) in open.chain(failed) {
        ui.horizontal_wrapped(|ui| {
            ui.colored_label(context.theme.error, words);
            if ui.button("Discard").on_hover_text(format!("Do without {}", file_name(&path))).clicked() {
                discard(&path, context);
            }
        });
    }
}

/// Leaves a picture: another one that is not measured yet is shown, else one that is.
fn discard(path: &Path, context: &mut PaneContext<'_>) {
    context.states.of::<State>().taken.take_if(|taken| taken == path);
    let recorded = &mut context.view.recorded;
    recorded.photos.remove(path);
    recorded.failed.remove(path);
    if recorded.photo.as_deref() == Some(path) {
        recorded.photo = recorded.photos.keys().next().cloned();
        next(context);
    }
}

/// Shows a picture that is not measured yet in place of one that is.
fn next(context: &mut PaneContext<'_>) {
    let open = open(context).into_iter().find(|path| context.view.recorded.photo.as_ref() != Some(path));
    if open.is_some() {
        context.view.recorded.photo = open;
    }
}

/// Chart and grid of a picture: of one that is not measured yet and where none was found, those of the last one.
fn chart_of(path: &Path, photo: &ChartPhoto, context: &PaneContext<'_>) -> (String, [usize; 2]) {
    let measurement = &context.scene.document.measurement;
    let own = measurement.place(photo.contents, &file_name(path)).map(|index| &measurement.shots[index]);
    let like = own.or_else(|| measurement.shots.last().filter(|_| photo.found.is_none()));
    like.map_or_else(|| (PHOTOGRAPHED_CHART.to_owned(), CHART_SIZE), |shot| (shot.chart.clone(), shot.grid))
}

/// Puts the patches within the corners into the document.
fn take(path: &Path, photo: &ChartPhoto, context: &mut PaneContext<'_>) {
    let (chart, grid) = chart_of(path, photo, context);
    let state = context.states.of::<State>();
    let Ok(corners) = <[[f64; 2]; 4]>::try_from(state.corners.as_slice()) else { return };
    let patches = match photo.picture.patches(corners, grid) {
        Ok(patches) => patches,
        Err(error) => {
            state.corners.clear();
            return context.view.fail(format!("{}: {error}.", file_name(path)));
        }
    };
    let (camera, model) = (photo.picture.camera(), photo.picture.model());
    let (contents, photos) = (photo.contents, context.view.recorded.photos.clone());
    change(context, "Patches of a picture", |measurement| {
        if measurement.camera.is_empty() {
            measurement.camera = camera.unwrap_or_else(|| MY_CAMERA.to_owned());
        }
        if let Some(index) = measurement.place(contents, &file_name(path)) {
            let shot = &mut measurement.shots[index];
            (shot.corners, shot.patches, shot.model) = (corners, patches, model);
            return;
        }
        let is_namesake = |shot: &MeasuredShot| Path::new(&shot.file).ends_with(file_name(path));
        let path_of = |shot: &MeasuredShot| {
            let photo = photos.iter().find(|(_, of)| of.is_some() && **of == shot.contents);
            photo.map_or_else(|| PathBuf::from(&shot.file), |(path, _)| path.clone())
        };
        let mut paths: Vec<PathBuf> = measurement.shots.iter().filter(|shot| is_namesake(shot)).map(path_of).collect();
        paths.push(path.to_owned());
        for shot in measurement.shots.iter_mut().filter(|shot| is_namesake(shot)) {
            shot.file = path_end(&path_of(shot), &paths);
        }
        let file = path_end(path, &paths);
        let contents = Some(contents);
        // The user's word was about the models before.
        measurement.is_one_camera &= model.is_none() || measurement.shots.iter().any(|shot| shot.model == model);
        measurement.shots.push(MeasuredShot {
            file,
            contents,
            model,
            chart,
            light: None,
            temperature_k: None,
            grid,
            corners,
            patches,
        });
    });
    next(context);
}

fn draw(ui: &mut Ui, path: &Path, photo: &ChartPhoto, corners: &[[f64; 2]], context: &mut PaneContext<'_>) {
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
    panel.marks.extend(grid(corners, chart_of(path, photo, context).1, context));
    // Rings, through which the corner of the chart is seen.
    let [ink, halo] = ON_PICTURE;
    panel.marks.extend([(halo, 5.0), (ink, 2.0)].map(|(ink, width)| {
        let points = Shape::Points { points: corners.to_vec(), marker: Marker::Circle, radius: 5.0 };
        Mark::new(Tag::default(), "corners", points).with_stroke(ink, width)
    }));
    let options = PlotOptions { zoomable: false, reset: context.view.reset_plots, ..PlotOptions::default() };
    let plot = paint::plot(ui, Id::unique(("picture of a chart", path)), &panel, &context.theme, place, options);
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
                return take(path, photo, context);
            }
        }
    }
    if plot.response.drag_stopped() && state.held.take().is_some() {
        take(path, photo, context);
    }
}

/// Outlines of the patches' counted parts; those with clipped pixels are marked.
fn grid(corners: &[[f64; 2]], [columns, rows]: [usize; 2], context: &PaneContext<'_>) -> Vec<Mark> {
    let corners_of_grid = <[[f64; 2]; 4]>::try_from(corners).ok();
    let Some(grid) = corners_of_grid.and_then(|corners| ChartGrid::new(corners, columns, rows).ok()) else {
        return Vec::new();
    };
    let shots = &context.scene.document.measurement.shots;
    let shot = shots.iter().find(|shot| shot.corners.as_slice() == corners);
    let outline = |patch: usize| {
        let points = grid.outline(patch).to_vec();
        let clipped = shot.and_then(|shot| shot.patches.get(patch)).is_some_and(|patch| patch.clipped > 0.0);
        let [ink, halo] = ON_PICTURE;
        let mark = Mark::new(Tag::default(), "patch", Shape::Line { points, closed: true });
        if clipped {
            mark.with_stroke(CLIPPED, 2.0).with_dash(Dash::Dashed)
        } else {
            mark.with_stroke(ink, 1.0).with_halo(halo)
        }
    };
    (0..grid.patches()).map(outline).collect()
}
