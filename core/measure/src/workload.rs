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
}

impl Workload {
    /// All, in the order of the pipeline's queries.
    pub const ALL: [Self; 6] =
        [Self::Locus, Self::Responses, Self::DiffuseSum, Self::Integral, Self::Frames, Self::Temperature];

    /// The name to request it by, also that of its files.
    pub const fn name(self) -> &'static str {
        self.words()[0]
    }

    /// Title in a few words.
    pub const fn title(self) -> &'static str {
        self.words()[1]
    }

    const fn words(self) -> [&'static str; 2] {
        match self {
            Self::Locus => ["locus", "Chromaticities of blackbodies, 1000 to 20 000 K"],
            Self::Responses => ["responses", "Responses of reflectances through sensitivities"],
            Self::DiffuseSum => ["diffuse-sum", "The diffuse sum S(g, b)"],
            Self::Integral => ["integral", "The spectral integral of a pixel"],
            Self::Frames => ["frames", "Frames of the head through four sources"],
            Self::Temperature => ["temperature", "Correlated color temperature and Duv"],
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
