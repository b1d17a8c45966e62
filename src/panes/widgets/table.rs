//! Table of every pane: aligned numbers with units in the header, sorted, filtered, linked with all panes.
//!
//! Visible rows and columns are laid out by `egui_table`, which keeps the header and the first column in place.

mod body;
mod columns;
mod order;

use std::collections::HashMap;

use body::Body;
use chromascope_figure::{Cell, Column, Table};
use columns::Layout;
use egui::{Align, Event, Id, Key, Modifiers, Rect, RichText, ScrollArea, TextEdit, Ui, UiBuilder, Vec2};

use crate::panes::context::PaneContext;
use crate::plot_item::{PlotItem, SensorId};
use crate::scene::Scene;
use crate::theme::{ROW, UNIT};
use crate::view::{Sorting, TableLook};
use crate::workspaces::PaneKind;

const LINE: f32 = 20.0;
/// Height of a row between other lines of text.
const COMPACT_LINE: f32 = 15.0;
const HEAD_LINE: f32 = 15.0;

pub struct DataTable<'a> {
    pane: PaneKind,
    id: &'a str,
    table: &'a Table,
    item: Option<&'a dyn Fn(usize) -> Option<PlotItem>>,
    first: Option<Sorting>,
    compact: bool,
    /// Rows are quantities of their own.
    ragged: bool,
    scrolls: bool,
    drawn: Option<Drawn<'a>>,
}

/// A column whose cells are pictures.
#[derive(Clone, Copy)]
pub struct Drawn<'a> {
    pub column: usize,
    pub width: f32,
    /// Draws the cell of a row in a rectangle.
    pub draw: &'a dyn Fn(&egui::Painter, Rect, usize),
}

/// User actions on a table in a frame; rows are counted in the given order.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct TableOutput {
    pub clicked: Option<usize>,
    /// Row that was clicked twice, or on which Enter was pressed.
    pub activated: Option<usize>,
}

impl<'a> DataTable<'a> {
    /// A table of a pane. `id` names its order and columns in what is saved between runs.
    pub fn new(pane: PaneKind, id: &'a str, table: &'a Table) -> Self {
        Self { pane, id, table, item: None, first: None, compact: false, ragged: false, scrolls: false, drawn: None }
    }

    /// Compact table that is as wide as its columns need, for a place that scrolls.
    #[must_use]
    pub fn with_scrolling(self) -> Self {
        Self { scrolls: true, ..self }
    }

    /// Table with the items of its rows.
    #[must_use]
    pub fn with_items(self, item: &'a dyn Fn(usize) -> Option<PlotItem>) -> Self {
        Self { item: Some(item), ..self }
    }

    /// Table whose rows are quantities of their own: their points do not line up.
    #[must_use]
    pub fn with_quantities(self) -> Self {
        Self { ragged: true, ..self }
    }

    #[must_use]
    pub fn with_drawn(self, drawn: Drawn<'a>) -> Self {
        Self { drawn: Some(drawn), ..self }
    }

    /// Table sorted by a column until the user sorts by another.
    #[must_use]
    pub fn sorted_by(self, sorting: Sorting) -> Self {
        Self { first: Some(sorting), ..self }
    }

    fn is_drawn(&self, column: usize) -> bool {
        self.drawn.is_some_and(|drawn| drawn.column == column)
    }

    /// Shows the table in a rectangle, below a bar with filter, columns and copying.
    pub fn show(&self, ui: &mut Ui, rect: Rect, context: &mut PaneContext<'_>) -> TableOutput {
        let mut look = context.view.saved.looks.remove(self.id).unwrap_or_default();
        look.sorting = look.sorting.or_else(|| self.first.clone());
        let shown = order::columns(&self.table.columns, &look);
        let mut order = order::rows(self.table, &look);
        let bar = Rect::from_min_size(rect.min, Vec2::new(rect.width(), ROW));
        let copy = self.bar(ui, bar, &mut look, order.len(), context);
        if look.filter.is_empty() && order.len() < self.table.rows.len() {
            order = order::rows(self.table, &look);
        }
        let below = rect.with_min_y(bar.bottom() + UNIT);
        let mut body = self.body(shown, order, &look, context);
        let scroll = self.keys(ui, &mut look, &mut body, context);
        if copy || self.copies(ui, context) {
            let written: Vec<usize> = body.shown.iter().copied().filter(|column| !self.is_drawn(*column)).collect();
            let table = self.copied(&written, &body.order, context);
            context.view.say(format!("{} rows copied.", table.rows.len()));
            ui.ctx().copy_text(table.to_tsv());
        }
        body.show(ui, below, scroll);
        let output = self.take_in(&body, &mut look, context);
        look.sorting.take_if(|sorting| self.first.as_ref() == Some(sorting));
        if look != TableLook::default() {
            context.view.saved.looks.insert(self.id.to_owned(), look);
        }
        output
    }

