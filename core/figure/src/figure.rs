//! A whole figure.

use super::panel::{LegendEntry, LegendPlace, Panel};
use super::table::Table;

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
