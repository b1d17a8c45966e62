//! View state of the Recorded pane.

use chromascope_core::camera::recorded::Freedom;
use chromascope_core::query::RecordedSet;

/// View state of the Recorded pane.
#[derive(Clone, Debug, Default)]
pub struct RecordedView {
    /// True while the open file dialog is for recorded values.
    pub opening: bool,
    /// Parameters that are fitted.
    pub freedom: Freedom,
    /// Corners of the chart in the picture that were clicked, in its pixels.
    pub corners: Vec<[f64; 2]>,
    /// Raw value from which on a channel of a table is clipped; 0 for none.
    pub clip: f64,
    /// Camera whose residuals are shown; the best without one.
    pub camera: Option<String>,
    /// The current patches.
    pub set: Option<RecordedSet>,
}
