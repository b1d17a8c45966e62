//! The benchmark, in a build that has it.

use chromascope_core::render::Stop;
use chromascope_measure::{BenchError, Effort, Progress, Report, Workload};

/// The benchmark: measures workloads, telling of its progress, until it is done or stopped.
pub type Bench = fn(&[Workload], Effort, &Stop, &mut dyn FnMut(Progress<'_>)) -> Result<Report, BenchError>;

/// The command that runs the program with the benchmark.
pub const BUILD: &str = "cargo run --release --features bench";

#[cfg(feature = "bench")]
pub fn bench() -> Option<Bench> {
    Some(chromascope_measure::run)
}

/// Returns none: this build has no benchmark.
#[cfg(not(feature = "bench"))]
pub fn bench() -> Option<Bench> {
    None
}
