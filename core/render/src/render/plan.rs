//! Methods of integration: the one place that decides how the diffuse component's spectral integral is evaluated.
//!
//! ```text
//! J_c(κ, β) = Σ_λ w_c(λ) S(κ (λ0/λ)², β κ (λ0/λ)²)
//! ```
//! A [`Plan`] is made for a [`SpectralWeights`], a [`RelTolerance`] and a [`Demand`] (range of κ, number of samples). Above some κ the
//! integral separates into moments; below it one of
//!
//! | method | cost of a sample |
//! |---|---|
//! | table of ln J over (ln κ, v), by splines of degree 3 to 9 | one interpolation, after it was filled |
//! | wavelengths shared by the channels | N sums S |
//! | wavelengths of each channel's own Gauss rule | 3 N sums S |
//! | all wavelengths of the grid | 401 sums S |
//!
//! Each is compared with the sum over all wavelengths at [`Precision::Full`] at a fixed set of (κ, β). Errors are relative to the
//! largest channel of J(κ, 0), the brightest that a surface of this roughness gets, so that a channel that changes its sign has
//! none of its own. The largest found, times [`MARGIN`], is the estimated error bound. The fastest within the tolerance is taken, the cost of filling a table counted
//! in. Where samples are too few to pay for that search, [`Plan::fixed`] takes as many wavelengths as are known to be enough.

mod candidate;
mod check;
mod cost;
mod domain;
mod extent;
mod method;
mod nodes;
mod run;
mod search;
mod spline;
mod surface;
mod table;
mod tables;

pub use candidate::{Candidate, Explanation, Verdict};
pub use check::MARGIN;
pub use domain::{Demand, is_lit, position};
pub use method::IntegrationMethod;
pub use run::Plan;
pub(in crate::render) use run::{Places, RUN};

use super::diffuse::{NEARLY_ROUGH, ROUGH, VERY_ROUGH};
use super::measure::{MOMENTS, Node, SpectralWeights};
use super::quality::Quality;
use crate::reflectance::Precision;
use chromascope_color::accuracy::{RelTolerance, Unmet};
use run::Below;

/// Number of wavelengths of a preview, and the errors known of them and of those of a [`SpectralWeights`].
const PREVIEW_NODES: usize = 6;
const PREVIEW_BOUND: f64 = 1e-4;
/// κ from which on all moments are within that.
const PREVIEW_ROUGH: f64 = 32.0;
const COARSE_BOUND: f64 = 1e-6;
const FINE_BOUND: f64 = 1e-9;
/// Below this cost of a picture's samples at wavelengths, in nanoseconds, no search is made: it would take longer.
const SEARCH_NS: f64 = 5e6;

impl Plan {
    /// Searches the fastest method for a measure. The same measure, tolerance and demand give the same plan, on any machine.
    /// Takes some milliseconds.
    ///
    /// # Errors
    /// [`Unmet`] for tolerances below 1e-13, the error of the most exact S there is.
    pub fn new(measure: &SpectralWeights, tolerance: RelTolerance, demand: Demand) -> Result<Self, Unmet> {
        search::plan(measure, tolerance, demand)
    }

    /// The method of a quality without a search, by what is known of any measure: a few wavelengths, or all.
    pub fn fixed(measure: &SpectralWeights, quality: Quality) -> Self {
        let shared = |nodes: &[Node], precision| Below::Shared(nodes.to_vec(), precision);
        let (below, bound) = match quality {
            Quality::Preview => (shared(&measure.shared(PREVIEW_NODES), Precision::Coarse), Some(PREVIEW_BOUND)),
            Quality::Full => (shared(measure.coarse(), Precision::Fine), Some(COARSE_BOUND)),
            Quality::Fine => (shared(measure.fine(), Precision::Full), Some(FINE_BOUND)),
            Quality::Reference | Quality::Within(_) => (Below::Every(Precision::Full), Some(search::REFERENCE)),
            Quality::Regimes => (Below::Regimes, None),
        };
        let rough = match quality {
            Quality::Preview => Some(([PREVIEW_ROUGH, NEARLY_ROUGH], PREVIEW_BOUND)),
            Quality::Full => Some(([NEARLY_ROUGH, ROUGH], COARSE_BOUND)),
            Quality::Fine => Some(([ROUGH, VERY_ROUGH], FINE_BOUND)),
            Quality::Reference | Quality::Regimes | Quality::Within(_) => None,
        };
        let demand = Demand::of_picture([f64::MIN_POSITIVE, f64::MAX], 1);
        Self {
            demand,
            held: demand.held(),
            leaves_dark: quality.leaves_dark(),
            rough: rough.map_or((f64::INFINITY, 0), |([from, _], _)| (from, MOMENTS)),
            few: rough.map_or(f64::INFINITY, |([_, few], _)| few),
            moments: *measure.moments(),
            explanation: Explanation {
                asked: RelTolerance::at_best(bound.unwrap_or(1.0)),
                demand,
                rough: rough.map(|([from_kappa, _], bound)| {
                    Candidate::known(IntegrationMethod::Moments { orders: MOMENTS, from_kappa }, Some(bound))
                }),
                chosen: Candidate::known(below.method(), bound),
                rejected: Vec::new(),
            },
            below,
            every: measure.dense().to_vec(),
        }
    }

    /// True if a search pays for a picture of a quality with these numbers of samples below [`NEARLY_ROUGH`] and [`ROUGH`], if
    /// the diffuse component has to meet this tolerance. A numeric tolerance always requires a search: its error is checked.
    pub(in crate::render) fn is_searched(quality: Quality, tolerance: RelTolerance, below: [u64; 2]) -> bool {
        let (nodes, precision, samples) = match quality {
            Quality::Within(_) => return true,
            Quality::Preview | Quality::Reference | Quality::Regimes => return false,
            Quality::Full | Quality::Fine if !tolerance.allows(FINE_BOUND) => return true,
            Quality::Full if tolerance.allows(COARSE_BOUND) => (9, Precision::Fine, below[0]),
            Quality::Full | Quality::Fine => (15, Precision::Full, below[1]),
        };
        let by_nodes = cost::of_sample(&IntegrationMethod::Shared { nodes, precision });
        samples as f64 * by_nodes > SEARCH_NS
    }

    /// The quality whose [`Plan::fixed`] keeps a tolerance of the diffuse component in a picture of another.
    pub(in crate::render) fn fixed_quality(quality: Quality, tolerance: Option<RelTolerance>) -> Quality {
        let is_tight = tolerance.is_some_and(|tolerance| !tolerance.allows(COARSE_BOUND));
        if quality == Quality::Full && is_tight { Quality::Fine } else { quality }
    }
}
