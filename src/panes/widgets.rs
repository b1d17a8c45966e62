//! Parts that more than one pane uses.

pub mod conditions;
pub mod differences;
pub mod facts;
pub mod lines;
pub mod number_field;
pub mod pick_list;
pub mod pixel;
pub mod sets;
pub mod table;
pub mod tolerance;
pub mod walk;

use std::time::Duration;

use chromascope_figure::{FigureRoom, Table};
use chromascope_text::Choice;
use egui::{
    Align, Align2, Button, Color32, FontId, Key, Layout, Modifiers, Rect, Response, RichText, ScrollArea, Sense, Shape,
    Ui, UiBuilder, Vec2,
};

use crate::command::Command;
use crate::export::FigureForm;
use crate::export::profile::CorrectionForm;
use crate::figures::chromaticity::key;
use crate::jobs::PATIENCE;
use crate::paint;
use crate::panes::context::{Pane, PaneContext};
use crate::plot_item::SensorId;
use crate::scene::ComparedSensor;
use crate::theme::{self, ROW, Theme, UNIT};
use crate::workspaces::{PaneKind, Side, Workspace};

pub use lines::{focus_rim, labeled, named};

pub const WHAT_YOU_SEE: &str = "A camera's spectral sensitivities differ from the eye's, and so do its colors. \
                                Chromascope shows how far off they are.";

/// Passes after which a control that is not drawn is no longer sought.
const SOUGHT: u64 = 4;

pub const HEADER: f32 = 32.0;

