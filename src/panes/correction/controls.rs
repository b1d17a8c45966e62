//! The choices of a correction: camera, method, training, weights, second light.

use chromascope_core::correction::CorrectionMethod;
use chromascope_core::correction::classes::{ClassWeights, ColorClass};
use egui::{DragValue, Ui};

use crate::action::{Action, SceneAction};
use crate::document::SetKind;
use crate::document::correction::CorrectionChoice;
use crate::panes::context::PaneContext;
use crate::panes::widgets::pick_list::{self, Line};

/// Width of the names before lists, so that these stand below each other.
const CAPTION: f32 = 78.0;

/// The camera that is corrected; none where none is compared.
pub(super) fn camera(ui: &mut Ui, context: &mut PaneContext<'_>) -> Option<String> {
    let sources = context.scene.sources();
    let cameras: Vec<&String> =
        sources.iter().filter(|source| source.kind == SetKind::Camera).map(|source| &source.name).collect();
    let chosen = context.view.correction.camera.clone().filter(|name| cameras.contains(&name));
    let now = chosen.or_else(|| cameras.first().map(|name| (*name).clone()))?;
    let lines = || cameras.iter().map(|name| Line::new(*name, **name == now)).collect();
    let hint = "The camera that is corrected, of those compared";
    if let Some(index) = list(ui, ("Camera", hint), &now, context, lines) {
        context.view.correction.camera = Some(cameras[index].clone());
    }
    Some(now)
}

/// Method and white.
pub(super) fn method(ui: &mut Ui, context: &mut PaneContext<'_>) {
    let choice = context.scene.document.correction.clone();
    let fitted = !context.scene.document.transform.is_eq_13();
    let shown = if fitted { choice.method.label() } else { "Paper matrix (Eq 13)" };
    let hint = "Method of the color transform, of all cameras and wherever colors are shown";
    let line = |method: &CorrectionMethod| Line::new(method.label(), fitted && choice.method == *method);
    let lines = || CorrectionMethod::ALL.iter().map(line).collect();
    if let Some(index) = list(ui, ("Method", hint), shown, context, lines) {
        set(context, CorrectionChoice { method: CorrectionMethod::ALL[index], ..choice.clone() });
    }
    let mut keeps_white = choice.keeps_white;
    let hint = "A perfect diffuser keeps its color exactly. Off: white is one color among the others";
    if ui.checkbox(&mut keeps_white, "Keep white").on_hover_text(hint).changed() {
        set(context, CorrectionChoice { keeps_white, ..choice });
    }
}

/// Training reflectances and weights.
pub(super) fn training(ui: &mut Ui, context: &mut PaneContext<'_>) {
    let choice = context.scene.document.correction.clone();
    let hint = "The reflectances that the transform is fitted over";
    let mut names = Vec::new();
    let chosen = list(ui, ("Training", hint), &choice.training, context, || {
        let kinds = [SetKind::Chart, SetKind::Material].into_iter();
        names.extend(kinds.flat_map(|kind| context.scene.entries(kind)).map(|entry| entry.name));
        names.iter().map(|name| Line::new(name, *name == choice.training)).collect()
    });
    if let Some(index) = chosen {
        set(context, CorrectionChoice { training: names.swap_remove(index), ..choice.clone() });
    }
    let shown = context.view.correction.shown.clone();
    ui.horizontal_wrapped(|ui| {
        for class in ColorClass::ALL {
            let mut weight = choice.weights[class as usize];
            let count = shown.as_ref().map(|file| file.sheet.first.report.classes[class as usize]);
            let hint = match count {
                Some(count) => {
                    format!("Weight in the fit of the {count} training reflectances of this class; others have 1")
                }
                None => "Weight in the fit of the training reflectances of this class; others have 1".to_owned(),
            };
            let field = DragValue::new(&mut weight).range(0.0..=ClassWeights::MOST).speed(0.05).max_decimals(2);
            let label = ui.label(class.label());
            if ui.add(field).labelled_by(label.id).on_hover_text(hint).changed() {
                let mut weights = choice.weights;
                weights[class as usize] = weight;
                set(context, CorrectionChoice { weights, ..choice.clone() });
            }
        }
    });
}

/// The second calibration light.
pub(super) fn second_light(ui: &mut Ui, context: &mut PaneContext<'_>) {
    let choice = context.scene.document.correction.clone();
    let now = choice.second_light.clone();
    let hint = "A second calibration light for DNG matrices and DCP files. The first is the light on the scene";
    let shown = now.as_deref().unwrap_or("None");
    let mut lights = vec![None];
    let chosen = list(ui, ("Second light", hint), shown, context, || {
        lights.extend(context.scene.entries(SetKind::Illuminant).map(|entry| Some(entry.name)));
        lights.iter().map(|light| Line::new(light.as_deref().unwrap_or("None"), *light == now)).collect()
    });
    if let Some(light) = chosen.map(|index| lights.swap_remove(index)) {
        set(context, CorrectionChoice { second_light: light, ..choice.clone() });
    }
}

fn set(context: &mut PaneContext<'_>, choice: CorrectionChoice) {
    context.push(Action::Scene(SceneAction::SetCorrection(choice)));
}

/// A list to choose from, with its name before it. Returns the line that was chosen.
fn list(
    ui: &mut Ui,
    (name, hint): (&str, &str),
    shown: &str,
    context: &PaneContext<'_>,
    lines: impl FnOnce() -> Vec<Line>,
) -> Option<usize> {
    let row = ui.horizontal(|ui| {
        let width = ui.label(name).rect.width();
        ui.add_space((CAPTION - width).max(0.0));
        let width = (ui.available_width() - 8.0).clamp(80.0, 300.0);
        pick_list::drop_down(ui, (name, hint), shown, width, &context.theme, lines)
    });
    row.inner
}
