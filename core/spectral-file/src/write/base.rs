//! What all formats but CSV share: the curves that they hold on one grid, and values at other wavelengths than those of a curve.

use std::ops::Range;

use chromascope_math::interpolation::{Sprague, linear};

use crate::decimal::clean;
use crate::error::MAX_SAMPLES;
use crate::write::format::{Format, Grid, Note, WriteError};
use crate::write::sheet::{Content, Piece, Sheet, one_line};

pub(super) struct Draft<'a> {
    pub(super) sheet: &'a Sheet<'a>,
    pub(super) format: Format,
    pub(super) pieces: Vec<Piece<'a>>,
    pub(super) wavelengths: Vec<f64>,
    pub(super) values: Vec<Vec<f64>>,
    pub(super) resampling: Option<String>,
    pub(super) notes: Vec<Note>,
}

struct Limits {
    format: Format,
    range_nm: [f64; 2],
    bands: usize,
    reads: fn(&[f64]) -> bool,
}

impl Limits {
    fn of(format: Format) -> Self {
        let (range_nm, bands, reads): (_, _, fn(&[f64]) -> bool) = match format {
            // Keys of three digits before the point: those alone are in the order of wavelengths when sorted as text.
            Format::RawtoacesJson => ([100.0, 999.999], usize::MAX, even_in_single),
            // The most bands that dcamprof takes for a range.
            Format::DcamprofJson | Format::Csv | Format::CommentedCsv => ([0.0, f64::MAX], 1_000_000, |_| true),
            // Argyll has room for as many.
            Format::ArgyllSp | Format::ArgyllCmf => ([1.0, 99_999.0], 601, even_bands),
            Format::Cgats => ([1.0, 99_999.0], usize::MAX, even_bands),
        };
        Self { format, range_nm, bands, reads }
    }

    fn take(&self, wavelengths: &[f64]) -> bool {
        wavelengths.len() > 1 && !self.starts(wavelengths).is_empty() && (self.reads)(wavelengths)
    }

    /// The first bands of those among these that can be kept, if they are too many: with all of 380 to 780 nm that is covered, or
    /// nearest to it. Empty if the format has no room for these.
    fn starts(&self, wavelengths: &[f64]) -> Range<usize> {
        let visible = [380.0 - SAME_NM, 780.0 + SAME_NM].map(|end| wavelengths.partition_point(|&w| w < end));
        let spare = wavelengths.len().saturating_sub(self.bands);
        visible[1].saturating_sub(self.bands)..visible[0].min(spare) + 1
    }

    /// The bands to keep of too many: those that hold most of the values, and of several such nearest to the middle.
    fn kept(&self, wavelengths: &[f64], values: &[Vec<f64>]) -> Range<usize> {
        let count = wavelengths.len().min(self.bands);
        let mut before = vec![0.0];
        for band in 0..wavelengths.len() {
            before.push(before[band] + values.iter().map(|values| values[band].abs()).sum::<f64>());
        }
        let held = |start: usize| before[start + count] - before[start];
        let off = |start: usize| (wavelengths[start] + wavelengths[start + count - 1] - 380.0 - 780.0).abs();
        let starts = self.starts(wavelengths);
        let best = starts.max_by(|&a, &b| held(a).total_cmp(&held(b)).then(off(b).total_cmp(&off(a))));
        best.map_or(0..count, |start| start..start + count)
    }
}

/// Returns whether wavelengths are evenly spaced for a program that takes them in single precision and compares exactly.
fn even_in_single(wavelengths: &[f64]) -> bool {
    let single: Vec<f32> = wavelengths.iter().map(|&w| w as f32).collect();
    let mut steps = single.windows(2).map(|pair| pair[1] - pair[0]);
    steps.next().is_some_and(|first| first > 0.0 && steps.all(|step| step == first))
}

/// Returns whether wavelengths are evenly spaced and, rounded to whole nanometers as in the names of fields, all different.
fn even_bands(wavelengths: &[f64]) -> bool {
    let rounded = |w: f64| (w + 0.5).floor();
    even_step(wavelengths).is_some() && wavelengths.windows(2).all(|pair| rounded(pair[0]) < rounded(pair[1]))
}

/// The steps in nanometers that are tried where curves have no grid in common that the format takes.
const STEPS_NM: [f64; 3] = [1.0, 5.0, 10.0];

