//! Text of a file, of which only the visible lines are laid out; the interpretation of each is marked by shape, not by color.

use std::ops::Range;
use std::sync::Arc;

use egui::text::{CCursor, LayoutJob};
use egui::{
    FontId, Galley, Id, Pos2, Rect, RichText, ScrollArea, Sense, Stroke, StrokeKind, TextFormat, TextStyle, Ui,
    UiBuilder, Vec2,
};
use spectral_file::{LONGEST_LINE, Mark, Preview, Shown, What};

use crate::catalog::opened::FilePreview;
use crate::command::Command;
use crate::document::imported::{Fingerprint, ImportedSet};
use crate::figures::curves::ImportSelection;
use crate::format::sentence;
use crate::panes::context::PaneContext;
use crate::panes::widgets::{self, lines};
use crate::theme::{MONO, ROW, Theme, UNIT};

const LINE: f32 = 18.0;
const LEGEND: f32 = 20.0;
/// Length up to which a long line can be scrolled: later parts have to be skipped letter by letter.
const WIDEST: usize = 50_000;
const _: () = assert!(WIDEST < LONGEST_LINE, "a line is counted so far");
/// Number of letters of a line exposed to screen readers.
const SAID: usize = 200;

pub(super) fn show(ui: &mut Ui, rect: Rect, shown: &ImportSelection, context: &mut PaneContext<'_>) {
    let Some(file) = &shown.file else {
        if let Some(set) = &shown.set {
            away(ui, rect, set, context);
        }
        return;
    };
    let head = Rect::from_min_size(rect.min, Vec2::new(rect.width(), ROW));
    let foot = rect.with_min_y(rect.bottom() - LEGEND);
    let body = Rect::from_x_y_ranges(rect.x_range(), head.bottom()..=foot.top());
    let preview = shown.look.as_ref().map(|look| &look.preview);
    let mut words = format!("{}, {}", file.origin.name, size(file.bytes.len()));
    if let Some(Ok(preview)) = preview {
        words = format!("{words}, {}, {}", preview.encoding(), line_count(preview));
    }
    lines::elided(ui, head, &words, TextStyle::Body, context.theme.text);
    ui.painter().rect_filled(body, 0.0, context.theme.plot);
    match (&shown.look, preview) {
        (Some(look), Some(Ok(preview))) => {
            forms(ui, foot, context);
            let body = wrong(ui, body, shown, context);
            lines_of(ui, body, shown, look, preview, context);
        }
        (_, Some(Err(error))) => message(ui, body, &sentence(&error.to_string()), context.theme.error),
        _ => message(ui, body, "Reading…", context.theme.weak),
    }
}

/// Below the text, the reason that it could not be read; a click shows the line. Returns the rectangle above.
fn wrong(ui: &Ui, body: Rect, shown: &ImportSelection, context: &mut PaneContext<'_>) -> Rect {
    let Some(error) = shown.error() else { return body };
    let theme = context.theme;
    let words = sentence(&error.to_string());
    let left = body.left() + 5.0 * UNIT;
    let galley =
        ui.painter().layout(words.clone(), TextStyle::Body.resolve(ui.style()), theme.error, body.right() - left);
    let place = body.with_min_y(body.bottom() - galley.size().y.max(ROW));
    ui.painter().rect_filled(place, 0.0, theme.panel);
    lines::warning_mark(ui.painter(), place.left_top() + Vec2::new(2.0 * UNIT, 0.5 * ROW), theme.error);
    ui.painter().galley(egui::pos2(left, place.top() + 0.5 * UNIT), galley, theme.error);
    let response = ui.interact(place, Id::unique("reason below the text"), Sense::click());
    widgets::labeled(&response, egui::Role::Button, &words);
    if let Some(line) = error.line().filter(|_| response.clicked()) {
        context.view.import.line = Some(line);
        ui.ctx().request_repaint();
    }
    body.with_max_y(place.top())
}

