//! Sources of tables: splines of the highest degree through few sums over wavelengths, as exact as the tables need.

use super::candidate::Candidate;
use super::check::Check;
use super::cost;
use super::extent::Extent;
use super::surface::Surface;
use super::table::{Size, Table};
use crate::reflectance::Precision;
use crate::render::diffuse::by_nodes;
use crate::render::measure::{Node, SpectralWeights};

/// The degree of what tables are made of.
const DEGREE: usize = 9;
/// The finest table: cells of 1/320.
const LAST_STEP: u32 = 36;
/// The largest: 32 MB.
const MOST_CELLS: usize = 1 << 20;
const MOST_NODES: usize = 24;
/// Minimum number of digits by which a table's data are more accurate than the table.
const SPARE: f64 = 0.6;
/// To how many digits that is; not to any, so that tables share it.
const LEVELS: [f64; 8] = [4.0, 5.5, 7.0, 8.5, 10.0, 11.0, 12.0, 13.0];
/// Number of digits from which on S is computed in full precision.
const FULL: f64 = 9.0;

/// All splines of a measure for tables, each computed at first use. A table's contents do not depend on the order of use.
pub(super) struct Makings<'a> {
    measure: &'a SpectralWeights,
    check: &'a Check,
    extent: Extent,
    /// Errors of sums over N wavelengths, from N = 0 on.
    node_errors: Vec<f64>,
    made: Vec<Made>,
}

/// A spline of degree 9 through sums over wavelengths.
struct Made {
    level: f64,
    step: u32,
    nodes: Vec<Node>,
    surface: Surface,
}

impl<'a> Makings<'a> {
    pub(super) fn new(measure: &'a SpectralWeights, check: &'a Check, kappa: [f64; 2]) -> Self {
        Self { measure, check, extent: Extent::new(kappa), node_errors: Vec::new(), made: Vec::new() }
    }

    /// The tables of a degree, from a step on, each finer than the one before.
    pub(super) fn sizes(&self, degree: usize, from: u32) -> impl Iterator<Item = Size> {
        let size = move |step| Size::new(&self.extent, degree, step);
        (from..=LAST_STEP).map(size).take_while(|size| size.count() <= MOST_CELLS)
    }

    pub(super) fn table(&mut self, size: &Size) -> Table {
        let (level, source) = (level(size), self.source(size));
        let found = self.made.iter().position(|made| (made.level, made.step) == (level, source.step));
        let index = found.unwrap_or_else(|| {
            let nodes = self.measure.shared(self.nodes(level));
            let surface = Surface::filled(&self.extent, DEGREE, source.intervals, &nodes, precision(level));
            self.made.push(Made { level, step: source.step, nodes, surface });
            self.made.len() - 1
        });
        let Made { nodes, surface, .. } = &self.made[index];
        let surface =
            if size.degree == DEGREE { surface.clone() } else { surface.resampled(size.degree, size.intervals) };
        Table::new(&self.extent, surface, nodes.clone())
    }

    /// Number of wavelengths a table is made of, and what making it costs in nanoseconds.
    fn cost(&mut self, size: &Size) -> (usize, f64) {
        let (level, source) = (level(size), self.source(size));
        let nodes = self.nodes(level);
        let sums = (nodes * source.count()) as f64 * cost::sum_ns(precision(level));
        (nodes, sums + size.count() as f64 * cost::PLACE_NS)
    }

    /// A table that is not made yet, as a candidate.
    pub(super) fn candidate(&mut self, size: &Size) -> Candidate {
        let (nodes, making_ns) = self.cost(size);
        Candidate { making_ns, ..Candidate::unseen(size.method(nodes)) }
    }

    /// Source of the table: one of degree 9 itself, others another that is more exact.
    fn source(&self, size: &Size) -> Size {
        let exact = |source: &Size| source.digits() >= level(size);
        if size.degree == DEGREE { *size } else { self.sizes(DEGREE, 0).find(exact).unwrap_or(*size) }
    }

    /// The fewest wavelengths whose error at a few places is small enough.
    fn nodes(&mut self, level: f64) -> usize {
        let target = 10_f64.powf(-level);
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

/// To how many digits a table's source is made.
fn level(size: &Size) -> f64 {
    let wanted = size.digits() + SPARE;
    LEVELS.into_iter().find(|&level| level >= wanted).unwrap_or(LEVELS[LEVELS.len() - 1])
}

fn precision(level: f64) -> Precision {
    if level > FULL { Precision::Full } else { Precision::Fine }
}