    /// Shows a few rows between other lines of text: without bar and scrolling, at their own height.
    pub fn show_compact(self, ui: &mut Ui, context: &PaneContext<'_>) -> TableOutput {
        let table = Self { compact: true, ragged: true, ..self };
        let shown = (0..table.table.columns.len()).collect();
        let order: Vec<usize> = (0..table.table.rows.len()).collect();
        let mut body = table.body(shown, order, &TableLook::default(), context);
        let height = body.head_height() + COMPACT_LINE * table.table.rows.len() as f32;
        let width = ui.available_width().max(if table.scrolls { body.least_width() } else { 0.0 });
        let (rect, _) = ui.allocate_exact_size(Vec2::new(width, height), egui::Sense::hover());
        body.show(ui, rect, None);
        body.output
    }

    fn body<'t>(
        &'t self,
        shown: Vec<usize>,
        order: Vec<usize>,
        look: &TableLook,
        context: &PaneContext<'_>,
    ) -> Body<'t> {
        let layouts = (0..self.table.columns.len()).map(|index| match self.drawn {
            _ if !shown.contains(&index) => Layout::HIDDEN,
            Some(drawn) if drawn.column == index => Layout { width: drawn.width, ..Layout::HIDDEN },
            _ => Layout::of(self.table, index, (self.compact, self.ragged)),
        });
        Body::new(self, layouts.collect(), shown, order, look, context)
    }

    /// Moves along the rows with the keyboard, if the pane has it and no control does. Returns the row to scroll to.
    fn keys(&self, ui: &Ui, look: &mut TableLook, body: &mut Body<'_>, context: &mut PaneContext<'_>) -> Option<usize> {
        let now = body.current(look);
        let followed = look.seen != context.view.selected;
        // A row that is still computed is followed until it is at its place.
        let column = look.sorting.as_ref().and_then(|by| self.table.columns.iter().position(|of| of.name == by.column));
        let is_placed =
            |now: usize| column.is_none_or(|column| *self.table.cell(body.order[now], column) != Cell::Empty);
        if followed && (now.is_some_and(is_placed) || context.view.selected.is_none()) {
            look.seen.clone_from(&context.view.selected);
        }
        let has_keys = context.view.focused == Some(self.pane)
            && ui.memory(|memory| memory.focused().is_none())
            && !egui::Popup::is_any_open(ui.ctx());
        let last = body.order.len().checked_sub(1);
        let (Some(last), true) = (last, has_keys) else { return now.filter(|_| followed) };
        let page = body.page(ui);
        let pressed = |key: Key| ui.input_mut(|input| input.consume_key(Modifiers::NONE, key));
        let next = [
            (Key::ArrowDown, now.map_or(0, |now| (now + 1).min(last))),
            (Key::ArrowUp, now.map_or(0, |now| now.saturating_sub(1))),
            (Key::PageDown, now.map_or(page, |now| now + page).min(last)),
            (Key::PageUp, now.map_or(0, |now| now.saturating_sub(page))),
            (Key::End, last),
        ];
        let next = next.into_iter().find_map(|(key, row)| pressed(key).then_some(row));
        if let Some(next) = next {
            let row = body.order[next];
            look.cursor = Some(row);
            if let Some(item) = self.item.and_then(|item| item(row)) {
                context.view.selected = Some(item);
                look.seen.clone_from(&context.view.selected);
            }
            body.follow(look, context);
        }
        if let Some(now) = now.filter(|_| pressed(Key::Enter)) {
            body.output.activated = Some(body.order[now]);
        }
        next.or(now.filter(|_| followed))
    }

    /// True if the pane has the keyboard, and its table is to be copied. The table is then what Ctrl+C means.
    fn copies(&self, ui: &Ui, context: &mut PaneContext<'_>) -> bool {
        if context.view.focused != Some(self.pane) || ui.ctx().text_edit_focused() {
            return false;
        }
        context.view.table_copies = true;
        ui.input(|input| input.events.contains(&Event::Copy))
    }

    /// Rows and columns as shown, in full precision, uncertainties in separate columns, with the conditions where numbers
    /// depend on them.
    fn copied(&self, shown: &[usize], order: &[usize], context: &PaneContext<'_>) -> Table {
        let mut table = self.table.part(shown, order);
        for place in 0..table.columns.len() {
            let uncertain = (0..order.len()).any(|row| table.cell(row, place).note().uncertainty.is_some());
            let column = &mut table.columns[place];
            column.key = column.full_name();
            column.uncertainty = if uncertain { format!("± {}", column.key) } else { String::new() };
        }
        if context.pane(self.pane).is_some_and(|pane| pane.under_conditions) {
            let mut conditions = context.scene.conditions();
            if matches!(self.pane, PaneKind::METRICS | PaneKind::HEAD_TO_HEAD) {
                let document = context.scene.document;
                conditions.extend(context.scene.metrics_constants(document.temperature_k));
            }
            return table.with_constants(conditions);
        }
        table
    }

    fn take_in(&self, body: &Body<'_>, look: &mut TableLook, context: &mut PaneContext<'_>) -> TableOutput {
        if let Some(column) = body.clicked_head.filter(|column| !self.is_drawn(*column)) {
            let column = &self.table.columns[column];
            look.sort_by(&column.name, column.largest_first);
        }
        let item = |row: Option<usize>| self.item.and_then(|item| item(row?));
        context.view.hover(item(body.hovered).as_ref());
        if let Some(row) = body.output.clicked {
            look.cursor = Some(row);
            if let Some(item) = item(Some(row)) {
                // A second click shortly after is a double click, not a change of mind.
                if body.output.activated.is_some() {
                    context.view.selected = Some(item);
                } else {
                    context.view.click(Some(&item));
                }
                look.seen.clone_from(&context.view.selected);
            }
        }
        body.output
    }
}

