//! All conditions in one bar: reference, light, temperature, patches, white balance, color transform, difference.

use chromascope_core::correction::CorrectionMethod;
use egui::{Align, ComboBox, Layout, Rect, RichText, Sense, Slider, Ui, UiBuilder, Vec2};

use super::context::PaneContext;
use crate::action::{Action, CompareAction, SceneAction};
use crate::document::correction::CorrectionChoice;
use crate::document::{Light, SetKind, Subset, TransformChoice, WhiteBalanceChoice};
use crate::format::signed;
use crate::panes::widgets::number_field::NumberField;
use crate::theme::{ROW, UNIT};

/// Temperatures of the slider, in mired from hot to cold; the slider runs like the strip, cold at the left.
const MIRED: [f64; 2] = [50.0, 1000.0];
/// Below this width the difference is chosen in the View menu.
const WITH_DIFFERENCE: f32 = 1100.0;

/// Shows the bar in its rectangle.
pub fn show(ui: &mut Ui, rect: Rect, context: &mut PaneContext<'_>) {
    let wide = rect.width() >= WITH_DIFFERENCE;
    let slider = if wide { 166.0 } else { 84.0 };
    let inner = rect.shrink2(Vec2::new(2.0 * UNIT, 0.0));
    let layout = Layout::left_to_right(Align::Min);
    let mut bar = ui.new_child(UiBuilder::new().id_salt("scene bar").max_rect(inner).layout(layout));
    bar.set_clip_rect(rect.intersect(ui.clip_rect()));
    bar.spacing_mut().item_spacing.x = 3.0 * UNIT;
    let compact = if wide { 1.0 } else { 0.78 };
    field(&mut bar, "Reference", 200.0 * compact, context, reference);
    let caption = light_caption(context);
    captioned(&mut bar, ("Light", &caption), 148.0 * compact, context, light);
    field(&mut bar, temperature_caption(context, wide), slider + 74.0, context, |ui, context| {
        temperature(ui, slider, context);
    });
    field(&mut bar, "Patches", 196.0 * compact, context, patches);
    field(&mut bar, "White balance", 108.0 * compact, context, white);
    field(&mut bar, "Color transform", 146.0 * compact, context, transform);
    if wide {
        field(&mut bar, "Difference", 90.0, context, difference);
    }
}

/// A caption above a control of a fixed width, so that nothing moves when a value changes.
fn field(
    ui: &mut Ui,
    caption: &str,
    width: f32,
    context: &mut PaneContext<'_>,
    control: impl FnOnce(&mut Ui, &mut PaneContext<'_>),
) {
    captioned(ui, (caption, caption), width, context, control);
}

/// Adds a control whose caption varies, under a constant id.
fn captioned(
    ui: &mut Ui,
    (id, caption): (&str, &str),
    width: f32,
    context: &mut PaneContext<'_>,
    control: impl FnOnce(&mut Ui, &mut PaneContext<'_>),
) {
    let (rect, _) = ui.allocate_exact_size(Vec2::new(width, ui.available_height()), Sense::hover());
    let top = Rect::from_min_size(rect.min + Vec2::new(0.0, 2.0), Vec2::new(width + 2.0 * UNIT, 14.0));
    let mut head = ui.new_child(UiBuilder::new().id_salt((id, "head")).max_rect(top));
    head.label(RichText::new(caption).small().color(context.theme.weak));
    let below = Rect::from_min_size(rect.min + Vec2::new(0.0, 18.0), Vec2::new(width, ROW));
    let layout = Layout::left_to_right(Align::Center);
    let mut body = ui.new_child(UiBuilder::new().id_salt(id).max_rect(below).layout(layout));
    body.spacing_mut().item_spacing.x = UNIT;
    control(&mut body, context);
}

/// A drop-down list as wide as its field, with an accessible name.
fn choice(ui: &mut Ui, name: &str, hint: &str, shown: &str, list: impl FnOnce(&mut Ui)) {
    let width = ui.available_width();
    let combo = ComboBox::from_id_salt(name).width(width).truncate().selected_text(shown);
    let response = combo.show_ui(ui, list).response;
    response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::ComboBox, true, format!("{name}: {shown}")));
    response.on_hover_text(format!("{hint}\nNow: {shown}"));
}

fn reference(ui: &mut Ui, context: &mut PaneContext<'_>) {
    let now = context.scene.document.reference.clone();
    // A truncated name distinguishes two observers less well than a short one.
    let entry = context.scene.entry(SetKind::Observer, &now).ok().filter(|_| ui.available_width() < 180.0);
    let shown = entry.map_or_else(|| now.clone(), |entry| entry.short);
    choice(ui, "Reference", "The observer that cameras are compared with.", &shown, |ui| {
        for entry in context.scene.entries(SetKind::Observer) {
            if ui.selectable_label(entry.name == now, &entry.name).clicked() {
                let counts_in_xyz = entry.counts_in_xyz();
                context.push(Action::Compare(CompareAction::SetReference { name: entry.name, counts_in_xyz }));
            }
        }
    });
}

