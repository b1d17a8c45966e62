//! The name of a set, taken over with Enter or when the field is left.

use egui::{Id, RichText, TextEdit, Ui};

use super::caption;
use crate::action::{Action, OwnAction};
use crate::catalog::Kind;
use crate::document::own::OwnSet;
use crate::panes::PaneContext;
use crate::thing::Thing;

/// Shows the field.
pub(super) fn show(ui: &mut Ui, set: &OwnSet, context: &mut PaneContext<'_>) {
    let theme = context.theme;
    let id = Id::unique("name of the set that is read");
    let kept: Option<(String, String)> = ui.data(|data| data.get_temp(id));
    let mut text = kept.filter(|(of, _)| *of == set.name).map_or_else(|| set.name.clone(), |(_, text)| text);
    let own = &context.scene.document.own;
    let taken = |name: &str| own.iter().any(|other| other.name == name) && name != set.name;
    caption(ui, &theme, "Name", false);
    let field = ui.add(TextEdit::singleline(&mut text).id(id.with("field")).desired_width(f32::INFINITY));
    field.widget_info(|| egui::WidgetInfo::labeled(egui::Role::TextInput, true, "Name of the set"));
    let mut accepted = None;
    if field.lost_focus() {
        accepted = Some(text.trim().to_owned()).filter(|name| !name.is_empty() && !taken(name));
        text = accepted.clone().unwrap_or_else(|| set.name.clone());
    }
    if taken(text.trim()) {
        ui.label(RichText::new("Another set of yours has this name.").color(theme.error));
    }
    ui.data_mut(|data| data.insert_temp(id, (set.name.clone(), text)));
    if let Some(name) = accepted.filter(|name| *name != set.name) {
        let with = OwnSet { name: name.clone(), ..set.clone() };
        context.push(Action::Own(OwnAction::Replace { name: set.name.clone(), with: Box::new(with) }));
        follow(&set.name, &name, context);
    }
}

/// Keeps what is looked at on a set whose name changes.
fn follow(old: &str, new: &str, context: &mut PaneContext<'_>) {
    context.view.import.rename(old, new);
    if let Some(Thing::Source(id)) = &mut context.view.selected
        && id.kind == Kind::Camera
        && id.name == old
    {
        new.clone_into(&mut id.name);
    }
}
