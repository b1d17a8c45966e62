//! Mesh, material and garment: settings that are sets or files. Roughness and refractive index, the choices of the reflectance
//! model, and its limits.

use std::path::PathBuf;

use chromascope_core::query::render::Roughness;
use chromascope_core::reflectance::{Caution, Normalization};
use egui::{RichText, Ui};

use super::{caption, controls, line, list, set};
use crate::catalog::Entry;
use crate::catalog::meshes::{MeshState, is_mesh};
use crate::catalog::spectral_images::{ImageState, has_image_ending};
use crate::command::Command;
use crate::document::SetKind;
use crate::document::render::settings::{IMAGE, SURFACE};
use crate::document::render::{LEAF, MeshChoice, RenderSettings, SKIN};
use crate::figures::render::returned;
use crate::format::{capitalized, file_name};
use crate::panes::context::PaneContext;
use crate::panes::widgets::facts;
use crate::panes::widgets::pick_list::{self, Line};

/// The control of a setting that is a set or a file.
pub(super) fn own(ui: &mut Ui, key: &str, is_enabled: bool, context: &mut PaneContext<'_>) {
    match key {
        "mesh" => {
            let settings = context.scene.document.render.clone();
            mesh(ui, &settings, context);
            summary(ui, &settings, context);
            image(ui, &settings, context);
        }
        "garment" => {
            let is_head = context.scene.document.render.mesh == MeshChoice::Head;
            caption(ui, if is_head { "Garment" } else { "Garment: only the head has one" }, context);
            ui.add_enabled_ui(is_enabled, |ui| material(ui, Part::Garment, context));
        }
        _ => {
            caption(ui, "Material", context);
            material(ui, Part::Skin, context);
        }
    }
}

/// Facts and settings of a spectral image in place of a mesh.
fn image(ui: &mut Ui, settings: &RenderSettings, context: &mut PaneContext<'_>) {
    let MeshChoice::Image(path) = &settings.mesh else { return };
    if let ImageState::Ready(image) = context.images.get(path) {
        let words = RichText::new(&image.summary).small().color(context.theme.weak);
        ui.label(words).on_hover_text(image.message());
    }
    controls(ui, IMAGE, context);
}

fn mesh(ui: &mut Ui, settings: &RenderSettings, context: &mut PaneContext<'_>) {
    let shown = match &settings.mesh {
        MeshChoice::File(path) | MeshChoice::Image(path) => file_name(path),
        own => capitalized(&own.name()),
    };
    let own = [MeshChoice::Head, MeshChoice::Fern, MeshChoice::Sphere, MeshChoice::Plane];
    let recent = context.view.saved.recent.iter().filter(|path| is_mesh(path, &[]) || has_image_ending(path));
    let recent: Vec<PathBuf> = recent.cloned().collect();
    let chosen = list(ui, "Mesh", [&shown, "What is rendered"], context, || {
        let mesh = |mesh: &MeshChoice| Line::new(capitalized(&mesh.name()), settings.mesh == *mesh);
        let file = |path: &PathBuf| {
            let here = [MeshChoice::File(path.clone()), MeshChoice::Image(path.clone())].contains(&settings.mesh);
            Line { facts: path.display().to_string(), ..Line::new(file_name(path), here) }
        };
        let hint = "OBJ, PLY or STL, or a spectral image (ENVI, OpenEXR); or drop it on the window";
        let open = Line { facts: hint.to_owned(), ..Line::new("Open mesh or image…", false) };
        own.iter().map(mesh).chain(recent.iter().map(file)).chain([open]).collect()
    });
    let Some(index) = chosen else { return };
    let path = index.checked_sub(own.len()).and_then(|index| recent.get(index)).cloned();
    match (own.into_iter().nth(index), path) {
        (Some(mesh), _) => set(context, "Mesh", |settings| settings.take(mesh)),
        (None, Some(path)) => context.push(Command::OpenPath(path)),
        (None, None) => context.push(Command::Open),
    }
}

/// Notes on the mesh file that was read: one line, empty for the program's own meshes.
fn summary(ui: &mut Ui, settings: &RenderSettings, context: &PaneContext<'_>) {
    let ready = match &settings.mesh {
        MeshChoice::File(path) => match context.meshes.get(path) {
            MeshState::Ready(mesh) => Some(mesh),
            MeshState::Loading | MeshState::Failed(_) => None,
        },
        _ => None,
    };
    let [words, notes] =
        ready.map_or_else(<[String; 2]>::default, |mesh| [mesh.summary.clone(), mesh.notes.join("\n")]);
    line(ui, &words, if notes.is_empty() { &words } else { &notes }, context.theme.weak);
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Part {
    Skin,
    Garment,
}

/// The head without a garment.
const BARE: &str = "None: bare shoulders";

/// A list of all reflectances that is filtered as one types: the user's own, then the built-in ones by file.
fn material(ui: &mut Ui, part: Part, context: &mut PaneContext<'_>) {
    let mut names = Vec::new();
    let width = ui.available_width();
    let settings = &context.scene.document.render;
    let (what, hint, now) = match part {
        Part::Skin => ("Material", "Reflectance of the surface", settings.material.clone()),
        Part::Garment => {
            let hint = "Reflectance of the head's garment, which scatters evenly. Figures 8 and 9 have none.";
            ("Garment", hint, settings.garment.clone().unwrap_or_else(|| BARE.to_owned()))
        }
    };
    let chosen = pick_list::drop_down(ui, (what, hint), &now, width, &context.theme, || {
        let own = context.scene.entries(SetKind::Chart).filter(Entry::is_own);
        let mut entries: Vec<Entry> = own.chain(context.scene.entries(SetKind::Material)).collect();
        entries.sort_by_cached_key(|entry| (!entry.is_own(), entry.also.clone()));
        let mut lines: Vec<Line> = Vec::new();
        let mut last = None;
        if part == Part::Garment {
            lines.push(Line::new(BARE, now == BARE));
            names.push(BARE.to_owned());
        }
        for entry in entries {
            let facts = facts::provenance(&context.scene, &entry);
            let Entry { name, short, also, .. } = entry;
            let group = also.unwrap_or_else(|| "Others".to_owned());
            if last.as_ref() != Some(&group) {
                lines.push(Line::heading(&group));
                names.push(String::new());
            }
            lines.push(Line { also: format!("{short} {group}"), facts, ..Line::new(&name, name == now) });
            names.push(name);
            last = Some(group);
        }
        lines
    });
    if let Some(name) = chosen.map(|index| names.swap_remove(index)) {
        set(context, what, |settings| match part {
            Part::Skin => settings.material = name,
            Part::Garment => settings.garment = (name != BARE).then_some(name),
        });
    }
}

pub(super) fn surface(ui: &mut Ui, context: &mut PaneContext<'_>) {
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
