//! Sums over wavelengths that were not made.

use chromascope_core::reflectance::Precision;
use chromascope_core::render::SpectralWeights;
use chromascope_core::render::diffuse::by_nodes;
use chromascope_core::render::shading::{DiffuseKind, Shade};
use chromascope_measure::harness::shortest;

use super::{SAMPLES, SUMS, SkippedWork, Sources, measured_on, some_of};

/// Work skipped for dark samples; their sums are computed here.
pub(super) fn dark(sources: &Sources<'_>) -> Option<SkippedWork> {
    let shades = sources.shading.shades().iter().enumerate();
    let lit: Vec<&Shade> = shades.filter(|(index, _)| sources.is_lit(*index)).map(|(_, shade)| shade).collect();
    let dark: Vec<&Shade> = lit.iter().copied().filter(|shade| shade.kind == DiffuseKind::Dark).collect();
    let taken = some_of(&dark, SAMPLES);
    if taken.is_empty() {
        return None;
    }
    let sum = |measure: &SpectralWeights| {
        let sum = |shade: &&Shade| by_nodes(measure.coarse(), shade.kappa, shade.beta, Precision::Fine);
        taken.iter().map(sum).collect::<Vec<_>>()
    };
    let seconds = shortest(|| sources.measures().map(sum).collect::<Vec<_>>());
    let places = sources.places();
    let threshold = if sources.pictures.shading.quality.leaves_dark() {
        "below e^-30 of the peak at their roughness at every wavelength, or the model gives nothing"
    } else {
        "where the model gives nothing"
    };
    Some(SkippedWork {
        what: format!("lit {places} below the threshold").into(),
        count: dark.len() as u64,
        of: Some(lit.len() as u64),
        saved: seconds * dark.len() as f64 / taken.len() as f64,
        how: format!(
            "{threshold}: sums at nine wavelengths; {}, one thread",
            measured_on(taken.len(), dark.len(), places)
        ),
    })
}

/// Skipped wavelengths of the grid: the sums over all are computed here.
pub(super) fn wavelengths(sources: &Sources<'_>) -> Option<SkippedWork> {
    let lit = sources.lit();
    let (mut looked_at, mut all) = (0, 0);
    for plans in &sources.plans {
        looked_at += lit.iter().map(|shade| plans.looked_at(shade) as u64).sum::<u64>();
        all += (plans.measure().dense().len() * lit.len()) as u64;
    }
    if looked_at >= all {
        return None;
    }
    let taken = some_of(&lit, SUMS);
    let sum = |measure: &SpectralWeights| {
        let sum = |shade: &&Shade| by_nodes(measure.dense(), shade.kappa, shade.beta, Precision::Full);
        taken.iter().map(sum).collect::<Vec<_>>()
    };
    let by_sum = shortest(|| sources.measures().map(sum).collect::<Vec<_>>());
    let now: f64 = sources.plans.iter().map(|plans| plans.seconds(&taken)).sum();
    let places = sources.places();
    Some(SkippedWork {
        what: format!("wavelengths at a lit {}", sources.place()).into(),
        count: all - looked_at,
        of: Some(all),
        saved: (by_sum - now).max(0.0) * lit.len() as f64 / taken.len() as f64,
        how: format!(
            "those of 401 that the integral is not zero at and S is not made at; sums over all of them, S to 1e-13, less what \
             integrals cost now; {}, one thread",
            measured_on(taken.len(), lit.len(), places)
        ),
    })
}