fn forms(ui: &Ui, rect: Rect, context: &PaneContext<'_>) {
    const GAPS: [f32; 3] = [12.0, 8.0, 4.0];
    let galleys = GAPS.map(|gap| ui.painter().layout_job(legend(&context.theme, gap)));
    let [_, _, narrowest] = &galleys;
    let galley = galleys.iter().find(|galley| galley.size().x <= rect.width()).unwrap_or(narrowest);
    let at = egui::pos2(rect.left(), rect.center().y - galley.size().y / 2.0);
    let painter = ui.painter().with_clip_rect(rect.intersect(ui.clip_rect()));
    painter.galley(at, std::sync::Arc::clone(galley), context.theme.text);
}

fn size(bytes: usize) -> String {
    match bytes {
        0..1000 => format!("{bytes} bytes"),
        1000..1_000_000 => format!("{} kB", (bytes + 500) / 1000),
        _ => format!("{:.1} MB", bytes as f64 / 1e6),
    }
}

fn line_count(preview: &Preview) -> String {
    if preview.line_count() == 1 { "1 line".to_owned() } else { format!("{} lines", preview.line_count()) }
}

fn message(ui: &mut Ui, rect: Rect, words: &str, color: egui::Color32) {
    let mut child = ui.new_child(UiBuilder::new().id_salt("no text").max_rect(rect.shrink(2.0 * UNIT)));
    child.label(RichText::new(words).color(color));
}

/// A set whose file cannot be found as it was.
fn away(ui: &mut Ui, rect: Rect, set: &ImportedSet, context: &mut PaneContext<'_>) {
    let mut child = ui.new_child(UiBuilder::new().id_salt("away").max_rect(rect.shrink(UNIT)));
    let place = set.path.as_ref().map_or(String::new(), |path| format!(" ({})", path.display()));
    let text_state = if set.curves.len() == 1 { "Its curve is" } else { "Its curves are" };
    child.label(format!("{} is not available{place}. {text_state} stored in the session.", set.file));
    child.add_space(UNIT);
    context.button(&mut child, "Open…", "Locate the file", Command::Open);
}

#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct TextState {
    /// The error that was brought into view last, by its line.
    error: Option<(Fingerprint, usize)>,
    /// The line that was requested last.
    line: Option<(Fingerprint, usize)>,
}

struct Place {
    rect: Rect,
    left: f32,
    letter: f32,
    gutter: f32,
}

fn lines_of(
    ui: &mut Ui,
    rect: Rect,
    shown: &ImportSelection,
    look: &FilePreview,
    preview: &Preview,
    context: &mut PaneContext<'_>,
) {
    // All letters of the font have one width, measured more exactly on many together.
    const SAMPLE: &str = "0000000000000000";
    let sample = ui.painter().layout_no_wrap(SAMPLE.to_owned(), FontId::monospace(MONO), context.theme.text);
    let letter = sample.size().x / SAMPLE.len() as f32;
    let digits = preview.line_count().to_string().len().max(3);
    let gutter = digits as f32 * letter + 4.0 * UNIT;
    let place = Place { rect, left: rect.left() + gutter + UNIT, letter, gutter };
    let error = shown.error().and_then(|error| preview.error_range(error));
    let target = target(ui, shown, look, error.as_ref(), context);
    let columns = preview.longest().min(WIDEST) + 2;
    let content = Vec2::new(gutter + UNIT + columns as f32 * letter, preview.line_count() as f32 * LINE + UNIT);
    let mut child = widgets::clipped(ui, "text", rect);
    let mut area = ScrollArea::both().id_salt(("text of", look.fingerprint)).auto_shrink(false);
    if let Some((line, column)) = target {
        let [y, x] = [line.saturating_sub(1) as f32 * LINE, column as f32 * letter];
        area = area.vertical_scroll_offset((y - rect.height() / 3.0).max(0.0));
        let width = rect.width() - gutter;
        area = area.horizontal_scroll_offset(if x < width * 0.8 { 0.0 } else { x - width / 2.0 });
    }
    area.show_viewport(&mut child, |ui, viewport| {
        ui.set_min_size(content);
        let view = View { preview, look, shown, taken: shown.are_taken(), error: error.as_ref(), viewport };
        view.lines(ui, &place, context);
    });
}

