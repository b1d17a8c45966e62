//! Benchmarks of the core's kernels one by one, each repeated a given number of times: for counting instructions, which are
//! repeatable where times are not.
//!
//! ```text
//! kernels                      the names, each with its number of runs
//! kernels NAME COUNT           runs one COUNT times without output
//! kernels --quick              time of each as a ratio to a plain product of 401 samples in the same run
//! ```
//! `.ci/instructions` counts under callgrind: the difference of two counts of runs, over their difference, is free of what
//! starting costs. One thread throughout. Valgrind knows no AVX-512, so that what is compiled for several instruction sets
//! runs there as for AVX2.
#![allow(
    clippy::disallowed_methods,
    clippy::disallowed_types,
    reason = "a bench reads the clock, the data and its arguments"
)]
#![allow(clippy::print_stdout, reason = "the names and ratios are what it is run for")]
#![allow(clippy::unwrap_used, reason = "a bench that cannot go on should say so by failing")]

#[path = "kernels/library.rs"]
mod library;
#[path = "kernels/list.rs"]
mod list;

use list::{BASELINE, KERNELS, Kernel};
use std::hint::black_box;
use std::time::Instant;

fn main() {
    // A pool of the calling thread alone: nothing waits, nothing spins.
    rayon::ThreadPoolBuilder::new().num_threads(1).use_current_thread().build_global().unwrap();
    let arguments: Vec<String> = std::env::args().skip(1).filter(|argument| argument != "--bench").collect();
    match arguments.iter().map(String::as_str).collect::<Vec<_>>()[..] {
        [] => KERNELS.iter().for_each(|kernel| println!("{} {}", kernel.name, kernel.count)),
        ["--quick"] => ratios(),
        [name, count] => {
            let kernel = KERNELS.iter().find(|kernel| kernel.name == name).expect("a kernel of that name");
            repeat(&mut (kernel.ready)(), count.parse().expect("a count"));
        }
        _ => panic!("kernels [NAME COUNT | --quick]"),
    }
}

/// A kernel that is ready to run repeatedly.
type Work = Box<dyn FnMut() -> f64>;

fn repeat(work: &mut Work, count: u64) {
    for _ in 0..count {
        black_box(work());
    }
}

/// The least time of a few turns taken one after the other, beside the baseline's.
fn ratios() {
    const TURNS: usize = 7;
    let mut work: Vec<(&Kernel, Work, f64)> = KERNELS.iter().map(|k| (k, (k.ready)(), f64::INFINITY)).collect();
    for _ in 0..TURNS {
        for (kernel, work, least) in &mut work {
            let begun = Instant::now();
            repeat(work, kernel.count);
            *least = least.min(begun.elapsed().as_secs_f64() / kernel.count as f64);
        }
    }
    let baseline = work.iter().find(|(kernel, ..)| kernel.name == BASELINE).map_or(1.0, |(.., least)| *least);
    println!("kernel\ttime / {BASELINE}");
    for (kernel, _, least) in &work {
        println!("{}\t{:.2}", kernel.name, least / baseline);
    }
}
