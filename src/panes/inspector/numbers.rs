//! Numbers in aligned columns.

use chromascope_core::colorimetry::Xyz;
use chromascope_core::light::Cct;
use chromascope_core::query::PatchColor;
use chromascope_figure::{Cell, Table};
use egui::Ui;

use crate::panes::context::PaneContext;
use crate::panes::widgets::table::{CellNote, Column, DataTable};
use crate::scene::Scene;
use crate::workspaces::PaneKind;

/// A row: its name, its decimals, and a number for each column.
pub(super) struct Row {
    /// Name of the quantity.
    pub(super) name: &'static str,
    /// Number of decimals shown.
    pub(super) decimals: usize,
    /// The numbers; none where there is none.
    pub(super) cells: Vec<Option<f64>>,
}

/// The rows that patches have: RGB, both diagrams, L*a*b*.
pub(super) fn of_patches(scene: &Scene<'_>, colors: &[Option<PatchColor>]) -> Vec<Row> {
    let row = |name, decimals, take: &dyn Fn(&PatchColor) -> Option<f64>| Row {
        name,
        decimals,
        cells: colors.iter().map(|color| color.as_ref().and_then(take)).collect(),
    };
    let mut rows = vec![
        row("R", 4, &|c| c.rgb.map(|rgb| rgb[0])),
        row("G", 4, &|c| c.rgb.map(|rgb| rgb[1])),
        row("B", 4, &|c| c.rgb.map(|rgb| rgb[2])),
        row("x", 4, &|c| c.xy.map(|xy| xy.x)),
        row("y", 4, &|c| c.xy.map(|xy| xy.y)),
        row("u′", 4, &|c| c.uv.map(|uv| uv.u)),
        row("v′", 4, &|c| c.uv.map(|uv| uv.v)),
        row("L*", 2, &|c| c.lab.map(|lab| lab.l)),
        row("a*", 2, &|c| c.lab.map(|lab| lab.a)),
        row("b*", 2, &|c| c.lab.map(|lab| lab.b)),
    ];
    rows.extend(temperatures(scene, colors.iter().map(|color| color.map(|color| color.xyz))));
    rows
}

/// Correlated color temperature in kelvins and Duv, for the CIE 1931 observer; none where it is undefined.
pub(super) fn temperatures(scene: &Scene<'_>, colors: impl Iterator<Item = Option<Xyz>>) -> [Row; 2] {
    let found: Vec<Option<Cct>> = colors.map(|color| scene.temperature_of(color).ok()?.ok()).collect();
    let row = |name, decimals, take: fn(Cct) -> f64| Row {
        name,
        decimals,
        cells: found.iter().map(|cct| cct.map(take)).collect(),
    };
    [row("CCT", 0, |cct| cct.temperature.get()), row("Duv", 4, |cct| cct.duv)]
}

/// Writes rows below the columns' headers; `id` distinguishes tables of one pane.
pub(super) fn show(ui: &mut Ui, id: &str, heads: &[String], rows: &[Row], context: &PaneContext<'_>) {
    let table = table(heads, rows);
    let names = std::iter::once(Column::default());
    let columns = names.chain(heads.iter().map(|head| Column { name: head.clone(), ..Column::default() }));
    let note = |row: usize, _| CellNote { decimals: Some(rows[row].decimals), ..CellNote::default() };
    let shown = DataTable::new(PaneKind::INSPECTOR, id, &table).with_columns(columns.collect()).with_notes(&note);
    shown.show_compact(ui, context);
}

/// Rows for a spreadsheet, in full precision.
pub(super) fn to_tsv(heads: &[String], rows: &[Row]) -> String {
    table(heads, rows).to_tsv()
}

fn table(heads: &[String], rows: &[Row]) -> Table {
    let mut table = Table::new(std::iter::once("quantity").chain(heads.iter().map(String::as_str)));
    for row in rows {
        table.push(std::iter::once(Cell::from(row.name)).chain(row.cells.iter().map(|cell| Cell::from(*cell))));
    }
    table
}
