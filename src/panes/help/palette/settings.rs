//! Settings of the scene, the view and the render, as they are found.

use chromascope_core::correction::CorrectionMethod;
use chromascope_core::render::QualityLevel;
use chromascope_core::scene::lighting::SUN_RADIUS;

use super::Found;
use crate::action::{Action, CompareAction, RenderAction, SceneAction};
use crate::catalog::Entry;
use crate::command::{Command, THEMES};
use crate::document::correction::CorrectionChoice;
use crate::document::render::model::{AreaChoice, SpecularChoice};
use crate::document::render::{GARMENT, MeshChoice, NEAR, ReadingChoice, RenderSettings, RoughnessChoice};
use crate::document::{Diagram, Light, SetKind, Subset, TransformChoice, WhiteBalanceChoice};
use crate::panes::PaneContext;
use crate::panes::widgets::pixel::PIXEL;
use crate::theme::Surround;
use crate::view::render::RenderMode;
use crate::view::{DiagramFit, SpectraLayout, SwatchLayout, SwatchStyle, ViewChoice};
use crate::workspaces::PaneKind;

const SETTINGS: &str = "Settings";
const RENDER: &str = "Render";

/// Sliders of the render settings by name, with other words for them.
const SLIDERS: [(&str, &str); 10] = [
    ("Roughness σ", "RMS sigma surface"),
    ("Correlation τ", "length tau surface"),
    ("Index n", "refractive Fresnel surface"),
    ("Light elevation", "direction height sun"),
    ("Light azimuth", "direction side sun"),
    ("Light distance", "near point light"),
    ("Sky", "skylight ambient hemisphere"),
    ("Exposure", "EV brightness"),
    ("Field of view", "lens angle zoom"),
    ("Triangles", "mesh resolution"),
];

/// Conditions of the scene bar, and the diagram's elements.
pub(super) fn scene(context: &PaneContext<'_>) -> Vec<Found> {
    let document = context.scene.document;
    let set = |words: String, action: SceneAction, on: bool| Found::new(SETTINGS, words, Action::Scene(action)).on(on);
    let mut found = Vec::new();
    for (diagram, words, also) in [
        (Diagram::Xy, "Diagram: xy", "CIE 1931 chromaticity"),
        (Diagram::UvPrime, "Diagram: u′v′", "uv CIE 1976 chromaticity"),
    ] {
        let line = set(words.to_owned(), SceneAction::SetDiagram(diagram), document.diagram == diagram);
        found.push(line.also(also));
    }
    let mut overlays = document.overlays;
    let count = overlays.labeled().len();
    for index in 0..count {
        let mut changed = document.overlays;
        let (on, words) = &mut changed.labeled()[index];
        let (now, words) = (**on, *words);
        **on = !now;
        found.push(set(format!("Show {words}"), SceneAction::SetOverlays(changed), now).also("diagram element"));
    }
    for (subset, words) in [(Subset::Five, "Patches: the paper's five"), (Subset::All, "Patches: all of the chart")] {
        if context.scene.has_five() {
            found.push(set(words.to_owned(), SceneAction::SetSubset(subset), document.subset == subset));
        }
    }
    for metric in document.transform.metrics() {
        let words = format!("Difference: {}", metric.name(document.transform.is_eq_13()));
        let on = document.difference == metric;
        found.push(
            set(words, SceneAction::SetDifference(metric), on).also(format!("delta E {} {}", metric.id, metric.label)),
        );
    }
    for (light, words) in [(Light::BlackBody, "Light: blackbody"), (Light::Daylight, "Light: daylight")] {
        let on = document.light == light;
        found
            .push(set(words.to_owned(), SceneAction::SetLight(light), on).note("at the temperature").also("Planckian"));
    }
    if !document.filters.is_empty() {
        found.push(set("Remove filters".to_owned(), SceneAction::ClearFilters, false));
    }
    let pixel = Found::new(SETTINGS, "Pixel: full well and read noise", Command::Seek(PaneKind::METRICS, PIXEL));
    found.push(pixel.note("go to the menu").also("gray SNR signal-to-noise ratio electrons"));
    found.extend(white_and_transform(context));
    found
}

