//! The machine's limits: kernels that do nothing but read memory, or multiply and add.

use super::Machine;
use crate::harness::shortest_of;
use crate::workload::Effort;
use crate::workloads::timing::Pools;
use multiversion::multiversion;
use rayon::prelude::*;
use std::hint::black_box;

/// Doubles side by side in the widest register.
const WIDTH: usize = 8;
const CHUNK: usize = 1 << 16;

impl Machine {
    pub(crate) fn measure(effort: Effort, pools: &Pools) -> Self {
        let (megabytes, rounds) = match effort {
            Effort::Trial => (8, 2),
            Effort::Quick => (256, 7),
            Effort::Full => (512, 15),
        };
        let array = vec![1.0_f64; megabytes * 1_000_000 / size_of::<f64>()];
        let bytes = size_of_val(array.as_slice()) as f64;
        let turns = if effort == Effort::Trial { 1_000 } else { 1_000_000 };
        let most = |threads: usize, work: &(dyn Fn() + Sync)| pools.on(threads, || shortest_of(rounds, work));
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
