//! One door for slow answers: whoever waits asks in each frame, and has the last answer meanwhile.
//!
//! Each question of a pane has a [`Background`] of its own from the first time it is asked: nothing is to be named, ended or
//! waited for one by one. What a frame does not ask rests; what was [begun](Later::begin) goes on to its end.

use std::any::{Any, TypeId};
use std::cell::RefCell;
use std::collections::HashMap;
use std::sync::Arc;
use std::time::Duration;

use super::{Background, Executor, Job, Shown};

/// Slow answers, by who waits for them and the type of the question.
pub struct Later {
    executor: Executor,
    wake: Arc<dyn Fn() + Send + Sync>,
    slots: RefCell<Slots>,
}

type Slots = HashMap<(&'static str, TypeId), Box<dyn Slot>>;

/// What there is of an answer.
pub struct Waiting<J: Job> {
    /// The last answer with its question, which may be an earlier one.
    pub shown: Option<Shown<J>>,
    pub busy: Option<Duration>,
    /// Reason that the request has no answer.
    pub failure: Option<String>,
    /// The stages requested, and the number of those finished.
    pub stages: Arc<[J]>,
    pub done: usize,
}

impl<J: Job> Waiting<J> {
    /// The last answer, which may be of an earlier question; an error if this question has none.
    pub fn last(self) -> Result<Option<Shown<J>>, String> {
        self.failure.map_or(Ok(self.shown), Err)
    }

    /// The answer to this question, once there is one.
    pub fn current(self) -> Result<Option<Arc<J::Answer>>, String> {
        Ok(self.last()?.filter(|shown| shown.current).map(|shown| shown.answer))
    }
}

/// A thread for one question at a time.
struct Worker<J: Job> {
    thread: Background<J>,
    is_asked: bool,
    goes_on: bool,
}

trait Slot: Any {
    fn end_frame(&mut self);
    fn wait(&self);
}

impl<J: Job> Slot for Worker<J> {
    fn end_frame(&mut self) {
        if !std::mem::take(&mut self.is_asked) && !self.goes_on && self.thread.busy().is_some() {
            self.thread.rest();
        }
    }

    fn wait(&self) {
        self.thread.wait();
    }
}

impl Later {
    /// Answers on an executor; `wake` is called after each answer, from the worker's thread.
    pub fn on(executor: &Executor, wake: impl Fn() + Send + Sync + 'static) -> Self {
        Self { executor: executor.clone(), wake: Arc::new(wake), slots: RefCell::default() }
    }

    /// Asks for a pane, in stages from coarse to fine: the latest request wins, the same one again changes nothing. An empty
    /// list asks for nothing.
    pub fn ask<J: Job>(&self, pane: impl Into<&'static str>, stages: Vec<J>) -> Waiting<J> {
        self.with(pane, |worker| {
            worker.is_asked = true;
            worker.thread.ask(stages);
            worker.waiting()
        })
    }

    /// Asks once more for what was asked last.
    pub fn again<J: Job>(&self, pane: impl Into<&'static str>) -> Waiting<J> {
        self.with(pane, |worker| {
            worker.is_asked = true;
            worker.waiting()
        })
    }

    /// Asks anew, even if it was asked before. It goes on in frames that do not ask, until it is [stopped](Self::stop).
    pub fn begin<J: Job>(&self, pane: impl Into<&'static str>, stages: Vec<J>) {
        self.with(pane, |worker| {
            worker.goes_on = true;
            worker.thread.ask_anew(stages);
        });
    }

    /// Stops what was begun. Its last answer stays.
    pub fn stop<J: Job>(&self, pane: impl Into<&'static str>) {
        self.with(pane, |worker: &mut Worker<J>| {
            worker.goes_on = false;
            worker.thread.rest();
        });
    }

    /// What there is of an answer, without asking for it.
    pub fn seen<J: Job>(&self, pane: impl Into<&'static str>) -> Waiting<J> {
        self.with(pane, |worker| worker.waiting())
    }

    /// Ends a frame: what it did not ask for is stopped, and resumes when asked for again. What is answered stays.
    pub fn end_frame(&self) {
        self.slots.borrow_mut().values_mut().for_each(|slot| slot.end_frame());
    }

    /// Waits until all is answered. For tests.
    pub fn wait(&self) {
        self.slots.borrow().values().for_each(|slot| slot.wait());
    }

    fn with<J: Job, R>(&self, pane: impl Into<&'static str>, read: impl FnOnce(&mut Worker<J>) -> R) -> R {
        let mut slots = self.slots.borrow_mut();
        let slot = slots.entry((pane.into(), TypeId::of::<J>())).or_insert_with(|| {
            let wake = Arc::clone(&self.wake);
            let thread = Background::<J>::on(&self.executor, move || wake());
            Box::new(Worker { thread, is_asked: false, goes_on: false })
        });
        let slot: &mut dyn Any = &mut **slot;
        read(slot.downcast_mut().expect("a slot is of the type that it is kept under"))
    }
}

impl<J: Job> Worker<J> {
    fn waiting(&self) -> Waiting<J> {
        let (stages, done) = self.thread.progress();
        let (shown, busy, failure) = (self.thread.shown(), self.thread.busy(), self.thread.failure());
        Waiting { shown, busy, failure, stages, done }
    }
}
