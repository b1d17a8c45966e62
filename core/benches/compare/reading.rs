//! How fast files of every family are read, and how much memory that takes, beside a plain parse of the same bytes by the
//! `csv` crate into cells.
//!
//! The numbers in the files are known, so that every value read is compared with the one written.

use std::cell::Cell;
use std::time::Instant;

use chromascope_core::table::{ReadError, ReadOptions, Table, Watch, read, read_watched};

use crate::files::{File, digits, files};
use crate::memory::peak;
use crate::stopwatch::median;

const MB: f64 = 1e6;

/// Files of every family, of 60 MB or, in a quick run, 4 MB each.
pub(crate) fn reading(rounds: usize) {
    let quick = rounds < 10;
    let (bytes, rounds) = if quick { (4_000_000, 3) } else { (60_000_000, 3) };
    println!("\nfiles of {} MB: read, and split into cells by the csv crate (baseline)", bytes / 1_000_000);
    println!(
        "  {:<34} {:>9} {:>10} {:>10} {:>9} {:>7} {:>9}",
        "", "read", "csv crate", "time", "max", "peak", "longest"
    );
    println!(
        "  {:<34} {:>9} {:>10} {:>10} {:>9} {:>7} {:>9}",
        "", "MB/s", "MB/s", "ratio", "error", "/ size", "wait ms"
    );
    for make in files() {
        row(&make(bytes), rounds);
    }
    first_curve();
}

/// One line of the table.
fn row(file: &File, rounds: usize) {
    let bytes = file.text.as_bytes();
    let size = bytes.len() as f64;
    let options = ReadOptions::default();
    let (table, wait) = watched(bytes);
    let error = match table {
        Ok(table) => error(&table, file),
        Err(error) => {
            println!("  {:<34} {error}", file.name);
            return;
        }
    };
    let memory = peak(|| read(bytes, &options)) as f64 / size;
    let mut times = [Vec::new(), Vec::new()];
    for _ in 0..rounds {
        times[0].push(seconds(|| read(bytes, &options)));
        times[1].push(seconds(|| plain(bytes, file.separator, file.comma)));
    }
    let [read, plain] = times.map(|mut times| median(&mut times));
    println!(
        "  {:<34} {:>9.0} {:>10.0} {:>10.3} {error:>9.1e} {memory:>7.2} {:>9.1}",
        file.name,
        size / MB / read,
        size / MB / plain,
        read / plain,
        1e3 * wait,
    );
}

fn seconds<T>(work: impl FnOnce() -> T) -> f64 {
    let start = Instant::now();
    drop(std::hint::black_box(work()));
    start.elapsed().as_secs_f64()
}

/// The largest difference of a value from the one written; infinite where samples are too many or too few.
fn error(table: &Table, file: &File) -> f64 {
    let shape =
        table.curves.len() == file.curves && table.curves.iter().all(|curve| curve.values.len() == file.samples);
    if !shape {
        return f64::INFINITY;
    }
    let curves = table.curves.iter().enumerate();
    let differences = curves.flat_map(|(curve, read)| {
        read.values.iter().enumerate().map(move |(sample, value)| (value - (file.value)(curve, sample)).abs())
    });
    differences.fold(0.0, f64::max)
}

/// What is read, and the longest time in seconds between two looks at the wish to stop: no stop takes longer.
fn watched(bytes: &[u8]) -> (Result<Table, ReadError>, f64) {
    let (last, longest) = (Cell::new(Instant::now()), Cell::new(0.0_f64));
    let look = |_| {
        longest.set(longest.get().max(last.replace(Instant::now()).elapsed().as_secs_f64()));
        true
    };
    let table = read_watched(bytes, &ReadOptions::default(), Watch::new(&look));
    look(1.0);
    (table, longest.get())
}

/// Every cell as a number, NaN where it is none, as a program would that knows how the file is laid out.
fn plain(bytes: &[u8], separator: u8, comma: bool) -> Vec<f64> {
    let mut reader =
        csv::ReaderBuilder::new().has_headers(false).flexible(true).delimiter(separator).from_reader(bytes);
    let mut record = csv::ByteRecord::new();
    let mut cells = Vec::new();
    let mut point = Vec::new();
    while reader.read_byte_record(&mut record).unwrap() {
        for mut cell in &record {
            if comma {
                point.clear();
                point.extend(cell.iter().map(|&byte| if byte == b',' { b'.' } else { byte }));
                cell = &point;
            }
            let number = std::str::from_utf8(cell.trim_ascii()).ok().and_then(|text| text.parse().ok());
            cells.push(number.unwrap_or(f64::NAN));
        }
    }
    cells
}

/// How long it takes to have the curve of a file of 4000 lines with two columns.
fn first_curve() {
    let lines = (0..4000).map(|i| format!("{:.2}\t0.{}\n", 300.0 + 0.2 * f64::from(i), digits(0, i as usize)));
    let text: String = lines.collect();
    let options = ReadOptions::default();
    let mut times: Vec<f64> = (0..41).map(|_| seconds(|| read(text.as_bytes(), &options).unwrap())).collect();
    println!("  first curve of two columns with 4000 samples: {:.3} ms", 1e3 * median(&mut times));
}
