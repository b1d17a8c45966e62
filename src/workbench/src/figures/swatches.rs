//! Patches as colors: rows or charts, each swatch beside the reference's, with a bar for the difference.

mod board;

use chromascope_core::colorimetry::Metric;
use chromascope_core::query::PatchColor;
use chromascope_figure::{Anchor, Field, Figure, FigureRoom, Ink, InkRole, Panel, Rect, Table};

use self::board::Board;
use super::chromaticity::{conditions, id};
use super::kind::FigureKind;
use super::look::{FigureLook, SwatchLayout, SwatchStyle};
use crate::document::{SetKind, TransformChoice};
use crate::format::{fixed, number};
use crate::plot_item::{PickIndex, PlotItem};
use crate::scene::{ComparedSensor, Scene};

/// The swatches with the items of their marks.
#[derive(Clone, Debug)]
pub struct Built {
    pub panel: Panel,
    pub things: PickIndex,
    pub height: f64,
}

struct Row {
    source: ComparedSensor,
    /// Colors as they are drawn, where these are others.
    drawn: Vec<PatchColor>,
    /// Colors with their differences, or why there are none.
    colors: Result<Vec<(PatchColor, Option<f64>)>, String>,
}

impl Row {
    fn name(&self, is_short: bool) -> &str {
        match &self.source {
            source if source.is_reference => "Reference",
            source if is_short => &source.short,
            source => &source.label,
        }
    }

    /// The largest difference with its patch; of the reference none.
    fn worst<'a>(&self, names: &'a [String]) -> Option<(f64, &'a String)> {
        let named = self.colors.iter().flatten().zip(names);
        let differences = named.filter_map(|((_, difference), name)| Some(((*difference)?, name)));
        differences.max_by(|a, b| a.0.total_cmp(&b.0))
    }
}

/// True if patches are arranged in rows.
pub fn in_rows(layout: SwatchLayout, count: usize) -> bool {
    match layout {
        SwatchLayout::Auto => count <= 8,
        SwatchLayout::Rows => true,
        SwatchLayout::Charts => false,
    }
}

fn patch_names(scene: &Scene<'_>) -> Vec<String> {
    scene.patches().map(|set| set.patches().iter().map(|p| p.name.clone()).collect()).unwrap_or_default()
}

/// Builds the board for an area; it may want to be higher.
pub fn build(scene: &Scene<'_>, look: &FigureLook, size: [f64; 2]) -> Built {
    let rows = rows(scene);
    let mut board = Board::new(scene, look, patch_names(scene));
    let height = if in_rows(look.swatch_layout, board.names.len()) {
        board.rows(&rows, size)
    } else {
        board.charts(&rows, size)
    };
    let area = Rect::from_min_size([0.0, 0.0], [size[0], height.max(size[1])]);
    let mut panel = Panel::board("Swatches", area, Ink::new(InkRole::Surround));
    panel.marks = board.marks;
    Built { panel, things: board.things, height }
}

/// Length of a bar in words, and the factor on the colors' differences where there is one.
pub fn bar_scale(scene: &Scene<'_>) -> String {
    let scale = format!("bar: {} from 0 to {}", scene.difference_name(), number(scene.document.difference.full_scale));
    scene.document.exaggeration.note().map_or(scale.clone(), |note| format!("{note}; {scale}"))
}

/// A difference with the decimals of a number beside a bar.
fn short(metric: Metric, difference: f64) -> String {
    fixed(difference, metric.decimals.saturating_sub(1))
}

/// The visible sensors that can be shown with the reference.
fn rows(scene: &Scene<'_>) -> Vec<Row> {
    let compares = |source: &ComparedSensor| {
        source.is_reference || scene.document.transform != TransformChoice::Paper || {
            // By Paper a CIE observer is drawn directly; as a swatch it would be a difference that is none.
            !matches!(scene.comparable(source.kind, &source.name), Ok(Err(_)))
        }
    };
    let visible = scene.visible_sources().into_iter().filter(|source| compares(source));
    visible
        .map(|source| {
            let colors =
                scene.patch_colors(source.kind, &source.name).map_err(|error| error.to_string()).map(|colors| {
                    let differences = scene.differences(source.kind, &source.name).unwrap_or_default();
                    let of = |i: usize| differences.get(i).and_then(|d| d.ok()).filter(|_| !source.is_reference);
                    colors.into_iter().enumerate().map(|(i, color)| (color, of(i))).collect()
                });
            let drawn = scene.drawn_patch_colors(source.kind, &source.name).unwrap_or_default();
            Row { source, drawn, colors }
        })
        .collect()
}