/// The line, and the letter in it, to bring into view in this frame.
fn target(
    ui: &Ui,
    shown: &ImportSelection,
    look: &FilePreview,
    error: Option<&(usize, Range<usize>)>,
    context: &mut PaneContext<'_>,
) -> Option<(usize, usize)> {
    let id = Id::unique("text of import");
    let mut text_state: TextState = ui.data(|data| data.get_temp(id).unwrap_or_default());
    let before = text_state;
    let column = |number: usize, byte: usize| {
        let line = look.preview.as_ref().ok().and_then(|preview| preview.line(number)).unwrap_or("");
        line.char_indices().take(WIDEST).take_while(|(at, _)| *at < byte).count()
    };
    let failed = error.map(|(line, range)| (*line, column(*line, range.start)));
    let mut target = None;
    let new_error = failed.map(|(line, _)| (look.fingerprint, line));
    if shown.is_fresh() && text_state.error != new_error {
        text_state.error = new_error;
        target = failed;
    }
    if let Some(line) = context.view.import.line.take() {
        text_state.line = Some((look.fingerprint, line));
        target = failed.filter(|(failed, _)| *failed == line).or(Some((line, 0)));
    }
    if text_state != before {
        ui.data_mut(|data| data.insert_temp(id, text_state));
    }
    target
}

struct View<'a> {
    preview: &'a Preview,
    look: &'a FilePreview,
    shown: &'a ImportSelection,
    /// Flags for the imported curves, by index in the file.
    taken: Vec<bool>,
    error: Option<&'a (usize, Range<usize>)>,
    viewport: Rect,
}

impl View<'_> {
    fn lines(&self, ui: &mut Ui, place: &Place, context: &mut PaneContext<'_>) {
        let theme = context.theme;
        let first = (self.viewport.top() / LINE).floor().max(0.0) as usize;
        let count = (self.viewport.height() / LINE).ceil() as usize + 1;
        let last = (first + count).min(self.preview.line_count());
        let id = Id::unique("text of import");
        let text_state: TextState = ui.data(|data| data.get_temp(id).unwrap_or_default());
        let asked = text_state.line.filter(|(of, _)| *of == self.look.fingerprint).map(|(_, line)| line);
        let gutter = Rect::from_min_size(place.rect.min, Vec2::new(place.gutter, place.rect.height()));
        let text = place.rect.with_min_x(gutter.right());
        let clip = ui.clip_rect();
        let pointer = ui.input(|input| input.pointer.hover_pos()).filter(|at| text.contains(*at));
        let pointer = pointer.filter(|_| ui.rect_contains_pointer(text));
        let mut curve = None;
        for number in first + 1..=last {
            // So far down, the place itself would not be exact to the point.
            let y = (number - 1) as f64 * f64::from(LINE) - f64::from(self.viewport.top());
            let y = place.rect.top() + y as f32;
            let band = Rect::from_min_size(egui::pos2(place.rect.left(), y), Vec2::new(place.rect.width(), LINE));
            if asked == Some(number) {
                ui.painter().rect_filled(band, 0.0, theme.control);
            }
            let is_wrong = self.error.is_some_and(|(line, _)| *line == number);
            let color = if is_wrong { theme.error } else { theme.weak };
            let words = number.to_string();
            let label = band.with_max_x(gutter.right() - 2.0 * UNIT);
            lines::right_aligned(ui, label, &words, TextStyle::Monospace, color);
            ui.set_clip_rect(clip.intersect(text));
            let under = pointer.filter(|at| band.y_range().contains(at.y) && at.y < band.bottom());
            curve = self.line(ui, number, band, place, under, context).or(curve);
            ui.set_clip_rect(clip);
        }
        ui.painter().vline(gutter.right(), place.rect.y_range(), egui::Stroke::new(1.0, theme.line));
        widgets::hover_curve(ui, "pointer over text of import", pointer.is_some(), curve, context);
    }

    fn line(
        &self,
        ui: &Ui,
        number: usize,
        band: Rect,
        place: &Place,
        pointer: Option<egui::Pos2>,
        context: &mut PaneContext<'_>,
    ) -> Option<usize> {
        let from = (self.viewport.left() / place.letter).floor().max(0.0) as usize;
        let count = (band.width() / place.letter).ceil() as usize + 2;
        // The last letter that can be scrolled to is followed by an ellipsis.
        let count = count.min(WIDEST.saturating_sub(from));
        let part = self.preview.shown(number, from, count)?;
        let table = self.look.table.as_deref().ok();
        let marks = match (table, &self.look.marker) {
            (Some(table), Some(marker)) => self.preview.marks_within(number, part.window.clone(), table, marker),
            _ => Vec::new(),
        };
        let understood = self.look.marker.is_some();
        // If all values belong to one curve, none is highlighted.
        let several = table.is_some_and(|table| table.curves.len() > 1);
        let hovered = context.view.import.hovered_curve.filter(|_| several);
        let pen = Pen { theme: &context.theme, understood, hovered, taken: &self.taken };
        let said: String = part.text.chars().take(SAID).collect();
        let line = Line::new(ui, part, marks, &pen);
        let x = place.left + from as f32 * place.letter - self.viewport.left();
        let at = egui::pos2(x, (band.center().y - line.height() / 2.0).round());
        let error = self.error.filter(|(line, _)| *line == number).map(|(_, range)| range);
        line.paint(ui, at, error, &context.theme);
        let (id, name) = (Id::unique(("line of text", number)), format!("{number}: {said}"));
        let response = widgets::named(ui, band, id, egui::Role::Label, &name);
        let pointer = pointer?;
        if let (Some(_), Some(error)) = (error, self.shown.error()) {
            response.on_hover_text_at_pointer(sentence(&error.to_string()));
            return None;
        }
        let (mark, cell) = line.hit(at, pointer)?;
        let words = mark.what.describe(table?);
        ui.painter().rect_stroke(cell, 2.0, egui::Stroke::new(1.0, context.theme.weak), egui::StrokeKind::Outside);
        context.view.point = Some(words.clone());
        response.on_hover_text_at_pointer(words);
        mark.what.curve()
    }
}

