//! Channels of a camera; name of a set; and a set whose file is not available: what can be changed by its values alone.

use egui::{Id, RichText, TextEdit, Ui};
use spectral_file::{Certainty, Values, WavelengthUnit};

use super::{Closed, caption, list};
use crate::action::{Action, ImportedAction};
use crate::document::SetKind;
use crate::document::imported::{ImportOverrides, ImportedSet, Role};
use crate::document::names::Holder;
use crate::figures::curves::{ImportSelection, places};
use crate::panes::context::PaneContext;
use crate::panes::widgets::{self, segmented};
use crate::plot_item::PlotItem;
use crate::theme::{Theme, UNIT};

/// Shows the set with controls; every change is one step of undo.
pub(super) fn show(ui: &mut Ui, set: &ImportedSet, context: &mut PaneContext<'_>) {
    let theme = context.theme;
    name(ui, set, context);
    let curves = match set.curves.len() {
        1 => "curve is".to_owned(),
        count => format!("{count} curves are"),
    };
    widgets::note(ui, format!("{} is not available. Its {curves} stored in the session.", set.file));
    let mut changed = set.clone();
    choices(ui, &mut changed, &theme);
    if changed.role == Role::Camera {
        camera(ui, &mut changed, &theme);
    }
    if let Some(sentence) = trouble(set, context) {
        ui.label(RichText::new(sentence).color(theme.error));
    }
    ui.add_space(UNIT);
    if !set.decisions.is_empty() {
        ui.label("Decisions");
    }
    for decision in &set.decisions {
        ui.label(RichText::new(decision).small());
    }
    if changed != *set {
        follow(set, &mut changed);
        let (name, built_in) = (set.name.clone(), context.scene.catalog.names().clone());
        context.push(Action::Imported(ImportedAction::Replace { name, with: Box::new(changed), built_in }));
    }
}

/// Has the file, when it comes back, read as the set was changed.
fn follow(before: &ImportedSet, changed: &mut ImportedSet) {
    let places = places(before);
    let options = &mut changed.overrides.options;
    if changed.role != before.role {
        options.role = Some(changed.role);
    }
    if changed.unit != before.unit {
        options.wavelength_unit = Some(changed.unit);
    }
    if changed.percent != before.percent {
        options.values = Some(if changed.percent { Values::Percent } else { Values::Plain });
    }
    if changed.per_photon != before.per_photon {
        changed.overrides.per_photon = Some(changed.per_photon);
    }
    if changed.channels != before.channels {
        changed.overrides.channels = Some(changed.channels.map(|index| places.get(index).copied().unwrap_or(index)));
    }
}

fn plain(value: &str) -> Closed {
    Closed { value: value.to_owned(), ..Closed::default() }
}

fn choice<T: Copy + PartialEq>(ui: &mut Ui, theme: &Theme, words: &str, choices: &[(T, &str)], value: &mut T) {
    let width = ui.available_width() - 2.0;
    let shown = choices.iter().find(|(choice, _)| choice == value).map_or("", |(_, words)| words);
    let entries: Vec<(String, bool)> = choices.iter().map(|(c, words)| ((*words).to_owned(), c == value)).collect();
    if let Some((choice, _)) =
        list(ui, theme, words, &plain(shown), &entries, width).and_then(|index| choices.get(index))
    {
        *value = *choice;
    }
}

fn choices(ui: &mut Ui, set: &mut ImportedSet, theme: &Theme) {
    choice(ui, theme, "This is a", Role::CHOICES, &mut set.role);
    choice(ui, theme, "Wavelengths in", WavelengthUnit::CHOICES, &mut set.unit);
    ui.checkbox(&mut set.percent, "Values are percent");
}

fn camera(ui: &mut Ui, set: &mut ImportedSet, theme: &Theme) {
    let width = ui.available_width() - 2.0;
    for (channel, color) in ["Red", "Green", "Blue"].into_iter().enumerate() {
        let now = set.channels[channel];
        let shown = set.curves.get(now).map_or_else(|| format!("column {} is missing", now + 1), |c| c.name.clone());
        let entries: Vec<(String, bool)> =
            set.curves.iter().enumerate().map(|(index, curve)| (curve.name.clone(), index == now)).collect();
        if let Some(index) = list(ui, theme, color, &plain(&shown), &entries, width) {
            set.channels[channel] = index;
        }
    }
    ui.horizontal(|ui| {
        caption(ui, theme, "Response", false);
        if let Some(per_photon) = segmented(ui, &RESPONSES, set.per_photon) {
            set.per_photon = per_photon;
        }
    });
}

fn trouble(set: &ImportedSet, context: &PaneContext<'_>) -> Option<String> {
    match set.role {
        Role::Camera => context.scene.sensor(SetKind::Camera, &set.name).err().map(|error| error.to_string()),
        _ => match set.curves_in_nm() {
            Ok(curves) if curves.is_empty() => Some(format!("{}: no curve found", set.name)),
            Ok(_) => None,
            Err(error) => Some(format!("{}: {error}", set.name)),
        },
    }
}

