//! Start values: reciprocal temperatures over a grid of chromaticities.

use super::nearest::Vertices;
use super::pieces::Pieces;
use super::result::{COLDEST_MIRED, HOTTEST_MIRED, MAX_DUV};
use crate::colorimetry::Uv60;
use crate::math::array::each;
use crate::math::exp::ROUNDER;
use rayon::prelude::*;

/// The grid's spacing in u and v. Halving it costs the nearest cache, doubling it another step of Newton's.
const PITCH: f64 = 0.002;

/// Nearest reciprocal temperatures over a square grid around the part of the diagram in which color temperatures exist.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Start {
    corner: Uv60,
    /// The last column and row of cells.
    last: [f64; 2],
    columns: usize,
    /// Each cell's function between its corners: 1, x, y, xy.
    cells: Vec<[f32; 4]>,
}

/// A cell of the grid and where in it a color lies.
#[derive(Clone, Copy, Debug)]
pub(super) struct Place {
    pub(super) column: u32,
    pub(super) row: u32,
    pub(super) right: f64,
    pub(super) up: f64,
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
        let [columns, rows] =
            [0, 1].map(|c: usize| ((high[c] - low[c]) / PITCH).ceil().clamp(1.0, 4096.0) as usize + 2);
        let corner = Uv60 { u: low[0] - 0.5 * PITCH, v: low[1] - 0.5 * PITCH };
        let node = |index: usize| {
            let (row, column) = (index / columns, index % columns);
            let color = Uv60 { u: corner.u + column as f64 * PITCH, v: corner.v + row as f64 * PITCH };
            vertices.nearest(pieces, color).mired
        };
        let nodes: Vec<f64> = (0..rows * columns).into_par_iter().map(node).collect();
        let cell = |index: usize| {
            let first = index / (columns - 1) * columns + index % (columns - 1);
            let [a, b, c, d] = [first, first + 1, first + columns, first + columns + 1].map(|node| nodes[node]);
            [a, b - a, c - a, (d - c) - (b - a)].map(|v| v as f32)
        };
        let cells = (0..(columns - 1) * (rows - 1)).map(cell).collect();
        Self { corner, last: [(columns - 2) as f64, (rows - 2) as f64], columns: columns - 1, cells }
    }

    /// Place of a color on the grid. Colors beyond it are held at its border, and NaN at a corner: searches from there do
    /// not end near them.
    #[allow(clippy::manual_clamp, reason = "clamp keeps what is not a number")]
    #[inline(always)]
    pub(super) fn place(&self, color: Uv60) -> Place {
        let x = ((color.u - self.corner.u) * (1.0 / PITCH)).max(0.0).min(self.last[0] + 1.0);
        let y = ((color.v - self.corner.v) * (1.0 / PITCH)).max(0.0).min(self.last[1] + 1.0);
        // To the nearest, half a cell lower: that rounds down, but for the edges between two cells, where either will do.
        let column = (x - 0.5).max(0.0).min(self.last[0]) + ROUNDER;
        let row = (y - 0.5).max(0.0).min(self.last[1]) + ROUNDER;
        let (right, up) = (x - (column - ROUNDER), y - (row - ROUNDER));
        Place { column: column.to_bits() as u32 & 0xffff, row: row.to_bits() as u32 & 0xffff, right, up }
    }

    #[inline]
    pub(super) fn cell(&self, column: u32, row: u32) -> [f32; 4] {
        self.cells.get(row as usize * self.columns + column as usize).copied().unwrap_or_default()
    }
}

/// About where the nearest point lies, in mired: between the values at four corners.
#[inline(always)]
pub(super) fn between(cell: [f32; 4], right: f64, up: f64) -> f64 {
    let [a, b, c, d] = each(cell, f64::from);
    (a + right * b) + up * (c + right * d)
}
