//! Values at other wavelengths than those of a curve.

use chromascope_math::interpolation::{Sprague, linear};

use crate::decimal::clean;
use crate::limits::MAX_SAMPLES;
use crate::write::format::Grid;
use crate::write::note::{Note, WriteError};
use crate::write::sheet::{Content, Piece};

/// Largest distance in nanometers at which a wavelength is that of a sample.
pub(super) const SAME_NM: f64 = 1e-6;

const SMALLEST_STEP_NM: f64 = 1e-3;

/// Returns whether a grid is valid.
pub(super) fn check(grid: Grid) -> Result<(), WriteError> {
    match grid {
        Grid::Step(step) | Grid::Average(step) if !(step.is_finite() && step >= SMALLEST_STEP_NM) => {
            Err(WriteError::Step)
        }
        Grid::Step(_) | Grid::Average(_) | Grid::Native => Ok(()),
    }
}

/// Method for values at new wavelengths.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Sampling {
    /// The value there.
    Points,
    /// The mean over a band of the given width in nanometers around it.
    Bands(f64),
}

impl Sampling {
    pub(super) fn of(grid: Grid) -> Self {
        match grid {
            Grid::Average(step) => Self::Bands(step),
            Grid::Native | Grid::Step(_) => Self::Points,
        }
    }

    /// The range in which a curve has values of this kind.
    pub(super) fn within(self, [first, last]: [f64; 2]) -> [f64; 2] {
        match self {
            Self::Points => [first, last],
            Self::Bands(width) => [first + width / 2.0, last - width / 2.0],
        }
    }
}

/// Means of the linear interpolant of a curve over bands of a width around ascending wavelengths, in time proportional to both.
///
/// A band that goes on beyond the curve is cut off there. The mean of a constant is that constant.
fn band_means(piece: &Piece<'_>, centers: &[f64], width: f64) -> Vec<f64> {
    let (wavelengths, values) = (piece.wavelengths.as_ref(), piece.values.as_ref());
    let [first, last] = piece.range();
    let at = |cell: usize, x: f64| {
        let (x0, x1) = (wavelengths[cell], wavelengths[cell + 1]);
        let t = ((x - x0) / (x1 - x0)).clamp(0.0, 1.0);
        values[cell] * (1.0 - t) + values[cell + 1] * t
    };
    let cells = wavelengths.len().saturating_sub(1);
    let mut start = 0;
    let mean = |&center: &f64| {
        let (from, to) = ((center - width / 2.0).max(first), (center + width / 2.0).min(last));
        while start + 1 < cells && wavelengths[start + 1] <= from {
            start += 1;
        }
        let (mut integral, mut shares) = (0.0, 0.0);
        let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
        for cell in (start..cells).take_while(|cell| wavelengths[*cell] < to) {
            let (a, b) = (wavelengths[cell].max(from), wavelengths[cell + 1].min(to));
            let (va, vb) = (at(cell, a), at(cell, b));
            let middle = va * 0.5 + vb * 0.5;
            integral += (b - a) * middle;
            shares += (b - a) / (to - from) * middle;
            (low, high) = (low.min(va).min(vb), high.max(va).max(vb));
        }
        // One division rounds less; huge values overflow in sums, not in shares.
        let mean = integral / (to - from);
        let mean = if mean.is_finite() { mean } else { shares };
        if low <= high { mean.clamp(low, high) } else { mean }
    };
    centers.iter().map(mean).collect()
}

/// The whole multiples of a step within a range.
pub(super) fn multiples(step: f64, [first, last]: [f64; 2]) -> Result<Vec<f64>, WriteError> {
    // Beyond, multiples have no room for nine decimals.
    const LARGEST: f64 = 1e12;
    let (from, to) = ((first / step).floor(), (last / step).ceil());
    if to > LARGEST || to - from > MAX_SAMPLES as f64 {
        return Err(WriteError::TooLarge);
    }
    let count = (to - from) as usize;
    let all = (0..=count).map(|i| clean((from + i as f64) * step));
    Ok(all.filter(|x| (first - SAME_NM..=last + SAME_NM).contains(x)).collect())
}

/// The spacing of wavelengths if it is the same throughout (to 1e-6 of it).
pub(super) fn even_step(wavelengths: &[f64]) -> Option<f64> {
    let step = mean_step(wavelengths);
    let even = wavelengths.windows(2).all(|pair| (pair[1] - pair[0] - step).abs() <= 1e-6 * step);
    (wavelengths.len() > 1 && even).then_some(step)
}

/// The mean distance between neighbors.
pub(super) fn mean_step(wavelengths: &[f64]) -> f64 {
    match wavelengths {
        [first, .., last] => (last - first) / (wavelengths.len() - 1) as f64,
        _ => 0.0,
    }
}

/// A curve between its samples.
pub(super) struct Between<'a> {
    wavelengths: &'a [f64],
    values: &'a [f64],
    sprague: Option<Sprague>,
    clamps: bool,
}

