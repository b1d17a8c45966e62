//! A set of the library: its curves, source and terms.

use chromascope_figure::InkRole;
use egui::{Rect, RichText, Sense, Ui, Vec2};

use super::{buttons, copy_text, failure, note};
use crate::catalog::Entry;
use crate::document::SetKind;
use crate::figures::data_set;
use crate::paint;
use crate::panes::context::PaneContext;
use crate::panes::widgets::facts;
use crate::theme::UNIT;

const CURVES: f32 = 104.0;

pub(super) fn show(ui: &mut Ui, kind: SetKind, name: &str, context: &mut PaneContext<'_>) {
    let (scene, theme) = (context.scene, context.theme);
    let entry = match scene.entry(kind, name) {
        Ok(entry) => entry,
        Err(error) => return failure(ui, &theme, &error.to_string()),
    };
    ui.label(RichText::new(&entry.name).strong());
    let also = entry.also.as_ref().map_or_else(String::new, |also| format!(", {also}"));
    note(ui, &theme, format!("{}{also}", kind.singular()));
    curves(ui, &entry, InkRole::Text, context);
    let known = facts::of(&scene, &entry, true);
    facts::show(ui, &theme, &known);
    if buttons(ui, context) {
        let lines: Vec<String> = known.iter().map(|(caption, words)| format!("{caption}\t{words}\n")).collect();
        copy_text(ui, lines.concat(), context);
    }
}

pub(super) fn curves(ui: &mut Ui, entry: &Entry, role: InkRole, context: &PaneContext<'_>) {
    let size = Vec2::new(ui.available_width(), CURVES);
    let panel = match data_set::panel(context.scene.results, entry, role, [f64::from(size.x), f64::from(size.y)]) {
        Ok(Some(panel)) => panel,
        Ok(None) => return,
        Err(error) => return failure(ui, &context.theme, &error.to_string()),
    };
    let (rect, response) = ui.allocate_exact_size(size, Sense::hover());
    response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Image, true, format!("Curves of {}", entry.name)));
    paint::still(ui.painter(), &panel, &context.theme, Rect::from_min_size(rect.min, size));
    ui.add_space(UNIT);
}
