//! Arrangement of swatches in rows or charts.

use chromascope_core::query::PatchColor;
use chromascope_figure::{Anchor, Ink, InkRole, Mark, Rect, Shape, Tag, TextSize, clip_segment, text_width, wrapped};

use super::{NARROW, Row, short};
use crate::document::{Exaggeration, SetKind};
use crate::figures::chromaticity::{id, sign};
use crate::figures::filled;
use crate::figures::look::{FigureLook, SwatchStyle};
use crate::format::cut_in_middle;
use crate::plot_item::{PickIndex, PlotItem};
use crate::scene::{ComparedSensor, Scene};

const GAP: f64 = 4.0;
const MARGIN: f64 = 6.0;
/// The height of the bar of a difference.
const BAR: f64 = 3.0;
/// The height of a difference's number.
const NUMBER: f64 = 11.0;
/// Space between a number and the bar of the next swatch.
const APART: f64 = 3.0;
/// The width from which on a number stands beside its bar, in points.
const BESIDE: f64 = 52.0;
/// The least height of a swatch in a row.
const LEAST_ROW: f64 = 16.0;
/// The least height of colors above a number in a chart.
const LEAST_COLOR: f64 = 12.0;
/// The least width of a swatch with its number above the bar in a chart.
const LEAST_ABOVE: f64 = 18.0;
/// The least length of a bar beside its number in a chart.
const LEAST_TRACK: f64 = 8.0;
/// Number of charts above which narrow ones have bars without numbers, which their heads and the table tell.
const CROWDED: usize = 4;
/// Share of the bar from which on a chart has a difference's number: others are read by pointing at them.
const NUMBERED: f64 = 0.4;
/// Distance of the lines over colors that a screen cannot show.
const HATCH: f64 = 5.0;
/// The height of a chart's head.
const HEAD: f64 = 20.0;
/// Room of the marker before a name, and least space between a name and what stands behind it.
const KEY: f64 = 18.0;
const AIR: f64 = 6.0;
/// The least width of a column with a name.
const LEAST_COLUMN: f64 = 68.0;

pub(super) struct Board<'a> {
    scene: &'a Scene<'a>,
    look: &'a FigureLook,
    pub(super) names: Vec<String>,
    reference: Vec<PatchColor>,
    pub(super) marks: Vec<Mark>,
    pub(super) things: PickIndex,
    /// Width of the widest number beside a bar in a chart, with the space before it.
    widest: f64,
}

/// Difference of a swatch as it is drawn below the colors.
#[derive(Clone, Copy, PartialEq)]
enum Note {
    None,
    Bar,
    /// The number, and the bar below.
    Above,
    /// The number at the right of the bar.
    Beside,
    /// The same in a chart, where colors come first.
    Close,
}

impl Note {
    fn height(self) -> f64 {
        match self {
            Self::None => 0.0,
            Self::Bar => BAR + 1.0,
            Self::Above => NUMBER + BAR + 1.0,
            Self::Beside => NUMBER + 2.0,
            Self::Close => NUMBER,
        }
    }
}

impl<'a> Board<'a> {
    pub(super) fn new(scene: &'a Scene<'a>, look: &'a FigureLook, names: Vec<String>) -> Self {
        let reference = scene.patch_colors(SetKind::Observer, &scene.document.reference).unwrap_or_default();
        Self { scene, look, names, reference, marks: Vec::new(), things: PickIndex::default(), widest: 0.0 }
    }

    /// What fits below a swatch of a width.
    fn note(&self, rows: &[&Row], width: f64) -> Note {
        if self.look.without_bars {
            return Note::None;
        }
        let widest = self.widest_number(rows);
        match width {
            width if width >= BESIDE.max(widest + 24.0) => Note::Beside,
            width if width >= widest => Note::Above,
            _ => Note::Bar,
        }
    }

    fn widest_number(&self, rows: &[&Row]) -> f64 {
        let metric = self.scene.document.difference;
        let numbers = rows.iter().flat_map(|row| row.colors.iter().flatten()).filter_map(|(_, difference)| *difference);
        numbers.map(|d| text_width(&short(metric, d), TextSize::Small)).fold(0.0, f64::max)
    }

