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
mod nodes;
mod run;
mod search;

mod spline;
mod surface;
mod table;
mod tables;

pub use candidate::{Candidate, Explanation, IntegrationMethod, Verdict};
pub use check::MARGIN;
pub use domain::{Demand, is_lit, position};
pub(in crate::render) use run::{Places, RUN};

use super::diffuse::{NEARLY_ROUGH, ROUGH, VERY_ROUGH, by_nodes, by_regimes};
use super::measure::{MOMENTS, Node, SpectralWeights};
use super::quality::Quality;
use super::shading::ShadingImage;
use crate::reflectance::Precision;
use chromascope_color::accuracy::{RelTolerance, Unmet};
use nodes::OwnRule;
use table::Table;

/// A method of integration with all that it needs.
#[derive(Clone, Debug, PartialEq)]
pub struct Plan {
    demand: Demand,
    /// Range of κ that is served.
    held: [f64; 2],
    /// True if places below e^-30 of the peak are omitted.
    leaves_dark: bool,
    /// κ from which on the first moments suffice, and their number; infinite if none are accurate enough.
    rough: (f64, usize),
    /// κ from which on [`FEW_MOMENTS`](super::diffuse::FEW_MOMENTS) of these serve.
    few: f64,
    moments: [[f64; MOMENTS]; 3],
    below: Below,
    /// All wavelengths, for κ that are not served.
    every: Vec<Node>,
    explanation: Explanation,
}

/// Method below the rough.
#[derive(Clone, Debug, PartialEq)]
enum Below {
    Nothing,
    Table(Table),
    Shared(Vec<Node>, Precision),
    Own([OwnRule; 3], Precision),
    Every(Precision),
    Regimes,
}

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

    /// The plan of a shaded picture for a camera: found by search if [`ShadingImage::plan_request`] requires it.
    ///
    /// # Errors
    /// See [`Plan::new`].
    pub fn for_picture(shading: &ShadingImage, measure: &SpectralWeights) -> Result<Self, Unmet> {
        match shading.plan_request() {
            Some((tolerance, demand)) => Self::new(measure, tolerance, demand),
            None => Ok(Self::fixed(measure, shading.fixed_quality())),
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

    /// The demand it was made for.
    pub fn demand(&self) -> Demand {
        self.demand
    }

    /// Memory in bytes.
    pub fn bytes(&self) -> usize {
        size_of_val(self.every.as_slice()) + self.table().map_or(0, Table::bytes)
    }

    /// The methods and the reasons for them.
    pub fn explanation(&self) -> &Explanation {
        &self.explanation
    }

    /// The method that evaluates the integral at (κ, β).
    pub fn method(&self, kappa: f64, beta: f64) -> IntegrationMethod {
        let Explanation { rough, chosen, .. } = &self.explanation;
        let is_dark = self.leaves_dark && !is_lit(kappa, beta);
        match (rough, self.table()) {
            _ if kappa.is_nan() || kappa <= 0.0 || is_dark => IntegrationMethod::Nothing,
            _ if !self.holds(kappa) => IntegrationMethod::Every { precision: Precision::Full },
            (Some(rough), _) if kappa >= self.rough.0 => rough.method,
            (_, Some(table)) if !table.holds(kappa) => {
                IntegrationMethod::Shared { nodes: table.nodes().len(), precision: Precision::Full }
            }
            _ => chosen.method,
        }
    }

    /// The wavelengths that integrals below the rough rest on, in each sample or in the table; for rules of each channel's own, as
    /// many for all.
    pub fn nodes(&self, measure: &SpectralWeights) -> Vec<Node> {
        match &self.below {
            Below::Table(table) => table.nodes().to_vec(),
            Below::Shared(nodes, _) => nodes.clone(),
            Below::Own(rules, _) => measure.shared(rules.iter().map(Vec::len).sum()),
            Below::Nothing | Below::Every(_) | Below::Regimes => measure.dense().to_vec(),
        }
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

    /// Number of samples that take about a millisecond: between two looks at a stop signal.
    pub(in crate::render) fn chunk(&self) -> usize {
        let samples = 1e6 / self.explanation.chosen.sample_ns.max(1.0);
        (samples as usize).next_multiple_of(RUN).clamp(RUN, 4096)
    }

    fn holds(&self, kappa: f64) -> bool {
        let [from, to] = self.held;
        from <= kappa && kappa <= to
    }

    /// The integral at a place that neither moments nor table serve.
    fn by_remaining_method(&self, kappa: f64, beta: f64) -> [f64; 3] {
        match &self.below {
            _ if !self.holds(kappa) => by_nodes(&self.every, kappa, beta, Precision::Full),
            Below::Own(rules, precision) => nodes::by_own(rules, kappa, beta, *precision),
            Below::Regimes => by_regimes(&self.every, kappa, beta),
            _ => {
                let (nodes, precision) = self.common().unwrap_or((&self.every, Precision::Full));
                by_nodes(nodes, kappa, beta, precision)
            }
        }
    }

    /// The wavelengths of such an integral, where all channels have them in common.
    fn common(&self) -> Option<(&[Node], Precision)> {
        match &self.below {
            Below::Nothing => Some((&self.every, Precision::Full)),
            Below::Table(table) => Some((table.nodes(), Precision::Full)),
            Below::Shared(nodes, precision) => Some((nodes, *precision)),
            Below::Own(..) | Below::Regimes => None,
            Below::Every(precision) => Some((&self.every, *precision)),
        }
    }

    fn table(&self) -> Option<&Table> {
        if let Below::Table(table) = &self.below { Some(table) } else { None }
    }
}

impl Below {
    fn method(&self) -> IntegrationMethod {
        match self {
            Self::Nothing => IntegrationMethod::Nothing,
            Self::Table(table) => table.method(),
            Self::Shared(nodes, precision) => IntegrationMethod::Shared { nodes: nodes.len(), precision: *precision },
            Self::Own(rules, precision) => {
                IntegrationMethod::Own { nodes: rules.iter().map(Vec::len).sum(), precision: *precision }
            }
            Self::Every(precision) => IntegrationMethod::Every { precision: *precision },
            Self::Regimes => IntegrationMethod::Regimes,
        }
    }
}
