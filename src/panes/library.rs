//! Compared sensors, which are the only legend, and all data sets.

mod compared;
mod save;
mod sets;
mod show;

pub use show::PANE;