pub(super) fn name(ui: &mut Ui, set: &ImportedSet, context: &mut PaneContext<'_>) {
    let theme = context.theme;
    let id = Id::unique("name of the set that is read");
    let kept: Option<(String, String)> = ui.data(|data| data.get_temp(id));
    let mut text = kept.filter(|(of, _)| *of == set.name).map_or_else(|| set.name.clone(), |(_, text)| text);
    let document = context.scene.document;
    let index = document.own.iter().position(|other| other.name == set.name);
    let kind = SetKind::of_own(set);
    let built_in = context.scene.catalog.names();
    let holder = |name: &str| document.holder_of(kind, name, index, built_in).filter(|_| name != set.name);
    caption(ui, &theme, "Name", false);
    let field = ui.add(TextEdit::singleline(&mut text).id(id.with("field")).desired_width(f32::INFINITY));
    widgets::labeled(&field, egui::Role::TextInput, "Name of the set");
    let sentence = match holder(text.trim()) {
        None => "",
        Some(Holder::Own) => "Another imported data set has this name.",
        Some(Holder::BuiltIn) => "A built-in data set has this name; choose another.",
    };
    if !sentence.is_empty() {
        ui.label(RichText::new(sentence).color(theme.error));
    }
    let mut accepted = None;
    if field.lost_focus() {
        accepted = Some(text.trim().to_owned()).filter(|name| !name.is_empty() && sentence.is_empty());
        if !sentence.is_empty() {
            context.view.fail(format!("{}: {sentence} It is still called {}.", text.trim(), set.name));
        }
        text = accepted.clone().unwrap_or_else(|| set.name.clone());
    }
    ui.data_mut(|data| data.insert_temp(id, (set.name.clone(), text)));
    if let Some(name) = accepted.filter(|name| *name != set.name) {
        let with = ImportedSet { name: name.clone(), ..set.clone() };
        let built_in = built_in.clone();
        context.push(Action::Imported(ImportedAction::Replace {
            name: set.name.clone(),
            with: Box::new(with),
            built_in,
        }));
        follow_name(&set.name, &name, context);
    }
}

fn follow_name(old: &str, new: &str, context: &mut PaneContext<'_>) {
    if let Some(PlotItem::Sensor(id)) = &mut context.view.selected
        && id.kind == SetKind::Camera
        && id.name == old
    {
        new.clone_into(&mut id.name);
    }
}

const LISTED: usize = 500;

/// Responses per energy and per photon.
const RESPONSES: [(bool, &str, &str); 2] = [
    (false, "per energy", "To equal power at each wavelength"),
    (true, "per photon", "To equal numbers of photons, as quantum efficiencies are given"),
];

pub(super) fn channels(ui: &mut Ui, shown: &ImportSelection, overrides: &mut ImportOverrides, theme: &Theme) {
    let Some(table) = shown.table().filter(|table| table.role.value == Role::Camera) else { return };
    let found = table.reading.camera_columns;
    let mut channels = overrides.channels.or(found).unwrap_or([0, 1, 2]);
    let width = ((ui.available_width() - 2.0 - 4.0 * UNIT) / 3.0).floor();
    let mut chosen = None;
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = 2.0 * UNIT;
        for (channel, color) in ["Red", "Green", "Blue"].into_iter().enumerate() {
            let name = table.curves.get(channels[channel]).map_or("missing", |curve| curve.name.as_str());
            let guess = overrides.channels.is_none() && found.is_none();
            let how = if guess { "guess" } else { "" };
            let why = if overrides.channels.is_some() {
                "Chosen by hand"
            } else {
                "From the names or the peaks of the curves"
            };
            let closed = Closed { value: name.to_owned(), how: how.to_owned(), guess, why: why.to_owned() };
            let entries: Vec<(String, bool)> = table
                .curves
                .iter()
                .take(LISTED)
                .enumerate()
                .map(|(place, curve)| (curve.name.clone(), place == channels[channel]))
                .collect();
            if let Some(place) = list(ui, theme, color, &closed, &entries, width) {
                chosen = Some((channel, place));
            }
        }
    });
    if let Some((channel, place)) = chosen {
        // Two channels change places rather than being the same curve.
        if let Some(other) = channels.iter().position(|known| *known == place) {
            channels[other] = channels[channel];
        }
        channels[channel] = place;
        overrides.channels = Some(channels).filter(|channels| Some(*channels) != found);
        let mut taken = shown.taken();
        if !taken.contains(&place) {
            taken.push(place);
            taken.sort_unstable();
            overrides.taken = Some(taken);
        }
    }
    let said = table.reading.per_photon.as_ref();
    let before = || shown.set.as_ref().is_some_and(|set| set.per_photon);
    let per_photon = overrides.per_photon.or(said.map(|said| said.value)).unwrap_or_else(before);
    let guess = overrides.per_photon.is_none() && said.is_none_or(|said| said.certainty == Certainty::Guess);
    ui.horizontal(|ui| {
        caption(ui, theme, if guess { "Response (guess)" } else { "Response" }, guess);
        ui.add_space(3.0 * UNIT);
        if let Some(per_photon) = segmented(ui, &RESPONSES, per_photon) {
            overrides.per_photon = Some(per_photon);
        }
    });
}
