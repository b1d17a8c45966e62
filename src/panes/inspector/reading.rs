//! What was decided on reading a set of the user's, and how to change it.

use egui::{ComboBox, Id, RichText, TextEdit, Ui};

use super::{failure, note};
use crate::action::{Action, OwnAction};
use crate::catalog::Kind;
use crate::document::own::{OwnRole, OwnSet, OwnUnit};
use crate::panes::PaneContext;
use crate::theme::{ROW, UNIT};
use crate::thing::Thing;
use crate::widgets::segmented;

/// Shows the set's reading with controls; every change is one step of undo.
pub(super) fn show(ui: &mut Ui, name: &str, context: &mut PaneContext<'_>) {
    let theme = context.theme;
    let Some(set) = context.scene.document.own.iter().find(|set| set.name == name).cloned() else { return };
    let mut changed = OwnSet::clone(&set);
    ui.label(RichText::new("Reading").strong());
    note(ui, &theme, format!("{}, {} curves", set.file, set.curves.len()));
    ui.add_space(UNIT);
    name_field(ui, &mut changed, context);
    choices(ui, &mut changed);
    if changed.role == OwnRole::Camera {
        camera(ui, &mut changed);
    }
    if let Some(sentence) = trouble(&set, context) {
        failure(ui, &theme, &sentence);
    }
    ui.add_space(UNIT);
    ui.horizontal_wrapped(|ui| {
        if context.view.reading.is_some() && ui.button("Done").clicked() {
            context.view.reading = None;
        }
        if ui.button("Remove").on_hover_text("Take the set out; Undo brings it back").clicked() {
            context.view.reading = None;
            context.view.selected = None;
            context.push(Action::Own(OwnAction::Remove(name.to_owned())));
        }
    });
    note(ui, &theme, "Decided on reading:");
    for decision in &set.decisions {
        ui.label(RichText::new(decision).small());
    }
    if changed != *set {
        follow_name(name, &changed.name, context);
        context.push(Action::Own(OwnAction::Replace { name: name.to_owned(), with: Box::new(changed) }));
    }
}

/// Keeps what is looked at on a set whose name changes.
fn follow_name(old: &str, new: &str, context: &mut PaneContext<'_>) {
    if old == new {
        return;
    }
    if context.view.reading.is_some() {
        context.view.reading = Some(new.to_owned());
    }
    if let Some(Thing::Source(id)) = &mut context.view.selected
        && id.kind == Kind::Camera
        && id.name == old
    {
        new.clone_into(&mut id.name);
    }
}

fn caption(ui: &mut Ui, words: &str) -> egui::Response {
    let (rect, response) = ui.allocate_exact_size(egui::Vec2::new(76.0, ROW), egui::Sense::hover());
    let color = ui.visuals().weak_text_color();
    crate::widgets::lines::elided(ui, rect, words, egui::TextStyle::Small, color);
    response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Label, true, words));
    response
}

/// The name, taken over with Enter or when the field is left.
fn name_field(ui: &mut Ui, set: &mut OwnSet, context: &PaneContext<'_>) {
    let id = Id::unique("name of the set that is read");
    let kept: Option<(String, String)> = ui.data(|data| data.get_temp(id));
    let mut text = kept.filter(|(of, _)| *of == set.name).map_or_else(|| set.name.clone(), |(_, text)| text);
    let taken = |name: &str| context.scene.document.own.iter().any(|other| other.name == name) && name != set.name;
    let mut accepted = None;
    ui.horizontal(|ui| {
        let words = caption(ui, "Name");
        let field = ui.add(TextEdit::singleline(&mut text).id(id.with("field")).desired_width(f32::INFINITY));
        let field = field.labelled_by(words.id);
        field.widget_info(|| egui::WidgetInfo::labeled(egui::Role::TextInput, true, "Name of the set"));
        if field.lost_focus() {
            accepted = Some(text.trim().to_owned()).filter(|name| !name.is_empty() && !taken(name));
            text = accepted.clone().unwrap_or_else(|| set.name.clone());
        }
    });
    if taken(text.trim()) {
        failure(ui, &context.theme, "Another set of yours has this name.");
    }
    ui.data_mut(|data| data.insert_temp(id, (set.name.clone(), text)));
    if let Some(name) = accepted {
        set.name = name;
    }
}

/// Role, unit and percent.
fn choices(ui: &mut Ui, set: &mut OwnSet) {
    ui.horizontal_wrapped(|ui| {
        caption(ui, "Used as");
        let roles = [
            (OwnRole::Camera, "Camera", "Three sensitivities"),
            (OwnRole::Reflectance, "Reflectance", "Patches"),
            (OwnRole::Illuminant, "Light", "A light; its first curve"),
        ];
        if let Some(role) = segmented(ui, &roles, set.role) {
            set.role = role;
        }
    });
    ui.horizontal_wrapped(|ui| {
        caption(ui, "Wavelengths");
        let units = [
            (OwnUnit::Nanometers, "nm", "Nanometers"),
            (OwnUnit::Micrometers, "µm", "Micrometers"),
            (OwnUnit::Angstroms, "Å", "Ångströms"),
        ];
        if let Some(unit) = segmented(ui, &units, set.unit) {
            set.unit = unit;
        }
    });
    if set.role == OwnRole::Reflectance {
        ui.checkbox(&mut set.percent, "Values are percent");
    }
}

/// Channels, and what they count.
fn camera(ui: &mut Ui, set: &mut OwnSet) {
    let names: Vec<String> = set.curves.iter().map(|curve| curve.name.clone()).collect();
    for (channel, color) in ["Red", "Green", "Blue"].into_iter().enumerate() {
        ui.horizontal(|ui| {
            caption(ui, color);
            let missing = format!("column {} is missing", set.channels[channel] + 1);
            let shown = names.get(set.channels[channel]).cloned().unwrap_or(missing);
            let combo = ComboBox::from_id_salt(("channel", channel)).width(ui.available_width() - UNIT).truncate();
            let response = combo
                .selected_text(&shown)
                .show_ui(ui, |ui| {
                    for (index, name) in names.iter().enumerate() {
                        ui.selectable_value(&mut set.channels[channel], index, name);
                    }
                })
                .response;
            response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::ComboBox, true, format!("{color}: {shown}")));
        });
    }
    ui.horizontal_wrapped(|ui| {
        caption(ui, "Response");
        let responses = [
            (false, "per energy", "To equal power at each wavelength"),
            (true, "per photon", "To equal numbers of photons, as quantum efficiencies are given"),
        ];
        if let Some(per_photon) = segmented(ui, &responses, set.per_photon) {
            set.per_photon = per_photon;
        }
    });
}

/// Why the set cannot be used as it is read now, if so.
fn trouble(set: &OwnSet, context: &PaneContext<'_>) -> Option<String> {
    match set.role {
        OwnRole::Camera => context.scene.sensor(Kind::Camera, &set.name).err().map(|error| error.to_string()),
        OwnRole::Reflectance | OwnRole::Illuminant => match set.curves_in_nm() {
            Ok(curves) if curves.is_empty() => Some(format!("{}: it has no curve", set.name)),
            Ok(_) => None,
            Err(error) => Some(format!("{}: {error}", set.name)),
        },
    }
}
