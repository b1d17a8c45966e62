//! A line that stays below the conditions while another window has the profile.

use std::path::Path;

use egui::{Rect, Sense, TextStyle, Ui, Vec2};

use crate::theme::{Theme, UNIT};
use crate::widgets::lines;

/// Shows the line; under the pointer, where this window's document is kept.
pub(super) fn other_window(ui: &Ui, rect: Rect, words: &str, file: &Path, theme: &Theme) {
    let inner = rect.shrink2(Vec2::new(2.0 * UNIT, 0.0));
    lines::warning_mark(ui.painter(), egui::pos2(inner.left() + 7.0, inner.center().y), theme.warning);
    let text = Rect::from_min_max(inner.min + Vec2::new(5.0 * UNIT, 0.0), inner.max);
    lines::elided(ui, text, words, TextStyle::Body, theme.warning);
    let response = ui.interact(inner, ui.scope_id().with("other window"), Sense::hover());
    response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Status, true, words));
    response.on_hover_text(format!("The copy: {}", file.display()));
}