    /// A row for each sensor, a column for each patch, in as many blocks as the columns need. Returns the height.
    pub(super) fn rows(&mut self, rows: &[Row], size: [f64; 2]) -> f64 {
        let widest = rows.iter().map(|row| text_width(&row.source.label, TextSize::Body)).fold(40.0, f64::max);
        let head = (widest + 30.0).min(0.3 * size[0]);
        let is_short = head < widest + 30.0;
        let room = size[0] - 2.0 * MARGIN - head;
        let count = self.names.len().max(1);
        let most = ((room / (LEAST_COLUMN + GAP)) as usize).clamp(1, count);
        let blocks = count.div_ceil(most);
        let columns = count.div_ceil(blocks);
        let width = (room / columns as f64 - GAP).max(6.0);
        let heads: Vec<Vec<String>> = self.names.iter().map(|name| column_head(name, width)).collect();
        let title = 3.0 + 14.0 * heads.iter().map(Vec::len).max().unwrap_or(1) as f64;
        let note = self.note(&rows.iter().collect::<Vec<_>>(), width);
        let available = (size[1] - MARGIN) / blocks as f64 - title - MARGIN;
        let least = LEAST_ROW + note.height() + GAP;
        // The reference's colors have no differences below.
        let references = rows.iter().filter(|row| row.source.is_reference).count() as f64;
        let available = available + references * note.height();
        let pitch = (available / rows.len().max(1) as f64).clamp(least, 64.0 + note.height());
        let mut y = MARGIN;
        for block in 0..blocks {
            let shown = block * columns..((block + 1) * columns).min(self.names.len());
            let left = |column: usize| MARGIN + head + (column - block * columns) as f64 * (width + GAP);
            for column in shown.clone() {
                self.column_title(column, &heads[column], [left(column) + width / 2.0, y + title - 4.0]);
            }
            y += title;
            for row in rows {
                let (note, pitch) =
                    if row.source.is_reference { (Note::None, pitch - note.height()) } else { (note, pitch) };
                self.row_head(&row.source, row.name(is_short), [MARGIN, y + (pitch - GAP - note.height()) / 2.0], head);
                match &row.colors {
                    Err(why) => self.text(PickIndex::NONE, why, [MARGIN + head, y + pitch / 2.0], Anchor::LEFT),
                    Ok(colors) => {
                        let drawn = colors.iter().zip(&row.drawn).enumerate();
                        for (column, ((_, difference), color)) in drawn.filter(|(i, _)| shown.contains(i)) {
                            let area = [[left(column), y], [left(column) + width, y + pitch - GAP]];
                            self.swatch(&row.source, column, (color, *difference), area, (note, false));
                        }
                    }
                }
                y += pitch;
            }
            y += MARGIN;
        }
        y
    }

    /// A column's name above it, in lines that end at a height.
    fn column_title(&mut self, column: usize, lines: &[String], [x, bottom]: [f64; 2]) {
        let tag = self.things.tag(PlotItem::Patch { source: None, patch: self.names[column].clone() });
        for (line, words) in lines.iter().rev().enumerate() {
            self.text(tag, words, [x, bottom - 7.0 - 14.0 * line as f64], Anchor::CENTER);
        }
    }

    /// A chart for each sensor, wrapping to the width. Returns the height. The reference has one only where the others do not
    /// show its colors in every swatch.
    pub(super) fn charts(&mut self, rows: &[Row], size: [f64; 2]) -> f64 {
        let is_split = self.look.swatch_style != SwatchStyle::Whole && rows.len() > 1;
        let rows: Vec<&Row> = rows.iter().filter(|row| !(is_split && row.source.is_reference)).collect();
        let columns = chart_columns(self.names.len());
        let lines = self.names.len().div_ceil(columns).max(1);
        let is_crowded = rows.len() > CROWDED && size[0] < NARROW;
        let least = match (self.look.without_bars, columns * lines) {
            (_, count) if count > 60 => [8.0; 2],
            (false, _) if is_crowded => [16.0, Note::Bar.height() + LEAST_COLOR],
            (false, _) => [self.widest_number(&rows) + 4.0 + LEAST_TRACK, Note::Close.height() + LEAST_COLOR],
            (true, _) => [12.0; 2],
        };
        let (across, cell) = chart_cell(rows.len(), columns, lines, size, least);
        let note = self.chart_note(&rows, cell);
        self.widest = self.widest_number(&rows) + 4.0;
        let chart = [columns as f64 * (cell[0] + GAP / 2.0), lines as f64 * (cell[1] + GAP / 2.0) + HEAD];
        let pitch = (size[0] / across as f64).max(chart[0] + 2.0 * MARGIN);
        let width = (pitch - 2.0 * MARGIN).min(chart[0].max(200.0));
        let form = self.head_form(&rows, width);
        for (index, row) in rows.iter().enumerate() {
            let x = MARGIN + (index % across) as f64 * pitch;
            let y = MARGIN + (index / across) as f64 * (chart[1] + MARGIN);
            self.chart_head(row, form, [x, y + 8.0], width);
            match &row.colors {
                Err(why) => {
                    for (line, words) in wrapped(why, TextSize::Body, pitch - MARGIN).iter().enumerate() {
                        self.text(PickIndex::NONE, words, [x, y + 32.0 + 15.0 * line as f64], Anchor::LEFT);
                    }
                }
                Ok(colors) => {
                    for (i, ((_, difference), color)) in colors.iter().zip(&row.drawn).enumerate() {
                        let left = x + (i % columns) as f64 * (cell[0] + GAP / 2.0);
                        let up = y + HEAD - 2.0 + (i / columns) as f64 * (cell[1] + GAP / 2.0);
                        let area = [[left, up], [left + cell[0], up + cell[1]]];
                        self.swatch(&row.source, i, (color, *difference), area, (note, true));
                    }
                }
            }
        }
        MARGIN + rows.len().div_ceil(across) as f64 * (chart[1] + MARGIN)
    }

