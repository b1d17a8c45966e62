//! The parts of a figure: panels with axes and marks, and the legend.

use super::annotation::annotations;
use super::axis::Axis;
use super::ink::{Ink, InkRole};
use super::mark::{Mark, Marker, Shape, Stroke, TextSize};
use super::projection::Projection;
use super::rect::Rect;
use super::text::text_area;

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

/// Position of a legend.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum LegendPlace {
    /// Inside the largest panel, upper right, below the panel's note.
    #[default]
    UpperRight,
    /// Inside the largest panel, upper left.
    UpperLeft,
    /// Inside the largest panel, lower right.
    LowerRight,
    /// Inside the largest panel, lower left.
    LowerLeft,
    /// In a corner of the largest panel where it covers no point, else below.
    Inside,
    /// In a column right of the figure, which grows by it.
    Outside,
    /// In rows below the figure, which grows by them.
    Below,
    /// Nowhere.
    None,
}
