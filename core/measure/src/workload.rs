//! Workloads, and the effort spent on them.

use serde::{Deserialize, Serialize};

use crate::data::DataError;
use crate::{Machine, Measurement};

/// A kind of computation that is measured.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Workload {
    /// Chromaticities of blackbodies, 1000 to 20 000 K.
    Locus,
    /// Responses of reflectances through sensitivities.
    Responses,
    /// The diffuse sum S(g, b) of Eq 2.
    DiffuseSum,
    /// The spectral integral of a pixel, three channels.
    Integral,
    /// Frames of the head through four sources.
    Frames,
    /// Correlated color temperature and Duv.
    Temperature,
    /// Color differences ΔE*00.
    Difference,
}

impl Workload {
    /// All, in the order of the pipeline's queries.
    pub const ALL: [Self; 7] = [
        Self::Locus,
        Self::Responses,
        Self::DiffuseSum,
        Self::Integral,
        Self::Frames,
        Self::Temperature,
        Self::Difference,
    ];

    /// The name to request it by, also that of its files.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Locus => "locus",
            Self::Responses => "responses",
            Self::DiffuseSum => "diffuse-sum",
            Self::Integral => "integral",
            Self::Frames => "frames",
            Self::Temperature => "temperature",
            Self::Difference => "difference",
        }
    }

    /// Title in a few words.
    pub const fn title(self) -> &'static str {
        match self {
            Self::Locus => "Chromaticities of blackbodies, 1000 to 20 000 K",
            Self::Responses => "Responses of reflectances through sensitivities",
            Self::DiffuseSum => "The diffuse sum S(g, b)",
            Self::Integral => "The spectral integral of a pixel",
            Self::Frames => "Frames of the head through four sources",
            Self::Temperature => "Correlated color temperature and Duv",
            Self::Difference => "Color differences \u{394}E*00",
        }
    }

    /// The workload of a name.
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|workload| workload.name() == name)
    }
}

/// Thoroughness.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Effort {
    /// Few items and few rounds, for tests.
    Trial,
    /// A minute for all workloads on four cores.
    #[default]
    Quick,
    /// A quarter of an hour.
    Full,
}

/// A step of a run.
#[derive(Clone, Copy, Debug)]
pub enum Progress<'a> {
    /// The machine's limits are known.
    Machine(&'a Machine),
    /// A workload begins.
    Begins(Workload),
    /// A method was measured.
    Measured(&'a Measurement),
}

/// A benchmark that cannot run.
#[derive(Debug, thiserror::Error)]
pub enum BenchError {
    /// There are no threads to be had.
    #[error("no threads to measure on: {0}")]
    Threads(#[from] rayon::ThreadPoolBuildError),
    /// The data cannot be computed with.
    #[error(transparent)]
    Data(#[from] DataError),
}