/// The largest difference of all in words, with the patch through the sensor.
pub fn worst(scene: &Scene<'_>) -> Option<(String, PlotItem)> {
    let (rows, names) = (rows(scene), patch_names(scene));
    let worst = rows.iter().filter_map(|row| row.worst(&names).map(|(worst, name)| (worst, &row.source, name)));
    let (difference, source, patch) = worst.max_by(|a, b| a.0.total_cmp(&b.0))?;
    let number = short(scene.document.difference, difference);
    let compared = rows.iter().filter(|row| row.colors.iter().flatten().any(|(_, difference)| difference.is_some()));
    let count = compared.clone().count();
    let what = if compared.clone().all(|row| row.source.kind == SetKind::Camera) { "cameras" } else { "sensors" };
    let among = if count > 1 { format!("Worst of {count} {what}") } else { "Worst".to_owned() };
    let words = format!("{among}: {} {number}, {}, {patch}", scene.difference_name(), source.label);
    Some((words, PlotItem::Patch { source: Some(id(source)), patch: patch.clone() }))
}

/// The sensor that is off most and by how much, and how far the others are, in a sentence.
pub fn headline(scene: &Scene<'_>) -> Option<String> {
    let largest = |row: Row| {
        let all = row.colors.ok()?;
        Some((all.into_iter().filter_map(|(_, difference)| difference).reduce(f64::max)?, row.source.label))
    };
    let mut largest: Vec<(f64, String)> = rows(scene).into_iter().filter_map(largest).collect();
    largest.sort_by(|a, b| b.0.total_cmp(&a.0));
    let ((most, name), others) = largest.split_first()?;
    let number = |difference: f64| short(scene.document.difference, difference);
    let others = match others {
        [] => String::new(),
        [(most, name)] => format!(", {name} by up to {}", number(*most)),
        [(most, _), ..] => {
            let count = ["two", "three", "four", "five", "six", "seven", "eight", "nine"].get(others.len() - 2);
            let count = count.map_or_else(|| others.len().to_string(), |word| (*word).to_owned());
            format!(", {count} others by up to {}", number(*most))
        }
    };
    let (measure, light) = (scene.difference_name(), scene.light_name());
    Some(format!("{name} is off by up to {measure} {} under {light}{others}", number(*most)))
}

const SIZE: [f64; 2] = [700.0, 300.0];
/// Width below which a figure is higher than its proportions.
const NARROW: f64 = 500.0;
/// Height of the line below it that says how long bars are.
const KEY: f64 = 18.0;

pub static KIND: FigureKind = FigureKind::new("swatches", "Patches as each sensor renders them", figure).in_report();

/// The figure as it is saved (in rows with the five patches, the paper's Figure 5), with all numbers.
#[allow(clippy::unnecessary_wraps, reason = "other kinds of figures can have nothing to draw")]
fn figure(scene: &Scene<'_>, look: &FigureLook, room: FigureRoom) -> Option<Figure> {
    let [width, height] = room.size(SIZE, KEY);
    // On a narrow page charts stand below each other.
    let least = if room.height.is_none() && width < NARROW { 0.8 * width } else { 0.0 };
    Some(figure_sized(scene, look, [width, height.max(least)]))
}

