//! Compared sensors, which are the only legend, with their differences; and cameras to be added.

mod row;
mod sets;

use std::collections::HashSet;

use egui::{Id, Key, Rect, ScrollArea, TextEdit, Ui, UiBuilder, Vec2};

use crate::document::SetKind;
use crate::panes::context::{Pane, PaneContext};
use crate::panes::widgets::sets::choose;
use crate::panes::widgets::{self, mark_all};
use crate::theme::{ROW, UNIT};
use crate::workspaces::PaneKind;

/// While cameras are added: share of the height for the compared sensors, and their least and most rows.
const ADDING: (f32, [f32; 2]) = (0.36, [3.0, 8.0]);

pub const PANE: Pane = Pane::new(PaneKind::COMPARED, "Compared", show);

fn show(ui: &mut Ui, rect: Rect, context: &mut PaneContext<'_>) {
    widgets::ground(ui, PANE.kind, rect, context);
    let inner = rect.shrink2(Vec2::new(2.0 * UNIT, UNIT));
    let mut column = ui.new_child(UiBuilder::new().id_salt("compared pane").max_rect(inner));
    column.set_clip_rect(rect.intersect(ui.clip_rect()));
    column.spacing_mut().item_spacing.y = UNIT;
    heading(&mut column, context);
    let enters = widgets::walk::has_keys(&column, PANE.kind, context)
        && column.input_mut(|input| input.consume_key(egui::Modifiers::NONE, Key::ArrowDown))
        || context.view.focused == Some(PANE.kind) && std::mem::take(&mut context.view.tab_enters);
    if let Some(first) = context.scene.sources().first().filter(|_| enters) {
        row::focus(&column, first);
    }
    compared(&mut column, inner.height(), context);
    let words = if context.view.adding { "Done" } else { "Add camera…" };
    let add = column.add_sized([inner.width(), ROW], egui::Button::new(words));
    if add.on_hover_text("Choose from all cameras and observers (Ctrl+F)").clicked() {
        context.view.adding ^= true;
        context.view.focus_search = context.view.adding;
    }
    if context.view.adding {
        let rows = sets::rows(context);
        let chosen = search_field(&mut column, context);
        if chosen && let Some(entry) = rows.iter().find_map(sets::Row::entry) {
            choose(&entry, true, context);
        }
        sets::list(&mut column, &rows, context);
    }
}

/// The compared sensors. While cameras are added, their list has a fixed height, so that nothing below moves.
fn compared(ui: &mut Ui, height: f32, context: &mut PaneContext<'_>) {
    let sources = context.scene.sources();
    let pitch = ROW + UNIT;
    let (share, [least, most]) = ADDING;
    let room = (height / pitch).floor() - 3.0;
    let rows = if context.view.adding {
        (share * height / pitch).floor().clamp(least, most)
    } else {
        room.min(sources.len() as f32)
    };
    let seen = Id::unique("compared sensors seen");
    let now: Vec<(SetKind, String)> = sources.iter().map(|source| (source.kind, source.name.clone())).collect();
    let before: Option<Vec<(SetKind, String)>> = ui.data(|data| data.get_temp(seen));
    let area = ScrollArea::vertical().id_salt("compared").max_height(rows * pitch).auto_shrink(false);
    // One that was just added is brought into view.
    let added = before.as_ref().filter(|before| before.len() < now.len()).and_then(|before| {
        let before: HashSet<&(SetKind, String)> = before.iter().collect();
        now.iter().rposition(|key| !before.contains(key))
    });
    area.show_rows(ui, ROW, sources.len(), |ui, range| {
        if sources.len() as f32 > rows {
            ui.set_max_width(ui.available_width() - sets::SCROLL_BAR);
        }
        if let Some(added) = added {
            let top = ui.cursor().min + Vec2::new(0.0, pitch * (added as f32 - range.start as f32));
            ui.scroll_to_rect(Rect::from_min_size(top, Vec2::new(1.0, ROW)), None);
        }
        for source in &sources[range] {
            row::row(ui, source, context);
        }
    });
    if before.as_ref() != Some(&now) {
        ui.data_mut(|data| data.insert_temp(seen, now));
    }
}

fn heading(ui: &mut Ui, context: &PaneContext<'_>) {
    let (rect, response) = ui.allocate_exact_size(Vec2::new(ui.available_width(), ROW - UNIT), egui::Sense::hover());
    widgets::labeled(&response, egui::Role::Label, PANE.title);
    let words = format!("mean {}", context.scene.difference_name());
    let room = rect.with_max_x(rect.right() - widgets::lines::DOTS);
    let beside = widgets::lines::right_aligned(ui, room, &words, egui::TextStyle::Small, context.theme.weak);
    let title = rect.with_max_x(room.right() - beside - UNIT);
    widgets::lines::elided(ui, title, PANE.title, egui::TextStyle::Body, context.theme.text);
}

/// The field that the list is searched with. Returns whether the first match was chosen with Enter.
fn search_field(ui: &mut Ui, context: &mut PaneContext<'_>) -> bool {
    let id = ui.scope_id().with("search");
    let hint = "Search cameras, Ctrl+F";
    let search = &mut context.view.search;
    let field = TextEdit::singleline(search).id(id).hint_text(hint).margin(egui::Margin::symmetric(6, 4));
    let response = ui.add_sized([ui.available_width(), ROW], field);
    widgets::labeled(&response, egui::Role::TextInput, "Search the cameras");
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
