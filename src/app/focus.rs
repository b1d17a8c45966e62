//! Keyboard focus: a ring around the focused control, which is scrolled into view.

use egui::accesskit::{Action, ActionRequest, TreeId};
use egui::{Context, Event, FocusDirection, Id, Key, Modifiers, Rect, Stroke, StrokeKind, Ui};

use crate::theme::{FOCUS, Theme};
use crate::view::View;

/// Draws a ring around the control that has the keyboard, whatever draws the control. A second line of the ground's color
/// within shows the ring on any color.
pub(super) fn ring(ctx: &Context, theme: &Theme) {
    let focused = ctx.memory(egui::Memory::focused).filter(|_| ctx.input(|input| input.focused));
    let Some(response) = focused.and_then(|id| ctx.read_response(id)) else { return };
    let rect = response.interact_rect;
    if !rect.is_positive() {
        return;
    }
    let painter = ctx.layer_painter(response.layer_id);
    painter.rect_stroke(rect.shrink(FOCUS), 2.0, Stroke::new(1.0, theme.panel), StrokeKind::Inside);
    painter.rect_stroke(rect, 3.0, Stroke::new(FOCUS, theme.focus), StrokeKind::Inside);
}

/// Frames the pane that has the keyboard while one goes from pane to pane with it.
pub(super) fn frame(ui: &Ui, rect: Rect, theme: &Theme) {
    let painter = ui.painter();
    painter.rect_stroke(rect.shrink(FOCUS), 0.0, Stroke::new(1.0, theme.panel), StrokeKind::Inside);
    painter.rect_stroke(rect, 0.0, Stroke::new(FOCUS, theme.focus), StrokeKind::Inside);
}

/// Arrow keys that the pane with the keyboard has no use for lead into its controls in the next frame, as Tab does.
pub(super) fn enter_by_arrows(ctx: &Context, view: &mut View) {
    let free = ctx.memory(|memory| memory.focused().is_none()) && !egui::Popup::is_any_open(ctx);
    let pressed = ctx.input(|input| input.key_pressed(Key::ArrowDown) || input.key_pressed(Key::ArrowUp));
    view.arrow_enters = free && pressed && view.by_keyboard && view.palette.is_none();
    if view.arrow_enters {
        ctx.request_repaint();
    }
}

/// A letter or digit is a shortcut, not meant for the button of an offer that has the keyboard.
pub(super) fn leave_offer(ctx: &Context) {
    let offer: Option<Id> = ctx.data(|data| data.get_temp(Id::unique("offer")));
    let is_shortcut = |event: &Event| matches!(event, Event::Key { key, pressed: true, .. } if key.name().len() == 1);
    let Some(offer) = offer.filter(|offer| ctx.memory(|memory| memory.has_focus(*offer))) else { return };
    if ctx.input(|input| input.events.iter().any(is_shortcut)) {
        ctx.memory_mut(|memory| memory.surrender_focus(offer));
    }
}

/// Tab leads into the pane that has the keyboard, not to the first control of the window.
pub(super) fn enter_pane(ctx: &Context, view: &mut View) {
    let free = ctx.memory(|memory| memory.focused().is_none());
    view.tab_enters = free
        && view.by_keyboard
        && view.focused.is_some()
        && view.palette.is_none()
        && (std::mem::take(&mut view.arrow_enters)
            || ctx.input_mut(|input| input.consume_key(Modifiers::NONE, Key::Tab)));
    if view.tab_enters {
        ctx.memory_mut(|memory| memory.move_focus(FocusDirection::None));
    }
}

/// Scrolls a newly focused control into view. Only its own scroll areas can do so: they receive the request that a screen
/// reader would send.
pub(super) fn into_sight(ctx: &Context, before: &mut Option<Id>) {
    let focused = ctx.memory(egui::Memory::focused);
    if *before == focused {
        return;
    }
    let Some(response) = focused.and_then(|id| ctx.read_response(id)) else {
        *before = focused;
        return;
    };
    *before = focused;
    if response.interact_rect.expand(0.5).contains_rect(response.rect) {
        return;
    }
    let target_node = response.id.accesskit_id();
    let request = ActionRequest { action: Action::ScrollIntoView, target_tree: TreeId::ROOT, target_node, data: None };
    ctx.input_mut(|input| input.events.push(Event::AccessKitActionRequest(request)));
}
