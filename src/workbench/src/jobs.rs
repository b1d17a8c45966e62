//! Background work: a thread for each question that somebody waits for, through one door ([`Later`]).
//!
//! The latest request stops the one before it; the last answer stays visible meanwhile; a panic fails its own request only. A
//! request is one query in stages from coarse to fine, or a list of queries ([`Background::progress`] counts the finished ones,
//! and [`Results::known`] has their answers as they arrive). The threads share the cache and, for their loops, the common rayon
//! pool, to which none of them belongs: no thread of the pool starts a whole job while it waits for a part of another. Tests run
//! the same work on a [driven](Executor::driven) executor: on their own thread and clock.

mod executor;
mod later;

pub use executor::{Clock, Executor, Monitor};
pub use later::{Later, Waiting};

use std::cell::Cell;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::rc::Rc;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use chromascope_core::query::{Ask as _, Query};
use chromascope_core::render::Stop;

use crate::results::Results;

/// After this long a computation is shown to be going on.
pub const PATIENCE: Duration = Duration::from_millis(100);

/// Work to be done in the background. Every [`Query`] is a job; so is a measurement, which is repeated at each request.
pub trait Job: Clone + PartialEq + Send + Sync + 'static {
    type Answer: Send + Sync + 'static;
    /// Name of its thread, and of its place in the queue of a driven executor.
    const NAME: &'static str;

    /// Runs the job with the shared cache. The result is discarded if [`Results::stop`](chromascope_core::query::Ask::stop) was
    /// set meanwhile.
    fn run(&self, results: &Results) -> Arc<Self::Answer>;
}

impl<Q: Query> Job for Q {
    type Answer = <Q as Query>::Answer;
    const NAME: &'static str = <Q as Query>::NAME;

    fn run(&self, results: &Results) -> Arc<Self::Answer> {
        results.ask(self)
    }
}

/// Runs one kind of job on a thread of its own and holds its latest answer.
pub struct Background<J: Job> {
    monitor: Arc<Monitor<State<J>>>,
    executor: Executor,
    /// True if a driven executor has the work in its queue.
    is_queued: Rc<Cell<bool>>,
}

struct State<J: Job> {
    /// The stages of the latest request, from coarse to fine, and the next one.
    stages: Arc<[J]>,
    next: usize,
    stop: Arc<AtomicBool>,
    begun: Option<Duration>,
    shown: Option<Shown<J>>,
    serial: u64,
    failure: Option<String>,
    closed: bool,
}

/// The latest answer.
pub struct Shown<J: Job> {
    pub job: J,
    pub answer: Arc<J::Answer>,
    /// True if it is of the latest request.
    pub current: bool,
    /// Time taken by this stage alone.
    pub time: Duration,
    /// A number that no other answer has.
    pub serial: u64,
}

impl<J: Job> Clone for Shown<J> {
    fn clone(&self) -> Self {
        let (job, answer) = (self.job.clone(), Arc::clone(&self.answer));
        Self { job, answer, current: self.current, time: self.time, serial: self.serial }
    }
}

impl<J: Job> Background<J> {
    /// Starts the worker on an executor. `wake` is called after each answer, from the worker's thread.
    pub fn on(executor: &Executor, wake: impl Fn() + Send + Sync + 'static) -> Self {
        let state = State {
            stages: Arc::from(Vec::new()),
            next: 0,
            stop: Arc::default(),
            begun: None,
            shown: None,
            serial: 0,
            failure: None,
            closed: false,
        };
        let monitor = Arc::new(Monitor::new(executor, state, wake));
        if !executor.is_driven() {
            let (theirs, results) = (Arc::clone(&monitor), executor.results());
            let work = move || {
                while theirs.wait_for(|state| state.closed || state.has_work(), |state| !state.closed) {
                    step(&theirs, &results);
                }
            };
            if let Err(error) = executor.spawn(J::NAME, work) {
                monitor.lock().failure = Some(format!("no thread could be started: {error}"));
            }
        }
        Self { monitor, executor: executor.clone(), is_queued: Rc::default() }
    }

