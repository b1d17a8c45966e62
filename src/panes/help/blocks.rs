//! Blocks of a help page: headings, paragraphs, lists, tables, code and formulas; words in several styles and formulas, broken
//! into lines on a common baseline.

use std::sync::Arc;

use egui::text::LayoutJob;
use egui::{
    Color32, CursorIcon, FontId, Galley, Pos2, Rect, ScrollArea, Sense, Stroke, TextFormat, Ui, UiBuilder, Vec2,
};

use super::typeset::{self, Typeset};
use crate::help::formula::Formula;
use crate::help::markdown::{self, Block, Inline, Style};
use crate::panes::widgets;
use crate::theme::{self, HEADING, MONO, TEXT, Theme, UNIT};

const FORMULA: f32 = 16.0;
const INDENT: f32 = 5.0 * UNIT;
const COLUMN_GAP: f32 = 4.0 * UNIT;

/// Draws a block and the space below it; returns a clicked link.
pub(super) fn show(ui: &mut Ui, block: &Block, ink: &Ink<'_>) -> Option<String> {
    let color = ink.theme.text;
    let clicked = match block {
        Block::Heading { level, content } => {
            let size = [HEADING + 4.0, HEADING, TEXT + 1.0][usize::from(*level).clamp(1, 3) - 1];
            ui.add_space(if *level == 1 { 0.0 } else { 2.0 * UNIT });
            paragraph(ui, content, size, true, color, ink)
        }
        Block::Paragraph(content) => paragraph(ui, content, TEXT, false, color, ink),
        Block::List { start, items } => list(ui, *start, items, ink),
        Block::Table(rows) => table(ui, rows, ink),
        Block::Code(text) => code(ui, text, ink),
        Block::Formula(formula) => display(ui, formula, color),
    };
    ui.add_space(UNIT);
    clicked
}

fn paragraph(
    ui: &mut Ui,
    content: &[Inline],
    size: f32,
    strong: bool,
    color: Color32,
    ink: &Ink<'_>,
) -> Option<String> {
    let flow = Flow::new(ui, content, size, strong, ink);
    let width = ui.available_width();
    let (rect, _) = ui.allocate_exact_size(Vec2::new(width, flow.height(width)), Sense::empty());
    flow.show_at(ui, rect.min, width, color, ink)
}

fn list(ui: &mut Ui, start: Option<u64>, items: &[Vec<Block>], ink: &Ink<'_>) -> Option<String> {
    let mut clicked = None;
    for (index, item) in items.iter().enumerate() {
        let mark = start.map_or_else(|| "•".to_owned(), |start| format!("{}.", start + index as u64));
        let flow = Flow::new(ui, &[Inline::text(mark)], TEXT, false, ink);
        let corner = ui.cursor().min + Vec2::new(INDENT - 2.0 * UNIT - flow.width(), 0.0);
        flow.show_at(ui, corner, INDENT, ink.theme.text, ink);
        let inner = Rect::from_min_max(ui.cursor().min + Vec2::new(INDENT, 0.0), ui.max_rect().max);
        let inner = inner.with_max_x(ui.cursor().min.x + ui.available_width());
        let inside = ui.scope_builder(UiBuilder::new().id_salt(("item", index)).max_rect(inner), |ui| {
            item.iter().fold(None, |clicked, block| show(ui, block, ink).or(clicked))
        });
        clicked = inside.inner.or(clicked);
    }
    clicked
}

/// Column widths: natural ones where they fit, otherwise the room beyond the narrowest is shared in proportion.
fn column_widths(rows: &[Vec<Flow>], room: f32) -> Vec<f32> {
    let columns = rows.iter().map(Vec::len).max().unwrap_or(0);
    let most = |column: usize, width: fn(&Flow) -> f32| {
        rows.iter().filter_map(|row| row.get(column)).map(width).fold(0.0_f32, f32::max).ceil()
    };
    let natural: Vec<f32> = (0..columns).map(|column| most(column, Flow::width)).collect();
    let narrowest: Vec<f32> = (0..columns).map(|column| most(column, Flow::narrowest)).collect();
    let room = room - COLUMN_GAP * columns.saturating_sub(1) as f32;
    let (wide, narrow): (f32, f32) = (natural.iter().sum(), narrowest.iter().sum());
    if wide <= room {
        return natural;
    }
    let share = ((room - narrow) / (wide - narrow).max(1.0)).max(0.0);
    natural.iter().zip(&narrowest).map(|(wide, narrow)| (narrow + share * (wide - narrow)).floor()).collect()
}

