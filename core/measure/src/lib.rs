#![doc = include_str!("../README.md")]

mod data;
pub mod harness;
pub mod loci;
mod machine;
pub mod method;
pub mod pareto;
mod report;
mod workload;
#[cfg(feature = "workloads")]
mod workloads;

pub use data::DataError;
pub use machine::Machine;
pub use report::{Report, ReportError, program};
pub use workload::{BenchError, Effort, ErrorOf, ErrorScale, Measurement, Progress, Roof, Workload};
#[cfg(feature = "workloads")]
pub use workloads::{exact, run};
