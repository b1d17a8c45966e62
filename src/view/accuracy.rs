//! View state of the Numerics workspace.

pub use crate::figures::look::Shows;

/// View state of the Numerics workspace.
#[derive(Clone, Debug, Default)]
pub struct AccuracyView {
    /// Selected measurement.
    pub shows: Shows,
}
