//! The pane's column: the legend above, the search and the list below.

use egui::{Key, Rect, ScrollArea, TextEdit, Ui, UiBuilder, Vec2};

use super::{compared, sets};
use crate::panes::PaneContext;
use crate::theme::{ROW, UNIT};
use crate::workspaces::PaneKind;

/// So many compared sources stand without scrolling.
const WITHOUT_SCROLLING: usize = 10;

/// Shows the pane in its rectangle.
pub fn show(ui: &mut Ui, rect: Rect, context: &mut PaneContext<'_>) {
    ui.painter().rect_filled(rect, 0.0, context.theme.panel);
    if ui.input(|input| input.pointer.any_pressed() && input.pointer.interact_pos().is_some_and(|at| rect.contains(at)))
    {
        context.view.focused = Some(PaneKind::Library);
    }
    context.view.keeps_escape = false;
    let inner = rect.shrink2(Vec2::new(2.0 * UNIT, UNIT));
    let mut column = ui.new_child(UiBuilder::new().id_salt("library").max_rect(inner));
    column.set_clip_rect(rect.intersect(ui.clip_rect()));
    column.spacing_mut().item_spacing.y = UNIT;
    heading(&mut column, "Compared", context);
    let sources = context.scene.sources();
    let pitch = ROW + UNIT;
    let wanted = pitch * sources.len() as f32;
    let most = (pitch * WITHOUT_SCROLLING as f32).min((inner.height() * 0.45).max(3.0 * pitch));
    let area = ScrollArea::vertical().id_salt("compared").max_height(most).auto_shrink([false, true]);
    area.show(&mut column, |ui| {
        if wanted > most {
            ui.set_max_width(ui.available_width() - sets::SCROLL_BAR);
        }
        for source in &sources {
            compared::row(ui, source, context);
        }
    });
    column.separator();
    heading(&mut column, "Library", context);
    let rows = sets::rows(context);
    let chosen = search_field(&mut column, context);
    if chosen && let Some(entry) = sets::first_match(&rows) {
        sets::choose(entry, true, context);
    }
    sets::list(&mut column, &rows, context);
}

fn heading(ui: &mut Ui, words: &str, context: &PaneContext<'_>) {
    let (rect, response) = ui.allocate_exact_size(Vec2::new(ui.available_width(), ROW - UNIT), egui::Sense::hover());
    response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Label, true, words));
    crate::widgets::lines::elided(ui, rect, words, egui::TextStyle::Body, context.theme.text);
}

/// The field that the list is searched with. Returns whether the first match was chosen with Enter.
fn search_field(ui: &mut Ui, context: &mut PaneContext<'_>) -> bool {
    let id = ui.scope_id().with("search");
    let count = context.scene.catalog.entries().len() + context.scene.document.own.len();
    let hint = format!("Search {count} sets, Ctrl+F");
    let search = &mut context.view.search;
    let field = TextEdit::singleline(search).id(id).hint_text(hint).margin(egui::Margin::symmetric(6, 4));
    let response = ui.add_sized([ui.available_width(), ROW], field);
    response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::TextInput, true, "Search the library"));
    if std::mem::take(&mut context.view.focus_search) {
        response.request_focus();
        mark_all(ui, id, &context.view.search);
    }
    context.view.keeps_escape |= response.has_focus() && !context.view.search.is_empty();
    if response.lost_focus() {
        // The key itself was taken by the program before; that it is down remains.
        if ui.input(|input| input.key_down(Key::Escape)) {
            context.view.search.clear();
        }
        return ui.input(|input| input.key_pressed(Key::Enter)) && !context.view.search.trim().is_empty();
    }
    false
}

/// Marks what is in the field, so that typing replaces it.
fn mark_all(ui: &Ui, id: egui::Id, text: &str) {
    use egui::text::{CCursor, CCursorRange};
    let mut state = TextEdit::load_state(ui.ctx(), id).unwrap_or_default();
    let all = CCursorRange::two(CCursor::new(0), CCursor::new(text.chars().count()));
    state.cursor.set_char_range(Some(all));
    state.store(ui.ctx(), id);
}
