//! What a scene did not compute, and the time that this saved: measured by computing it.

mod terms;

use std::borrow::Cow;

use chromascope_core::query::Ask;
use chromascope_core::query::render::PicturesOf;
use chromascope_core::reflectance::{Precision, coherent_prefactor, kappa};
use chromascope_core::render::diffuse::by_nodes;
use chromascope_core::render::mirror::{Nodes, mirror_sum};
use chromascope_core::render::shading::{Mirror, Way};
use chromascope_core::render::{Measure, Quality, ShadingImage};
use chromascope_core::spectral::grid::COUNT;
use serde::{Deserialize, Serialize};

use super::SceneRunOf;
use super::stopwatch::once;

/// At most so many samples are computed to say what all would have cost.
const SAMPLES: usize = 1000;
/// The same for sums over all wavelengths.
const SUMS: usize = 200;

/// Something that was not computed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct LeftOut {
    /// What it is.
    pub what: Cow<'static, str>,
    /// How many of these were left out.
    pub count: u64,
    /// Of how many; none where that says nothing.
    pub of: Option<u64>,
    /// The seconds saved, on one thread.
    pub saved: f64,
    /// How that was measured.
    pub how: String,
}

/// All rows. What is stopped on the way is left out.
pub(super) fn rows(run: &SceneRunOf, ask: &impl Ask) -> Vec<LeftOut> {
    let mut rows = Vec::new();
    if let Some(pictures) = &run.pictures {
        rows.extend(of_pictures(pictures, ask).unwrap_or_default());
        if !ask.stop().is_set() {
            rows.extend(cameras(run, pictures, ask));
            rows.extend(panes_of_pictures(pictures, ask));
        }
    }
    if !ask.stop().is_set() {
        rows.extend(panes(run, ask));
    }
    rows
}

/// A source with its weights.
struct Sources<'a> {
    pictures: &'a PicturesOf,
    shading: &'a ShadingImage,
    measures: Vec<std::sync::Arc<Result<Measure, chromascope_core::camera::NoRendering>>>,
}

impl Sources<'_> {
    fn measures(&self) -> impl Iterator<Item = &Measure> {
        self.measures.iter().filter_map(|measure| (**measure).as_ref().ok())
    }

    fn count(&self) -> f64 {
        self.measures().count() as f64
    }
}

fn of_pictures(pictures: &PicturesOf, ask: &impl Ask) -> Option<Vec<LeftOut>> {
    let shading = ask.ask(&pictures.shading);
    let shading = (*shading).as_ref()?;
    let measures = pictures.sources.iter().map(|source| ask.ask(&pictures.image(&source.rendering).measure)).collect();
    let sources = Sources { pictures, shading, measures };
    let size = pictures.shading.geometry.visibility.size;
    let all = (size.columns() * size.rows()) as u64;
    let counts = shading.geometry().counts();
    let each = sample_cost(&sources)?;
    let plain = |what: &'static str, count: u64, of: u64| LeftOut {
        what: what.into(),
        count,
        of: Some(of),
        saved: each * count as f64,
        how: format!("what a lit sample costs through all sources, {:.0} ns, times their number", each * 1e9),
    };
    let mut rows = vec![
        plain("samples beside the mesh", all - counts.seen.min(all), all),
        plain("samples turned from the light", counts.facing_away, all),
        plain("samples in shadow", counts.shadowed, all),
    ];
    rows.extend(dark(&sources));
    rows.extend(wavelengths(&sources, each));
    rows.extend(terms::terms(&sources, each, ask));
    rows.extend(mirrors(&sources));
    (!ask.stop().is_set()).then_some(rows)
}

