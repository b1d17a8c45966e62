//! Turning and approaching the mesh. View state: no step of undo.

use egui::{EventFilter, Key, Modifiers, PointerButton, Response, Ui};

use crate::panes::context::PaneContext;
use crate::scene::orbit::Orbit;
use crate::workspaces::PaneKind;

const DRAG: f64 = 0.4;
const STEP: f64 = 5.0;
const NEARER: f64 = 0.9;

/// Drag turns, wheel and pinch approach.
pub(super) fn by_pointer(ui: &Ui, response: &Response, context: &mut PaneContext<'_>) {
    if response.clicked() || response.drag_started() {
        // Keys act on this pane now, not on an earlier text field; letters are free unless a control has the focus.
        ui.memory_mut(|memory| {
            if let Some(other) = memory.focused() {
                memory.surrender_focus(other);
            }
        });
    }
    if response.dragged_by(PointerButton::Primary) {
        let moved = response.drag_delta();
        if moved != egui::Vec2::ZERO {
            change(ui, context, |orbit| orbit.turned(-DRAG * f64::from(moved.x), DRAG * f64::from(moved.y)));
        }
    }
    if response.contains_pointer() {
        let (scroll, zoom) = ui.input(|input| (input.smooth_scroll_delta().y, input.zoom_delta()));
        if scroll != 0.0 || zoom != 1.0 {
            let factor = (-0.003 * f64::from(scroll)).exp() / f64::from(zoom.max(0.01));
            change(ui, context, |orbit| orbit.at_distance(factor));
        }
    }
}

/// Arrows turn, + and − approach, while the pictures have the keyboard, or nothing else has.
pub(super) fn by_keys(ui: &Ui, response: &Response, context: &mut PaneContext<'_>) {
    if response.has_focus() {
        let arrows = EventFilter { horizontal_arrows: true, vertical_arrows: true, ..EventFilter::default() };
        ui.memory_mut(|memory| memory.set_focus_lock_filter(response.id, arrows));
    }
    let idle = context.view.focused == Some(PaneKind::RENDER) && ui.memory(|memory| memory.focused().is_none());
    if !response.has_focus() && !idle {
        return;
    }
    let (x, y, nearer) = ui.input_mut(|input| {
        if !input.modifiers.is_none() && !input.modifiers.shift_only() {
            return (0.0, 0.0, 0.0);
        }
        let mut presses = |key: Key| input.count_and_consume_key(Modifiers::NONE, key) as f64;
        (
            presses(Key::ArrowRight) - presses(Key::ArrowLeft),
            presses(Key::ArrowUp) - presses(Key::ArrowDown),
            presses(Key::Plus) + presses(Key::Equals) - presses(Key::Minus),
        )
    });
    if x != 0.0 || y != 0.0 {
        change(ui, context, |orbit| orbit.turned(STEP * x, STEP * y));
    }
    if nearer != 0.0 {
        change(ui, context, |orbit| orbit.at_distance(NEARER.powf(nearer)));
    }
}

fn change(ui: &Ui, context: &mut PaneContext<'_>, to: impl FnOnce(Orbit) -> Orbit) {
    let now = context.view.saved.render.orbit.unwrap_or_else(|| Orbit::of(&context.scene.document.render.mesh));
    context.view.saved.render.orbit = Some(to(now));
    ui.ctx().request_repaint();
}
