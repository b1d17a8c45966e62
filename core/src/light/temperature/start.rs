//! Where to begin: reciprocal temperatures over a grid of chromaticities.

use rayon::prelude::*;

use super::nearest::Vertices;
use super::pieces::Pieces;
use super::{COLDEST_MIRED, HOTTEST_MIRED, MAX_DUV};
use crate::colorimetry::Uv60;

/// The grid's spacing in u and v. Halving it costs the nearest cache, doubling it another step of Newton's.
const PITCH: f64 = 0.002;

/// Nearest reciprocal temperatures on a square grid around the part of the diagram in which color temperatures exist.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Start {
    corner: Uv60,
    columns: usize,
    rows: usize,
    mired: Vec<f64>,
}

impl Start {
    pub(super) fn new(pieces: &Pieces, vertices: &Vertices) -> Self {
        let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
        let inside = |mired: f64| (HOTTEST_MIRED - 10.0..=COLDEST_MIRED + 10.0).contains(&mired);
        for piece in pieces.iter().filter(|piece| inside(piece.mired)) {
            let motion = piece.motion(0.0);
            let [du, dv] = motion.per_mired;
            let reach = (MAX_DUV + PITCH) / du.hypot(dv);
            for side in [-reach, reach] {
                for (c, value) in [motion.at.u - side * dv, motion.at.v + side * du].into_iter().enumerate() {
                    low[c] = low[c].min(value);
                    high[c] = high[c].max(value);
                }
            }
        }
        let [columns, rows] = [0, 1].map(|c: usize| ((high[c] - low[c]) / PITCH).ceil().clamp(1.0, 4096.0) as usize + 2);
        let corner = Uv60 { u: low[0] - 0.5 * PITCH, v: low[1] - 0.5 * PITCH };
        let node = |index: usize| {
            let (row, column) = (index / columns, index % columns);
            let color = Uv60 { u: corner.u + column as f64 * PITCH, v: corner.v + row as f64 * PITCH };
            vertices.nearest(pieces, color).mired
        };
        let mired = (0..rows * columns).into_par_iter().map(node).collect();
        Self { corner, columns, rows, mired }
    }

    /// About where the nearest point lies, in mired: between the values at four corners. None outside the grid and for NaN.
    #[inline]
    pub(super) fn mired(&self, color: Uv60) -> Option<f64> {
        let x = (color.u - self.corner.u) * (1.0 / PITCH);
        let y = (color.v - self.corner.v) * (1.0 / PITCH);
        // Written so that NaN falls out.
        if !(x >= 0.0 && y >= 0.0 && x < (self.columns - 1) as f64 && y < (self.rows - 1) as f64) {
            return None;
        }
        let (column, row) = (x as usize, y as usize);
        let (right, up) = (x - column as f64, y - row as f64);
        let first = row * self.columns + column;
        let [a, b] = self.mired.get(first..first + 2)? else { return None };
        let [c, d] = self.mired.get(first + self.columns..first + self.columns + 2)? else { return None };
        let (lower, upper) = (a + right * (b - a), c + right * (d - c));
        Some(lower + up * (upper - lower))
    }
}