    /// What stands below the colors of a chart: a bar with its number beside it, where that leaves enough of both.
    fn chart_note(&self, rows: &[&Row], cell: [f64; 2]) -> Note {
        let widest = self.widest_number(rows);
        match cell {
            _ if self.look.without_bars => Note::None,
            [_, height] if height < Note::Close.height() + LEAST_COLOR => Note::Bar,
            [width, _] if width >= widest + 4.0 + LEAST_TRACK => Note::Close,
            [width, height] if width >= widest && height >= Note::Above.height() + LEAST_COLOR => Note::Above,
            _ => Note::Bar,
        }
    }

    /// The largest difference of a chart in words, in one of four forms.
    fn worst_words(&self, row: &Row, form: usize) -> Option<(String, &String)> {
        let (worst, patch) = row.worst(&self.names)?;
        let number = short(self.scene.document.difference, worst);
        let measure = self.scene.difference_name();
        let words = match form {
            0 => format!("worst {measure} {number}, {patch}"),
            1 => format!("max {measure} {number}, {patch}"),
            2 => format!("{measure} ≤ {number}"),
            _ => format!("≤ {number}"),
        };
        Some((words, patch))
    }

    /// The longest form of largest differences and of names, in full or short, that fits in the heads of all charts.
    fn head_form(&self, rows: &[&Row], width: f64) -> (usize, bool) {
        let forms = (0..4).flat_map(|words| [false, true].map(|is_short| (words, is_short)));
        let fits = |(form, is_short): &(usize, bool)| {
            rows.iter().all(|row| {
                let words = self.worst_words(row, *form).map_or(0.0, |(words, _)| text_width(&words, TextSize::Small));
                KEY + text_width(row.name(*is_short), TextSize::Body) + words + AIR <= width
            })
        };
        forms.clone().find(fits).unwrap_or((3, true))
    }

    /// A chart's marker and name, and at its right end its largest difference, which stands for that patch.
    fn chart_head(&mut self, row: &Row, (form, is_short): (usize, bool), at: [f64; 2], width: f64) {
        let worst = self.worst_words(row, form).map(|(words, patch)| (words, patch.clone()));
        let Some((words, patch)) = worst else {
            return self.row_head(&row.source, row.name(is_short), at, width);
        };
        self.row_head(&row.source, row.name(is_short), at, width - text_width(&words, TextSize::Small) - AIR);
        let tag = self.things.tag(PlotItem::Patch { source: Some(id(&row.source)), patch });
        self.marks.push(Mark { tag, ..small(&words, [at[0] + width, at[1]], Anchor::RIGHT) });
    }

    /// A sensor's marker and label, no wider than there is room.
    fn row_head(&mut self, source: &ComparedSensor, label: &str, at: [f64; 2], width: f64) {
        let tag = self.things.tag(PlotItem::Sensor(id(source)));
        self.marks.push(sign(tag, source, [at[0] + 7.0, at[1]], 5.0, InkRole::OnSurround));
        let fits = |form: &str| text_width(form, TextSize::Body) <= width - KEY;
        self.text(tag, &cut_in_middle(label, fits), [at[0] + KEY, at[1]], Anchor::LEFT);
    }

