//! The tour: the paper's findings in five scenes, each set up by actions on a document of its own.

use chromascope_core::colorimetry::Metric;

use crate::action::{Action, CompareAction, RenderAction, SceneAction};
use crate::document::imported::ImportedSet;
use crate::document::start::Start;
use crate::document::{CIE_1931, Document, Light, TransformChoice};
use crate::plot_item::PlotItem;
use crate::workspaces::{PaneKind, Workspace};
use chromascope_core::query::Shared;

pub struct TourStep {
    pub title: &'static str,
    /// What to look at, and why it is so.
    pub text: &'static str,
    /// Numbers of the scene that are written below the text.
    pub numbers: TourNumbers,
    pub workspace: Workspace,
    pub maximized: Option<PaneKind>,
    /// Patch that is selected through all sensors.
    pub patch: Option<&'static str>,
    actions: fn() -> Vec<Action>,
}

/// Numbers that a step computes from its scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TourNumbers {
    LocusLengths,
    /// Temperature at which each locus is nearest to the reference's.
    NearestTemperatures,
    PatchDifferences,
    /// Difference of the rendered material facing the light, for each camera.
    RenderedDifferences,
}

pub const STEPS: [TourStep; 5] = [
    TourStep {
        title: "Each camera has its own locus of blackbodies",
        text: "The thick line is the reference observer's, from 20000 K at the left to 1000 K at the right; colored lines \
               are the cameras'. The shorter a locus, the less a camera tells light sources apart: the Kodak's is the shortest.",
        numbers: TourNumbers::LocusLengths,
        workspace: Workspace::Compare,
        maximized: None,
        patch: None,
        actions: Vec::new,
    },
    TourStep {
        title: "Near daylight they agree",
        text: "The strip at the bottom is each camera's distance from the reference over temperature, with a ring at the \
               minimum. All minima lie near daylight because signals are normalized to equal energy; they follow the normalization.",
        numbers: TourNumbers::NearestTemperatures,
        workspace: Workspace::Compare,
        maximized: Some(PaneKind::CHROMATICITY),
        patch: None,
        actions: || vec![Action::Scene(SceneAction::SetTemperature(5950.0))],
    },
    TourStep {
        title: "In the diagram, red is near the reference",
        text: "Each tail leads from a camera's patch to the reference's. Measured in xy, red and orange yellow are nearer \
               than green and blue for Canon and Nikon.",
        numbers: TourNumbers::PatchDifferences,
        workspace: Workspace::Compare,
        maximized: None,
        patch: Some("red"),
        actions: || vec![Action::Scene(SceneAction::SetDifference(Metric::XY))],
    },
    TourStep {
        title: "To the eye, red is the farthest",
        text: "The same patches under D65, with cameras fitted to CIE 1931 by 3×3 matrices. By ΔE*00, which weighs \
               differences as the eye does, red is now the worst.",
        numbers: TourNumbers::PatchDifferences,
        workspace: Workspace::Compare,
        maximized: None,
        patch: Some("red"),
        actions: || {
            let name = CIE_1931.to_owned();
            vec![
                Action::Scene(SceneAction::SetWay(TransformChoice::Observer(name.clone()))),
                Action::Compare(CompareAction::SetReference { name, counts_in_xyz: true }),
                Action::Scene(SceneAction::SetLight(Light::Set("D65".to_owned()))),
                Action::Scene(SceneAction::SetDifference(Metric::DELTA_E_2000)),
            ]
        },
    },
    TourStep {
        title: "Skin in sunlight",
        text: "The paper's Figure 8: a head of measured skin under the direct sun, rendered through each camera. Canon and \
               Nikon are nearest to the reference; the Kodak's skin is brighter and less saturated. Drag to turn the heads.",
        numbers: TourNumbers::RenderedDifferences,
        workspace: Workspace::Render,
        maximized: None,
        patch: None,
        actions: || vec![Action::Render(RenderAction::Figure8)],
    },
];

impl TourStep {
    /// The document of the scene; imported sets stay at hand.
    pub fn document(&self, own: &[Shared<ImportedSet>]) -> Document {
        let mut document = Document { own: own.to_vec(), ..Start::Paper.document() };
        for action in (self.actions)() {
            action.apply(&mut document);
        }
        document
    }

    pub fn selected(&self) -> Option<PlotItem> {
        self.patch.map(|patch| PlotItem::Patch { source: None, patch: patch.to_owned() })
    }
}
