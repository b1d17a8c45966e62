//! Mesh, material, and where the light is.

use chromascope_core::scene::lighting::SUN_RADIUS;
use chromascope_mesh::head::FEWEST;
use egui::{ComboBox, Ui};

use super::{Dial, caption, material, set, unless_image};
use crate::catalog::meshes::{MeshState, is_mesh};
use crate::catalog::spectral_images::has_image_ending;
use crate::command::Command;
use crate::document::render::{MeshChoice, NEAR, RenderSettings};
use crate::panes::context::PaneContext;

/// Choices of the number of triangles.
const TRIANGLES: std::ops::RangeInclusive<f64> = 2e3..=2e6;

/// Shows the group.
pub(super) fn show(ui: &mut Ui, context: &mut PaneContext<'_>) {
    let settings = context.scene.document.render.clone();
    ui.horizontal(|ui| {
        mesh(ui, &settings, context);
        ui.label("Mesh");
    });
    summary(ui, &settings, context);
    super::image::show(ui, context);
    let reason = "Triangles, material and light direction do nothing to a spectral image.";
    unless_image(ui, reason, context, |ui, context| of_mesh(ui, &settings, context));
}

/// Controls of a mesh: its triangles, material and light.
fn of_mesh(ui: &mut Ui, settings: &RenderSettings, context: &mut PaneContext<'_>) {
    if matches!(settings.mesh, MeshChoice::Head | MeshChoice::Fern | MeshChoice::Sphere) {
        // The head's mesh has a minimum number of triangles.
        let least = if settings.mesh == MeshChoice::Head { FEWEST as f64 } else { *TRIANGLES.start() };
        let dial = Dial {
            name: "Triangles",
            range: least..=*TRIANGLES.end(),
            logarithmic: Some(1.0),
            unit: "",
            hint: "Approximate number of triangles. Generating a mesh takes longer than drawing it.",
            beyond: false,
        };
        if let Some(to) = dial.show(ui, (settings.triangles as f64).max(least)) {
            set(context, "Triangles", |settings| settings.triangles = to as usize);
        }
    }
    caption(ui, "Material", context);
    material::choice(ui, &settings.material, context);
    light(ui, settings, context);
}

fn mesh(ui: &mut Ui, settings: &RenderSettings, context: &mut PaneContext<'_>) {
    let shown = match &settings.mesh {
        MeshChoice::Head => "Head".to_owned(),
        MeshChoice::Fern => "Fern".to_owned(),
        MeshChoice::Sphere => "Sphere".to_owned(),
        MeshChoice::Plane => "Plane".to_owned(),
        MeshChoice::File(path) | MeshChoice::Image(path) => {
            path.file_name().unwrap_or(path.as_os_str()).to_string_lossy().into_owned()
        }
    };
    let combo = ComboBox::from_id_salt("mesh").width(150.0).truncate().selected_text(&shown);
    let response = combo.show_ui(ui, |ui| {
        for (choice, words) in [
            (MeshChoice::Head, "Head"),
            (MeshChoice::Fern, "Fern"),
            (MeshChoice::Sphere, "Sphere"),
            (MeshChoice::Plane, "Plane"),
        ] {
            if ui.selectable_label(settings.mesh == choice, words).clicked() {
                set(context, "Mesh", |settings| settings.mesh = choice);
            }
        }
        ui.separator();
        let recent = context.view.saved.recent.clone();
        for path in recent.into_iter().filter(|path| is_mesh(path, &[]) || has_image_ending(path)) {
            let name = path.file_name().unwrap_or(path.as_os_str()).to_string_lossy().into_owned();
            let here = [MeshChoice::File(path.clone()), MeshChoice::Image(path.clone())].contains(&settings.mesh);
            if ui.selectable_label(here, name).on_hover_text(path.display().to_string()).clicked() {
                context.push(Command::OpenPath(path));
            }
        }
        let hint = "OBJ, PLY or STL, or a spectral image (ENVI, OpenEXR); or drop it on the window";
        if ui.selectable_label(false, "Open mesh or image…").on_hover_text(hint).clicked() {
            context.push(Command::Open);
        }
    });
    response.response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::ComboBox, true, format!("Mesh: {shown}")));
}

/// Notes on the mesh file that was read.
fn summary(ui: &mut Ui, settings: &RenderSettings, context: &PaneContext<'_>) {
    if let MeshChoice::File(path) = &settings.mesh
        && let MeshState::Ready(mesh) = context.meshes.get(path)
    {
        let words = egui::RichText::new(&mesh.summary).small().color(context.theme.weak);
        ui.label(words).on_hover_text(mesh.notes.join("\n"));
    }
}

fn light(ui: &mut Ui, settings: &RenderSettings, context: &mut PaneContext<'_>) {
    let angle =
        |name, to: f64, hint| Dial { name, range: -to..=to, logarithmic: None, unit: "°", hint, beyond: false };
    let height = angle(
        "Light elevation",
        90.0,
        "Elevation of the light above the view axis; it moves with the \
                                              viewpoint.",
    );
    if let Some(to) = height.show(ui, settings.light_up_deg) {
        set(context, "Light elevation", |settings| settings.light_up_deg = to.round());
    }
    let side = angle(
        "Light azimuth",
        180.0,
        "Azimuth of the light to the right of the view axis; negative is left, beyond 90° \
                                    is behind.",
    );
    if let Some(to) = side.show(ui, settings.light_right_deg) {
        set(context, "Light azimuth", |settings| settings.light_right_deg = to.round());
    }
    ui.horizontal(|ui| {
        let mut shadows = settings.shadows;
        if ui.checkbox(&mut shadows, "Shadows").on_hover_text("Self-shadowing of the mesh").changed() {
            set(context, "Shadows", |settings| settings.shadows = shadows);
        }
        let mut disk = settings.light_radius > 0.0;
        let hint =
            "A light as wide as the Sun blurs the specular lobe; a point does not. Only smooth surfaces show it.";
        if ui.checkbox(&mut disk, "Sun's disk").on_hover_text(hint).changed() {
            set(context, "Sun's disk", |settings| settings.light_radius = if disk { SUN_RADIUS } else { 0.0 });
        }
        let mut near = settings.light_distance.is_some();
        let hint = "Point light at a finite distance instead of parallel rays; no inverse-square falloff";
        if ui.checkbox(&mut near, "Point light").on_hover_text(hint).changed() {
            set(context, "Point light", |settings| settings.light_distance = near.then_some(NEAR));
        }
    });
    if let Some(distance) = settings.light_distance {
        let hint = "From the center, in radii of the mesh";
        let range = 1.1..=100.0;
        let dial = Dial { name: "Light distance", range, logarithmic: Some(1.0), unit: "", hint, beyond: false };
        if let Some(to) = dial.show(ui, distance) {
            set(context, "Light distance", |settings| settings.light_distance = Some(to));
        }
    }
}
