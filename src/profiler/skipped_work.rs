//! Skipped work of a scene and the time saved, measured by doing that work.

mod coherent_samples;
mod panes;
mod source_plans;
mod sums;
mod terms;

use std::borrow::Cow;
use std::sync::Arc;

use chromascope_core::query::Ask;
use chromascope_core::query::render::picture::PicturesQuery;
use chromascope_core::render::shading::{DiffuseKind, Shade};
use chromascope_core::render::{CameraImage, ShadingImage, SpectralWeights, Stop};
use chromascope_measure::harness::shortest;
use chromascope_measure::pareto::duration;
use serde::{Deserialize, Serialize};

use super::SceneRunJob;
pub use panes::{LOCI, PATCHES};
use source_plans::SourcePlans;

/// Maximum number of samples computed to extrapolate the cost of all.
const SAMPLES: usize = 1000;
/// Maximum number of samples summed over all wavelengths.
const SUMS: usize = 200;

/// Something that was not computed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SkippedWork {
    /// Name of the work.
    pub what: Cow<'static, str>,
    /// Number of units that were skipped.
    pub count: u64,
    /// Total number of units; `None` where it is meaningless.
    pub of: Option<u64>,
    /// The seconds saved; 0 where that was not measured.
    pub saved: f64,
    /// Method of the measurement, or the reason that there is none.
    pub how: String,
}

/// All rows. Rows interrupted by a stop are omitted.
pub(super) fn rows(run: &SceneRunJob, ask: &impl Ask) -> Vec<SkippedWork> {
    let mut rows = Vec::new();
    if let Some(pictures) = &run.pictures {
        rows.extend(of_pictures(pictures, ask).unwrap_or_default());
        if !ask.stop().is_set() {
            rows.extend(panes::cameras(run, pictures, ask));
            rows.extend(panes::pictures(pictures, ask));
        }
    }
    if !ask.stop().is_set() {
        rows.extend(panes::others(run, ask));
    }
    rows
}

/// Pictures and samples to measure on.
struct Sources<'a> {
    pictures: &'a PicturesQuery,
    shading: &'a ShadingImage,
    plans: Vec<SourcePlans>,
}

impl Sources<'_> {
    fn measures(&self) -> impl Iterator<Item = &SpectralWeights> {
        self.plans.iter().map(SourcePlans::measure)
    }

    /// The samples, or vertices in their place, that take a spectral integral.
    fn lit(&self) -> Vec<&Shade> {
        let shades = self.shading.shades().iter();
        shades.filter(|shade| shade.kind == DiffuseKind::Spectral).collect()
    }

    /// True at a sample, or vertex, that the light reaches; a sample may be lit by the sky or from behind alone.
    fn is_lit(&self, index: usize) -> bool {
        let angles = self.shading.geometry().angles();
        self.shading.vertices().is_some() || angles.get(index).is_some_and(|angles| angles.light() > 0.0)
    }

    fn place(&self) -> &'static str {
        if self.shading.vertices().is_some() { "vertex" } else { "sample" }
    }

    fn places(&self) -> &'static str {
        if self.shading.vertices().is_some() { "vertices" } else { "samples" }
    }
}

/// At most `most` elements of a list, evenly spread.
fn some_of<T: Clone>(all: &[T], most: usize) -> Vec<T> {
    all.iter().step_by(all.len().div_ceil(most).max(1)).cloned().collect()
}

/// Number of samples measured, in words.
fn measured_on(taken: usize, all: usize, places: &str) -> String {
    if taken < all { format!("extrapolated from {taken} {places}") } else { format!("all {taken} {places}") }
}

fn of_pictures(pictures: &PicturesQuery, ask: &impl Ask) -> Option<Vec<SkippedWork>> {
    let shading = ask.ask(&pictures.shading);
    let shading = (*shading).as_ref()?;
    let plans = pictures.sources.iter().filter_map(|source| SourcePlans::new(pictures, source, shading, ask)).collect();
    let sources = Sources { pictures, shading, plans };
    let mut rows = unlit(&sources);
    rows.extend(sums::dark(&sources));
    rows.extend(sums::wavelengths(&sources));
    rows.extend(terms::terms(&sources));
    rows.extend(coherent_samples::coherent_samples(&sources, ask));
    (!ask.stop().is_set()).then_some(rows)
}

/// Samples that no light or no triangle is at.
fn unlit(sources: &Sources<'_>) -> Vec<SkippedWork> {
    let size = sources.pictures.shading.geometry.visibility.size;
    let all = (size.columns() * size.rows()) as u64;
    let counts = sources.shading.geometry().counts();
    let each = sample_cost(sources);
    let how = match &each {
        Ok(each) => format!(
            "what a lit sample costs through all sensors, from angles to signals, {}, times their number; {}, one \
             thread",
            duration(each.seconds),
            measured_on(each.samples, sources.shading.geometry().angles().len(), "lit samples"),
        ),
        Err(why) => format!("time not measured: {why}"),
    };
    let row = |what: &'static str, count: u64, of: u64| {
        let saved = each.as_ref().map_or(0.0, |each| each.seconds * count as f64);
        SkippedWork { what: what.into(), count, of: Some(of), saved, how: how.clone() }
    };
    vec![
        row("samples beside the mesh", all - counts.seen.min(all), all),
        row("samples turned from the light", counts.facing_away, all),
        row("samples in shadow", counts.shadowed, all),
    ]
}

/// Cost of a lit sample.
struct SampleCost {
    seconds: f64,
    /// Number of samples measured.
    samples: usize,
}

/// Seconds of a lit sample through all sources, from angles to signals, on one thread.
fn sample_cost(sources: &Sources<'_>) -> Result<SampleCost, &'static str> {
    if sources.shading.vertices().is_some() {
        return Err(
            "with the roughness from the mesh all vertices are computed, and a sample only mixes three of them",
        );
    }
    let lit = sources.shading.geometry().angles().len();
    let thinned = Arc::new(sources.shading.geometry().thinned(lit.div_ceil(SAMPLES).max(1)));
    let count = thinned.angles().len();
    if count == 0 {
        return Err("no sample is lit");
    }
    let of = &sources.pictures.shading;
    let work = || {
        let shading = ShadingImage::new(thinned.clone(), of.surface, of.reading, of.quality, &Stop::NEVER)?;
        for plans in &sources.plans {
            let measure = plans.measure();
            CameraImage::new(&shading, measure, Arc::clone(plans.plan()), &Stop::NEVER)?;
        }
        Some(())
    };
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().map_err(|_| "no thread could be started")?;
    Ok(SampleCost { seconds: shortest(|| pool.install(work)) / count as f64, samples: count })
}

#[cfg(test)]
mod tests;