struct Line {
    shown: Shown,
    marks: Vec<Mark>,
    galley: Arc<Galley>,
}

struct Pen<'a> {
    theme: &'a Theme,
    understood: bool,
    hovered: Option<usize>,
    taken: &'a [bool],
}

impl Line {
    fn new(ui: &Ui, shown: Shown, marks: Vec<Mark>, pen: &Pen<'_>) -> Self {
        let job = job(&shown, &marks, pen);
        let galley = ui.painter().layout_job(job);
        Self { shown, marks, galley }
    }

    /// Draws it, with frames around what has no letters or is wrong.
    fn paint(&self, ui: &Ui, at: Pos2, error: Option<&Range<usize>>, theme: &Theme) {
        let painter = ui.painter();
        if let Some(range) = error {
            let frame = self.place(at, range).unwrap_or_else(|| self.bounds(at));
            let fill = theme.error.gamma_multiply(0.16);
            painter.rect(frame, 2.0, fill, Stroke::new(1.5, theme.error), StrokeKind::Outside);
        }
        for mark in self.marks.iter().filter(|mark| matches!(mark.what, What::Gap(..))) {
            if let Some(frame) = self.place(at, &mark.range) {
                painter.rect_stroke(
                    frame.shrink2(Vec2::new(0.0, 3.0)),
                    0.0,
                    Stroke::new(1.0, theme.weak),
                    StrokeKind::Middle,
                );
            }
        }
        painter.galley(at, Arc::clone(&self.galley), theme.text);
    }

    fn height(&self) -> f32 {
        self.galley.size().y
    }

    fn hit(&self, at: Pos2, pointer: Pos2) -> Option<(&Mark, Rect)> {
        let mut found = None;
        for mark in &self.marks {
            if let Some(place) = self.place(at, &mark.range).filter(|place| place.x_range().contains(pointer.x)) {
                // A gap is narrow and overlaps its neighbors.
                found = Some((mark, place));
            }
        }
        found
    }

    fn bounds(&self, at: Pos2) -> Rect {
        Rect::from_min_size(at, self.galley.size().max(Vec2::new(4.0, 4.0)))
    }

