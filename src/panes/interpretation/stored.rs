//! A set whose file is not available: what can be changed by its values alone.

use egui::{RichText, Ui};
use spectral_file::{Values, WavelengthUnit};

use super::camera::RESPONSES;
use super::{Closed, caption, list, name};
use crate::action::{Action, ImportedAction};
use crate::document::SetKind;
use crate::document::imported::{ImportedSet, Role};
use crate::figures::curves::places;
use crate::panes::context::PaneContext;
use crate::panes::widgets::{self, segmented};
use crate::theme::{Theme, UNIT};

/// Shows the set with controls; every change is one step of undo.
pub(super) fn show(ui: &mut Ui, set: &ImportedSet, context: &mut PaneContext<'_>) {
    let theme = context.theme;
    name::show(ui, set, context);
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
    Closed { value: value.to_owned(), how: String::new(), guess: false, why: String::new() }
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

/// Reason that the set cannot be used as it is read now, if so.
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