fn table(ui: &mut Ui, rows: &[Vec<Vec<Inline>>], ink: &Ink<'_>) -> Option<String> {
    let flow = |cell: &Vec<Inline>, head| Flow::new(ui, cell, TEXT - 0.5, head, ink);
    let rows: Vec<Vec<Flow>> =
        rows.iter().enumerate().map(|(index, row)| row.iter().map(|cell| flow(cell, index == 0)).collect()).collect();
    let widths = column_widths(&rows, ui.available_width());
    let total = widths.iter().sum::<f32>() + COLUMN_GAP * widths.len().saturating_sub(1) as f32;
    let mut clicked = None;
    let id = ui.next_auto_id();
    ScrollArea::horizontal().id_salt(id).auto_shrink([false, true]).show(ui, |ui| {
        ui.spacing_mut().item_spacing.y = 0.0;
        for row in &rows {
            // A head without words has no line.
            let height = row.iter().zip(&widths).map(|(cell, width)| cell.height(*width)).fold(0.0, f32::max);
            if row.iter().all(|cell| cell.width() == 0.0) {
                continue;
            }
            let (rect, _) = ui.allocate_exact_size(Vec2::new(total, height + UNIT), Sense::empty());
            let mut x = rect.left();
            for (cell, width) in row.iter().zip(&widths) {
                let corner = egui::pos2(x, rect.top() + 0.5 * UNIT);
                clicked = cell.show_at(ui, corner, *width, ink.theme.text, ink).or(clicked.take());
                x += width + COLUMN_GAP;
            }
            ui.painter().hline(rect.x_range(), rect.bottom(), Stroke::new(1.0, ink.theme.line));
        }
    });
    clicked
}

fn code(ui: &mut Ui, text: &str, ink: &Ink<'_>) -> Option<String> {
    egui::Frame::NONE.fill(ink.theme.plot).inner_margin(2.0 * UNIT).show(ui, |ui| {
        ui.set_width(ui.available_width());
        ui.add(egui::Label::new(egui::RichText::new(text).monospace().size(MONO)).wrap());
    });
    None
}

fn display(ui: &mut Ui, formula: &Formula, color: Color32) -> Option<String> {
    let set = typeset::typeset(ui.painter(), &formula.root, FORMULA, true);
    let id = ui.next_auto_id();
    ScrollArea::horizontal().id_salt(id).auto_shrink([false, true]).show(ui, |ui| {
        let size = Vec2::new(INDENT + set.width, set.ascent + set.descent + 2.0 * UNIT);
        let (rect, response) = ui.allocate_exact_size(size, Sense::empty());
        widgets::labeled(&response, egui::Role::Label, formula.words.as_str());
        set.paint(ui.painter(), rect.min + Vec2::new(INDENT, UNIT + set.ascent), color);
    });
    None
}

const CODE: f32 = 0.93;
const LEADING: f32 = 0.28;
const SPACE: f32 = 0.32;

pub(super) struct Ink<'a> {
    pub(super) theme: Theme,
    pub(super) terms: &'a [String],
}

/// A paragraph in pieces that are not broken.
pub(super) struct Flow {
    pieces: Vec<Piece>,
    size: f32,
    words: String,
}

struct Piece {
    what: What,
    width: f32,
    ascent: f32,
    descent: f32,
    /// True if a line may begin here, after a space.
    after_space: bool,
    style: Style,
    highlighted: bool,
    link: Option<String>,
}

