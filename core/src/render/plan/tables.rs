//! The series that tables are made of: each as exact as the tables it is for.

use super::check::Check;
use super::cost;
use super::extent::Extent;
use super::series::{Cell, Series, cells, places, to_coefficients};
use super::table::{Size, Table};
use crate::reflectance::Precision;
use crate::render::measure::{Measure, Node};
use rayon::prelude::*;

/// The most terms of a series along an axis, and the fewest.
const MOST_TERMS: usize = 128;
const FEWEST_TERMS: usize = 8;
/// Where its smoothness is looked at: lines along each axis, in parts of the other.
const LINES: [f64; 4] = [0.0, 0.35, 0.7, 1.0];
/// By how many wavelengths.
const LINE_NODES: usize = 4;
/// The most wavelengths.
const MOST_NODES: usize = 24;
/// A series is more exact than a table is likely to be by this power of ten.
const SPARE: f64 = 1.0;
/// The powers of ten that a series is made to.
const DIGITS: [i32; 2] = [4, 13];
/// From here on S is made in full.
const FULL_DIGITS: i32 = 8;

/// All series of a measure, each made when it is asked for.
pub(super) struct Makings<'a> {
    measure: &'a Measure,
    check: &'a Check,
    extent: Extent,
    /// The largest coefficient from each on, along ln κ and along v.
    tails: [Vec<f64>; 2],
    /// What so many wavelengths are off by, from none on.
    node_errors: Vec<f64>,
    made: Vec<(i32, Vec<Node>, Series)>,
}

impl<'a> Makings<'a> {
    pub(super) fn new(measure: &'a Measure, check: &'a Check, kappa: [f64; 2]) -> Self {
        let extent = Extent::new(kappa);
        let tails = tails(&extent, &measure.shared(LINE_NODES));
        Self { measure, check, extent, tails, node_errors: Vec::new(), made: Vec::new() }
    }

    pub(super) fn size(&self, degree: usize, step: u32) -> Size {
        Size::new(&self.extent, degree, step)
    }

    /// A table.
    pub(super) fn table(&mut self, size: &Size) -> Table {
        let digits = digits(size);
        let found = self.made.iter().position(|(of, ..)| *of == digits);
        let index = found.unwrap_or_else(|| {
            let nodes = self.measure.shared(self.nodes(digits));
            let series = Series::new(&self.extent, self.terms(digits), &nodes, precision(digits));
            self.made.push((digits, nodes, series));
            self.made.len() - 1
        });
        let (_, nodes, series) = &self.made[index];
        Table::new(size, series, nodes.clone())
    }

    /// How many wavelengths a table is made of, and what making it costs in nanoseconds.
    pub(super) fn cost(&mut self, size: &Size) -> (usize, f64) {
        let digits = digits(size);
        let (nodes, [along_kappa, along_v], [kappas, betas]) = (self.nodes(digits), self.terms(digits), size.places());
        let sums = (nodes * along_kappa * along_v) as f64 * cost::sum_ns(precision(digits));
        (nodes, sums + (kappas * betas * along_kappa) as f64 * cost::TERM_NS)
    }

    /// The fewest wavelengths whose error at a few places is small enough.
    fn nodes(&mut self, digits: i32) -> usize {
        let target = 10_f64.powi(-digits);
        let mut count = 2;
        while count < MOST_NODES && self.node_error(count) > target {
            count += 1;
        }
        count
    }

    fn node_error(&mut self, count: usize) -> f64 {
        while self.node_errors.len() <= count {
            let error = match self.node_errors.len() {
                0 | 1 => f64::INFINITY,
                count => self.check.error_of_nodes(&self.measure.shared(count)),
            };
            self.node_errors.push(error);
        }
        self.node_errors[count]
    }

    fn terms(&self, digits: i32) -> [usize; 2] {
        let target = 10_f64.powi(-digits);
        [0, 1].map(|axis: usize| self.tails[axis].partition_point(|&tail| tail > target).max(FEWEST_TERMS))
    }
}

/// To which power of ten the series is made that a table is made of.
fn digits(size: &Size) -> i32 {
    ((size.digits() + SPARE).ceil() as i32).clamp(DIGITS[0], DIGITS[1])
}

fn precision(digits: i32) -> Precision {
    if digits > FULL_DIGITS { Precision::Full } else { Precision::Fine }
}

/// How the coefficients fall along both axes, the largest of some lines.
fn tails(extent: &Extent, nodes: &[Node]) -> [Vec<f64>; 2] {
    let (at, matrix) = (places(MOST_TERMS), to_coefficients(MOST_TERMS));
    let line = |&(axis, share): &(usize, f64)| -> Vec<Cell> {
        let other = 2.0 * share - 1.0;
        if axis == 0 {
            at.iter().flat_map(|&t| cells(extent, t, &[other], nodes, Precision::Full)).collect()
        } else {
            cells(extent, other, &at, nodes, Precision::Full)
        }
    };
    let all: Vec<(usize, f64)> = [0, 1].into_iter().flat_map(|axis| LINES.map(|share| (axis, share))).collect();
    let size = |line: Vec<Cell>| -> Vec<f64> {
        let of = |row: &Vec<f64>| {
            (0..4).map(|lane| row.iter().zip(&line).map(|(w, c)| w * c[lane]).sum::<f64>().abs()).fold(0.0, f64::max)
        };
        matrix.iter().map(of).collect()
    };
    let sizes: Vec<Vec<f64>> = all.par_iter().map(|of| size(line(of))).collect();
    [0, 1].map(|axis: usize| {
        let mut tail = vec![0.0_f64; MOST_TERMS];
        for size in &sizes[axis * LINES.len()..(axis + 1) * LINES.len()] {
            tail.iter_mut().zip(size).for_each(|(tail, size)| *tail = tail.max(*size));
        }
        for k in (1..MOST_TERMS).rev() {
            tail[k - 1] = tail[k - 1].max(tail[k]);
        }
        tail
    })
}
