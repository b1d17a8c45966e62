//! Roughness and refractive index, the choices of the reflectance model, and its limits.

use chromascope_core::reflectance::Caution;
use egui::Ui;

use super::{Dial, SLIDER, VALUE, caption, choices, line, set};
use crate::document::render::model::{AreaChoice, SpecularChoice};
use crate::document::render::{LEAF, ReadingChoice, RenderSettings, RoughnessChoice, SKIN};
use crate::figures::render::returned;
use crate::panes::context::PaneContext;
use crate::theme::UNIT;

/// Shows the group.
pub(super) fn show(ui: &mut Ui, context: &mut PaneContext<'_>) {
    let settings = context.scene.document.render.clone();
    presets(ui, context);
    lengths(ui, &settings, context);
    let hint = "The refractive index, the same at all wavelengths; type up to 1000.";
    let dial =
        Dial { name: "Index n", range: 1.0..=3.0, logarithmic: None, unit: "", hint, beyond: true, enabled: true };
    if let Some(to) = dial.show(ui, settings.index, context) {
        set(context, "Refractive index", |settings| settings.index = to.clamp(0.01, 1000.0));
    }
    area(ui, &settings, context);
    reading(ui, settings.reading, context);
    line(ui, settings.reading.consequence(), settings.reading.why(), context.theme.weak);
    ui.add_enabled_ui(settings.reading != ReadingChoice::Lambertian, |ui| specular(ui, settings.specular, context));
    returned_light(ui, &settings, context);
    cautions(ui, &settings, context);
}

/// The area A given by the half-widths.
fn area(ui: &mut Ui, settings: &RenderSettings, context: &mut PaneContext<'_>) {
    ui.horizontal(|ui| {
        for choice in AreaChoice::ALL {
            if ui.radio(settings.area == choice, choice.label()).on_hover_text(choice.why()).clicked() {
                set(context, "Illuminated area", |settings| settings.area = choice);
            }
        }
    });
}

/// The reflectance factor of the coherent component.
fn specular(ui: &mut Ui, now: SpecularChoice, context: &mut PaneContext<'_>) {
    let words = |choice: SpecularChoice| [choice.label(), choice.why()];
    let all = (SpecularChoice::ALL.as_slice(), now);
    if let Some(to) = choices(ui, ("Coherent component", now.why()), all, words, context) {
        set(context, "Coherent component", |settings| settings.specular = to);
    }
}

/// The share of light that the surface returns; where that is more than came, in the color of a warning.
fn returned_light(ui: &mut Ui, settings: &RenderSettings, context: &PaneContext<'_>) {
    let words = returned::words(&context.scene);
    let (text, is_warning) = words.map_or((String::new(), false), |words| (words.text, words.is_warning));
    let color = if is_warning { context.theme.warning } else { context.theme.weak };
    line(ui, &text, &format!("{text}. {}", returned::meaning(settings.reading)), color);
}

/// Surfaces to begin with.
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

fn lengths(ui: &mut Ui, settings: &RenderSettings, context: &mut PaneContext<'_>) {
    let length = |name, from, least, hint| Dial {
        name,
        range: from..=1000.0,
        logarithmic: Some(least),
        unit: " µm",
        hint,
        beyond: true,
        enabled: true,
    };
    let sigma = length("Roughness σ", 0.0, 0.01, "RMS roughness; type up to 1e6, a meter");
    if let Some(to) = sigma.show(ui, settings.sigma_um, context) {
        set(context, "Roughness", |settings| settings.sigma_um = to.clamp(0.0, 1e6));
    }
    let from_mesh = settings.roughness == RoughnessChoice::Mesh;
    let mut wanted = from_mesh;
    let said =
        ui.checkbox(&mut wanted, "σ and τ from the mesh, as in the paper").on_hover_text(RoughnessChoice::WHY_NOT);
    if said.changed() {
        let to = if wanted { RoughnessChoice::Mesh } else { RoughnessChoice::Surface };
        set(context, "Roughness from the mesh", |settings| settings.roughness = to);
    }
    let tau = length(
        "Correlation τ",
        0.001,
        0.001,
        "Correlation length: lag at which the height autocorrelation falls to 1/e",
    );
    if let Some(to) = tau.show(ui, settings.tau_um, context) {
        set(context, "Correlation length", |settings| settings.tau_um = to.clamp(0.001, 1e6));
    }
    caption(ui, "Half-widths of the coherently illuminated area", context);
    ui.horizontal(|ui| {
        for (axis, name, hint) in [
            (0, "X", "Half-width of the coherently illuminated area, in the plane of incidence"),
            (1, "Y", "Half-width of the coherently illuminated area, across the plane of incidence"),
        ] {
            let mut value = settings.half_sides_um[axis];
            let field = egui::DragValue::new(&mut value)
                .range(0.001..=1e6)
                .speed(0.01 * settings.half_sides_um[axis])
                .max_decimals(3)
                .suffix(" µm");
            let response = ui.add_sized([VALUE + 2.0 * UNIT, SLIDER], field);
            ui.label(name).on_hover_text(hint);
            response.widget_info(|| egui::WidgetInfo::slider(true, value, format!("Half-width {name}")));
            if response.on_hover_text(hint).changed() {
                set(context, "Half-widths", |settings| settings.half_sides_um[axis] = value);
            }
        }
    });
}

fn reading(ui: &mut Ui, now: ReadingChoice, context: &mut PaneContext<'_>) {
    let words = |reading: ReadingChoice| [reading.label(), reading.why()];
    let all = (ReadingChoice::ALL.as_slice(), now);
    if let Some(to) = choices(ui, ("Normalization", now.why()), all, words, context) {
        set(context, "Normalization", |settings| settings.reading = to);
    }
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
    if settings.reading == ReadingChoice::Lambertian {
        return Vec::new();
    }
    if settings.roughness == RoughnessChoice::Mesh {
        let words = "Lengths of the mesh: dark except for a narrow lobe".to_owned();
        return vec![[words, RoughnessChoice::WHY_NOT.to_owned()]];
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
    settings.roughness == RoughnessChoice::Surface && (-phase * phase).exp() > 0.01
}
