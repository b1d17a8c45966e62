//! Exposure, lens and quality.

use chromascope_text::Number;
use egui::Ui;

use super::{Dial, caption, controls, line, set};
use crate::document::render::RenderSettings;
use crate::document::render::settings::VIEW;
use crate::panes::context::PaneContext;
use crate::panes::widgets;
use crate::scene::orbit::Orbit;

const FIELD: Number<Orbit> = Number { unit: "°", slider: [2.0, 120.0], ..Number::DEFAULT };

pub(super) fn show(ui: &mut Ui, context: &mut PaneContext<'_>) {
    controls(ui, VIEW, context);
    let is_image = context.scene.document.render.mesh.is_image();
    let reset = ui.add_enabled(!is_image, egui::Button::new("Reset view"));
    if reset.on_hover_text("Initial view of the mesh (Home)").clicked() {
        context.view.saved.render.orbit = None;
        ui.ctx().request_repaint();
    }
    without_picture(ui, context);
}

/// The field of view, which is no part of the document.
pub(super) fn lens(ui: &mut Ui, settings: &RenderSettings, context: &mut PaneContext<'_>) {
    let orbit = context.view.saved.render.orbit.unwrap_or_else(|| Orbit::of(&settings.mesh));
    let hint =
        "Of the lens; the viewpoint moves so that the mesh keeps its size. Wide lenses fall off with cos⁴ (Eq 12)";
    let is_enabled = !settings.mesh.is_image();
    let dial = Dial { name: "Field of view", hint, number: &FIELD, is_enabled };
    if let Some(to) = dial.show(ui, orbit.field_of_view_deg, context) {
        context.view.saved.render.orbit = Some(orbit.with_field_of_view(to));
        ui.ctx().request_repaint();
    }
}

pub(super) fn tolerance(ui: &mut Ui, is_enabled: bool, settings: &RenderSettings, context: &mut PaneContext<'_>) {
    let hint = "Largest error of a picture, relative to its brightest sample, with the quality Within a tolerance. The \
                Numerics workspace shows the method for each camera.";
    caption(ui, "Tolerance", context);
    let id = ui.make_persistent_id("tolerance field");
    let field = |ui: &mut Ui| widgets::tolerance::field(ui, id, settings.tolerance, "", hint, context);
    if let Some(to) = ui.add_enabled_ui(is_enabled, field).inner {
        set(context, "Tolerance", |settings| settings.tolerance = to);
    }
}

/// Lists the compared sensors that have no picture.
fn without_picture(ui: &mut Ui, context: &PaneContext<'_>) {
    let rendered = context.scene.rendered_sources();
    let skipped_work = context.scene.sources().into_iter().filter(|source| source.visible);
    let skipped_work =
        skipped_work.filter(|source| !rendered.iter().any(|r| (r.kind, &r.name) == (source.kind, &source.name)));
    let names: Vec<String> = skipped_work.map(|source| source.label).collect();
    let words = if names.is_empty() { String::new() } else { format!("No picture: {}", names.join(", ")) };
    let why =
        "Eq 13 takes the signals of cameras and of Stiles & Burch; with a fitted color transform all have pictures.";
    line(ui, &words, &format!("{words}. {why}"), context.theme.weak);
}
