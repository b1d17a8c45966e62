//! The chromaticity diagram while it is drawn.

use std::collections::BTreeSet;

use chromascope_core::colorimetry::{UvPrime, Xy};
use chromascope_figure::{Label, Mark};

use super::frame::{self, Frame};
use super::labels::Rank;
use crate::document::Diagram;
use crate::figures::look::FigureLook;
use crate::plot_item::{PickIndex, SensorId};
use crate::scene::{ComparedSensor, Scene};

pub(super) struct Drawing<'a> {
    pub(super) scene: &'a Scene<'a>,
    pub(super) look: &'a FigureLook,
    pub(super) diagram: Diagram,
    pub(super) frame: Frame,
    /// True if a lens shows the data: they are only hinted at here.
    pub(super) sketch: bool,
    /// Areas and lines, drawn first.
    pub(super) marks: Vec<Mark>,
    /// Patches, over the lines.
    pub(super) points: Vec<Mark>,
    /// Small marks, over the patches.
    pub(super) small: Vec<Mark>,
    /// Texts, over all.
    pub(super) labels: Vec<(Rank, Label)>,
    pub(super) things: PickIndex,
    /// Positions of the markers halfway along the lines.
    pub(super) halfway: Vec<[f64; 2]>,
    pub(super) refused: Vec<String>,
    /// Places among the marks of the lines of Planckian loci.
    pub(super) loci: BTreeSet<usize>,
}

impl<'a> Drawing<'a> {
    pub(super) fn new(scene: &'a Scene<'a>, look: &'a FigureLook, frame: Frame, sketch: bool) -> Self {
        Self {
            scene,
            look,
            diagram: scene.document.diagram,
            frame,
            sketch,
            marks: Vec::new(),
            points: Vec::new(),
            small: Vec::new(),
            labels: Vec::new(),
            things: PickIndex::default(),
            halfway: Vec::new(),
            refused: Vec::new(),
            loci: BTreeSet::new(),
        }
    }

    /// Coordinates of a chromaticity in the chosen diagram.
    pub(super) fn place(&self, xy: Xy) -> Option<[f64; 2]> {
        frame::place(self.diagram, Some(xy), xy.uv_prime())
    }

    pub(super) fn place_of(&self, xy: Option<Xy>, uv: Option<UvPrime>) -> Option<[f64; 2]> {
        frame::place(self.diagram, xy, uv)
    }
}

pub fn id(source: &ComparedSensor) -> SensorId {
    SensorId { kind: source.kind, name: source.name.clone() }
}
