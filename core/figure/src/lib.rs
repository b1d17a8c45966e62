//! A plot as data: panels with axes, marks, a legend, and the table beside it.
//!
//! A [`Figure`] specifies *what* is drawn and in which role, never in which color: the renderer's [`Palette`] maps an
//! [`InkRole`] to sRGB. The window draws panels with egui, [`svg::write`] and [`pdf::write`] write the whole
//! figure, PNG is made from that SVG, and [`Table::to_csv`] writes the same numbers. Lengths are points (1/72 inch on
//! paper, logical pixels on screen), y downward outside panels and by the axis inside.
//!
//! Points that are not finite are never drawn: they break a line in two and are omitted from everything else.

mod axis;
mod clip;
mod ink;
mod labels;
mod latex;
mod mark;
pub mod number;
mod page;
mod panel;
pub mod pdf;
mod projection;
mod rect;
mod room;
pub mod svg;
mod table;
mod text;

pub use axis::{Axis, MIN_LABEL_SPACING, Tick, Ticks, auto_ticks};
pub use clip::segment as clip_segment;
pub use ink::{Ink, InkRole, Palette};
pub use labels::{Label, Labels, Place};
pub use mark::{
    Anchor, Dash, Image, Mark, Marker, MarkerOutline, Rgb, Shape, Stroke, Tag, TextSize, color_runs, finite_runs,
};
pub use page::{AxisTitles, Page, PageStyle};
pub use panel::{Annotation, Figure, LegendEntry, LegendPlace, Panel, annotations};
pub use projection::{Projection, fit_equal};
pub use rect::Rect;
pub use room::{AxisRanges, FigureRoom, Numbers};
pub use table::{Cell, CellValue, Column, Field, Note, Table};
pub use text::{text_area, text_width, wrapped};
