//! Figures of merit of many cameras, computed in the background a few at a time; their uncertainties follow for all at once.
//!
//! The latest request stops the one before it, and one that no frame repeats is stopped. Until all cameras are done, the last
//! complete ranking stays.

use std::sync::Arc;
use std::time::Duration;

use chromascope_core::metamers::Confusion;
use chromascope_core::query::{Ask, Query, Shared};
use serde::{Deserialize, Serialize};

use crate::catalog::Entry;
use crate::catalog::load::LoadError;
use crate::document::{Document, SetKind};
use crate::export::profile::{CorrectionFile, CorrectionFileQuery, CorrectionRequest};
use crate::jobs::{Background, Executor, Shown};
use crate::plot_item::SensorId;
use crate::scene::light::LightSheetQuery;
use crate::scene::metrics::{CameraFigures, CatalogMetamersQuery, CatalogMetricsQuery, FoundMetamers};
use crate::scene::recorded::RecordedRankingQuery;
use crate::scene::{Scene, SceneError};

/// Cameras between two reports of progress.
const STEP: usize = 4;

/// A choice of cameras.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum RankedCameras {
    /// All of the library, the user's too.
    #[default]
    Library,
    /// Those that are compared.
    Compared,
    /// The user's.
    Yours,
}

/// A camera to be ranked.
#[derive(Clone, Debug, PartialEq)]
pub struct RankedCamera {
    /// Its place in the catalog.
    pub id: SensorId,
    /// True if the user brought it.
    pub is_own: bool,
    /// Query for its figures of merit, or the reason that there is none.
    pub query: Result<CatalogMetricsQuery, String>,
}

/// Cameras with their figures of merit.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Ranked {
    /// The requested cameras.
    pub cameras: Vec<RankedCamera>,
    /// Their figures of merit: reason for none, or none while they are being made.
    pub metrics: Vec<Option<Result<CameraFigures, String>>>,
}

/// The first `count` queries of a list.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
struct FirstQuery {
    all: Shared<Vec<CatalogMetricsQuery>>,
    count: usize,
}

impl Query for FirstQuery {
    type Answer = Vec<Result<CameraFigures, LoadError>>;
    const NAME: &'static str = "ranking";
    const CAPACITY: usize = 2;

    fn answer(&self, ask: &impl Ask) -> Self::Answer {
        ask.ask_all(&self.all[..self.count]).iter().map(|answer| (**answer).clone()).collect()
    }
}

/// A thread for one query at a time, which rests in frames that do not ask.
struct Worker<Q: Query> {
    thread: Background<Q>,
    is_asked: bool,
}

impl<Q: Query> Worker<Q> {
    fn on(executor: &Executor, name: &str, wake: impl Fn() + Send + Sync + 'static) -> Self {
        Self { thread: Background::on(executor, name, wake), is_asked: false }
    }

    /// The last answer, which may be of an earlier question; an error if this question has none.
    fn ask(&mut self, query: Q) -> Result<Option<Shown<Q>>, String> {
        self.ask_in_stages(vec![query])
    }

    /// The same of a question in stages from coarse to fine.
    fn ask_in_stages(&mut self, stages: Vec<Q>) -> Result<Option<Shown<Q>>, String> {
        self.is_asked = true;
        self.thread.ask(stages);
        self.thread.failure().map_or_else(|| Ok(self.thread.shown()), Err)
    }

    fn end_frame(&mut self) {
        if !std::mem::take(&mut self.is_asked) {
            self.thread.rest();
        }
    }
}

/// Camera ranking in the background, and its latest result.
pub struct Ranking {
    worker: Background<FirstQuery>,
    searcher: Worker<CatalogMetamersQuery>,
    card: Worker<CatalogMetricsQuery>,
    recorded: Worker<RecordedRankingQuery>,
    corrections: Worker<CorrectionFileQuery>,
    light: Worker<LightSheetQuery>,
    asked: Option<Arc<Vec<RankedCamera>>>,
    /// Document and choice of cameras of the request.
    of: Option<(Document, RankedCameras)>,
    is_asked: bool,
    complete: Option<Arc<Ranked>>,
    shown: Arc<Ranked>,
    serial: Option<u64>,
    done: usize,
}