enum What {
    Word(Arc<Galley>),
    Formula(Typeset),
}

/// A piece's place relative to the paragraph's top left corner.
struct Placed {
    piece: usize,
    x: f32,
    baseline: f32,
}

impl Flow {
    pub(super) fn new(ui: &Ui, content: &[Inline], size: f32, strong: bool, ink: &Ink<'_>) -> Self {
        let mut flow = Self { pieces: Vec::new(), size, words: markdown::plain(content) };
        let mut after_space = true;
        for part in content {
            match part {
                Inline::Text { text, style, link } => {
                    for (index, word) in text.split(' ').enumerate() {
                        after_space |= index > 0;
                        if !word.is_empty() {
                            let style = Style { strong: style.strong || strong, ..*style };
                            let mut piece = word_piece(ui, word, size, style, ink);
                            (piece.after_space, piece.link) = (after_space, link.clone());
                            flow.pieces.push(piece);
                            after_space = false;
                        }
                    }
                }
                Inline::Formula(formula) => {
                    let set = typeset::typeset(ui.painter(), &formula.root, size + 0.5, formula.display);
                    flow.pieces.push(Piece { after_space, ..formula_piece(set) });
                    after_space = false;
                }
            }
        }
        flow
    }

    pub(super) fn width(&self) -> f32 {
        self.place(f32::INFINITY).2
    }

    pub(super) fn narrowest(&self) -> f32 {
        self.place(1.0).2
    }

    pub(super) fn height(&self, width: f32) -> f32 {
        self.place(width).1
    }

    /// Places of pieces, height, and width of the longest line.
    fn place(&self, width: f32) -> (Vec<Placed>, f32, f32) {
        let mut placed: Vec<Placed> = Vec::with_capacity(self.pieces.len());
        let (mut x, mut y, mut longest) = (0.0_f32, 0.0_f32, 0.0_f32);
        let mut first = 0;
        let mut index = 0;
        while index < self.pieces.len() {
            // Pieces without a space between them stay together.
            let end = (index + 1..self.pieces.len()).find(|&i| self.pieces[i].after_space).unwrap_or(self.pieces.len());
            let chunk: f32 = self.pieces[index..end].iter().map(|piece| piece.width).sum();
            let space = if index > first { SPACE * self.size } else { 0.0 };
            if index > first && x + space + chunk > width {
                y = self.end_line(&mut placed, first, y);
                (first, x) = (index, 0.0);
            } else {
                x += space;
            }
            for piece in index..end {
                placed.push(Placed { piece, x, baseline: 0.0 });
                x += self.pieces[piece].width;
            }
            longest = longest.max(x);
            index = end;
        }
        let bottom = self.end_line(&mut placed, first, y);
        (placed, bottom, longest)
    }

    /// Sets the baseline of the line that begins with piece `first`, and returns the line's bottom.
    fn end_line(&self, placed: &mut [Placed], first: usize, top: f32) -> f32 {
        let line = &self.pieces[first..placed.len()];
        let usual = [0.93 * self.size, 0.24 * self.size];
        let most = |usual: f32, extent: fn(&Piece) -> f32| line.iter().map(extent).fold(usual, f32::max);
        let ascent = most(usual[0], |piece| piece.ascent);
        let descent = most(usual[1], |piece| piece.descent);
        for place in &mut placed[first..] {
            place.baseline = top + ascent;
        }
        top + ascent + descent + LEADING * self.size
    }

