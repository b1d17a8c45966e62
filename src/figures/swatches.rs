//! Patches as colors: rows or charts, each swatch beside the reference's, with a bar for the difference.

use chromascope_core::query::PatchColor;
use chromascope_figure::{Anchor, Cell, Figure, Ink, InkRole, Mark, Panel, Rect, Shape, Table, TextSize, text_width};

use super::chromaticity::{caption, id};
use crate::document::{SetKind, TransformChoice};
use crate::plot_item::{PickIndex, PlotItem};
use crate::scene::{ComparedSensor, Scene};
use crate::view::{SwatchLayout, SwatchStyle, View};

/// The swatches with the items of their marks.
#[derive(Clone, Debug)]
pub struct Built {
    /// The panel, in points.
    pub panel: Panel,
    /// Items of the marks.
    pub things: PickIndex,
    /// Natural height.
    pub height: f64,
    /// The largest difference with its sensor label and patch.
    pub worst: Option<(String, PlotItem)>,
}

/// One sensor's colors.
struct Row {
    source: ComparedSensor,
    /// Colors with their differences, or why there are none.
    colors: Result<Vec<(PatchColor, Option<f64>)>, String>,
}

/// Layout of the swatches.
struct Board<'a> {
    scene: &'a Scene<'a>,
    view: &'a View,
    names: Vec<String>,
    reference: Vec<PatchColor>,
    marks: Vec<Mark>,
    things: PickIndex,
}

const GAP: f64 = 4.0;
const MARGIN: f64 = 6.0;
/// The height of the bar of a difference.
const BAR: f64 = 3.0;
/// The least height of a row.
const LEAST_ROW: f64 = 22.0;

/// True if patches are arranged in rows.
pub fn in_rows(layout: SwatchLayout, count: usize) -> bool {
    match layout {
        SwatchLayout::Auto => count <= 8,
        SwatchLayout::Rows => true,
        SwatchLayout::Charts => false,
    }
}

/// Builds the board for an area; it may want to be higher.
pub fn build(scene: &Scene<'_>, view: &View, size: [f64; 2]) -> Built {
    let names: Vec<String> =
        scene.patches().map(|set| set.patches().iter().map(|p| p.name.clone()).collect()).unwrap_or_default();
    let reference = scene.patch_colors(SetKind::Observer, &scene.document.reference).unwrap_or_default();
    let rows = rows(scene);
    let worst = worst(&rows, &names);
    let mut board = Board { scene, view, names, reference, marks: Vec::new(), things: PickIndex::default() };
    let height = if in_rows(view.saved.swatch_layout, board.names.len()) {
        board.rows(&rows, size)
    } else {
        board.charts(&rows, size)
    };
    let area = Rect::from_min_size([0.0, 0.0], [size[0], height.max(size[1])]);
    let mut panel = Panel::board("Swatches", area, Ink::new(InkRole::Surround));
    panel.marks = board.marks;
    Built { panel, things: board.things, height, worst }
}

/// The visible sensors that can be shown with the reference.
fn rows(scene: &Scene<'_>) -> Vec<Row> {
    let compares = |source: &ComparedSensor| {
        source.is_reference || scene.document.transform != TransformChoice::Paper || {
            // By Paper a CIE observer is drawn directly; as a swatch it would be a difference that is none.
            !matches!(scene.comparable(source.kind, &source.name), Ok(Err(_)))
        }
    };
    let visible = scene.sources().into_iter().filter(|source| source.visible && compares(source));
    visible
        .map(|source| {
            let colors =
                scene.patch_colors(source.kind, &source.name).map_err(|error| error.to_string()).map(|colors| {
                    let differences = scene.differences(source.kind, &source.name).unwrap_or_default();
                    let of = |i: usize| differences.get(i).and_then(|d| d.ok()).filter(|_| !source.is_reference);
                    colors.into_iter().enumerate().map(|(i, color)| (color, of(i))).collect()
                });
            Row { source, colors }
        })
        .collect()
}