impl<'a> Between<'a> {
    /// Prepares a curve by the convention for what it is.
    pub(super) fn new(piece: &'a Piece<'_>, content: Content<'_>) -> Self {
        const SMOOTH_FROM_NM: f64 = 5.0;
        let (wavelengths, values) = (piece.wavelengths.as_ref(), piece.values.as_ref());
        let known = !matches!(content, Content::Illuminant | Content::Other);
        let step = even_step(wavelengths).filter(|step| known && *step >= SMOOTH_FROM_NM);
        let sprague = step.and_then(|step| Sprague::new(piece.range()[0], step, values));
        Self { wavelengths, values, sprague, clamps: content != Content::Observer }
    }

    /// Returns whether it is interpolated by polynomials.
    pub(super) fn is_smooth(&self) -> bool {
        self.sprague.is_some()
    }

    /// The value at a wavelength, and whether it is a sample; none outside the curve's range.
    pub(super) fn at(&self, x: f64) -> Option<(f64, bool)> {
        if let Ok(sample) = self.wavelengths.binary_search_by(|w| w.total_cmp(&x)) {
            return Some((self.values[sample], true));
        }
        let above = self.wavelengths.partition_point(|&w| w <= x + SAME_NM);
        let below = above.checked_sub(1)?;
        let (x0, y0) = (self.wavelengths[below], self.values[below]);
        if (x - x0).abs() <= SAME_NM {
            return Some((y0, true));
        }
        let (&x1, &y1) = (self.wavelengths.get(above)?, self.values.get(above)?);
        let straight = finite_or(linear(&[x0, x1], &[y0, y1], x), || {
            // The difference of huge values overflows; halves of them do not.
            let t = (x - x0) / (x1 - x0);
            (y0 * (1.0 - t) + y1 * t).clamp(y0.min(y1), y0.max(y1))
        });
        let Some(sprague) = &self.sprague else { return Some((straight, false)) };
        let curved = finite_or(sprague.at(x), || straight);
        // Polynomials overshoot; what cannot be negative is not made so.
        let floor = if self.clamps { y0.min(y1).min(0.0) } else { f64::MIN };
        Some((curved.max(floor), false))
    }
}

fn finite_or(value: f64, other: impl FnOnce() -> f64) -> f64 {
    if value.is_finite() { value } else { other() }
}

/// Changes by resampling, over all curves.
#[derive(Debug, Default)]
pub(super) struct Changes {
    sampling: Option<Sampling>,
    interpolated: bool,
    smooth: bool,
    finest_nm: Option<f64>,
    /// The first and the last wavelength of any curve.
    reach_nm: Option<[f64; 2]>,
}

impl Changes {
    pub(super) fn new(sampling: Sampling) -> Self {
        Self { sampling: Some(sampling), ..Self::default() }
    }

    /// The values of a curve at wavelengths within its range.
    pub(super) fn take(&mut self, piece: &Piece<'_>, content: Content<'_>, wavelengths: &[f64]) -> Vec<f64> {
        let [first, last] = piece.range();
        self.reach_nm = Some(self.reach_nm.map_or([first, last], |[a, b]| [a.min(first), b.max(last)]));
        let step = mean_step(&piece.wavelengths);
        self.finest_nm = Some(self.finest_nm.map_or(step, |finest| finest.min(step)));
        if let Some(Sampling::Bands(width)) = self.sampling {
            return band_means(piece, wavelengths, width);
        }
        let between = Between::new(piece, content);
        let mut interpolated = false;
        let value = |&x: &f64| {
            let (value, sample) = between.at(x).unwrap_or((0.0, false));
            interpolated |= !sample;
            value
        };
        let values = wavelengths.iter().map(value).collect();
        self.interpolated |= interpolated;
        self.smooth |= interpolated && between.is_smooth();
        values
    }

    /// Description of the method, for the head of a file; none at a curve's own wavelengths.
    pub(super) fn description(&self, step: Option<f64>) -> Option<String> {
        let step = step?;
        Some(match self.sampling {
            Some(Sampling::Bands(width)) => format!(
                "band averages every {step} nm: means of the linear interpolant over ±{} nm",
                decimal_half(width)
            ),
            _ if self.smooth => format!("values every {step} nm, by Sprague's interpolation"),
            _ if self.interpolated => format!("values every {step} nm, interpolated linearly"),
            _ => format!("values every {step} nm, samples picked"),
        })
    }

    /// Notes for a step (none for the curves' own wavelengths) and the range that was written.
    pub(super) fn note(&self, step: Option<f64>, [from_nm, to_nm]: [f64; 2], notes: &mut Vec<Note>) {
        if let Some(Sampling::Bands(step_nm)) = self.sampling {
            notes.push(Note::Averaged(step_nm));
        } else if let Some(step_nm) = step {
            if self.interpolated {
                notes.push(Note::Resampled { step_nm, smooth: self.smooth });
            }
            let finest = self.finest_nm.filter(|finest| *finest < step_nm * (1.0 - 1e-6));
            notes.extend(finest.map(|from_nm| Note::Thinned { from_nm, to_nm: step_nm }));
        }
        let clipped = |[first, last]: [f64; 2]| first < from_nm - SAME_NM || last > to_nm + SAME_NM;
        if self.reach_nm.is_some_and(clipped) {
            notes.push(Note::Clipped { from_nm, to_nm });
        }
    }
}

/// Half of a number without the noise of binary fractions.
fn decimal_half(number: f64) -> f64 {
    clean(number / 2.0)
}
