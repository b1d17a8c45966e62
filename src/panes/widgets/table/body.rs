//! Header and rows of a table; only visible ones are laid out.

use chromascope_figure::{Cell, CellValue, Column, InkRole};
use egui::{Id, Rect, Response, Role, Sense, Stroke, StrokeKind, TextStyle, Ui, UiBuilder, Vec2, WidgetInfo};
use egui_table::{CellInfo, HeaderCellInfo, HeaderRow, PrefetchInfo, TableDelegate};

use super::columns::{Form, Layout, WIDEST_TEXT, air, words};
use super::{COMPACT_LINE, DataTable, HEAD_LINE, LINE, TableLook, TableOutput, cut};
use crate::panes::context::PaneContext;
use crate::panes::widgets::{fade, focus_rim, lines};
use crate::plot_item::{PlotItem, Relation};
use crate::theme::{Theme, UNIT};
use crate::view::Sorting;

/// Largest share of a table that its first column takes where it stays in place.
const WIDEST_FROZEN: f32 = 0.6;

pub(super) struct Body<'a> {
    of: &'a DataTable<'a>,
    layouts: Vec<Layout>,
    /// Columns and rows as shown, counted as given.
    pub(super) shown: Vec<usize>,
    pub(super) order: Vec<usize>,
    theme: Theme,
    sorting: Option<Sorting>,
    reference: String,
    selected: Option<PlotItem>,
    pointed: Option<PlotItem>,
    cursor: Option<usize>,
    id: Id,
    /// The first column stays in place.
    sticks: bool,
    /// Whether a column is cut at the right or out of sight there, and rows are out of sight below.
    goes_on: [bool; 2],
    /// Air at the right of cells that a narrow table does without.
    spared: f32,
    frozen: bool,
    pub(super) hovered: Option<usize>,
    pub(super) clicked_head: Option<usize>,
    pub(super) output: TableOutput,
}

impl<'a> Body<'a> {
    pub(super) fn new(
        of: &'a DataTable<'a>,
        layouts: Vec<Layout>,
        shown: Vec<usize>,
        order: Vec<usize>,
        look: &TableLook,
        context: &PaneContext<'_>,
    ) -> Self {
        Self {
            of,
            layouts,
            shown,
            order,
            theme: context.theme,
            sorting: look.sorting.clone(),
            reference: context.scene.document.reference.clone(),
            selected: context.view.selected.clone(),
            pointed: context.view.hovered.clone(),
            cursor: look.cursor,
            id: Id::unique(("table", of.id)),
            sticks: false,
            goes_on: [false; 2],
            spared: 0.0,
            frozen: false,
            hovered: None,
            clicked_head: None,
            output: TableOutput::default(),
        }
    }

    pub(super) fn follow(&mut self, look: &TableLook, context: &PaneContext<'_>) {
        self.cursor = look.cursor;
        self.selected.clone_from(&context.view.selected);
    }

    /// Place of the selected row, or of the one under the keyboard.
    pub(super) fn current(&self, look: &TableLook) -> Option<usize> {
        self.order.iter().position(|&row| self.is_selected(row)).or_else(|| {
            let cursor = look.cursor.filter(|_| self.of.item.is_none())?;
            self.order.iter().position(|&row| row == cursor)
        })
    }

    fn is_selected(&self, row: usize) -> bool {
        match (self.of.item, &self.selected) {
            (Some(item), Some(selected)) => {
                // A selected camera is that of all rows of its patches.
                let is_it = |item: PlotItem| {
                    item.patch().is_some() == selected.patch().is_some()
                        && selected.relation_to(&item, &self.reference) == Relation::Same
                };
                item(row).is_some_and(is_it)
            }
            (Some(_), None) => false,
            (None, _) => self.cursor == Some(row) && !self.of.compact,
        }
    }

    /// Height of the head: one line, or two where there are units.
    pub(super) fn head_height(&self) -> f32 {
        let columns = &self.of.table.columns;
        let has = |text: fn(&Column) -> &str| self.shown.iter().any(|&index| !text(&columns[index]).is_empty());
        let lines = f32::from(u8::from(has(|column| &column.name))) + f32::from(u8::from(has(|column| &column.unit)));
        let air = if self.of.compact || lines == 0.0 { 0.0 } else { 1.5 * UNIT };
        lines * HEAD_LINE + air
    }

