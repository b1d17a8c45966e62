//! Threads for background work, the answers and the state they share and the clock that times it; for tests, a queue and a clock that
//! they drive.

use std::cell::RefCell;
use std::collections::VecDeque;
use std::io;
use std::rc::Rc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Condvar, LazyLock, Mutex, MutexGuard, PoisonError};
use std::thread;
use std::time::{Duration, Instant};

use crate::results::Results;

/// Runs background work: on a thread for each piece or, if [driven](Self::driven), only on request. Clones share their
/// answers.
#[derive(Clone, Default)]
pub struct Executor {
    driven: Option<Rc<Driven>>,
    results: Results,
}

/// The queue and the clock of an executor that is driven by its owner.
#[derive(Default)]
struct Driven {
    queue: RefCell<VecDeque<(String, Task)>>,
    clock: Arc<AtomicU64>,
}

/// A piece of work, which returns whether it is to be run again.
type Task = Box<dyn FnMut() -> bool>;

impl Executor {
    /// An executor that runs queued work only on request, on the caller's thread, and whose clock advances only by
    /// [`advance`](Self::advance). Its clones share queue and clock.
    pub fn driven() -> Self {
        Self { driven: Some(Rc::default()), results: Results::default() }
    }

    /// True if queued work runs only on request.
    pub fn is_driven(&self) -> bool {
        self.driven.is_some()
    }

    /// The answers that all work on this executor shares.
    pub fn results(&self) -> Results {
        self.results.clone()
    }

    /// The clock that work is timed by.
    pub fn clock(&self) -> Clock {
        Clock(self.driven.as_ref().map(|driven| Arc::clone(&driven.clock)))
    }

    /// Starts work on a thread of that name, or queues it.
    pub fn spawn(&self, name: &str, work: impl FnOnce() + Send + 'static) -> io::Result<()> {
        if self.driven.is_none() {
            return thread::Builder::new().name(name.to_owned()).spawn(work).map(drop);
        }
        let mut work = Some(work);
        self.queue(name, move || {
            work.take().into_iter().for_each(|work| work());
            false
        });
        Ok(())
    }

    /// Queues work that is repeated, behind the work queued meanwhile, for as long as it returns true. Threads run no such work.
    pub(super) fn queue(&self, name: &str, work: impl FnMut() -> bool + 'static) {
        if let Some(driven) = &self.driven {
            driven.queue.borrow_mut().push_back((name.to_owned(), Box::new(work)));
        }
    }

    /// Names of the queued work, in the order in which it will run.
    pub fn queued(&self) -> Vec<String> {
        self.driven
            .iter()
            .flat_map(|driven| driven.queue.borrow().iter().map(|(name, _)| name.clone()).collect::<Vec<_>>())
            .collect()
    }

    /// Runs the next step of the first queued work of a name. Returns whether there was any.
    pub fn run_one(&self, name: &str) -> bool {
        self.run_first(|queued| queued == name)
    }

    /// Runs the next step of the first queued work. Returns whether there was any.
    pub fn run_next(&self) -> bool {
        self.run_first(|_| true)
    }

    pub fn run_all(&self) {
        while self.run_next() {}
    }

    pub fn advance(&self, by: Duration) {
        if let Some(driven) = &self.driven {
            driven.clock.fetch_add(u64::try_from(by.as_nanos()).unwrap_or(u64::MAX), Ordering::Relaxed);
        }
    }

    fn run_first(&self, wanted: impl Fn(&str) -> bool) -> bool {
        let Some(driven) = &self.driven else { return false };
        let taken = {
            let mut queue = driven.queue.borrow_mut();
            let place = queue.iter().position(|(name, _)| wanted(name));
            place.and_then(|place| queue.remove(place))
        };
        let Some((name, mut task)) = taken else { return false };
        // Nothing is borrowed here: work may queue more.
        if task() {
            driven.queue.borrow_mut().push_back((name, task));
        }
        true
    }
}

/// The system's steady clock, or that of a driven executor.
#[derive(Clone, Debug, Default)]
pub struct Clock(Option<Arc<AtomicU64>>);

/// The moment that the system's clock is read from.
static START: LazyLock<Instant> = LazyLock::new(Instant::now);

impl Clock {
    /// Time since a moment that all readings of this clock share.
    pub fn now(&self) -> Duration {
        match &self.0 {
            Some(nanoseconds) => Duration::from_nanos(nanoseconds.load(Ordering::Relaxed)),
            None => START.elapsed(),
        }
    }

    /// Time since an earlier reading.
    pub fn since(&self, earlier: Duration) -> Duration {
        self.now().saturating_sub(earlier)
    }
}

/// State shared by the window and background threads, with a condition variable for waiting threads and a wake callback
/// for the window.
pub struct Monitor<S> {
    state: Mutex<S>,
    news: Condvar,
    wake: Box<dyn Fn() + Send + Sync>,
    clock: Clock,
}

impl<S> Monitor<S> {
    /// Creates the initial state with an executor's clock. `wake` is called from the thread that changed the state.
    pub fn new(executor: &Executor, state: S, wake: impl Fn() + Send + Sync + 'static) -> Self {
        Self { state: Mutex::new(state), news: Condvar::new(), wake: Box::new(wake), clock: executor.clock() }
    }

    /// The state. A panic elsewhere leaves no partial state: it is only read and replaced under the lock.
    pub fn lock(&self) -> MutexGuard<'_, S> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    pub fn clock(&self) -> &Clock {
        &self.clock
    }

    /// Notifies waiting threads of a change.
    pub fn notify(&self) {
        self.news.notify_all();
    }

    /// Notifies waiting threads and the window.
    pub fn tell(&self) {
        self.notify();
        (self.wake)();
    }

    /// Waits until the state satisfies a condition, and then reads it.
    pub fn wait_for<R>(&self, is_wanted: impl Fn(&S) -> bool, read: impl FnOnce(&S) -> R) -> R {
        let state = self.news.wait_while(self.lock(), |state| !is_wanted(state));
        read(&state.unwrap_or_else(PoisonError::into_inner))
    }

    /// Waits until the state satisfies a condition: on a driven executor, by running its queued work. For tests.
    pub fn settle(&self, executor: &Executor, is_wanted: impl Fn(&S) -> bool) {
        if executor.is_driven() {
            while !is_wanted(&self.lock()) && executor.run_next() {}
        } else {
            self.wait_for(is_wanted, |_| ());
        }
    }
}
