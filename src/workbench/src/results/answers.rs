//! The answers of one kind of query, bounded in number and memory.

use std::any::Any;
use std::collections::HashMap;
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use chromascope_core::query::Query;
use chromascope_core::render::Stop;

use super::Count;

/// The most memory that the answers of one kind take; the last one stays, however large.
const BYTES: usize = 256 << 20;
/// Interval at which a waiting thread checks whether its answer is still needed.
const GLANCE: Duration = Duration::from_millis(5);

/// Type-erased answers of one kind of query.
pub(super) trait Kind: Any + Send + Sync {
    fn count(&self) -> (&'static str, Count);
}

pub(super) struct Answers<Q: Query> {
    table: Mutex<Table<Q>>,
    /// Notified when a computation has ended.
    ended: Condvar,
}

struct Table<Q: Query> {
    slots: HashMap<Q, Slot<Q::Answer>>,
    count: Count,
}

enum Slot<A> {
    /// A thread computes it.
    Making,
    Made(Made<A>),
}

struct Made<A> {
    answer: Arc<A>,
    asked: u64,
    bytes: usize,
}

/// Result of a cache lookup.
pub(super) enum Asked<'a, Q: Query> {
    Known(Arc<Q::Answer>),
    /// The asker computes it.
    Ours(Claim<'a, Q>),
}

/// The promise to compute an answer, which ends by a panic too.
pub(super) struct Claim<'a, Q: Query> {
    answers: &'a Answers<Q>,
    query: &'a Q,
    /// Others wait for it.
    is_first: bool,
}

impl<Q: Query> Default for Answers<Q> {
    fn default() -> Self {
        let table = Table { slots: HashMap::new(), count: Count::default() };
        Self { table: Mutex::new(table), ended: Condvar::new() }
    }
}

impl<Q: Query> Kind for Answers<Q> {
    fn count(&self) -> (&'static str, Count) {
        (Q::NAME, self.lock().count)
    }
}

impl<Q: Query> Answers<Q> {
    /// A panic elsewhere leaves nothing half done here: each change is one insertion or removal.
    fn lock(&self) -> MutexGuard<'_, Table<Q>> {
        self.table.lock().unwrap_or_else(PoisonError::into_inner)
    }

    pub(super) fn known(&self, query: &Q, now: u64) -> Option<Arc<Q::Answer>> {
        self.lock().known(query, now)
    }

    /// The answer, waited for if another thread computes it; or the right to compute it. A thread of a pool never waits, nor does
    /// one that is stopped, unless computing would not stop either.
    pub(super) fn claim<'a>(&'a self, query: &'a Q, now: u64, stop: &Stop) -> Asked<'a, Q> {
        let is_in_pool = rayon::current_thread_index().is_some();
        let mut table = self.lock();
        let mut waits = false;
        loop {
            if let Some(answer) = table.known(query, now) {
                return Asked::Known(answer);
            }
            let is_first = !table.slots.contains_key(query);
            if is_first {
                table.slots.insert(query.clone(), Slot::Making);
            }
            if is_first || is_in_pool || (!Q::ALWAYS_COMPLETE && stop.is_set()) {
                return Asked::Ours(Claim { answers: self, query, is_first });
            }
            table.count.waits += u64::from(!waits);
            waits = true;
            (table, _) = self.ended.wait_timeout(table, GLANCE).unwrap_or_else(PoisonError::into_inner);
        }
    }
}

impl<Q: Query> Table<Q> {
    fn known(&mut self, query: &Q, now: u64) -> Option<Arc<Q::Answer>> {
        let Some(Slot::Made(made)) = self.slots.get_mut(query) else { return None };
        made.asked = now;
        self.count.hits += 1;
        Some(Arc::clone(&made.answer))
    }

    /// Evicts the least recently requested answers after one of so many bytes, until the rest is within the limits. Beyond their number
    /// a sixteenth of it goes at once: each of a thousand answers would look through all the others.
    fn excess(&mut self, new_bytes: usize) -> Vec<Slot<Q::Answer>> {
        if new_bytes == 0 && self.slots.len() <= Q::CAPACITY {
            return Vec::new();
        }
        let made = |slot: &Slot<Q::Answer>| match slot {
            Slot::Made(made) => Some((made.asked, made.bytes)),
            Slot::Making => None,
        };
        let mut known: Vec<(u64, usize)> = self.slots.values().filter_map(made).collect();
        known.sort_unstable();
        let (mut count, mut bytes, mut last) = (known.len(), known.iter().map(|(_, bytes)| bytes).sum::<usize>(), None);
        let most = if count > Q::CAPACITY { Q::CAPACITY - Q::CAPACITY / 16 } else { count };
        for (asked, size) in known {
            if count <= 1 || (count <= most && bytes <= BYTES) {
                break;
            }
            (count, bytes, last) = (count - 1, bytes - size, Some(asked));
        }
        let is_old = |slot: &Slot<_>| made(slot).is_some_and(|(asked, _)| Some(asked) <= last);
        self.slots.extract_if(|_, slot| is_old(slot)).map(|(_, slot)| slot).collect()
    }
}

impl<Q: Query> Claim<'_, Q> {
    /// Ends the computation with an answer to remember, or with none where it is not whole.
    pub(super) fn end(self, answer: Option<&Arc<Q::Answer>>, now: u64, made: Count) {
        let bytes = answer.map_or(0, |answer| Q::bytes(answer));
        let kept = answer.map(|answer| Slot::Made(Made { answer: Arc::clone(answer), asked: now, bytes }));
        let mut table = self.answers.lock();
        table.count.misses += made.misses;
        table.count.time += made.time;
        table.count.own_time += made.own_time;
        let before = kept.and_then(|kept| table.slots.insert(self.query.clone(), kept));
        let excess = table.excess(bytes);
        drop(table);
        // Large answers are dropped while no lock is held.
        drop((before, excess));
    }
}

impl<Q: Query> Drop for Claim<'_, Q> {
    fn drop(&mut self) {
        if self.is_first {
            let mut table = self.answers.lock();
            if matches!(table.slots.get(self.query), Some(Slot::Making)) {
                table.slots.remove(self.query);
            }
            drop(table);
            self.answers.ended.notify_all();
        }
    }
}
