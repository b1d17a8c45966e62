//! Exposure, lens and quality.

use egui::Ui;

use super::{Dial, caption, choices, line, set, unless_image};

use crate::document::render::RenderSettings;
use crate::panes::context::PaneContext;
use crate::panes::widgets;
use crate::scene::orbit::Orbit;
use chromascope_core::render::QualityLevel;

/// Shows the group.
pub(super) fn show(ui: &mut Ui, context: &mut PaneContext<'_>) {
    let settings = context.scene.document.render.clone();
    let hint = if settings.mesh.is_image() {
        "The same for all cameras. At 0 EV a reflectance of 1 is the screen's white; of radiances, the luminance that \
         99.5 % of the pixels stay below."
    } else {
        "The same for all cameras. At 0 EV the material facing the light has 40 % of the screen's white."
    };
    let dial = Dial {
        name: "Exposure",
        range: -6.0..=6.0,
        logarithmic: None,
        unit: " EV",
        hint,
        beyond: false,
        enabled: true,
    };
    if let Some(to) = dial.show(ui, settings.exposure_ev, context) {
        set(context, "Exposure", |settings| settings.exposure_ev = (to * 10.0).round() / 10.0);
    }
    let reason = "These do nothing to a spectral image.";
    unless_image(ui, reason, context, |ui, context| lens_and_quality(ui, &settings, context));
    without_picture(ui, context);
}

/// Lens, accuracy of the integrals, and the initial view.
fn lens_and_quality(ui: &mut Ui, settings: &RenderSettings, context: &mut PaneContext<'_>) {
    let orbit = context.view.saved.render.orbit.unwrap_or_else(|| Orbit::of(&settings.mesh));
    let hint = "Of the lens; the viewpoint moves so that the mesh keeps its size. Wide lenses fall off with cos⁴ (Eq \
                12).";
    let dial = Dial {
        name: "Field of view",
        range: 2.0..=120.0,
        logarithmic: None,
        unit: "°",
        hint,
        beyond: false,
        enabled: true,
    };
    if let Some(to) = dial.show(ui, orbit.field_of_view_deg, context) {
        context.view.saved.render.orbit = Some(orbit.with_field_of_view(to));
        ui.ctx().request_repaint();
    }
    let now = settings.quality;
    let hint = "Accuracy of integrals over wavelength at rest";
    let words = |quality: QualityLevel| [quality.label(), ""];
    if let Some(to) = choices(ui, ("Quality", hint), (&QualityLevel::ALL, now), words, context) {
        set(context, "Quality", |settings| settings.quality = to);
    }
    caption(ui, "Tolerance", context);
    ui.add_enabled_ui(now == QualityLevel::Tolerance, |ui| tolerance(ui, settings, context));
    if ui.button("Reset view").on_hover_text("Initial view of the mesh (Home)").clicked() {
        context.view.saved.render.orbit = None;
        ui.ctx().request_repaint();
    }
}

fn tolerance(ui: &mut Ui, settings: &RenderSettings, context: &mut PaneContext<'_>) {
    let hint = "Largest error of a picture, relative to its brightest sample, with the quality Within a tolerance. The \
                Numerics workspace shows the method for each camera.";
    let id = ui.make_persistent_id("tolerance field");
    if let Some(to) = widgets::tolerance::field(ui, id, settings.tolerance, "", hint, context) {
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