    /// One swatch: the sensor's color, the reference's part, the notch, a frame that is seen when it is chosen, the
    /// difference. Nothing lies across the edge between the colors.
    fn swatch(
        &mut self,
        source: &ComparedSensor,
        index: usize,
        (color, difference): (&PatchColor, Option<f64>),
        [[x0, y0], [x1, y1]]: [[f64; 2]; 2],
        (note, is_chart): (Note, bool),
    ) {
        let name = self.names.get(index).cloned().unwrap_or_default();
        let tag = self.things.tag(PlotItem::Patch { source: Some(id(source)), patch: name.clone() });
        let bottom = if y1 - y0 > 3.0 * BAR { y1 - note.height() } else { y1 };
        let reference = self.reference.get(index).copied();
        let shown = if self.look.blink { reference.unwrap_or(*color) } else { *color };
        let title = format!("{} {name}", source.label);
        self.area(&title, [[x0, y0], [x1, bottom]], &shown);
        if let Some(reference) = reference.filter(|_| !source.is_reference && !self.look.blink) {
            let (w, h) = (x1 - x0, bottom - y0);
            match self.look.swatch_style {
                SwatchStyle::Split => self.area("reference", [[x0, y0], [x0 + w / 2.0, bottom]], &reference),
                SwatchStyle::Inset => {
                    let inner = [[x0 + w * 0.3, y0 + h * 0.25], [x1 - w * 0.3, bottom - h * 0.25]];
                    self.area("reference", inner, &reference);
                }
                SwatchStyle::Whole => {}
            }
        }
        let exaggerated = self.scene.document.exaggeration != Exaggeration::One && !source.is_reference;
        if shown.srgb.clipped && exaggerated && !self.look.blink {
            let left = if self.look.swatch_style == SwatchStyle::Split { 0.5 * (x0 + x1) } else { x0 };
            self.hatch([[left, y0], [x1, bottom]]);
        } else if shown.srgb.clipped {
            let notch = (0.3 * (bottom - y0)).min(9.0);
            let points = vec![[x1 - notch, y0], [x1, y0], [x1, y0 + notch]];
            let mark = Mark::new(PickIndex::NONE, "clipped", Shape::Polygon { points });
            self.marks.push(mark.with_fill(InkRole::Surround));
        }
        self.marks.push(Mark::new(tag, title, Shape::Rect { min: [x0, y0], max: [x1, bottom] }));
        if let Some(difference) = difference.filter(|_| bottom < y1) {
            self.difference(difference, [[x0, bottom], [x1, y1]], note, is_chart);
        }
    }

    /// The bar of a difference on a hairline of full length, signed where it is longer, with its number.
    fn difference(&mut self, difference: f64, [[x0, y0], [x1, y1]]: [[f64; 2]; 2], note: Note, is_chart: bool) {
        let metric = self.scene.document.difference;
        let words = short(metric, difference);
        let share = (difference / metric.full_scale).clamp(0.0, 1.0);
        let beside = if is_chart { self.widest } else { text_width(&words, TextSize::Small).max(24.0) + 4.0 } + APART;
        let is_beside = matches!(note, Note::Beside | Note::Close);
        let right = if is_beside { x1 - beside } else { x1 };
        let middle = if is_beside { 0.5 * (y0 + y1) + 0.5 } else { y1 - 0.5 * BAR };
        let track = Shape::Segments { segments: vec![[[x0, middle], [right, middle]]] };
        let faint = Ink::new(InkRole::OnSurround).faded(0.35);
        self.marks.push(Mark::new(PickIndex::NONE, "full scale", track).with_stroke(faint, 1.0));
        let bar = Shape::Rect { min: [x0, middle - 0.5 * BAR], max: [x0 + share * (right - x0), middle + 0.5 * BAR] };
        self.marks.push(Mark::new(PickIndex::NONE, "difference", bar).with_fill(InkRole::OnSurround));
        if difference > metric.full_scale {
            let points = vec![[right - 3.0, middle - 2.5], [right + 1.0, middle], [right - 3.0, middle + 2.5]];
            let sign = Mark::new(PickIndex::NONE, "beyond the scale", Shape::Polygon { points });
            self.marks.push(sign.with_fill(InkRole::OnSurround));
        }
        if is_chart && share < NUMBERED {
            return;
        }
        // A little lower, so that no digit touches the color above.
        match note {
            Note::Beside | Note::Close => self.marks.push(small(&words, [x1 - APART, middle + 0.5], Anchor::RIGHT)),
            Note::Above => self.marks.push(small(&words, [x0, y0 + 0.5 * NUMBER + 1.0], Anchor::LEFT)),
            Note::Bar | Note::None => {}
        }
    }