impl Ranking {
    /// Ranks on an executor; `wake` is called after each few cameras.
    pub fn on(executor: &Executor, wake: impl Fn() + Send + Sync + Clone + 'static) -> Self {
        Self {
            searcher: Worker::on(executor, "metamers", wake.clone()),
            card: Worker::on(executor, "report card", wake.clone()),
            recorded: Worker::on(executor, "recorded ranking", wake.clone()),
            corrections: Worker::on(executor, "color corrections", wake.clone()),
            light: Worker::on(executor, "light", wake.clone()),
            worker: Background::on(executor, "ranking", wake),
            asked: None,
            of: None,
            is_asked: false,
            complete: None,
            shown: Arc::default(),
            serial: None,
            done: 0,
        }
    }

    /// Requests the cameras of a scene and applies the results since the last frame. Repeating the same request has no effect.
    pub fn ask(&mut self, scene: &Scene<'_>, which: RankedCameras) -> Arc<Ranked> {
        self.is_asked = true;
        if self.of.as_ref().is_none_or(|(document, cameras)| document != scene.document || *cameras != which) {
            self.of = Some((scene.document.clone(), which));
            self.ask_for(cameras(scene, which));
        }
        if let Some(made) = self.worker.shown().filter(|made| made.current && self.serial != Some(made.serial)) {
            self.serial = Some(made.serial);
            self.take_in(&made.answer);
        }
        Arc::clone(&self.shown)
    }

    /// Searches all reflectances for pairs that a camera or the reference confuses; none until they are found.
    ///
    /// # Errors
    ///
    /// The reason that there is no query.
    pub fn metamers(
        &mut self,
        scene: &Scene<'_>,
        camera: &SensorId,
        confusion: Confusion,
    ) -> Result<Option<Arc<Result<FoundMetamers, String>>>, String> {
        let query = scene.metamers_query(camera.kind, &camera.name, confusion).map_err(|error| error.to_string())?;
        Ok(self.searcher.ask(query)?.filter(|shown| shown.current).map(|shown| shown.answer))
    }

    /// Figures of merit of one camera, their uncertainties a little later; the last ones while those of other conditions are made.
    ///
    /// # Errors
    ///
    /// A sentence that says why there are none.
    pub fn card(&mut self, scene: &Scene<'_>, camera: &SensorId) -> Result<Option<CameraFigures>, String> {
        let conditions = scene.metrics_conditions(scene.document.temperature_k);
        let entry = scene.entry(camera.kind, &camera.name);
        let (conditions, entry) =
            conditions.and_then(|conditions| Ok((conditions, entry?))).map_err(|error| error.to_string())?;
        let query =
            CatalogMetricsQuery::new(&entry, Shared::new(conditions), scene.channel_ratio_query(&entry.name).ok());
        let stages = vec![query.clone(), query.with_uncertainties()];
        let Some(shown) = self.card.ask_in_stages(stages)?.filter(|shown| shown.job.is_of_same_camera(&query)) else {
            return Ok(None);
        };
        (*shown.answer).clone().map(Some).map_err(|error| unloaded(camera, error))
    }

    /// Cameras by their fit to recorded values; those of an earlier question while they are fitted.
    ///
    /// # Errors
    ///
    /// A sentence that says why there are none.
    pub fn recorded(&mut self, query: RecordedRankingQuery) -> Result<Option<Shown<RecordedRankingQuery>>, String> {
        self.recorded.ask(query)
    }

    /// The color correction of a camera; none while it is made.
    ///
    /// # Errors
    ///
    /// A sentence that says why there is none.
    pub fn correction(
        &mut self,
        scene: &Scene<'_>,
        request: CorrectionRequest<'_>,
    ) -> Result<Option<Arc<CorrectionFile>>, String> {
        let query = CorrectionFileQuery::new(scene, request).map_err(|error| error.to_string())?;
        let shown = self.corrections.ask(query)?.filter(|shown| shown.current);
        shown.map(|shown| (*shown.answer).clone()).transpose().map_err(|error| error.to_string())
    }

    /// Indices of the light and consistency of the compared cameras; those of an earlier light while they are made.
    ///
    /// # Errors
    ///
    /// A sentence that says why there are none.
    pub fn light(&mut self, scene: &Scene<'_>) -> Result<Option<Shown<LightSheetQuery>>, String> {
        self.light.ask(scene.light_sheet_query().map_err(|error| error.to_string())?)
    }

    fn ask_for(&mut self, cameras: Vec<RankedCamera>) {
        if self.asked.as_deref() == Some(&cameras) {
            return;
        }
        let queries: Vec<_> = cameras.iter().filter_map(|camera| camera.query.clone().ok()).collect();
        let last = queries.len();
        let finest = Shared::new(queries.iter().map(CatalogMetricsQuery::with_uncertainties).collect());
        let all = Shared::new(queries);
        let counts = (1..=last.div_ceil(STEP)).map(|step| (step * STEP).min(last));
        let values = counts.map(|count| FirstQuery { all: all.clone(), count });
        // Values do not wait for uncertainties.
        let uncertainties = (last > 0).then_some(FirstQuery { all: finest, count: last });
        self.worker.ask(values.chain(uncertainties).collect());
        self.asked = Some(Arc::new(cameras));
        (self.serial, self.done) = (None, 0);
        if last == 0 {
            self.take_in(&[]);
        } else if self.complete.is_none() {
            self.shown = self.with(&[]);
        }
    }