    /// Draws the paragraph at a place and returns a clicked link. A screen reader gets it as one label.
    pub(super) fn show_at(&self, ui: &Ui, at: Pos2, width: f32, color: Color32, ink: &Ink<'_>) -> Option<String> {
        let (placed, height, longest) = self.place(width);
        // The place on the page, which scrolling does not change.
        let corner = (at - ui.min_rect().min).round();
        let id = ui.scope_id().with((corner.x as i32, corner.y as i32));
        let rect = Rect::from_min_size(at, Vec2::new(longest, height));
        let label = ui.interact(rect, id, Sense::empty());
        widgets::labeled(&label, egui::Role::Label, &self.words);
        let mut clicked = None;
        let mut before: Option<&str> = None;
        for Placed { piece, x, baseline } in placed {
            let place = egui::pos2(at.x + x, at.y + baseline);
            let piece = &self.pieces[piece];
            if ui.is_rect_visible(rect) {
                self.paint(ui, piece, place, color, ink);
            }
            if let Some(link) = &piece.link {
                // The first piece of a link takes the keyboard, the others only clicks.
                let sense = if before == Some(link) { Sense::CLICK } else { Sense::click() };
                let area = Rect::from_min_max(
                    place - Vec2::new(0.0, piece.ascent),
                    place + Vec2::new(piece.width, piece.descent),
                );
                let response = ui.interact(area, id.with((x.to_bits(), baseline.to_bits())), sense);
                widgets::labeled(&response, egui::Role::Link, self.link_words(link));
                if response.has_focus() {
                    ui.painter().rect_stroke(area, 0.0, Stroke::new(1.0, ink.theme.focus), egui::StrokeKind::Outside);
                }
                if response.on_hover_cursor(CursorIcon::PointingHand).on_hover_text(link).clicked() {
                    clicked = Some(link.clone());
                }
            }
            before = piece.link.as_deref();
        }
        clicked
    }

    fn link_words(&self, link: &str) -> String {
        let words = self.pieces.iter().filter(|piece| piece.link.as_deref() == Some(link));
        let words = words.filter_map(|piece| match &piece.what {
            What::Word(galley) => Some(galley.text().to_owned()),
            What::Formula(_) => None,
        });
        words.collect::<Vec<_>>().join(" ")
    }

    fn paint(&self, ui: &Ui, piece: &Piece, place: Pos2, color: Color32, ink: &Ink<'_>) {
        let area = Rect::from_min_max(
            place - Vec2::new(0.0, 0.9 * self.size),
            place + Vec2::new(piece.width, 0.25 * self.size),
        );
        if piece.highlighted {
            ui.painter().rect_filled(area.expand(1.0), 2.0, ink.theme.chosen);
        } else if piece.style.code {
            ui.painter().rect_filled(area.expand(1.0), 2.0, ink.theme.plot);
        }
        match &piece.what {
            What::Word(galley) => {
                let top = place - Vec2::new(0.0, typeset::baseline(galley));
                ui.painter().galley_with_override_text_color(top, galley.clone(), color);
            }
            What::Formula(set) => set.paint(ui.painter(), place, color),
        }
        if piece.link.is_some() {
            let y = place.y + 2.5;
            ui.painter().hline(area.x_range(), y, Stroke::new(1.0, color));
        }
    }
}

fn word_piece(ui: &Ui, word: &str, size: f32, style: Style, ink: &Ink<'_>) -> Piece {
    let font = match style {
        Style { code: true, .. } => FontId::monospace(CODE * size),
        Style { strong: true, .. } => FontId::new(size, theme::bold()),
        _ => FontId::proportional(size),
    };
    let format = TextFormat { italics: style.emphasis, font_id: font, ..TextFormat::default() };
    let mut job = LayoutJob::single_section(word.to_owned(), format);
    job.wrap.max_width = f32::INFINITY;
    let galley = ui.painter().layout_job(job);
    let folded = if ink.terms.is_empty() { String::new() } else { word.to_lowercase() };
    let width = galley.size().x;
    let ascent = typeset::baseline(&galley);
    Piece {
        width,
        ascent,
        descent: galley.size().y - ascent,
        after_space: false,
        style,
        highlighted: ink.terms.iter().any(|term| folded.contains(term.as_str())),
        link: None,
        what: What::Word(galley),
    }
}

fn formula_piece(set: Typeset) -> Piece {
    Piece {
        width: set.width,
        ascent: set.ascent,
        descent: set.descent,
        after_space: false,
        style: Style::default(),
        highlighted: false,
        link: None,
        what: What::Formula(set),
    }
}
