//! Query cache, shared by the window and all background work.
//!
//! Each query is computed once. No lock is held during a computation. A thread that needs an answer which another thread is
//! computing waits for it; as no query depends on itself, two threads never wait for each other. Threads of the rayon pool
//! compute the answer themselves instead of waiting: a waiting one could be the one that the other thread's loop needs.

mod answers;

use std::any::{Any, TypeId};
use std::cell::Cell;
use std::collections::{BTreeMap, HashMap};
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, PoisonError, RwLock};
use std::time::{Duration, Instant};

use chromascope_core::query::{Ask, Query};
use chromascope_core::render::Stop;
use rayon::iter::{IntoParallelRefIterator as _, ParallelExtend as _, ParallelIterator as _};

use answers::{Answers, Asked, Kind};

/// Counters of one kind of query.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Count {
    pub hits: u64,
    /// Cache misses: answers that were computed.
    pub misses: u64,
    /// Number of times that an answer was waited for while another thread computed it.
    pub waits: u64,
    /// Time spent computing, nested queries included.
    pub time: Duration,
    /// Time spent computing, without nested queries.
    pub own_time: Duration,
}

/// One thread's access to the answers. Clones share them.
#[derive(Default)]
pub struct Results {
    store: Arc<Store>,
    stop: Stop,
    nested_time: Cell<Duration>,
    frame_time: Cell<Duration>,
    last_work: Cell<Duration>,
    depth: Cell<u32>,
}

/// The answers of each kind of query.
#[derive(Default)]
struct Store {
    kinds: RwLock<HashMap<TypeId, Arc<dyn Kind>>>,
    clock: AtomicU64,
}

impl Clone for Results {
    fn clone(&self) -> Self {
        self.until(self.stop.clone())
    }
}

impl Results {
    /// Access to the same cache until stopped. Answers that are being computed then are not cached.
    #[must_use]
    pub fn until(&self, stop: Stop) -> Self {
        Self { store: Arc::clone(&self.store), stop, ..Self::default() }
    }

    /// Closes a frame's book.
    pub fn end_frame(&self) {
        if self.frame_time.get() > Duration::ZERO {
            self.last_work.set(self.frame_time.replace(Duration::ZERO));
        }
    }

    /// The time that the last frame that computed anything spent computing.
    pub fn last_work(&self) -> Duration {
        self.last_work.get()
    }

    /// Hits, misses and time of each kind of query since the start, on all threads.
    pub fn counts(&self) -> BTreeMap<&'static str, Count> {
        let kinds = self.store.kinds.read().unwrap_or_else(PoisonError::into_inner);
        kinds.values().map(|kind| kind.count()).filter(|(_, count)| *count != Count::default()).collect()
    }

    /// The cached answer to a query, if any.
    pub fn known<Q: Query>(&self, query: &Q) -> Option<Arc<Q::Answer>> {
        self.answers::<Q>().known(query, self.now())
    }

    fn now(&self) -> u64 {
        self.store.clock.fetch_add(1, Ordering::Relaxed)
    }

    fn answers<Q: Query>(&self) -> Arc<Answers<Q>> {
        let id = TypeId::of::<Q>();
        let known = self.store.kinds.read().unwrap_or_else(PoisonError::into_inner).get(&id).cloned();
        let kind = known.unwrap_or_else(|| {
            let mut kinds = self.store.kinds.write().unwrap_or_else(PoisonError::into_inner);
            Arc::clone(kinds.entry(id).or_insert_with(|| Arc::new(Answers::<Q>::default())))
        });
        let kind: Arc<dyn Any + Send + Sync> = kind;
        kind.downcast().unwrap_or_default()
    }
}

impl Ask for Results {
    fn ask<Q: Query>(&self, query: &Q) -> Arc<Q::Answer> {
        let answers = self.answers::<Q>();
        if let Some(answer) = answers.known(query, self.now()) {
            return answer;
        }
        let start = Instant::now();
        let before = self.nested_time.replace(Duration::ZERO);
        self.depth.set(self.depth.get() + 1);
        // No lock is held here: the computation may evaluate further queries.
        let (answer, claim) = match answers.claim(query, self.now(), &self.stop) {
            Asked::Known(answer) => (answer, None),
            Asked::Ours(claim) => (Arc::new(query.answer(self)), Some(claim)),
        };
        self.depth.set(self.depth.get() - 1);
        let time = start.elapsed();
        let on_the_way = self.nested_time.replace(before + time);
        if self.depth.get() == 0 {
            self.frame_time.set(self.frame_time.get() + time);
        }
        if let Some(claim) = claim {
            let is_complete = Q::ALWAYS_COMPLETE || !self.stop.is_set();
            let made = Count { misses: 1, time, own_time: time.saturating_sub(on_the_way), ..Count::default() };
            claim.end(is_complete.then_some(&answer), self.now(), made);
        }
        answer
    }

    /// The first alone, so that what all of them need is cached before the others are computed in parallel.
    fn ask_all<Q: Query>(&self, queries: &[Q]) -> Vec<Arc<Q::Answer>> {
        let Some((first, rest)) = queries.split_first() else { return Vec::new() };
        let mut answers = vec![self.ask(first)];
        let start = Instant::now();
        let (store, stop) = (&self.store, &self.stop);
        let access = || Self { store: Arc::clone(store), stop: stop.clone(), ..Self::default() };
        answers.par_extend(rest.par_iter().map_init(access, |results, query| results.ask(query)));
        let time = start.elapsed();
        self.nested_time.set(self.nested_time.get() + time);
        if self.depth.get() == 0 {
            self.frame_time.set(self.frame_time.get() + time);
        }
        answers
    }

    fn stop(&self) -> Stop {
        self.stop.clone()
    }
}