    /// Shows the results; after a complete ranking only when all are available.
    fn take_in(&mut self, made: &[Result<CameraFigures, LoadError>]) {
        self.done = made.len();
        let shown = self.with(made);
        if self.progress().is_none() {
            self.complete = Some(Arc::clone(&shown));
            self.shown = shown;
        } else if self.complete.is_none() {
            self.shown = shown;
        }
    }

    /// The requested cameras, with the figures of merit of the first that have any.
    fn with(&self, made: &[Result<CameraFigures, LoadError>]) -> Arc<Ranked> {
        let cameras = self.asked.as_deref().cloned().unwrap_or_default();
        let mut made = made.iter();
        let metrics = cameras.iter().map(|camera| match &camera.query {
            Ok(_) => made.next().map(|metrics| metrics.clone().map_err(|error| unloaded(&camera.id, error))),
            Err(why) => Some(Err(why.clone())),
        });
        let metrics = metrics.collect();
        Arc::new(Ranked { cameras, metrics })
    }

    /// Number of cameras done and of all, while some are not.
    pub fn progress(&self) -> Option<(usize, usize)> {
        let all = self.asked.as_ref()?.iter().filter(|camera| camera.query.is_ok()).count();
        (self.done < all).then_some((self.done, all))
    }

    /// Running time of the latest request, if it is still running.
    pub fn busy(&self) -> Option<Duration> {
        self.worker.busy()
    }

    /// Reason that ranking failed, if it did.
    pub fn failure(&self) -> Option<String> {
        self.worker.failure()
    }

    /// Ends a frame: a request that it did not repeat is stopped, and resumes when repeated.
    pub fn end_frame(&mut self) {
        self.searcher.end_frame();
        self.card.end_frame();
        self.recorded.end_frame();
        self.corrections.end_frame();
        self.light.end_frame();
        if !std::mem::take(&mut self.is_asked) && self.worker.busy().is_some() {
            self.worker.rest();
            (self.asked, self.of) = (None, None);
        }
    }

    /// Waits until all is done. For tests.
    pub fn wait(&self) {
        self.worker.wait();
        self.searcher.thread.wait();
        self.card.thread.wait();
        self.recorded.thread.wait();
        self.light.thread.wait();
    }
}

/// The cameras of a choice, each with its query. Loads none of them.
fn cameras(scene: &Scene<'_>, which: RankedCameras) -> Vec<RankedCamera> {
    let is_chosen = |entry: &Entry| match which {
        RankedCameras::Library => true,
        RankedCameras::Compared => scene.document.compared(SetKind::Camera, &entry.name).is_some(),
        RankedCameras::Yours => entry.is_own(),
    };
    let conditions = scene.metrics_conditions(scene.document.temperature_k);
    let conditions = conditions.map(Shared::new).map_err(|error| error.to_string());
    let camera = |entry: Entry| RankedCamera {
        query: conditions.clone().map(|conditions| {
            CatalogMetricsQuery::new(&entry, conditions, scene.channel_ratio_query(&entry.name).ok())
        }),
        is_own: entry.is_own(),
        id: SensorId { kind: SetKind::Camera, name: entry.name },
    };
    scene.entries(SetKind::Camera).filter(is_chosen).map(camera).collect()
}

/// Sentence for a camera whose table is damaged.
fn unloaded(camera: &SensorId, error: LoadError) -> String {
    SceneError::Load { name: camera.name.clone(), error }.to_string()
}

/// Figures of merit of a choice of cameras with uncertainties, without delay: cached answers are used, all others are computed.
pub fn ranked(scene: &Scene<'_>, which: RankedCameras) -> Ranked {
    let cameras = cameras(scene, which);
    let metrics = |camera: &RankedCamera| {
        let query = camera.query.as_ref().map(CatalogMetricsQuery::with_uncertainties).map_err(Clone::clone);
        Some(query.and_then(|query| (*scene.results.ask(&query)).clone().map_err(|error| unloaded(&camera.id, error))))
    };
    Ranked { metrics: cameras.iter().map(metrics).collect(), cameras }
}
