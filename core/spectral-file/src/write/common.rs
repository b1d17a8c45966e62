//! One grid for all curves, as most formats want it.

use crate::limits::MAX_SAMPLES;
use crate::write::format::{Format, Grid};
use crate::write::note::{Note, WriteError};
use crate::write::resample::{Changes, SAME_NM, Sampling, even_step, mean_step, multiples};
use crate::write::sheet::{Content, Piece};

/// Limits of a format, or of the program that reads it.
pub(super) struct Limits {
    pub(super) format: Format,
    /// The wavelengths in nanometers.
    pub(super) range_nm: [f64; 2],
    pub(super) bands: usize,
    /// True if wavelengths are ones that the program reads.
    pub(super) reads: fn(&[f64]) -> bool,
}

/// Curves on one grid.
#[derive(Debug)]
pub(super) struct Common {
    pub(super) wavelengths: Vec<f64>,
    /// The values of each curve at those wavelengths.
    pub(super) values: Vec<Vec<f64>>,
    /// Resampling, if there was any.
    pub(super) resampling: Option<String>,
}

/// The steps in nanometers that are tried where curves have no grid in common that the format takes.
const STEPS_NM: [f64; 3] = [1.0, 5.0, 10.0];

/// Brings curves onto one grid within the range that all of them cover.
pub(super) fn common(
    pieces: &[Piece<'_>],
    content: Content<'_>,
    grid: Grid,
    limits: &Limits,
    notes: &mut Vec<Note>,
) -> Result<Common, WriteError> {
    let sampling = Sampling::of(grid);
    let ranges = pieces.iter().map(|piece| sampling.within(piece.range()));
    let range = ranges.fold(limits.range_nm, |[a, b], [from, to]| [a.max(from), b.min(to)]);
    let (wavelengths, step) = match grid {
        Grid::Step(step) | Grid::Average(step) => (asked(step, range, limits)?, Some(step)),
        Grid::Native => match own(pieces, range).filter(|own| limits.take(own)) {
            Some(own) => (own, None),
            None => sensible(pieces, range, limits).map(|(wavelengths, step)| (wavelengths, Some(step)))?,
        },
    };
    let (Some(&from), Some(&to)) = (wavelengths.first(), wavelengths.last()) else {
        return Err(WriteError::NoOverlap);
    };
    if wavelengths.len() < 2 {
        return Err(WriteError::NoOverlap);
    }
    if wavelengths.len().saturating_mul(pieces.len()) > MAX_SAMPLES {
        return Err(WriteError::TooLarge);
    }
    let mut changes = Changes::new(sampling);
    let values = pieces.iter().map(|piece| changes.take(piece, content, &wavelengths)).collect();
    changes.note(step, [from, to], notes);
    Ok(Common { wavelengths, values, resampling: changes.description(step) })
}

impl Limits {
    fn take(&self, wavelengths: &[f64]) -> bool {
        wavelengths.len() > 1 && wavelengths.len() <= self.bands && (self.reads)(wavelengths)
    }
}

/// The multiples of the requested step.
fn asked(step: f64, range: [f64; 2], limits: &Limits) -> Result<Vec<f64>, WriteError> {
    let wavelengths = multiples(step, range)?;
    let (format, found, most) = (limits.format, wavelengths.len(), limits.bands);
    if found > 1 && !(limits.reads)(&wavelengths) {
        return Err(WriteError::StepOfFormat { format, step_nm: step });
    }
    if found > most { Err(WriteError::Bands { format, found, most }) } else { Ok(wavelengths) }
}

/// The wavelengths in a range, if they are the same in all curves.
fn own(pieces: &[Piece<'_>], [from, to]: [f64; 2]) -> Option<Vec<f64>> {
    let within = |piece: &Piece<'_>| {
        let start = piece.wavelengths.partition_point(|&w| w < from - SAME_NM);
        start..piece.wavelengths.partition_point(|&w| w <= to + SAME_NM).max(start)
    };
    let first = pieces.first()?;
    let own = &first.wavelengths[within(first)];
    let same = |piece: &Piece<'_>| {
        let other = &piece.wavelengths[within(piece)];
        other.len() == own.len() && other.iter().zip(own).all(|(a, b)| (a - b).abs() <= SAME_NM)
    };
    pieces.iter().all(same).then(|| own.to_vec())
}

/// Multiples of the largest step that is not above that of the curves, or of a larger one if there would be too many.
fn sensible(pieces: &[Piece<'_>], range: [f64; 2], limits: &Limits) -> Result<(Vec<f64>, f64), WriteError> {
    let finest = pieces.iter().map(|piece| mean_step(&piece.wavelengths)).fold(f64::INFINITY, f64::min);
    let start = STEPS_NM.iter().rposition(|step| *step <= finest * (1.0 + 1e-6)).unwrap_or(0);
    let mut error = WriteError::NoOverlap;
    for &step in STEPS_NM[..=start].iter().rev().chain(&STEPS_NM[start + 1..]) {
        match asked(step, range, limits) {
            Ok(wavelengths) if wavelengths.len() > 1 => return Ok((wavelengths, step)),
            Ok(_) => {}
            Err(found) => error = found,
        }
    }
    Err(error)
}

/// Returns whether wavelengths are evenly spaced and, rounded to whole nanometers as in the names of fields, all different.
pub(super) fn even_bands(wavelengths: &[f64]) -> bool {
    let rounded = |w: f64| (w + 0.5).floor();
    even_step(wavelengths).is_some() && wavelengths.windows(2).all(|pair| rounded(pair[0]) < rounded(pair[1]))
}
