//! Uncertainty of light and patches by draws: of the light with first derivatives, of patches with their colors made anew.

use super::differences::{DifferenceConditions, PatchDifferences};
use super::evidence::Evidence;
use super::figures::CameraMetrics;
use super::table::{CameraMetric, MetricGroup};
use super::value::{CameraMetricsQuery, WhyNot};
use crate::ask::{Ask, Shared};
use crate::patches::{RenderingQuery, patch_colors};
use chromascope_color::camera::table_draws::shifts;
use chromascope_color::camera::{Rendering, RenderingError};
use chromascope_color::patch_set::Patch;
use chromascope_color::spectral::grid::{FIRST_NM, LAST_NM};
use chromascope_color::spectral::stated_uncertainty::Errors;
use chromascope_color::spectral::{Correlation, GridSpectrum, Quantity, SpectralDistribution, StatedUncertainty};
use chromascope_color::units::hash_by;
use chromascope_math::dot::dot;
use std::ops::Range;
use std::sync::Arc;

/// Width in nanometers of the bands within which a metric has one derivative by all samples.
const BAND_NM: f64 = 10.0;
/// Step of a derivative, relative to the light's largest value.
const STEP: f64 = 1e-3;
/// Pairs of charts drawn where errors of many samples are independent: a spread is known to 6 %.
const PAIRS: usize = 128;

/// A light as measured, with the uncertainty that its file states.
#[derive(Clone, Debug, PartialEq)]
pub struct LightUncertainty {
    /// Light at the wavelengths of its file.
    pub measured: SpectralDistribution,
    /// Uncertainty of its one curve.
    pub stated: StatedUncertainty,
    /// Transmittance of the filters in front of it; none without.
    pub transmittance: Option<GridSpectrum>,
}

hash_by!(LightUncertainty, |of| (&of.measured, &of.stated, &of.transmittance));

/// Samples of each band that has effect on the grid.
fn bands(curve: &SpectralDistribution) -> Vec<Range<usize>> {
    let nm = curve.wavelengths_nm();
    let band = |nm: f64| ((nm - FIRST_NM) / BAND_NM).floor();
    let inside = |at: &usize| {
        // A sample beyond the grid counts where the next one is within.
        let next = nm[(at + 1).min(nm.len() - 1)];
        next >= FIRST_NM && nm[at.saturating_sub(1)] <= LAST_NM
    };
    let mut found: Vec<Range<usize>> = Vec::new();
    for at in (0..nm.len()).filter(inside) {
        match found.last_mut().filter(|last| band(nm[last.start]) == band(nm[at])) {
            Some(last) => last.end = at + 1,
            None => found.push(at..at + 1),
        }
    }
    found
}

/// The curve on the grid with some of its samples shifted, less the curve itself.
fn shift(curve: &SpectralDistribution, of: &Range<usize>, by: f64) -> Option<GridSpectrum> {
    let mut values = vec![0.0; curve.values().len()];
    values[of.clone()].fill(by);
    let shift = SpectralDistribution::new(curve.wavelengths_nm().to_vec(), values).ok()?;
    Some(GridSpectrum::resample(&shift, Quantity::Light))
}

fn sum(a: &GridSpectrum, b: &GridSpectrum) -> GridSpectrum {
    let mut at = a.values().iter().zip(b.values());
    GridSpectrum::from_fn(|_| at.next().map_or(0.0, |(a, b)| a + b))
}

fn largest(curve: &SpectralDistribution) -> f64 {
    curve.values().iter().fold(0.0_f64, |most, value| most.max(value.abs())).max(f64::MIN_POSITIVE)
}

/// A light and the uncertainty that its file states: metrics, and the patches' differences, with their first derivatives by bands.
pub(super) struct LightDraws<'a> {
    stated: &'a StatedUncertainty,
    nominal: Arc<CameraMetrics>,
    /// Samples of each band, and what a step of all of them leads to.
    bands: Vec<(Range<usize>, Arc<CameraMetrics>)>,
    step: f64,
}

impl<'a> LightDraws<'a> {
    /// None where the uncertainty is not that of the light, or when stopped.
    pub(super) fn new(
        of: &CameraMetricsQuery,
        LightUncertainty { measured, stated, transmittance }: &'a LightUncertainty,
        ask: &impl Ask,
    ) -> Option<Self> {
        stated.is_of([measured.values().len()]).then_some(())?;
        let step = STEP * largest(measured);
        let mut found = Vec::new();
        for band in bands(measured) {
            if stated.standard()[0][band.clone()].iter().all(|u| *u == 0.0) {
                continue;
            }
            let shift = shift(measured, &band, step)?;
            let shift = transmittance.as_ref().map_or_else(|| shift.clone(), |filter| shift.times(filter));
            let light = Shared::new(sum(&of.rendering.light, &shift));
            let under = |rendering: &RenderingQuery| RenderingQuery { light: light.clone(), ..rendering.clone() };
            let (rendering, reference) = (under(&of.rendering), under(&of.reference));
            found.push((band, ask.ask(&CameraMetricsQuery { rendering, reference, ..of.clone() })));
            (!ask.stop().is_set()).then_some(())?;
        }
        Some(Self { stated, nominal: ask.ask(of), bands: found, step })
    }

