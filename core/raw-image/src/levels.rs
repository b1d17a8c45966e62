//! Black and white levels (DNG 1.7.1, chapter 5, "Mapping Raw Values to Linear Reference Values").

use crate::directory::{Directories, tag};
use crate::error::RawImageError;

/// Levels of the active area: (sample − black) × scale is 0 at black and 1 at white.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Levels {
    /// Black of the columns, for each row of the repeated pattern; samples of a pixel side by side.
    columns: Vec<Vec<f64>>,
    /// Black that the rows add; empty for none.
    rows: Vec<f64>,
    /// Scale of each sample of a pixel.
    pub(crate) scale: Vec<f64>,
}

impl Levels {
    /// Levels of an active area of `width` × `height` pixels with `planes` samples each.
    pub(crate) fn read(
        tags: &mut Directories<'_>,
        directory: usize,
        [width, height]: [usize; 2],
        planes: usize,
        bits: u32,
    ) -> Result<Self, RawImageError> {
        let repeat = tags.numbers(directory, tag::BLACK_REPEAT)?.unwrap_or_else(|| vec![1.0; 2]);
        let &[down, across] = repeat.as_slice() else {
            return Err(value("BlackLevelRepeatDim", &repeat, "two numbers"));
        };
        // The pattern of Adobe's DNG SDK has at most 8 × 8 levels.
        if ![down, across].iter().all(|side| (1.0..=8.0).contains(side)) {
            return Err(value("BlackLevelRepeatDim", &repeat, "1 to 8"));
        }
        let (down, across) = ((down as usize).min(height), across as usize);
        let black = tags.numbers(directory, tag::BLACK_LEVEL)?.unwrap_or_else(|| vec![0.0]);
        let black = all("BlackLevel", black, down * across * planes)?;
        let mut delta = |tag, field, length| match tags.numbers(directory, tag)? {
            Some(delta) if delta.len() < length || !delta.iter().all(|delta| delta.is_finite()) => {
                Err(value(field, &delta[..delta.len().min(4)], "a number for each row or column"))
            }
            other => Ok(other.unwrap_or_default()),
        };
        let delta_h = delta(tag::BLACK_DELTA_H, "BlackLevelDeltaH", width)?;
        let rows = delta(tag::BLACK_DELTA_V, "BlackLevelDeltaV", height)?;
        let at = |x: usize| delta_h.get(x).copied().unwrap_or(0.0);
        let columns: Vec<Vec<f64>> = black
            .chunks(across * planes)
            .map(|row| (0..width * planes).map(|i| row[i % row.len()] + at(i / planes)).collect())
            .collect();
        let white = tags.numbers(directory, tag::WHITE_LEVEL)?.unwrap_or_else(|| vec![f64::from((1_u32 << bits) - 1)]);
        let white = all("WhiteLevel", white, planes)?;
        let highest_row = rows.iter().copied().reduce(f64::max).unwrap_or(0.0);
        let scale = (0..planes).map(|plane| {
            // The highest black of the plane, so that white is nowhere below 1.
            let of_plane = columns.iter().flat_map(|row| row.iter().skip(plane).step_by(planes));
            let range = white[plane] - of_plane.copied().fold(f64::NEG_INFINITY, f64::max) - highest_row;
            if range > 0.0 { Ok(1.0 / range) } else { Err(value("WhiteLevel", &white, "more than the black level")) }
        });
        let scale = scale.collect::<Result<_, _>>()?;
        Ok(Self { columns, rows, scale })
    }

    /// Black of the samples of a row but for what is added to all of them, and that.
    pub(crate) fn row(&self, y: usize) -> (&[f64], f64) {
        (&self.columns[y % self.columns.len()], self.rows.get(y).copied().unwrap_or(0.0))
    }

    /// Values from which on a sample is at the white level or above: half a step of the finest scale below 1.
    pub(crate) fn clip(&self) -> f64 {
        1.0 - 0.5 * self.scale.iter().copied().fold(f64::INFINITY, f64::min)
    }
}

/// `length` finite numbers; one alone holds for all.
fn all(field: &'static str, mut numbers: Vec<f64>, length: usize) -> Result<Vec<f64>, RawImageError> {
    if numbers.len() == 1 {
        numbers.resize(length, numbers[0]);
    }
    if numbers.len() < length || !numbers.iter().all(|number| number.is_finite()) {
        return Err(value(field, &numbers, "a number, or one for each sample of the pattern"));
    }
    numbers.truncate(length);
    Ok(numbers)
}

fn value(field: &'static str, numbers: &[f64], expected: &'static str) -> RawImageError {
    RawImageError::Value { field, value: format!("{numbers:?}"), expected }
}