/// Seconds of a lit sample through all sources, from angles to signals, on one thread.
fn sample_cost(sources: &Sources<'_>) -> Option<f64> {
    use chromascope_core::render::mirror::Reach;
    use chromascope_core::render::{Against, CameraImage, DiffuseTable, Plan, Stop};
    let lit = sources.shading.geometry().angles().len();
    let thinned = std::sync::Arc::new(sources.shading.geometry().thinned(lit.div_ceil(SAMPLES).max(1)));
    let count = thinned.angles().len();
    if count == 0 {
        return None;
    }
    let of = &sources.pictures.shading;
    let tables: Vec<Option<DiffuseTable>> =
        sources.measures().map(|measure| sources.shading.needs_table().then(|| DiffuseTable::new(measure))).collect();
    let demand = sources.shading.demand().zip(sources.shading.plan_accuracy());
    let plan = |measure| demand.and_then(|(demand, accuracy)| Plan::new(measure, accuracy, Against::Peak, demand).ok());
    let plans: Vec<Option<Plan>> = sources.measures().map(plan).collect();
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().ok()?;
    let work = || {
        let shading = ShadingImage::new(thinned.clone(), of.surface, of.reading, of.quality, &Stop::NEVER)?;
        for ((measure, table), plan) in sources.measures().zip(&tables).zip(&plans) {
            match plan {
                Some(plan) => {
                    let reach = Reach::of(of.quality, measure);
                    CameraImage::by_plan(&shading, measure, Some(plan), reach, &Stop::NEVER)?
                }
                None => CameraImage::new(&shading, measure, table.as_ref(), &Stop::NEVER)?,
            };
        }
        Some(())
    };
    let times = (0..3).map(|_| once(|| pool.install(work)).1);
    Some(times.fold(f64::INFINITY, f64::min) / count as f64)
}

/// Samples whose light lies below the threshold: their sums are made here.
fn dark(sources: &Sources<'_>) -> Option<LeftOut> {
    let dark: Vec<[f64; 2]> = sources
        .shading
        .shades()
        .iter()
        .filter(|shade| shade.way == Way::Dark)
        .map(|shade| [shade.kappa, shade.beta])
        .collect();
    let of = sources.shading.shades().len() as u64;
    let taken: Vec<[f64; 2]> = dark.iter().step_by(dark.len().div_ceil(SAMPLES).max(1)).copied().collect();
    if taken.is_empty() {
        return None;
    }
    let sum = |measure: &Measure| {
        taken.iter().map(|&[kappa, beta]| by_nodes(measure.coarse(), kappa, beta, Precision::Fine)).collect::<Vec<_>>()
    };
    let (_, seconds) = once(|| sources.measures().map(sum).collect::<Vec<_>>());
    Some(LeftOut {
        what: "lit samples below the threshold".into(),
        count: dark.len() as u64,
        of: Some(of),
        saved: seconds * dark.len() as f64 / taken.len() as f64,
        how: format!("sums at nine wavelengths at {} of them", taken.len()),
    })
}

/// Wavelengths of the grid that were not looked at: the sums over all are made here.
fn wavelengths(sources: &Sources<'_>, each: f64) -> Option<LeftOut> {
    let quality = sources.pictures.shading.quality;
    if matches!(quality, Quality::Exact | Quality::Regimes) {
        return None;
    }
    let lit: Vec<[f64; 2]> = sources
        .shading
        .shades()
        .iter()
        .filter(|shade| !matches!(shade.way, Way::Dark | Way::Flat))
        .map(|shade| [shade.kappa, shade.beta])
        .collect();
    let taken: Vec<[f64; 2]> = lit.iter().step_by(lit.len().div_ceil(SUMS).max(1)).copied().collect();
    if taken.is_empty() {
        return None;
    }
    let sum = |measure: &Measure| {
        taken.iter().map(|&[kappa, beta]| by_nodes(measure.dense(), kappa, beta, Precision::Full)).collect::<Vec<_>>()
    };
    let (_, seconds) = once(|| sources.measures().map(sum).collect::<Vec<_>>());
    let by_sum = seconds / taken.len() as f64;
    Some(LeftOut {
        what: "wavelengths of 401 at a lit sample".into(),
        count: (lit.len() as f64 * sources.count()) as u64 * COUNT as u64,
        of: None,
        saved: ((by_sum - each) * lit.len() as f64).max(0.0),
        how: format!("sums over all wavelengths at {} samples, less what they cost now", taken.len()),
    })
}

