//! The machine, and how fast it can be.

use std::fmt;
use std::hint::black_box;
use std::time::Instant;

use multiversion::multiversion;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use super::Effort;
use super::timing::Pools;

/// The machine a bench ran on, with the limits found in the same run.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Machine {
    /// The processor's name, where the system says it.
    pub processor: String,
    /// How many threads it runs at a time.
    pub cores: usize,
    /// The widest instruction set that the kernels use here.
    pub instruction_set: String,
    /// What a sum over an array far beyond the caches reads, in GB/s: on one thread, and on all.
    pub memory_gb_per_s: [f64; 2],
    /// Multiply-adds of doubles in registers, in Gflop/s, two for each: on one thread, and on all.
    pub arithmetic_gflop_per_s: [f64; 2],
}

/// Doubles side by side in the widest register.
const WIDTH: usize = 8;
/// Doubles per piece of work of the memory's sum.
const CHUNK: usize = 1 << 16;

impl Machine {
    /// What it is, without its limits, which are 0 here.
    pub fn unmeasured() -> Self {
        Self {
            processor: crate::files::processor().unwrap_or_else(|| "unknown processor".to_owned()),
            cores: std::thread::available_parallelism().map_or(1, usize::from),
            instruction_set: instruction_set().to_owned(),
            ..Self::default()
        }
    }

    /// The processor, how many threads it runs at a time, and its instruction set, in words.
    pub fn identity(&self) -> String {
        let Self { processor, cores, instruction_set, .. } = self;
        format!("{processor}, {cores} {}, {instruction_set}", if *cores == 1 { "core" } else { "cores" })
    }

    /// Looks at the machine, and measures the most it can do: the best of some rounds.
    pub(super) fn measure(effort: Effort, pools: &Pools) -> Self {
        let (megabytes, rounds) = match effort {
            Effort::Trial => (8, 2),
            Effort::Quick => (256, 7),
            Effort::Full => (512, 15),
        };
        let array = vec![1.0_f64; megabytes * 1_000_000 / size_of::<f64>()];
        let bytes = size_of_val(array.as_slice()) as f64;
        let turns = if effort == Effort::Trial { 1_000 } else { 1_000_000 };
        let most = |threads: usize, work: &(dyn Fn() + Sync)| {
            let seconds = || {
                let start = Instant::now();
                work();
                start.elapsed().as_secs_f64()
            };
            pools.on(threads, || (0..rounds).map(|_| seconds()).fold(f64::INFINITY, f64::min))
        };
        let memory = |threads| {
            let read = || {
                black_box(array.par_chunks(CHUNK).map(sum).sum::<f64>());
            };
            bytes / most(threads, &read) * 1e-9
        };
        let arithmetic = |threads: usize| {
            let of = |rows: usize, kernel: fn(u32, f64) -> f64| {
                let compute = || {
                    let each = (0..threads).into_par_iter().map(|thread| kernel(turns, 1.0 + thread as f64));
                    black_box(each.sum::<f64>());
                };
                2.0 * (WIDTH * rows * threads) as f64 * f64::from(turns) / most(threads, &compute) * 1e-9
            };
            // Twelve registers keep two units with a latency of four to five busy: of half the width, or of all of it.
            of(6, multiply_add::<6>).max(of(12, multiply_add::<12>))
        };
        let cores = pools.most();
        Self {
            cores,
            memory_gb_per_s: [memory(1), memory(cores)],
            arithmetic_gflop_per_s: [arithmetic(1), arithmetic(cores)],
            ..Self::unmeasured()
        }
    }

    /// The limits for a number of threads: bytes and operations per second. Between one and all of them the smaller of all,
    /// and one times their number.
    pub(super) fn limits(&self, threads: usize) -> [f64; 2] {
        [self.memory_gb_per_s, self.arithmetic_gflop_per_s]
            .map(|[one, all]| 1e9 * if threads >= self.cores { all } else { (one * threads as f64).min(all.max(one)) })
    }
}

impl fmt::Display for Machine {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let identity = self.identity();
        let ([memory, all_memory], [flops, all_flops]) = (self.memory_gb_per_s, self.arithmetic_gflop_per_s);
        write!(
            f,
            "{identity}; memory {memory:.1} GB/s on one, {all_memory:.1} on all; \
             multiply-adds {flops:.1} Gflop/s on one, {all_flops:.1} on all"
        )
    }
}

/// What the core's kernels choose from, by the same tests: multiversion takes 512 bits only where they do not slow the processor
/// down, of which its newest extensions are the sign.
fn instruction_set() -> &'static str {
    #[cfg(target_arch = "x86_64")]
    {
        if is_x86_feature_detected!("avx512vl")
            && is_x86_feature_detected!("avx512vbmi2")
            && is_x86_feature_detected!("avx512vpopcntdq")
            && is_x86_feature_detected!("vpclmulqdq")
        {
            return "AVX-512";
        }
        if is_x86_feature_detected!("avx2") {
            return "AVX2";
        }
        "SSE2"
    }
    #[cfg(target_arch = "aarch64")]
    {
        "NEON"
    }
    #[cfg(not(any(target_arch = "x86_64", target_arch = "aarch64")))]
    {
        "the compiler's default"
    }
}

#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl+avx512bw+avx512cd", "x86_64+avx2", "aarch64+neon"))]
fn sum(values: &[f64]) -> f64 {
    let mut lanes = [0.0; 32];
    for chunk in values.as_chunks::<32>().0 {
        for (lane, value) in lanes.iter_mut().zip(chunk) {
            *lane += value;
        }
    }
    lanes.iter().sum()
}

#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl+avx512bw+avx512cd+fma", "x86_64+avx2+fma", "aarch64+neon"))]
fn multiply_add<const ROWS: usize>(turns: u32, start: f64) -> f64 {
    let mut lanes: [[f64; WIDTH]; ROWS] =
        std::array::from_fn(|row| std::array::from_fn(|lane| start + (WIDTH * row + lane) as f64));
    let (factor, term) = ([black_box(0.999); WIDTH], [black_box(1e-3); WIDTH]);
    for _ in 0..turns {
        for row in &mut lanes {
            for lane in 0..WIDTH {
                row[lane] = row[lane].mul_add(factor[lane], term[lane]);
            }
        }
    }
    lanes.iter().flatten().sum()
}