impl<'a> Draft<'a> {
    /// Brings the curves that a format holds onto one grid within the range that all of them cover.
    pub(super) fn new(sheet: &'a Sheet<'a>, format: Format, grid: Grid) -> Result<Self, WriteError> {
        let mut notes = Vec::new();
        if sheet.curves.iter().any(|curve| curve.uncertainty.is_some()) || sheet.covariance.is_some() {
            notes.push(Note::NoUncertainty);
        }
        let pieces = match format {
            Format::ArgyllSp | Format::Cgats => sheet.energy_pieces(&mut notes),
            _ => sheet.channel_pieces(&mut notes),
        };
        let limits = &Limits::of(format);
        let ranges = pieces.iter().map(|piece| grid.within(piece.range()));
        let range = ranges.fold(limits.range_nm, |[a, b], [from, to]| [a.max(from), b.min(to)]);
        let (wavelengths, step) = match grid {
            Grid::Step(step) | Grid::Average(step) => (asked(step, range, limits)?, Some(step)),
            Grid::Native => match own(&pieces, range).filter(|own| limits.take(own)) {
                Some(own) => (own, None),
                None => sensible(&pieces, range, limits).map(|(wavelengths, step)| (wavelengths, Some(step)))?,
            },
        };
        if wavelengths.len() < 2 {
            return Err(WriteError::NoOverlap);
        }
        if wavelengths.len().saturating_mul(pieces.len()) > MAX_SAMPLES {
            return Err(WriteError::TooLarge);
        }
        let mut changes = Changes::new(grid);
        let take = |piece: &Piece<'a>| changes.take(piece, sheet.content, &wavelengths);
        let mut values: Vec<Vec<f64>> = pieces.iter().map(take).collect();
        let kept = limits.kept(&wavelengths, &values);
        for values in &mut values {
            *values = values[kept.clone()].to_vec();
        }
        let wavelengths = wavelengths[kept].to_vec();
        let ends = [wavelengths.first(), wavelengths.last()].map(|end| end.copied().unwrap_or_default());
        changes.note(step, ends, &mut notes);
        Ok(Self { sheet, format, pieces, wavelengths, values, resampling: changes.description(step), notes })
    }

    /// Notes that the name of a single curve gives way to the title.
    pub(super) fn note_lone_name(&mut self) {
        if self.sheet.curves.first().is_some_and(|only| one_line(only.name) != self.sheet.title()) {
            self.notes.push(Note::NoNames);
        }
    }

    /// What is known about the curves as they are written; that numbers are numbers is not said.
    pub(super) fn known(&self) -> Vec<(String, String)> {
        let per_energy =
            matches!(self.sheet.content, Content::Camera { per_photon: Some(_), .. }).then_some("per energy");
        let mut known = self.sheet.known(per_energy, self.resampling.as_deref());
        known.retain(|(key, value)| key != "unit" || value != "1");
        known
    }

    /// The same for formats with few members of their own, each as `key: value`; and the licenses in one text.
    pub(super) fn remarks(&self) -> (Vec<String>, String) {
        let is_license = |(key, _): &(String, String)| key.eq_ignore_ascii_case("license");
        let (licenses, rest): (Vec<_>, Vec<_>) = self.known().into_iter().partition(is_license);
        let licenses: Vec<String> = licenses.into_iter().map(|(_, value)| value).collect();
        (rest.into_iter().map(|(key, value)| format!("{key}: {value}")).collect(), licenses.join("; "))
    }
}

