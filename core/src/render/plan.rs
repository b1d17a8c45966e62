//! The diffuse part's spectral integral by the cheapest way that keeps a chosen error, checked for this camera, light and
//! reflectance.
//!
//! ```text
//! J_c(κ, β) = Σ_λ w_c(λ) S(κ (λ0/λ)², β κ (λ0/λ)²)
//! ```
//! A [`Plan`] is made once for a [`SpectralWeights`], an [`Accuracy`] and a [`Demand`] (which κ, how many samples). Above some κ the
//! integral separates into moments; below it one of
//!
//! | way | cost of a sample |
//! |---|---|
//! | table of ln J over (ln κ, v), by splines of degree 3 to 9 | a reading, after it was filled |
//! | wavelengths shared by the channels | N sums S |
//! | wavelengths of each channel's own Gauss rule | 3 N sums S |
//! | all wavelengths of the grid | 401 sums S |
//!
//! Each is compared with the sum over all wavelengths at [`Precision::Full`] at a fixed set of (κ, β); the largest error seen,
//! times [`MARGIN`], is what it is certified for. The cheapest that is certified is taken, the cost of filling a table counted in.
//! [`Plan::explanation`] tells all of it.

mod candidate;
mod check;
mod cost;
mod domain;
mod extent;
mod nodes;
mod run;
mod search;

mod spline;
mod surface;
mod table;
mod tables;

pub use candidate::{Candidate, Explanation, Method, Verdict};
pub use check::MARGIN;
pub(in crate::render) use domain::is_lit;
pub use domain::{Demand, position};
pub(in crate::render) use run::{Places, RUN};

use super::diffuse::by_nodes;
use super::measure::{MOMENTS, Node, SpectralWeights};
use crate::accuracy::{Accuracy, Unmet};
use crate::reflectance::Precision;
use nodes::OwnRule;
use table::Table;

/// What an error of the integral is relative to, at each (κ, β) the same for the three channels, so that a channel that changes
/// its sign has no error of its own.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Against {
    /// The largest channel of J(κ, 0): the brightest that a surface of this roughness gets.
    #[default]
    Peak,
    /// The largest channel of J(κ, β) itself, as long as that is above e^-30 of the peak; darker, e^-30 of the peak is what is
    /// promised.
    Value,
}

/// A way to the integral that keeps its error. Cheap to use, costly to make: some tens of milliseconds, a table's more.
#[derive(Clone, Debug, PartialEq)]
pub struct Plan {
    demand: Demand,
    /// Its κ.
    kappa: [f64; 2],
    /// From this κ on by the first so many moments; infinite where none are good enough.
    rough: (f64, usize),
    moments: [[f64; MOMENTS]; 3],
    below: Below,
    /// All wavelengths: for what was not asked for.
    every: Vec<Node>,
    explanation: Explanation,
}

/// How the integral is made below the rough.
#[derive(Clone, Debug, PartialEq)]
enum Below {
    /// Nothing lies there.
    Nothing,
    Table(Table),
    Shared(Vec<Node>, Precision),
    Own([OwnRule; 3], Precision),
    Every(Precision),
}

impl Plan {
    /// Chooses the way for a measure. The same measure, accuracy and demand give the same plan, on any machine.
    ///
    /// # Errors
    /// Below 1e-13, which is the error of the most exact S there is, nothing is promised.
    pub fn new(measure: &SpectralWeights, accuracy: Accuracy, against: Against, demand: Demand) -> Result<Self, Unmet> {
        search::plan(measure, accuracy, against, demand)
    }

    /// What it was made for.
    pub fn demand(&self) -> Demand {
        self.demand
    }

    /// How much memory it takes, in bytes.
    pub fn bytes(&self) -> usize {
        size_of_val(self.every.as_slice()) + self.table().map_or(0, Table::bytes)
    }

    /// What was chosen and why.
    pub fn explanation(&self) -> &Explanation {
        &self.explanation
    }

    /// The three integrals. Outside the demanded κ by the sum over all wavelengths: exact and slow. 0 where κ is not above 0;
    /// a β below 0 counts as 0.
    pub fn at(&self, kappa: f64, beta: f64) -> [f64; 3] {
        let mut sums = [[0.0; 3]];
        self.fill(&[[kappa, beta]], &mut sums);
        sums[0]
    }

    /// The three integrals at each `[κ, β]`, as many as both have. Much faster than one by one.
    pub fn fill(&self, points: &[[f64; 2]], sums: &mut [[f64; 3]]) {
        run::fill(self, points, sums);
    }

    /// The integral at a place that neither moments nor table serve.
    fn slowly(&self, kappa: f64, beta: f64) -> [f64; 3] {
        if !self.demand.holds(kappa) {
            return by_nodes(&self.every, kappa, beta, Precision::Full);
        }
        if let Below::Own(rules, precision) = &self.below {
            return nodes::by_own(rules, kappa, beta, *precision);
        }
        let (nodes, precision) = self.common().unwrap_or((&self.every, Precision::Full));
        by_nodes(nodes, kappa, beta, precision)
    }

    /// The wavelengths of such an integral, where all channels have them in common.
    fn common(&self) -> Option<(&[Node], Precision)> {
        match &self.below {
            Below::Nothing => Some((&self.every, Precision::Full)),
            Below::Table(table) => Some((table.nodes(), Precision::Full)),
            Below::Shared(nodes, precision) => Some((nodes, *precision)),
            Below::Own(..) => None,
            Below::Every(precision) => Some((&self.every, *precision)),
        }
    }

    fn table(&self) -> Option<&Table> {
        if let Below::Table(table) = &self.below { Some(table) } else { None }
    }
}
