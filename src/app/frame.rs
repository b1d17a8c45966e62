//! One frame: bars, panes, the borders between them, and overlays; a ring around the focused control, which is scrolled into view.

use egui::accesskit::{ActionRequest, TreeId};
use egui::{
    Align2, Button, CentralPanel, Context, CursorIcon, Event, FocusDirection, Frame, Id, Key, Modifiers, Panel, Rect,
    Sense, Stroke, StrokeKind, TextStyle, Ui, Vec2,
};

use super::{ChromascopeApp, path_prompt};
use crate::command::Command;
use crate::files::{PersistentMessage, PersistentMessageKind};
use crate::panes;
use crate::panes::context::PaneContext;
use crate::panes::widgets::lines;
use crate::scene::Scene;
use crate::theme::{self, FOCUS, Theme, UNIT};
use crate::view::View;
use crate::workspaces::{PaneKind, Shown, Side, Slot, Splitter, Workspace, arrange};

/// Height of a notice, and width of the button that takes it away.
const NOTICE: f32 = 24.0;
const DISMISS: f32 = 72.0;

impl ChromascopeApp {
    pub(super) fn show(&mut self, ui: &mut Ui) {
        let theme = Theme::of(ui.visuals()).with_surround(self.view.saved.surround);
        let mut context = PaneContext {
            panes: panes::ALL,
            scene: Scene { document: self.history.document(), catalog: &self.catalog, results: &self.results },
            theme,
            view: &mut self.view,
            meshes: &self.meshes,
            images: &self.images,
            opened: &self.opened,
            recorded: &self.recorded,
            later: &self.later,
            states: &mut self.states,
            render_service: &mut self.render_service,
            profiler: &mut self.profiler,
            commands: &mut self.commands,
        };
        delay_tooltips(ui.ctx(), f32::MAX);
        let bar = |ui: &mut Ui, id, height, top| bar(ui, &theme, (id, height), top);
        let menu = bar(ui, "menu", 30.0, true);
        let conditions = bar(ui, "conditions", panes::scene_bar::HEIGHT, true);
        let tour = context.view.tour.map(|_| bar(ui, "tour", panes::help::TOUR, true));
        let standing: Vec<(PersistentMessage, Rect)> = self
            .files
            .standing()
            .into_iter()
            .zip(["first notice", "second notice", "third notice", "fourth notice", "fifth notice"])
            .map(|(standing, id)| (standing, bar(ui, id, NOTICE, true)))
            .collect();
        let status = bar(ui, "status", 24.0, false);
        let area = CentralPanel::default().frame(Frame::NONE.fill(theme.panel)).show(ui, |ui| ui.max_rect()).inner;
        panes::menu::show(ui, menu, &self.history, &mut context);
        panes::scene_bar::show(ui, conditions, &mut context);
        if let Some(rect) = tour {
            panes::help::tour(ui, rect, &mut context);
        }
        for (standing, rect) in standing {
            if notice(ui, rect, &standing, &theme) {
                self.files.dismiss(standing.kind);
            }
        }
        let page = context.view.page;
        let of = context.view.settings_view().and_then(|view| context.pane(view));
        let shown = Shown {
            workspace: context.view.saved.workspace,
            layout: &context.view.saved.layout,
            maximized: page.or(context.view.maximized),
            card: context.view.card,
            numerics: context.view.numerics,
            has_lower: match context.view.saved.workspace {
                Workspace::Compare => of.is_some_and(|view| view.settings.is_some()),
                // The Inspector has the curves of what is selected.
                Workspace::Data => {
                    !context.view.is_shown(PaneKind::INSPECTOR) && context.view.import.selected.is_some()
                }
                Workspace::Rank => false,
            },
            column_over: context.view.column_over,
        };
        self.arrangement = arrange(&shown, area, self.arrangement.narrow);
        // Keys never mean a pane that is out of sight.
        if page.is_none() && context.view.focused.is_some_and(|focused| !self.arrangement.shows(focused)) {
            context.view.focused = context.view.maximized;
        }
        if let Some(view) = context.view.focused.filter(|pane| pane.slot() == Slot::View) {
            context.view.settings_of = Some(view);
        }
        for (pane, rect) in self.arrangement.panes.clone() {
            if page == Some(pane) {
                panes::figure_page::show(ui, rect, pane, &mut context);
            } else {
                panes::show(ui, pane, rect, &mut context);
            }
        }
        for (splitter, rect) in self.arrangement.splitters.clone() {
            drag_border(ui, splitter, rect, area, &mut context);
        }
        for (side, rect) in self.arrangement.handles.clone() {
            handle(ui, side, rect, &mut context);
        }
        for (pane, rect) in self.arrangement.over.clone() {
            let id = egui::Id::unique(("column over", pane));
            let layer = egui::Area::new(id).fixed_pos(rect.min).order(egui::Order::Middle);
            layer.show(ui.ctx(), |ui| {
                ui.set_min_size(rect.size());
                panes::show(ui, pane, rect, &mut context);
                ui.painter().rect_stroke(rect, 0.0, egui::Stroke::new(1.0, theme.line), egui::StrokeKind::Inside);
            });
        }
        let framed = context.view.focused.filter(|_| context.view.by_keyboard && context.view.palette.is_none());
        if let Some((_, rect)) = self.arrangement.panes.iter().find(|(pane, _)| Some(*pane) == framed) {
            frame_pane(ui, *rect, &theme);
        }
        enter_by_arrows(ui.ctx(), context.view);
        panes::status_bar::show(ui, status, &self.arrangement, &mut context);
        delay_tooltips(ui.ctx(), theme::TOOLTIP_DELAY);
        panes::help::show(ui, &self.history, &mut context);
        path_prompt::show(ui, &theme, &mut self.files);
        context.render_service.end_frame();
        context.later.end_frame();
        self.ask_about_session(ui, &theme);
        ring(ui.ctx(), &theme);
        drop_veil(ui, theme);
    }
}