/// The light's temperature, and that there are filters in front of it.
fn light_caption(context: &PaneContext<'_>) -> String {
    let filters = if context.scene.document.filters.is_empty() { "Light" } else { "Filtered" };
    match context.scene.light_temperature() {
        Ok(Ok(cct)) => format!("{filters} {:.0} K", cct.temperature.get()),
        _ => filters.to_owned(),
    }
}

fn light(ui: &mut Ui, context: &mut PaneContext<'_>) {
    let now = context.scene.document.light.clone();
    let shown = match &now {
        Light::Set(name) if name == "E" && ui.available_width() > 130.0 => "E, equal energy".to_owned(),
        Light::Set(name) => name.clone(),
        Light::BlackBody => "Blackbody".to_owned(),
        Light::Daylight => "Daylight".to_owned(),
    };
    let filters = &context.scene.document.filters;
    let mut hint =
        "The light on the scene. Blackbody and Daylight follow the temperature. Filters are ticked in the Library."
            .to_owned();
    for filter in filters {
        hint.extend(["\nFilter: ", filter]);
    }
    if let Ok(Ok(cct)) = context.scene.light_temperature() {
        hint.extend(["\nDuv ", &signed(cct.duv)]);
    }
    let filtered = !filters.is_empty();
    choice(ui, "Light", &hint, &shown, |ui| {
        if filtered && ui.button("Remove filters").clicked() {
            context.push(Action::Scene(SceneAction::ClearFilters));
        }
        let mut offer = |ui: &mut Ui, light: Light, words: &str| {
            if ui.selectable_label(now == light, words).clicked() {
                context.commands.push(Action::Scene(SceneAction::SetLight(light)).into());
            }
        };
        offer(ui, Light::BlackBody, "Blackbody at the temperature");
        offer(ui, Light::Daylight, "Daylight at the temperature, 4000–20000 K");
        ui.separator();
        for entry in context.scene.entries(SetKind::Illuminant) {
            let words =
                entry.also.as_ref().map_or_else(|| entry.name.clone(), |also| format!("{}, {also}", entry.name));
            offer(ui, Light::Set(entry.name), &words);
        }
    });
}

