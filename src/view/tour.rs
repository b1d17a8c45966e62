//! The tours: the program's places, and the paper's findings, in scenes that are set up by actions on a document of their own.

use chromascope_core::colorimetry::Metric;
use chromascope_core::query::Shared;
use chromascope_text::choices;

use crate::action::{Action, CompareAction, RenderAction, SceneAction};
use crate::document::imported::ImportedSet;
use crate::document::start::Start;
use crate::document::{CIE_1931, Document, Light, SetKind, TransformChoice};
use crate::plot_item::PlotItem;
use crate::workspaces::PaneKind;

pub struct TourStep {
    pub title: &'static str,
    /// What to look at, and why it is so.
    pub text: &'static str,
    /// Numbers of the scene that are written below the text.
    pub numbers: TourNumbers,
    /// Pane that is shown in any case.
    pub pane: PaneKind,
    pub maximized: Option<PaneKind>,
    /// True if the pane is shown as the printed page.
    pub is_printed: bool,
    /// Patch that is selected through all sensors.
    pub patch: Option<&'static str>,
    actions: fn() -> Vec<Action>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TourNumbers {
    None,
    /// Mean difference of the patches through each camera.
    MeanDifferences,
    LocusLengths,
    /// Temperature at which each locus is nearest to the reference's.
    NearestTemperatures,
    PatchDifferences,
    /// Difference of the rendered material facing the light, for each camera.
    RenderedDifferences,
}

choices! {
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum Tour {
        Program = "program", "Tour of the program", "Open, compare, rank, correct, print";
        Paper = "paper", "Tour of the paper", "What the paper found, on live data";
    }
}

impl Tour {
    pub const fn steps(self) -> &'static [TourStep] {
        match self {
            Self::Program => &PROGRAM,
            Self::Paper => &PAPER,
        }
    }

    const fn start(self) -> Start {
        match self {
            Self::Program => Start::Colorimetry,
            Self::Paper => Start::Paper,
        }
    }

    /// The document of a step; imported sets stay at hand.
    pub fn document(self, step: &TourStep, own: &[Shared<ImportedSet>]) -> Document {
        let mut document = Document { own: own.to_vec(), ..self.start().document() };
        for action in (step.actions)() {
            action.apply(&mut document);
        }
        document
    }
}

const STEP: TourStep = TourStep {
    title: "",
    text: "",
    numbers: TourNumbers::MeanDifferences,
    pane: PaneKind::CHROMATICITY,
    maximized: None,
    is_printed: false,
    patch: None,
    actions: added,
};

const ADDED: &str = "Nikon D3300";

fn added() -> Vec<Action> {
    vec![Action::Compare(CompareAction::Add(SetKind::Camera, ADDED.to_owned()))]
}

const PROGRAM: [TourStep; 5] = [
    TourStep {
        title: "Data: open a file",
        text: "Ctrl+O, or drop files on the window. Data lists every set with its source, yours first, and beside it how a \
               file was read, to be checked. Nothing is changed until you use a set as light, filter, patches or camera.",
        numbers: TourNumbers::None,
        pane: PaneKind::LIBRARY,
        actions: Vec::new,
        ..STEP
    },
    TourStep {
        title: "Compare: add a camera",
        text: "Add camera, at the left, finds any camera by a part of its name; the Nikon D3300 was just added. The list is \
               the legend of all views and has each camera's mean difference. The sentence at the top says under which conditions.",
        ..STEP
    },
    TourStep {
        title: "Rank: which camera?",
        text: "Every camera by any figure of merit, with its uncertainty; a rank is a range where cameras cannot be told \
               apart. A click opens the camera's page beside it; Against sets two cameras side by side.",
        pane: PaneKind::METRICS,
        ..STEP
    },
    TourStep {
        title: "Rank, Matrix: what corrects a camera?",
        text: "The color correction of one camera under this light, with the differences that it leaves. It is saved as DCP, \
               ICC, CLF or plain numbers.",
        pane: PaneKind::CORRECTION,
        ..STEP
    },
    TourStep {
        title: "A figure to print",
        text: "Ctrl+E shows a view as it will be printed, in true size, and saves PDF, SVG, PNG or its numbers. File > Report \
               puts the whole comparison on one page to send.",
        is_printed: true,
        ..STEP
    },
];

const PAPER: [TourStep; 5] = [
    TourStep {
        title: "Each camera has its own locus of blackbodies",
        text: "The thick line is the reference observer's, from 20000 K at the left to 1000 K at the right; colored lines \
               are the cameras'. The shorter a locus, the less a camera tells light sources apart: the Kodak's is the shortest.",
        numbers: TourNumbers::LocusLengths,
        actions: Vec::new,
        ..STEP
    },
    TourStep {
        title: "Near daylight they agree",
        text: "The strip at the bottom is each camera's distance from the reference over temperature, with a ring at the \
               minimum. All minima lie near daylight because signals are normalized to equal energy; they follow the normalization.",
        numbers: TourNumbers::NearestTemperatures,
        maximized: Some(PaneKind::CHROMATICITY),
        actions: || vec![Action::Scene(SceneAction::SetTemperature(5950.0))],
        ..STEP
    },
    TourStep {
        title: "In the diagram, red is near the reference",
        text: "Each tail leads from a camera's patch to the reference's. Measured in xy, red and orange yellow are nearer \
               than green and blue for Canon and Nikon.",
        numbers: TourNumbers::PatchDifferences,
        patch: Some("red"),
        actions: || vec![Action::Scene(SceneAction::SetDifference(Metric::XY))],
        ..STEP
    },
    TourStep {
        title: "To the eye, red is the farthest",
        text: "The same patches under D65, with cameras fitted to CIE 1931 by 3×3 matrices. By ΔE*00, which weighs \
               differences as the eye does, red is now the worst.",
        numbers: TourNumbers::PatchDifferences,
        patch: Some("red"),
        actions: || {
            let name = CIE_1931.to_owned();
            vec![
                Action::Scene(SceneAction::SetTransform(TransformChoice::Observer(name.clone()))),
                Action::Compare(CompareAction::SetReference { name, counts_in_xyz: true }),
                Action::Scene(SceneAction::SetLight(Light::Set("D65".to_owned()))),
                Action::Scene(SceneAction::SetDifference(Metric::DELTA_E_2000)),
            ]
        },
        ..STEP
    },
    TourStep {
        title: "Skin in sunlight",
        text: "The paper's Figure 8: a head of measured skin under the direct sun, rendered through each camera. Canon and \
               Nikon are nearest to the reference; the Kodak's skin is brighter and less saturated. Drag to turn the heads.",
        numbers: TourNumbers::RenderedDifferences,
        pane: PaneKind::RENDER,
        actions: || vec![Action::Render(RenderAction::Figure8)],
        ..STEP
    },
];

impl TourStep {
    pub fn selected(&self) -> Option<PlotItem> {
        self.patch.map(|patch| PlotItem::Patch { source: None, patch: patch.to_owned() })
    }
}