    pub(super) fn page(&self, ui: &Ui) -> usize {
        ui.data(|data| data.get_temp::<usize>(self.id)).unwrap_or(1).max(1)
    }

    pub(super) fn show(&mut self, ui: &mut Ui, rect: Rect, scroll_to: Option<usize>) {
        let mut child = cut(ui, self.id.with("body"), rect);
        let mut widths: Vec<f32> = self.shown.iter().map(|&column| self.layouts[column].width).collect();
        if self.of.compact {
            self.spared = fit(&mut widths, rect.width());
            return self.lay_out(&mut child, rect, &widths);
        }
        // A last column whose text is cut has what is left, but for the scroll bar.
        let left = rect.width() - widths.iter().sum::<f32>() - 3.0 * UNIT;
        if let (Some(last), Some(&column)) = (widths.last_mut(), self.shown.last())
            && self.layouts[column].form == Form::Text
            && f64::from(*last) > WIDEST_TEXT
        {
            *last += left.max(0.0);
        }
        // Names and air give way to a column that lacks little room.
        let (room, air) = (rect.width() - 3.0 * UNIT, SPARE * widths.len().saturating_sub(1) as f32);
        if left < 0.0 && widths.iter().sum::<f32>() - air - (widths[0] - LEAST_NAME).max(0.0) <= room {
            self.spared = fit(&mut widths, room);
        }
        self.sticks = widths.len() > 1 && widths[0] < WIDEST_FROZEN * rect.width();
        let page = ((rect.height() - self.head_height()) / self.default_row_height()).floor() as usize;
        ui.data_mut(|data| data.insert_temp(self.id, page));
        let columns = widths.into_iter().map(|width| egui_table::Column::new(width).resizable(false));
        let mut table = egui_table::Table::new()
            .id_salt(self.of.id)
            .num_rows(self.order.len() as u64)
            .columns(columns.collect::<Vec<_>>())
            .num_sticky_cols(usize::from(self.sticks))
            .headers([HeaderRow::new(self.head_height())]);
        if let Some(row) = scroll_to {
            // With its neighbors, so that it does not lie below the edge's fade.
            let row = row as u64;
            table = table.scroll_to_rows(
                row.saturating_sub(1)..=(row + 1).min((self.order.len() as u64).saturating_sub(1)),
                None,
            );
        }
        table.show(&mut child, self);
        if self.goes_on[1] {
            fade(child.painter(), rect, self.theme.panel);
        }
        if self.goes_on[0] {
            let at = egui::pos2(rect.right() - UNIT, rect.top() + 0.5 * self.head_height());
            let stroke = Stroke::new(1.5, self.theme.text);
            let ground = Rect::from_center_size(at, Vec2::new(2.0 * UNIT, HEAD_LINE));
            child.painter().rect_filled(ground, 0.0, self.theme.panel);
            for wing in [-4.0, 4.0] {
                child.painter().line_segment([at + Vec2::new(2.0, 0.0), at + Vec2::new(-2.0, wing)], stroke);
            }
        }
    }

    /// Width that the columns of a compact table need.
    pub(super) fn least_width(&self) -> f32 {
        let widths = self.shown.iter().map(|&column| self.layouts[column].width);
        widths.sum::<f32>() - SPARE * self.shown.len().saturating_sub(1) as f32
    }

    /// Lays out all rows, visible or not: a few within other text.
    fn lay_out(&mut self, ui: &mut Ui, rect: Rect, widths: &[f32]) {
        let edges: Vec<f32> = std::iter::once(rect.left())
            .chain(widths.iter().scan(rect.left(), |x, width| {
                *x += width;
                Some(*x)
            }))
            .collect();
        let cell = |ui: &mut Ui, x: std::ops::Range<usize>, top: f32, height: f32| {
            let place = Rect::from_x_y_ranges(edges[x.start]..=edges[x.end], top..=top + height);
            ui.new_child(UiBuilder::new().max_rect(place))
        };
        let head = self.head_height();
        if head > 0.0 {
            for column in 0..widths.len() {
                self.head(&cell(ui, column..column + 1, rect.top(), head), column);
            }
        }
        for row in 0..self.order.len() {
            let top = rect.top() + head + COMPACT_LINE * row as f32;
            self.row(&cell(ui, 0..widths.len(), top, COMPACT_LINE), row);
            for column in 0..widths.len() {
                self.cell(&cell(ui, column..column + 1, top, COMPACT_LINE), row, column);
            }
        }
    }

