//! Result of the reader of a format.

use crate::grid::Grid;
use crate::report::{Decided, Decision, Reader};
use crate::sniff::Layout;

/// Result of a reader, before units, order and scale are settled.
pub(crate) struct Found {
    pub(crate) grid: Grid,
    pub(crate) layout: Layout,
    pub(crate) reader: Decided<Reader>,
    /// Decisions that only this family needs.
    pub(crate) notes: Vec<Decision>,
}