    /// Metrics under lights drawn under each correlation that is possible; camera and reference see the same light. Statistics are those of
    /// the patches' linearized differences: their order changes.
    pub(super) fn values(&self) -> impl Iterator<Item = (Correlation, impl Iterator<Item = Vec<Result<f64, WhyNot>>>)> {
        let size = self.stated.standard().iter().map(Vec::len).sum();
        let kernel = |(band, _): &(Range<usize>, _)| {
            let mut kernel = vec![0.0; size];
            kernel[band.clone()].fill(1.0 / (self.step * band.len() as f64));
            kernel
        };
        let kernels: Vec<Vec<f64>> = self.bands.iter().map(kernel).collect();
        self.stated.errors().map(move |errors| {
            let draws = shifts(errors, &kernels, 0);
            let kernels = kernels.clone();
            let steps = move |shift: &[f64]| kernels.iter().map(|kernel| dot(kernel, shift)).collect::<Vec<f64>>();
            (errors.correlation, draws.map(move |shift| self.at(&steps(&shift))))
        })
    }

    /// Metrics with so many steps in each band.
    fn at(&self, steps: &[f64]) -> Vec<Result<f64, WhyNot>> {
        let moved = |of: &dyn Fn(&CameraMetrics) -> Option<f64>| -> Option<f64> {
            let nominal = of(&self.nominal)?;
            let each = self.bands.iter().zip(steps).map(|((_, moved), steps)| Some((of(moved)? - nominal) * steps));
            Some(nominal + each.sum::<Option<f64>>()?)
        };
        let none = WhyNot::NoPatches;
        let patch = |p: usize| {
            let own = &self.nominal.patches[p];
            let metric = |m: usize| moved(&|of| of.patches.get(p)?.by_metric[m].ok()).map(f64::abs);
            let lch = |c: usize| moved(&|of| of.patches.get(p)?.lch.map(|lch| lch[c]));
            let [l, c, h] = [lch(0), lch(1), lch(2)];
            PatchDifferences {
                by_metric: (0..own.by_metric.len()).map(|m| own.by_metric[m].and(metric(m).ok_or(none))).collect(),
                lch: l.zip(c).zip(h).map(|((l, c), h)| [l, c, h]),
                angle_deg: moved(&|of| of.patches.get(p)?.angle_deg).map(f64::abs),
            }
        };
        let patches = statistics(Ok((0..self.nominal.patches.len()).map(patch).collect()));
        let value = |at: usize| match CameraMetric::ALL[at].group {
            MetricGroup::Differences => patches[at],
            _ => self.nominal.values[at].and(moved(&|of| of.values[at].ok()).ok_or(none)),
        };
        (0..patches.len()).map(value).collect()
    }
}

/// A chart and the uncertainty that its file states.
pub(super) struct PatchDraws<'a> {
    of: &'a CameraMetricsQuery,
    stated: &'a StatedUncertainty,
    renderings: [Arc<Result<Rendering, RenderingError>>; 2],
}

impl<'a> PatchDraws<'a> {
    /// None where the uncertainty is not that of the chart's patches.
    pub(super) fn new(of: &'a CameraMetricsQuery, stated: &'a StatedUncertainty, ask: &impl Ask) -> Option<Self> {
        let lengths = of.patches.patches().iter().map(|patch| patch.measured.values().len());
        let renderings = [&of.reference, &of.rendering].map(|of| ask.ask(of));
        stated.is_of(lengths).then_some(Self { of, stated, renderings })
    }

    /// Metrics of charts drawn under each correlation that is possible: those of differences, which alone depend on it.
    pub(super) fn values(&self) -> impl Iterator<Item = (Correlation, impl Iterator<Item = Vec<Result<f64, WhyNot>>>)> {
        let values = |errors: Errors<'a>| shifts(errors, &[], PAIRS).map(|shift| statistics(self.differences(&shift)));
        self.stated.errors().map(move |errors| (errors.correlation, values(errors)))
    }

    fn differences(&self, shift: &[f64]) -> Result<Vec<PatchDifferences>, WhyNot> {
        let mut shift = shift.iter();
        let moved = |patch: &Patch| {
            let values = patch.measured.values().iter().zip(&mut shift).map(|(value, by)| value + by).collect();
            let moved = SpectralDistribution::new(patch.measured.wavelengths_nm().to_vec(), values);
            moved.map_or_else(|_| patch.grid.clone(), |moved| GridSpectrum::resample(&moved, Quantity::Reflectance))
        };
        let moved: Vec<GridSpectrum> = self.of.patches.patches().iter().map(moved).collect();
        let [reference, sample] =
            [(&self.of.reference, &self.renderings[0]), (&self.of.rendering, &self.renderings[1])].map(
                |(of, rendering)| (**rendering).as_ref().map(|rendering| patch_colors(of, rendering, moved.iter())),
            );
        let (reference, sample) = (reference.map_err(|&e| e)?, sample.map_err(|&e| e)?);
        let way = DifferenceConditions::new(&self.of.rendering, &self.of.reference);
        Ok(reference.iter().zip(&sample).map(|(reference, sample)| way.differences(reference, sample)).collect())
    }
}

/// Metrics of patches alone.
fn statistics(patches: Result<Vec<PatchDifferences>, WhyNot>) -> Vec<Result<f64, WhyNot>> {
    let none = WhyNot::NoPatches;
    let evidence = Evidence {
        patches,
        locus: Err(none),
        space: Err(none),
        index: Err(none),
        noise: Err(none),
        scale: Err(none),
        snr_db: Err(none),
    };
    CameraMetric::ALL.iter().map(|metric| metric.evaluate(&evidence)).collect()
}
