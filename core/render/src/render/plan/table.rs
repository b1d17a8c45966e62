//! ln J over (ln κ, v) by splines of odd degree, as fine as is wanted.

use super::extent::Extent;
use super::method::IntegrationMethod;
use super::spline::{BLOCK, weights};
use super::surface::{Cell, Surface};
use crate::render::measure::Node;
use chromascope_math::array::{array, each};
use chromascope_math::exp::ROUNDER;

/// A table's fineness: each fourth step halves its cells.
#[derive(Clone, Copy, Debug)]
pub(super) struct Size {
    pub(super) degree: usize,
    /// Intervals along ln κ and along v.
    pub(super) intervals: [usize; 2],
    pub(super) step: u32,
}

/// The steps of the coarsest table, in ln κ and in ln(1 + β).
const COARSEST: f64 = 1.6;
/// Cells get longer along v than along κ: where v is stretched most there is least to see.
const ALONG_V: f64 = 1.0;

impl Size {
    /// The size of a table after `step` times making its cells smaller.
    pub(super) fn new(extent: &Extent, degree: usize, step: u32) -> Self {
        let h = side(step);
        let lengths = extent.lengths();
        let along = |length: f64, h: f64| (length / h).ceil().max(2.0) as usize;
        Self { degree, intervals: [along(lengths[0], h), along(lengths[1], ALONG_V * h)], step }
    }

    /// To how many digits the spline is likely to be right, relative to the peak: as it was found for a camera.
    pub(super) fn digits(&self) -> f64 {
        let x = -side(self.step).log2();
        match self.degree {
            3 => 1.73 + 1.32 * x,
            5 => 1.16 + 2.2 * x,
            7 => 3.2 * x - 0.18,
            _ => 2.71 + (x - 0.54) * x.max(0.54),
        }
    }

    pub(super) fn places(&self) -> [usize; 2] {
        self.intervals.map(|count| count + self.degree)
    }

    pub(super) fn count(&self) -> usize {
        self.places().into_iter().product()
    }

    pub(super) fn method(&self, nodes: usize) -> IntegrationMethod {
        let [kappas, betas] = self.places();
        IntegrationMethod::Table { degree: self.degree, kappas, betas, nodes }
    }
}

fn side(step: u32) -> f64 {
    COARSEST * (-0.25 * f64::from(step)).exp2()
}

#[derive(Clone, Debug, PartialEq)]
pub(super) struct Table {
    extent: Extent,
    surface: Surface,
    nodes: Vec<Node>,
}

impl Table {
    /// A spline to be read, made of these wavelengths.
    pub(super) fn new(extent: &Extent, surface: Surface, nodes: Vec<Node>) -> Self {
        Self { extent: *extent, surface, nodes }
    }

    /// The wavelengths that it is made of.
    pub(super) fn nodes(&self) -> &[Node] {
        &self.nodes
    }

    pub(super) fn bytes(&self) -> usize {
        size_of_val(self.surface.cells.as_slice())
    }

    pub(super) fn degree(&self) -> usize {
        self.surface.degree
    }

    pub(super) fn method(&self) -> IntegrationMethod {
        let [kappas, betas] = self.surface.intervals.map(|count| count + self.surface.degree);
        IntegrationMethod::Table { degree: self.surface.degree, kappas, betas, nodes: self.nodes.len() }
    }

    pub(super) fn holds(&self, kappa: f64) -> bool {
        self.extent.kappa[0] <= kappa && kappa <= self.extent.kappa[1]
    }

    pub(super) fn kappa(&self) -> [f64; 2] {
        self.extent.kappa
    }

    /// Between how many knots it lies along v.
    pub(super) fn intervals(&self) -> usize {
        self.surface.intervals[1]
    }

    #[inline]
    fn width(&self) -> usize {
        self.surface.intervals[1] + self.surface.degree
    }

    /// Places of a block of samples between the knots.
    #[inline(always)]
    pub(super) fn around<const N: usize>(&self, kappa: &[f64; BLOCK], beta: &[f64; BLOCK], around: &mut Around<N>) {
        let (mut t, mut s, width) = ([0.0; BLOCK], [0.0; BLOCK], self.width() as f64);
        let [rows, columns] = each(self.surface.intervals, |count| count as f64);
        for i in 0..BLOCK {
            let [place, v] = self.extent.place(kappa[i], beta[i]);
            let (x, y) = (0.5 * rows * (place + 1.0), columns * v);
            let (row, column) = (cell(x, rows), cell(y, columns));
            (around.v[i], t[i], s[i]) = (v, 2.0 * (x - row) - 1.0, 2.0 * (y - column) - 1.0);
            // An integer, in the low bits of its mantissa.
            around.start[i] = (row * width + column + ROUNDER).to_bits() as u32;
        }
        weights(&t, &mut around.across);
        weights(&s, &mut around.along);
    }

    /// A cell between the knots; v from 0 to 1.
    #[inline(always)]
    pub(super) fn read<const N: usize>(&self, around: &Around<N>, i: usize) -> Cell {
        let along: [f64; N] = array(|k| around.along[k][i]);
        let cells = self.surface.cells.get(around.start[i] as usize..).unwrap_or_default();
        let width = self.width();
        let mut mixed = [0.0; 4];
        for (place, across) in around.across.iter().enumerate() {
            let Some(row) = cells.get(place * width..).and_then(|row| row.first_chunk::<N>()) else { return mixed };
            let mut line = [0.0; 4];
            for k in 0..N {
                for lane in 0..4 {
                    line[lane] += along[k] * row[k][lane];
                }
            }
            for lane in 0..4 {
                mixed[lane] += across[i] * line[lane];
            }
        }
        mixed
    }
}

/// Places of a block of samples between the knots of a table.
pub(super) struct Around<const N: usize> {
    /// v, above 1 where it is dark.
    pub(super) v: [f64; BLOCK],
    /// The first of the coefficients that each is made of.
    start: [u32; BLOCK],
    /// Their weights along ln κ and along v.
    across: [[f64; BLOCK]; N],
    along: [[f64; BLOCK]; N],
}

impl<const N: usize> Around<N> {
    pub(super) const NOTHING: Self =
        Self { v: [0.0; BLOCK], start: [0; BLOCK], across: [[0.0; BLOCK]; N], along: [[0.0; BLOCK]; N] };
}

/// The cell of a place, not beyond the last. Which of two cells a knot belongs to does not matter.
#[inline(always)]
fn cell(place: f64, count: f64) -> f64 {
    let nearest = place - 0.5 + ROUNDER - ROUNDER;
    nearest.max(0.0).min(count - 1.0)
}
