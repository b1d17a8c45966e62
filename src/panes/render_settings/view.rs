//! Exposure, lens and quality.

use egui::{ComboBox, RichText, Ui};

use super::{Dial, set, unless_image};

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
    let dial = Dial { name: "Exposure", range: -6.0..=6.0, logarithmic: None, unit: " EV", hint, beyond: false };
    if let Some(to) = dial.show(ui, settings.exposure_ev) {
        set(context, "Exposure", |settings| settings.exposure_ev = (to * 10.0).round() / 10.0);
    }
    let reason = "Field of view and quality do nothing to a spectral image.";
    unless_image(ui, reason, context, |ui, context| lens_and_quality(ui, &settings, context));
    without_picture(ui, context);
}

/// Lens, accuracy of the integrals, and the initial view.
fn lens_and_quality(ui: &mut Ui, settings: &RenderSettings, context: &mut PaneContext<'_>) {
    let orbit = context.view.saved.render.orbit.unwrap_or_else(|| Orbit::of(&settings.mesh));
    let hint = "Of the lens; the viewpoint moves so that the mesh keeps its size. Wide lenses fall off with cos⁴ (Eq \
                12).";
    let dial = Dial { name: "Field of view", range: 2.0..=120.0, logarithmic: None, unit: "°", hint, beyond: false };
    if let Some(to) = dial.show(ui, orbit.field_of_view_deg) {
        context.view.saved.render.orbit = Some(orbit.with_field_of_view(to));
        ui.ctx().request_repaint();
    }
    ui.horizontal(|ui| {
        let now = settings.quality;
        let combo = ComboBox::from_id_salt("quality").width(150.0).selected_text(now.label());
        let response = combo.show_ui(ui, |ui| {
            for quality in QualityLevel::ALL {
                if ui.selectable_label(now == quality, quality.label()).clicked() {
                    set(context, "Quality", |settings| settings.quality = quality);
                }
            }
        });
        let said = format!("Quality: {}", now.label());
        response.response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::ComboBox, true, &said));
        response.response.on_hover_text("Accuracy of integrals over wavelength at rest");
        ui.label("Quality");
        if ui.button("Reset").on_hover_text("Initial view of the mesh (Home)").clicked() {
            context.view.saved.render.orbit = None;
            ui.ctx().request_repaint();
        }
    });
    if settings.quality == QualityLevel::Tolerance {
        let hint = "Largest error of a picture, relative to its brightest sample. The Numerics workspace shows the method \
             for each camera.";
        let id = ui.make_persistent_id("tolerance field");
        if let Some(to) = widgets::tolerance::field(ui, id, settings.tolerance, "Tolerance", hint, context) {
            set(context, "Tolerance", |settings| settings.tolerance = to);
        }
    }
}

/// Lists the compared sensors that have no picture.
fn without_picture(ui: &mut Ui, context: &PaneContext<'_>) {
    let rendered = context.scene.rendered_sources();
    let skipped_work = context.scene.sources().into_iter().filter(|source| source.visible);
    let skipped_work =
        skipped_work.filter(|source| !rendered.iter().any(|r| (r.kind, &r.name) == (source.kind, &source.name)));
    let names: Vec<String> = skipped_work.map(|source| source.label).collect();
    if !names.is_empty() {
        let words = format!("No picture: {}", names.join(", "));
        ui.label(RichText::new(words).small().color(context.theme.weak)).on_hover_text(
            "Eq 13 takes the signals of cameras and of Stiles & Burch; with a fitted color transform all have pictures.",
        );
    }
}
