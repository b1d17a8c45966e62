//! Background rendering: one worker and its latest pictures.

pub mod made;
pub mod pixel;

use std::sync::Arc;
use std::time::Duration;

use chromascope_core::query::Ask as _;
use chromascope_core::query::render::MeshQuery;
use chromascope_core::render::RasterSize;
use chromascope_core::scene::Viewpoint;

use crate::jobs::{Background, Executor, Job, PATIENCE};
use crate::results::Results;
use crate::scene::render::Finish;
use crate::scene::{ComparedSensor, Scene, SceneError};
use made::{MadePictures, NoPictures, PicturesAnswer, PicturesOf};

/// For this many seconds after the last change something is taken to be moving.
pub const REST_AFTER: f64 = 0.15;

/// Pictures with the query that they answer.
#[derive(Clone, Debug)]
pub struct RenderedFrame {
    pub query: PicturesOf,
    /// The sensors, in the query's order.
    pub sources: Arc<[ComparedSensor]>,
    pub answer: Arc<PicturesAnswer>,
    pub time: Duration,
    /// True if nothing finer is to come.
    pub is_last: bool,
    /// A number that no other answer has.
    pub serial: u64,
}

impl RenderedFrame {
    /// Samples along the side of a pixel of pictures that are made at once.
    const SAMPLES: u32 = 2;

    /// Pictures of a mesh through a scene's sensors for a page, made at once, so many pixels wide.
    pub fn of_mesh(scene: &Scene<'_>, mesh: MeshQuery, viewpoint: Viewpoint, width: u32) -> Result<Self, SceneError> {
        let sources = scene.rendered_sources();
        let height = (f64::from(width) / scene.document.render.aspect()).round() as u32;
        let size = RasterSize { width, height, samples: Self::SAMPLES }.clamped();
        let finish = Finish::whole(size, scene.document.render.quality());
        let query = scene.pictures_of(&sources, mesh, viewpoint, finish, None)?;
        let answer = Arc::new(PicturesAnswer::Mesh(scene.results.ask(&query)));
        let (query, sources) = (PicturesOf::Mesh(query), sources.into());
        Ok(Self { query, sources, answer, time: Duration::ZERO, is_last: true, serial: 0 })
    }

    pub fn pictures(&self) -> Result<MadePictures<'_>, NoPictures> {
        self.answer.pictures()
    }

    pub fn made(&self) -> Option<MadePictures<'_>> {
        self.pictures().ok()
    }
}

/// Pictures to be made. Names and marks of the sensors change nothing in them.
#[derive(Clone)]
struct PicturesJob {
    query: PicturesOf,
    sources: Arc<[ComparedSensor]>,
    is_last: bool,
    moving: bool,
}

impl PartialEq for PicturesJob {
    fn eq(&self, other: &Self) -> bool {
        self.query == other.query
    }
}

impl Job for PicturesJob {
    type Answer = PicturesAnswer;
    const NAME: &'static str = "pictures";

    fn run(&self, results: &Results) -> Arc<Self::Answer> {
        Arc::new(match &self.query {
            PicturesOf::Mesh(query) => PicturesAnswer::Mesh(results.ask(query)),
            PicturesOf::Image(query) => PicturesAnswer::Image(results.ask(query)),
        })
    }
}

pub struct RenderService {
    worker: Background<PicturesJob>,
    frame: Option<Arc<RenderedFrame>>,
    is_hidden: bool,
    wanted: Option<PicturesOf>,
    changed_at: f64,
    asked: bool,
    is_looked_at: bool,
    /// Running time when the last frame was made.
    busy_then: Option<Duration>,
}

impl RenderService {
    /// Makes pictures on an executor; `wake` is called when something is made.
    pub fn on(executor: &Executor, wake: impl Fn() + Send + Sync + 'static) -> Self {
        Self {
            worker: Background::on(executor, wake),
            frame: None,
            is_hidden: false,
            wanted: None,
            changed_at: f64::NEG_INFINITY,
            asked: false,
            is_looked_at: false,
            busy_then: None,
        }
    }

    /// Sets the final request, at a time in seconds. Returns the remaining time for which it counts as moving.
    pub fn want(&mut self, wanted: &PicturesOf, now: f64) -> Option<f64> {
        if self.wanted.as_ref() != Some(wanted) {
            // A first request is not a movement.
            if self.wanted.is_some() {
                self.changed_at = now;
            }
            self.wanted = Some(wanted.clone());
        }
        let rest = self.changed_at + REST_AFTER - now;
        (rest > 0.0).then_some(rest)
    }

