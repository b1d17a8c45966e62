//! Run time and error of the color differences ΔE*00 on this machine, as comma-separated values.
//!
//! `cargo run --release -p chromascope-measure --features workloads --example color-differences`
#![allow(clippy::print_stdout, reason = "the table is what it is run for")]

use chromascope_core::render::Stop;
use chromascope_measure::{BenchError, Effort, Workload, run};

fn main() -> Result<(), BenchError> {
    let report = run(&[Workload::Difference], Effort::Quick, &Stop::NEVER, &mut |_| ())?;
    print!("{}", report.table().to_csv());
    Ok(())
}