/// The figure in a width, and at least a height, in points.
pub fn figure_sized(scene: &Scene<'_>, look: &FigureLook, size: [f64; 2]) -> Figure {
    let built = build(scene, &FigureLook { blink: false, ..look.clone() }, size);
    let mut figure = Figure::new("Swatches", [size[0], built.height.max(120.0) + KEY]);
    let area = Rect::from_min_size([0.0, 0.0], figure.size);
    let mut panel = Panel { marks: built.panel.marks, ..Panel::board("Swatches", area, built.panel.background) };
    if !look.without_bars || scene.document.exaggeration.note().is_some() {
        let at = [size[0] - 6.0, figure.size[1] - 0.5 * KEY - 2.0];
        panel.marks.push(board::small(&bar_scale(scene), at, Anchor::RIGHT));
    }
    figure.panels.push(panel);
    let how = match look.swatch_style {
        SwatchStyle::Split => "Left half: reference; right half: sensor.",
        SwatchStyle::Inset => "Inside: reference; outside: sensor.",
        SwatchStyle::Whole => "",
    };
    let heads =
        if in_rows(look.swatch_layout, patch_names(scene).len()) { "" } else { " Beside names: the worst patch." };
    let worst = worst(scene).map_or_else(String::new, |(words, _)| format!("{words}. "));
    let bars = if look.without_bars { String::new() } else { format!(" Bars: {}.", scene.difference_name()) };
    let exaggerated = scene.document.exaggeration.sentence();
    let is_clipped =
        rows(scene).iter().flat_map(|row| row.colors.iter().flatten()).any(|(color, _)| color.srgb.clipped);
    let clipped = match (is_clipped, exaggerated.is_empty()) {
        (_, false) => " Notched or hatched: clipped.",
        (true, true) => " Notched corners: clipped.",
        (false, true) => "",
    };
    figure.caption = format!("{how}{bars}{heads}{exaggerated}{clipped} {worst}{}", conditions(scene));
    figure.table = table(scene);
    figure
}

/// A patch through a sensor: label, name, color, and difference from the reference by a metric.
type Swatch = (String, String, PatchColor, Option<f64>, &'static str);

const COLUMNS: [Field<Swatch>; 19] = [
    Field::new("sensor", |(sensor, ..)| sensor.as_str().into()),
    Field::new("patch", |(_, patch, ..)| patch.as_str().into()),
    Field::new("r", |(.., color, _, _)| color.rgb.map(|rgb| rgb[0]).into()),
    Field::new("g", |(.., color, _, _)| color.rgb.map(|rgb| rgb[1]).into()),
    Field::new("b", |(.., color, _, _)| color.rgb.map(|rgb| rgb[2]).into()),
    Field::new("X", |(.., color, _, _)| color.xyz.x.into()),
    Field::new("Y", |(.., color, _, _)| color.xyz.y.into()),
    Field::new("Z", |(.., color, _, _)| color.xyz.z.into()),
    Field::new("x", |(.., color, _, _)| color.xy.map(|xy| xy.x).into()),
    Field::new("y", |(.., color, _, _)| color.xy.map(|xy| xy.y).into()),
    Field::new("L*", |(.., color, _, _)| color.lab.map(|lab| lab.l).into()),
    Field::new("a*", |(.., color, _, _)| color.lab.map(|lab| lab.a).into()),
    Field::new("b*", |(.., color, _, _)| color.lab.map(|lab| lab.b).into()),
    Field::new("srgb_r", |(.., color, _, _)| f64::from(color.srgb.bytes[0]).into()),
    Field::new("srgb_g", |(.., color, _, _)| f64::from(color.srgb.bytes[1]).into()),
    Field::new("srgb_b", |(.., color, _, _)| f64::from(color.srgb.bytes[2]).into()),
    Field::new("clipped", |(.., color, _, _)| if color.srgb.clipped { "yes" } else { "no" }.into()),
    Field::new("difference", |(.., difference, _)| (*difference).into()),
    Field::new("measure", |(.., difference, measure)| if difference.is_some() { measure } else { "" }.into()),
];

fn table(scene: &Scene<'_>) -> Table {
    let (names, measure) = (patch_names(scene), scene.difference_name());
    let swatches = rows(scene).into_iter().flat_map(|row| {
        let colors = row.colors.into_iter().flatten().zip(&names);
        let swatch = |((color, difference), name): (_, &String)| {
            (row.source.label.clone(), name.clone(), color, difference, measure)
        };
        colors.map(swatch).collect::<Vec<Swatch>>()
    });
    Table::of(&COLUMNS, swatches)
}