/// Draws a pane's frame and header and returns the rectangle below it. `switches` adds the pane's own controls: beside the
/// title or tabs, or where these leave no room, below.
pub fn pane(
    ui: &mut Ui,
    pane: &Pane,
    rect: Rect,
    context: &mut PaneContext<'_>,
    switches: impl FnOnce(&mut Ui, &mut PaneContext<'_>),
) -> Rect {
    ground(ui, pane.kind, rect, context);
    let mut header =
        Rect::from_min_size(rect.min, Vec2::new(rect.width(), HEADER)).shrink2(Vec2::new(2.0 * UNIT, UNIT));
    let layout = Layout::left_to_right(Align::Center);
    let mut bar = ui.new_child(UiBuilder::new().id_salt(("header", pane.kind)).max_rect(header).layout(layout));
    bar.set_clip_rect(header.expand(2.0).intersect(ui.clip_rect()));
    let slot = slot_of(pane, context);
    tabs(&mut bar, pane, slot, context);
    // The buttons on the right are laid out first, so that a narrow pane cuts switches, never the way to its figure.
    let buttons_width = 4.0 * ROW + 3.0 * UNIT;
    let mut left = bar.cursor().min.x;
    let key = ui.scope_id().with(("width of switches", pane.kind));
    let wanted: f32 = ui.data(|data| data.get_temp(key)).unwrap_or_default();
    if slot.is_some() && header.right() - left < buttons_width + wanted {
        header = header.translate(Vec2::new(0.0, HEADER));
        left = header.left();
    }
    let room = Rect::from_min_max(egui::pos2(left, header.top()), header.max - Vec2::new(buttons_width, 0.0));
    let mut left = ui.new_child(UiBuilder::new().id_salt(("switches", pane.kind)).max_rect(room).layout(layout));
    left.set_clip_rect(room.expand(2.0).intersect(ui.clip_rect()));
    left.spacing_mut().button_padding.x = 1.25 * UNIT;
    switches(&mut left, context);
    let taken = left.min_rect().width();
    if taken > wanted || taken + 2.0 * ROW < wanted {
        // The next frame gives them the room that they need.
        ui.data_mut(|data| data.insert_temp(key, taken));
        ui.ctx().request_repaint();
    }
    let right = header.with_min_x(header.right() - buttons_width);
    let to_left = Layout::right_to_left(Align::Center);
    let mut buttons = ui.new_child(UiBuilder::new().id_salt(("buttons", pane.kind)).max_rect(right).layout(to_left));
    header_buttons(&mut buttons, pane, slot, context);
    rect.with_min_y(header.bottom() + UNIT)
}

/// The ground of a pane, which takes the keyboard where it is pressed.
pub fn ground(ui: &Ui, pane: PaneKind, rect: Rect, context: &mut PaneContext<'_>) {
    ui.painter().rect_filled(rect, 0.0, context.theme.panel);
    if ui.input(|input| input.pointer.any_pressed() && input.pointer.interact_pos().is_some_and(|at| rect.contains(at)))
    {
        context.view.focused = Some(pane);
    }
}

/// A pane's frame and header as [`pane`] draws them. Returns the rectangle below within the usual margins.
pub fn body(
    ui: &mut Ui,
    pane: &Pane,
    rect: Rect,
    context: &mut PaneContext<'_>,
    switches: impl FnOnce(&mut Ui, &mut PaneContext<'_>),
) -> Rect {
    let body = self::pane(ui, pane, rect, context, switches);
    Rect::from_min_max(body.min + Vec2::new(2.0 * UNIT, 0.0), body.max - Vec2::new(2.0 * UNIT, UNIT))
}

/// A part of a pane, beyond whose rectangle nothing is drawn.
pub fn clipped(ui: &mut Ui, salt: impl egui::AsIdSalt, rect: Rect) -> Ui {
    let mut child = ui.new_child(UiBuilder::new().id_salt(salt).max_rect(rect));
    child.set_clip_rect(rect.intersect(ui.clip_rect()));
    child
}

/// A place in the middle of a rectangle, whose lines are centered.
pub fn middle(ui: &mut Ui, salt: impl egui::AsIdSalt, body: Rect, size: Vec2) -> Ui {
    let place = Rect::from_center_size(body.center(), Vec2::new(body.width().min(size.x), size.y)).intersect(body);
    let layout = Layout::top_down(Align::Center);
    ui.new_child(UiBuilder::new().id_salt(salt).max_rect(place).layout(layout))
}

/// A window of a fixed place and size.
pub fn window<'a>(title: impl egui::IntoAtoms<'a>, id: &'static str, place: (Align2, Vec2)) -> egui::Window<'a> {
    let window = egui::Window::new(title).id(egui::Id::unique(id));
    window.collapsible(false).resizable(false).anchor(place.0, place.1)
}

/// Keeps what lies below an open window from the pointer and the keyboard. True if something else is pressed.
pub fn alone(ctx: &egui::Context, window: &Response) -> bool {
    ctx.memory_mut(|memory| memory.set_modal_layer(window.layer_id));
    // A modal layer has the keys to itself, but not the pointer.
    let (layer, screen) = (window.layer_id, ctx.content_rect());
    let below = egui::Area::new(layer.id.with("below")).order(layer.order).fixed_pos(screen.min);
    below.show(ctx, |ui| ui.set_min_size(screen.size()));
    ctx.move_to_top(layer);
    let at = ctx.input(|input| input.pointer.interact_pos().filter(|_| input.pointer.any_pressed()));
    at.is_some_and(|at| !window.rect.contains(at))
}

/// Draws a sentence in the middle of a rectangle.
pub fn say(ui: &Ui, body: Rect, words: impl ToString, color: egui::Color32) {
    let font = FontId::proportional(theme::TEXT);
    ui.painter().text(body.center(), Align2::CENTER_CENTER, words, font, color);
}

pub fn note(ui: &mut Ui, words: impl Into<String>) {
    ui.label(RichText::new(words).small().weak());
}

/// Shows a pane's numbers instead of its picture, if that is chosen. Returns whether it is.
pub fn numbers(
    ui: &mut Ui,
    pane: &Pane,
    body: Rect,
    context: &mut PaneContext<'_>,
    table: impl FnOnce(&PaneContext<'_>) -> Option<Table>,
) -> bool {
    let is_chosen = context.view.saved.tables.contains(&pane.kind);
    if let Some(numbers) = is_chosen.then(|| table(context)).flatten() {
        table::show_numbers(ui, body, pane.kind, &numbers, context);
    }
    is_chosen
}

/// The same with the numbers of the pane's figure.
pub fn figure_numbers(ui: &mut Ui, pane: &Pane, body: Rect, context: &mut PaneContext<'_>) -> bool {
    numbers(ui, pane, body, context, |context| {
        Some(pane.figure?.figure(&context.scene, &context.look(pane.kind), FigureRoom::default())?.table)
    })
}

/// Takes a curve as the one under the pointer, and lets it go when the pointer leaves.
pub fn hover_curve(ui: &Ui, salt: &'static str, inside: bool, place: Option<usize>, context: &mut PaneContext<'_>) {
    let id = egui::Id::unique(salt);
    let was = ui.data_mut(|data| std::mem::replace(data.get_temp_mut_or_default::<bool>(id), inside));
    if (inside || was) && context.view.import.hovered_curve != place {
        context.view.import.hovered_curve = place;
        ui.ctx().request_repaint();
    }
}

/// Has the control of a name take the keyboard as soon as it is drawn.
pub fn seek(ctx: &egui::Context, name: &'static str) {
    let until = ctx.cumulative_pass_nr() + SOUGHT;
    ctx.data_mut(|data| data.insert_temp(egui::Id::unique("sought control"), (name, until)));
    ctx.request_repaint();
}

/// Gives a control the keyboard and brings it into sight, if it is the one that is sought.
pub fn take_sought(response: &Response, name: &str) {
    let (id, pass) = (egui::Id::unique("sought control"), response.ctx.cumulative_pass_nr());
    let sought: Option<(&'static str, u64)> = response.ctx.data(|data| data.get_temp(id));
    if sought.is_some_and(|(sought, until)| sought == name && pass <= until) {
        response.ctx.data_mut(|data| data.remove::<(&'static str, u64)>(id));
        response.request_focus();
        response.scroll_to_me(Some(Align::Center));
    }
}

/// Draws a pane's frame and header, and content that scrolls below.
pub fn scrolling_pane(
    ui: &mut Ui,
    pane: &Pane,
    rect: Rect,
    context: &mut PaneContext<'_>,
    content: impl FnOnce(&mut Ui, &mut PaneContext<'_>),
) {
    let body = self::pane(ui, pane, rect, context, |_, _| {});
    scroll(ui, (pane.kind, pane.title), body, context, content);
}

/// Workspace and place in it that a pane stands in, if others can stand there too.
fn slot_of(pane: &Pane, context: &PaneContext<'_>) -> Option<(Workspace, usize)> {
    let workspace = context.view.saved.workspace;
    let at = context.view.places().iter().position(|place| *place == Some(pane.kind))?;
    let slot = workspace.slots()[at].filter(|_| !context.view.numerics)?;
    let others = context.panes.iter().filter(|other| slot.takes(other.kind)).count();
    (others > 1).then_some((workspace, at))
}

/// The title, or where others can stand in its place, tabs of these.
fn tabs(ui: &mut Ui, pane: &Pane, slot: Option<(Workspace, usize)>, context: &mut PaneContext<'_>) {
    let enters = context.view.focused == Some(pane.kind) && std::mem::take(&mut context.view.tab_enters);
    let Some((workspace, at)) = slot else {
        let title = ui.add(egui::Label::new(pane.title).sense(Sense::focusable_noninteractive()));
        if enters {
            title.request_focus();
        }
        return;
    };
    ui.spacing_mut().item_spacing.x = 1.0;
    ui.spacing_mut().button_padding.x = UNIT;
    let panes = context.panes.iter().filter(|other| workspace.slots()[at].is_some_and(|slot| slot.takes(other.kind)));
    for other in panes {
        let on = other.kind == pane.kind;
        let fill = if on { context.theme.control } else { context.theme.panel };
        let tab = ui.add(Button::selectable(on, RichText::new(other.tab).small()).fill(fill));
        tab.widget_info(|| egui::WidgetInfo::selected(egui::Role::Tab, true, on, other.tab));
        if on && enters {
            tab.request_focus();
        }
        if tab.clicked() && !on {
            context.view.saved.layout.put(workspace, at, other.kind);
            context.view.focused = Some(other.kind);
            if context.view.maximized == Some(pane.kind) {
                context.view.maximized = Some(other.kind);
            }
            ui.ctx().request_repaint();
        }
    }
}

fn header_buttons(ui: &mut Ui, pane: &Pane, slot: Option<(Workspace, usize)>, context: &mut PaneContext<'_>) {
    let (kind, title) = (pane.kind, pane.title);
    let maximized = context.view.maximized == Some(kind);
    if context.view.card == Some(kind) && icon_button(ui, Icon::Close, &format!("Close {title}")).clicked() {
        context.view.card = None;
    }
    let words = format!("Fold {} away", pane.tab);
    if slot == Some((Workspace::Compare, 1)) && !maximized && icon_button(ui, Icon::Fold, &words).clicked() {
        context.push(Command::Toggle(Side::Lower));
    }
    let words = if maximized { "Restore" } else { "Maximize" };
    if !kind.is_controls() && icon_button(ui, Icon::Maximize, &format!("{words} {title} (F)")).clicked() {
        context.push(Command::Maximize(kind));
    }
    if pane.figure.is_some() {
        export_menu(ui, pane, context);
    }
    if pane.table {
        let tables = &mut context.view.saved.tables;
        let shown = tables.contains(&kind);
        let words = if shown { "Picture instead of numbers" } else { "Numbers instead of the picture" };
        if icon_button(ui, Icon::Table { on: shown }, &format!("{words}: {title}")).clicked() && !tables.remove(&kind) {
            tables.insert(kind);
        }
    }
}

fn export_menu(ui: &mut Ui, &Pane { kind, title, .. }: &Pane, context: &mut PaneContext<'_>) {
    let response = icon_button(ui, Icon::Export, &format!("Export {title}"));
    egui::Popup::menu(&response).show(|ui| {
        let mut item = |ui: &mut Ui, words: &str, command: Command| context.item(ui, words, "", command);
        if kind == PaneKind::CORRECTION {
            for form in CorrectionForm::ALL {
                item(ui, form.words().0, Command::SaveCorrection(form));
            }
            ui.separator();
        }
        item(ui, "Figure page (Ctrl+E)", Command::FigurePage(kind));
        ui.separator();
        for form in FigureForm::ALL {
            let what = if form.is_numbers() { "Numbers" } else { "Figure" };
            item(ui, &format!("{what} as {}…", form.label()), Command::Export(kind, form));
        }
        item(ui, "Card as PNG…", Command::SaveCard(kind));
        ui.separator();
        item(ui, "Copy picture", Command::CopyPicture(kind));
        item(ui, "Copy as card", Command::CopyCard(kind));
        item(ui, "Copy numbers", Command::CopyNumbers(kind));
        if let Some(shot) = context.render_service.frame().cloned().filter(|_| kind == PaneKind::RENDER) {
            ui.separator();
            for source in shot.sources.iter() {
                let id = SensorId { kind: source.kind, name: source.name.clone() };
                context.item(ui, &format!("{} as OpenEXR…", source.label), "", Command::ExportExr(id));
            }
        }
    });
}

/// A thin progress line along the top while a computation lasts long; its description is in the status bar.
pub fn busy_line(ui: &Ui, body: Rect, busy: Option<Duration>, color: egui::Color32) {
    let Some(busy) = busy else { return };
    if let Some(wait) = PATIENCE.checked_sub(busy) {
        ui.ctx().request_repaint_after(wait);
        return;
    }
    ui.ctx().request_repaint_after(Duration::from_millis(50));
    let left = body.left() + body.width() * 0.75 * (0.5 - 0.5 * (3.0 * busy.as_secs_f32()).cos());
    let line = Rect::from_min_size(egui::pos2(left, body.top()), Vec2::new(0.25 * body.width(), 2.0));
    ui.painter().rect_filled(line, 0.0, color);
}

/// Small pictures drawn with lines, so that no font needs them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Icon {
    Table { on: bool },
    Export,
    Maximize,
    Fold,
    Close,
    Undo,
    Redo,
}

pub fn icon_button(ui: &mut Ui, icon: Icon, name: &str) -> Response {
    let (rect, response) = ui.allocate_exact_size(Vec2::splat(ROW), Sense::click());
    response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Button, ui.is_enabled(), name));
    let theme = Theme::of(ui.visuals());
    let on = icon == (Icon::Table { on: true });
    if response.hovered() || response.has_focus() || on {
        let fill = if response.hovered() { theme.hover } else { theme.control };
        ui.painter().rect(rect, 3.0, fill, focus_rim(&response, &theme), egui::StrokeKind::Inside);
    }
    let is_bright = response.hovered() || on || (matches!(icon, Icon::Undo | Icon::Redo) && ui.is_enabled());
    let color = if is_bright { theme.text } else { theme.weak };
    let stroke = egui::Stroke::new(1.2, color);
    let at = |x: f32, y: f32| rect.center() + Vec2::new(x, y);
    let line = |a: egui::Pos2, b: egui::Pos2| {
        ui.painter().line_segment([a, b], stroke);
    };
    match icon {
        Icon::Table { .. } => {
            let frame = Rect::from_center_size(rect.center(), Vec2::new(12.0, 10.0));
            ui.painter().rect_stroke(frame, 1.0, stroke, egui::StrokeKind::Middle);
            line(at(-6.0, -1.5), at(6.0, -1.5));
            line(at(-6.0, 2.0), at(6.0, 2.0));
            line(at(-1.0, -5.0), at(-1.0, 5.0));
        }
        Icon::Export => {
            line(at(0.0, -6.0), at(0.0, 2.0));
            line(at(-3.0, -3.0), at(0.0, -6.0));
            line(at(3.0, -3.0), at(0.0, -6.0));
            for pair in [[(-5.0, 0.0), (-5.0, 5.0)], [(-5.0, 5.0), (5.0, 5.0)], [(5.0, 5.0), (5.0, 0.0)]] {
                line(at(pair[0].0, pair[0].1), at(pair[1].0, pair[1].1));
            }
        }
        Icon::Maximize => {
            line(at(-5.0, 5.0), at(5.0, -5.0));
            for corner in [1.0, -1.0] {
                line(at(5.0 * corner, -5.0 * corner), at(1.0 * corner, -5.0 * corner));
                line(at(5.0 * corner, -5.0 * corner), at(5.0 * corner, -corner));
            }
        }
        Icon::Fold => {
            line(at(-4.0, -2.0), at(0.0, 2.0));
            line(at(4.0, -2.0), at(0.0, 2.0));
        }
        Icon::Close => {
            line(at(-4.0, -4.0), at(4.0, 4.0));
            line(at(-4.0, 4.0), at(4.0, -4.0));
        }
        Icon::Undo | Icon::Redo => {
            let side = if icon == Icon::Undo { 1.0 } else { -1.0 };
            // From the shaft at the top round to the foot.
            let arc = (0..=12).map(|step| {
                let angle = std::f32::consts::PI * (step as f32 / 12.0 - 0.5);
                at(side * (1.5 + 4.0 * angle.cos()), 1.0 + 4.0 * angle.sin())
            });
            ui.painter().line(
                std::iter::once(at(-5.0 * side, -3.0)).chain(arc).chain([at(-2.0 * side, 5.0)]).collect(),
                stroke,
            );
            line(at(-5.0 * side, -3.0), at(-1.5 * side, -6.0));
            line(at(-5.0 * side, -3.0), at(-1.5 * side, 0.0));
        }
    }
    response.on_hover_text(name)
}

/// A switch of a few words of which one is on. Returns the one clicked.
pub fn segmented<T: Copy + PartialEq>(ui: &mut Ui, choices: &[(T, &str, &str)], current: T) -> Option<T> {
    pressed(ui, choices, current).filter(|choice| *choice != current)
}

pub fn switch<T: Choice>(ui: &mut Ui, value: &mut T) {
    if let Some(to) = choice(ui, *value) {
        *value = to;
        ui.ctx().request_repaint();
    }
}

/// Buttons of all alternatives of a choice, of which one is on. Returns the one clicked.
pub fn choice<T: Choice>(ui: &mut Ui, current: T) -> Option<T> {
    choice_of(ui, T::ALL, current).filter(|choice| *choice != current)
}

/// Buttons of some alternatives, which may do something when pressed again.
pub fn choice_of<T: Choice>(ui: &mut Ui, all: &[T], current: T) -> Option<T> {
    let line = |choice: &T| (*choice, choice.words().label, choice.words().why);
    pressed(ui, &all.iter().map(line).collect::<Vec<_>>(), current)
}

pub fn pressed<T: Copy + PartialEq>(ui: &mut Ui, choices: &[(T, &str, &str)], current: T) -> Option<T> {
    let mut clicked = None;
    for &(choice, words, hint) in choices {
        let on = choice == current;
        let theme = Theme::of(ui.visuals());
        let fill = if on { theme.hover } else { theme.panel };
        let button = Button::new(words).fill(fill).selected(on).frame_when_inactive(on);
        if ui.add(button).on_hover_text(hint).clicked() {
            clicked = Some(choice);
        }
    }
    clicked
}

pub fn source_key(ui: &mut Ui, source: &ComparedSensor, theme: &Theme) -> Response {
    let (rect, response) = ui.allocate_exact_size(Vec2::new(26.0, ROW), Sense::hover());
    paint::key(ui.painter(), rect, &key(source, String::new()), theme);
    response
}

pub fn read_at_pointer(response: &Response, lines: &[String]) {
    response.clone().on_hover_ui_at_pointer(|ui| told(ui, lines));
}

/// Shows lines of text beside what they explain, where there is room on one of these sides, the first of them first.
pub fn read_beside(response: &Response, what: Rect, sides: [egui::RectAlign; 2], lines: &[String]) {
    let mut tooltip = egui::Tooltip::for_enabled(response);
    tooltip.popup = tooltip.popup.anchor(what).align(sides[0]).align_alternatives(&sides[1..]);
    tooltip.show(|ui| told(ui, lines));
}

/// A heading and the lines below it.
pub fn told(ui: &mut Ui, lines: &[String]) {
    for (index, line) in lines.iter().enumerate() {
        if index == 0 {
            ui.strong(line);
        } else {
            ui.label(line);
        }
    }
}

/// Selects all text of a field, so that typing replaces it.
pub fn mark_all(ui: &Ui, id: egui::Id, text: &str) {
    mark(ui, id, 0..text.chars().count());
}

/// Selects a part of the text of a field.
pub fn mark(ui: &Ui, id: egui::Id, part: std::ops::Range<usize>) {
    use egui::text::{CCursor, CCursorRange};
    let mut state = egui::TextEdit::load_state(ui.ctx(), id).unwrap_or_default();
    state.cursor.set_char_range(Some(CCursorRange::two(CCursor::new(part.start), CCursor::new(part.end))));
    state.store(ui.ctx(), id);
}

const HINT_LINE: f32 = 18.0;
/// Share of the visible height that Page Up and Page Down move by.
const PAGE: f32 = 0.9;

/// Shows content that scrolls in a rectangle of a pane, also by Page Up and Page Down. Where it does not fit, a line below it is
/// kept for the hint, so that nothing moves when the end is reached.
pub fn scroll(
    ui: &mut Ui,
    (pane, name): (PaneKind, &str),
    rect: Rect,
    context: &mut PaneContext<'_>,
    content: impl FnOnce(&mut Ui, &mut PaneContext<'_>),
) {
    let key = ui.scope_id().with((name, "height"));
    let before: f32 = ui.data(|data| data.get_temp(key)).unwrap_or_default();
    let kept = if before > rect.height() { HINT_LINE } else { 0.0 };
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
        fade(ui.painter(), view, context.theme.panel);
        let slot = slot.shrink2(Vec2::new(2.0 * UNIT, 0.0));
        more_below(&ui.new_child(UiBuilder::new().id_salt((name, "below")).max_rect(slot)), slot, context.theme.weak);
    }
}

/// Fades the lower end of what scrolls into its ground: a line that is cut there reads as one that goes on.
pub fn fade(painter: &egui::Painter, area: Rect, ground: Color32) {
    const DEPTH: f32 = 16.0;
    let area = area.with_min_y(area.bottom() - DEPTH);
    let mut mesh = egui::Mesh::default();
    mesh.colored_vertex(area.left_top(), Color32::TRANSPARENT);
    mesh.colored_vertex(area.right_top(), Color32::TRANSPARENT);
    mesh.colored_vertex(area.right_bottom(), ground);
    mesh.colored_vertex(area.left_bottom(), ground);
    mesh.add_triangle(0, 1, 2);
    mesh.add_triangle(0, 2, 3);
    painter.add(Shape::mesh(mesh));
}

/// A hint at the left of a place that there is more to scroll to.
pub fn more_below(ui: &Ui, slot: Rect, color: Color32) {
    let font = FontId::proportional(crate::theme::SMALL);
    let words = ui.painter().layout_no_wrap("more below".to_owned(), font, color);
    let at = slot.left_center() + Vec2::new(14.0, -0.5 * words.size().y);
    let tip = slot.left_center() + Vec2::new(6.0, 3.0);
    ui.painter().galley(at, words, color);
    let corners = vec![tip, tip + Vec2::new(-4.0, -5.0), tip + Vec2::new(4.0, -5.0)];
    named(ui, slot, ui.scope_id().with("more below"), egui::Role::Label, "more below");
    ui.painter().add(Shape::convex_polygon(corners, color, egui::Stroke::NONE));
}
