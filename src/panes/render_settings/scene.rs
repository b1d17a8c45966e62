//! Mesh, material, and where the light is.

use std::path::PathBuf;

use chromascope_core::scene::lighting::SUN_RADIUS;
use chromascope_mesh::head::FEWEST;
use egui::Ui;

use super::{Dial, caption, line, list, material, set, unless_image};
use crate::catalog::meshes::{MeshState, is_mesh};
use crate::catalog::spectral_images::has_image_ending;
use crate::command::Command;
use crate::document::render::{MeshChoice, NEAR, RenderSettings};
use crate::format::{capitalized, file_name};
use crate::panes::context::PaneContext;
use crate::panes::widgets::{self, pick_list::Line};

/// Choices of the number of triangles.
const TRIANGLES: std::ops::RangeInclusive<f64> = 2e3..=2e6;

/// Shows the group.
pub(super) fn show(ui: &mut Ui, context: &mut PaneContext<'_>) {
    let settings = context.scene.document.render.clone();
    mesh(ui, &settings, context);
    summary(ui, &settings, context);
    super::image::show(ui, context);
    let reason = "These do nothing to a spectral image.";
    unless_image(ui, reason, context, |ui, context| of_mesh(ui, &settings, context));
}

/// Controls of a mesh: its triangles, material and light.
fn of_mesh(ui: &mut Ui, settings: &RenderSettings, context: &mut PaneContext<'_>) {
    // The head's cages have so many that a smaller number would change nothing. The slider has one range for all meshes: equal
    // numbers have equal places.
    let is_head = settings.mesh == MeshChoice::Head;
    let least = if is_head { FEWEST[usize::from(settings.garment.is_some())] as f64 } else { *TRIANGLES.start() };
    let dial = Dial {
        name: "Triangles",
        range: TRIANGLES,
        logarithmic: Some(1.0),
        unit: "",
        hint: "Approximate number of triangles of head, fern and sphere. Generating a mesh takes longer than drawing it.",
        beyond: false,
        enabled: matches!(settings.mesh, MeshChoice::Head | MeshChoice::Fern | MeshChoice::Sphere),
    };
    if let Some(to) = dial.show(ui, (settings.triangles as f64).max(least), context) {
        set(context, "Triangles", |settings| settings.triangles = to.max(least) as usize);
    }
    caption(ui, "Material", context);
    material::choice(ui, material::Part::Skin, context);
    let words = if is_head { "Garment" } else { "Garment: only the head has one" };
    caption(ui, words, context);
    ui.add_enabled_ui(is_head, |ui| material::choice(ui, material::Part::Garment, context));
    conditions(ui, settings, context);
    light(ui, settings, context);
}

/// The rendered scene's light and white: the sun, or those of the scene bar.
fn conditions(ui: &mut Ui, settings: &RenderSettings, context: &mut PaneContext<'_>) {
    caption(ui, "Light and white balance", context);
    ui.horizontal(|ui| {
        let choices = [
            (true, "Sun, D55", "Direct sun (ASTM G173), balanced to D55, in this workspace alone"),
            (
                false,
                "As above",
                "The light and white balance of all workspaces; choosing one above while pictures are visible chooses this too",
            ),
        ];
        if let Some(to) = widgets::segmented(ui, &choices, settings.sunlight) {
            set(context, "Light and white balance", |settings| settings.sunlight = to);
        }
    });
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

fn light(ui: &mut Ui, settings: &RenderSettings, context: &mut PaneContext<'_>) {
    let angle = |name, to: f64, hint| Dial {
        name,
        range: -to..=to,
        logarithmic: None,
        unit: "°",
        hint,
        beyond: false,
        enabled: true,
    };
    let hint = "Elevation of the light above the view axis; it moves with the viewpoint.";
    if let Some(to) = angle("Light elevation", 90.0, hint).show(ui, settings.light_up_deg, context) {
        set(context, "Light elevation", |settings| settings.light_up_deg = to.round());
    }
    let hint = "Azimuth of the light to the right of the view axis; negative is left, beyond 90° is behind.";
    if let Some(to) = angle("Light azimuth", 180.0, hint).show(ui, settings.light_right_deg, context) {
        set(context, "Light azimuth", |settings| settings.light_right_deg = to.round());
    }
    let hint = "Uniform sky above the horizon, of the light's spectrum: irradiance of a level surface over that of a \
                surface that faces the light. About 15 % on a clear day. Figures 8 and 9 have none.";
    let sky = Dial { range: 0.0..=100.0, unit: " %", ..angle("Sky", 0.0, hint) };
    if let Some(to) = sky.show(ui, 100.0 * settings.sky, context) {
        set(context, "Sky", |settings| settings.sky = to.round() / 100.0);
    }
    switches(ui, settings, context);
    let hint = "Of a point light from the center, in radii of the mesh";
    let enabled = settings.light_distance.is_some();
    let dial =
        Dial { range: 1.1..=100.0, logarithmic: Some(1.0), unit: "", enabled, ..angle("Light distance", 0.0, hint) };
    if let Some(to) = dial.show(ui, settings.light_distance.unwrap_or(NEAR), context).filter(|_| enabled) {
        set(context, "Light distance", |settings| settings.light_distance = Some(to));
    }
}

/// Shadows, the Sun's disk, a point light, and light through leaves.
fn switches(ui: &mut Ui, settings: &RenderSettings, context: &mut PaneContext<'_>) {
    ui.horizontal(|ui| {
        let mut shadows = settings.shadows;
        if ui.checkbox(&mut shadows, "Shadows").on_hover_text("Self-shadowing of the mesh").changed() {
            set(context, "Shadows", |settings| settings.shadows = shadows);
        }
        let mut disk = settings.light_radius > 0.0;
        let hint =
            "A light as wide as the Sun softens the edges of shadows and blurs the specular lobe; a point does not.";
        if ui.checkbox(&mut disk, "Sun's disk").on_hover_text(hint).changed() {
            set(context, "Sun's disk", |settings| settings.light_radius = if disk { SUN_RADIUS } else { 0.0 });
        }
        let mut near = settings.light_distance.is_some();
        let hint = "Point light at a finite distance instead of parallel rays; no inverse-square falloff";
        if ui.checkbox(&mut near, "Point light").on_hover_text(hint).changed() {
            set(context, "Point light", |settings| settings.light_distance = near.then_some(NEAR));
        }
    });
    let mut thin = settings.thin;
    let hint = "Light also passes through, as through a leaf: its transmittance from the material's reflectance by the \
                plate model (PROSPECT: 1.5 plates of index 1.45), alike in all directions";
    if ui.checkbox(&mut thin, "Light through leaves").on_hover_text(hint).changed() {
        set(context, "Light through leaves", |settings| settings.thin = thin);
    }
}
