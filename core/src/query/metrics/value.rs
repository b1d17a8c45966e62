//! Values of metrics, and reasons for none.

use super::uncertainty::MetricUncertainty;
use crate::camera::RenderingError;
use crate::query::compare::DifferenceError;

/// Reason for no value of a metric.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum WhyNot {
    /// The sensor or the reference cannot be shown under these conditions.
    #[error(transparent)]
    Rendering(#[from] RenderingError),
    /// The sensor cannot be compared with the reference.
    #[error(transparent)]
    Difference(#[from] DifferenceError),
    /// Eq 13 takes any RGB as sRGB: a formula of L*a*b* gives a number there, but no CIE color difference.
    #[error("Eq 13 takes RGB as sRGB, so ΔE* is undefined; choose a fitted color transform")]
    Eq13,
    /// A statistic of nothing.
    #[error("the chart has no patches")]
    NoPatches,
    /// A color or a locus that is not on the diagram.
    #[error("the blackbody has no chromaticity on one of the loci; choose another temperature")]
    NoLocus,
    /// A meaningless color temperature.
    #[error(
        "the color is farther than 0.05 in CIE 1960 u, v from the reference's locus, or beyond 500 K to 100 000 K there, \
         so it has no correlated color temperature"
    )]
    NoCct,
    /// Curves that span less than three dimensions.
    #[error("the three curves are linearly dependent")]
    Dependent,
    /// Tristimulus values have no noise of channels.
    #[error("noise is that of camera RGB; an observer has none")]
    NoChannels,
    /// The table does not hold the ratio between the channels.
    #[error("the table scales each channel to the same maximum, so the balance gains of the camera are unknown")]
    ChannelScale,
    /// Noise in electrons needs electrons.
    #[error("the full-well capacity is not given")]
    NoElectrons,
}

/// Value of a metric with its uncertainty.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MetricValue {
    /// The value in the metric's unit, or the reason for none.
    pub value: Result<f64, WhyNot>,
    /// Uncertainty that the sensitivities cause; none where it is unknown, or not computed yet.
    pub uncertainty: Option<MetricUncertainty>,
}