/// Reference, white balance and color transform.
fn white_and_transform(context: &PaneContext<'_>) -> Vec<Found> {
    let document = context.scene.document;
    let set = |words: String, action: SceneAction, on: bool| Found::new(SETTINGS, words, Action::Scene(action)).on(on);
    let mut found = Vec::new();
    let transform = |words: String, to: TransformChoice| {
        let on = document.transform == to && document.correction.is_default_fit();
        set(words, SceneAction::SetTransform(to), on)
    };
    found.push(transform("Color transform: paper matrix (Eq 13)".to_owned(), TransformChoice::Paper));
    for entry in context.scene.entries(SetKind::Observer) {
        let counts_in_xyz = entry.counts_in_xyz();
        let Entry { name, .. } = entry;
        if counts_in_xyz {
            let words = format!("Color transform: fitted to {name}");
            found.push(transform(words, TransformChoice::Observer(name.clone())));
        }
        let (words, on) = (format!("Reference: {name}"), document.reference == name);
        let action = Action::Compare(CompareAction::SetReference { name, counts_in_xyz });
        found.push(Found::new(SETTINGS, words, action).on(on));
    }
    for method in CorrectionMethod::ALL {
        let on = !document.transform.is_eq_13() && document.correction.method == method;
        let action = SceneAction::SetCorrection(CorrectionChoice { method, ..document.correction.clone() });
        found.push(set(format!("Color correction: {}", method.label()), action, on).also("transform fit"));
    }
    let white = |words: String, to: WhiteBalanceChoice| {
        let on = document.white == to;
        set(format!("White balance: {words}"), SceneAction::SetWhite(to), on)
    };
    found.push(white("unity, 1 : 1 : 1".to_owned(), WhiteBalanceChoice::Unity));
    let lights = context.scene.entries(SetKind::Illuminant);
    found.extend(lights.map(|entry| white(entry.glossed_name(), WhiteBalanceChoice::Light(entry.name))));
    found
}

/// How the window and its plots look.
pub(super) fn view(context: &PaneContext<'_>) -> Vec<Found> {
    let saved = &context.view.saved;
    let mut found = Vec::new();
    let mut choice = |words: &str, also: &str, choice: ViewChoice| {
        let on = saved.has(choice);
        found.push(Found::new(SETTINGS, words, Command::Look(choice)).on(on).also(also));
    };
    choice("Diagram: fit to data", "zoom range", ViewChoice::Diagram(DiagramFit::Data));
    choice("Diagram: full diagram", "whole zoom range spectral locus", ViewChoice::Diagram(DiagramFit::Whole));
    choice("Swatches: rows", "layout", ViewChoice::Swatches(SwatchLayout::Rows));
    choice("Swatches: charts", "layout", ViewChoice::Swatches(SwatchLayout::Charts));
    choice("Swatches: split", "reference half style", ViewChoice::SwatchStyle(SwatchStyle::Split));
    choice("Swatches: inset", "reference inside style", ViewChoice::SwatchStyle(SwatchStyle::Inset));
    choice("Swatches: sensor only", "style", ViewChoice::SwatchStyle(SwatchStyle::Whole));
    choice("Spectra: overlay", "sensitivities one plot", ViewChoice::Spectra(SpectraLayout::Overlay));
    choice("Spectra: each", "sensitivities plot for each sensor", ViewChoice::Spectra(SpectraLayout::Each));
    for (mode, words) in [
        (RenderMode::Grid, "Pictures: grid"),
        (RenderMode::Split, "Pictures: split"),
        (RenderMode::One, "Pictures: one"),
        (RenderMode::Difference, "Pictures: difference maps"),
    ] {
        choice(words, "render mode", ViewChoice::Pictures(mode));
    }
    let is_dark = context.theme.dark;
    for (preference, words) in THEMES {
        let on = preference == if is_dark { egui::ThemePreference::Dark } else { egui::ThemePreference::Light };
        let line = Found::new(SETTINGS, format!("Theme: {}", words.to_lowercase()), Command::SetTheme(preference));
        found.push(line.on(on).also("mode appearance"));
    }
    for surround in Surround::ALL {
        let words = format!("Surround of swatches: {}", surround.name().to_lowercase());
        let line = Found::new(SETTINGS, words, Command::SetSurround(surround));
        found.push(line.on(saved.surround == surround).also("background grey"));
    }
    found
}

