//! Content that scrolls, with a hint that it goes on below.

use egui::{Color32, FontId, Key, Modifiers, Rect, ScrollArea, Shape, Ui, UiBuilder, Vec2};

use super::walk;
use crate::panes::context::PaneContext;
use crate::theme::UNIT;
use crate::workspaces::PaneKind;

const LINE: f32 = 18.0;
/// Share of the visible height that Page Up and Page Down move by.
const PAGE: f32 = 0.9;

/// Shows content that scrolls in a rectangle of a pane, also by Page Up and Page Down. Where it does not fit, a line below it is
/// kept for the hint, so that nothing moves when the end is reached.
pub fn show(
    ui: &mut Ui,
    (pane, name): (PaneKind, &str),
    rect: Rect,
    context: &mut PaneContext<'_>,
    content: impl FnOnce(&mut Ui, &mut PaneContext<'_>),
) {
    let key = ui.scope_id().with((name, "height"));
    let before: f32 = ui.data(|data| data.get_temp(key)).unwrap_or_default();
    let kept = if before > rect.height() { LINE } else { 0.0 };
    let (view, slot) = rect.split_top_bottom_at_y(rect.bottom() - kept);
    let inner = view.shrink2(Vec2::new(2.0 * UNIT, 0.0));
    let mut child = ui.new_child(UiBuilder::new().id_salt(name).max_rect(inner));
    child.set_clip_rect(view.intersect(ui.clip_rect()));
    let shown = ScrollArea::vertical().id_salt(name).auto_shrink(false).show(&mut child, |ui| {
        ui.set_max_width(inner.width() - 2.0 * UNIT);
        if walk::has_keys(ui, pane, context) {
            let pressed = |key| ui.input_mut(|input| input.count_and_consume_key(Modifiers::NONE, key)) as f32;
            let pages = pressed(Key::PageUp) - pressed(Key::PageDown);
            if pages != 0.0 {
                ui.scroll_with_delta(Vec2::new(0.0, pages * PAGE * view.height()));
            }
        }
        content(ui, context);
    });
    let height = shown.content_size.y;
    if (height > rect.height()) != (kept > 0.0) {
        ui.ctx().request_repaint();
    }
    ui.data_mut(|data| data.insert_temp(key, height));
    if kept > 0.0 && height - shown.state.clamped_offset().y > view.height() + 1.0 {
        let slot = slot.shrink2(Vec2::new(2.0 * UNIT, 0.0));
        more_below(&ui.new_child(UiBuilder::new().id_salt((name, "below")).max_rect(slot)), slot, context.theme.weak);
    }
}

/// A hint at the left of a place that there is more to scroll to.
pub fn more_below(ui: &Ui, slot: Rect, color: Color32) {
    let font = FontId::proportional(crate::theme::SMALL);
    let words = ui.painter().layout_no_wrap("more below".to_owned(), font, color);
    let at = slot.left_center() + Vec2::new(14.0, -0.5 * words.size().y);
    let tip = slot.left_center() + Vec2::new(6.0, 3.0);
    ui.painter().galley(at, words, color);
    let corners = vec![tip, tip + Vec2::new(-4.0, -5.0), tip + Vec2::new(4.0, -5.0)];
    super::named(ui, slot, ui.scope_id().with("more below"), egui::Role::Label, "more below");
    ui.painter().add(Shape::convex_polygon(corners, color, egui::Stroke::NONE));
}
