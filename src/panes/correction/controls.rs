//! The choices of a correction: camera, method, training, weights, second light.

use chromascope_core::correction::CorrectionMethod;
use chromascope_core::correction::classes::{ClassWeights, ColorClass};
use egui::{ComboBox, DragValue, Ui};

use crate::action::{Action, SceneAction};
use crate::document::SetKind;
use crate::document::correction::CorrectionChoice;
use crate::panes::context::PaneContext;
use crate::panes::widgets::pick_list::{self, Line};

/// The camera that is corrected; none where none is compared.
pub(super) fn camera(ui: &mut Ui, context: &mut PaneContext<'_>) -> Option<String> {
    let sources = context.scene.sources();
    let cameras: Vec<&String> =
        sources.iter().filter(|source| source.kind == SetKind::Camera).map(|source| &source.name).collect();
    let chosen = context.view.correction.camera.clone().filter(|name| cameras.contains(&name));
    let now = chosen.or_else(|| cameras.first().map(|name| (*name).clone()))?;
    list(ui, "Camera", "The camera that is corrected, of those compared", &now, |ui| {
        for name in cameras {
            if ui.selectable_label(*name == now, name).clicked() {
                context.view.correction.camera = Some(name.clone());
            }
        }
    });
    Some(now)
}

/// Method and white.
pub(super) fn method(ui: &mut Ui, context: &mut PaneContext<'_>) {
    let choice = context.scene.document.correction.clone();
    let fitted = !context.scene.document.transform.is_eq_13();
    let shown = if fitted { choice.method.label() } else { "Paper matrix (Eq 13)" };
    let hint = "Method of the color transform, of all cameras and wherever colors are shown";
    list(ui, "Method", hint, shown, |ui| {
        for method in CorrectionMethod::ALL {
            if ui.selectable_label(fitted && choice.method == method, method.label()).clicked() {
                set(context, CorrectionChoice { method, ..choice.clone() });
            }
        }
    });
    let mut keeps_white = choice.keeps_white;
    let hint = "A perfect diffuser keeps its color exactly. Off: white is one color among the others";
    if ui.checkbox(&mut keeps_white, "Keep white").on_hover_text(hint).changed() {
        set(context, CorrectionChoice { keeps_white, ..choice });
    }
}

/// Training reflectances and weights.
pub(super) fn training(ui: &mut Ui, context: &mut PaneContext<'_>) {
    let choice = context.scene.document.correction.clone();
    list(ui, "Training", "The reflectances that the transform is fitted over", &choice.training, |ui| {
        for kind in [SetKind::Chart, SetKind::Material] {
            for entry in context.scene.entries(kind) {
                if ui.selectable_label(entry.name == choice.training, &entry.name).clicked() {
                    set(context, CorrectionChoice { training: entry.name, ..choice.clone() });
                }
            }
        }
    });
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
    ui.horizontal(|ui| {
        ui.label("Second light");
        let width = (ui.available_width() - 8.0).clamp(80.0, 300.0);
        let chosen = pick_list::drop_down(ui, ("Second light", hint), shown, width, &context.theme, || {
            lights.extend(context.scene.entries(SetKind::Illuminant).map(|entry| Some(entry.name)));
            lights.iter().map(|light| Line::new(light.as_deref().unwrap_or("None"), *light == now)).collect()
        });
        if let Some(light) = chosen.map(|index| lights.swap_remove(index)) {
            set(context, CorrectionChoice { second_light: light, ..choice.clone() });
        }
    });
}

fn set(context: &mut PaneContext<'_>, choice: CorrectionChoice) {
    context.push(Action::Scene(SceneAction::SetCorrection(choice)));
}

/// A list to choose from, with its name before it.
fn list(ui: &mut Ui, name: &str, hint: &str, shown: &str, choices: impl FnOnce(&mut Ui)) {
    ui.horizontal(|ui| {
        let label = ui.label(name);
        let width = (ui.available_width() - 8.0).clamp(80.0, 300.0);
        let combo = ComboBox::from_id_salt(("correction", name)).width(width).truncate().selected_text(shown);
        let response = combo.show_ui(ui, choices).response.labelled_by(label.id);
        response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::ComboBox, true, format!("{name}: {shown}")));
        response.on_hover_text(format!("{hint}\nNow: {shown}"));
    });
}
