//! What was chosen and what was not, with errors and costs, for somebody to look at.

use super::table::Size;
use super::tables::Makings;
use super::{Against, Demand, cost};
use crate::accuracy::Accuracy;
use crate::reflectance::Precision;

/// A way to the integral.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Method {
    /// No sample goes this way.
    Nothing,
    /// The first so many orders of the expansion in 1/κ.
    Moments {
        /// How many, one to four.
        orders: usize,
        /// From this κ on.
        from_kappa: f64,
    },
    /// A table.
    Table {
        /// The degree of its splines: 3, 5, 7 or 9.
        degree: usize,
        /// Coefficients along ln κ.
        kappas: usize,
        /// Coefficients along v.
        betas: usize,
        /// Wavelengths that it is made of.
        nodes: usize,
    },
    /// Wavelengths that the channels share.
    Shared {
        /// How many.
        nodes: usize,
        /// How exactly S is made at each.
        precision: Precision,
    },
    /// Wavelengths of each channel's own rule.
    Own {
        /// How many, the three channels together.
        nodes: usize,
        /// How exactly S is made at each.
        precision: Precision,
    },
    /// All wavelengths of the grid.
    Every {
        /// How exactly S is made at each.
        precision: Precision,
    },
}

/// Why a way was taken or not.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// The cheapest of those that are exact enough.
    Chosen,
    /// Its certified error is too large.
    TooInexact,
    /// Another is cheaper.
    TooSlow,
}

/// A way with its error and cost.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Candidate {
    /// The way.
    pub method: Method,
    /// The largest error seen in the check; none for a table that would have cost too much to be filled.
    pub seen: Option<f64>,
    /// The error that it is certified for.
    pub certified: Option<f64>,
    /// What a sample costs by the model, in nanoseconds.
    pub sample_ns: f64,
    /// What making it costs by the model, in nanoseconds.
    pub making_ns: f64,
    /// Why it was taken or not.
    pub verdict: Verdict,
}

impl Candidate {
    pub(super) fn new(method: Method, seen: f64, certified: f64) -> Self {
        Self::unseen(method).checked(seen, certified)
    }

    pub(super) fn unseen(method: Method) -> Self {
        let sample_ns = cost::of_sample(&method);
        Self { method, seen: None, certified: None, sample_ns, making_ns: 0.0, verdict: Verdict::TooSlow }
    }

    /// A table that is not made yet.
    pub(super) fn table(size: &Size, makings: &mut Makings<'_>) -> Self {
        let (nodes, making_ns) = makings.cost(size);
        Self { making_ns, ..Self::unseen(size.method(nodes)) }
    }

    /// The same with what was seen.
    pub(super) fn checked(self, seen: f64, certified: f64) -> Self {
        Self { seen: Some(seen), certified: Some(certified), ..self }
    }

    /// Nanoseconds for so many samples.
    pub fn total_ns(&self, samples: f64) -> f64 {
        self.making_ns + samples * self.sample_ns
    }

    pub(super) fn meets(&self, accuracy: Accuracy) -> bool {
        self.certified.is_some_and(|error| accuracy.allows(error))
    }
}

/// What a plan is made of and why.
#[derive(Clone, Debug, PartialEq)]
pub struct Explanation {
    /// The error that was asked for.
    pub asked: Accuracy,
    /// What it is relative to.
    pub against: Against,
    /// The κ and the number of samples.
    pub demand: Demand,
    /// How large κ are treated; none where no moments are good enough within the demand.
    pub rough: Option<Candidate>,
    /// How the others are.
    pub chosen: Candidate,
    /// What else was looked at.
    pub rejected: Vec<Candidate>,
}

impl Explanation {
    /// The error that the whole plan is certified for: the larger of its parts'.
    pub fn certified(&self) -> f64 {
        let of = |candidate: &Candidate| candidate.certified.unwrap_or(0.0);
        self.rough.as_ref().map_or(0.0, of).max(of(&self.chosen))
    }
}
