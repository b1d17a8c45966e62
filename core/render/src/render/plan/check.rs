//! Fixed set of (κ, β) with reference values of the integral, against which every method is checked.

use super::domain::{Demand, beta_at};
use super::nodes::many_by_nodes;
use super::run::{Plan, RUN};
use crate::reflectance::Precision;
use crate::render::diffuse::by_nodes;
use crate::render::measure::{Node, SpectralWeights};
use chromascope_color::accuracy::RelTolerance;
use rayon::prelude::*;

/// The largest error between the points of the check is taken to be at most this much larger than at them.
pub const MARGIN: f64 = 3.0;

/// Error of the sum over all wavelengths: S at full precision.
pub(super) const REFERENCE: f64 = 1e-13;

/// Numbers of κ, and of β at each.
const KAPPAS: usize = 96;
const BETAS: usize = 16;
/// Methods whose error is smooth in κ and β, as that of sums over a few wavelengths, are checked at every third point. Strides
/// have no divisor in common with the number of β, so that every β is checked.
const SMOOTH_STRIDE: usize = 3;

/// Number of β at the least and the largest κ, and where moments begin: errors are largest in the corners.
const EDGE_BETAS: usize = 64;

/// Numbers of wavelengths that may stand for all in the check, compared with all at every 101st point.
const STAND_INS: [usize; 3] = [12, 20, 28];
const COMPARED_STRIDE: usize = 101;
/// Share of the tolerance that a stand-in may be off by.
const STAND_IN_SHARE: f64 = 1e-4;

/// Towards β = 0, where a table's error is largest, it is checked at this number of κ and at these shares of its first
/// interval.
const FIRST_KAPPAS: usize = 384;
const FIRST_SHARES: [f64; 2] = [0.02, 0.5];

/// Every 41st point shows what is far off.
const FEW_STRIDE: usize = 41;

/// A place and the integral there.
#[derive(Clone)]
pub(super) struct Point {
    pub(super) kappa: f64,
    pub(super) beta: f64,
    pub(super) exact: [f64; 3],
    pub(super) scale: f64,
}

pub(super) struct Check {
    grid: Vec<Point>,
    edges: Vec<Point>,
    /// The wavelengths that `exact` is made of.
    nodes: Vec<Node>,
    /// Error allowed of `exact`.
    reference: f64,
}

impl Check {
    /// By the sum over all wavelengths; where fewer are as good as that next to a tolerance, by those.
    pub(super) fn new(measure: &SpectralWeights, demand: Demand, tolerance: RelTolerance) -> Self {
        let few = points(measure.dense(), demand, COMPARED_STRIDE);
        let slack = (STAND_IN_SHARE * tolerance.max_relative_error()).max(REFERENCE);
        for count in STAND_INS {
            let nodes = measure.shared(count);
            let off = |point: &Point| off(point, by_nodes(&nodes, point.kappa, point.beta, Precision::Full));
            let apart = few.par_iter().map(off).reduce(|| 0.0, f64::max);
            if apart <= slack {
                return Self::by(nodes, demand, MARGIN * apart + REFERENCE);
            }
        }
        Self::by(measure.dense().to_vec(), demand, REFERENCE)
    }

    fn by(nodes: Vec<Node>, demand: Demand, reference: f64) -> Self {
        let grid = points(&nodes, demand, 1);
        let edges = demand.kappa().map(|kappa| edge(&nodes, kappa)).into_iter().flatten().collect();
        Self { grid, edges, nodes, reference }
    }

    /// The largest error of a method that is smooth in κ and β, over the points for which `asked` holds, without
    /// margin.
    pub(super) fn error(&self, asked: impl Fn(f64) -> bool + Sync, way: impl Fn(f64, f64) -> [f64; 3] + Sync) -> f64 {
        let points = self.grid.par_iter().step_by(SMOOTH_STRIDE).chain(&self.edges);
        points
            .filter(|point| asked(point.kappa))
            .map(|point| off(point, way(point.kappa, point.beta)))
            .reduce(|| 0.0, f64::max)
    }

    /// Check points from some κ on, with that κ itself as an edge.
    pub(super) fn error_from(&self, from: f64, way: impl Fn(f64, f64) -> [f64; 3] + Sync) -> f64 {
        let first = edge(&self.nodes, from);
        let first = first.iter().map(|point| off(point, way(point.kappa, point.beta))).fold(0.0, f64::max);
        first.max(self.error(|kappa| kappa >= from, &way))
    }

    /// The largest error at a few points, without margin.
    pub(super) fn error_of_few(&self, way: impl Fn(f64, f64) -> [f64; 3] + Sync) -> f64 {
        let few: Vec<&Point> = self.points().step_by(FEW_STRIDE).collect();
        few.par_iter().map(|point| off(point, way(point.kappa, point.beta))).reduce(|| 0.0, f64::max)
    }

