//! Templates: documents to begin a new session with, and what shows them.

use crate::action::{Action, ImportedAction, RenderAction, SceneAction};
use crate::catalog::import::import;
use crate::document::imported::{ImportedSet, Role};
use crate::document::names::BuiltInNames;
use crate::document::start::Start;
use crate::document::{Document, Light, Overlays, SetKind, WhiteBalanceChoice};
use crate::workspaces::PaneKind;

#[derive(Debug)]
pub struct Template {
    pub name: &'static str,
    /// The question that it answers, and the conditions.
    pub summary: &'static str,
    pub pane: PaneKind,
    start: Start,
    actions: fn(&Document) -> Vec<Action>,
}

pub const TEMPLATES: [Template; 7] = [
    Template {
        name: "The paper, experiment 1",
        summary: "The colors of blackbodies from 1000 to 20000 K as two cameras and the eye see them: lines that part (Eq 13).",
        pane: PaneKind::CHROMATICITY,
        start: Start::Paper,
        actions: |document| {
            vec![overlays(Overlays { patches: false, isotherms: true, whites: true, ..document.overlays })]
        },
    },
    Template {
        name: "The paper, experiment 2",
        summary: "Five patches of the ColorChecker as each camera and as the eye sees them, side by side (equal energy, Eq 13, Δxy).",
        pane: PaneKind::SWATCHES,
        start: Start::Paper,
        actions: |_| Vec::new(),
    },
    Template {
        name: "The paper, experiment 3",
        summary: "A person in direct sunlight as each camera and as the eye sees him (measured skin, balanced to D55, Figure 8).",
        pane: PaneKind::RENDER,
        start: Start::Paper,
        actions: |_| vec![Action::Render(RenderAction::Figure8)],
    },
    Template {
        name: "Colorimetry",
        summary: Start::Colorimetry.why(),
        pane: PaneKind::CHROMATICITY,
        start: Start::Colorimetry,
        actions: |_| Vec::new(),
    },
    Template {
        name: "White balance across daylight",
        summary: "Balance fixed at daylight of 5500 K, light along the daylight locus: drag the temperature.",
        pane: PaneKind::CHROMATICITY,
        start: Start::Paper,
        actions: |document| {
            vec![
                Action::Scene(SceneAction::SetTemperature(6504.0)),
                Action::Scene(SceneAction::SetLight(Light::Daylight)),
                Action::Scene(SceneAction::SetWhite(WhiteBalanceChoice::Daylight(5500.0))),
                overlays(Overlays { daylight: true, whites: true, ..document.overlays }),
            ]
        },
    },
    Template {
        name: "Best camera for skin",
        summary: "All cameras ranked by ΔE*00 over the skin of 100 people (NIST) under D65, each fitted to CIE 1931.",
        pane: PaneKind::METRICS,
        start: Start::Colorimetry,
        actions: |_| {
            let Some(set) = skin() else { return Vec::new() };
            let name = set.name.clone();
            let sets = vec![set];
            [
                ImportedAction::Import { sets, built_in: BuiltInNames::default() },
                ImportedAction::Use(SetKind::Chart, name),
            ]
            .map(Action::Imported)
            .into()
        },
    },
    Template {
        name: "Will a matrix fix it?",
        summary: "Fitted 3×3 matrices and the spectral loci of the cameras: errors that no matrix can correct.",
        pane: PaneKind::CORRECTION,
        start: Start::Colorimetry,
        actions: |document| vec![overlays(Overlays { camera_spectral_loci: true, ..document.overlays })],
    },
];

fn overlays(overlays: Overlays) -> Action {
    Action::Scene(SceneAction::SetOverlays(overlays))
}

/// Measured skins, as one set of patches.
fn skin() -> Option<ImportedSet> {
    let text = chromascope_data::text("materials/skin_nist.csv")?;
    let set = import("skin_nist.csv", text.as_bytes(), Some(Role::Reflectance)).ok()?.set;
    Some(ImportedSet { name: "Skin of 100 people (NIST)".to_owned(), ..set })
}

impl Template {
    pub fn document(&self) -> Document {
        let mut document = self.start.document();
        for action in (self.actions)(&document) {
            action.apply(&mut document);
        }
        document
    }
}
