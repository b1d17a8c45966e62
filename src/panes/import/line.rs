//! One line of a file as drawn: its interpretation is marked by shape, not by color.

use std::ops::Range;
use std::sync::Arc;

use egui::text::{CCursor, LayoutJob};
use egui::{FontId, Galley, Pos2, Rect, Stroke, StrokeKind, TextFormat, Ui, Vec2};
use spectral_file::{Mark, Shown, What};

use crate::theme::{MONO, Theme};

pub(super) struct Line {
    shown: Shown,
    marks: Vec<Mark>,
    galley: Arc<Galley>,
}

pub(super) struct Pen<'a> {
    pub(super) theme: &'a Theme,
    pub(super) understood: bool,
    pub(super) hovered: Option<usize>,
    pub(super) taken: &'a [bool],
}

impl Line {
    pub(super) fn new(ui: &Ui, shown: Shown, marks: Vec<Mark>, pen: &Pen<'_>) -> Self {
        let job = job(&shown, &marks, pen);
        let galley = ui.painter().layout_job(job);
        Self { shown, marks, galley }
    }

    /// Draws it, with frames around what has no letters or is wrong.
    pub(super) fn paint(&self, ui: &Ui, at: Pos2, error: Option<&Range<usize>>, theme: &Theme) {
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

    pub(super) fn height(&self) -> f32 {
        self.galley.size().y
    }

    pub(super) fn hit(&self, at: Pos2, pointer: Pos2) -> Option<(&Mark, Rect)> {
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
pub(super) fn legend(theme: &Theme, gap: f32) -> LayoutJob {
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
