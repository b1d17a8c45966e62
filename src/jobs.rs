//! Work beside the window: a named thread for each place on screen that waits for long answers.
//!
//! The latest request wins and stops the one before it; the last answer stays on show; a panic stays where it happened. Tests run
//! the same work on a [driven](Executor::driven) executor: on their own thread, when they say so, by a clock that they move.

mod executor;

pub use executor::{Clock, Executor};

use std::cell::{Cell, RefCell};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::rc::Rc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use chromascope_core::query::{Ask, Query};
use chromascope_core::render::Stop;

use crate::results::{Count, Results};

/// Answers of one kind of question, made on a thread of their own.
pub struct Background<Q: Query> {
    desk: Arc<Desk<Q>>,
    name: String,
    executor: Executor,
    /// The worker where no thread has one, and whether it is queued.
    driven: Rc<(RefCell<Worker>, Cell<bool>)>,
}

/// What lies between the window and the worker.
struct Desk<Q: Query> {
    state: Mutex<State<Q>>,
    news: Condvar,
    wake: Box<dyn Fn() + Send + Sync>,
    clock: Clock,
}

struct State<Q: Query> {
    /// The stages of the latest request, from coarse to fine; what is to be made next.
    stages: Arc<[Q]>,
    next: usize,
    stop: Arc<AtomicBool>,
    begun: Option<Duration>,
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
    /// True if it answers the latest request.
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
        Self::on(&Executor::default(), name, wake)
    }

    /// Starts the worker on an executor.
    pub fn on(executor: &Executor, name: &str, wake: impl Fn() + Send + Sync + 'static) -> Self {
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
        let clock = executor.clock();
        let desk = Arc::new(Desk { state: Mutex::new(state), news: Condvar::new(), wake: Box::new(wake), clock });
        if !executor.is_driven() {
            let theirs = Arc::clone(&desk);
            if let Err(error) = executor.spawn(name, move || work(&theirs)) {
                desk.lock().failure = Some(format!("no thread could be started: {error}"));
            }
        }
        Self { desk, name: name.to_owned(), executor: executor.clone(), driven: Rc::default() }
    }

    /// Asks for stages from coarse to fine. The same request again changes nothing; another stops the one before it.
    pub fn ask(&self, stages: Vec<Q>) {
        let mut state = self.desk.lock();
        if *state.stages == *stages {
            return;
        }
        state.stop.store(true, Ordering::Relaxed);
        state.stop = Arc::default();
        state.begun = (!stages.is_empty()).then(|| self.desk.clock.now());
        state.stages = stages.into();
        state.next = 0;
        state.failure = None;
        if let Some(shown) = &mut state.shown {
            shown.current = false;
        }
        drop(state);
        self.desk.news.notify_all();
        self.queue();
    }

    /// Has a driven executor make the stages, one at each step.
    fn queue(&self) {
        let (_, queued) = &*self.driven;
        if !self.executor.is_driven() || queued.replace(true) {
            return;
        }
        let (desk, driven) = (Arc::clone(&self.desk), Rc::clone(&self.driven));
        self.executor.queue(&self.name, move || {
            let (worker, queued) = &*driven;
            worker.borrow_mut().step(&desk);
            queued.set(desk.has_work());
            queued.get()
        });
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
        self.desk.lock().begun.map(|begun| self.desk.clock.since(begun))
    }

    /// Reason that the latest request has no answer, if it failed.
    pub fn failure(&self) -> Option<String> {
        self.desk.lock().failure.clone()
    }

    /// Hits, misses and times of each kind of question on the worker.
    pub fn counts(&self) -> Vec<(&'static str, Count)> {
        self.desk.lock().counts.clone()
    }

    /// Waits until the latest request is answered or has failed. For tests and programs without a window.
    pub fn wait(&self) {
        if self.executor.is_driven() {
            while self.desk.has_work() && self.executor.run_next() {}
            return;
        }
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

    /// Waits for a stage that is to be made. Returns false when the window has gone.
    fn wait_for_work(&self) -> bool {
        let mut state = self.lock();
        while !state.closed && !state.has_work() {
            state = self.news.wait(state).unwrap_or_else(PoisonError::into_inner);
        }
        !state.closed
    }

    fn has_work(&self) -> bool {
        self.lock().has_work()
    }

    /// The stages, which of them is to be made next, and the signal that it is no longer wanted.
    fn next(&self) -> Option<(Arc<[Q]>, usize, Arc<AtomicBool>)> {
        let state = self.lock();
        (!state.closed && state.has_work()).then(|| (Arc::clone(&state.stages), state.next, Arc::clone(&state.stop)))
    }
}