struct RowItems {
    sensor: Option<usize>,
    patch: Option<usize>,
    temperature: Option<usize>,
    /// Sensors by label; none for a label that several have.
    sensors: HashMap<String, Option<SensorId>>,
}

impl RowItems {
    fn of(scene: &Scene<'_>, table: &Table) -> Self {
        let mut sensors: HashMap<String, Option<SensorId>> = HashMap::new();
        for source in scene.sources() {
            let id = SensorId { kind: source.kind, name: source.name };
            sensors.entry(source.label).and_modify(|known| *known = None).or_insert(Some(id));
        }
        let [sensor, patch, temperature] = ["sensor", "patch", "temperature_k"].map(|key| table.place(key));
        Self { sensor, patch, temperature, sensors }
    }

    fn is_empty(&self) -> bool {
        self.sensor.is_none()
    }

    fn of_row(&self, row: &[Cell]) -> Option<PlotItem> {
        let cell = |column: Option<usize>| row.get(column?);
        let source = self.sensors.get(cell(self.sensor)?.text()?)?.clone()?;
        if let Some(patch) = cell(self.patch).and_then(Cell::text) {
            return Some(PlotItem::Patch { source: Some(source), patch: patch.to_owned() });
        }
        match cell(self.temperature).and_then(Cell::number) {
            Some(kelvin) => Some(PlotItem::Radiator { source, kelvin }),
            None => Some(PlotItem::Sensor(source)),
        }
    }
}

/// Shows the numbers of a figure, its rows linked by the columns of sensors, patches and temperatures.
pub fn show_numbers(ui: &mut Ui, rect: Rect, pane: PaneKind, table: &Table, context: &mut PaneContext<'_>) {
    let scene = context.scene;
    let items = RowItems::of(&scene, table);
    let item = |row: usize| items.of_row(&table.rows[row]);
    let id = context.title(pane);
    let shown = DataTable::new(pane, id, table);
    if items.is_empty() {
        shown.show(ui, rect, context)
    } else {
        shown.with_items(&item).show(ui, rect, context)
    };
}

