//! Numbers in aligned columns: patches and blackbodies as columns of one table.

use chromascope_core::colorimetry::{Lab, UvPrime, Xy, Xyz};
use chromascope_core::light::Cct;
use chromascope_core::query::{DifferenceError, LocusPoint, PatchColor, Temperatures};
use chromascope_core::units::Kelvin;
use chromascope_figure::{Cell, Column, Table};
use egui::{ScrollArea, Ui};

use super::{buttons, copy_text, reference_id};
use crate::panes::context::PaneContext;
use crate::panes::widgets::table::DataTable;
use crate::plot_item::{PlotItem, SensorId};
use crate::scene::{Scene, SceneError};
use crate::workspaces::PaneKind;

pub(super) struct Row {
    pub(super) name: &'static str,
    pub(super) decimals: usize,
    pub(super) cells: Vec<Option<f64>>,
}

/// Color of a patch or a blackbody through one sensor, under its head.
#[derive(Clone, Debug, Default)]
pub(super) struct Point {
    pub(super) head: String,
    pub(super) rgb: Option<[f64; 3]>,
    pub(super) lab: Option<Lab>,
    pub(super) xyz: Option<Xyz>,
    pub(super) xy: Option<Xy>,
    pub(super) uv: Option<UvPrime>,
    /// Difference from the reference by the document's metric.
    pub(super) difference: Option<f64>,
}

impl Point {
    pub(super) fn of_patch(head: impl Into<String>, color: Option<PatchColor>) -> Self {
        let point =
            color.map(|c| Self { rgb: c.rgb, lab: c.lab, xyz: Some(c.xyz), xy: c.xy, uv: c.uv, ..Self::default() });
        Self { head: head.into(), ..point.unwrap_or_default() }
    }

    pub(super) fn of_blackbody(head: impl Into<String>, point: Option<LocusPoint>) -> Self {
        let point = point.map(|p| Self { xyz: Some(p.xyz), xy: p.xy, uv: p.uv, ..Self::default() });
        Self { head: head.into(), ..point.unwrap_or_default() }
    }
}

pub(super) fn heads(points: &[Point]) -> Vec<String> {
    points.iter().map(|point| point.head.clone()).collect()
}

/// The rows that points have: difference, RGB, both diagrams, L*a*b*, CCT and Duv; rows that no point has are omitted.
pub(super) fn rows_of(scene: &Scene<'_>, points: &[Point]) -> Vec<Row> {
    let row = |name, decimals, take: &dyn Fn(&Point) -> Option<f64>| Row {
        name,
        decimals,
        cells: points.iter().map(take).collect(),
    };
    let mut rows = vec![
        row(scene.difference_name(), scene.document.difference.decimals, &|p| p.difference),
        row("R", 4, &|p| p.rgb.map(|rgb| rgb[0])),
        row("G", 4, &|p| p.rgb.map(|rgb| rgb[1])),
        row("B", 4, &|p| p.rgb.map(|rgb| rgb[2])),
        row("x", 4, &|p| p.xy.map(|xy| xy.x)),
        row("y", 4, &|p| p.xy.map(|xy| xy.y)),
        row("u′", 4, &|p| p.uv.map(|uv| uv.u)),
        row("v′", 4, &|p| p.uv.map(|uv| uv.v)),
        row("L*", 2, &|p| p.lab.map(|lab| lab.l)),
        row("a*", 2, &|p| p.lab.map(|lab| lab.a)),
        row("b*", 2, &|p| p.lab.map(|lab| lab.b)),
    ];
    rows.retain(|row| row.cells.iter().any(Option::is_some));
    rows.extend(temperatures(scene, points.iter().map(|point| point.xyz)));
    rows
}

/// Correlated color temperature in kelvins and Duv, for the CIE 1931 observer; none where it is undefined.
fn temperatures(scene: &Scene<'_>, colors: impl Iterator<Item = Option<Xyz>>) -> [Row; 2] {
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
    let mut table = table(heads, rows);
    table.columns[0] = Column::default();
    let shown = DataTable::new(PaneKind::INSPECTOR, id, &table);
    ScrollArea::horizontal().id_salt(id).auto_shrink([false, true]).show(ui, |ui| {
        shown.with_scrolling().show_compact(ui, context);
    });
}

