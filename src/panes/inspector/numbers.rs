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

const CCT: &str = "CCT";
const DUV: &str = "Duv";

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

/// A column for each point, with the rows that points have: difference, RGB, both diagrams, L*a*b*; CCT in kelvins and Duv for the
/// CIE 1931 observer.
pub(super) fn table(scene: &Scene<'_>, points: &[Point]) -> Table {
    let ccts: Vec<Option<Cct>> = points.iter().map(|point| scene.temperature_of(point.xyz).ok()?.ok()).collect();
    let of = |take: &dyn Fn(&Point) -> Option<f64>| points.iter().map(take).collect::<Vec<_>>();
    let rows = [
        (scene.difference_name(), scene.document.difference.decimals, of(&|p| p.difference)),
        ("R", 4, of(&|p| p.rgb.map(|rgb| rgb[0]))),
        ("G", 4, of(&|p| p.rgb.map(|rgb| rgb[1]))),
        ("B", 4, of(&|p| p.rgb.map(|rgb| rgb[2]))),
        ("x", 4, of(&|p| p.xy.map(|xy| xy.x))),
        ("y", 4, of(&|p| p.xy.map(|xy| xy.y))),
        ("u′", 4, of(&|p| p.uv.map(|uv| uv.u))),
        ("v′", 4, of(&|p| p.uv.map(|uv| uv.v))),
        ("L*", 2, of(&|p| p.lab.map(|lab| lab.l))),
        ("a*", 2, of(&|p| p.lab.map(|lab| lab.a))),
        ("b*", 2, of(&|p| p.lab.map(|lab| lab.b))),
        (CCT, 0, ccts.iter().map(|cct| cct.map(|cct| cct.temperature.get())).collect()),
        (DUV, 4, ccts.iter().map(|cct| cct.map(|cct| cct.duv)).collect()),
    ];
    let is_shown = |(name, _, cells): &(&str, usize, Vec<Option<f64>>)| {
        [CCT, DUV].contains(name) || cells.iter().any(Option::is_some)
    };
    let rows: Vec<_> = rows.into_iter().filter(is_shown).collect();
    let decimals = rows.iter().map(|(_, decimals, _)| *decimals).max();
    let heads = points.iter().map(|point| Column { decimals, ..Column::from(point.head.as_str()) });
    let mut table = Table::new(std::iter::once(Column::from("quantity")).chain(heads));
    for (name, decimals, cells) in rows {
        let cells = cells.into_iter().map(|cell| Cell::from(cell).with(|note| note.decimals = Some(decimals)));
        table.push(std::iter::once(Cell::from(name)).chain(cells));
    }
    table
}

/// Writes a table of points; `id` distinguishes tables of one pane.
pub(super) fn show(ui: &mut Ui, id: &str, mut table: Table, context: &PaneContext<'_>) {
    table.columns[0] = Column::default();
    let shown = DataTable::new(PaneKind::INSPECTOR, id, &table);
    ScrollArea::horizontal().id_salt(id).auto_shrink([false, true]).show(ui, |ui| {
        shown.with_scrolling().show_compact(ui, context);
    });
}

/// The table of a page, with the pinned items as columns A, B, …, and the page's buttons.
pub(super) fn points_table(ui: &mut Ui, mut points: Vec<Point>, page: &PlotItem, context: &mut PaneContext<'_>) {
    let scene = context.scene;
    points.extend(points_of(&scene, &context.view.pinned, Some(page)));
    let table = table(&scene, &points);
    let text = table.to_tsv();
    show(ui, "points", table, context);
    if buttons(ui, context) {
        copy_text(ui, text, context);
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
