//! Times of several methods that take turns, so that a slow moment of the machine falls on all of them.

use std::hint::black_box;
use std::time::{Duration, Instant};

use chromascope_core::render::Stop;

/// So many rounds at least, and for so long.
const ROUNDS: usize = 5;
const AT_LEAST: Duration = Duration::from_millis(100);
/// A slow method is given up after the least rounds once so much was spent.
const AT_MOST: Duration = Duration::from_secs(1);

/// Seconds of each method by its median over the rounds; none if stopped.
pub(super) fn medians<T>(methods: &[&dyn Fn() -> T], stop: &Stop) -> Option<Vec<f64>> {
    let mut times = vec![Vec::new(); methods.len()];
    if methods.is_empty() {
        return Some(Vec::new());
    }
    let start = Instant::now();
    while times[0].len() < ROUNDS || start.elapsed() < AT_LEAST {
        for (method, times) in methods.iter().zip(&mut times) {
            if stop.is_set() {
                return None;
            }
            let begun = Instant::now();
            black_box(method());
            times.push(begun.elapsed().as_secs_f64());
        }
        if times[0].len() >= 3 && start.elapsed() > AT_MOST {
            break;
        }
    }
    Some(times.into_iter().map(median).collect())
}

/// How long something takes once, with what it gives.
pub(super) fn once<T>(work: impl FnOnce() -> T) -> (T, f64) {
    let begun = Instant::now();
    let made = black_box(work());
    (made, begun.elapsed().as_secs_f64())
}

/// The shortest that something takes of three times.
pub(super) fn shortest<T>(mut work: impl FnMut() -> T) -> f64 {
    (0..3).map(|_| once(&mut work).1).fold(f64::INFINITY, f64::min)
}

fn median(mut times: Vec<f64>) -> f64 {
    times.sort_by(f64::total_cmp);
    times.get(times.len() / 2).copied().unwrap_or(0.0)
}
