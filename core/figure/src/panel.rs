//! A whole figure and its parts: panels with axes, marks and small texts, and the legend.

use chromascope_text::choices;

use super::axis::Axis;
use super::ink::{Ink, InkRole};
use super::mark::{Anchor, Mark, Marker, Shape, Stroke, TextSize};
use super::projection::Projection;
use super::rect::Rect;
use super::table::Table;
use super::text::{text_area, text_width, wrapped};

/// Height of a line of a note, in points.
const LINE: f64 = 15.0;

/// A figure: everything that is needed to show it, print it, and write its numbers.
#[derive(Debug, Clone, PartialEq)]
pub struct Figure {
    /// Title in a few words. Read by screen readers and written as the SVG's title.
    pub title: String,
    /// Width and height in points, without caption and margins.
    pub size: [f64; 2],
    /// Panels, drawn in this order.
    pub panels: Vec<Panel>,
    /// Keys of the legend; empty for none.
    pub legend: Vec<LegendEntry>,
    /// Position of the legend.
    pub legend_place: LegendPlace,
    /// Text below the figure: conditions and sources. Empty for none.
    pub caption: String,
    /// The numbers shown.
    pub table: Table,
}

impl Figure {
    /// An empty figure of the given size in points.
    pub fn new(title: impl Into<String>, size: [f64; 2]) -> Self {
        Self {
            title: title.into(),
            size,
            panels: Vec::new(),
            legend: Vec::new(),
            legend_place: LegendPlace::default(),
            caption: String::new(),
            table: Table::default(),
        }
    }
}

/// One rectangle of a figure with its own axes.
#[derive(Debug, Clone, PartialEq)]
pub struct Panel {
    /// Name, unique inside the figure.
    pub name: String,
    /// Outer box inside the figure in points, tick labels included.
    pub area: Rect,
    /// Horizontal axis. A range written from high to low runs leftward.
    pub x: Axis,
    /// Vertical axis, upward. A range written from high to low runs downward.
    pub y: Axis,
    /// One unit is as long on x as on y. The ranges are enlarged to fill the area, never cropped.
    pub equal_aspect: bool,
    /// Ink behind the marks.
    pub background: Ink,
    /// Small text in the upper right corner.
    pub note: String,
    /// A thin frame around the plot.
    pub framed: bool,
    /// Marks, drawn from back to front.
    pub marks: Vec<Mark>,
}

impl Panel {
    /// A framed panel with axes and no marks.
    pub fn new(name: impl Into<String>, area: Rect, x: Axis, y: Axis) -> Self {
        Self {
            name: name.into(),
            area,
            x,
            y,
            equal_aspect: false,
            background: Ink::new(InkRole::Plot),
            note: String::new(),
            framed: true,
            marks: Vec::new(),
        }
    }

    /// A panel without axes, drawn in points: the origin is the upper left corner, y runs downward.
    pub fn board(name: impl Into<String>, area: Rect, background: Ink) -> Self {
        let x = Axis::hidden([0.0, area.width()]);
        let y = Axis::hidden([area.height(), 0.0]);
        Self { background, framed: false, ..Self::new(name, area, x, y) }
    }

    /// The panel with its vertical range, upward, raised until no mark lies under the texts in its upper corners, nor within
    /// `above` points of those and of the upper edge, where labels have room. In a low panel most of the height stays the marks'.
    #[must_use]
    pub fn with_headroom(mut self, above: f64) -> Self {
        let projection = Projection::new(&self, 1.0);
        let (plot, [low, high]) = (projection.plot, projection.y);
        let notes =
            annotations(&self, plot, 1.0).into_iter().filter(|note| note.anchor.1 < 0.5 && note.at[1] < plot.max[1]);
        let notes = notes.map(|note| text_area(&note.text, TextSize::Small, note.at, note.anchor));
        let edge = Rect { min: plot.min, max: [plot.max[0], plot.min[1]] };
        let kept: Vec<Rect> = notes.chain([edge]).collect();
        let mut raised = high;
        for ([a, b], reach) in self.marks.iter().flat_map(tops) {
            let [a, b] = [a, b].map(|point| (projection.at(point)[0], point[1]));
            let over = |area: &&Rect| a.0.max(b.0) >= area.min[0] - 4.0 && a.0.min(b.0) <= area.max[0] + 4.0;
            let below = kept.iter().filter(over).map(|area| area.max[1] - plot.min[1]).fold(0.0, f64::max);
            let share = ((below + above + reach) / plot.height()).min(0.6);
            raised = f64::max(raised, low + (a.1.max(b.1) - low) / (1.0 - share));
        }
        self.y.range = [low, raised];
        self
    }
}