/// Shows names with their descriptions, a line each, within other text.
pub fn show_pairs<N: AsRef<str>>(
    ui: &mut Ui,
    pane: PaneKind,
    id: &str,
    pairs: &[(N, String)],
    context: &PaneContext<'_>,
) {
    let mut table = Table::new(["", ""]);
    for (name, value) in pairs {
        table.push([name.as_ref(), value.as_str()].map(Cell::from));
    }
    DataTable::new(pane, id, &table).show_compact(ui, context);
}

/// A part of a pane's ui that is cut at its rectangle.
fn cut(ui: &mut Ui, id: Id, rect: Rect) -> Ui {
    let mut child = ui.new_child(UiBuilder::new().scope_id(id).max_rect(rect));
    child.set_clip_rect(rect.intersect(ui.clip_rect()));
    child
}

/// Maximum and minimum width of the filter, and the width of the controls beside it.
const FILTER: [f32; 2] = [132.0, 48.0];
const BESIDE: f32 = 192.0;
const MENU: f32 = 360.0;

impl DataTable<'_> {
    /// Shows the bar. Returns whether the rows are to be copied.
    fn bar(&self, ui: &mut Ui, rect: Rect, look: &mut TableLook, rows: usize, context: &mut PaneContext<'_>) -> bool {
        let mut child = cut(ui, ui.scope_id().with((self.id, "bar")), rect);
        child
            .with_layout(egui::Layout::left_to_right(Align::Center), |ui| {
                self.filter(ui, look, context);
                let all = self.table.rows.len();
                let words = if rows == all { format!("{all} rows") } else { format!("{rows} of {all}") };
                ui.label(RichText::new(words).small().color(context.theme.weak));
                if !look.filter.is_empty() && ui.button("Clear").on_hover_text("Show all rows").clicked() {
                    look.filter.clear();
                }
                ui.menu_button("Columns", |ui| menu(ui, &self.table.columns, look))
                    .response
                    .on_hover_text("Choose columns");
                let hint = "Copy rows and columns as shown, in full precision (Ctrl+C)";
                ui.button("Copy").on_hover_text(hint).clicked()
            })
            .inner
    }

    fn filter(&self, ui: &mut Ui, look: &mut TableLook, context: &mut PaneContext<'_>) {
        let id = ui.scope_id().with((self.id, "filter"));
        let edit = TextEdit::singleline(&mut look.filter)
            .id(id)
            .hint_text("Filter")
            .desired_width((ui.available_width() - BESIDE).clamp(FILTER[1], FILTER[0]));
        let response = ui.add(edit.align(egui::Align2::LEFT_CENTER).margin(egui::Margin::symmetric(4, 3)));
        super::lines::labeled(&response, egui::Role::TextInput, "Filter rows");
        if self.pane == PaneKind::LIBRARY && std::mem::take(&mut context.view.focus_search) {
            response.request_focus();
        }
        let escaped = response.lost_focus() && ui.input(|input| input.key_down(egui::Key::Escape));
        if escaped {
            look.filter.clear();
        }
        // Escape empties the filter, and nothing else.
        context.view.keeps_escape |= response.has_focus() || escaped;
        response.on_hover_text("Rows that contain all these words");
    }
}

/// A box for each column but the first, which stays.
fn menu(ui: &mut Ui, columns: &[Column], look: &mut TableLook) {
    ui.horizontal(|ui| {
        let mut all = |shown: bool| {
            look.columns = columns.iter().skip(1).map(|column| (column.name.clone(), shown)).collect();
        };
        if ui.button("All").clicked() {
            all(true);
        }
        if ui.button("None").clicked() {
            all(false);
        }
        if ui.button("As at first").clicked() {
            look.columns.clear();
        }
    });
    ScrollArea::vertical().max_height(MENU).show(ui, |ui| {
        let mut group = "";
        for column in columns.iter().skip(1) {
            if column.group != group {
                group = &column.group;
                ui.add_space(UNIT);
                ui.label(RichText::new(group).small().weak());
            }
            let mut shown = look.columns.get(&column.name).copied().unwrap_or(!column.starts_hidden);
            if ui.checkbox(&mut shown, column.full_name()).on_hover_text(&column.hint).changed() {
                look.columns.insert(column.name.clone(), shown);
            }
        }
    });
}
