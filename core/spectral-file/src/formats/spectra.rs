//! What readers of formats give, and spectra that each have wavelengths of their own, brought onto one grid.

use crate::decision::{Decided, DecimalMark, Decision, Delimiter, Orientation, Reader};
use crate::dialect::Dialect;
use crate::dialect_trial::Layout;
use crate::error::{MAX_CURVES, ReadError, check_samples};
use crate::grid::{Grid, RawCurve};
use crate::header::Header;
use crate::text::excerpt;
use crate::warning::{LineList, Warning};
use crate::watch::{Log, PlaceId, PlaceKind};

/// Result of a reader, before units, order and scale are settled.
pub(crate) struct Found {
    pub(crate) grid: Grid,
    pub(crate) layout: Layout,
    pub(crate) reader: Decided<Reader>,
    /// Decisions that only this family needs.
    pub(crate) notes: Vec<Decision>,
}

impl Found {
    /// Result of a format that leaves nothing to decide on its layout.
    pub(crate) fn fixed(
        grid: Grid,
        reader: Decided<Reader>,
        (dialect, first_line, why): ((Delimiter, DecimalMark), usize, &str),
        notes: Vec<Decision>,
    ) -> Self {
        Self { grid, layout: Layout::fixed(dialect, Orientation::Down, first_line, why), reader, notes }
    }
}

#[derive(Debug, Clone, Copy)]
pub(crate) struct Sample {
    pub(crate) wavelength: f64,
    pub(crate) value: f64,
    pub(crate) line: usize,
    pub(crate) place: PlaceId,
}

#[derive(Debug, Default)]
pub(crate) struct Spectrum {
    pub(crate) name: Option<String>,
    /// Role that the file gives to the values, in its words.
    pub(crate) label: String,
    pub(crate) samples: Vec<Sample>,
}

impl Spectrum {
    fn line(&self) -> usize {
        self.samples.first().map_or(1, |sample| sample.line)
    }

    /// Returns whether wavelengths fall from first to last.
    fn falls(&self) -> bool {
        let (first, last) = (self.samples.first(), self.samples.last());
        first.zip(last).is_none_or(|(first, last)| last.wavelength < first.wavelength)
            && self.samples.is_sorted_by(|a, b| a.wavelength >= b.wavelength)
    }

    /// Brings the samples into ascending order, one for each wavelength.
    fn settle(&mut self, index: usize, name: &str, log: &mut Log<'_>) {
        let back = |pair: &[Sample]| pair[1].wavelength < pair[0].wavelength;
        if !self.falls()
            && let Some(at) = self.samples.windows(2).position(back)
        {
            log.push(Warning::Sorted(self.samples[at + 1].line));
        }
        self.samples.sort_by(|a, b| a.wavelength.total_cmp(&b.wavelength));
        let mut lines = Vec::new();
        let (mut kept, mut count) = (0, 1.0);
        for i in 1..self.samples.len() {
            let next = self.samples[i];
            if next.wavelength == self.samples[kept].wavelength {
                count += 1.0;
                if next.value != self.samples[kept].value {
                    lines.push(next.line);
                }
                self.merge(kept, &next, index, log);
                let mean = &mut self.samples[kept].value;
                *mean += (next.value - *mean) / count;
                continue;
            }
            kept += 1;
            count = 1.0;
            self.samples[kept] = next;
        }
        self.samples.truncate(kept + 1);
        if !lines.is_empty() {
            lines.sort_unstable();
            log.push(Warning::Averaged { name: name.to_owned(), lines: lines.into_iter().collect() });
        }
        if let Some(places) = &mut log.places {
            self.samples.iter().for_each(|sample| places.assign(sample.place, index, sample.wavelength));
        }
    }

    /// Records that a sample is at the wavelength of an earlier one.
    fn merge(&mut self, kept: usize, next: &Sample, index: usize, log: &mut Log<'_>) {
        let Some(places) = &mut log.places else { return };
        let kept = &mut self.samples[kept];
        let same = kept.value == next.value;
        let kind = if same { PlaceKind::Repeated } else { PlaceKind::Averaged };
        places.merge(next.place, kind, index, next.wavelength);
        if !same {
            places.merge(std::mem::take(&mut kept.place), kind, index, next.wavelength);
        }
    }
}

