//! One line of text that never runs over its place, keys of sources, small marks, numbers.

use std::sync::Arc;

use chromascope_figure::{Ink, LegendEntry, Stroke};
use egui::{
    Align, Color32, Galley, Layout, Painter, Pos2, Rect, Response, Sense, Shape, TextStyle, TextWrapMode, Ui,
    UiBuilder, Vec2, WidgetText,
};

use crate::action::{Action, SceneAction};
use crate::document::TransformChoice;
use crate::format::cut_in_middle;
use crate::paint;
use crate::panes::context::PaneContext;
use crate::scene::ComparedSensor;
use crate::theme::{FADED, ROW, Theme, UNIT};

pub const KEY: f32 = 26.0;
pub const DOTS: f32 = 18.0;

/// Draws a line of text into a rectangle, with an ellipsis if it does not fit. Returns whether it was cut.
pub fn elided(ui: &Ui, rect: Rect, words: &str, style: TextStyle, color: Color32) -> bool {
    let galley = truncated(ui, rect, words, style);
    let at = Pos2::new(rect.left(), rect.center().y - galley.size().y / 2.0);
    let cut = galley.elided;
    ui.painter().galley(at, galley, color);
    cut
}

fn truncated(ui: &Ui, rect: Rect, words: &str, style: TextStyle) -> Arc<Galley> {
    WidgetText::from(words).into_galley(ui, Some(TextWrapMode::Truncate), rect.width().max(0.0), style)
}

/// Draws a name into a rectangle, with an ellipsis in its middle if it does not fit. Returns whether it was cut.
pub fn name(ui: &Ui, rect: Rect, words: &str, style: TextStyle, color: Color32) -> bool {
    let shown = cut_in_middle(words, |words| !truncated(ui, rect, words, style.clone()).elided);
    elided(ui, rect, &shown, style, color) || *shown != *words
}

/// Draws small text into a rectangle, in at most so many rows, with an ellipsis if it does not fit.
pub fn wrapped(ui: &Ui, rect: Rect, words: &str, rows: usize, color: Color32) {
    let font = TextStyle::Small.resolve(ui.style());
    let mut job = egui::text::LayoutJob::simple(words.to_owned(), font, color, rect.width().max(0.0));
    job.wrap.max_rows = rows;
    let galley = ui.ctx().fonts_mut(|fonts| fonts.layout_job(job));
    ui.painter().galley(rect.min, galley, color);
}

pub fn width(ui: &Ui, words: &str, style: TextStyle) -> f32 {
    WidgetText::from(words).into_galley(ui, Some(TextWrapMode::Extend), f32::INFINITY, style).size().x
}

/// Draws a line of text that ends at the right of a rectangle. Returns its width.
pub fn right_aligned(ui: &Ui, rect: Rect, words: &str, style: TextStyle, color: Color32) -> f32 {
    let galley = WidgetText::from(words).into_galley(ui, Some(TextWrapMode::Extend), f32::INFINITY, style);
    let size = galley.size();
    ui.painter().galley(Pos2::new(rect.right() - size.x, rect.center().y - size.y / 2.0), galley, color);
    size.x
}

/// Draws a source's key: filled where it is shown, hollow and pale where it is hidden, with a dot where it is the user's.
pub fn key(painter: &Painter, rect: Rect, source: &ComparedSensor, theme: &Theme) {
    let ink = if source.visible { Ink::new(source.role) } else { Ink::new(source.role).faded(FADED) };
    let entry = LegendEntry {
        name: source.label.clone(),
        stroke: Some(Stroke::solid(ink, source.width)),
        marker: Some(source.marker),
        fill: source.visible.then_some(ink),
    };
    paint::key(painter, rect, &entry, theme);
    if source.is_own && source.visible {
        painter.circle_filled(rect.center(), 1.8, theme.panel);
    }
}

pub fn key_and_label(ui: &mut Ui, source: &ComparedSensor, theme: &Theme) -> Response {
    let (rect, response) = ui.allocate_exact_size(Vec2::new(ui.available_width(), ROW), Sense::hover());
    key(ui.painter(), Rect::from_min_size(rect.min, Vec2::new(KEY, ROW)), source, theme);
    let words = rect.with_min_x(rect.left() + KEY + 8.0);
    let cut = name(ui, words, &source.label, TextStyle::Body, theme.text);
    labeled(&response, egui::Role::Label, &source.label);
    if cut { response.on_hover_text(&source.label) } else { response }
}

/// A drawn part that shows nothing else under the pointer, with its name for screen readers.
pub fn named(ui: &Ui, rect: Rect, id: egui::Id, role: egui::Role, words: &str) -> Response {
    let response = ui.interact(rect, id, Sense::hover());
    response.widget_info(|| egui::WidgetInfo::labeled(role, true, words));
    response
}

