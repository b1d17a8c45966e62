//! Conditions that metrics are computed under, their values with uncertainties, and reasons for none.

use crate::ask::Shared;
use crate::compare::DifferenceError;
use crate::patches::RenderingQuery;
use chromascope_color::camera::RenderingError;
use chromascope_color::camera::quality::Electrons;
use chromascope_color::patch_set::PatchSet;
use chromascope_color::spectral::{Correlation, GridSpectrum, Sensor};
use chromascope_color::units::Kelvin;

/// Reason for no value of a metric.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[allow(missing_docs, reason = "each variant says in its message what is wrong")]
pub enum WhyNot {
    #[error(transparent)]
    Rendering(#[from] RenderingError),
    #[error(transparent)]
    Difference(#[from] DifferenceError),
    #[error("Eq 13 takes RGB as sRGB, so ΔE* is undefined; choose a fitted color transform")]
    Eq13,
    #[error("the chart has no patches")]
    NoPatches,
    #[error("the blackbody has no chromaticity on one of the loci; choose another temperature")]
    NoLocus,
    #[error(
        "the color is farther than 0.05 in CIE 1960 u, v from the reference's locus, or beyond 500 K to 100 000 K there, \
         so it has no correlated color temperature"
    )]
    NoCct,
    #[error("the three curves are linearly dependent")]
    Dependent,
    #[error("noise is that of camera RGB; an observer has none")]
    NoChannels,
    #[error("the table scales each channel to the same maximum, so the balance gains of the camera are unknown")]
    ChannelScale,
    #[error("the full-well capacity is not given")]
    NoElectrons,
    #[error("the metric was not asked for")]
    NotAsked,
}

/// Origin of an uncertainty.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum UncertaintySource {
    /// Stated in the camera's own file; where it does not state the correlation, the one that gives most.
    Own(Correlation),
    /// The spread of other models' tables between laboratories.
    Prior,
}

impl UncertaintySource {
    /// Word in tables.
    pub const fn word(self) -> &'static str {
        match self {
            Self::Own(_) => "own",
            Self::Prior => "prior",
        }
    }

    /// Correlation of the errors; the prior has its own.
    pub const fn correlation(self) -> Option<Correlation> {
        match self {
            Self::Own(correlation) => Some(correlation),
            Self::Prior => None,
        }
    }
}

/// Parts of a standard uncertainty, as standard uncertainties themselves; 0 for a part that does not apply.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Contributions {
    /// The curves' shapes.
    pub curves: f64,
    /// Whether the table is per energy or per photon, where its source does not state it.
    pub response: f64,
    /// The ratio between the channels, where the curves' part does not hold it.
    pub channel_ratio: f64,
    /// The light's own file.
    pub light: f64,
    /// The chart's own file.
    pub patches: f64,
}

impl Contributions {
    /// Root of the sum of their squares.
    pub fn combined(self) -> f64 {
        let parts = [self.response, self.channel_ratio, self.light, self.patches];
        parts.into_iter().fold(self.curves, f64::hypot)
    }
}

/// Uncertainty of a metric's value, in the metric's unit.
///
/// ```text
/// u² = u²(curves) + u²(response) + u²(channel ratio) + u²(light) + u²(patches),   95 %: x ± k u
/// prior: k = 1.15 t₀.₉₇₅(14) = 2.47;   own: k = 1.96, or that of the file if larger
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MetricUncertainty {
    /// Combined standard uncertainty.
    pub standard: f64,
    /// Its parts.
    pub contributions: Contributions,
    /// Degrees of freedom of the curves' part; those of the whole are not fewer. Infinite for uncertainties of files.
    pub freedom: f64,
    /// Coverage factor k for 95 %.
    pub coverage: f64,
    /// Origin.
    pub source: UncertaintySource,
    /// True where the prior is stretched: the sensor is unlike the models of the prior, or what the metric uses reaches beyond 400–700 nm;
    /// and where the camera's own table, with its uncertainties, does not reach over 400–700 nm.
    pub is_extrapolated: bool,
    /// Mean of the metric over perturbed curves, less its value: how much errors of curves move the metric on average. Not corrected for,
    /// not part of [`Self::standard`].
    pub bias: f64,
}

impl MetricUncertainty {
    /// Half the 95 % interval: `k u`.
    pub fn expanded(&self) -> f64 {
        self.coverage * self.standard
    }
}

/// Value of a metric with its uncertainty.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MetricValue {
    /// The value in the metric's unit, or the reason for none.
    pub value: Result<f64, WhyNot>,
    /// Uncertainty that the sensitivities cause; none where it is unknown, or not computed yet.
    pub uncertainty: Option<MetricUncertainty>,
}

/// Figures of merit of one camera under one set of conditions.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct CameraMetricsQuery {
    /// The camera and its color transform.
    pub rendering: RenderingQuery,
    /// The reference observer under the same conditions.
    pub reference: RenderingQuery,
    /// The patches that differences are taken over.
    pub patches: Shared<PatchSet>,
    /// Temperature of the blackbody whose place on the locus is compared.
    pub temperature: Kelvin,
    /// Light and patches of the metamerism index.
    pub index: IndexConditions,
    /// The camera's full-well capacity and read noise, if known.
    pub electrons: Option<Electrons>,
    /// Metrics that are computed; the others are [`WhyNot::NotAsked`].
    pub wanted: MetricSet,
}

/// Metrics that a question asks for: nothing is computed for the others.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct MetricSet(pub(super) u64);

/// Conditions of the sensitivity metamerism index: by ISO 17321-1 the CIE 1931 observer, D55 and the 18 chromatic patches of the
/// `ColorChecker`.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct IndexConditions {
    /// The observer; counts in XYZ.
    pub observer: Shared<Sensor>,
    /// The light.
    pub light: Shared<GridSpectrum>,
    /// The patches.
    pub patches: Shared<PatchSet>,
}
