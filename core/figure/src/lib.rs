//! A plot as data: panels with axes, marks, a legend, and the table beside it.
//!
//! A [`Figure`] says *what* is drawn and in which role, never in which color: the [`Palette`] of whoever draws it
//! turns an [`InkRole`] into sRGB. The window draws panels with egui, [`svg::write`] writes the whole figure as SVG,
//! PNG and PDF are made from that SVG, and [`Table::to_csv`] holds the same numbers. Lengths are points (1/72 inch
//! on paper, logical pixels on screen), y downward outside panels and as the axis says inside.
//!
//! Points that are not finite are never drawn: they break a line in two and are left out of everything else.

mod axis;
mod ink;
mod mark;
mod projection;
pub mod svg;
mod table;
mod text;

pub use axis::{Axis, MIN_LABEL_SPACING, Tick, Ticks, auto_ticks};
pub use ink::{Ink, InkRole, Palette};
pub use mark::{Anchor, Dash, Image, Mark, Marker, MarkerOutline, Rgb, Shape, Stroke, Tag, TextSize, finite_runs};
pub use projection::{Projection, fit_equal};
pub use table::{Cell, Table};
pub use text::{Annotation, annotations, text_width, wrapped};

/// An axis-parallel rectangle in points, `min` is the upper left corner.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rect {
    /// Upper left corner.
    pub min: [f64; 2],
    /// Lower right corner.
    pub max: [f64; 2],
}

impl Rect {
    /// The rectangle from its upper left corner and its size.
    pub fn from_min_size(min: [f64; 2], size: [f64; 2]) -> Self {
        Self { min, max: [min[0] + size[0], min[1] + size[1]] }
    }

    /// Width in points.
    pub fn width(&self) -> f64 {
        self.max[0] - self.min[0]
    }

    /// Height in points.
    pub fn height(&self) -> f64 {
        self.max[1] - self.min[1]
    }
}

/// A figure: everything that is needed to show it, print it, and write its numbers.
#[derive(Debug, Clone, PartialEq)]
pub struct Figure {
    /// Title in a few words, read by screen readers and written as the SVG's title.
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
    /// Background of the marks.
    pub background: Ink,
    /// Small text in the upper right corner.
    pub note: String,
    /// A thin frame around the plot.
    pub framed: bool,
    /// Marks from back to front.
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
    /// Fill of the marker; `None` for a hollow one.
    pub fill: Option<Ink>,
}

/// Position of a legend.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum LegendPlace {
    /// Inside the first panel, upper right, below the panel's note.
    #[default]
    UpperRight,
    /// Inside the first panel, upper left.
    UpperLeft,
    /// Inside the first panel, lower right.
    LowerRight,
    /// Inside the first panel, lower left.
    LowerLeft,
    /// In a column right of the figure, which grows by it.
    Outside,
}
