//! The scene as figures: the same value is drawn on screen, saved as SVG and PNG, and written as numbers.
//!
//! A new kind of figure is one file and its line in [`FIGURES`] (with its `mod` line):
//!
//! ```diff
//! --- /dev/null
//! +++ b/src/workbench/src/figures/gamut.rs
//! +//! Gamut of each sensor.
//! +
//! +use chromascope_figure::{Figure, FigureRoom};
//! +
//! +use super::kind::FigureKind;
//! +use super::look::FigureLook;
//! +use crate::scene::Scene;
//! +
//! +pub static KIND: FigureKind = FigureKind::new("gamut", "Gamut of each sensor", figure);
//! +
//! +fn figure(scene: &Scene<'_>, look: &FigureLook, room: FigureRoom) -> Option<Figure> {
//! +    …
//! +}
//! --- a/src/workbench/src/figures.rs
//! +++ b/src/workbench/src/figures.rs
//! +pub mod gamut;
//!      &accuracy::KIND,
//! +    &gamut::KIND,
//! ```
//!
//! `chromascope figure gamut` then draws it, and its help lists it. A pane whose figure it is names its `KIND`.

pub mod accuracy;
pub mod band;
pub mod chromaticity;
pub mod correction;
pub mod curves;
pub mod data_set;
pub mod head_to_head;
pub mod kind;
pub mod light;
pub mod look;
pub mod metrics;
pub mod portrait;
pub mod recorded;
pub mod render;
pub mod report_card;
pub mod spectra;
pub mod strip;
pub mod swatches;

use kind::FigureKind;

/// All kinds, in the order in which the command line lists them.
pub static FIGURES: &[&FigureKind] = &[
    &chromaticity::KIND,
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
