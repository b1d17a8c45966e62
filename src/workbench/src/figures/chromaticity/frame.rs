//! Coordinates of colors, and their positions in the plot.

use chromascope_core::colorimetry::{UvPrime, Xy};
use chromascope_figure::{Projection, fit_equal};

use super::shown::Ranges;
use crate::document::Diagram;

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