    /// Lines over a color that is exaggerated beyond what a screen shows.
    fn hatch(&mut self, [min, max]: [[f64; 2]; 2]) {
        let [width, height] = [max[0] - min[0], max[1] - min[1]];
        let count = ((width + height) / HATCH) as u32;
        let area = Rect { min, max };
        let line = |index| {
            let x = min[0] - height + HATCH * (f64::from(index) + 0.5);
            clip_segment(area, [[x, max[1]], [x + height, min[1]]])
        };
        let segments = (0..=count).filter_map(line).collect();
        let mark = Mark::new(PickIndex::NONE, "clipped", Shape::Segments { segments });
        self.marks.push(mark.with_stroke(InkRole::Surround, 1.2));
    }

    fn area(&mut self, name: &str, [min, max]: [[f64; 2]; 2], color: &PatchColor) {
        let mark = Mark::new(PickIndex::NONE, name, Shape::Rect { min, max });
        self.marks.push(mark.with_fill(Ink::rgb(color.srgb.bytes)));
    }

    fn text(&mut self, tag: Tag, text: &str, at: [f64; 2], anchor: Anchor) {
        self.marks.push(Mark { tag, ..Mark::text(text, at, anchor, TextSize::Body, InkRole::OnSurround) });
    }
}

/// Small text on the surround.
pub(super) fn small(text: &str, at: [f64; 2], anchor: Anchor) -> Mark {
    Mark::text(text, at, anchor, TextSize::Small, InkRole::OnSurround)
}

/// A column's name in at most two lines, each cut to the width.
fn column_head(name: &str, width: f64) -> Vec<String> {
    let mut lines = wrapped(name, TextSize::Body, width);
    if lines.len() > 2 {
        let rest = lines.split_off(1).join(" ");
        lines.push(rest);
    }
    let fits = |form: &str| text_width(form, TextSize::Body) <= width;
    lines.iter().map(|line| cut_in_middle(line, fits).into_owned()).collect()
}

/// Six for a ColorChecker, else about half again as wide as high.
fn chart_columns(count: usize) -> usize {
    if count == 24 { 6 } else { ((count as f64 * 1.5).sqrt().ceil() as usize).max(1) }
}

/// Number of charts side by side, and the size of a swatch with its note: the largest that fits and fills the area, at most
/// twice as wide as high and 2.6 times as high as wide, with numbers above the bars or without where only so all fit, else
/// the least high, and the charts scroll.
fn chart_cell(charts: usize, columns: usize, lines: usize, size: [f64; 2], least: [f64; 2]) -> (usize, [f64; 2]) {
    let narrow = (least[0] - 4.0 - LEAST_TRACK).max(LEAST_ABOVE.min(least[0]));
    let above = [narrow, LEAST_COLOR + Note::Above.height()];
    // On paper, where nothing scrolls, the board is higher instead.
    let bars = Some([least[0].min(16.0), Note::Bar.height() + LEAST_COLOR - 2.0]).filter(|_| size[0] >= NARROW);
    let largest =
        [least, above].into_iter().chain(bars).find_map(|least| largest_cell(charts, [columns, lines], size, least));
    largest.unwrap_or_else(|| {
        let width = |across: f64| (size[0] / across - 2.0 * MARGIN) / columns as f64 - GAP / 2.0;
        let most = size[0] / (columns as f64 * (least[0] + GAP / 2.0) + 2.0 * MARGIN);
        let across = (most as usize).clamp(1, charts.max(1));
        (across, [width(across as f64).clamp(least[0], least[0].max(2.4 * least[1])), least[1]])
    })
}

/// The largest size of a swatch, at least as given, with which all charts fit.
fn largest_cell(
    charts: usize,
    [columns, lines]: [usize; 2],
    size: [f64; 2],
    least: [f64; 2],
) -> Option<(usize, [f64; 2])> {
    let mut best: Option<(usize, [f64; 2])> = None;
    for across in 1..=charts.max(1) {
        let down = charts.div_ceil(across).max(1);
        let width = (size[0] - MARGIN * (2.0 * across as f64)) / across as f64 / columns as f64 - GAP / 2.0;
        let height = ((size[1] - MARGIN * (1.0 + down as f64)) / down as f64 - HEAD) / lines as f64 - GAP / 2.0;
        let cell = [width.min(2.0 * height), height.min((2.6 * width).max(least[1]))];
        let fits = cell[0] >= least[0] && cell[1] >= least[1];
        // A place that were empty counts as what it takes from the others.
        let merit = |across: usize, cell: [f64; 2]| cell[0].min(cell[1]) * filled(charts, across);
        if fits && best.is_none_or(|(other, best)| merit(across, cell) > merit(other, best)) {
            best = Some((across, cell));
        }
    }
    best
}
