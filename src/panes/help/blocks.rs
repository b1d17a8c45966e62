//! Blocks of a help page: headings, paragraphs, lists, tables, code and formulas.

use egui::{Color32, Rect, ScrollArea, Sense, Stroke, Ui, UiBuilder, Vec2};

use super::text::{Flow, Ink};
use super::typeset;
use crate::help::formula::Formula;
use crate::help::markdown::{Block, Inline};
use crate::theme::{HEADING, MONO, TEXT, UNIT};

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
    let set = typeset::typeset(ui.painter(), formula.root(), FORMULA, true);
    let id = ui.next_auto_id();
    ScrollArea::horizontal().id_salt(id).auto_shrink([false, true]).show(ui, |ui| {
        let size = Vec2::new(INDENT + set.width, set.ascent + set.descent + 2.0 * UNIT);
        let (rect, response) = ui.allocate_exact_size(size, Sense::empty());
        response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Label, true, formula.words()));
        set.paint(ui.painter(), rect.min + Vec2::new(INDENT, UNIT + set.ascent), color);
    });
    None
}