/// The grid of all wavelengths of all spectra; a spectrum has gaps where only others have values.
pub(crate) fn grid(mut spectra: Vec<Spectrum>, header: Header, log: &mut Log<'_>) -> Result<Grid, ReadError> {
    let rows = spectra.iter().map(|spectrum| spectrum.samples.len()).sum();
    let line = spectra.first().map_or(1, Spectrum::line);
    if spectra.len() > MAX_CURVES {
        return Err(ReadError::TooManyCurves(spectra[MAX_CURVES].line()));
    }
    let falls = !spectra.is_empty() && spectra.iter().all(|spectrum| spectrum.samples.len() > 1 && spectrum.falls());
    let title = header.comment("title").filter(|_| spectra.len() == 1).map(str::to_owned);
    let mut names = Vec::with_capacity(spectra.len());
    for (index, spectrum) in spectra.iter_mut().enumerate() {
        log.look(usize::MAX)?;
        let given = spectrum.name.take().or_else(|| title.clone());
        let name = given.clone().unwrap_or_else(|| format!("Spectrum {}", index + 1));
        spectrum.settle(index, &name, log);
        names.push((name, given.is_some()));
    }
    log.look(usize::MAX)?;
    let samples = spectra.iter().flat_map(|spectrum| &spectrum.samples);
    let mut wavelengths: Vec<f64> = samples.map(|sample| sample.wavelength).collect();
    wavelengths.sort_unstable_by(f64::total_cmp);
    wavelengths.dedup();
    log.look(usize::MAX)?;
    check_samples(wavelengths.len().saturating_mul(spectra.len()), line)?;
    let mut lines = vec![line];
    if let [only] = spectra.as_slice() {
        lines = only.samples.iter().map(|sample| sample.line).collect();
    }
    let curves = spectra.into_iter().zip(names).enumerate().map(|(origin, (spectrum, (name, named)))| RawCurve {
        origin,
        name,
        named,
        label: spectrum.label,
        values: onto(&wavelengths, &spectrum.samples),
        ..RawCurve::default()
    });
    let curves = curves.collect();
    let mut grid = Grid { wavelengths, lines, curves, header, rows, own_wavelengths: true, ..Grid::default() };
    if falls {
        let order: Vec<usize> = (0..grid.wavelengths.len()).rev().collect();
        grid.reorder(&order);
    }
    Ok(grid)
}

/// Columns of such rows that are looked at, more than any has.
const MAX_COLUMNS: usize = 100;

/// Rows of numbers with blanks between them: a wavelength first, of the others those in the given columns, from 1. Returns the
/// samples of each column.
pub(crate) fn rows<'a>(
    lines: impl Iterator<Item = (usize, &'a str)>,
    columns: &[usize],
    log: &mut Log<'_>,
) -> Result<Vec<Vec<Sample>>, ReadError> {
    let mut all = vec![Vec::new(); columns.len()];
    let (mut width, mut missing) = (None, LineList::default());
    for (line, text) in lines.filter(|(_, line)| !line.trim().is_empty()) {
        log.work(text.len() + 1, 0)?;
        let cells: Vec<&str> = text.split_whitespace().take(MAX_COLUMNS).collect();
        let expected = *width.get_or_insert(cells.len());
        if cells.len() != expected || cells.len() < 2 {
            return Err(ReadError::UnevenRow { line, found: cells.len(), expected: expected.max(2) });
        }
        let number = |column: usize| {
            let wrong = || ReadError::NotANumber { line, column: column + 1, text: excerpt(cells[column]) };
            Dialect::of_number(cells[column]).value(cells[column]).ok_or_else(wrong)
        };
        let wavelength = number(0)?;
        log.places.as_mut().map(|places| places.add(PlaceKind::Wavelength, cells[0]));
        for (samples, &column) in all.iter_mut().zip(columns) {
            let value = number(column)?;
            if value.is_nan() || wavelength.is_nan() {
                missing.add(line);
                continue;
            }
            let place = log.places.as_mut().map(|places| places.add(PlaceKind::Value, cells[column]));
            samples.push(Sample { wavelength, value, line, place: place.unwrap_or_default() });
        }
    }
    let cells = missing.count();
    if cells > 0 {
        log.push(Warning::Gaps { cells, lines: missing, sentinel: None });
    }
    Ok(all)
}

/// The values at the wavelengths of a grid that holds all wavelengths of the samples.
fn onto(wavelengths: &[f64], samples: &[Sample]) -> Vec<f64> {
    let mut next = samples.iter().peekable();
    let value = |&wavelength: &f64| {
        next.next_if(|sample| sample.wavelength == wavelength).map_or(f64::NAN, |sample| sample.value)
    };
    wavelengths.iter().map(value).collect()
}