/// Upper ends of a mark as straight lines in data units, each with the points by which it reaches above them.
fn tops(mark: &Mark) -> Vec<([[f64; 2]; 2], f64)> {
    let half = mark.stroke.map_or(0.0, |stroke| 0.5 * stroke.width);
    let mut tops = match &mark.shape {
        Shape::Line { points, .. } => points.windows(2).map(|ends| ([ends[0], ends[1]], half)).collect(),
        Shape::Segments { segments } => segments.iter().map(|ends| (*ends, half)).collect(),
        Shape::Points { points, radius, .. } => points.iter().map(|at| ([*at; 2], 1.3 * radius + half)).collect(),
        Shape::Rect { min, max } => {
            let top = min[1].max(max[1]);
            vec![([[min[0], top], [max[0], top]], half)]
        }
        _ => Vec::new(),
    };
    tops.retain(|(ends, _)| ends.as_flattened().iter().all(|v| v.is_finite()));
    tops
}

/// A small text of a plot: an axis' label, a panel's note.
#[derive(Debug, Clone, PartialEq)]
pub struct Annotation {
    /// Its place in points.
    pub at: [f64; 2],
    /// The text.
    pub text: String,
    /// Anchor: the point of the text that lies at the position.
    pub anchor: Anchor,
}

/// Labels of the axes (y upper left; x below the tick labels, symbols lower right) and the note (upper right) of a panel
/// whose plot covers the given rectangle, a long one in several lines, for [`TextSize::Small`] drawn `text_scale` times as large as on screen. None covers another.
pub fn annotations(panel: &Panel, plot: Rect, text_scale: f64) -> Vec<Annotation> {
    let pad = 5.0 * text_scale;
    let width = |text: &str| text_scale * text_width(text, TextSize::Small);
    let beside = width(&panel.y.label) + width(&panel.note) + 4.0 * pad <= plot.width();
    let below = if beside || panel.y.label.is_empty() { 0.0 } else { 16.0 * text_scale };
    let left = plot.min[0] + pad;
    let right = plot.max[0] - pad;
    let top = plot.min[1] + pad;
    let x = if panel.x.has_title_line() {
        let bottom = plot.max[1] + (Projection::BOTTOM - 2.0) * text_scale;
        ([0.5 * (plot.min[0] + plot.max[0]), bottom], &panel.x.label, Anchor::TOP)
    } else {
        ([right, plot.max[1] - pad], &panel.x.label, Anchor::RIGHT_BOTTOM)
    };
    [([left, top], &panel.y.label, Anchor::LEFT_TOP), ([right, top + below], &panel.note, Anchor::RIGHT_TOP), x]
        .into_iter()
        .flat_map(|([x, y], text, anchor)| {
            let lines = wrapped(text, TextSize::Small, (plot.width() - 2.0 * pad) / text_scale);
            let first = if anchor.1 < 0.5 { 0.0 } else { 1.0 - lines.len() as f64 };
            let line =
                move |(i, text)| Annotation { at: [x, y + LINE * text_scale * (first + i as f64)], text, anchor };
            lines.into_iter().enumerate().map(line)
        })
        .collect()
}

/// One key of a legend: the line and marker of a source with its name.
#[derive(Debug, Clone, PartialEq)]
pub struct LegendEntry {
    /// Name of the source.
    pub name: String,
    /// Its line; `None` for a key with a marker only.
    pub stroke: Option<Stroke>,
    /// Its marker; `None` for a key with a line only.
    pub marker: Option<Marker>,
    /// Ink that fills the marker; `None` for a hollow one.
    pub fill: Option<Ink>,
}

choices! {
    /// Position of a legend.
    #[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
    #[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
    pub enum LegendPlace {
        /// In a corner of the largest panel where it covers no point, else below.
        Inside = "inside", "Inside, where it covers nothing", "Inside, in a corner where it covers no point; below where there is none";
        /// Inside the largest panel, upper right, below the panel's note.
        #[default]
        UpperRight = "upper-right", "Upper right", "Inside, at the upper right";
        /// Inside the largest panel, upper left.
        UpperLeft = "upper-left", "Upper left", "Inside, at the upper left";
        /// Inside the largest panel, lower right.
        LowerRight = "lower-right", "Lower right", "Inside, at the lower right";
        /// Inside the largest panel, lower left.
        LowerLeft = "lower-left", "Lower left", "Inside, at the lower left";
        /// In a column right of the figure, which grows by it.
        Outside = "beside", "Beside", "Right of the figure; below where that would take half of the width";
        /// In rows below the figure, which grows by them.
        Below = "below", "Below", "Below the figure";
        /// Nowhere.
        None = "none", "None", "No legend";
    }
}