    /// Requests stages from coarse to fine. The same request again changes nothing; another stops the one before it.
    pub fn ask(&self, stages: Vec<J>) {
        if *self.monitor.lock().stages != *stages {
            self.ask_anew(stages);
        }
    }

    /// Requests stages even if they are those of the latest request.
    pub fn ask_anew(&self, stages: Vec<J>) {
        let mut state = self.monitor.lock();
        state.stop.store(true, Ordering::Relaxed);
        state.stop = Arc::default();
        state.begun = (!stages.is_empty()).then(|| self.monitor.clock().now());
        state.stages = stages.into();
        state.next = 0;
        state.failure = None;
        if let Some(shown) = &mut state.shown {
            shown.current = false;
        }
        drop(state);
        self.monitor.notify();
        self.queue();
    }

    /// Has a driven executor make the stages, one at each step.
    fn queue(&self) {
        if !self.executor.is_driven() || self.is_queued.replace(true) {
            return;
        }
        let (monitor, results) = (Arc::clone(&self.monitor), self.executor.results());
        let is_queued = Rc::clone(&self.is_queued);
        self.executor.queue(J::NAME, move || {
            step(&monitor, &results);
            is_queued.set(monitor.lock().has_work());
            is_queued.get()
        });
    }

    /// Stops the current work, as its result is no longer needed. The last answer stays available.
    pub fn rest(&self) {
        self.ask(Vec::new());
    }

    /// The last answer with its query, which may not be the latest requested.
    pub fn shown(&self) -> Option<Shown<J>> {
        self.monitor.lock().shown.clone()
    }

    /// Running time of the latest request, if it is still running.
    pub fn busy(&self) -> Option<Duration> {
        self.monitor.lock().begun.map(|begun| self.monitor.clock().since(begun))
    }

    /// The stages of the latest request, and the number of finished ones.
    pub fn progress(&self) -> (Arc<[J]>, usize) {
        let state = self.monitor.lock();
        (Arc::clone(&state.stages), state.next)
    }

    /// Reason that the latest request has no answer, if it failed.
    pub fn failure(&self) -> Option<String> {
        self.monitor.lock().failure.clone()
    }

    /// Waits until the latest request has finished or failed. For tests and programs without a window.
    pub fn wait(&self) {
        self.monitor.settle(&self.executor, |state| state.begun.is_none() || state.failure.is_some());
    }
}

impl<J: Job> Drop for Background<J> {
    fn drop(&mut self) {
        let mut state = self.monitor.lock();
        state.closed = true;
        state.stop.store(true, Ordering::Relaxed);
        drop(state);
        self.monitor.notify();
    }
}

impl<J: Job> State<J> {
    fn has_work(&self) -> bool {
        self.next < self.stages.len() && !self.closed
    }
}

/// Makes the next stage, if there is one.
fn step<J: Job>(monitor: &Monitor<State<J>>, results: &Results) {
    let (stages, next, stop) = {
        let state = monitor.lock();
        if !state.has_work() {
            return;
        }
        (Arc::clone(&state.stages), state.next, Arc::clone(&state.stop))
    };
    let results = results.until(Stop::at(Arc::clone(&stop)));
    let start = monitor.clock().now();
    let answer = catch_unwind(AssertUnwindSafe(|| stages[next].run(&results)));
    let time = monitor.clock().since(start);
    let mut state = monitor.lock();
    if stop.load(Ordering::Relaxed) {
        return;
    }
    match answer {
        Ok(answer) => {
            state.serial += 1;
            let (job, serial) = (stages[next].clone(), state.serial);
            state.shown = Some(Shown { job, answer, current: true, time, serial });
            state.next = next + 1;
        }
        Err(panic) => {
            state.failure = Some(said(panic.as_ref()));
            state.next = stages.len();
        }
    }
    if state.next >= stages.len() {
        state.begun = None;
    }
    drop(state);
    monitor.tell();
}

/// Message of a panic.
fn said(panic: &(dyn std::any::Any + Send)) -> String {
    let text = panic.downcast_ref::<&str>().map(|text| (*text).to_owned());
    text.or_else(|| panic.downcast_ref::<String>().cloned()).unwrap_or_else(|| "an unknown failure".to_owned())
}
