//! Settings of the scene, the view and the render, as they are found.

use chromascope_core::correction::CorrectionMethod;
use chromascope_text::{Settings as _, Value, lowered};

use super::Found;
use crate::action::{Action, CompareAction, RenderAction, SceneAction};
use crate::catalog::Entry;
use crate::command::{Command, THEMES};
use crate::document::correction::CorrectionChoice;
use crate::document::render::{GARMENT, MeshChoice, RenderSettings};
use crate::document::{Diagram, Light, SetKind, Subset, TransformChoice, WhiteBalanceChoice};
use crate::panes::PaneContext;
use crate::panes::widgets::pixel::PIXEL;
use crate::theme::Surround;
use crate::view::RenderMode;
use crate::view::{DiagramFit, SpectraLayout, SwatchLayout, SwatchStyle, ViewChoice};
use crate::workspaces::PaneKind;

const SETTINGS: &str = "Settings";
const RENDER: &str = "Render";

/// Conditions of the scene bar, and the diagram's elements.
pub(super) fn scene(context: &PaneContext<'_>) -> Vec<Found> {
    let document = context.scene.document;
    let set = |words: String, action: SceneAction, on: bool| Found::new(SETTINGS, words, Action::Scene(action)).on(on);
    let mut found = Vec::new();
    for diagram in Diagram::ALL {
        let line =
            set(format!("Diagram: {}", diagram.label()), SceneAction::SetDiagram(diagram), document.diagram == diagram);
        found.push(line.also(format!("chromaticity {}", diagram.why())));
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
    let mut choice = |what: &str, label: &str, also: String, choice: ViewChoice| {
        let words = format!("{what}: {}", lowered(label));
        let line = Found::new(SETTINGS, words, Command::Look(choice)).on(saved.has(choice));
        found.push(line.also(also));
    };
    for fit in DiagramFit::ALL {
        choice("Diagram", fit.label(), format!("zoom range whole {}", fit.why()), ViewChoice::Diagram(fit));
    }
    for layout in [SwatchLayout::Rows, SwatchLayout::Charts] {
        choice("Swatches", layout.label(), format!("layout {}", layout.why()), ViewChoice::Swatches(layout));
    }
    for style in SwatchStyle::ALL {
        choice("Swatches", style.label(), format!("style half {}", style.why()), ViewChoice::SwatchStyle(style));
    }
    for layout in SpectraLayout::ALL {
        choice("Spectra", layout.label(), layout.why().to_owned(), ViewChoice::Spectra(layout));
    }
    for mode in RenderMode::ALL {
        choice("Pictures", mode.label(), format!("render mode maps {}", mode.why()), ViewChoice::Pictures(mode));
    }
    let is_dark = context.theme.dark;
    for (preference, words) in THEMES {
        let on = preference == if is_dark { egui::ThemePreference::Dark } else { egui::ThemePreference::Light };
        let line = Found::new(SETTINGS, format!("Theme: {}", words.to_lowercase()), Command::SetTheme(preference));
        found.push(line.on(on).also("mode appearance"));
    }
    for surround in Surround::ALL {
        let words = format!("Surround of swatches: {}", surround.label().to_lowercase());
        let line = Found::new(SETTINGS, words, Command::SetSurround(surround));
        found.push(line.on(saved.surround == surround).also("background grey"));
    }
    found
}

/// Mesh, material, surface, light and quality of the pictures; sliders are gone to.
pub(super) fn render(context: &PaneContext<'_>) -> Vec<Found> {
    let now = &context.scene.document.render;
    let mut found: Vec<Found> = Vec::new();
    let settings = || RenderSettings::ALL.iter().filter(|setting| (setting.idle)(now).is_none());
    let sliders = settings().filter(|setting| !setting.value.numbers().is_empty());
    let sliders = sliders.map(|setting| (setting.sought(), setting.name, setting.found_by));
    for (sought, name, also) in sliders.chain([("Field of view", "Field of view", "lens angle zoom")]) {
        let line = Found::new(RENDER, name, Command::Seek(PaneKind::RENDER_SETTINGS, sought));
        found.push(line.note("go to the slider").also(format!("render {also}")));
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
    for setting in settings() {
        let (name, also) = (setting.name, setting.found_by);
        match &setting.value {
            Value::Switch(get, to) => {
                let words = format!("{name}: {}", if get(now) { "off" } else { "on" });
                set(name, words, also, &|settings| to(settings, !get(now)));
            }
            Value::Choice(pick) => {
                for (index, words) in (pick.all)().into_iter().enumerate() {
                    set(name, format!("{name}: {}", words.label), also, &|to| (pick.set)(to, index));
                }
            }
            Value::Number(_) | Value::Pair(_) | Value::Own => {}
        }
    }
    let own = context.scene.entries(SetKind::Chart).filter(Entry::is_own);
    for entry in own.chain(context.scene.entries(SetKind::Material)) {
        set("Material", format!("Material: {}", entry.name), "reflectance surface", &|to| {
            to.material.clone_from(&entry.name);
        });
    }
    found
}