/// The largest difference of all.
fn worst(rows: &[Row], names: &[String]) -> Option<(String, PlotItem)> {
    let mut worst: Option<(f64, String, PlotItem)> = None;
    for row in rows {
        for ((_, difference), name) in row.colors.iter().flatten().zip(names) {
            if let Some(d) = difference.filter(|d| worst.as_ref().is_none_or(|w| *d > w.0)) {
                let thing = PlotItem::Patch { source: Some(id(&row.source)), patch: name.clone() };
                worst = Some((d, format!("Worst: {}, {name}", row.source.label), thing));
            }
        }
    }
    worst.map(|(_, words, thing)| (words, thing))
}

impl Board<'_> {
    /// A row for each sensor, a column for each patch. Returns the height.
    fn rows(&mut self, rows: &[Row], size: [f64; 2]) -> f64 {
        let widest = rows.iter().map(|row| text_width(&row.source.label, TextSize::Body)).fold(40.0, f64::max);
        let head = (widest + 30.0).min(0.3 * size[0]);
        let top = MARGIN + 17.0;
        let count = self.names.len().max(1) as f64;
        let width = ((size[0] - 2.0 * MARGIN - head) / count - GAP).max(6.0);
        let available = (size[1] - top - MARGIN) / rows.len().max(1) as f64;
        let pitch = available.clamp(LEAST_ROW, 64.0);
        if width > 40.0 {
            for (column, name) in self.names.clone().into_iter().enumerate() {
                let x = MARGIN + head + column as f64 * (width + GAP) + width / 2.0;
                let tag = self.things.tag(PlotItem::Patch { source: None, patch: name.clone() });
                self.text(tag, &elided(&name, width), [x, MARGIN + 8.0], Anchor::CENTER);
            }
        }
        for (index, row) in rows.iter().enumerate() {
            let y = top + index as f64 * pitch;
            self.row_head(&row.source, [MARGIN, y + (pitch - GAP) / 2.0], head);
            match &row.colors {
                Err(why) => self.text(PickIndex::NONE, why, [MARGIN + head, y + pitch / 2.0], Anchor::LEFT),
                Ok(colors) => {
                    for (column, (color, difference)) in colors.iter().enumerate() {
                        let x = MARGIN + head + column as f64 * (width + GAP);
                        let area = [[x, y], [x + width, y + pitch - GAP]];
                        self.swatch(&row.source, column, color, *difference, area);
                    }
                }
            }
        }
        top + rows.len() as f64 * pitch + MARGIN
    }

    /// A chart for each sensor, wrapping to the width. Returns the height.
    fn charts(&mut self, rows: &[Row], size: [f64; 2]) -> f64 {
        let columns = chart_columns(self.names.len());
        let lines = self.names.len().div_ceil(columns).max(1);
        let (across, cell) = chart_cell(rows.len(), columns, lines, size);
        let chart = [columns as f64 * (cell[0] + GAP / 2.0), lines as f64 * (cell[1] + GAP / 2.0) + 24.0];
        for (index, row) in rows.iter().enumerate() {
            let x = MARGIN + (index % across) as f64 * (chart[0] + 2.0 * MARGIN);
            let y = MARGIN + (index / across) as f64 * (chart[1] + MARGIN);
            self.row_head(&row.source, [x, y + 8.0], chart[0] + MARGIN);
            match &row.colors {
                Err(why) => self.text(PickIndex::NONE, why, [x, y + 32.0], Anchor::LEFT),
                Ok(colors) => {
                    for (i, (color, difference)) in colors.iter().enumerate() {
                        let left = x + (i % columns) as f64 * (cell[0] + GAP / 2.0);
                        let up = y + 22.0 + (i / columns) as f64 * (cell[1] + GAP / 2.0);
                        let area = [[left, up], [left + cell[0], up + cell[1]]];
                        self.swatch(&row.source, i, color, *difference, area);
                    }
                }
            }
        }
        MARGIN + rows.len().div_ceil(across) as f64 * (chart[1] + MARGIN)
    }

    /// A sensor's marker and label, no wider than there is room.
    fn row_head(&mut self, source: &ComparedSensor, at: [f64; 2], width: f64) {
        let tag = self.things.tag(PlotItem::Sensor(id(source)));
        let shape = Shape::Points { points: vec![[at[0] + 7.0, at[1]]], marker: source.marker, radius: 5.0 };
        let mark = Mark::new(tag, source.label.clone(), shape).with_stroke(InkRole::OnSurround, 1.5);
        let filled = source.marker.has_inside();
        self.marks.push(if filled { mark.with_fill(InkRole::OnSurround) } else { mark });
        let label = if source.is_reference { "Reference" } else { &source.label };
        self.text(tag, &elided(label, width - 18.0), [at[0] + 18.0, at[1]], Anchor::LEFT);
    }

    /// One swatch: the reference's part, the sensor's, the bar, the notch.
    fn swatch(
        &mut self,
        source: &ComparedSensor,
        index: usize,
        color: &PatchColor,
        difference: Option<f64>,
        area: [[f64; 2]; 2],
    ) {
        let [[x0, y0], [x1, y1]] = area;
        let name = self.names.get(index).cloned().unwrap_or_default();
        let tag = self.things.tag(PlotItem::Patch { source: Some(id(source)), patch: name.clone() });
        let bars = self.view.saved.difference_bars && y1 - y0 > 3.0 * BAR;
        let bottom = if bars { y1 - BAR - 1.0 } else { y1 };
        let reference = self.reference.get(index).copied();
        let shown = if self.view.blink { reference.unwrap_or(*color) } else { *color };
        let title = format!("{} {name}", source.label);
        self.area(tag, &title, [[x0, y0], [x1, bottom]], &shown);
        if let Some(reference) = reference.filter(|_| !source.is_reference && !self.view.blink) {
            let (w, h) = (x1 - x0, bottom - y0);
            match self.view.saved.swatch_style {
                SwatchStyle::Split => self.area(tag, "reference", [[x0, y0], [x0 + w / 2.0, bottom]], &reference),
                SwatchStyle::Inset => {
                    let inner = [[x0 + w * 0.3, y0 + h * 0.25], [x1 - w * 0.3, bottom - h * 0.25]];
                    self.area(tag, "reference", inner, &reference);
                }
                SwatchStyle::Whole => {}
            }
        }
        if shown.srgb.clipped {
            let notch = (0.3 * (bottom - y0)).min(9.0);
            let points = vec![[x1 - notch, y0], [x1, y0], [x1, y0 + notch]];
            let mark = Mark::new(tag, "clipped", Shape::Polygon { points });
            self.marks.push(mark.with_fill(InkRole::Surround));
        }
        if let Some(difference) = difference.filter(|_| bars) {
            let share = (difference / self.scene.document.difference.full_scale).clamp(0.0, 1.0);
            let bar = Shape::Rect { min: [x0, y1 - BAR], max: [x0 + share * (x1 - x0), y1] };
            self.marks.push(Mark::new(tag, "difference", bar).with_fill(InkRole::OnSurround));
        }
    }

    fn area(&mut self, tag: chromascope_figure::Tag, name: &str, [min, max]: [[f64; 2]; 2], color: &PatchColor) {
        let mark = Mark::new(tag, name, Shape::Rect { min, max });
        self.marks.push(mark.with_fill(Ink::rgb(color.srgb.bytes)));
    }

    fn text(&mut self, tag: chromascope_figure::Tag, text: &str, at: [f64; 2], anchor: Anchor) {
        let ink = Ink::new(InkRole::OnSurround);
        let shape = Shape::Text { at, text: text.to_owned(), anchor, offset: [0.0, 0.0], size: TextSize::Body, ink };
        self.marks.push(Mark::new(tag, text, shape));
    }
}

