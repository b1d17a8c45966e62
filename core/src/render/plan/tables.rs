//! What tables are made of: splines of the highest degree through few sums over wavelengths, as exact as the tables they are for.

use super::check::Check;
use super::cost;
use super::extent::Extent;
use super::surface::Surface;
use super::table::{SPARE, Size, Table};
use crate::reflectance::Precision;
use crate::render::diffuse::by_nodes;
use crate::render::measure::{Measure, Node};

/// The finest table: cells of 1/320.
const LAST_STEP: u32 = 36;
/// The largest: 32 MB.
const MOST_CELLS: usize = 1 << 20;
/// The most wavelengths.
const MOST_NODES: usize = 24;
/// No sum over wavelengths need be more exact.
const SMALLEST: f64 = 1e-13;
/// From so many digits on S is made in full.
const FULL: f64 = 8.0;

/// All splines of a measure that tables are made of, each made when it is asked for.
pub(super) struct Makings<'a> {
    measure: &'a Measure,
    check: &'a Check,
    extent: Extent,
    /// What so many wavelengths are off by, from none on.
    node_errors: Vec<f64>,
    made: Vec<Made>,
}

/// A spline through sums over so many wavelengths.
struct Made {
    step: u32,
    count: usize,
    nodes: Vec<Node>,
    surface: Surface,
}

impl<'a> Makings<'a> {
    pub(super) fn new(measure: &'a Measure, check: &'a Check, kappa: [f64; 2]) -> Self {
        Self { measure, check, extent: Extent::new(kappa), node_errors: Vec::new(), made: Vec::new() }
    }

    /// The tables of a degree, from a step on, each finer than the one before.
    pub(super) fn sizes(&self, degree: usize, from: u32) -> impl Iterator<Item = Size> {
        let size = move |step| Size::new(&self.extent, degree, step);
        (from..=LAST_STEP).map(size).take_while(|size| size.count() <= MOST_CELLS)
    }

    /// A table.
    pub(super) fn table(&mut self, size: &Size) -> Table {
        let source = size.source(&self.extent);
        let count = self.nodes(size);
        let found = self
            .made
            .iter()
            .position(|made| made.surface.degree == source.degree && made.step == source.step && made.count == count);
        let index = found.unwrap_or_else(|| {
            let nodes = self.measure.shared(count);
            let surface = Surface::filled(&self.extent, source.degree, source.intervals, &nodes, precision(size));
            self.made.push(Made { step: source.step, count, nodes, surface });
            self.made.len() - 1
        });
        let Made { nodes, surface: made, .. } = &self.made[index];
        let same = (source.degree, source.step) == (size.degree, size.step);
        let surface = if same { made.clone() } else { made.resampled(size.degree, size.intervals) };
        Table::new(&self.extent, surface, nodes.clone())
    }

    /// How many wavelengths a table is made of, and what making it costs in nanoseconds.
    pub(super) fn cost(&mut self, size: &Size) -> (usize, f64) {
        let source = size.source(&self.extent);
        let nodes = self.nodes(size);
        let sums = (nodes * source.count()) as f64 * cost::sum_ns(precision(size));
        (nodes, sums + size.count() as f64 * cost::PLACE_NS)
    }

    /// The fewest wavelengths whose error at a few places is small enough.
    fn nodes(&mut self, size: &Size) -> usize {
        let target = 10_f64.powf(-size.digits() - SPARE).max(SMALLEST);
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
                count => {
                    let nodes = self.measure.shared(count);
                    self.check.error_of_few(|kappa, beta| by_nodes(&nodes, kappa, beta, Precision::Full))
                }
            };
            self.node_errors.push(error);
        }
        self.node_errors[count]
    }
}

fn precision(size: &Size) -> Precision {
    if size.digits() > FULL { Precision::Full } else { Precision::Fine }
}
