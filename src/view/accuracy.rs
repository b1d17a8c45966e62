//! View state of the Numerics workspace.

pub use crate::figures::look::Shows;

#[derive(Clone, Debug, Default)]
pub struct AccuracyView {
    pub shows: Shows,
}
