//! The parts of a figure: panels with axes and marks, and the legend.

use super::axis::Axis;
use super::ink::{Ink, InkRole};
use super::mark::{Mark, Marker, Stroke};
use super::rect::Rect;
use chromascope_text::choices;

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
