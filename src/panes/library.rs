//! All data sets as a table, the user's first: what each is, where it is from, and what it can be used as.

use chromascope_core::query::Shared;
use chromascope_figure::{Cell, InkRole, Table};
use egui::{Rect, Ui};

use super::context::{Pane, PaneContext};
use crate::catalog::{Entry, Place};
use crate::command::Command;
use crate::document::SetKind;
use crate::document::imported::ImportedSet;
use crate::figures::data_set;
use crate::paint;
use crate::panes::widgets;
use crate::panes::widgets::facts::{range, range_words};
use crate::panes::widgets::sets;
use crate::panes::widgets::table::{DataTable, Drawn};
use crate::plot_item::PlotItem;
use crate::scene::Scene;
use crate::view::import::ImportItem;
use crate::workspaces::{PaneKind, Workspace};

/// Width of a set's curves, the second column.
const CURVES: (usize, f32) = (1, 96.0);

pub const PANE: Pane = Pane::new(PaneKind::LIBRARY, "Library", show);

/// The rows, made anew when the user's sets change.
#[derive(Default)]
struct Rows {
    own: Vec<Shared<ImportedSet>>,
    entries: Vec<Entry>,
    table: Table,
    /// The item that the panes beside follow.
    followed: Option<PlotItem>,
}

impl Rows {
    fn refresh(&mut self, scene: &Scene<'_>) {
        let own = &scene.document.own;
        if !self.entries.is_empty() && self.own == *own {
            return;
        }
        self.own.clone_from(own);
        self.entries = own.iter().map(Entry::from_own).chain(scene.catalog.entries().iter().cloned()).collect();
        self.table = Table::new(["name", "curves", "kind", "range", "source"]);
        for entry in &self.entries {
            let source = match &entry.place {
                Place::Own(set) => format!("yours: {}", set.file),
                Place::BuiltIn { .. } => entry.header.as_ref().map_or_else(String::new, |header| header.source.clone()),
            };
            let range = range(scene, entry).map_or_else(String::new, |(range, _)| range_words(range));
            let name = if entry.is_own() { entry.name.clone() } else { entry.glossed_name() };
            let kind = entry.kind.label().to_owned();
            self.table.push([
                Cell::from(name),
                Cell::from(""),
                Cell::from(kind),
                Cell::from(range),
                Cell::from(source),
            ]);
        }
    }
}

fn item(entry: &Entry) -> PlotItem {
    PlotItem::of_set(entry.kind, &entry.name)
}

fn show(ui: &mut Ui, rect: Rect, context: &mut PaneContext<'_>) {
    let scene = context.scene;
    let mut rows = std::mem::take(context.states.of::<Rows>());
    rows.refresh(&scene);
    let of_file =
        |entry: &&Entry| entry.is_own() && context.view.import.selected == Some(ImportItem::Set(entry.name.clone()));
    let selected = rows.entries.iter().find(|entry| context.view.selected.as_ref() == Some(&item(entry)));
    let chosen = selected.or_else(|| rows.entries.iter().find(of_file)).cloned();
    let body = widgets::body(ui, &PANE, rect, context, |ui, context| {
        uses(ui, chosen.as_ref(), context);
    });
    let of_row = |row: usize| Some(item(rows.entries.get(row)?));
    let theme = context.theme;
    let draw = |painter: &egui::Painter, place: Rect, row: usize| {
        let size = [f64::from(place.width()), f64::from(place.height())];
        let Some(panel) = rows
            .entries
            .get(row)
            .and_then(|entry| data_set::sparkline(scene.results, entry, InkRole::Text, size).ok().flatten())
        else {
            return;
        };
        paint::still(painter, &panel, &theme, place);
    };
    let (column, width) = CURVES;
    let table = DataTable::new(PANE.kind, "Library", &rows.table).with_items(&of_row);
    let shown = table.with_drawn(Drawn { column, width, draw: &draw }).show(ui, body, context);
    if let Some(entry) = shown.activated.and_then(|row| rows.entries.get(row)) {
        use_or_leave(entry, context);
    }
    follow(&mut rows, context);
    *context.states.of::<Rows>() = rows;
}

/// Shows how the selected set was read, where it is the user's, else its source.
fn follow(rows: &mut Rows, context: &mut PaneContext<'_>) {
    if rows.followed == context.view.selected {
        return;
    }
    rows.followed.clone_from(&context.view.selected);
    let Some(entry) = rows.entries.iter().find(|entry| rows.followed.as_ref() == Some(&item(entry))) else { return };
    let pane = if entry.is_own() { PaneKind::INTERPRETATION } else { PaneKind::INSPECTOR };
    if entry.is_own() {
        context.view.import.select(ImportItem::Set(entry.name.clone()));
    }
    context.view.saved.layout.put(Workspace::Data, 2, pane);
}

/// Uses a set, or ends its use where that is possible.
fn use_or_leave(entry: &Entry, context: &mut PaneContext<'_>) {
    let on = context.scene.document.uses(entry.kind, &entry.name);
    sets::choose(entry, !on || !matches!(entry.kind, SetKind::Camera | SetKind::Observer | SetKind::Filter), context);
}

/// What can be done with the selected set.
fn uses(ui: &mut Ui, entry: Option<&Entry>, context: &mut PaneContext<'_>) {
    let Some(entry) = entry else {
        context.button(ui, "Open…", "Spectral files of any kind (Ctrl+O)", Command::Open);
        return widgets::note(ui, "Select a set to see its source and to use it.");
    };
    let used = context.scene.document.uses(entry.kind, &entry.name);
    let words = match entry.kind {
        SetKind::Camera | SetKind::Observer if used => "Remove from comparison".to_owned(),
        SetKind::Camera => "Use as camera".to_owned(),
        SetKind::Observer => "Compare".to_owned(),
        SetKind::Filter if used => "Remove filter".to_owned(),
        SetKind::Unsorted => "Choose its kind…".to_owned(),
        kind => kind.used_as().map_or_else(String::new, |used| format!("Use as {used}")),
    };
    let ends = matches!(entry.kind, SetKind::Camera | SetKind::Observer | SetKind::Filter);
    let is_reference = entry.kind == SetKind::Observer && entry.name == context.scene.document.reference;
    let button = ui.add_enabled((!used || ends) && !is_reference, egui::Button::new(words));
    if button.on_disabled_hover_text("In use").clicked() {
        use_or_leave(entry, context);
    }
    ui.menu_button("More", |ui| sets::menu(ui, entry, context));
}
