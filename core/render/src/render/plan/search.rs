//! Search for the fastest method within a tolerance.
//!
//! Cost and error of a method do not depend on the tolerance. A method is skipped only if it costs more than one that meets
//! the tolerance, or certainly does not meet it. So the fastest method for a smaller tolerance rarely has a larger error than
//! the fastest for a larger one; where a candidate is missed it can (`tests/core/accuracy.rs` names a scene).

use super::candidate::{Candidate, Explanation, Verdict};
pub(super) use super::check::REFERENCE;
use super::check::{Check, Point};
use super::domain::Demand;
use super::method::IntegrationMethod;
use super::nodes::{by_own, carried, own_rules};
use super::run::{self, Below, Plan};
use super::table::Size;
use super::tables::Makings;
use crate::reflectance::{Precision, diffuse_sum};
use crate::render::diffuse::{FEW_MOMENTS, by_moments, by_nodes, rough_basis};
use crate::render::measure::{MOMENTS, Node, SpectralWeights};
use chromascope_color::accuracy::{RelTolerance, Unmet};

/// The most wavelengths that stand for all.
const MOST_NODES: usize = 24;
/// The least κ that moments are tried from, and the largest that a table holds.
const LEAST_ROUGH: f64 = 16.0;
const LAST_TABLE: f64 = 1024.0;
/// A table reaches down to this share of the largest κ in it.
const TABLE_SPAN: f64 = 1e-6;
/// Of which degree tables are.
const DEGREES: [usize; 4] = [3, 5, 7, 9];
/// An error is taken to fall by at most this much more than by 2^((degree + 1)/4) from a table to the next finer one.
const STEEPER: f64 = 1.5;
/// Least cost of other methods in nanoseconds, where tables are tried first.
const PAYS_NS: f64 = 2e6;
/// A table's error is taken to be smaller than what is likely by this power of ten at most.
const UNLIKELY: f64 = 0.1;

pub(super) fn plan(measure: &SpectralWeights, tolerance: RelTolerance, demand: Demand) -> Result<Plan, Unmet> {
    tolerance.met_by(REFERENCE)?;
    let check = Check::new(measure, demand, tolerance);
    let mut search = Search { measure, tolerance, demand, check: &check, seen: Vec::new(), best: None };
    let whole = search.moments();
    let rough = search.rough();
    let from = rough.as_ref().map_or(f64::INFINITY, |(_, from)| *from);
    if whole.is_none() {
        search.every();
        if search.many(from) {
            search.tables(from);
        }
        search.shared();
        search.own();
        if !search.many(from) {
            search.tables(from);
        }
    }
    let few = match &whole {
        Some(_) => search.few(demand.kappa()[0]),
        None => rough.as_ref().map_or(f64::INFINITY, |(_, from)| search.few(*from)),
    };
    let Search { mut seen, best, .. } = search;
    let (chosen, below, rough) = match (whole, best) {
        (Some(moments), _) => (moments, Below::Nothing, Some((moments, demand.kappa()[0]))),
        (None, Some((chosen, below))) => (chosen, below, rough),
        // The sum over all wavelengths meets whatever the reference does.
        (None, None) => return Err(Unmet { asked: tolerance, best: RelTolerance::at_best(REFERENCE) }),
    };
    let chosen = Candidate { verdict: Verdict::Chosen, ..chosen };
    seen.retain(|candidate| candidate.method != chosen.method);
    let orders = |candidate: &Candidate| {
        if let IntegrationMethod::Moments { orders, .. } = candidate.method { orders } else { 0 }
    };
    Ok(Plan {
        demand,
        held: demand.held(),
        leaves_dark: true,
        rough: rough.as_ref().map_or((f64::INFINITY, 0), |(candidate, from)| (*from, orders(candidate))),
        few,
        moments: *measure.moments(),
        below,
        every: measure.dense().to_vec(),
        explanation: Explanation {
            asked: tolerance,
            demand,
            rough: rough.map(|(candidate, _)| Candidate { verdict: Verdict::Chosen, ..candidate }),
            chosen,
            rejected: seen,
        },
    })
}

struct Search<'a> {
    measure: &'a SpectralWeights,
    tolerance: RelTolerance,
    demand: Demand,
    check: &'a Check,
    seen: Vec<Candidate>,
    best: Option<(Candidate, Below)>,
}