    fn inner(&self, cell: Rect) -> Rect {
        let [left, right] = air(self.of.compact);
        Rect::from_min_max(cell.min + Vec2::new(left, 0.0), cell.max - Vec2::new(right - self.spared, 0.0))
    }

    fn arrow(&self, ui: &Ui, rect: Rect, descending: bool) {
        let center = rect.center();
        let tip = if descending { 3.0 } else { -3.0 };
        let points = [(-4.0, -tip), (4.0, -tip), (0.0, tip)].map(|(x, y)| center + Vec2::new(x, y));
        ui.painter().add(egui::Shape::convex_polygon(points.to_vec(), self.theme.text, Stroke::NONE));
    }

    /// A row's ground: shaded under the pointer, framed where it is selected.
    fn ground(&self, ui: &Ui, rect: Rect, row: usize, response: &Response) {
        let pointed = self.pointed.is_some() && self.pointed == self.of.item.and_then(|item| item(row));
        if response.hovered() || pointed {
            ui.painter().rect_filled(rect, 0.0, self.theme.control);
        }
        if self.is_selected(row) {
            ui.painter().rect_stroke(rect, 2.0, Stroke::new(1.5, self.theme.text), StrokeKind::Inside);
        }
    }

    fn said(&self, row: usize, column: usize) -> String {
        let cell = self.of.table.cell(row, column);
        match cell.value() {
            CellValue::Nothing => "–".to_owned(),
            CellValue::Text(text) => text.to_owned(),
            CellValue::Number(value) => {
                let number = self.number_in_words(cell, value, column).trim_end().to_owned();
                cell.note().behind().map_or(number.clone(), |behind| format!("{number} {behind}"))
            }
        }
    }

    fn number_in_words(&self, cell: &Cell, value: f64, column: usize) -> String {
        let note = cell.note();
        note.words.clone().unwrap_or_else(|| words(value, self.layouts[column].form, note.own_decimals()))
    }

    /// A row in words: its first cell, then each column with its cell.
    fn spoken(&self, row: usize) -> String {
        let said = |&column: &usize| self.said(row, column);
        let Some((first, others)) = self.shown.split_first() else { return String::new() };
        let others = others.iter().filter(|column| !self.of.is_drawn(**column));
        let others = others.map(|column| format!("{} {}", self.of.table.columns[*column].name, said(column)));
        let others: Vec<String> = others.map(|words| words.trim_start().to_owned()).collect();
        if others.is_empty() { said(first) } else { format!("{}: {}", said(first), others.join(", ")) }
    }

    fn number(&self, ui: &Ui, rect: Rect, cell: &Cell, value: f64, column: usize) {
        let (layout, note) = (self.layouts[column], cell.note());
        let edge = ui.clip_rect().right();
        let mut place = rect;
        place.max.x -= layout.uncertainty;
        if place.right() > edge + 1.0 {
            // Part of a number would be read as another; the head has the sign that more follow.
            return;
        }
        let ink = if note.is_gray { self.theme.weak } else { self.theme.text };
        if !note.is_gray
            && let Some(share) = layout.shade(value)
        {
            let ground = rect.shrink2(Vec2::new(1.0, 2.0)).expand2(Vec2::new(2.0 * UNIT - 2.0, 0.0));
            ui.painter().rect_filled(ground, 2.0, self.theme.shade(share));
        }
        let written = self.number_in_words(cell, value, column);
        let written = if self.of.ragged { written.trim_end() } else { &written };
        if layout.form == Form::Text {
            lines::elided(ui, place, written, TextStyle::Monospace, ink);
        } else {
            lines::right_aligned(ui, place, written, TextStyle::Monospace, ink);
        }
        let Some(behind) = note.behind() else { return };
        place = rect.with_min_x(place.max.x + UNIT);
        lines::elided(ui, place.with_max_x(place.right().min(edge)), &behind, TextStyle::Small, self.theme.weak);
    }
}