pub(super) fn to_tsv(heads: &[String], rows: &[Row]) -> String {
    table(heads, rows).to_tsv()
}

fn table(heads: &[String], rows: &[Row]) -> Table {
    let decimals = rows.iter().map(|row| row.decimals).max();
    let heads = heads.iter().map(|head| Column { decimals, ..Column::from(head.as_str()) });
    let mut table = Table::new(std::iter::once(Column::from("quantity")).chain(heads));
    for row in rows {
        let cells = row.cells.iter().map(|cell| Cell::from(*cell).with(|note| note.decimals = Some(row.decimals)));
        table.push(std::iter::once(Cell::from(row.name)).chain(cells));
    }
    table
}

/// The table of a page, with the pinned items as columns A, B, …, and the page's buttons.
pub(super) fn points_table(ui: &mut Ui, mut points: Vec<Point>, page: &PlotItem, context: &mut PaneContext<'_>) {
    let scene = context.scene;
    points.extend(points_of(&scene, &context.view.pinned, Some(page)));
    let (heads, rows) = (heads(&points), rows_of(&scene, &points));
    show(ui, "points", &heads, &rows, context);
    if buttons(ui, context) {
        copy_text(ui, to_tsv(&heads, &rows), context);
    }
}

/// Columns of pinned items, lettered; the page's own is omitted.
pub(super) fn points_of(scene: &Scene<'_>, pinned: &[PlotItem], page: Option<&PlotItem>) -> Vec<Point> {
    let columns = pinned.iter().enumerate().filter(|(_, item)| Some(*item) != page);
    columns.filter_map(|(index, item)| Some(Point { head: letter(index), ..point_of(scene, item)? })).collect()
}

/// Color of an item with its difference from the reference; none of items that have no color.
pub(super) fn point_of(scene: &Scene<'_>, item: &PlotItem) -> Option<Point> {
    match item {
        PlotItem::Patch { source: Some(id), patch } => {
            let difference = difference_of(scene, id, patch).and_then(Result::ok);
            let difference = difference.filter(|_| *id != reference_id(scene));
            Some(Point { difference, ..Point::of_patch("", color_of(scene, id, patch).ok().flatten()) })
        }
        PlotItem::Radiator { source, kelvin } => {
            Some(Point::of_blackbody("", blackbody_of(scene, source, *kelvin).ok().flatten()))
        }
        PlotItem::Patch { source: None, .. } | PlotItem::Sensor(_) | PlotItem::Light | PlotItem::DataSet { .. } => None,
    }
}

pub(super) fn letter(index: usize) -> String {
    let letters = 'A'..='Z';
    letters.clone().nth(index).map_or_else(|| (index + 1).to_string(), String::from)
}

pub(super) fn index_of(scene: &Scene<'_>, patch: &str) -> Option<usize> {
    scene.patches().ok()?.patches().iter().position(|p| p.name == patch)
}

pub(super) fn color_of(scene: &Scene<'_>, id: &SensorId, patch: &str) -> Result<Option<PatchColor>, SceneError> {
    let colors = scene.patch_colors(id.kind, &id.name)?;
    Ok(index_of(scene, patch).and_then(|index| colors.get(index).copied()))
}

/// Difference of a patch through a sensor from the reference's, or why there is none.
pub(super) fn difference_of(scene: &Scene<'_>, id: &SensorId, patch: &str) -> Option<Result<f64, DifferenceError>> {
    scene.differences(id.kind, &id.name).ok()?.get(index_of(scene, patch)?).copied()
}

pub(super) fn blackbody_of(scene: &Scene<'_>, id: &SensorId, kelvin: f64) -> Result<Option<LocusPoint>, SceneError> {
    let temperatures = Temperatures::List(vec![Kelvin::new(kelvin)?]);
    Ok(scene.locus_at(id.kind, &id.name, temperatures)?.points.first().copied())
}
