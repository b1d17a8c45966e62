//! The scene as figures: the same value is drawn on screen, saved as SVG and PNG, and written as numbers.

pub mod accuracy;
pub mod chromaticity;
pub mod curves;
pub mod light;
pub mod metrics;
pub mod render;
pub mod report_card;
pub mod skipped_work;
pub mod spectra;
pub mod strip;
pub mod swatches;
