//! Settings of the scene, the view and the render, as they are found.

use chromascope_text::{Setting, Settings, Words};

use super::Found;
use crate::action::{Action, RenderAction, SceneAction};
use crate::catalog::Entry;
use crate::command::{Command, THEMES};
use crate::document::render::{GARMENT, MeshChoice, RenderSettings};
use crate::document::{Diagram, Light, SetKind};
use crate::panes::PaneContext;
use crate::panes::widgets::conditions;
use crate::panes::widgets::pick_list::Line;
use crate::panes::widgets::pixel::PIXEL;
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
    for (name, all) in conditions::ALL {
        for (line, action) in all(&context.scene) {
            // Illuminants and charts are found as data sets.
            let is_set = |action: &Action| {
                matches!(action, Action::Scene(SceneAction::SetLight(Light::Set(_)) | SceneAction::SetChart(_)))
            };
            let Some(action) = action.filter(|action| !is_set(action)) else { continue };
            let words = format!("{name}: {}", line.words);
            found.push(Found { line: Line { words, ..line }, ..Found::new(SETTINGS, "", action) });
        }
    }
    let pixel = Found::new(SETTINGS, "Pixel: full well and read noise", Command::Seek(PaneKind::METRICS, PIXEL));
    found.push(pixel.note("go to the menu").also("gray SNR signal-to-noise ratio electrons"));
    found
}

/// How the window and its plots look.
pub(super) fn view(context: &PaneContext<'_>) -> Vec<Found> {
    let look = |setting: &'static Setting<_>, (place, words): (usize, &Words), _| {
        (Command::Look(setting.key, place), words.why.to_owned())
    };
    let mut found = alternatives(SETTINGS, &context.view.saved, look);
    let is_dark = context.theme.dark;
    for (preference, words) in THEMES {
        let on = preference == if is_dark { egui::ThemePreference::Dark } else { egui::ThemePreference::Light };
        let line = Found::new(SETTINGS, format!("Theme: {}", words.to_lowercase()), Command::SetTheme(preference));
        found.push(line.on(on).also("mode appearance"));
    }
    found
}

/// A line for each alternative of settings that have some. `command` is given its place, its words, and the data with it, and
/// adds other words that find it.
fn alternatives<D: Settings + Clone + PartialEq>(
    group: &'static str,
    now: &D,
    command: impl Fn(&'static Setting<D>, (usize, &Words), D) -> (Command, String),
) -> Vec<Found> {
    let mut found = Vec::new();
    for setting in D::ALL.iter().filter(|setting| (setting.idle)(now).is_none()) {
        for (place, words) in setting.value.alternatives().into_iter().enumerate() {
            let mut to = now.clone();
            setting.value.choose(&mut to, place);
            let on = to == *now;
            let (command, also) = command(setting, (place, words), to);
            let line = Found::new(group, format!("{}: {}", setting.name, words.label), command);
            found.push(line.on(on).also(format!("{} {also}", setting.found_by)));
        }
    }
    found
}

/// Mesh, material, surface, light and quality of the pictures; sliders are gone to.
pub(super) fn render(context: &PaneContext<'_>) -> Vec<Found> {
    let now = &context.scene.document.render;
    let set = |what, to| Action::Render(RenderAction::Set { what, to: Box::new(to) });
    let mut found = alternatives(RENDER, now, |setting, _, to| (set(setting.name, to).into(), "render".to_owned()));
    let sliders = RenderSettings::ALL.iter().filter(|setting| (setting.idle)(now).is_none());
    let sliders = sliders.filter(|setting| !setting.value.numbers().is_empty());
    let sliders = sliders.map(|setting| (setting.sought(), setting.name, setting.found_by));
    for (sought, name, also) in sliders.chain([("Field of view", "Field of view", "lens angle zoom")]) {
        let line = Found::new(RENDER, name, Command::Seek(PaneKind::RENDER, sought));
        found.push(line.note("go to the slider").also(format!("render {also}")));
    }
    let mut offer = |what: &'static str, words: String, also: &str, change: &dyn Fn(&mut RenderSettings)| {
        let mut to = now.clone();
        change(&mut to);
        let on = to == *now;
        found.push(Found::new(RENDER, words, set(what, to)).on(on).also(format!("render {also}")));
    };
    for mesh in [MeshChoice::Head, MeshChoice::Fern, MeshChoice::Sphere, MeshChoice::Plane] {
        offer("Mesh", format!("Mesh: {}", mesh.name()), "scene object", &|to| to.mesh = mesh.clone());
    }
    for (words, garment) in [("Garment of the head: jeans", Some(GARMENT)), ("Garment of the head: none", None)] {
        offer("Garment", words.to_owned(), "clothes collar bare", &|to| to.garment = garment.map(str::to_owned));
    }
    let own = context.scene.entries(SetKind::Chart).filter(Entry::is_own);
    for entry in own.chain(context.scene.entries(SetKind::Material)) {
        offer("Material", format!("Material: {}", entry.name), "reflectance surface", &|to| {
            to.material.clone_from(&entry.name);
        });
    }
    found
}
