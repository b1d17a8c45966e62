//! State shared by the window and background threads.

use std::sync::{Condvar, Mutex, MutexGuard, PoisonError};

use super::executor::{Clock, Executor};

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
