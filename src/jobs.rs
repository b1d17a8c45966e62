//! Work beside the window: a named thread for each place on screen that waits for long answers.
//!
//! The latest request wins and stops the one before it; the last answer stays on show; a panic stays where it happened.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::thread;
use std::time::{Duration, Instant};

use chromascope_core::query::{Ask, Query};
use chromascope_core::render::Stop;

use crate::results::{Count, Results};

/// Answers of one kind of question, made on a thread of their own.
pub struct Background<Q: Query> {
    desk: Arc<Desk<Q>>,
}

/// What lies between the window and the worker.
struct Desk<Q: Query> {
    state: Mutex<State<Q>>,
    news: Condvar,
    wake: Box<dyn Fn() + Send + Sync>,
}

struct State<Q: Query> {
    /// The stages of the latest request, from coarse to fine; what is to be made next.
    stages: Arc<[Q]>,
    next: usize,
    stop: Arc<AtomicBool>,
    begun: Option<Instant>,
    shown: Option<Shown<Q::Answer>>,
    /// What is answered by what is shown.
    question: Option<Q>,
    failure: Option<String>,
    counts: Vec<(&'static str, Count)>,
    closed: bool,
}

/// An answer on show.
pub struct Shown<A> {
    /// The answer.
    pub answer: Arc<A>,
    /// Which stage of its request it is.
    pub stage: usize,
    /// Whether it answers the latest request.
    pub current: bool,
    /// How long it took, earlier stages not included.
    pub time: Duration,
    /// A number that no other answer has.
    pub serial: u64,
}

impl<A> Clone for Shown<A> {
    fn clone(&self) -> Self {
        let Self { answer, stage, current, time, serial } = self;
        Self { answer: Arc::clone(answer), stage: *stage, current: *current, time: *time, serial: *serial }
    }
}

impl<Q> Background<Q>
where
    Q: Query + Send + Sync,
    Q::Answer: Send + Sync,
{
    /// Starts the worker. `wake` is called after each answer, from the worker's thread.
    pub fn new(name: &str, wake: impl Fn() + Send + Sync + 'static) -> Self {
        let state = State {
            stages: Arc::from(Vec::new()),
            next: 0,
            stop: Arc::default(),
            begun: None,
            shown: None,
            question: None,
            failure: None,
            counts: Vec::new(),
            closed: false,
        };
        let desk = Arc::new(Desk { state: Mutex::new(state), news: Condvar::new(), wake: Box::new(wake) });
        let theirs = Arc::clone(&desk);
        let started = thread::Builder::new().name(name.to_owned()).spawn(move || work(&theirs));
        if let Err(error) = started {
            desk.lock().failure = Some(format!("no thread could be started: {error}"));
        }
        Self { desk }
    }

    /// Asks for stages from coarse to fine. The same request again changes nothing; another stops the one before it.
    pub fn ask(&self, stages: Vec<Q>) {
        let mut state = self.desk.lock();
        if *state.stages == *stages {
            return;
        }
        state.stop.store(true, Ordering::Relaxed);
        state.stop = Arc::default();
        state.begun = (!stages.is_empty()).then(Instant::now);
        state.stages = stages.into();
        state.next = 0;
        state.failure = None;
        if let Some(shown) = &mut state.shown {
            shown.current = false;
        }
        drop(state);
        self.desk.news.notify_all();
    }

    /// Stops what is being made: nobody looks. The answer on show stays.
    pub fn rest(&self) {
        self.ask(Vec::new());
    }

    /// The last answer.
    pub fn shown(&self) -> Option<Shown<Q::Answer>> {
        self.desk.lock().shown.clone()
    }

    /// The last answer with its question, which may not be the latest that was asked.
    pub fn answered(&self) -> Option<(Q, Arc<Q::Answer>)> {
        let state = self.desk.lock();
        Some((state.question.clone()?, Arc::clone(&state.shown.as_ref()?.answer)))
    }

    /// For how long the latest request has been worked on, if it still is.
    pub fn busy(&self) -> Option<Duration> {
        self.desk.lock().begun.map(|begun| begun.elapsed())
    }

    /// Why the latest request has no answer, if it failed.
    pub fn failure(&self) -> Option<String> {
        self.desk.lock().failure.clone()
    }

    /// Hits, misses and times of each kind of question on the worker.
    pub fn counts(&self) -> Vec<(&'static str, Count)> {
        self.desk.lock().counts.clone()
    }

    /// Waits until the latest request is answered or has failed. For tests and programs without a window.
    pub fn wait(&self) {
        let mut state = self.desk.lock();
        while state.begun.is_some() && state.failure.is_none() {
            let (next, _) =
                self.desk.news.wait_timeout(state, Duration::from_millis(20)).unwrap_or_else(PoisonError::into_inner);
            state = next;
        }
    }
}

impl<Q: Query> Drop for Background<Q> {
    fn drop(&mut self) {
        let mut state = self.desk.lock();
        state.closed = true;
        state.stop.store(true, Ordering::Relaxed);
        drop(state);
        self.desk.news.notify_all();
    }
}

impl<Q: Query> Desk<Q> {
    /// A panic elsewhere leaves nothing half done here: each change is one assignment.
    fn lock(&self) -> MutexGuard<'_, State<Q>> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// The worker's life.
fn work<Q: Query>(desk: &Desk<Q>) {
    // The worker is one of the threads that compute: handing each small piece over to others and waiting costs a fifth of a
    // frame. Without a pool of its own it uses the common one.
    let _pool = rayon::ThreadPoolBuilder::new().use_current_thread().build();
    let mut results = Results::bounded();
    let mut serial = 0;
    loop {
        let (stages, next, stop) = {
            let mut state = desk.lock();
            while !state.closed && state.next >= state.stages.len() {
                state = desk.news.wait(state).unwrap_or_else(PoisonError::into_inner);
            }
            if state.closed {
                return;
            }
            (Arc::clone(&state.stages), state.next, Arc::clone(&state.stop))
        };
        results.stop_at(Stop::at(Arc::clone(&stop)));
        let start = Instant::now();
        let answer = catch_unwind(AssertUnwindSafe(|| results.ask(&stages[next])));
        let time = start.elapsed();
        serial += 1;
        let mut state = desk.lock();
        if stop.load(Ordering::Relaxed) || !Arc::ptr_eq(&state.stages, &stages) {
            if answer.is_err() {
                results = Results::bounded();
            }
            continue;
        }
        match answer {
            Ok(answer) => {
                state.shown = Some(Shown { answer, stage: next, current: true, time, serial });
                state.question = Some(stages[next].clone());
                state.next = next + 1;
            }
            Err(panic) => {
                state.failure = Some(said(panic.as_ref()));
                state.next = stages.len();
                // What it was in the middle of is not to be trusted.
                results = Results::bounded();
            }
        }
        if state.next >= stages.len() {
            state.begun = None;
        }
        state.counts = results.counts().into_iter().collect();
        drop(state);
        desk.news.notify_all();
        (desk.wake)();
    }
}

/// What a panic said.
fn said(panic: &(dyn std::any::Any + Send)) -> String {
    let text = panic.downcast_ref::<&str>().map(|text| (*text).to_owned());
    text.or_else(|| panic.downcast_ref::<String>().cloned()).unwrap_or_else(|| "an unknown failure".to_owned())
}
