//! The chromaticity diagram while it is drawn.

use std::collections::BTreeSet;

use chromascope_core::colorimetry::{UvPrime, Xy};
use chromascope_figure::Mark;

use crate::document::Diagram;
use crate::plot_item::{PickIndex, SensorId};
use crate::scene::{ComparedSensor, Scene};
use crate::view::View;

/// The diagram while it is drawn.
pub(super) struct Drawing<'a> {
    pub(super) scene: &'a Scene<'a>,
    pub(super) view: &'a View,
    pub(super) diagram: Diagram,
    pub(super) marks: Vec<Mark>,
    pub(super) things: PickIndex,
    pub(super) refused: Vec<String>,
    /// Places among the marks of the lines of Planckian loci.
    pub(super) loci: BTreeSet<usize>,
    /// All that the ranges have to hold.
    pub(super) data: Vec<[f64; 2]>,
}

impl Drawing<'_> {
    /// Coordinates of a chromaticity in the chosen diagram.
    pub(super) fn place(&self, xy: Xy) -> Option<[f64; 2]> {
        match self.diagram {
            Diagram::Xy => Some([xy.x, xy.y]),
            Diagram::UvPrime => xy.uv_prime().map(|uv| [uv.u, uv.v]),
        }
    }

    /// Coordinates of a color that is known in both diagrams.
    pub(super) fn place_of(&self, xy: Option<Xy>, uv: Option<UvPrime>) -> Option<[f64; 2]> {
        match self.diagram {
            Diagram::Xy => xy.map(|xy| [xy.x, xy.y]),
            Diagram::UvPrime => uv.map(|uv| [uv.u, uv.v]),
        }
    }
}

/// A sensor's identity.
pub(crate) fn id(source: &ComparedSensor) -> SensorId {
    SensorId { kind: source.kind, name: source.name.clone() }
}
