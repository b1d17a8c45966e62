//! Statistics of the numbers of each curve.

use crate::decimal::short;
use crate::grid::Grid;

/// Wavelengths at which reflectances are judged: outside, instruments are noisy.
pub(super) const VISIBLE_NM: std::ops::RangeInclusive<f64> = 400.0..=700.0;

/// Values of one curve that are enough for its quantiles.
const SAMPLE: usize = 4096;

/// Values above it are no fractions, apart from noise and fluorescence.
const ABOVE_FRACTIONS: f64 = 2.0;

/// The numbers of one curve, where they are judged.
#[derive(Debug, Clone, Copy)]
pub(super) struct Span {
    pub(super) min: f64,
    pub(super) max: f64,
    pub(super) median: f64,
    /// The ninth decile, and at most the second largest value: one outlier does not move it.
    pub(super) high: f64,
    /// The most neighbors that are all larger than fractions are.
    run: usize,
}

/// The numbers of all curves.
#[derive(Debug)]
pub(super) struct Evidence {
    /// Those of each curve; `None` where it has no value.
    pub(super) curves: Vec<Option<Span>>,
}

/// Scale of a curve of fractions of light, by its numbers.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Looks {
    /// Fractions, but dark samples in percent look the same.
    Plain,
    /// Percent.
    Percent,
    /// Neither.
    Neither,
}

impl Span {
    /// The numbers of a curve at the wavelengths that `judged` takes.
    fn of(wavelengths: &[f64], values: &[f64], judged: impl Fn(&f64) -> bool) -> Option<Self> {
        let present = || {
            let pairs = wavelengths.iter().zip(values).filter(|(w, value)| judged(w) && !value.is_nan());
            pairs.map(|(_, value)| *value)
        };
        let (mut min, mut max, mut count) = (f64::INFINITY, f64::NEG_INFINITY, 0_usize);
        let (mut run, mut now) = (0, 0);
        for value in present() {
            (min, max, count) = (min.min(value), max.max(value), count + 1);
            now = if value > ABOVE_FRACTIONS { now + 1 } else { 0 };
            run = run.max(now);
        }
        let stride = (count / SAMPLE).max(1);
        let mut sample: Vec<f64> = present().step_by(stride).collect();
        sample.sort_unstable_by(f64::total_cmp);
        let last = sample.len().checked_sub(1)?;
        Some(Self { min, max, median: sample[sample.len() / 2], high: sample[last * 9 / 10], run })
    }

    /// Scale of fractions of light with such numbers. `largest` is what percent may reach: glossy and fluorescent samples
    /// pass 100.
    pub(super) fn looks(&self, largest: f64) -> Looks {
        // Percent of a filter that lets only a band pass: dark elsewhere, and far above one in the band.
        const BAND: usize = 3;
        const BAND_PEAK: f64 = 5.0;
        let mostly = self.median > ABOVE_FRACTIONS && self.high <= largest;
        let band = self.run >= BAND && self.max >= BAND_PEAK && self.max <= largest;
        if mostly || band {
            Looks::Percent
        } else if self.high <= ABOVE_FRACTIONS && self.median <= ABOVE_FRACTIONS {
            Looks::Plain
        } else {
            Looks::Neither
        }
    }
}

impl Evidence {
    pub(super) fn of(grid: &Grid) -> Self {
        let visible = |w: &f64| VISIBLE_NM.contains(w);
        let everywhere = !grid.wavelengths.iter().any(visible);
        let judged = |w: &f64| everywhere || visible(w);
        let spans = grid.curves.iter().map(|curve| Span::of(&grid.wavelengths, &curve.values, judged));
        Self { curves: spans.collect() }
    }

    /// The smallest and the largest value of all curves.
    pub(super) fn range(&self) -> (f64, f64) {
        let all = self.curves.iter().flatten();
        all.fold((f64::INFINITY, f64::NEG_INFINITY), |(min, max), span| (min.min(span.min), max.max(span.max)))
    }

    /// The largest of the ninth deciles.
    pub(super) fn high(&self) -> f64 {
        self.curves.iter().flatten().map(|span| span.high).fold(f64::NEG_INFINITY, f64::max)
    }

    /// Largest value, in words.
    pub(super) fn words(&self) -> String {
        format!("Values reach {}", short(self.range().1, 4))
    }
}
