//! All tables of one camera model: the library's, recovered ones and the user's, with what they differ by.

use std::path::{MAIN_SEPARATOR, Path};

use chromascope_core::query::{CameraMetric, Shared};
use chromascope_figure::{Cell, Table};
use egui::{Rect, Ui};

use super::context::{Pane, PaneContext};
use crate::catalog::names::model_of;
use crate::document::SetKind;
use crate::document::imported::ImportedSet;
use crate::figures::metrics::{USUAL, figures};
use crate::format::{path_end, sentence};
use crate::panes::widgets;
use crate::panes::widgets::table::DataTable;
use crate::scene::metrics::{RankedCameras, Ranking};
use crate::scene::tables;
use crate::scene::uncertainty;
use crate::theme::UNIT;
use crate::workspaces::PaneKind;

pub const PANE: Pane = Pane::new(PaneKind::TABLES, "Tables", show).under_conditions();

fn show(ui: &mut Ui, rect: Rect, context: &mut PaneContext<'_>) {
    let body = widgets::body(ui, &PANE, rect, context, |ui, context| {
        let width = (ui.available_width() - UNIT).max(140.0);
        widgets::sets::camera(ui, width, context);
    });
    let Some(camera) = context.view.camera(&context.scene) else {
        return widgets::say(ui, body, "Add a camera.", context.theme.weak);
    };
    let names = context.scene.tables_of(&camera.name);
    let query = context.scene.model_tables(&names).map_err(|error| error.to_string());
    let made = query.and_then(|query| context.later.ask(PANE.kind, vec![query]).current());
    let rows = match &made {
        Ok(Some(made)) => made.as_ref().as_ref().map_err(ToString::to_string),
        Ok(None) => return,
        Err(why) => Err(why.clone()),
    };
    let rows = match rows {
        Ok(rows) => rows,
        Err(why) => return widgets::say(ui, body, sentence(&why), context.theme.error),
    };
    let ranked = context.states.of::<Ranking>().ask(context.later, &context.scene, RankedCameras::Library);
    let place = |name: &String| ranked.cameras.iter().position(|camera| camera.id.name == *name);
    let usual: Vec<CameraMetric> = USUAL.split(' ').filter_map(CameraMetric::by_id).collect();
    let mut table = uncertainty::table(("table", names.iter().map(String::as_str)), &usual, |row, metric| {
        let value = place(&names[row]).and_then(|at| figures(&ranked, at)?.of(metric));
        value.map_or(Cell::Empty, uncertainty::cell)
    });
    tables::insert(&mut table, rows);
    let heads = heads(&names, &context.scene.document.own);
    let open = heads.iter().zip(rows).filter(|(_, row)| !row.ends.is_empty());
    let open: Vec<String> = open.map(|(name, row)| format!("{name}: {}.", tables::ends(row))).collect();
    let alone = if names.len() > 1 { "" } else { "There is no other table of this model. " };
    let words = format!("{alone}{} {}", tables::COLUMNS, open.join(" "));
    let body = widgets::lines::foot(ui, body, &words, context);
    DataTable::new(PANE.kind, "Tables of the model", &turned(&table, &heads)).with_quantities().show(ui, body, context);
}

/// What distinguishes a table from others of its model.
fn distinct(name: &str) -> &str {
    let rest = name.strip_prefix(model_of(name)).map(|rest| rest.trim_matches([' ', '(', ')']));
    rest.filter(|rest| !rest.is_empty()).unwrap_or(name)
}

/// What distinguishes each table; files of one name are told apart by their folders.
fn heads(names: &[String], own: &[Shared<ImportedSet>]) -> Vec<String> {
    let is_camera = |set: &ImportedSet| SetKind::of_own(set) == SetKind::Camera;
    let path = |name: &String| own.iter().find(|set| set.name == *name && is_camera(set))?.path.as_deref();
    let paths: Vec<&Path> = names.iter().filter_map(path).collect();
    let head = |name: &String| {
        let end = path(name).map(|path| path_end(path, &paths));
        end.filter(|end| end.contains(MAIN_SEPARATOR)).unwrap_or_else(|| distinct(name).to_owned())
    };
    names.iter().map(head).collect()
}

/// The table with a row for each quantity, since a page is narrow; uncertainties are under the pointer. Ends are told in words.
fn turned(table: &Table, heads: &[String]) -> Table {
    let mut turned = Table::new(std::iter::once("quantity").chain(heads.iter().map(String::as_str)));
    turned.columns.iter_mut().for_each(|column| column.decimals = Some(0));
    for (at, column) in table.columns.iter().enumerate().skip(1).filter(|(_, column)| column.key != tables::ENDS) {
        let cell = |row: &Vec<Cell>| {
            row[at].clone().with(|note| {
                note.hint = note.behind().unwrap_or_default();
                (note.uncertainty, note.decimals) = (None, note.decimals.or(column.decimals));
            })
        };
        let head = Cell::from(column.full_name()).with(|note| note.hint.clone_from(&column.hint));
        turned.push(std::iter::once(head).chain(table.rows.iter().map(cell)));
    }
    turned
}
