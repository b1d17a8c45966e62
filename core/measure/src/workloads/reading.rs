//! Reading files of every family, beside a plain split of the same bytes by the `csv` crate into numbers.

mod files;

use std::hint::black_box;

use spectral_file::{ReadOptions, SpectralFile, read};

use self::files::{File, files};
use super::timing::{Bench, Candidate, Case};
use crate::measurement::Errors;
use crate::{ErrorOf, ErrorScale, Workload};

pub(super) fn run(bench: &mut Bench<'_>) {
    let bytes = bench.pick(60_000, 2_000_000, 20_000_000);
    for make in files() {
        if bench.stop.is_set() {
            return;
        }
        one(bench, &make(bytes));
    }
}

fn one(bench: &mut Bench<'_>, file: &File) {
    let bytes = file.text.as_bytes();
    let split = Candidate::new("csv crate, cells", bytes.len(), error(&of_rows(file, &rows(file)), file), |_| {
        black_box(cells(bytes, file.separator, file.comma));
    });
    let options = ReadOptions::default();
    let whole = read(bytes, &options).map_or_else(|_| Vec::new(), |table| of_table(&table));
    let reader = Candidate::new("the program's reader", bytes.len(), error(&whole, file), |_| {
        let _ = black_box(read(bytes, &options));
    });
    let case = Case { workload: Workload::Reading, name: file.name, item: "byte" };
    bench.compare(case, vec![split.undivided(), reader.undivided()]);
}

/// The curves of a file, one after the other.
type Curves = Vec<Vec<f64>>;

fn of_table(table: &SpectralFile) -> Curves {
    table.curves.iter().map(|curve| curve.values.clone()).collect()
}

/// Curves of the cells, if it is known that a file holds curves side by side, or one below the other; else nothing.
fn of_rows(file: &File, rows: &[Vec<f64>]) -> Curves {
    let wide = |count: usize| -> Curves {
        let rows = rows.iter().filter(|row| row.len() == count + 1 && row[1..].iter().all(|cell| cell.is_finite()));
        rows.map(|row| row[1..].to_vec()).collect()
    };
    let side_by_side = wide(file.curves);
    if side_by_side.len() == file.samples {
        return (0..file.curves).map(|curve| side_by_side.iter().map(|row| row[curve]).collect()).collect();
    }
    let mut below = wide(file.samples);
    // A row of wavelengths is numbers too.
    below.split_off(below.len().saturating_sub(file.curves))
}

/// Quantity of the errors.
const WHAT: &str = "values, against the numbers written";

/// The differences from the numbers that were written; nothing is right where samples are too many or too few.
fn error(found: &Curves, file: &File) -> ErrorOf {
    let mut errors = Errors::default();
    let fits = found.len() == file.curves && found.iter().all(|curve| curve.len() == file.samples);
    if !fits {
        (0..file.curves * file.samples).for_each(|_| errors.refuse());
        return errors.sum_up(WHAT, ErrorScale::Absolute);
    }
    for (curve, values) in found.iter().enumerate() {
        for (sample, value) in values.iter().enumerate() {
            let exact = (file.value)(curve, sample);
            errors.add(value - exact, exact);
        }
    }
    errors.sum_up(WHAT, ErrorScale::Absolute)
}

/// Every cell as a number, NaN where it is none, as a program would that knows how the file is laid out.
fn cells(bytes: &[u8], separator: u8, comma: bool) -> Vec<f64> {
    let mut cells = Vec::new();
    split(bytes, separator, comma, |number, _| cells.push(number));
    cells
}

fn rows(file: &File) -> Vec<Vec<f64>> {
    let mut rows: Vec<Vec<f64>> = Vec::new();
    split(file.text.as_bytes(), file.separator, file.comma, |number, first| {
        if first {
            rows.push(Vec::new());
        }
        if let Some(row) = rows.last_mut() {
            row.push(number);
        }
    });
    rows
}

/// Calls with each cell, and whether it is the first of its row.
fn split(bytes: &[u8], separator: u8, comma: bool, mut cell: impl FnMut(f64, bool)) {
    let mut reader =
        csv::ReaderBuilder::new().has_headers(false).flexible(true).delimiter(separator).from_reader(bytes);
    let mut record = csv::ByteRecord::new();
    let mut point = Vec::new();
    while reader.read_byte_record(&mut record).unwrap_or(false) {
        for (place, mut text) in record.iter().enumerate() {
            if comma {
                point.clear();
                point.extend(text.iter().map(|&byte| if byte == b',' { b'.' } else { byte }));
                text = &point;
            }
            let number = std::str::from_utf8(text.trim_ascii()).ok().and_then(|text| text.parse().ok());
            cell(number.unwrap_or(f64::NAN), place == 0);
        }
    }
}
