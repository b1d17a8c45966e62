//! What a window waits for: whole screens and frames, what a change makes anew, how cost grows, what reading takes.
//!
//! Methods one beside the other, run time against error, are measured by `chromascope bench`.
//!
//! `cargo bench -p chromascope-core --bench compare [-- --quick document slider render growth reading]`. Times are medians over rounds in which the candidates take
//! turns, so that a slow moment of the machine falls on all of them. Errors are against compensated sums (Neumaier), which a
//! double cannot tell from exact ones.
#![allow(
    clippy::disallowed_methods,
    clippy::disallowed_types,
    reason = "a bench reads the clock, the data and its arguments"
)]
#![allow(clippy::print_stdout, reason = "the table is what a bench is for")]
#![allow(clippy::unwrap_used, reason = "a bench that cannot go on should say so by failing")]

#[path = "compare/asker.rs"]
mod asker;
#[path = "compare/exact.rs"]
mod exact;
#[allow(dead_code, reason = "what is in the files is compared where it is timed, in the program's own bench")]
#[path = "../../src/bench/reading/files.rs"]
mod files;
#[path = "compare/library.rs"]
mod library;
#[path = "compare/memory.rs"]
mod memory;
#[path = "compare/pictures.rs"]
mod pictures;
#[path = "compare/reading.rs"]
mod reading;
#[path = "compare/render.rs"]
mod render;
#[path = "compare/stopwatch.rs"]
mod stopwatch;
#[path = "compare/workloads.rs"]
mod workloads;

/// A name to ask for it by, and what to run for how many rounds.
type Workload = (&'static str, fn(usize));

fn main() {
    // As the window's worker: the thread that asks is one of those that compute.
    rayon::ThreadPoolBuilder::new().use_current_thread().build_global().unwrap();
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let quick = arguments.iter().any(|argument| argument == "--quick");
    let rounds = if quick { 5 } else { 41 };
    let cores = std::thread::available_parallelism().map_or(0, usize::from);
    println!("{} · {cores} cores, one used but for pictures · medians of {rounds} rounds", library::processor());
    let named: Vec<&String> = arguments.iter().filter(|argument| !argument.starts_with('-')).collect();
    let workloads: [Workload; 5] = [
        ("document", workloads::document),
        ("slider", workloads::slider),
        ("render", render::render),
        ("growth", render::growth),
        ("reading", reading::reading),
    ];
    for (name, run) in workloads {
        if named.is_empty() || named.iter().any(|wanted| *wanted == name) {
            run(rounds);
        }
    }
}