    /// True if the finest pictures of the same signals are available, so that only their development can differ.
    pub fn only_develops(&self, wanted: &PicturesOf) -> bool {
        self.frame.as_ref().is_some_and(|frame| frame.is_last && frame.query.has_signals_of(wanted))
    }

    /// Requests stages from coarse to fine. While something moves, the running stage is not interrupted: a slightly late
    /// picture is better than none.
    pub fn ask(&mut self, stages: Vec<PicturesOf>, sources: &[ComparedSensor], moving: bool) {
        self.asked = true;
        let (latest, _) = self.worker.progress();
        let was_moving = latest.first().is_some_and(|job| job.moving);
        // What ends in the same pictures is on its way already, or there.
        let same_end = !moving && !was_moving && latest.last().map(|job| &job.query) == stages.last();
        // At rest, a running coarse stage is the first of the requested ones: stopping it would waste a mesh or a tree under
        // construction.
        let begun = moving || latest.first().map(|job| &job.query) == stages.first();
        if same_end || (begun && was_moving && self.worker.busy().is_some()) {
            return;
        }
        let sources: Arc<[ComparedSensor]> = sources.into();
        let job = |query: PicturesOf| {
            let is_last = self.wanted.as_ref() == Some(&query);
            PicturesJob { query, sources: Arc::clone(&sources), is_last, moving }
        };
        self.worker.ask(stages.into_iter().map(job).collect());
    }

    /// Stops rendering; finished pictures stay visible.
    pub fn stay(&mut self) {
        self.asked = true;
        self.worker.rest();
    }

    /// Discards the pictures, as the requested ones cannot be made.
    pub fn hide(&mut self) {
        self.is_hidden = true;
    }

    /// Applies finished work.
    pub fn refresh(&mut self) {
        self.is_hidden = false;
        self.busy_then = self.busy();
        let Some(shown) = self.worker.shown() else { return };
        if self.frame.as_ref().is_none_or(|frame| frame.serial != shown.serial) {
            let PicturesJob { query, sources, is_last, .. } = shown.job;
            // Cached pictures have no render time worth showing.
            let remembered = self.frame.as_ref().filter(|frame| frame.query == query).map(|frame| frame.time);
            let (time, serial) = (remembered.unwrap_or(shown.time), shown.serial);
            self.frame = Some(Arc::new(RenderedFrame { query, sources, answer: shown.answer, time, is_last, serial }));
        }
    }

    /// Ends a frame: pictures that it did not request are not computed.
    pub fn end_frame(&mut self) {
        self.is_looked_at = std::mem::take(&mut self.asked);
        if !self.is_looked_at {
            self.worker.rest();
        }
    }

    /// True if pictures were requested in the last frame.
    pub fn is_looked_at(&self) -> bool {
        self.is_looked_at
    }

    pub fn frame(&self) -> Option<&Arc<RenderedFrame>> {
        self.frame.as_ref().filter(|_| !self.is_hidden)
    }

    /// True if pictures were made before, visible or not.
    pub fn has_made(&self) -> bool {
        self.frame.is_some()
    }

    /// True if pictures of what is wanted are still to come, and others or none are there.
    pub fn is_of_another(&self) -> bool {
        let Some(wanted) = &self.wanted else { return false };
        self.frame.as_ref().is_none_or(|frame| !frame.query.has_subject_of(wanted))
    }

    /// True if the latest pictures are the final ones of the request.
    pub fn is_settled(&self) -> bool {
        self.frame.as_ref().is_some_and(|frame| self.wanted.as_ref() == Some(&frame.query))
    }

    pub fn busy(&self) -> Option<Duration> {
        self.worker.busy()
    }

    /// True if the request had lasted long enough for progress to be shown when the last frame was made.
    pub fn is_waiting(&self) -> bool {
        self.busy_then.is_some_and(|busy| busy >= PATIENCE)
    }

    pub fn failure(&self) -> Option<String> {
        self.worker.failure()
    }

    /// Waits until the latest request has finished. For tests.
    pub fn wait(&self) {
        self.worker.wait();
    }
}
