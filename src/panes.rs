//! Panes: each reads the document, requests answers and issues commands. None depends on another.
//!
//! A new pane is one file and its line in [`ALL`] (with its `mod` line), as the help page on the architecture shows.
//!
//! What it keeps from frame to frame is a struct in its file, and a slow answer is asked for in each frame: nothing is to be
//! registered, ended or waited for (`tests/app/panes.rs` has a whole one). It is then among the tabs of the views of Compare, in
//! saved layouts and in exports; another place is named in `PaneKind::slot`.

pub mod chromaticity;
pub mod compared;
pub mod context;
pub mod correction;
pub mod curves;
pub mod differences;
pub mod figure_page;
pub mod head_to_head;
pub mod help;
pub mod import;
pub mod inspector;
pub mod interpretation;
pub mod library;
pub mod light;
pub mod measure;
pub mod menu;
pub mod metamers;
pub mod methods;
pub mod metrics;
pub mod recorded;
pub mod render;
pub mod report_card;
pub mod scene_bar;
pub mod settings;
pub mod spectra;
pub mod statistics;
pub mod status_bar;
pub mod swatches;
pub mod tables;
pub mod tolerance;
pub mod widgets;

use chromascope_figure::{Figure, FigureRoom};
use egui::{Id, Rect, Ui, UiBuilder};

use context::{Pane, PaneContext};

use crate::figures::look::FigureLook;
use crate::scene::Scene;
use crate::workspaces::PaneKind;

/// All panes, in the order they are listed.
pub const ALL: &[&Pane] = &[
    &compared::PANE,
    &chromaticity::PANE,
    &differences::PANE,
    &swatches::PANE,
    &render::PANE,
    &spectra::PANE,
    &inspector::PANE,
    &settings::PANE,
    &metrics::PANE,
    &report_card::PANE,
    &head_to_head::PANE,
    &correction::PANE,
    &metamers::PANE,
    &recorded::PANE,
    &tables::PANE,
    &library::PANE,
    &measure::PANE,
    &import::PANE,
    &interpretation::PANE,
    &curves::PANE,
    &light::PANE,
    &methods::PANE,
    &tolerance::PANE,
    &statistics::PANE,
];

/// A pane, if there is one of this id.
pub fn by_kind(kind: PaneKind) -> Option<&'static Pane> {
    ALL.iter().copied().find(|pane| pane.kind == kind)
}

pub fn title(kind: PaneKind) -> &'static str {
    by_kind(kind).map_or("", |pane| pane.title)
}

/// Shows a pane in exactly its rectangle.
pub fn show(ui: &mut Ui, kind: PaneKind, rect: Rect, context: &mut PaneContext<'_>) {
    if let Some(pane) = by_kind(kind) {
        // Controls keep their ids, and the keyboard, whatever other panes draw before them.
        let own = UiBuilder::new().scope_id(Id::unique(("pane", kind))).max_rect(ui.max_rect());
        (pane.show)(&mut ui.new_child(own), rect, context);
    }
}

/// A pane's figure in a room; none for panes without one, and while there is nothing to draw.
pub fn figure(kind: PaneKind, scene: &Scene<'_>, look: &FigureLook, room: FigureRoom) -> Option<Figure> {
    by_kind(kind)?.figure?.figure(scene, look, room)
}
