//! Uncertainty of light and patches: first derivatives of metrics by their samples, propagated (JCGM 100:2008, 5.1 and 5.2).

use super::differences::{DifferenceConditions, PatchDifferences};
use super::evidence::Evidence;
use super::table::{CameraMetric, MetricGroup};
use super::value::{CameraMetricsQuery, WhyNot};
use crate::ask::{Ask, Shared};
use crate::patches::{PatchColor, RenderingQuery, patch_colors};
use chromascope_color::spectral::grid::{FIRST_NM, LAST_NM};
use chromascope_color::spectral::{GridSpectrum, Quantity, SpectralDistribution, StatedUncertainty};
use chromascope_color::units::hash_by;
use std::ops::Range;

/// Width in nanometers of the bands within which a metric has one derivative by all samples.
const BAND_NM: f64 = 10.0;
/// Step of a derivative, relative to a spectrum's largest value or to a difference.
const STEP: f64 = 1e-3;

/// A light as measured, with the uncertainty that its file states.
#[derive(Clone, Debug, PartialEq)]
pub struct LightUncertainty {
    /// Light at the wavelengths of its file.
    pub measured: SpectralDistribution,
    /// Uncertainty of its one curve.
    pub stated: StatedUncertainty,
}

hash_by!(LightUncertainty, |of| (&of.measured, &of.stated));

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

/// Standard uncertainty of each metric by the light's: camera and reference see the same light.
pub(super) fn light_parts(
    of: &CameraMetricsQuery,
    light: Option<&LightUncertainty>,
    nominal: &[Result<f64, WhyNot>],
    ask: &impl Ask,
) -> Vec<f64> {
    let nothing = vec![0.0; nominal.len()];
    let Some(LightUncertainty { measured, stated }) = light else { return nothing };
    if !stated.is_of([measured.values().len()]) {
        return nothing;
    }
    let step = STEP * largest(measured);
    let mut derivatives = vec![vec![0.0; measured.values().len()]; nominal.len()];
    for band in bands(measured) {
        let is_certain = stated.standard()[0][band.clone()].iter().all(|u| *u == 0.0);
        let Some(shift) = shift(measured, &band, step).filter(|_| !is_certain) else { continue };
        let light = Shared::new(sum(&of.rendering.light, &shift));
        let under = |rendering: &RenderingQuery| RenderingQuery { light: light.clone(), ..rendering.clone() };
        let (rendering, reference) = (under(&of.rendering), under(&of.reference));
        let moved = ask.ask(&CameraMetricsQuery { rendering, reference, ..of.clone() });
        if ask.stop().is_set() {
            return nothing;
        }
        for ((derivatives, moved), nominal) in derivatives.iter_mut().zip(&moved.values).zip(nominal) {
            if let (Ok(moved), Ok(nominal)) = (moved, nominal) {
                derivatives[band.clone()].fill((moved - nominal) / (step * band.len() as f64));
            }
        }
    }
    derivatives.iter().map(|derivatives| stated.propagated(derivatives)).collect()
}

/// Standard uncertainty of each metric by the patches': that of differences alone, which the others do not use.
pub(super) fn patch_parts(of: &CameraMetricsQuery, stated: Option<&StatedUncertainty>, ask: &impl Ask) -> Vec<f64> {
    let nothing = vec![0.0; CameraMetric::ALL.len()];
    let patches = of.patches.patches();
    let lengths = || patches.iter().map(|patch| patch.measured.values().len());
    let Some(stated) = stated.filter(|stated| stated.is_of(lengths())) else { return nothing };
    let renderings = [ask.ask(&of.rendering), ask.ask(&of.reference)];
    let [Ok(sample), Ok(reference)] = [&*renderings[0], &*renderings[1]] else { return nothing };
    let way = DifferenceConditions::new(&of.rendering, &of.reference);
    let differences = |reflectances: &[GridSpectrum]| -> Vec<PatchDifferences> {
        let colors = |of: &RenderingQuery, rendering| -> Vec<PatchColor> {
            patch_colors(of, rendering, reflectances.iter())
        };
        let pairs = colors(&of.reference, reference).into_iter().zip(colors(&of.rendering, sample));
        pairs.map(|(reference, sample)| way.differences(&reference, &sample)).collect()
    };
    let grids: Vec<GridSpectrum> = patches.iter().map(|patch| patch.grid.clone()).collect();
    let nominal = differences(&grids);
    let values = statistics(nominal.clone());
    let metrics = CameraMetric::ALL.iter().enumerate();
    let metrics: Vec<usize> =
        metrics.filter(|(_, metric)| metric.group == MetricGroup::Differences).map(|(at, _)| at).collect();
    let mut derivatives = vec![Vec::with_capacity(lengths().sum()); CameraMetric::ALL.len()];
    for (p, patch) in patches.iter().enumerate() {
        let mut of_patch = vec![vec![0.0; patch.measured.values().len()]; CameraMetric::ALL.len()];
        let is_certain = stated.standard()[p].iter().all(|u| *u == 0.0);
        let bands = if is_certain { Vec::new() } else { bands(&patch.measured) };
        let step = STEP * largest(&patch.measured);
        let shifts = bands.iter().filter_map(|band| shift(&patch.measured, band, step));
        let moved = differences(&shifts.map(|shift| sum(&patch.grid, &shift)).collect::<Vec<_>>());
        let mut bumped = nominal.clone();
        bumped[p] = scaled(&nominal[p], 1.0 + STEP);
        let (bumped, alone) = (statistics(bumped), statistics(vec![nominal[p].clone()]));
        for (band, moved) in bands.iter().zip(moved) {
            let moved = statistics(vec![moved]);
            for &m in &metrics {
                // By the patch's own difference, then by its samples.
                if let [Ok(all), Ok(bumped), Ok(alone), Ok(moved)] = [values[m], bumped[m], alone[m], moved[m]]
                    && alone != 0.0
                {
                    let share = (bumped - all) / (STEP * alone);
                    of_patch[m][band.clone()].fill(share * (moved - alone) / (step * band.len() as f64));
                }
            }
        }
        derivatives.iter_mut().zip(of_patch).for_each(|(all, own)| all.extend(own));
        if ask.stop().is_set() {
            return nothing;
        }
    }
    derivatives.iter().map(|derivatives| stated.propagated(derivatives)).collect()
}

fn scaled(of: &PatchDifferences, by: f64) -> PatchDifferences {
    PatchDifferences {
        by_metric: of.by_metric.iter().map(|value| value.map(|value| value * by)).collect(),
        lch: of.lch.map(|lch| lch.map(|value| value * by)),
        angle_deg: of.angle_deg.map(|value| value * by),
    }
}

/// Metrics of patches alone.
fn statistics(patches: Vec<PatchDifferences>) -> Vec<Result<f64, WhyNot>> {
    let none = WhyNot::NoPatches;
    let evidence = Evidence {
        patches: Ok(patches),
        locus: Err(none),
        space: Err(none),
        index: Err(none),
        noise: Err(none),
        scale: Err(none),
        snr_db: Err(none),
    };
    CameraMetric::ALL.iter().map(|metric| metric.evaluate(&evidence)).collect()
}
