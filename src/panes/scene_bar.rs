//! All conditions in one bar: reference, light, temperature, patches, white balance, color transform, difference.

use egui::{Align, Layout, Rect, Sense, Slider, Ui, UiBuilder, Vec2};

use super::context::PaneContext;
use crate::action::{Action, SceneAction};
use crate::document::render::{BALANCE, SUN};
use crate::document::{Light, SetKind, Subset, TransformChoice, WhiteBalanceChoice};
use crate::format::signed;
use crate::panes::widgets::conditions::{self, Listing};
use crate::panes::widgets::number_field::NumberField;
use crate::panes::widgets::pick_list::{self, Line};
use crate::panes::widgets::{self, Icon};
use crate::theme::{ROW, UNIT};
use crate::view::View;
use crate::workspaces::PaneKind;

/// Temperatures of the slider, in mired from hot to cold; the slider runs like the strip, cold at the left.
const MIRED: [f64; 2] = [50.0, 1000.0];
const DIM: f32 = 0.45;
/// Below this width the list of differences has no room for its name, only for a button.
const WITH_DIFFERENCE: f32 = 1100.0;
const BUTTON: f32 = 20.0;

pub fn show(ui: &mut Ui, rect: Rect, context: &mut PaneContext<'_>) {
    let wide = rect.width() >= WITH_DIFFERENCE;
    let slider = if wide { 166.0 } else { 84.0 };
    let inner = rect.shrink2(Vec2::new(2.0 * UNIT, 0.0));
    let layout = Layout::left_to_right(Align::Min);
    let mut bar = ui.new_child(UiBuilder::new().id_salt("scene bar").max_rect(inner).layout(layout));
    bar.set_clip_rect(rect.intersect(ui.clip_rect()));
    bar.spacing_mut().item_spacing.x = 3.0 * UNIT;
    let compact = if wide { 1.0 } else { 0.78 };
    field(&mut bar, (Condition::Reference, "Reference"), 200.0 * compact, context, reference);
    let caption = light_caption(context);
    field(&mut bar, (Condition::Light, &caption), 148.0 * compact, context, light);
    let caption = temperature_caption(context, wide);
    field(&mut bar, (Condition::Temperature, caption), slider + 74.0, context, |ui, context| {
        temperature(ui, slider, context);
    });
    field(&mut bar, (Condition::Patches, "Patches"), 196.0 * compact, context, patches);
    let caption = if shows_sunlight(context) { "Render's own white" } else { "White balance" };
    field(&mut bar, (Condition::White, caption), 108.0 * compact, context, white);
    field(&mut bar, (Condition::Transform, "Color transform"), 146.0 * compact, context, transform);
    let (caption, width) = if wide { ("Difference", 90.0) } else { ("Δ", BUTTON) };
    field(&mut bar, (Condition::Difference, caption), width, context, difference);
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
enum Condition {
    Reference,
    Light,
    Temperature,
    Patches,
    White,
    Transform,
    Difference,
}

impl Condition {
    /// True if a pane shows something that depends on it.
    fn matters_to(self, pane: PaneKind, view: &View, (light, is_eq_13): (&Light, bool)) -> bool {
        // A light of its own has its own temperature: what is set marks the loci alone.
        let is_of_light = self != Self::Temperature || !matches!(light, Light::Set(_));
        match pane {
            PaneKind::LIBRARY | PaneKind::IMPORT | PaneKind::CURVES | PaneKind::INTERPRETATION => false,
            PaneKind::INSPECTOR => view.selected.is_some() || !view.pinned.is_empty(),
            PaneKind::SPECTRA => {
                is_of_light && matches!(self, Self::Reference | Self::Light | Self::Temperature | Self::Patches)
            }
            PaneKind::RENDER | PaneKind::RENDER_SETTINGS | PaneKind::TOLERANCE | PaneKind::STATISTICS => {
                is_of_light && self != Self::Patches
            }
            // Ranks are by every metric.
            PaneKind::METRICS | PaneKind::HEAD_TO_HEAD => self != Self::Difference,
            // There is no correction without a fit.
            PaneKind::CORRECTION if is_eq_13 => self == Self::Transform,
            PaneKind::CORRECTION => is_of_light && !matches!(self, Self::Reference | Self::Patches),
            PaneKind::LIGHT => is_of_light && !matches!(self, Self::Reference | Self::White | Self::Difference),
            PaneKind::RECORDED => is_of_light && matches!(self, Self::Light | Self::Temperature | Self::Patches),
            PaneKind::METHODS => is_of_light && self != Self::Difference,
            _ => true,
        }
    }

    /// True if a visible pane shows something that depends on it.
    fn matters(self, context: &PaneContext<'_>) -> bool {
        let (view, light) = (&*context.view, &context.scene.document.light);
        let sun = Light::Set(SUN.to_owned());
        let is_eq_13 = context.scene.document.transform.is_eq_13();
        let light_of = |pane| match pane {
            PaneKind::RENDER | PaneKind::RENDER_SETTINGS | PaneKind::TOLERANCE | PaneKind::STATISTICS
                if context.scene.is_sunlit() =>
            {
                &sun
            }
            _ => light,
        };
        if let Some(pane) = view.maximized {
            return self.matters_to(pane, view, (light_of(pane), is_eq_13));
        }
        let places = view.saved.layout.places(view.saved.workspace).iter().flatten();
        places.copied().any(|pane| self.matters_to(pane, view, (light_of(pane), is_eq_13)))
    }
}

/// True if the workspace shows pictures under the sun, whatever the light of the other panes.
fn shows_sunlight(context: &PaneContext<'_>) -> bool {
    let saved = &context.view.saved;
    let mut places = saved.layout.places(saved.workspace).iter().flatten();
    context.scene.is_sunlit() && places.any(|pane| *pane == PaneKind::RENDER)
}

/// A caption above a control of a fixed width, so that nothing moves when a value changes; dim where the control does nothing in
/// the workspace.
fn field(
    ui: &mut Ui,
    (condition, caption): (Condition, &str),
    width: f32,
    context: &mut PaneContext<'_>,
    control: impl FnOnce(&mut Ui, &mut PaneContext<'_>),
) {
    let id = format!("{condition:?}");
    let matters = condition.matters(context);
    let (rect, _) = ui.allocate_exact_size(Vec2::new(width, ui.available_height()), Sense::hover());
    let top = Rect::from_min_size(rect.min + Vec2::new(0.0, 2.0), Vec2::new(width + 2.0 * UNIT, 14.0));
    let mut head = ui.new_child(UiBuilder::new().id_salt((&id, "head")).max_rect(top));
    if !matters {
        head.set_opacity(DIM);
    }
    widgets::note(&mut head, caption);
    let below = Rect::from_min_size(rect.min + Vec2::new(0.0, 18.0), Vec2::new(width, ROW));
    let layout = Layout::left_to_right(Align::Center);
    let mut body = ui.new_child(UiBuilder::new().id_salt(&id).max_rect(below).layout(layout));
    body.spacing_mut().item_spacing.x = UNIT;
    if !matters {
        body.set_opacity(DIM);
        let name = context.view.saved.workspace.label();
        let place = ui.interact(rect, ui.scope_id().with((&id, "dim")), Sense::hover());
        place.on_hover_text(format!("{caption}: no effect on the panes of {name}"));
    }
    control(&mut body, context);
}

fn choice(
    ui: &mut Ui,
    name: &str,
    hint: &str,
    shown: &str,
    context: &PaneContext<'_>,
    lines: impl FnOnce() -> Vec<Line>,
) -> Option<usize> {
    let width = ui.available_width();
    if width > BUTTON {
        return pick_list::drop_down(ui, (name, hint), shown, width, &context.theme, lines);
    }
    let (button, chosen) = pick_list::menu(ui, ("⋯", name, &format!("{name}: {shown}\n{hint}")), &context.theme, lines);
    widgets::labeled(&button, egui::Role::Button, format!("{name}: {shown}"));
    chosen
}

/// A list of the alternatives of a condition. Pushes the action of the one that was chosen.
fn actions(ui: &mut Ui, (name, hint): (&str, &str), shown: &str, context: &mut PaneContext<'_>, all: Listing) {
    let mut made = Vec::new();
    let chosen = choice(ui, name, hint, shown, context, || {
        let (lines, actions): (Vec<_>, Vec<_>) = all(&context.scene).into_iter().unzip();
        made = actions;
        lines
    });
    if let Some(action) = chosen.and_then(|index| made.swap_remove(index)) {
        context.push(action);
    }
}

fn reference(ui: &mut Ui, context: &mut PaneContext<'_>) {
    let now = context.scene.document.reference.clone();
    // A truncated name distinguishes two observers less well than a short one.
    let entry = context.scene.entry(SetKind::Observer, &now).ok().filter(|_| ui.available_width() < 180.0);
    let shown = entry.map_or_else(|| now.clone(), |entry| entry.short);
    actions(ui, ("Reference", "The observer that cameras are compared with."), &shown, context, conditions::references);
}

fn light_caption(context: &PaneContext<'_>) -> String {
    if shows_sunlight(context) {
        return "Render's own light".to_owned();
    }
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
    let sunlit = shows_sunlight(context);
    let mut hint =
        "The light on the scene. Blackbody and Daylight follow the temperature. Filters are ticked in the Library."
            .to_owned();
    if sunlit {
        hint = format!(
            "The pictures are under the sun, balanced to {BALANCE}, by Render's own choice; other panes: {shown}. What is \
             chosen here is for both. {hint}"
        );
    }
    let filters = context.scene.document.filters.clone();
    let shown = match filters.as_slice() {
        _ if sunlit => SUN.to_owned(),
        [] => shown,
        [filter] => format!("{shown} × {filter}"),
        many => format!("{shown} × {} filters", many.len()),
    };
    for filter in &filters {
        hint.extend(["\nFilter: ", filter]);
    }
    // Where there is a filter, it is taken off beside the list.
    let off = if sunlit || filters.is_empty() { 0.0 } else { ROW };
    let whole = ui.available_rect_before_wrap();
    ui.set_max_width(whole.width() - off);
    if off > 0.0 {
        let place = Rect::from_min_size(egui::pos2(whole.right() - off, whole.top()), Vec2::splat(off));
        let words = if let [filter] = filters.as_slice() { filter } else { "all filters" };
        let mut child = ui.new_child(UiBuilder::new().id_salt("filters off").max_rect(place));
        if widgets::icon_button(&mut child, Icon::Close, &format!("Remove {words}")).clicked() {
            context.push(Action::Scene(SceneAction::ClearFilters));
        }
    }
    if let Ok(Ok(cct)) = context.scene.light_temperature() {
        hint.extend(["\nDuv ", &signed(cct.duv)]);
    }
    actions(ui, ("Light", &hint), &shown, context, conditions::lights);
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
    if !slider.is_pointer_button_down_on() {
        slider.on_hover_text("Drag: evenly in mired (10⁶/T), as in the strip below the diagram");
    }
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
    let matters = Condition::Temperature.matters(context);
    set = field.show(ui, rect, focus && matters, context).or(set);
    if !matters && (focus || set.is_some()) {
        context.view.say(without_effect(context));
    }
    if let Some(kelvin) = set.filter(|kelvin| *kelvin != now) {
        context.push(Action::Scene(SceneAction::SetTemperature(kelvin)));
    }
}

/// Reason that the temperature changes nothing in the workspace, with the remedy.
fn without_effect(context: &PaneContext<'_>) -> String {
    let words = format!("The temperature has no effect on the panes of {}", context.view.saved.workspace.label());
    let light = match &context.scene.document.light {
        _ if shows_sunlight(context) => SUN,
        Light::Set(name) if Condition::Light.matters(context) => name,
        _ => return format!("{words}."),
    };
    format!("{words}: the light is {light}. Choose Blackbody or Daylight under Light.")
}

fn patches(ui: &mut Ui, context: &mut PaneContext<'_>) {
    let document = context.scene.document;
    let now = document.chart.clone();
    let five = document.subset == Subset::Five && context.scene.has_five();
    let short = context.scene.chart_entry(&now).map_or_else(|_| now.clone(), |entry| entry.short);
    let shown = if five { format!("Five of {short}") } else { short };
    let hint = "The reflectances shown: charts, skin, leaves, yours.";
    actions(ui, ("Patches", hint), &shown, context, conditions::patches);
}

fn white(ui: &mut Ui, context: &mut PaneContext<'_>) {
    let now = context.scene.document.white.clone();
    let shown = match &now {
        WhiteBalanceChoice::Unity => "Unity".to_owned(),
        WhiteBalanceChoice::Light(name) => name.clone(),
        WhiteBalanceChoice::Daylight(kelvin) => format!("Daylight {kelvin:.0} K"),
        WhiteBalanceChoice::BlackBody(kelvin) => format!("Blackbody {kelvin:.0} K"),
    };
    let shown = if shows_sunlight(context) { BALANCE.to_owned() } else { shown };
    let hint = "White-balance target: the RGB that a perfect diffuser under the light is mapped to (Eq 11). With a \
                fitted color transform it changes camera RGB only; the matrix compensates for it.";
    actions(ui, ("White balance", hint), &shown, context, conditions::whites);
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
    actions(ui, ("Color transform", hint), &shown, context, conditions::transforms);
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
    actions(ui, ("Difference", hint), now.name(transform.is_eq_13()), context, conditions::differences);
}
