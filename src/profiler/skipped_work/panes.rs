//! Work of panes that are not visible, each measured with an empty cache.

use chromascope_core::query::Ask;
use chromascope_core::query::render::picture::PicturesQuery;
use chromascope_measure::harness::timed;

use super::SkippedWork;
use crate::profiler::{SceneRunJob, fresh};

/// The row of the loci.
pub const LOCI: &str = "loci, while Chromaticity is not visible";
/// The row of the patches.
pub const PATCHES: &str = "patches of a sensor, while nothing shows them";

/// Number of threads that evaluate queries here, in words.
fn threads() -> String {
    match rayon::current_num_threads() {
        1 => "one thread".to_owned(),
        threads => format!("up to {threads} threads"),
    }
}

/// Work skipped for cameras that are not visible: their signals are computed here.
pub(super) fn cameras(run: &SceneRunJob, pictures: &PicturesQuery, ask: &impl Ask) -> Option<SkippedWork> {
    let ((), seconds) =
        timed(|| run.hidden.iter().for_each(|hidden| drop(ask.ask(&pictures.image(&hidden.rendering)))));
    (!run.hidden.is_empty()).then(|| SkippedWork {
        what: "sensors that are not visible".into(),
        count: run.hidden.len() as u64,
        of: Some((run.hidden.len() + pictures.sources.len()) as u64),
        saved: seconds,
        how: format!("their signals, computed once with shared inputs cached; {}", threads()),
    })
}

/// The pictures of a workspace that is not visible.
pub(super) fn pictures(pictures: &PicturesQuery, ask: &impl Ask) -> Option<SkippedWork> {
    let fresh = fresh(ask);
    let (answer, seconds) = timed(|| fresh.ask(pictures));
    matches!(&*answer, Ok(Some(_))).then(|| SkippedWork {
        what: "pictures, while Render is not visible".into(),
        count: pictures.sources.len() as u64,
        of: None,
        saved: seconds,
        how: format!("made timed from nothing, mesh, shadows and tables included; {}", threads()),
    })
}

/// Queries of the other panes.
pub(super) fn others(run: &SceneRunJob, ask: &impl Ask) -> Vec<SkippedWork> {
    let row = |what: &'static str, count: usize, work: &dyn Fn()| {
        let ((), saved) = timed(work);
        let how = format!("each made timed from nothing; {}", threads());
        (count > 0).then_some(SkippedWork { what: what.into(), count: count as u64, of: None, saved, how })
    };
    let loci = row(LOCI, run.loci.len(), &|| run.loci.iter().for_each(|locus| drop(fresh(ask).ask(locus))));
    let patches =
        row(PATCHES, run.patches.len(), &|| run.patches.iter().for_each(|patches| drop(fresh(ask).ask(patches))));
    [loci, patches].into_iter().flatten().collect()
}