/// A label cut to the available width; the pointer shows it in full.
fn elided(label: &str, width: f64) -> String {
    if text_width(label, TextSize::Body) <= width {
        return label.to_owned();
    }
    let mut short: String = label.to_owned();
    while short.pop().is_some() {
        let shown = format!("{}…", short.trim_end());
        if text_width(&shown, TextSize::Body) <= width {
            return shown;
        }
    }
    String::new()
}

/// Six for a ColorChecker, else about half again as wide as high.
fn chart_columns(count: usize) -> usize {
    if count == 24 { 6 } else { ((count as f64 * 1.5).sqrt().ceil() as usize).max(1) }
}

/// Number of charts side by side, and the size of a swatch: the largest that fits, else the least.
fn chart_cell(charts: usize, columns: usize, lines: usize, size: [f64; 2]) -> (usize, [f64; 2]) {
    let mut best = (1, [0.0_f64, 0.0_f64]);
    for across in 1..=charts.max(1) {
        let down = charts.div_ceil(across).max(1);
        let width = (size[0] - MARGIN * (2.0 * across as f64)) / across as f64 / columns as f64 - GAP / 2.0;
        let height = ((size[1] - MARGIN * (1.0 + down as f64)) / down as f64 - 24.0) / lines as f64 - GAP / 2.0;
        let cell = [width.min(height * 1.6).min(56.0), height.min(width).min(42.0)];
        if cell[0].min(cell[1]) > best.1[0].min(best.1[1]) {
            best = (across, cell);
        }
    }
    let least = if columns * lines > 60 { 8.0 } else { 18.0 };
    if best.1[0].min(best.1[1]) >= least {
        return best;
    }
    // They do not fit: they scroll.
    let across = ((size[0] / (columns as f64 * (least + GAP / 2.0) + 2.0 * MARGIN)) as usize).clamp(1, charts.max(1));
    (across, [least, least])
}