/// Names a control for screen readers.
#[allow(
    clippy::needless_pass_by_value,
    reason = "texts and references to them, made into words only for who reads them"
)]
pub fn labeled(response: &Response, role: egui::Role, words: impl ToString) {
    response.widget_info(|| egui::WidgetInfo::labeled(role, true, words.to_string()));
}

pub fn focus_rim(response: &Response, theme: &Theme) -> egui::Stroke {
    if response.has_focus() { egui::Stroke::new(1.5, theme.text) } else { egui::Stroke::NONE }
}

/// A small button of three dots that opens a row's menu.
pub fn dots(ui: &Ui, rect: Rect, id: egui::Id, name: &str) -> Response {
    let theme = Theme::of(ui.visuals());
    let response = ui.interact(rect, id, Sense::click());
    labeled(&response, egui::Role::Button, name);
    if response.hovered() || response.has_focus() {
        ui.painter().rect(rect, 3.0, theme.hover, focus_rim(&response, &theme), egui::StrokeKind::Inside);
    }
    let color = if response.hovered() { theme.text } else { theme.weak };
    for step in [-4.0, 0.0, 4.0] {
        ui.painter().circle_filled(rect.center() + Vec2::new(step, 0.0), 1.1, color);
    }
    response.on_hover_text(name)
}

/// A triangle with an exclamation mark: a shape in addition to the color.
pub fn warning_mark(painter: &Painter, center: Pos2, color: Color32) {
    let at = |x: f32, y: f32| center + Vec2::new(x, y);
    let stroke = egui::Stroke::new(1.3, color);
    painter.add(Shape::closed_line(vec![at(0.0, -6.0), at(6.5, 5.0), at(-6.5, 5.0)], stroke));
    painter.line_segment([at(0.0, -2.5), at(0.0, 1.5)], stroke);
    painter.circle_filled(at(0.0, 3.3), 0.8, color);
}

/// Shows the scene's caution, if there is one, with its remedy as a button. Returns the rectangle that remains below.
pub fn caution(ui: &mut Ui, rect: Rect, context: &mut PaneContext<'_>) -> Rect {
    let Some(caution) = context.scene.caution() else { return rect };
    let line = Rect::from_min_size(rect.min, Vec2::new(rect.width(), ROW));
    let layout = Layout::right_to_left(Align::Center);
    let mut row = ui.new_child(UiBuilder::new().id_salt("caution").max_rect(line).layout(layout));
    row.set_clip_rect(line.intersect(ui.clip_rect()));
    if let Some(observer) = caution.fit_to() {
        let words = format!("Fit 3×3 to {observer}");
        let hint = "Color transform: a 3×3 matrix for each camera, fitted to this observer";
        let transform = TransformChoice::Observer(observer.to_owned());
        context.button(&mut row, &words, hint, Action::Scene(SceneAction::SetTransform(transform)));
    }
    let sentence = caution.sentence();
    let mut rest = line.with_max_x(row.min_rect().left() - 2.0 * UNIT);
    if caution.fit_to().is_none() {
        rest.max.x = line.right();
    }
    warning_mark(ui.painter(), egui::pos2(rest.left() + 7.0, rest.center().y), context.theme.warning);
    rest.min.x += 5.0 * UNIT;
    elided(ui, rest, &sentence, TextStyle::Small, context.theme.warning);
    let response = named(ui, rest, ui.scope_id().with(("caution", rect.min.x as i32)), egui::Role::Alert, &sentence);
    response.on_hover_text(sentence);
    rect.with_min_y(line.bottom() + 0.5 * UNIT)
}

/// Largest share of a pane's height that sentences at its foot take; longer ones are cut and stand under the pointer.
const FOOT: f32 = 0.3;

/// Writes sentences at the foot of a pane. Returns the rectangle that remains above.
pub fn foot(ui: &Ui, rect: Rect, words: &str, context: &PaneContext<'_>) -> Rect {
    let font = TextStyle::Small.resolve(ui.style());
    let galley = ui.painter().layout(words.to_owned(), font, context.theme.weak, rect.width());
    let line = galley.rows.first().map_or(0.0, |row| row.height());
    let fits = galley.size().y <= FOOT * rect.height();
    let height = if fits { galley.size().y } else { line };
    let place = rect.with_min_y(rect.bottom() - height);
    if fits {
        ui.painter().galley(place.min, galley, context.theme.weak);
    } else {
        elided(ui, place, words, TextStyle::Small, context.theme.weak);
    }
    let response = named(ui, place, ui.scope_id().with(("foot", rect.min.x as i32)), egui::Role::Label, words);
    response.on_hover_text(words);
    rect.with_max_y(place.top() - UNIT)
}