/// Delays tooltips below an open window: one that is open where the window opens would stay, and above it.
fn delay_tooltips(ctx: &egui::Context, seconds: f32) {
    if ctx.memory(egui::Memory::top_modal_layer).is_some() {
        ctx.global_style_mut(|style| style.interaction.tooltip_delay = seconds);
    }
}

fn bar(ui: &mut Ui, theme: &Theme, (id, height): (&'static str, f32), top: bool) -> Rect {
    let panel = if top { Panel::top(id) } else { Panel::bottom(id) };
    let panel = panel.exact_size(height).resizable(false).frame(Frame::NONE.fill(theme.panel));
    panel.show_separator_line(true).show(ui, |ui| ui.max_rect()).inner
}

/// A border between panes, which can be dragged and, with a double click, put back.
fn drag_border(ui: &mut Ui, splitter: Splitter, rect: Rect, area: Rect, context: &mut PaneContext<'_>) {
    let upright = rect.height() > rect.width();
    let response = ui.interact(rect.expand(2.0), ui.scope_id().with(("border", splitter)), Sense::click_and_drag());
    let middle = rect.center();
    let stroke = egui::Stroke::new(
        1.0,
        if response.hovered() || response.dragged() { context.theme.weak } else { context.theme.line },
    );
    if upright {
        ui.painter().vline(middle.x.round() + 0.5, rect.y_range(), stroke);
    } else {
        ui.painter().hline(rect.x_range(), middle.y.round() + 0.5, stroke);
    }
    let layout = &mut context.view.saved.layout;
    if response.double_clicked() {
        layout.release(splitter);
    } else if let Some(at) = response.interact_pointer_pos().filter(|_| response.dragged()) {
        layout.drag(splitter, at, area);
    }
    response.on_hover_and_drag_cursor(if upright { CursorIcon::ResizeHorizontal } else { CursorIcon::ResizeVertical });
}

/// The handle of what is hidden at a side: a click shows it.
fn handle(ui: &Ui, side: Side, rect: Rect, context: &mut PaneContext<'_>) {
    let (words, turn) = match side {
        Side::Left => ("Show the compared sensors (L)", Vec2::new(1.0, 0.0)),
        Side::Right => ("Show the right column (I)", Vec2::new(-1.0, 0.0)),
        Side::Lower => ("Show the lower view", Vec2::new(0.0, -1.0)),
    };
    let response = ui.interact(rect, ui.scope_id().with(("handle", side)), Sense::click());
    lines::labeled(&response, egui::Role::Button, words);
    let theme = &context.theme;
    let lit = response.hovered() || response.has_focus();
    ui.painter().rect_filled(rect, 0.0, if lit { theme.hover } else { theme.control });
    let (at, stroke) = (rect.center(), Stroke::new(1.5, theme.text));
    for wing in [turn.rot90(), -turn.rot90()] {
        ui.painter().line_segment([at + 2.0 * turn, at - 2.0 * turn + 5.0 * wing], stroke);
    }
    if response.on_hover_text(words).clicked() {
        context.push(Command::Toggle(side));
    }
}

/// While files hang over the window: where they may fall.
fn drop_veil(ui: &Ui, theme: Theme) {
    if ui.input(|input| input.raw.hovered_files.is_empty()) {
        return;
    }
    let screen = ui.ctx().content_rect();
    let layer = egui::LayerId::new(egui::Order::Foreground, egui::Id::unique("drop veil"));
    let painter = ui.ctx().layer_painter(layer);
    painter.rect_filled(screen, 0.0, theme.panel.gamma_multiply(0.85));
    painter.rect_stroke(screen.shrink(12.0), 4.0, egui::Stroke::new(2.0, theme.text), egui::StrokeKind::Inside);
    let font = egui::FontId::proportional(theme::HEADING);
    painter.text(screen.center(), Align2::CENTER_CENTER, "Drop to open", font, theme.text);
}

/// Shows a line below the conditions that stays, such as that the document is not saved; under the pointer, all of it and the file it is about. Returns whether it was dismissed.
fn notice(ui: &mut Ui, rect: Rect, standing: &PersistentMessage, theme: &Theme) -> bool {
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
    let text = Rect::from_x_y_ranges(left..=right, inner.y_range());
    lines::elided(ui, text, &standing.words, TextStyle::Body, color);
    let response = ui.interact(text, ui.scope_id().with(("standing", standing.kind)), Sense::hover());
    lines::labeled(&response, egui::Role::Status, &standing.words);
    let file = standing.file.as_ref().map_or_else(String::new, |file| format!("\n{}", file.display()));
    response.on_hover_text(format!("{}{file}", standing.words));
    dismissed
}

/// Draws a ring around the control that has the keyboard, whatever draws the control. A second line of the ground's color
/// within shows the ring on any color.
fn ring(ctx: &Context, theme: &Theme) {
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
fn frame_pane(ui: &Ui, rect: Rect, theme: &Theme) {
    let painter = ui.painter();
    painter.rect_stroke(rect.shrink(FOCUS), 0.0, Stroke::new(1.0, theme.panel), StrokeKind::Inside);
    painter.rect_stroke(rect, 0.0, Stroke::new(FOCUS, theme.focus), StrokeKind::Inside);
}

/// Arrow keys that the pane with the keyboard has no use for lead into its controls in the next frame, as Tab does.
fn enter_by_arrows(ctx: &Context, view: &mut View) {
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
    let request = ActionRequest {
        action: egui::accesskit::Action::ScrollIntoView,
        target_tree: TreeId::ROOT,
        target_node,
        data: None,
    };
    ctx.input_mut(|input| input.events.push(Event::AccessKitActionRequest(request)));
}