fn asked(step: f64, range: [f64; 2], limits: &Limits) -> Result<Vec<f64>, WriteError> {
    let wavelengths = multiples(step, range)?;
    let (format, found, most) = (limits.format, wavelengths.len(), limits.bands);
    if found > 1 && !(limits.reads)(&wavelengths) {
        return Err(WriteError::StepOfFormat { format, step_nm: step });
    }
    let fits = !limits.starts(&wavelengths).is_empty();
    if fits { Ok(wavelengths) } else { Err(WriteError::Bands { format, found, most }) }
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

/// Largest distance in nanometers at which a wavelength is that of a sample.
pub(super) const SAME_NM: f64 = 1e-6;

const SMALLEST_STEP_NM: f64 = 1e-3;

pub(super) fn check(grid: Grid) -> Result<(), WriteError> {
    match grid {
        Grid::Step(step) | Grid::Average(step) if !(step.is_finite() && step >= SMALLEST_STEP_NM) => {
            Err(WriteError::Step)
        }
        Grid::Step(_) | Grid::Average(_) | Grid::Native => Ok(()),
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

pub(super) fn mean_step(wavelengths: &[f64]) -> f64 {
    match wavelengths {
        [first, .., last] => (last - first) / (wavelengths.len() - 1) as f64,
        _ => 0.0,
    }
}

struct Between<'a> {
    piece: &'a Piece<'a>,
    sprague: Option<Sprague>,
    clamps: bool,
}

impl<'a> Between<'a> {
    fn new(piece: &'a Piece<'_>, content: Content<'_>) -> Self {
        const SMOOTH_FROM_NM: f64 = 5.0;
        let known = !matches!(content, Content::Illuminant | Content::Other);
        let step = even_step(&piece.wavelengths).filter(|step| known && *step >= SMOOTH_FROM_NM);
        let sprague = step.and_then(|step| Sprague::new(piece.range()[0], step, &piece.values));
        Self { piece, sprague, clamps: content != Content::Observer }
    }

    /// The value at a wavelength, and whether it is a sample; none outside the curve's range.
    fn at(&self, x: f64) -> Option<(f64, bool)> {
        let Piece { wavelengths, values, .. } = self.piece;
        if let Ok(sample) = wavelengths.binary_search_by(|w| w.total_cmp(&x)) {
            return Some((values[sample], true));
        }
        let above = wavelengths.partition_point(|&w| w <= x + SAME_NM);
        let below = above.checked_sub(1)?;
        let (x0, y0) = (wavelengths[below], values[below]);
        if (x - x0).abs() <= SAME_NM {
            return Some((y0, true));
        }
        let (&x1, &y1) = (wavelengths.get(above)?, values.get(above)?);
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

#[derive(Debug, Default)]
pub(super) struct Changes {
    pub(super) grid: Grid,
    interpolated: bool,
    smooth: bool,
    finest_nm: Option<f64>,
    reach_nm: Option<[f64; 2]>,
    /// True if an uncertainty is between samples, or that of an average.
    pub(super) alike: bool,
}

impl Changes {
    pub(super) fn new(grid: Grid) -> Self {
        Self { grid, ..Self::default() }
    }

    pub(super) fn take(&mut self, piece: &Piece<'_>, content: Content<'_>, wavelengths: &[f64]) -> Vec<f64> {
        let [first, last] = piece.range();
        self.reach_nm = Some(self.reach_nm.map_or([first, last], |[a, b]| [a.min(first), b.max(last)]));
        let step = mean_step(&piece.wavelengths);
        self.finest_nm = Some(self.finest_nm.map_or(step, |finest| finest.min(step)));
        if let Grid::Average(width) = self.grid {
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
        self.smooth |= interpolated && between.sprague.is_some();
        values
    }

    /// Standard uncertainties of values between samples or averaged ones, of samples that err alike: none can be larger.
    pub(super) fn take_alike(&mut self, piece: &Piece<'_>, standard: &[f64], wavelengths: &[f64]) -> Vec<f64> {
        let own = (piece.wavelengths.as_ref().into(), standard.into());
        let piece = Piece { name: "".into(), wavelengths: own.0, values: own.1, uncertainty: None };
        let mut changes = Self::new(self.grid);
        let taken = changes.take(&piece, Content::Other, wavelengths);
        self.alike |= changes.interpolated || matches!(self.grid, Grid::Average(_));
        taken
    }

    /// Description of the method, for the head of a file; none at a curve's own wavelengths.
    pub(super) fn description(&self, step: Option<f64>) -> Option<String> {
        let step = step?;
        Some(match self.grid {
            Grid::Average(width) => format!(
                "band averages every {step} nm: means of the linear interpolant over ±{} nm",
                clean(width / 2.0)
            ),
            _ if self.smooth => format!("values every {step} nm, by Sprague's interpolation"),
            _ if self.interpolated => format!("values every {step} nm, interpolated linearly"),
            _ => format!("values every {step} nm, samples picked"),
        })
    }

    /// Notes for a step (none for the curves' own wavelengths) and the range that was written.
    pub(super) fn note(&self, step: Option<f64>, [from_nm, to_nm]: [f64; 2], notes: &mut Vec<Note>) {
        if let Grid::Average(step_nm) = self.grid {
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
