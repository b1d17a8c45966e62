//! Lines below the conditions that stay: another window has the profile, the document is not saved, one could not be read.

use egui::{Button, Rect, TextStyle, Ui, Vec2};

use crate::files::{PersistentMessage, PersistentMessageKind};
use crate::panes::widgets::{self, lines};
use crate::theme::{Theme, UNIT};

pub(super) const HEIGHT: f32 = 24.0;
const DISMISS: f32 = 72.0;

/// Shows a line; under the pointer, all of it and the file it is about. Returns whether it was dismissed.
pub(super) fn show(ui: &mut Ui, rect: Rect, standing: &PersistentMessage, theme: &Theme) -> bool {
    let inner = rect.shrink2(Vec2::new(2.0 * UNIT, 0.0));
    let color = match standing.kind {
        PersistentMessageKind::NotSaved => theme.error,
        PersistentMessageKind::Copies => theme.text,
        _ => theme.warning,
    };
    let mut left = inner.left();
    if standing.kind != PersistentMessageKind::Copies {
        lines::warning_mark(ui.painter(), egui::pos2(left + 7.0, inner.center().y), color);
        left += 5.0 * UNIT;
    }
    let mut right = inner.right();
    let mut dismissed = false;
    if standing.kind.is_dismissible() {
        let place = Rect::from_min_max(egui::pos2(right - DISMISS, inner.top() + 2.0), inner.max - Vec2::new(0.0, 2.0));
        dismissed = ui.put(place, Button::new("Dismiss").small()).clicked();
        right = place.left() - 2.0 * UNIT;
    }
    let text = Rect::from_min_max(egui::pos2(left, inner.top()), egui::pos2(right, inner.bottom()));
    lines::elided(ui, text, &standing.words, TextStyle::Body, color);
    let response =
        widgets::named(ui, text, ui.scope_id().with(("standing", standing.kind)), egui::Role::Status, &standing.words);
    let file = standing.file.as_ref().map_or_else(String::new, |file| format!("\n{}", file.display()));
    response.on_hover_text(format!("{}{file}", standing.words));
    dismissed
}
