//! Wavelengths and values on alternate lines below `@date`, `@time` and `#title`, as Macam writes.

use crate::decision::{Decided, DecimalMark, Delimiter, Reader, Role};
use crate::dialect::Dialect;
use crate::error::ReadError;
use crate::formats::Format;
use crate::formats::spectra::{self, Found, Sample, Spectrum};
use crate::header::Header;
use crate::options::ReadOptions;
use crate::text::{Lines, excerpt};
use crate::watch::Log;

impl Reader {
    /// Wavelengths and values on alternate lines, as Macam writes.
    pub const ALTERNATE: Self = Self::new("alternate", "wavelengths and values on alternate lines", "Alternate lines");
}

pub(super) const FORMAT: Format =
    Format { reader: Reader::ALTERNATE, fits: |head| head.is_plain() && recognize(head.text, head.chosen), read };

/// Lines of numbers that are looked at.
const LOOK: usize = 16;

/// Returns whether single numbers stand in the lines, below one that begins with `@`, or every other one a wavelength.
fn recognize(text: &str, chosen: bool) -> bool {
    let mut lines = Lines::new(text).map(|(_, line)| line.trim()).filter(|line| !line.is_empty()).peekable();
    let marked = lines.peek().is_some_and(|line| line.starts_with('@'));
    let numbers = lines.skip_while(|line| line.starts_with(['@', '#'])).take(LOOK).map(number);
    let Some(numbers) = numbers.collect::<Option<Vec<f64>>>() else { return false };
    marked || chosen || numbers.len() == LOOK && alternates(&numbers)
}

/// Returns whether every other number is a wavelength, in equal steps, and the ones between them are no wavelengths.
fn alternates(numbers: &[f64]) -> bool {
    const CLOSE: f64 = 1e-6;
    let wavelengths: Vec<f64> = numbers.iter().step_by(2).copied().collect();
    let step = wavelengths[1] - wavelengths[0];
    wavelengths.iter().all(|nm| (100.0..=25_000.0).contains(nm))
        && step > 0.0
        && wavelengths.windows(2).all(|pair| (pair[1] - pair[0] - step).abs() <= CLOSE * pair[1])
        && numbers.windows(2).any(|pair| pair[1] < pair[0])
}

fn number(cell: &str) -> Option<f64> {
    Dialect::of_number(cell).value(cell)
}

fn read(text: &str, _: &ReadOptions, log: &mut Log<'_>) -> Result<Found, ReadError> {
    let mut header = Header::default();
    let mut samples = Vec::new();
    let mut wavelength = None;
    let mut comma = false;
    for (line, cell) in Lines::new(text).map(|(line, text)| (line, text.trim())).filter(|(_, cell)| !cell.is_empty()) {
        log.at(cell.as_ptr() as usize - text.as_ptr() as usize)?;
        if let Some(title) = cell.strip_prefix('#') {
            if title.trim() != "No Title" {
                header.note(line, "title", title.trim());
            }
            continue;
        }
        if let Some(date) = cell.strip_prefix('@') {
            header.note(line, "date", date.trim());
            continue;
        }
        let broken = || ReadError::NotANumber { line, column: 1, text: excerpt(cell) };
        let found = number(cell).ok_or_else(broken)?;
        comma |= cell.contains(',');
        match wavelength.take() {
            None => wavelength = Some((line, cell, found)),
            Some((line, written, wavelength)) if found.is_finite() && f64::is_finite(wavelength) => {
                let place = log.places.as_mut().map(|places| places.pair(written, cell)).unwrap_or_default();
                samples.push(Sample { wavelength, value: found, line, place });
            }
            Some(_) => {}
        }
    }
    if let Some((line, ..)) = wavelength {
        return Err(ReadError::UnevenRow { line, found: 1, expected: 2 });
    }
    let first_line = samples.first().map(|sample| sample.line).ok_or(ReadError::NoNumbers)?;
    let mut grid = spectra::grid(vec![Spectrum { samples, ..Spectrum::default() }], header, log)?;
    grid.role = Some(Decided::guess(Role::Illuminant, "Meters that write such files measure light"));
    let mark = if comma { DecimalMark::Comma } else { DecimalMark::Point };
    let why = "Single numbers stand in the lines, every other one a wavelength";
    let marked = "The first line begins with @, and single numbers follow";
    let reader = if text.trim_start().starts_with('@') {
        Decided::certain(Reader::ALTERNATE, marked)
    } else {
        Decided::guess(Reader::ALTERNATE, why)
    };
    let why = reader.why.clone();
    Ok(Found::fixed(grid, reader, ((Delimiter::Elements, mark), first_line, &why), Vec::new()))
}
