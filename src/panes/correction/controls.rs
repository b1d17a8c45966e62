//! The choices of a correction: camera, method, training, weights, second light.

use chromascope_core::camera::ChannelRatio;
use chromascope_core::correction::CorrectionMethod;
use chromascope_core::correction::classes::{ClassWeights, ColorClass};
use egui::{DragValue, Label, Response, RichText, TextEdit, Ui};

use crate::action::{Action, SceneAction};
use crate::command::Command;
use crate::document::SetKind;
use crate::document::correction::CorrectionChoice;
use crate::export::profile::{CorrectionForm, stated_model};
use crate::panes::context::PaneContext;
use crate::panes::widgets::pick_list::{self, Line};
use crate::panes::widgets::sets;

/// Width of the names before lists, so that these stand below each other.
const CAPTION: f32 = 78.0;
/// Width of a class with its weight.
const WEIGHT: f32 = 110.0;

/// The camera that is corrected; none where none is selected or compared.
pub(super) fn camera(ui: &mut Ui, context: &mut PaneContext<'_>) -> Option<String> {
    ui.horizontal(|ui| {
        caption(ui, "Camera");
        sets::camera(ui, width(ui), context);
    });
    Some(context.view.camera(&context.scene)?.name)
}

pub(super) fn files(ui: &mut Ui, context: &mut PaneContext<'_>) {
    ui.horizontal_wrapped(|ui| {
        ui.label("Save as");
        for form in CorrectionForm::ALL {
            let (label, hint) = form.words();
            context.button(ui, label, hint, Command::SaveCorrection(form));
        }
    });
}

/// What files state of the camera: model, and a neutral in place of the table's own ratio between the channels.
pub(super) fn stated(ui: &mut Ui, camera: &str, ratio: Option<ChannelRatio>, context: &mut PaneContext<'_>) {
    let theme = context.theme;
    let key = (camera.to_owned(), context.scene.light_name());
    let hint = format!("AsShotNeutral of a raw file under {}: R,G,B, as 0.5,1,0.7", key.1);
    let view = &mut context.view.correction;
    let neutral = view.neutrals.entry(key).or_default();
    let own = if ratio.is_some_and(|ratio| !ratio.is_credible()) { "not given" } else { "the table's own" };
    field(ui, ("Neutral", &hint), neutral, own);
    let (model, stated) = (view.models.entry(camera.to_owned()).or_default(), stated_model(&context.scene, camera));
    let hint = "UniqueCameraModel, as raw files of the camera state it; raw developers choose a DCP file by it";
    field(ui, ("Model", hint), model, &stated);
    let (words, color) = match (context.view.correction.neutral(&context.scene, camera), ratio) {
        (Err(error), _) => (format!("Neutral: {error}"), theme.error),
        (Ok(None), Some(ratio)) if !ratio.is_credible() => {
            (format!("Channel ratio {ratio}. DCP, CLF and DNG text need a neutral."), theme.warning)
        }
        _ => return,
    };
    ui.add(Label::new(RichText::new(words).small().color(color)).wrap());
}

fn field(ui: &mut Ui, (name, hint): (&str, &str), text: &mut String, empty: &str) {
    ui.horizontal(|ui| {
        let label = caption(ui, name);
        let field = TextEdit::singleline(text).hint_text(empty).desired_width(width(ui));
        ui.add(field).labelled_by(label.id).on_hover_text(hint);
    });
}

fn width(ui: &Ui) -> f32 {
    (ui.available_width() - 8.0).clamp(80.0, 300.0)
}

/// A name before a control, so wide that controls stand below each other.
fn caption(ui: &mut Ui, name: &str) -> Response {
    let label = ui.label(name);
    ui.add_space((CAPTION - label.rect.width()).max(0.0));
    label
}

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
            if ui.available_size_before_wrap().x < WEIGHT {
                ui.end_row();
            }
            let mut weight = choice.weights[class as usize];
            let count = shown.as_ref().map(|file| file.sheet.first.report.classes[class as usize]);
            let hint = match count {
                Some(count) => {
                    format!("Weight in the fit of the {count} training reflectances of this class; others have 1")
                }
                None => "Weight in the fit of the training reflectances of this class; others have 1".to_owned(),
            };
            let field = DragValue::new(&mut weight).range(0.0..=ClassWeights::MOST).speed(0.05).max_decimals(2);
            let field = ui.horizontal(|ui| {
                let label = ui.label(class.label());
                ui.add(field).labelled_by(label.id)
            });
            if field.inner.on_hover_text(hint).changed() {
                let mut weights = choice.weights;
                weights[class as usize] = weight;
                set(context, CorrectionChoice { weights, ..choice.clone() });
            }
        }
    });
}

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

fn list(
    ui: &mut Ui,
    (name, hint): (&str, &str),
    shown: &str,
    context: &PaneContext<'_>,
    lines: impl FnOnce() -> Vec<Line>,
) -> Option<usize> {
    let row = ui.horizontal(|ui| {
        caption(ui, name);
        pick_list::drop_down(ui, (name, hint), shown, width(ui), &context.theme, lines)
    });
    row.inner
}