/// Spreads columns over a width; or takes the spare air of all but the first, and then narrows the first, which holds names.
/// Returns the air that was taken.
fn fit(widths: &mut [f32], width: f32) -> f32 {
    let others = widths.len().saturating_sub(1).max(1) as f32;
    let spare = ((widths.iter().sum::<f32>() - width) / others).clamp(0.0, SPARE);
    widths.iter_mut().skip(1).for_each(|other| *other -= spare);
    let all: f32 = widths.iter().sum();
    if let Some(first) = widths.first_mut() {
        *first = (*first + width - all).clamp(first.min(24.0), *first);
    }
    spare
}

/// Least width of names that others take room from.
const LEAST_NAME: f32 = 72.0;
/// Air of a column that it can do without.
const SPARE: f32 = 2.0 * UNIT;

impl TableDelegate for Body<'_> {
    fn prepare(&mut self, seen: &PrefetchInfo) {
        self.frozen = false;
        self.goes_on = [seen.visible_columns.end < self.shown.len(), seen.visible_rows.end < self.order.len() as u64];
    }

    fn default_row_height(&self) -> f32 {
        if self.of.compact { COMPACT_LINE } else { LINE }
    }

    fn header_cell_ui(&mut self, ui: &mut Ui, cell: &HeaderCellInfo) {
        // Heads come between the cells that scroll and those that stay.
        self.frozen = true;
        self.head(ui, cell.col_range.start);
    }

    fn row_ui(&mut self, ui: &mut Ui, row_nr: u64) {
        self.row(ui, row_nr as usize);
    }

    fn cell_ui(&mut self, ui: &mut Ui, cell: &CellInfo) {
        self.cell(ui, cell.row_nr as usize, cell.col_nr);
    }
}

