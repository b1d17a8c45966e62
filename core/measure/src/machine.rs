//! The machine and its limits: memory bandwidth and multiply-adds.

#[cfg(feature = "workloads")]
mod limits;

use std::fmt;

use serde::{Deserialize, Serialize};

/// The machine a bench ran on, with the limits found in the same run.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Machine {
    /// The processor's name, if the system reports it.
    pub processor: String,
    /// Number of threads it runs at a time.
    pub cores: usize,
    /// The widest instruction set that the kernels use here.
    pub instruction_set: String,
    /// Memory read by a sum over an array far beyond the caches, in GB/s: on one thread, and on all.
    pub memory_gb_per_s: [f64; 2],
    /// Multiply-adds of doubles in registers, in Gflop/s, two for each: on one thread, and on all.
    pub arithmetic_gflop_per_s: [f64; 2],
}

impl Machine {
    /// This machine without its limits, which are 0 here.
    pub fn unmeasured() -> Self {
        Self {
            processor: processor().unwrap_or_else(|| "unknown processor".to_owned()),
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

    /// The limits for a number of threads: bytes and operations per second. Between one and all of them the smaller of all,
    /// and one times their number.
    #[cfg(feature = "workloads")]
    pub(crate) fn limits(&self, threads: usize) -> [f64; 2] {
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

fn processor() -> Option<String> {
    let facts = std::fs::read_to_string("/proc/cpuinfo").ok()?;
    let line = facts.lines().find(|line| line.starts_with("model name"))?;
    Some(line.split_once(": ")?.1.trim().to_owned())
}

/// The instruction sets that the core's kernels choose from, by the same tests: multiversion takes 512 bits only where they do not slow the processor
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
