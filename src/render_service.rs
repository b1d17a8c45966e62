//! Where pictures are made: one worker, what it was asked for, and what it last made.

pub mod pixel;

use std::sync::Arc;
use std::time::Duration;

use chromascope_core::camera::RenderingError;
use chromascope_core::query::Query;
use chromascope_core::query::render::picture::{Pictures, PicturesQuery};

use crate::jobs::{Background, Executor};
use crate::results::Count;
use crate::scene::ComparedSensor;

/// For this many seconds after the last change something is taken to be moving.
pub const REST_AFTER: f64 = 0.15;

/// Pictures with the question that they answer.
#[derive(Clone, Debug)]
pub struct RenderedFrame {
    /// The question.
    pub query: PicturesQuery,
    /// The sensors, in the question's order.
    pub sources: Vec<ComparedSensor>,
    /// The answer.
    pub answer: Arc<<PicturesQuery as Query>::Answer>,
    /// How long it took.
    pub time: Duration,
    /// True if nothing finer is to come.
    pub is_last: bool,
    /// A number that no other answer has.
    pub serial: u64,
}

impl RenderedFrame {
    /// The pictures, or why there are none.
    pub fn pictures(&self) -> Result<&Pictures, RenderingError> {
        match &*self.answer {
            Ok(Some(pictures)) => Ok(pictures),
            Ok(None) => Err(RenderingError::NoWhite),
            Err(error) => Err(*error),
        }
    }

    /// The pictures, if there are any.
    pub fn made(&self) -> Option<&Pictures> {
        self.pictures().ok()
    }
}

/// What the worker was asked for.
#[derive(Clone, Default)]
struct Request {
    stages: Vec<PicturesQuery>,
    sources: Vec<ComparedSensor>,
    wanted: Option<PicturesQuery>,
    moving: bool,
}

/// The worker and its last answer.
pub struct RenderService {
    worker: Background<PicturesQuery>,
    latest: Request,
    before: Request,
    shot: Option<Arc<RenderedFrame>>,
    wanted: Option<PicturesQuery>,
    changed_at: f64,
    asked: bool,
}

impl RenderService {
    /// Starts the worker, which wakes the window when it has made something.
    pub fn new(ctx: &egui::Context) -> Self {
        Self::on(&Executor::default(), ctx)
    }

    /// Makes pictures on an executor.
    pub fn on(executor: &Executor, ctx: &egui::Context) -> Self {
        let window = ctx.clone();
        Self {
            worker: Background::on(executor, "pictures", move || window.request_repaint()),
            latest: Request::default(),
            before: Request::default(),
            shot: None,
            wanted: None,
            changed_at: f64::NEG_INFINITY,
            asked: false,
        }
    }

    /// Says what is to be shown in the end, at a time in seconds. Returns for how long it is still taken to be moving.
    pub fn want(&mut self, wanted: &PicturesQuery, now: f64) -> Option<f64> {
        if self.wanted.as_ref() != Some(wanted) {
            // What is shown for the first time did not move.
            if self.wanted.is_some() {
                self.changed_at = now;
            }
            self.wanted = Some(wanted.clone());
        }
        let rest = self.changed_at + REST_AFTER - now;
        (rest > 0.0).then_some(rest)
    }

    /// True if the finest pictures of the same shaded mesh are on show, so that only their development can differ.
    pub fn only_develops(&self, wanted: &PicturesQuery) -> bool {
        self.shot.as_ref().is_some_and(|shot| shot.is_last && shot.query.shading == wanted.shading)
    }

    /// Asks for stages from coarse to fine. While something moves, what is being made is waited for: a picture a little late is
    /// better than none.
    pub fn ask(&mut self, stages: Vec<PicturesQuery>, sources: &[ComparedSensor], moving: bool) {
        self.asked = true;
        // What ends in the same pictures is on its way already, or there.
        let same_end = !moving && !self.latest.moving && self.latest.stages.last() == stages.last();
        if same_end || self.latest.stages == stages {
            return;
        }
        // At rest, the coarse pictures that are on their way are the first of those wanted: stopping them would waste a mesh or a
        // tree that is being built.
        let begun = moving || self.latest.stages.first() == stages.first();
        if begun && self.latest.moving && self.worker.busy().is_some() {
            return;
        }
        let request =
            Request { stages: stages.clone(), sources: sources.to_vec(), wanted: self.wanted.clone(), moving };
        self.before = std::mem::replace(&mut self.latest, request);
        self.worker.ask(stages);
    }

    /// Nobody looks: what is being made is stopped.
    fn rest(&mut self) {
        if !self.latest.stages.is_empty() {
            self.before = std::mem::take(&mut self.latest);
            self.worker.rest();
        }
    }

    /// Stops what is being made; what was made so far stays on show.
    pub fn stay(&mut self) {
        self.asked = true;
        self.rest();
    }

    /// Closes a frame: pictures that nobody asked for in it are not made.
    pub fn end_frame(&mut self) {
        if !std::mem::take(&mut self.asked) {
            self.rest();
        }
    }

    /// The last pictures made.
    pub fn shot(&mut self) -> Option<Arc<RenderedFrame>> {
        let shown = self.worker.shown()?;
        if self.shot.as_ref().is_none_or(|shot| shot.serial != shown.serial) {
            // What arrived before the latest request was made answers the one before.
            let request = if shown.current { &self.latest } else { &self.before };
            // What arrived while nobody looked belongs to a request that is forgotten.
            let Some(query) = request.stages.get(shown.stage).cloned() else { return self.shot.clone() };
            // What was only remembered took no time worth telling.
            let remembered = self.shot.as_ref().filter(|shot| shot.query == query).map(|shot| shot.time);
            self.shot = Some(Arc::new(RenderedFrame {
                is_last: request.wanted.as_ref() == Some(&query),
                query,
                sources: request.sources.clone(),
                answer: shown.answer,
                time: remembered.unwrap_or(shown.time),
                serial: shown.serial,
            }));
        }
        self.shot.clone()
    }

    /// True if the pictures on show are those that are wanted in the end.
    pub fn is_settled(&self) -> bool {
        self.shot.as_ref().is_some_and(|shot| self.wanted.as_ref() == Some(&shot.query))
    }

    /// For how long the latest request has been worked on, if it still is.
    pub fn busy(&self) -> Option<Duration> {
        self.worker.busy()
    }

    /// Reason that the latest request has no answer, if it failed.
    pub fn failure(&self) -> Option<String> {
        self.worker.failure()
    }

    /// Hits, misses and times of each kind of question on the worker.
    pub fn counts(&self) -> Vec<(&'static str, Count)> {
        self.worker.counts()
    }

    /// Number of stages of the latest request.
    pub fn stages(&self) -> usize {
        self.latest.stages.len()
    }

    /// Waits until the latest request is answered. For tests.
    pub fn wait(&self) {
        self.worker.wait();
    }
}