/// Mesh, material, surface, light and quality of the pictures; sliders are gone to.
pub(super) fn render(context: &PaneContext<'_>) -> Vec<Found> {
    let now = &context.scene.document.render;
    let mut found: Vec<Found> = Vec::new();
    for (name, also) in SLIDERS {
        let shown = name != "Light distance" || now.light_distance.is_some();
        if shown {
            let line = Found::new(RENDER, name, Command::Seek(PaneKind::RENDER_SETTINGS, name));
            found.push(line.note("go to the slider").also(format!("render {also}")));
        }
    }
    let mut set = |what: &'static str, words: String, also: &str, change: &dyn Fn(&mut RenderSettings)| {
        let mut to = now.clone();
        change(&mut to);
        let on = to == *now;
        let action = Action::Render(RenderAction::Set { what, to: Box::new(to) });
        found.push(Found::new(RENDER, words, action).on(on).also(format!("render {also}")));
    };
    for mesh in [MeshChoice::Head, MeshChoice::Fern, MeshChoice::Sphere, MeshChoice::Plane] {
        set("Mesh", format!("Mesh: {}", mesh.name()), "scene object", &|to| to.mesh = mesh.clone());
    }
    for (words, garment) in [("Garment of the head: jeans", Some(GARMENT)), ("Garment of the head: none", None)] {
        set("Garment", words.to_owned(), "clothes collar bare", &|to| to.garment = garment.map(str::to_owned));
    }
    for quality in QualityLevel::ALL {
        set("Quality", format!("Quality: {}", quality.label()), "", &|to| to.quality = quality);
    }
    for reading in ReadingChoice::ALL {
        let words = format!("Normalization: {}", reading.label());
        set("Normalization", words, "reflectance model surface", &|to| to.reading = reading);
    }
    for specular in SpecularChoice::ALL {
        let words = format!("Coherent component: {}", specular.label());
        set("Coherent component", words, "specular lobe surface", &|to| to.specular = specular);
    }
    for area in AreaChoice::ALL {
        set("Illuminated area", format!("Illuminated area: {}", area.label()), "surface", &|to| to.area = area);
    }
    let mesh = now.roughness == RoughnessChoice::Mesh;
    let other = if mesh { RoughnessChoice::Surface } else { RoughnessChoice::Mesh };
    let words = if mesh { "Roughness of the surface" } else { "Roughness from the mesh, as in the paper" };
    set("Roughness from the mesh", words.to_owned(), "sigma tau", &|to| to.roughness = other);
    let words = if now.shadows { "Shadows: off" } else { "Shadows: on" };
    set("Shadows", words.to_owned(), "", &|to| to.shadows = !now.shadows);
    let words = if now.light_radius > 0.0 { "Sun's disk: off" } else { "Sun's disk: on" };
    let radius = if now.light_radius > 0.0 { 0.0 } else { SUN_RADIUS };
    set("Sun's disk", words.to_owned(), "light radius", &|to| to.light_radius = radius);
    let distance = if now.light_distance.is_some() { None } else { Some(NEAR) };
    let words = if distance.is_none() { "Point light: off" } else { "Point light: on" };
    set("Point light", words.to_owned(), "near", &|to| to.light_distance = distance);
    let own = context.scene.entries(SetKind::Chart).filter(Entry::is_own);
    for entry in own.chain(context.scene.entries(SetKind::Material)) {
        set("Material", format!("Material: {}", entry.name), "reflectance surface", &|to| {
            to.material.clone_from(&entry.name);
        });
    }
    found
}
