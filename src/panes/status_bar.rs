//! Stub.

use super::PaneContext;
use egui::{Rect, Ui};

/// Shows it.
pub fn show(_ui: &mut Ui, _rect: Rect, _arrangement: &crate::workspaces::Arrangement, _context: &mut PaneContext<'_>) {}
