//! The chromaticity diagram while it is drawn: coordinates of colors, their positions in the plot, and texts: what is named first,
//! and how a line's name is told from another line's.

use std::collections::BTreeSet;

use chromascope_core::colorimetry::{UvPrime, Xy};
use chromascope_figure::{InkRole, Label, Labels, Mark, Panel, Place, Projection, TextSize, fit_equal};

use super::shown::Ranges;
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
        place(self.diagram, Some(xy), xy.uv_prime())
    }

    pub(super) fn place_of(&self, xy: Option<Xy>, uv: Option<UvPrime>) -> Option<[f64; 2]> {
        place(self.diagram, xy, uv)
    }
}

pub fn id(source: &ComparedSensor) -> SensorId {
    SensorId { kind: source.kind, name: source.name.clone() }
}

/// Least coordinate that is shown: no color has less than 0.
pub(super) const LEAST: f64 = -0.02;

/// Coordinates of a color that is known in both diagrams.
pub(super) fn place(diagram: Diagram, xy: Option<Xy>, uv: Option<UvPrime>) -> Option<[f64; 2]> {
    match diagram {
        Diagram::Xy => xy.map(|xy| [xy.x, xy.y]),
        Diagram::UvPrime => uv.map(|uv| [uv.u, uv.v]),
    }
}

/// Map from coordinates to points of the plot, y downward.
#[derive(Clone, Copy, Debug)]
pub(super) struct Frame {
    pub(super) ranges: Ranges,
    pub(super) size: [f64; 2],
}

impl Frame {
    /// The frame that shows all of `ranges` in a panel of the given size: equal units on both axes, nothing below −0.02.
    pub(super) fn around(shown: Ranges, panel: [f64; 2]) -> Self {
        let Self { ranges, size } = Self::centered(shown, panel);
        let ranges = ranges.map(|[low, high]| {
            let up = (LEAST - low).max(0.0);
            [low + up, high + up]
        });
        Self { ranges, size }
    }

    /// The frame that shows all of `ranges` in the middle of a panel of the given size, with equal units on both axes.
    pub(super) fn centered([x, y]: Ranges, panel: [f64; 2]) -> Self {
        let size = [panel[0] - Projection::LEFT - 1.0, panel[1] - Projection::BOTTOM - 1.0].map(|side| side.max(1.0));
        let (x, y) = fit_equal(x, y, size);
        Self { ranges: [x, y], size }
    }

    /// Points for each unit.
    pub(super) fn scale(&self) -> f64 {
        self.size[0] / (self.ranges[0][1] - self.ranges[0][0])
    }

    /// Position in the plot.
    pub(super) fn at(&self, point: [f64; 2]) -> [f64; 2] {
        let [x, y] = self.ranges;
        let share = |value: f64, [low, high]: [f64; 2]| (value - low) / (high - low);
        [share(point[0], x) * self.size[0], (1.0 - share(point[1], y)) * self.size[1]]
    }

    /// The point at a position in the plot.
    pub(super) fn value(&self, at: [f64; 2]) -> [f64; 2] {
        let [x, y] = self.ranges;
        let value = |share: f64, [low, high]: [f64; 2]| low + share * (high - low);
        [value(at[0] / self.size[0], x), value(1.0 - at[1] / self.size[1], y)]
    }

    /// True if a position lies in the plot, at least `inset` from its edges.
    pub(super) fn contains(&self, at: [f64; 2], inset: f64) -> bool {
        [0, 1].iter().all(|&axis| at[axis] >= inset && at[axis] <= self.size[axis] - inset)
    }
}

/// Distance that sensors' names keep from markers of patches, in points.
const CLEARANCE: f64 = 8.0;
/// Distance of two lines' ends below which a name beside one could be the other's.
const CROWDED: f64 = 16.0;

/// Rank of a label: the lower one is placed first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Rank {
    /// A patch that is pointed at or chosen: never left out.
    Pointed,
    Patch,
    Light,
    White,
    Temperature,
    Sensor,
    Ground,
}

/// A small text of a rank, without a leader.
pub(super) fn label(rank: Rank, text: impl Into<String>, ink: InkRole, places: Vec<Place>) -> (Rank, Label) {
    let size = if rank <= Rank::Patch { TextSize::Body } else { TextSize::Small };
    let clearance = if rank == Rank::Sensor { CLEARANCE } else { 0.0 };
    (rank, Label { size, clearance, always: rank == Rank::Pointed, ..Label::new(text, ink, places) })
}

/// Places labels among the marks of a panel in order of rank, the reference's name before other sensors'.
pub(super) fn placed(mut all: Vec<(Rank, Label)>, panel: &Panel) -> Vec<Mark> {
    let mut labels = Labels::new(panel);
    all.sort_by_key(|(rank, label)| (*rank, label.ink.role != InkRole::Reference));
    let end = |label: &Label| Some(labels.projection().at(*label.starts.last()?));
    let sensors = all.iter().filter(|(rank, _)| *rank == Rank::Sensor);
    let ends: Vec<[f64; 2]> = sensors.filter_map(|(_, label)| end(label)).collect();
    for (rank, label) in &mut all {
        let Some([x, y]) = end(label).filter(|_| *rank == Rank::Sensor) else { continue };
        // The reference's line is thick enough to be told by itself, but not where its name would be below another's end.
        let is_reference = label.ink.role == InkRole::Reference;
        let least = if is_reference { 4.0 * CROWDED } else { CROWDED };
        if ends.iter().filter(|end| (end[0] - x).hypot(end[1] - y) < least).count() < 2 {
            continue;
        }
        if is_reference {
            let end = label.starts.last().copied();
            label.places.retain(|place| Some(place.at) != end);
            label.clearance = 2.0 * CLEARANCE;
        } else {
            // Leaders from ends that lie close together could be each other's.
            label.starts.truncate(1);
            label.prefers_leader = true;
        }
    }
    for (_, label) in &all {
        labels.place(label);
    }
    labels.into_marks()
}