impl<Q: Query> State<Q> {
    fn has_work(&self) -> bool {
        self.next < self.stages.len()
    }
}

/// The life of a worker on a thread of its own.
fn work<Q: Query>(desk: &Desk<Q>) {
    // The worker is one of the threads that compute: handing each small piece over to others and waiting costs a fifth of a
    // frame. Without a pool of its own it uses the common one.
    let _pool = rayon::ThreadPoolBuilder::new().use_current_thread().build();
    let mut worker = Worker::default();
    while desk.wait_for_work() {
        worker.step(desk);
    }
}

/// What a worker keeps from one answer to the next.
struct Worker {
    results: Results,
    serial: u64,
}

impl Default for Worker {
    fn default() -> Self {
        Self { results: Results::bounded(), serial: 0 }
    }
}

impl Worker {
    /// Makes the next stage, if there is one.
    fn step<Q: Query>(&mut self, desk: &Desk<Q>) {
        let Some((stages, next, stop)) = desk.next() else { return };
        self.results.stop_at(Stop::at(Arc::clone(&stop)));
        let start = desk.clock.now();
        let answer = catch_unwind(AssertUnwindSafe(|| self.results.ask(&stages[next])));
        let time = desk.clock.since(start);
        self.serial += 1;
        let serial = self.serial;
        if answer.is_err() {
            // What it was in the middle of is not to be trusted.
            self.results = Results::bounded();
        }
        let mut state = desk.lock();
        if stop.load(Ordering::Relaxed) || !Arc::ptr_eq(&state.stages, &stages) {
            return;
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
            }
        }
        if state.next >= stages.len() {
            state.begun = None;
        }
        state.counts = self.results.counts().into_iter().collect();
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

#[cfg(test)]
mod tests {
    use super::*;

    /// Twice a number; 13 cannot be doubled.
    #[derive(Clone, PartialEq, Eq, Hash)]
    struct Doubled(u32);

    impl Query for Doubled {
        type Answer = u32;
        const NAME: &'static str = "doubled";

        fn answer(&self, _: &impl Ask) -> u32 {
            assert_ne!(self.0, 13, "no luck");
            2 * self.0
        }
    }

    fn doubling() -> (Executor, Background<Doubled>) {
        let executor = Executor::driven();
        let worker = Background::on(&executor, "doubling", || ());
        (executor, worker)
    }

    fn shown(worker: &Background<Doubled>) -> Option<(u32, usize, bool)> {
        worker.shown().map(|shown| (*shown.answer, shown.stage, shown.current))
    }

    #[test]
    fn stages_come_one_by_one_and_the_latest_request_wins() {
        let (executor, worker) = doubling();
        worker.ask(vec![Doubled(1), Doubled(2)]);
        assert_eq!((shown(&worker), worker.busy()), (None, Some(Duration::ZERO)));
        assert!(executor.run_one("doubling"));
        assert_eq!(shown(&worker), Some((2, 0, true)));
        executor.advance(Duration::from_secs(3));
        assert_eq!(worker.busy(), Some(Duration::from_secs(3)));
        worker.ask(vec![Doubled(5)]);
        assert_eq!((shown(&worker), worker.busy()), (Some((2, 0, false)), Some(Duration::ZERO)));
        executor.run_all();
        assert_eq!((shown(&worker), worker.busy()), (Some((10, 0, true)), None));
        let computed: Vec<_> = worker.counts().into_iter().map(|(name, count)| (name, count.misses)).collect();
        assert_eq!(computed, [("doubled", 2)], "the stage of the request before was not made");
    }

    #[test]
    fn what_nobody_looks_at_is_not_made() {
        let (executor, worker) = doubling();
        worker.ask(vec![Doubled(1)]);
        worker.rest();
        executor.run_all();
        assert_eq!((shown(&worker), worker.busy(), worker.counts().len()), (None, None, 0));
    }

    #[test]
    fn a_panic_fails_its_request_alone() {
        let (_executor, worker) = doubling();
        worker.ask(vec![Doubled(13)]);
        worker.wait();
        assert!(worker.failure().is_some_and(|why| why.contains("no luck")) && worker.busy().is_none());
        worker.ask(vec![Doubled(4)]);
        worker.wait();
        assert_eq!((shown(&worker), worker.failure()), (Some((8, 0, true)), None));
    }

    #[test]
    fn a_thread_answers_too() {
        let worker = Background::new("doubling", || ());
        worker.ask(vec![Doubled(1), Doubled(2)]);
        worker.wait();
        assert_eq!(shown(&worker), Some((4, 1, true)));
    }
}
