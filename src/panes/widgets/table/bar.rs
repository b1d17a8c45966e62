//! The bar over a table: filter, number of rows, columns, copying.

use chromascope_figure::Column;
use egui::{Align, Layout, Rect, RichText, ScrollArea, TextEdit, Ui};

use super::{DataTable, TableLook, cut};
use crate::panes::context::PaneContext;
use crate::theme::UNIT;

/// Maximum and minimum width of the filter, and the width of the controls beside it.
const FILTER: [f32; 2] = [132.0, 48.0];
const BESIDE: f32 = 192.0;
const MENU: f32 = 360.0;

impl DataTable<'_> {
    /// Shows the bar. Returns whether the rows are to be copied.
    pub(super) fn bar(
        &self,
        ui: &mut Ui,
        rect: Rect,
        look: &mut TableLook,
        rows: usize,
        context: &mut PaneContext<'_>,
    ) -> bool {
        let mut child = cut(ui, ui.scope_id().with((self.id, "bar")), rect);
        child
            .with_layout(Layout::left_to_right(Align::Center), |ui| {
                self.filter(ui, look, context);
                let all = self.table.rows.len();
                let words = if rows == all { format!("{all} rows") } else { format!("{rows} of {all}") };
                ui.label(RichText::new(words).small().color(context.theme.weak));
                if !look.filter.is_empty() && ui.button("Clear").on_hover_text("Show all rows").clicked() {
                    look.filter.clear();
                }
                ui.menu_button("Columns", |ui| menu(ui, &self.table.columns, look))
                    .response
                    .on_hover_text("Choose columns");
                let hint = "Copy rows and columns as shown, in full precision (Ctrl+C)";
                ui.button("Copy").on_hover_text(hint).clicked()
            })
            .inner
    }

    fn filter(&self, ui: &mut Ui, look: &mut TableLook, context: &mut PaneContext<'_>) {
        let id = ui.scope_id().with((self.id, "filter"));
        let edit = TextEdit::singleline(&mut look.filter)
            .id(id)
            .hint_text("Filter")
            .desired_width((ui.available_width() - BESIDE).clamp(FILTER[1], FILTER[0]));
        let response = ui.add(edit.align(egui::Align2::LEFT_CENTER).margin(egui::Margin::symmetric(4, 3)));
        response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::TextInput, true, "Filter rows"));
        let escaped = response.lost_focus() && ui.input(|input| input.key_down(egui::Key::Escape));
        if escaped {
            look.filter.clear();
        }
        // Escape empties the filter, and nothing else.
        context.view.keeps_escape |= response.has_focus() || escaped;
        response.on_hover_text("Rows that contain all these words");
    }
}

/// A box for each column but the first, which stays.
fn menu(ui: &mut Ui, columns: &[Column], look: &mut TableLook) {
    ui.horizontal(|ui| {
        let mut all = |shown: bool| {
            look.columns = columns.iter().skip(1).map(|column| (column.name.clone(), shown)).collect();
        };
        if ui.button("All").clicked() {
            all(true);
        }
        if ui.button("None").clicked() {
            all(false);
        }
        if ui.button("As at first").clicked() {
            look.columns.clear();
        }
    });
    ScrollArea::vertical().max_height(MENU).show(ui, |ui| {
        let mut group = "";
        for column in columns.iter().skip(1) {
            if column.group != group {
                group = &column.group;
                ui.add_space(UNIT);
                ui.label(RichText::new(group).small().weak());
            }
            let mut shown = look.columns.get(&column.name).copied().unwrap_or(!column.starts_hidden);
            if ui.checkbox(&mut shown, column.full_name()).on_hover_text(&column.hint).changed() {
                look.columns.insert(column.name.clone(), shown);
            }
        }
    });
}
