//! Methods of integration with errors and costs: the chosen and the rejected.

use super::cost;
use super::domain::Demand;
use super::method::IntegrationMethod;
use chromascope_color::accuracy::RelTolerance;
use std::fmt;

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
