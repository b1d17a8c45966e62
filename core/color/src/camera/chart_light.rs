//! Uneven light on a chart, from a gray surface in its place or from its neutral patches.

use super::chart_grid::PatchMean;

/// Smallest reflectance of a neutral patch by which the light is measured: darker ones owe too much to veiling glare.
const LEAST_REFLECTANCE: f64 = 0.15;

/// Measurements divided by those of an even gray surface at the same cells, each channel of which has a mean of 1:
/// `m_kc / (f_kc / mean_k f_kc)`, with the noise of both. None where the numbers of patches differ or a channel of the surface is dark,
/// clipped or missing.
pub fn evened_by_gray(patches: &[PatchMean], gray: &[PatchMean]) -> Option<Vec<PatchMean>> {
    let usable =
        |patch: &PatchMean| (0..3).all(|c| patch.mean[c].is_finite() && !patch.is_dark(c, 0.0) && !patch.clipped[c]);
    if patches.len() != gray.len() || !gray.iter().all(usable) {
        return None;
    }
    let mean = [0, 1, 2].map(|c: usize| gray.iter().map(|patch| patch.mean[c]).sum::<f64>() / gray.len() as f64);
    let evened = |(patch, gray): (&PatchMean, &PatchMean)| {
        let mut evened = *patch;
        for (c, mean) in mean.iter().enumerate() {
            let light = gray.mean[c] / mean;
            evened.mean[c] /= light;
            evened.noise[c] = (patch.noise[c] / light).hypot(evened.mean[c] * gray.noise[c] / gray.mean[c]);
        }
        evened
    };
    Some(patches.iter().zip(gray).map(evened).collect())
}

/// Slope of the light along a row of neutral patches, as a change of its logarithm from patch to patch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NeutralSlope {
    /// Change of ln(light) from one patch to the next.
    pub slope: f64,
    /// Its standard deviation, from the residuals.
    pub deviation: f64,
}

/// Least-squares slope of `ln(m_kc / ρ_k) = g_c + s k` over a row of neutral patches of known reflectance in order, without those below
/// 15 %. It says nothing about the light across the row. None with fewer than three usable patches.
pub fn neutral_slope(row: &[PatchMean], reflectances: &[f64]) -> Option<NeutralSlope> {
    let usable = |(_, (patch, reflectance)): &(usize, (&PatchMean, &f64))| {
        **reflectance >= LEAST_REFLECTANCE && (0..3).all(|c| patch.mean[c] > 0.0 && !patch.clipped[c])
    };
    let logarithms = |(k, (patch, reflectance)): (usize, (&PatchMean, &f64))| {
        (k as f64, patch.mean.map(|mean| (mean / reflectance).ln()))
    };
    let points: Vec<(f64, [f64; 3])> =
        row.iter().zip(reflectances).enumerate().filter(usable).map(logarithms).collect();
    let n = points.len() as f64;
    if points.len() < 3 {
        return None;
    }
    let place = points.iter().map(|(k, _)| k).sum::<f64>() / n;
    let gain = [0, 1, 2].map(|c: usize| points.iter().map(|(_, ln)| ln[c]).sum::<f64>() / n);
    let square = 3.0 * points.iter().map(|(k, _)| (k - place).powi(2)).sum::<f64>();
    let sum = |value: &dyn Fn(f64, f64) -> f64| -> f64 {
        points.iter().flat_map(|(k, ln)| [0, 1, 2].map(|c: usize| value(k - place, ln[c] - gain[c]))).sum()
    };
    let slope = sum(&|k, ln| k * ln) / square;
    let residual = sum(&|k, ln| (ln - slope * k).powi(2));
    // The channels share the reflectances' errors: they count as one in the degrees of freedom.
    Some(NeutralSlope { slope, deviation: (residual / (n - 2.0) / square).sqrt() })
}
