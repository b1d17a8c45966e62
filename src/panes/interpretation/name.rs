//! The name of a set, taken over with Enter or when the field is left.

use egui::{Id, RichText, TextEdit, Ui};

use super::caption;
use crate::action::{Action, ImportedAction};
use crate::document::SetKind;
use crate::document::imported::ImportedSet;
use crate::document::names::Holder;
use crate::panes::context::PaneContext;
use crate::plot_item::PlotItem;

pub(super) fn show(ui: &mut Ui, set: &ImportedSet, context: &mut PaneContext<'_>) {
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
    field.widget_info(|| egui::WidgetInfo::labeled(egui::Role::TextInput, true, "Name of the set"));
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
        follow(&set.name, &name, context);
    }
}

fn follow(old: &str, new: &str, context: &mut PaneContext<'_>) {
    if let Some(PlotItem::Sensor(id)) = &mut context.view.selected
        && id.kind == SetKind::Camera
        && id.name == old
    {
        new.clone_into(&mut id.name);
    }
}
