//! The scene as figures: the same value is drawn on screen, saved as SVG and PNG, and written as numbers.
//!
//! A new kind of figure is one file and its line in [`FIGURES`] (with its `mod` line), as the help page on the architecture shows:
//! `chromascope figure` then draws it, and its help lists it. A pane whose figure it is names its `KIND`.

pub mod accuracy;
pub mod band;
pub mod chromaticity;
pub mod correction;
pub mod curves;
pub mod data_set;
pub mod differences;
pub mod head_to_head;
pub mod kind;
pub mod light;
pub mod look;
pub mod measured;
pub mod metrics;
pub mod portrait;
pub mod recorded;
pub mod render;
pub mod report_card;
pub mod spectra;
pub mod strip;
pub mod swatches;
mod whiskers;

use kind::FigureKind;

/// Share of the places in so many columns that a number of things fills.
pub fn filled(count: usize, columns: usize) -> f64 {
    count as f64 / count.next_multiple_of(columns.max(1)).max(1) as f64
}

/// All kinds, in the order in which the command line lists them.
pub static FIGURES: &[&FigureKind] = &[
    &chromaticity::KIND,
    &differences::KIND,
    &strip::KIND,
    &spectra::KIND,
    &swatches::KIND,
    &light::KIND,
    &render::KIND,
    &render::DIFFERENCE,
    &metrics::KIND,
    &head_to_head::KIND,
    &report_card::KIND,
    &correction::KIND,
    &curves::KIND,
    &recorded::KIND,
    &accuracy::KIND,
];