/// Mirror terms too small to be seen: they are made here, by the full sum.
fn mirrors(sources: &Sources<'_>) -> Option<LeftOut> {
    let shading = sources.shading;
    let (surface, radius) = (*shading.surface(), shading.geometry().angular_radius());
    let reading = sources.pictures.shading.reading;
    let skipped = shading.counts().mirrors_skipped;
    let has: std::collections::BTreeSet<u32> = shading.mirrors().iter().map(|mirror| mirror.index).collect();
    let all = shading.geometry().angles();
    let stride = all.len().div_ceil(SUMS).max(1);
    let taken: Vec<Mirror> = (0..all.len())
        .step_by(stride)
        .filter(|index| !has.contains(&(*index as u32)))
        .map(|index| {
            let geometry = all[index].geometry();
            Mirror {
                index: index as u32,
                front: coherent_prefactor(&surface, &geometry, reading),
                kappa: kappa(&surface, &geometry),
                v: [geometry.vx_by_k, geometry.vy_by_k],
            }
        })
        .collect();
    if taken.is_empty() || skipped == 0 {
        return None;
    }
    let sum = |measure: &Measure| {
        let nodes = Nodes {
            smooth: measure.fine(),
            every: measure.dense(),
            still_m: 0.0,
            settled_m: f64::INFINITY,
            quick: false,
        };
        taken.iter().map(|mirror| mirror_sum(mirror, &surface, nodes, radius)).collect::<Vec<_>>()
    };
    let (_, seconds) = once(|| sources.measures().map(sum).collect::<Vec<_>>());
    Some(LeftOut {
        what: "mirror terms".into(),
        count: skipped,
        of: Some(shading.shades().len() as u64),
        saved: seconds * skipped as f64 / taken.len() as f64,
        how: format!("mirror terms over all wavelengths at {} samples", taken.len()),
    })
}

/// Cameras that are not on show: their signals are made here.
fn cameras(run: &SceneRunOf, pictures: &PicturesOf, ask: &impl Ask) -> Option<LeftOut> {
    let ((), seconds) = once(|| run.hidden.iter().for_each(|hidden| drop(ask.ask(&pictures.image(&hidden.rendering)))));
    (!run.hidden.is_empty()).then(|| LeftOut {
        what: "sources that are not on show".into(),
        count: run.hidden.len() as u64,
        of: Some((run.hidden.len() + pictures.sources.len()) as u64),
        saved: seconds,
        how: "their signals, made once, on all threads".to_owned(),
    })
}

/// The pictures of a workspace that is not on show.
fn panes_of_pictures(pictures: &PicturesOf, ask: &impl Ask) -> Option<LeftOut> {
    let (answer, seconds) = once(|| ask.ask(pictures));
    matches!(&*answer, Ok(Some(_))).then(|| LeftOut {
        what: "pictures, while Render is not on show".into(),
        count: pictures.sources.len() as u64,
        of: None,
        saved: seconds,
        how: "made once, on all threads, with what this run knew already".to_owned(),
    })
}

/// What other panes would ask for.
fn panes(run: &SceneRunOf, ask: &impl Ask) -> Vec<LeftOut> {
    let mut rows = Vec::new();
    if !run.loci.is_empty() {
        let ((), seconds) = once(|| run.loci.iter().for_each(|locus| drop(ask.ask(locus))));
        rows.push(LeftOut {
            what: "loci, while Chromaticity is not on show".into(),
            count: run.loci.len() as u64,
            of: None,
            saved: seconds,
            how: "made once".to_owned(),
        });
    }
    if !run.patches.is_empty() {
        let ((), seconds) = once(|| run.patches.iter().for_each(|patches| drop(ask.ask(patches))));
        rows.push(LeftOut {
            what: "patches of a source, while nothing shows them".into(),
            count: run.patches.len() as u64,
            of: None,
            saved: seconds,
            how: "made once".to_owned(),
        });
    }
    rows
}