/// The size of a saved figure in points.
const SIZE: [f64; 2] = [700.0, 300.0];

/// The figure as it is saved (in rows with the five patches, the paper's Figure 5), with all numbers.
pub fn figure(scene: &Scene<'_>, view: &View) -> Figure {
    figure_sized(scene, view, SIZE)
}

/// The figure in a width, and at least a height, in points.
pub fn figure_sized(scene: &Scene<'_>, view: &View, size: [f64; 2]) -> Figure {
    let paper = View { saved: view.saved.clone(), ..View::default() };
    let built = build(scene, &paper, size);
    let mut figure = Figure::new("Swatches", [size[0], built.height.max(120.0)]);
    let mut panel = built.panel;
    panel.area = Rect::from_min_size([0.0, 0.0], figure.size);
    figure.panels.push(Panel { marks: panel.marks, ..Panel::board("Swatches", panel.area, panel.background) });
    let how = match view.saved.swatch_style {
        SwatchStyle::Split => "Left half: reference; right half: sensor.",
        SwatchStyle::Inset => "Inside: reference; outside: sensor.",
        SwatchStyle::Whole => "",
    };
    let symbol = scene.difference_name();
    let full = scene.document.difference.full_scale;
    figure.caption = format!("{how} Bars: {symbol}, full at {full}. Notched corners: clipped. {}", caption(scene));
    figure.table = table(scene);
    figure
}

fn table(scene: &Scene<'_>) -> Table {
    let columns = "sensor patch r g b X Y Z x y L* a* b* srgb_r srgb_g srgb_b clipped difference measure";
    let mut table = Table::new(columns.split(' '));
    let names: Vec<String> =
        scene.patches().map(|set| set.patches().iter().map(|p| p.name.clone()).collect()).unwrap_or_default();
    let measure = scene.difference_name();
    for row in rows(scene) {
        for ((color, difference), name) in row.colors.iter().flatten().zip(&names) {
            let part = |i: usize| Cell::from(color.rgb.map(|rgb| rgb[i]));
            let [sr, sg, sb] = color.srgb.bytes.map(|v| Cell::from(f64::from(v)));
            table.push([
                Cell::from(row.source.label.as_str()),
                Cell::from(name.as_str()),
                part(0),
                part(1),
                part(2),
                Cell::from(color.xyz.x),
                Cell::from(color.xyz.y),
                Cell::from(color.xyz.z),
                Cell::from(color.xy.map(|p| p.x)),
                Cell::from(color.xy.map(|p| p.y)),
                Cell::from(color.lab.map(|lab| lab.l)),
                Cell::from(color.lab.map(|lab| lab.a)),
                Cell::from(color.lab.map(|lab| lab.b)),
                sr,
                sg,
                sb,
                Cell::from(if color.srgb.clipped { "yes" } else { "no" }),
                Cell::from(*difference),
                Cell::from(if difference.is_some() { measure } else { "" }),
            ]);
        }
    }
    table
}
