//! Candidates take turns; a table says how long each took and how far off it is.

use std::time::Instant;

/// One way of doing a piece of work, and how far its result is from the exact one.
pub(crate) struct Candidate<'a> {
    name: &'static str,
    run: Box<dyn FnMut() + 'a>,
    error: f64,
}

/// A way of doing the work: what is timed, and the largest error of what it gives.
pub(crate) fn candidate<'a, T>(
    name: &'static str,
    mut work: impl FnMut() -> T + 'a,
    error: impl FnOnce(T) -> f64,
) -> Candidate<'a> {
    let error = error(work());
    Candidate { name, run: Box::new(move || drop(std::hint::black_box(work()))), error }
}

/// Times the candidates by turns and prints a table; the first is the baseline.
pub(crate) fn compare(title: &str, what_error: &str, rounds: usize, mut candidates: Vec<Candidate<'_>>) {
    let mut times = vec![Vec::with_capacity(rounds); candidates.len()];
    for _ in 0..rounds {
        for (candidate, times) in candidates.iter_mut().zip(&mut times) {
            let start = Instant::now();
            (candidate.run)();
            times.push(start.elapsed().as_secs_f64());
        }
    }
    let medians: Vec<f64> = times.iter_mut().map(|times| median(times)).collect();
    println!("\n{title}");
    println!("  {:<44} {:>10} {:>8}  {what_error}", "", "median", "ratio");
    for (candidate, time) in candidates.iter().zip(&medians) {
        let error = if candidate.error.is_nan() { "-".to_owned() } else { format!("{:.1e}", candidate.error) };
        println!("  {:<44} {:>7.3} ms {:>8.3}  {error}", candidate.name, 1e3 * time, time / medians[0]);
    }
}

/// The middle one.
pub(crate) fn median(times: &mut [f64]) -> f64 {
    times.sort_by(f64::total_cmp);
    times[times.len() / 2]
}
