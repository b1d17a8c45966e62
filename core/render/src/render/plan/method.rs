//! Methods of integration by name.

use crate::reflectance::Precision;
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