impl Search<'_> {
    /// Takes a candidate if it is exact enough and the cheapest so far.
    fn offer(&mut self, mut candidate: Candidate, below: Below) {
        let meets = candidate.meets(self.tolerance);
        candidate.verdict = if meets { Verdict::TooSlow } else { Verdict::TooInexact };
        self.seen.push(candidate);
        if meets && self.may_win(&candidate) {
            self.best = Some((candidate, below));
        }
    }

    /// True if a candidate is cheaper than the best so far.
    fn may_win(&self, candidate: &Candidate) -> bool {
        let samples = self.demand.samples();
        self.best.as_ref().is_none_or(|(best, _)| candidate.total_ns(samples) < best.total_ns(samples))
    }

    /// True if there are enough samples that a table is likely to pay.
    fn many(&self, rough: f64) -> bool {
        let fewest = Candidate::unseen(IntegrationMethod::Shared { nodes: 2, precision: Precision::Coarse });
        self.tabulated(rough).is_some() && fewest.total_ns(self.demand.samples()) > PAYS_NS
    }

    fn by_moments(&self, orders: usize) -> impl Fn(f64, f64) -> [f64; 3] + Sync + use<> {
        let moments = *self.measure.moments();
        move |kappa, beta| {
            let mut basis = rough_basis(kappa, beta.min(run::LAST_BETA));
            basis[orders..].fill(0.0);
            by_moments(&moments, &basis)
        }
    }

    /// The fewest moments that do for all of the demand.
    fn moments(&mut self) -> Option<Candidate> {
        let from_kappa = self.demand.kappa()[0];
        if from_kappa < LEAST_ROUGH {
            return None;
        }
        for orders in 1..=MOMENTS {
            let seen = self.check.error_from(from_kappa, self.by_moments(orders));
            let found =
                Candidate::new(IntegrationMethod::Moments { orders, from_kappa }, seen, self.check.error_bound(seen));
            if found.meets(self.tolerance) {
                return Some(found);
            }
            self.seen.push(Candidate { verdict: Verdict::TooInexact, ..found });
        }
        None
    }

    /// The powers of √2 from which moments do at the points of the check, falling.
    fn within(&self, least: f64, orders: usize) -> impl DoubleEndedIterator<Item = f64> + use<> {
        let last = self.demand.kappa()[1];
        let steps = (1..).map(|i| last * (-0.5 * f64::from(i)).exp2()).take_while(|&step| step >= least);
        let meets = |seen| self.tolerance.allows(self.check.error_bound(seen));
        let within = steps.take_while(|&step| meets(self.check.error(|k| k >= step, self.by_moments(orders))));
        within.collect::<Vec<f64>>().into_iter()
    }

    /// κ from which on few moments do, among those from which all do.
    fn few(&self, from: f64) -> f64 {
        let meets = |&from: &f64| {
            let seen = self.check.error_from(from, self.by_moments(FEW_MOMENTS));
            self.tolerance.allows(self.check.error_bound(seen))
        };
        self.within(from, FEW_MOMENTS).rev().find(meets).unwrap_or(f64::INFINITY)
    }

    /// All moments, and the power of √2 from which they do, if it lies within the demand.
    fn rough(&mut self) -> Option<(Candidate, f64)> {
        // Where each begins, the error is looked at last: that takes sums over wavelengths, elsewhere they are made already.
        for from_kappa in self.within(LEAST_ROUGH.max(self.demand.kappa()[0]), MOMENTS).rev() {
            let seen = self.check.error_from(from_kappa, self.by_moments(MOMENTS));
            let method = IntegrationMethod::Moments { orders: MOMENTS, from_kappa };
            let candidate = Candidate::new(method, seen, self.check.error_bound(seen));
            if candidate.meets(self.tolerance) {
                return Some((candidate, from_kappa));
            }
            self.seen.push(Candidate { verdict: Verdict::TooInexact, ..candidate });
        }
        None
    }

    fn every(&mut self) {
        let carried = self.carried(self.check.nodes());
        for precision in Precision::ALL {
            // Compared with itself the most exact would be without error.
            let full = precision == Precision::Full;
            let seen = if full { 0.0 } else { carried * precision.max_relative_error() };
            let candidate = Candidate::new(IntegrationMethod::Every { precision }, seen, seen + REFERENCE);
            self.offer(candidate, Below::Every(precision));
        }
    }

    /// By how much a relative error of S is larger in the integral, at most: half as much again as at some of the places.
    fn carried(&self, nodes: &[Node]) -> f64 {
        let of = |point: &Point| {
            let sum = |node: &Node| {
                let g = point.kappa * node.scale;
                diffuse_sum(g, point.beta * g, Precision::Coarse)
            };
            let sums: Vec<f64> = nodes.iter().map(sum).collect();
            let carried = carried(nodes, &sums);
            if carried == 0.0 { 0.0 } else { carried / point.scale }
        };
        1.5 * self.check.points().step_by(47).map(of).fold(1.0, f64::max)
    }

    /// The fewest wavelengths that do, with each precision of S.
    fn shared(&mut self) {
        for count in 2..=MOST_NODES {
            let cheapest = Candidate::unseen(IntegrationMethod::Shared { nodes: count, precision: Precision::Coarse });
            if !self.may_win(&cheapest) {
                self.seen.push(cheapest);
                break;
            }
            let nodes = self.measure.shared(count);
            let way = |kappa, beta| by_nodes(&nodes, kappa, beta, Precision::Full);
            let seen = self.check.error_within(self.tolerance, way);
            let method = |precision| IntegrationMethod::Shared { nodes: nodes.len(), precision };
            let exact = Candidate::new(method(Precision::Full), seen, self.check.error_bound(seen));
            let meets = exact.meets(self.tolerance);
            if meets {
                let carried = self.carried(&nodes);
                for precision in [Precision::Coarse, Precision::Fine] {
                    let rounded = precision.max_relative_error() * carried;
                    let candidate =
                        Candidate::new(method(precision), seen + rounded, self.check.error_bound(seen) + rounded);
                    self.offer(candidate, Below::Shared(nodes.clone(), precision));
                }
            }
            self.offer(exact, Below::Shared(nodes, Precision::Full));
            if meets {
                break;
            }
        }
    }

    /// Candidates with rules of each channel's own, while they are cheaper.
    fn own(&mut self) {
        for count in 1..=MOST_NODES / 2 {
            let rules = own_rules(self.measure.dense(), count);
            let method = IntegrationMethod::Own { nodes: rules.iter().map(Vec::len).sum(), precision: Precision::Full };
            let unseen = Candidate::unseen(method);
            if !self.may_win(&unseen) {
                self.seen.push(unseen);
                break;
            }
            let way = |kappa, beta| by_own(&rules, kappa, beta, Precision::Full);
            let seen = self.check.error_within(self.tolerance, way);
            let candidate = Candidate::new(method, seen, self.check.error_bound(seen));
            let meets = candidate.meets(self.tolerance);
            self.offer(candidate, Below::Own(rules, Precision::Full));
            if meets {
                break;
            }
        }
    }

    /// Tables, while they are cheaper than what there is.
    fn tables(&mut self, rough: f64) {
        let Some(kappa) = self.tabulated(rough) else { return };
        let mut makings = Makings::new(self.measure, self.check, kappa);
        let mut next: Vec<Size> = DEGREES.iter().filter_map(|&degree| self.first(&makings, degree)).collect();
        let samples = self.demand.samples();
        // The cheapest first, so that none is filled that is dearer than the one taken.
        while !next.is_empty() {
            let candidates: Vec<Candidate> = next.iter().map(|size| makings.candidate(size)).collect();
            let total = |&i: &usize| candidates[i].total_ns(samples);
            let Some(cheapest) = (0..next.len()).min_by(|a, b| total(a).total_cmp(&total(b))) else { return };
            if !self.may_win(&candidates[cheapest]) {
                self.seen.extend(candidates);
                return;
            }
            let size = next.swap_remove(cheapest);
            let plan = self.with(Below::Table(makings.table(&size)));
            let seen = self.table_error(&plan);
            self.offer(candidates[cheapest].checked(seen, self.check.error_bound(seen)), plan.below);
            next.extend(self.finer(&makings, &size, seen));
        }
    }

    /// The κ of a table, if any lie below the rough.
    fn tabulated(&self, rough: f64) -> Option<[f64; 2]> {
        let [least, last] = self.demand.kappa();
        let last = last.min(LAST_TABLE);
        let from = least.max(last * TABLE_SPAN);
        (from < last && rough > from).then_some([from, last])
    }

    /// The coarsest table of a degree that is likely to be exact enough, and some that are not.
    fn first(&self, makings: &Makings<'_>, degree: usize) -> Option<Size> {
        let tried = -self.tolerance.max_relative_error().log10() - UNLIKELY;
        makings.sizes(degree, 0).find(|size| size.digits() >= tried)
    }

    /// The coarsest table finer than one of this error that may be exact enough.
    fn finer(&self, makings: &Makings<'_>, size: &Size, seen: f64) -> Option<Size> {
        let steepest = STEEPER * (0.25 * (size.degree + 1) as f64).exp2();
        let mut least = seen;
        makings.sizes(size.degree, size.step + 1).find(|_| {
            least /= steepest;
            self.tolerance.allows(self.check.error_bound(least))
        })
    }

    fn table_error(&self, plan: &Plan) -> f64 {
        let seen = self.check.error_of_plan(plan);
        match &plan.below {
            Below::Table(table) if self.tolerance.allows(self.check.error_bound(seen)) => {
                seen.max(self.check.error_of_first(table.kappa(), table.intervals(), plan))
            }
            _ => seen,
        }
    }

    fn with(&self, below: Below) -> Plan {
        let chosen = Candidate::unseen(IntegrationMethod::Nothing);
        let (asked, demand) = (self.tolerance, self.demand);
        Plan {
            demand,
            held: demand.held(),
            leaves_dark: true,
            rough: (f64::INFINITY, 0),
            few: f64::INFINITY,
            moments: *self.measure.moments(),
            below,
            every: Vec::new(),
            explanation: Explanation { asked, demand, rough: None, chosen, rejected: Vec::new() },
        }
    }
}
