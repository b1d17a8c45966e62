//! Roughness and refractive index, the choices of the reflectance model, and its limits.

use chromascope_core::query::render::Roughness;
use chromascope_core::reflectance::{Caution, Normalization};
use egui::Ui;

use super::{controls, line, set};
use crate::document::render::settings::SURFACE;
use crate::document::render::{LEAF, RenderSettings, SKIN};
use crate::figures::render::returned;
use crate::panes::context::PaneContext;

pub(super) fn show(ui: &mut Ui, context: &mut PaneContext<'_>) {
    let settings = context.scene.document.render.clone();
    ui.add_enabled_ui(!settings.mesh.is_image(), |ui| presets(ui, context));
    controls(ui, SURFACE, context);
    ui.add_enabled_ui(!settings.mesh.is_image(), |ui| {
        returned_light(ui, &settings, context);
        cautions(ui, &settings, context);
    });
}

/// The share of light that the surface returns; where that is more than came, in the color of a warning.
fn returned_light(ui: &mut Ui, settings: &RenderSettings, context: &PaneContext<'_>) {
    let words = returned::words(&context.scene);
    let (text, is_warning) = words.map_or((String::new(), false), |words| (words.text, words.is_warning));
    let color = if is_warning { context.theme.warning } else { context.theme.weak };
    line(ui, &text, &format!("{text}. {}", returned::meaning(settings.normalization)), color);
}

fn presets(ui: &mut Ui, context: &mut PaneContext<'_>) {
    ui.horizontal(|ui| {
        let rough = RenderSettings::default();
        for (name, material, index, sigma_um, hint) in [
            (
                "Skin",
                SKIN,
                1.40,
                rough.sigma_um,
                "σ 5 µm, τ 10 µm, n 1.40. RMS slope 0.7, above the model's limit of 0.4: brightness by angle is approximate",
            ),
            (
                "Leaf",
                LEAF,
                1.45,
                rough.sigma_um,
                "σ 5 µm, τ 10 µm, n 1.45. RMS slope 0.7, above the model's limit of 0.4: brightness by angle is approximate",
            ),
            (
                "Smooth",
                "",
                1.50,
                0.05,
                "σ 0.05 µm, τ 10 µm, n 1.50: a glossy surface, dark except for highlights; the material is unchanged",
            ),
        ] {
            if ui.button(name).on_hover_text(hint).clicked() {
                let tau_um = rough.tau_um;
                set(context, name, |settings| {
                    if !material.is_empty() {
                        material.clone_into(&mut settings.material);
                    }
                    (settings.index, settings.sigma_um, settings.tau_um) = (index, sigma_um, tau_um);
                });
            }
        }
    });
}

/// Limits of the model that the surface exceeds: the first in one line that is always there, all of them on hover.
fn cautions(ui: &mut Ui, settings: &RenderSettings, context: &PaneContext<'_>) {
    let said = cautions_of(settings);
    let is_error = settings.surface().is_err();
    let color = if is_error { context.theme.error } else { context.theme.warning };
    let more = if said.len() > 1 { format!(" (+{})", said.len() - 1) } else { String::new() };
    let words = said.first().map_or_else(String::new, |[words, _]| format!("{words}{more}"));
    let all: Vec<&str> = said.iter().map(|[_, whole]| whole.as_str()).collect();
    line(ui, &words, &all.join("\n\n"), color);
}

/// Limits in a few words and in full.
fn cautions_of(settings: &RenderSettings) -> Vec<[String; 2]> {
    if settings.normalization == Normalization::Lambertian {
        return Vec::new();
    }
    if settings.roughness == Roughness::Mesh {
        let words = "Lengths of the mesh: dark except for a narrow lobe".to_owned();
        return vec![[words, Roughness::Mesh.why().to_owned()]];
    }
    let surface = match settings.surface() {
        Ok(surface) => surface,
        Err(error) => return vec![[error.to_string(), error.to_string()]],
    };
    let mut said = Vec::new();
    if is_nearly_a_mirror(settings) {
        let whole = "Nearly specular: most light is in the highlight, which determines exposure; everything else is \
                     dark. A small highlight may fall between pixels.";
        said.push(["Nearly specular: dark except for the highlight".to_owned(), whole.to_owned()]);
    }
    for caution in surface.cautions() {
        let words = if caution == Caution::Steep {
            format!("Slope {:.1}, model good to 0.4: brightness by angle is approximate", surface.slope())
        } else {
            caution.brief().to_owned()
        };
        said.push([words, format!("{caution}.")]);
    }
    said
}

/// True if most of the light is reflected specularly at normal incidence, at 550 nm.
fn is_nearly_a_mirror(settings: &RenderSettings) -> bool {
    let phase = 4.0 * std::f64::consts::PI * settings.sigma_um / 0.55;
    settings.roughness == Roughness::Surface && (-phase * phase).exp() > 0.01
}
