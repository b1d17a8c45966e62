//! Color differences of patches that took no part in a recovery.

use glam::DVec3;

use super::chart::{ChartRecovery, RecoveryError, Shot};
use super::prior::Library;
use crate::colorimetry::Xyz;
use crate::colorimetry::difference::delta_e_2000;
use crate::colorimetry::lab::lab_from_xyz;
use crate::math::least_squares::linear_fit;
use crate::spectral::Sensor;

/// ΔE\*00 of a patch that was left out; none where a value of it is not used or the others determine no matrix.
#[derive(Clone, Debug, PartialEq)]
pub struct LeftOut {
    /// Name of the patch.
    pub patch: String,
    /// Between the recorded values and those that the curves recovered from the other patches predict, both through the matrix of these curves.
    pub table: Option<f64>,
    /// Between the patch and its recorded values through the matrix that is fitted to the recovered curves' values of the other patches.
    pub from_curves: Option<f64>,
    /// Between the patch and its recorded values through the matrix that is fitted to the recorded values of the other patches.
    pub from_patches: Option<f64>,
}

/// Each patch of the first shot left out of all shots in turn, everything recovered and fitted again (CIEDE2000, the brightest patch white).
///
/// Recorded values are divided by their brightness: that of the others as recovered, that of the patch as makes the sums of its channels
/// equal. It thus is a difference of chromaticity first of all.
///
/// # Errors
/// [`RecoveryError`] of a recovery without a patch.
pub fn left_out(library: &Library, shots: &[Shot], observer: &Sensor) -> Result<Vec<LeftOut>, RecoveryError> {
    let Some(first) = shots.first() else { return Ok(Vec::new()) };
    let xyz = |patch: usize| DVec3::from(observer.integrate(first.patches[patch].radiance.values()));
    let all = 0..first.patches.len();
    let white = all.clone().map(xyz).max_by(|a, b| a.y.total_cmp(&b.y)).unwrap_or(DVec3::ONE);
    let difference = |a: DVec3, b: DVec3| {
        let lab = |v: DVec3| lab_from_xyz(Xyz::from_vector(v), Xyz::from_vector(white));
        Some(delta_e_2000(lab(a)?, lab(b)?))
    };
    let recorded = |patch: usize| -> Option<DVec3> {
        let [r, g, b] = first.patches[patch].rgb.map(|signal| signal.value().ok());
        Some(DVec3::new(r?, g?, b?))
    };
    let one = |omitted: usize| {
        let without = |shot: &Shot| {
            let mut shot = shot.clone();
            let name = &first.patches[omitted].name;
            let kept: Vec<bool> = shot.patches.iter().map(|patch| patch.name != *name).collect();
            let mut kept = [kept.iter(), kept.iter()];
            shot.patches.retain(|_| kept[0].next() == Some(&true));
            shot.noise.retain(|_| kept[1].next() == Some(&true));
            shot
        };
        let recovery = ChartRecovery::new(library, &shots.iter().map(without).collect::<Vec<_>>())?;
        let sensor = recovery.curves.sensor().map_err(|_| RecoveryError::NoPrior)?;
        let signals = |patch: usize| DVec3::from(sensor.integrate(first.patches[patch].radiance.values()));
        let others: Vec<usize> = all.clone().filter(|patch| *patch != omitted).collect();
        let bright = |patch: &usize| {
            let place = others.iter().position(|other| other == patch)?;
            recovery.brightness[0].get(place).copied()
        };
        let fitted = |values: Vec<(DVec3, DVec3)>| {
            let rows: Vec<Vec<f64>> = values.iter().map(|(rgb, _)| rgb.to_array().to_vec()).collect();
            let targets: Vec<DVec3> = values.iter().map(|(_, xyz)| *xyz).collect();
            let terms = linear_fit(&rows, &targets, None).ok()?.coefficients;
            Some(move |rgb: DVec3| (0..3).map(|c| terms[c] * rgb[c]).sum::<DVec3>())
        };
        let by_curves = fitted(others.iter().map(|patch| (signals(*patch), xyz(*patch))).collect());
        let measured = |patch: &usize| Some((recorded(*patch)? / bright(patch)?, xyz(*patch)));
        let by_patches = fitted(others.iter().filter_map(measured).collect());
        let (own, modeled) = (recorded(omitted), signals(omitted));
        let scaled = own.map(|own| own * (modeled.element_sum() / own.element_sum()));
        let through = |a: DVec3, b: DVec3| by_curves.as_ref().and_then(|matrix| difference(matrix(a), matrix(b)));
        // Of a matrix fitted to recorded values the scale is free: luminance is that of the patch.
        let leveled = |found: DVec3| found * (xyz(omitted).y / found.y);
        let against = |found: DVec3| difference(xyz(omitted), leveled(found));
        Ok(LeftOut {
            patch: first.patches[omitted].name.clone(),
            table: scaled.and_then(|own| through(modeled, own)),
            from_curves: own.and_then(|own| against(by_curves.as_ref()?(own))),
            from_patches: own.and_then(|own| against(by_patches.as_ref()?(own))),
        })
    };
    all.clone().map(one).collect()
}
