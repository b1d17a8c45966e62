//! Stub.

use super::PaneContext;
use egui::{Rect, Ui};

/// Shows it.
pub fn show(_ui: &mut Ui, _rect: Rect, _context: &mut PaneContext<'_>) {}
