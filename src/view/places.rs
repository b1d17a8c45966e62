//! Which panes are visible, and which of them keys, menus and settings mean.

use super::View;
use crate::workspaces::{PaneKind, Places, Slot, Workspace};

impl View {
    /// Panes of the workspace, or of the page in its place.
    pub fn places(&self) -> Places {
        if self.numerics {
            return [Some(PaneKind::METHODS), None, Some(PaneKind::TOLERANCE), Some(PaneKind::STATISTICS)];
        }
        let places = *self.saved.layout.places(self.saved.workspace);
        if places[0] == Some(PaneKind::MEASURE) { [places[0], None, None, None] } else { places }
    }

    /// Shows a pane in its place.
    pub fn show(&mut self, pane: PaneKind) {
        match pane.slot() {
            Slot::Card => self.card = Some(pane),
            Slot::Numerics => self.numerics = true,
            Slot::Left => {
                (self.saved.workspace, self.saved.layout.left, self.numerics) = (Workspace::Compare, true, false);
            }
            _ => {
                self.numerics = false;
                let layout = &mut self.saved.layout;
                let Some((workspace, at)) = layout.place_of(pane, self.saved.workspace) else { return };
                layout.put(workspace, at, pane);
                // Measuring takes all of Data, and would cover it.
                if at > 0 && layout.data[0] == Some(PaneKind::MEASURE) && workspace == Workspace::Data {
                    layout.data[0] = Some(PaneKind::LIBRARY);
                }
                self.saved.workspace = workspace;
                if at >= 2 {
                    (self.card, layout.right) = (None, true);
                }
            }
        }
    }

    pub fn is_shown(&self, pane: PaneKind) -> bool {
        self.places().contains(&Some(pane))
            || self.card == Some(pane)
            || pane.slot() == Slot::Left && self.saved.workspace == Workspace::Compare && self.saved.layout.left
    }

    /// The view that the settings are of: the last that had the focus while it is shown, else the upper one.
    pub fn settings_view(&self) -> Option<PaneKind> {
        let [upper, lower, ..] = self.saved.layout.compare;
        self.settings_of.filter(|view| [upper, lower].contains(&Some(*view))).or(upper)
    }

    /// The pane that keys and menus mean: the one with the keyboard, else the first of the workspace.
    pub fn keyed(&self) -> PaneKind {
        let first = self.places().into_iter().flatten().next();
        self.page.or(self.focused).or(first).unwrap_or(PaneKind::CHROMATICITY)
    }

    /// The pane whose figure a key or menu means: the wanted one if it has figures, else the first in the workspace that has.
    pub fn pictured(&self, wanted: PaneKind, has_figures: impl Fn(PaneKind) -> bool) -> PaneKind {
        let places = self.places().into_iter().flatten();
        std::iter::once(wanted).chain(places).find(|kind| has_figures(*kind)).unwrap_or(PaneKind::CHROMATICITY)
    }
}