    fn place(&self, at: Pos2, range: &Range<usize>) -> Option<Rect> {
        /// Width for a part without letters.
        const EMPTY: f32 = 6.0;
        let bytes = self.shown.map(range)?;
        let x = |byte: usize| {
            let count = self.shown.text.get(..byte).map_or(0, |text| text.chars().count());
            self.galley.pos_from_cursor(CCursor::new(count)).left()
        };
        let (mut left, mut right) = (x(bytes.start), x(bytes.end));
        if right - left < EMPTY {
            let middle = f32::midpoint(left, right);
            (left, right) = (middle - EMPTY / 2.0, middle + EMPTY / 2.0);
        }
        Some(Rect::from_min_max(at + Vec2::new(left, 0.0), at + Vec2::new(right, self.galley.size().y)))
    }
}

fn job(shown: &Shown, marks: &[Mark], pen: &Pen<'_>) -> LayoutJob {
    let mut job = LayoutJob::default();
    job.wrap.max_width = f32::INFINITY;
    job.break_on_newline = false;
    let plain = form(None, pen);
    let mut done = 0;
    let mut append = |range: Range<usize>, format: &TextFormat| {
        if let Some(text) = shown.text.get(range).filter(|text| !text.is_empty()) {
            job.append(text, 0.0, format.clone());
        }
    };
    for mark in marks {
        let Some(range) = shown.map(&mark.range) else { continue };
        let start = range.start.max(done);
        let end = range.end.max(start);
        append(done..start, &plain);
        append(start..end, &form(Some(mark.what), pen));
        done = end;
    }
    append(done..shown.text.len(), &plain);
    if shown.more_after {
        job.append("…", 0.0, plain);
    }
    job
}

fn form(what: Option<What>, pen: &Pen<'_>) -> TextFormat {
    let theme = pen.theme;
    let line = |color| Stroke::new(1.0, color);
    let weak = TextFormat { font_id: FontId::monospace(MONO), color: theme.weak, ..TextFormat::default() };
    let bright = TextFormat { color: theme.text, ..weak.clone() };
    // Values and names excluded by the user are as pale as unused ones.
    let out = |curve: usize| pen.taken.get(curve) == Some(&false);
    match what {
        None if pen.understood => weak,
        Some(What::Wavelength(..)) => TextFormat { underline: line(theme.text), ..bright },
        Some(What::Value { curve, .. } | What::Block(curve)) if pen.hovered == Some(curve) => {
            TextFormat { background: theme.hover, ..bright }
        }
        Some(What::Value { curve, .. } | What::Block(curve) | What::Name(curve)) if out(curve) => weak,
        Some(What::Unit(Some(curve))) if out(curve) => TextFormat { italics: true, ..weak },
        Some(What::Name(..)) => TextFormat { background: theme.control, expand_bg: 1.5, ..bright },
        Some(What::Unit(..)) => TextFormat { italics: true, ..bright },
        Some(What::Setting) => TextFormat { italics: true, ..weak },
        Some(What::LeftOut(..)) => TextFormat { strikethrough: line(theme.weak), ..weak },
        // Values, whatever else is a part of a curve, and all of a text of which nothing is known yet.
        _ => bright,
    }
}

/// Legend of the styles, each word in its own style, separated by `gap`.
fn legend(theme: &Theme, gap: f32) -> LayoutJob {
    let pen = Pen { theme, understood: true, hovered: None, taken: &[] };
    let mut job = LayoutJob::default();
    let mut first = true;
    let value = What::Value { curve: 0, nm: 0.0, value: 0.0, written: 0.0 };
    let left_out = What::LeftOut(spectral_file::LeftOut::Column);
    for (words, what) in [
        ("wavelength", Some(What::Wavelength(0.0))),
        ("value", Some(value)),
        ("name", Some(What::Name(0))),
        ("unit", Some(What::Unit(None))),
        ("setting", Some(What::Setting)),
        ("skipped", Some(left_out)),
        ("not used", None),
    ] {
        let format = form(what, &pen);
        let small = TextFormat { font_id: FontId::monospace(crate::theme::SMALL), ..format };
        job.append(words, if first { 0.0 } else { gap }, small);
        first = false;
    }
    job
}