impl Body<'_> {
    /// A column's head; a click sorts.
    fn head(&mut self, ui: &Ui, place: usize) {
        let index = self.shown[place];
        let (column, layout) = (&self.of.table.columns[index], self.layouts[index]);
        let rect = ui.max_rect();
        self.goes_on[0] |= rect.right() > ui.clip_rect().right() + UNIT;
        let sense = if self.of.compact { Sense::hover() } else { Sense::click() };
        let response = ui.interact(rect, self.id.with(("head", index)), sense);
        lines::labeled(&response, Role::ColumnHeader, column.full_name());
        if response.hovered() && !self.of.compact || response.has_focus() {
            let rim = focus_rim(&response, &self.theme);
            ui.painter().rect(rect.shrink(1.0), 3.0, self.theme.control, rim, StrokeKind::Inside);
        }
        let mut place = self.inner(rect);
        let edge = place.right();
        if self.goes_on[0] {
            // The sign that more columns follow stands at the edge.
            place.max.x = place.max.x.min(ui.clip_rect().right() - 3.0 * UNIT);
        }
        if let Some(sorting) = self.sorting.as_ref().filter(|sorting| sorting.column == column.name) {
            let arrow = Rect::from_min_size(place.min, Vec2::new(8.0, HEAD_LINE));
            let arrow =
                if layout.form == Form::Text { arrow.translate(Vec2::new(place.width() - 8.0, 0.0)) } else { arrow };
            self.arrow(ui, arrow.translate(Vec2::new(0.0, 0.5 * UNIT)), sorting.descending);
            if layout.form != Form::Text {
                place.min.x = arrow.right() + 0.5 * UNIT;
            }
        }
        if !self.of.compact {
            place.min.y += 0.5 * UNIT;
            ui.painter().hline(rect.x_range(), rect.bottom() - 0.5, Stroke::new(1.0, self.theme.line));
        }
        // A head without its numbers would be that of an empty column.
        let is_cut = layout.form != Form::Text && edge - layout.uncertainty > ui.clip_rect().right() + 1.0;
        let has_room = place.width() > 5.0 * UNIT && !is_cut;
        for (line, text) in [&column.name, &column.unit].into_iter().enumerate().filter(|_| has_room) {
            let at = egui::pos2(place.left(), place.top() + line as f32 * HEAD_LINE);
            let row = Rect::from_min_size(at, Vec2::new(place.width(), HEAD_LINE));
            let fits = lines::width(ui, text, TextStyle::Small) <= row.width();
            if layout.form == Form::Text || !fits {
                lines::elided(ui, row, text, TextStyle::Small, self.theme.weak);
            } else {
                lines::right_aligned(ui, row, text, TextStyle::Small, self.theme.weak);
            }
        }
        if response.clicked() {
            self.clicked_head = Some(index);
        }
        if !self.of.compact {
            response.on_hover_ui(|ui| {
                ui.strong(column.full_name());
                if !column.hint.is_empty() {
                    ui.label(&column.hint);
                }
                if !self.of.is_drawn(index) {
                    ui.small("Click to sort.");
                }
            });
        }
    }

    /// A row behind its cells; a click selects.
    fn row(&mut self, ui: &Ui, place: usize) {
        let Some(&row) = self.order.get(place) else { return };
        let rect = ui.max_rect();
        let sense = if self.of.compact && self.of.item.is_none() { Sense::hover() } else { Sense::CLICK };
        let response = ui.interact(rect, self.id.with(("row", row, self.frozen)), sense);
        if self.frozen || !self.sticks {
            response.widget_info(|| WidgetInfo::selected(Role::Row, true, self.is_selected(row), self.spoken(row)));
        }
        if sense == Sense::hover() {
            return;
        }
        self.ground(ui, rect, row, &response);
        if response.hovered() {
            self.hovered = Some(row);
        }
        if response.clicked() {
            self.output.clicked = Some(row);
        }
        if response.double_clicked() {
            self.output.activated = Some(row);
        }
    }

    fn cell(&self, ui: &Ui, row: usize, column: usize) {
        let (Some(&row), Some(&column)) = (self.order.get(row), self.shown.get(column)) else { return };
        let (layout, cell) = (self.layouts[column], self.of.table.cell(row, column));
        let whole = ui.max_rect();
        let rect = self.inner(whole);
        let edge = rect.right().min(ui.clip_rect().right());
        if let Some(drawn) = self.of.drawn.filter(|drawn| drawn.column == column) {
            return (drawn.draw)(ui.painter(), whole.shrink2(Vec2::new(UNIT, 2.0)), row);
        }
        let style = if self.of.compact { TextStyle::Small } else { TextStyle::Body };
        let ink = if cell.note().is_gray { self.theme.weak } else { self.theme.text };
        let said = self.said(row, column);
        let cut = match cell.value() {
            CellValue::Number(value) => {
                self.number(ui, rect, cell, value, column);
                false
            }
            CellValue::Text(_) if cell.note().swatch.is_some() => {
                let (left, right) = whole.shrink2(Vec2::new(UNIT, 1.0)).split_left_right_at_fraction(0.5);
                for (half, color) in [left, right].into_iter().zip(cell.note().swatch.unwrap_or_default()) {
                    ui.painter().rect_filled(half, 0.0, self.theme.ink(InkRole::Rgb(color).into()));
                }
                false
            }
            CellValue::Text(text) => lines::name(ui, rect.with_max_x(edge), text, style, ink),
            CellValue::Nothing if layout.form == Form::Text => lines::elided(ui, rect, "–", style, self.theme.weak),
            CellValue::Nothing => {
                let mut place = rect;
                place.max.x -= layout.uncertainty;
                lines::right_aligned(ui, place, "–", TextStyle::Monospace, self.theme.weak);
                false
            }
        };
        let response = ui.interact(whole, self.id.with(("cell", row, column)), Sense::hover());
        lines::labeled(&response, Role::Cell, &said);
        if !cell.hint().is_empty() {
            response.on_hover_text(cell.hint());
        } else if cut {
            response.on_hover_text(said);
        }
    }
}