fn temperature_caption(context: &PaneContext<'_>, wide: bool) -> &'static str {
    match context.scene.document.light {
        Light::Set(_) if !wide => "Temperature",
        Light::BlackBody | Light::Daylight if !wide => "Temperature of light",
        Light::Set(_) => "Temperature (marks the loci)",
        Light::BlackBody => "Temperature (of the light)",
        Light::Daylight => "Temperature (of daylight)",
    }
}

fn temperature(ui: &mut Ui, slider_width: f32, context: &mut PaneContext<'_>) {
    let now = context.scene.document.temperature_k;
    let mut set = None;
    let mut mired = 1e6 / now;
    ui.spacing_mut().slider_width = slider_width - UNIT;
    let slider = Slider::new(&mut mired, MIRED[1]..=MIRED[0]).show_value(false).step_by(0.0);
    let slider = ui.add(slider);
    slider.widget_info(|| egui::WidgetInfo::slider(true, now, "Temperature, evenly in mired"));
    if slider.changed() {
        let kelvin = 1e6 / mired;
        // To ten kelvins: the precision of a drag and of reading.
        set = Some((kelvin / 10.0).round() * 10.0);
    }
    slider.on_hover_text("Drag: evenly in mired (10⁶/T), as in the strip below the diagram");
    let [coldest, hottest] = crate::document::LOCUS_RANGE_K;
    let coldest = if context.scene.document.light == Light::Daylight { 4000.0 } else { coldest };
    let field = NumberField {
        id: egui::Id::unique("temperature in kelvins"),
        now,
        range: [coldest, hottest],
        speed: 10.0,
        unit: "K",
        name: "Temperature in kelvins",
        hint: "Temperature in kelvins: drag, or click and type (T)",
    };
    let (rect, _) = ui.allocate_exact_size(Vec2::new(66.0, ROW), Sense::hover());
    let focus = std::mem::take(&mut context.view.focus_temperature);
    set = field.show(ui, rect, focus, context).or(set);
    if let Some(kelvin) = set.filter(|kelvin| *kelvin != now) {
        context.push(Action::Scene(SceneAction::SetTemperature(kelvin)));
    }
}

fn patches(ui: &mut Ui, context: &mut PaneContext<'_>) {
    let document = context.scene.document;
    let now = document.chart.clone();
    let five = document.subset == Subset::Five && context.scene.has_five();
    let short = context.scene.chart_entry(&now).map_or_else(|_| now.clone(), |entry| entry.short);
    let shown = if five { format!("Five of {short}") } else { short };
    choice(ui, "Patches", "The reflectances shown: charts, skin, leaves, yours.", &shown, |ui| {
        for kind in [SetKind::Chart, SetKind::Material] {
            for entry in context.scene.entries(kind) {
                if ui.selectable_label(entry.name == now, &entry.name).clicked() {
                    context.push(Action::Scene(SceneAction::SetChart(entry.name)));
                }
            }
            ui.separator();
        }
        if context.scene.has_five() {
            let mut on = five;
            if ui.checkbox(&mut on, "Only the paper's five").changed() {
                let subset = if on { Subset::Five } else { Subset::All };
                context.push(Action::Scene(SceneAction::SetSubset(subset)));
            }
        }
    });
}

fn white(ui: &mut Ui, context: &mut PaneContext<'_>) {
    let now = context.scene.document.white.clone();
    let shown = match &now {
        WhiteBalanceChoice::Unity => "Unity".to_owned(),
        WhiteBalanceChoice::Light(name) => name.clone(),
        WhiteBalanceChoice::Daylight(kelvin) => format!("Daylight {kelvin:.0} K"),
        WhiteBalanceChoice::BlackBody(kelvin) => format!("Blackbody {kelvin:.0} K"),
    };
    let hint = "White-balance target: the RGB that a perfect diffuser under the light is mapped to (Eq 11). With a \
                fitted color transform it changes camera RGB only; the matrix compensates for it.";
    choice(ui, "White balance", hint, &shown, |ui| {
        let mut offer = |ui: &mut Ui, white: WhiteBalanceChoice, words: &str| {
            if ui.selectable_label(now == white, words).clicked() {
                context.commands.push(Action::Scene(SceneAction::SetWhite(white)).into());
            }
        };
        let kelvin = context.scene.document.temperature_k;
        offer(ui, WhiteBalanceChoice::Unity, "Unity, 1 : 1 : 1 (the paper's experiments 1 and 2)");
        offer(ui, WhiteBalanceChoice::Daylight(kelvin.max(4000.0)), &format!("Daylight {:.0} K", kelvin.max(4000.0)));
        offer(ui, WhiteBalanceChoice::BlackBody(kelvin), &format!("Blackbody {kelvin:.0} K"));
        ui.separator();
        for entry in context.scene.entries(SetKind::Illuminant) {
            offer(ui, WhiteBalanceChoice::Light(entry.name.clone()), &entry.name);
        }
    });
}

fn transform(ui: &mut Ui, context: &mut PaneContext<'_>) {
    let now = context.scene.document.transform.clone();
    let correction = context.scene.document.correction.clone();
    let shown = match &now {
        TransformChoice::Paper if ui.available_width() < 130.0 => "Eq 13".to_owned(),
        TransformChoice::Paper => "Paper (Eq 13)".to_owned(),
        TransformChoice::Observer(name) if correction.is_default_fit() => format!("Fit {name}"),
        TransformChoice::Observer(name) => correction.describe(name),
    };
    let hint = "Color transform from camera RGB to XYZ. Paper matrix: camera and RGB observer signals through the \
                matrix of Eq 13, CIE observers directly. Fitted: a 3×3 matrix for each sensor, fitted to a CIE \
                observer over 190 training reflectances under the light, or another correction; training \
                reflectances and weights are chosen in the pane Correction.";
    choice(ui, "Color transform", hint, &shown, |ui| {
        if ui.selectable_label(now == TransformChoice::Paper, "Paper matrix (Eq 13)").clicked() {
            context.push(Action::Scene(SceneAction::SetWay(TransformChoice::Paper)));
        }
        ui.separator();
        for entry in context.scene.entries(SetKind::Observer).filter(crate::catalog::Entry::counts_in_xyz) {
            let transform = TransformChoice::Observer(entry.name.clone());
            if ui.selectable_label(now == transform, format!("Fitted to {}", entry.name)).clicked() {
                context.push(Action::Scene(SceneAction::SetWay(transform)));
            }
        }
        ui.separator();
        for method in CorrectionMethod::ALL {
            let chosen = !now.is_eq_13() && correction.method == method;
            if ui.selectable_label(chosen, method.label()).clicked() {
                let correction = CorrectionChoice { method, ..correction.clone() };
                context.push(Action::Scene(SceneAction::SetCorrection(correction)));
            }
        }
    });
}

fn difference(ui: &mut Ui, context: &mut PaneContext<'_>) {
    let now = context.scene.document.difference;
    let transform = context.scene.document.transform.clone();
    let hint = match transform {
        TransformChoice::Paper => {
            "Metric of the difference from the reference. Eq 13 treats an observer's RGB as sRGB, so its L*a*b* is \
             not that of the CIE: distances in the diagram are valid, but the ΔE*00 formula does not yield ΔE*00."
        }
        TransformChoice::Observer(_) => "Metric of the difference from the reference.",
    };
    choice(ui, "Difference", hint, now.name(transform.is_eq_13()), |ui| {
        for metric in transform.metrics() {
            let name = metric.name(transform.is_eq_13());
            if ui.selectable_label(now == metric, name).on_hover_text(metric.label).clicked() {
                context.push(Action::Scene(SceneAction::SetDifference(metric)));
            }
        }
    });
}
