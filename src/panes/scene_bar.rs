//! All conditions in one sentence: seen by a reference, under a light, on patches, through a color transform, in a difference.

use egui::{Align, Button, Layout, Rect, Sense, TextStyle, Ui, UiBuilder, Vec2};

use super::context::PaneContext;
use crate::action::{Action, RenderAction, SceneAction};
use crate::command::Command;
use crate::document::render::{BALANCE, SUN};
use crate::document::{Exaggeration, Light, SetKind, Subset, TransformChoice, WhiteBalanceChoice};
use crate::format::signed;
use crate::panes::widgets::conditions::{self, Listing};
use crate::panes::widgets::number_field::NumberField;
use crate::panes::widgets::pick_list::{self, Line};
use crate::panes::widgets::{self, Icon, lines};
use crate::theme::{ROW, UNIT};
use crate::view::View;
use crate::workspaces::PaneKind;

pub const HEIGHT: f32 = 36.0;
const DIM: f32 = 0.45;
const GAP: f32 = 1.5 * UNIT;
/// The menu of what has no room.
const MORE: f32 = 24.0;

/// A part of the sentence: its words, its control and the widths that this has in wide and narrow windows.
struct Part {
    condition: Condition,
    word: &'static str,
    widths: [f32; 2],
    control: fn(&mut Ui, &mut PaneContext<'_>),
    /// Parts with larger numbers leave a narrow bar first, for the menu at its end.
    leaves: u8,
}

fn parts(context: &PaneContext<'_>) -> Vec<Part> {
    let part = |condition, word, widths, leaves, control| Part { condition, word, widths, control, leaves };
    let is_set = matches!(context.scene.document.light, Light::Set(_));
    let mut parts = vec![
        part(Condition::Reference, "Seen by", [150.0, 112.0], 0, reference as fn(&mut Ui, &mut PaneContext<'_>)),
        part(Condition::Light, "under", [150.0, 104.0], 0, light),
        part(Condition::White, "", [30.0, 30.0], 0, beside_light),
        // The temperature of a light of its own marks the loci alone.
        part(
            Condition::Temperature,
            if is_set { "loci at" } else { "" },
            [66.0, 62.0],
            if is_set { 9 } else { 0 },
            temperature,
        ),
        part(Condition::Patches, "on", [160.0, 118.0], 1, patches),
        part(Condition::Transform, "through", [146.0, 104.0], 2, transform),
        part(Condition::Difference, "in", [90.0, 76.0], 3, difference),
        part(Condition::Exaggeration, "", [68.0, 68.0], 4, exaggeration),
    ];
    if shows_sunlight(context) {
        parts.insert(3, part(Condition::Light, "", [104.0, 104.0], 5, sunlit));
    }
    parts
}

pub fn show(ui: &mut Ui, rect: Rect, context: &mut PaneContext<'_>) {
    let inner = rect.shrink2(Vec2::new(2.0 * UNIT, 0.0));
    let mut bar = ui.new_child(UiBuilder::new().id_salt("scene bar").max_rect(inner));
    bar.set_clip_rect(rect.intersect(ui.clip_rect()));
    let mut parts = parts(context);
    let words = |part: &Part, ui: &Ui| match part.word {
        "" => 0.0,
        word => lines::width(ui, word, TextStyle::Body) + GAP,
    };
    let width = |parts: &[Part], size: usize, ui: &Ui| -> f32 {
        parts.iter().map(|part| words(part, ui) + part.widths[size] + GAP).sum::<f32>() - GAP
    };
    let size = usize::from(width(&parts, 0, &bar) > inner.width());
    let mut left_out = Vec::new();
    while width(&parts, size, &bar) > inner.width() - if left_out.is_empty() { 0.0 } else { MORE + GAP } {
        let Some(last) = (0..parts.len()).max_by_key(|&index| parts[index].leaves) else { break };
        left_out.push(parts.remove(last));
    }
    let mut x = inner.left();
    for part in &parts {
        let word = words(part, &bar);
        let place = |left: f32, width: f32| {
            Rect::from_min_size(egui::pos2(left, inner.center().y - 0.5 * ROW), Vec2::new(width, ROW))
        };
        let control = place(x + word, part.widths[size]);
        field(&mut bar, part, (place(x, word), control), context);
        x = control.right() + GAP;
    }
    if left_out.iter().any(|part| part.condition == Condition::Temperature)
        && std::mem::take(&mut context.view.focus_temperature)
    {
        // The palette takes a number with its unit.
        context.push(Command::FindAnything);
        context.view.say("Type a temperature, such as 5500 K.");
    }
    if !left_out.is_empty() {
        let place = Rect::from_min_size(egui::pos2(x, inner.center().y - 0.5 * ROW), Vec2::new(MORE, ROW));
        more(&mut bar, place, &left_out, context);
    }
}

/// The menu of the parts that have no room, at the end of the sentence.
fn more(ui: &mut Ui, place: Rect, parts: &[Part], context: &mut PaneContext<'_>) {
    let mut child = ui.new_child(UiBuilder::new().id_salt("rest of the sentence").max_rect(place));
    let config =
        egui::containers::menu::MenuConfig::new().close_behavior(egui::PopupCloseBehavior::CloseOnClickOutside);
    let (button, _) =
        egui::containers::menu::MenuButton::from_button(Button::new("›")).config(config).ui(&mut child, |ui| {
            ui.set_min_width(150.0);
            for part in parts {
                let Some(all) = part.condition.listing().filter(|_| part.condition != Condition::White) else {
                    ui.label(part.condition.name());
                    (part.control)(ui, context);
                    continue;
                };
                ui.menu_button(part.condition.name(), |ui| {
                    for (line, action) in all(&context.scene) {
                        if let Some(action) = action
                            && ui.selectable_label(line.on, &line.words).clicked()
                        {
                            context.push(action);
                            ui.close();
                        }
                    }
                });
            }
        });
    lines::labeled(&button, egui::Role::Button, "More conditions");
    button.on_hover_text("Conditions that have no room here");
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
    Exaggeration,
}

impl Condition {
    const fn name(self) -> &'static str {
        match self {
            Self::Reference => "Reference",
            Self::Light => "Light",
            Self::Temperature => "Temperature",
            Self::Patches => "Patches",
            Self::White => "White balance",
            Self::Transform => "Color transform",
            Self::Difference => "Difference",
            Self::Exaggeration => "Exaggerate",
        }
    }

    fn listing(self) -> Option<Listing> {
        let mut all = conditions::ALL.iter();
        all.find(|(name, _)| *name == self.name()).map(|(_, listing)| *listing)
    }

    /// True if a pane shows something that depends on it.
    fn matters_to(self, pane: PaneKind, view: &View, (light, is_eq_13): (&Light, bool)) -> bool {
        // A light of its own has its own temperature: what is set marks the loci alone.
        let is_of_light = self != Self::Temperature || !matches!(light, Light::Set(_));
        if self == Self::Exaggeration {
            let drawn = [PaneKind::CHROMATICITY, PaneKind::DIFFERENCES, PaneKind::SWATCHES, PaneKind::RENDER];
            return drawn.contains(&pane);
        }
        match pane {
            PaneKind::LIBRARY
            | PaneKind::COMPARED
            | PaneKind::SETTINGS
            | PaneKind::IMPORT
            | PaneKind::CURVES
            | PaneKind::INTERPRETATION => false,
            PaneKind::INSPECTOR => view.selected.is_some() || !view.pinned.is_empty(),
            PaneKind::SPECTRA => {
                is_of_light && matches!(self, Self::Reference | Self::Light | Self::Temperature | Self::Patches)
            }
            PaneKind::RENDER | PaneKind::TOLERANCE | PaneKind::STATISTICS => is_of_light && self != Self::Patches,
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
            PaneKind::RENDER | PaneKind::TOLERANCE | PaneKind::STATISTICS if context.scene.is_sunlit() => &sun,
            _ => light,
        };
        if let Some(pane) = view.maximized {
            return self.matters_to(pane, view, (light_of(pane), is_eq_13));
        }
        view.places().into_iter().flatten().any(|pane| self.matters_to(pane, view, (light_of(pane), is_eq_13)))
    }
}

/// True if pictures under the sun are visible, whatever the light of the other panes.
fn shows_sunlight(context: &PaneContext<'_>) -> bool {
    context.scene.is_sunlit() && context.view.is_shown(PaneKind::RENDER)
}

/// A word and a control of a fixed width, so that nothing moves when a value changes; dim where the control does nothing in the
/// workspace.
fn field(ui: &mut Ui, part: &Part, (word, control): (Rect, Rect), context: &mut PaneContext<'_>) {
    let matters = part.condition.matters(context);
    let id = (part.condition, part.leaves);
    let layout = Layout::left_to_right(Align::Center);
    let mut body = ui.new_child(UiBuilder::new().id_salt(id).max_rect(control).layout(layout));
    body.spacing_mut().item_spacing.x = UNIT;
    let mut color = context.theme.weak;
    if !matters {
        body.set_opacity(DIM);
        color = color.gamma_multiply(DIM);
        let place = ui.interact(word.union(control), ui.scope_id().with((id, "dim")), Sense::hover());
        let workspace = context.view.saved.workspace.label();
        place.on_hover_text(format!("{}: no effect on the panes of {workspace}", part.condition.name()));
    }
    if !part.word.is_empty() {
        lines::elided(ui, word, part.word, TextStyle::Body, color);
    }
    (part.control)(&mut body, context);
}

/// A list of the alternatives of a condition. Pushes the action of the one that was chosen.
fn actions(ui: &mut Ui, (name, hint): (&str, &str), shown: &str, context: &mut PaneContext<'_>, all: Listing) {
    let mut made = Vec::new();
    let chosen = pick_list::drop_down(ui, (name, hint), shown, ui.available_width(), &context.theme, || {
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

fn light(ui: &mut Ui, context: &mut PaneContext<'_>) {
    let now = context.scene.document.light.clone();
    let shown = match &now {
        Light::Set(name) => name.clone(),
        Light::BlackBody => "Blackbody".to_owned(),
        Light::Daylight => "Daylight".to_owned(),
    };
    let mut hint = "The light on the scene. Blackbody and Daylight follow the temperature.".to_owned();
    let filters = context.scene.document.filters.clone();
    let shown = match filters.as_slice() {
        [] => shown,
        [filter] => format!("{shown} × {filter}"),
        many => format!("{shown} × {} filters", many.len()),
    };
    for filter in &filters {
        hint.extend(["\nFilter: ", filter]);
    }
    // Where there is a filter, it is taken off beside the list.
    let off = if filters.is_empty() { 0.0 } else { ROW };
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
        hint.extend([format!("\nCCT {:.0} K, Duv {}", cct.temperature.get(), signed(cct.duv))]);
    }
    actions(ui, ("Light", &hint), &shown, context, conditions::lights);
}

/// Says that the pictures are under another light; a click puts them under this one.
fn sunlit(ui: &mut Ui, context: &mut PaneContext<'_>) {
    let hint = format!(
        "The pictures are under {SUN}, balanced to {BALANCE}, by the choice Light and white balance in their settings. Click: \
         they take the light of this bar."
    );
    let button = ui.add_sized(ui.available_size(), Button::new("pictures: sun").small());
    if button.on_hover_text(hint).clicked() {
        let mut to = context.scene.document.render.clone();
        to.sunlight = false;
        context.push(Action::Render(RenderAction::Set { what: "Light and white balance", to: Box::new(to) }));
    }
}

/// What lives with the light: its judgment, filters, white balance.
fn beside_light(ui: &mut Ui, context: &mut PaneContext<'_>) {
    let mut commands = Vec::new();
    let white = white_in_words(&context.scene.document.white);
    let hint = format!("Judge the light; filters; white balance (now {white})");
    let words = ("⋯", "Filter and white balance", hint.as_str());
    let (button, chosen) = pick_list::menu(ui, words, &context.theme, || {
        let judge = (Line::new("Judge this light…", false), Some(Command::GoTo(PaneKind::LIGHT)));
        let listed = |all: Listing, heading: &str| {
            let lines = all(&context.scene).into_iter().map(|(line, action)| (line, action.map(Command::Do)));
            std::iter::once((Line::heading(heading), None)).chain(lines).collect::<Vec<_>>()
        };
        let all = std::iter::once(judge)
            .chain(listed(conditions::whites, "White balance"))
            .chain(listed(conditions::filters, "Filters"));
        let (lines, made): (Vec<Line>, Vec<Option<Command>>) = all.unzip();
        commands = made;
        lines
    });
    widgets::labeled(&button, egui::Role::Button, format!("White balance: {white}"));
    if let Some(command) = chosen.and_then(|index| commands.swap_remove(index)) {
        context.push(command);
    }
}

fn white_in_words(white: &WhiteBalanceChoice) -> String {
    match white {
        WhiteBalanceChoice::Unity => "Unity".to_owned(),
        WhiteBalanceChoice::Light(name) => name.clone(),
        WhiteBalanceChoice::Daylight(kelvin) => format!("Daylight {kelvin:.0} K"),
        WhiteBalanceChoice::BlackBody(kelvin) => format!("Blackbody {kelvin:.0} K"),
    }
}

fn temperature(ui: &mut Ui, context: &mut PaneContext<'_>) {
    let now = context.scene.document.temperature_k;
    let [coldest, hottest] = crate::document::LOCUS_RANGE_K;
    let coldest = if context.scene.document.light == Light::Daylight { 4000.0 } else { coldest };
    let field = NumberField {
        id: egui::Id::unique("temperature in kelvins"),
        now,
        range: [coldest, hottest],
        speed: 10.0,
        unit: "K",
        name: "Temperature in kelvins",
        hint: if matches!(context.scene.document.light, Light::Set(_)) {
            "Temperature that is marked on the loci: drag, or click and type (T)"
        } else {
            "Temperature of the light, marked on the loci: drag, or click and type (T)"
        },
    };
    let (rect, _) = ui.allocate_exact_size(Vec2::new(ui.available_width().min(66.0), ROW), Sense::hover());
    let focus = std::mem::take(&mut context.view.focus_temperature);
    let matters = Condition::Temperature.matters(context);
    let set = field.show(ui, rect, focus && matters, context);
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
                reflectances and weights are chosen under Matrix in Rank.";
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

/// One small list, in the color of a warning while differences are not drawn as they are.
fn exaggeration(ui: &mut Ui, context: &mut PaneContext<'_>) {
    let now = context.scene.document.exaggeration;
    if now != Exaggeration::One {
        ui.visuals_mut().override_text_color = Some(context.theme.warning);
    }
    let hint = "Differences from the reference as they are drawn, in the diagram, differences, swatches and pictures; \
                numbers stay as they are.";
    actions(ui, ("Exaggerate", hint), now.label(), context, conditions::exaggerations);
}
