//! How much memory reading files of every family takes, and how long a wish to stop waits. How fast it is, and that every
//! value is right, `chromascope bench --only reading` measures.

use std::cell::Cell;
use std::time::Instant;

use spectral_file::{ReadError, ReadOptions, SpectralFile, Watch, read, read_watched};

use crate::files::{File, digits, files};
use crate::memory::peak;
use crate::stopwatch::median;

/// Files of every family, of 60 MB or, in a quick run, 4 MB each.
pub(crate) fn reading(rounds: usize) {
    let bytes = if rounds < 10 { 4_000_000 } else { 60_000_000 };
    println!("\nreading files of {} MB", bytes / 1_000_000);
    println!("  {:<34} {:>12} {:>16}", "", "peak / size", "longest wait, ms");
    for make in files() {
        row(&make(bytes));
    }
    first_curve();
}

/// One line of the table.
fn row(file: &File) {
    let bytes = file.text.as_bytes();
    let (table, wait) = watched(bytes);
    if let Err(error) = table {
        println!("  {:<34} {error}", file.name);
        return;
    }
    let memory = peak(|| read(bytes, &ReadOptions::default())) as f64 / bytes.len() as f64;
    println!("  {:<34} {memory:>12.2} {:>16.1}", file.name, 1e3 * wait);
}

fn seconds<T>(work: impl FnOnce() -> T) -> f64 {
    let start = Instant::now();
    drop(std::hint::black_box(work()));
    start.elapsed().as_secs_f64()
}

/// What is read, and the longest time in seconds between two looks at the wish to stop: no stop takes longer.
fn watched(bytes: &[u8]) -> (Result<SpectralFile, ReadError>, f64) {
    let (last, longest) = (Cell::new(Instant::now()), Cell::new(0.0_f64));
    let look = |_| {
        longest.set(longest.get().max(last.replace(Instant::now()).elapsed().as_secs_f64()));
        true
    };
    let table = read_watched(bytes, &ReadOptions::default(), Watch::new(&look));
    look(1.0);
    (table, longest.get())
}

/// How long it takes to have the curve of a file of 4000 lines with two columns.
fn first_curve() {
    let lines = (0..4000).map(|i| format!("{:.2}\t0.{}\n", 300.0 + 0.2 * f64::from(i), digits(0, i as usize)));
    let text: String = lines.collect();
    let options = ReadOptions::default();
    let mut times: Vec<f64> = (0..41).map(|_| seconds(|| read(text.as_bytes(), &options).unwrap())).collect();
    println!("  first curve of two columns with 4000 samples: {:.3} ms", 1e3 * median(&mut times));
}
