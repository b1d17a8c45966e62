//! Run time against error: every method the core has, on every workload, beside a reference that is not the code under test.
//!
//! ```text
//! plan of workloads ──► cases: items, a reference in 106 bits, candidates ──► rounds in turns ──► Report
//!                                                                                       │ figures, table, JSON
//! ```
//! Candidates of a case take turns, so that a slow moment of the machine falls on all of them; times are medians, ratios are
//! medians of the ratios to the case's baseline in the same round. No time is reported without an error.

mod case;
mod difference;
mod diffuse_sum;
pub mod exact;
mod figure;
mod frames;
mod inputs;
mod integral;
mod locus;
mod machine;
mod reading;
mod report;
mod responses;
mod temperature;
mod timing;

pub use case::{ErrorOf, ErrorScale, Measurement, Roof};
pub use machine::Machine;
pub use report::{Report, ReportError};

use chromascope_core::render::Stop;
use serde::{Deserialize, Serialize};

use self::timing::{Bench, Pools};

/// What is measured.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Workload {
    /// Chromaticities of black bodies, 1000 to 20 000 K.
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
    /// Files of spectra.
    Reading,
    /// Color differences ΔE*00.
    Difference,
}

impl Workload {
    /// All, in the order of the pipeline's questions.
    pub const ALL: [Self; 8] = [
        Self::Locus,
        Self::Responses,
        Self::DiffuseSum,
        Self::Integral,
        Self::Frames,
        Self::Temperature,
        Self::Reading,
        Self::Difference,
    ];

    /// The name to ask for it by, also that of its files.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Locus => "locus",
            Self::Responses => "responses",
            Self::DiffuseSum => "diffuse-sum",
            Self::Integral => "integral",
            Self::Frames => "frames",
            Self::Temperature => "temperature",
            Self::Reading => "reading",
            Self::Difference => "difference",
        }
    }

    /// What it is, in a few words.
    pub const fn title(self) -> &'static str {
        match self {
            Self::Locus => "Chromaticities of blackbodies, 1000 to 20 000 K",
            Self::Responses => "Responses of reflectances through sensitivities",
            Self::DiffuseSum => "The diffuse sum S(g, b)",
            Self::Integral => "The spectral integral of a pixel",
            Self::Frames => "Frames of the head through four sources",
            Self::Temperature => "Correlated color temperature and Duv",
            Self::Reading => "Reading files of spectra",
            Self::Difference => "Color differences \u{394}E*00",
        }
    }

    /// The workload of a name.
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|workload| workload.name() == name)
    }
}

/// How much time may be taken.
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

/// What happens while it runs.
#[derive(Clone, Copy, Debug)]
pub enum Progress<'a> {
    /// The machine's limits are known.
    Machine(&'a Machine),
    /// A workload begins.
    Begins(Workload),
    /// A method was measured.
    Measured(&'a Measurement),
}

/// Why nothing can be measured.
#[derive(Debug, thiserror::Error)]
pub enum BenchError {
    /// There are no threads to be had.
    #[error("no threads to measure on: {0}")]
    Threads(#[from] rayon::ThreadPoolBuildError),
    /// The data that come with the program cannot be computed with.
    #[error("{0}")]
    Data(#[from] crate::catalog::load::LoadError),
}

/// This moment in UTC to the second, as `2026-11-21T18:05:11Z`.
pub(crate) fn now() -> String {
    jiff::Timestamp::now().round(jiff::Unit::Second).map_or_else(|_| String::new(), |now| now.to_string())
}

/// The program and its version.
pub(crate) fn program() -> String {
    concat!("Chromascope ", env!("CARGO_PKG_VERSION")).to_owned()
}

/// Measures the workloads of a plan in its order. Once the stop is set, the report ends with the last whole case.
pub fn run(
    plan: &[Workload],
    effort: Effort,
    stop: &Stop,
    progress: &mut dyn FnMut(Progress<'_>),
) -> Result<Report, BenchError> {
    let began = now();
    let pools = Pools::new()?;
    let machine = Machine::measure(effort, &pools);
    progress(Progress::Machine(&machine));
    let mut bench = Bench { effort, stop, pools, machine, progress, measurements: Vec::new() };
    for &workload in plan {
        if stop.is_set() {
            break;
        }
        (bench.progress)(Progress::Begins(workload));
        match workload {
            Workload::Locus => locus::run(&mut bench)?,
            Workload::Responses => responses::run(&mut bench)?,
            Workload::DiffuseSum => diffuse_sum::run(&mut bench),
            Workload::Integral => integral::run(&mut bench)?,
            Workload::Frames => frames::run(&mut bench)?,
            Workload::Temperature => temperature::run(&mut bench)?,
            Workload::Reading => reading::run(&mut bench),
            Workload::Difference => difference::run(&mut bench),
        }
    }
    let Bench { machine, measurements, .. } = bench;
    Ok(Report { program: program(), began, machine, effort, whole: !stop.is_set(), measurements })
}
