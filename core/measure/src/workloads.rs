//! The workloads, each with candidates and a reference that is not the code under test.
//!
//! ```text
//! plan of workloads ──► cases: items, a reference in 106 bits, candidates ──► rounds in turns ──► Report
//! ```
//! Candidates of a case take turns; times are medians, ratios are medians of the ratios to the case's baseline in the same
//! round. No time is reported without an error.

mod diffuse_sum;
pub mod exact;
mod frames;
mod integral;
mod locus;
mod responses;
mod temperature;
pub(crate) mod timing;

use self::timing::{Bench, Pools};
use crate::harness::now;
use crate::machine::Machine;
use crate::report::Report;
use crate::workload::{BenchError, Effort, Progress, Workload};
use chromascope_core::light::RadiationConstants;
use chromascope_core::render::Stop;
use chromascope_math::random::SplitMix64;

const CONSTANTS: RadiationConstants = RadiationConstants::Paper;
/// The observer of color temperatures.
const OBSERVER: &str = "observers/cie_1931_2deg.csv";
/// The camera that stands for all.
const CAMERA: &str = "cameras/nikon_d70_2007_figure.csv";
/// The light that stands for all.
const LIGHT: &str = "illuminants/direct_sun_astm_g173.csv";
/// The reflectance that stands for all.
const REFLECTANCE: &str = "materials/skin_vrhel.csv";

/// Measures the workloads of a plan in its order. Once the stop is set, the report ends with the last whole case.
///
/// # Errors
/// Fails where no threads can be started, and where a data set of a workload is damaged.
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
        }
    }
    let Bench { machine, measurements, .. } = bench;
    Ok(Report { program: crate::report::program(), began, machine, effort, whole: !stop.is_set(), measurements })
}

/// Numbers that look like chance and are the same in every run.
struct Numbers(SplitMix64);

impl Numbers {
    fn new(seed: u64) -> Self {
        Self(SplitMix64::new(seed))
    }

    /// The next, evenly from `low` to `high`.
    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.0.unit()
    }

    /// The next, its logarithm evenly.
    fn log_between(&mut self, low: f64, high: f64) -> f64 {
        self.between(low.ln(), high.ln()).exp()
    }
}