    /// The largest error of a method that is smooth in κ and β; if a few points show that it is too large, at those.
    pub(super) fn error_within(&self, tolerance: RelTolerance, way: impl Fn(f64, f64) -> [f64; 3] + Sync) -> f64 {
        let few = self.error_of_few(&way);
        if tolerance.allows(self.error_bound(few)) { few.max(self.error(|_| true, way)) } else { few }
    }

    /// The largest error of a plan, without margin.
    pub(super) fn error_of_plan(&self, plan: &Plan) -> f64 {
        error_of_plan(&self.grid, plan).max(error_of_plan(&self.edges, plan))
    }

    /// The largest error of a plan by a table of the given number of intervals along v in the first of them, without
    /// margin.
    pub(super) fn error_of_first(&self, [from, to]: [f64; 2], intervals: usize, plan: &Plan) -> f64 {
        let of_row = |i: usize| {
            let kappa = from * (to / from).powf((i as f64 + 0.5) / FIRST_KAPPAS as f64);
            row(&self.nodes, kappa, FIRST_SHARES.iter().map(|share| share / intervals as f64))
        };
        let rows: Vec<Vec<Point>> = (0..FIRST_KAPPAS).into_par_iter().map(of_row).collect();
        error_of_plan(&rows.concat(), plan)
    }

    pub(super) fn nodes(&self) -> &[Node] {
        &self.nodes
    }

    pub(super) fn points(&self) -> impl Iterator<Item = &Point> {
        self.grid.iter().chain(&self.edges)
    }

    /// Estimated error bound from the largest error found.
    pub(super) fn error_bound(&self, seen: f64) -> f64 {
        MARGIN * seen + self.reference
    }
}

fn error_of_plan(points: &[Point], plan: &Plan) -> f64 {
    // In runs: outside a table each point takes sums over wavelengths.
    let of_run = |points: &[Point]| {
        let places: Vec<[f64; 2]> = points.iter().map(|point| [point.kappa, point.beta]).collect();
        let mut sums = [[0.0; 3]; RUN];
        plan.fill(&places, &mut sums);
        points.iter().zip(sums).map(|(point, sum)| off(point, sum)).fold(0.0, f64::max)
    };
    points.par_chunks(RUN).map(of_run).reduce(|| 0.0, f64::max)
}

/// Every `stride`th point of the grid, by a sum over these wavelengths; only where a bound applies.
fn points(nodes: &[Node], demand: Demand, stride: usize) -> Vec<Point> {
    let [from, to] = demand.kappa();
    let rows: Vec<Vec<Point>> = (0..KAPPAS)
        .into_par_iter()
        .map(|i| {
            let kappa = from * (to / from).powf(i as f64 / (KAPPAS - 1) as f64);
            let shift = (i as f64 * 0.618_033_988_749_894_9).fract();
            // The edge itself, then a little beyond v = 1 too; each row lies between the others'.
            let v = |j: usize| if j == 0 { 0.0 } else { 1.05 * (j as f64 - shift) / (BETAS - 1) as f64 };
            let asked = (0..BETAS).filter(|j| (i * BETAS + j).is_multiple_of(stride));
            row(nodes, kappa, asked.map(v))
        })
        .collect();
    rows.into_iter().flatten().collect()
}

/// Many points at one κ.
fn edge(nodes: &[Node], kappa: f64) -> Vec<Point> {
    row(nodes, kappa, (0..EDGE_BETAS).map(|j| j as f64 / (EDGE_BETAS - 1) as f64))
}

/// Points at one κ.
fn row(nodes: &[Node], kappa: f64, vs: impl Iterator<Item = f64>) -> Vec<Point> {
    // The peak comes first.
    let places: Vec<[f64; 2]> = [0.0].into_iter().chain(vs).map(|v| [kappa, beta_at(kappa, v)]).collect();
    if places.len() == 1 {
        return Vec::new();
    }
    let sums = many_by_nodes(nodes, &places);
    let scale = largest(sums[0]);
    let point = |(&[_, beta], &exact): (&[f64; 2], &[f64; 3])| Point { kappa, beta, exact, scale };
    places.iter().zip(&sums).skip(1).map(point).collect()
}

fn largest(sums: [f64; 3]) -> f64 {
    sums.into_iter().map(f64::abs).fold(0.0, f64::max)
}

/// A point's error. Black is exact if it is black.
fn off(point: &Point, found: [f64; 3]) -> f64 {
    let off = apart(point.exact, found);
    if off == 0.0 { 0.0 } else { off / point.scale }
}

fn apart(a: [f64; 3], b: [f64; 3]) -> f64 {
    a.iter().zip(b).fold(0.0_f64, |most, (a, b)| most.max((a - b).abs()))
}
