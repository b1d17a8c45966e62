//! The list of reflectances.

use egui::{ComboBox, ScrollArea, TextEdit, Ui};

use super::set;
use crate::catalog::{Entry, names};
use crate::document::SetKind;
use crate::panes::context::PaneContext;
use crate::panes::widgets::facts;
use crate::theme::ROW;

/// A list of all reflectances, with a field to search it.
pub(super) fn choice(ui: &mut Ui, now: &str, context: &mut PaneContext<'_>) {
    let combo = ComboBox::from_id_salt("material")
        .width(ui.available_width())
        .height(16.0 * ROW)
        .truncate()
        .close_behavior(egui::PopupCloseBehavior::CloseOnClickOutside)
        .selected_text(now);
    let response = combo.show_ui(ui, |ui| {
        ui.set_min_width(280.0);
        let field = TextEdit::singleline(&mut context.view.render.material_search);
        let field = ui.add(field.hint_text("Search materials").desired_width(f32::INFINITY));
        field.widget_info(|| egui::WidgetInfo::labeled(egui::Role::TextInput, true, "Search materials"));
        let rows = rows(context);
        if rows.is_empty() {
            ui.label("No match.");
        }
        ScrollArea::vertical().max_height(12.0 * ROW).show_rows(ui, ROW - 4.0, rows.len(), |ui, range| {
            for row in &rows[range] {
                match row {
                    Row::Group(words) => {
                        ui.label(egui::RichText::new(words).small().color(context.theme.weak));
                    }
                    Row::Set(entry) => {
                        let response = ui.selectable_label(entry.name == now, &entry.name);
                        let response = response.on_hover_ui(|ui| {
                            facts::tooltip(ui, &context.scene, &context.theme, entry);
                        });
                        if response.clicked() {
                            let name = entry.name.clone();
                            set(context, "Material", |settings| settings.material = name);
                            context.view.render.material_search.clear();
                            ui.close();
                        }
                    }
                }
            }
        });
    });
    response.response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::ComboBox, true, format!("Material: {now}")));
}

enum Row {
    Group(String),
    Set(Box<Entry>),
}

/// The user's own reflectances, then the built-in ones by file, as far as they match.
fn rows(context: &PaneContext<'_>) -> Vec<Row> {
    let search = &context.view.render.material_search;
    let own = context.scene.entries(SetKind::Chart).filter(Entry::is_own);
    let all = own.chain(context.scene.entries(SetKind::Material));
    let mut rows = Vec::new();
    let mut last = String::new();
    let mut found: Vec<Entry> = all.filter(|entry| names::matches_search(entry, search)).collect();
    found.sort_by_cached_key(|entry| (!entry.is_own(), entry.also.clone()));
    for entry in found {
        let group = entry.also.clone().unwrap_or_else(|| "Others".to_owned());
        if group != last {
            rows.push(Row::Group(group.clone()));
            last = group;
        }
        rows.push(Row::Set(Box::new(entry)));
    }
    rows
}
