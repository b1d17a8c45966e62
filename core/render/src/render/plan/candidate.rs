//! Methods of integration with errors and costs: the chosen and the rejected.

use super::table::Size;
use super::tables::Makings;
use super::{Demand, cost};
use crate::reflectance::Precision;
use chromascope_color::accuracy::RelTolerance;
use chromascope_color::spectral::grid::COUNT;
use std::fmt;

/// Method by which the spectral integral of a sample is evaluated.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum IntegrationMethod {
    /// None: no sample needs one, or the integral is below e^-30 of its peak.
    Nothing,
    /// The first orders of the expansion in 1/κ.
    Moments {
        /// Number of orders, one to eight.
        orders: usize,
        /// κ from which on they serve.
        from_kappa: f64,
    },
    /// Table of ln J, interpolated by splines.
    Table {
        /// Degree of its splines: 3, 5, 7 or 9.
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
        /// Number of wavelengths.
        nodes: usize,
        /// Exactness of S at each.
        precision: Precision,
    },
    /// Wavelengths of a rule for each channel.
    Own {
        /// Number of wavelengths, the three channels together.
        nodes: usize,
        /// Exactness of S at each.
        precision: Precision,
    },
    /// All wavelengths of the grid.
    Every {
        /// Exactness of S at each.
        precision: Precision,
    },
    /// All wavelengths of the grid, with the paper's three cases of g in place of S.
    Regimes,
}

impl IntegrationMethod {
    /// Number of wavelengths at which S is evaluated for a sample; those that filled a table beforehand do not count.
    pub fn node_count(&self) -> usize {
        match *self {
            Self::Nothing | Self::Moments { .. } | Self::Table { .. } => 0,
            Self::Shared { nodes, .. } | Self::Own { nodes, .. } => nodes,
            Self::Every { .. } | Self::Regimes => COUNT,
        }
    }

    /// Name in one or two words.
    pub const fn name(&self) -> &'static str {
        match self {
            Self::Nothing => "below the threshold",
            Self::Moments { .. } => "moments",
            Self::Table { .. } => "table",
            Self::Shared { .. } | Self::Own { .. } => "nodes",
            Self::Every { .. } => "all wavelengths",
            Self::Regimes => "paper's cases",
        }
    }
}

/// The method with its numbers: "4 moments (κ ≥ 128)", "table of 24 × 20, degree 5, 9 wavelengths an entry".
impl fmt::Display for IntegrationMethod {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let precise = |precision: Precision| format!("S to {:e}", precision.max_relative_error());
        match *self {
            Self::Nothing => write!(f, "nothing"),
            Self::Moments { orders, from_kappa } => {
                let (plural, digits) = (if orders == 1 { "" } else { "s" }, usize::from(from_kappa < 100.0));
                write!(f, "{orders} moment{plural} (κ ≥ {from_kappa:.digits$})")
            }
            Self::Table { degree, kappas, betas, nodes } => {
                write!(f, "table of {kappas} × {betas}, degree {degree}, {nodes} wavelengths an entry")
            }
            Self::Shared { nodes, precision } => {
                write!(f, "{nodes} wavelengths for all channels, {}", precise(precision))
            }
            Self::Own { nodes, precision } => {
                write!(f, "{nodes} wavelengths, each channel its own, {}", precise(precision))
            }
            Self::Every { precision } => write!(f, "all {COUNT} wavelengths, {}", precise(precision)),
            Self::Regimes => write!(f, "all {COUNT} wavelengths, the paper's three cases of g"),
        }
    }
}

/// Reason why a method was chosen or rejected.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// The fastest of those that are exact enough.
    Chosen,
    /// Its estimated error bound exceeds the tolerance.
    TooInexact,
    /// Another is faster.
    TooSlow,
}

/// A method with its error and cost.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Candidate {
    /// The method.
    pub method: IntegrationMethod,
    /// Largest error found in the check; none where it was not checked.
    pub seen: Option<f64>,
    /// Estimated error bound: the largest error found, times a margin; none where it was not checked.
    pub error_bound: Option<f64>,
    /// Cost of a sample by the model, in nanoseconds.
    pub sample_ns: f64,
    /// Cost of preparation by the model, in nanoseconds.
    pub making_ns: f64,
    /// Reason why it was chosen or rejected.
    pub verdict: Verdict,
}

impl Candidate {
    pub(super) fn new(method: IntegrationMethod, seen: f64, error_bound: f64) -> Self {
        Self::unseen(method).checked(seen, error_bound)
    }

    pub(super) fn unseen(method: IntegrationMethod) -> Self {
        let sample_ns = cost::of_sample(&method);
        Self { method, seen: None, error_bound: None, sample_ns, making_ns: 0.0, verdict: Verdict::TooSlow }
    }

    /// A method that is known to keep an error, without a check.
    pub(super) fn known(method: IntegrationMethod, error_bound: Option<f64>) -> Self {
        Self { error_bound, verdict: Verdict::Chosen, ..Self::unseen(method) }
    }

    /// A table that is not made yet.
    pub(super) fn table(size: &Size, makings: &mut Makings<'_>) -> Self {
        let (nodes, making_ns) = makings.cost(size);
        Self { making_ns, ..Self::unseen(size.method(nodes)) }
    }

    /// This candidate with the result of a check.
    pub(super) fn checked(self, seen: f64, error_bound: f64) -> Self {
        Self { seen: Some(seen), error_bound: Some(error_bound), ..self }
    }

    /// Nanoseconds for the given number of samples.
    pub fn total_ns(&self, samples: f64) -> f64 {
        self.making_ns + samples * self.sample_ns
    }

    pub(super) fn meets(&self, tolerance: RelTolerance) -> bool {
        self.error_bound.is_some_and(|error| tolerance.allows(error))
    }
}

/// Methods of a plan, and the reasons for them.
#[derive(Clone, Debug, PartialEq)]
pub struct Explanation {
    /// Requested tolerance.
    pub asked: RelTolerance,
    /// κ and number of samples.
    pub demand: Demand,
    /// Method for large κ; none where moments are nowhere exact enough within the demand.
    pub rough: Option<Candidate>,
    /// Method for all other κ.
    pub chosen: Candidate,
    /// Rejected methods.
    pub rejected: Vec<Candidate>,
}

impl Explanation {
    /// Estimated error bound of the whole plan, the larger of its parts'; 0 where none is known, as for the paper's cases.
    pub fn error_bound(&self) -> f64 {
        let of = |candidate: &Candidate| candidate.error_bound.unwrap_or(0.0);
        self.rough.as_ref().map_or(0.0, of).max(of(&self.chosen))
    }

    /// The methods in use: that for large κ, if it is another, and that for all others.
    pub fn parts(&self) -> impl Iterator<Item = &Candidate> {
        let rough = self.rough.as_ref().filter(|rough| rough.method != self.chosen.method);
        rough.into_iter().chain([&self.chosen]).filter(|part| part.method != IntegrationMethod::Nothing)
    }
}

/// The methods in use: "4 moments (κ ≥ 128), below that table of …".
impl fmt::Display for Explanation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut parts = self.parts();
        let Some(first) = parts.next() else { return write!(f, "nothing") };
        write!(f, "{}", first.method)?;
        parts.try_for_each(|part| write!(f, ", below that {}", part.method))
    }
}
